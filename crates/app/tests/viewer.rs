//! The window as a person uses it: on a display of its own, with real keys and drags. Built with the feature `viewer` alone:
//! `tests/README.md` has the command. Skipped by name without Xvfb or xdotool.

use std::io::{BufRead, BufReader, Read};
use std::path::{Path, PathBuf};
use std::process::{Child, Command, ExitStatus, Stdio};
use std::sync::mpsc::{Receiver, channel};
use std::time::{Duration, Instant};

/// Longest wait for anything: software drivers compile each kernel for seconds.
const PATIENCE: Duration = Duration::from_secs(300);

const RASRAY: &str = env!("CARGO_BIN_EXE_rasray");

/// Whether a program is on the path.
fn is_there(program: &str) -> bool {
    let path = std::env::var_os("PATH").unwrap_or_default();
    std::env::split_paths(&path).any(|folder| folder.join(program).is_file())
}

/// An X server without a screen.
struct Display {
    server: Child,
    name: String,
}

impl Display {
    fn start() -> Self {
        let mut server = Command::new("Xvfb")
            .args(["-displayfd", "1", "-screen", "0", "1000x700x24", "-nolisten", "tcp"])
            .stdout(Stdio::piped())
            .stderr(Stdio::null())
            .spawn()
            .expect("Xvfb starts");
        let mut number = String::new();
        BufReader::new(server.stdout.take().expect("a pipe")).read_line(&mut number).expect("a display");
        Self { server, name: format!(":{}", number.trim()) }
    }

    /// Runs xdotool with these words and returns what it printed.
    fn xdotool(&self, words: &str) -> String {
        let output = Command::new("xdotool")
            .args(words.split(' '))
            .env("DISPLAY", &self.name)
            .output()
            .expect("xdotool starts");
        assert!(output.status.success(), "{words}: {}", String::from_utf8_lossy(&output.stderr));
        String::from_utf8_lossy(&output.stdout).trim().to_owned()
    }
}

impl Drop for Display {
    fn drop(&mut self) {
        // It may have ended by itself.
        _ = self.server.kill();
        _ = self.server.wait();
    }
}

/// The window of a scene.
struct Window<'a> {
    display: &'a Display,
    command: Child,
    lines: Receiver<String>,
    folder: PathBuf,
}

impl<'a> Window<'a> {
    fn open(display: &'a Display, folder: &Path, line: &str) -> Self {
        let mut command = Command::new(RASRAY)
            .args(line.split(' '))
            .env("DISPLAY", &display.name)
            .env_remove("WAYLAND_DISPLAY")
            .current_dir(folder)
            .stderr(Stdio::piped())
            .spawn()
            .expect("the command starts");
        let (sender, lines) = channel();
        let stderr = command.stderr.take().expect("a pipe");
        std::thread::spawn(move || {
            for line in BufReader::new(stderr).lines().map_while(Result::ok) {
                eprintln!("{line}");
                _ = sender.send(line);
            }
        });
        let window = Self { display, command, lines, folder: folder.to_owned() };
        let id = display.xdotool("search --sync --onlyvisible --name rasray");
        // Nobody manages windows here, so nobody gives them the keys.
        display.xdotool(&format!("windowfocus --sync {}", id.lines().next().expect("a window")));
        window
    }

    /// Saves the picture when its refinement has ended: its place, and the command line that makes it.
    fn save(&self) -> (PathBuf, String) {
        let began = Instant::now();
        loop {
            assert!(began.elapsed() < PATIENCE, "no whole picture");
            self.display.xdotool("key p");
            let Ok(line) = self.lines.recv_timeout(Duration::from_secs(3)) else { continue };
            let Some(place) = line.strip_prefix("wrote ") else { continue };
            let made_by = self.lines.recv_timeout(PATIENCE).expect("how it is made");
            if let Some(command) = made_by.strip_prefix("it is made by: ") {
                return (self.folder.join(place), command.to_owned());
            }
            std::thread::sleep(Duration::from_millis(500));
        }
    }

    fn end(&mut self) -> ExitStatus {
        let began = Instant::now();
        loop {
            match self.command.try_wait().expect("a process") {
                Some(status) => return status,
                None if began.elapsed() > PATIENCE => panic!("it does not end"),
                None => std::thread::sleep(Duration::from_millis(50)),
            }
        }
    }
}

impl Drop for Window<'_> {
    fn drop(&mut self) {
        // It has ended unless the test has failed.
        _ = self.command.kill();
        _ = self.command.wait();
    }
}

/// The pixels of a picture: the file of a render has a key as well.
fn pixels(path: &Path) -> Vec<u8> {
    let read = || -> Result<Vec<u8>, Box<dyn std::error::Error>> {
        let file = std::io::Cursor::new(std::fs::read(path)?);
        let mut reader = png::Decoder::new(file).read_info()?;
        let mut pixels = vec![0; reader.output_buffer_size().ok_or("a size")?];
        reader.next_frame(&mut pixels)?;
        Ok(pixels)
    };
    read().unwrap_or_else(|error| panic!("{}: {error}", path.display()))
}

/// The pixels of the picture that a command line makes, in another file.
fn made_by(folder: &Path, line: &str) -> Vec<u8> {
    let line = line.strip_prefix("rasray ").expect("a command line");
    let script = format!("exec \"$0\" {line} --output again.png --quiet");
    // Of an option that is given twice there is an error, so the one that was printed goes.
    let (before, _) = line.rsplit_once(" --output ").expect("a place");
    let script = script.replace(line, before);
    let status =
        Command::new("sh").args(["-c", &script, RASRAY]).current_dir(folder).status().expect("a shell");
    assert!(status.success(), "{line}");
    pixels(&folder.join("again.png"))
}

#[test]
fn a_window_follows_keys_and_drags_and_its_pictures_are_those_of_render() {
    if !is_there("Xvfb") || !is_there("xdotool") {
        eprintln!(
            "skipped: a_window_follows_keys_and_drags_and_its_pictures_are_those_of_render needs Xvfb and xdotool"
        );
        return;
    }
    let folder = tempfile::tempdir().expect("a folder");
    let display = Display::start();
    let line = "view cornell --size 60x40 --spp 2 --bounces 1 --validation";
    let mut window = Window::open(&display, folder.path(), line);

    let (first, first_line) = window.save();
    assert_eq!(first.file_name().and_then(|name| name.to_str()), Some("cornell.0001.png"));
    let first = pixels(&first);
    assert_eq!(made_by(folder.path(), &first_line), first, "{first_line}");

    // As fast as a hand: what happens within one frame of a debug build is a click.
    display.xdotool("mousemove 150 300 sleep 0.5 mousedown 1");
    for _ in 0..5 {
        display.xdotool("sleep 0.3 mousemove_relative 12 4");
    }
    display.xdotool("sleep 0.3 mouseup 1");
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
    if !is_there("Xvfb") || !is_there("xdotool") {
        eprintln!("skipped: a_signal_closes_the_window needs Xvfb and xdotool");
        return;
    }
    let folder = tempfile::tempdir().expect("a folder");
    let display = Display::start();
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
