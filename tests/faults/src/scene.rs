//! A small scene on the device, systems of the registry, and hits through them.

use std::f64::consts::TAU;

use glam::DVec3;
use rasray_ads::{Hit, Ray, Structure, TraceMode};
use rasray_gpu::{Device, Timing};
use rasray_gpu_scene::{GpuScene, Parts, SceneTables, View};
use rasray_scene::default_view::default_camera;
use rasray_scene::needs::Needs;
use rasray_scene::{Filter, Image, Scene, Texture, TextureRef, Wrap};
use rasray_systems::{SYSTEMS, Spec};
use rasray_tracer::{BatchTracer, build_until_complete};

use crate::Failure;

/// Cells along a side of the systems that have them: enough for lists of several nodes.
const RESOLUTION: u32 = 32;

/// A system and preset of the registry at a small resolution.
///
/// # Errors
/// The registry has no such system or preset.
pub fn spec(system: &str, preset: &str) -> Result<Spec, Failure> {
    let spec = Spec::new(system, preset, [])?;
    match spec.system().size_option() {
        Some(size) => Ok(spec.with_option(size, &RESOLUTION.to_string())?),
        None => Ok(spec),
    }
}

/// Every system and preset of the registry.
///
/// # Errors
/// None in practice: all are registered.
pub fn specs() -> Result<Vec<Spec>, Failure> {
    let rows = SYSTEMS.iter().flat_map(|row| row.presets.iter().map(move |preset| (row.name, preset.name())));
    rows.map(|(system, preset)| spec(system, preset)).collect()
}

/// The room of `cornell` on the device, seen by its camera in an image of 16 x 16 pixels.
///
/// # Errors
/// The device fails.
pub fn stage(device: &Device) -> Result<GpuScene, Failure> {
    stage_of(device, &cornell())
}

/// The built-in `cornell`.
fn cornell() -> Scene {
    let scene = rasray_scene::builtin::builtin("cornell");
    scene.expect("`cornell` is built in").expect("it needs no parameters")
}

/// The room of `cornell` with a texture on everything: an image of `size` x `size` texels, no two neighbours
/// alike.
pub fn textured_room(size: u32) -> Scene {
    let mut scene = cornell();
    let byte = |index: u32| (index.wrapping_mul(2_654_435_761) >> 25) as u8 + 128;
    let rgba8 = (0..size * size * 4).map(byte).collect();
    scene.images = vec![Image { name: "noise".to_owned(), width: size, height: size, rgba8 }];
    scene.textures = vec![Texture {
        image: 0,
        wrap_u: Wrap::Repeat,
        wrap_v: Wrap::Repeat,
        filter: Filter::Linear,
        mipmapped: true,
    }];
    for material in &mut scene.materials {
        let uv_transform = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
        material.base_color_texture = Some(TextureRef { texture: 0, uv_set: 0, uv_transform });
    }
    for mesh in &mut scene.meshes {
        // Other places along every axis.
        let place = |&[x, y, z]: &[f32; 3]| [0.7 * x + 0.3 * y, 0.6 * z - 0.4 * y];
        mesh.uvs[0] = Some(mesh.positions.iter().map(place).collect());
    }
    scene
}

/// A scene on the device, seen by its camera in an image of 16 x 16 pixels.
///
/// # Errors
/// The device fails.
pub fn stage_of(device: &Device, scene: &Scene) -> Result<GpuScene, Failure> {
    let camera = scene.cameras.first().cloned().unwrap_or_else(|| default_camera(scene));
    let origin = SceneTables::default_frame_origin(scene, camera.world_from_camera.translation);
    let tables = SceneTables::new(scene, origin, &Parts::from(&Needs::all()))?;
    Ok(GpuScene::upload(device, &tables, &View { camera, width: 16, height: 16, seed: 1 })?)
}

/// Rays within the bounds of a scene, the same in every run.
pub fn rays(scene: &GpuScene, count: u32) -> Vec<Ray> {
    let [lower, upper] = scene.geometry().bounds().map(|corner| corner.map(f64::from)).map(DVec3::from_array);
    // Multiples of an irrational number modulo 1 fill an interval evenly.
    let part = |index: u32, step: f64| (f64::from(index) * step).fract();
    (0..count)
        .map(|index| {
            let at = DVec3::new(
                part(index, 0.754_877_666_246_692_8),
                part(index, 0.569_840_290_998_053_2),
                part(index, 0.381_966_011_250_105_1),
            );
            let origin = lower + (upper - lower) * (0.05 + 0.9 * at);
            let (z, turn) =
                (2.0 * part(index, 0.618_033_988_749_894_9) - 1.0, part(index, 0.414_213_562) * TAU);
            let across = (1.0 - z * z).sqrt();
            let direction = [across * turn.cos(), across * turn.sin(), z].map(|value| value as f32);
            Ray::new(origin.as_vec3().to_array(), direction)
        })
        .collect()
}

/// Builds a structure and traces the nearest hits of [`rays`] through it.
///
/// # Errors
/// The device or the structure fails.
pub fn hits(device: &Device, spec: &Spec, count: u32) -> Result<(Box<dyn Structure>, Vec<Hit>), Failure> {
    let scene = stage(device)?;
    let mut structure = spec.create(device, scene.geometry(), Some(scene.binding()))?;
    build_until_complete(device, structure.as_mut(), scene.eye(), Timing::None)?;
    let tracer = BatchTracer::new(device, count)?;
    let outcome = tracer.trace(structure.as_ref(), &rays(&scene, count), TraceMode::Closest, Timing::None)?;
    Ok((structure, outcome.hits))
}
