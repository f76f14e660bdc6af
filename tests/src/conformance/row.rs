use rasray_ads::{Geometry, Structure, StructureKind};
use rasray_experiment::HIT_ROUNDING;
use rasray_systems::{Preset, Spec};

use crate::harness::Bench;

/// Demand on the hits of a row.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Demand {
    /// Every unambiguous ray finds its triangle at a t within the oracle's bounds of rounding, give or
    /// take `rounding` (relative); ambiguous rays get an admissible answer.
    Exact {
        /// Relative to t.
        rounding: f64,
    },
    /// The share of missed, false and (by `depth_tolerance`) wrong hits falls with the size of a cell: it is
    /// at most `per_cell / resolution`, or what `laws` says for the case.
    Law {
        /// Cells along a side of a face.
        resolution: u32,
        /// Share of the unambiguous rays, times the resolution.
        per_cell: f64,
        /// |dt| / t that counts as right.
        depth_tolerance: f64,
        /// Cases with a factor of their own.
        laws: &'static [Law],
    },
    /// Rules of a paper lose hits of a structure that finds triangles: the share of missed, false and wrong
    /// hits is at most `share`, whatever the size of a cell.
    Loss {
        /// Share of the unambiguous rays.
        share: f64,
        /// Rounding of a hit that is right, relative to t.
        rounding: f64,
    },
}

impl Demand {
    /// Structures that it is made of.
    pub fn kind(&self) -> StructureKind {
        match self {
            Self::Exact { .. } => StructureKind::Primitive,
            Self::Law { .. } => StructureKind::Fragment,
            Self::Loss { .. } => StructureKind::LossyPrimitive,
        }
    }
}

/// A case whose errors fall with the size of a cell as well, from a higher start.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Law {
    /// Id of the case.
    pub case: &'static str,
    /// Why it has more errors than others.
    pub reason: &'static str,
    /// Share of the unambiguous rays, times the resolution.
    pub per_cell: f64,
    /// The way in which the limit falls with the resolution.
    pub curve: Curve,
}

/// The way in which the largest rate of a law falls with the resolution N.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Curve {
    /// `per_cell / N`: each ray hits one border, whose share of the rays is as wide as a cell.
    Line,
    /// `1 - exp(-per_cell / N)`: a ray is right only if none of many borders spoils it, each with a chance
    /// that is as wide as a cell and does not depend on the others.
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

/// Cases that a row is held against.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Cases {
    /// All of them.
    All,
    /// All but [`DEEP`].
    Shallow,
    /// Only [`DEEP`].
    Deep,
}

/// Cases whose hundreds of layers fill every cell: fragment structures trace them at a low resolution, since
/// millions of fragments would show nothing more.
pub const DEEP: &[&str] = &["C10", "Z6", "Z6-pixel", "Z7"];

impl Cases {
    /// True if the case with this id is among them.
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
    /// Demand on the answers to every case.
    pub demand: Demand,
    /// The cases that are known not to meet it. None may be listed for [`Demand::Exact`].
    pub deviations: &'static [Deviation],
}

impl Row {
    /// A row of `preset=robust` from which every answer must be right.
    pub(super) const fn exact(
        name: &'static str,
        system: &'static str,
        options: &'static [(&'static str, &'static str)],
        tier: Tier,
        cases: Cases,
    ) -> Self {
        let demand = Demand::Exact { rounding: HIT_ROUNDING };
        Self { name, system, preset: Preset::Robust, options, tier, cases, demand, deviations: &[] }
    }

    /// Specification of the structure.
    ///
    /// # Panics
    /// If the registry does not know the row's words.
    pub fn spec(&self) -> Spec {
        let options = self.options.iter().map(|(name, value)| ((*name).to_owned(), (*value).to_owned()));
        Spec::new(self.system, self.preset.name(), options)
            .unwrap_or_else(|error| panic!("row {} is not registered: {error}", self.name))
    }

    /// Makes the structure; its geometry is replaced for each case.
    ///
    /// # Panics
    /// If the registry does not know the row's words, or the device refuses.
    pub fn make(&self, bench: &Bench, geometry: &Geometry) -> Box<dyn Structure> {
        self.spec()
            .create(bench.device(), geometry, None)
            .unwrap_or_else(|error| panic!("row {} cannot be made: {error}", self.name))
    }

    /// A structure as the row says, with pools reached by address.
    ///
    /// # Panics
    /// As [`make`](Self::make), or if the structure has no pools.
    pub fn make_by_address(&self, bench: &Bench, geometry: &Geometry) -> Box<dyn Structure> {
        let spec = self.spec().with_option("addressing", "address").expect("it has pools");
        spec.create(bench.device(), geometry, None)
            .unwrap_or_else(|error| panic!("row {} cannot be made by address: {error}", self.name))
    }

    /// Largest error of depth in the error rate, and of t beyond the oracle's bounds.
    pub fn tolerances(&self) -> (f64, f64) {
        match self.demand {
            Demand::Exact { rounding } => (0.0, rounding),
            Demand::Law { depth_tolerance, .. } => (depth_tolerance, 0.0),
            Demand::Loss { rounding, .. } => (rounding, rounding),
        }
    }

    /// True if it has no views but the camera's, so that only what that sees is evaluated.
    pub fn only_camera(&self) -> bool {
        self.options.contains(&("views", "camera"))
    }

    /// True if every answer must be right.
    pub fn is_exact(&self) -> bool {
        matches!(self.demand, Demand::Exact { .. })
    }

    /// The largest rate of wrong answers on a case without a deviation.
    pub fn largest_rate(&self, case: &str) -> f64 {
        match self.demand {
            Demand::Exact { .. } => 0.0,
            Demand::Law { resolution, per_cell, laws, .. } => {
                let law = laws.iter().find(|law| law.case == case);
                law.map_or(per_cell / f64::from(resolution), |law| law.limit(resolution))
            }
            Demand::Loss { share, .. } => share,
        }
    }

    /// Bound on its answers to a case, in words.
    pub fn limit(&self, case: &str) -> String {
        let deviation = self.deviations.iter().find(|deviation| deviation.case == case);
        match (self.demand, deviation) {
            (Demand::Exact { rounding }, _) => format!("t within {rounding:.1e} of the oracle's bounds"),
            (_, Some(Deviation { reason, at_least_rate, at_most_rate, .. })) => {
                format!("a deviation between {at_least_rate} and {at_most_rate}: {reason}")
            }
            (Demand::Law { resolution, laws, .. }, None) => {
                let law = laws.iter().find(|law| law.case == case);
                let limit = self.largest_rate(case);
                let reason = law.map_or_else(String::new, |law| format!(": {}", law.reason));
                format!("at most {limit:.4} with {resolution} cells along a side{reason}")
            }
            (Demand::Loss { share, .. }, None) => format!("at most {share}"),
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

/// Demand on the published presets of fragment structures.
pub(super) const fn published_law(resolution: u32) -> Demand {
    // A fragment is a depth at its cell's centre: surfaces that lean by 45 degrees are off by half a cell.
    Demand::Law { resolution, per_cell: 1.92, depth_tolerance: 2e-2, laws: &[] }
}
