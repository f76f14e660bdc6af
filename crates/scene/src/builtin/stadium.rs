//! A teapot in a stadium: details of a millimetre in a space of 200 m.

use std::ops::RangeInclusive;

use glam::{DAffine3, DMat3, DVec2, DVec3};

use super::atrium::sky;
use super::cornell::{diffuse, place_each};
use super::forms::{about_y, standing, turn};
use super::shape::{Icosphere, Shapes};
use super::teapot::{BODY, teapot};
use crate::default_view::camera_looking_at;
use crate::{Instance, Light, Material, Mesh, Scene};

/// Parameters of [`stadium`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Stadium {
    /// Number of seats that is asked for, within [`Stadium::SEATS`]; the scene has that many within 10.
    pub seats: u64,
}

impl Stadium {
    /// Valid range of [`Stadium::seats`].
    pub const SEATS: RangeInclusive<u64> = 100..=15_000;
}

impl Default for Stadium {
    fn default() -> Self {
        Self { seats: 12_000 }
    }
}

/// Half axis of the first row along x, metres, and the ratio of the half axis along z to it.
const FIRST_ROW: f64 = 60.0;
const FLAT: f64 = 0.75;
/// Number of rows, and depth and height of a step, metres.
const ROWS: usize = 24;
const STEP: (f64, f64) = (0.95, 0.55);
/// Height of the first step above the pitch, metres.
const FOOT: f64 = 1.6;
/// Number of seats side by side in a bench, and the width of one, metres.
const BENCH: usize = 10;
const SEAT: f64 = 0.52;
/// Height of the top of the pedestal, metres.
const PEDESTAL: f64 = 1.05;
/// Radius of the pot's body and of a bead, metres.
const POT: f64 = 0.085;
const BEAD: f64 = 0.0012;

const PITCH: usize = 0;
const MOWN: usize = 1;
const LINE: usize = 2;
const CONCRETE: usize = 3;
const STEEL: usize = 4;
const POT_SILVER: usize = 5;
const MARBLE: usize = 6;
const GOLD: usize = 7;
const SEATS: usize = 8;

/// Makes a bowl of benches in three colours around a pitch, under a ring of roof. On a pedestal in the middle
/// stands a silver teapot of 24 cm with a string of golden beads whose triangles measure less than a
/// millimetre. The camera stands half a metre from the pot. Benches of ten seats are instances of three
/// meshes.
pub fn stadium(parameters: Stadium) -> Scene {
    let seats = parameters.seats.clamp(*Stadium::SEATS.start(), *Stadium::SEATS.end());
    let paint =
        |name: &str, color: [f32; 3]| Material { specular: 0.8, roughness: 0.4, ..diffuse(name, color) };
    let metal = |name: &str, color: [f32; 3], roughness: f32| Material {
        metallic: 1.0,
        roughness,
        ..diffuse(name, color)
    };
    let materials = vec![
        diffuse("pitch", [0.1, 0.2, 0.05]),
        diffuse("mown", [0.14, 0.27, 0.07]),
        diffuse("lines", [0.75, 0.76, 0.74]),
        diffuse("concrete", [0.42, 0.41, 0.39]),
        paint("steel", [0.62, 0.64, 0.67]),
        metal("silver", [0.95, 0.93, 0.89], 0.06),
        Material { specular: 1.0, roughness: 0.25, ..diffuse("marble", [0.66, 0.63, 0.58]) },
        metal("gold", [0.95, 0.72, 0.3], 0.2),
        paint("red seats", [0.6, 0.05, 0.04]),
        paint("white seats", [0.72, 0.72, 0.7]),
        paint("blue seats", [0.04, 0.12, 0.42]),
    ];
    let mut meshes = vec![stands(), roof()];
    pitch(&mut meshes);
    centre(&mut meshes);
    let mut instances = place_each(&meshes);
    let first_bench = meshes.len();
    meshes.extend((SEATS..materials.len()).map(|material| bench(&materials[material].name, material)));
    benches(&mut instances, &meshes, first_bench, (seats as usize).div_ceil(BENCH));
    Scene {
        name: "stadium".to_owned(),
        instances,
        meshes,
        materials,
        lights: vec![Light::Directional {
            direction: DVec3::new(-0.5, -0.62, -0.45).normalize(),
            irradiance: [3.3, 3.0, 2.5],
        }],
        environment: sky(0.55),
        cameras: vec![camera_looking_at(
            "pedestal",
            DVec3::new(-0.22, PEDESTAL + 0.17, 0.52),
            DVec3::new(0.02, PEDESTAL + 0.095, 0.0),
            0.75,
        )],
        ..Scene::default()
    }
}

fn at(x: f64, y: f64, z: f64) -> DVec3 {
    DVec3::new(x, y, z)
}

/// Returns the map from circles to the ellipses of the bowl.
fn bowl() -> DAffine3 {
    DAffine3::from_scale(at(1.0, 1.0, FLAT))
}

/// Makes steps of concrete, closed by a slope behind.
fn stands() -> Mesh {
    let mut shapes = Shapes::new("stands", CONCRETE);
    let back = FIRST_ROW + STEP.0 * ROWS as f64 + 1.5;
    let top = FOOT + STEP.1 * ROWS as f64;
    let mut profile = vec![(back, -0.1), (back, top + 1.1), (back - 0.3, top + 1.1)];
    for row in (0..ROWS).rev() {
        let (inner, height) = (FIRST_ROW + STEP.0 * row as f64, FOOT + STEP.1 * row as f64);
        let outer = if row + 1 == ROWS { back - 0.3 } else { inner + STEP.0 };
        profile.extend([(outer, height), (inner, height)]);
    }
    profile.extend([(FIRST_ROW, -0.1), (back, -0.1)]);
    shapes.revolve(bowl(), 160, &profile.into_iter().map(DVec2::from).collect::<Vec<_>>(), DVec2::ONE);
    shapes.finish()
}

/// Makes a ring of roof over the upper rows, carried by trusses.
fn roof() -> Mesh {
    let mut shapes = Shapes::new("roof", STEEL);
    let back = FIRST_ROW + STEP.0 * ROWS as f64 + 4.0;
    let profile = [(back, 24.0), (back, 24.5), (back - 20.0, 28.2), (back - 20.5, 27.7), (back, 24.0)];
    shapes.revolve(bowl(), 160, &profile.map(DVec2::from), DVec2::ONE);
    for truss in 0..64 {
        let (sin, cos) = turn(f64::from(truss) / 64.0);
        let point = |out: f64, height: f64| at(out * cos, height, out * sin * FLAT);
        let mut rod = |from: DVec3, to: DVec3, radius: f64| {
            shapes.tube(&[from, to], 8, |_| radius, DVec2::ONE);
        };
        let corners = [(back, 0.0), (back, 24.2), (back - 19.8, 27.9), (back - 1.5, 30.5)]
            .map(|(out, y)| point(out, y));
        rod(corners[0], corners[1], 0.35);
        rod(corners[1], corners[3], 0.18);
        rod(corners[3], corners[2], 0.12);
        let below = |share: f64| corners[1].lerp(corners[2], share);
        for share in [0.25, 0.5, 0.75] {
            rod(corners[3].lerp(corners[2], share), below(share - 0.12), 0.07);
        }
        // Lamps under the edge of the roof.
        let lamp = standing(below(0.97) - DVec3::Y * 0.5, f64::from(truss) / 64.0);
        shapes.block_with_bevel(lamp, at(0.5, 0.25, 0.5), 0.06, 1.0);
    }
    shapes.finish()
}

/// Adds stripes of grass, lines, and two goals.
fn pitch(meshes: &mut Vec<Mesh>) {
    let (half_x, half_z) = (48.0, 31.0);
    let mut kinds = [Shapes::new("pitch", PITCH), Shapes::new("mown pitch", MOWN)];
    for stripe in 0..16 {
        let (from, to) = (f64::from(stripe) * 6.0 - half_x, f64::from(stripe + 1) * 6.0 - half_x);
        let corners =
            [at(from, 0.0, half_z), at(to, 0.0, half_z), at(to, 0.0, -half_z), at(from, 0.0, -half_z)];
        kinds[stripe as usize % 2].quad(corners, DVec2::ONE);
    }
    let ground = [(0.0, -0.02), (FIRST_ROW + 1.0, -0.02)];
    let mut track = Shapes::new("track", CONCRETE);
    track.revolve(bowl(), 96, &[ground[1], ground[0]].map(DVec2::from), DVec2::ONE);

    let mut lines = Shapes::new("lines", LINE);
    let mut line = |middle: DVec3, half_x: f64, half_z: f64| {
        lines.block_with_bevel(standing(middle, 0.0), at(half_x, 0.004, half_z), 0.002, 1.0);
    };
    for side in [-1.0, 1.0] {
        line(at(0.0, 0.002, side * 28.0), 44.0, 0.06);
        line(at(side * 44.0, 0.002, 0.0), 0.06, 28.0);
        line(at(side * 30.0, 0.002, 0.0), 0.06, 16.0);
        line(at(side * 37.0, 0.002, 16.0), 7.0, 0.06);
        line(at(side * 37.0, 0.002, -16.0), 7.0, 0.06);
    }
    line(at(0.0, 0.002, 0.0), 0.06, 28.0);
    let circle = [(9.21, 0.006), (9.09, 0.006)];
    lines.revolve(DAffine3::IDENTITY, 96, &circle.map(DVec2::from), DVec2::ONE);

    let mut goals = Shapes::new("goals", LINE);
    for side in [-1.0, 1.0] {
        let corner = |y: f64, z: f64| at(side * 44.0, y, z);
        for path in [
            [corner(0.0, -3.66), corner(2.44, -3.66)],
            [corner(0.0, 3.66), corner(2.44, 3.66)],
            [corner(2.44, -3.72), corner(2.44, 3.72)],
        ] {
            goals.tube(&path, 16, |_| 0.06, DVec2::ONE);
        }
    }
    let [plain, mown] = kinds;
    meshes.extend([plain, mown, track, lines, goals].map(Shapes::finish));
}

/// Adds the pedestal, the pot and its beads.
fn centre(meshes: &mut Vec<Mesh>) {
    let mut marble = Shapes::new("pedestal", MARBLE);
    for (y, half, height) in [(0.06, 0.3, 0.06), (0.55, 0.2, 0.43), (PEDESTAL - 0.035, 0.26, 0.035)] {
        marble.block_with_bevel(standing(at(0.0, y, 0.0), 0.0), at(half, height, half), 0.012, 1.0);
    }
    meshes.push(marble.finish());
    let mut pot = Shapes::new("teapot", POT_SILVER);
    // The pot hovers just above the marble: its bottom would otherwise lie in the marble's plane.
    let foot = at(0.0, PEDESTAL + 0.000_05, 0.0);
    let scale = DMat3::from_diagonal(DVec3::splat(POT * 2.0 / BODY));
    let place = DAffine3::from_mat3_translation(scale * about_y(0.06), foot);
    teapot(&mut pot, place, 24);
    meshes.push(pot.finish());

    // A string of beads lies around the pot in waves.
    let mut beads = Shapes::new("beads", GOLD);
    let unit = Icosphere::new(2);
    for bead in 0..360 {
        let share = f64::from(bead) / 360.0;
        let (sin, cos) = turn(share);
        let reach = 0.118 + 0.014 * turn(5.0 * share).0;
        let middle = at(reach * cos, PEDESTAL + 1.02 * BEAD, reach * sin);
        beads.sphere(&unit, middle, BEAD, false);
    }
    meshes.push(beads.finish());
}

/// Makes ten seats around the origin that look along +z.
fn bench(name: &str, material: usize) -> Mesh {
    let mut shapes = Shapes::new(name, material);
    let faces = [true, true, false, true, true, true];
    for seat in 0..BENCH {
        let x = SEAT * (seat as f64 - 0.5 * (BENCH as f64 - 1.0));
        shapes.block(at(x - 0.22, 0.38, -0.2), at(x + 0.22, 0.43, 0.2), faces, 1.0);
        shapes.block(at(x - 0.22, 0.4, -0.26), at(x + 0.22, 0.86, -0.2), faces, 1.0);
    }
    shapes.finish()
}

/// Places `count` benches evenly on the steps; each step gets a share of them in proportion to its length.
fn benches(instances: &mut Vec<Instance>, meshes: &[Mesh], first: usize, count: usize) {
    let steps = 512;
    let point = |row: usize, share: f64| {
        let (sin, cos) = turn(share);
        let out = FIRST_ROW + STEP.0 * row as f64 + 0.45;
        at(out * cos, FOOT + STEP.1 * row as f64, out * sin * FLAT)
    };
    let length = |row: usize| -> f64 {
        (0..steps)
            .map(|step| {
                let share = |step: i32| f64::from(step) / f64::from(steps);
                point(row, share(step)).distance(point(row, share(step + 1)))
            })
            .sum()
    };
    let lengths: Vec<f64> = (0..ROWS).map(length).collect();
    let total: f64 = lengths.iter().sum();
    let (mut passed, mut placed) = (0.0, 0);
    for (row, length) in lengths.iter().enumerate() {
        passed += length;
        let here = (count as f64 * passed / total).round() as usize - placed;
        placed += here;
        let (mut travelled, mut next) = (0.0, 0);
        for step in 0..steps {
            let [from, to] = [step, step + 1].map(|step| point(row, f64::from(step) / f64::from(steps)));
            let reach = from.distance(to);
            while next < here && (next as f64 + 0.5) * length / (here as f64) <= travelled + reach {
                let share = ((next as f64 + 0.5) * length / (here as f64) - travelled) / reach;
                let along = (to - from).normalize();
                // A row runs from +x over +z, so the middle is to its right.
                let inward = along.cross(DVec3::Y);
                let turned = DMat3::from_cols(DVec3::Y.cross(inward), DVec3::Y, inward);
                let place = from.lerp(to, share);
                let block = (16.0 * ((step as f64 + share) / f64::from(steps))) as usize;
                let mesh = first + (block + usize::from(row >= ROWS / 2)) % 3;
                instances.push(Instance {
                    name: format!("{} {row}.{next}", meshes[mesh].name),
                    mesh,
                    world_from_mesh: DAffine3::from_mat3_translation(turned, place),
                });
                next += 1;
            }
            travelled += reach;
        }
    }
}
