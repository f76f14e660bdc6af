use crate::oracle::OracleError;

/// Why a reference image cannot be made.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum ReferenceError {
    /// The triangles cannot be asked for hits.
    #[error(transparent)]
    Oracle(#[from] OracleError),
    /// The scene names something that it does not have.
    #[error("{what}, but the scene has {count}; load it through the scene crate, which checks this")]
    Malformed {
        /// The mismatch, such as `instance a names mesh 3`.
        what: String,
        /// Number that the scene has.
        count: usize,
    },
    /// Posed positions given from outside do not fit the scene.
    #[error(
        "{given} posed positions were given for a scene of {expected}; pass one for each vertex of each instance"
    )]
    PositionCount {
        /// Number of positions given.
        given: usize,
        /// Number of positions of the scene.
        expected: usize,
    },
    /// An image without pixels or samples.
    #[error("an image of {width} x {height} pixels with {samples} samples is empty; each must be at least 1")]
    EmptyImage {
        /// Pixels a row.
        width: u32,
        /// Rows.
        height: u32,
        /// Samples per pixel.
        samples: u32,
    },
}
