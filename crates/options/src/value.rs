//! Values of options.

use std::collections::BTreeMap;
use std::fmt;

/// The value of an option. Its text is what is typed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Value {
    /// A word.
    Word(&'static str),
    /// A whole number.
    Whole(u32),
    /// A number.
    Number(f32),
    /// Columns and rows.
    Cells([u32; 2]),
    /// A point, metres.
    Point([f32; 3]),
}

impl Value {
    /// The word, where it is one.
    pub fn word(self) -> Option<&'static str> {
        if let Self::Word(word) = self { Some(word) } else { None }
    }

    /// The whole number, where it is one.
    pub fn whole(self) -> Option<u32> {
        if let Self::Whole(whole) = self { Some(whole) } else { None }
    }

    /// The number, where it is one that need not be whole.
    pub fn number(self) -> Option<f32> {
        if let Self::Number(number) = self { Some(number) } else { None }
    }

    /// Columns and rows, where it is these.
    pub fn cells(self) -> Option<[u32; 2]> {
        if let Self::Cells(cells) = self { Some(cells) } else { None }
    }

    /// The point, where it is one.
    pub fn point(self) -> Option<[f32; 3]> {
        if let Self::Point(point) = self { Some(point) } else { None }
    }
}

impl fmt::Display for Value {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Word(word) => formatter.write_str(word),
            Self::Whole(whole) => whole.fmt(formatter),
            Self::Number(number) => number.fmt(formatter),
            Self::Cells([columns, rows]) => write!(formatter, "{columns}x{rows}"),
            Self::Point([x, y, z]) => write!(formatter, "{x},{y},{z}"),
        }
    }
}

impl From<&'static str> for Value {
    fn from(word: &'static str) -> Self {
        Self::Word(word)
    }
}

impl From<u32> for Value {
    fn from(whole: u32) -> Self {
        Self::Whole(whole)
    }
}

impl From<f32> for Value {
    fn from(number: f32) -> Self {
        Self::Number(number)
    }
}

/// Values given for options, by name; options left out follow the default.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct OptionValues(BTreeMap<&'static str, Value>);

impl OptionValues {
    /// Everything that was given, in the order of names.
    pub fn iter(&self) -> impl Iterator<Item = (&'static str, Value)> {
        self.0.iter().map(|(name, value)| (*name, *value))
    }

    /// Number of options given.
    pub fn len(&self) -> usize {
        self.0.len()
    }

    /// True if no option was given.
    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    /// Value given for an option.
    pub fn get(&self, option: &str) -> Option<Value> {
        self.0.get(option).copied()
    }

    /// Value given for an option, as it is typed.
    pub fn text(&self, option: &str) -> Option<String> {
        self.get(option).map(|value| value.to_string())
    }

    /// Gives a value.
    pub fn set(&mut self, option: &'static str, value: impl Into<Value>) {
        self.0.insert(option, value.into());
    }

    /// Takes back what was given for an option.
    pub fn unset(&mut self, option: &str) {
        self.0.remove(option);
    }

    /// Adds one more value.
    #[must_use]
    pub fn with(mut self, option: &'static str, value: impl Into<Value>) -> Self {
        self.set(option, value);
        self
    }

    /// Values given for options whose names `keep` accepts.
    #[must_use]
    pub fn filtered(&self, keep: impl Fn(&str) -> bool) -> Self {
        Self(self.0.iter().filter(|(name, _)| keep(name)).map(|(name, value)| (*name, *value)).collect())
    }
}

impl FromIterator<(&'static str, Value)> for OptionValues {
    fn from_iter<I: IntoIterator<Item = (&'static str, Value)>>(values: I) -> Self {
        Self(values.into_iter().collect())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_last_value_of_an_option_counts() {
        let given = OptionValues::default().with("sort", "on").with("buckets", 4).with("buckets", 8);
        assert_eq!(
            given.iter().collect::<Vec<_>>(),
            [("buckets", Value::Whole(8)), ("sort", Value::Word("on"))]
        );
        let mut kept = given.filtered(|name| name != "buckets");
        assert_eq!((kept.text("buckets"), kept.text("sort").as_deref(), kept.len()), (None, Some("on"), 1));
        kept.unset("sort");
        assert!(kept.is_empty());
    }

    #[test]
    fn a_value_is_of_one_kind() {
        let kinds = |value: Value| {
            [
                value.word().is_some(),
                value.whole().is_some(),
                value.number().is_some(),
                value.cells().is_some(),
                value.point().is_some(),
            ]
        };
        assert_eq!(kinds(Value::from("on")), [true, false, false, false, false]);
        assert_eq!(kinds(Value::from(1)), [false, true, false, false, false]);
        assert_eq!(kinds(Value::from(1.0)), [false, false, true, false, false]);
        assert_eq!(kinds(Value::Cells([1, 2])), [false, false, false, true, false]);
        assert_eq!(kinds(Value::Point([1.0; 3])), [false, false, false, false, true]);
    }
}
