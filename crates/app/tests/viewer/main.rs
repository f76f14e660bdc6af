//! The window as a person uses it: on a display of its own, with real keys and drags. Built with the feature
//! `viewer` alone: `tests/README.md` has the command. Skipped by name without Xvfb or xdotool.

mod moving;
mod panel;
mod window;

use std::io::Read;
use std::process::{Command, Stdio};
use std::time::Duration;

use window::{Display, RASRAY, Window, made_by, pixels};

#[test]
fn a_window_follows_keys_and_drags_and_its_pictures_are_those_of_render() {
    let Some(display) =
        Display::start("a_window_follows_keys_and_drags_and_its_pictures_are_those_of_render")
    else {
        return;
    };
    let folder = tempfile::tempdir().expect("a folder");
    let line = "view cornell --size 60x40 --spp 2 --bounces 1 --validation";
    let mut window = Window::open(&display, folder.path(), line);

    let (first, first_line) = window.save();
    assert_eq!(first.file_name().and_then(|name| name.to_str()), Some("cornell.0001.png"));
    let first = pixels(&first);
    assert_eq!(made_by(folder.path(), &first_line), first, "{first_line}");

    window.drag([150, 300], [60, 20]);
    std::thread::sleep(Duration::from_secs(2));
    let (turned, turned_line) = window.save();
    let turned = pixels(&turned);
    assert!(turned != first && turned_line.contains("--eye"), "a drag turns the camera: {turned_line}");
    assert_eq!(made_by(folder.path(), &turned_line), turned, "{turned_line}");

    display.xdotool("key r");
    std::thread::sleep(Duration::from_secs(2));
    let (back, back_line) = window.save();
    assert_eq!(pixels(&back), first, "{back_line}");

    display.xdotool("keydown w");
    std::thread::sleep(Duration::from_secs(1));
    display.xdotool("keyup w");
    std::thread::sleep(Duration::from_secs(2));
    let (flown, flown_line) = window.save();
    assert!(pixels(&flown) != first && flown_line.contains("--eye"), "{flown_line}");

    display.xdotool("key ctrl+q");
    assert_eq!(window.end().code(), Some(0), "a message of the validation layers is an error");
}

#[test]
fn a_signal_closes_the_window() {
    let Some(display) = Display::start("a_signal_closes_the_window") else { return };
    let folder = tempfile::tempdir().expect("a folder");
    let mut window = Window::open(&display, folder.path(), "view cornell --size 24x16 --integrator raycast");
    let status = Command::new("kill").args(["-INT", &window.command.id().to_string()]).status();
    assert!(status.expect("kill").success());
    assert_eq!(window.end().code(), Some(130));
}

#[test]
fn without_a_display_the_error_says_what_to_do() {
    let mut command = Command::new(RASRAY)
        .args(["view", "cornell"])
        .env_remove("DISPLAY")
        .env_remove("WAYLAND_DISPLAY")
        .env_remove("WAYLAND_SOCKET")
        .stderr(Stdio::piped())
        .spawn()
        .expect("the command starts");
    let mut text = String::new();
    command.stderr.take().expect("a pipe").read_to_string(&mut text).expect("text");
    assert_eq!(command.wait().expect("an end").code(), Some(3), "{text}");
    assert!(text.contains("display") && text.contains("DISPLAY") && text.contains("rasray render"), "{text}");
}
