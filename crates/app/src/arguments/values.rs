//! Values that options take, read from text.

use clap::ValueEnum;
use rasray_experiment::Shard;
use rasray_options::Values;
use std::ops::RangeInclusive;

/// A switch.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Switch {
    /// Yes
    On,
    /// No
    Off,
}

/// Pixels of an image.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Size {
    /// Pixels a row, in [1, 16384].
    pub width: u32,
    /// Rows, in [1, 16384].
    pub height: u32,
}

/// The largest number of a frame.
const MOST_FRAMES: u32 = 9_999_999;

/// Largest side of an image, in pixels.
const SIDE_LIMIT: u32 = 16_384;

/// Reads `640x360`.
///
/// # Errors
/// Says what the form is, or which side is out of range.
pub fn size(text: &str) -> Result<Size, String> {
    let form = || "write WIDTHxHEIGHT, such as 640x360".to_owned();
    let (width, height) = text.split_once(['x', 'X']).ok_or_else(form)?;
    let side = |text: &str| -> Result<u32, String> {
        let value: u32 = text.trim().parse().map_err(|_| form())?;
        if value == 0 || value > SIDE_LIMIT {
            return Err(format!("each side must be from 1 to {SIDE_LIMIT} pixels"));
        }
        Ok(value)
    };
    Ok(Size { width: side(width)?, height: side(height)? })
}

/// A parser of whole numbers from `least` to `most`.
///
/// # Errors
/// Of the parser: says what is allowed.
pub fn whole(least: u32, most: u32) -> impl Fn(&str) -> Result<u32, String> + Clone + Send + Sync {
    let values = Values::Whole(least, most);
    move |text| values.parse(text)?.whole().ok_or_else(|| values.expected())
}

/// Reads three numbers, `1,-2.5,0`; those that are not finite are left to the caller.
pub fn three(text: &str) -> Option<[f64; 3]> {
    let mut parts = text.split(',');
    let mut next = || -> Option<f64> { parts.next()?.trim().parse().ok() };
    let values = [next()?, next()?, next()?];
    parts.next().is_none().then_some(values)
}

/// Largest distance of a point from the origin of the world along an axis, metres: farther away squares of distances
/// exceed single precision.
const FARTHEST: f64 = 1.0e18;

/// Reads a point of the world, `1,-2.5,0`.
///
/// # Errors
/// Says what the form and the range are.
pub fn point(text: &str) -> Result<[f64; 3], String> {
    let values = three(text).ok_or("write three numbers, such as 0,1.5,-4")?;
    // Written so that NaN is refused.
    if !values.iter().all(|value| value.abs() <= FARTHEST) {
        return Err("each number must be from -1e18 to 1e18 metres".to_owned());
    }
    Ok(values)
}

/// Reads numbers of frames, `7` or `0-99`, both ends included.
///
/// # Errors
/// Says what the form is.
pub fn frames(text: &str) -> Result<RangeInclusive<u32>, String> {
    let (first, last) = text.split_once('-').unwrap_or((text, text));
    match (first.trim().parse(), last.trim().parse()) {
        (Ok(first), Ok(last)) if first <= last && last <= MOST_FRAMES => Ok(first..=last),
        _ => Err(format!("must be a frame or a range such as 0-99, up to {MOST_FRAMES}")),
    }
}

/// Reads frames per second.
///
/// # Errors
/// Says what is allowed.
pub fn frames_per_second(text: &str) -> Result<f64, String> {
    match text.trim().parse::<f64>() {
        Ok(value) if (0.001..=100_000.0).contains(&value) => Ok(value),
        _ => Err("must be a number from 0.001 to 100000".to_owned()),
    }
}

/// Reads a share of the work, `2/8`.
///
/// # Errors
/// Says what the form is.
pub fn shard(text: &str) -> Result<Shard, String> {
    Shard::parse(text).ok_or_else(|| "must be a share such as 2/8, the second of eight".to_owned())
}

/// Latest time and, negative, the earliest, seconds: about thirty years.
const LATEST: f64 = 1.0e9;

/// Reads a time.
///
/// # Errors
/// Says what is allowed.
pub fn seconds(text: &str) -> Result<f64, String> {
    match text.trim().parse::<f64>() {
        Ok(value) if value.abs() <= LATEST => Ok(value),
        _ => Err("must be a finite number of seconds from -1e9 to 1e9".to_owned()),
    }
}

/// Reads a standard error that is allowed, as a share of what is measured.
///
/// # Errors
/// Says what is allowed.
pub fn noise(text: &str) -> Result<f64, String> {
    match text.trim().parse::<f64>() {
        Ok(value) if (1.0e-6..=1.0).contains(&value) => Ok(value),
        _ => Err("must be a share from 0.000001 to 1, such as 0.02".to_owned()),
    }
}

/// Reads stops of exposure.
///
/// # Errors
/// Says what is allowed.
pub fn stops(text: &str) -> Result<f32, String> {
    match text.trim().parse::<f32>() {
        Ok(value) if value.abs() <= 64.0 => Ok(value),
        _ => Err("must be a number from -64 to 64".to_owned()),
    }
}

/// Reads a full angle of view in degrees.
///
/// # Errors
/// Says what is allowed.
pub fn angle_of_view(text: &str) -> Result<f64, String> {
    match text.trim().parse::<f64>() {
        Ok(value) if (0.01..=175.0).contains(&value) => Ok(value),
        _ => Err("must be from 0.01 to 175 degrees".to_owned()),
    }
}

/// Reads a length in metres.
///
/// # Errors
/// Says what is allowed.
pub fn length(text: &str) -> Result<f64, String> {
    match text.trim().parse::<f64>() {
        Ok(value) if (0.0..=FARTHEST).contains(&value) => Ok(value),
        _ => Err("must be from 0 to 1e18 metres".to_owned()),
    }
}

/// Reads a distance in metres, which is not 0.
///
/// # Errors
/// Says what is allowed.
pub fn distance(text: &str) -> Result<f64, String> {
    match length(text) {
        // What is smaller is 0 in single precision.
        Ok(value) if value >= 1.0e-30 => Ok(value),
        _ => Err("must be from 1e-30 to 1e18 metres".to_owned()),
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
            assert_eq!(parse(bad), Err("must be a whole number from 2 to 65535".to_owned()), "{bad}");
        }
    }

    #[test]
    fn ranges_of_frames() {
        assert_eq!((frames("7"), frames("0-99"), frames(" 3 - 3 ")), (Ok(7..=7), Ok(0..=99), Ok(3..=3)));
        for bad in ["", "-", "9-3", "-1-2", "1-", "0-10000000", "1.5", "1-2-3"] {
            assert!(frames(bad).is_err(), "{bad}");
        }
        assert_eq!((frames_per_second("25"), frames_per_second("23.976")), (Ok(25.0), Ok(23.976)));
        for bad in ["0", "-1", "nan", "inf", "x"] {
            assert!(frames_per_second(bad).is_err(), "{bad}");
        }
    }

    #[test]
    fn times() {
        assert_eq!((seconds("1.5"), seconds(" -2 ")), (Ok(1.5), Ok(-2.0)));
        for bad in ["", "x", "nan", "inf", "1s", "1e39", "-1e10"] {
            assert!(seconds(bad).is_err(), "{bad}");
        }
    }

    #[test]
    fn lengths() {
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
        assert!(angle_of_view("45").is_ok() && angle_of_view("0").is_err() && angle_of_view("180").is_err());
        assert!(stops("-2").is_ok() && stops("65").is_err() && stops("nan").is_err());
        assert!(
            noise("0.02").is_ok() && noise("0").is_err() && noise("1.5").is_err() && noise("nan").is_err()
        );
    }
}
