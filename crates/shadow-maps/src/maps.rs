//! The maps on the device.

use bytemuck::{bytes_of, cast_slice};
use rasray_ads::kit::Modules;
use rasray_ads::{
    Addressing, AdsError, Domain, Geometry, Occluder, RayQueue, SceneBinding, Structure, Trace,
};
use rasray_gpu::{
    Access, BindingSet, Buffer, BufferDesc, BufferUsage, ComputePipeline, ComputePipelineDesc, Device,
    Feature, MemoryLocation, RasterPipeline, RasterPipelineDesc, Recorder, Requirements, SetLayout, Stage,
    TraceMode,
};
use rasray_shaders_glsl::constants::ads::GEOMETRY_DRAW_VIEWS;
use rasray_shaders_glsl::constants::shadow_maps::SHADOW_MAPS_EMPTY;
use rasray_shaders_glsl::records::{
    Light, ShadowMapsDrawConstants, ShadowMapsHeader, ShadowMapsQueueConstants,
};

use crate::Config;
use crate::layout::{sizes, texel_count, views_of_all, views_of_emitters};

const MODULES: Modules =
    Modules { structure: "shadow-maps", prefix: "shadow_maps", addressing: Addressing::Descriptor };

/// Threads of a workgroup of `shadow_maps/build_0_views`.
const LIGHTS_PER_GROUP: u32 = 64;

/// Lights that shadow rays lead to.
#[derive(Clone, Copy, Debug)]
pub struct Lights<'a> {
    /// [`Light`] records of lights without extent on the device, from its start. Each build reads where they
    /// are then.
    pub records: &'a Buffer,
    /// These records as the host knows them: which kinds there are, and how wide cones are. Where they are is
    /// not looked at.
    pub known: &'a [Light],
    /// Triangles that emit, where there are any.
    pub emitters: Option<Emitters<'a>>,
}

/// Triangles that emit. With [`Config::points`] each of them has maps.
#[derive(Clone, Copy, Debug)]
pub struct Emitters<'a> {
    /// [`EmissiveTriangle`](crate::EmissiveTriangle) records on the device, from its start, of which the
    /// triangle is read.
    pub records: &'a Buffer,
    /// Number of triangles.
    pub count: u32,
}

/// Shadow maps of all lights: a cube around each that shines everywhere, one view along each narrower cone,
/// one parallel view over all triangles for each light far away; and where [`Config::points`] asks for it a
/// cube around each of so many points on every emitting triangle, of which a ray takes the one nearest to its
/// end.
///
/// A build draws the triangles into every view. Rays that lead to a light
/// ([`Ray::light`](rasray_ads::Ray::light)) are answered by one comparison; a structure is asked for all
/// others: for rays without such a light, from outside of a view, and rays that pass back faces. Until a
/// build of the triangles that there are was recorded, it is asked for all.
///
/// There is one set of maps, which frames in flight on one queue use one after the other.
#[derive(Debug)]
pub struct ShadowMaps {
    config: Config,
    geometry: Geometry,
    scene: Option<SceneBinding>,
    build_views: ComputePipeline,
    build_depths: RasterPipeline,
    occluded: ComputePipeline,
    layout: SetLayout,
    views: Buffer,
    texels: Buffer,
    of_lights: OfLights,
}

/// Sizes and buffers that are made anew for other lights.
#[derive(Debug)]
struct OfLights {
    lights: u32,
    /// Points on all emitting triangles.
    points: u32,
    view_count: u32,
    table: Buffer,
    set: BindingSet,
}

impl ShadowMaps {
    /// Requirements of a device: the floor, stores of fragment shaders, and those of its modules.
    pub fn requirements() -> Requirements {
        let mut requirements = Requirements::floor();
        requirements.required.push(Feature::FragmentStoresAndAtomics);
        MODULES.add_to(&mut requirements);
        requirements
    }

    /// Makes pipelines and maps; nothing is built. `scene` has the alpha masks; without it geometry is
    /// opaque.
    ///
    /// # Errors
    /// An option out of range, or maps larger than the device draws or binds; out of memory, or the device
    /// lacks a feature or refuses a pipeline.
    pub fn new(
        device: &Device,
        config: Config,
        geometry: &Geometry,
        scene: Option<&SceneBinding>,
        lights: Lights<'_>,
    ) -> Result<Self, AdsError> {
        config.validate()?;
        device.require("shadow maps", &Self::requirements())?;
        if device.limits().max_framebuffer_size.iter().any(|&most| config.resolution + 2 > most) {
            return Err(AdsError::Option {
                option: "shadow-resolution",
                value: config.resolution.to_string(),
                expected: "with a border of one texel it is more than this device draws",
            });
        }
        let layout = device.create_set_layout("shadow maps", 5)?;
        let queue_layout = RayQueue::layout(device)?;
        let mask = SceneBinding::mask_suffix(scene);
        let masks = scene.filter(|scene| scene.alpha_masked);
        let compute =
            |name, sets: &[&SetLayout], push_constant_bytes: usize| -> Result<ComputePipeline, AdsError> {
                let shader = MODULES.find(name)?;
                Ok(device.create_compute_pipeline(&ComputePipelineDesc {
                    name: shader.name,
                    spirv: &shader.words(),
                    sets,
                    push_constant_bytes: push_constant_bytes as u32,
                    constants: &[],
                })?)
            };
        let build_views = compute("build_0_views", &[geometry.layout(), &layout], 0)?;
        let sets = [geometry.layout(), &layout, &queue_layout];
        let occluded = compute("occluded", &sets, size_of::<ShadowMapsQueueConstants>())?;
        let vertex = MODULES.find("build_raster")?;
        let fragment = MODULES.find(&format!("build_1_depths{mask}"))?;
        let mut sets = vec![geometry.layout(), &layout];
        sets.extend(masks.map(|scene| &scene.layout));
        let build_depths = device.create_raster_pipeline(&RasterPipelineDesc {
            name: fragment.name,
            vertex_spirv: &vertex.words(),
            fragment_spirv: &fragment.words(),
            sets: &sets,
            push_constant_bytes: size_of::<ShadowMapsDrawConstants>() as u32,
            constants: masks.map_or(&[][..], |scene| &scene.constants),
        })?;
        let (views, texels, of_lights) = made_for(device, &config, &layout, lights, None)?;
        Ok(Self {
            config,
            geometry: geometry.clone(),
            scene: scene.cloned(),
            build_views,
            build_depths,
            occluded,
            layout,
            views,
            texels,
            of_lights,
        })
    }

    /// Takes other lights from the next recording on; the maps grow where there are more. Nothing is built
    /// then. What was recorded before keeps the lights that it was recorded with. Nothing changes after an
    /// error.
    ///
    /// # Errors
    /// Maps larger than the device binds, or out of memory.
    pub fn set_lights(&mut self, device: &Device, lights: Lights<'_>) -> Result<(), AdsError> {
        let kept = Some((&self.views, &self.texels));
        (self.views, self.texels, self.of_lights) =
            made_for(device, &self.config, &self.layout, lights, kept)?;
        Ok(())
    }

    /// Takes other triangles from the next recording on. Until they are drawn, a structure is asked for every
    /// ray.
    pub fn set_geometry(&mut self, geometry: &Geometry) {
        self.geometry = geometry.clone();
    }

    /// Takes the scene that other triangles belong to, whose alpha masks the next build reads. Nothing
    /// changes after an error.
    ///
    /// # Errors
    /// [`AdsError::OtherScene`] where it has alpha masks and the one before had none, or other specialisation
    /// constants.
    pub fn set_scene(&mut self, scene: &SceneBinding) -> Result<(), AdsError> {
        if let Some(what) = self.scene.as_ref().and_then(|before| before.difference(scene)) {
            return Err(AdsError::OtherScene { structure: MODULES.structure, what });
        }
        if self.scene.is_some() {
            self.scene = Some(scene.clone());
        }
        Ok(())
    }

    /// Options.
    pub fn config(&self) -> &Config {
        &self.config
    }

    /// Views of all lights and points: where there are none, every ray is traced.
    pub fn view_count(&self) -> u32 {
        self.of_lights.view_count
    }

    /// Bytes of all maps with their tables.
    pub fn bytes(&self) -> u64 {
        self.of_lights.table.size() + self.views.size() + self.texels.size()
    }

    /// Depths of the texels of all views, metres from the light, of a light far away from the front of the
    /// view, row by row; NaN where there is no triangle. Submits and waits: for tests and tools.
    ///
    /// # Errors
    /// The device failed.
    pub fn download_depths(&self, device: &Device) -> Result<Vec<f32>, AdsError> {
        let count = texel_count(&self.config, self.of_lights.view_count.into())?;
        Ok(device.download_as::<f32>(&self.texels, 0, count as usize)?)
    }

    /// Records that all maps are drawn, of lights and triangles as they are where this comes in the
    /// recording: after what moves them, and after a structure's build, which gathers and checks triangles.
    /// Visible to what follows.
    pub fn record_build(&self, recorder: &mut Recorder<'_>) {
        let OfLights { lights, points, view_count, .. } = self.of_lights;
        if view_count == 0 {
            return;
        }
        let resolution = self.config.resolution;
        let texel_bytes = u64::from(resolution).pow(2) * u64::from(view_count) * 4;
        recorder.begin_pass(Stage::ShadowMaps, "shadow_maps/build_0_views");
        recorder.barrier(Access::ALL, Access::COMPUTE | Access::TRANSFER_WRITE);
        recorder.fill(&self.texels, 0, texel_bytes, SHADOW_MAPS_EMPTY);
        recorder.bind_compute(&self.build_views);
        recorder.bind_sets(0, &[self.geometry.set(), &self.of_lights.set]);
        recorder.dispatch([(lights + points).div_ceil(LIGHTS_PER_GROUP), 1, 1]);
        recorder.barrier(
            Access::COMPUTE | Access::TRANSFER_WRITE,
            Access::VERTEX_READ | Access::FRAGMENT | Access::COMPUTE,
        );
        recorder.end_pass();
        recorder.begin_pass(Stage::ShadowMaps, "shadow_maps/build_1_depths");
        if self.geometry.triangle_count() > 0 {
            recorder.begin_rendering(resolution + 2, resolution + 2);
            recorder.bind_raster(&self.build_depths);
            recorder.bind_sets(0, &[self.geometry.set(), &self.of_lights.set]);
            if let Some(scene) = self.scene.as_ref().filter(|scene| scene.alpha_masked) {
                recorder.bind_sets(2, &[&scene.set]);
            }
            for first_view in (0..view_count).step_by(GEOMETRY_DRAW_VIEWS as usize) {
                recorder.push_constants(bytes_of(&ShadowMapsDrawConstants { first_view }));
                self.geometry.record_draw(recorder, GEOMETRY_DRAW_VIEWS.min(view_count - first_view));
            }
            recorder.end_rendering();
        }
        recorder.barrier(Access::FRAGMENT, Access::COMPUTE | Access::TRANSFER);
        recorder.end_pass();
    }
}

impl Occluder for ShadowMaps {
    fn record_occluded(
        &self,
        recorder: &mut Recorder<'_>,
        queue: &RayQueue,
        domain: Domain,
        structure: &dyn Structure,
    ) {
        if self.of_lights.view_count == 0 {
            return structure.record_trace(recorder, queue, Trace::occluded(domain));
        }
        recorder.begin_pass(Stage::Trace(TraceMode::Occluded), "shadow_maps/occluded");
        recorder.bind_compute(&self.occluded);
        recorder.bind_sets(0, &[self.geometry.set(), &self.of_lights.set, queue.set()]);
        recorder.push_constants(bytes_of(&ShadowMapsQueueConstants { domain: domain.word() }));
        queue.record_dispatch(recorder, domain);
        recorder.barrier(Access::COMPUTE, Access::COMPUTE | Access::TRANSFER);
        recorder.end_pass();
        queue.record_take(recorder);
        structure.record_trace(recorder, queue, Trace::occluded(Domain::Selected));
        queue.record_take_back(recorder);
    }
}

/// Views, texels and tables for these lights; `kept` are views and texels to be used again where they
/// suffice.
fn made_for(
    device: &Device,
    config: &Config,
    layout: &SetLayout,
    lights: Lights<'_>,
    kept: Option<(&Buffer, &Buffer)>,
) -> Result<(Buffer, Buffer, OfLights), AdsError> {
    let Lights { records, known, emitters } = lights;
    let (views_of_lights, first_point) = views_of_all(known);
    let emitter_count = emitters.map_or(0, |emitters| emitters.count);
    let view_count = first_point + views_of_emitters(config, emitter_count);
    let texels = texel_count(config, view_count)?;
    let [table_bytes, view_bytes, texel_bytes] = sizes(known.len(), view_count, texels);
    let table = device.create_buffer(&BufferDesc {
        name: "shadow map lights",
        size: table_bytes,
        usage: BufferUsage::STORAGE,
        location: MemoryLocation::Upload,
    })?;
    // Status 0 until a build.
    let header = ShadowMapsHeader {
        status: 0,
        resolution: config.resolution,
        light_count: known.len() as u32,
        view_count: view_count as u32,
        bias: config.bias,
        emitter_count,
        point_count: config.points,
        first_point: first_point as u32,
    };
    table.write(0, bytes_of(&header))?;
    table.write(size_of::<ShadowMapsHeader>() as u64, cast_slice(&views_of_lights))?;
    let grown = |kept: Option<&Buffer>, name, size| match kept {
        Some(kept) if kept.size() >= size => Ok(kept.clone()),
        _ => device.create_buffer(&BufferDesc {
            name,
            size,
            usage: BufferUsage::STORAGE | BufferUsage::TRANSFER_SRC | BufferUsage::TRANSFER_DST,
            location: MemoryLocation::Device,
        }),
    };
    let views = grown(kept.map(|(views, _)| views), "shadow map views", view_bytes)?;
    let texels = grown(kept.map(|(_, texels)| texels), "shadow map texels", texel_bytes)?;
    // Lights stand in where nothing emits, and nothing is read of them there.
    let emitting = emitters.map_or(records, |emitters| emitters.records);
    let set =
        device.create_binding_set(layout, "shadow maps", &[&table, &views, &texels, records, emitting])?;
    let (lights, points) = (known.len() as u32, emitter_count * config.points);
    let of_lights = OfLights { lights, points, view_count: view_count as u32, table, set };
    Ok((views, texels, of_lights))
}
