use crate::image::Image;

/// Linear light to values as shown: exposure 1, clamped to [0, 1], sRGB transfer curve. NaN becomes 0.
/// Metrics of perception (PSNR, SSIM, FLIP) are defined on these.
pub fn display_values(image: &Image<'_>) -> Vec<[f32; 3]> {
    image.pixels().iter().map(|pixel| pixel.map(encode)).collect()
}

/// Three bytes per pixel: colours times 2^`exposure` stops, clamped to [0, 1], on the sRGB curve, rounded to the nearest
/// step. NaN becomes 0.
pub fn tone_map(linear: &[[f32; 3]], exposure: f32) -> Vec<u8> {
    let scale = exposure.exp2();
    linear.iter().flatten().map(|value| (encode(value * scale) * 255.0 + 0.5) as u8).collect()
}

fn encode(linear: f32) -> f32 {
    let x = if linear.is_nan() { 0.0 } else { linear.clamp(0.0, 1.0) };
    if x <= 0.003_130_8 { 12.92 * x } else { 1.055 * x.powf(1.0 / 2.4) - 0.055 }
}

#[cfg(test)]
mod tests {
    use approx::assert_abs_diff_eq;

    use super::*;

    #[test]
    fn ends_knee_and_middle() {
        assert_eq!([-1.0, 0.0, f32::NAN].map(encode), [0.0; 3]);
        assert!([1.0, 7.0, f32::INFINITY].iter().all(|x| (encode(*x) - 1.0).abs() < 1e-6));
        assert_abs_diff_eq!(encode(0.003_130_8), 0.040_45, epsilon = 1e-5);
        assert_abs_diff_eq!(encode(0.214_041), 0.5, epsilon = 1e-5);
    }

    #[test]
    fn the_curve_is_srgb() {
        let values = [[f32::NAN, -1.0, 0.0], [0.002, 0.214_041_14, 0.5], [1.0, 2.0, f32::INFINITY]];
        assert_eq!(tone_map(&values, 0.0), [0, 0, 0, 7, 128, 188, 255, 255, 255]);
    }

    #[test]
    fn a_stop_doubles() {
        assert_eq!(tone_map(&[[0.25, 0.1, 0.3]], 1.0), tone_map(&[[0.5, 0.2, 0.6]], 0.0));
        assert_eq!(tone_map(&[[0.5; 3]], -1.0), tone_map(&[[0.25; 3]], 0.0));
    }
}
