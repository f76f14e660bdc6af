//! Options of the driver's tree.

use rasray_ads::kit::{Common, Configured, check_work_budget};
use rasray_ads::{Addressing, AdsError, Counters, words};
use rasray_gpu::DriverTreeGoal;

/// Goal of the tree: a hint that a driver may ignore.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Goal {
    /// Traces.
    #[default]
    Trace,
    /// Builds.
    Build,
}

words! { Goal { Trace "trace", Build "build" } }

impl From<Goal> for DriverTreeGoal {
    fn from(goal: Goal) -> Self {
        match goal {
            Goal::Trace => Self::Trace,
            Goal::Build => Self::Build,
        }
    }
}

/// All options. None of them changes a hit.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Config {
    /// Goal of the tree.
    pub goal: Goal,
    /// Counters that rays record of their work.
    pub counters: Counters,
    /// Work units that a ray from far outside may spend in one dispatch; the shared default where absent.
    /// Other rays end in the first.
    pub work_budget: Option<u32>,
}

impl Configured for Config {
    /// The header and the boxes are in descriptors: the tree itself has no other address than the driver's.
    fn common(&self) -> Common {
        let Self { counters, work_budget, .. } = *self;
        Common { addressing: Addressing::Descriptor, counters, work_budget }
    }
}

impl Config {
    /// The defaults.
    pub fn new() -> Self {
        Self::default()
    }

    /// Checks ranges.
    ///
    /// # Errors
    /// The first option out of range.
    pub fn validate(&self) -> Result<(), AdsError> {
        check_work_budget(self.work_budget, false)
    }

    /// Options as name and value, for reports.
    pub fn options(&self) -> Vec<(&'static str, String)> {
        vec![("goal", self.goal.name().to_owned())]
    }
}
