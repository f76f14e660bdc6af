//! What a frame of a scene that moves costs: `cargo bench --bench frames -- [SCENE] [WIDTHxHEIGHT] [FRAMES]`.
//!
//! Per system the medians over frames of pose, build, trace, surfaces and shade, each timed by itself, and from these
//! the time of a frame at 1, 4 and 16 rays per pixel, divided by that of a tree rebuilt by Morton codes. `crossover` is the
//! number of rays per pixel up to which the system is faster than that tree, or from which on. Rays are those of the
//! camera. Times of software devices are for ratios on that device.

use std::error::Error;
use std::ffi::OsStr;

use rasray_ads::{Check, Structure};
use rasray_experiment::{LoadedScene, load, requirements};
use rasray_gpu::{Device, DeviceDesc, PassTiming};
use rasray_gpu_scene::{GpuScene, Parts, PosePass, Sampling, SceneTables, View};
use rasray_integrators::{Film, Integrator, IntegratorDesc, Raycast, waves};
use rasray_metrics::median;
use rasray_scene::needs::{self, Needs, Workload};
use rasray_scene::{Camera, Moment, default_view};
use rasray_systems::Spec;

type Result<T> = std::result::Result<T, Box<dyn Error>>;

/// Systems with an option each; the first is what the others are divided by.
const SYSTEMS: [(&str, Option<(&str, &str)>); 8] = [
    ("bvh", Some(("builder", "lbvh"))),
    ("bvh", Some(("builder", "sah"))),
    ("bricks", None),
    ("dirt", None),
    ("hu", None),
    ("mmrt", None),
    ("selective", None),
    ("ldc", None),
];

/// Rays per pixel of the frames in the table.
const RAYS: [u32; 3] = [1, 4, 16];

/// Builds that a frame may take until its pools suffice.
const BUILDS: u32 = 8;

/// Percent that pools grow beyond a demand.
const HEADROOM: u32 = 50;

/// Medians over frames, milliseconds.
#[derive(Clone, Copy)]
struct Frame {
    pose: f64,
    build: f64,
    trace: f64,
    surfaces: f64,
    shade: f64,
}

impl Frame {
    /// At a number of rays per pixel, of which each is traced and shaded.
    fn at(&self, rays: f64) -> f64 {
        self.pose + self.build + rays * self.per_ray()
    }

    fn per_ray(&self) -> f64 {
        self.trace + self.surfaces + self.shade
    }
}

fn main() -> Result<()> {
    let arguments: Vec<String> = std::env::args().skip(1).filter(|a| !a.starts_with("--")).collect();
    let argument = |place: usize, default: &'static str| arguments.get(place).map_or(default, String::as_str);
    let (name, size, count) = (argument(0, "walker"), argument(1, "320x180"), argument(2, "8"));
    let size = size.split_once('x').and_then(|(w, h)| Some([w.parse().ok()?, h.parse().ok()?]));
    let size: [u32; 2] =
        size.filter(|[w, h]| *w > 0 && *h > 0).ok_or("the size is WIDTHxHEIGHT, in pixels")?;
    let count: u32 =
        count.parse().ok().filter(|count| *count > 0).ok_or("FRAMES is a whole number above 0")?;
    let device = Device::create(&DeviceDesc { requirements: requirements(), ..DeviceDesc::default() })?;
    let loaded = load(OsStr::new(name))?;
    let [width, height] = size;
    println!(
        "{}, {}, {} triangles, {width} x {height}, medians of {count} frames, milliseconds\n",
        device.name(),
        loaded.scene.name,
        loaded.triangles
    );
    let mut measured = Vec::new();
    for (system, option) in SYSTEMS {
        let given = option.map(|(name, value)| (name.to_owned(), value.to_owned()));
        let spec = Spec::new(system, "robust", given)?;
        let title = option.map_or_else(|| system.to_owned(), |(_, value)| format!("{system} {value}"));
        measured.push((title, frames(&device, &loaded, &spec, size, count)?));
    }
    print(&measured);
    Ok(())
}

fn print(measured: &[(String, Frame)]) {
    let baseline = measured[0].1;
    println!("| system | pose | build | trace | surfaces | shade | 1 ray | 4 rays | 16 rays | crossover |");
    println!("|---|---|---|---|---|---|---|---|---|---|");
    for (title, frame) in measured {
        let Frame { pose, build, trace, surfaces, shade } = frame;
        let ratios = RAYS.map(|rays| {
            let time = frame.at(rays.into());
            format!("{time:.1} ({:.2})", baseline.at(rays.into()) / time)
        });
        println!(
            "| {title} | {pose:.2} | {build:.2} | {trace:.2} | {surfaces:.2} | {shade:.2} | {} | {} |",
            ratios.join(" | "),
            crossover(frame, &baseline)
        );
    }
}

/// Where two lines over the rays per pixel meet.
fn crossover(frame: &Frame, baseline: &Frame) -> String {
    let (fixed, slope) = (frame.at(0.0) - baseline.at(0.0), frame.per_ray() - baseline.per_ray());
    let at = -fixed / slope;
    match (fixed < 0.0, slope < 0.0) {
        (true, true) => "always faster".to_owned(),
        (false, false) => "never faster".to_owned(),
        (false, true) => format!("from {at:.2}"),
        (true, false) => format!("up to {at:.2}"),
    }
}

/// What is measured of one system.
struct Setting<'a> {
    device: &'a Device,
    scene: GpuScene,
    pose: PosePass,
    integrator: Raycast,
    loaded: &'a LoadedScene,
    view: View,
}

fn frames(device: &Device, loaded: &LoadedScene, spec: &Spec, size: [u32; 2], count: u32) -> Result<Frame> {
    let [width, height] = size;
    let scene = &loaded.scene;
    let camera: Camera =
        scene.cameras.first().cloned().unwrap_or_else(|| default_view::default_camera(scene));
    let workload = Workload { integrator: needs::Integrator::Raycast, bounces: 0 };
    let parts = Parts::from(&Needs::of(scene, workload));
    let origin = SceneTables::default_frame_origin(scene, camera.world_from_camera.translation);
    let tables = SceneTables::new(scene, origin, &parts)?;
    let view = View { camera, width, height, seed: 1 };
    let gpu = GpuScene::upload(device, &tables, &view)?;
    let pose = PosePass::new(device, scene, &tables, &gpu)?;
    let film = Film::new(device, width, height)?;
    let integrator = Raycast::new(&IntegratorDesc::new(device, &gpu, &film))?;
    let mut structure = spec.create(device, gpu.geometry(), Some(gpu.binding()))?;
    let setting = Setting { device, scene: gpu, pose, integrator, loaded, view };
    let mut all = Vec::new();
    // The first compiles kernels and grows pools.
    for number in 0..=count {
        let frame = setting.frame(structure.as_mut(), number)?;
        if number > 0 {
            all.push(frame);
        }
    }
    let middle = |of: fn(&Frame) -> f64| median(&all.iter().map(of).collect::<Vec<_>>()).unwrap_or(f64::NAN);
    Ok(Frame {
        pose: middle(|frame| frame.pose),
        build: middle(|frame| frame.build),
        trace: middle(|frame| frame.trace),
        surfaces: middle(|frame| frame.surfaces),
        shade: middle(|frame| frame.shade),
    })
}

impl Setting<'_> {
    /// One frame, each part waited for.
    fn frame(&self, structure: &mut dyn Structure, number: u32) -> Result<Frame> {
        let Self { device, scene, pose, integrator, loaded, view } = self;
        let timing = device.best_timing();
        let clips = loaded.scene.animation.rig.compatible_clips();
        let moment = Moment { seconds: f64::from(number) / 25.0, clips };
        let started = std::time::Instant::now();
        let at = pose.frame(&loaded.scene, &moment)?;
        let host = started.elapsed().as_secs_f64() * 1.0e3;
        let posed = device.submit_passes(timing, |recorder| {
            pose.record(recorder, 0, &at);
            scene.record_frame(recorder, view, Sampling::default());
        })?;
        let build = self.build(structure)?;
        let mut passes = Vec::new();
        let film = integrator.film();
        for wave in waves(film.pixel_count(), 1, integrator.wave_capacity()) {
            let traced = device.submit_passes(timing, |recorder| {
                integrator.record_reset(recorder);
                integrator.record_wave(recorder, (&*structure).into(), wave)
            })?;
            traced.value?;
            passes.extend(traced.passes);
        }
        let is_trace = |label: &str| label.contains("/trace_");
        let is_surfaces = |label: &str| label.contains("surface");
        Ok(Frame {
            pose: host + total(&posed.passes, |_| true),
            build,
            trace: total(&passes, is_trace),
            surfaces: total(&passes, is_surfaces),
            shade: total(&passes, |label| !is_trace(label) && !is_surfaces(label)),
        })
    }

    /// The build that is complete, milliseconds; those before it, in which pools grew, are not counted.
    fn build(&self, structure: &mut dyn Structure) -> Result<f64> {
        let (device, viewpoint) = (self.device, self.scene.viewpoint());
        for _ in 0..BUILDS {
            let started = std::time::Instant::now();
            structure.prepare_build(device)?;
            let host = started.elapsed().as_secs_f64() * 1.0e3;
            let built = device.submit_passes(device.best_timing(), |recorder| {
                structure.record_build(recorder, 0, viewpoint)
            })?;
            built.value?;
            let status = structure.status(0)?;
            match structure.check(&status, HEADROOM)? {
                Check::Complete => return Ok(host + total(&built.passes, |_| true)),
                Check::Grow(sizes) => structure.resize(device, &sizes)?,
            }
        }
        Err(format!("{} is not complete after {BUILDS} builds", structure.name()).into())
    }
}

fn total(passes: &[PassTiming], is_counted: impl Fn(&str) -> bool) -> f64 {
    passes.iter().filter(|pass| is_counted(&pass.label)).map(|pass| pass.milliseconds).sum()
}
