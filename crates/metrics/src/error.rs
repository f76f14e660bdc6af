/// Error of a comparison.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum MetricsError {
    /// The numbers of verdicts and hits differ.
    #[error("{truths} verdicts but {hits} hits; pass one of each for every ray")]
    RayCountMismatch {
        /// Number of verdicts given.
        truths: usize,
        /// Number of hits given.
        hits: usize,
    },
    /// The number of pixels does not match the size.
    #[error(
        "{pixels} pixels for an image of {width} x {height}; pass width * height of them, and at least one"
    )]
    PixelCountMismatch {
        /// Number of pixels given.
        pixels: usize,
        /// Number of pixels in a row.
        width: usize,
        /// Number of rows.
        height: usize,
    },
    /// The sizes of the two images differ.
    #[error(
        "an image of {test:?} pixels cannot be compared with a reference of {reference:?}; render both at one size"
    )]
    SizeMismatch {
        /// Width and height of the tested image.
        test: [usize; 2],
        /// Width and height of the reference.
        reference: [usize; 2],
    },
    /// A pixel of the reference is not finite.
    #[error("pixel {pixel} of the reference is not finite; render the reference again")]
    NonFiniteReference {
        /// Index of the first such pixel, in row order.
        pixel: usize,
    },
    /// The image is too large for the perceptual metric.
    #[error("an image of {size:?} pixels is too large for FLIP; compare it in parts")]
    TooLarge {
        /// Width and height of the image.
        size: [usize; 2],
    },
}
