use crate::error::MetricsError;
use crate::image::{Image, check};
use crate::statistics::percentile;
use crate::tone::display_values;
use nv_flip::{DEFAULT_PIXELS_PER_DEGREE, FlipImageRgb8};

/// Perceptual difference when flipping between two images (Andersson et al. 2020), for a viewer who
/// sees 67 pixels in a degree. Per pixel 0 is no difference and 1 the greatest.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Flip {
    /// Mean over all pixels.
    pub mean: f64,
    /// 99th percentile of the pixels.
    pub p99: f64,
    /// Value of the worst pixel.
    pub max: f64,
    /// Share of the pixels above [`VISIBLE`].
    pub visible: f64,
}

/// Value from which on a pixel differs visibly. The authors of FLIP give no threshold: this one is a tenth of
/// the difference of black and white.
pub const VISIBLE: f32 = 0.1;

/// Computes the variant for low dynamic range (LDR-FLIP) of displayed values (exposure 1, clamped, sRGB) in 8
/// bits per channel. Values above 1 are white for it; HDR-FLIP, which compares several exposures, is not
/// computed here.
///
/// # Errors
/// An error if the sizes differ, a pixel of the reference is not finite, or the image has more than 2^29
/// pixels.
pub fn flip(test: &Image<'_>, reference: &Image<'_>) -> Result<Flip, MetricsError> {
    Ok(Flip::of(&flip_map(test, reference)?))
}

/// Computes the values that [`flip`] summarises: one in [0, 1] for each pixel, in row order.
///
/// # Errors
/// Errors of [`flip`].
pub fn flip_map(test: &Image<'_>, reference: &Image<'_>) -> Result<Vec<f32>, MetricsError> {
    check(test, reference)?;
    Ok(nv_flip::flip(quantize(reference)?, quantize(test)?, DEFAULT_PIXELS_PER_DEGREE).to_vec())
}

impl Flip {
    /// Summarises the values of pixels, as [`flip_map`] gives them; NaN if there are none.
    pub fn of(map: &[f32]) -> Self {
        let values: Vec<f64> = map.iter().copied().map(f64::from).collect();
        Self {
            mean: values.iter().sum::<f64>() / values.len() as f64,
            p99: percentile(&values, 0.99).unwrap_or(f64::NAN),
            max: percentile(&values, 1.0).unwrap_or(f64::NAN),
            visible: map.iter().filter(|value| **value > VISIBLE).count() as f64 / map.len() as f64,
        }
    }
}

fn quantize(image: &Image<'_>) -> Result<FlipImageRgb8, MetricsError> {
    let size = image.size();
    // The library multiplies width, height and channels in 32 bits.
    if size[0] * size[1] > 1 << 29 {
        return Err(MetricsError::TooLarge { size });
    }
    let bytes: Vec<u8> =
        display_values(image).as_flattened().iter().map(|value| (value * 255.0).round() as u8).collect();
    Ok(FlipImageRgb8::with_data(size[0] as u32, size[1] as u32, &bytes))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn measure(test: &[[f32; 3]], reference: &[[f32; 3]]) -> Flip {
        let [test, reference] = [test, reference].map(|p| Image::new(32, 32, p).expect("sizes fit"));
        flip(&test, &reference).expect("comparable")
    }

    #[test]
    fn opposite_images_differ_more_than_similar_ones() {
        let [black, dark, white] = [0.0, 0.02, 1.0].map(|value| vec![[value; 3]; 32 * 32]);
        let (near, far) = (measure(&dark, &black), measure(&white, &black));
        assert_eq!(measure(&dark, &dark), Flip { mean: 0.0, p99: 0.0, max: 0.0, visible: 0.0 });
        assert!(near.mean > 0.01 && near.mean < far.mean, "{near:?} {far:?}");
        assert!(far.mean > 0.9 && far.max <= 1.0, "{far:?}");
    }

    #[test]
    fn one_spot_moves_the_maximum_and_hardly_the_mean() {
        let grey = vec![[0.2; 3]; 32 * 32];
        let mut spot = grey.clone();
        spot[16 * 32 + 16] = [1.0, 0.1, 0.1];
        let error = measure(&spot, &grey);
        assert!(error.max > 0.2 && error.mean < 0.05 && error.p99 <= error.max, "{error:?}");
        // The map shows the place: the worst pixel is the spot, and the far corner has no difference.
        let [test, reference] = [&spot, &grey].map(|p| Image::new(32, 32, p).expect("sizes fit"));
        let map = flip_map(&test, &reference).expect("comparable");
        assert_eq!(Flip::of(&map), error);
        assert_eq!(f64::from(map[16 * 32 + 16]), error.max);
        let count = map.iter().filter(|value| **value > VISIBLE).count();
        assert!((1..100).contains(&count), "{count}");
        assert_eq!(error.visible, count as f64 / map.len() as f64);
        assert!(map[0] < 1e-3, "{}", map[0]);
    }
}
