//! Implementation of the BVH as a structure.

use std::mem::offset_of;

use rasray_ads::kit::{BuildPipelines, Design, Parts, Pooled};
use rasray_ads::{
    AdsError, Dependencies, GeometryExtent, RecordLayout, SceneBinding, Sizes, StructureKind,
    StructureReport, Viewpoint,
};
use rasray_gpu::{BindingSet, Device, Feature, Recorder, Requirements};
use rasray_shaders_glsl::constant_ids::bvh::{BVH_CHILDREN, BVH_CLUSTER_LEAF};
use rasray_shaders_glsl::constants::bvh::BVH_NONE;

use crate::build::Build;
use crate::four::with_four_children;
use crate::host::{self, Box3};
use crate::kept::{KeptTrees, Made};
use crate::layout::{BOX_WORDS, NAME, formula_bytes, pair_elements, plan};
use crate::{
    Builder, Children, Config, Contents, Header, Loads, Node, NodeOfFour, Pool, Record, well_formed,
};

/// A bounding volume hierarchy with two or four children per node, made from a [`Config`].
pub type Bvh = Pooled<Passes>;

/// Pipelines and state of the build, which are the design of [`Bvh`].
#[derive(Debug)]
pub struct Passes {
    build: Build,
    /// Tree that the host has made for the next build.
    prepared: Option<Prepared>,
    /// Decides which builds keep a tree.
    trees: KeptTrees,
    /// Tree that the build recorded next keeps.
    kept: Option<Made>,
}

/// Demand of a build: the number of elements that it needs in each pool.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Demand {
    /// Number of inner nodes of the tree and, for nodes of four that the device makes, of the nodes of two
    /// that they are made of.
    pub nodes: u64,
    /// Number of triangles in leaves.
    pub records: u64,
    /// Words of the scratch pool, which only the build uses.
    pub scratch: u64,
    /// Number of triangles of the geometry.
    pub triangles: u64,
}

/// Root of a tree in the pools, and its numbers of inner nodes and of triangles.
#[derive(Clone, Copy, Debug)]
struct Prepared {
    root: u32,
    nodes: u32,
    triangles: u32,
}

/// Returns the tree that the device builds over at most `triangles` triangles, as far as the host knows it.
/// The device sets the final root, number of triangles and number of nodes of four.
fn on_device(triangles: u32) -> Prepared {
    Prepared { root: BVH_NONE, nodes: triangles.saturating_sub(1), triangles }
}

/// Returns true if the capacity suffices for the whole tree. There is no partial tree: a build that does not
/// fit builds nothing.
fn has_capacity(config: &Config, sizes: &Sizes, extent: &GeometryExtent) -> bool {
    plan(config, extent.triangle_count.into()).is_ok_and(|wanted| !wanted.exceed(sizes))
}

/// Returns the header that the next build starts from.
fn first_header(
    config: &Config,
    sizes: &Sizes,
    extent: &GeometryExtent,
    Prepared { root, nodes, triangles }: Prepared,
) -> Header {
    let has_capacity = has_capacity(config, sizes, extent);
    let capacity = |pool| if has_capacity { sizes.elements_of(pool) as u32 } else { 0 };
    let pair_elements = if has_capacity { pair_elements(config, triangles.into()) as u32 } else { 0 };
    let node_capacity = capacity(Pool::Nodes) - pair_elements;
    let pair_capacity = match config.made_children() {
        Children::Two => node_capacity,
        Children::Four => pair_elements,
    };
    // Place of the primitive index of each record: behind the boxes, or in the second word of each key.
    let (order_offset, order_stride) = match config.builder {
        Builder::Sah => (BOX_WORDS as u32 * triangles, 1),
        Builder::Lbvh | Builder::Ploc | Builder::Trbvh | Builder::Refit => (1, 2),
    };
    Header {
        root,
        triangle_count: triangles,
        node_capacity,
        record_capacity: capacity(Pool::Records),
        scratch_capacity: capacity(Pool::Scratch),
        order_offset,
        order_stride,
        node_count: nodes,
        pair_capacity,
        ..Header::default()
    }
}

impl rasray_ads::kit::Demand for Demand {
    fn zip(self, other: Self, mut with: impl FnMut(&'static str, u64, u64) -> u64) -> Self {
        Self {
            nodes: with("nodes", self.nodes, other.nodes),
            records: with("records", self.records, other.records),
            scratch: with("scratch", self.scratch, other.scratch),
            triangles: self.triangles,
        }
    }
}

/// Returns the number of rounds that a ray needs if it hits every box of the tree.
fn most_rounds(parts: &Parts<Config>) -> u32 {
    // A ray tests each triangle once, enters each node once, and exits each child once after a pause.
    let units = 4 * u64::from(parts.geometry.triangle_count());
    let budget = u64::from(parts.work_budget);
    (units / budget + 2).min(u32::MAX.into()) as u32
}

impl Design for Passes {
    type Config = Config;
    type Header = Header;
    type Demand = Demand;
    type Pool = Pool;
    type Contents = Contents;

    const NAME: &'static str = NAME;
    const TITLE: &'static str = "the hierarchy";
    const BUILD_READS_SCENE: bool = false;
    const CORRUPTED: usize = offset_of!(Header, corrupted);
    const RECORDS: &'static [RecordLayout] =
        &[Header::LAYOUT, Node::LAYOUT, NodeOfFour::LAYOUT, Record::LAYOUT];
    const HAS_SURFACES_OF_TRIANGLES: bool = true;

    fn kind(_config: &Config) -> StructureKind {
        StructureKind::Primitive
    }

    fn depends_on(_config: &Config) -> Dependencies {
        Dependencies::default()
    }

    fn requirements(config: &Config) -> Requirements {
        let mut requirements = Requirements::compute();
        match config.loads {
            None => requirements.optional.push((Feature::Int64, "half as many loads on software devices")),
            Some(Loads::Bits32) => {}
            Some(Loads::Bits64) => requirements.required.push(Feature::Int64),
        }
        requirements
    }

    fn complete(device: &Device, config: &mut Config) {
        config.complete(device);
    }

    fn trace_variant(config: &Config) -> String {
        match config.loads {
            None | Some(Loads::Bits32) => String::new(),
            Some(Loads::Bits64) => ".words64".to_owned(),
        }
    }

    fn constants(config: &Config) -> Vec<(u32, u32)> {
        let cluster_leaf = if config.builder.merges_clusters() { config.made_leaf() } else { 1 };
        vec![(BVH_CHILDREN, config.made_children().number()), (BVH_CLUSTER_LEAF, cluster_leaf)]
    }

    fn first_plan(config: &Config, extent: &GeometryExtent) -> Result<Sizes, AdsError> {
        plan(config, extent.triangle_count.into())
    }

    fn plan(config: &Config, demand: &Demand) -> Result<Sizes, AdsError> {
        // The triangles determine everything that a tree needs. Its pools grow only after a resize to sizes
        // that are not those of its triangles.
        plan(config, demand.triangles)
    }

    fn plan_for(config: &Config, sizes: &Sizes, extent: &GeometryExtent) -> Result<Option<Sizes>, AdsError> {
        let wanted = plan(config, extent.triangle_count.into())?;
        Ok(wanted.exceed(sizes).then_some(wanted))
    }

    fn make(
        pipelines: &BuildPipelines<'_>,
        config: &Config,
        _scene: Option<&SceneBinding>,
    ) -> Result<Self, AdsError> {
        Ok(Self {
            build: Build::new(pipelines, config)?,
            prepared: None,
            trees: KeptTrees::default(),
            kept: None,
        })
    }

    fn builds_on_host(config: &Config) -> bool {
        config.builder == Builder::Sah
    }

    fn prepare(&mut self, parts: &mut Parts<Config>, device: &Device) -> Result<(), AdsError> {
        if parts.config.builder != Builder::Sah {
            return Ok(());
        }
        self.prepared = None;
        let (extent, sizes) = (parts.extent(), parts.pools.sizes());
        let unknown = on_device(extent.triangle_count);
        if !has_capacity(&parts.config, sizes, &extent) {
            // The status of the build reports the lack of capacity.
            self.prepared = Some(unknown);
            return Ok(());
        }
        let header = first_header(&parts.config, sizes, &extent, unknown);
        parts.pools.begin_unread::<Pool>(header);
        device.submit(|recorder| self.build.record_boxes(recorder, parts.target(None)))?;
        let triangles = parts.geometry.download_count(device)?;
        let boxes = device.download_as::<Box3>(parts.pools.pool(Pool::Scratch), 0, triangles as usize)?;
        let tree = host::build(&boxes, parts.config.made_leaf());
        let nodes = match parts.config.made_children() {
            Children::Two => {
                device.upload_slice(parts.pools.pool(Pool::Nodes), 0, &tree.nodes)?;
                tree.nodes.len()
            }
            Children::Four => {
                let nodes = with_four_children(&tree);
                device.upload_slice(parts.pools.pool(Pool::Nodes), 0, &nodes)?;
                nodes.len()
            }
        };
        let order_at = size_of::<Box3>() as u64 * u64::from(triangles);
        device.upload_slice(parts.pools.pool(Pool::Scratch), order_at, &tree.order)?;
        self.prepared = Some(Prepared { root: tree.root, nodes: nodes as u32, triangles });
        Ok(())
    }

    fn forget(&mut self) {
        self.prepared = None;
        self.trees.forget();
    }

    fn completed(&self, header: &Header) {
        self.trees.see(header);
    }

    fn overwritten(&self) {
        self.trees.forget();
    }

    fn first_header(&mut self, parts: &Parts<Config>, _viewpoint: Viewpoint) -> Result<Header, AdsError> {
        let extent = parts.extent();
        let triangles = extent.triangle_count;
        // A number of triangles that the device counts may differ in each build.
        let is_fixed = parts.geometry.desc().count.is_none();
        self.kept = if parts.config.builder == Builder::Refit && is_fixed { self.trees.next() } else { None };
        let prepared = match parts.config.builder {
            // The triangles may move after a build, so a tree serves one build only.
            Builder::Sah => self.prepared.take().ok_or(AdsError::NotPrepared { structure: NAME })?,
            Builder::Lbvh | Builder::Ploc | Builder::Trbvh | Builder::Refit => on_device(triangles),
        };
        let first = first_header(&parts.config, parts.pools.sizes(), &extent, prepared);
        let header = Header { tree: self.trees.number(), ..first };
        Ok(match self.kept {
            // The device sets the root and the number of nodes to those of the tree that it holds. Records
            // keep their triangles.
            Some(made) => Header { order_stride: 0, level_count: made.levels, node_count: 0, ..header },
            None => header,
        })
    }

    fn record_passes(&self, recorder: &mut Recorder<'_>, parts: &Parts<Config>, scene: Option<&BindingSet>) {
        self.build.record(recorder, parts.target(scene), self.kept);
    }

    fn asked(&self, parts: &Parts<Config>, header: &Header) -> Demand {
        let extent = parts.extent();
        let triangles = u64::from(extent.triangle_count);
        let wanted = plan(&parts.config, triangles).unwrap_or_default();
        // The build counts the nodes of a tree. All other demand follows from the number of triangles.
        let nodes = if has_capacity(&parts.config, parts.pools.sizes(), &extent) {
            u64::from(header.node_count) + pair_elements(&parts.config, triangles)
        } else {
            wanted.elements_of(Pool::Nodes)
        };
        Demand {
            nodes,
            records: wanted.elements_of(Pool::Records),
            scratch: wanted.elements_of(Pool::Scratch),
            triangles,
        }
    }

    fn capacity(_config: &Config, sizes: &Sizes, extent: &GeometryExtent) -> Demand {
        Demand {
            nodes: sizes.elements_of(Pool::Nodes),
            records: sizes.elements_of(Pool::Records),
            scratch: sizes.elements_of(Pool::Scratch),
            triangles: extent.triangle_count.into(),
        }
    }

    fn ample_rounds(parts: &Parts<Config>, _header: &Header) -> u32 {
        most_rounds(parts)
    }

    fn most_rounds(parts: &Parts<Config>) -> Option<u32> {
        Some(most_rounds(parts))
    }

    /// Returns the elements of a pool in use. A tree may have fewer nodes than its triangles could need.
    fn used(_parts: &Parts<Config>, asked: &Demand, pool: Pool) -> Option<u64> {
        match pool {
            Pool::Header => None,
            Pool::Nodes => Some(asked.nodes),
            Pool::Records => Some(asked.records),
            Pool::Scratch => Some(asked.scratch),
        }
    }

    fn report(parts: &Parts<Config>, header: &Header, asked: &Demand) -> StructureReport {
        StructureReport {
            options: parts.config.options(),
            paths: parts.config.paths(),
            formula_bytes: formula_bytes(&parts.config, header.node_count.into(), asked.triangles).total(),
            stored: Some(header.triangle_count.into()),
            ..StructureReport::default()
        }
    }

    fn fault(contents: &Contents, _triangles: u32) -> Option<String> {
        well_formed(contents).err().map(|fault| fault.to_string())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const BOUNDS: [[f32; 3]; 2] = [[0.0; 3], [4.0, 2.0, 1.0]];

    #[test]
    fn pools_are_planned_without_a_device() {
        let extent = GeometryExtent::new(1_000, BOUNDS);
        for config in [Config::new(Builder::Sah), Config::new(Builder::Ploc), Config::new(Builder::Refit)] {
            let sizes = Passes::first_plan(&config, &extent).expect("options are in range");
            // The capacity of these pools, expressed as a demand, has to plan these pools again.
            let capacity = Passes::capacity(&config, &sizes, &extent);
            assert_eq!(Passes::plan(&config, &capacity).expect("options are in range"), sizes, "{config:?}");
            let of = |triangles| {
                let extent = GeometryExtent::new(triangles, BOUNDS);
                Passes::plan_for(&config, &sizes, &extent).expect("options are in range")
            };
            assert_eq!([0, 1, 500, 1_000].map(of), [const { None }; 4], "{config:?}");
            assert!(of(2_000).is_some_and(|larger| larger.exceed(&sizes)), "{config:?}");
        }
    }
}
