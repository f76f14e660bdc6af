//! Build of the voxels: its pipelines, and its passes in the order they are recorded.

use std::mem::offset_of;

use rasray_ads::kit::{
    BuildPipelines, BuildTarget, LargePass, Lengths, ListSort, Scan, ViewDraw, Visit, Visits, workgroups,
};
use rasray_ads::{AdsError, SceneBinding};
use rasray_gpu::{Access, ComputePipeline, Recorder, Stage};
use rasray_shaders_glsl::constants::voxel::VOXEL_SCAN_OCTANTS;

use crate::layout::{levels, list_count, scratch, upper_nodes};
use crate::{Axes, Config, Header, Leaves, Marking, Payload, Pool, Storage, Traversal};

/// Pipelines of the build, which are the design of [`Voxels`](crate::Voxels).
#[derive(Debug)]
pub struct Build {
    large: Option<LargePass>,
    voxels: Option<Visit>,
    axes: Option<ComputePipeline>,
    lengths: Option<Lengths>,
    store: Option<Visit>,
    sort: Option<ListSort>,
    longest: Option<ComputePipeline>,
    octree: Option<Octree>,
    status: ComputePipeline,
}

/// Pipelines of the passes that build the octree from complete voxels.
#[derive(Debug)]
struct Octree {
    octants: ComputePipeline,
    scan: Scan,
    nodes: ComputePipeline,
}

impl Octree {
    fn new(pipelines: &BuildPipelines<'_>) -> Result<Self, AdsError> {
        Ok(Self {
            octants: pipelines.compute("build_10_octants")?,
            scan: Scan::new(pipelines, "build_5_scan")?,
            nodes: pipelines.compute("build_11_nodes")?,
        })
    }

    fn record(&self, recorder: &mut Recorder<'_>, config: &Config, target: BuildTarget<'_>) {
        let upper = upper_nodes(config);
        recorder.begin_pass(Stage::Build, "voxel/build_10_octants");
        for level in (0..levels(config) - 1).rev() {
            target.dispatch(recorder, &self.octants, workgroups(1 << (3 * level)), level);
            recorder.barrier(Access::COMPUTE, Access::COMPUTE);
        }
        recorder.end_pass();
        self.scan.record(recorder, target, "voxel/build_5_scan", upper, VOXEL_SCAN_OCTANTS, Access::COMPUTE);
        target.items_pass(recorder, "voxel/build_11_nodes", &self.nodes, upper, 0, Access::COMPUTE);
    }
}

impl Build {
    /// Makes the pipelines that a configuration needs.
    ///
    /// # Errors
    /// The configuration needs the scene's shaders and there is no scene, or the device refuses a pipeline.
    pub(crate) fn new(
        pipelines: &BuildPipelines<'_>,
        config: &Config,
        scene: Option<&SceneBinding>,
    ) -> Result<Self, AdsError> {
        let stored = config.payload != Payload::Index;
        if stored {
            SceneBinding::for_payload(scene, "attributes")?;
        }
        let masked = SceneBinding::mask_suffix(scene);
        let variant = if stored { ".attributes" } else { masked };
        let visits = Visits { pipelines, builder: config.builder, groups: offset_of!(Header, groups) };
        let voxels = || visits.visit("build_columns", "build_2_voxels", "");
        let lengths = || {
            let count = visits.visit("build_raster", "build_4_count", masked)?;
            Lengths::new(pipelines, count, "build_5_scan")
        };
        let store = || visits.visit("build_raster", "build_6_store", variant);
        let keeps = config.leaves == Leaves::Fragments;
        let sort = || ListSort::new(pipelines, "build_7_sort", "", "build_8_sort_long");
        Ok(Self {
            large: visits.large("build_1_large")?,
            voxels: (config.marking() == Marking::Triangles).then(voxels).transpose()?,
            axes: (config.axes != Axes::Triangle).then(|| pipelines.compute("build_3_axes")).transpose()?,
            lengths: (keeps && config.storage == Storage::Contiguous).then(lengths).transpose()?,
            store: keeps.then(store).transpose()?,
            sort: config.sorts().then(sort).transpose()?,
            longest: (keeps && !config.bisects())
                .then(|| pipelines.compute("build_9_longest"))
                .transpose()?,
            octree: (config.traversal == Traversal::Octree).then(|| Octree::new(pipelines)).transpose()?,
            status: pipelines.compute("build_12_status")?,
        })
    }

    /// Records all passes of a build.
    pub(crate) fn record(&self, recorder: &mut Recorder<'_>, config: &Config, target: BuildTarget<'_>) {
        let lists = list_count(config.resolution);
        let words = u64::from(config.grid()).pow(3).div_ceil(8);
        // If each triangle is kept only in the view it faces most, one instance draws it, in that view.
        let views = if config.axes == Axes::Triangle { 1 } else { 3 };
        let views = [ViewDraw { side: config.resolution + 2, views, first: 0 }];
        let columns = [ViewDraw { side: config.grid() + 2, views: 1, first: 0 }];
        let shaders = Access::COMPUTE | Access::FRAGMENT;
        let cleared: &[Pool] = match config.axes {
            Axes::Triangle => &[Pool::Voxels, Pool::Lists],
            Axes::All | Axes::Voxel => &[Pool::Voxels, Pool::Normals, Pool::Lists],
        };

        target.record_header(recorder, "voxel/build_0_header", cleared, shaders | Access::VERTEX_READ);
        if let Some(large) = &self.large {
            large.record(recorder, target);
        }
        if let Some(voxels) = &self.voxels {
            voxels.record(recorder, target, &columns);
        }
        let axes = |recorder: &mut Recorder<'_>| {
            if let Some(axes) = &self.axes {
                target.items_pass(recorder, "voxel/build_3_axes", axes, words, 0, shaders);
            }
        };
        // If all views keep all fragments, the pass that stores fragments also sums normals, so the axes
        // follow it.
        // follow it.
        if config.axes == Axes::Voxel {
            axes(recorder);
        }
        if let Some(lengths) = &self.lengths {
            lengths.record(recorder, target, &views, lists, shaders);
        }
        if let Some(store) = &self.store {
            store.record(recorder, target, &views);
        }
        if config.axes == Axes::All {
            axes(recorder);
        }
        if let Some(sort) = &self.sort {
            let linked = config.storage == Storage::Linked;
            let long = scratch(config).long_capacity(target.pools.sizes());
            sort.record(recorder, target, lists, linked, long, Access::COMPUTE);
        }
        if let Some(longest) = &self.longest {
            target.items_pass(recorder, "voxel/build_9_longest", longest, lists, 0, Access::COMPUTE);
        }
        if let Some(octree) = &self.octree {
            octree.record(recorder, config, target);
        }
        target.status_pass(recorder, "voxel/build_12_status", &self.status);
    }
}
