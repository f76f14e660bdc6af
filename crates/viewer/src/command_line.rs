//! The command line that makes a picture again.

use rasray_experiment::{Frame, GlassShadows, Integrator, Primary, SystemConfig};
use rasray_scene::{BackFaces, ShadowTerminator};

/// A word as a shell reads it back.
pub fn quoted(word: &str) -> String {
    let plain = |character: char| character.is_ascii_alphanumeric() || "_@%+=:,./-".contains(character);
    if !word.is_empty() && word.chars().all(plain) {
        word.to_owned()
    } else {
        format!("'{}'", word.replace('\'', "'\\''"))
    }
}

/// The words that make a frame.
pub(crate) fn frame_words(frame: &Frame) -> Vec<String> {
    let Frame { integrator, width, height, spp, seed, sampler, primary, back_faces, shadow_terminator } =
        frame;
    let mut words = vec![
        "--size".to_owned(),
        format!("{width}x{height}"),
        "--spp".to_owned(),
        spp.to_string(),
        "--integrator".to_owned(),
        integrator.name().to_owned(),
    ];
    match integrator {
        Integrator::Path { bounces, glass_shadows } => {
            words.extend(["--bounces".to_owned(), bounces.to_string()]);
            if *glass_shadows != GlassShadows::default() {
                words.extend(["--glass-shadows".to_owned(), glass_shadows.name().to_owned()]);
            }
        }
        Integrator::AmbientOcclusion { distance: Some(metres) } => {
            words.extend(["--ao-distance".to_owned(), metres.to_string()]);
        }
        Integrator::AmbientOcclusion { distance: None } | Integrator::Raycast => (),
    }
    words.extend(["--seed".to_owned(), seed.to_string(), "--sampler".to_owned(), sampler.name().to_owned()]);
    if *primary != Primary::default() {
        words.extend(["--primary".to_owned(), primary.name().to_owned()]);
    }
    if *back_faces != BackFaces::default() {
        words.extend(["--back-faces".to_owned(), back_faces.name().to_owned()]);
    }
    if *shadow_terminator != ShadowTerminator::default() {
        words.extend(["--shadow-terminator".to_owned(), shadow_terminator.name().to_owned()]);
    }
    words
}

/// The words that make a structure.
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
    use crate::settings::tests::some;

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
        settings.frame.integrator = Integrator::AmbientOcclusion { distance: Some(0.5) };
        let words = frame_words(&settings.frame).join(" ");
        assert_eq!(words, "--size 40x30 --spp 4 --integrator ao --ao-distance 0.5 --seed 1 --sampler sobol");
        settings.frame.integrator = Integrator::Path { bounces: 2, glass_shadows: GlassShadows::Opaque };
        let words = frame_words(&settings.frame).join(" ");
        assert!(words.contains("--integrator path --bounces 2 --glass-shadows opaque "), "{words}");
        settings.frame.back_faces = BackFaces::None;
        let words = frame_words(&settings.frame).join(" ");
        assert!(words.ends_with("--sampler sobol --back-faces none"), "{words}");
        settings.system.options = settings.system.options.with("grid", 8);
        assert_eq!(system_words(&settings.system).join(" "), "--system bricks --preset robust --grid=8");
    }
}
