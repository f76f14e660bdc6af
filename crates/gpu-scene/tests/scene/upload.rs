//! Tables on a device, with validation on.

use glam::{DAffine3, DVec3};
use rasray_gpu::{Device, DeviceDesc, GpuError};
use rasray_gpu_scene::{GpuScene, GpuSceneError, Parts, SceneTables, TexelRuns, View, left_out_bytes};
use rasray_scene::{Camera, Environment, Instance, Light, Material, Mesh, Projection, Scene, builtin};

fn device() -> Device {
    let desc = DeviceDesc { validation: true, ..DeviceDesc::default() };
    Device::create(&desc).expect("these tests need a Vulkan device and the validation layer")
}

fn view() -> View {
    let camera = Camera {
        name: "eye".to_owned(),
        world_from_camera: DAffine3::from_translation(DVec3::new(100.0, 0.0, 0.5)),
        projection: Projection::Perspective { fov_y: 1.0 },
        aspect_ratio: None,
        lens: None,
    };
    View { camera, width: 16, height: 8, seed: 4 }
}

fn scene(triangles: usize) -> Scene {
    let positions = (0..3 * triangles).map(|i| [i as f32, (i % 3) as f32, (i % 7) as f32]).collect();
    let mesh = Mesh {
        name: "triangles".to_owned(),
        positions,
        indices: (0..3 * triangles as u32).collect(),
        ..Mesh::default()
    };
    Scene {
        name: "triangles".to_owned(),
        meshes: vec![mesh],
        instances: vec![Instance {
            name: "instance".to_owned(),
            mesh: 0,
            world_from_mesh: DAffine3::from_translation(DVec3::new(100.0, 0.0, 0.0)),
        }],
        materials: vec![Material::default()],
        ..Scene::default()
    }
}

#[test]
fn what_was_packed_is_what_structures_read() {
    let device = device();
    let scene = scene(100);
    let tables =
        SceneTables::new(&scene, DVec3::new(100.0, 0.0, 0.0), &Parts::ALL).expect("the scene is well formed");
    let mut uploaded = GpuScene::upload(&device, &tables, &view()).expect("the scene fits");
    let geometry = uploaded.geometry().desc().clone();
    let (positions, indices) = uploaded.geometry().download(&device).expect("readable");
    assert_eq!(positions, tables.posed.positions);
    assert_eq!(indices, tables.posed.indices);
    let draws: Vec<rasray_ads::Draw> = device.download_as(&geometry.draws.buffer, 0, 1).expect("readable");
    assert_eq!(draws, tables.posed.draws);
    assert_eq!((geometry.vertex_count, geometry.triangle_count, geometry.draw_count), (300, 100, 1));
    assert_eq!(geometry.bounds, [[0.0; 3], [299.0, 2.0, 6.0]]);
    assert_eq!(geometry.frame_origin, [100.0, 0.0, 0.0]);
    assert_eq!((uploaded.eye(), uploaded.image_size()), ([0.0, 0.0, 0.5], [16, 8]));
    let mut other = view();
    other.camera.world_from_camera = DAffine3::from_translation(DVec3::new(101.0, 0.0, 0.0));
    other.width = 20;
    uploaded.update_camera(&other).expect("the frame can be written");
    assert_eq!((uploaded.eye(), uploaded.image_size()), ([1.0, 0.0, 0.0], [20, 8]));
    assert_eq!(uploaded.frame().triangle_count, 100);
    assert_eq!(device.validation_messages(), Vec::<String>::new());
}

#[test]
fn bytes_are_given_by_part_and_come_back() {
    let device = device();
    let tables = SceneTables::new(&scene(10), DVec3::ZERO, &Parts::ALL).expect("the scene is well formed");
    let uploaded = GpuScene::upload(&device, &tables, &view()).expect("the scene fits");
    let bytes = |name| uploaded.bytes_by_part().iter().find(|part| part.0 == name).map(|part| part.1);
    assert_eq!(bytes("positions"), Some(10 * 36));
    assert_eq!(bytes("indices"), Some(10 * 12));
    assert_eq!(bytes("materials"), Some(300));
    assert_eq!(bytes("lights"), Some(56), "one zero record stands in for an empty table");
    assert_eq!(uploaded.bytes(), uploaded.bytes_by_part().iter().map(|part| part.1).sum::<u64>());
    assert!(device.allocated_bytes() >= uploaded.bytes());
    let log = device.validation_log();
    drop(uploaded);
    assert_eq!(device.allocated_bytes(), 0);
    drop(device);
    assert_eq!(log.messages(), Vec::<String>::new());
}

#[test]
fn a_scene_without_triangles_can_be_uploaded() {
    let device = device();
    let tables =
        SceneTables::new(&Scene::default(), DVec3::ZERO, &Parts::ALL).expect("the scene is well formed");
    let uploaded = GpuScene::upload(&device, &tables, &view()).expect("the scene fits");
    assert_eq!(uploaded.geometry().triangle_count(), 0);
    assert!(!uploaded.binding().alpha_masked && !uploaded.features().textures);
    assert_eq!(device.validation_messages(), Vec::<String>::new());
}

#[test]
fn too_little_memory_is_an_error_that_names_the_table() {
    let device = device();
    let tables =
        SceneTables::new(&scene(10_000), DVec3::ZERO, &Parts::ALL).expect("the scene is well formed");
    device.set_memory_limit(Some(200_000));
    match GpuScene::upload(&device, &tables, &view()) {
        Err(GpuSceneError::Gpu(GpuError::OutOfDeviceMemory { name, .. })) => assert_eq!(name, "positions"),
        other => panic!("expected to run out of memory, got {other:?}"),
    }
    assert_eq!(device.allocated_bytes(), 0);
    assert_eq!(device.validation_messages(), Vec::<String>::new());
}

#[test]
fn texels_lie_in_runs_that_count_as_one_part() {
    let device = device();
    let mut tables = SceneTables::new(&scene(1), DVec3::ZERO, &Parts::ALL).expect("the scene is well formed");
    tables.texels = (0..1000).collect();
    for (length, is_split) in [(1024, false), (999, true), (512, true), (256, true)] {
        let runs = TexelRuns::at_most(length);
        let uploaded = GpuScene::upload_in_runs(&device, &tables, &view(), runs).expect("the scene fits");
        let parts = uploaded.bytes_by_part().iter().filter(|part| part.0 == "texels");
        assert_eq!(parts.map(|part| part.1).collect::<Vec<_>>(), [4000], "runs of {length}");
        assert_eq!(uploaded.frame().texel_shift, runs.shift());
        assert_eq!(uploaded.features().texel_runs, is_split, "runs of {length}");
    }
    match GpuScene::upload_in_runs(&device, &tables, &view(), TexelRuns::at_most(128)) {
        Err(GpuSceneError::TooManyTexels { count: 1000, limit: 512 }) => {}
        other => panic!("four runs of 128 hold 512 texels, got {other:?}"),
    }
    // By default the runs are the longest that the device can bind.
    let uploaded = GpuScene::upload(&device, &tables, &view()).expect("the scene fits");
    let bytes = 4u64 << uploaded.frame().texel_shift;
    let limit = device.limits().max_storage_buffer_range.min(device.limits().max_memory_allocation);
    assert!(bytes <= limit && (2 * bytes > limit || bytes == 4 << 30), "{bytes} of {limit}");
    assert_eq!(device.validation_messages(), Vec::<String>::new());
}

/// Makes a built-in scene with all features that parts can leave out: a map around it, all attributes, rough
/// glass, a lamp.
fn scene_with_all_parts() -> Scene {
    let mut scene = builtin::builtin("atrium").expect("a name").expect("no parameters");
    scene.environment = Environment::LatLong { width: 4, height: 2, radiance: vec![[0.5; 3]; 8] };
    for mesh in &mut scene.meshes {
        let vertices = mesh.positions.len();
        mesh.tangents.get_or_insert_with(|| vec![[1.0, 0.0, 0.0, 1.0]; vertices]);
        mesh.colors.get_or_insert_with(|| vec![[1.0; 4]; vertices]);
        mesh.uvs[1].get_or_insert_with(|| vec![[0.0; 2]; vertices]);
    }
    scene.lights.push(Light::Point { position: DVec3::Y, intensity: [1.0; 3], range: f32::INFINITY });
    let glass =
        Material { transmission: 1.0, thickness: 0.1, roughness: 0.5, ior: 1.5, ..Material::default() };
    scene.materials[0] = Material { emission: [1.0; 3], ..glass };
    scene
}

#[test]
fn bytes_that_are_left_out_are_those_that_are_not_allocated() {
    let device = device();
    let of_part: [fn(&mut Parts); 13] = [
        |parts| parts.normals = false,
        |parts| parts.tangents = false,
        |parts| parts.uvs = [true, false],
        |parts| parts.colors = false,
        |parts| parts.base_color_textures = false,
        |parts| parts.normal_textures = false,
        |parts| parts.emission_textures = false,
        |parts| parts.glass_albedos = false,
        |parts| parts.alpha = false,
        |parts| parts.lights = false,
        |parts| parts.emissive_triangles = false,
        |parts| parts.environment = false,
        |parts| *parts = Parts::VISIBILITY,
    ];
    for scene in [scene_with_all_parts(), scene(10), Scene::default()] {
        let origin = SceneTables::default_frame_origin(&scene, DVec3::ZERO);
        let uploaded = |parts: &Parts| {
            let tables = SceneTables::new(&scene, origin, parts).expect("the scene is well formed");
            GpuScene::upload(&device, &tables, &view()).expect("the scene fits").bytes()
        };
        let whole = uploaded(&Parts::ALL);
        let mut saving = 0;
        for change in of_part {
            let mut parts = Parts::ALL;
            change(&mut parts);
            let left_out = left_out_bytes(&scene, origin, &parts).expect("the scene is well formed");
            assert_eq!(left_out, whole - uploaded(&parts), "{}: {parts:?}", scene.name);
            saving += usize::from(left_out > 0);
        }
        assert_eq!(left_out_bytes(&scene, origin, &Parts::ALL).expect("the scene is well formed"), 0);
        assert!(scene.name != "atrium" || saving > 8, "{saving} of the parts have bytes of their own");
    }
    assert_eq!(device.validation_messages(), Vec::<String>::new());
}
