//! Packing of whole scenes, without a device.

use glam::{DAffine3, DMat3, DVec3};
use rasray_gpu_scene::{GpuSceneError, LARGEST_COORDINATE, Parts, SceneTables, View, layout};
use rasray_scene::{
    AlphaMode, Camera, Environment, Filter, Image, Instance, Light, Material, Mesh, Projection, Scene,
    Texture, TextureRef, Wrap,
};
use rasray_shaders_glsl::constants::{contract, scene as numbers};

const IDENTITY_ROWS: [[f32; 3]; 2] = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];

fn texture_ref(texture: usize) -> TextureRef {
    TextureRef { texture, uv_set: 0, uv_transform: IDENTITY_ROWS }
}

/// Makes a square of two triangles in the xy plane, with all attributes.
fn square(material: usize) -> Mesh {
    Mesh {
        name: "square".to_owned(),
        positions: vec![[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]],
        normals: Some(vec![[0.0, 0.0, 1.0]; 4]),
        tangents: Some(vec![[1.0, 0.0, 0.0, 1.0]; 4]),
        uvs: [Some(vec![[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]]), None],
        colors: Some(vec![[1.0, 0.5, 0.25, 1.0]; 4]),
        indices: vec![0, 1, 2, 0, 2, 3],
        material,
    }
}

fn instance(mesh: usize, world_from_mesh: DAffine3) -> Instance {
    Instance { name: format!("instance of {mesh}"), mesh, world_from_mesh }
}

/// Makes three instances of two meshes: plain, mirrored and scaled, and an emissive one.
fn scene() -> Scene {
    let image = |name: &str, width: u32, height: u32, byte: u8| Image {
        name: name.to_owned(),
        width,
        height,
        rgba8: vec![byte; (width * height * 4) as usize],
    };
    let texture = |image: usize, mipmapped: bool| Texture {
        image,
        wrap_u: Wrap::Mirror,
        wrap_v: Wrap::Clamp,
        filter: Filter::Linear,
        mipmapped,
    };
    Scene {
        name: "three squares".to_owned(),
        meshes: vec![square(0), square(1)],
        instances: vec![
            instance(0, DAffine3::from_translation(DVec3::new(1e6, 0.0, 0.25))),
            instance(0, DAffine3::from_mat3(DMat3::from_diagonal(DVec3::new(-2.0, 1.0, 1.0)))),
            instance(1, DAffine3::IDENTITY),
        ],
        materials: vec![
            Material {
                base_color_texture: Some(texture_ref(0)),
                metallic_roughness_texture: Some(texture_ref(0)),
                normal_texture: Some(texture_ref(1)),
                alpha_mode: AlphaMode::Mask { cutoff: 0.25 },
                ..Material::default()
            },
            Material {
                emission: [2.0, 2.0, 2.0],
                emission_texture: Some(texture_ref(1)),
                double_sided: true,
                ..Material::default()
            },
        ],
        textures: vec![texture(0, true), texture(1, false)],
        images: vec![image("large", 4, 2, 100), image("small", 2, 2, 255)],
        lights: vec![Light::Directional { direction: DVec3::NEG_Y, irradiance: [1.0; 3] }],
        environment: Environment::Constant([0.5; 3]),
        ..Scene::default()
    }
}

fn pack(scene: &Scene, origin: DVec3, parts: &Parts) -> SceneTables {
    SceneTables::new(scene, origin, parts).expect("the scene is well formed")
}

#[test]
fn positions_indices_and_draws_follow_scene_order() {
    let origin = DVec3::new(1e6, 0.0, 0.0);
    let tables = pack(&scene(), origin, &Parts::ALL);
    let posed = &tables.posed;
    assert_eq!(posed.triangle_count(), 6);
    assert_eq!(posed.positions.len(), 12);
    assert_eq!(posed.indices[..6], [0, 1, 2, 0, 2, 3]);
    assert_eq!(posed.indices[12..], [8, 9, 10, 8, 10, 11]);
    assert_eq!(posed.draw_of_triangle, [0, 0, 1, 1, 2, 2]);
    assert_eq!(posed.positions[2], [1.0, 1.0, 0.25], "the origin is taken off in f64");
    assert_eq!(posed.positions[5], [(-2.0f64 - 1e6) as f32, 0.0, 0.0]);
    assert_eq!(posed.draws[1].first_triangle, 2);
    assert_eq!(posed.draws[0].flags, contract::DRAW_ALPHA_MASKED);
    assert_eq!(posed.draws[2].flags, 0);
    assert_eq!(posed.upper, [1.0, 1.0, 0.25]);
    assert_eq!(posed.lower, [-1_000_002.0, 0.0, 0.0]);
}

#[test]
fn attributes_are_posed_once_per_instance_and_shared_where_they_can_be() {
    let tables = pack(&scene(), DVec3::ZERO, &Parts::ALL);
    let [plain, mirrored, emissive] = tables.draw_shadings[..] else { panic!("three draws") };
    assert_eq!(
        (plain.flags, mirrored.flags),
        (contract::DRAW_ALPHA_MASKED, contract::DRAW_ALPHA_MASKED | contract::DRAW_MIRRORED)
    );
    assert_eq!((plain.uv0, plain.colors), (mirrored.uv0, mirrored.colors));
    assert_ne!(plain.normals, mirrored.normals);
    assert_ne!(plain.uv0, emissive.uv0);
    assert_eq!(plain.uv1, numbers::ATTRIBUTE_NONE);
    assert_eq!((mirrored.first_vertex, mirrored.first_triangle, mirrored.instance), (4, 2, 1));
    let tangent = &tables.posed_attributes[mirrored.tangents as usize..][..4];
    assert_eq!(tangent, [-1.0, 0.0, 0.0, -1.0]);
    let normal = &tables.posed_attributes[mirrored.normals as usize..][..3];
    assert_eq!(normal, [0.0, 0.0, 1.0]);
    assert_eq!(tables.vertex_attributes[plain.uv0 as usize..][2..4], [1.0, 0.0]);
    assert_eq!(tables.vertex_attributes[plain.colors as usize..][..4], [1.0, 0.5, 0.25, 1.0]);
}

#[test]
fn one_entry_for_each_texture_and_use_one_run_of_texels_for_each_image_and_encoding() {
    let tables = pack(&scene(), DVec3::ZERO, &Parts::ALL);
    let [masked, emissive] = tables.materials[..] else { panic!("two materials") };
    // The textures are base colour (sRGB), metallic-roughness (linear) and normal (linear) of one material,
    // emission (sRGB) of the other.
    assert_eq!(tables.textures.len(), 4);
    let texture = |slot: layout::TextureUse| tables.textures[slot.texture as usize];
    let color = texture(masked.base_color_texture);
    let linear = texture(masked.metallic_roughness_texture);
    assert_eq!((color.width, color.height, color.level_count), (4, 2, 3));
    let wraps = numbers::WRAP_MIRROR | numbers::WRAP_CLAMP << numbers::TEXTURE_WRAP_V_SHIFT;
    assert_eq!(color.sampling, wraps | numbers::TEXTURE_LINEAR | numbers::TEXTURE_SRGB);
    assert_eq!(linear.sampling, wraps | numbers::TEXTURE_LINEAR);
    assert_ne!(color.first_texel, linear.first_texel);
    assert_eq!(texture(emissive.emission_texture).level_count, 1);
    assert_eq!(tables.texels.len(), 2 * (8 + 2 + 1) + 2 * 4);
    assert!(tables.texels[color.first_texel as usize..][..11].iter().all(|&texel| texel == 0x6464_6464));
    assert_eq!(masked.transmission_texture.texture, numbers::TEXTURE_NONE);
    assert_eq!((masked.flags, masked.alpha_cutoff), (numbers::MATERIAL_ALPHA_MASK, 0.25));
    assert_eq!(emissive.flags, numbers::MATERIAL_DOUBLE_SIDED);
}

#[test]
fn emissive_triangles_are_chosen_by_power() {
    let mut scene = scene();
    // The second emissive instance is four times as large.
    scene.instances.push(instance(1, DAffine3::from_scale(DVec3::splat(2.0))));
    let tables = pack(&scene, DVec3::ZERO, &Parts::ALL);
    let entries: Vec<_> = tables.emissive_triangles.iter().map(|e| (e.primitive, e.cumulative)).collect();
    assert_eq!(entries, [(4, 0.1), (5, 0.2), (6, 0.6), (7, 1.0)]);
    let first: Vec<u32> = tables.draw_shadings.iter().map(|draw| draw.first_emissive).collect();
    assert_eq!(first, [numbers::EMISSIVE_NONE, numbers::EMISSIVE_NONE, 0, 2]);
    // A texture that glows on one half gives its power to the triangles of that half: 4 texels a row, 2 of
    // them dark.
    let whole = tables.emissive_triangles.len();
    let dark_right = |texel: usize| texel % 4 >= 2;
    let mut halved = scene.clone();
    halved.images[1] = Image { name: "half".to_owned(), width: 4, height: 4, rgba8: Vec::new() };
    halved.images[1].rgba8 = (0..16).flat_map(|texel| [if dark_right(texel) { 0 } else { 255 }; 4]).collect();
    let square = &mut halved.meshes[1];
    // The first triangle lies on the left half of the image, the second on the right.
    square.indices = vec![0, 1, 2, 3, 4, 5];
    let [a, b, c, d] = [0, 1, 2, 3].map(|corner| square.positions[corner]);
    square.positions = vec![a, b, c, a, c, d];
    (square.normals, square.tangents, square.colors) = (None, None, None);
    square.uvs =
        [Some(vec![[0.05, 0.1], [0.45, 0.1], [0.45, 0.9], [0.55, 0.1], [0.95, 0.9], [0.55, 0.9]]), None];
    if let Some(used) = &mut halved.materials[1].emission_texture {
        (used.uv_set, used.uv_transform) = (0, [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0]]);
    }
    let halved = pack(&halved, DVec3::ZERO, &Parts::ALL).emissive_triangles;
    let cumulative: Vec<_> = halved.iter().map(|entry| entry.cumulative).collect();
    assert_eq!((cumulative, whole), (vec![0.2, 0.2, 1.0, 1.0], 4));
    // A black emission texture leaves nothing to sample.
    scene.images[1].rgba8.fill(0);
    let tables = pack(&scene, DVec3::ZERO, &Parts::ALL);
    assert!(tables.emissive_triangles.is_empty());
    assert!(tables.draw_shadings.iter().all(|draw| draw.first_emissive == numbers::EMISSIVE_NONE));
    // A blended material has power in proportion to its opacity; a clear or an unlit one has none.
    scene.images[1].rgba8.fill(255);
    let opaque = pack(&scene, DVec3::ZERO, &Parts::ALL);
    let alpha = scene.materials[1].base_color[3];
    scene.materials[1].alpha_mode = AlphaMode::Blend;
    scene.materials[1].base_color[3] = 0.5;
    let blended = pack(&scene, DVec3::ZERO, &Parts::ALL);
    assert_eq!(blended.emissive_triangles, opaque.emissive_triangles);
    assert_eq!(blended.emissive_power, 0.5 * opaque.emissive_power);
    scene.materials[1].base_color[3] = 0.0;
    assert!(pack(&scene, DVec3::ZERO, &Parts::ALL).emissive_triangles.is_empty());
    (scene.materials[1].alpha_mode, scene.materials[1].base_color[3]) = (AlphaMode::Opaque, alpha);
    scene.materials[1].unlit = true;
    assert!(pack(&scene, DVec3::ZERO, &Parts::ALL).emissive_triangles.is_empty());
}

#[test]
fn what_is_not_observed_is_not_packed() {
    let tables = pack(&scene(), DVec3::ZERO, &Parts::VISIBILITY);
    assert!(tables.posed_attributes.is_empty() && tables.lights.is_empty());
    assert!(tables.emissive_triangles.is_empty() && !tables.environment.emits);
    // The mask's texture and coordinates stay; the emissive square's coordinates go.
    assert_eq!(tables.textures.len(), 1);
    assert_ne!(tables.draw_shadings[0].uv0, numbers::ATTRIBUTE_NONE);
    assert_eq!(tables.draw_shadings[2].uv0, numbers::ATTRIBUTE_NONE);
    assert_eq!(tables.materials[0].normal_texture.texture, numbers::TEXTURE_NONE);
    let opaque = Parts { alpha: false, ..Parts::VISIBILITY };
    let tables = pack(&scene(), DVec3::ZERO, &opaque);
    assert!(tables.textures.is_empty() && tables.texels.is_empty());
    assert_eq!(tables.posed.draws[0].flags, 0);
    assert_eq!(tables.materials[0].flags, 0);
    let posed = |parts| pack(&scene(), DVec3::ZERO, &parts).posed.positions;
    assert_eq!(posed(Parts::ALL), posed(Parts::VISIBILITY));
}

#[test]
fn triangles_that_leave_the_range_of_f32_are_collapsed_and_counted() {
    let mut scene = scene();
    scene.instances[1].world_from_mesh = DAffine3::from_scale(DVec3::new(1e30, 1.0, 1.0));
    scene.instances[2].world_from_mesh = DAffine3::from_translation(DVec3::new(f64::NAN, 0.0, 0.0));
    let tables = pack(&scene, DVec3::ZERO, &Parts::ALL);
    let posed = &tables.posed;
    assert_eq!(posed.dropped_triangles, 4);
    assert_eq!(posed.triangle_count(), 6, "ids do not shift");
    assert!(posed.positions.iter().flatten().all(|x| x.is_finite() && x.abs() <= LARGEST_COORDINATE));
    for triangle in posed.indices[6..].chunks_exact(3) {
        assert!(triangle[0] == triangle[1] && triangle[1] == triangle[2]);
    }
    let lamps = (tables.emissive_triangles.len(), tables.emissive_power);
    assert_eq!(lamps, (2, 0.0), "a collapsed light has no area, and may have one later");
}

#[test]
fn malformed_scenes_are_errors_that_say_what_is_missing() {
    let broken = |change: &dyn Fn(&mut Scene)| {
        let mut scene = scene();
        change(&mut scene);
        match SceneTables::new(&scene, DVec3::ZERO, &Parts::ALL) {
            Err(error @ GpuSceneError::Malformed { .. }) => error.to_string(),
            other => panic!("expected a malformed scene, got {other:?}"),
        }
    };
    assert!(broken(&|s| s.instances[0].mesh = 9).contains("mesh 9"));
    assert!(broken(&|s| s.meshes[0].material = 7).contains("material 7"));
    assert!(broken(&|s| s.meshes[1].indices[4] = 4).contains("vertex 4"));
    assert!(broken(&|s| s.meshes[1].indices[4] = u32::MAX).contains("vertex"));
    assert!(broken(&|s| s.textures[0].image = 5).contains("image 5"));
    assert!(broken(&|s| s.materials[0].normal_texture = Some(texture_ref(3))).contains("texture 3"));
    assert!(broken(&|s| s.images[0].rgba8.truncate(31)).contains("large"));
    assert!(broken(&|s| s.meshes[0].normals = Some(vec![[0.0; 3]; 3])).contains("3 normals"));
}

#[test]
fn a_scene_without_triangles_has_an_environment_and_nothing_else() {
    let scene = Scene { environment: Environment::Constant([1.0; 3]), ..Scene::default() };
    let tables = pack(&scene, DVec3::ZERO, &Parts::ALL);
    let camera = Camera {
        name: "eye".to_owned(),
        world_from_camera: DAffine3::IDENTITY,
        projection: Projection::Perspective { fov_y: 1.0 },
        aspect_ratio: None,
        lens: None,
    };
    let frame = tables.frame(&View { camera, width: 8, height: 4, seed: 3 });
    assert_eq!((frame.triangle_count, frame.light_count, frame.emissive_count), (0, 0, 0));
    assert_eq!((frame.environment_sampled, frame.environment_radiance), (1, [1.0; 3]));
    assert_eq!((frame.width, frame.height, frame.seed), (8, 4, 3));
    assert_eq!(tables.posed.lower, [0.0; 3]);
    assert_eq!(
        SceneTables::default_frame_origin(&scene, DVec3::new(3.4, 0.0, 70.4)),
        DVec3::new(3.0, 0.0, 70.0)
    );
}

#[test]
fn the_default_frame_origin_is_near_the_eye_and_stays_on_its_grid() {
    let scene = scene();
    // The scene reaches from -2 to 1e6 + 1: an eighth of that is above 2^16 metres.
    let eye = DVec3::new(9e5, 10.0, -70_000.0);
    let origin = SceneTables::default_frame_origin(&scene, eye);
    assert_eq!(origin, DVec3::new(14.0 * 65_536.0, 0.0, -65_536.0));
    assert_eq!(SceneTables::default_frame_origin(&scene, eye + DVec3::splat(3.0)), origin);
    // Nearer to the world's origin another one gains nothing.
    assert_eq!(SceneTables::default_frame_origin(&scene, DVec3::new(16_000.0, 10.0, -900.0)), DVec3::ZERO);
}

#[test]
fn a_small_model_keeps_the_bits_of_its_file() {
    let mut scene = scene();
    for (mesh, scale) in scene.meshes.iter_mut().zip([0.1, 0.01].into_iter().cycle()) {
        for position in &mut mesh.positions {
            *position = position.map(|x| x * scale);
        }
    }
    scene.meshes[0].positions[0] = [-0.0, 0.1, 1e-40];
    for instance in &mut scene.instances {
        instance.world_from_mesh = DAffine3::IDENTITY;
    }
    let origin = SceneTables::default_frame_origin(&scene, DVec3::new(0.31, 0.25, 0.625));
    assert_eq!(origin, DVec3::ZERO);
    let tables = pack(&scene, origin, &Parts::ALL);
    let files = scene.instances.iter().flat_map(|instance| &scene.meshes[instance.mesh].positions);
    let bits = |position: &[f32; 3]| position.map(f32::to_bits);
    assert!(tables.posed.positions.iter().map(bits).eq(files.map(bits)));
}
