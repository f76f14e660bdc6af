//! A smithy: one room full of objects, lit through a door and a window.

mod things;
mod walls;

use glam::DVec3;

use super::cornell::{diffuse, place_each};
use super::shape::Shapes;
use super::texture::{repeating, textured, wood};
use crate::default_view::camera_looking_at;
use crate::{Light, Material, Mesh, Scene};

/// Half extent of the room, metres: x and z.
const ROOM: (f64, f64) = (3.5, 2.6);
/// Height under the beams, metres.
const HEIGHT: f64 = 3.0;

/// Centre of the lantern, metres.
const LANTERN: DVec3 = DVec3::new(0.9, 2.05, -0.6);

/// Materials in the order of [`Kit::shapes`].
#[derive(Clone, Copy)]
enum Of {
    Stone,
    Mortar,
    Flags,
    Timber,
    Iron,
    Steel,
    Brick,
    Coal,
    Ember,
    Leather,
    Copper,
    Clay,
    Flame,
    Water,
    Daylight,
}

/// Shapes of the scene by material.
struct Kit {
    shapes: Vec<Shapes>,
}

impl Kit {
    fn of(&mut self, material: Of) -> &mut Shapes {
        &mut self.shapes[material as usize]
    }
}

/// Makes a smithy of 7 m by 5.2 m with walls of single stones, beams, a forge with glowing coals, an anvil, a
/// bench, tools on the walls, barrels, crates, a wheel. Screens as bright as the sky stand outside the door
/// and the window and above two lights in the roof: a renderer that samples lamps finds them, and the
/// openings stay open. The scene suits ambient occlusion, with corners, gaps and objects before walls at
/// every size.
pub fn smithy() -> Scene {
    let materials = materials();
    let shapes =
        materials.iter().enumerate().map(|(index, material)| Shapes::new(&material.name, index)).collect();
    let mut kit = Kit { shapes };
    walls::add(&mut kit);
    things::add(&mut kit);
    let meshes: Vec<Mesh> = kit.shapes.into_iter().map(Shapes::finish).collect();
    Scene {
        name: "smithy".to_owned(),
        instances: place_each(&meshes),
        meshes,
        materials,
        textures: vec![repeating(0)],
        images: vec![wood()],
        lights: vec![Light::Point {
            position: LANTERN - DVec3::Y * 0.14,
            intensity: [2.2, 1.4, 0.7],
            range: f32::INFINITY,
        }],
        cameras: vec![camera_looking_at(
            "corner",
            DVec3::new(2.75, 1.62, 2.2),
            DVec3::new(-1.0, 0.95, -1.35),
            0.98,
        )],
        ..Scene::default()
    }
}

fn materials() -> Vec<Material> {
    let metal = |name: &str, color: [f32; 3], roughness: f32| Material {
        metallic: 1.0,
        roughness,
        ..diffuse(name, color)
    };
    let timber = Material { specular: 0.4, roughness: 0.6, ..diffuse("timber", [1.0; 3]) };
    vec![
        diffuse("stone", [0.46, 0.42, 0.37]),
        diffuse("mortar", [0.34, 0.31, 0.27]),
        Material { specular: 0.5, roughness: 0.5, ..diffuse("flags", [0.3, 0.29, 0.28]) },
        textured(timber, 0),
        metal("iron", [0.3, 0.29, 0.28], 0.42),
        metal("steel", [0.62, 0.61, 0.6], 0.25),
        diffuse("brick", [0.42, 0.19, 0.12]),
        diffuse("coal", [0.03, 0.03, 0.03]),
        Material { emission: [11.0, 2.6, 0.35], ..diffuse("ember", [0.2, 0.05, 0.02]) },
        Material { specular: 0.6, roughness: 0.5, ..diffuse("leather", [0.2, 0.1, 0.05]) },
        metal("copper", [0.86, 0.5, 0.34], 0.28),
        Material { specular: 0.8, roughness: 0.4, ..diffuse("clay", [0.48, 0.24, 0.13]) },
        Material { emission: [30.0, 19.0, 9.0], ..diffuse("flame", [0.5; 3]) },
        Material { specular: 1.0, roughness: 0.1, ..diffuse("water", [0.03, 0.05, 0.05]) },
        Material { emission: [10.0, 10.6, 11.4], ..diffuse("daylight", [0.5; 3]) },
    ]
}

fn at(x: f64, y: f64, z: f64) -> DVec3 {
    DVec3::new(x, y, z)
}
