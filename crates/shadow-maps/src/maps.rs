//! Shadow maps on the device.

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

/// Number of threads in a workgroup of `shadow_maps/build_0_views`.
const LIGHTS_PER_GROUP: u32 = 64;

/// Lights to which shadow rays lead.
#[derive(Clone, Copy, Debug)]
pub struct Lights<'a> {
    /// [`Light`] records of lights without extent, on the device, from the start of the buffer. Each build
    /// reads the positions that the records have then.
    pub records: &'a Buffer,
    /// [`Light`] records as the host knows them, which give the kinds of lights and the widths of cones.
    /// Their positions are not read.
    pub known: &'a [Light],
    /// Triangles that emit; `None` if there are none.
    pub emitters: Option<Emitters<'a>>,
}

/// Triangles that emit. Each of them has [`Config::points`] points with maps.
#[derive(Clone, Copy, Debug)]
pub struct Emitters<'a> {
    /// [`EmissiveTriangle`](crate::EmissiveTriangle) records on the device, from the start of the buffer.
    /// Only the triangle of a record is read.
    pub records: &'a Buffer,
    /// Number of triangles that emit.
    pub count: u32,
}

/// Shadow maps of all lights. A light that shines everywhere has a cube of views around it, a narrower cone
/// has one view along it, and a light far away has one parallel view over all triangles. With
/// [`Config::points`], each of so many points on every emitting triangle has a cube of views, and a ray takes
/// the point nearest to its end.
///
/// A build draws the triangles into every view. One comparison answers a ray that leads to a light
/// ([`Ray::light`](rasray_ads::Ray::light)). A structure traces all other rays: rays without such a light,
/// rays from outside of a view, and rays that pass back faces. Until a build of the current triangles is
/// recorded, a structure traces every ray.
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

/// Sizes and buffers that a change of lights makes anew.
#[derive(Debug)]
struct OfLights {
    lights: u32,
    /// Number of points on all emitting triangles.
    points: u32,
    view_count: u32,
    table: Buffer,
    set: BindingSet,
}

impl ShadowMaps {
    /// Returns the requirements on a device: the floor, stores of fragment shaders, and the requirements of
    /// the shader modules.
    pub fn requirements() -> Requirements {
        let mut requirements = Requirements::floor();
        requirements.required.push(Feature::FragmentStoresAndAtomics);
        MODULES.add_to(&mut requirements);
        requirements
    }

    /// Makes pipelines and empty maps, and builds nothing. `scene` has the alpha masks; without a scene
    /// geometry is opaque.
    ///
    /// # Errors
    /// An option is out of range, the maps are larger than the device draws or binds, memory runs out, or the
    /// device lacks a feature or refuses a pipeline.
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
                    module: &shader.module(),
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
            vertex_module: &vertex.module(),
            fragment_module: &fragment.module(),
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

    /// Replaces the lights from the next recording on, and builds nothing. The maps grow if there are more
    /// lights. Earlier recordings keep the lights that they were recorded with. Nothing changes after an
    /// error.
    ///
    /// # Errors
    /// The maps are larger than the device binds, or memory runs out.
    pub fn set_lights(&mut self, device: &Device, lights: Lights<'_>) -> Result<(), AdsError> {
        let kept = Some((&self.views, &self.texels));
        (self.views, self.texels, self.of_lights) =
            made_for(device, &self.config, &self.layout, lights, kept)?;
        Ok(())
    }

    /// Replaces the triangles from the next recording on. Until a build draws them, a structure traces every
    /// ray.
    pub fn set_geometry(&mut self, geometry: &Geometry) {
        self.geometry = geometry.clone();
    }

    /// Replaces the scene, to which other triangles belong. The next build reads its alpha masks. Nothing
    /// changes after an error.
    ///
    /// # Errors
    /// [`AdsError::OtherScene`] if the scene has alpha masks and the one before had none, or if it has other
    /// specialisation constants.
    pub fn set_scene(&mut self, scene: &SceneBinding) -> Result<(), AdsError> {
        if let Some(what) = self.scene.as_ref().and_then(|before| before.difference(scene)) {
            return Err(AdsError::OtherScene { structure: MODULES.structure, what });
        }
        if self.scene.is_some() {
            self.scene = Some(scene.clone());
        }
        Ok(())
    }

    /// Returns the options.
    pub fn config(&self) -> &Config {
        &self.config
    }

    /// Returns the number of views of all lights and points. If it is 0, a structure traces every ray.
    pub fn view_count(&self) -> u32 {
        self.of_lights.view_count
    }

    /// Returns the bytes of all maps with their tables.
    pub fn bytes(&self) -> u64 {
        self.of_lights.table.size() + self.views.size() + self.texels.size()
    }

    /// Downloads the depths of the texels of all views, row by row, in metres: from the light or, for a light
    /// far away, from the front of the view; NaN where there is no triangle. Submits and waits: for tests and
    /// tools.
    ///
    /// # Errors
    /// The device failed.
    pub fn download_depths(&self, device: &Device) -> Result<Vec<f32>, AdsError> {
        let count = texel_count(&self.config, self.of_lights.view_count.into())?;
        Ok(device.download_as::<f32>(&self.texels, 0, count as usize)?)
    }

    /// Records the passes that draw all maps. They see the lights and triangles at this place of the
    /// recording, so it follows the commands that move these, and a structure's build, which gathers and
    /// checks triangles. The maps are visible to later commands.
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

/// Makes views, texels and tables for these lights. `kept` are earlier buffers of views and texels, which are
/// used again if they suffice.
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
    // The status is 0 until a build.
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
    // If no triangle emits, the buffer of lights is bound in place of that of emitters, and nothing is read
    // of it there.
    let emitting = emitters.map_or(records, |emitters| emitters.records);
    let set =
        device.create_binding_set(layout, "shadow maps", &[&table, &views, &texels, records, emitting])?;
    let (lights, points) = (known.len() as u32, emitter_count * config.points);
    let of_lights = OfLights { lights, points, view_count: view_count as u32, table, set };
    Ok((views, texels, of_lights))
}
