//! Handling of SIGINT, SIGTERM and SIGHUP: the first signal asks for an early end with a valid result, a
//! second one ends the process at once. If there is no finished part that could be kept, the first signal
//! ends the process as well, after [`GRACE`]: a build, a compiler or a wave may take long.
//!
//! A terminal that goes away may send SIGHUP twice, itself and by its shell, and systemd sends one after
//! SIGTERM: therefore SIGHUP never counts as a second signal. If SIGHUP is ignored from the start, as under
//! nohup, it stays ignored.

use crate::error::EXIT_INTERRUPTED;
use crate::terminal;
use signal_hook::consts::{SIGHUP, SIGINT, SIGTERM};
use std::path::PathBuf;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError, mpsc};
use std::time::{Duration, Instant};
use tempfile::NamedTempFile;

/// Time from the first signal to the end, if nothing is finished by then.
const GRACE: Duration = Duration::from_secs(1);

/// Longest time that the end waits for its message to be written. The reader of stderr may have stopped
/// reading, and another writer to stderr then waits with the stream locked.
const LAST_WORDS: Duration = Duration::from_millis(200);

/// Message of an end before anything was finished.
const NOTHING: &str = "interrupted: stopped before anything was finished; nothing was written\n";

/// Request of a signal for an early end, and the list of unfinished files.
#[derive(Clone, Debug, Default)]
pub struct Interrupt {
    requested: Arc<AtomicBool>,
    /// True if there is a finished part that an early end keeps.
    keeps: Arc<AtomicBool>,
    unfinished: Arc<Mutex<Vec<PathBuf>>>,
}

/// True if the process was started with a signal ignored.
fn is_ignored(signal: i32) -> bool {
    let mut found = std::mem::MaybeUninit::<libc::sigaction>::uninit();
    // SAFETY: without a new action `sigaction` only writes the present action to `found`, which has room for
    // it.
    let answer = unsafe { libc::sigaction(signal, std::ptr::null(), found.as_mut_ptr()) };
    // SAFETY: `found` was written if the call succeeded.
    answer == 0 && unsafe { found.assume_init() }.sa_sigaction == libc::SIG_IGN
}

fn locked(files: &Mutex<Vec<PathBuf>>) -> MutexGuard<'_, Vec<PathBuf>> {
    files.lock().unwrap_or_else(PoisonError::into_inner)
}

impl Interrupt {
    /// Takes over SIGINT and SIGTERM, and SIGHUP unless it is ignored, for the rest of the process.
    ///
    /// # Errors
    /// The operating system refuses a handler.
    pub fn install() -> std::io::Result<Self> {
        let interrupt = Self::default();
        let mut signals = signal_hook::iterator::Signals::new([SIGINT, SIGTERM])?;
        if !is_ignored(SIGHUP) {
            signals.add_signal(SIGHUP)?;
        }
        let watched = interrupt.clone();
        std::thread::Builder::new().name("signals".to_owned()).spawn(move || {
            for signal in signals.forever() {
                if signal == SIGHUP {
                    terminal::hang_up();
                }
                if watched.requested.swap(true, Ordering::SeqCst) {
                    if signal == SIGHUP {
                        continue;
                    }
                    watched.leave();
                }
                let stopping = watched.clone();
                // This thread stays free for the second signal, if another thread can be made.
                let other = std::thread::Builder::new().name("stopping".to_owned());
                if other.spawn(move || stopping.stop()).is_err() {
                    watched.stop();
                }
            }
        })?;
        Ok(interrupt)
    }

    /// Ends the process after [`GRACE`], unless there is a finished part that the work will write.
    fn stop(&self) {
        let deadline = Instant::now() + GRACE;
        let keeps = || self.keeps.load(Ordering::SeqCst);
        let text = if keeps() {
            "stopping as soon as what is finished can be written; a second signal stops at once, without a result"
        } else {
            "stopping; nothing is finished yet"
        };
        say(move || terminal::note(text));
        std::thread::sleep(deadline.saturating_duration_since(Instant::now()));
        if !keeps() {
            say(|| terminal::complain(NOTHING));
            self.leave();
        }
    }

    /// Notes that there is a finished part: an early end waits until it is written.
    pub(crate) fn keep(&self) {
        self.keeps.store(true, Ordering::SeqCst);
    }

    /// True if an early end was asked for.
    pub fn requested(&self) -> bool {
        self.requested.load(Ordering::SeqCst)
    }

    /// Makes a file that is unfinished until the guard is dropped: an immediate end removes it. No end occurs
    /// between the creation of the file and of its guard.
    ///
    /// # Errors
    /// The error of `make`.
    pub(crate) fn unfinished(
        &self,
        make: impl FnOnce() -> std::io::Result<NamedTempFile>,
    ) -> std::io::Result<(Unfinished<'_>, NamedTempFile)> {
        let mut files = locked(&self.unfinished);
        let file = make()?;
        let path = file.path().to_owned();
        files.push(path.clone());
        Ok((Unfinished { interrupt: self, path }, file))
    }

    /// Ends the process without destructors, which would wait for the device. The lock is held to the end, so
    /// that no further file can be begun.
    fn leave(&self) -> ! {
        let files = locked(&self.unfinished);
        for path in files.iter() {
            // A file that is not there yet, or no longer, needs no removal.
            _ = std::fs::remove_file(path);
        }
        signal_hook::low_level::exit(EXIT_INTERRUPTED.into())
    }
}

/// Writes a message, and returns when it is written or after [`LAST_WORDS`].
fn say(words: impl FnOnce() + Send + 'static) {
    let (said, is_said) = mpsc::channel();
    let speaker = std::thread::Builder::new().name("last words".to_owned()).spawn(move || {
        words();
        _ = said.send(());
    });
    // Without a thread no message is written: the end matters more.
    if speaker.is_ok() {
        _ = is_said.recv_timeout(LAST_WORDS);
    }
}

/// Guard that marks a file as unfinished.
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
