//! Values of options.

use std::collections::BTreeMap;
use std::fmt;

/// Value of an option. It is displayed as a user types it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Value {
    /// Word, one of those that the option takes.
    Word(&'static str),
    /// Whole number.
    Whole(u32),
    /// Number that need not be whole.
    Number(f32),
    /// Numbers of columns and rows.
    Cells([u32; 2]),
    /// Point, in metres.
    Point([f32; 3]),
}

impl Value {
    /// Returns the word, or `None` for a value of another kind.
    pub fn word(self) -> Option<&'static str> {
        if let Self::Word(word) = self { Some(word) } else { None }
    }

    /// Returns the whole number, or `None` for a value of another kind.
    pub fn whole(self) -> Option<u32> {
        if let Self::Whole(whole) = self { Some(whole) } else { None }
    }

    /// Returns the number that need not be whole, or `None` for a value of another kind.
    pub fn number(self) -> Option<f32> {
        if let Self::Number(number) = self { Some(number) } else { None }
    }

    /// Returns the columns and rows, or `None` for a value of another kind.
    pub fn cells(self) -> Option<[u32; 2]> {
        if let Self::Cells(cells) = self { Some(cells) } else { None }
    }

    /// Returns the point, or `None` for a value of another kind.
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

/// Values that were given for options, by name. Options that are left out follow their default.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct OptionValues(BTreeMap<&'static str, Value>);

impl OptionValues {
    /// Returns all given options and values, in the order of names.
    pub fn iter(&self) -> impl Iterator<Item = (&'static str, Value)> {
        self.0.iter().map(|(name, value)| (*name, *value))
    }

    /// Returns the number of options given.
    pub fn len(&self) -> usize {
        self.0.len()
    }

    /// Returns true if no option was given.
    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    /// Returns the value given for an option.
    pub fn get(&self, option: &str) -> Option<Value> {
        self.0.get(option).copied()
    }

    /// Returns the value given for an option, as a user types it.
    pub fn text(&self, option: &str) -> Option<String> {
        self.get(option).map(|value| value.to_string())
    }

    /// Sets the value of an option.
    pub fn set(&mut self, option: &'static str, value: impl Into<Value>) {
        self.0.insert(option, value.into());
    }

    /// Removes the value of an option, which then follows its default.
    pub fn unset(&mut self, option: &str) {
        self.0.remove(option);
    }

    /// Returns these values with one more.
    #[must_use]
    pub fn with(mut self, option: &'static str, value: impl Into<Value>) -> Self {
        self.set(option, value);
        self
    }

    /// Returns the values of the options whose names `keep` accepts.
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
