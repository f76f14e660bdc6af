//! Warnings of readers about a scene.

/// Something the user should know about a scene.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Warning {
    /// Stable word for tests and reports, such as `degenerate-triangles`.
    pub kind: &'static str,
    /// One sentence: what, where, how many, what was done instead.
    pub message: String,
}
