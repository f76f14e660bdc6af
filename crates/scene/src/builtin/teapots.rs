//! Teapots on a mirror, or beside a mirror.

use std::ops::RangeInclusive;

use glam::{DAffine3, DMat3, DVec2, DVec3};

use super::cornell::diffuse;
use super::forms::{about_y, turn};
use super::shape::{Icosphere, Shapes};
use super::spheres::Random;
use super::teapot::{BODY, teapot};
use crate::default_view::{camera_looking_at, default_light};
use crate::{Environment, Instance, Material, Scene};

/// Width of the mirror beyond the centre of the outermost pot, metres.
const MARGIN: f64 = 4.0;
/// Number of quads along a side of a patch.
const STEPS: usize = 10;
/// Width of a pot's body, metres. The length from handle to spout is 1.61 times as much.
const WIDTH: f64 = 0.4;
/// Distance between pots times 0.65, metres: no pot reaches another, however they are turned.
const SPACING: f64 = 0.46;
/// Seed of the pots' rotations.
const SEED: u64 = 0x5EED_0005;

/// Parameters of [`teapots`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Teapots {
    /// Number of pots, within [`Teapots::POTS`].
    pub pots: u64,
    /// Kind of ground under the pots.
    pub ground: Ground,
    /// Number of rectangular lamps above the pots, within [`Teapots::LAMPS`]. Without a lamp the environment
    /// is a map: [`default_light`].
    pub lamps: u64,
}

/// Ground under the pots of [`teapots`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Ground {
    /// A plane mirror.
    Mirror,
    /// A matt plane; the mirror is a ball in the place of one more pot.
    Matt,
}

impl Ground {
    /// Names of the values on the command line.
    pub const NAMES: [&'static str; 2] = ["mirror", "matt"];
}

impl Teapots {
    /// Valid range of [`Teapots::pots`].
    pub const POTS: RangeInclusive<u64> = 1..=2_000;
    /// Valid range of [`Teapots::lamps`].
    pub const LAMPS: RangeInclusive<u64> = 0..=2;
}

impl Default for Teapots {
    fn default() -> Self {
        Self { pots: 37, ground: Ground::Mirror, lamps: 2 }
    }
}

/// Returns the position of a pot: a spiral of golden angles gives each pot as much room.
fn place(index: u64) -> (f64, f64) {
    let (sin, cos) = turn(index as f64 * 0.381_966_011_250_105);
    let distance = SPACING * (index as f64 + 0.5).sqrt();
    (distance * cos, distance * sin)
}

/// Makes Utah teapots of seven glazes and metals in a spiral on a plane mirror or beside a mirroring ball,
/// under large lamps or a sky. All are instances of one shape, with a mesh for each material.
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
            let (x, z) = place(index);
            let turned = DMat3::from_diagonal(DVec3::splat(WIDTH)) * about_y(random.unit());
            // The pot hovers just above the mirror: its bottom would otherwise lie in the mirror's plane.
            let foot = DVec3::new(x, 0.0005, z);
            let kind = index as usize % kinds;
            Instance {
                name: format!("{} {index}", materials[kind].name),
                mesh: kind,
                world_from_mesh: DAffine3::from_mat3_translation(turned, foot),
            }
        })
        .collect();

    let at = DVec3::new;
    let mut stage = Vec::new();
    let half = SPACING * (pots as f64).sqrt() + MARGIN;
    let corner = |x: f64, z: f64| at(half * x, 0.0, half * z);
    let plane = [corner(-1.0, 1.0), corner(1.0, 1.0), corner(1.0, -1.0), corner(-1.0, -1.0)];
    let mut mirror = Shapes::new("mirror", materials.len());
    materials.push(Material { metallic: 1.0, roughness: 0.0, ..diffuse("mirror", [0.93, 0.93, 0.94]) });
    match parameters.ground {
        Ground::Mirror => mirror.quad(plane, DVec2::ONE),
        Ground::Matt => {
            let (x, z) = place(pots);
            mirror.sphere(&Icosphere::new(5), at(x, 0.5 * WIDTH + 0.0005, z), 0.5 * WIDTH, false);
            let mut ground = Shapes::new("ground", materials.len());
            materials.push(diffuse("ground", [0.6, 0.58, 0.54]));
            ground.quad(plane, DVec2::ONE);
            stage.push(ground);
        }
    }
    stage.push(mirror);
    let environment = if parameters.lamps == 0 {
        default_light()
    } else {
        let mut lamps = Shapes::new("lamps", materials.len());
        materials.push(Material { emission: [5.5, 5.2, 4.8], ..diffuse("lamp", [0.0; 3]) });
        let quads = [
            [at(-6.5, 3.0, 4.5), at(-4.0, 3.0, 6.5), at(-2.2, 6.5, 4.2), at(-4.7, 6.5, 2.2)],
            [at(3.0, 5.5, 1.0), at(5.5, 5.5, 1.0), at(5.5, 5.5, 5.0), at(3.0, 5.5, 5.0)],
        ];
        // The first lamp faces away from the pots.
        for quad in quads.into_iter().skip(usize::from(parameters.lamps == 1)) {
            lamps.quad(quad, DVec2::ONE);
        }
        stage.push(lamps);
        Environment::Constant([0.42, 0.47, 0.55])
    };
    for shapes in stage {
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
        environment,
        cameras: vec![camera_looking_at("low", at(0.3, 1.3, 4.2), at(0.05, 0.02, 0.25), 0.58)],
        ..Scene::default()
    }
}
