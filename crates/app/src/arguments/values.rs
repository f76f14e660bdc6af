//! Values that options take, read from text.

use clap::ValueEnum;
use rasray_experiment::Shard;
use rasray_options::text::{number, numbers, sides};
use rasray_options::{NotTaken, Values};
use std::fmt;
use std::ops::RangeInclusive;
use std::str::FromStr;

/// A switch.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Switch {
    /// Yes
    On,
    /// No
    Off,
}

/// Size of an image in pixels.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Size {
    /// Width in pixels, in [1, 16384].
    pub width: u32,
    /// Height in pixels, in [1, 16384].
    pub height: u32,
}

/// Largest number of a frame.
const MOST_FRAMES: u32 = 9_999_999;

/// Largest side of an image, in pixels.
const SIDE_LIMIT: u32 = 16_384;

/// Largest distance of a point from the origin of the world along an axis, metres: beyond it squares of
/// distances exceed single precision.
const FARTHEST: f64 = 1.0e18;

/// Error of text that is not a value of an argument.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum ValueError {
    /// The text is not a size.
    #[error("write WIDTHxHEIGHT, such as 640x360")]
    Size,
    /// A side of the size is empty or too large.
    #[error("each side must be from 1 to {SIDE_LIMIT} pixels")]
    Side,
    /// The text is not a point.
    #[error("write three numbers, such as 0,1.5,-4")]
    Point,
    /// The point is too far away.
    #[error("each number must be from -{FARTHEST:e} to {FARTHEST:e} metres")]
    Far,
    /// The text is not a number or range of frames.
    #[error("must be a frame or a range such as 0-99, up to {MOST_FRAMES}")]
    Frames,
    /// The text is not a share of the work.
    #[error("must be a share such as 2/8, the second of eight")]
    Shard,
    /// The text is not a number, or the number is out of range.
    #[error("must be {0}")]
    Number(Quantity),
    /// The text is not a file with a name.
    #[error("write NAME=FILE.npy, such as embree=hits.npy")]
    NamedFile,
    /// The name contains characters that reports would escape.
    #[error("the name before = has letters, digits, '.', '_' and '-' only")]
    Name,
    /// The text is not a value of the option.
    #[error(transparent)]
    NotTaken(#[from] NotTaken),
}

/// Reads `640x360`.
///
/// # Errors
/// The text does not have the form, or a side is impossible; the message describes what is allowed.
pub fn size(text: &str) -> Result<Size, ValueError> {
    let sides = sides(text).ok_or(ValueError::Size)?;
    if !sides.iter().all(|side| (1..=SIDE_LIMIT).contains(side)) {
        return Err(ValueError::Side);
    }
    let [width, height] = sides;
    Ok(Size { width, height })
}

/// Makes a parser of whole numbers from `least` to `most`.
///
/// # Errors
/// The parser fails for anything else; its message describes what is allowed.
pub fn whole(least: u32, most: u32) -> impl Fn(&str) -> Result<u32, ValueError> + Clone + Send + Sync {
    let values = Values::Whole(least, most);
    move |text| Ok(values.parse(text)?.whole().ok_or(NotTaken(values))?)
}

/// Reads three numbers, `1,-2.5,0`. The caller must check that they are finite.
pub fn three(text: &str) -> Option<[f64; 3]> {
    numbers(text, &[','])
}

/// Reads a point of the world, `1,-2.5,0`.
///
/// # Errors
/// The text does not have the form, or a number is out of range; the message describes both.
pub fn point(text: &str) -> Result<[f64; 3], ValueError> {
    let values = three(text).ok_or(ValueError::Point)?;
    // The comparison is written so that NaN is refused.
    if !values.iter().all(|value| value.abs() <= FARTHEST) {
        return Err(ValueError::Far);
    }
    Ok(values)
}

/// Reads numbers of frames, `7` or `0-99`, both ends included.
///
/// # Errors
/// The text does not have the form; the message describes it.
pub fn frames(text: &str) -> Result<RangeInclusive<u32>, ValueError> {
    let ends = numbers(text, &['-']).or_else(|| number(text).map(|frame| [frame, frame]));
    match ends {
        Some([first, last]) if first <= last && last <= MOST_FRAMES => Ok(first..=last),
        _ => Err(ValueError::Frames),
    }
}

/// Reads a share of the work, `2/8`.
///
/// # Errors
/// The text does not have the form; the message describes it.
pub fn shard(text: &str) -> Result<Shard, ValueError> {
    Shard::parse(text).ok_or(ValueError::Shard)
}

/// Quantity with a range of numbers, both ends included.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Quantity {
    /// Name of the quantity, for messages.
    of: &'static str,
    lowest: f64,
    highest: f64,
}

impl Quantity {
    /// Quantity of frames per second.
    pub const FRAMES_PER_SECOND: Self = Self { of: "a number", lowest: 0.001, highest: 100_000.0 };
    /// Quantity of time, up to about thirty years from the origin.
    pub const SECONDS: Self = Self { of: "a finite number of seconds", lowest: -1.0e9, highest: 1.0e9 };
    /// Quantity of an allowed standard error, as a share of the measured value.
    pub const NOISE: Self = Self { of: "a share", lowest: 1.0e-6, highest: 1.0 };
    /// Quantity of exposure in stops.
    pub const STOPS: Self = Self { of: "a number", lowest: -64.0, highest: 64.0 };
    /// Quantity of a full angle of view.
    pub const ANGLE_OF_VIEW: Self = Self { of: "a number of degrees", lowest: 0.01, highest: 175.0 };
    /// Quantity of a length in metres.
    pub const LENGTH: Self = Self { of: "a number of metres", lowest: 0.0, highest: FARTHEST };
    /// Quantity of a distance in metres that is neither 0 nor so small that it is 0 in single precision.
    pub const DISTANCE: Self = Self { lowest: 1.0e-30, ..Self::LENGTH };

    /// Reads a number of the quantity.
    ///
    /// # Errors
    /// The text is not a number in the range; the message describes what is allowed.
    fn parse<T: FromStr + Into<f64> + Copy>(self, text: &str) -> Result<T, ValueError> {
        let read: Option<T> = number(text);
        // The comparison is false for NaN.
        let is_within = |value: &T| (self.lowest..=self.highest).contains(&(*value).into());
        read.filter(is_within).ok_or(ValueError::Number(self))
    }

    /// Makes a parser of numbers of the quantity.
    ///
    /// # Errors
    /// The parser fails for anything else; its message describes what is allowed.
    pub fn parser<T: FromStr + Into<f64> + Copy>(
        self,
    ) -> impl Fn(&str) -> Result<T, ValueError> + Clone + Send + Sync {
        move |text| self.parse(text)
    }
}

impl fmt::Display for Quantity {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        let is_short = |number: f64| number == 0.0 || (1.0e-3..1.0e6).contains(&number.abs());
        let text = |number| if is_short(number) { format!("{number}") } else { format!("{number:e}") };
        write!(formatter, "{} from {} to {}", self.of, text(self.lowest), text(self.highest))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sizes() {
        assert_eq!(size("640x360"), Ok(Size { width: 640, height: 360 }));
        for bad in ["", "640", "640x", "x360", "0x10", "10x0", "-1x5", "99999x1", "1x2x3", "1.5x2"] {
            assert!(size(bad).is_err(), "{bad}");
        }
    }

    #[test]
    fn whole_numbers() {
        let parse = whole(2, 65_535);
        assert_eq!((parse("2"), parse(" 65535 ")), (Ok(2), Ok(65_535)));
        for bad in ["1", "65536", "-2", "2.5", "", "4294967298", "two"] {
            let error = parse(bad).expect_err(bad);
            assert_eq!(error.to_string(), "must be a whole number from 2 to 65535", "{bad}");
        }
    }

    #[test]
    fn ranges_of_frames() {
        assert_eq!((frames("7"), frames("0-99"), frames(" 3 - 3 ")), (Ok(7..=7), Ok(0..=99), Ok(3..=3)));
        for bad in ["", "-", "9-3", "-1-2", "1-", "0-10000000", "1.5", "1-2-3"] {
            assert!(frames(bad).is_err(), "{bad}");
        }
        let parse = Quantity::FRAMES_PER_SECOND.parser::<f64>();
        assert_eq!((parse("25"), parse("23.976")), (Ok(25.0), Ok(23.976)));
        for bad in ["0", "-1", "nan", "inf", "x"] {
            assert!(parse(bad).is_err(), "{bad}");
        }
    }

    #[test]
    fn times() {
        let seconds = Quantity::SECONDS.parser::<f64>();
        assert_eq!((seconds("1.5"), seconds(" -2 ")), (Ok(1.5), Ok(-2.0)));
        for bad in ["", "x", "nan", "inf", "1s", "1e39", "-1e10"] {
            assert!(seconds(bad).is_err(), "{bad}");
        }
    }

    #[test]
    fn lengths() {
        let (length, distance) = (Quantity::LENGTH.parser::<f64>(), Quantity::DISTANCE.parser::<f64>());
        assert_eq!((length("0"), length(" 2.5e-2 "), distance("1e18")), (Ok(0.0), Ok(0.025), Ok(1.0e18)));
        for bad in ["", "-1", "nan", "inf", "2e18", "1m"] {
            assert!(length(bad).is_err() && distance(bad).is_err(), "{bad}");
        }
        assert!(distance("0").is_err() && distance("1e-40").is_err());
    }

    #[test]
    fn points() {
        assert_eq!(point("1,-2.5, 3e2"), Ok([1.0, -2.5, 300.0]));
        for bad in ["", "1,2", "1,2,3,4", "1,2,x", "nan,0,0", "inf,0,0", "1;2;3", "1e39,0,0", "0,-1.1e18,0"] {
            assert!(point(bad).is_err(), "{bad}");
        }
    }

    #[test]
    fn ranges_refuse_what_lies_outside() {
        let angle_of_view = Quantity::ANGLE_OF_VIEW.parser::<f64>();
        assert!(angle_of_view("45").is_ok() && angle_of_view("0").is_err() && angle_of_view("180").is_err());
        let stops = Quantity::STOPS.parser::<f32>();
        assert!(stops("-2").is_ok() && stops("65").is_err() && stops("nan").is_err());
        let noise = Quantity::NOISE.parser::<f64>();
        assert!(
            noise("0.02").is_ok() && noise("0").is_err() && noise("1.5").is_err() && noise("nan").is_err()
        );
    }

    #[test]
    fn errors_say_the_range() {
        for (quantity, expected) in [
            (Quantity::FRAMES_PER_SECOND, "must be a number from 0.001 to 100000"),
            (Quantity::SECONDS, "must be a finite number of seconds from -1e9 to 1e9"),
            (Quantity::NOISE, "must be a share from 1e-6 to 1"),
            (Quantity::STOPS, "must be a number from -64 to 64"),
            (Quantity::ANGLE_OF_VIEW, "must be a number of degrees from 0.01 to 175"),
            (Quantity::LENGTH, "must be a number of metres from 0 to 1e18"),
            (Quantity::DISTANCE, "must be a number of metres from 1e-30 to 1e18"),
        ] {
            assert_eq!(ValueError::Number(quantity).to_string(), expected);
        }
        assert_eq!(ValueError::Far.to_string(), "each number must be from -1e18 to 1e18 metres");
    }
}
