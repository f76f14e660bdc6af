use rasray_ads::{Geometry, Structure};
use rasray_systems::{Preset, Spec};

use super::{deviations, deviations_ldc, deviations_voxel};
use crate::hard_cases;
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
    /// Of the unambiguous rays, times the resolution.
    pub per_cell: f64,
    /// How the limit falls.
    pub curve: Curve,
}

/// How the largest rate of a law falls with the resolution N.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Curve {
    /// `per_cell / N`: each ray meets one border, whose share of the rays is as wide as a cell.
    Line,
    /// `1 - exp(-per_cell / N)`: a ray is right only if none of many borders spoils it, each with a chance that is
    /// as wide as a cell and does not depend on the others.
    Chances,
}

impl Law {
    /// The largest rate at a resolution.
    pub fn limit(&self, resolution: u32) -> f64 {
        let width = self.per_cell / f64::from(resolution);
        match self.curve {
            Curve::Line => width,
            Curve::Chances => -(-width).exp_m1(),
        }
    }
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

/// When a row is held.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Tier {
    /// In every run.
    Quick,
    /// Only where `RASRAY_FULL` is 1.
    Full,
}

/// A system of the registry with a preset and options.
#[derive(Clone, Copy, Debug)]
pub struct Row {
    /// Unique; failures are reported under it.
    pub name: &'static str,
    /// Name of the system.
    pub system: &'static str,
    /// Its preset.
    pub preset: Preset,
    /// Options over the preset, by name.
    pub options: &'static [(&'static str, &'static str)],
    /// When it is held.
    pub tier: Tier,
    /// Against which cases.
    pub cases: Cases,
    /// What every case demands.
    pub demand: Demand,
    /// The cases that are known not to meet it. None may be listed for [`Demand::Exact`].
    pub deviations: &'static [Deviation],
}

impl Row {
    /// Makes the structure; its geometry is replaced for each case.
    ///
    /// # Panics
    /// If the registry does not know the row's words, or the device refuses.
    pub fn make(&self, bench: &Bench, geometry: &Geometry) -> Box<dyn Structure> {
        let options = self.options.iter().map(|(name, value)| ((*name).to_owned(), (*value).to_owned()));
        Spec::new(self.system, self.preset.name(), options)
            .and_then(|spec| spec.create(bench.device(), geometry, None))
            .unwrap_or_else(|error| panic!("row {} cannot be made: {error}", self.name))
    }

    /// How deep hits may be off in the error rate, and how far t may be beyond the oracle's bounds.
    pub fn tolerances(&self) -> (f64, f64) {
        match self.demand {
            Demand::Exact { rounding } => (0.0, rounding),
            Demand::Law { depth_tolerance, .. } => (depth_tolerance, 0.0),
        }
    }

    /// Whether it has no views but the camera's, so that only what that sees is judged.
    pub fn only_camera(&self) -> bool {
        self.options.contains(&("views", "camera"))
    }

    /// Whether every answer must be right.
    pub fn is_exact(&self) -> bool {
        matches!(self.demand, Demand::Exact { .. })
    }

    /// What bounds its answers on a case, in words.
    pub fn limit(&self, case: &str) -> String {
        let deviation = self.deviations.iter().find(|deviation| deviation.case == case);
        match (self.demand, deviation) {
            (Demand::Exact { rounding }, _) => format!("t within {rounding:.1e} of the oracle's bounds"),
            (Demand::Law { .. }, Some(Deviation { reason, at_least_rate, at_most_rate, .. })) => {
                format!("a deviation between {at_least_rate} and {at_most_rate}: {reason}")
            }
            (Demand::Law { resolution, per_cell, laws, .. }, None) => {
                let law = laws.iter().find(|law| law.case == case);
                let general = per_cell / f64::from(resolution);
                let limit = law.map_or(general, |law| law.limit(resolution));
                let reason = law.map_or_else(String::new, |law| format!(": {}", law.reason));
                format!("at most {limit:.4} with {resolution} cells a side{reason}")
            }
        }
    }

    /// The command that traces one ray of a case with this row's system and prints what it did.
    pub fn replay_command(&self, case: &str, seed: u64, ray: usize) -> String {
        let options: String =
            self.options.iter().map(|(name, value)| format!(" {}.{name}={value}", self.system)).collect();
        format!(
            "rasray compare hard:{case} --systems {} --presets {} --seed {seed} --replay {ray}{options}",
            self.system,
            self.preset.name()
        )
    }
}

/// How often a row is judged in all runs together: each law and each end of a deviation is one comparison.
pub fn comparisons() -> usize {
    let cases = |row: &Row| hard_cases::ids().iter().filter(|id| row.cases.contain(id)).count();
    ROWS.iter().map(|row| 2 * cases(row)).sum()
}

/// 64 units of rounding: what a hit may differ by beyond the bounds that the oracle derives from the test itself.
const ROUNDING: f64 = 64.0 / 16_777_216.0;

const fn robust_law(resolution: u32) -> Demand {
    // One ray in a hundred at 64 cells a side.
    Demand::Law { resolution, per_cell: 0.64, depth_tolerance: 1e-3, laws: deviations::ROBUST_LAWS }
}

const fn voxel_law(resolution: u32) -> Demand {
    Demand::Law { resolution, per_cell: 0.64, depth_tolerance: 1e-3, laws: deviations_voxel::LAWS }
}

const fn published_law(resolution: u32) -> Demand {
    // A fragment is a depth at its cell's centre: surfaces that lean by 45 degrees are off by half a cell.
    Demand::Law { resolution, per_cell: 1.92, depth_tolerance: 2e-2, laws: &[] }
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

const fn ldc_law(resolution: u32) -> Demand {
    Demand::Law { resolution, per_cell: 0.64, depth_tolerance: 1e-3, laws: deviations_ldc::ROBUST_LAWS }
}

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

const fn dirt(
    name: &'static str,
    options: &'static [(&'static str, &'static str)],
    tier: Tier,
    cases: Cases,
) -> Row {
    let demand = Demand::Exact { rounding: ROUNDING };
    Row { name, system: "dirt", preset: Preset::Robust, options, tier, cases, demand, deviations: &[] }
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

/// All rows.
pub const ROWS: &[Row] = &[
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
    // 16 coarse tiles a side, few buckets, linked lists.
    dirt(
        "dirt-lists-16",
        &[("resolution", "64"), ("tile", "4"), ("buckets", "4"), ("storage", "llb")],
        Tier::Quick,
        Cases::All,
    ),
    dirt("dirt-lists-128", &[("storage", "sb")], Tier::Quick, Cases::Shallow),
    // 16 tiles a side and few slices, then as many as a scene of a hundred thousand triangles gets.
    dirt("dirt-robust-16", &[("resolution", "16"), ("tile", "1"), ("slices", "12")], Tier::Quick, Cases::All),
    dirt("dirt-robust-128", &[("resolution", "256")], Tier::Quick, Cases::Shallow),
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
    voxel(
        "hu-robust-16",
        ("hu", Preset::Robust),
        &[("resolution", "16")],
        Cases::Deep,
        voxel_law(16),
        deviations_voxel::ROBUST_16,
    ),
    voxel(
        "hu-robust-64",
        ("hu", Preset::Robust),
        &[("resolution", "64")],
        Cases::Shallow,
        voxel_law(64),
        deviations_voxel::ROBUST_64,
    ),
    voxel(
        "hu-robust-128",
        ("hu", Preset::Robust),
        &[("resolution", "128")],
        Cases::Shallow,
        voxel_law(128),
        deviations_voxel::ROBUST_128,
    ),
    voxel(
        "hu-published-16",
        ("hu", Preset::Published),
        &[("resolution", "16")],
        Cases::Deep,
        published_law(16),
        deviations_voxel::HU_16,
    ),
    voxel(
        "hu-published-128",
        ("hu", Preset::Published),
        &[("resolution", "128")],
        Cases::Shallow,
        published_law(128),
        deviations_voxel::HU_128,
    ),
    voxel(
        "selective-robust-16",
        ("selective", Preset::Robust),
        &[("resolution", "16")],
        Cases::Deep,
        voxel_law(16),
        deviations_voxel::ROBUST_16,
    ),
    voxel(
        "selective-published-16",
        ("selective", Preset::Published),
        &[("resolution", "16")],
        Cases::Deep,
        published_law(16),
        deviations_voxel::SELECTIVE_16,
    ),
    voxel(
        "selective-published-128",
        ("selective", Preset::Published),
        &[("resolution", "128")],
        Cases::Shallow,
        published_law(128),
        deviations_voxel::SELECTIVE_128,
    ),
    ldc("ldc-robust-16", Preset::Robust, &[("resolution", "16")], Cases::Deep, ldc_law(16), &[]),
    ldc("ldc-robust-64", Preset::Robust, &[("resolution", "64")], Cases::Shallow, ldc_law(64), &[]),
    Row {
        tier: Tier::Full,
        ..ldc("ldc-robust-256", Preset::Robust, &[("resolution", "256")], Cases::Shallow, ldc_law(256), &[])
    },
    ldc(
        "ldc-published-16",
        Preset::Published,
        &[("resolution", "16")],
        Cases::Deep,
        published_law(16),
        deviations_ldc::PUBLISHED_16,
    ),
    ldc(
        "ldc-published-64",
        Preset::Published,
        &[("resolution", "64")],
        Cases::Shallow,
        published_law(64),
        deviations_ldc::PUBLISHED_64,
    ),
];
