//! Cells of a comparison: the existing ones, those that are made, and the report of all.

use super::destination::Destination;
use crate::error::AppError;
use crate::interrupt::Interrupt;
use crate::terminal;
use rasray_experiment::{CellList, Shard, check_run};
use rasray_report::{
    CameraRecord, CellRecord, Device, Origin, Report, Run, SCHEMA, SceneRecord, json_escaped,
};
use std::collections::{BTreeMap, BTreeSet};
use std::fs::{File, OpenOptions, TryLockError};
use std::io::{ErrorKind, Write};
use std::path::Path;

/// Advice for lines that do not go together.
const SAME: &str = "name another file, or leave --resume out to make all cells anew";

/// Lines of a file, each the report of one cell.
#[derive(Debug)]
pub(crate) struct CellLines {
    /// Reports of the cells, each with the record of its cell.
    pub(crate) lines: Vec<(CellRecord, Report)>,
    /// True if the last line was cut short, and is left out.
    is_torn: bool,
}

/// Reads the cells of a file; none if there is no file. A last line that was cut short by a kill is left out,
/// with a warning.
///
/// # Errors
/// The file cannot be read, or another line of it is not the report of a cell.
pub(crate) fn read_cells(path: &Path) -> Result<CellLines, AppError> {
    let unreadable =
        |message: String| AppError::input(path, message, "see that you may read it, and that it is text");
    let mut bytes = match std::fs::read(path) {
        Ok(bytes) => bytes,
        Err(error) if error.kind() == ErrorKind::NotFound => Vec::new(),
        Err(error) => return Err(unreadable(error.to_string())),
    };
    let whole = bytes.iter().rposition(|byte| *byte == b'\n').map_or(0, |end| end + 1);
    let is_torn = whole < bytes.len();
    if is_torn {
        terminal::warn(&format!(
            "{}: the last line was cut short and is left out (torn-line)",
            path.display()
        ));
    }
    bytes.truncate(whole);
    let text = String::from_utf8(bytes).map_err(|error| unreadable(error.to_string()))?;
    let cell = |(number, line): (usize, &str)| {
        let wrong = |message: String| {
            AppError::input(path, format!("line {}: {message}", number + 1), "remove that line, or the file")
        };
        let report: Report =
            serde_json::from_str(line).map_err(|error| wrong(format!("is not a report ({error})")))?;
        let is_cell = report.schema == SCHEMA && report.runs.len() == 1;
        let record = report.cell.clone().filter(|_| is_cell);
        record
            .map(|record| (record, report))
            .ok_or_else(|| wrong(format!("is not a report {SCHEMA} of a cell")))
    };
    let lines = text.lines().enumerate().map(cell).collect::<Result<_, _>>()?;
    Ok(CellLines { lines, is_torn })
}

/// Describes the difference between the subjects of two lines; `None` if both are of one comparison.
pub(crate) fn difference(line: &Report, other: &Report) -> Option<String> {
    let device = |report: &Report| format!("{} ({})", report.device.full_name(), report.device.driver);
    let list = |report: &Report| report.cell.as_ref().map(|cell| (cell.list.clone(), cell.cells));
    if line.program() != other.program() {
        return Some(format!("was made by rasray {}, and not by rasray {}", line.program(), other.program()));
    }
    if line.device != other.device {
        return Some(format!("was measured on {}, and not on {}", device(line), device(other)));
    }
    (list(line) != list(other)).then(|| {
        let command = line.command.as_deref().unwrap_or("unknown");
        format!("is of another comparison, made by: {command}")
    })
}

/// Assembles the report of the runs of these lines, in the order of their places; `None` without lines. Their
/// common fields are taken from the first line.
pub(crate) fn assembled<'a>(lines: impl IntoIterator<Item = &'a Report>) -> Option<Report> {
    let mut lines = lines.into_iter().peekable();
    let first = (*lines.peek()?).clone();
    // The triangles of hard cases add up.
    let mut scenes = BTreeMap::new();
    let mut runs = Vec::new();
    for line in lines {
        let scene = line.cell.as_ref().map(|cell| cell.depends_on.scene.as_str());
        scenes.insert(scene, line.scene.triangles);
        runs.extend(line.runs.iter().cloned());
    }
    let Report { version, commit, command, device, mut scene, camera, .. } = first;
    scene.triangles = scenes.values().sum();
    let report = Report::new(Origin { version, commit, command }, device, scene, runs);
    Some(Report { camera, ..report })
}

/// File that gets a line for each cell.
struct CellFile {
    place: Destination,
    /// Open file, once this command has taken it.
    file: Option<File>,
}

/// Cells of a comparison: the existing ones, and those that are added.
pub(crate) struct Cells {
    list: CellList,
    origin: Origin,
    device: Device,
    made: BTreeMap<usize, Report>,
    file: Option<CellFile>,
}

impl Cells {
    /// Opens the cells of `list`, as this program (`origin`) makes them on a device. A file gets a line for
    /// each; `resume` keeps the existing lines.
    ///
    /// # Errors
    /// The file cannot be read, another command writes it, or a line of it is of another program, device or
    /// comparison.
    pub(crate) fn open(
        list: CellList,
        (origin, device): (Origin, Device),
        place: Option<&Destination>,
        (resume, interrupt): (bool, &Interrupt),
    ) -> Result<Self, AppError> {
        let file = place.map(|place| CellFile { place: place.clone(), file: None });
        let mut cells = Self { list, origin, device, made: BTreeMap::new(), file };
        if let Some(place) = place.filter(|_| resume) {
            cells.resume(place, interrupt)?;
        }
        Ok(cells)
    }

    fn resume(&mut self, place: &Destination, interrupt: &Interrupt) -> Result<(), AppError> {
        let CellLines { lines, is_torn } = read_cells(place.named())?;
        let nothing =
            Report::new(self.origin.clone(), self.device.clone(), SceneRecord::default(), Vec::new());
        let own = Report { cell: self.list.record(0).cloned(), ..nothing };
        for (number, (record, line)) in lines.into_iter().enumerate() {
            let expected = self.list.record(record.place as usize);
            let wrong = difference(&line, &own).or_else(|| {
                let is_whole = expected.is_some_and(|expected| expected.key == record.key);
                (!is_whole).then(|| "is of a cell that its comparison does not have".to_owned())
            });
            if let Some(wrong) = wrong {
                return Err(AppError::input(place.named(), format!("line {}: {wrong}", number + 1), SAME));
            }
            self.made.entry(record.place as usize).or_insert(line);
        }
        if is_torn {
            let text: String = self.lines().map(text_of).collect();
            place.put(text.as_bytes(), interrupt)?;
        }
        // From now on the file belongs to this command.
        self.file.as_mut().map_or(Ok(()), |file| file.take().map(|_| ()))
    }

    /// Returns the lines of the existing cells, in their order.
    pub(crate) fn lines(&self) -> impl Iterator<Item = &Report> {
        self.made.values()
    }

    /// Returns the cells of the comparison.
    pub(crate) fn list(&self) -> &CellList {
        &self.list
    }

    /// Returns the number of existing cells.
    pub(crate) fn count(&self) -> usize {
        self.made.len()
    }

    /// Returns the places of the missing cells, of every group or of the groups that belong to a share of the
    /// work.
    ///
    /// # Errors
    /// The share has no group.
    pub(crate) fn missing(&self, shard: Option<Shard>) -> Result<BTreeSet<usize>, AppError> {
        let share = shard.unwrap_or_default();
        let mut groups = self
            .list
            .groups()
            .iter()
            .enumerate()
            .filter(|(number, _)| share.holds(*number as u32))
            .peekable();
        if let (Some(shard), None) = (shard, groups.peek()) {
            let count = self.list.groups().len();
            return Err(AppError::usage(
                format!("--shard {shard} has none of {count} sets of rays, hard cases and images"),
                "make no more shares than there are",
            ));
        }
        let missing = |place: &usize| !self.made.contains_key(place);
        Ok(groups.flat_map(|(_, places)| places.clone()).filter(missing).collect())
    }

    /// Adds the run of a cell, with its line in the file; an incomplete run gets no line, so that it is made
    /// again.
    ///
    /// # Errors
    /// The file accepts no line, or another command writes it.
    pub(crate) fn add(
        &mut self,
        place: usize,
        run: Run,
        (scene, camera): (SceneRecord, Option<CameraRecord>),
        interrupt: &Interrupt,
    ) -> Result<(), AppError> {
        let is_whole = check_run(&run).is_ok();
        let report = Report::new(self.origin.clone(), self.device.clone(), scene, vec![run]);
        let line = Report { camera, cell: self.list.record(place).cloned(), ..report };
        if let Some(file) = self.file.as_mut().filter(|_| is_whole) {
            file.add(&text_of(&line), interrupt)?;
        }
        self.made.insert(place, line);
        Ok(())
    }

    /// Returns the report of all existing cells, with the command line of this process; `None` without cells.
    pub(crate) fn report(&self) -> Option<Report> {
        let report = assembled(self.made.values())?;
        Some(Report { command: self.origin.command.clone(), ..report })
    }

    /// Returns the place in [`Self::report`] of the run of the cell at a place.
    pub(crate) fn run(&self, place: usize) -> usize {
        self.made.range(..place).count()
    }

    /// Notes how many cells the file holds.
    pub(crate) fn note(&self) {
        if let Some(file) = &self.file {
            let (made, all) = (self.made.len(), self.list.len());
            terminal::note(&format!("{} holds {made} of {all} cells", file.place.named().display()));
        }
    }
}

/// Returns a line of the file.
pub(crate) fn text_of(line: &Report) -> String {
    json_escaped(&format!("{}\n", line.to_json_line()))
}

impl CellFile {
    /// Opens the file for lines after its last.
    fn take(&mut self) -> Result<&mut File, AppError> {
        let path = self.place.named();
        let failed = |message: String| AppError::refused(format!("{}: {message}", path.display()), FREE);
        let file = OpenOptions::new()
            .append(true)
            .create(true)
            .open(path)
            .map_err(|error| failed(error.to_string()))?;
        match file.try_lock() {
            Err(TryLockError::WouldBlock) => {
                let help = "wait until it has ended, or name another file: each share has one of its own";
                Err(AppError::input(path, "is being written by another command", help))
            }
            // Not every file system has locks.
            Ok(()) | Err(TryLockError::Error(_)) => Ok(self.file.insert(file)),
        }
    }

    /// Appends a line at once. The first line of a command that does not resume replaces the whole file.
    fn add(&mut self, line: &str, interrupt: &Interrupt) -> Result<(), AppError> {
        let Some(file) = &mut self.file else {
            self.place.put(line.as_bytes(), interrupt)?;
            return self.take().map(|_| ());
        };
        file.write_all(line.as_bytes()).and_then(|()| file.sync_data()).map_err(|error| {
            let path = self.place.named().display();
            AppError::refused(format!("{path}: a line could not be added: {error}"), FREE)
        })
    }
}

/// Advice for a file that accepts no line.
const FREE: &str = "free space or see that you may write to it, then run again with --resume";
