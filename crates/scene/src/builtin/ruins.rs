//! Heaps of rubble around broken columns: many stones deep in one another, from boulders down to crumbs.

use std::f64::consts::TAU;
use std::ops::RangeInclusive;

use glam::{DMat3, DQuat, DVec2, DVec3, EulerRot};

use super::atrium::sky;
use super::cornell::{diffuse, place_each};
use super::shape::{Icosphere, Shapes};
use super::spheres::Random;
use crate::default_view::camera_looking_at;
use crate::{Light, Material, Scene};

/// Half the side of the ground, metres.
const GROUND: f64 = 14.0;
/// Seed of the stones' places, sizes and shapes.
const SEED: u64 = 0x5EED_0003;
/// Centre on the ground, radius and height of each heap, metres.
const HEAPS: [(f64, f64, f64, f64); 5] = [
    (0.0, 0.0, 3.2, 2.4),
    (-5.2, 3.6, 2.2, 1.7),
    (4.8, 4.0, 2.4, 1.9),
    (-4.8, -5.0, 2.6, 1.8),
    (5.2, -4.8, 1.9, 1.4),
];
/// Foot on the ground and height of each column, metres.
const COLUMNS: [(f64, f64, f64); 7] = [
    (-4.5, -4.0, 5.2),
    (-1.5, -4.0, 2.1),
    (1.5, -4.0, 6.0),
    (4.5, -4.0, 3.4),
    (-4.5, 4.5, 1.2),
    (0.0, 4.5, 4.4),
    (4.5, 4.5, 6.0),
];
/// Radius of a column, metres.
const COLUMN: f64 = 0.4;
/// Radii of stones, metres; small ones are far more frequent.
const STONES: (f64, f64) = (0.1, 1.0);

/// Parameters of [`ruins`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Ruins {
    /// Number of triangles that is asked for, within [`Ruins::TRIANGLES`]; the scene has that many within 20.
    pub triangles: u64,
}

impl Ruins {
    /// Valid range of [`Ruins::triangles`].
    pub const TRIANGLES: RangeInclusive<u64> = 10_000..=10_000_000;
}

impl Default for Ruins {
    fn default() -> Self {
        Self { triangles: 200_000 }
    }
}

/// Makes five heaps of faceted stones on a square of ground, stones buried in stones, with stumps of columns
/// among them, under a low sun and a blue sky. Radii follow a power law, so that a ray hits many layers of
/// triangles of every size; large stones have 320 triangles, middle ones 80, crumbs 20. The camera stands at
/// the edge of the ground.
pub fn ruins(parameters: Ruins) -> Scene {
    let triangles = parameters.triangles.clamp(*Ruins::TRIANGLES.start(), *Ruins::TRIANGLES.end());
    let units: Vec<Icosphere> = (0..=2).map(Icosphere::new).collect();
    let materials = vec![
        diffuse("ground", [0.36, 0.31, 0.25]),
        Material { specular: 0.5, ..diffuse("sandstone", [0.62, 0.5, 0.36]) },
        Material { specular: 0.5, ..diffuse("limestone", [0.68, 0.66, 0.6]) },
        Material { specular: 1.0, roughness: 0.35, ..diffuse("marble", [0.74, 0.72, 0.7]) },
    ];
    let mut ground = Shapes::new("ground", 0);
    let corner = |x: f64, z: f64| DVec3::new(GROUND * x, 0.0, GROUND * z);
    ground.quad(
        [corner(-1.0, 1.0), corner(1.0, 1.0), corner(1.0, -1.0), corner(-1.0, -1.0)],
        DVec2::splat(14.0),
    );
    let mut columns = Shapes::new("columns", 3);
    for (x, z, height) in COLUMNS {
        column(&mut columns, DVec3::new(x, 0.0, z), height);
    }
    let mut meshes = vec![ground.finish(), columns.finish()];
    let standing: u64 = meshes.iter().map(|mesh| mesh.triangle_count() as u64).sum();

    let mut left = triangles.saturating_sub(standing);
    let mut stones = [Shapes::new("sandstone", 1), Shapes::new("limestone", 2)];
    let mut random = Random::new(SEED);
    // Scenes of few stones have larger ones, so that heaps are solid at every count.
    let crowd = (200_000.0 / triangles as f64).cbrt().clamp(0.3, 2.5);
    while left >= 20 {
        let radius = crowd * STONES.0 * (STONES.1 / STONES.0).powf(random.unit().powi(2));
        let wanted = if radius > 0.6 * crowd { 2 } else { usize::from(radius > 0.25 * crowd) };
        let level =
            (0..=wanted).rev().find(|&level| units[level].triangles.len() as u64 <= left).unwrap_or(0);
        let unit = &units[level];
        left -= unit.triangles.len() as u64;
        let kind = (random.next() % 2) as usize;
        let centre = place(&mut random);
        stone(&mut stones[kind], unit, centre, radius, &mut random);
    }
    meshes.extend(stones.into_iter().map(Shapes::finish));
    meshes.retain(|mesh| mesh.triangle_count() > 0);

    let eye = DVec3::new(8.6, 2.9, 11.6);
    Scene {
        name: "ruins".to_owned(),
        instances: place_each(&meshes),
        meshes,
        materials,
        lights: vec![Light::Directional {
            direction: DVec3::new(-0.7, -0.55, -0.3).normalize(),
            irradiance: [3.4, 2.9, 2.2],
        }],
        environment: sky(0.35),
        cameras: vec![camera_looking_at("edge", eye, DVec3::new(-0.6, 0.9, -0.6), 0.85)],
        ..Scene::default()
    }
}

/// Picks a point in a heap: evenly over its foot, and evenly below its surface, which falls off towards the
/// rim.
fn place(random: &mut Random) -> DVec3 {
    let (x, z, radius, height) = HEAPS[(random.next() % HEAPS.len() as u64) as usize];
    let share = random.unit().sqrt();
    let angle = TAU * random.unit();
    let surface = height * (1.0 - share * share);
    DVec3::new(x + share * radius * angle.cos(), surface * random.unit(), z + share * radius * angle.sin())
}

/// Adds a faceted stone: a sphere cut down by a few planes, scaled and rotated.
fn stone(shapes: &mut Shapes, unit: &Icosphere, centre: DVec3, radius: f64, random: &mut Random) {
    let angles: [f64; 3] = std::array::from_fn(|_| TAU * random.unit());
    let turn = DMat3::from_quat(DQuat::from_euler(EulerRot::XYZ, angles[0], angles[1], angles[2]));
    let stretch = DVec3::new(1.0, 0.6 + 0.4 * random.unit(), 0.5 + 0.5 * random.unit());
    let cuts: [(DVec3, f64); 5] = std::array::from_fn(|_| {
        let normal = DVec3::new(random.signed(), random.signed(), random.signed());
        (normal.normalize_or(DVec3::Y), 0.55 + 0.35 * random.unit())
    });
    let corners: Vec<DVec3> = unit
        .directions
        .iter()
        .map(|&direction| {
            // Each vertex reaches as far as the nearest cut lets it, so that the stone stays star-shaped with
            // its front outside.
            let reach = cuts.iter().fold(1.0_f64, |reach, &(normal, distance)| {
                let along = direction.dot(normal);
                if along > 0.0 { reach.min(distance / along) } else { reach }
            });
            centre + turn * (direction * reach * stretch) * radius
        })
        .collect();
    for triangle in &unit.triangles {
        let [a, b, c] = triangle.map(|corner| corners[corner as usize]);
        let normal = (b - a).cross(c - a).normalize_or(DVec3::Y);
        let first = [a, b, c].map(|point| shapes.vertex(point, normal, DVec2::new(point.x, point.z)));
        shapes.triangle(first);
    }
}

/// Adds a stump of a column with a base, broken off level.
fn column(shapes: &mut Shapes, foot: DVec3, height: f64) {
    let profile =
        [(COLUMN * 1.5, 0.0), (COLUMN * 1.5, 0.3), (COLUMN, 0.45), (COLUMN * 0.92, height), (0.0, height)];
    shapes.lathe(foot, 32, &profile, DVec2::new(4.0, height));
}
