//! Levels of a finished image: tells whether it shows anything, and what to do if it does not.

use super::format::ImageFormat;
use rasray_experiment::RenderOutput;
use rasray_metrics::Tone;

/// Mean of a PNG's linear values, clamped to 0 to 1, below which the image is nearly black. Single bright
/// pixels, as noise makes them, do not hide that.
const DARK: f64 = 0.015;
/// Share of the pixels above which the image is white.
const NEARLY_ALL: f64 = 0.98;
/// Mean that a suggested exposure gives an image: a middle grey.
const MIDDLE: f64 = 0.18;
/// Largest exposure that is worth suggesting, stops.
const MOST_STOPS: f64 = 20.0;

/// Returns a sentence if an image is black, or as a PNG in this tone nearly black or white. Linear values of
/// an EXR are too dark only if all are 0, and never too bright.
pub fn hint(output: &RenderOutput, format: ImageFormat, tone: Tone) -> Option<String> {
    let count = output.beauty.len().max(1) as f64;
    let mean = |shown: &dyn Fn([f32; 3]) -> [f32; 3]| {
        let pixels = output.beauty.iter().flat_map(|pixel| shown(*pixel));
        pixels.map(f64::from).sum::<f64>() / (3.0 * count)
    };
    let is_white = |pixel: &&[f32; 3]| tone.shown(**pixel).iter().all(|channel| *channel >= 1.0);
    let linear = mean(&|pixel| pixel);
    let (dark, white) = match format {
        ImageFormat::Png => (
            !linear.is_nan() && mean(&|pixel| tone.shown(pixel)) < DARK,
            output.beauty.iter().filter(is_white).count() as f64 >= NEARLY_ALL * count,
        ),
        ImageFormat::Exr => (linear == 0.0, false),
    };
    let stops = (MIDDLE / linear).log2().round();
    let exposed = |what: &str| {
        let helps = format == ImageFormat::Png && stops.abs() <= MOST_STOPS;
        if helps { format!("--exposure {stops} {what} it; ") } else { String::new() }
    };
    if dark {
        return Some(format!(
            "hint: the image is nearly black: {}--environment 1,1,1 or FILE.hdr lights the scene from outside, and \
             --eye with --target looks from elsewhere",
            exposed("brightens")
        ));
    }
    white.then(|| {
        format!(
            "hint: the image is nearly white: {}a darker --environment, or an .exr, keeps what is in it",
            exposed("darkens")
        )
    })
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
        let png = |output: &RenderOutput, exposure: f32| hint(output, ImageFormat::Png, exposure.into());
        let dim = image(&[([0.01, 0.005, 0.002], 1), ([0.002; 3], 99)]);
        let text = png(&dim, 0.0).expect("nearly black");
        assert!(
            text.contains("black") && text.contains("--exposure 6 ") && text.contains("--environment"),
            "{text}"
        );
        // The advice of the hint helps.
        assert_eq!(png(&dim, 6.0), None);
        let text = png(&image(&[([0.0; 3], 9)]), 0.0).expect("black");
        assert!(text.contains("black") && !text.contains("--exposure"), "no exposure helps: {text}");
        let text = png(&image(&[([8.0; 3], 99), ([0.0; 3], 1)]), 0.0).expect("white");
        assert!(text.contains("white") && text.contains("--exposure -5 "), "{text}");
        // Noise does not make a picture.
        assert!(png(&image(&[([0.0; 3], 995), ([9.0; 3], 5)]), 0.0).is_some());
        // A small thing before nothing, a bright wall, and colours are pictures.
        assert_eq!(png(&image(&[([0.0; 3], 96), ([0.5; 3], 4)]), 0.0), None);
        assert_eq!(png(&image(&[([2.0, 2.0, 0.5], 100)]), 0.0), None);
        assert_eq!(png(&image(&[([f32::NAN; 3], 100)]), 0.0), None);
    }

    #[test]
    fn linear_values_are_left_alone_unless_there_are_none() {
        let exr = |value: f32| hint(&image(&[([value; 3], 10)]), ImageFormat::Exr, Tone::default());
        assert_eq!((exr(1.0e-6), exr(50.0)), (None, None));
        let text = exr(0.0).expect("black");
        assert!(!text.contains("--exposure"), "{text}");
    }
}
