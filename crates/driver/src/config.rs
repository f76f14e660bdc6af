//! Options of the driver's tree.

use rasray_ads::kit::{Common, Configured, check_work_budget};
use rasray_ads::{Addressing, AdsError, Counters, words};
use rasray_gpu::DriverTreeGoal;

/// Goal for which the driver should optimize the tree: a hint that a driver may ignore.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Goal {
    /// Fast traces.
    #[default]
    Trace,
    /// Fast builds.
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

/// Options of the driver's tree. None of them changes a hit.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Config {
    /// Goal for which the driver should optimize the tree.
    pub goal: Goal,
    /// Counters that rays record of their work.
    pub counters: Counters,
    /// Work units that a ray from far outside may spend in one dispatch. If absent, the default that all
    /// structures share. Other rays end in their first dispatch.
    pub work_budget: Option<u32>,
}

impl Configured for Config {
    /// Returns the options that all structures have. The header and the boxes are always in descriptors, and
    /// the tree itself has no address other than the driver's.
    fn common(&self) -> Common {
        let Self { counters, work_budget, .. } = *self;
        Common { addressing: Addressing::Descriptor, counters, work_budget }
    }
}

impl Config {
    /// Returns the default options.
    pub fn new() -> Self {
        Self::default()
    }

    /// Checks the ranges of all options.
    ///
    /// # Errors
    /// The first option that is out of range.
    pub fn validate(&self) -> Result<(), AdsError> {
        check_work_budget(self.work_budget, false)
    }

    /// Returns the options as pairs of name and value, for reports.
    pub fn options(&self) -> Vec<(&'static str, String)> {
        vec![("goal", self.goal.name().to_owned())]
    }
}
