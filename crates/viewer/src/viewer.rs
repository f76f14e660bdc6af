//! Viewer without the drawing of its window: a session with the threads that carry it out.

use std::ffi::OsStr;
use std::sync::{Arc, mpsc};

use crate::engine::Engine;
use crate::session::{Failure, Session};
use crate::worker::{Opened, Update, Worker};

/// Function that reads the scene of a name, which may take long; it is called in a thread of its own.
pub type OpenScene = dyn Fn(&OsStr) -> Result<Opened, Failure> + Send + Sync;

/// Session, the worker that makes its pictures, and the function that reads its scenes.
pub struct Viewer {
    /// Choices of the user.
    pub session: Session,
    worker: Worker,
    updates: mpsc::Receiver<Update>,
    tell: Arc<dyn Fn(Update) + Send + Sync>,
    open: Arc<OpenScene>,
}

impl Viewer {
    /// Begins a session with the engine that `engine` makes in the worker's thread. Other threads call `wake`
    /// when there are updates to take ([`Viewer::take_updates`]).
    ///
    /// # Errors
    /// The operating system has no more threads.
    pub fn start(
        session: Session,
        engine: impl FnOnce() -> Engine + Send + 'static,
        open: Arc<OpenScene>,
        wake: impl Fn() + Send + Sync + 'static,
    ) -> std::io::Result<Self> {
        let (sender, updates) = mpsc::channel();
        let tell: Arc<dyn Fn(Update) + Send + Sync> = Arc::new(move |update| {
            // If the receiver is gone, nobody wants more pictures.
            _ = sender.send(update);
            wake();
        });
        let told = tell.clone();
        let worker = Worker::start(engine, move |update| told(update))?;
        Ok(Self { session, worker, updates, tell, open })
    }

    /// Takes the updates that arrived, at `now` (seconds).
    pub fn take_updates(&mut self, now: f64) {
        while let Ok(update) = self.updates.try_recv() {
            if let Some((source, settings)) = self.session.take(update, now) {
                self.worker.show(source, settings);
            }
        }
    }

    /// Asks for everything that was chosen, at `now` (seconds): pictures, answers to a pick, another scene.
    ///
    /// # Errors
    /// The operating system has no more threads.
    pub fn ask(&mut self, now: f64) -> std::io::Result<()> {
        if let Some(settings) = self.session.changed_settings(now) {
            self.worker.want(settings);
        }
        if let Some(pick) = self.session.asked_pick() {
            self.worker.pick(pick);
        }
        if let Some((number, scene)) = self.session.asked_scene() {
            let (tell, open) = (self.tell.clone(), self.open.clone());
            // The thread ends by itself; the result of a request that is no longer the newest is dropped.
            std::thread::Builder::new()
                .name("reading".to_owned())
                .spawn(move || tell(Update::Read(number, open(&scene).map(Box::new))))?;
        }
        Ok(())
    }
}
