//! Text of a campaign as Markdown, and the columns of its tables.

use crate::campaign::{Campaign, Experiment, Row};
use crate::{bytes, grouped, in_line};

/// Column of the tables of campaigns: a result and the form in which it is shown.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Column {
    /// Name of the result in [`Row::results`].
    pub name: &'static str,
    /// Heading of the column.
    pub head: &'static str,
    /// Meaning of the result, one line.
    pub meaning: &'static str,
    form: Form,
}

/// Form in which a number is written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Form {
    /// Number with three significant digits.
    Number,
    /// Whole number.
    Count,
    Bytes,
    /// Power of ten.
    Tiny,
    /// Share in per cent.
    Percent,
}

const fn column(name: &'static str, head: &'static str, form: Form, meaning: &'static str) -> Column {
    Column { name, head, meaning, form }
}

/// All columns in their order. A column without a value in any row of an experiment is left out.
pub const COLUMNS: [Column; 23] = [
    column("build_ms", "build ms", Form::Number, "Posed positions to traceable, median"),
    column("trace_ms", "trace ms", Form::Number, "Rays in to hits out, median"),
    column("mrays_per_s", "Mrays/s", Form::Number, "Millions of rays per second"),
    column("image_ms", "image ms", Form::Number, "All passes of the image on the device"),
    column("stages.surfaces.ms", "surfaces ms", Form::Number, "Of that the stage from hits to surfaces"),
    column(
        "stages.shade.ms",
        "shade ms",
        Form::Number,
        "Of that the stage from surfaces to radiance and further rays",
    ),
    column("memory.structure_bytes", "bytes", Form::Bytes, "The structure's allocations"),
    column("counters.fragments", "fragments", Form::Count, "Fragments stored"),
    column("counters.entries", "entries", Form::Count, "List entries stored"),
    column(
        "counters.lists.all.layers_mean",
        "layers",
        Form::Number,
        "Mean over the cells that hold something",
    ),
    column("counters.lists.all.layers_most", "most layers", Form::Count, "Of the cell that has most"),
    column("counters.lists.all.waste_bytes", "unfilled", Form::Bytes, "Bytes of slots that no entry fills"),
    column("counters.cells_per_ray", "cells/ray", Form::Number, "Cells stepped per ray"),
    column("counters.nodes_per_ray", "entries/ray", Form::Number, "List entries or tree nodes read per ray"),
    column("counters.tests_per_ray", "tests/ray", Form::Number, "Primitive tests per ray"),
    column("error_share", "wrong hits", Form::Percent, "Missed, false or wrong, of rays that can be decided"),
    column("accuracy.missed", "missed", Form::Count, "Hits that were not found"),
    column("accuracy.dt_rel_p99", "dt/t p99", Form::Tiny, "99th percentile of |dt|/t over common hits"),
    column("image.flip_mean", "FLIP", Form::Number, "Mean over the pixels of LDR-FLIP"),
    column("image.flip_visible", "visible", Form::Percent, "Pixels whose FLIP is above 0.1"),
    column("image.relmse", "relMSE", Form::Tiny, "Mean of (R - r)^2 / (r^2 + 0.01)"),
    column("image.bias", "bias", Form::Tiny, "Mean of R - r, linear"),
    column("image.psnr", "PSNR dB", Form::Number, "Of displayed values"),
];

impl Column {
    /// Returns the number of a row as text; empty if the row has none.
    pub fn of(&self, row: &Row) -> String {
        let Some(value) = row.results.get(self.name).copied() else { return String::new() };
        match self.form {
            Form::Number => number(value),
            Form::Count => grouped(value as u64),
            Form::Bytes => bytes(value as u64),
            Form::Tiny if value == 0.0 => "0".to_owned(),
            Form::Tiny => format!("{value:.1e}"),
            Form::Percent => format!("{} %", number(100.0 * value)),
        }
    }
}

/// Writes a number with three significant digits, without an exponent where possible.
pub fn number(value: f64) -> String {
    match value.abs() {
        0.0 => "0".to_owned(),
        size if size >= 100.0 => format!("{value:.0}"),
        size if size >= 10.0 => format!("{value:.1}"),
        size if size >= 1.0 => format!("{value:.2}"),
        size if size >= 0.1 => format!("{value:.3}"),
        size if size >= 0.01 => format!("{value:.4}"),
        size if size >= 0.001 => format!("{value:.5}"),
        _ => format!("{value:.2e}"),
    }
}

impl Experiment {
    /// Returns the columns for which at least one row has a value.
    pub fn columns(&self) -> Vec<Column> {
        let has = |column: &Column| self.rows.iter().any(|row| row.results.contains_key(column.name));
        COLUMNS.into_iter().filter(has).collect()
    }

    /// Returns the settings that all rows share as text; empty without rows.
    pub fn common(&self) -> String {
        let Some(first) = self.rows.first() else { return String::new() };
        let varied = self.varied();
        let common = self.settings().into_iter().filter(|name| !varied.contains(name));
        common.map(|name| format!("{name} {}", first.setting(name))).collect::<Vec<_>>().join(", ")
    }
}

/// Writes the campaign as Markdown: for each experiment the settings that its rows have in common, and a
/// table of the settings in which they differ and of their results.
pub fn campaign_markdown(campaign: &Campaign) -> String {
    let device = &campaign.device;
    let software = if device.software { ", a software driver: times are for ratios" } else { "" };
    let mut text = format!(
        "# {}\n\nrasray {}. Device: {}{software}.\n",
        in_line(&campaign.title),
        in_line(&campaign.program),
        in_line(&device.full_name())
    );
    for experiment in &campaign.experiments {
        text += &format!("\n## {}\n\n{}\n", in_line(&experiment.name), experiment_markdown(experiment));
    }
    text
}

/// Writes the sets of rays of an experiment, then its images: for each the settings that the rows have in
/// common, and their table.
fn experiment_markdown(experiment: &Experiment) -> String {
    experiment.parts().iter().map(part_markdown).collect::<Vec<_>>().join("\n")
}

fn part_markdown(experiment: &Experiment) -> String {
    let rows = rows_markdown(experiment, &experiment.varied(), &experiment.columns());
    format!("{}\n\n{rows}", in_line(&experiment.common()))
}

/// Writes one table row per run with these settings and these columns of results. A unit that all numbers of
/// a column have is written in the heading.
pub fn rows_markdown(experiment: &Experiment, settings: &[&str], columns: &[Column]) -> String {
    let mut heads: Vec<_> = settings.iter().map(|&name| name.to_owned()).collect();
    let rules = settings.iter().map(|_| "---").chain(columns.iter().map(|_| "---:"));
    let settings = |row: &Row| settings.iter().map(|name| row.setting(name).to_owned()).collect::<Vec<_>>();
    let mut rows: Vec<_> = experiment.rows.iter().map(settings).collect();
    for column in columns {
        let cells: Vec<_> = experiment.rows.iter().map(|row| column.of(row)).collect();
        let unit = common_unit(&cells).map(|unit| format!(" {unit}"));
        heads.push(
            unit.as_ref().map_or_else(|| column.head.to_owned(), |unit| format!("{},{unit}", column.head)),
        );
        for (row, cell) in rows.iter_mut().zip(&cells) {
            let number = unit.as_ref().and_then(|unit| cell.strip_suffix(unit.as_str()));
            row.push(number.unwrap_or(cell).to_owned());
        }
    }
    line(heads) + &line(rules.map(str::to_owned)) + &rows.into_iter().map(line).collect::<String>()
}

/// Returns the unit that follows every number of a column; `None` if the numbers differ in it.
fn common_unit(cells: &[String]) -> Option<&str> {
    let mut units = cells.iter().filter(|cell| !cell.is_empty()).map(|cell| cell.split_once(' '));
    let (_, first) = units.next()??;
    units.all(|unit| unit.is_some_and(|(_, unit)| unit == first)).then_some(first)
}

fn line(cells: impl IntoIterator<Item = String>) -> String {
    let cells: Vec<_> = cells.into_iter().map(|cell| in_line(&cell).replace('|', "\\|")).collect();
    format!("| {} |\n", cells.join(" | "))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::campaign::tests::{cell, line as cell_line};

    #[test]
    fn numbers_have_three_digits_that_count() {
        let numbers = [(0.0, "0"), (1234.5, "1234"), (-12.345, "-12.3"), (1.0, "1.00"), (0.5, "0.500")];
        let small = [(0.012_34, "0.0123"), (0.001_234, "0.00123"), (0.000_123_4, "1.23e-4")];
        for (value, text) in numbers.into_iter().chain(small) {
            assert_eq!(number(value), text);
        }
    }

    #[test]
    fn a_unit_stands_in_the_head_where_all_numbers_have_it() {
        let of = |cells: &[&str]| {
            common_unit(&cells.iter().map(|&cell| cell.to_owned()).collect::<Vec<_>>()).map(str::to_owned)
        };
        assert_eq!(of(&["1.50 MiB", "", "2.00 MiB"]).as_deref(), Some("MiB"));
        assert_eq!(
            (of(&["1.50 MiB", "2.00 KiB"]), of(&["1.50 MiB", "2"]), of(&["", ""])),
            (None, None, None)
        );
    }

    #[test]
    fn tables_show_what_rows_differ_in_and_say_the_rest_once() {
        let lines = [
            cell_line(0, &[(0, "Samples")], cell("mmrt", Some("50"), false)),
            cell_line(1, &[(0, "Samples")], cell("mmrt", Some("100"), false)),
            cell_line(2, &[(1, "a | b")], cell("bvh", None, true)),
        ];
        let text = campaign_markdown(&Campaign::of(&lines).expect("of a campaign"));
        let table: Vec<_> = text.lines().filter(|line| line.starts_with('|')).collect();
        assert_eq!(table[0], "| samples | trace ms | bytes, B | fragments | wrong hits, % | missed |");
        assert_eq!(table[2], "| 50 | 2.50 | 64 | 9 | 10.0 | 4 |");
        assert!(
            text.contains("scene cornell, size 4x3") && text.contains("system mmrt, preset robust"),
            "{text}"
        );
        assert!(
            text.starts_with("# All\n") && text.contains("## Samples\n") && text.contains("## a | b\n"),
            "{text}"
        );
    }
}
