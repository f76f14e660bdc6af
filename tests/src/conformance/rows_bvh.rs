//! Rows of the yardstick and of the judge.

use rasray_systems::Preset;

use super::row::{Cases, Demand, ROUNDING, Row, Tier};

const fn bvh(name: &'static str, builder: &'static [(&'static str, &'static str)]) -> Row {
    Row {
        name,
        system: "bvh",
        preset: Preset::Robust,
        options: builder,
        tier: Tier::Quick,
        cases: Cases::All,
        demand: Demand::Exact { rounding: ROUNDING },
        deviations: &[],
    }
}

/// All of them.
pub(super) const ROWS: &[Row] = &[
    bvh("bvh-sah", &[("builder", "sah")]),
    bvh("bvh-lbvh", &[("builder", "lbvh")]),
    Row {
        name: "brute-force",
        system: "brute-force",
        preset: Preset::Robust,
        options: &[],
        tier: Tier::Quick,
        cases: Cases::All,
        demand: Demand::Exact { rounding: ROUNDING },
        deviations: &[],
    },
];
