//! Text from files, cut to the length that fits a message. Code that writes it to a terminal must escape it.

use std::fmt::Display;

/// Largest length of a file's text that a message repeats, characters.
const LONGEST: usize = 160;
/// Largest length of a sentence, characters.
const LONGEST_SENTENCE: usize = 800;

/// Returns a name or value of a file, cut where it is long.
pub fn shown(text: impl Display) -> String {
    cut(text.to_string(), LONGEST)
}

/// Returns a sentence, cut where it is long.
pub fn sentence(text: impl Display) -> String {
    cut(text.to_string(), LONGEST_SENTENCE)
}

/// Returns the message of the operating system, without its error number.
pub fn reason(error: &std::io::Error) -> String {
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
