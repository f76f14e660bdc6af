//! Lines and words of OBJ and MTL files.

use std::borrow::Cow;
use std::path::Path;

use crate::SceneError;

/// One statement: a word and what follows on its line.
pub(super) struct Statement<'a> {
    /// Line of the file where it begins, from 1.
    pub line: usize,
    /// The first word.
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
    /// Words after the first, up to a comment.
    pub fn words(&self) -> impl Iterator<Item = &[u8]> {
        self.rest
            .split(u8::is_ascii_whitespace)
            .filter(|word| !word.is_empty())
            .take_while(|word| word[0] != b'#')
    }

    /// All that follows the first word, for names that may hold spaces or `#`. Bytes that are not
    /// UTF-8 are replaced.
    pub fn name(&self) -> String {
        String::from_utf8_lossy(&self.rest).into_owned()
    }

    /// Where this is, for messages.
    pub fn place(&self) -> String {
        format!("line {}", self.line)
    }

    /// Up to `N` numbers, at least `least`; what is not given is 0. Also returns how many there are,
    /// of which only the first `N` must be numbers.
    pub fn numbers<const N: usize>(
        &self,
        path: &Path,
        least: usize,
    ) -> Result<([f32; N], usize), SceneError> {
        let mut numbers = [0.0; N];
        let mut count = 0;
        for word in self.words() {
            if let Some(slot) = numbers.get_mut(count) {
                *slot = number(word).ok_or_else(|| self.not_a_number(path, word))?;
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

    /// The error for a word that is no number.
    pub fn not_a_number(&self, path: &Path, word: &[u8]) -> SceneError {
        let shown: String = String::from_utf8_lossy(word).chars().take(40).collect();
        SceneError::syntax(path, format!("{}: `{shown}` is not a number", self.place()))
    }
}

/// A decimal number. What some C libraries print for NaN and infinity (`-1.#IND`) counts as NaN,
/// which the check of the finished mesh deals with.
pub(super) fn number(word: &[u8]) -> Option<f32> {
    let text = std::str::from_utf8(word).ok()?;
    match text.parse() {
        Ok(number) => Some(number),
        Err(_) if text.contains(".#") => Some(f32::NAN),
        Err(_) => None,
    }
}
