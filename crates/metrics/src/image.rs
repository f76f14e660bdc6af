use crate::error::MetricsError;

/// Image to compare: linear Rec. 709, rows from the top.
#[derive(Clone, Copy, Debug)]
pub struct Image<'a> {
    width: usize,
    height: usize,
    pixels: &'a [[f32; 3]],
}

impl<'a> Image<'a> {
    /// Wraps pixels as an image.
    ///
    /// # Errors
    /// An error if there are not `width * height` pixels, or none.
    pub fn new(width: usize, height: usize, pixels: &'a [[f32; 3]]) -> Result<Self, MetricsError> {
        if pixels.is_empty() || width.checked_mul(height) != Some(pixels.len()) {
            return Err(MetricsError::PixelCountMismatch { pixels: pixels.len(), width, height });
        }
        Ok(Self { width, height, pixels })
    }

    /// Returns width and height.
    pub fn size(&self) -> [usize; 2] {
        [self.width, self.height]
    }

    /// Returns the pixels in row order.
    pub fn pixels(&self) -> &'a [[f32; 3]] {
        self.pixels
    }
}

/// Checks that two images can be compared.
pub(crate) fn check(test: &Image<'_>, reference: &Image<'_>) -> Result<(), MetricsError> {
    if test.size() != reference.size() {
        return Err(MetricsError::SizeMismatch { test: test.size(), reference: reference.size() });
    }
    match reference.pixels.iter().position(|pixel| !pixel.iter().all(|x| x.is_finite())) {
        Some(pixel) => Err(MetricsError::NonFiniteReference { pixel }),
        None => Ok(()),
    }
}
