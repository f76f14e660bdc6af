//! Structures that follow scene and camera.

use rasray_ads::StructureKind;
use rasray_experiment::{Built, DeviceScene, ExperimentError, OptionValues, SystemConfig};
use rasray_gpu::Device;
use rasray_scene::needs::Needs;
use rasray_systems::{Preset, SYSTEMS};

/// Structure with the configuration that it was built for.
pub(crate) struct Traced {
    pub(crate) config: SystemConfig,
    pub(crate) built: Built,
    /// Time of the scene at the build, seconds; absent at rest.
    seconds: Option<f64>,
}

/// Returns a configuration whose hits are exact and whose system is not the one that is shown.
pub(crate) fn exact_config(shown: &SystemConfig) -> SystemConfig {
    let is_exact = |config: &SystemConfig| {
        config.spec().and_then(|spec| Ok(spec.kind()?)).is_ok_and(|kind| kind == StructureKind::Primitive)
    };
    let robust = |system| SystemConfig::new(system, Preset::Robust, OptionValues::default());
    let others = SYSTEMS.iter().filter(|system| *system != shown.system).map(robust);
    others.into_iter().find(is_exact).unwrap_or_else(|| shown.clone())
}

/// Makes the structure of a configuration for the scene at a time and its camera, unless it exists. Builds it
/// anew if the scene has moved, or if the camera has moved and the structure depends on it. A structure whose
/// build fails is dropped.
pub(crate) fn follow(
    device: &Device,
    stage: Option<&(DeviceScene, Needs)>,
    seconds: Option<f64>,
    traced: &mut Option<Traced>,
    config: &SystemConfig,
    say: &mut dyn FnMut(&str),
) -> Result<(), ExperimentError> {
    let Some((stage, _)) = stage else { return Ok(()) };
    match traced.take() {
        Some(mut kept) if kept.config == *config => {
            kept.built.follow(device, &stage.scene, &[kept.seconds != seconds])?;
            kept.seconds = seconds;
            *traced = Some(kept);
        }
        _ => {
            say("building the structure");
            let built = Built::new(device, &config.spec()?, &stage.scene, stage.scene.eye())?;
            *traced = Some(Traced { config: config.clone(), built, seconds });
        }
    }
    Ok(())
}
