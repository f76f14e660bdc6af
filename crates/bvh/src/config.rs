//! Options of the BVH.

use rasray_ads::{Addressing, AdsError, Counters, check_range, check_work_budget};
use rasray_shaders_glsl::constants::bvh::BVH_LEAF_LIMIT;

/// What builds the tree.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Builder {
    /// The host, by the surface area heuristic: slow to build, fast to trace.
    Sah,
    /// The device, by Morton codes: fast to build, slower to trace.
    Lbvh,
    /// The device: the first tree by Morton codes, after that only its boxes, over the same order of the triangles. Fastest
    /// to build, and slower to trace the farther the triangles have moved since the first build.
    Refit,
}

impl Builder {
    /// The word of options and reports.
    pub fn name(self) -> &'static str {
        match self {
            Self::Sah => "sah",
            Self::Lbvh => "lbvh",
            Self::Refit => "refit",
        }
    }
}

/// All options. None of them changes a hit.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Config {
    /// What builds the tree.
    pub builder: Builder,
    /// Maximum number of triangles per leaf, 1 to 16; only for [`Builder::Sah`], whose heuristic may use fewer.
    pub leaf: u32,
    /// How pools are reached.
    pub addressing: Addressing,
    /// How much of their work rays record: nodes read and triangles tested.
    pub counters: Counters,
    /// Work units (nodes read and triangles tested) a ray may spend in one dispatch, 1 or more; the shared
    /// default where absent.
    pub work_budget: Option<u32>,
}

rasray_ads::configured!(Config);

impl Config {
    /// The defaults with a builder.
    pub fn new(builder: Builder) -> Self {
        Self {
            builder,
            leaf: 4,
            addressing: Addressing::Descriptor,
            counters: Counters::Off,
            work_budget: None,
        }
    }

    /// Checks ranges.
    ///
    /// # Errors
    /// The first option out of range.
    pub fn validate(&self) -> Result<(), AdsError> {
        check_range("leaf", self.leaf, 1..=BVH_LEAF_LIMIT, "1 to 16 triangles per leaf")?;
        check_work_budget(self.work_budget, false)
    }

    /// Options as name and value, for reports.
    pub fn options(&self) -> Vec<(&'static str, String)> {
        let mut options = vec![("builder", self.builder.name().to_owned())];
        if self.builder == Builder::Sah {
            options.push(("leaf", self.leaf.to_string()));
        }
        options
    }

    /// Paths as name and value, for reports.
    pub fn paths(&self) -> Vec<(&'static str, String)> {
        let builder = match self.builder {
            Builder::Sah => "host",
            Builder::Lbvh | Builder::Refit => "device",
        };
        vec![("builder", builder.to_owned()), ("addressing", self.addressing.name().to_owned())]
    }
}
