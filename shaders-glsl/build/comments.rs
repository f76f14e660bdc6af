//! Documentation of Rust from comments of GLSL.

/// Converts a comment for rustdoc: names get code marks, and characters that Markdown takes for markup are
/// escaped. Text in code marks stays unchanged.
pub(crate) fn documentation(comment: &str) -> String {
    let mut text = String::new();
    for (place, part) in comment.split('`').enumerate() {
        if place % 2 == 1 {
            text = text + "`" + part + "`";
        } else {
            text += &marked(part);
        }
    }
    text
}

/// Converts a comment as [`documentation`] into a sentence: with a capital, unless it begins with a name, and
/// a full stop.
pub(crate) fn sentence(comment: &str) -> String {
    let comment = comment.trim();
    let mut characters = comment.chars();
    let first: String = characters.next().map(|first| first.to_uppercase().collect()).unwrap_or_default();
    let begins_with_name = comment.split(|c: char| !is_of_word(c)).next().is_some_and(is_name);
    let capital = if begins_with_name { comment.to_owned() } else { first + characters.as_str() };
    let ends = comment.ends_with(['.', '!', '?']);
    documentation(&capital) + if ends { "" } else { "." }
}

fn is_of_word(character: char) -> bool {
    character.is_ascii_alphanumeric() || character == '_'
}

/// True if a word is a name of the code and not a word of the language.
fn is_name(word: &str) -> bool {
    word.contains('_') && word.chars().any(char::is_alphabetic)
}

fn marked(text: &str) -> String {
    let mut result = String::new();
    let mut rest = text;
    while let Some(first) = rest.chars().next() {
        let word = &rest[..rest.find(|c| !is_of_word(c)).unwrap_or(rest.len())];
        if word.is_empty() {
            if matches!(first, '[' | ']' | '<' | '*' | '_') {
                result.push('\\');
            }
            result.push(first);
            rest = &rest[first.len_utf8()..];
            continue;
        }
        rest = &rest[word.len()..];
        if !is_name(word) {
            result += word;
            continue;
        }
        // `STATUS_*` stands for all names that begin with `STATUS_`.
        let star = if word.ends_with('_') && rest.starts_with('*') { "*" } else { "" };
        rest = &rest[star.len()..];
        result = result + "`" + word + star + "`";
    }
    result
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn comments_become_documentation() {
        for (comment, expected) in [
            ("metres: half side", "Metres: half side."),
            ("STATUS_*; without STATUS_COMPLETE nothing", "`STATUS_*`; without `STATUS_COMPLETE` nothing."),
            ("as half_width", "As `half_width`."),
            ("`a[0] <= b_c`, else t_max", "`a[0] <= b_c`, else `t_max`."),
            ("in [0, 1]; a < b", "In \\[0, 1\\]; a \\< b."),
            ("WRAP_* | WRAP_* << SHIFT_V. Ends.", "`WRAP_*` | `WRAP_*` \\<\\< `SHIFT_V`. Ends."),
            ("0: none; 2 * x", "0: none; 2 \\* x."),
        ] {
            assert_eq!(sentence(comment), expected);
        }
        assert_eq!(documentation("lower, UPPER_CASE"), "lower, `UPPER_CASE`");
    }
}
