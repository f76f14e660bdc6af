//! Text from files, made fit to be shown.

use std::fmt::Display;

/// Longest text of a file that a message repeats, characters.
const LONGEST: usize = 160;
/// Longest sentence, characters.
const LONGEST_SENTENCE: usize = 800;

/// `text` without anything that a terminal would obey: control characters, and those that turn the
/// direction of writing or end a line, become escapes such as `\u{1b}`.
///
/// Names from files and names of files may hold any of them. All names in a loaded [`crate::Scene`],
/// all warnings and all errors of this crate have passed through here.
pub fn printable(text: impl Display) -> String {
    let mut shown = String::new();
    for character in text.to_string().chars() {
        if commands(character) {
            shown.extend(character.escape_default());
        } else {
            shown.push(character);
        }
    }
    shown
}

fn commands(character: char) -> bool {
    let turns = matches!(character, '\u{61c}' | '\u{200e}' | '\u{200f}' | '\u{202a}'..='\u{202e}' | '\u{2066}'..='\u{2069}');
    character.is_control() || turns || matches!(character, '\u{2028}' | '\u{2029}')
}

/// [`printable`], and cut where a name or value is long.
pub(crate) fn shown(text: impl Display) -> String {
    cut(printable(text), LONGEST)
}

/// [`printable`], and cut where a sentence is long.
pub(crate) fn sentence(text: impl Display) -> String {
    cut(printable(text), LONGEST_SENTENCE)
}

/// What the operating system said, without the number it says it by.
pub(crate) fn reason(error: &std::io::Error) -> String {
    let whole = sentence(error);
    match whole.rfind(" (os error ") {
        Some(end) => whole[..end].to_owned(),
        None => whole,
    }
}

fn cut(whole: String, longest: usize) -> String {
    match whole.char_indices().nth(longest) {
        Some((end, _)) => format!("{}…", &whole[..end]),
        None => whole,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nothing_commands_the_terminal() {
        assert_eq!(printable("Würfel 立方体"), "Würfel 立方体");
        assert_eq!(printable("a\u{1b}[31mb\r\n\u{9b}c\u{7f}"), r"a\u{1b}[31mb\r\n\u{9b}c\u{7f}");
        assert_eq!(printable("a\u{202e}b\u{2066}c\u{2028}d"), r"a\u{202e}b\u{2066}c\u{2028}d");
    }

    #[test]
    fn reasons_have_no_numbers() {
        let error = std::fs::File::open("/nowhere/at/all").expect_err("there is no such file");
        let shown = reason(&error);
        assert!(!shown.is_empty() && !shown.contains("os error"), "{shown}");
        assert_eq!(reason(&std::io::Error::other("a pipe")), "a pipe");
    }

    #[test]
    fn long_texts_are_cut_between_characters() {
        assert_eq!(shown("é".repeat(LONGEST)), "é".repeat(LONGEST));
        assert_eq!(shown("é".repeat(LONGEST + 1)), format!("{}…", "é".repeat(LONGEST)));
    }
}
