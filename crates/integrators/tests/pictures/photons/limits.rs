//! The memory of a photon map, and what is refused.

use glam::DVec3;
use rasray_gpu::Timing;
use rasray_integrators::{
    Integrator, IntegratorError, Path, PathOptions, PhotonKind, PhotonOptions, Photons, Wave,
};
use rasray_scene::{Environment, Material, Scene};

use super::{options, photons, point_light, render};
use crate::pictures::common::{scenes::cornell, *};

/// Formula of the page, and its value.
const FORMULA: &str = "44 N (B - 1) + 4 max(1024, 2 ceil2(N)) + 56 N + 12 bytes";

fn formula_bytes(photon_paths: u64, bounces: u64) -> u64 {
    44 * photon_paths * (bounces - 1)
        + 4 * 1024.max(2 * photon_paths.next_power_of_two())
        + 56 * photon_paths
        + 12
}

/// Bytes by which the device enlarges the buffers of a map and its queue for alignment.
const ALIGNMENT: u64 = 10 * 256;

#[test]
fn a_map_takes_the_bytes_that_the_page_says() {
    let page = include_str!("../../../../../docs/photons.md");
    assert!(page.contains(FORMULA), "docs/photons.md: {FORMULA}");
    let (scene, eye) = cornell();
    let device = device();
    let stage = Setup::new(&device, &scene, eye, 8, 8, 0);
    for (paths, bounces) in [(1, 1), (100, 2), (3000, 3), (4096, 8), (4097, 5)] {
        let before = device.allocated_bytes();
        let path = Path::new(&stage.desc(), bounces).expect("valid");
        let of_path = device.allocated_bytes() - before;
        let map = photons(&stage, options(PhotonKind::All, bounces, paths, 1.0));
        let of_map = device.allocated_bytes() - before - 2 * of_path;
        let queue: u64 =
            map.queues().last().expect("it has one").bytes_by_part().map(|(_, bytes)| bytes).sum();
        let expected = formula_bytes(paths.into(), bounces.into());
        println!("{paths} paths, {bounces} bounces: {of_map} bytes, of which {queue} are the queue's");
        let measured = expected + queue..=expected + queue + ALIGNMENT;
        assert!(measured.contains(&of_map), "{paths} paths, {bounces} bounces: {of_map}, not {measured:?}");
        assert_eq!(map.state_bytes() - path.state_bytes(), expected, "as reports say it");
    }
}

/// More photons around a surface than one invocation processes are an error, and not a darker picture.
#[test]
fn crowds_and_options_out_of_their_ranges_are_refused() {
    let device = device();
    let wall = Material { double_sided: false, ..lambert(0.9, 1.0) };
    let furnace = scene(box_inside(1.0, 0), vec![wall], [0.0; 3]);
    let stage = Setup::new(&device, &furnace, forward_camera(DVec3::ZERO), 2, 2, 0);
    let error =
        |options: PhotonOptions| Photons::new(&stage.desc(), options).expect_err("refused").to_string();
    let valid = options(PhotonKind::All, 8, 40_000, 10.0);
    for (options, named) in [
        (PhotonOptions { photon_paths: 0, ..valid }, "photon-paths 0"),
        (PhotonOptions { radius: Some(0.0), ..valid }, "radius 0"),
        (PhotonOptions { radius: Some(f32::NAN), ..valid }, "radius NaN"),
        (PhotonOptions { paths: PathOptions::from(1025), ..valid }, "bounces 1025"),
        (PhotonOptions { photon_paths: 1 << 20, paths: PathOptions::from(1024), ..valid }, "bytes"),
    ] {
        assert!(error(options).contains(named), "{named}: {}", error(options));
    }
    // The scene has light but no surfaces.
    let mut empty = Scene { environment: Environment::Constant([0.5; 3]), ..Scene::default() };
    empty.lights.extend(point_light(1.0, 1.0));
    let sky = Setup::new(&device, &empty, forward_camera(DVec3::ZERO), 2, 2, 0);
    let of_sky = PhotonOptions { photon_paths: 100, radius: None, ..valid };
    assert_eq!(render(&sky, of_sky, 1), [[0.5; 3]; 4]);
    let crowded = photons(&stage, valid);
    device.submit(|recorder| crowded.record_reset(recorder)).expect("the reset runs");
    let wave = Wave { first_pixel: 0, pixel_count: 4, sample: 0 };
    let made = crowded.render_wave(&device, Timing::None, (&stage.structure).into(), wave);
    assert!(matches!(made, Err(IntegratorError::Crowded { surfaces: 4, .. })), "{made:?}");
    assert_silent(&device);
}
