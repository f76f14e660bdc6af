/// Why a comparison cannot be made.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum MetricsError {
    /// Verdicts and hits are compared one to one.
    #[error("{truths} verdicts but {hits} hits; pass one of each for every ray")]
    RayCountMismatch {
        /// Verdicts given.
        truths: usize,
        /// Hits given.
        hits: usize,
    },
    /// The pixel count does not follow from the size.
    #[error(
        "{pixels} pixels for an image of {width} x {height}; pass width * height of them, and at least one"
    )]
    PixelCountMismatch {
        /// Pixels given.
        pixels: usize,
        /// Pixels in a row.
        width: usize,
        /// Rows.
        height: usize,
    },
    /// The two images do not match.
    #[error(
        "an image of {test:?} pixels cannot be compared with a reference of {reference:?}; render both at one size"
    )]
    SizeMismatch {
        /// Width and height of the tested image.
        test: [usize; 2],
        /// Width and height of the reference.
        reference: [usize; 2],
    },
    /// A reference must be right.
    #[error("pixel {pixel} of the reference is not finite; render the reference again")]
    NonFiniteReference {
        /// The first such pixel, in row order.
        pixel: usize,
    },
    /// The image is too large for the perceptual metric.
    #[error("an image of {size:?} pixels is too large for FLIP; compare it in parts")]
    TooLarge {
        /// Width and height.
        size: [usize; 2],
    },
}
