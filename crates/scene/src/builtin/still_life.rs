//! A laid table: glass vessels with thickness and contents, metal, fruit, cloth.

use std::ops::RangeInclusive;

use glam::{DAffine3, DVec2, DVec3};

use super::cornell::{diffuse, place_each};
use super::forms::{Fineness, along, arc, curve, standing, turn};
use super::shape::{Icosphere, Shapes};
use super::spheres::Random;
use super::texture::{cloth, repeating, textured, wood};
use crate::default_view::camera_looking_at;
use crate::{Environment, Material, Mesh, Scene};

/// Parameters of [`still_life`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StillLife {
    /// Fineness of curved surfaces, in [0.25, 4]; the number of triangles grows with its square.
    pub detail: f64,
}

impl StillLife {
    /// Valid range of [`StillLife::detail`].
    pub const DETAIL: RangeInclusive<f64> = 0.25..=4.0;
}

impl Default for StillLife {
    fn default() -> Self {
        Self { detail: 1.0 }
    }
}

/// Seed of the positions of grapes.
const SEED: u64 = 0x5EED_0004;
/// Gap between an object and its support, and between a liquid and its vessel, metres.
const GAP: f64 = 0.0004;

const WOOD: usize = 0;
const WALL: usize = 1;
const CLOTH: usize = 2;
const GLASS: usize = 3;
const GREEN_GLASS: usize = 4;
const WATER: usize = 5;
const WINE: usize = 6;
const SILVER: usize = 7;
const BRASS: usize = 8;
const APPLE: usize = 9;
const ORANGE: usize = 10;
const LEMON: usize = 11;
const GRAPE: usize = 12;
const WAX: usize = 13;
const STALK: usize = 14;
const WINDOW: usize = 15;

/// Makes a table with a glass bowl of fruit, a bottle, a carafe, two glasses of wine, a silver jug, a
/// candlestick, grapes and a cloth over the table's edge, lit by a window from the left. Every object is a
/// closed solid: glass has an outer and an inner side, and its contents are a volume of their own that
/// nowhere touches the glass. The scene has about 291,000 triangles at detail 1.
pub fn still_life(parameters: StillLife) -> Scene {
    let fineness = Fineness(parameters.detail.clamp(*StillLife::DETAIL.start(), *StillLife::DETAIL.end()));
    let materials = materials();
    let mut meshes = vec![table(), wall(), tablecloth(fineness), window()];
    glass(&mut meshes, fineness);
    metal(&mut meshes, fineness);
    fruit(&mut meshes, fineness);
    Scene {
        name: "still-life".to_owned(),
        instances: place_each(&meshes),
        meshes,
        materials,
        textures: vec![repeating(0), repeating(1)],
        images: vec![wood(), cloth("linen", [222.0, 214.0, 198.0], [170.0, 60.0, 50.0])],
        environment: Environment::Constant([0.2, 0.21, 0.24]),
        cameras: vec![camera_looking_at(
            "table",
            DVec3::new(0.1, 0.42, 1.55),
            DVec3::new(0.02, 0.105, 0.0),
            0.42,
        )],
        ..Scene::default()
    }
}

fn materials() -> Vec<Material> {
    let polished = |name: &str, color: [f32; 3], roughness: f32| Material {
        roughness,
        specular: 1.0,
        ..diffuse(name, color)
    };
    let clear = |name: &str, ior: f32, attenuation_color: [f32; 3], attenuation_distance: f32| Material {
        transmission: 1.0,
        roughness: 0.0,
        specular: 1.0,
        ior,
        thickness: 0.01,
        attenuation_color,
        attenuation_distance,
        ..diffuse(name, [1.0; 3])
    };
    let metal = |name: &str, color: [f32; 3], roughness: f32| Material {
        metallic: 1.0,
        roughness,
        ..diffuse(name, color)
    };
    vec![
        textured(polished("wood", [1.0; 3], 0.35), 0),
        diffuse("wall", [0.2, 0.19, 0.17]),
        textured(diffuse("linen", [1.0; 3]), 1),
        clear("glass", 1.5, [0.9, 0.97, 0.95], 0.05),
        clear("green glass", 1.52, [0.35, 0.62, 0.25], 0.008),
        clear("water", 1.33, [0.9, 0.97, 1.0], 0.5),
        clear("wine", 1.34, [0.5, 0.02, 0.04], 0.012),
        metal("silver", [0.93, 0.91, 0.87], 0.12),
        metal("brass", [0.84, 0.63, 0.3], 0.18),
        polished("apple", [0.55, 0.06, 0.04], 0.25),
        polished("orange", [0.85, 0.35, 0.04], 0.4),
        polished("lemon", [0.85, 0.68, 0.07], 0.35),
        polished("grape", [0.13, 0.04, 0.14], 0.3),
        polished("wax", [0.88, 0.82, 0.66], 0.5),
        diffuse("stalk", [0.18, 0.11, 0.05]),
        Material { emission: [4.6, 4.45, 4.2], ..diffuse("window", [0.5; 3]) },
    ]
}

/// Makes the table; its top is at height 0.
fn table() -> Mesh {
    let mut shapes = Shapes::new("table", WOOD);
    for board in 0..5 {
        let z = 0.2 * f64::from(board) - 0.4;
        let place = standing(DVec3::new(0.0, -0.02, z), 0.0);
        shapes.block_with_bevel(place, DVec3::new(0.95, 0.02, 0.0995), 0.003, 1.2);
    }
    shapes.finish()
}

/// Makes the wall behind the table, and the floor below.
fn wall() -> Mesh {
    let mut shapes = Shapes::new("wall", WALL);
    let at = DVec3::new;
    shapes.quad(
        [at(-2.1, -0.8, -1.1), at(2.1, -0.8, -1.1), at(2.1, 1.6, -1.1), at(-2.1, 1.6, -1.1)],
        DVec2::ONE,
    );
    shapes.quad(
        [at(-2.1, -0.8, 1.7), at(2.1, -0.8, 1.7), at(2.1, -0.8, -1.1), at(-2.1, -0.8, -1.1)],
        DVec2::ONE,
    );
    shapes.finish()
}

/// Makes a window of six panes to the left, fronts towards the table.
fn window() -> Mesh {
    let mut shapes = Shapes::new("window", WINDOW);
    for (column, row) in (0..3).flat_map(|row| (0..2).map(move |column| (f64::from(column), f64::from(row))))
    {
        let (z, y) = (0.95 * column - 0.75, 0.12 + 0.66 * row);
        let at = |dz: f64, dy: f64| DVec3::new(-1.9, y + dy, z + dz);
        shapes.quad([at(0.88, 0.0), at(0.0, 0.0), at(0.0, 0.6), at(0.88, 0.6)], DVec2::ONE);
    }
    shapes.finish()
}

/// Makes a cloth with folds, over the table's front edge.
fn tablecloth(fineness: Fineness) -> Mesh {
    let mut shapes = Shapes::new("cloth", CLOTH);
    let (round, drop, depth, thickness) = (0.012, 0.24, 0.62, 0.0012);
    let quarter = 0.25 * std::f64::consts::TAU * round;
    let at = |u: f64, v: f64, lift: f64| {
        // Metres from the hem: up, around the edge, over the table.
        let s = (drop + quarter + depth) * v;
        let x = 0.62 * u - 0.2 + 0.1 * (v - 0.5) * (u - 0.5);
        let crease = |waves: f64, phase: f64| turn(waves * u + 0.7 * v + phase).0;
        let wave = 0.5 + 0.3 * crease(3.0, 0.1) + 0.2 * crease(7.0, 0.6);
        let hang = ((drop - s) / drop).clamp(0.0, 1.0);
        let flat = ((s - drop - quarter) / 0.12).clamp(0.0, 1.0);
        // The cloth is nearly flat where objects stand on it.
        let crest = 0.5 + 0.5 * turn(1.7 * u - 2.3 * v + 0.2).0;
        let ridge = (crest * crest) * (crest * crest) * (crest * crest);
        let rise = lift + GAP + 0.002 * flat * ridge + 0.045 * hang * wave;
        let edge = 0.5;
        if s < drop {
            DVec3::new(x, s - drop - round - GAP, edge + rise)
        } else if s < drop + quarter {
            let (sin, cos) = turn(0.25 * (s - drop) / quarter);
            DVec3::new(x, -round + (round + rise) * sin, edge - round + (round + rise) * cos)
        } else {
            DVec3::new(x, rise, edge - round - (s - drop - quarter))
        }
    };
    let (columns, rows) = (fineness.of(120.0, 24), fineness.of(110.0, 24));
    shapes.between(columns, rows, DVec2::new(2.0, 2.8), |u, v| at(u, v, thickness), |u, v| at(u, v, 0.0));
    shapes.finish()
}

/// Reads (radius, height) pairs in metres from a flat list.
fn points(listed: &[f64]) -> Vec<DVec2> {
    listed.chunks_exact(2).map(DVec2::from_slice).collect()
}

/// Makes the profile of a vessel: outside from the axis up to the rim, and back inside; both smooth, the rim
/// round.
fn vessel(outside: &[DVec2], inside: &[DVec2], fineness: Fineness) -> Vec<DVec2> {
    let steps = fineness.of(6.0, 2);
    let mut profile = curve(outside, steps);
    profile.extend(curve(inside, steps));
    profile.iter().map(|point| DVec2::new(point.x.max(0.0), point.y)).collect()
}

/// Makes the profile of the filling of a vessel up to `level`: a gap away from the vessel's inside, level on
/// top.
fn filling(inside: &[DVec2], level: f64, fineness: Fineness) -> Vec<DVec2> {
    let mut profile: Vec<DVec2> = curve(inside, fineness.of(6.0, 2))
        .into_iter()
        .rev()
        .map(|point| DVec2::new((point.x - GAP).max(0.0), point.y + GAP))
        .take_while(|point| point.y < level)
        .collect();
    if let Some(&last) = profile.last() {
        profile.extend([DVec2::new(last.x, level), DVec2::new(0.0, level)]);
    }
    profile
}

/// Adds a bottle, a carafe, two glasses and a bowl, with their contents.
fn glass(meshes: &mut Vec<Mesh>, fineness: Fineness) {
    let segments = fineness.of(72.0, 12);
    let mut turned = |name: &str, material: usize, place: DVec3, profile: &[DVec2]| {
        let mut shapes = Shapes::new(name, material);
        shapes.revolve(standing(place + DVec3::Y * 0.0022, 0.0), segments, profile, DVec2::ONE);
        meshes.push(shapes.finish());
    };
    let bottle_out = points(&[
        0.0, 0.012, 0.012, 0.01, 0.028, 0.0, 0.036, 0.003, 0.0375, 0.012, 0.0375, 0.1, 0.0375, 0.18, 0.033,
        0.208, 0.02, 0.235, 0.0145, 0.26, 0.014, 0.3, 0.0165, 0.303, 0.0165, 0.312, 0.0145, 0.3175,
    ]);
    let bottle_in = points(&[
        0.0125, 0.3175, 0.0105, 0.312, 0.0105, 0.26, 0.0165, 0.232, 0.0295, 0.205, 0.034, 0.178, 0.034, 0.1,
        0.034, 0.018, 0.03, 0.01, 0.012, 0.0155, 0.0, 0.0175,
    ]);
    let stand = DVec3::new(-0.235, 0.0, -0.12);
    turned("bottle", GREEN_GLASS, stand, &vessel(&bottle_out, &bottle_in, fineness));
    turned("wine in the bottle", WINE, stand, &filling(&bottle_in, 0.15, fineness));

    let carafe_out = points(&[
        0.0, 0.0, 0.045, 0.0, 0.058, 0.004, 0.066, 0.02, 0.068, 0.045, 0.055, 0.1, 0.032, 0.15, 0.025, 0.18,
        0.027, 0.205, 0.036, 0.228, 0.0375, 0.231,
    ]);
    let carafe_in = points(&[
        0.036, 0.2318, 0.0338, 0.229, 0.0245, 0.205, 0.0225, 0.18, 0.0295, 0.15, 0.0525, 0.099, 0.065, 0.045,
        0.063, 0.022, 0.056, 0.009, 0.044, 0.006, 0.0, 0.006,
    ]);
    let stand = DVec3::new(0.2, 0.0, -0.16);
    turned("carafe", GLASS, stand, &vessel(&carafe_out, &carafe_in, fineness));
    turned("water", WATER, stand, &filling(&carafe_in, 0.11, fineness));

    let glass_out = points(&[
        0.0, 0.0, 0.03, 0.0, 0.0345, 0.0008, 0.034, 0.0022, 0.018, 0.0045, 0.006, 0.009, 0.0036, 0.02,
        0.0034, 0.06, 0.0042, 0.078, 0.012, 0.088, 0.026, 0.1, 0.0355, 0.122, 0.0365, 0.14, 0.033, 0.17,
        0.0298, 0.19,
    ]);
    let glass_in = points(&[
        0.029, 0.1905, 0.0285, 0.19, 0.0317, 0.17, 0.035, 0.14, 0.034, 0.1225, 0.025, 0.1025, 0.011, 0.0915,
        0.0, 0.089,
    ]);
    for (x, z, level) in [(-0.09, 0.2, 0.128), (0.315, 0.06, 0.118)] {
        let stand = DVec3::new(x, 0.0, z);
        turned("wine glass", GLASS, stand, &vessel(&glass_out, &glass_in, fineness));
        turned("wine in a glass", WINE, stand, &filling(&glass_in, level, fineness));
    }

    // The inner side is a sphere of 0.17 m around (0, 0.18).
    let mut bowl_out = points(&[0.0, 0.0, 0.05, 0.0, 0.056, 0.002, 0.055, 0.006, 0.05, 0.0085]);
    let centre = DVec2::new(0.0, 0.18);
    bowl_out = curve(&bowl_out, fineness.of(4.0, 2));
    bowl_out.extend(arc(centre, 0.175, -0.196, -0.046, fineness.of(28.0, 6)));
    let rim = bowl_out[bowl_out.len() - 1];
    let inner = arc(centre, 0.17, -0.046, -0.25, fineness.of(34.0, 6));
    bowl_out.push((rim + inner[0]) * 0.5 + DVec2::Y * 0.0015);
    bowl_out.extend(&inner[..inner.len() - 1]);
    bowl_out.push(DVec2::new(0.0, 0.01));
    turned("bowl", GLASS, BOWL, &bowl_out);
}

/// Position of the bowl.
const BOWL: DVec3 = DVec3::new(0.02, 0.0, -0.02);

/// Adds the jug with its handle, a plate, the candlestick with its candle.
fn metal(meshes: &mut Vec<Mesh>, fineness: Fineness) {
    let segments = fineness.of(72.0, 12);
    let mut jug = Shapes::new("jug", SILVER);
    let foot = DVec3::new(-0.36, 0.0, 0.0);
    let outside = points(&[
        0.0, 0.0, 0.04, 0.0, 0.045, 0.003, 0.042, 0.01, 0.036, 0.016, 0.05, 0.035, 0.066, 0.075, 0.062,
        0.115, 0.042, 0.155, 0.035, 0.18, 0.038, 0.205, 0.047, 0.225,
    ]);
    let inside = points(&[
        0.0455, 0.2255, 0.036, 0.205, 0.033, 0.18, 0.04, 0.155, 0.06, 0.115, 0.064, 0.075, 0.048, 0.037, 0.0,
        0.022,
    ]);
    jug.revolve(standing(foot, 0.0), segments, &vessel(&outside, &inside, fineness), DVec2::ONE);
    for (ring, radius, width) in [(0.02, 0.0375, 0.004), (0.158, 0.0405, 0.003), (0.2, 0.0372, 0.0025)] {
        let torus = arc(DVec2::new(radius, ring), width, 0.0, -1.0, fineness.of(16.0, 6));
        let mut torus: Vec<DVec2> = torus.into_iter().rev().collect();
        let last = torus.len() - 1;
        torus[last] = torus[0];
        jug.revolve(standing(foot, 0.0), segments, &torus, DVec2::ONE);
    }
    let handle = [(0.036, 0.2), (0.075, 0.215), (0.105, 0.18), (0.1, 0.12), (0.075, 0.08), (0.062, 0.07)];
    let (sin, cos) = turn(0.42);
    let handle = handle.map(|(out, y)| foot + DVec3::new(out * cos, y, out * sin));
    let handle = curve(&handle, fineness.of(10.0, 3));
    jug.tube(&handle, fineness.of(16.0, 6), |share| 0.0058 - 0.002 * (1.0 - share) * share, DVec2::ONE);
    meshes.push(jug.finish());

    let mut plate = Shapes::new("plate", SILVER);
    let outside = points(&[0.0, 0.0, 0.06, 0.0, 0.07, 0.002, 0.08, 0.009, 0.105, 0.0135, 0.112, 0.0145]);
    let inside =
        points(&[0.1125, 0.0158, 0.105, 0.0155, 0.079, 0.0112, 0.069, 0.0045, 0.06, 0.0022, 0.0, 0.002]);
    let place = standing(PLATE + DVec3::Y * 0.0042, 0.0);
    plate.revolve(place, segments, &vessel(&outside, &inside, fineness), DVec2::ONE);
    meshes.push(plate.finish());

    let mut stick = Shapes::new("candlestick", BRASS);
    let foot = DVec3::new(0.41, 0.0, -0.12);
    let profile = points(&[
        0.0, 0.0, 0.055, 0.0, 0.058, 0.006, 0.05, 0.014, 0.02, 0.024, 0.012, 0.04, 0.018, 0.052, 0.012,
        0.064, 0.009, 0.1, 0.014, 0.122, 0.021, 0.13, 0.014, 0.138, 0.01, 0.16, 0.016, 0.178, 0.032, 0.19,
        0.034, 0.194, 0.018, 0.194, 0.0, 0.19,
    ]);
    let profile: Vec<DVec2> = curve(&profile, fineness.of(6.0, 2))
        .iter()
        .map(|point| DVec2::new(point.x.max(0.0), point.y))
        .collect();
    stick.revolve(standing(foot, 0.0), segments, &profile, DVec2::ONE);
    meshes.push(stick.finish());

    let mut candle = Shapes::new("candle", WAX);
    let profile = points(&[
        0.0, 0.193, 0.0105, 0.193, 0.0105, 0.2, 0.0108, 0.26, 0.0105, 0.31, 0.0095, 0.3175, 0.006, 0.3165,
        0.0, 0.314,
    ]);
    candle.revolve(standing(foot, 0.0), segments / 2, &profile, DVec2::ONE);
    meshes.push(candle.finish());
    let mut wick = Shapes::new("wick", STALK);
    let path = [(0.0, 0.312), (0.0005, 0.32), (0.002, 0.327)].map(|(x, y)| foot + DVec3::new(x, y, 0.0));
    wick.tube(&curve(&path, 4), 8, |_| 0.0008, DVec2::ONE);
    meshes.push(wick.finish());
}

/// Position of the plate, on the cloth.
const PLATE: DVec3 = DVec3::new(0.14, 0.0, 0.27);

/// Adds a fruit: its profile about its axis, from blossom to stalk, around its centre.
fn one_fruit(shapes: &mut Shapes, stalks: &mut Shapes, kind: usize, place: DAffine3, fineness: Fineness) {
    let outline = match kind {
        APPLE => points(&[
            0.0, -0.029, 0.004, -0.0305, 0.014, -0.033, 0.028, -0.024, 0.0368, -0.004, 0.036, 0.014, 0.026,
            0.03, 0.014, 0.0325, 0.005, 0.026, 0.0, 0.0225,
        ]),
        LEMON => points(&[
            0.0, -0.042, 0.004, -0.0415, 0.008, -0.036, 0.02, -0.027, 0.029, -0.01, 0.0295, 0.008, 0.022,
            0.025, 0.01, 0.034, 0.006, 0.039, 0.0, 0.04,
        ]),
        _ => arc(DVec2::ZERO, 0.0365, -0.25, 0.25, 12),
    };
    let profile: Vec<DVec2> = curve(&outline, fineness.of(5.0, 1))
        .iter()
        .map(|point| DVec2::new(point.x.max(0.0), point.y))
        .collect();
    let last = profile.len() - 1;
    let mut closed = profile;
    closed[0].x = 0.0;
    closed[last].x = 0.0;
    shapes.revolve(place, fineness.of(56.0, 12), &closed, DVec2::ONE);
    if kind == APPLE {
        let path = [(0.0, 0.021), (0.001, 0.03), (0.004, 0.041)].map(|(x, y)| DVec3::new(x, y, 0.0));
        let path: Vec<DVec3> = curve(&path, 4).iter().map(|&point| place.transform_point3(point)).collect();
        stalks.tube(&path, 8, |share| 0.0012 + 0.0006 * share, DVec2::ONE);
    }
}

/// Adds fruit in the bowl and beside it, and grapes on the plate.
fn fruit(meshes: &mut Vec<Mesh>, fineness: Fineness) {
    let mut kinds = [(APPLE, "apples"), (ORANGE, "oranges"), (LEMON, "lemons")]
        .map(|(material, name)| (material, Shapes::new(name, material)));
    let mut stalks = Shapes::new("stalks", STALK);
    let mut put = |kind: usize, middle: DVec3, axis: DVec3| {
        let shapes = kinds.iter_mut().find(|(material, _)| *material == kind).map(|(_, shapes)| shapes);
        if let Some(shapes) = shapes {
            one_fruit(shapes, &mut stalks, kind, along(axis, middle), fineness);
        }
    };
    let floor = BOWL + DVec3::Y * 0.0022;
    for (index, kind) in [APPLE, ORANGE, APPLE, LEMON, ORANGE].into_iter().enumerate() {
        let (sin, cos) = turn(index as f64 / 5.0 + 0.05);
        let middle = floor + DVec3::new(0.075 * cos, 0.0745, 0.075 * sin);
        put(kind, middle, DVec3::new(0.4 * cos + 0.3, 0.8, 0.3 * sin + 0.2 * index as f64 - 0.4));
    }
    for (index, kind) in [ORANGE, APPLE, APPLE].into_iter().enumerate() {
        let (sin, cos) = turn(index as f64 / 3.0 + 0.02);
        let middle = floor + DVec3::new(0.046 * cos, 0.145, 0.046 * sin);
        put(kind, middle, DVec3::new(-0.4 * sin + 0.2, 1.0, 0.5 * cos));
    }
    put(LEMON, DVec3::new(-0.2, 0.0338, 0.24), DVec3::new(1.0, 0.12, 0.45));
    put(APPLE, DVec3::new(0.4, 0.0345, 0.17), DVec3::new(0.25, 1.0, 0.35));
    put(ORANGE, DVec3::new(-0.29, 0.0372, 0.16), DVec3::new(0.3, 1.0, -0.2));
    meshes.extend(kinds.into_iter().map(|(_, shapes)| shapes.finish()));

    let mut grapes = Shapes::new("grapes", GRAPE);
    let unit = Icosphere::new(if fineness.0 < 0.6 { 2 } else { 3 });
    let mut random = Random::new(SEED);
    let mut placed: Vec<(DVec3, f64)> = Vec::new();
    let plate = PLATE + DVec3::Y * 0.0066;
    let mut tries = 0;
    while placed.len() < 70 && tries < 20_000 {
        tries += 1;
        let at = DVec3::new(random.signed(), random.unit(), random.signed());
        if at.length_squared() > 1.0 {
            continue;
        }
        let radius = 0.0088 + 0.0016 * random.unit();
        // The lowest grapes come first, so that none floats far above the others.
        let layer = (placed.len() / 26) as f64;
        let middle = plate
            + DVec3::new(
                at.x * (0.062 - 0.017 * layer),
                radius + 0.0145 * layer,
                at.z * (0.05 - 0.014 * layer),
            );
        if placed.iter().all(|(other, reach)| other.distance(middle) > 0.97 * (radius + reach)) {
            placed.push((middle, radius));
        }
    }
    for (middle, radius) in placed {
        grapes.sphere(&unit, middle, radius, false);
    }
    meshes.push(grapes.finish());
    meshes.push(stalks.finish());
}
