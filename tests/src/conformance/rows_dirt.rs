//! Rows of DIRT.

use rasray_systems::Preset;

use super::deviations_dirt;
use super::row::{Cases, Demand, Deviation, Row, Tier};
use rasray_experiment::HIT_ROUNDING;

const fn published(
    name: &'static str,
    options: &'static [(&'static str, &'static str)],
    deviations: &'static [Deviation],
) -> Row {
    let demand = Demand::Loss { share: deviations_dirt::SHARE, rounding: HIT_ROUNDING };
    let (preset, tier, cases) = (Preset::Published, Tier::Quick, Cases::Shallow);
    Row { name, system: "dirt", preset, options, tier, cases, demand, deviations }
}

/// All rows of DIRT.
pub(super) const ROWS: &[Row] = &[
    // This row has 16 coarse tiles along a side, few buckets and linked lists.
    Row::exact(
        "dirt-lists-16",
        "dirt",
        &[("resolution", "64"), ("tile", "4"), ("buckets", "4"), ("storage", "llb")],
        Tier::Quick,
        Cases::All,
    ),
    Row::exact("dirt-lists-128", "dirt", &[("storage", "sb")], Tier::Full, Cases::Shallow),
    // These rows have the least tiles and buckets that the paper advises, and those of its second table; few
    // tiles if lists are deep.
    Row {
        cases: Cases::Deep,
        ..published(
            "dirt-published-16",
            &[("resolution", "32"), ("buckets", "8")],
            deviations_dirt::PUBLISHED_16,
        )
    },
    published("dirt-published-64", &[("resolution", "128"), ("buckets", "8")], deviations_dirt::PUBLISHED),
    Row {
        tier: Tier::Full,
        ..published(
            "dirt-published-hardware-128",
            &[("resolution", "128"), ("tile", "1"), ("buckets", "4"), ("coverage", "hardware")],
            deviations_dirt::HARDWARE,
        )
    },
];
