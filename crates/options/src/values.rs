//! Values that an option takes, and conversion of text to them.

use crate::Value;
use crate::text::{number, numbers, sides};

/// Word that an option takes, and its meaning.
pub type Word = (&'static str, &'static str);

/// Unit of a number.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Unit {
    /// Length, in metres.
    Metres,
    /// Share of a whole, at most 1.
    Share,
}

/// Lower end of the numbers that an option takes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Least {
    /// Numbers from 0 on.
    Zero,
    /// Numbers above 0, without 0 itself.
    AboveZero,
}

/// Values that an option takes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Values {
    /// One of these words, each with its meaning.
    Words(&'static [Word]),
    /// Whole number from the first to the second, both included.
    Whole(u32, u32),
    /// Finite number of a unit, from its lower end on.
    Number(Unit, Least),
    /// Columns and rows, such as `720x480`, or one number for both; each from 1 to this number.
    Cells(u32),
    /// Point, such as `0,1.5,-2`: three finite numbers, in metres.
    Point,
}

/// Error for text that is none of the values that are taken.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[error("{}", .0.expected())]
pub struct NotTaken(
    /// Values that are taken.
    pub Values,
);

impl Values {
    /// Values of a switch: `on` and `off`.
    pub const SWITCH: Self = Self::Words(&[("on", "Yes"), ("off", "No")]);

    /// Reads a value from text.
    ///
    /// # Errors
    /// The text is none of these values; the error says which values are taken.
    pub fn parse(self, text: &str) -> Result<Value, NotTaken> {
        let value = match self {
            Self::Words(words) => {
                words.iter().find(|(word, _)| *word == text).map(|(word, _)| Value::Word(word))
            }
            Self::Whole(..) => number(text).map(Value::Whole),
            Self::Number(..) => number(text).map(Value::Number),
            Self::Cells(_) => sides(text).or_else(|| number(text).map(|side| [side, side])).map(Value::Cells),
            Self::Point => numbers(text, &[',']).map(Value::Point),
        };
        value.filter(|value| self.takes(*value)).ok_or(NotTaken(self))
    }

    /// Returns true if `value` is one of these values.
    pub fn takes(self, value: Value) -> bool {
        match (self, value) {
            (Self::Words(words), Value::Word(given)) => words.iter().any(|(word, _)| *word == given),
            (Self::Whole(lowest, highest), Value::Whole(given)) => (lowest..=highest).contains(&given),
            (Self::Number(unit, least), Value::Number(given)) => {
                let is_least = given > 0.0 || (given == 0.0 && least == Least::Zero);
                is_least && given.is_finite() && (unit != Unit::Share || given <= 1.0)
            }
            (Self::Cells(most), Value::Cells(sides)) => sides.iter().all(|side| (1..=most).contains(side)),
            (Self::Point, Value::Point(point)) => point.iter().all(|number| number.is_finite()),
            _ => false,
        }
    }

    /// Returns true if the values are those of a switch, `on` and `off`.
    pub fn is_switch(self) -> bool {
        self == Self::SWITCH
    }

    /// Returns the condition on a value, in words that follow the option's name.
    pub fn expected(self) -> String {
        match self {
            Self::Words(words) => {
                let words: Vec<_> = words.iter().map(|(word, _)| *word).collect();
                format!("must be one of: {}", words.join(", "))
            }
            Self::Whole(lowest, highest) => format!("must be a whole number from {lowest} to {highest}"),
            Self::Number(Unit::Share, Least::Zero) => "must be a number from 0 to 1".to_owned(),
            Self::Number(Unit::Share, Least::AboveZero) => "must be a number above 0, at most 1".to_owned(),
            Self::Number(Unit::Metres, Least::Zero) => "must be a finite number of at least 0".to_owned(),
            Self::Number(Unit::Metres, Least::AboveZero) => "must be a finite number above 0".to_owned(),
            Self::Cells(most) => {
                format!("write columns x rows from 1 to {most} each, such as 720x480, or one number for both")
            }
            Self::Point => "must be three finite numbers such as 0,1.5,-2".to_owned(),
        }
    }

    /// Returns the values that are taken, as a cell of a table in Markdown.
    pub fn in_markdown(self) -> String {
        match self {
            Self::Words(words) => {
                let words: Vec<_> = words.iter().map(|(word, doc)| format!("`{word}`: {doc}")).collect();
                words.join("<br>")
            }
            Self::Whole(lowest, u32::MAX) => format!("{lowest} or more"),
            Self::Whole(lowest, highest) => format!("{lowest} to {highest}"),
            Self::Number(unit, least) => {
                let unit = if unit == Unit::Metres { "metres" } else { "a share of 1" };
                format!("{unit}, {}", if least == Least::Zero { "not negative" } else { "above 0" })
            }
            Self::Cells(most) => format!("columns x rows, or one number for both, 1 to {most} each"),
            Self::Point => "x,y,z, metres".to_owned(),
        }
    }

    /// Returns the lower and upper end of whole numbers, or of columns and rows, for help. `None` for all
    /// other values, and for whole numbers without an upper end.
    pub fn range(self) -> Option<String> {
        match self {
            Self::Whole(lowest, highest) if highest < u32::MAX => Some(format!("{lowest} to {highest}")),
            Self::Cells(most) => Some(format!("1 to {most} each")),
            _ => None,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const WORDS: Values = Values::Words(&[("sah", "A tree"), ("lbvh", "Another")]);

    #[test]
    fn values_are_read_once_and_written_as_they_are_typed() {
        for (values, text, value, written) in [
            (WORDS, "lbvh", Value::Word("lbvh"), "lbvh"),
            (Values::SWITCH, "off", Value::Word("off"), "off"),
            (Values::Whole(2, 65_535), " 65535 ", Value::Whole(65_535), "65535"),
            (Values::Number(Unit::Metres, Least::Zero), "0", Value::Number(0.0), "0"),
            (Values::Number(Unit::Share, Least::AboveZero), "0.1", Value::Number(0.1), "0.1"),
            (Values::Cells(8192), "720x480", Value::Cells([720, 480]), "720x480"),
            (Values::Cells(64), "64", Value::Cells([64, 64]), "64x64"),
            (Values::Point, "0, 1.5,-2", Value::Point([0.0, 1.5, -2.0]), "0,1.5,-2"),
        ] {
            assert_eq!(values.parse(text), Ok(value), "{text}");
            assert_eq!(value.to_string(), written);
            assert_eq!(values.parse(written), Ok(value), "{written}");
        }
    }

    #[test]
    fn what_lies_outside_is_refused_in_words() {
        let metres = Values::Number(Unit::Metres, Least::Zero);
        for (values, expected, refused) in [
            (WORDS, "must be one of: sah, lbvh", &["", "SAH", "sah ", "1"][..]),
            (
                Values::Whole(2, 65_535),
                "must be a whole number from 2 to 65535",
                &["1", "65536", "-2", "2.5", "", "4294967298", "two"],
            ),
            (metres, "must be a finite number of at least 0", &["-0.1", "nan", "inf", "1e39", "", "1m"]),
            (
                Values::Number(Unit::Metres, Least::AboveZero),
                "must be a finite number above 0",
                &["0", "-0", "-1", "nan", "inf"],
            ),
            (
                Values::Number(Unit::Share, Least::Zero),
                "must be a number from 0 to 1",
                &["-0.1", "1.01", "nan", "inf"],
            ),
            (
                Values::Number(Unit::Share, Least::AboveZero),
                "must be a number above 0, at most 1",
                &["0", "-1", "1.01", "nan", "inf"],
            ),
            (
                Values::Cells(8192),
                "write columns x rows from 1 to 8192 each, such as 720x480, or one number for both",
                &["", "0", "x", "720x", "8193", "720x480x2", "-1x4"],
            ),
            (
                Values::Point,
                "must be three finite numbers such as 0,1.5,-2",
                &["", "1", "1,2", "1,2,3,4", "1,2,nan", "1,2,inf", "1,2,z"],
            ),
        ] {
            for text in refused {
                assert_eq!(values.parse(text), Err(NotTaken(values)), "{text}");
                assert_eq!(NotTaken(values).to_string(), expected);
            }
        }
    }

    #[test]
    fn a_value_of_another_kind_is_not_taken() {
        let all = [
            Value::Word("on"),
            Value::Whole(1),
            Value::Number(1.0),
            Value::Cells([1, 1]),
            Value::Point([1.0; 3]),
        ];
        let kinds = [
            Values::SWITCH,
            Values::Whole(0, 2),
            Values::Number(Unit::Share, Least::Zero),
            Values::Cells(2),
            Values::Point,
        ];
        for (kind, values) in kinds.iter().enumerate() {
            for (place, value) in all.iter().enumerate() {
                assert_eq!(values.takes(*value), kind == place, "{values:?} {value:?}");
            }
        }
        assert!(Values::SWITCH.is_switch() && !WORDS.is_switch());
    }
}
