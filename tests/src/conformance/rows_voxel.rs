//! Rows of Hu and of the selective variant.

use rasray_systems::Preset;

use super::deviations_voxel;
use super::row::{Cases, Demand, Deviation, Row, Tier, published_law};

const fn voxel_law(resolution: u32) -> Demand {
    Demand::Law { resolution, per_cell: 0.64, depth_tolerance: 1e-3, laws: deviations_voxel::LAWS }
}

const fn voxel(
    name: &'static str,
    (system, preset): (&'static str, Preset),
    options: &'static [(&'static str, &'static str)],
    cases: Cases,
    demand: Demand,
    deviations: &'static [Deviation],
) -> Row {
    Row { name, system, preset, options, tier: Tier::Quick, cases, demand, deviations }
}

/// All rows of Hu and of the selective variant. Rows of published rules have triangle ids instead of
/// attributes, which need a scene.
pub(super) const ROWS: &[Row] = &[
    voxel(
        "hu-centres-16",
        ("hu", Preset::Robust),
        &[("resolution", "16"), ("coverage", "exact")],
        Cases::Deep,
        voxel_law(16),
        deviations_voxel::CENTRES_16,
    ),
    voxel(
        "hu-centres-64",
        ("hu", Preset::Robust),
        &[("resolution", "64"), ("coverage", "exact")],
        Cases::Shallow,
        voxel_law(64),
        deviations_voxel::CENTRES_64,
    ),
    voxel(
        "hu-centres-128",
        ("hu", Preset::Robust),
        &[("resolution", "128"), ("coverage", "exact")],
        Cases::Shallow,
        voxel_law(128),
        deviations_voxel::CENTRES_128,
    ),
    // These rows are as published, except that every cell is visited, with crossings counted where the ray
    // enters and leaves it.
    voxel(
        "hu-published-exact-128",
        ("hu", Preset::Published),
        &[("resolution", "128"), ("payload", "index"), ("march", "exact")],
        Cases::Shallow,
        published_law(128),
        deviations_voxel::PARITY_128,
    ),
    // Every cell keeps each triangle that reaches into it: hits are those of triangles.
    Row::exact("hu-robust-16", "hu", &[("resolution", "16")], Tier::Quick, Cases::Shallow),
    Row::exact("hu-robust-64", "hu", &[("resolution", "64")], Tier::Full, Cases::Shallow),
    Row::exact("selective-robust-32", "selective", &[("resolution", "32")], Tier::Full, Cases::Shallow),
    Row::exact(
        "selective-paged-16",
        "selective",
        &[("resolution", "16"), ("storage", "paged")],
        Tier::Quick,
        Cases::Shallow,
    ),
    voxel(
        "hu-published-16",
        ("hu", Preset::Published),
        &[("resolution", "16"), ("payload", "index")],
        Cases::Deep,
        published_law(16),
        deviations_voxel::HU_16,
    ),
    voxel(
        "hu-published-128",
        ("hu", Preset::Published),
        &[("resolution", "128"), ("payload", "index")],
        Cases::Shallow,
        published_law(128),
        deviations_voxel::HU_128,
    ),
    voxel(
        "selective-centres-16",
        ("selective", Preset::Robust),
        &[("resolution", "16"), ("coverage", "exact"), ("storage", "paged")],
        Cases::Deep,
        voxel_law(16),
        deviations_voxel::CENTRES_16,
    ),
    // Hits equal those of `hu` with fragments alone, bit for bit, and so do laws and deviations.
    Row {
        tier: Tier::Full,
        ..voxel(
            "selective-centres-128",
            ("selective", Preset::Robust),
            &[("resolution", "128"), ("coverage", "exact"), ("storage", "paged")],
            Cases::Shallow,
            voxel_law(128),
            deviations_voxel::CENTRES_128,
        )
    },
    voxel(
        "selective-published-16",
        ("selective", Preset::Published),
        &[("resolution", "16"), ("payload", "index")],
        Cases::Deep,
        published_law(16),
        deviations_voxel::SELECTIVE_16,
    ),
    voxel(
        "selective-published-128",
        ("selective", Preset::Published),
        &[("resolution", "128"), ("payload", "index")],
        Cases::Shallow,
        published_law(128),
        deviations_voxel::SELECTIVE_128,
    ),
];
