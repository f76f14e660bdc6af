//! Brute force: a test of every triangle for every ray. It is the reference for hits, and always present.

use rasray_ads::{BruteForce, StructureKind};

use crate::{Preset, System};

/// Row of this system in [`SYSTEMS`](crate::SYSTEMS).
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
