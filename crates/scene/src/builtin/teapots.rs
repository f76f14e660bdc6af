//! Teapots on a mirror.

use std::ops::RangeInclusive;

use glam::{DAffine3, DMat3, DVec2, DVec3};

use super::cornell::diffuse;
use super::forms::{about_y, turn};
use super::shape::Shapes;
use super::spheres::Random;
use super::teapot::{BODY, teapot};
use crate::default_view::camera_looking_at;
use crate::{Environment, Instance, Material, Scene};

/// How far the mirror reaches beyond the middle of the outermost pot, metres.
const MARGIN: f64 = 4.0;
/// Quads along a side of a patch.
const STEPS: usize = 10;
/// Width of a pot's body, metres; from handle to spout it is 1.61 times as long.
const WIDTH: f64 = 0.4;
/// Distance of the pots times 0.65, metres: none reaches another, however they are turned.
const SPACING: f64 = 0.46;
/// Seed of the turns of the pots.
const SEED: u64 = 0x5EED_0005;

/// Parameters of [`teapots`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Teapots {
    /// How many there are, within [`Teapots::POTS`].
    pub pots: u64,
}

impl Teapots {
    /// How many can be asked for.
    pub const POTS: RangeInclusive<u64> = 1..=2_000;
}

impl Default for Teapots {
    fn default() -> Self {
        Self { pots: 37 }
    }
}

/// Utah teapots of seven glazes and metals in a spiral on a plane mirror, under two large lamps. All are instances of
/// one shape, with a mesh for each material.
pub fn teapots(parameters: Teapots) -> Scene {
    let pots = parameters.pots.clamp(*Teapots::POTS.start(), *Teapots::POTS.end());
    let glaze = |name: &str, color: [f32; 3], roughness: f32| Material {
        specular: 1.0,
        roughness,
        ..diffuse(name, color)
    };
    let metal = |name: &str, color: [f32; 3], roughness: f32| Material {
        metallic: 1.0,
        roughness,
        ..diffuse(name, color)
    };
    let mut materials = vec![
        glaze("porcelain", [0.82, 0.8, 0.76], 0.1),
        metal("copper", [0.93, 0.58, 0.42], 0.22),
        glaze("cobalt", [0.03, 0.08, 0.36], 0.08),
        glaze("celadon", [0.36, 0.56, 0.42], 0.12),
        metal("silver", [0.95, 0.93, 0.9], 0.06),
        glaze("oxblood", [0.42, 0.03, 0.03], 0.1),
        glaze("stoneware", [0.36, 0.26, 0.18], 0.6),
    ];
    let kinds = materials.len();
    let mut meshes: Vec<_> = materials
        .iter()
        .enumerate()
        .take(pots as usize)
        .map(|(index, material)| {
            let mut shapes = Shapes::new(&material.name, index);
            teapot(&mut shapes, DAffine3::from_scale(DVec3::splat(1.0 / BODY)), STEPS);
            shapes.finish()
        })
        .collect();
    let mut random = Random::new(SEED);
    let mut instances: Vec<Instance> = (0..pots)
        .map(|index| {
            // A spiral of golden angles: as much room for each.
            let (sin, cos) = turn(index as f64 * 0.381_966_011_250_105);
            let distance = SPACING * (index as f64 + 0.5).sqrt();
            let turned = DMat3::from_diagonal(DVec3::splat(WIDTH)) * about_y(random.unit());
            // Just above the mirror: standing on it, the bottom would lie in its plane.
            let foot = DVec3::new(distance * cos, 0.0005, distance * sin);
            let kind = index as usize % kinds;
            Instance {
                name: format!("{} {index}", materials[kind].name),
                mesh: kind,
                world_from_mesh: DAffine3::from_mat3_translation(turned, foot),
            }
        })
        .collect();

    materials.push(Material { metallic: 1.0, roughness: 0.0, ..diffuse("mirror", [0.93, 0.93, 0.94]) });
    let mut mirror = Shapes::new("mirror", kinds);
    let half = SPACING * (pots as f64).sqrt() + MARGIN;
    let corner = |x: f64, z: f64| DVec3::new(half * x, 0.0, half * z);
    mirror.quad([corner(-1.0, 1.0), corner(1.0, 1.0), corner(1.0, -1.0), corner(-1.0, -1.0)], DVec2::ONE);
    materials.push(Material { emission: [5.5, 5.2, 4.8], ..diffuse("lamp", [0.0; 3]) });
    let mut lamps = Shapes::new("lamps", kinds + 1);
    let at = DVec3::new;
    lamps.quad([at(-6.5, 3.0, 4.5), at(-4.0, 3.0, 6.5), at(-2.2, 6.5, 4.2), at(-4.7, 6.5, 2.2)], DVec2::ONE);
    lamps.quad([at(3.0, 5.5, 1.0), at(5.5, 5.5, 1.0), at(5.5, 5.5, 5.0), at(3.0, 5.5, 5.0)], DVec2::ONE);
    for shapes in [mirror, lamps] {
        let mesh = shapes.finish();
        let name = mesh.name.clone();
        instances.push(Instance { name, mesh: meshes.len(), world_from_mesh: DAffine3::IDENTITY });
        meshes.push(mesh);
    }
    Scene {
        name: "teapots".to_owned(),
        instances,
        meshes,
        materials,
        environment: Environment::Constant([0.42, 0.47, 0.55]),
        cameras: vec![camera_looking_at("low", at(0.3, 1.3, 4.2), at(0.05, 0.02, 0.25), 0.58)],
        ..Scene::default()
    }
}
