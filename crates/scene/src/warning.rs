//! Warnings of readers about a scene.

/// Something the user should know about a scene.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Warning {
    /// Stable word for tests and reports, such as `degenerate-triangles`.
    pub kind: &'static str,
    /// One sentence with the fault, its place, the number of cases, and the replacement.
    pub message: String,
}
