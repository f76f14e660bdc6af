//! Whether a finished image shows anything, and what to do if it does not.

use super::ImageFormat;
use crate::backend::RenderOutput;

/// The share of pixels that makes an image black or white.
const NEARLY_ALL: f64 = 0.98;
/// A pixel of a PNG whose channels all stay below this share of white is nearly black.
const DARK: f32 = 0.01;
/// The mean that a suggested exposure gives an image: a middle grey.
const MIDDLE: f64 = 0.18;
/// Exposures that are worth suggesting, stops.
const MOST_STOPS: f64 = 20.0;

/// A sentence where nearly all pixels are black, or in a PNG at this `exposure` (stops) nearly black or white; linear
/// values of an EXR are too bright or too dark for nobody but where nothing is there at all.
pub fn hint(output: &RenderOutput, format: ImageFormat, exposure: f32) -> Option<String> {
    let pixels = output.beauty.len();
    let share = |count: usize| count as f64 / pixels.max(1) as f64;
    let count = |test: &dyn Fn(f32) -> bool| {
        output.beauty.iter().filter(|pixel| pixel.iter().all(|value| test(*value))).count()
    };
    let scale = exposure.exp2();
    let (dark, bright) = match format {
        ImageFormat::Png => (count(&|value| value * scale < DARK), count(&|value| value * scale >= 1.0)),
        ImageFormat::Exr => (count(&|value| value == 0.0), 0),
    };
    let suggested = || {
        let sum: f64 = output.beauty.iter().flatten().map(|value| f64::from(*value)).sum();
        let stops = (MIDDLE * 3.0 * pixels as f64 / sum).log2().round();
        (stops.abs() <= MOST_STOPS && format == ImageFormat::Png).then_some(stops)
    };
    let percent = |count: usize| format!("{:.0} % of the pixels are", 100.0 * share(count));
    if share(dark) >= NEARLY_ALL {
        let expose =
            suggested().map(|stops| format!("--exposure {stops} brightens them; ")).unwrap_or_default();
        return Some(format!(
            "hint: {} nearly black: {expose}--environment 1,1,1 or FILE.hdr lights the scene from outside, and \
             --eye with --target looks from elsewhere",
            percent(dark)
        ));
    }
    if share(bright) >= NEARLY_ALL {
        let expose =
            suggested().map(|stops| format!("--exposure {stops} darkens them; ")).unwrap_or_default();
        return Some(format!(
            "hint: {} white: {expose}a darker --environment, or an .exr, keeps what is in them",
            percent(bright)
        ));
    }
    None
}

#[cfg(test)]
mod tests {
    use super::*;

    fn image(pixels: &[([f32; 3], usize)]) -> RenderOutput {
        let beauty: Vec<_> = pixels.iter().flat_map(|(pixel, count)| vec![*pixel; *count]).collect();
        RenderOutput { width: beauty.len() as u32, height: 1, beauty, ..RenderOutput::default() }
    }

    #[test]
    fn an_image_that_shows_nothing_gets_a_way_out() {
        let png = |output: &RenderOutput, exposure| hint(output, ImageFormat::Png, exposure);
        let dim = image(&[([0.01, 0.005, 0.002], 1), ([0.002; 3], 99)]);
        let text = png(&dim, 0.0).expect("nearly black");
        assert!(
            text.contains("99 %") && text.contains("--exposure 6 ") && text.contains("--environment"),
            "{text}"
        );
        // What it suggests helps.
        assert_eq!(png(&dim, 6.0), None);
        let text = png(&image(&[([0.0; 3], 9)]), 0.0).expect("black");
        assert!(text.contains("100 %") && !text.contains("--exposure"), "no exposure helps: {text}");
        let text = png(&image(&[([8.0; 3], 99), ([0.0; 3], 1)]), 0.0).expect("white");
        assert!(text.contains("white") && text.contains("--exposure -5 "), "{text}");
        // A small thing before nothing, a bright wall, and colours are pictures.
        assert_eq!(png(&image(&[([0.0; 3], 97), ([0.5; 3], 3)]), 0.0), None);
        assert_eq!(png(&image(&[([2.0, 2.0, 0.5], 100)]), 0.0), None);
        assert_eq!(png(&image(&[([f32::NAN; 3], 100)]), 0.0), None);
    }

    #[test]
    fn linear_values_are_left_alone_unless_there_are_none() {
        let exr = |value: f32| hint(&image(&[([value; 3], 10)]), ImageFormat::Exr, 0.0);
        assert_eq!((exr(1.0e-6), exr(50.0)), (None, None));
        let text = exr(0.0).expect("black");
        assert!(!text.contains("--exposure"), "{text}");
    }
}
