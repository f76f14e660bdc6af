//! The build: pipelines, and the passes in the order they are recorded.

use rasray_ads::{AdsError, BuildPipelines, BuildTarget, SceneBinding};
use rasray_gpu::{Access, ComputePipeline, RasterPipeline, Recorder};
use rasray_shaders_glsl::constants::abuffer::ABUFFER_GROUP_SIZE;

use crate::layout::cell_count;
use crate::{Accept, Config, Payload};

/// Faces of the cube.
const VIEWS: u32 = 6;

/// Pipelines of the build.
#[derive(Debug)]
pub(crate) struct Build {
    near: ComputePipeline,
    bounds: RasterPipeline,
    scale: Option<ComputePipeline>,
    store: RasterPipeline,
    reorder: Option<ComputePipeline>,
    status: ComputePipeline,
}

impl Build {
    /// # Errors
    /// The configuration needs the scene's shaders and there is no scene, or the device refuses a pipeline.
    pub(crate) fn new(
        pipelines: &BuildPipelines<'_>,
        config: &Config,
        scene: Option<&SceneBinding>,
    ) -> Result<Self, AdsError> {
        let alpha = scene.is_some_and(|scene| scene.alpha_masked);
        let attributes = config.payload == Payload::Attributes;
        if attributes && scene.is_none() {
            return Err(AdsError::Option {
                option: "payload",
                value: "attributes".to_owned(),
                expected: "attributes are read from a scene; without one use `index`",
            });
        }
        let store = match (attributes, alpha) {
            (true, _) => "build_4_store.attributes",
            (false, true) => "build_4_store.alpha",
            (false, false) => "build_4_store",
        };
        let bounds = if alpha { "build_2_bounds.alpha" } else { "build_2_bounds" };
        let plane = config.accept == Accept::Plane;
        Ok(Self {
            near: pipelines.compute("build_1_near")?,
            bounds: pipelines.raster("build_raster", bounds)?,
            scale: plane.then(|| pipelines.compute("build_3_scale")).transpose()?,
            store: pipelines.raster("build_raster", store)?,
            reorder: config.sort.then(|| pipelines.compute("build_5_reorder")).transpose()?,
            status: pipelines.compute("build_6_status")?,
        })
    }

    /// Records all passes.
    pub(crate) fn record(&self, recorder: &mut Recorder<'_>, config: &Config, target: BuildTarget<'_>) {
        let cells = cell_count(config.resolution);
        let groups = |items: u64| items.div_ceil(u64::from(ABUFFER_GROUP_SIZE));
        let triangles = u64::from(target.geometry.triangle_count());
        let side = config.resolution + 2;
        let shaders = Access::COMPUTE | Access::FRAGMENT;

        let cleared = ["bounds", "lists", "nodes"];
        let readers = shaders | Access::VERTEX_READ;
        target.pools.record_header(recorder, "abuffer/build_0_clear", &cleared, readers);
        let near = groups(triangles);
        target.compute_pass(recorder, "abuffer/build_1_near", &self.near, near, 0, Access::COMPUTE);
        target.raster_pass(recorder, "abuffer/build_2_bounds", &self.bounds, side, VIEWS);
        if let Some(scale) = &self.scale {
            target.compute_pass(recorder, "abuffer/build_3_scale", scale, groups(cells), 0, shaders);
        }
        target.raster_pass(recorder, "abuffer/build_4_store", &self.store, side, VIEWS);
        if let Some(reorder) = &self.reorder {
            let lists = groups(cells * u64::from(config.buckets));
            target.compute_pass(recorder, "abuffer/build_5_reorder", reorder, lists, 0, Access::COMPUTE);
        }
        target.status_pass(recorder, "abuffer/build_6_status", &self.status);
    }
}
