//! Trees and grass whose leaves are slivers smaller than a pixel.

use std::ops::RangeInclusive;
use std::sync::Arc;

use glam::{DVec2, DVec3};

use super::atrium::sky;
use super::cornell::{diffuse, place_each};
use super::forms::turn;
use super::shape::Shapes;
use super::spheres::Random;
use super::texture::{leaf, pierced, repeating, textured};
use crate::default_view::camera_looking_at;
use crate::deforming::{Deformation, Deformer, Shape, Topology};
use crate::{Animation, Light, Material, Mesh, Scene, SceneError};

/// Parameters of [`foliage`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Foliage {
    /// Number of leaves of the trees and blades of grass, within [`Foliage::LEAVES`].
    pub leaves: u64,
    /// True if each leaf of a tree is a square card with an alpha mask; false if it is an outline of
    /// triangles.
    pub cards: bool,
}

impl Foliage {
    /// Valid range of [`Foliage::leaves`].
    pub const LEAVES: RangeInclusive<u64> = 1_000..=1_000_000;
}

impl Default for Foliage {
    fn default() -> Self {
        Self { leaves: 40_000, cards: false }
    }
}

/// Half the side of the ground, metres. Near its border the ground rises over the horizon of the camera.
const GROUND: f64 = 20.0;
/// Distance from the middle at which the ground begins to rise, and height of its border, metres.
const RISE: (f64, f64) = (12.5, 2.4);
/// Seed of all plants.
const SEED: u64 = 0x5EED_0008;
/// Duration of the wind, seconds.
const DURATION: f64 = 8.0;
/// Foot and height of each tree, metres.
const TREES: [(f64, f64, f64); 5] =
    [(0.3, 0.0, 6.2), (-3.9, -2.6, 5.0), (4.2, -3.4, 5.6), (-7.6, -7.5, 6.8), (9.0, -9.0, 6.4)];
/// Area of the grass: middle and half the extent, metres.
const MEADOW: (f64, f64, f64, f64) = (0.0, 1.2, 7.0, 5.2);
/// Period of blades of grass: one of so many leaves is a blade of grass.
const GRASS_SHARE: u64 = 3;

const EARTH: usize = 0;
const BARK: usize = 1;
const LEAF: usize = 2;
const GRASS: usize = 3;

/// Indices of the meshes that the wind moves: leaves and grass.
const MOVING: [usize; 2] = [2, 3];

/// Makes five trees and a meadow in a hollow, in a wind ([`Scene::at`]). Two thirds of the leaves asked for
/// are on the trees, each a folded outline of six triangles, or a card of two with an alpha mask; the others
/// are blades of grass of five triangles. More than half of these triangles are narrower than a pixel of a
/// picture of 640 by 360.
pub fn foliage(parameters: Foliage) -> Scene {
    let leaves = parameters.leaves.clamp(*Foliage::LEAVES.start(), *Foliage::LEAVES.end());
    let plants = Plants::grow(leaves, parameters.cards);
    let mut ground = Shapes::new("ground", EARTH);
    ground.patch(GROUND_GRID, GROUND_GRID, DVec2::ONE, |u, v| {
        let step = 1.0 / 1024.0;
        let along = hollow(u + step, v) - hollow(u - step, v);
        let back = hollow(u, v + step) - hollow(u, v - step);
        (hollow(u, v), along.cross(back).normalize())
    });
    let mut wood = Shapes::new("wood", BARK);
    for limb in &plants.limbs {
        let segments = if limb.radius > 0.03 {
            14
        } else if limb.radius > 0.006 {
            5
        } else {
            3
        };
        wood.tube(&limb.path, segments, |share| limb.radius * (1.0 - 0.75 * share), DVec2::new(1.0, 3.0));
    }
    let [leaves, grass] = plants.meshes_at(0.0);
    let meshes = vec![ground.finish(), wood.finish(), leaves, grass];
    let green = |name: &str, color: [f32; 3]| Material {
        specular: 0.5,
        roughness: 0.5,
        double_sided: true,
        ..diffuse(name, color)
    };
    let leaf_material = green("leaf", [0.19, 0.33, 0.06]);
    let cards = plants.cards;
    Scene {
        name: "foliage".to_owned(),
        instances: place_each(&meshes),
        meshes,
        materials: vec![
            diffuse("earth", [0.16, 0.17, 0.07]),
            diffuse("bark", [0.2, 0.15, 0.1]),
            if cards { pierced(textured(leaf_material, 0)) } else { leaf_material },
            green("grass", [0.22, 0.34, 0.07]),
        ],
        textures: if cards { vec![repeating(0)] } else { Vec::new() },
        images: if cards { vec![leaf()] } else { Vec::new() },
        lights: vec![Light::Directional {
            direction: DVec3::new(0.62, -0.62, -0.35).normalize(),
            irradiance: [4.6, 4.1, 3.3],
        }],
        environment: sky(0.55),
        cameras: vec![camera_looking_at(
            "meadow",
            DVec3::new(-1.6, 1.5, 9.6),
            DVec3::new(0.1, 2.35, -0.5),
            0.8,
        )],
        animation: Animation {
            duration: DURATION as f32,
            deformer: Some(Arc::new(plants)),
            ..Animation::default()
        },
        ..Scene::default()
    }
}

/// Number of quads along a side of the ground.
const GROUND_GRID: usize = 64;

/// Returns a point of the ground over (u, v) in [0, 1]^2; the ground is level in the middle.
fn hollow(u: f64, v: f64) -> DVec3 {
    let (x, z) = (GROUND * (2.0 * u - 1.0), GROUND * (1.0 - 2.0 * v));
    let out = (((x * x + z * z).sqrt() - RISE.0) / (GROUND - RISE.0)).clamp(0.0, 1.0);
    DVec3::new(x, RISE.1 * out * out * (3.0 - 2.0 * out), z)
}

/// Branch of a tree: its course, and its radius at its foot, metres.
#[derive(Debug)]
struct Limb {
    path: Vec<DVec3>,
    radius: f64,
}

/// Leaf or blade of grass at rest.
#[derive(Clone, Copy, Debug)]
struct Blade {
    foot: DVec3,
    /// Vector from foot to tip, metres.
    long: DVec3,
    /// Half the width as a vector across `long`, metres.
    wide: DVec3,
    /// Distances by which the wind moves the foot and the tip, metres.
    give: [f64; 2],
    /// Phase of the flutter, as a share of a turn.
    phase: f64,
}

/// Limbs, leaves and grass of the scene.
#[derive(Debug)]
struct Plants {
    limbs: Vec<Limb>,
    leaves: Vec<Blade>,
    grass: Vec<Blade>,
    cards: bool,
}

impl Plants {
    fn grow(leaves: u64, cards: bool) -> Self {
        let mut random = Random::new(SEED);
        let mut plants = Self { limbs: Vec::new(), leaves: Vec::new(), grass: Vec::new(), cards };
        let mut twigs = Vec::new();
        for (x, z, height) in TREES {
            let foot = DVec3::new(x, 0.0, z);
            plants.branch(&mut random, &mut twigs, (foot, DVec3::Y), height * 0.45, 0.034 * height, 0);
        }
        let grass = leaves / GRASS_SHARE;
        // Few leaves are larger ones, so that trees look as dense.
        let size = (40_000.0 / leaves as f64).sqrt().clamp(0.35, 3.0);
        for index in 0..leaves - grass {
            let (from, to) = twigs[index as usize % twigs.len()];
            plants.leaves.push(leaf_at(&mut random, from, to, size));
        }
        for _ in 0..grass {
            plants.grass.push(blade_at(&mut random, size));
        }
        plants
    }

    /// Grows a limb and its children; the last ones are twigs.
    fn branch(
        &mut self,
        random: &mut Random,
        twigs: &mut Vec<(DVec3, DVec3)>,
        (foot, direction): (DVec3, DVec3),
        length: f64,
        radius: f64,
        depth: u32,
    ) {
        let mut path = vec![foot];
        let mut heading = direction;
        for _ in 0..5 {
            let bend = DVec3::new(random.signed(), random.signed() + 0.25, random.signed());
            heading = (heading + bend * (0.1 + 0.06 * f64::from(depth))).normalize();
            path.push(path[path.len() - 1] + heading * (length / 5.0));
        }
        if depth >= 3 {
            for pair in path.windows(2) {
                twigs.push((pair[0], pair[1]));
            }
        }
        if depth < 4 {
            let count = [7, 4, 4, 3][depth as usize];
            let spin = random.unit();
            for child in 0..count {
                // Children sit along the outer part of the limb, around it by golden angles.
                let share = 0.45 + 0.55 * f64::from(child) / f64::from(count - 1);
                let place = share * 5.0;
                let low = (place as usize).min(4);
                let start = path[low].lerp(path[low + 1], place - low as f64);
                let (sin, cos) = turn(spin + 0.381_966 * f64::from(child));
                let side = heading.any_orthonormal_vector();
                let out = side * cos + heading.cross(side) * sin;
                let spread = if child + 1 == count { 0.25 } else { 0.95 };
                let toward = (heading + out * spread + DVec3::Y * 0.12).normalize();
                let shorter = length * (0.62 + 0.16 * random.unit());
                let thinner = radius * (1.0 - 0.75 * share) * 0.8;
                self.branch(random, twigs, (start, toward), shorter, thinner.max(0.004), depth + 1);
            }
        }
        self.limbs.push(Limb { path, radius });
    }

    /// Makes leaves and grass after the given seconds of wind.
    fn meshes_at(&self, seconds: f64) -> [Mesh; 2] {
        let mut leaves = Shapes::new("leaves", LEAF);
        for blade in &self.leaves {
            let blade = blade.in_wind(seconds);
            if self.cards { card(&mut leaves, blade) } else { outline(&mut leaves, blade) }
        }
        let mut grass = Shapes::new("grass", GRASS);
        for blade in &self.grass {
            bent(&mut grass, blade.in_wind(seconds));
        }
        [leaves.finish(), grass.finish()]
    }
}

impl Deformer for Plants {
    fn topology(&self) -> Topology {
        Topology::Fixed
    }

    fn duration(&self) -> f64 {
        DURATION
    }

    fn meshes(&self) -> &[usize] {
        &MOVING
    }

    fn at(&self, seconds: f64) -> Result<Deformation, SceneError> {
        let meshes = self.meshes_at(seconds.clamp(0.0, DURATION));
        let shape = |mesh: Mesh| Shape::Vertices { positions: mesh.positions, normals: mesh.normals };
        let shapes = MOVING.into_iter().zip(meshes).map(|(index, mesh)| (index, shape(mesh))).collect();
        Ok(Deformation { shapes, warnings: Vec::new() })
    }
}

impl Blade {
    /// Moves the blade by gusts that cross the meadow and by a flutter of its own. The wind begins at 0 s and
    /// ends where it began.
    fn in_wind(self, seconds: f64) -> Self {
        let gust = |rate: f64, reach: f64| {
            let place = (self.foot.x + 0.4 * self.foot.z) / reach;
            turn(rate * seconds / DURATION - place).0 - turn(-place).0
        };
        let sway = 0.6 * gust(2.0, 9.0) + 0.4 * gust(5.0, 4.0);
        let flutter = turn(11.0 * seconds / DURATION + self.phase).0 - turn(self.phase).0;
        let toward = DVec3::new(1.0, 0.0, 0.25);
        let foot = self.foot + toward * (self.give[0] * sway);
        let shift = toward * ((self.give[1] - self.give[0]) * sway)
            + self.wide.normalize().cross(self.long).normalize() * (0.25 * self.give[1] * flutter);
        // The length stays.
        let long = (self.long + shift).normalize() * self.long.length();
        Self { foot, long, ..self }
    }
}

/// Makes a leaf of 12 to 19 cm beside a twig; it hangs a little.
fn leaf_at(random: &mut Random, from: DVec3, to: DVec3, size: f64) -> Blade {
    let foot = from.lerp(to, random.unit());
    let side = DVec3::new(random.signed(), random.signed(), random.signed()).normalize_or(DVec3::X);
    let toward = ((to - from).normalize() * 0.4 + side + DVec3::Y * -0.25).normalize_or(DVec3::NEG_Y);
    let long = toward * (size * (0.12 + 0.07 * random.unit()));
    let across = toward.cross(DVec3::new(random.signed(), 2.0, random.signed())).normalize_or(DVec3::X);
    let high = (foot.y / 5.0).clamp(0.0, 1.3);
    Blade {
        foot,
        long,
        wide: across * (0.27 * long.length()),
        give: [0.05 * high * high, 0.05 * high * high + 0.012],
        phase: random.unit(),
    }
}

/// Makes a blade of grass of 10 to 45 cm.
fn blade_at(random: &mut Random, size: f64) -> Blade {
    let (x, z, half_x, half_z) = MEADOW;
    let foot = DVec3::new(x + half_x * random.signed(), 0.0, z + half_z * random.signed());
    let length = 0.1 + 0.35 * random.unit() * random.unit();
    let (sin, cos) = turn(random.unit());
    let lean = 0.1 + 0.5 * random.unit();
    let long = DVec3::new(lean * cos, 1.0, lean * sin).normalize() * length;
    let wide = DVec3::new(-sin, 0.0, cos) * (size * (0.0035 + 0.0025 * random.unit()));
    Blade { foot, long, wide, give: [0.0, 0.25 * length], phase: random.unit() }
}

/// Adds a leaf of two halves folded along the middle rib, three triangles each.
fn outline(shapes: &mut Shapes, blade: Blade) {
    let Blade { foot, long, wide, .. } = blade;
    let up = wide.cross(long).normalize() * (0.35 * wide.length());
    let at = |along: f64, out: f64| foot + long * along + wide * out + up * (out.abs() - along * along);
    let rib = [0.0, 0.45, 1.0].map(|along| at(along, 0.0));
    for side in [-1.0, 1.0] {
        let edge = [at(0.22, 0.75 * side), at(0.58, 0.9 * side)];
        for corners in [[rib[0], edge[0], rib[1]], [edge[0], edge[1], rib[1]], [edge[1], rib[2], rib[1]]] {
            flat(shapes, corners, side > 0.0);
        }
    }
}

/// Adds a square with the picture of a leaf.
fn card(shapes: &mut Shapes, blade: Blade) {
    let Blade { foot, long, wide, .. } = blade;
    let normal = wide.cross(long).normalize();
    let corners = [(-1.0, 0.0), (1.0, 0.0), (1.0, 1.0), (-1.0, 1.0)].map(|(out, along): (f64, f64)| {
        let uv = DVec2::new(0.5 + 0.5 * out, 1.0 - along);
        shapes.vertex(foot + wide * out + long * along, normal, uv)
    });
    shapes.triangle([corners[0], corners[1], corners[2]]);
    shapes.triangle([corners[0], corners[2], corners[3]]);
}

/// Adds a blade that bends over: two quads and a tip.
fn bent(shapes: &mut Shapes, blade: Blade) {
    let Blade { foot, long, wide, .. } = blade;
    let sag = DVec3::new(long.x, -0.35 * long.length(), long.z);
    let at = |along: f64, out: f64| {
        foot + long * along + sag * (0.55 * along * along) + wide * (out * (1.0 - 0.5 * along))
    };
    let [low, middle] = [0.0, 0.4].map(|along| [at(along, -1.0), at(along, 1.0)]);
    let high = [at(0.75, -0.8), at(0.75, 0.8)];
    for [a, b] in [[low, middle], [middle, high]] {
        flat(shapes, [a[0], a[1], b[1]], true);
        flat(shapes, [a[0], b[1], b[0]], true);
    }
    flat(shapes, [high[0], high[1], at(1.0, 0.0)], true);
}

/// Adds a triangle with its own normal, in the order of the corners or the opposite one.
fn flat(shapes: &mut Shapes, corners: [DVec3; 3], in_order: bool) {
    let [a, b, c] = if in_order { corners } else { [corners[0], corners[2], corners[1]] };
    let normal = (b - a).cross(c - a).normalize_or(DVec3::Y);
    let corners = [a, b, c].map(|corner| shapes.vertex(corner, normal, DVec2::ZERO));
    shapes.triangle(corners);
}
