//! Hu et al.: voxels with axis A-buffers, with the paper's presets.

use rasray_voxel::{Config, Payload, Voxels};

use crate::{Preset, Spec, System, SystemsError, voxel};

/// The registry's row.
pub(crate) const SYSTEM: System = System {
    name: "hu",
    structure: "voxel",
    presets: &[Preset::Robust, Preset::Published],
    options: &voxel::OPTIONS,
    requirements: |spec| Ok(Voxels::requirements_of(&config(spec)?)),
    create: |spec, device, geometry, scene| {
        Ok(Box::new(Voxels::new(device, config(spec)?, geometry, scene)?))
    },
};

/// The configuration that a spec stands for.
fn config(spec: &Spec) -> Result<Config, SystemsError> {
    let preset = match spec.preset() {
        Preset::Robust => Config::robust(voxel::RESOLUTION),
        Preset::Published => Config::published_hu(voxel::RESOLUTION),
    };
    voxel::config(spec, preset, Payload::Material)
}
