//! Build on the device: its pipelines, and its passes in the order they are recorded.

use rasray_ads::AdsError;
use rasray_ads::kit::{BuildPipelines, BuildTarget, Scan, workgroups};
use rasray_gpu::{Access, ComputePipeline, Recorder, Stage};
use rasray_shaders_glsl::constants::bvh::{
    BVH_CLUSTERS, BVH_DIGITS, BVH_TREELET_CLASSES, BVH_TREELET_ROUNDS,
};

use crate::kept::Made;
use crate::layout::{
    cluster_levels, digit_counts, level_invocations, most_nodes, sort_chunks, treelet_classes, union_levels,
};
use crate::{Builder, Children, Chunks, Config, Loads, Pool};

/// Pipelines of the build.
#[derive(Debug)]
pub(crate) struct Build {
    of_builder: OfBuilder,
    records: ComputePipeline,
    status: ComputePipeline,
}

#[derive(Debug)]
enum OfBuilder {
    Sah { boxes: ComputePipeline },
    Device(Box<DevicePipelines>),
}

#[derive(Debug)]
struct DevicePipelines {
    codes: ComputePipeline,
    chunks: Chunks,
    counts: ComputePipeline,
    scan: Scan,
    scatter: ComputePipeline,
    tree: TreePipelines,
    /// Passes that restructure treelets of the tree by Morton codes.
    treelets: Option<TreeletPipelines>,
    /// Passes that make nodes of four children from nodes of two.
    fours: Option<FourPipelines>,
    /// Passes of trees that later builds keep.
    refit: Option<RefitPipelines>,
}

/// Pipelines that make the nodes of two children over the records.
#[derive(Debug)]
enum TreePipelines {
    /// Each node is made by itself, from the Morton codes.
    OfCodes { unions: ComputePipeline, topology: ComputePipeline },
    /// Nodes are made by merging clusters.
    OfClusters { clusters: ComputePipeline, chunks: Chunks },
}

#[derive(Debug)]
struct TreeletPipelines {
    sizes: ComputePipeline,
    chains: ComputePipeline,
    treelets: ComputePipeline,
}

#[derive(Debug)]
struct RefitPipelines {
    levels: ComputePipeline,
    places: ComputePipeline,
    listed: ComputePipeline,
    refit: ComputePipeline,
    /// Pass of the last level, where an invocation may read boxes that it wrote. It reads words of 32 bits as
    /// it writes them; in other words it might not see them.
    refit_last: ComputePipeline,
}

#[derive(Debug)]
struct FourPipelines {
    openings: ComputePipeline,
    tops: ComputePipeline,
    list: ComputePipeline,
    fours: ComputePipeline,
}

impl Build {
    pub(crate) fn new(pipelines: &BuildPipelines<'_>, config: &Config) -> Result<Self, AdsError> {
        let of_builder = match config.builder {
            Builder::Sah => OfBuilder::Sah { boxes: pipelines.compute("build_1_boxes")? },
            Builder::Lbvh | Builder::Ploc | Builder::Trbvh | Builder::Refit => {
                OfBuilder::Device(Box::new(DevicePipelines::new(pipelines, config)?))
            }
        };
        let records = pipelines.compute("build_6_records")?;
        Ok(Self { of_builder, records, status: pipelines.compute("build_20_status")? })
    }

    /// Records the pass that writes the boxes of triangles for a build on the host. The host has written the
    /// header.
    pub(crate) fn record_boxes(&self, recorder: &mut Recorder<'_>, target: BuildTarget<'_>) {
        let OfBuilder::Sah { boxes } = &self.of_builder else { return };
        record_header(recorder, target);
        recorder.begin_pass(Stage::Build, "bvh/build_1_boxes");
        target.dispatch(recorder, boxes, workgroups(target.geometry.triangle_count().into()), 0);
        recorder.barrier(Access::COMPUTE, Access::TRANSFER_READ);
        recorder.end_pass();
    }

    /// Records all passes of a build or, if a tree is kept, those that compute its boxes anew. The host has
    /// written the header.
    pub(crate) fn record(&self, recorder: &mut Recorder<'_>, target: BuildTarget<'_>, kept: Option<Made>) {
        record_header(recorder, target);
        match (&self.of_builder, kept) {
            (OfBuilder::Sah { .. }, _) => self.record_records(recorder, target),
            (OfBuilder::Device(pipelines), Some(made)) => {
                self.record_records(recorder, target);
                pipelines.record_kept(recorder, target, made);
            }
            (OfBuilder::Device(pipelines), None) => {
                pipelines.record_order(recorder, target);
                self.record_records(recorder, target);
                pipelines.record_tree(recorder, target);
            }
        }
        target.status_pass(recorder, "bvh/build_20_status", &self.status);
    }

    fn record_records(&self, recorder: &mut Recorder<'_>, target: BuildTarget<'_>) {
        pass(recorder, target, "bvh/build_6_records", &self.records, 0, target.geometry.triangle_count());
    }
}

impl DevicePipelines {
    fn new(pipelines: &BuildPipelines<'_>, config: &Config) -> Result<Self, AdsError> {
        let compute = |name| pipelines.compute(name);
        let chunks = config.chunks.unwrap_or(Chunks::Shared);
        let (counts, scatter) = match chunks {
            Chunks::Serial => ("build_3_counts", "build_5_scatter"),
            Chunks::Shared => ("build_3_counts.shared", "build_5_scatter.shared"),
        };
        let treelets = (config.builder == Builder::Trbvh).then(|| TreeletPipelines::new(pipelines));
        let refit = (config.builder == Builder::Refit).then(|| RefitPipelines::new(pipelines, config.loads));
        let fours = (config.made_children() == Children::Four).then(|| FourPipelines::new(pipelines));
        Ok(Self {
            codes: compute("build_2_codes")?,
            chunks,
            counts: compute(counts)?,
            scan: Scan::new(pipelines, "build_4_scan")?,
            scatter: compute(scatter)?,
            tree: TreePipelines::new(pipelines, config.builder, chunks)?,
            treelets: treelets.transpose()?,
            fours: fours.transpose()?,
            refit: refit.transpose()?,
        })
    }

    /// Records the passes that find Morton codes and sort the triangles by them.
    fn record_order(&self, recorder: &mut Recorder<'_>, target: BuildTarget<'_>) {
        let triangles = target.geometry.triangle_count();
        let counts = digit_counts(triangles.into());
        let groups = self.chunks.groups(sort_chunks(triangles.into()));
        let chunk_pass = |recorder: &mut Recorder<'_>, label, pipeline, digit| {
            target.compute_pass(recorder, label, pipeline, groups, digit, Access::COMPUTE);
        };
        pass(recorder, target, "bvh/build_2_codes", &self.codes, 0, triangles);
        // Each of four digits takes the keys from one buffer to the other, so they end in the first buffer.
        for digit in 0..BVH_DIGITS {
            chunk_pass(recorder, "bvh/build_3_counts", &self.counts, digit);
            self.scan.record(recorder, target, "bvh/build_4_scan", counts, digit, Access::COMPUTE);
            chunk_pass(recorder, "bvh/build_5_scatter", &self.scatter, digit);
        }
    }

    /// Records the passes that make nodes over the records.
    fn record_tree(&self, recorder: &mut Recorder<'_>, target: BuildTarget<'_>) {
        self.tree.record(recorder, target);
        if let Some(treelets) = &self.treelets {
            treelets.record(recorder, target);
        }
        if let Some(fours) = &self.fours {
            fours.record(recorder, target, &self.scan, self.refit.is_some());
        }
        if let Some(refit) = &self.refit {
            refit.record_made(recorder, target);
        }
    }

    /// Records the passes that compute records and boxes of a kept tree.
    fn record_kept(&self, recorder: &mut Recorder<'_>, target: BuildTarget<'_>, made: Made) {
        if let Some(refit) = &self.refit {
            refit.record_kept(recorder, target, made);
        }
    }
}

impl TreePipelines {
    fn new(pipelines: &BuildPipelines<'_>, builder: Builder, chunks: Chunks) -> Result<Self, AdsError> {
        let compute = |name| pipelines.compute(name);
        Ok(if builder.merges_clusters() {
            let name = match chunks {
                Chunks::Serial => "build_8_topology.clusters",
                Chunks::Shared => "build_8_topology.clusters.shared",
            };
            Self::OfClusters { clusters: compute(name)?, chunks }
        } else {
            Self::OfCodes { unions: compute("build_7_unions")?, topology: compute("build_8_topology")? }
        })
    }

    fn record(&self, recorder: &mut Recorder<'_>, target: BuildTarget<'_>) {
        let triangles = target.geometry.triangle_count();
        match self {
            Self::OfCodes { unions, topology } => {
                for (level, boxes) in (0..).zip(union_levels(triangles.into())) {
                    pass(recorder, target, "bvh/build_7_unions", unions, level, boxes as u32);
                }
                pass(recorder, target, "bvh/build_8_topology", topology, 0, triangles.saturating_sub(1));
            }
            Self::OfClusters { clusters, chunks } => {
                for (level, count) in (0..).zip(cluster_levels(triangles.into())) {
                    let groups = chunks.groups(count.div_ceil(BVH_CLUSTERS.into()));
                    target.compute_pass(
                        recorder,
                        "bvh/build_8_topology",
                        clusters,
                        groups,
                        level,
                        Access::COMPUTE,
                    );
                }
            }
        }
    }
}

impl TreeletPipelines {
    fn new(pipelines: &BuildPipelines<'_>) -> Result<Self, AdsError> {
        Ok(Self {
            sizes: pipelines.compute("build_10_sizes")?,
            chains: pipelines.compute("build_11_chains")?,
            treelets: pipelines.compute("build_12_treelets")?,
        })
    }

    /// Records all rounds. In each round the classes of subtrees, by size, follow one after the other, since
    /// subtrees of a class depend on those of smaller classes.
    fn record(&self, recorder: &mut Recorder<'_>, target: BuildTarget<'_>) {
        let triangles = target.geometry.triangle_count();
        let counts = BVH_TREELET_ROUNDS * BVH_TREELET_CLASSES;
        pass(recorder, target, "bvh/build_10_sizes", &self.sizes, 0, triangles.max(counts));
        for round in 0..BVH_TREELET_ROUNDS {
            for (class, chains) in treelet_classes(triangles, round) {
                if class == round {
                    pass(recorder, target, "bvh/build_11_chains", &self.chains, round, triangles);
                }
                let step = BVH_TREELET_CLASSES * round + class;
                pass(recorder, target, "bvh/build_12_treelets", &self.treelets, step, chains);
            }
        }
    }
}

impl RefitPipelines {
    fn new(pipelines: &BuildPipelines<'_>, loads: Option<Loads>) -> Result<Self, AdsError> {
        let refit = match loads {
            Some(Loads::Bits64) => "build_9_refit.words64",
            None | Some(Loads::Bits32) => "build_9_refit",
        };
        Ok(Self {
            levels: pipelines.compute("build_17_levels")?,
            places: pipelines.compute("build_18_places")?,
            listed: pipelines.compute("build_19_listed")?,
            refit: pipelines.compute(refit)?,
            refit_last: pipelines.compute("build_9_refit")?,
        })
    }

    /// Records the passes that list the nodes of a new tree by level.
    fn record_made(&self, recorder: &mut Recorder<'_>, target: BuildTarget<'_>) {
        let nodes = most_nodes(Children::Four, target.geometry.triangle_count().into()) as u32;
        pass(recorder, target, "bvh/build_17_levels", &self.levels, 0, nodes);
        pass(recorder, target, "bvh/build_18_places", &self.places, 0, nodes);
        pass(recorder, target, "bvh/build_19_listed", &self.listed, 0, nodes + 1);
    }

    /// Records the pass of each level of the kept tree, from the leaves up.
    fn record_kept(&self, recorder: &mut Recorder<'_>, target: BuildTarget<'_>, made: Made) {
        for level in 0..made.levels {
            let pipeline = if level + 1 == made.levels { &self.refit_last } else { &self.refit };
            let nodes = level_invocations(level, made.nodes);
            pass(recorder, target, "bvh/build_9_refit", pipeline, level, nodes);
        }
    }
}

impl FourPipelines {
    fn new(pipelines: &BuildPipelines<'_>) -> Result<Self, AdsError> {
        Ok(Self {
            openings: pipelines.compute("build_13_openings")?,
            tops: pipelines.compute("build_14_tops")?,
            list: pipelines.compute("build_15_list")?,
            fours: pipelines.compute("build_16_fours")?,
        })
    }

    /// Records the passes that choose the nodes of two children that become nodes of four, number them, and
    /// make the nodes of four. If later builds may keep the tree, the header gets its cost.
    fn record(&self, recorder: &mut Recorder<'_>, target: BuildTarget<'_>, scan: &Scan, may_keep: bool) {
        let nodes = target.geometry.triangle_count().saturating_sub(1);
        pass(recorder, target, "bvh/build_13_openings", &self.openings, 0, nodes);
        pass(recorder, target, "bvh/build_14_tops", &self.tops, 0, nodes);
        scan.record(recorder, target, "bvh/build_4_scan", nodes.into(), BVH_DIGITS, Access::COMPUTE);
        pass(recorder, target, "bvh/build_15_list", &self.list, may_keep.into(), nodes);
        let most = most_nodes(Children::Four, target.geometry.triangle_count().into()) as u32;
        pass(recorder, target, "bvh/build_16_fours", &self.fours, may_keep.into(), most);
    }
}

impl Chunks {
    /// Returns the number of workgroups for this many chunks.
    fn groups(self, chunks: u64) -> u64 {
        match self {
            Self::Serial => workgroups(chunks),
            Self::Shared => chunks,
        }
    }
}

/// Records a pass with an invocation per item, whose writes the next pass can see.
fn pass(
    recorder: &mut Recorder<'_>,
    target: BuildTarget<'_>,
    label: &str,
    pipeline: &ComputePipeline,
    step: u32,
    items: u32,
) {
    target.items_pass(recorder, label, pipeline, items.into(), step, Access::COMPUTE);
}

fn record_header(recorder: &mut Recorder<'_>, target: BuildTarget<'_>) {
    target.record_header(recorder, "bvh/build_0_header", &[] as &[Pool], Access::COMPUTE);
}
