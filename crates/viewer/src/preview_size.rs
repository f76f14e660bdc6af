//! How many pixels a picture has while something moves.

/// Milliseconds that a picture may take while something moves.
const TARGET_MS: f64 = 80.0;

/// Greatest number that sides are divided by.
const MOST: u32 = 8;

/// The size of pictures while something moves, by how long the last ones took.
#[derive(Clone, Copy, Debug)]
pub struct PreviewSize {
    /// Milliseconds per pixel; absent before the first picture.
    ms_per_pixel: Option<f64>,
    divisor: u32,
}

impl Default for PreviewSize {
    fn default() -> Self {
        Self { ms_per_pixel: None, divisor: 4 }
    }
}

impl PreviewSize {
    /// Takes note of how long a picture took, and chooses by what sides are divided from now on: 1, 2, 4 or 8.
    /// Sides in pixels.
    pub fn took(&mut self, milliseconds: f64, full: [u32; 2], pixels: u32) {
        let now = milliseconds / f64::from(pixels.max(1));
        // One slow picture, as after a build, counts by half.
        let ms_per_pixel = self.ms_per_pixel.map_or(now, |before| 0.5 * (before + now));
        self.ms_per_pixel = Some(ms_per_pixel);
        let expected = |divisor: u32| {
            let [width, height] = sides(full, divisor);
            ms_per_pixel * f64::from(width) * f64::from(height)
        };
        // A step back to more pixels is taken only where it is worth it, so that sizes do not alternate.
        while self.divisor < MOST && expected(self.divisor) > TARGET_MS {
            self.divisor *= 2;
        }
        while self.divisor > 1 && expected(self.divisor / 2) < 0.7 * TARGET_MS {
            self.divisor /= 2;
        }
    }

    /// Pixels a row and rows.
    pub fn size(&self, full: [u32; 2]) -> [u32; 2] {
        sides(full, self.divisor)
    }
}

fn sides(full: [u32; 2], divisor: u32) -> [u32; 2] {
    full.map(|side| side.div_ceil(divisor).max(1))
}

#[cfg(test)]
mod tests {
    use super::*;

    const FULL: [u32; 2] = [640, 360];

    #[test]
    fn slow_devices_get_fewer_pixels_and_fast_ones_all() {
        let mut size = PreviewSize::default();
        assert_eq!(size.size(FULL), [160, 90]);
        size.took(1000.0, FULL, 160 * 90);
        assert_eq!(size.size(FULL), [80, 45]);
        // The least size is kept, however slow it is.
        size.took(10_000.0, FULL, 80 * 45);
        assert_eq!(size.size(FULL), [80, 45]);
        for _ in 0..40 {
            let [width, height] = size.size(FULL);
            size.took(1.0, FULL, width * height);
        }
        assert_eq!(size.size(FULL), FULL);
    }

    #[test]
    fn a_size_that_fits_stays() {
        let mut size = PreviewSize::default();
        for _ in 0..9 {
            size.took(60.0, FULL, 160 * 90);
            assert_eq!(size.size(FULL), [160, 90]);
        }
    }

    #[test]
    fn no_side_is_empty() {
        let mut size = PreviewSize::default();
        size.took(1.0e9, [3, 1], 1);
        assert_eq!(size.size([3, 1]), [1, 1]);
    }
}
