//! A window on a display of its own, and what is done to it.

use std::io::{BufRead, BufReader};
use std::path::{Path, PathBuf};
use std::process::{Child, Command, ExitStatus, Stdio};
use std::sync::mpsc::{Receiver, channel};
use std::time::{Duration, Instant};

/// Longest wait for anything: software drivers compile each kernel for seconds.
pub const PATIENCE: Duration = Duration::from_secs(300);

/// The command.
pub const RASRAY: &str = env!("CARGO_BIN_EXE_rasray");

/// True if a program is on the path.
fn is_there(program: &str) -> bool {
    let path = std::env::var_os("PATH").unwrap_or_default();
    std::env::split_paths(&path).any(|folder| folder.join(program).is_file())
}

/// An X server without a screen.
pub struct Display {
    server: Child,
    name: String,
}

impl Display {
    /// Absent, and the test of this name said to be skipped, without the programs that it takes.
    pub fn start(test: &str) -> Option<Self> {
        if !is_there("Xvfb") || !is_there("xdotool") {
            eprintln!("skipped: {test} needs Xvfb and xdotool");
            return None;
        }
        let mut server = Command::new("Xvfb")
            .args(["-displayfd", "1", "-screen", "0", "1000x700x24", "-nolisten", "tcp"])
            .stdout(Stdio::piped())
            .stderr(Stdio::null())
            .spawn()
            .expect("Xvfb starts");
        let mut number = String::new();
        BufReader::new(server.stdout.take().expect("a pipe")).read_line(&mut number).expect("a display");
        Some(Self { server, name: format!(":{}", number.trim()) })
    }

    /// Runs xdotool with these words and returns what it printed.
    pub fn xdotool(&self, words: &str) -> String {
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
pub struct Window<'a> {
    display: &'a Display,
    pub command: Child,
    lines: Receiver<String>,
    folder: PathBuf,
}

impl<'a> Window<'a> {
    pub fn open(display: &'a Display, folder: &Path, line: &str) -> Self {
        let mut command = Command::new(RASRAY)
            .args(line.split(' '))
            .env("DISPLAY", &display.name)
            // A point is a pixel, so that places in the panel are known.
            .env("WINIT_X11_SCALE_FACTOR", "1")
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
    pub fn save(&self) -> (PathBuf, String) {
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

    /// Saves the first picture whose command line is the wanted one: until then those before are shown.
    pub fn save_when(&self, is_wanted: impl Fn(&str) -> bool) -> (PathBuf, String) {
        let began = Instant::now();
        loop {
            let (place, line) = self.save();
            if is_wanted(&line) {
                return (place, line);
            }
            assert!(began.elapsed() < PATIENCE, "{line}");
            std::thread::sleep(Duration::from_millis(500));
        }
    }

    /// Saves a map, of which there is no command line: its place, and what was said of its scale, which has a
    /// word.
    pub fn save_map(&self, word: &str) -> (PathBuf, String) {
        let began = Instant::now();
        loop {
            assert!(began.elapsed() < PATIENCE, "no map: {word}");
            self.display.xdotool("key p");
            let Ok(line) = self.lines.recv_timeout(Duration::from_secs(3)) else { continue };
            let Some(place) = line.strip_prefix("wrote ") else { continue };
            let scale = self.lines.recv_timeout(PATIENCE).expect("its scale");
            if scale.contains("(bright)") && scale.contains(word) {
                return (self.folder.join(place), scale);
            }
            std::thread::sleep(Duration::from_millis(500));
        }
    }

    /// Presses the left button where the pointer is sent to.
    pub fn click(&self, [x, y]: [i32; 2]) {
        self.display
            .xdotool(&format!("mousemove {x} {y} sleep 0.4 mousedown 1 sleep 0.2 mouseup 1 sleep 0.4"));
    }

    /// Drags with the left button, as fast as a hand.
    pub fn drag(&self, [x, y]: [i32; 2], by: [i32; 2]) {
        self.display.xdotool(&format!("mousemove {x} {y} sleep 0.5 mousedown 1"));
        for _ in 0..5 {
            self.display.xdotool(&format!("sleep 0.3 mousemove_relative -- {} {}", by[0] / 5, by[1] / 5));
        }
        self.display.xdotool("sleep 0.3 mouseup 1");
        std::thread::sleep(Duration::from_secs(1));
    }

    pub fn end(&mut self) -> ExitStatus {
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
pub fn pixels(path: &Path) -> Vec<u8> {
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
pub fn made_by(folder: &Path, line: &str) -> Vec<u8> {
    let line = line.strip_prefix("rasray ").expect("a command line");
    let script = format!("exec \"$0\" {line} --output again.png --quiet");
    // An option that is given twice is an error, so the one that was printed goes.
    let (before, _) = line.rsplit_once(" --output ").expect("a place");
    let script = script.replace(line, before);
    let status =
        Command::new("sh").args(["-c", &script, RASRAY]).current_dir(folder).status().expect("a shell");
    assert!(status.success(), "{line}");
    pixels(&folder.join("again.png"))
}
