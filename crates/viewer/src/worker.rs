//! Worker that runs an engine in a thread of its own: the newest settings win, and the thread that shows
//! pictures never waits.

use std::collections::VecDeque;
use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};
use std::thread::JoinHandle;
use std::time::{Duration, Instant};

use rasray_experiment::SystemConfig;

use crate::engine::{Engine, SceneSource, Step};
use crate::error::ViewerError;
use crate::picked::{Answer, Pick};
use crate::picture::Picture;
use crate::session::{Failure, Opening};
use crate::settings::Settings;

/// Least time between two forwarded pictures of equal settings.
const PICTURE_PAUSE: Duration = Duration::from_millis(30);

/// Message of a worker.
pub enum Update {
    /// Description of work that takes long, in a few words.
    Status(String),
    /// A picture.
    Picture(Box<Picture>),
    /// Failure of the settings. The last complete picture stays.
    Failed(ViewerError),
    /// Answer of a system to the pick of this number.
    Answered(u64, Answer),
    /// Result of reading a scene, with the number of the request.
    Read(u64, Result<Box<Opened>, Failure>),
}

/// Scene that was read.
pub struct Opened {
    /// State with which a session of the scene begins.
    pub opening: Opening,
    /// Source of the scene for an engine.
    pub source: SceneSource,
}

#[derive(Default)]
struct Wanted {
    source: Option<SceneSource>,
    settings: Option<Settings>,
    pick: Option<Pick>,
    quit: bool,
}

/// Requests that are shared with the thread.
#[derive(Default)]
struct Post {
    wanted: Mutex<Wanted>,
    changed: Condvar,
}

impl Post {
    fn wanted(&self) -> MutexGuard<'_, Wanted> {
        self.wanted.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

/// Worker: a thread that makes pictures. Dropping it waits for the current piece of work.
pub struct Worker {
    post: Arc<Post>,
    thread: Option<JoinHandle<()>>,
}

impl Worker {
    /// Starts the thread with the settings of the engine that `make` makes in the thread, where the engine
    /// stays. The thread calls `tell`.
    ///
    /// # Errors
    /// The operating system has no more threads.
    pub fn start(
        make: impl FnOnce() -> Engine + Send + 'static,
        tell: impl Fn(Update) + Send + 'static,
    ) -> std::io::Result<Self> {
        let post = Arc::new(Post::default());
        let shared = post.clone();
        let thread = std::thread::Builder::new()
            .name("pictures".to_owned())
            .spawn(move || work(make(), &shared, &tell))?;
        Ok(Self { post, thread: Some(thread) })
    }

    /// Asks for pictures of these settings from now on.
    pub fn want(&self, settings: Settings) {
        self.post.wanted().settings = Some(settings);
        self.post.changed.notify_one();
    }

    /// Asks for pictures of another scene from now on, with these settings.
    pub fn show(&self, source: SceneSource, settings: Settings) {
        let mut wanted = self.post.wanted();
        (wanted.source, wanted.settings) = (Some(source), Some(settings));
        drop(wanted);
        self.post.changed.notify_one();
    }

    /// Asks for the hits of a pick; outstanding answers to an earlier pick no longer come.
    pub fn pick(&self, pick: Pick) {
        self.post.wanted().pick = Some(pick);
        self.post.changed.notify_one();
    }
}

impl Drop for Worker {
    fn drop(&mut self) {
        self.post.wanted().quit = true;
        self.post.changed.notify_one();
        if let Some(thread) = self.thread.take() {
            // The thread itself has reported its panic.
            _ = thread.join();
        }
    }
}

fn work(mut engine: Engine, post: &Post, tell: &dyn Fn(Update)) {
    let mut handed_on = None::<Instant>;
    let mut idle = false;
    let mut asked = None::<(Pick, VecDeque<SystemConfig>)>;
    loop {
        {
            let mut wanted = post.wanted();
            let is_news = |wanted: &Wanted| wanted.settings.is_some() || wanted.pick.is_some() || wanted.quit;
            while idle && asked.is_none() && !is_news(&wanted) {
                wanted = post.changed.wait(wanted).unwrap_or_else(PoisonError::into_inner);
            }
            if wanted.quit {
                return;
            }
            if let Some(source) = wanted.source.take() {
                engine.show(source);
                asked = None;
            }
            if let Some(settings) = wanted.settings.take() {
                engine.apply(settings);
                (idle, handed_on) = (false, None);
            }
            if let Some(pick) = wanted.pick.take() {
                let systems = pick.systems.iter().cloned().collect();
                asked = Some((pick, systems));
            }
        }
        // Systems answer one at a time: a build may take long, and newer settings are handled before the next
        // system.
        if let Some((pick, systems)) = &mut asked {
            match systems.pop_front() {
                Some(config) => tell(Update::Answered(pick.number, engine.answer(pick, &config))),
                None => asked = None,
            }
        }
        if idle {
            continue;
        }
        match engine.step(&mut |text| tell(Update::Status(text.to_owned()))) {
            Ok(Step::Working) => (),
            Ok(Step::Done) => idle = true,
            Ok(Step::Picture(picture)) => {
                let is_due = handed_on.is_none_or(|before| before.elapsed() >= PICTURE_PAUSE);
                if is_due || picture.samples >= picture.settings.frame.spp {
                    handed_on = Some(Instant::now());
                    tell(Update::Picture(picture));
                }
            }
            Err(error) => {
                tell(Update::Failed(error));
                idle = true;
            }
        }
    }
}
