//! A swimming pool: a closed volume of water with waves over tiles.

use std::sync::Arc;

use glam::{DAffine3, DVec2, DVec3};

use super::atrium::sky;
use super::cornell::{diffuse, place_each};
use super::forms::{along, arc, curve, standing, turn};
use super::shape::{Icosphere, Shapes};
use super::texture::{mosaic, repeating, textured, wood};
use crate::default_view::camera_looking_at;
use crate::deforming::{Deformation, Deformer, Shape, Topology};
use crate::{Animation, Light, Material, Mesh, Scene, SceneError};

/// Half extent of the basin, metres: x and z.
const BASIN: (f64, f64) = (5.0, 2.5);
/// Depth of the basin at its two ends, metres.
const DEPTH: (f64, f64) = (1.1, 2.0);
/// Height of the water at rest; the deck is at 0. Metres.
const LEVEL: f64 = -0.11;
/// Length by which the water reaches into the walls, so that there is no air between, and height of its
/// underside, below the floor. Metres.
const OVERLAP: f64 = 0.02;
const BELOW: f64 = -2.3;
/// Number of quads of the water's surface along x and z.
const WATER_GRID: (usize, usize) = (200, 100);
/// Duration for which the waves are described, seconds.
const DURATION: f64 = 20.0;
/// Waves: direction as a share of a turn from +x, length and amplitude in metres, phase as a share of a turn.
const WAVES: [(f64, f64, f64, f64); 9] = [
    (0.03, 2.6, 0.009, 0.1),
    (0.14, 1.7, 0.0065, 0.7),
    (0.91, 1.25, 0.005, 0.35),
    (0.22, 0.9, 0.0036, 0.55),
    (0.78, 0.7, 0.0027, 0.2),
    (0.45, 0.52, 0.0019, 0.9),
    (0.6, 0.41, 0.0014, 0.45),
    (0.34, 0.3, 0.0009, 0.65),
    (0.97, 0.24, 0.0006, 0.05),
];

const WATER: usize = 0;
const TILE: usize = 1;
const STONE: usize = 2;
const COPING: usize = 3;
const PLASTER: usize = 4;
const WOOD: usize = 5;
const CHROME: usize = 6;
const LINE: usize = 7;
const RED: usize = 8;
const CUSHION: usize = 9;
const LEAF: usize = 10;
const CLAY: usize = 11;

/// Makes a pool of 10 m by 5 m under the sun, with tiles, steps, a ladder and a board. Around it are a deck
/// of slabs, loungers and a pergola before a white wall. The water is a closed volume with an index of
/// refraction of 1.33 that reaches a little into the walls, so that water meets tiles without air between.
/// The waves move ([`Scene::at`]), each with the speed that a wave of its length has in deep water.
pub fn pool() -> Scene {
    let mut meshes = vec![water_at(0.0)];
    basin(&mut meshes);
    deck(&mut meshes);
    fittings(&mut meshes);
    around(&mut meshes);
    plants(&mut meshes);
    Scene {
        name: "pool".to_owned(),
        instances: place_each(&meshes),
        meshes,
        materials: materials(),
        textures: vec![repeating(0), repeating(1)],
        images: vec![mosaic(), wood()],
        lights: vec![Light::Directional {
            direction: DVec3::new(0.45, -0.75, -0.5).normalize(),
            irradiance: [3.0, 2.75, 2.35],
        }],
        environment: sky(0.5),
        cameras: vec![camera_looking_at(
            "deck",
            DVec3::new(-6.3, 1.75, 4.6),
            DVec3::new(0.7, -0.35, -0.7),
            0.85,
        )],
        animation: Animation {
            duration: DURATION as f32,
            deformer: Some(Arc::new(Waves)),
            ..Animation::default()
        },
        ..Scene::default()
    }
}

fn materials() -> Vec<Material> {
    vec![
        Material {
            transmission: 1.0,
            roughness: 0.0,
            specular: 1.0,
            ior: 1.33,
            thickness: 1.0,
            attenuation_color: [0.5, 0.84, 0.9],
            attenuation_distance: 4.0,
            ..diffuse("water", [1.0; 3])
        },
        textured(Material { specular: 1.0, roughness: 0.3, ..diffuse("tiles", [1.0; 3]) }, 0),
        Material { specular: 0.5, roughness: 0.6, ..diffuse("slabs", [0.4, 0.35, 0.29]) },
        Material { specular: 0.5, roughness: 0.5, ..diffuse("coping", [0.6, 0.57, 0.51]) },
        diffuse("plaster", [0.66, 0.62, 0.56]),
        textured(Material { specular: 0.5, roughness: 0.5, ..diffuse("wood", [1.0; 3]) }, 1),
        Material { metallic: 1.0, roughness: 0.1, ..diffuse("steel", [0.78, 0.79, 0.8]) },
        Material { specular: 1.0, roughness: 0.3, ..diffuse("dark tiles", [0.02, 0.06, 0.2]) },
        Material { specular: 1.0, roughness: 0.35, ..diffuse("red", [0.7, 0.07, 0.04]) },
        diffuse("cushion", [0.78, 0.74, 0.62]),
        Material { specular: 0.6, roughness: 0.45, ..diffuse("leaf", [0.12, 0.27, 0.08]) },
        diffuse("clay", [0.5, 0.22, 0.11]),
    ]
}

fn at(x: f64, y: f64, z: f64) -> DVec3 {
    DVec3::new(x, y, z)
}

/// Returns the height of the water over a point of the plan, metres.
fn height(x: f64, z: f64, seconds: f64) -> f64 {
    let wave = |&(direction, length, amplitude, phase): &(f64, f64, f64, f64)| {
        let (sin, cos) = turn(direction);
        // Turns per second: sqrt(g / (2 pi length)).
        let rate = (9.81 / (std::f64::consts::TAU * length)).sqrt();
        amplitude * turn((x * cos + z * sin) / length - rate * seconds + phase).0
    };
    LEVEL + WAVES.iter().map(wave).sum::<f64>()
}

fn water_at(seconds: f64) -> Mesh {
    let mut shapes = Shapes::new("water", WATER);
    let plan =
        |u: f64, v: f64| ((2.0 * u - 1.0) * (BASIN.0 + OVERLAP), (1.0 - 2.0 * v) * (BASIN.1 + OVERLAP));
    let top = |u: f64, v: f64| {
        let (x, z) = plan(u, v);
        at(x, height(x, z, seconds), z)
    };
    let bottom = |u: f64, v: f64| {
        let (x, z) = plan(u, v);
        at(x, BELOW, z)
    };
    shapes.between(WATER_GRID.0, WATER_GRID.1, DVec2::ONE, top, bottom);
    shapes.finish()
}

/// Deformer of the water's surface.
#[derive(Debug)]
struct Waves;

impl Deformer for Waves {
    fn topology(&self) -> Topology {
        Topology::Fixed
    }

    fn duration(&self) -> f64 {
        DURATION
    }

    fn meshes(&self) -> &[usize] {
        &[0]
    }

    fn at(&self, seconds: f64) -> Result<Deformation, SceneError> {
        let water = water_at(seconds.clamp(0.0, DURATION));
        let shape = Shape::Vertices { positions: water.positions, normals: water.normals };
        Ok(Deformation { shapes: vec![(0, shape)], warnings: Vec::new() })
    }
}

/// Returns the height of the floor of the basin.
fn floor(x: f64) -> f64 {
    let share = ((x + BASIN.0) / (2.0 * BASIN.0)).clamp(0.0, 1.0);
    -DEPTH.0 + (DEPTH.0 - DEPTH.1) * share
}

/// Adds the walls and the floor of tiles, dark lines, steps.
fn basin(meshes: &mut Vec<Mesh>) {
    let (x, z) = BASIN;
    let mut tiles = Shapes::new("basin", TILE);
    let low = -DEPTH.1 - 0.1;
    let mut wall = |from: DVec3, to: DVec3| {
        let repeat = DVec2::new(from.distance(to), -low);
        tiles.quad([from + DVec3::Y * low, to + DVec3::Y * low, to, from], repeat);
    };
    wall(at(-x, 0.0, -z), at(x, 0.0, -z));
    wall(at(x, 0.0, -z), at(x, 0.0, z));
    wall(at(x, 0.0, z), at(-x, 0.0, z));
    wall(at(-x, 0.0, z), at(-x, 0.0, -z));
    let ground = |x: f64, z: f64| at(x, floor(x), z);
    tiles.quad([ground(-x, z), ground(x, z), ground(x, -z), ground(-x, -z)], DVec2::new(2.0 * x, 2.0 * z));
    for step in 0..4 {
        let (top, reach) = (-0.28 - 0.22 * f64::from(step), 0.36 * f64::from(step + 1));
        let half = DVec3::new(0.5 * reach, 0.5 * (DEPTH.1 + top), 1.2);
        let middle = at(-x + 0.5 * reach, top - half.y, 0.0);
        tiles.block_with_bevel(standing(middle, 0.0), half, 0.015, 1.0);
    }
    meshes.push(tiles.finish());

    let mut lines = Shapes::new("lines", LINE);
    for lane in [-0.55, 1.25] {
        let line = |x: f64, z: f64| at(x, floor(x) + 0.004, z);
        let (from, to) = (-2.9, x - 0.9);
        lines.quad(
            [line(from, lane + 0.12), line(to, lane + 0.12), line(to, lane - 0.12), line(from, lane - 0.12)],
            DVec2::ONE,
        );
    }
    for side in [-1.0, 1.0] {
        let band = DVec3::new(x, 0.03, 0.004);
        lines.block_with_bevel(standing(at(0.0, -0.1, side * (z + 0.001)), 0.0), band, 0.001, 1.0);
        let band = DVec3::new(0.004, 0.03, z);
        lines.block_with_bevel(standing(at(side * (x + 0.001), -0.1, 0.0), 0.0), band, 0.001, 1.0);
    }
    meshes.push(lines.finish());
}

/// Adds slabs of half a metre, and a coping around the basin.
fn deck(meshes: &mut Vec<Mesh>) {
    let (x, z) = BASIN;
    let half = DVec3::new(0.246, 0.02, 0.246);
    let mut slabs = Shapes::new("slabs", STONE);
    let mut coping = Shapes::new("coping", COPING);
    for (column, row) in (0..25).flat_map(|row| (0..36).map(move |column| (column, row))) {
        let middle = at(0.5 * f64::from(column) - 8.75, -half.y, 0.5 * f64::from(row) - 5.25);
        let (outer, inner) =
            (middle.x.abs() < x + 0.5 && middle.z.abs() < z + 0.5, middle.x.abs() < x && middle.z.abs() < z);
        if !outer {
            slabs.block_with_bevel(standing(middle, 0.0), half, 0.006, 1.0);
        } else if !inner {
            coping.block_with_bevel(standing(middle, 0.0), DVec3::new(0.249, 0.03, 0.249), 0.012, 1.0);
        }
    }
    let mut ground = Shapes::new("ground", STONE);
    let sides = [(-9.2, -x, -5.7, 7.3), (x, 9.2, -5.7, 7.3), (-x, x, z, 7.3), (-x, x, -5.7, -z)];
    for (left, right, far, near) in sides {
        let corner = |x: f64, z: f64| at(x, -0.035, z);
        ground.quad(
            [corner(left, near), corner(right, near), corner(right, far), corner(left, far)],
            DVec2::ONE,
        );
    }
    meshes.extend([slabs.finish(), coping.finish(), ground.finish()]);
}

/// Adds the ladder, the board, a ball and a lifebelt.
fn fittings(meshes: &mut Vec<Mesh>) {
    let (x, z) = BASIN;
    let mut steel = Shapes::new("ladder", CHROME);
    for side in [-0.28, 0.28] {
        let rail = [
            (0.55, -0.02),
            (0.56, 0.4),
            (0.42, 0.78),
            (0.12, 0.8),
            (-0.08, 0.5),
            (-0.1, 0.0),
            (-0.1, -0.6),
            (-0.1, -1.25),
        ];
        let rail = rail.map(|(out, y)| at(1.2 + side, y, -z - out));
        steel.tube(&curve(&rail, 10), 20, |_| 0.021, DVec2::ONE);
    }
    for step in 0..4 {
        let middle = at(1.2, -0.3 - 0.28 * f64::from(step), -z + 0.1);
        steel.block_with_bevel(standing(middle, 0.0), DVec3::new(0.28, 0.012, 0.05), 0.006, 1.0);
    }
    for side in [-0.3, 0.3] {
        let rail = [
            (x + 1.6, 0.0),
            (x + 1.6, 0.7),
            (x + 1.45, 0.86),
            (x + 0.7, 0.86),
            (x + 0.55, 0.7),
            (x + 0.55, 0.0),
        ];
        let rail = rail.map(|(x, y)| at(x, y, side * 1.1));
        steel.tube(&curve(&rail, 8), 16, |_| 0.022, DVec2::ONE);
    }
    meshes.push(steel.finish());

    let mut board = Shapes::new("board", CUSHION);
    board.block_with_bevel(standing(at(x + 0.4, 0.42, 0.0), 0.0), DVec3::new(1.5, 0.025, 0.24), 0.012, 1.0);
    board.block_with_bevel(standing(at(x + 1.0, 0.2, 0.0), 0.0), DVec3::new(0.45, 0.2, 0.2), 0.03, 1.0);
    meshes.push(board.finish());

    let mut red = Shapes::new("ball and lifebelt", RED);
    red.sphere(&Icosphere::new(4), at(-0.9, LEVEL + 0.14, 0.9), 0.2, false);
    let mut ring: Vec<DVec2> = arc(DVec2::new(0.3, 0.0), 0.07, 0.0, 1.0, 20);
    ring[20] = ring[0];
    let tilted = DAffine3::from_mat3_translation(
        along(at(0.05, 0.25, 1.0), DVec3::ZERO).matrix3,
        at(-2.4, 1.25, -5.28),
    );
    red.revolve(tilted, 56, &ring, DVec2::ONE);
    meshes.push(red.finish());
}

/// Adds the wall with its pergola, and two loungers.
fn around(meshes: &mut Vec<Mesh>) {
    let mut wall = Shapes::new("wall", PLASTER);
    wall.block_with_bevel(standing(at(0.0, 1.2, -5.5), 0.0), DVec3::new(9.2, 1.25, 0.15), 0.03, 1.0);
    wall.block_with_bevel(standing(at(9.05, 1.2, 0.95), 0.0), DVec3::new(0.15, 1.25, 6.4), 0.03, 1.0);
    meshes.push(wall.finish());

    let mut timber = Shapes::new("pergola", WOOD);
    for post in 0..5 {
        let x = -4.2 + 2.6 * f64::from(post);
        timber.block_with_bevel(standing(at(x, 1.2, -3.9), 0.0), DVec3::new(0.06, 1.2, 0.06), 0.01, 0.7);
    }
    for (y, z) in [(2.46, -3.9), (2.46, -5.2)] {
        timber.block_with_bevel(standing(at(1.0, y, z), 0.0), DVec3::new(5.7, 0.07, 0.045), 0.008, 0.7);
    }
    for slat in 0..30 {
        let place = standing(at(-4.55 + 0.38 * f64::from(slat), 2.58, -4.5), 0.0);
        timber.block_with_bevel(place, DVec3::new(0.03, 0.05, 0.95), 0.006, 0.7);
    }
    let mut cushions = Shapes::new("cushions", CUSHION);
    for (x, share) in [(-0.6, 0.02), (1.2, -0.015)] {
        let stand = standing(at(x, 0.0, -4.05), share);
        let put = |shapes: &mut Shapes, middle: DVec3, half: DVec3, bevel: f64, lean: f64| {
            let (sin, cos) = turn(lean);
            let tilt = glam::DMat3::from_cols(DVec3::X, at(0.0, cos, sin), at(0.0, -sin, cos));
            let place = stand * DAffine3::from_mat3_translation(tilt, middle);
            shapes.block_with_bevel(place, half, bevel, 0.7);
        };
        for side in [-0.3, 0.3] {
            put(&mut timber, at(side, 0.27, 0.15), at(0.025, 0.035, 0.85), 0.008, 0.0);
            for end in [-0.55, 0.9] {
                put(&mut timber, at(side, 0.13, end), at(0.03, 0.13, 0.03), 0.006, 0.0);
            }
        }
        put(&mut cushions, at(0.0, 0.35, 0.32), at(0.31, 0.045, 0.68), 0.035, 0.0);
        put(&mut cushions, at(0.0, 0.57, -0.6), at(0.31, 0.045, 0.37), 0.035, 0.1);
    }
    meshes.extend([timber.finish(), cushions.finish()]);
}

/// Adds three agaves in pots.
fn plants(meshes: &mut Vec<Mesh>) {
    let mut pots = Shapes::new("pots", CLAY);
    let mut leaves = Shapes::new("leaves", LEAF);
    let profile = [
        (0.0, 0.0),
        (0.2, 0.0),
        (0.3, 0.42),
        (0.33, 0.43),
        (0.33, 0.5),
        (0.29, 0.5),
        (0.28, 0.44),
        (0.0, 0.44),
    ];
    let profile = profile.map(DVec2::from);
    for (plant, (x, z)) in [(-5.6, -3.7), (-6.9, -4.5), (6.6, -3.6)].into_iter().enumerate() {
        let foot = at(x, 0.001, z);
        pots.revolve(standing(foot, 0.0), 40, &profile, DVec2::ONE);
        for leaf in 0..46 {
            // Turns by the golden angle place each leaf where there is most room.
            let share = f64::from(leaf) * 0.381_966 + 0.21 * plant as f64;
            let (sin, cos) = turn(share);
            let (steep, long) = (0.15 + 0.75 * f64::from(leaf) / 46.0, 0.95 - 0.007 * f64::from(leaf));
            let blade: Vec<DVec3> = (0..=8)
                .map(|step| {
                    let s = f64::from(step) / 8.0;
                    let out = long * s * (1.0 - 0.55 * steep);
                    let rise = long * (steep * s - 0.25 * (1.0 - steep) * s * s);
                    foot + at(out * cos, 0.44 + rise, out * sin)
                })
                .collect();
            leaves.tube(&blade, 6, |s| 0.034 * (1.0 - s) * (0.6 + 2.0 * s), DVec2::ONE);
        }
    }
    meshes.extend([pots.finish(), leaves.finish()]);
}
