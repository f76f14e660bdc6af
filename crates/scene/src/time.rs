//! Comparison of times in different precisions.
//!
//! Files hold times in single precision, and frames and command lines give them in double: frame 10 of 25 per
//! second is at 0.4000000059604645 s in a file and is requested at 0.4 s. Both mean the same time, and this
//! module alone compares them.

/// Relative tolerance within which two times are equal: the error of a frame's number times the duration of a
/// frame in single precision, as some exporters compute it, which is two roundings of half a unit in the last
/// place each.
const SAME: f64 = 1.0 / (1 << 22) as f64;

/// True if a requested time is that of a key, both in seconds.
pub(crate) fn is_at(key: f64, seconds: f64) -> bool {
    (key - seconds).abs() <= SAME * key.abs()
}

/// True if a key has been reached at a time, both in seconds.
pub(crate) fn has_come(key: f64, seconds: f64) -> bool {
    key <= seconds || is_at(key, seconds)
}

/// Returns the number of the last frame that has begun, of frames that begin at n / `fps`.
pub fn frame(seconds: f64, fps: f64) -> f64 {
    let nearest = (seconds * fps).round();
    if has_come(nearest / fps, seconds) { nearest } else { nearest - 1.0 }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_frame_is_at_its_time_however_that_was_rounded() {
        for fps in [24.0, 25.0, 30.0, 60.0, 29.97, 30_000.0 / 1001.0, 12.5, 1000.0] {
            for frame_number in 1..5000_u16 {
                let number = f64::from(frame_number);
                let exact = number / fps;
                let product = f32::from(frame_number) * (fps as f32).recip();
                let written = format!("{exact:.9}").parse().expect("a number");
                for seconds in [
                    exact,
                    f64::from(exact as f32),
                    f64::from(product),
                    exact.next_up(),
                    exact.next_down(),
                    written,
                ] {
                    assert_eq!(frame(seconds, fps), number, "{seconds} s at {fps}");
                    assert!(is_at(f64::from(exact as f32), seconds), "{seconds} s at {fps}");
                }
                assert_eq!(frame(exact + 0.5 / fps, fps), number);
                let before = exact - 0.01 / fps;
                assert!(!has_come(f64::from(exact as f32), before) && frame(before, fps) == number - 1.0);
            }
        }
    }

    #[test]
    fn far_frames_are_their_own() {
        for number in [1_u32 << 22, 1 << 26, u32::MAX].map(f64::from) {
            assert_eq!(frame(number / 60.0, 60.0), number);
        }
    }
}
