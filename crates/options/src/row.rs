//! Row of an option.

use crate::{Value, Values, Word};

/// Option as data: name, values, help, default.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OptionRow {
    /// Name of the option, on the command line and in reports.
    pub name: &'static str,
    /// Values that the option takes.
    pub values: Values,
    /// Purpose, one line of help without a full stop, with names of other options in backticks. Help adds the
    /// range and the default.
    pub doc: &'static str,
    /// Value of the option if none is given; `None` if that depends on more than the option.
    pub default: Option<Value>,
    /// Another name for the value `off`, such as a flag of its own. If present, the option's own name without
    /// a value means `on`.
    pub off_name: Option<&'static str>,
    /// Values that tests try. If empty, tests try all words of the option.
    pub tried: &'static [&'static str],
}

/// Error for a value that an option does not take.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{option} {value} is not possible: {expected}")]
pub struct ValueError {
    /// Name of the option.
    pub option: &'static str,
    /// Value that was given.
    pub value: String,
    /// Values that the option takes, in words.
    pub expected: String,
}

impl OptionRow {
    /// Returns an option without a default.
    pub const fn new(name: &'static str, values: Values, doc: &'static str) -> Self {
        Self { name, values, doc, default: None, off_name: None, tried: &[] }
    }

    /// Returns an option that takes one of several words.
    pub const fn words(name: &'static str, words: &'static [Word], doc: &'static str) -> Self {
        Self::new(name, Values::Words(words), doc)
    }

    /// Returns an option that is on or off.
    pub const fn switch(name: &'static str, doc: &'static str) -> Self {
        Self::new(name, Values::SWITCH, doc)
    }

    /// Sets the default.
    #[must_use]
    pub const fn by_default(self, default: Value) -> Self {
        Self { default: Some(default), ..self }
    }

    /// Sets the values that tests try.
    #[must_use]
    pub const fn trying(self, tried: &'static [&'static str]) -> Self {
        Self { tried, ..self }
    }

    /// Returns the values that tests try.
    pub fn tried(&self) -> Vec<&'static str> {
        match self.values {
            Values::Words(words) if self.tried.is_empty() => words.iter().map(|(word, _)| *word).collect(),
            _ => self.tried.to_vec(),
        }
    }

    /// Reads a value from text.
    ///
    /// # Errors
    /// The option does not take the value.
    pub fn parse(&self, text: &str) -> Result<Value, ValueError> {
        self.values.parse(text).map_err(|error| self.refused(text, error.to_string()))
    }

    /// Returns the value, if the option takes it.
    ///
    /// # Errors
    /// The option does not take the value.
    pub fn check(&self, value: Value) -> Result<Value, ValueError> {
        let taken = self.values.takes(value).then_some(value);
        taken.ok_or_else(|| self.refused(value, self.values.expected()))
    }

    /// Returns the error for a value, with the values that are expected instead, in words.
    pub fn refused(&self, value: impl ToString, expected: String) -> ValueError {
        ValueError { option: self.name, value: value.to_string(), expected }
    }

    /// Returns the help: the purpose, with the range and the default.
    pub fn help(&self) -> String {
        let range = self.values.range().map(|range| format!(" [{range}]"));
        let default = self.default.map(|value| format!(" [default: {value}]"));
        [Some(self.doc.to_owned()), range, default].into_iter().flatten().collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn help_says_the_range_and_the_default() {
        let row = OptionRow::new("buckets", Values::Whole(1, 64), "Depth buckets");
        assert_eq!(row.help(), "Depth buckets [1 to 64]");
        let row = OptionRow::switch("sort", "Sort").by_default(Value::Word("on"));
        assert_eq!(row.help(), "Sort [default: on]");
        assert_eq!(OptionRow::new("capacity", Values::Whole(0, u32::MAX), "Entries").help(), "Entries");
    }

    #[test]
    fn errors_name_the_option() {
        let row = OptionRow::switch("sort", "Sort");
        let error = row.parse("maybe").expect_err("no such word");
        assert_eq!(error.to_string(), "sort maybe is not possible: must be one of: on, off");
        assert_eq!(row.check(Value::Whole(1)).expect_err("no word").value, "1");
        assert_eq!(row.check(Value::Word("on")), Ok(Value::Word("on")));
    }

    #[test]
    fn every_word_is_tried_unless_told() {
        assert_eq!(OptionRow::switch("sort", "Sort").tried(), ["on", "off"]);
        assert_eq!(OptionRow::switch("sort", "Sort").trying(&["off"]).tried(), ["off"]);
        assert!(OptionRow::new("page", Values::Whole(1, 8), "Page").tried().is_empty());
    }
}
