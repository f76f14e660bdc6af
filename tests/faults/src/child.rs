//! Tests in a process of their own, which may crash or hang without taking others along.

use std::io::{BufRead, BufReader};
use std::process::{Command, Stdio};
use std::sync::mpsc::{RecvTimeoutError, channel};
use std::time::Duration;

/// Set for the process that may crash.
const CHILD: &str = "RASRAY_FAULTS_CHILD";

/// Longest silence of that process: a driver compiles a kernel within it, on a machine that has other work.
const PATIENCE: Duration = Duration::from_secs(240);

/// Runs the test of this name again in a process of its own; true in that process.
///
/// # Panics
/// The other process fails, or does not end.
pub fn in_child(test: &str) -> bool {
    if std::env::var_os(CHILD).is_some() {
        return true;
    }
    let mut child = Command::new(std::env::current_exe().expect("the path of this test"))
        .args(["--exact", test, "--nocapture"])
        .env(CHILD, "1")
        .stdout(Stdio::piped())
        .spawn()
        .expect("this test can be run again");
    let words = BufReader::new(child.stdout.take().expect("its output is piped"));
    let (said, heard) = channel();
    let reader = std::thread::spawn(move || {
        // Ends where the child does, or where nobody listens any more.
        words.lines().map_while(Result::ok).try_for_each(|line| said.send(line))
    });
    let mut text = String::new();
    loop {
        match heard.recv_timeout(PATIENCE) {
            Ok(line) => text = text + &line + "\n",
            Err(RecvTimeoutError::Disconnected) => break,
            Err(RecvTimeoutError::Timeout) => {
                child.kill().expect("a child that runs");
                panic!("nothing was said for {PATIENCE:?}: traces through damaged lists do not end\n{text}");
            }
        }
    }
    let status = child.wait().expect("a child");
    reader.join().expect("reading does not panic").expect("the channel was open");
    assert!(status.success() && text.contains("1 passed"), "{status:?}: {text}");
    print!("{text}");
    false
}
