//! Tests of emitting triangles: the map of the point that is nearest to a shadow ray's end answers the ray.

use glam::DVec3;
use rasray_ads::{Domain, Hit, Ray};
use rasray_scene::{Instance, Material, Mesh, Scene, builtin};
use rasray_shaders_glsl::constants::scene::LIGHT_POINT;
use rasray_shadow_maps::{Config, bytes, views_of};

use crate::disagreement::{exponent, is_full, points};
use crate::law::{Naive, naive};
use crate::lit::{Lit, cluttered_room, device, expect_silence, lights, scene_of};

fn config(resolution: u32, points: u32) -> Config {
    Config { points, ..Config::new(resolution) }
}

/// Returns a room with things in it and a lamp of two triangles below its ceiling. The lamp is a mesh of its
/// own, so that its triangles come last.
fn room_with_a_lamp() -> Scene {
    let mut scene = scene_of(&cluttered_room(60), lights()[..2].to_vec());
    let corner = |x: f32, z: f32| [x, 0.9, z];
    scene.meshes.push(Mesh {
        name: "lamp".to_owned(),
        positions: vec![corner(-0.5, -0.3), corner(0.5, -0.3), corner(0.5, 0.3), corner(-0.5, 0.3)],
        indices: vec![0, 1, 2, 0, 2, 3],
        material: 1,
        ..Mesh::default()
    });
    scene.instances.push(Instance { mesh: 1, ..scene.instances[0].clone() });
    scene.materials.push(Material { emission: [1.0; 3], ..scene.materials[0].clone() });
    scene
}

/// Returns the places of the points on a triangle, as the page describes them.
fn places([a, b, c]: [DVec3; 3], count: u32) -> Vec<DVec3> {
    let stride = 1.0 / f64::from(count);
    let place = |k: u32| {
        let root = (stride * (f64::from(k) + 0.5)).sqrt();
        let along = f64::from(k.reverse_bits()) / 2.0_f64.powi(32) + 0.5 * stride;
        a * (1.0 - root) + b * (root * (1.0 - along)) + c * (root * along)
    };
    (0..count).map(place).collect()
}

/// Returns the triangles that emit: the last two.
fn lamp(lit: &Lit) -> [(u32, [DVec3; 3]); 2] {
    let triangles = lit.triangles();
    let first = triangles.len() - 2;
    [0, 1].map(|k| ((first + k) as u32, triangles[first + k]))
}

fn share_that_differs(lit: &Lit, rays: &[Ray], traced: &[bool]) -> f64 {
    let found = lit.occluded(rays, true);
    found.iter().zip(traced).filter(|(found, traced)| found != traced).count() as f64 / rays.len() as f64
}

#[test]
fn answers_are_those_of_a_naive_map_of_the_nearest_point() {
    let (device, _turn) = device();
    let scene = room_with_a_lamp();
    let mut lit = Lit::new(&device, &scene, Config::new(16));
    for (resolution, count) in [(64, 1), (100, 5), (256, 16)] {
        lit = lit.with(config(resolution, count));
        lit.build();
        let views: Vec<_> = lit.scene.lights().iter().map(views_of).collect();
        assert_eq!(lit.maps.bytes(), bytes(lit.maps.config(), &views, 2));
        let triangles = lit.triangles();
        for (emitter, (excluded, corners)) in (0..).zip(lamp(&lit)) {
            let places = places(corners, count);
            let rays = lit.rays_to_emitter(emitter, corners, 1500);
            let found = lit.occluded(&rays, true);
            let (mut counts, mut unsure) = ([0, 0], 0);
            for (ray, occluded) in rays.iter().zip(found) {
                let [origin, direction] = [ray.origin, ray.direction].map(|v| glam::Vec3::from(v).as_dvec3());
                let end = origin + f64::from(ray.t_max) * direction;
                let mut by_distance = places.clone();
                by_distance.sort_by(|a, b| a.distance_squared(end).total_cmp(&b.distance_squared(end)));
                let is_close = by_distance.len() > 1
                    && by_distance[1].distance(end) - by_distance[0].distance(end) < 1.0e-5;
                let position = by_distance[0].as_vec3().to_array();
                let point = rasray_shadow_maps::Light { kind: LIGHT_POINT, position, ..Default::default() };
                let expected = match naive(&point, Some(excluded), &triangles, ray, resolution) {
                    Naive::Occluded if !is_close => true,
                    Naive::Open if !is_close => false,
                    _ => {
                        unsure += 1;
                        continue;
                    }
                };
                assert_eq!(occluded, expected, "emitter {emitter}, {resolution} texels: {ray:?}");
                counts[usize::from(expected)] += 1;
            }
            let [open, occluded] = counts;
            println!(
                "emitter {emitter}, {count} points, {resolution} texels: {open} open, {occluded} occluded, {unsure} unsure"
            );
            assert!(open > 50 && occluded > 50 && 5 * unsure < rays.len(), "emitter {emitter}");
        }
    }
    expect_silence(&device);
}

/// Checks that rays to emitters without points, and to emitters that do not exist, are traced, and that
/// lights without extent keep their maps.
#[test]
fn rays_to_emitters_without_points_are_traced() {
    let (device, _turn) = device();
    let scene = room_with_a_lamp();
    let without = Lit::new(&device, &scene, Config::new(64));
    without.build();
    let (_, corners) = lamp(&without)[0];
    let rays = without.rays_to_emitter(0, corners, 600);
    let all = Domain::First(rays.len() as u32);
    let traced = without.hits(&rays, false, all);
    assert_eq!(without.hits(&rays, true, all), traced);
    let with = Lit::new(&device, &scene, config(64, 4));
    with.build();
    assert_ne!(with.hits(&rays, true, all), traced);
    let beyond: Vec<_> = rays.iter().map(|ray| ray.with_light(4)).collect();
    assert_eq!(with.hits(&beyond, true, all), traced, "two lights and two triangles are 0 to 3");
    let largest: Vec<_> = rays.iter().map(|ray| ray.with_light(u32::MAX)).collect();
    assert_eq!(with.hits(&largest, true, all), traced);
    for light in 0..2 {
        let rays = without.shadow_rays(light, 500);
        let all = Domain::First(rays.len() as u32);
        let [a, b] = [&without, &with].map(|lit| lit.hits(&rays, true, all));
        assert_eq!(
            a.iter().map(Hit::is_hit).collect::<Vec<_>>(),
            b.iter().map(Hit::is_hit).collect::<Vec<_>>()
        );
    }
    expect_silence(&device);
}

/// Checks that the share of rays with an answer different from a trace falls as points and texels grow.
#[test]
fn errors_fall_as_points_and_texels_grow() {
    let (device, _turn) = device();
    let mut cornell = builtin::cornell();
    cornell.lights.clear();
    let counts: &[u32] = if is_full() { &[1, 4, 16, 64] } else { &[1, 4, 16] };
    let resolutions: &[u32] = if is_full() { &[64, 128, 256] } else { &[32, 128] };
    for (name, scene, count) in
        [("cornell", cornell, 200_000), ("cluttered room", room_with_a_lamp(), 60_000)]
    {
        let mut lit = Lit::new(&device, &scene, Config::new(16));
        let emitters = emitters(&lit);
        let rays: Vec<Ray> = (0..)
            .zip(&emitters)
            .flat_map(|(emitter, corners)| lit.rays_to_emitter(emitter, *corners, points(count) / 2))
            .collect();
        let traced = lit.occluded(&rays, false);
        let mut last = Vec::new();
        for &resolution in resolutions {
            let mut shares = Vec::new();
            for &count in counts {
                let config = config(resolution, count);
                let views: Vec<_> = lit.scene.lights().iter().map(views_of).collect();
                if bytes(&config, &views, 2) > device.limits().max_storage_buffer_range {
                    break;
                }
                lit = lit.with(config);
                lit.build();
                shares.push(share_that_differs(&lit, &rays, &traced));
            }
            let e = exponent(&counts[..shares.len()], &shares);
            let percent: Vec<String> = shares.iter().map(|share| format!("{:.3}", 100.0 * share)).collect();
            println!(
                "{name}, {resolution} texels, points {counts:?}: {} %, exponent {e:.2}",
                percent.join(" ")
            );
            assert!(shares.windows(2).all(|pair| pair[1] < pair[0]), "{name}: {shares:?}");
            // With few points the points decide the share, and all resolutions have room for 16.
            last.push((shares[2], e));
        }
        let [coarse, fine] = [last[0], last[last.len() - 1]];
        assert!(fine.0 < coarse.0 && fine.1 > 0.22, "{name}: {last:?}");
    }
    expect_silence(&device);
}

/// Returns the corners of the triangles that emit.
fn emitters(lit: &Lit) -> Vec<[DVec3; 3]> {
    let posed = lit.scene.posed_buffers();
    let count = lit.scene.emitter_count() as usize;
    let records: Vec<rasray_shadow_maps::EmissiveTriangle> =
        lit.device.download_as(&posed.emissive, 0, count).expect("readable");
    let triangles = lit.triangles();
    records.iter().map(|record| triangles[record.primitive as usize]).collect()
}
