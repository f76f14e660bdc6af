//! Lines and words of OBJ and MTL files.

use std::borrow::Cow;
use std::path::Path;

use rasray_scene::SceneError;

/// Statement: a word and the rest of its line.
pub(super) struct Statement<'a> {
    /// Line of the file where the statement begins, from 1.
    pub line: usize,
    /// First word of the statement.
    pub word: Cow<'a, [u8]>,
    rest: Cow<'a, [u8]>,
}

/// Splits a file into statements: blank lines and comments are skipped, a backslash at the end of a
/// line continues it, lines end with LF, CR LF or (where there is no LF at all) CR.
pub(super) fn statements(bytes: &[u8]) -> impl Iterator<Item = Statement<'_>> {
    let bytes = bytes.strip_prefix(b"\xEF\xBB\xBF").unwrap_or(bytes);
    let end_of_line = if bytes.contains(&b'\n') { b'\n' } else { b'\r' };
    let mut lines = bytes.split(move |byte| *byte == end_of_line).zip(1..);
    std::iter::from_fn(move || {
        loop {
            let (text, line) = lines.next()?;
            let text = text.trim_ascii();
            if text.is_empty() || text[0] == b'#' {
                continue;
            }
            let mut whole = Cow::Borrowed(text);
            while let Some(start) = whole.strip_suffix(b"\\") {
                let mut longer = start.to_vec();
                match lines.next() {
                    Some((next, _)) => {
                        longer.push(b' ');
                        longer.extend_from_slice(next.trim_ascii());
                        whole = Cow::Owned(longer);
                    }
                    None => whole = Cow::Owned(longer),
                }
            }
            let split = whole.iter().position(u8::is_ascii_whitespace).unwrap_or(whole.len());
            let (word, rest) = match &whole {
                Cow::Borrowed(whole) => {
                    (Cow::Borrowed(&whole[..split]), Cow::Borrowed(whole[split..].trim_ascii()))
                }
                Cow::Owned(whole) => {
                    (Cow::Owned(whole[..split].to_vec()), Cow::Owned(whole[split..].trim_ascii().to_vec()))
                }
            };
            if !word.is_empty() {
                return Some(Statement { line, word, rest });
            }
        }
    })
}

impl Statement<'_> {
    /// Iterates over the words after the first, up to a comment.
    pub fn words(&self) -> impl Iterator<Item = &[u8]> {
        self.rest
            .split(u8::is_ascii_whitespace)
            .filter(|word| !word.is_empty())
            .take_while(|word| word[0] != b'#')
    }

    /// Returns all text after the first word, for names that may hold spaces or `#`. Bytes that are not UTF-8
    /// are replaced.
    pub fn name(&self) -> String {
        String::from_utf8_lossy(&self.rest).into_owned()
    }

    /// Returns the place of the statement, for messages.
    pub fn place(&self) -> String {
        format!("line {}", self.line)
    }

    /// Reads up to `N` numbers, at least `least`; absent numbers are 0. Also returns the number of words, of
    /// which only the first `N` must be numbers.
    pub fn numbers<const N: usize>(
        &self,
        path: &Path,
        least: usize,
    ) -> Result<([f32; N], usize), SceneError> {
        self.parsed(path, least, number)
    }

    /// Reads numbers as [`Self::numbers`] does, in double precision.
    pub fn wide_numbers<const N: usize>(
        &self,
        path: &Path,
        least: usize,
    ) -> Result<([f64; N], usize), SceneError> {
        self.parsed(path, least, wide_number)
    }

    fn parsed<T: Copy + Default, const N: usize>(
        &self,
        path: &Path,
        least: usize,
        parse: fn(&[u8]) -> Option<T>,
    ) -> Result<([T; N], usize), SceneError> {
        let mut numbers = [T::default(); N];
        let mut count = 0;
        for word in self.words() {
            if let Some(slot) = numbers.get_mut(count) {
                *slot = parse(word).ok_or_else(|| self.not_a_number(path, word))?;
            }
            count += 1;
        }
        if count < least {
            let word = String::from_utf8_lossy(&self.word);
            let reason = format!("{}: `{word}` needs {least} numbers, but {count} are given", self.place());
            return Err(SceneError::syntax(path, reason));
        }
        Ok((numbers, count))
    }

    /// Makes the error for a word that is no number.
    pub fn not_a_number(&self, path: &Path, word: &[u8]) -> SceneError {
        let shown: String = String::from_utf8_lossy(word).chars().take(40).collect();
        SceneError::syntax(path, format!("{}: `{shown}` is not a number", self.place()))
    }
}

/// Reads a decimal number. The text that some C libraries print for NaN and infinity (`-1.#IND`) counts as
/// NaN, which the check of the finished mesh handles.
pub(super) fn number(word: &[u8]) -> Option<f32> {
    let text = std::str::from_utf8(word).ok()?;
    match text.parse() {
        Ok(number) => Some(number),
        Err(_) if text.contains(".#") => Some(f32::NAN),
        Err(_) => None,
    }
}

/// Reads a number in double precision: the number nearest to the text that, rounded once more, equals
/// [`number`].
fn wide_number(word: &[u8]) -> Option<f64> {
    let text = std::str::from_utf8(word).ok()?;
    let wide: f64 = match text.parse() {
        Ok(wide) => wide,
        Err(_) if text.contains(".#") => return Some(f64::NAN),
        Err(_) => return None,
    };
    // Only half-way between two single-precision numbers can the text lie on the other side than its double.
    // The low 29 bits show that case, except for subnormal numbers.
    let is_half_way =
        wide.to_bits() & 0x1FFF_FFFF == 0x1000_0000 || wide.abs() < f64::from(f32::MIN_POSITIVE);
    if is_half_way && wide != 0.0 {
        let narrow: f32 = text.parse().ok()?;
        if wide as f32 != narrow {
            return Some(if f64::from(narrow) > wide { wide.next_up() } else { wide.next_down() });
        }
    }
    Some(wide)
}

#[cfg(test)]
mod tests {
    use super::{number, wide_number};

    #[test]
    fn double_precision_rounds_to_single_precision() {
        // 1 + 2^-24 is half-way; the last digit is beyond double precision.
        let half_way = "1.000000059604644775390625";
        for text in [
            half_way,
            "1.00000005960464477539062500000001",
            "1.00000005960464477539062499999999",
            "1.00000017881393432617187499999999",
            "-1.00000005960464477539062500000001",
            "0.1",
            "1e-45",
            "7.0064923216240853e-46",
            "7.0064923216240854e-46",
            "7.00649232162408535461864791644958065640130970938257885878534141944895541342930300743319094181060791015625e-46",
            "3.4028235677973366e38",
            "1e39",
            "4649776.6540",
            "-0",
            "0",
        ] {
            let (wide, narrow) = (wide_number(text.as_bytes()), number(text.as_bytes()));
            assert_eq!(wide.map(|wide| (wide as f32).to_bits()), narrow.map(f32::to_bits), "{text}");
        }
        assert_eq!(wide_number(b"4649776.6540"), Some(4649776.654));
        assert!(wide_number(b"-1.#IND").is_some_and(f64::is_nan) && wide_number(b"a").is_none());
    }
}
