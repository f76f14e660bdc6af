//! Gains of frames in flight: `cargo bench --bench flights -- [SCENE] [WIDTHxHEIGHT] [FRAMES] [SYSTEM]`.
//!
//! Renders pictures of a scene that moves, with one path of four bounces per pixel, step by step with a wait
//! after each step, and in frames with one to three in flight. The ways take turns. Prints medians over
//! rounds of the milliseconds per frame, with quartiles. Pictures of all ways must be equal bit for bit.
//! Times of software devices are only for ratios on that device.

use std::error::Error;
use std::ffi::OsStr;
use std::ops::ControlFlow;
use std::time::Instant;

use rasray_benches::moving::Arguments;
use rasray_experiment::{DeviceChoice, open_device};
use rasray_frame::{FrameInput, FrameRenderer, ImageRenderer, render_in_order};
use rasray_gpu::{Device, Timing};
use rasray_gpu_scene::{FramePose, GpuScene, Parts, PosePass, Sampling, SceneTables, View};
use rasray_integrators::{Film, FilmPixel, Integrator, IntegratorDesc, IntegratorRow, IntegratorSpec};
use rasray_metrics::Summary;
use rasray_scene::needs::Needs;
use rasray_scene::{Moment, default_view};
use rasray_scene_source::{LoadedScene, load};
use rasray_systems::Spec;
use rasray_tracer::{FrameSettings, FrameStructure, refresh_until_complete};

type Result<T> = std::result::Result<T, Box<dyn Error>>;

/// Numbers of frames in flight; 0 is one step after the other.
const WAYS: [u32; 4] = [0, 1, 2, 3];
const ROUNDS: usize = 5;
const BOUNCES: u32 = 4;

fn main() -> Result<()> {
    let Arguments { scene: name, size, frames: count, more } = Arguments::read(12)?;
    let spec = Spec::new(more.as_deref().unwrap_or("bricks"), "robust", [])?;
    let device = open_device(&DeviceChoice::default())?;
    let loaded = load(OsStr::new(&name))?;
    println!(
        "{}, {name}, {} triangles, {} x {}, {}, {count} frames, {ROUNDS} rounds\n",
        device.name(),
        loaded.triangles,
        size[0],
        size[1],
        spec.system().name
    );
    let mut times = WAYS.map(|_| Vec::new());
    let mut first = None;
    for _ in 0..ROUNDS {
        for (slots, times) in WAYS.iter().zip(&mut times) {
            let setting = Setting::new(&device, &loaded, &spec, size)?;
            let (milliseconds, pictures) = match slots {
                0 => setting.step_by_step(count)?,
                slots => setting.in_flight(count, *slots)?,
            };
            times.push(milliseconds);
            if first.get_or_insert_with(|| pictures.clone()) != &pictures {
                return Err(format!("pictures with {slots} frames in flight are others").into());
            }
        }
    }
    println!("| in flight | ms per frame | quartiles |\n|---|---|---|");
    for (slots, times) in WAYS.iter().zip(&times) {
        let Summary { median, first_quartile, third_quartile, .. } = Summary::of(times).ok_or("no times")?;
        let way = if *slots == 0 { "step by step".to_owned() } else { slots.to_string() };
        println!("| {way} | {median:.2} | {first_quartile:.2} to {third_quartile:.2} |");
    }
    Ok(())
}

/// Scene and integrator with which one way renders.
struct Setting<'a> {
    device: &'a Device,
    loaded: &'a LoadedScene,
    spec: &'a Spec,
    view: View,
    scene: GpuScene,
    pose: PosePass,
    path: Box<dyn Integrator>,
}

/// Milliseconds per frame, and the pictures.
type Rendered = (f64, Vec<Vec<FilmPixel>>);

impl<'a> Setting<'a> {
    fn new(device: &'a Device, loaded: &'a LoadedScene, spec: &'a Spec, size: [u32; 2]) -> Result<Self> {
        let [width, height] = size;
        let scene = &loaded.scene;
        let camera = scene.cameras.first().cloned().unwrap_or_else(|| default_view::default_camera(scene));
        let view = View { camera, width, height, seed: 1 };
        let paths = IntegratorRow::named("path").ok_or("paths are not registered")?;
        let paths = IntegratorSpec::from(paths).with("bounces", BOUNCES)?;
        let parts = Parts::from(&Needs::of(scene, paths.workload()));
        let origin = SceneTables::default_frame_origin(scene, view.eye());
        let tables = SceneTables::new(scene, origin, &parts)?;
        let gpu = GpuScene::upload(device, &tables, &view)?;
        let pose = PosePass::new(device, scene, &tables, &gpu)?;
        let film = Film::new(device, width, height)?;
        let path = paths.make(&IntegratorDesc::new(device, &gpu, &film))?;
        Ok(Self { device, loaded, spec, view, scene: gpu, pose, path })
    }

    fn posed(pose: &PosePass, loaded: &LoadedScene, number: u32) -> Result<FramePose> {
        let clips = loaded.scene.animation.rig.compatible_clips();
        let moment = Moment { seconds: f64::from(number) / 25.0, clips };
        Ok(pose.frame(&loaded.scene, &moment)?)
    }

    /// Renders step by step. The first frame is not timed, because it compiles kernels and grows pools.
    fn step_by_step(self, count: u32) -> Result<Rendered> {
        let Self { device, loaded, spec, view, scene, pose, path } = self;
        let structure = spec.create(device, scene.geometry(), Some(scene.binding()))?;
        let settings = FrameSettings { slots: 1, ..FrameSettings::default() };
        let mut structure = FrameStructure::new(device, structure, settings)?;
        let mut image = ImageRenderer::new(device, path, 0..1)?;
        let (mut started, mut pictures) = (Instant::now(), Vec::new());
        for number in 0..=count {
            if number == 1 {
                (started, pictures) = (Instant::now(), Vec::new());
            }
            let posed = Self::posed(&pose, loaded, number)?;
            device.submit(|recorder| pose.record(recorder, 0, &posed))?;
            structure.geometry_moved();
            let viewpoint = scene.viewpoint_of(&view);
            refresh_until_complete(device, &mut structure, viewpoint, Timing::None)?;
            image.clear()?;
            image.render(structure.structure(), Timing::None, |_, _| ControlFlow::Continue(()))?;
            pictures.push(image.film().read_pixels(device)?);
        }
        Ok((started.elapsed().as_secs_f64() * 1.0e3 / f64::from(count), pictures))
    }

    fn in_flight(self, count: u32, slots: u32) -> Result<Rendered> {
        let Self { device, loaded, spec, view, scene, pose, path } = self;
        let structure = spec.create(device, scene.geometry(), Some(scene.binding()))?;
        let rest = (FrameSettings { slots, ..FrameSettings::default() }, Timing::None, true);
        let mut renderer = FrameRenderer::new(device, (scene, Some(pose)), structure, path, rest)?;
        let shown = renderer.scene().clone();
        let pose = shown.pose().ok_or("the scene does not move")?;
        let mut failed = Ok(());
        let mut inputs = (0..=count).map_while(|number| {
            let pose = Self::posed(pose, loaded, number).map_err(|error| failed = Err(error)).ok()?;
            let (view, sampling, samples) = (view.clone(), Sampling::default(), (0..1).into());
            Some(FrameInput { view, sampling, scene: None, pose: Some(pose), samples, continues: false })
        });
        render_in_order(&mut renderer, inputs.next(), |_| ControlFlow::Continue(()))?;
        let (started, mut pictures) = (Instant::now(), Vec::new());
        render_in_order(&mut renderer, inputs, |picture| {
            pictures.push(picture.film.pixels);
            ControlFlow::Continue(())
        })?;
        failed?;
        Ok((started.elapsed().as_secs_f64() * 1.0e3 / f64::from(count), pictures))
    }
}
