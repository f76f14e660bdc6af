//! Options of the BVH.

use rasray_ads::kit::{check_range, check_work_budget};
use rasray_ads::words;
use rasray_ads::{Addressing, AdsError, Counters};
use rasray_shaders_glsl::constants::bvh::{BVH_FOUR, BVH_LEAF_LIMIT};

use crate::{Node, NodeOfFour};

/// Builder of the tree.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Builder {
    /// The host, by the surface area heuristic: slow to build, fast to trace.
    Sah,
    /// The device, by Morton codes: fast to build, slower to trace.
    Lbvh,
    /// The device: clusters of triangles merge with near ones, by surface area: slower to build than
    /// [`Builder::Lbvh`], faster to trace.
    Ploc,
    /// The device: the tree by Morton codes, and then treelets of it are restructured by surface area: slower
    /// to build, faster to trace.
    Trbvh,
    /// The device: the first tree as [`Builder::Trbvh`] makes it, after that only its boxes. Fastest to
    /// build, and slower to trace the farther the triangles have moved since the first build.
    Refit,
}

words! { Builder { Sah "sah", Lbvh "lbvh", Ploc "ploc", Trbvh "trbvh", Refit "refit" } }

/// Children of a node.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Children {
    /// Two.
    Two,
    /// Four, tested together: fewer nodes to read, and the fastest to trace.
    Four,
}

words! { Children { Two "2", Four "4" } }

impl Children {
    /// Their number: 2 or 4.
    pub fn number(self) -> u32 {
        match self {
            Self::Two => 2,
            Self::Four => BVH_FOUR,
        }
    }

    /// Bytes of a node.
    pub(crate) fn node_bytes(self) -> usize {
        match self {
            Self::Two => size_of::<Node>(),
            Self::Four => size_of::<NodeOfFour>(),
        }
    }
}

/// Way in which the device works on chunks, of keys that it sorts and of clusters that it merges. The tree is
/// the same.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Chunks {
    /// An invocation takes a chunk alone: the least work.
    Serial,
    /// A workgroup takes a chunk, in shared memory: fills a device.
    Shared,
}

/// All options. None of them changes a hit.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Config {
    /// Builder of the tree.
    pub builder: Builder,
    /// Children per node; by default two by [`Builder::Lbvh`] and [`Builder::Refit`], whose builds are to be
    /// quick, and four by the others.
    pub children: Option<Children>,
    /// Maximum number of triangles per leaf, 1 to 16; by default 4 by [`Builder::Sah`] and, with four
    /// children per node, by [`Builder::Ploc`], whose heuristic may use fewer, and 1 by the others, whose
    /// leaves hold one.
    pub leaf: Option<u32>,
    /// Way in which the device works on chunks; where absent [`Chunks::Serial`] on software devices and
    /// [`Chunks::Shared`] on others.
    pub chunks: Option<Chunks>,
    /// Addressing of pools.
    pub addressing: Addressing,
    /// Counters that rays record of their work: nodes read and triangles tested.
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
            children: None,
            leaf: None,
            chunks: None,
            addressing: Addressing::Descriptor,
            counters: Counters::Off,
            work_budget: None,
        }
    }

    /// Children of a node of the trees that are made.
    pub fn made_children(&self) -> Children {
        self.children.unwrap_or(match self.builder {
            Builder::Sah | Builder::Ploc | Builder::Trbvh => Children::Four,
            Builder::Lbvh | Builder::Refit => Children::Two,
        })
    }

    /// Maximum number of triangles per leaf of the trees that are made.
    pub fn made_leaf(&self) -> u32 {
        self.leaf.unwrap_or(if self.chooses_leaves() { 4 } else { 1 })
    }

    /// True where triangles may share a leaf.
    fn chooses_leaves(&self) -> bool {
        match self.builder {
            Builder::Sah => true,
            Builder::Ploc => self.made_children() == Children::Four,
            Builder::Lbvh | Builder::Trbvh | Builder::Refit => false,
        }
    }

    /// Checks ranges, and that the builder makes such trees.
    ///
    /// # Errors
    /// The first option out of range.
    pub fn validate(&self) -> Result<(), AdsError> {
        let leaf = self.made_leaf();
        if self.chooses_leaves() {
            check_range("leaf", leaf, 1..=BVH_LEAF_LIMIT, "1 to 16 triangles per leaf")?;
        } else {
            check_range(
                "leaf",
                leaf,
                1..=1,
                "1 triangle per leaf of such a tree, or builder `sah`, or `ploc` with 4 children per node",
            )?;
        }
        check_work_budget(self.work_budget, false)
    }

    /// Options as name and value, for reports.
    pub fn options(&self) -> Vec<(&'static str, String)> {
        vec![
            ("builder", self.builder.name().to_owned()),
            ("children", self.made_children().number().to_string()),
            ("leaf", self.made_leaf().to_string()),
        ]
    }

    /// Paths as name and value, for reports.
    pub fn paths(&self) -> Vec<(&'static str, String)> {
        let builder = match self.builder {
            Builder::Sah => "host",
            Builder::Lbvh | Builder::Ploc | Builder::Trbvh | Builder::Refit => "device",
        };
        vec![("builder", builder.to_owned()), ("addressing", self.addressing.name().to_owned())]
    }
}
