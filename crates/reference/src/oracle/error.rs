/// Error of making an oracle.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum OracleError {
    /// The number of indices is no multiple of three.
    #[error("{indices} indices are no multiple of three; pass three indices for each triangle")]
    IncompleteTriangle {
        /// Number of indices given.
        indices: usize,
    },
    /// An index points past the positions.
    #[error(
        "triangle {primitive} uses position {index} of {positions}; indices must be below the number of positions"
    )]
    IndexOutOfRange {
        /// Running index of the triangle.
        primitive: usize,
        /// Value of the index.
        index: u32,
        /// Number of positions.
        positions: usize,
    },
    /// There are more triangles than ids: ids are 32 bits wide and the last one means "none".
    #[error("{triangles} triangles do not fit 32-bit ids; split the scene")]
    TooManyTriangles {
        /// Number of triangles given.
        triangles: usize,
    },
}
