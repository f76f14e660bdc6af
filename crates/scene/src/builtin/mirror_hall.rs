//! A hall in which mirrors cover a given share of the picture.

use glam::{DVec2, DVec3};

use super::cornell::{diffuse, place_each};
use super::forms::{curve, standing, turn};
use super::shape::{Icosphere, Shapes};
use crate::default_view::{camera_looking_at, seen_instances};
use crate::{Camera, Material, Mesh, Scene};

/// Half the width of the hall, metres.
const HALF: f64 = 6.0;
/// Ends of the hall along z, metres: the far end, which the camera looks at, and the end behind the camera.
const ENDS: (f64, f64) = (-16.0, 14.0);
/// Height of the hall, metres.
const HEIGHT: f64 = 8.0;
/// Length of a bay, metres.
const BAY: f64 = 3.0;
/// Distance from a row of columns to the middle, metres.
const ROW: f64 = 3.9;
/// Half the width of the glass roof, metres.
const GLASS: f64 = 1.5;
/// Half the size of a pane, metres.
const PANE: DVec3 = DVec3::new(0.235, 0.285, 0.012);
/// Size of the picture in which pixels are counted.
const COUNTED: [u32; 2] = [240, 135];

const PLASTER: usize = 0;
const LACQUER: usize = 1;
const GILDED: usize = 2;
const LIGHT: usize = 3;
const DARK: usize = 4;
const MARBLE: usize = 5;
const RED: usize = 6;
const ROOF: usize = 7;
const OPAL: usize = 8;
const MIRROR: usize = 9;

/// Parameters of [`mirror_hall`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MirrorHall {
    /// Share of the pixels of the scene's camera that show a mirror at the first hit, percent, in [0, 80].
    pub share: f64,
}

impl MirrorHall {
    /// Valid range of [`MirrorHall::share`], percent.
    pub const SHARE: std::ops::RangeInclusive<f64> = 0.0..=80.0;
}

impl Default for MirrorHall {
    fn default() -> Self {
        Self { share: 25.0 }
    }
}

/// Makes a hall of 12 m by 30 m between two rows of fluted columns, under a roof of glass. In a 16:9 picture
/// of its camera the given share of the pixels shows a perfect mirror at the first hit, within a quarter of a
/// percentage point. Parts become mirrors one after the other: the panes of the walls, the balls, the panes
/// of the far end, the dark tiles, the light ones, columns, ceiling, and what is between. All other surfaces
/// are Lambertian and without specular reflection; the scene has the same triangles at every share.
pub fn mirror_hall(parameters: MirrorHall) -> Scene {
    let share = parameters.share.clamp(*MirrorHall::SHARE.start(), *MirrorHall::SHARE.end());
    let materials = vec![
        diffuse("plaster", [0.74, 0.68, 0.58]),
        diffuse("lacquer", [0.09, 0.26, 0.27]),
        diffuse("gilding", [0.72, 0.5, 0.2]),
        diffuse("light tiles", [0.72, 0.69, 0.63]),
        diffuse("dark tiles", [0.1, 0.11, 0.13]),
        diffuse("marble", [0.78, 0.75, 0.7]),
        diffuse("red", [0.55, 0.07, 0.05]),
        Material { emission: [2.3, 2.35, 2.5], ..diffuse("glass roof", [0.3; 3]) },
        Material { emission: [0.75, 0.72, 0.68], ..diffuse("opal glass", [0.3; 3]) },
        Material { metallic: 1.0, roughness: 0.0, ..diffuse("mirror", [0.94, 0.95, 0.95]) },
    ];
    let camera = camera_looking_at("hall", DVec3::new(0.7, 2.2, 12.9), DVec3::new(-0.4, 3.1, -16.0), 1.0);
    let (candidates, fixed) = parts();
    let mirrors = choose(&candidates, &fixed, &camera, share);

    let mut whole: Vec<Shapes> =
        materials.iter().enumerate().map(|(index, material)| Shapes::new(&material.name, index)).collect();
    for (part, mirror) in candidates.iter().zip(mirrors) {
        whole[if mirror { MIRROR } else { part.material() }].append(part);
    }
    for part in &fixed {
        whole[part.material()].append(part);
    }
    let mut meshes: Vec<Mesh> = whole.into_iter().map(Shapes::finish).collect();
    meshes.retain(|mesh| mesh.triangle_count() > 0);
    Scene {
        name: "mirror-hall".to_owned(),
        instances: place_each(&meshes),
        meshes,
        materials,
        cameras: vec![camera],
        ..Scene::default()
    }
}

/// Chooses the candidates that are mirrors: all in order up to the first that shows more pixels than are
/// still wanted, then those that fill the rest. A candidate that the camera does not see is treated like the
/// one before it.
fn choose(candidates: &[Shapes], fixed: &[Shapes], camera: &Camera, share: f64) -> Vec<bool> {
    let meshes: Vec<Mesh> = candidates.iter().chain(fixed).cloned().map(Shapes::finish).collect();
    let scene = Scene { instances: place_each(&meshes), meshes, ..Scene::default() };
    let mut pixels = vec![0_u32; scene.instances.len()];
    for instance in seen_instances(&scene, camera, COUNTED).into_iter().flatten() {
        pixels[instance as usize] += 1;
    }
    let mut wanted = (share / 100.0 * f64::from(COUNTED[0] * COUNTED[1])).round() as u32;
    let mut in_order = wanted > 0;
    let mut take = |&pixels: &u32| {
        in_order &= pixels <= wanted;
        let fits = in_order || (1..=wanted).contains(&pixels);
        wanted -= if fits { pixels } else { 0 };
        fits
    };
    pixels[..candidates.len()].iter().map(&mut take).collect()
}

/// Makes the parts that can be mirrors, in the order in which they become mirrors, and the parts that cannot.
fn parts() -> (Vec<Shapes>, Vec<Shapes>) {
    let mut parts = Vec::new();
    wall_panes(&mut parts);
    balls(&mut parts);
    end_panes(&mut parts);
    for dark in [true, false] {
        tiles(&mut parts, dark);
    }
    for z in column_places() {
        column(&mut parts, DVec3::new(-ROW, 0.0, z));
        column(&mut parts, DVec3::new(ROW, 0.0, z));
    }
    ceiling(&mut parts);
    walls(&mut parts);
    frames(&mut parts);

    let mut roof = Shapes::new("glass roof", ROOF);
    let mut opal = Shapes::new("opal glass", OPAL);
    let strip = |shapes: &mut Shapes, from: f64, to: f64| {
        let at = |x: f64, z: f64| DVec3::new(x, HEIGHT, z);
        shapes.quad([at(from, ENDS.0), at(to, ENDS.0), at(to, ENDS.1), at(from, ENDS.1)], DVec2::ONE);
    };
    strip(&mut roof, -GLASS, GLASS);
    strip(&mut opal, -HALF, -GLASS);
    strip(&mut opal, GLASS, HALF);
    (parts, vec![roof, opal])
}

/// Adds a part made of one kind of shape.
fn part(parts: &mut Vec<Shapes>, material: usize, make: impl FnOnce(&mut Shapes)) {
    let mut shapes = Shapes::new("part", material);
    make(&mut shapes);
    parts.push(shapes);
}

fn block(parts: &mut Vec<Shapes>, material: usize, middle: DVec3, half: DVec3, bevel: f64) {
    part(parts, material, |shapes| shapes.block_with_bevel(standing(middle, 0.0), half, bevel, 1.0));
}

/// Iterates over the middles of the bays along z, from the far one.
fn bays() -> impl Iterator<Item = f64> {
    (0..10).map(|bay| ENDS.0 + (f64::from(bay) + 0.5) * BAY)
}

/// Iterates over the positions of columns along z.
fn column_places() -> impl Iterator<Item = f64> {
    (1..9).map(|bay| ENDS.0 + f64::from(bay) * BAY)
}

/// Adds four by eight panes with cut edges in each bay of the long walls.
fn wall_panes(parts: &mut Vec<Shapes>) {
    for (z, side) in bays().flat_map(|z| [(z, -1.0), (z, 1.0)]) {
        for pane in 0..32 {
            let (across, up) = (f64::from(pane % 4) - 1.5, f64::from(pane / 4));
            let middle = DVec3::new(side * (HALF - 0.03), 1.2 + 0.6 * up, z + 0.5 * across);
            part(parts, LACQUER, |shapes| shapes.block_with_bevel(standing(middle, 0.25), PANE, 0.008, 1.0));
        }
    }
}

/// Adds balls on the floor, and urns on pedestals between the columns.
fn balls(parts: &mut Vec<Shapes>) {
    let unit = Icosphere::new(4);
    for (x, z, radius) in
        [(0.9, -12.0, 0.8), (-1.1, -8.5, 0.65), (1.2, -4.0, 0.6), (-1.3, 1.5, 0.55), (1.0, 4.6, 0.4)]
    {
        // The ball hovers a little above the floor: its lowest vertex would otherwise lie in the floor's
        // plane.
        let middle = DVec3::new(x, 1.001 * radius, z);
        part(parts, RED, |shapes| shapes.sphere(&unit, middle, radius, false));
    }
    let outline = [
        (0.0, 0.0),
        (0.16, 0.0),
        (0.17, 0.04),
        (0.07, 0.12),
        (0.07, 0.17),
        (0.24, 0.34),
        (0.3, 0.52),
        (0.24, 0.7),
        (0.13, 0.78),
        (0.17, 0.86),
        (0.15, 0.87),
        (0.1, 0.78),
        (0.0, 0.75),
    ];
    let profile = curve(&outline.map(DVec2::from), 4);
    for (index, z) in bays().skip(1).take(8).enumerate() {
        let side = if index % 2 == 0 { -ROW } else { ROW };
        for x in [side, -side] {
            let foot = DVec3::new(x, 0.0, z);
            block(parts, MARBLE, foot + DVec3::Y * 0.5, DVec3::new(0.26, 0.5, 0.26), 0.02);
            let place = standing(foot + DVec3::Y * 1.001, 0.0);
            part(parts, RED, |shapes| {
                shapes.revolve(place, 40, &on_axis(&profile), DVec2::ONE);
            });
        }
    }
}

/// Moves the profile of a closed vessel so that nothing lies beyond the axis.
fn on_axis(profile: &[DVec2]) -> Vec<DVec2> {
    profile.iter().map(|point| DVec2::new(point.x.max(0.0), point.y)).collect()
}

/// Adds panes all over the far end.
fn end_panes(parts: &mut Vec<Shapes>) {
    for pane in 0..20 * 10 {
        let (across, up) = (f64::from(pane % 20) - 9.5, f64::from(pane / 20));
        let middle = DVec3::new(0.5 * across, 1.2 + 0.6 * up, ENDS.0 + 0.03);
        block(parts, LACQUER, middle, PANE, 0.008);
    }
}

/// Adds the square metres of the floor that have one of its two colours, from the far end.
fn tiles(parts: &mut Vec<Shapes>, dark: bool) {
    let material = if dark { DARK } else { LIGHT };
    for (row, column) in (0..30).flat_map(|row| (0..12).map(move |column| (row, column))) {
        if ((row + column) % 2 == 0) == dark {
            let (x, z) = (f64::from(column) - HALF, ENDS.0 + f64::from(row));
            let corner = |dx: f64, dz: f64| DVec3::new(x + dx, 0.0, z + dz);
            let corners = [corner(0.0, 1.0), corner(1.0, 1.0), corner(1.0, 0.0), corner(0.0, 0.0)];
            part(parts, material, |shapes| shapes.quad(corners, DVec2::ONE));
        }
    }
}

/// Adds a column: base, fluted shaft, capital, and the plate that carries the beam.
fn column(parts: &mut Vec<Shapes>, foot: DVec3) {
    let place = standing(foot, 0.0);
    let below =
        [(0.0, 0.0), (0.5, 0.0), (0.5, 0.16), (0.46, 0.2), (0.47, 0.28), (0.4, 0.34), (0.4, 0.4), (0.0, 0.4)];
    let above = [(0.0, 5.3), (0.31, 5.3), (0.33, 5.36), (0.31, 5.42), (0.36, 5.6), (0.46, 5.7), (0.0, 5.7)];
    part(parts, MARBLE, |shapes| shapes.revolve(place, 48, &below.map(DVec2::from), DVec2::ONE));
    part(parts, MARBLE, |shapes| shaft(shapes, foot));
    part(parts, GILDED, |shapes| shapes.revolve(place, 48, &above.map(DVec2::from), DVec2::ONE));
    block(parts, MARBLE, foot + DVec3::Y * 5.79, DVec3::new(0.5, 0.09, 0.5), 0.015);
}

/// Adds twenty flutes around a column that is thinner at its top, from base to capital.
fn shaft(shapes: &mut Shapes, foot: DVec3) {
    let point = |u: f64, v: f64| {
        let (sin, cos) = turn(u);
        let hollow = turn(20.0 * u).1;
        // Arrises are sharp and hollows round.
        let depth = 0.022 * (1.0 - hollow * hollow * hollow.signum()).max(0.0);
        let radius = 0.37 - 0.06 * v * v - depth;
        foot + DVec3::new(cos * radius, 0.4 + 4.9 * v, -sin * radius)
    };
    let step = 1.0 / 1024.0;
    shapes.patch(160, 8, DVec2::new(4.0, 4.0), |u, v| {
        let across = point(u + step, v) - point(u - step, v);
        let upwards = point(u, v + step) - point(u, v - step);
        (point(u, v), across.cross(upwards).normalize())
    });
}

/// Adds beams and bars below the glass.
fn ceiling(parts: &mut Vec<Shapes>) {
    let middle = 0.5 * (ENDS.0 + ENDS.1);
    for z in (0..20).map(|row| ENDS.0 + f64::from(row) * 1.5) {
        let beam = if (z - ENDS.0) % BAY == 0.0 { 0.16 } else { 0.09 };
        for side in [-1.0, 1.0] {
            let x = side * 0.5 * (HALF + GLASS);
            let half = DVec3::new(0.5 * (HALF - GLASS), beam, beam);
            block(parts, PLASTER, DVec3::new(x, HEIGHT - beam, z), half, 0.02);
        }
        block(parts, GILDED, DVec3::new(0.0, HEIGHT - 0.05, z), DVec3::new(GLASS, 0.04, 0.03), 0.008);
    }
    for (x, half) in
        [(GLASS, 0.15), (3.0, 0.09), (4.5, 0.09)].into_iter().flat_map(|(x, half)| [(x, half), (-x, half)])
    {
        block(parts, PLASTER, DVec3::new(x, HEIGHT - half, middle), DVec3::new(half, half, 15.0), 0.02);
    }
    for (x, z) in bays().flat_map(|z| [(-ROW, z), (ROW, z)]) {
        block(parts, MARBLE, DVec3::new(x, 6.2, z), DVec3::new(0.36, 0.32, 0.5 * BAY), 0.02);
        block(parts, GILDED, DVec3::new(x, 6.6, z), DVec3::new(0.44, 0.07, 0.5 * BAY), 0.02);
    }
}

/// Adds walls behind the panes, in parts of a bay, and curtains at the end behind the camera.
fn walls(parts: &mut Vec<Shapes>) {
    let mut wall = |from: DVec3, to: DVec3| {
        let up = DVec3::Y * HEIGHT;
        part(parts, PLASTER, |shapes| shapes.quad([from, to, to + up, from + up], DVec2::ONE));
    };
    let at = |x: f64, z: f64| DVec3::new(x, 0.0, z);
    for z in bays() {
        let (far, near) = (z - 0.5 * BAY, z + 0.5 * BAY);
        wall(at(-HALF, near), at(-HALF, far));
        wall(at(HALF, far), at(HALF, near));
    }
    wall(at(-HALF, ENDS.0), at(HALF, ENDS.0));
    wall(at(HALF, ENDS.1), at(-HALF, ENDS.1));
    for middle in [-3.4, 0.0, 3.4] {
        let point = |u: f64, v: f64| {
            let fold = 0.06 * turn(7.0 * u).0 + 0.02 * turn(17.0 * u + 0.3).0 * (1.0 - v);
            DVec3::new(middle + 1.5 * (1.0 - 2.0 * u), 0.1 + 6.2 * v, ENDS.1 - 0.2 + fold)
        };
        let step = 1.0 / 1024.0;
        part(parts, RED, |shapes| {
            shapes.patch(120, 12, DVec2::ONE, |u, v| {
                let across = point(u + step, v) - point(u - step, v);
                let upwards = point(u, v + step) - point(u, v - step);
                (point(u, v), across.cross(upwards).normalize())
            });
        });
    }
}

/// Adds gilded frames around the panes, and pilasters and a skirting between.
fn frames(parts: &mut Vec<Shapes>) {
    for (z, side) in bays().flat_map(|z| [(z, -1.0), (z, 1.0)]) {
        let at = |y: f64, dz: f64| DVec3::new(side * (HALF - 0.05), y, z + dz);
        for dz in [-1.07, 1.07] {
            block(parts, GILDED, at(3.3, dz), DVec3::new(0.06, 2.54, 0.06), 0.015);
        }
        for y in [0.82, 5.78] {
            block(parts, GILDED, at(y, 0.0), DVec3::new(0.07, 0.07, 1.15), 0.015);
        }
        block(parts, MARBLE, at(3.5, 0.5 * BAY), DVec3::new(0.12, 3.5, 0.2), 0.02);
        block(parts, MARBLE, at(0.25, 0.0), DVec3::new(0.08, 0.25, 0.5 * BAY), 0.02);
        block(parts, GILDED, at(7.1, 0.0), DVec3::new(0.16, 0.1, 0.5 * BAY), 0.02);
    }
    let end = |x: f64, y: f64| DVec3::new(x, y, ENDS.0 + 0.05);
    for x in [-5.08, 5.08] {
        block(parts, GILDED, end(x, 3.9), DVec3::new(0.07, 3.1, 0.07), 0.015);
    }
    for y in [0.82, 6.98] {
        block(parts, GILDED, end(0.0, y), DVec3::new(5.15, 0.07, 0.08), 0.015);
    }
    block(parts, MARBLE, end(0.0, 0.25), DVec3::new(HALF, 0.25, 0.08), 0.02);
    block(parts, GILDED, end(0.0, 7.3), DVec3::new(HALF, 0.1, 0.16), 0.02);
}
