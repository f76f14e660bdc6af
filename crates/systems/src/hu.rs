//! Hu et al.: voxels with axis A-buffers, with the paper's presets.

use rasray_voxel::{Config, Payload, Voxels};

use crate::{PaperFrame, Preset, Spec, System, SystemsError, voxel};

/// Number of cells along a side of a view in the paper.
const PUBLISHED_RESOLUTION: u32 = 1280;

/// Row of this system in [`SYSTEMS`](crate::SYSTEMS).
pub(crate) const SYSTEM: System = System {
    name: "hu",
    doc: "Voxels over A-buffers along the three axes",
    structure: "voxel",
    records: Voxels::RECORDS,
    large_pools: &[("resolution", "3500")],
    presets: &[Preset::Robust, Preset::Published],
    frame: Some(PaperFrame::of("whitted", &[("mirror-roughness", "0.3")])),
    without_scene: &[("payload", "index")],
    options: voxel::names,
    requirements: |spec| Ok(Voxels::requirements_of(&config(spec)?)),
    kind: |spec| Ok(Voxels::kind_of(&config(spec)?)),
    create: |spec, device, geometry, scene| {
        Ok(Box::new(Voxels::new(device, config(spec)?, geometry, scene)?))
    },
};

/// Returns the configuration for a spec.
pub(crate) fn config(spec: &Spec) -> Result<Config, SystemsError> {
    let preset = match spec.preset() {
        Preset::Robust => Config::robust(voxel::RESOLUTION),
        Preset::Published => voxel::of_the_paper(spec, Config::published_hu(PUBLISHED_RESOLUTION)),
    };
    voxel::config(spec, preset, Payload::Material)
}
