//! Scenes that use every feature of shading.

use glam::{DAffine3, DMat3, DVec3};
use rasray_scene::{
    AlphaMode, Camera, Environment, Filter, Image, Light, Material, Scene, Texture, TextureRef, Wrap, builtin,
};

use super::{box_inside, lambert, scene, square};

pub fn cornell() -> (Scene, Camera) {
    let scene = builtin::builtin("cornell").expect("a name of a built-in scene").expect("no parameters");
    let camera = scene.cameras[0].clone();
    (scene, camera)
}

/// Makes a checkered image with alpha in its dark squares.
fn checker(size: u32, dark: [u8; 4], bright: [u8; 4]) -> Image {
    let rgba8 = (0..size * size)
        .flat_map(|i| if (i % size / 3 + i / size / 3).is_multiple_of(2) { dark } else { bright })
        .collect();
    Image { name: "checker".to_owned(), width: size, height: size, rgba8 }
}

fn textured(texture: usize, scale: f32) -> Option<TextureRef> {
    let uv_transform = [[scale, 0.1, 0.05], [-0.1, scale, 0.3]];
    Some(TextureRef { texture, uv_set: 0, uv_transform })
}

fn with_coordinates(mut mesh: rasray_scene::Mesh) -> rasray_scene::Mesh {
    let corners = vec![[-0.2, -0.3], [1.4, 0.0], [1.1, 1.2], [0.0, 1.0]];
    mesh.uvs[0] = Some(corners);
    mesh.colors = Some(vec![[1.0, 0.8, 0.6, 1.0], [0.7, 1.0, 0.9, 1.0], [1.0; 4], [0.5, 0.6, 1.0, 1.0]]);
    mesh
}

/// Makes a room with every kind of texture, a mask, vertex colours, a mirrored instance, an environment map
/// and lights.
pub fn textured_room() -> Scene {
    let floor = Material {
        base_color_texture: textured(0, 3.0),
        metallic_roughness_texture: textured(2, 2.0),
        normal_texture: textured(3, 1.5),
        metallic: 0.6,
        roughness: 0.8,
        ..lambert(0.9, 0.0)
    };
    let fence = Material {
        base_color_texture: textured(1, 1.0),
        alpha_mode: AlphaMode::Mask { cutoff: 0.5 },
        specular: 1.0,
        ..lambert(0.8, 0.0)
    };
    let lamp = Material { emission_texture: textured(0, 1.0), ..lambert(0.2, 6.0) };
    let meshes = vec![
        with_coordinates(square(DVec3::new(0.0, -1.0, -2.0), DVec3::X * 3.0, -DVec3::Z * 3.0, 0)),
        with_coordinates(square(DVec3::new(0.5, -0.3, -2.0), DVec3::X * 0.7, DVec3::Y * 0.7, 1)),
        with_coordinates(square(DVec3::new(-1.5, 0.6, -2.5), DVec3::X * 0.4, DVec3::new(0.0, 0.2, 0.4), 2)),
    ];
    let mut scene = scene(meshes, vec![floor, fence, lamp], [0.0; 3]);
    scene.name = "textured room".to_owned();
    scene.instances.push(rasray_scene::Instance {
        name: "mirrored fence".to_owned(),
        mesh: 1,
        world_from_mesh: DAffine3::from_mat3_translation(
            DMat3::from_diagonal(DVec3::new(-1.0, 1.2, 0.9)),
            DVec3::new(-0.4, 0.1, -0.8),
        ),
    });
    let texture = |image, filter, mipmapped| Texture {
        image,
        wrap_u: Wrap::Repeat,
        wrap_v: Wrap::Mirror,
        filter,
        mipmapped,
    };
    scene.images = vec![
        checker(32, [40, 60, 90, 255], [250, 230, 200, 255]),
        checker(13, [90, 160, 70, 30], [200, 220, 160, 255]),
        checker(8, [0, 120, 200, 255], [0, 230, 40, 255]),
        checker(16, [110, 140, 250, 255], [140, 120, 240, 255]),
    ];
    scene.textures = vec![
        texture(0, Filter::Linear, true),
        texture(1, Filter::Nearest, false),
        texture(2, Filter::Linear, true),
        Texture { wrap_u: Wrap::Clamp, ..texture(3, Filter::Linear, false) },
    ];
    let radiance =
        (0..16 * 8).map(|i| [0.1 + (i % 5) as f32 * 0.2, 0.3, 0.2 + (i / 16) as f32 * 0.1]).collect();
    scene.environment = Environment::LatLong { width: 16, height: 8, radiance };
    scene.lights = vec![
        Light::Point { position: DVec3::new(1.0, 1.5, -1.0), intensity: [2.0, 1.5, 1.0], range: 20.0 },
        Light::Directional { direction: DVec3::new(0.3, -1.0, -0.2).normalize(), irradiance: [0.5; 3] },
        Light::Spot {
            position: DVec3::new(-1.0, 1.0, 0.0),
            direction: DVec3::new(0.5, -1.0, -1.0).normalize(),
            intensity: [4.0; 3],
            range: f32::INFINITY,
            inner_cone: 0.2,
            outer_cone: 0.6,
        },
    ];
    scene
}

/// Makes a solid block of glass, a rough pane, metal, a veil and an unlit sign in a lit box.
pub fn glass_room() -> Scene {
    let glass = Material {
        transmission: 1.0,
        roughness: 0.0,
        specular: 1.0,
        thickness: 0.2,
        attenuation_color: [0.4, 0.9, 0.7],
        attenuation_distance: 0.5,
        ..lambert(1.0, 0.0)
    };
    let pane = Material { thickness: 0.0, roughness: 0.3, transmission: 0.7, ..glass.clone() };
    let metal = Material { metallic: 1.0, roughness: 0.25, specular: 1.0, ..lambert(0.9, 0.0) };
    let mut veil = lambert(0.7, 0.0);
    veil.base_color[3] = 0.4;
    veil.alpha_mode = AlphaMode::Blend;
    let unlit = Material { unlit: true, ..lambert(0.3, 0.0) };
    let mut meshes = box_inside(1.0, 0);
    meshes.push(square(DVec3::new(0.0, 0.98, 0.0), DVec3::X * 0.4, DVec3::Z * 0.4, 1));
    for face in box_inside(0.25, 2) {
        // The face is turned outwards and moved to the left.
        let mut face = face;
        face.indices = face.indices.chunks_exact(3).flat_map(|t| [t[0], t[2], t[1]]).collect();
        for position in &mut face.positions {
            position[0] -= 0.5;
        }
        meshes.push(face);
    }
    meshes.push(square(DVec3::new(0.5, 0.3, -0.3), DVec3::X * 0.3, DVec3::Y * 0.3, 3));
    meshes.push(square(DVec3::new(0.5, -0.5, -0.5), DVec3::X * 0.4, DVec3::new(0.0, 0.3, -0.2), 4));
    meshes.push(square(DVec3::new(0.0, -0.3, 0.2), DVec3::X * 0.3, DVec3::Y * 0.4, 5));
    meshes.push(square(DVec3::new(0.0, 0.6, -0.9), DVec3::X * 0.2, DVec3::Y * 0.1, 6));
    let materials = vec![lambert(0.6, 0.0), lambert(0.0, 4.0), glass, pane, metal, veil, unlit];
    let mut scene = scene(meshes, materials, [0.0; 3]);
    scene.name = "glass, mirrors and a veil".to_owned();
    scene
}

/// Makes the glass room with smooth panes, tinted, milky and with holes, more veils, and lights of all kinds
/// in front of them and behind.
pub fn veiled_room() -> Scene {
    let mut scene = glass_room();
    let pane = Material {
        transmission: 1.0,
        roughness: 0.0,
        specular: 1.0,
        thickness: 0.0,
        base_color: [0.9, 0.6, 0.3, 1.0],
        ..lambert(1.0, 0.0)
    };
    let milky = Material { transmission: 0.6, metallic: 0.2, emission: [0.1, 0.0, 0.2], ..pane.clone() };
    let mut holed = pane.clone();
    holed.base_color[3] = 0.6;
    holed.alpha_mode = AlphaMode::Blend;
    let mut glowing = lambert(0.2, 3.0);
    glowing.base_color[3] = 0.3;
    glowing.alpha_mode = AlphaMode::Blend;
    let first = scene.materials.len();
    scene.materials.extend([pane, milky, holed, glowing]);
    let under_lamp = |y: f64| DVec3::new(0.1, y, 0.0);
    for (place, u, v, material) in [
        (under_lamp(0.8), DVec3::X * 0.5, DVec3::Z * 0.5, first),
        (under_lamp(0.7), DVec3::X * 0.3, DVec3::new(0.0, 0.1, 0.4), first + 1),
        (under_lamp(0.6), DVec3::X * 0.4, DVec3::Z * 0.4, first + 2),
        (under_lamp(0.5), DVec3::X * 0.6, DVec3::Z * 0.3, 5),
        (DVec3::new(0.0, 0.2, 0.5), DVec3::X * 0.2, DVec3::Y * 0.2, first),
        (DVec3::new(-0.6, 0.4, 0.3), DVec3::Z * 0.1, DVec3::Y * 0.15, first + 3),
    ] {
        let mesh = scene.meshes.len();
        scene.meshes.push(square(place, u, v, material));
        scene.instances.push(rasray_scene::Instance { mesh, ..scene.instances[0].clone() });
    }
    scene.lights.push(Light::Point {
        position: DVec3::new(0.2, 0.9, 0.1),
        intensity: [0.5, 0.4, 0.6],
        range: f32::INFINITY,
    });
    scene.name = "veils and panes".to_owned();
    scene
}
