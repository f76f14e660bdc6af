//! Rows of MMRT.

use rasray_systems::Preset;

use super::deviations;
use super::row::{Cases, Demand, Deviation, Row, Tier, published_law};

const fn centres_law(resolution: u32) -> Demand {
    // The law allows one ray in a hundred at 64 cells along a side.
    Demand::Law { resolution, per_cell: 0.64, depth_tolerance: 1e-3, laws: deviations::CENTRES_LAWS }
}

const fn mmrt(
    name: &'static str,
    preset: Preset,
    options: &'static [(&'static str, &'static str)],
    cases: Cases,
    demand: Demand,
    deviations: &'static [Deviation],
) -> Row {
    Row { name, system: "mmrt", preset, options, tier: Tier::Quick, cases, demand, deviations }
}

/// All rows of MMRT.
pub(super) const ROWS: &[Row] = &[
    mmrt(
        "mmrt-centres-16",
        Preset::Robust,
        &[("resolution", "16"), ("coverage", "exact")],
        Cases::Deep,
        centres_law(16),
        deviations::CENTRES_16,
    ),
    mmrt(
        "mmrt-centres-64",
        Preset::Robust,
        &[("resolution", "64"), ("coverage", "exact")],
        Cases::Shallow,
        centres_law(64),
        deviations::CENTRES_64,
    ),
    mmrt(
        "mmrt-centres-128",
        Preset::Robust,
        &[("resolution", "128"), ("coverage", "exact")],
        Cases::Shallow,
        centres_law(128),
        deviations::CENTRES_128,
    ),
    Row {
        tier: Tier::Full,
        ..mmrt(
            "mmrt-centres-256",
            Preset::Robust,
            &[("resolution", "256"), ("coverage", "exact")],
            Cases::Shallow,
            centres_law(256),
            deviations::CENTRES_256,
        )
    },
    // These rows have the cube's cells and finer ones of the camera, which looks away from the axes; then the
    // camera alone.
    Row {
        tier: Tier::Full,
        ..mmrt(
            "mmrt-cube-camera-64",
            Preset::Robust,
            &[
                ("resolution", "64"),
                ("coverage", "exact"),
                ("views", "cube+camera"),
                ("camera-resolution", "128"),
            ],
            Cases::Shallow,
            centres_law(64),
            deviations::CUBE_CAMERA_64,
        )
    },
    mmrt(
        "mmrt-camera-64",
        Preset::Robust,
        &[("resolution", "64"), ("coverage", "exact"), ("views", "camera")],
        Cases::Shallow,
        centres_law(64),
        deviations::CAMERA_64,
    ),
    // This row has planes, and in addition the triangles that are lost or seen edge-on.
    Row {
        tier: Tier::Full,
        ..mmrt(
            "mmrt-edge-on-64",
            Preset::Robust,
            &[("resolution", "64"), ("coverage", "edge-on")],
            Cases::Shallow,
            centres_law(64),
            deviations::EDGE_ON_64,
        )
    },
    // This row has planes that fragments carry themselves, which do not end where their triangles end.
    Row {
        tier: Tier::Full,
        ..mmrt(
            "mmrt-planes-64",
            Preset::Robust,
            &[("resolution", "64"), ("payload", "plane")],
            Cases::Shallow,
            centres_law(64),
            deviations::PLANES_64,
        )
    },
    // Every cell keeps each triangle that reaches into it: hits are those of triangles.
    Row::exact("mmrt-robust-16", "mmrt", &[("resolution", "16")], Tier::Quick, Cases::All),
    Row::exact("mmrt-robust-64", "mmrt", &[("resolution", "64")], Tier::Full, Cases::Shallow),
    Row::exact(
        "mmrt-robust-cells-16",
        "mmrt",
        &[("resolution", "16"), ("march", "exact"), ("storage", "dllb")],
        Tier::Full,
        Cases::All,
    ),
    Row::exact(
        "mmrt-robust-cube-camera-32",
        "mmrt",
        &[("resolution", "32"), ("views", "cube+camera"), ("camera-resolution", "48"), ("storage", "sb")],
        Tier::Full,
        Cases::Shallow,
    ),
    // Rows use triangle ids instead of attributes, which need a scene.
    mmrt(
        "mmrt-published-16",
        Preset::Published,
        &[("resolution", "16"), ("payload", "index")],
        Cases::Deep,
        published_law(16),
        deviations::PUBLISHED_16,
    ),
    mmrt(
        "mmrt-published-128",
        Preset::Published,
        &[("resolution", "128"), ("payload", "index")],
        Cases::Shallow,
        published_law(128),
        deviations::PUBLISHED_128,
    ),
];
