//! The build on the device: pipelines, and the passes in the order they are recorded.

use bytemuck::{Pod, Zeroable, bytes_of};
use rasray_ads::{AdsError, Geometry, SceneBinding};
use rasray_gpu::{
    Access, BindingSet, Buffer, ComputePipeline, ComputePipelineDesc, Device, Recorder, SetLayout,
};
use rasray_shaders_glsl::Shader;
use rasray_shaders_glsl::constants::bvh::{BVH_DIGITS, BVH_GROUP_SIZE, BVH_SORT_CHUNK};

use crate::layout::{NAME, union_levels};
use crate::{Addressing, Builder, Config};

/// The module of that name for a configuration.
fn find(config: &Config, name: &str) -> Result<&'static Shader, AdsError> {
    let suffix = match config.addressing {
        Addressing::Descriptor => "",
        Addressing::Address => ".address",
    };
    // Modules with the scene's set are the only ones that may not have been compiled.
    rasray_shaders_glsl::shader(&format!("bvh/{name}{suffix}")).ok_or(AdsError::NoScene { structure: NAME })
}

/// Modules of the traces.
pub(crate) struct TraceModules {
    pub(crate) closest: &'static Shader,
    pub(crate) occluded: &'static Shader,
    pub(crate) surfaces: Option<&'static Shader>,
}

/// Finds the modules of the traces.
///
/// # Errors
/// The scene has alpha masks and this crate was compiled without the feature `scene`.
pub(crate) fn trace_modules(config: &Config, scene: Option<&SceneBinding>) -> Result<TraceModules, AdsError> {
    let alpha = scene.is_some_and(|scene| scene.alpha_masked);
    Ok(TraceModules {
        closest: find(config, if alpha { "trace_closest.alpha" } else { "trace_closest" })?,
        occluded: find(config, if alpha { "trace_occluded.alpha" } else { "trace_occluded" })?,
        surfaces: find(config, "surfaces").ok(),
    })
}

/// Address of the tree (zero with descriptors), and digit of the sort or level of the unions.
#[repr(C)]
#[derive(Clone, Copy, Pod, Zeroable)]
struct BuildConstants {
    tree: [u32; 2],
    step: u32,
}

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
    Lbvh(Box<LbvhPipelines>),
}

#[derive(Debug)]
struct LbvhPipelines {
    codes: ComputePipeline,
    counts: ComputePipeline,
    sums: ComputePipeline,
    scan: ComputePipeline,
    starts: ComputePipeline,
    scatter: ComputePipeline,
    unions: ComputePipeline,
    topology: ComputePipeline,
}

/// What one recording of the build works on.
pub(crate) struct Target<'a> {
    pub(crate) geometry: &'a Geometry,
    pub(crate) set: Option<&'a BindingSet>,
    pub(crate) address: u64,
    pub(crate) header_source: &'a Buffer,
    pub(crate) header: &'a Buffer,
    pub(crate) header_readback: &'a Buffer,
}

impl Build {
    pub(crate) fn new(
        device: &Device,
        config: &Config,
        geometry: &Geometry,
        structure: &SetLayout,
    ) -> Result<Self, AdsError> {
        let compute = |name: &str| -> Result<ComputePipeline, AdsError> {
            let shader = find(config, name)?;
            Ok(device.create_compute_pipeline(&ComputePipelineDesc {
                name: shader.name,
                spirv: shader.words(),
                sets: &[geometry.layout(), structure],
                push_constant_bytes: size_of::<BuildConstants>() as u32,
                constants: &[],
            })?)
        };
        let of_builder = match config.builder {
            Builder::Sah => OfBuilder::Sah { boxes: compute("build_1_boxes")? },
            Builder::Lbvh => OfBuilder::Lbvh(Box::new(LbvhPipelines {
                codes: compute("build_2_codes")?,
                counts: compute("build_3_counts")?,
                sums: compute("build_4_sums")?,
                scan: compute("build_5_scan")?,
                starts: compute("build_6_starts")?,
                scatter: compute("build_7_scatter")?,
                unions: compute("build_9_unions")?,
                topology: compute("build_10_topology")?,
            })),
        };
        Ok(Self { of_builder, records: compute("build_8_records")?, status: compute("build_11_status")? })
    }

    /// Records what the host needs to know of the triangles. The host has written `header_source`.
    pub(crate) fn record_boxes(&self, recorder: &mut Recorder<'_>, target: &Target<'_>) {
        let OfBuilder::Sah { boxes } = &self.of_builder else { return };
        record_header(recorder, target);
        recorder.begin_pass("bvh/build_1_boxes");
        dispatch(recorder, boxes, target, 0, target.geometry.triangle_count());
        recorder.barrier(Access::COMPUTE, Access::TRANSFER_READ);
        recorder.end_pass();
    }

    /// Records all passes. The host has written `header_source`.
    pub(crate) fn record(&self, recorder: &mut Recorder<'_>, target: &Target<'_>) {
        record_header(recorder, target);
        let triangles = target.geometry.triangle_count();
        if let OfBuilder::Lbvh(pipelines) = &self.of_builder {
            pipelines.record_order(recorder, target);
        }
        pass(recorder, target, "bvh/build_8_records", &self.records, 0, triangles);
        if let OfBuilder::Lbvh(pipelines) = &self.of_builder {
            pipelines.record_nodes(recorder, target);
        }
        recorder.begin_pass("bvh/build_11_status");
        dispatch(recorder, &self.status, target, 0, 1);
        recorder.barrier(Access::COMPUTE, Access::COMPUTE | Access::TRANSFER_READ);
        recorder.copy(target.header, 0, target.header_readback, 0, target.header.size());
        recorder.barrier(Access::TRANSFER_WRITE, Access::HOST_READ);
        recorder.end_pass();
    }
}

impl LbvhPipelines {
    /// Codes, and the order of the triangles by them.
    fn record_order(&self, recorder: &mut Recorder<'_>, target: &Target<'_>) {
        let triangles = target.geometry.triangle_count();
        let chunks = triangles.div_ceil(BVH_SORT_CHUNK);
        pass(recorder, target, "bvh/build_2_codes", &self.codes, 0, triangles);
        // Four digits take the keys from the first buffer to the second and back twice.
        for digit in 0..BVH_DIGITS {
            pass(recorder, target, "bvh/build_3_counts", &self.counts, digit, chunks);
            pass(recorder, target, "bvh/build_4_sums", &self.sums, digit, chunks);
            // One workgroup, however large.
            pass(recorder, target, "bvh/build_5_scan", &self.scan, digit, chunks.min(1));
            pass(recorder, target, "bvh/build_6_starts", &self.starts, digit, chunks);
            pass(recorder, target, "bvh/build_7_scatter", &self.scatter, digit, chunks);
        }
    }

    /// Nodes over the records.
    fn record_nodes(&self, recorder: &mut Recorder<'_>, target: &Target<'_>) {
        let triangles = target.geometry.triangle_count();
        for (level, boxes) in (0..).zip(union_levels(triangles.into())) {
            pass(recorder, target, "bvh/build_9_unions", &self.unions, level, boxes as u32);
        }
        let nodes = triangles.saturating_sub(1);
        pass(recorder, target, "bvh/build_10_topology", &self.topology, 0, nodes);
    }
}

/// A pass with an invocation per item, visible to the next one.
fn pass(
    recorder: &mut Recorder<'_>,
    target: &Target<'_>,
    label: &str,
    pipeline: &ComputePipeline,
    step: u32,
    items: u32,
) {
    recorder.begin_pass(label);
    dispatch(recorder, pipeline, target, step, items);
    recorder.barrier(Access::COMPUTE, Access::COMPUTE);
    recorder.end_pass();
}

fn record_header(recorder: &mut Recorder<'_>, target: &Target<'_>) {
    recorder.begin_pass("bvh/build_0_header");
    recorder.barrier(Access::ALL, Access::TRANSFER_WRITE);
    recorder.copy(target.header_source, 0, target.header, 0, target.header.size());
    recorder.barrier(Access::TRANSFER_WRITE, Access::COMPUTE);
    recorder.end_pass();
}

/// One invocation per item; more groups than one dimension holds go to the second.
fn dispatch(
    recorder: &mut Recorder<'_>,
    pipeline: &ComputePipeline,
    target: &Target<'_>,
    step: u32,
    items: u32,
) {
    let groups = items.div_ceil(BVH_GROUP_SIZE);
    if groups == 0 {
        return;
    }
    let rows = groups.div_ceil(32_768);
    let tree = [target.address as u32, (target.address >> 32) as u32];
    recorder.bind_compute(pipeline);
    recorder.bind_sets(0, &[target.geometry.set()]);
    if let Some(set) = target.set {
        recorder.bind_sets(1, &[set]);
    }
    recorder.push_constants(bytes_of(&BuildConstants { tree, step }));
    recorder.dispatch([groups.div_ceil(rows), rows, 1]);
}
