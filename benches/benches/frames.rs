//! Costs of frames of a scene that moves: `cargo bench --bench frames -- [SCENE] [WIDTHxHEIGHT] [FRAMES]
//! [SYSTEM,...]`.
//!
//! Prints for each system the medians over frames of pose, trace, surfaces and shade, each timed by itself,
//! and the mean of builds, since a tree that frames keep is made anew now and then. From these follows the
//! time of a frame at 1, 4 and 16 rays per pixel, divided by the time with a tree that is rebuilt by Morton
//! codes. `crossover` is the number of rays per pixel up to which, or from which on, the system is faster
//! than that tree. Rays are those of the camera; `cells`, `entries` and `tests` are the averages per ray,
//! counted in a trace that is not timed. Times of software devices are only for ratios on that device.

use std::error::Error;
use std::ffi::OsStr;
use std::ops::ControlFlow;

use rasray_ads::{Combined, Counters, Geometry, QueueCounters, Structure};
use rasray_benches::moving::Arguments;
use rasray_experiment::{DeviceScene, requirements};
use rasray_frame::{Advance, ImageRenderer};
use rasray_gpu::{Device, DeviceDesc, PassTiming, Stage};
use rasray_integrators::{Film, IntegratorDesc, Raycast};
use rasray_metrics::median;
use rasray_scene::needs::{Needs, Workload};
use rasray_scene::{Camera, Moment, default_view};
use rasray_scene_source::{LoadedScene, load};
use rasray_systems::{SYSTEMS, Spec};
use rasray_tracer::{FrameSettings, FrameStructure, Refresh, refresh_until_complete};

type Result<T> = std::result::Result<T, Box<dyn Error>>;

/// Variant: a system, an option of the system, and true if the moving part is a part by itself, the only one
/// that is built with every frame.
type Variant = (&'static str, Option<[&'static str; 2]>, bool);

/// Variants of the systems with several rows; all other systems of the registry have one row, without
/// options. The times of the first row divide those of all others.
const VARIANTS: [Variant; 8] = [
    ("bvh", Some(["builder", "lbvh"]), false),
    ("bvh", Some(["builder", "lbvh"]), true),
    ("bvh", Some(["builder", "ploc"]), false),
    ("bvh", Some(["builder", "refit"]), false),
    ("bvh", Some(["builder", "sah"]), false),
    ("bricks", None, false),
    ("bricks", Some(["divisions", "1"]), false),
    ("bricks", None, true),
];

/// System without a row, because it tests every triangle against every ray of every frame.
const LEFT_OUT: &str = "brute-force";

/// Numbers of rays per pixel of the frames in the table.
const RAYS: [u32; 3] = [1, 4, 16];

/// Settings of frames that follow one after the other, in pools with half as much again as they have to hold.
const SETTINGS: FrameSettings = FrameSettings { slots: 1, headroom: 50 };

/// Medians over frames, the mean for builds; milliseconds.
#[derive(Clone, Copy)]
struct Frame {
    pose: f64,
    build: f64,
    trace: f64,
    surfaces: f64,
    shade: f64,
}

/// Average work per ray.
#[derive(Clone, Copy)]
struct Work {
    cells: f64,
    entries: f64,
    tests: f64,
}

/// Measured costs of a system.
struct Measured {
    title: String,
    frame: Frame,
    work: Work,
}

impl Frame {
    /// Returns the costs at a number of rays per pixel, each of which is traced and shaded.
    fn at(&self, rays: f64) -> f64 {
        self.pose + self.build + rays * self.per_ray()
    }

    fn per_ray(&self) -> f64 {
        self.trace + self.surfaces + self.shade
    }
}

fn main() -> Result<()> {
    let Arguments { scene: name, size, frames: count, more } = Arguments::read(8)?;
    let device = Device::create(&DeviceDesc { requirements: requirements(), ..DeviceDesc::default() })?;
    let loaded = load(OsStr::new(&name))?;
    let [width, height] = size;
    println!(
        "{}, {}, {} triangles, {width} x {height}, medians of {count} frames, means of their builds, milliseconds\n",
        device.name(),
        loaded.scene.name,
        loaded.triangles
    );
    let wanted: Vec<&str> = more.iter().flat_map(|names| names.split(',')).collect();
    let mut measured = Vec::new();
    for (system, option, in_parts) in variants() {
        // The baseline is always measured.
        if !(wanted.is_empty() || measured.is_empty() || wanted.contains(&system)) {
            continue;
        }
        let given = option.map(|[name, value]| (name.to_owned(), value.to_owned()));
        let spec = Spec::new(system, "robust", given)?;
        let missing = device.lacks(&spec.requirements()?);
        if !missing.is_empty() {
            let missing = missing.join(", ");
            if measured.is_empty() {
                return Err(format!(
                    "{system}, the baseline, cannot be measured: the device lacks {missing}"
                )
                .into());
            }
            println!("{system} is left out: the device lacks {missing}\n");
            continue;
        }
        let option = option.map(|words| words.join("="));
        let words = [Some(system), option.as_deref(), in_parts.then_some("in parts")];
        let title = words.into_iter().flatten().collect::<Vec<_>>().join(" ");
        let (frame, work) = frames(&device, &loaded, &spec, in_parts, (size, count))?;
        measured.push(Measured { title, frame, work });
    }
    print(&measured);
    Ok(())
}

/// Returns the variants in the order of the table's rows.
fn variants() -> impl Iterator<Item = Variant> {
    let is_single = |name: &str| name != LEFT_OUT && VARIANTS.iter().all(|(system, ..)| *system != name);
    let single = SYSTEMS.iter().map(|system| system.name).filter(move |name| is_single(name));
    VARIANTS.into_iter().chain(single.map(|system| (system, None, false)))
}

fn print(measured: &[Measured]) {
    let baseline = measured[0].frame;
    println!(
        "| system | pose | build | trace | surfaces | shade | 1 ray | 4 rays | 16 rays | crossover | cells | entries | tests |"
    );
    println!("|---|---|---|---|---|---|---|---|---|---|---|---|---|");
    for Measured { title, frame, work } in measured {
        let Frame { pose, build, trace, surfaces, shade } = frame;
        let ratios = RAYS.map(|rays| {
            let time = frame.at(rays.into());
            format!("{time:.1} ({:.2})", baseline.at(rays.into()) / time)
        });
        println!(
            "| {title} | {pose:.2} | {build:.2} | {trace:.2} | {surfaces:.2} | {shade:.2} | {} | {} | {:.1} | {:.1} | {:.1} |",
            ratios.join(" | "),
            crossover(frame, &baseline),
            work.cells,
            work.entries,
            work.tests
        );
    }
}

/// Returns the intersection of two lines over the rays per pixel.
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

/// Setting of the measurements of one system.
struct Setting<'a> {
    device: &'a Device,
    stage: DeviceScene,
    image: ImageRenderer,
    loaded: &'a LoadedScene,
}

fn frames(
    device: &Device,
    loaded: &LoadedScene,
    spec: &Spec,
    in_parts: bool,
    (size, count): ([u32; 2], u32),
) -> Result<(Frame, Work)> {
    let [width, height] = size;
    let scene = &loaded.scene;
    let camera: Camera =
        scene.cameras.first().cloned().unwrap_or_else(|| default_view::default_camera(scene));
    let workload = Workload { emission: true, shades: true, ..Workload::VISIBILITY };
    let stage = DeviceScene::moving(device, scene, &camera, size, 1, &Needs::of(scene, workload))?;
    let film = Film::new(device, width, height)?;
    let raycast = Raycast::new(&IntegratorDesc::new(device, &stage.scene, &film))?;
    let image = ImageRenderer::new(device, Box::new(raycast), 0..1)?;
    let mut setting = Setting { device, stage, image, loaded };
    let mut structure = setting.create(spec, in_parts)?;
    let mut all = Vec::new();
    // The first two frames compile the kernels of builds that make and that keep a tree, and grow pools. They
    // are not timed.
    for number in 0..count + 2 {
        let frame = setting.frame(&mut structure, number)?;
        if number > 1 {
            all.push(frame);
        }
    }
    let middle = |of: fn(&Frame) -> f64| median(&all.iter().map(of).collect::<Vec<_>>()).unwrap_or(f64::NAN);
    let frame = Frame {
        pose: middle(|frame| frame.pose),
        build: all.iter().map(|frame| frame.build).sum::<f64>() / all.len() as f64,
        trace: middle(|frame| frame.trace),
        surfaces: middle(|frame| frame.surfaces),
        shade: middle(|frame| frame.shade),
    };
    // Kernels that count differ from the timed ones. A tree that is kept is counted as it is when it was made
    // for the first frame.
    let mut counting = setting.create(&spec.clone().with_counters(Counters::Sums), in_parts)?;
    for number in [0, count] {
        setting.show(number)?;
        setting.build(&mut counting)?;
    }
    setting.trace(counting.structure())?;
    let rays = f64::from(width) * f64::from(height);
    let mut counters = Vec::new();
    for queue in setting.image.passes().integrator().queues() {
        counters.push(queue.download_counters(device)?);
    }
    let per_ray = |of: fn(&QueueCounters) -> u64| counters.iter().map(of).sum::<u64>() as f64 / rays;
    let work = Work {
        cells: per_ray(|counters| counters.cells),
        entries: per_ray(|counters| counters.entries),
        tests: per_ray(|counters| counters.tests),
    };
    Ok((frame, work))
}

impl Setting<'_> {
    fn create(&mut self, spec: &Spec, in_parts: bool) -> Result<FrameStructure> {
        let refresh =
            if in_parts { rasray_experiment::Refresh::Moving } else { rasray_experiment::Refresh::All };
        let parts = self.stage.parts(self.device, &self.loaded.scene, refresh)?;
        let scene = &self.stage.scene;
        let create = |geometry: &Geometry| spec.create(self.device, geometry, Some(scene.binding()));
        let structure: Refresh = match parts {
            None => create(scene.geometry())?.into(),
            Some(parts) => Combined::new(&parts, create)?.into(),
        };
        Ok(FrameStructure::new(self.device, structure, SETTINGS)?)
    }

    /// Poses the scene for a frame, and returns the milliseconds.
    fn show(&mut self, number: u32) -> Result<f64> {
        let clips = self.loaded.scene.animation.rig.compatible_clips();
        let moment = Moment { seconds: f64::from(number) / 25.0, clips };
        let shown = self.stage.pose(self.device, &self.loaded.scene, &moment, self.device.best_timing())?;
        Ok(shown.host_milliseconds + total(&shown.passes, |_| true))
    }

    /// Builds the structure after motion, and returns the milliseconds of the complete build; builds before
    /// it, in which pools grew, are not counted. The camera does not move.
    fn build(&self, structure: &mut FrameStructure) -> Result<f64> {
        let (device, viewpoint) = (self.device, self.stage.scene.viewpoint());
        structure.geometry_moved();
        let built = refresh_until_complete(device, structure, viewpoint, device.best_timing())?;
        Ok(built.prepare_milliseconds + total(&built.passes, |_| true))
    }

    /// Traces and shades one ray per pixel, and returns the times of the passes.
    fn trace(&mut self, structure: &dyn Structure) -> Result<Vec<PassTiming>> {
        let mut all = Vec::new();
        self.image.clear()?;
        self.image.render(structure, self.device.best_timing(), |_, step| {
            match step {
                Advance::Wave { passes } => all.extend(passes),
                Advance::StartedOver => all.clear(),
            }
            ControlFlow::Continue(())
        })?;
        if self.image.unfinished() > 0 {
            return Err(format!("{} left rays without an answer", structure.description().name).into());
        }
        Ok(all)
    }

    /// Makes one frame, and waits after each part.
    fn frame(&mut self, structure: &mut FrameStructure, number: u32) -> Result<Frame> {
        let pose = self.show(number)?;
        let build = self.build(structure)?;
        let passes = self.trace(structure.structure())?;
        Ok(Frame {
            pose,
            build,
            trace: total(&passes, |stage| matches!(stage, Stage::Trace(_))),
            surfaces: total(&passes, |stage| stage == Stage::Surfaces),
            shade: total(&passes, |stage| matches!(stage, Stage::Shade | Stage::Film)),
        })
    }
}

fn total(passes: &[PassTiming], is_counted: impl Fn(Stage) -> bool) -> f64 {
    passes.iter().filter(|pass| is_counted(pass.stage)).map(|pass| pass.milliseconds).sum()
}
