//! Setting of benches of structures: a built-in scene and a number of rays, from their command lines.

use std::error::Error;

use rasray_experiment::{DeviceChoice, DeviceScene, open_device};
use rasray_gpu::Device;
use rasray_scene::needs::{Needs, Workload};
use rasray_scene::{Camera, builtin, default_view};

/// Seed of all random numbers.
pub const SEED: u32 = 1;

/// Width and height of the image that shapes the camera's rays, pixels.
pub const SIZE: [u32; 2] = [64, 64];

/// Scene on a device, and the number of rays to trace.
pub struct Setting {
    /// Name of the scene.
    pub name: String,
    /// Number of rays.
    pub rays: u32,
    /// Camera from which the scene is seen.
    pub camera: Camera,
    /// Device that traces.
    pub device: Device,
    /// Scene on the device.
    pub stage: DeviceScene,
}

impl Setting {
    /// Reads `[SCENE] [RAYS]` after the words of the command; `scene` and `rays` are the defaults.
    ///
    /// # Errors
    /// There is no such scene or no device, or RAYS is not a number greater than 0.
    pub fn read(command: &str, scene: &str, rays: u32) -> Result<Self, Box<dyn Error>> {
        let mut arguments = std::env::args().skip(1).filter(|argument| !argument.starts_with("--"));
        let name = arguments.next().unwrap_or_else(|| scene.to_owned());
        let rays = match arguments.next() {
            Some(text) => text.parse().ok().filter(|rays| *rays > 0).ok_or_else(|| {
                format!("RAYS must be a whole number above 0, not `{text}`; {command} -- [SCENE] [RAYS]")
            })?,
            None => rays,
        };
        let scene =
            builtin::builtin(&name).ok_or_else(|| format!("there is no built-in scene `{name}`"))??;
        let camera = scene.cameras.first().cloned().unwrap_or_else(|| default_view::default_camera(&scene));
        let device = open_device(&DeviceChoice::default())?;
        let needs = Needs::of(&scene, Workload { emission: true, shades: true, ..Workload::VISIBILITY });
        let stage = DeviceScene::new(&device, &scene, &camera, SIZE, SEED, &needs)?;
        Ok(Self { name, rays, camera, device, stage })
    }
}
