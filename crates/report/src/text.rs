//! Escaping of names and numbers in text for people.

use std::borrow::Cow;

/// Escapes every character in a text of one or several lines that a terminal interprets, such as `\u{1b}`:
/// controls except line breaks and tabs, and characters that change the direction of the text after them.
pub fn escaped(text: &str) -> Cow<'_, str> {
    written_out(text, &['\n', '\t'])
}

/// Escapes like [`escaped`], except for the characters in `kept`.
pub fn escaped_but<'a>(text: &'a str, kept: &[char]) -> Cow<'a, str> {
    written_out(text, &[&['\n', '\t'], kept].concat())
}

/// Escapes like [`escaped`] for a name within a line: line breaks and tabs are escaped as well.
pub fn in_line(text: &str) -> Cow<'_, str> {
    written_out(text, &[])
}

/// Joins the words of a text with single spaces, for one line.
pub fn one_line(text: &str) -> String {
    in_line(&text.split_whitespace().collect::<Vec<_>>().join(" ")).into_owned()
}

fn written_out<'a>(text: &'a str, kept: &[char]) -> Cow<'a, str> {
    let is_written_out = |character: char| is_obeyed(character) && !kept.contains(&character);
    if !text.contains(is_written_out) {
        return Cow::Borrowed(text);
    }
    let mut escaped = String::with_capacity(text.len() + 8);
    for character in text.chars() {
        if is_written_out(character) {
            escaped.extend(character.escape_default());
        } else {
            escaped.push(character);
        }
    }
    Cow::Owned(escaped)
}

fn is_obeyed(character: char) -> bool {
    let turns = matches!(character, '\u{61c}' | '\u{200e}' | '\u{200f}' | '\u{202a}'..='\u{202e}' | '\u{2066}'..='\u{2069}');
    let separates = matches!(character, '\u{2028}' | '\u{2029}');
    character.is_control() || turns || separates
}

/// Escapes every such character in JSON text the way JSON does it, so that nothing is left for [`escaped`].
/// In valid JSON these characters stand only in strings, except for the line breaks between them.
pub fn json_escaped(text: &str) -> String {
    let mut escaped = String::with_capacity(text.len());
    for character in text.chars() {
        if is_obeyed(character) && character != '\n' {
            // No such character is beyond the sixteen bits that one escape holds.
            escaped += &format!("\\u{:04x}", u32::from(character));
        } else {
            escaped.push(character);
        }
    }
    escaped
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nothing_that_a_terminal_obeys_is_shown_as_it_is() {
        let text = "wall\u{1b}[2J\r\u{7}\u{9b}31m\u{202e}x\0";
        assert_eq!(escaped(text), r"wall\u{1b}[2J\r\u{7}\u{9b}31m\u{202e}x\u{0}");
        assert_eq!(escaped_but("a\u{1b}b\u{7}\n", &['\u{1b}']), "a\u{1b}b\\u{7}\n");
        let plain = "Wände, 壁\n\tand 🧱";
        assert!(matches!(escaped(plain), Cow::Borrowed(text) if text == plain));
        assert_eq!(in_line("a\nb\tc\u{2028}d"), r"a\nb\tc\u{2028}d");
        assert_eq!(one_line(" a\n  b\u{7} "), r"a b\u{7}");
    }

    #[test]
    fn json_stays_json() {
        let name = "a\u{1b}\u{9b}\u{202e}\n\"b\"";
        let text = json_escaped(&serde_json::to_string(name).expect("a string"));
        assert!(!text.contains(is_obeyed), "{text}");
        assert_eq!(serde_json::from_str::<String>(&text).expect("a string"), name);
    }
}
