//! Rows of the baselines and of brute force.

use super::row::{Cases, Row, Tier};

/// All rows of the baselines and of brute force.
pub(super) const ROWS: &[Row] = &[
    Row::exact("bvh-sah", "bvh", &[("builder", "sah")], Tier::Quick, Cases::All),
    Row::exact("bvh-sah-two", "bvh", &[("builder", "sah"), ("children", "2")], Tier::Full, Cases::All),
    Row::exact("bvh-lbvh", "bvh", &[("builder", "lbvh")], Tier::Quick, Cases::All),
    Row::exact("bvh-lbvh-four", "bvh", &[("builder", "lbvh"), ("children", "4")], Tier::Full, Cases::All),
    Row::exact("bvh-ploc", "bvh", &[("builder", "ploc")], Tier::Quick, Cases::All),
    Row::exact("bvh-ploc-two", "bvh", &[("builder", "ploc"), ("children", "2")], Tier::Full, Cases::All),
    Row::exact("bvh-trbvh", "bvh", &[("builder", "trbvh")], Tier::Quick, Cases::All),
    Row::exact("bvh-trbvh-two", "bvh", &[("builder", "trbvh"), ("children", "2")], Tier::Full, Cases::All),
    // The first build, on every case, merges clusters; only moving scenes have builds that keep the tree.
    Row::exact("bvh-refit", "bvh", &[("builder", "refit")], Tier::Full, Cases::All),
    Row::exact("grid", "grid", &[], Tier::Quick, Cases::All),
    Row::exact("driver-rt", "driver-rt", &[], Tier::Quick, Cases::All),
    Row::exact("driver-rt-build", "driver-rt", &[("goal", "build")], Tier::Full, Cases::All),
    Row::exact("brute-force", "brute-force", &[], Tier::Quick, Cases::All),
];
