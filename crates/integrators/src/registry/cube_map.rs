//! Environment mapping: a cube map of the scene answers mirrored and refracted rays by their direction.

use bytemuck::bytes_of;
use rasray_ads::{Domain, RayQueue};
use rasray_gpu::{Access, Buffer, Device, PassTiming, Recorder, Timing};
use rasray_gpu_scene::GpuScene;
use rasray_options::{OptionRow, Value, Values};
use rasray_scene::needs::Workload;
use rasray_shaders_glsl::{
    INTEGRATORS_CUBE_MAP_BOUNDS, INTEGRATORS_CUBE_MAP_DRAW, INTEGRATORS_CUBE_MAP_DRAW_PASSING,
    INTEGRATORS_CUBE_MAP_RAYS, INTEGRATORS_CUBE_MAP_SHADE, INTEGRATORS_CUBE_MAP_SHADE_PASSING,
    INTEGRATORS_PRIMARY, constant_ids::integrators::WHITTED_MIRROR_ROUGHNESS,
    constants::scene::BSDF_SMOOTH_ROUGHNESS, records::CubeMapHeader,
};

use crate::{
    Film, Integrator, IntegratorDesc, IntegratorError, IntegratorRow, IntegratorSpec, RayKind, Shadows,
    Traced, Wave, Whitted, WhittedOptions,
    kernels::{Kernel, WaveConstants, device_buffer},
    wave_capacity,
};

use super::sample_map::SampleMap;
use super::whitted::{MIRROR_ROUGHNESS, SHADOWS, TreeKernels};

/// Row of the registry.
pub(super) const ROW: IntegratorRow = IntegratorRow {
    name: "cube-map",
    doc: "Environment mapping: direct light, reflections and refractions by direction from a cube map",
    options: &[&RESOLUTION, &POSITION, &SHADOWS, &MIRROR_ROUGHNESS],
    rays: &[RayKind::Camera, RayKind::Shadow],
    workload: |_| Workload::ALL,
    make: |desc, spec| Ok(Box::new(CubeMap::new(desc, CubeMapOptions::of(spec))?)),
};

/// Largest number of texels along a side of a face.
pub const CUBE_MAP_LIMIT: u32 = 2048;

const RESOLUTION: OptionRow = OptionRow::new(
    "cube-resolution",
    Values::Whole(1, CUBE_MAP_LIMIT),
    "Texels along a side of a face of the cube map",
)
.by_default(Value::Whole(256))
.trying(&["1", "16"]);

const POSITION: OptionRow = OptionRow::new(
    "cube-position",
    Values::Point,
    "Centre of projection of the cube map; the centre of all perfectly smooth surfaces if not given",
)
.trying(&["0.2,-0.1,0.3"]);

/// Bindings of the cube map, as `integrators/cube_map.glsl` declares them.
const CUBE_MAP_TEXELS: u32 = 11;
const CUBE_MAP_HEADER: u32 = 12;

/// Largest number of invocations that search for smooth surfaces.
const BOUNDS_INVOCATIONS: u32 = 4096;

/// Options of [`CubeMap`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CubeMapOptions {
    /// Number of texels along a side of a face, from 1 to [`CUBE_MAP_LIMIT`].
    pub resolution: u32,
    /// Centre of projection of the map, world, metres; if absent, the centre of the bounds of the perfectly
    /// smooth surfaces.
    pub position: Option<[f32; 3]>,
    /// Surfaces from which shadow rays are traced; with [`Shadows::First`], surfaces in the map trace none.
    pub shadows: Shadows,
    /// Perceptual roughness below which surfaces are perfectly smooth; not negative.
    pub mirror_roughness: f32,
}

impl Default for CubeMapOptions {
    fn default() -> Self {
        Self {
            resolution: 256,
            position: None,
            shadows: Shadows::default(),
            mirror_roughness: BSDF_SMOOTH_ROUGHNESS,
        }
    }
}

impl CubeMapOptions {
    fn of(spec: &IntegratorSpec) -> Self {
        Self {
            resolution: spec.get(RESOLUTION.name).and_then(Value::whole).unwrap_or_default(),
            position: spec.get(POSITION.name).and_then(Value::point),
            shadows: spec.choice(&SHADOWS, &Shadows::ALL, Shadows::name),
            mirror_roughness: spec.get(MIRROR_ROUGHNESS.name).and_then(Value::number).unwrap_or_default(),
        }
    }
}

/// Environment mapping: direct light on the surfaces that the camera sees, with one mirrored and one
/// refracted ray each, which a cube map answers by their direction alone. Each sample draws a map of its own:
/// the scene seen from one point, with direct light, without perfectly smooth surfaces that show their back.
/// The map is traced through the structure, once per sample, in waves of its own.
///
/// If surfaces let rays pass, rays of the map may need more rounds than are recorded, and the camera's
/// surfaces can be looked up only after them: [`Integrator::render_wave`] waits for them, and frames are
/// repeated with more rounds ([`Integrator::allow_more_rounds`]).
#[derive(Debug)]
pub struct CubeMap {
    position: Option<[f32; 3]>,
    /// Header of the map, relative to the frame origin of the current scene.
    header: CubeMapHeader,
    header_buffer: Buffer,
    bounds: Kernel,
    /// Integrator of the map; its film holds the texels.
    drawn: Whitted,
    /// Integrator of the surfaces that the camera sees.
    seen: Whitted,
    of_sample: SampleMap,
}

impl CubeMap {
    /// Makes queues, states, kernels and the map.
    ///
    /// # Errors
    /// An error for an option out of its range, sizes that do not fit, out of memory, or if the device
    /// refuses a pipeline.
    pub fn new(desc: &IntegratorDesc<'_>, options: CubeMapOptions) -> Result<Self, IntegratorError> {
        let CubeMapOptions { resolution, position, shadows, mirror_roughness } = options;
        RESOLUTION.check(Value::Whole(resolution))?;
        position.map(|position| POSITION.check(Value::Point(position))).transpose()?;
        desc.check()?;
        let device = desc.device;
        let header_buffer = device_buffer(device, "cube map position", size_of::<CubeMapHeader>() as u64)?;
        let direct = WhittedOptions { ray_depth: 0, shadows, mirror_roughness, ..WhittedOptions::default() };

        let side = resolution + 2;
        let texels = desc.film.beside(device, [side, 6 * side])?;
        let of_texels = IntegratorDesc {
            film: &texels,
            wave_capacity: wave_capacity(device).min(texels.pixel_count()),
            ..*desc
        };
        let kernels = TreeKernels {
            first_rays: &INTEGRATORS_CUBE_MAP_RAYS,
            shade: &INTEGRATORS_CUBE_MAP_DRAW,
            shade_passing: &INTEGRATORS_CUBE_MAP_DRAW_PASSING,
            bound: &[(CUBE_MAP_HEADER, &header_buffer)],
            passes_backs: true,
        };
        // Surfaces in the map, which the camera does not see directly, are lit without shadow rays.
        let shadows = if shadows == Shadows::First { Shadows::None } else { shadows };
        let drawn = Whitted::of_trees(&of_texels, WhittedOptions { shadows, ..direct }, &kernels)?;
        let kernels = TreeKernels {
            first_rays: &INTEGRATORS_PRIMARY,
            shade: &INTEGRATORS_CUBE_MAP_SHADE,
            shade_passing: &INTEGRATORS_CUBE_MAP_SHADE_PASSING,
            bound: &[(CUBE_MAP_TEXELS, &texels.pixels()[0]), (CUBE_MAP_HEADER, &header_buffer)],
            passes_backs: false,
        };
        let seen = Whitted::of_trees(desc, direct, &kernels)?;
        let smooth = [(WHITTED_MIRROR_ROUGHNESS, mirror_roughness.to_bits())];
        Ok(Self {
            position,
            header: header(resolution, position, desc.scene),
            bounds: drawn.bindings().kernel(device, &INTEGRATORS_CUBE_MAP_BOUNDS, &smooth)?,
            header_buffer,
            drawn,
            seen,
            of_sample: SampleMap::default(),
        })
    }

    /// Iterates over the waves of the map for a sample.
    fn map_waves(&self, sample: u32) -> impl Iterator<Item = Wave> {
        self.drawn.film().bands().waves([sample], self.drawn.wave_capacity())
    }

    /// Records that the map is empty, and sets its centre of projection.
    fn record_position(&self, recorder: &mut Recorder<'_>) {
        self.drawn.film().record_clear_pixels(recorder);
        recorder.update(&self.header_buffer, 0, bytes_of(&self.header));
        recorder.barrier(Access::TRANSFER_WRITE, Access::COMPUTE | Access::TRANSFER);
        if self.position.is_none() {
            let (bindings, queue) = (self.drawn.bindings(), self.drawn.queues()[0]);
            let count = BOUNDS_INVOCATIONS.min(queue.capacity());
            let constants = WaveConstants { pixel_count: count, ..WaveConstants::default() };
            bindings.record(recorder, &self.bounds, queue, Domain::First(count), &constants);
        }
    }
}

/// Makes the initial header of a map. Bounds are empty.
fn header(resolution: u32, position: Option<[f32; 3]>, scene: &GpuScene) -> CubeMapHeader {
    let origin = scene.frame_origin().to_array();
    let relative =
        |position: [f32; 3]| std::array::from_fn(|axis| (f64::from(position[axis]) - origin[axis]) as f32);
    CubeMapHeader {
        resolution,
        position: position.map(relative).unwrap_or_default(),
        is_given: position.is_some().into(),
        lower_keys: [u32::MAX; 3],
        upper_keys: [0; 3],
    }
}

/// Returns `traced` without drawing, which cannot answer rays of the map: they do not leave the eye.
fn of_map(traced: Traced<'_>) -> Traced<'_> {
    traced.with_primary(None)
}

impl Integrator for CubeMap {
    fn name(&self) -> &'static str {
        ROW.name
    }

    fn record_wave(
        &self,
        recorder: &mut Recorder<'_>,
        traced: Traced<'_>,
        wave: Wave,
    ) -> Result<(), IntegratorError> {
        if self.of_sample.is_needed(wave) {
            self.record_position(recorder);
            for map in self.map_waves(wave.sample) {
                self.drawn.record_wave(recorder, of_map(traced), map)?;
            }
            self.of_sample.was_made(wave);
        }
        self.seen.record_wave(recorder, traced, wave)
    }

    fn record_rest(
        &self,
        recorder: &mut Recorder<'_>,
        traced: Traced<'_>,
        wave: Wave,
    ) -> Result<(), IntegratorError> {
        self.seen.record_rest(recorder, traced, wave)
    }

    fn has_rest(&self, device: &Device) -> Result<bool, IntegratorError> {
        self.seen.has_rest(device)
    }

    fn render_wave(
        &self,
        device: &Device,
        timing: Timing,
        traced: Traced<'_>,
        wave: Wave,
    ) -> Result<Vec<PassTiming>, IntegratorError> {
        let mut timings = Vec::new();
        if self.of_sample.is_needed(wave) {
            timings.extend(device.submit_passes(timing, |recorder| self.record_position(recorder))?.passes);
            for map in self.map_waves(wave.sample) {
                timings.extend(self.drawn.render_wave(device, timing, of_map(traced), map)?);
            }
            self.of_sample.was_made(wave);
        }
        timings.extend(self.seen.render_wave(device, timing, traced, wave)?);
        Ok(timings)
    }

    fn allow_more_rounds(&self) -> bool {
        // Both get more rounds: the faults do not tell whose rays have not ended.
        let map = self.drawn.allow_more_rounds();
        self.seen.allow_more_rounds() | map
    }

    fn asks_occluder(&self) -> bool {
        self.seen.asks_occluder()
    }

    fn set_scene(&mut self, scene: &GpuScene) -> Result<(), IntegratorError> {
        self.drawn.set_scene(scene)?;
        self.seen.set_scene(scene)?;
        self.header = header(self.header.resolution, self.position, scene);
        self.of_sample.forget();
        Ok(())
    }

    fn film(&self) -> &Film {
        self.seen.film()
    }

    fn queues(&self) -> Vec<&RayQueue> {
        [self.seen.queues(), self.drawn.queues()].concat()
    }

    fn wave_capacity(&self) -> u32 {
        self.seen.wave_capacity()
    }

    fn traces_per_wave(&self) -> u32 {
        let map_waves = self.map_waves(0).count() as u32;
        self.seen.traces_per_wave() + map_waves * self.drawn.traces_per_wave()
    }

    fn state_bytes(&self) -> u64 {
        self.seen.state_bytes()
            + self.drawn.state_bytes()
            + self.drawn.film().pixel_bytes()
            + self.header_buffer.size()
    }
}
