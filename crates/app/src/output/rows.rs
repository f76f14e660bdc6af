//! Report with a row per frame of an animation: JSON lines, each a whole report.

use super::destination::Destination;
use crate::error::AppError;
use crate::interrupt::Interrupt;
use rasray_report::{FramesRecord, Report, SCHEMA, json_escaped};
use std::collections::BTreeMap;
use std::io::ErrorKind;
use std::path::Path;

/// Row with the report of one frame.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Row {
    /// Number of the frame.
    pub(crate) frame: u32,
    /// Key of the picture.
    pub(crate) key: String,
    /// Frames that the row's command makes; absent in reports of older programs.
    pub(crate) frames: Option<FramesRecord>,
    /// Fields that all frames of a command have in common, as far as a row holds them.
    pub(crate) common: String,
    /// Report in one line, without a line break.
    pub(crate) line: String,
}

impl Row {
    /// Makes the row of a report; `None` unless the report is of a frame and has a key.
    pub(crate) fn of(report: &Report) -> Option<Self> {
        let (pose, run) = (report.scene.pose.as_ref()?, report.runs.first()?);
        let program = (&report.version, &report.commit);
        let system = (&run.system, &run.preset, &run.integrator);
        let picture = (run.width, run.height, run.spp, run.bounces, run.seed);
        let occluder = (&run.occluder, &run.shadow_resolution, &run.shadow_points);
        let options = (&run.primary, occluder, &run.sampler, &run.back_faces, &run.integrator_options);
        let light = (&report.scene.environment, &report.scene.alpha);
        // A sequence of files may name a file for each frame, so its scene name is not compared.
        let scene = Some(&report.scene.name).filter(|_| pose.file.is_none());
        Some(Self {
            frame: pose.frame?,
            key: run.key.clone()?,
            frames: pose.frames.clone(),
            common: format!("{program:?} {scene:?} {light:?} {system:?} {picture:?} {options:?}"),
            line: report.to_json_line(),
        })
    }
}

/// Reads the rows of a file; none if there is no file.
///
/// # Errors
/// The file cannot be read, or a line of it is not the report of a frame.
pub(crate) fn read_rows(path: &Path) -> Result<Vec<Row>, AppError> {
    let text = match std::fs::read_to_string(path) {
        Ok(text) => text,
        Err(error) if error.kind() == ErrorKind::NotFound => return Ok(Vec::new()),
        Err(error) => {
            return Err(AppError::input(path, error, "see that you may read it, and that it is text"));
        }
    };
    let row = |(number, line): (usize, &str)| {
        let wrong = |message: String| {
            let help = "remove that line, or the file";
            AppError::input(path, format!("line {}: {message}", number + 1), help)
        };
        let report: Report =
            serde_json::from_str(line).map_err(|error| wrong(format!("is not a report ({error})")))?;
        let row = Row::of(&report).filter(|_| report.schema == SCHEMA);
        row.map(|row| Row { line: line.to_owned(), ..row })
            .ok_or_else(|| wrong(format!("is not a report {SCHEMA} of a frame with a key")))
    };
    text.lines().enumerate().map(row).collect()
}

/// Returns the key in a report of one picture; `None` if there is no such report.
pub(crate) fn key_of_report(path: &Path) -> Option<String> {
    let report: Report = serde_json::from_slice(&std::fs::read(path).ok()?).ok()?;
    report.runs.first()?.key.clone()
}

/// File that is written anew, as a whole, with each row.
pub(crate) struct Rows {
    place: Destination,
    rows: BTreeMap<u32, Row>,
    /// True if the file does not hold the present rows.
    is_changed: bool,
}

impl Rows {
    /// True for the name of such a file, which ends in `.jsonl`.
    pub(crate) fn are_in(path: &Path) -> bool {
        path.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("jsonl"))
    }

    /// Opens a file for the rows of an animation. `resume` keeps the existing rows.
    ///
    /// # Errors
    /// The place accepts no file, or the existing file cannot be read.
    pub(crate) fn open(path: &Path, resume: bool) -> Result<Self, AppError> {
        let place = Destination::check(path)?;
        let there = if resume { read_rows(path)? } else { Vec::new() };
        let rows = there.into_iter().map(|row| (row.frame, row)).collect();
        Ok(Self { place, rows, is_changed: false })
    }

    /// Returns the destination of the rows.
    pub(crate) fn place(&self) -> &Destination {
        &self.place
    }

    /// True if there is a row of this picture.
    pub(crate) fn has(&self, frame: u32, key: &str) -> bool {
        self.rows.get(&frame).is_some_and(|row| row.key == key)
    }

    /// Marks the existing row of a frame as one of the frames that this command makes.
    pub(crate) fn keep(&mut self, frame: u32, frames: Option<&FramesRecord>) {
        let Some(row) = self.rows.get_mut(&frame).filter(|row| row.frames.as_ref() != frames) else { return };
        let Ok(mut report) = serde_json::from_str::<Report>(&row.line) else { return };
        let Some(pose) = &mut report.scene.pose else { return };
        pose.frames = frames.cloned();
        row.frames = frames.cloned();
        row.line = report.to_json_line();
        self.is_changed = true;
    }

    /// True if [`Rows::write`] would change the file.
    pub(crate) fn is_changed(&self) -> bool {
        self.is_changed
    }

    /// Puts a row in the place of the row of its frame, if there is one, and writes the file.
    ///
    /// # Errors
    /// As for [`Destination::put`].
    pub(crate) fn put(&mut self, row: Row, interrupt: &Interrupt) -> Result<(), AppError> {
        self.rows.insert(row.frame, row);
        self.write(interrupt)
    }

    /// Writes the file.
    ///
    /// # Errors
    /// As for [`Destination::put`].
    pub(crate) fn write(&mut self, interrupt: &Interrupt) -> Result<(), AppError> {
        self.place.put(lines(self.rows.values()).as_bytes(), interrupt)?;
        self.is_changed = false;
        Ok(())
    }
}

/// Returns the text of a file with these rows.
pub(crate) fn lines<'a>(rows: impl IntoIterator<Item = &'a Row>) -> String {
    json_escaped(&rows.into_iter().flat_map(|row| [row.line.as_str(), "\n"]).collect::<String>())
}

#[cfg(test)]
mod tests {
    use super::*;
    use rasray_report::{Device, Origin, PoseRecord, Run, SceneRecord};

    fn row(frame: u32, key: &str) -> Row {
        let pose = PoseRecord { time_s: f64::from(frame), frame: Some(frame), ..PoseRecord::default() };
        let scene = SceneRecord { name: "\u{1b}[2J".to_owned(), pose: Some(pose), ..SceneRecord::default() };
        let run = Run { key: Some(key.to_owned()), ..Run::default() };
        Row::of(&Report::new(Origin::default(), Device::default(), scene, vec![run])).expect("a row")
    }

    #[test]
    fn rows_stay_in_order_and_one_takes_the_place_of_its_frame() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("a.jsonl");
        let open = |resume| Rows::open(&path, resume).expect("writable");
        let mut rows = open(true);
        for (frame, key) in [(7, "a"), (3, "b"), (10, "c"), (3, "d")] {
            rows.put(row(frame, key), &Interrupt::default()).expect("written");
        }
        let read = read_rows(&path).expect("rows");
        let found: Vec<_> = read.iter().map(|row| (row.frame, row.key.as_str())).collect();
        assert_eq!(found, [(3, "d"), (7, "a"), (10, "c")]);
        assert!(!std::fs::read_to_string(&path).expect("text").contains('\u{1b}'));
        assert!(open(true).has(7, "a") && !open(true).has(7, "b") && !open(true).has(8, "a"));
        assert!(!open(false).has(7, "a"));

        let text = std::fs::read_to_string(&path).expect("text");
        std::fs::write(&path, format!("{text}{{\"schema\":")).expect("a file");
        let error = read_rows(&path).expect_err("a line that is cut short");
        assert!(error.exit_code() == 2 && error.to_string().contains("a.jsonl: line 4: "), "{error}");
        assert!(Rows::are_in(&path) && !Rows::are_in(&folder.path().join("a.json")));
    }
}
