//! Every triangle for every ray: the reference for hits, always present.

use rasray_ads::{BruteForce, StructureKind};

use crate::{Preset, System};

/// The registry's row.
pub(crate) const SYSTEM: System = System {
    name: "brute-force",
    doc: "Every triangle tested against every ray: the reference for hits, slow on purpose",
    structure: "brute-force",
    records: &[],
    large_pools: &[],
    presets: &[Preset::Robust],
    frame: None,
    without_scene: &[],
    options: Vec::new,
    requirements: |_| Ok(BruteForce::requirements_of()),
    kind: |_| Ok(StructureKind::Primitive),
    create: |spec, device, geometry, scene| {
        Ok(Box::new(BruteForce::new(device, geometry, scene, spec.counters())?))
    },
};
