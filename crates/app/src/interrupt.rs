//! SIGINT and SIGTERM: the first asks for an early end with a valid result, the second ends at once.

use crate::error::EXIT_INTERRUPTED;
use crate::terminal;
use signal_hook::consts::{SIGINT, SIGTERM};
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

/// Whether a signal asked for an early end, and which files are unfinished.
#[derive(Clone, Debug, Default)]
pub struct Interrupt {
    requested: Arc<AtomicBool>,
    unfinished: Arc<Mutex<Vec<PathBuf>>>,
}

fn locked(files: &Mutex<Vec<PathBuf>>) -> MutexGuard<'_, Vec<PathBuf>> {
    files.lock().unwrap_or_else(PoisonError::into_inner)
}

impl Interrupt {
    /// Takes over SIGINT and SIGTERM for the rest of the process.
    ///
    /// # Errors
    /// The system refuses a handler.
    pub fn install() -> std::io::Result<Self> {
        let interrupt = Self::default();
        let mut signals = signal_hook::iterator::Signals::new([SIGINT, SIGTERM])?;
        let watched = interrupt.clone();
        std::thread::Builder::new().name("signals".to_owned()).spawn(move || {
            for _ in signals.forever() {
                if watched.requested.swap(true, Ordering::SeqCst) {
                    watched.leave();
                }
                terminal::complain(
                    "stopping after the current wave; a second signal stops at once, without a result\n",
                );
            }
        })?;
        Ok(interrupt)
    }

    /// Whether an early end was asked for.
    pub fn requested(&self) -> bool {
        self.requested.load(Ordering::SeqCst)
    }

    /// Marks a file as unfinished until the guard is dropped: an end at once removes it.
    pub(crate) fn unfinished(&self, path: &Path) -> Unfinished<'_> {
        locked(&self.unfinished).push(path.to_owned());
        Unfinished { interrupt: self, path: path.to_owned() }
    }

    /// Ends the process. The lock is kept to the end, so that no further file can be begun.
    fn leave(&self) -> ! {
        let files = locked(&self.unfinished);
        for path in files.iter() {
            // A file that is not there yet, or not there any more, needs no removal.
            _ = std::fs::remove_file(path);
        }
        std::process::exit(EXIT_INTERRUPTED.into())
    }
}

/// Keeps a file marked as unfinished.
#[derive(Debug)]
pub(crate) struct Unfinished<'a> {
    interrupt: &'a Interrupt,
    path: PathBuf,
}

impl Drop for Unfinished<'_> {
    fn drop(&mut self) {
        locked(&self.interrupt.unfinished).retain(|path| *path != self.path);
    }
}
