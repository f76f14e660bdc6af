//! Tests of rays that maps answer, and of rays that they leave to a structure; of masks; of changed lights
//! and triangles; and of sizes that do not fit.

use glam::DVec3;
use rasray_ads::{AdsError, Domain, Hit, PRIMITIVE_UNKNOWN, RAY_CULL_BACK_FACES, Ray, RayQueue};
use rasray_scene::{AlphaMode, Filter, Image, Light, Texture, TextureRef, Wrap};
use rasray_shadow_maps::{Config, Lights, ShadowMaps, bytes, views_of};

use crate::lit::{Lit, cluttered_room, device, expect_silence, lights, lights_of, scene_of};

/// Returns true if a map has answered the slot: its hit has no triangle.
fn is_of_maps(hit: &Hit) -> bool {
    !hit.is_hit() || hit.primitive == PRIMITIVE_UNKNOWN
}

fn shares_differ(a: &[bool], b: &[bool]) -> f64 {
    a.iter().zip(b).filter(|(a, b)| a != b).count() as f64 / a.len() as f64
}

#[test]
fn rays_to_no_light_are_traced_and_all_others_answered_once() {
    let (device, _turn) = device();
    let lit = Lit::new(&device, &scene_of(&cluttered_room(60), lights()), Config::new(256));
    lit.build();
    let mut rays: Vec<Ray> = (0..5).flat_map(|light| lit.shadow_rays(light, 300)).collect();
    let traced = lit.hits(&rays, false, Domain::First(rays.len() as u32));
    // One ray in ten of each kind: without a light, of a light that does not exist, past back faces,
    // inactive.
    for (k, ray) in rays.iter_mut().enumerate() {
        match k % 10 {
            0 => ray.flags = 0,
            1 => *ray = ray.with_light(5),
            2 => ray.flags |= RAY_CULL_BACK_FACES,
            3 => ray.t_max = -1.0,
            _ => {}
        }
    }
    let found = lit.hits(&rays, true, Domain::First(rays.len() as u32));
    for (k, (hit, other)) in found.iter().zip(&traced).enumerate() {
        match k % 10 {
            0..=2 => assert_eq!(hit, other, "slot {k} is traced"),
            3 => assert!(!hit.is_hit(), "slot {k} is inactive"),
            _ => assert!(is_of_maps(hit), "slot {k} is answered by a map: {hit:?}"),
        }
    }
    let differ = found.iter().zip(&traced).enumerate();
    let differ = differ.filter(|(k, (a, b))| k % 10 > 3 && a.is_hit() != b.is_hit()).count();
    println!("{differ} of {} answers of maps differ", rays.len() * 6 / 10);
    assert!(20 * differ < rays.len(), "{differ}");
    expect_silence(&device);
}

/// Checks that later passes work on the slots that were selected before the maps, and that no other slot
/// changes.
#[test]
fn the_selection_of_a_queue_stays() {
    let (device, _turn) = device();
    let lit = Lit::new(&device, &scene_of(&cluttered_room(60), lights()), Config::new(128));
    lit.build();
    let rays: Vec<Ray> = (0..2).flat_map(|light| lit.shadow_rays(light, 400)).collect();
    let mut rays = rays[..300].to_vec();
    rays.iter_mut().step_by(2).for_each(|ray| ray.flags = 0);
    let queue = RayQueue::new(&device, "rays", 300, false).expect("it fits");
    device.upload_slice(queue.rays(), 0, &rays).expect("it fits");
    let untouched = Hit { t: 7.0, primitive: 77, a: 0.25, b: 0.5 };
    device.upload_slice(queue.hits(), 0, &[untouched; 300]).expect("it fits");
    // The selection is that of a shader that selects every third slot.
    let chosen: Vec<u32> = (0..100).map(|k| 3 * k).collect();
    let mut header =
        device.download_as::<rasray_ads::QueueHeader>(queue.header(), 0, 1).expect("readable")[0];
    header.selecting = 100;
    device.upload_slice(queue.header(), 0, &[header]).expect("it fits");
    device
        .upload_slice(queue.list(), 4 * 300 * (2 + (u64::from(header.takes) + 1) % 2), &chosen)
        .expect("it fits");
    device.submit(|recorder| queue.record_take(recorder)).expect("it runs");
    for round in 0..3 {
        lit.ask(&queue, true, Domain::Selected);
        let after = device.download_as::<rasray_ads::QueueHeader>(queue.header(), 0, 1).expect("readable")[0];
        assert_eq!((after.selected, after.selecting, after.selected_x), (100, 0, 2), "round {round}");
        let list = 4 * 300 * (2 + u64::from(after.takes) % 2);
        assert_eq!(device.download_as::<u32>(queue.list(), list, 100).expect("readable"), chosen);
    }
    let found: Vec<Hit> = device.download_as(queue.hits(), 0, 300).expect("readable");
    let all = lit.hits(&rays, true, Domain::First(300));
    for slot in 0..300 {
        let expected = if slot % 3 == 0 { all[slot] } else { untouched };
        assert_eq!(found[slot], expected, "slot {slot}");
    }
    expect_silence(&device);
}

#[test]
fn what_is_not_built_or_was_built_for_other_triangles_is_traced() {
    let (device, _turn) = device();
    let mut lit = Lit::new(&device, &scene_of(&cluttered_room(60), lights()), Config::new(128));
    let rays = lit.shadow_rays(0, 600);
    let all = Domain::First(rays.len() as u32);
    let traced = lit.hits(&rays, false, all);
    assert_eq!(lit.hits(&rays, true, all), traced, "nothing is built");
    lit.build();
    assert!(lit.hits(&rays, true, all).iter().all(is_of_maps));
    // Until other triangles are drawn, the maps give no answers from the triangles before.
    let other = Lit::new(&device, &scene_of(&cluttered_room(200), lights()), Config::new(128));
    lit.structure = other.structure;
    lit.maps.set_geometry(other.scene.geometry());
    lit.maps.set_scene(other.scene.binding()).expect("it is alike");
    let traced = lit.hits(&rays, false, all);
    assert_eq!(lit.hits(&rays, true, all), traced, "nothing of these triangles is built");
    lit.build();
    let found = lit.occluded(&rays, true);
    let traced: Vec<bool> = traced.iter().map(Hit::is_hit).collect();
    assert!(shares_differ(&found, &traced) < 0.03, "{}", shares_differ(&found, &traced));
    expect_silence(&device);
}

#[test]
fn lights_that_move_and_more_lights_are_seen_by_the_next_build() {
    let (device, _turn) = device();
    let all = lights();
    let mut lit = Lit::new(&device, &scene_of(&cluttered_room(60), all[..1].to_vec()), Config::new(256));
    lit.build();
    let (before, bytes_before) = (lit.maps.download_depths(&device).expect("readable"), lit.maps.bytes());
    // The device moves a light without the host.
    let moved =
        Light::Point { position: DVec3::new(-0.5, 0.6, 0.4), intensity: [1.0; 3], range: f32::INFINITY };
    let other = Lit::new(&device, &scene_of(&cluttered_room(60), vec![moved]), Config::new(256));
    let record = other.scene.lights()[0];
    device.upload_slice(&lit.scene.posed_buffers().lights, 0, &[record]).expect("it fits");
    lit.build();
    other.build();
    let after = lit.maps.download_depths(&device).expect("readable");
    let bits = |depths: &[f32]| depths.iter().map(|depth| depth.to_bits()).collect::<Vec<_>>();
    assert_ne!(bits(&after), bits(&before));
    assert_eq!(bits(&after), bits(&other.maps.download_depths(&device).expect("readable")));
    // With more lights the maps grow; with fewer they keep their size.
    let more = Lit::new(&device, &scene_of(&cluttered_room(60), all), Config::new(256));
    lit.maps.set_lights(&device, lights_of(&more.scene)).expect("they fit");
    let views: Vec<_> = more.scene.lights().iter().map(views_of).collect();
    assert_eq!(lit.maps.bytes(), bytes(lit.maps.config(), &views, 0));
    assert!(lit.maps.bytes() > bytes_before);
    for light in 0..5 {
        let rays = more.shadow_rays(light, 500);
        let traced = more.hits(&rays, false, Domain::First(rays.len() as u32));
        assert_eq!(lit.hits(&rays, true, Domain::First(rays.len() as u32)), traced, "not built yet");
    }
    lit.build();
    more.build();
    assert_eq!(
        bits(&lit.maps.download_depths(&device).expect("readable")),
        bits(&more.maps.download_depths(&device).expect("readable"))
    );
    let large = lit.maps.bytes();
    lit.maps.set_lights(&device, lights_of(&other.scene)).expect("they fit");
    assert!(large - lit.maps.bytes() < 100, "only the table is as small as it can be");
    expect_silence(&device);
}

#[test]
fn without_lights_or_triangles_every_ray_is_traced() {
    let (device, _turn) = device();
    let lit = Lit::new(&device, &scene_of(&cluttered_room(60), Vec::new()), Config::new(4096));
    lit.build();
    let lit_room = Lit::new(&device, &scene_of(&cluttered_room(60), lights()), Config::new(16));
    let rays = lit_room.shadow_rays(2, 300);
    let all = Domain::First(rays.len() as u32);
    assert_eq!(lit.hits(&rays, true, all), lit.hits(&rays, false, all));
    assert!(lit.maps.bytes() < 200 && lit.maps.view_count() == 0, "no texel: {}", lit.maps.bytes());
    let empty = Lit::new(&device, &scene_of(&[], lights()), Config::new(16));
    empty.build();
    assert!(empty.occluded(&rays, true).iter().all(|occluded| !occluded));
    expect_silence(&device);
}

/// Checks that a fence whose left half is cut away lets light through there, in maps as in traces.
#[test]
fn masked_leaves_let_light_through_where_they_are_cut() {
    let (device, _turn) = device();
    let square = |y: f64, half: f64| {
        let corner = |x: f64, z: f64| DVec3::new(half * x, y, half * z);
        [
            [corner(-1.0, -1.0), corner(1.0, -1.0), corner(1.0, 1.0)],
            [corner(-1.0, -1.0), corner(1.0, 1.0), corner(-1.0, 1.0)],
        ]
    };
    let lamp =
        Light::Point { position: DVec3::new(0.1, 2.0, 0.05), intensity: [1.0; 3], range: f32::INFINITY };
    let sun = Light::Directional { direction: DVec3::new(0.05, -1.0, 0.1).normalize(), irradiance: [1.0; 3] };
    let mut scene = scene_of(&square(0.0, 1.0), vec![lamp, sun]);
    let mut fence = scene_of(&square(1.0, 0.5), Vec::new());
    let mut mesh = fence.meshes.remove(0);
    mesh.uvs[0] = Some([[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 0.0], [1.0, 1.0], [0.0, 1.0]].to_vec());
    mesh.material = 1;
    scene.meshes.push(mesh);
    scene.instances.push(rasray_scene::Instance { mesh: 1, ..scene.instances[0].clone() });
    let uv_transform = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
    scene.materials.push(rasray_scene::Material {
        base_color_texture: Some(TextureRef { texture: 0, uv_set: 0, uv_transform }),
        alpha_mode: AlphaMode::Mask { cutoff: 0.5 },
        ..scene.materials[0].clone()
    });
    let rgba8 = [[255, 255, 255, 0], [255, 255, 255, 255]].concat();
    scene.images = vec![Image { name: "halves".to_owned(), width: 2, height: 1, rgba8 }];
    let (wrap_u, wrap_v) = (Wrap::Clamp, Wrap::Clamp);
    scene.textures = vec![Texture { image: 0, wrap_u, wrap_v, filter: Filter::Nearest, mipmapped: false }];
    let masked = Lit::new(&device, &scene, Config::new(512));
    scene.materials[1].alpha_mode = AlphaMode::Opaque;
    let opaque = Lit::new(&device, &scene, Config::new(512));
    for light in 0..2 {
        let rays = masked.shadow_rays(light, 6000);
        let shaded = |lit: &Lit| {
            lit.build();
            let (found, traced) = (lit.occluded(&rays, true), lit.occluded(&rays, false));
            let share = shares_differ(&found, &traced);
            assert!(share < 0.01, "light {light}: {share}");
            found.iter().filter(|occluded| **occluded).count()
        };
        let (half, whole) = (shaded(&masked), shaded(&opaque));
        println!(
            "light {light}: {half} rays occluded by half a fence, {whole} by a whole one, of {}",
            rays.len()
        );
        assert!(half > 200 && (1.8..2.3).contains(&(whole as f64 / half as f64)));
    }
    expect_silence(&device);
}

#[test]
fn sizes_that_do_not_fit_are_refused_with_a_reason() {
    let (device, _turn) = device();
    let lit = Lit::new(&device, &scene_of(&cluttered_room(10), lights()), Config::new(16));
    let made = |resolution: u32, known: &[rasray_shadow_maps::Light]| {
        let records = &lit.scene.posed_buffers().lights;
        let (geometry, lights) = (lit.scene.geometry(), Lights { records, known, emitters: None });
        ShadowMaps::new(&device, Config::new(resolution), geometry, Some(lit.scene.binding()), lights)
            .map(|_| ())
    };
    let known = lit.scene.lights();
    let error = made(8, known).expect_err("too few texels");
    assert!(error.to_string().contains("shadow-resolution is 8"), "{error}");
    let many = vec![known[0]; 1000];
    assert!(matches!(
        made(1024, &many),
        Err(AdsError::PoolTooLarge { pool: "texels", elements: 6_291_456_000, .. })
    ));
    let most = device.limits().max_storage_buffer_range;
    let lights = (most / (6 * 4 * 1024 * 1024) + 1) as usize;
    if 6 * lights < 4096 {
        let error = made(1024, &vec![known[0]; lights]).expect_err("more than a binding holds");
        assert!(error.to_string().contains("shadow map texels"), "{error}");
    }
    let widest = device.limits().max_framebuffer_size[0];
    if widest < Config::MOST_TEXELS + 2 {
        let error = made(widest - 1, &known[1..2]).expect_err("more than is drawn");
        assert!(error.to_string().contains("than this device draws"), "{error}");
    }
    assert!(made(16, known).is_ok());
    expect_silence(&device);
}
