//! SIGINT, SIGTERM and SIGHUP: the first asks for an early end with a valid result, a second ends at once.
//! Where nothing is finished that could be kept, the first ends as well, after [`GRACE`]: a build, a compiler
//! or a wave may take long.
//!
//! A terminal that goes away may send SIGHUP twice, itself and by its shell, and systemd sends one behind
//! SIGTERM: it is never a second signal. Where it is ignored from the start, as under nohup, it stays
//! ignored.

use crate::error::EXIT_INTERRUPTED;
use crate::terminal;
use signal_hook::consts::{SIGHUP, SIGINT, SIGTERM};
use std::path::PathBuf;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError, mpsc};
use std::time::{Duration, Instant};
use tempfile::NamedTempFile;

/// From the first signal to the end, where nothing is finished by then.
const GRACE: Duration = Duration::from_secs(1);

/// Longest wait of an end for its message to be taken. Who reads stderr may have stopped to, and whatever
/// else writes there then waits with the stream locked.
const LAST_WORDS: Duration = Duration::from_millis(200);

/// Message of the end where nothing was finished.
const NOTHING: &str = "interrupted: stopped before anything was finished; nothing was written\n";

/// Request of a signal for an early end, and the unfinished files.
#[derive(Clone, Debug, Default)]
pub struct Interrupt {
    requested: Arc<AtomicBool>,
    /// True if something is finished that an early end keeps.
    keeps: Arc<AtomicBool>,
    unfinished: Arc<Mutex<Vec<PathBuf>>>,
}

/// True if the process was started with a signal ignored.
fn is_ignored(signal: i32) -> bool {
    let mut found = std::mem::MaybeUninit::<libc::sigaction>::uninit();
    // SAFETY: without a new action `sigaction` only writes the present one to `found`, which has room for it.
    let answer = unsafe { libc::sigaction(signal, std::ptr::null(), found.as_mut_ptr()) };
    // SAFETY: it was written where the call succeeded.
    answer == 0 && unsafe { found.assume_init() }.sa_sigaction == libc::SIG_IGN
}

fn locked(files: &Mutex<Vec<PathBuf>>) -> MutexGuard<'_, Vec<PathBuf>> {
    files.lock().unwrap_or_else(PoisonError::into_inner)
}

impl Interrupt {
    /// Takes over SIGINT and SIGTERM, and SIGHUP unless it is ignored, for the rest of the process.
    ///
    /// # Errors
    /// The system refuses a handler.
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
                // This thread stays free for the second signal, if there can be another.
                let other = std::thread::Builder::new().name("stopping".to_owned());
                if other.spawn(move || stopping.stop()).is_err() {
                    watched.stop();
                }
            }
        })?;
        Ok(interrupt)
    }

    /// Ends the process after a while, unless something is finished that the work will write.
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

    /// From now on something is finished: an early end waits for it to be written.
    pub(crate) fn keep(&self) {
        self.keeps.store(true, Ordering::SeqCst);
    }

    /// True if an early end was asked for.
    pub fn requested(&self) -> bool {
        self.requested.load(Ordering::SeqCst)
    }

    /// Makes a file that is unfinished until the guard is dropped: an end at once removes it. No end comes
    /// between the file and its guard.
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

    /// Ends the process without destructors, which would wait for the device. The lock is kept to the end, so
    /// that no further file can be begun.
    fn leave(&self) -> ! {
        let files = locked(&self.unfinished);
        for path in files.iter() {
            // A file that is not there yet, or not there any more, needs no removal.
            _ = std::fs::remove_file(path);
        }
        signal_hook::low_level::exit(EXIT_INTERRUPTED.into())
    }
}

/// Says something, and goes on when it is said or after [`LAST_WORDS`].
fn say(words: impl FnOnce() + Send + 'static) {
    let (said, is_said) = mpsc::channel();
    let speaker = std::thread::Builder::new().name("last words".to_owned()).spawn(move || {
        words();
        _ = said.send(());
    });
    // Without a thread nothing is said: the end is worth more.
    if speaker.is_ok() {
        _ = is_said.recv_timeout(LAST_WORDS);
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
