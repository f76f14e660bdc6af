//! Rows of MMRT.

use rasray_systems::Preset;

use super::deviations;
use super::row::{Cases, Demand, Deviation, Row, Tier, published_law};

const fn robust_law(resolution: u32) -> Demand {
    // One ray in a hundred at 64 cells along a side.
    Demand::Law { resolution, per_cell: 0.64, depth_tolerance: 1e-3, laws: deviations::ROBUST_LAWS }
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

/// All of them.
pub(super) const ROWS: &[Row] = &[
    mmrt(
        "mmrt-robust-16",
        Preset::Robust,
        &[("resolution", "16")],
        Cases::Deep,
        robust_law(16),
        deviations::ROBUST_16,
    ),
    mmrt(
        "mmrt-robust-64",
        Preset::Robust,
        &[("resolution", "64")],
        Cases::Shallow,
        robust_law(64),
        deviations::ROBUST_64,
    ),
    mmrt(
        "mmrt-robust-128",
        Preset::Robust,
        &[("resolution", "128")],
        Cases::Shallow,
        robust_law(128),
        deviations::ROBUST_128,
    ),
    Row {
        tier: Tier::Full,
        ..mmrt(
            "mmrt-robust-256",
            Preset::Robust,
            &[("resolution", "256")],
            Cases::Shallow,
            robust_law(256),
            deviations::ROBUST_256,
        )
    },
    // The cube's cells and finer ones of the camera, which looks away from the axes; then the camera alone.
    Row {
        tier: Tier::Full,
        ..mmrt(
            "mmrt-cube-camera-64",
            Preset::Robust,
            &[("resolution", "64"), ("views", "cube+camera"), ("camera-resolution", "128")],
            Cases::Shallow,
            robust_law(64),
            deviations::CUBE_CAMERA_64,
        )
    },
    mmrt(
        "mmrt-camera-64",
        Preset::Robust,
        &[("resolution", "64"), ("views", "camera")],
        Cases::Shallow,
        robust_law(64),
        deviations::CAMERA_64,
    ),
    // Planes, and in addition the triangles that are lost or seen edge-on.
    Row {
        tier: Tier::Full,
        ..mmrt(
            "mmrt-edge-on-64",
            Preset::Robust,
            &[("resolution", "64"), ("coverage", "edge-on")],
            Cases::Shallow,
            robust_law(64),
            deviations::EDGE_ON_64,
        )
    },
    // Planes that fragments carry themselves, which do not end where their triangles do.
    Row {
        tier: Tier::Full,
        ..mmrt(
            "mmrt-planes-64",
            Preset::Robust,
            &[("resolution", "64"), ("payload", "plane")],
            Cases::Shallow,
            robust_law(64),
            deviations::PLANES_64,
        )
    },
    // What reaches into a cell is kept there: hits are those of triangles.
    Row::exact(
        "mmrt-conservative-16",
        "mmrt",
        &[("resolution", "16"), ("coverage", "conservative")],
        Tier::Quick,
        Cases::All,
    ),
    Row::exact(
        "mmrt-conservative-64",
        "mmrt",
        &[("resolution", "64"), ("coverage", "conservative"), ("march", "pyramid")],
        Tier::Full,
        Cases::Shallow,
    ),
    Row::exact(
        "mmrt-conservative-cube-camera-32",
        "mmrt",
        &[
            ("resolution", "32"),
            ("coverage", "conservative"),
            ("views", "cube+camera"),
            ("camera-resolution", "48"),
            ("storage", "sb"),
        ],
        Tier::Full,
        Cases::Shallow,
    ),
    // Triangle ids instead of attributes, which need a scene.
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
