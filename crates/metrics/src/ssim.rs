use crate::error::MetricsError;
use crate::image::{Image, check};
use crate::tone::display_values;

/// Radius of the window: 11 x 11.
const RADIUS: usize = 5;
const SIGMA: f64 = 1.5;
const C1: f64 = 0.01 * 0.01;
const C2: f64 = 0.03 * 0.03;

/// Computes the mean structural similarity (Wang et al. 2004) of the luma of displayed values, over all
/// pixels.
///
/// The window is Gaussian of 11 x 11 with sigma 1.5, the constants are 0.01^2 and 0.03^2. If the window
/// leaves the image, the weights inside are scaled to sum to one.
///
/// # Errors
/// An error if the sizes differ or a pixel of the reference is not finite.
pub fn ssim(test: &Image<'_>, reference: &Image<'_>) -> Result<f64, MetricsError> {
    check(test, reference)?;
    let [width, height] = test.size();
    let blur = |plane: &[f64]| blur(plane, width, height);
    let (x, y) = (luma(test), luma(reference));
    let products = |a: &[f64], b: &[f64]| -> Vec<f64> { a.iter().zip(b).map(|(a, b)| a * b).collect() };
    let (mean_x, mean_y) = (blur(&x), blur(&y));
    let [xx, yy, xy] = [products(&x, &x), products(&y, &y), products(&x, &y)].map(|plane| blur(&plane));
    let similarity = |i: usize| {
        let (mx, my) = (mean_x[i], mean_y[i]);
        let (variance_x, variance_y, covariance) = (xx[i] - mx * mx, yy[i] - my * my, xy[i] - mx * my);
        (2.0 * mx * my + C1) * (2.0 * covariance + C2)
            / ((mx * mx + my * my + C1) * (variance_x + variance_y + C2))
    };
    Ok((0..x.len()).map(similarity).sum::<f64>() / x.len() as f64)
}

fn luma(image: &Image<'_>) -> Vec<f64> {
    let weigh = |[r, g, b]: [f32; 3]| 0.2126 * f64::from(r) + 0.7152 * f64::from(g) + 0.0722 * f64::from(b);
    display_values(image).into_iter().map(weigh).collect()
}

/// Applies both passes of the window.
fn blur(plane: &[f64], width: usize, height: usize) -> Vec<f64> {
    let columns = blur_along(plane, width, 1, width);
    blur_along(&columns, height, width, width)
}

/// Blurs along an axis of `length` samples that lie `stride` apart.
fn blur_along(plane: &[f64], length: usize, stride: usize, width: usize) -> Vec<f64> {
    let weights: [f64; RADIUS + 1] =
        std::array::from_fn(|distance| (-((distance * distance) as f64) / (2.0 * SIGMA * SIGMA)).exp());
    (0..plane.len())
        .map(|index| {
            let place = if stride == 1 { index % width } else { index / width };
            let start = index - place * stride;
            let (mut sum, mut total) = (0.0, 0.0);
            for other in place.saturating_sub(RADIUS)..=(place + RADIUS).min(length - 1) {
                let weight = weights[other.abs_diff(place)];
                sum += weight * plane[start + other * stride];
                total += weight;
            }
            sum / total
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use approx::assert_abs_diff_eq;

    use super::*;

    fn grey(value: f32, count: usize) -> Vec<[f32; 3]> {
        vec![[value; 3]; count]
    }

    #[test]
    fn flat_images_have_a_closed_form() {
        let (a, b) = (grey(1.0, 200), grey(0.0, 200));
        let [a, b] = [&a, &b].map(|pixels| Image::new(20, 10, pixels).expect("sizes fit"));
        // White against black gives C1 / (1 + C1), and no variance at all.
        let value = ssim(&a, &b).expect("comparable");
        assert_abs_diff_eq!(value, C1 / (1.0 + C1), epsilon = 1e-7);
    }

    #[test]
    fn an_inverted_pattern_is_anticorrelated() {
        let pattern: Vec<[f32; 3]> = (0..400).map(|i| [((i % 20 + i / 20) % 2) as f32; 3]).collect();
        let inverse: Vec<[f32; 3]> = pattern.iter().map(|[x, ..]| [1.0 - x; 3]).collect();
        let [a, b] = [&pattern, &inverse].map(|pixels| Image::new(20, 20, pixels).expect("sizes fit"));
        assert!(ssim(&a, &b).expect("comparable") < -0.9);
        assert_abs_diff_eq!(ssim(&a, &a).expect("comparable"), 1.0, epsilon = 1e-12);
    }

    #[test]
    fn the_window_works_along_both_axes_and_at_borders() {
        // A blur with weights that sum to one keeps a plane's values where the window is symmetric.
        let (width, height) = (23, 17);
        let plane: Vec<f64> =
            (0..width * height).map(|i| (i % width) as f64 + 3.0 * (i / width) as f64).collect();
        let blurred = blur(&plane, width, height);
        for y in RADIUS..height - RADIUS {
            for x in RADIUS..width - RADIUS {
                assert_abs_diff_eq!(blurred[y * width + x], plane[y * width + x], epsilon = 1e-12);
            }
        }
        assert!(blur(&[2.0; 3], 3, 1).iter().all(|x| (x - 2.0).abs() < 1e-15));
    }
}
