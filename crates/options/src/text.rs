//! Reading of numbers from text, with or without spaces around them.

use std::str::FromStr;

/// Reads a number; returns `None` if the text is no number.
pub fn number<T: FromStr>(text: &str) -> Option<T> {
    text.trim().parse().ok()
}

/// Reads `COUNT` numbers with one of the characters `between` each two, as in `1,-2.5,0` or `640x360`. A
/// number cannot contain such a character: if `-` is one, then -1 is no number.
pub fn numbers<T: FromStr, const COUNT: usize>(text: &str, between: &[char]) -> Option<[T; COUNT]> {
    let numbers: Option<Vec<T>> = text.split(between).map(number).collect();
    numbers?.try_into().ok()
}

/// Reads columns and rows, as in `640x360`.
pub fn sides(text: &str) -> Option<[u32; 2]> {
    numbers(text, &['x', 'X'])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_as_many_as_asked_for() {
        assert_eq!(numbers::<f64, 3>("1,-2.5, 3e2", &[',']), Some([1.0, -2.5, 300.0]));
        assert_eq!((sides("640x360"), sides(" 6 X 7 ")), (Some([640, 360]), Some([6, 7])));
        assert_eq!(numbers::<u32, 2>("0-99", &['-']), Some([0, 99]));
        for bad in ["", "1", "1,2", "1,2,3,4", "1,,3", "1,2,z", "1;2;3"] {
            assert_eq!(numbers::<f64, 3>(bad, &[',']), None, "{bad}");
        }
        for bad in ["640", "640x", "x360", "1x2x3", "-1x5", "1.5x2"] {
            assert_eq!(sides(bad), None, "{bad}");
        }
        assert_eq!(numbers::<u32, 2>("-1-2", &['-']), None);
    }
}
