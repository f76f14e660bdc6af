//! Files that cannot be written, are cut short, or whose writer is killed: never a wrong file under the right
//! name.
#![cfg(target_os = "linux")]

use crate::scripted::{command, entries, stderr};
use rasray_app::Interrupt;
use rasray_app::output::{Destination, Metadata, encode_exr, encode_png};
use rasray_experiment::{Aov, AovImage, RenderOutput};
use std::path::Path;
use std::process::Command;
use std::time::Duration;

/// Set for the process that writes one file again and again: the file.
const WRITE: &str = "RASRAY_TEST_WRITE";

/// Set beside it for a writer that does not take care.
const IN_PLACE: &str = "RASRAY_TEST_WRITE_IN_PLACE";

/// Bytes of the file that is written again and again.
const LENGTH: usize = 24 << 20;

#[test]
fn places_that_take_no_file_end_with_2_before_anything_is_rendered() {
    let folder = tempfile::tempdir().expect("a folder");
    std::fs::create_dir(folder.path().join("folder.png")).expect("a folder");
    // The kernel's own file system takes no files, whoever asks.
    for place in
        ["folder.png", "/proc/a.png", "/proc/self/a.exr", "missing/a.png", "folder.png/../missing/a.png"]
    {
        let output = command(folder.path(), &format!("render cornell --size 8x8 -o {place}"))
            .output()
            .expect("the command starts");
        let text = stderr(&output);
        assert_eq!(output.status.code(), Some(2), "{place}: {text}");
        assert!(text.contains(place) && text.contains("help: "), "{text}");
        assert_eq!(entries(folder.path()), ["folder.png"]);
    }
}

/// Writes the same file, of one content and of another, until it is killed: as the command does, or in place.
#[test]
fn as_writer() {
    let Some(path) = std::env::var_os(WRITE) else { return };
    let path = Path::new(&path);
    let in_place = std::env::var_os(IN_PLACE).is_some();
    for fill in [b'a', b'b'].into_iter().cycle() {
        let bytes = vec![fill; LENGTH];
        if in_place {
            std::fs::write(path, &bytes).expect("written");
        } else {
            let destination = Destination::check(path).expect("writable");
            destination.write(&bytes, &Interrupt::default()).expect("written");
        }
    }
}

/// Files that killed writers left under the name of their file, and beside it.
#[derive(Debug, Default)]
struct Remains {
    /// Files that are not whole, or of two contents.
    torn: usize,
    /// Further files after a kill.
    extra: usize,
    /// Further files after the next check of the place.
    kept: usize,
}

/// Kills writers at different times, until `enough`.
fn kill_writers(in_place: bool, enough: impl Fn(&Remains) -> bool) -> Remains {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("a.exr");
    std::fs::write(&path, vec![b'o'; LENGTH]).expect("an old file");
    let mut remains = Remains::default();
    for round in 0..60_u64 {
        let mut writer = Command::new(std::env::current_exe().expect("this program"));
        writer
            .args(["faults_output::as_writer", "--exact", "--nocapture", "--test-threads=1"])
            .env(WRITE, &path);
        if in_place {
            writer.env(IN_PLACE, "1");
        }
        let mut child = writer.stdout(std::process::Stdio::null()).spawn().expect("the writer starts");
        std::thread::sleep(Duration::from_millis(30 + 11 * round));
        child.kill().expect("a child that runs");
        child.wait().expect("its end");
        let bytes = std::fs::read(&path).expect("the file is there at any time");
        let is_whole = bytes.len() == LENGTH && bytes.iter().all(|byte| *byte == bytes[0]);
        remains.torn += usize::from(!is_whole);
        remains.extra += entries(folder.path()).len() - 1;
        Destination::check(&path).expect("writable");
        remains.kept += entries(folder.path()).len() - 1;
        if enough(&remains) {
            return remains;
        }
    }
    panic!("60 writers were killed, hardly one while it wrote: {remains:?}");
}

/// SIGKILL cannot be handled: what counts is that a whole file, old or new, is all that its name ever shows,
/// and that what was left beside it goes with the next run.
#[test]
fn a_writer_that_is_killed_leaves_the_old_file_or_the_new_one() {
    let remains = kill_writers(false, |remains| remains.extra >= 3 || remains.torn > 0);
    assert_eq!((remains.torn, remains.kept), (0, 0), "{remains:?}");
    // A writer that writes in place is found out.
    let remains = kill_writers(true, |remains| remains.torn > 0);
    assert!(remains.torn > 0);
}

fn output() -> RenderOutput {
    let pixels = 32 * 24;
    RenderOutput {
        width: 32,
        height: 24,
        beauty: (0..pixels).map(|i| [i as f32 / 700.0, 0.5, 1.0 - i as f32 / 900.0]).collect(),
        aovs: [(Aov::Depth, AovImage::of((0..pixels).map(|i| [i as f32])))].into(),
        ..Default::default()
    }
}

/// Lengths to which a file of `length` bytes is cut: all short ones, the last ones, and many between.
fn cuts(length: usize) -> impl Iterator<Item = usize> {
    (0..length).filter(move |cut| *cut < 64 || cut % 23 == 0 || cut + 16 > length)
}

#[test]
fn images_that_were_cut_short_are_refused() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("cut.exr");
    let read = |bytes: &[u8]| {
        std::fs::write(&path, bytes).expect("a file");
        exr::prelude::read_all_flat_layers_from_file(&path)
    };
    let whole = encode_exr(&output(), &Metadata::default()).expect("a small image");
    assert!(read(&whole).is_ok());
    for cut in cuts(whole.len()) {
        assert!(read(&whole[..cut]).is_err(), "{cut} of {} bytes of an EXR are read", whole.len());
    }
    let whole = encode_png(&output(), 0.0.into(), &Metadata::default()).expect("a small image");
    let expected = image::load_from_memory(&whole).expect("a valid file").to_rgb8();
    for cut in cuts(whole.len()) {
        // Only the mark of the end may be missing: then every pixel is there.
        if let Ok(image) = image::load_from_memory(&whole[..cut]) {
            assert_eq!(image.to_rgb8(), expected, "{cut} of {} bytes of a PNG are read", whole.len());
            assert!(cut + 16 > whole.len(), "{cut} of {} bytes of a PNG are read", whole.len());
        }
    }
}
