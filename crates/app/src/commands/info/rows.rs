//! Rows of tables.

/// A name and what is said of it.
pub(super) fn pair(name: &str, value: impl ToString) -> Vec<String> {
    vec![name.to_owned(), value.to_string()]
}
