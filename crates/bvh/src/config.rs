//! Options of the BVH.

use rasray_ads::kit::{check_range, check_work_budget};
use rasray_ads::words;
use rasray_ads::{Addressing, AdsError, Counters};
use rasray_gpu::{Device, Feature};
use rasray_shaders_glsl::constants::bvh::{BVH_FOUR, BVH_LEAF_LIMIT};

use crate::{Node, NodeOfFour};

/// Builder of the tree.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Builder {
    /// Build on the host, by the surface area heuristic: slow to build, fast to trace.
    Sah,
    /// Build on the device, by Morton codes: fast to build, slower to trace.
    Lbvh,
    /// Build on the device that merges near clusters of triangles by surface area: slower to build than
    /// [`Builder::Lbvh`], faster to trace.
    Ploc,
    /// Build on the device that makes the tree of [`Builder::Lbvh`] and then restructures treelets of it by
    /// surface area: slower to build, faster to trace.
    Trbvh,
    /// Build on the device that makes a tree as [`Builder::Ploc`] with four children per node, and keeps it
    /// as long as the cost by surface area stays near that of the new tree: then a build computes only boxes
    /// anew. The fastest to build where triangles move smoothly.
    Refit,
}

words! { Builder { Sah "sah", Lbvh "lbvh", Ploc "ploc", Trbvh "trbvh", Refit "refit" } }

impl Builder {
    /// Returns true if the tree is made by merging clusters.
    pub(crate) fn merges_clusters(self) -> bool {
        matches!(self, Self::Ploc | Self::Refit)
    }
}

/// Maximum number of children of a node.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Children {
    /// Two children.
    Two,
    /// Four children, which a ray tests together: fewer nodes to read, and the fastest to trace.
    Four,
}

words! { Children { Two "2", Four "4" } }

impl Children {
    /// Returns the number of children: 2 or 4.
    pub fn number(self) -> u32 {
        match self {
            Self::Two => 2,
            Self::Four => BVH_FOUR,
        }
    }

    /// Returns the bytes of a node.
    pub(crate) fn node_bytes(self) -> usize {
        match self {
            Self::Two => size_of::<Node>(),
            Self::Four => size_of::<NodeOfFour>(),
        }
    }
}

/// Way in which the device works on chunks: of keys that it sorts, and of clusters that it merges. The tree
/// does not depend on it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Chunks {
    /// One invocation takes a chunk, which is the least work.
    Serial,
    /// One workgroup takes a chunk, in shared memory, which fills a device.
    Shared,
}

words! { Chunks { Serial "serial", Shared "shared" } }

/// Size of the words in which rays read nodes and triangles. The values read do not depend on it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Loads {
    /// Words of 32 bits, which every device can read.
    Bits32,
    /// Words of 64 bits, which need [`Feature::Int64`]: half as many loads for a driver that reads word by
    /// word.
    Bits64,
}

words! { Loads { Bits32 "32", Bits64 "64" } }

/// Options of a BVH. None of them changes a hit.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Config {
    /// Builder of the tree.
    pub builder: Builder,
    /// Maximum number of children per node. If absent, two with [`Builder::Lbvh`], whose builds should be
    /// quick, and four with the other builders. [`Builder::Refit`] has four.
    pub children: Option<Children>,
    /// Maximum number of triangles per leaf, 1 to 16. If absent, 4 with [`Builder::Sah`] and, with four
    /// children per node, with [`Builder::Ploc`] and [`Builder::Refit`], whose heuristic may use fewer; 1
    /// with the other builders, whose leaves hold one triangle.
    pub leaf: Option<u32>,
    /// Way in which the device works on chunks. If absent, [`Chunks::Serial`] on software devices and
    /// [`Chunks::Shared`] on others.
    pub chunks: Option<Chunks>,
    /// Size of the words in which rays read. If absent, [`Loads::Bits64`] on software devices that have
    /// [`Feature::Int64`], and [`Loads::Bits32`] on others.
    pub loads: Option<Loads>,
    /// Addressing of pools: descriptors or device addresses.
    pub addressing: Addressing,
    /// Counters that rays record of their work: nodes read and triangles tested.
    pub counters: Counters,
    /// Work units (nodes read and triangles tested) that a ray may spend in one dispatch, 1 or more. If
    /// absent, the default that all structures share.
    pub work_budget: Option<u32>,
}

rasray_ads::configured!(Config);

impl Config {
    /// Returns the default options with a builder.
    pub fn new(builder: Builder) -> Self {
        Self {
            builder,
            children: None,
            leaf: None,
            chunks: None,
            loads: None,
            addressing: Addressing::Descriptor,
            counters: Counters::Off,
            work_budget: None,
        }
    }

    /// Returns the number of children per node: the chosen one, or the builder's default.
    pub fn made_children(&self) -> Children {
        self.children.unwrap_or(match self.builder {
            Builder::Sah | Builder::Ploc | Builder::Trbvh | Builder::Refit => Children::Four,
            Builder::Lbvh => Children::Two,
        })
    }

    /// Returns the maximum number of triangles per leaf: the chosen one, or the builder's default.
    pub fn made_leaf(&self) -> u32 {
        self.leaf.unwrap_or(if self.chooses_leaves() { 4 } else { 1 })
    }

    /// Fills in the device's defaults of chunks and loads.
    pub(crate) fn complete(&mut self, device: &Device) {
        let is_software = device.is_software();
        let loads = if is_software && device.has(Feature::Int64) { Loads::Bits64 } else { Loads::Bits32 };
        self.loads.get_or_insert(loads);
        self.chunks.get_or_insert(if is_software { Chunks::Serial } else { Chunks::Shared });
    }

    /// Returns true if triangles may share a leaf.
    fn chooses_leaves(&self) -> bool {
        match self.builder {
            Builder::Sah => true,
            Builder::Ploc | Builder::Refit => self.made_children() == Children::Four,
            Builder::Lbvh | Builder::Trbvh => false,
        }
    }

    /// Checks the ranges of all options, and that the builder makes trees of this kind.
    ///
    /// # Errors
    /// The first option that is out of range, or that the builder cannot follow.
    pub fn validate(&self) -> Result<(), AdsError> {
        if self.builder == Builder::Refit {
            check_range(
                "children",
                self.made_children().number(),
                4..=4,
                "4 children per node with builder `refit`",
            )?;
        }
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

    /// Returns the options as pairs of name and value, for reports.
    pub fn options(&self) -> Vec<(&'static str, String)> {
        vec![
            ("builder", self.builder.name().to_owned()),
            ("children", self.made_children().number().to_string()),
            ("leaf", self.made_leaf().to_string()),
        ]
    }

    /// Returns the chosen code paths as pairs of name and value, for reports.
    pub fn paths(&self) -> Vec<(&'static str, String)> {
        let builder = match self.builder {
            Builder::Sah => "host",
            Builder::Lbvh | Builder::Ploc | Builder::Trbvh | Builder::Refit => "device",
        };
        let mut paths =
            vec![("builder", builder.to_owned()), ("addressing", self.addressing.name().to_owned())];
        paths.extend(self.chunks.map(|chunks| ("chunks", chunks.name().to_owned())));
        paths.extend(self.loads.map(|loads| ("loads", loads.name().to_owned())));
        paths
    }
}
