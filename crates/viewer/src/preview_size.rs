//! Size of a picture while something moves.

/// Largest time for a picture while something moves, milliseconds.
pub(crate) const TARGET_MS: f64 = 80.0;

/// Largest divisor of the sides.
const MOST: u32 = 8;

/// Least number of pixels of a picture whose sides are divided by more than 2: fewer cannot be recognised.
/// The number is a quarter of 640x360.
const LEAST_PIXELS: u32 = 320 * 180;

/// Size of pictures while something moves, chosen by the times of the last ones: half of the sides or the
/// full size, and less only if 320x180 pixels remain.
#[derive(Clone, Copy, Debug)]
pub struct PreviewSize {
    /// Time per pixel, milliseconds; absent before the first picture.
    ms_per_pixel: Option<f64>,
    divisor: u32,
}

impl Default for PreviewSize {
    fn default() -> Self {
        Self { ms_per_pixel: None, divisor: 2 }
    }
}

impl PreviewSize {
    /// Takes note of the time of a picture, and chooses the divisor of the sides from then on: 1, 2, 4 or 8.
    /// Sides are in pixels.
    pub fn took(&mut self, milliseconds: f64, full: [u32; 2], pixels: u32) {
        let now = milliseconds / f64::from(pixels.max(1));
        // The weight of one picture is a half, so that a single slow one, as after a build, does not decide.
        let ms_per_pixel = self.ms_per_pixel.map_or(now, |before| 0.5 * (before + now));
        self.ms_per_pixel = Some(ms_per_pixel);
        let expected = |divisor: u32| ms_per_pixel * pixels_of(full, divisor);
        // A step back to more pixels is taken only if it is worth it, so that sizes do not alternate.
        while self.divisor < most(full) && expected(self.divisor) > TARGET_MS {
            self.divisor *= 2;
        }
        while self.divisor > 1 && expected(self.divisor / 2) < 0.7 * TARGET_MS {
            self.divisor /= 2;
        }
    }

    /// Returns width and height in pixels.
    pub fn size(&self, full: [u32; 2]) -> [u32; 2] {
        sides(full, self.divisor.min(most(full)))
    }
}

/// Returns the greatest divisor of the sides of a picture.
fn most(full: [u32; 2]) -> u32 {
    let is_enough = |divisor: &u32| pixels_of(full, *divisor) >= f64::from(LEAST_PIXELS);
    [MOST, 4].into_iter().find(is_enough).unwrap_or(2)
}

fn pixels_of(full: [u32; 2], divisor: u32) -> f64 {
    sides(full, divisor).into_iter().map(f64::from).product()
}

fn sides(full: [u32; 2], divisor: u32) -> [u32; 2] {
    full.map(|side| side.div_ceil(divisor).max(1))
}

#[cfg(test)]
mod tests {
    use super::*;

    const FULL: [u32; 2] = [640, 360];

    #[test]
    fn slow_devices_get_half_the_sides_and_fast_ones_all() {
        let mut size = PreviewSize::default();
        assert_eq!(size.size(FULL), [320, 180]);
        size.took(10_000.0, FULL, 320 * 180);
        assert_eq!(size.size(FULL), [320, 180], "fewer cannot be read, however slow it is");
        for _ in 0..40 {
            let [width, height] = size.size(FULL);
            size.took(1.0, FULL, width * height);
        }
        assert_eq!(size.size(FULL), FULL);
    }

    #[test]
    fn large_pictures_of_slow_devices_get_as_few_pixels_as_can_be_read() {
        let large = [1920, 1080];
        let mut size = PreviewSize::default();
        assert_eq!(size.size(large), [960, 540]);
        size.took(900.0, large, 960 * 540);
        assert_eq!(size.size(large), [480, 270]);
        size.took(10_000.0, large, 480 * 270);
        assert_eq!(size.size(large), [480, 270]);
        assert_eq!(size.size(FULL), [320, 180], "what was chosen for another size");
    }

    #[test]
    fn a_size_that_fits_stays() {
        let mut size = PreviewSize::default();
        for _ in 0..9 {
            size.took(60.0, FULL, 320 * 180);
            assert_eq!(size.size(FULL), [320, 180]);
        }
    }

    #[test]
    fn no_side_is_empty() {
        let mut size = PreviewSize::default();
        size.took(1.0e9, [3, 1], 1);
        assert_eq!(size.size([3, 1]), [2, 1]);
    }
}
