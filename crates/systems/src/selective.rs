//! Selective reflections: voxels first, then each fragment in one of the axis A-buffers, with the paper's
//! presets.

use rasray_voxel::{Config, Payload, Voxels};

use crate::{PaperFrame, Preset, Spec, System, SystemsError, voxel};

/// Cells along a side of a view in the paper.
const PUBLISHED_RESOLUTION: u32 = 1024;

/// The registry's row.
pub(crate) const SYSTEM: System = System {
    name: "selective",
    doc: "Voxels over A-buffers along the three axes: voxels are found first, and each fragment is in one A-buffer",
    structure: "voxel",
    records: Voxels::RECORDS,
    large_pools: &[("resolution", "3500")],
    presets: &[Preset::Robust, Preset::Published],
    frame: Some(PaperFrame::of(
        "whitted",
        &[("select", "reflective"), ("ray-depth", "1"), ("shadows", "none"), ("mirror-roughness", "0.3")],
    )),
    without_scene: &[("payload", "index")],
    options: voxel::names,
    requirements: |spec| Ok(Voxels::requirements_of(&config(spec)?)),
    kind: |spec| Ok(Voxels::kind_of(&config(spec)?)),
    create: |spec, device, geometry, scene| {
        Ok(Box::new(Voxels::new(device, config(spec)?, geometry, scene)?))
    },
};

/// The configuration that a spec stands for.
pub(crate) fn config(spec: &Spec) -> Result<Config, SystemsError> {
    let preset = match spec.preset() {
        // Lists are sorted, which pages are not: rays read what is at their own depths alone.
        Preset::Robust => Config::robust(voxel::RESOLUTION),
        Preset::Published => voxel::of_the_paper(spec, Config::published_selective(PUBLISHED_RESOLUTION)),
    };
    voxel::config(spec, preset, Payload::Mirror)
}
