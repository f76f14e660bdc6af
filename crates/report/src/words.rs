//! Words for numbers, and aligned columns, as people read them.

use crate::in_line;
use std::fmt::Write;

/// Writes milliseconds in the unit that people use. A sum of no terms is -0 in Rust, and is written as 0
/// here.
pub fn duration(milliseconds: f64) -> String {
    let milliseconds = milliseconds + 0.0;
    if milliseconds < 1000.0 {
        format!("{milliseconds:.1} ms")
    } else {
        format!("{:.2} s", milliseconds / 1000.0)
    }
}

/// Aligns columns: the first `left` to the left, the others to the right.
pub fn columns(rows: &[Vec<String>], left: usize) -> String {
    let rows: Vec<Vec<_>> = rows.iter().map(|row| row.iter().map(|cell| in_line(cell)).collect()).collect();
    let count = rows.iter().map(Vec::len).max().unwrap_or(0);
    let mut widths = vec![0; count];
    for (column, cell) in rows.iter().flat_map(|row| row.iter().enumerate()) {
        widths[column] = widths[column].max(cell.chars().count());
    }
    let mut text = String::new();
    for row in &rows {
        let mut line = String::new();
        for (column, (cell, width)) in row.iter().zip(&widths).enumerate() {
            _ = if column < left {
                write!(line, "  {cell:<width$}")
            } else {
                write!(line, "  {cell:>width$}")
            };
        }
        text += line.trim_end();
        text.push('\n');
    }
    text
}

/// Aligns like [`columns`] in lines of at most `width` characters where possible. Columns that do not fit
/// beside the first `left` follow below, in further blocks that repeat the first `left` columns.
pub fn columns_within(rows: &[Vec<String>], left: usize, width: usize) -> String {
    let count = rows.iter().map(Vec::len).max().unwrap_or(0);
    let widest = |column: usize| {
        let cells = rows.iter().filter_map(|row| row.get(column));
        2 + cells.map(|cell| in_line(cell).chars().count()).max().unwrap_or(0)
    };
    let names: usize = (0..left.min(count)).map(widest).sum();
    let mut blocks: Vec<Vec<usize>> = Vec::new();
    let mut taken = 0;
    for column in left..count {
        let own = widest(column);
        match blocks.last_mut() {
            Some(block) if names + taken + own <= width => {
                block.push(column);
                taken += own;
            }
            _ => {
                blocks.push(vec![column]);
                taken = own;
            }
        }
    }
    if blocks.len() <= 1 {
        return columns(rows, left);
    }
    let block = |block: &Vec<usize>| {
        let cells = |row: &Vec<String>| {
            let places = (0..left).chain(block.iter().copied());
            places.filter_map(|column| row.get(column).cloned()).collect::<Vec<_>>()
        };
        columns(&rows.iter().map(cells).collect::<Vec<_>>(), left)
    };
    blocks.iter().map(block).collect::<Vec<_>>().join("\n")
}

/// Breaks text into lines of at most `width` characters where its words allow it: longer lines are broken at
/// spaces and continue `indent` spaces from the left.
pub fn wrapped(text: &str, width: usize, indent: usize) -> String {
    let mut lines = String::new();
    for line in text.lines() {
        let mut rest: Vec<char> = line.chars().collect();
        let mut start = 0;
        while rest.len() > width {
            // No break is made within the indentation, where it would leave an empty line.
            let first = start.max(rest.iter().position(|one| *one != ' ').unwrap_or(0));
            let is_space = |place: &usize| rest[*place] == ' ';
            let before = (first + 1..=width).rev().find(is_space);
            let Some(place) = before.or_else(|| (width.max(first) + 1..rest.len()).find(is_space)) else {
                break;
            };
            let broken: String = rest[..place].iter().collect();
            lines += broken.trim_end();
            lines.push('\n');
            let next =
                rest[place..].iter().position(|one| *one != ' ').map_or(rest.len(), |skip| place + skip);
            rest = std::iter::repeat_n(' ', indent).chain(rest[next..].iter().copied()).collect();
            start = indent;
        }
        lines.extend(rest);
        lines.push('\n');
    }
    lines
}

/// Writes bytes with a binary unit, exact below 1 KiB.
pub fn bytes(value: u64) -> String {
    const UNITS: [&str; 4] = ["KiB", "MiB", "GiB", "TiB"];
    let mut scaled = value as f64;
    let mut unit = "B";
    for next in UNITS {
        if scaled < 1024.0 {
            break;
        }
        scaled /= 1024.0;
        unit = next;
    }
    if unit == "B" { format!("{value} B") } else { format!("{scaled:.2} {unit}") }
}

/// Writes a whole number with its thousands separated.
pub fn grouped(value: u64) -> String {
    let digits = value.to_string();
    let mut text = String::new();
    for (position, digit) in digits.chars().enumerate() {
        if position > 0 && (digits.len() - position).is_multiple_of(3) {
            text.push(',');
        }
        text.push(digit);
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_time_has_no_sign() {
        let none: f64 = [0.0; 0].iter().sum();
        assert_eq!([none, 0.04, 12.34, 1234.0].map(duration), ["0.0 ms", "0.0 ms", "12.3 ms", "1.23 s"]);
    }

    #[test]
    fn columns_that_do_not_fit_come_below_with_the_names() {
        let row = |cells: [&str; 4]| cells.map(str::to_owned).to_vec();
        let rows = [row(["run", "ms", "missed", "FLIP"]), row(["mmrt robust", "12.5", "1,024", "0.25"])];
        for width in [18, 24, 27, 80] {
            let text = columns_within(&rows, 1, width);
            // The least width holds the name and the widest of the other columns.
            assert!(text.lines().all(|line| line.chars().count() <= width.max(21)), "{width}: {text}");
            for word in ["12.5", "1,024", "0.25", "missed"] {
                assert_eq!(text.matches(word).count(), 1, "{width}: {text}");
            }
            let blocks = text.matches("mmrt robust").count();
            assert_eq!(
                blocks,
                [(18, 3), (24, 3), (27, 2), (80, 1)].iter().find(|one| one.0 == width).map_or(0, |one| one.1),
                "{text}"
            );
        }
        assert_eq!(columns_within(&rows, 1, 80), columns(&rows, 1));
        assert_eq!(columns_within(&[], 1, 80), "");
    }

    #[test]
    fn long_lines_go_on_indented_and_lose_no_word() {
        assert_eq!(wrapped("  a bb ccc dddd\nshort\n", 8, 4), "  a bb\n    ccc\n    dddd\nshort\n");
        assert_eq!(
            wrapped("a_word_that_is_longer than others", 8, 2),
            "a_word_that_is_longer\n  than\n  others\n"
        );
        assert_eq!(wrapped("a_word_that_is_longer", 8, 2), "a_word_that_is_longer\n");
        assert_eq!(wrapped("", 8, 2), "");
        let text = "device llvmpipe (LLVM 15.0.6, 128 bits); times of software devices are for ratios";
        for width in 1..100 {
            let lines = wrapped(text, width, 7);
            assert_eq!(lines.split_whitespace().collect::<Vec<_>>(), text.split(' ').collect::<Vec<_>>());
            assert!(
                width < 20 || lines.lines().all(|line| line.chars().count() <= width),
                "{width}: {lines}"
            );
        }
    }

    #[test]
    fn numbers_for_people() {
        assert_eq!(grouped(0), "0");
        assert_eq!(grouped(1_234_567), "1,234,567");
        assert_eq!(bytes(1023), "1023 B");
        assert_eq!(bytes(3 << 20), "3.00 MiB");
    }
}
