//! Passes of a build: making their pipelines, binding, dispatching and drawing.

use bytemuck::bytes_of;
use rasray_gpu::{
    Access, BindingSet, ComputePipeline, ComputePipelineDesc, Device, RasterOptions, RasterPipeline,
    RasterPipelineDesc, Recorder, SetLayout, Stage,
};
use rasray_shaders_glsl::records::BuildConstants;

use crate::kit::addressing::halves;
use crate::kit::groups::{folded, workgroups};
use crate::kit::{Modules, PoolName, Pools};
use crate::{AdsError, Geometry, SceneBinding};

/// Maker of the pipelines of a build. Their sets are geometry, structure and, if given, scene.
#[derive(Clone, Debug)]
pub struct BuildPipelines<'a> {
    device: &'a Device,
    modules: Modules,
    sets: Vec<&'a SetLayout>,
    constants: Vec<(u32, u32)>,
    raster: RasterOptions,
}

impl<'a> BuildPipelines<'a> {
    /// Makes a maker of pipelines; `constants` are the specialisation constants of the structure: id and
    /// bits.
    pub fn new(
        device: &'a Device,
        modules: Modules,
        geometry: &'a Geometry,
        pools: &'a Pools,
        scene: Option<&'a SceneBinding>,
        constants: &[(u32, u32)],
    ) -> Self {
        let mut sets = vec![geometry.layout(), pools.layout()];
        sets.extend(scene.map(|scene| &scene.layout));
        let constants =
            constants.iter().chain(scene.iter().flat_map(|scene| &scene.constants)).copied().collect();
        Self { device, modules, sets, constants, raster: RasterOptions::default() }
    }

    /// Returns a maker of the same pipelines whose draws cover every pixel that a triangle touches, which
    /// needs [`Feature::ConservativeRasterization`](rasray_gpu::Feature::ConservativeRasterization).
    #[must_use]
    pub fn touching(&self) -> Self {
        Self { raster: RasterOptions { conservative: true, ..self.raster }, ..self.clone() }
    }

    /// Returns the label of the pass of the module with that name.
    pub fn label(&self, name: &str) -> String {
        format!("{}/{name}", self.modules.prefix)
    }

    /// Makes a compute pipeline from the module with that name.
    ///
    /// # Errors
    /// The module is not compiled in, or the device refuses it.
    pub fn compute(&self, name: &str) -> Result<ComputePipeline, AdsError> {
        let shader = self.modules.find(name)?;
        Ok(self.device.create_compute_pipeline(&ComputePipelineDesc {
            name: shader.name,
            module: &shader.module(),
            sets: &self.sets,
            push_constant_bytes: size_of::<BuildConstants>() as u32,
            constants: &self.constants,
        })?)
    }

    /// Makes a raster pipeline without attachments from the vertex and the fragment shader with these names.
    ///
    /// # Errors
    /// A module is not compiled in, or the device refuses it.
    pub fn raster(&self, vertex: &str, fragment: &str) -> Result<RasterPipeline, AdsError> {
        let (vertex, fragment) = (self.modules.find(vertex)?, self.modules.find(fragment)?);
        let desc = RasterPipelineDesc {
            name: fragment.name,
            vertex_module: &vertex.module(),
            fragment_module: &fragment.module(),
            sets: &self.sets,
            push_constant_bytes: size_of::<BuildConstants>() as u32,
            constants: &self.constants,
        };
        Ok(self.device.create_raster_pipeline_with(&desc, self.raster)?)
    }
}

/// A group of views of one size that are drawn together, one instance each.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ViewDraw {
    /// Number of cells along a side, border included.
    pub side: u32,
    /// Number of views.
    pub views: u32,
    /// Number of the first view, which is instance 0.
    pub first: u32,
}

/// Triangles, pools and scene that the passes of one recording work on.
#[derive(Clone, Copy, Debug)]
pub struct BuildTarget<'a> {
    /// Triangles to build from.
    pub geometry: &'a Geometry,
    /// Pools to build into; the host has written the header.
    pub pools: &'a Pools,
    /// Pass that computes the values of the header that follow from bounds and eye.
    pub header_pass: &'a ComputePipeline,
    /// The scene's set, if the pipelines were made with a scene.
    pub scene: Option<&'a BindingSet>,
}

impl BuildTarget<'_> {
    fn bind(&self, recorder: &mut Recorder<'_>, step: u32) {
        recorder.bind_sets(0, &[self.geometry.set()]);
        if let Some(set) = self.pools.set() {
            recorder.bind_sets(1, &[set]);
        }
        if let Some(scene) = self.scene {
            recorder.bind_sets(2, &[scene]);
        }
        let structure = halves(self.pools.address());
        recorder.push_constants(bytes_of(&BuildConstants { structure, step }));
    }

    /// Records the first pass of a build. It writes the header from the host, zeros the pools of `cleared`,
    /// computes the values of the header that follow from bounds and eye, and checks the triangles. All
    /// results are visible to `readers`; the status pass reads the result of the check.
    pub fn record_header(
        &self,
        recorder: &mut Recorder<'_>,
        label: &str,
        cleared: &[impl PoolName],
        readers: Access,
    ) {
        recorder.begin_pass(Stage::Build, label);
        self.pools.record_header(recorder, self.geometry, cleared, Access::COMPUTE);
        self.dispatch(recorder, self.header_pass, 1, 0);
        recorder.barrier(Access::TRANSFER_WRITE | Access::COMPUTE_WRITE, readers | Access::HOST_READ);
        recorder.end_pass();
    }

    /// Records a dispatch of that number of workgroups; nothing for 0.
    pub fn dispatch(&self, recorder: &mut Recorder<'_>, pipeline: &ComputePipeline, groups: u64, step: u32) {
        let Some(groups) = folded(groups) else { return };
        recorder.bind_compute(pipeline);
        self.bind(recorder, step);
        recorder.dispatch(groups);
    }

    /// Records a labelled indirect pass. Its numbers of workgroups are three u32 of the header, at a byte
    /// that is a multiple of 4. The pass before must make the header visible to [`Access::INDIRECT_READ`].
    pub fn indirect_pass(
        &self,
        recorder: &mut Recorder<'_>,
        label: &str,
        pipeline: &ComputePipeline,
        offset: u64,
        step: u32,
        readers: Access,
    ) {
        recorder.begin_pass(Stage::Build, label);
        recorder.bind_compute(pipeline);
        self.bind(recorder, step);
        recorder.dispatch_indirect(self.pools.header_buffer(), offset);
        recorder.barrier(Access::COMPUTE, readers);
        recorder.end_pass();
    }

    /// Records a labelled pass of one dispatch of that many workgroups, whose results are visible to
    /// `readers` after it.
    pub fn compute_pass(
        &self,
        recorder: &mut Recorder<'_>,
        label: &str,
        pipeline: &ComputePipeline,
        groups: u64,
        step: u32,
        readers: Access,
    ) {
        recorder.begin_pass(Stage::Build, label);
        self.dispatch(recorder, pipeline, groups, step);
        recorder.barrier(Access::COMPUTE, readers);
        recorder.end_pass();
    }

    /// Records a labelled pass with an invocation per item, in workgroups of `BUILD_GROUP_SIZE`, as
    /// [`BuildTarget::compute_pass`].
    pub fn items_pass(
        &self,
        recorder: &mut Recorder<'_>,
        label: &str,
        pipeline: &ComputePipeline,
        items: u64,
        step: u32,
        readers: Access,
    ) {
        self.compute_pass(recorder, label, pipeline, workgroups(items), step, readers);
    }

    /// Records a labelled pass of several dispatches one after the other, each with its number as step;
    /// records nothing if there are no workgroups.
    pub fn rounds_pass(
        &self,
        recorder: &mut Recorder<'_>,
        label: &str,
        pipeline: &ComputePipeline,
        groups: u64,
        rounds: u32,
        readers: Access,
    ) {
        if groups == 0 {
            return;
        }
        recorder.begin_pass(Stage::Build, label);
        for round in 0..rounds {
            self.dispatch(recorder, pipeline, groups, round);
            recorder.barrier(Access::COMPUTE, Access::COMPUTE | readers);
        }
        recorder.end_pass();
    }

    /// Draws every triangle once per view onto a square of `side` cells; draws nothing if there are no
    /// triangles.
    pub fn draw(
        &self,
        recorder: &mut Recorder<'_>,
        pipeline: &RasterPipeline,
        side: u32,
        views: u32,
        step: u32,
    ) {
        let draw = ViewDraw { side, views, first: step };
        self.draw_onto(recorder, pipeline, draw, |recorder| self.geometry.record_draw(recorder, views));
    }

    /// Draws that number of vertices per view in place of those of all triangles; draws nothing if there are
    /// no triangles.
    pub fn draw_vertices(
        &self,
        recorder: &mut Recorder<'_>,
        pipeline: &RasterPipeline,
        draw: ViewDraw,
        vertices: u32,
    ) {
        self.draw_onto(recorder, pipeline, draw, |recorder| recorder.draw(vertices, draw.views, 0));
    }

    fn draw_onto(
        &self,
        recorder: &mut Recorder<'_>,
        pipeline: &RasterPipeline,
        draw: ViewDraw,
        record: impl FnOnce(&mut Recorder<'_>),
    ) {
        if self.geometry.triangle_count() == 0 {
            return;
        }
        recorder.begin_rendering(draw.side, draw.side);
        recorder.bind_raster(pipeline);
        self.bind(recorder, draw.first);
        record(recorder);
        recorder.end_rendering();
    }

    /// Records a labelled pass that draws every triangle once per view, onto squares of several sizes, with
    /// results visible to compute and fragment shaders after it. The push constant that is the step in other
    /// passes is here the number of a draw's first view.
    pub fn raster_views(
        &self,
        recorder: &mut Recorder<'_>,
        label: &str,
        pipeline: &RasterPipeline,
        draws: &[ViewDraw],
    ) {
        recorder.begin_pass(Stage::Build, label);
        for draw in draws {
            self.draw(recorder, pipeline, draw.side, draw.views, draw.first);
        }
        recorder.barrier(Access::FRAGMENT, Access::COMPUTE | Access::FRAGMENT);
        recorder.end_pass();
    }

    /// Records the last pass of every build: one workgroup checks whether the build stored everything, and
    /// the header is copied to the host.
    pub fn status_pass(&self, recorder: &mut Recorder<'_>, label: &str, pipeline: &ComputePipeline) {
        recorder.begin_pass(Stage::Build, label);
        recorder.barrier(Access::COMPUTE, Access::COMPUTE);
        self.dispatch(recorder, pipeline, 1, 0);
        self.pools.record_readback(recorder);
        recorder.end_pass();
    }
}
