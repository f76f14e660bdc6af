//! Builds shadow maps in a plain ash program with its own device: a lamp and a sun shine on a staircase. Maps
//! answer the shadow rays, and the program compares the answers with those of brute force.

use rasray_ads::{BruteForce, Domain, Hit, Occluder, Ray, RayQueue, Structure, Trace};
use rasray_gpu::{Device, Recorder};
use rasray_shaders_glsl::constants::scene::{LIGHT_DIRECTIONAL, LIGHT_POINT};
use rasray_shadow_maps::{Config, Light, Lights, ShadowMaps};

#[path = "../../ads/examples/host/mod.rs"]
mod host;

use host::{Host, Result, staircase};

const LAMP: [f32; 3] = [0.5, 1.4, -0.6];
const SUN: [f32; 3] = [0.3, -0.9, 0.4];

/// Returns rays from points before the stairs: to the lamp, to the sun, and every third to no light.
fn rays() -> Vec<Ray> {
    let ray = |k: u32| {
        let origin = [(k % 31) as f32 / 31.0, (k % 37) as f32 / 37.0, (k % 41) as f32 / 41.0 + 0.011];
        let towards: [f32; 3] = std::array::from_fn(|axis| LAMP[axis] - origin[axis]);
        match k % 3 {
            0 => Ray { t_max: 1.0, ..Ray::new(origin, towards).with_light(0) },
            1 => Ray::new(origin, SUN.map(|x| -x)).with_light(1),
            _ => Ray::new(origin, [0.1, 0.2, 1.0]),
        }
    };
    (0..3000).map(ray).collect()
}

/// Runs the program; returns an error where answers differ or the validation layer complains.
pub fn main() -> Result<()> {
    let enabled = ShadowMaps::requirements().required;
    let host = Host::new(&enabled)?;
    // SAFETY: the host made the device with these features, and the host is dropped last.
    let device = unsafe { Device::from_raw(host.raw_device(&enabled)) }?;
    let mesh = staircase(8);
    let geometry = host.geometry(&device, &mesh, host.buffer(&mesh.positions)?)?;
    let known = [
        Light { kind: LIGHT_POINT, position: LAMP, ..Light::default() },
        Light { kind: LIGHT_DIRECTIONAL, direction: SUN, ..Light::default() },
    ];
    let records = host.adopted(&device, "lights", host.buffer(&known)?);
    let lights = Lights { records: &records, known: &known, emitters: None };
    let maps = ShadowMaps::new(&device, Config::new(512), &geometry, None, lights)?;
    let mut structure = BruteForce::new(&device, &geometry, None, false)?;
    let rays = rays();
    let mut answers: [Vec<Hit>; 2] = Default::default();
    for (by_maps, answers) in [true, false].into_iter().zip(&mut answers) {
        let queue = RayQueue::new(&device, "rays", rays.len() as u32, false)?;
        device.upload_slice(queue.rays(), 0, &rays)?;
        let recorded = host.submit(0, |commands| {
            // SAFETY: nobody else records into the command buffer, and `recorded` outlives the wait below.
            let mut recorder = unsafe { Recorder::from_raw(&device, commands) };
            let all = Domain::First(rays.len() as u32);
            queue.record_reset(&mut recorder);
            structure.record_build(&mut recorder, 0, LAMP.into())?;
            if by_maps {
                maps.record_build(&mut recorder);
                maps.record_occluded(&mut recorder, &queue, all, &structure);
            } else {
                structure.record_trace(&mut recorder, &queue, Trace::occluded(all));
            }
            Ok(recorder.finish()?)
        })?;
        host.wait(0)?;
        drop(recorded);
        *answers = device.download_as(queue.hits(), 0, rays.len())?;
    }
    let [found, expected] = answers;
    for (k, (name, least)) in [("lamp", 970), ("sun", 970), ("no light", 1000)].into_iter().enumerate() {
        let of_kind = || found.iter().zip(&expected).skip(k).step_by(3);
        let occluded = of_kind().filter(|(_, expected)| expected.is_hit()).count();
        let same = of_kind().filter(|(found, expected)| found.is_hit() == expected.is_hit()).count();
        println!("{name}: {occluded} of 1000 rays are occluded, {same} answers are those of brute force");
        if same < least || !(50..950).contains(&occluded) {
            return Err(format!("{name}: answers differ").into());
        }
    }
    host.is_silent()
}
