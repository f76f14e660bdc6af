//! Tests in a process of their own, which may crash or hang without taking others along.

use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

/// Set for the process that may crash.
const CHILD: &str = "RASRAY_FAULTS_CHILD";

/// How long that process may take.
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
    let start = Instant::now();
    while child.try_wait().expect("a child").is_none() {
        if start.elapsed() > PATIENCE {
            child.kill().expect("a child that runs");
            panic!("traces through damaged lists do not end");
        }
        std::thread::sleep(Duration::from_millis(20));
    }
    let output = child.wait_with_output().expect("its output");
    let text = String::from_utf8_lossy(&output.stdout);
    assert!(output.status.success() && text.contains("1 passed"), "{:?}: {text}", output.status);
    print!("{text}");
    false
}
