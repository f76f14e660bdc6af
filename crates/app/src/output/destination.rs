//! Destination of a file, which is either whole or absent: it is written next to its place, synchronised,
//! then renamed.

use crate::error::AppError;
use crate::interrupt::Interrupt;
use crate::terminal;
use std::ffi::OsString;
use std::fs::{File, OpenOptions};
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use tempfile::NamedTempFile;

/// Suffix of the names of unfinished files. No other program uses it, since remaining files of this suffix
/// are removed.
const UNFINISHED: &str = ".rasray-tmp";

/// Number of random letters and digits in these names.
const RANDOM: usize = 6;

/// Destination of a file. It is checked when it is made, before any work is done for the file.
#[derive(Clone, Debug)]
pub struct Destination {
    /// Path as the user wrote it, for messages.
    named: PathBuf,
    /// Path with links followed.
    path: PathBuf,
    kind: Kind,
}

/// Kind of a destination, which decides how bytes get there.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Kind {
    /// File, written next to its place and renamed.
    File,
    /// Device or pipe, written directly, because nothing can be renamed over it.
    Special,
    /// Standard output.
    Stdout,
}

/// Name that stands for standard output; a file of that name is `./-`.
const STDOUT: &str = "-";

/// Largest number of links that are followed, one after another.
const LINKS: usize = 40;

impl Destination {
    /// Checks that a file can be put at `path`: the folder exists and accepts new files, and no folder is in
    /// the way. A link is followed, so that it stays a link, even if it leads to no file yet. `-` is standard
    /// output.
    ///
    /// # Errors
    /// The message names the path, the obstacle and the remedy.
    pub fn check(path: &Path) -> Result<Self, AppError> {
        if path == Path::new(STDOUT) {
            return Ok(Self { named: path.to_owned(), path: path.to_owned(), kind: Kind::Stdout });
        }
        if let Ok(metadata) = std::fs::metadata(path) {
            if metadata.is_dir() {
                return Err(AppError::input(path, "is a folder", "name a file in it"));
            }
            if !metadata.is_file() {
                return Ok(Self { named: path.to_owned(), path: path.to_owned(), kind: Kind::Special });
            }
        }
        let destination = Self { named: path.to_owned(), path: followed(path), kind: Kind::File };
        if destination.path.is_symlink() {
            return Err(AppError::input(path, "is a link that leads in a circle", "name a file"));
        }
        let folder = destination.folder();
        if destination.path.file_name().is_none() {
            return Err(AppError::input(
                path,
                "is not the name of a file",
                "name a file in an existing folder",
            ));
        }
        if !folder.is_dir() {
            return Err(AppError::input(
                path,
                format!("the folder {} does not exist", folder.display()),
                format!("create it first: mkdir -p '{}'", folder.display()),
            ));
        }
        destination.sweep();
        // Only making a file tells whether a file can be made: permissions, read-only file systems and name
        // lengths all show here, before hours of rendering.
        match destination.begin() {
            Ok(_) => Ok(destination),
            Err(error) => Err(AppError::input(
                path,
                format!("no file can be made in {}: {error}", folder.display()),
                "choose a folder that you may write to",
            )),
        }
    }

    /// True if two destinations lead to the same file, or both to standard output.
    pub fn same_as(&self, other: &Self) -> bool {
        match (self.is_stdout(), other.is_stdout()) {
            (false, false) => absolute(&self.path) == absolute(&other.path),
            (one, two) => one && two,
        }
    }

    /// True if the file will be put where `path` leads.
    pub fn is(&self, path: &Path) -> bool {
        !self.is_stdout() && absolute(&self.path) == absolute(path)
    }

    /// True for standard output, which then carries nothing else.
    pub fn is_stdout(&self) -> bool {
        self.kind == Kind::Stdout
    }

    /// Returns the path as the user wrote it.
    pub fn named(&self) -> &Path {
        &self.named
    }

    /// Puts a file with these bytes in place, and reports it on stderr unless quiet was asked for.
    ///
    /// # Errors
    /// As for [`Self::put`].
    pub fn write(&self, bytes: &[u8], interrupt: &Interrupt) -> Result<(), AppError> {
        self.put(bytes, interrupt)?;
        if !self.is_stdout() {
            terminal::note(&format!("wrote {}", self.named.display()));
        }
        Ok(())
    }

    /// Puts a file with these bytes in place. After any failure, a file that was there before is unchanged
    /// and nothing else is left behind; an immediate end through `interrupt` leaves nothing either.
    ///
    /// # Errors
    /// [`AppError::Refused`], as the bytes exist and could not be kept.
    pub fn put(&self, bytes: &[u8], interrupt: &Interrupt) -> Result<(), AppError> {
        let result = match self.kind {
            Kind::File => self.replace(bytes, interrupt),
            Kind::Special => self.write_directly(bytes),
            Kind::Stdout => terminal::write_out(bytes),
        };
        result.map_err(|error| {
            AppError::refused(
                format!("{}: {} bytes could not be written: {error}", self.named.display(), bytes.len()),
                "free space or choose another place with --output, then run again; no partial file was left",
            )
        })
    }

    fn write_directly(&self, bytes: &[u8]) -> io::Result<()> {
        let mut file = OpenOptions::new().write(true).open(&self.path)?;
        file.write_all(bytes)?;
        file.flush()
    }

    fn replace(&self, bytes: &[u8], interrupt: &Interrupt) -> io::Result<()> {
        let (_unfinished, mut file) = interrupt.unfinished(|| self.begin())?;
        // The lock tells other runs that this file is being written; on a file system without locks, no run
        // removes remains.
        _ = file.as_file().try_lock();
        if let Ok(existing) = std::fs::metadata(&self.path) {
            file.as_file().set_permissions(existing.permissions())?;
        }
        // The bytes are written through the file itself, because errors of the pair name a temporary path.
        file.as_file_mut().write_all(bytes)?;
        file.as_file().sync_all()?;
        file.persist(&self.path)?;
        // The rename is durable only after the folder is synchronised, which not every file system supports.
        if let Ok(folder) = File::open(self.folder()) {
            _ = folder.sync_all();
        }
        Ok(())
    }

    /// Makes a file in the same folder under a name of its own, with the permissions of any new file; the
    /// file is removed when it is dropped.
    fn begin(&self) -> io::Result<NamedTempFile> {
        tempfile::Builder::new()
            .prefix(&self.unfinished_prefix())
            .suffix(UNFINISHED)
            .rand_bytes(RANDOM)
            .make_in(self.folder(), |path| File::create_new(path))
    }

    fn folder(&self) -> &Path {
        match self.path.parent() {
            Some(folder) if !folder.as_os_str().is_empty() => folder,
            _ => Path::new("."),
        }
    }

    fn unfinished_prefix(&self) -> OsString {
        let mut name = OsString::from(".");
        name.push(self.path.file_name().unwrap_or_default());
        name.push(".");
        name
    }

    /// Removes the remains of runs that were killed while they wrote this very file. A file that another run
    /// still writes is locked and stays.
    fn sweep(&self) {
        let prefix = self.unfinished_prefix();
        let Ok(entries) = std::fs::read_dir(self.folder()) else { return };
        for entry in entries.flatten() {
            let name = entry.file_name();
            let middle = name
                .as_encoded_bytes()
                .strip_prefix(prefix.as_encoded_bytes())
                .and_then(|rest| rest.strip_suffix(UNFINISHED.as_bytes()));
            if !middle.is_some_and(|word| word.len() == RANDOM && word.iter().all(u8::is_ascii_alphanumeric))
            {
                continue;
            }
            let Ok(file) = OpenOptions::new().write(true).open(entry.path()) else { continue };
            if file.try_lock().is_ok() {
                // If two runs remove the file, the second finds nothing.
                _ = std::fs::remove_file(entry.path());
            }
        }
    }
}

/// Returns the target of a name: the end of its links, whether or not the file exists yet.
fn followed(path: &Path) -> PathBuf {
    let mut path = path.to_owned();
    for _ in 0..LINKS {
        let Ok(target) = std::fs::read_link(&path) else { break };
        // The target of a link is relative to the link's own folder.
        path = path.parent().map_or_else(|| target.clone(), |folder| folder.join(&target));
    }
    std::fs::canonicalize(&path).unwrap_or(path)
}

/// Returns a path without links or `..`, whether or not the file exists yet.
fn absolute(path: &Path) -> PathBuf {
    let folder = match path.parent() {
        Some(folder) if !folder.as_os_str().is_empty() => folder,
        _ => Path::new("."),
    };
    let whole = std::fs::canonicalize(path);
    let next_to = || Some(std::fs::canonicalize(folder).ok()?.join(path.file_name()?));
    whole.ok().or_else(next_to).unwrap_or_else(|| path.to_owned())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn entries(folder: &Path) -> Vec<String> {
        let mut names: Vec<_> = std::fs::read_dir(folder)
            .expect("the folder")
            .map(|entry| entry.expect("an entry").file_name().to_string_lossy().into_owned())
            .collect();
        names.sort();
        names
    }

    #[test]
    fn a_file_is_replaced_whole_and_nothing_else_is_left() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("a.png");
        std::fs::write(&path, b"old and longer").expect("a file");
        let destination = Destination::check(&path).expect("writable");
        assert_eq!(entries(folder.path()), ["a.png"]);
        destination.write(b"new", &Interrupt::default()).expect("written");
        assert_eq!(std::fs::read(&path).expect("the file"), b"new");
        assert_eq!(entries(folder.path()), ["a.png"]);
    }

    #[cfg(unix)]
    #[test]
    fn a_link_stays_a_link_and_permissions_stay() {
        use std::os::unix::fs::PermissionsExt;
        let folder = tempfile::tempdir().expect("a folder");
        let (file, link) = (folder.path().join("a.png"), folder.path().join("b.png"));
        std::fs::write(&file, b"old").expect("a file");
        std::fs::set_permissions(&file, std::fs::Permissions::from_mode(0o640)).expect("permissions");
        std::os::unix::fs::symlink("a.png", &link).expect("a link");
        let destination = Destination::check(&link).expect("writable");
        destination.write(b"new", &Interrupt::default()).expect("written");
        assert!(std::fs::symlink_metadata(&link).expect("the link").is_symlink());
        assert_eq!(std::fs::read(&file).expect("the file"), b"new");
        assert_eq!(std::fs::metadata(&file).expect("the file").permissions().mode() & 0o777, 0o640);
        assert!(destination.same_as(&Destination::check(&file).expect("writable")));
    }

    #[cfg(unix)]
    #[test]
    fn a_new_file_has_the_permissions_of_any_new_file() {
        use std::os::unix::fs::PermissionsExt;
        let folder = tempfile::tempdir().expect("a folder");
        let (plain, written) = (folder.path().join("plain"), folder.path().join("a.png"));
        std::fs::write(&plain, b"new").expect("a file");
        let destination = Destination::check(&written).expect("writable");
        destination.write(b"new", &Interrupt::default()).expect("written");
        let mode = |path: &Path| std::fs::metadata(path).expect("the file").permissions().mode();
        assert_eq!(mode(&written), mode(&plain));
    }

    #[cfg(unix)]
    #[test]
    fn a_link_to_a_file_that_is_not_there_yet_makes_it_and_stays_a_link() {
        let folder = tempfile::tempdir().expect("a folder");
        std::fs::create_dir(folder.path().join("far")).expect("a folder");
        let links = [("far/a.png", "b.png"), ("b.png", "c.png")];
        for (target, link) in links {
            std::os::unix::fs::symlink(target, folder.path().join(link)).expect("a link");
        }
        let destination = Destination::check(&folder.path().join("c.png")).expect("writable");
        assert_eq!(entries(folder.path()), ["b.png", "c.png", "far"]);
        assert!(destination.is(&folder.path().join("far/a.png")));
        destination.write(b"new", &Interrupt::default()).expect("written");
        assert_eq!(std::fs::read(folder.path().join("far/a.png")).expect("the file"), b"new");
        assert_eq!(entries(&folder.path().join("far")), ["a.png"]);
        for (_, link) in links {
            assert!(std::fs::symlink_metadata(folder.path().join(link)).expect("the link").is_symlink());
        }
        let (circle, lost) = (folder.path().join("circle"), folder.path().join("lost"));
        std::os::unix::fs::symlink("circle", &circle).expect("a link");
        std::os::unix::fs::symlink("missing/a.png", &lost).expect("a link");
        assert_eq!(Destination::check(&lost).expect_err("no such folder").exit_code(), 2);
        assert_eq!(Destination::check(&circle).expect_err("a circle").exit_code(), 2);
        assert_eq!(entries(folder.path()).len(), 5);
    }

    #[test]
    fn a_dash_is_standard_output_and_no_file() {
        let (out, again) = (Destination::check(Path::new("-")), Destination::check(Path::new("-")));
        let (out, again) = (out.expect("stdout"), again.expect("stdout"));
        assert!(out.is_stdout() && out.same_as(&again) && !out.is(Path::new("-")));
        let file = Destination::check(Path::new("./-")).expect("a file");
        assert!(!file.is_stdout() && !file.same_as(&out) && !out.same_as(&file));
    }

    #[test]
    fn places_that_cannot_be_are_refused_at_once() {
        let folder = tempfile::tempdir().expect("a folder");
        for bad in [folder.path().to_owned(), folder.path().join("missing/a.png"), PathBuf::from("/")] {
            assert_eq!(Destination::check(&bad).expect_err("no place").exit_code(), 2, "{}", bad.display());
        }
        let long = folder.path().join(format!("{}.png", "x".repeat(300)));
        assert_eq!(Destination::check(&long).expect_err("too long").exit_code(), 2);
        assert!(entries(folder.path()).is_empty());
    }

    #[test]
    fn what_a_killed_run_left_is_swept_and_nothing_else() {
        let folder = tempfile::tempdir().expect("a folder");
        let kept = [
            ".a.png..rasray-tmp",
            ".a.png.Ab3xY-.rasray-tmp",
            ".a.png.Ab3xY.rasray-tmp",
            ".a.png.Ab3xYz.tmp",
            ".a.png.rasray-tmp",
            ".b.png.Ab3xYz.rasray-tmp",
            "a.png.Ab3xYz.rasray-tmp",
        ];
        for name in kept.into_iter().chain([".a.png.Ab3xYz.rasray-tmp", ".a.png.123456.rasray-tmp"]) {
            std::fs::write(folder.path().join(name), b"part").expect("a file");
        }
        let busy = File::create(folder.path().join(".a.png.000000.rasray-tmp")).expect("a file");
        busy.try_lock().expect("a lock");
        let destination = Destination::check(&folder.path().join("a.png")).expect("writable");
        let mut expected: Vec<_> = kept.into_iter().chain([".a.png.000000.rasray-tmp"]).collect();
        expected.sort_unstable();
        assert_eq!(entries(folder.path()), expected);
        destination.write(b"new", &Interrupt::default()).expect("written");
        drop(busy);
        Destination::check(&folder.path().join("a.png")).expect("writable");
        assert!(!entries(folder.path()).contains(&".a.png.000000.rasray-tmp".to_owned()));
    }

    #[cfg(target_os = "linux")]
    #[test]
    fn a_full_device_is_lost_data() {
        let destination = Destination::check(Path::new("/dev/full")).expect("a device takes bytes");
        let error = destination.write(b"bytes", &Interrupt::default()).expect_err("no space");
        assert_eq!(error.exit_code(), 4);
        assert!(error.to_string().contains("/dev/full"), "{error}");
    }
}
