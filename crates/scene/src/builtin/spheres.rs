//! Many small spheres in a large cube: triangles of one size, evenly spread.

use std::ops::RangeInclusive;

use glam::DVec3;

use super::cornell::{diffuse, place_each};
use super::shape::{Icosphere, Shapes};
use crate::default_view::camera_looking_at;
use crate::{Environment, Material, Scene};

/// Side of the cube that holds the spheres, metres.
const SIDE: f64 = 20.0;
/// Seed of the places and sizes.
const SEED: u64 = 0x5EED_0001;

/// Parameters of [`spheres`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Spheres {
    /// Number of triangles that is asked for, within [`Spheres::TRIANGLES`]; the scene has that many within
    /// 10.
    pub triangles: u64,
}

impl Spheres {
    /// Valid range of [`Spheres::triangles`].
    pub const TRIANGLES: RangeInclusive<u64> = 10_000..=10_000_000;
}

impl Default for Spheres {
    fn default() -> Self {
        Self { triangles: 300_000 }
    }
}

/// Makes icospheres in the cube [-10, 10]^3, none touching another, under a white sky of radiance 1. Most
/// have 1,280 triangles (320 below 100,000 in all); a few coarser ones fill up the count. The scene has one
/// mesh per material and four materials: two diffuse, one glossy, one metal. The camera stands outside and
/// sees the whole cube.
pub fn spheres(parameters: Spheres) -> Scene {
    let triangles = parameters.triangles.clamp(*Spheres::TRIANGLES.start(), *Spheres::TRIANGLES.end());
    let finest = if triangles < 100_000 { 2 } else { 3 };
    let units: Vec<Icosphere> = (0..=finest).map(Icosphere::new).collect();

    let mut levels = Vec::new();
    let mut left = triangles;
    for (level, unit) in units.iter().enumerate().rev() {
        let each = unit.triangles.len() as u64;
        levels.extend(std::iter::repeat_n(level, (left / each) as usize));
        left %= each;
    }
    // One more of the coarsest spheres, where the sum comes closer to the target with it.
    if left >= 10 {
        levels.push(0);
    }

    let materials = vec![
        diffuse("clay", [0.65, 0.35, 0.22]),
        diffuse("chalk", [0.75, 0.75, 0.72]),
        Material { roughness: 0.25, specular: 1.0, ..diffuse("glaze", [0.12, 0.28, 0.5]) },
        Material { metallic: 1.0, roughness: 0.35, ..diffuse("brass", [0.85, 0.68, 0.35]) },
    ];
    let mut shapes: Vec<Shapes> =
        materials.iter().enumerate().map(|(index, material)| Shapes::new(&material.name, index)).collect();

    // The smallest cube of cells with a cell for each sphere; the spheres take evenly spread cells.
    let across = (1_u64..).find(|across| across.pow(3) >= levels.len() as u64).unwrap_or(1);
    let cell = SIDE / across as f64;
    let mut random = Random::new(SEED);
    for (index, &level) in levels.iter().enumerate() {
        let place = (index as u128 * u128::from(across.pow(3)) / levels.len() as u128) as u64;
        let corner = DVec3::new(
            (place % across) as f64,
            (place / across % across) as f64,
            (place / (across * across)) as f64,
        );
        let radius = cell * (0.2 + 0.25 * random.unit());
        // Space to move within the cell; a hundredth of the cell is kept free on all sides.
        let slack = cell * 0.49 - radius;
        let jitter = DVec3::new(random.signed(), random.signed(), random.signed()) * slack;
        let centre = DVec3::splat(-SIDE / 2.0) + (corner + 0.5) * cell + jitter;
        let material = (random.next() % shapes.len() as u64) as usize;
        shapes[material].sphere(&units[level], centre, radius, false);
    }

    let meshes: Vec<_> = shapes.into_iter().map(Shapes::finish).collect();
    let camera = camera_looking_at("camera", DVec3::new(21.0, 12.0, 31.0), DVec3::ZERO, 0.8);
    Scene {
        name: "spheres".to_owned(),
        instances: place_each(&meshes),
        meshes,
        materials,
        environment: Environment::Constant([1.0; 3]),
        cameras: vec![camera],
        ..Scene::default()
    }
}

/// Random numbers: a counter through a 64-bit mixing function; the same numbers on every machine.
pub(super) struct Random {
    counter: u64,
}

impl Random {
    pub fn new(seed: u64) -> Self {
        Self { counter: seed }
    }

    pub fn next(&mut self) -> u64 {
        self.counter = self.counter.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut mixed = self.counter;
        mixed = (mixed ^ (mixed >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        mixed = (mixed ^ (mixed >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        mixed ^ (mixed >> 31)
    }

    /// Returns the next number in [0, 1).
    pub fn unit(&mut self) -> f64 {
        (self.next() >> 11) as f64 / (1_u64 << 53) as f64
    }

    /// Returns the next number in [-1, 1).
    pub fn signed(&mut self) -> f64 {
        2.0 * self.unit() - 1.0
    }
}
