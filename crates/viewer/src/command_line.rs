//! Command line that makes a picture again.

use rasray_experiment::{Adaptive, Frame, OccluderKind, Primary, SystemConfig};
use rasray_scene::BackFaces;

/// Quotes a word so that a shell reads it back.
pub fn quoted(word: &str) -> String {
    let plain = |character: char| character.is_ascii_alphanumeric() || "_@%+=:,./-".contains(character);
    if !word.is_empty() && word.chars().all(plain) {
        word.to_owned()
    } else {
        format!("'{}'", word.replace('\'', "'\\''"))
    }
}

/// Returns the words of the command line that make a frame.
pub(crate) fn frame_words(frame: &Frame) -> Vec<String> {
    let Frame { integrator, width, height, spp, adaptive, seed, sampler, primary, occluder, back_faces } =
        frame;
    let mut words = vec![
        "--size".to_owned(),
        format!("{width}x{height}"),
        "--spp".to_owned(),
        spp.to_string(),
        "--integrator".to_owned(),
        integrator.name().to_owned(),
    ];
    for (option, value) in integrator.options().iter() {
        words.extend([format!("--{option}"), value.to_string()]);
    }
    if let Some(Adaptive { threshold, least }) = adaptive {
        words.extend(["--adaptive".to_owned(), threshold.to_string()]);
        words.extend(["--least-samples".to_owned(), least.to_string()]);
    }
    words.extend(["--seed".to_owned(), seed.to_string(), "--sampler".to_owned(), sampler.name().to_owned()]);
    if *primary != Primary::default() {
        words.extend(["--primary".to_owned(), primary.name().to_owned()]);
    }
    if *occluder != OccluderKind::default() {
        words.extend(["--occluder".to_owned(), occluder.name().to_owned()]);
    }
    if let Some(resolution) = occluder.resolution() {
        words.extend(["--shadow-resolution".to_owned(), resolution.to_string()]);
    }
    if let Some(points) = occluder.points() {
        words.extend(["--shadow-points".to_owned(), points.to_string()]);
    }
    if *back_faces != BackFaces::default() {
        words.extend(["--back-faces".to_owned(), back_faces.name().to_owned()]);
    }
    words
}

/// Returns the words of the command line that make a structure.
pub(crate) fn system_words(config: &SystemConfig) -> Vec<String> {
    let mut words = vec![
        "--system".to_owned(),
        config.system.name.to_owned(),
        "--preset".to_owned(),
        config.preset.name().to_owned(),
    ];
    words.extend(config.options.iter().map(|(name, value)| format!("--{name}={value}")));
    words
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::settings::tests::{integrator, some};

    #[test]
    fn words_with_blanks_and_quotes_are_quoted() {
        assert_eq!(quoted("spheres:10k"), "spheres:10k");
        assert_eq!(quoted("my scene.glb"), "'my scene.glb'");
        assert_eq!(quoted("it's"), "'it'\\''s'");
        assert_eq!(quoted(""), "''");
        assert_eq!(quoted("shot.####.png"), "'shot.####.png'");
    }

    #[test]
    fn everything_that_a_picture_depends_on_is_named() {
        let mut settings = some();
        settings.frame.integrator = integrator("ao").with("ao-distance", 0.5).expect("valid");
        let words = frame_words(&settings.frame).join(" ");
        assert_eq!(words, "--size 40x30 --spp 4 --integrator ao --ao-distance 0.5 --seed 1 --sampler sobol");
        let opaque = integrator("path").with("glass-shadows", "opaque").expect("valid");
        settings.frame.integrator = opaque.with("bounces", 2).expect("valid");
        let words = frame_words(&settings.frame).join(" ");
        assert!(words.contains("--integrator path --bounces 2 --glass-shadows opaque "), "{words}");
        settings.frame.back_faces = BackFaces::None;
        let words = frame_words(&settings.frame).join(" ");
        assert!(words.ends_with("--sampler sobol --back-faces none"), "{words}");
        settings.frame.occluder = OccluderKind::ShadowMaps { resolution: 512, points: 4 };
        let words = frame_words(&settings.frame).join(" ");
        assert!(
            words.contains(
                "--sampler sobol --occluder shadow-maps --shadow-resolution 512 --shadow-points 4 "
            ),
            "{words}"
        );
        settings.system.options = settings.system.options.with("grid", 8);
        assert_eq!(system_words(&settings.system).join(" "), "--system bricks --preset robust --grid=8");
    }
}
