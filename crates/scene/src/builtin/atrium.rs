//! A courtyard of two storeys behind columns and arches, with drapes, screens, lamps and an open sky.

use std::f64::consts::{FRAC_PI_2, PI};
use std::ops::RangeInclusive;

use glam::{DVec2, DVec3};

use super::cornell::{diffuse, place_each};
use super::forms::Fineness;
use super::shape::{Icosphere, Shapes};
use super::texture;
use crate::default_view::camera_looking_at;
use crate::{Environment, Light, Material, Scene};

/// Parameters of [`atrium`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Atrium {
    /// Fineness of curved surfaces, in [0.25, 4]; the number of triangles grows with its square.
    pub detail: f64,
}

impl Atrium {
    /// Valid range of [`Atrium::detail`].
    pub const DETAIL: RangeInclusive<f64> = 0.25..=4.0;
}

impl Default for Atrium {
    fn default() -> Self {
        Self { detail: 1.0 }
    }
}

/// Half the courtyard's extent to the rows of columns, metres: x and z.
const COURT: (f64, f64) = (9.0, 4.0);
/// Half the building's extent to the outer walls, metres: x and z.
const WALL: (f64, f64) = (12.0, 7.0);
/// Height of a storey, metres.
const STOREY: f64 = 4.5;
/// Thickness of a floor between storeys, metres.
const SLAB: f64 = 0.4;
/// Height of a column with base and capital, metres.
const COLUMN: f64 = 2.6;
/// Thickness of the arches' wall, metres.
const ARCADE: f64 = 0.5;
/// Distance of columns in a row, metres; divides both sides of the courtyard.
const BAY: f64 = 2.0;

const STONE: usize = 0;
const MARBLE: usize = 1;
const FLOOR: usize = 2;
const DRAPE_RED: usize = 3;
const DRAPE_BLUE: usize = 4;
const SCREEN: usize = 5;
const BRASS: usize = 6;
const PLASTER: usize = 7;

/// Makes a courtyard of 18 m by 8 m that is open to the sky. Around it stand two storeys of columns and round
/// arches before walks with walls, a tiled floor, a gallery with pierced screens (alpha masks), hanging
/// drapes and brass lamps. A low sun shines in and a blue sky stands above. The scene has about 98,000
/// triangles at detail 1; the camera stands in the courtyard.
pub fn atrium(parameters: Atrium) -> Scene {
    let fineness = Fineness(parameters.detail.clamp(*Atrium::DETAIL.start(), *Atrium::DETAIL.end()));
    let images = vec![
        texture::tiles(),
        texture::cloth("red cloth", [150.0, 34.0, 30.0], [214.0, 170.0, 92.0]),
        texture::cloth("blue cloth", [38.0, 58.0, 128.0], [200.0, 196.0, 184.0]),
        texture::screen(),
    ];
    let materials = vec![
        Material { specular: 0.5, ..diffuse("stone", [0.55, 0.48, 0.39]) },
        Material { specular: 1.0, roughness: 0.3, ..diffuse("marble", [0.74, 0.71, 0.66]) },
        texture::textured(Material { specular: 1.0, roughness: 0.45, ..diffuse("floor", [1.0; 3]) }, 0),
        texture::textured(Material { double_sided: true, ..diffuse("red drape", [1.0; 3]) }, 1),
        texture::textured(Material { double_sided: true, ..diffuse("blue drape", [1.0; 3]) }, 2),
        texture::pierced(texture::textured(
            Material { specular: 1.0, roughness: 0.5, ..diffuse("screen", [1.0; 3]) },
            3,
        )),
        Material { metallic: 1.0, roughness: 0.25, ..diffuse("brass", [0.85, 0.65, 0.32]) },
        diffuse("plaster", [0.72, 0.66, 0.56]),
    ];

    let mut stone = Shapes::new("arcades", STONE);
    let mut marble = Shapes::new("columns", MARBLE);
    for storey in 0..2 {
        let ground = f64::from(storey) * STOREY;
        arcades(&mut stone, ground, fineness);
        columns(&mut marble, ground, fineness);
    }
    let mut meshes = vec![
        floor(),
        walls(),
        gallery(),
        stone.finish(),
        marble.finish(),
        drapes("red drapes", DRAPE_RED, 0, fineness),
        drapes("blue drapes", DRAPE_BLUE, 1, fineness),
        screens(),
        lamps(fineness),
    ];
    meshes.retain(|mesh| mesh.triangle_count() > 0);

    let eye = DVec3::new(7.4, 1.7, 0.9);
    Scene {
        name: "atrium".to_owned(),
        instances: place_each(&meshes),
        meshes,
        materials,
        textures: (0..images.len()).map(texture::repeating).collect(),
        images,
        lights: vec![Light::Directional {
            direction: DVec3::new(-0.35, -0.85, -0.4).normalize(),
            irradiance: [18.0, 16.4, 13.6],
        }],
        environment: sky(1.0),
        cameras: vec![camera_looking_at("courtyard", eye, DVec3::new(-6.0, 3.4, -1.2), 1.1)],
        ..Scene::default()
    }
}

fn at(x: f64, y: f64, z: f64) -> DVec3 {
    DVec3::new(x, y, z)
}

/// Returns the four sides of the courtyard: start, direction along the row, outward direction, bays.
fn sides() -> [(DVec3, DVec3, DVec3, usize); 4] {
    let (x, z) = COURT;
    let bays = |half: f64| (2.0 * half / BAY).round() as usize;
    [
        (at(-x, 0.0, z), DVec3::X, DVec3::Z, bays(x)),
        (at(x, 0.0, z), DVec3::NEG_Z, DVec3::X, bays(z)),
        (at(x, 0.0, -z), DVec3::NEG_X, DVec3::NEG_Z, bays(x)),
        (at(-x, 0.0, -z), DVec3::Z, DVec3::NEG_X, bays(z)),
    ]
}

/// Returns the foot of each column, once around the courtyard.
fn column_feet() -> Vec<DVec3> {
    let row = |(start, along, _, bays): (DVec3, DVec3, DVec3, usize)| {
        (0..bays).map(move |bay| start + along * (bay as f64 * BAY))
    };
    sides().into_iter().flat_map(row).collect()
}

fn columns(shapes: &mut Shapes, ground: f64, fineness: Fineness) {
    let segments = fineness.of(20.0, 8);
    let rings = fineness.of(6.0, 2);
    let mut profile = vec![(0.34, 0.0), (0.34, 0.12)];
    profile.extend(half_round(0.27, 0.19, 0.07, fineness));
    let (shaft_low, shaft_high) = (0.30, COLUMN - 0.42);
    for ring in 0..=rings {
        let share = ring as f64 / rings as f64;
        // Columns swell a little on their way up and end thinner than they began.
        let radius = 0.235 - 0.045 * share + 0.02 * (PI * share).sin();
        profile.push((radius, shaft_low + (shaft_high - shaft_low) * share));
    }
    profile.extend(half_round(0.205, COLUMN - 0.36, 0.05, fineness));
    profile.extend([(0.2, COLUMN - 0.3), (0.32, COLUMN - 0.12)]);
    for foot in column_feet() {
        let foot = foot + DVec3::Y * ground;
        shapes.lathe(foot, segments, &profile, DVec2::ONE);
        let (low, high) = (at(-0.34, COLUMN - 0.12, -0.34), at(0.34, COLUMN, 0.34));
        shapes.block(foot + low, foot + high, [true; 6], 1.0);
    }
}

/// Makes the profile of a moulding: half a circle that bulges outwards around height `y`.
fn half_round(radius: f64, y: f64, bulge: f64, fineness: Fineness) -> Vec<(f64, f64)> {
    let steps = fineness.of(6.0, 2);
    let angle = |step: usize| -FRAC_PI_2 + PI * step as f64 / steps as f64;
    (0..=steps).map(|step| (radius + bulge * angle(step).cos(), y + bulge * angle(step).sin())).collect()
}

/// Adds walls with a round arch in each bay, from the capitals to the ceiling of the storey.
fn arcades(shapes: &mut Shapes, ground: f64, fineness: Fineness) {
    let steps = fineness.of(24.0, 6);
    let radius = BAY / 2.0 - 0.25;
    let top = STOREY - SLAB;
    for (start, along, outward, bays) in sides() {
        for bay in 0..bays {
            let middle = start + along * ((bay as f64 + 0.5) * BAY) + DVec3::Y * (ground + COLUMN);
            let rise = top - COLUMN;
            for (face, facing) in [(0.5, 1.0), (-0.5, -1.0)] {
                let plane = middle + outward * (ARCADE * face);
                spandrel(shapes, plane, along, outward * facing, facing, (radius, rise), steps);
            }
            // The underside of the arch. Next to it the wall rests on the capitals, which are wider.
            let angle = |u: f64| PI * (1.0 - u);
            shapes.patch(steps, 1, DVec2::new(3.0, 0.5), |u, v| {
                let (sin, cos) = angle(u).sin_cos();
                let across = outward * (ARCADE * (v - 0.5));
                (
                    middle + along * (radius * cos) + DVec3::Y * (radius * sin) + across,
                    -along * cos - DVec3::Y * sin,
                )
            });
        }
    }
}

/// Adds the wall around one arch, seen from `normal`: from the arch out to the bay's rectangle.
fn spandrel(
    shapes: &mut Shapes,
    middle: DVec3,
    along: DVec3,
    normal: DVec3,
    facing: f64,
    (radius, rise): (f64, f64),
    steps: usize,
) {
    let half = BAY / 2.0;
    // Counter-clockwise seen from the normal: `along` runs to the right from outside only.
    let point = |angle: f64, v: f64| {
        let (sin, cos) = angle.sin_cos();
        let inner = DVec2::new(radius * cos, radius * sin);
        let outer = DVec2::new(half * cos, rise);
        let at = inner.lerp(outer, v);
        middle + along * at.x + DVec3::Y * at.y
    };
    shapes.patch(steps, 2, DVec2::new(1.0, 0.5), |u, v| {
        let angle = if facing > 0.0 { PI * (1.0 - u) } else { PI * u };
        (point(angle, v), normal)
    });
    // The wall beside the fan: between the springing line, the slanted border and the bay's edge.
    let corner = |x: f64, y: f64| middle + along * x + DVec3::Y * y;
    for side in [-1.0, 1.0] {
        let (foot, edge, high) =
            (corner(side * radius, 0.0), corner(side * half, 0.0), corner(side * half, rise));
        let first = shapes.vertex(foot, normal, DVec2::ZERO);
        let second = shapes.vertex(edge, normal, DVec2::X);
        let third = shapes.vertex(high, normal, DVec2::Y);
        shapes.triangle(if side * facing > 0.0 { [first, second, third] } else { [first, third, second] });
    }
}

/// Makes a tiled floor under the whole scene; one picture covers two metres.
fn floor() -> crate::Mesh {
    let mut shapes = Shapes::new("floor", FLOOR);
    let (x, z) = WALL;
    shapes.quad([at(-x, 0.0, z), at(x, 0.0, z), at(x, 0.0, -z), at(-x, 0.0, -z)], DVec2::new(x, z));
    shapes.finish()
}

/// Makes the outer walls. Their fronts face inwards, and they reach a parapet's height above the upper
/// ceiling.
fn walls() -> crate::Mesh {
    let mut shapes = Shapes::new("walls", PLASTER);
    let (x, z) = WALL;
    let top = 2.0 * STOREY;
    let mut wall = |from: DVec3, to: DVec3| {
        let repeat = DVec2::new(from.distance(to), top) * 0.25;
        shapes.quad([from, to, to + DVec3::Y * top, from + DVec3::Y * top], repeat);
    };
    wall(at(-x, 0.0, -z), at(x, 0.0, -z));
    wall(at(x, 0.0, -z), at(x, 0.0, z));
    wall(at(x, 0.0, z), at(-x, 0.0, z));
    wall(at(-x, 0.0, z), at(-x, 0.0, -z));
    shapes.finish()
}

/// Makes the slab between the storeys and the roof: rings between the outer walls and the courtyard.
fn gallery() -> crate::Mesh {
    let mut shapes = Shapes::new("gallery", STONE);
    let edge = ARCADE / 2.0 + 0.15;
    let (inner, outer) = ((COURT.0 - edge, COURT.1 - edge), WALL);
    for storey in [1.0, 2.0] {
        let (low, high) = (storey * STOREY - SLAB, storey * STOREY);
        let ring = |(x, z): (f64, f64), y: f64| [at(-x, y, z), at(x, y, z), at(x, y, -z), at(-x, y, -z)];
        let (out_low, out_high) = (ring(outer, low), ring(outer, high));
        let (in_low, in_high) = (ring(inner, low), ring(inner, high));
        for side in 0..4 {
            let next = (side + 1) % 4;
            let repeat = DVec2::new(out_low[side].distance(out_low[next]), 1.0) * 0.5;
            shapes.quad([out_high[side], out_high[next], in_high[next], in_high[side]], repeat);
            shapes.quad([out_low[next], out_low[side], in_low[side], in_low[next]], repeat);
            shapes.quad([in_low[next], in_low[side], in_high[side], in_high[next]], repeat);
        }
    }
    shapes.finish()
}

/// Makes drapes in every second bay of the long sides, in each storey by turns.
fn drapes(name: &str, material: usize, turn: usize, fineness: Fineness) -> crate::Mesh {
    let mut shapes = Shapes::new(name, material);
    let (columns, rows) = (fineness.of(44.0, 10), fineness.of(32.0, 8));
    for (index, (start, along, outward, bays)) in
        sides().into_iter().enumerate().filter(|(_, side)| side.3 > 4)
    {
        for bay in (0..bays).filter(|bay| (bay + index / 2) % 4 == 2 * turn) {
            let storey = turn as f64;
            let rod =
                start + along * ((bay as f64 + 0.5) * BAY) + DVec3::Y * (storey * STOREY + COLUMN - 0.1)
                    - outward * (ARCADE / 2.0 + 0.25);
            let (half, drop) = (0.8, 2.1);
            let phase = bay as f64 * 1.3 + index as f64;
            // Folds deepen downwards, and the lower hem swings.
            let place = |u: f64, v: f64| {
                let down = 1.0 - v;
                let fold = (0.03 + 0.09 * down) * (u * 9.0 * PI + phase).sin()
                    + 0.03 * (u * 23.0 + phase).cos() * down;
                let sway = 0.05 * down * (phase + 2.0 * u).sin();
                let narrow = 1.0 - 0.12 * down * down;
                rod + along * ((2.0 * u - 1.0) * half * narrow + sway)
                    - DVec3::Y * (drop * down)
                    - outward * fold
            };
            shapes.patch(columns, rows, DVec2::new(1.0, 1.4), |u, v| {
                let step = 1.0e-4;
                let right = place(u + step, v) - place(u - step, v);
                let up = place(u, v + step) - place(u, v - step);
                (place(u, v), right.cross(up).normalize_or(outward))
            });
        }
    }
    shapes.finish()
}

/// Makes pierced screens along the edge of the gallery, between the upper columns.
fn screens() -> crate::Mesh {
    let mut shapes = Shapes::new("screens", SCREEN);
    for (start, along, _, bays) in sides() {
        for bay in 0..bays {
            let left = start + along * (bay as f64 * BAY + 0.36) + DVec3::Y * (STOREY + 0.05);
            let right = left + along * (BAY - 0.72);
            let up = DVec3::Y * 0.95;
            shapes.quad([left, right, right + up, left + up], DVec2::new(1.35, 1.0));
        }
    }
    shapes.finish()
}

/// Makes brass globes under the arches of the lower storey, and two urns in the courtyard.
fn lamps(fineness: Fineness) -> crate::Mesh {
    let mut shapes = Shapes::new("brass", BRASS);
    let unit = Icosphere::new(if fineness.0 < 0.6 {
        1
    } else if fineness.0 < 2.0 {
        2
    } else {
        3
    });
    for (start, along, outward, bays) in sides() {
        for bay in (0..bays).step_by(2) {
            let middle = start + along * ((bay as f64 + 0.5) * BAY) + outward * 1.2;
            shapes.sphere(&unit, middle + DVec3::Y * 3.2, 0.16, false);
        }
    }
    let steps = fineness.of(28.0, 10);
    let mut profile: Vec<(f64, f64)> = (0..=steps)
        .map(|step| {
            let share = step as f64 / steps as f64;
            let belly = 0.30 * (PI * (0.12 + 0.76 * share)).sin() + 0.08 * (3.0 * PI * share).cos();
            (belly.max(0.05), share)
        })
        .collect();
    // The lid of the urn.
    profile.push((0.0, 1.0));
    for x in [-4.5, 4.5] {
        shapes.lathe(at(x, 0.0, 0.0), fineness.of(40.0, 12), &profile, DVec2::ONE);
    }
    shapes.finish()
}

/// Makes the sky: blue above, bright at the horizon, dim ground below, times `brightness`. The sun is a
/// separate light.
pub(super) fn sky(brightness: f32) -> Environment {
    let (width, height) = (32_u32, 32_u32);
    let mut radiance = Vec::with_capacity((width * height) as usize);
    for row in 0..height {
        let elevation = (0.5 - (f64::from(row) + 0.5) / f64::from(height)) * PI;
        let share = elevation.sin();
        let [zenith, horizon, ground] = [[0.35, 0.65, 1.5], [1.3, 1.35, 1.4], [0.16, 0.14, 0.12]];
        let color: [f32; 3] = std::array::from_fn(|channel| {
            if share < 0.0 {
                return ground[channel] as f32;
            }
            let mix = share.sqrt();
            (horizon[channel] * (1.0 - mix) + zenith[channel] * mix) as f32
        });
        radiance.extend(std::iter::repeat_n(color.map(|value| brightness * value), width as usize));
    }
    Environment::LatLong { width, height, radiance }
}
