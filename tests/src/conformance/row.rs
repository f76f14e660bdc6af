use rasray_ads::{Geometry, Structure, StructureKind};
use rasray_experiment::HIT_ROUNDING;
use rasray_systems::{Preset, Spec};

use crate::harness::Bench;

/// Demand on the hits of a row.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Demand {
    /// Every unambiguous ray finds its triangle at a t within the oracle's bounds of rounding, widened by
    /// `rounding` (relative); ambiguous rays get an admissible answer.
    Exact {
        /// Tolerance relative to t.
        rounding: f64,
    },
    /// The share of missed, false and (by `depth_tolerance`) wrong hits falls with the size of a cell: it is
    /// at most `per_cell / resolution`, or the limit that `laws` gives for the case.
    Law {
        /// Cells along a side of a face.
        resolution: u32,
        /// Largest share of the unambiguous rays, times the resolution.
        per_cell: f64,
        /// Largest |dt| / t that counts as right.
        depth_tolerance: f64,
        /// Laws of the cases that have a factor of their own.
        laws: &'static [Law],
    },
    /// The rules of a paper lose hits of a structure that finds triangles: the share of missed, false and
    /// wrong hits is at most `share`, whatever the size of a cell.
    Loss {
        /// Largest share of the unambiguous rays.
        share: f64,
        /// Rounding of a right hit, relative to t.
        rounding: f64,
    },
}

impl Demand {
    /// Returns the kind of the structures for which the demand is made.
    pub fn kind(&self) -> StructureKind {
        match self {
            Self::Exact { .. } => StructureKind::Primitive,
            Self::Law { .. } => StructureKind::Fragment,
            Self::Loss { .. } => StructureKind::LossyPrimitive,
        }
    }
}

/// Law of a case whose errors fall with the size of a cell as well, but from a higher start.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Law {
    /// Id of the case.
    pub case: &'static str,
    /// Reason for which the case has more errors than others.
    pub reason: &'static str,
    /// Largest share of the unambiguous rays, times the resolution.
    pub per_cell: f64,
    /// Curve by which the limit falls with the resolution.
    pub curve: Curve,
}

/// Curve by which the largest rate of a law falls with the resolution N.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Curve {
    /// `per_cell / N`: each ray hits one border, which spoils a share of the rays proportional to the width
    /// of a cell.
    Line,
    /// `1 - exp(-per_cell / N)`: a ray is right only if none of many borders spoils it, each independently
    /// with a probability proportional to the width of a cell.
    Chances,
}

impl Law {
    /// Returns the largest rate at a resolution.
    pub fn limit(&self, resolution: u32) -> f64 {
        let width = self.per_cell / f64::from(resolution);
        match self.curve {
            Curve::Line => width,
            Curve::Chances => -(-width).exp_m1(),
        }
    }
}

/// Deviation of a row on a case where the row does not meet its demand.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Deviation {
    /// Id of the case.
    pub case: &'static str,
    /// Reason for the deviation.
    pub reason: &'static str,
    /// Least error rate; a lower rate is an unexpected pass.
    pub at_least_rate: f64,
    /// Largest error rate.
    pub at_most_rate: f64,
}

/// Cases that a row is held against.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Cases {
    /// All cases.
    All,
    /// All cases except [`DEEP`].
    Shallow,
    /// Only the cases in [`DEEP`].
    Deep,
}

/// Cases whose hundreds of layers fill every cell. Fragment structures trace them at a low resolution, since
/// millions of fragments would show nothing more.
pub const DEEP: &[&str] = &["C10", "Z6", "Z6-pixel", "Z7"];

impl Cases {
    /// True if the case with this id is one of them.
    pub fn contain(self, id: &str) -> bool {
        match self {
            Self::All => true,
            Self::Shallow => !DEEP.contains(&id),
            Self::Deep => DEEP.contains(&id),
        }
    }
}

/// Tier of tests that holds a row against its cases.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Tier {
    /// The quick tier: every run.
    Quick,
    /// The full tier: only if `RASRAY_FULL` is 1.
    Full,
}

/// Row: a system of the registry with a preset and options.
#[derive(Clone, Copy, Debug)]
pub struct Row {
    /// Unique name, under which failures are reported.
    pub name: &'static str,
    /// Name of the system.
    pub system: &'static str,
    /// Preset of the system.
    pub preset: Preset,
    /// Options that override the preset, by name.
    pub options: &'static [(&'static str, &'static str)],
    /// Tier in which the row is held.
    pub tier: Tier,
    /// Cases against which the row is held.
    pub cases: Cases,
    /// Demand on the answers to every case.
    pub demand: Demand,
    /// Cases that are known not to meet the demand. None may be listed for [`Demand::Exact`].
    pub deviations: &'static [Deviation],
}

impl Row {
    /// Makes a row of `preset=robust` whose every answer must be right.
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

    /// Returns the specification of the structure.
    ///
    /// # Panics
    /// If the registry does not know a word of the row.
    pub fn spec(&self) -> Spec {
        let options = self.options.iter().map(|(name, value)| ((*name).to_owned(), (*value).to_owned()));
        Spec::new(self.system, self.preset.name(), options)
            .unwrap_or_else(|error| panic!("row {} is not registered: {error}", self.name))
    }

    /// Makes the structure; its geometry is replaced for each case.
    ///
    /// # Panics
    /// If the registry does not know a word of the row, or the device refuses.
    pub fn make(&self, bench: &Bench, geometry: &Geometry) -> Box<dyn Structure> {
        self.spec()
            .create(bench.device(), geometry, None)
            .unwrap_or_else(|error| panic!("row {} cannot be made: {error}", self.name))
    }

    /// Makes the row's structure with pools reached by address.
    ///
    /// # Panics
    /// As [`make`](Self::make), or if the structure has no pools.
    pub fn make_by_address(&self, bench: &Bench, geometry: &Geometry) -> Box<dyn Structure> {
        let spec = self.spec().with_option("addressing", "address").expect("it has pools");
        spec.create(bench.device(), geometry, None)
            .unwrap_or_else(|error| panic!("row {} cannot be made by address: {error}", self.name))
    }

    /// Returns the largest error of depth for the error rate, and of t beyond the oracle's bounds.
    pub fn tolerances(&self) -> (f64, f64) {
        match self.demand {
            Demand::Exact { rounding } => (0.0, rounding),
            Demand::Law { depth_tolerance, .. } => (depth_tolerance, 0.0),
            Demand::Loss { rounding, .. } => (rounding, rounding),
        }
    }

    /// True if the structure has only the view of the camera, so that only hits in this view are evaluated.
    pub fn only_camera(&self) -> bool {
        self.options.contains(&("views", "camera"))
    }

    /// True if every answer must be right.
    pub fn is_exact(&self) -> bool {
        matches!(self.demand, Demand::Exact { .. })
    }

    /// Returns the largest rate of wrong answers on a case without a deviation.
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

    /// Describes the bound on the row's answers to a case.
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

    /// Returns the command that traces one ray of a case with this row's system and prints each step.
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

/// Returns the demand on the published presets of fragment structures.
pub(super) const fn published_law(resolution: u32) -> Demand {
    // A fragment is a depth at its cell's centre: surfaces that lean by 45 degrees are off by half a cell.
    Demand::Law { resolution, per_cell: 1.92, depth_tolerance: 2e-2, laws: &[] }
}
