//! Rows of the layered depth cube.

use rasray_systems::Preset;

use super::deviations_ldc;
use super::row::{Cases, Demand, Deviation, Row, Tier, published_law};

const fn ldc_law(resolution: u32) -> Demand {
    Demand::Law { resolution, per_cell: 0.64, depth_tolerance: 1e-3, laws: deviations_ldc::PLANES_LAWS }
}

const fn ldc(
    name: &'static str,
    preset: Preset,
    options: &'static [(&'static str, &'static str)],
    cases: Cases,
    demand: Demand,
    deviations: &'static [Deviation],
) -> Row {
    Row { name, system: "ldc", preset, options, tier: Tier::Quick, cases, demand, deviations }
}

/// Options for planes of fragments in place of triangles.
const PLANES_16: &[(&str, &str)] = &[("resolution", "16"), ("accept", "plane")];
const PLANES_64: &[(&str, &str)] = &[("resolution", "64"), ("accept", "plane")];
const PLANES_256: &[(&str, &str)] = &[("resolution", "256"), ("accept", "plane")];

/// All rows of the layered depth cube.
pub(super) const ROWS: &[Row] = &[
    ldc("ldc-planes-16", Preset::Robust, PLANES_16, Cases::Deep, ldc_law(16), &[]),
    ldc("ldc-planes-64", Preset::Robust, PLANES_64, Cases::Shallow, ldc_law(64), &[]),
    Row {
        tier: Tier::Full,
        ..ldc("ldc-planes-256", Preset::Robust, PLANES_256, Cases::Shallow, ldc_law(256), &[])
    },
    // Triangles are stored in every cell that they reach into, and only triangles are hit.
    Row::exact("ldc-robust-16", "ldc", &[("resolution", "16")], Tier::Quick, Cases::Shallow),
    Row::exact("ldc-robust-64", "ldc", &[("resolution", "64")], Tier::Full, Cases::Shallow),
    // Fragments are hit at their own depth, plus or minus the rise of their triangles over half a cell.
    ldc(
        "ldc-slope-64",
        Preset::Robust,
        &[("resolution", "64"), ("accept", "slope")],
        Cases::Shallow,
        published_law(64),
        deviations_ldc::SLOPE_64,
    ),
    // Rows use triangle ids instead of attributes, which need a scene.
    ldc(
        "ldc-published-16",
        Preset::Published,
        &[("resolution", "16"), ("payload", "index")],
        Cases::Deep,
        published_law(16),
        deviations_ldc::PUBLISHED_16,
    ),
    ldc(
        "ldc-published-64",
        Preset::Published,
        &[("resolution", "64"), ("payload", "index")],
        Cases::Shallow,
        published_law(64),
        deviations_ldc::PUBLISHED_64,
    ),
];
