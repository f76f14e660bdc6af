//! Rows of tables.

/// Makes a row of a name and a value.
pub(super) fn pair(name: &str, value: impl ToString) -> Vec<String> {
    vec![name.to_owned(), value.to_string()]
}
