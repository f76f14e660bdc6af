//! Options of the BVH.

use rasray_ads::{Addressing, AdsError, Counters, check_range, check_work_budget};
use rasray_shaders_glsl::constants::bvh::{BVH_LEAF_LIMIT, BVH_WIDE};

use crate::{Node, WideNode};

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

/// Children of a node.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Width {
    /// Two.
    Two,
    /// Four, tested together: fewer nodes to read, and the fastest to trace.
    Four,
}

impl Width {
    /// The number.
    pub fn children(self) -> u32 {
        match self {
            Self::Two => 2,
            Self::Four => BVH_WIDE,
        }
    }

    /// Bytes of a node.
    pub(crate) fn node_bytes(self) -> usize {
        match self {
            Self::Two => size_of::<Node>(),
            Self::Four => size_of::<WideNode>(),
        }
    }
}

/// All options. None of them changes a hit.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Config {
    /// What builds the tree.
    pub builder: Builder,
    /// Children per node; only for [`Builder::Sah`], the others make trees of two.
    pub width: Width,
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
            width: Width::Four,
            leaf: 4,
            addressing: Addressing::Descriptor,
            counters: Counters::Off,
            work_budget: None,
        }
    }

    /// Children of a node of the trees that are made.
    pub fn made_width(&self) -> Width {
        match self.builder {
            Builder::Sah => self.width,
            Builder::Lbvh | Builder::Refit => Width::Two,
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
            options.push(("children", self.width.children().to_string()));
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
