//! An engine in a thread of its own: the newest settings win, and whoever shows pictures never waits.

use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};
use std::thread::JoinHandle;
use std::time::{Duration, Instant};

use crate::engine::{Engine, Step};
use crate::picture::Picture;
use crate::settings::Settings;

/// Least time between two pictures of the same settings that are handed on.
const PICTURE_PAUSE: Duration = Duration::from_millis(30);

/// What a worker says.
pub enum Update {
    /// What takes long, in a few words.
    Status(String),
    /// A picture.
    Picture(Box<Picture>),
    /// The settings failed. The picture before stays the last complete one.
    Failed {
        /// What is wrong.
        message: String,
        /// What to do; may be empty.
        help: String,
    },
}

#[derive(Default)]
struct Wanted {
    settings: Option<Settings>,
    quit: bool,
}

/// Shared with the thread.
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

/// A thread that makes pictures. Dropping it waits for the piece of work that is under way.
pub struct Worker {
    post: Arc<Post>,
    thread: Option<JoinHandle<()>>,
}

impl Worker {
    /// Starts it with the settings of the engine that `make` makes in the thread, where it stays; `tell` is called from
    /// there.
    ///
    /// # Errors
    /// The system has no more threads.
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
}

impl Drop for Worker {
    fn drop(&mut self) {
        self.post.wanted().quit = true;
        self.post.changed.notify_one();
        if let Some(thread) = self.thread.take() {
            // A panic of the thread has been reported by the thread.
            _ = thread.join();
        }
    }
}

fn work(mut engine: Engine, post: &Post, tell: &dyn Fn(Update)) {
    let mut handed_on = None::<Instant>;
    let mut idle = false;
    loop {
        {
            let mut wanted = post.wanted();
            while idle && wanted.settings.is_none() && !wanted.quit {
                wanted = post.changed.wait(wanted).unwrap_or_else(PoisonError::into_inner);
            }
            if wanted.quit {
                return;
            }
            if let Some(settings) = wanted.settings.take() {
                engine.apply(settings);
                (idle, handed_on) = (false, None);
            }
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
                tell(Update::Failed { message: error.to_string(), help: error.help().to_owned() });
                idle = true;
            }
        }
    }
}
