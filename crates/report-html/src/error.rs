/// Contradiction between figures and report, which no input of a user can cause.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{0}")]
pub struct HtmlError(String);

pub(crate) fn misfit(what: impl Into<String>) -> HtmlError {
    HtmlError(what.into())
}
