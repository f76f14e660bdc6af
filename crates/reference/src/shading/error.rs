use crate::oracle::OracleError;

/// Error of making a reference image.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum ReferenceError {
    /// The oracle cannot be made.
    #[error(transparent)]
    Oracle(#[from] OracleError),
    /// The scene refers to an element that it does not have.
    #[error("{what}, but the scene has {count}; load it through the scene crate, which checks this")]
    Malformed {
        /// Description of the mismatch, such as `instance a names mesh 3`.
        what: String,
        /// Number of such elements of the scene.
        count: usize,
    },
    /// The number of given posed positions does not fit the scene.
    #[error(
        "{given} posed positions were given for a scene of {expected}; pass one for each vertex of each instance"
    )]
    PositionCount {
        /// Number of positions given.
        given: usize,
        /// Number of positions of the scene.
        expected: usize,
    },
    /// The image has no pixels or samples.
    #[error("an image of {width} x {height} pixels with {samples} samples is empty; each must be at least 1")]
    EmptyImage {
        /// Number of pixels per row.
        width: u32,
        /// Number of rows.
        height: u32,
        /// Number of samples per pixel.
        samples: u32,
    },
}
