//! The command as a user starts it: what it takes, writes, says and survives.

mod adaptive;
mod campaign;
mod cells;
mod compare;
mod far;
mod faults_driver;
mod faults_output;
mod hard;
mod html_browser;
mod moments;
mod motion;
mod occluder;
mod output;
mod photons;
mod published;
mod replay;
mod results;
mod scripted;
mod shares;
mod signals;
mod usage;

/// Becomes the command where a test starts this program as one.
#[test]
fn as_command() {
    scripted::become_the_command();
}
