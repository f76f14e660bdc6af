use rasray_abuffer::{ABuffer, Accept, Config, Coverage, March};
use rasray_ads::{BruteForce, Geometry, Structure};

use super::deviations;
use crate::harness::Bench;

/// What is demanded of a row.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Demand {
    /// Every unambiguous ray finds its triangle at a t within the oracle's bounds of rounding, give or
    /// take `rounding` (relative); ambiguous rays get an admissible answer.
    Exact {
        /// Relative to t.
        rounding: f64,
    },
    /// The share of missed, false and (by `depth_tolerance`) wrong hits falls with the size of a cell: it is at
    /// most `per_cell / resolution`, or what `laws` says for the case.
    Law {
        /// Cells a side of a face.
        resolution: u32,
        /// Of the unambiguous rays, times the resolution.
        per_cell: f64,
        /// |dt| / t that counts as right.
        depth_tolerance: f64,
        /// Cases with a factor of their own.
        laws: &'static [Law],
    },
}

/// A case whose errors fall with the size of a cell as well, from a higher start.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Law {
    /// Id of the case.
    pub case: &'static str,
    /// Why it has more errors than others.
    pub reason: &'static str,
    /// The error rate is at most this over the resolution.
    pub per_cell: f64,
}

/// A case on which a row does not meet its demand.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Deviation {
    /// Id of the case.
    pub case: &'static str,
    /// Why.
    pub reason: &'static str,
    /// The error rate is at least this: less is an unexpected pass.
    pub at_least_rate: f64,
    /// The error rate is at most this.
    pub at_most_rate: f64,
}

/// Which cases a row is held against.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Cases {
    /// All of them.
    All,
    /// All but [`DEEP`].
    Shallow,
    /// Only [`DEEP`].
    Deep,
}

/// Cases whose hundreds of layers fill every cell: fragment structures meet them at a low resolution, since
/// millions of fragments would show nothing else.
pub const DEEP: &[&str] = &["C10", "Z6", "Z6-pixel", "Z7"];

impl Cases {
    /// Whether the case with this id is among them.
    pub fn contain(self, id: &str) -> bool {
        match self {
            Self::All => true,
            Self::Shallow => !DEEP.contains(&id),
            Self::Deep => DEEP.contains(&id),
        }
    }
}

/// A structure in a configuration.
#[derive(Clone, Copy, Debug)]
pub struct Row {
    /// Unique.
    pub name: &'static str,
    /// Makes the structure; its geometry is replaced for each case.
    pub make: fn(&Bench, &Geometry) -> Box<dyn Structure>,
    /// Which cases.
    pub cases: Cases,
    /// What every case demands.
    pub demand: Demand,
    /// The cases that are known not to.
    pub deviations: &'static [Deviation],
}

/// 64 units of rounding: what a hit may differ by beyond the bounds that the oracle derives from the test itself.
const ROUNDING: f64 = 64.0 / 16_777_216.0;

const fn robust_law(resolution: u32) -> Demand {
    // One ray in a hundred at 64 cells a side.
    Demand::Law { resolution, per_cell: 0.64, depth_tolerance: 1e-3, laws: deviations::ROBUST_LAWS }
}

const fn published_law(resolution: u32) -> Demand {
    // A fragment is a depth at its cell's centre: surfaces that lean by 45 degrees are off by half a cell.
    Demand::Law { resolution, per_cell: 1.92, depth_tolerance: 2e-2, laws: &[] }
}

/// All rows.
pub const ROWS: &[Row] = &[
    Row {
        name: "brute-force",
        make: brute_force,
        cases: Cases::All,
        demand: Demand::Exact { rounding: ROUNDING },
        deviations: &[],
    },
    Row {
        name: "mmrt-robust-16",
        make: robust::<16>,
        cases: Cases::Deep,
        demand: robust_law(16),
        deviations: deviations::ROBUST_16,
    },
    Row {
        name: "mmrt-robust-64",
        make: robust::<64>,
        cases: Cases::Shallow,
        demand: robust_law(64),
        deviations: deviations::ROBUST_64,
    },
    Row {
        name: "mmrt-robust-128",
        make: robust::<128>,
        cases: Cases::Shallow,
        demand: robust_law(128),
        deviations: deviations::ROBUST_128,
    },
    Row {
        name: "mmrt-published-16",
        make: published::<16>,
        cases: Cases::Deep,
        demand: published_law(16),
        deviations: deviations::PUBLISHED_16,
    },
    Row {
        name: "mmrt-published-128",
        make: published::<128>,
        cases: Cases::Shallow,
        demand: published_law(128),
        deviations: deviations::PUBLISHED_128,
    },
];

fn brute_force(bench: &Bench, geometry: &Geometry) -> Box<dyn Structure> {
    Box::new(BruteForce::new(bench.device(), geometry, None, false).expect("pipelines can be made"))
}

fn abuffer(bench: &Bench, geometry: &Geometry, config: Config) -> Box<dyn Structure> {
    Box::new(ABuffer::new(bench.device(), config, geometry, None).expect("the configuration is valid"))
}

fn robust<const RESOLUTION: u32>(bench: &Bench, geometry: &Geometry) -> Box<dyn Structure> {
    abuffer(bench, geometry, Config::robust(RESOLUTION))
}

/// The published march, acceptance and coverage; ids instead of attributes, which need a scene.
fn published<const RESOLUTION: u32>(bench: &Bench, geometry: &Geometry) -> Box<dyn Structure> {
    let config = Config {
        march: March::Samples,
        accept: Accept::Interval,
        coverage: Coverage::Hardware,
        ..Config::robust(RESOLUTION)
    };
    abuffer(bench, geometry, config)
}
