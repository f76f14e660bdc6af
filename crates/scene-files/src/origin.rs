//! Choice of origins for meshes of OBJ and PLY files, so that coordinates far from the origin keep their
//! precision.
//!
//! These files have coordinates in text, in double precision or in whole numbers, and no transforms; a mesh
//! has positions in single precision. Georeferenced coordinates lose their significant digits in it:
//! northings of 4,650 km are rounded to half a metre. So a mesh gets an origin in double precision, which its
//! instance carries: positions are the differences to it, rounded once.
//!
//! The rule: an axis is *far* where its greatest coordinate is more than [`FAR`] times the longest side of
//! the box around the placed triangles. On a far axis the origin is the middle of the box (to a quarter of
//! the power of two below that side), on any other axis 0. All meshes of a file share one origin if the file
//! is far; otherwise the file is divided where its boxes have gaps, and the same rule applies to each part.
//! So meshes that touch always share an origin, and closed surfaces stay closed. Where every coordinate of a
//! part is a single-precision number, the origin is 0: these meshes keep every bit of their file.
//!
//! Groups of one mesh may lie far apart, too, and one origin cannot serve both: such a mesh is divided first
//! ([`apart`]).
//!
//! On a far axis the difference of two single-precision coordinates is a single-precision number, too. So
//! placing by an origin never costs precision, wherever the origin is.

use std::collections::HashMap;

use glam::{DAffine3, DVec3};

use rasray_scene::check::MAX_COORDINATE;
use rasray_scene::{Instance, Material, Mesh, Texture, Wrap};

/// Ratio of the greatest coordinate to the longest side of the box above which an axis is far; see the
/// documentation of the module.
const FAR: f64 = 8.0;

/// Least width of a gap that divides a mesh into groups, over the side of the larger box next to the gap.
const APART: f64 = 32.0;

/// Largest number of levels of division of a file: gaps that are nested deeper occur in no plausible file,
/// and would take long to find.
const DEPTH: u32 = 32;

/// Choice of origins.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Origins<'a> {
    /// Origins that follow from the content of the file.
    Own,
    /// Origins that follow from the content of the file, also where this file loses nothing: later files are
    /// placed by these origins.
    First,
    /// Origins of an earlier file, mesh by mesh; zero for further meshes.
    Given(&'a [DVec3]),
}

/// Rounds the positions of meshes relative to origins, one for each mesh, and returns the origins. `wide` has
/// the positions of each mesh as the file has them, metres, world.
pub(crate) fn settle(meshes: &mut [Mesh], wide: &[Vec<DVec3>], origins: Origins<'_>) -> Vec<DVec3> {
    let mut found = vec![DVec3::ZERO; meshes.len()];
    match origins {
        Origins::Given(given) => {
            for (found, given) in found.iter_mut().zip(given) {
                *found = *given;
            }
        }
        Origins::Own | Origins::First => {
            let parts = meshes.iter().zip(wide).enumerate();
            let mut parts: Vec<Part> =
                parts.filter_map(|(number, (mesh, wide))| Part::of(number, &mesh.indices, wide)).collect();
            divide(&mut parts, matches!(origins, Origins::Own), DEPTH, &mut found);
        }
    }
    for ((mesh, wide), origin) in meshes.iter_mut().zip(wide).zip(&found) {
        mesh.positions = wide.iter().map(|point| relative(*point, *origin)).collect();
    }
    found
}

/// Rounds the texture coordinates of a mesh and flips v. `wide` has them as in the file: v counts from the
/// bottom of the image. Where textures repeat, whole numbers have no effect but cost precision: they are
/// subtracted on an axis that is far, by the same rule.
pub(crate) fn texture_coordinates(
    wide: &[[f64; 2]],
    material: &Material,
    textures: &[Texture],
) -> Vec<[f32; 2]> {
    let whole = if repeats(material, textures) { [0, 1].map(|axis| whole(wide, axis)) } else { [0.0; 2] };
    let on_axis = |axis: usize, x: f64| (x - whole[axis]) as f32;
    wide.iter().map(|[u, v]| [on_axis(0, *u), 1.0 - on_axis(1, *v)]).collect()
}

/// True if a material has textures, and all of them look the same when moved by a whole number of
/// coordinates.
fn repeats(material: &Material, textures: &[Texture]) -> bool {
    let used = [
        material.base_color_texture,
        material.metallic_roughness_texture,
        material.anisotropy_texture,
        material.normal_texture,
        material.emission_texture,
        material.transmission_texture,
    ];
    let mut used = used.into_iter().flatten().peekable();
    let is_whole = |row: [f32; 3]| row[..2].iter().all(|scale| scale.fract() == 0.0);
    used.peek().is_some()
        && used.all(|texture| {
            let Texture { wrap_u, wrap_v, .. } = textures[texture.texture];
            [wrap_u, wrap_v] == [Wrap::Repeat; 2] && texture.uv_transform.into_iter().all(is_whole)
        })
}

/// Returns the whole number to subtract on an axis of texture coordinates.
fn whole(wide: &[[f64; 2]], axis: usize) -> f64 {
    let values = || wide.iter().map(|point| point[axis]).filter(|x| x.abs() <= f64::from(MAX_COORDINATE));
    if values().all(|x| f64::from(x as f32) == x) {
        return 0.0;
    }
    let (low, high) =
        values().fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), x| (low.min(x), high.max(x)));
    // A texture has the size 1, however little of it a mesh shows.
    let is_far = low.abs().max(high.abs()) > FAR * (high - low).max(1.0);
    if is_far { ((low + high) / 2.0).round() } else { 0.0 }
}

/// Makes one instance for each mesh, at its origin; names that occur more than once get a running number.
pub(crate) fn place(meshes: &[Mesh], origins: &[DVec3]) -> Vec<Instance> {
    let mut seen: HashMap<&str, usize> = HashMap::new();
    let placed = meshes.iter().zip(origins).enumerate().map(|(index, (mesh, origin))| {
        let count = seen.entry(&mesh.name).or_default();
        *count += 1;
        let name = if *count == 1 { mesh.name.clone() } else { format!("{} {count}", mesh.name) };
        Instance { name, mesh: index, world_from_mesh: DAffine3::from_translation(*origin) }
    });
    placed.collect()
}

/// Returns a position relative to an origin; an unusable position stays out of range.
fn relative(point: DVec3, origin: DVec3) -> [f32; 3] {
    // A difference from zero would turn -0 into +0.
    let keeps = origin == DVec3::ZERO || !is_usable(point);
    (if keeps { point } else { point - origin }).as_vec3().to_array()
}

/// True if a position can be shown; NaN fails the comparison.
fn is_usable(point: DVec3) -> bool {
    point.to_array().iter().all(|x| x.abs() <= f64::from(MAX_COORDINATE))
}

/// Triangles of a mesh or of a group, reduced to the data that the rules use.
#[derive(Clone, Copy, Debug)]
struct Part {
    number: usize,
    low: DVec3,
    high: DVec3,
    /// True if every coordinate is a single-precision number.
    is_exact: bool,
}

impl Part {
    fn of(number: usize, indices: &[u32], wide: &[DVec3]) -> Option<Self> {
        let mut part = Self { number, low: DVec3::INFINITY, high: DVec3::NEG_INFINITY, is_exact: true };
        // Indices are checked with the finished mesh.
        let corners = indices.iter().filter_map(|&index| wide.get(index as usize));
        for &point in corners.filter(|point| is_usable(**point)) {
            part.low = part.low.min(point);
            part.high = part.high.max(point);
            part.is_exact &= point.as_vec3().as_dvec3() == point;
        }
        (part.low.x <= part.high.x).then_some(part)
    }

    /// Returns the box around both parts.
    fn and(self, other: Self) -> Self {
        let (low, high) = (self.low.min(other.low), self.high.max(other.high));
        Self { low, high, ..self }
    }

    fn side(&self) -> f64 {
        (self.high - self.low).max_element()
    }
}

/// Divides the groups of a mesh at wide gaps and returns a cluster number for each group. Groups on the two
/// sides of a gap have the same number unless the gap is much wider than the larger of the boxes next to it.
/// Each group has its part of the indices; all numbers are 0 where single precision loses nothing.
pub(crate) fn apart<'a>(groups: impl Iterator<Item = &'a [u32]>, wide: &[DVec3]) -> Vec<u32> {
    let boxes: Vec<Option<Part>> =
        groups.enumerate().map(|(number, indices)| Part::of(number, indices, wide)).collect();
    let mut clusters = vec![0; boxes.len()];
    let mut parts: Vec<Part> = boxes.into_iter().flatten().collect();
    if !parts.iter().all(|part| part.is_exact) {
        separate(&mut parts, &mut 0, &mut clusters);
    }
    clusters
}

/// Numbers the clusters from `next` on.
fn separate(parts: &mut [Part], next: &mut u32, clusters: &mut [u32]) {
    for axis in 0..3 {
        parts.sort_unstable_by(|a, b| a.low[axis].total_cmp(&b.low[axis]));
        // Boxes around all parts above a gap.
        let mut above: Vec<Part> = parts.to_vec();
        for place in (1..above.len()).rev() {
            above[place - 1] = above[place - 1].and(above[place]);
        }
        let mut below = parts.first().copied();
        for place in 1..parts.len() {
            let Some(under) = below else { break };
            let gap = above[place].low[axis] - under.high[axis];
            if gap > APART * under.side().max(above[place].side()) {
                let (low, high) = parts.split_at_mut(place);
                separate(low, next, clusters);
                separate(high, next, clusters);
                return;
            }
            below = Some(under.and(parts[place]));
        }
    }
    for part in parts {
        clusters[part.number] = *next;
    }
    *next += 1;
}

/// Chooses the origins of parts by the rule; with `spares`, parts that lose nothing keep the origin 0.
fn divide(parts: &mut [Part], spares: bool, depth: u32, origins: &mut [DVec3]) {
    if spares && parts.iter().all(|part| part.is_exact) {
        return;
    }
    let low = parts.iter().fold(DVec3::INFINITY, |low, part| low.min(part.low));
    let high = parts.iter().fold(DVec3::NEG_INFINITY, |high, part| high.max(part.high));
    let origin = origin(low, high);
    if parts.len() > 1 && depth > 0 && origin == DVec3::ZERO {
        for axis in 0..3 {
            parts.sort_unstable_by(|a, b| a.low[axis].total_cmp(&b.low[axis]));
            let mut reach = f64::NEG_INFINITY;
            let groups = parts.chunk_by_mut(|left, right| {
                reach = reach.max(left.high[axis]);
                right.low[axis] <= reach
            });
            let groups: Vec<&mut [Part]> = groups.collect();
            if groups.len() > 1 {
                groups.into_iter().for_each(|group| divide(group, spares, depth - 1, origins));
                return;
            }
        }
    }
    for part in parts {
        origins[part.number] = origin;
    }
}

/// Returns the origin for a box.
fn origin(low: DVec3, high: DVec3) -> DVec3 {
    let side = (high - low).max_element();
    // A point has no extent that could be lost.
    if side <= 0.0 || !side.is_normal() {
        return DVec3::ZERO;
    }
    // The largest power of two that is not above the side: the exponent bits alone.
    let spacing = f64::from_bits(side.to_bits() & 0x7FF0_0000_0000_0000) / 4.0;
    let on_axis = |axis: usize| {
        let (low, high) = (low[axis], high[axis]);
        let is_far = low.abs().max(high.abs()) > FAR * side;
        if is_far { ((low + high) / 2.0 / spacing).round() * spacing } else { 0.0 }
    };
    DVec3::from_array([0, 1, 2].map(on_axis))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn mesh(corners: &[[f64; 3]]) -> (Mesh, Vec<DVec3>) {
        let mesh = Mesh { indices: (0..corners.len() as u32).collect(), ..Mesh::default() };
        (mesh, corners.iter().map(|corner| DVec3::from_array(*corner)).collect())
    }

    fn settled(of: &[&[[f64; 3]]], origins: Origins<'_>) -> (Vec<Mesh>, Vec<DVec3>) {
        let (mut meshes, wide): (Vec<_>, Vec<_>) = of.iter().map(|corners| mesh(corners)).unzip();
        let origins = settle(&mut meshes, &wide, origins);
        for ((mesh, wide), origin) in meshes.iter().zip(&wide).zip(&origins) {
            for (position, wide) in mesh.positions.iter().zip(wide) {
                let world = DVec3::from(position.map(f64::from)) + *origin;
                assert!((world - *wide).abs().max_element() <= 1.0e-6, "{wide} became {world}");
            }
        }
        (meshes, origins)
    }

    const NEAR: [[f64; 3]; 3] = [[0.1, 0.0, 0.0], [1.1, 0.0, 0.0], [0.1, 1.3, -0.0]];
    const UTM: [[f64; 3]; 3] = [
        [500123.456, 4649776.654, 112.345],
        [500124.456, 4649776.654, 112.375],
        [500123.456, 4649777.654, 112.4],
    ];

    #[test]
    fn what_is_near_or_exact_keeps_its_bits() {
        let (meshes, origins) = settled(&[&NEAR], Origins::Own);
        assert_eq!(origins, [DVec3::ZERO]);
        assert_eq!(meshes[0].positions, NEAR.map(|corner| corner.map(|x| x as f32)));
        assert!(meshes[0].positions[2][2].is_sign_negative());
        let exact =
            [[500_123.5, 4_649_776.0, 0.0], [500_124.5, 4_649_776.0, 0.0], [500_123.5, 4_649_777.0, 0.0]];
        let (meshes, origins) = settled(&[&exact], Origins::Own);
        assert_eq!((origins[0], meshes[0].positions[1]), (DVec3::ZERO, [500_124.5, 4_649_776.0, 0.0]));
        // As the first of many files, this one has an origin all the same, and loses nothing by it.
        let (meshes, origins) = settled(&[&exact], Origins::First);
        assert_ne!(origins[0], DVec3::ZERO);
        for (position, corner) in meshes[0].positions.iter().zip(exact) {
            assert_eq!(DVec3::from(position.map(f64::from)) + origins[0], DVec3::from_array(corner));
        }
        let point = [[1.0e7 + 0.1; 3]; 3];
        let (mut meshes, wide): (Vec<_>, Vec<_>) = [mesh(&point)].into_iter().unzip();
        assert_eq!(settle(&mut meshes, &wide, Origins::Own), [DVec3::ZERO], "a point has no size");
    }

    #[test]
    fn what_is_far_and_near_in_one_file_has_origins_of_its_own() {
        let beside = UTM.map(|[x, y, z]| [x + 1.0, y, z]);
        let (_, origins) = settled(&[&UTM, &beside], Origins::Own);
        assert_eq!(origins[0], origins[1], "what touches shares an origin");
        assert!(origins[0].y > 4.6e6 && origins[0].x > 5.0e5);
        let (meshes, origins) = settled(&[&UTM, &NEAR, &beside], Origins::Own);
        assert_eq!((origins[0], origins[1]), (origins[2], DVec3::ZERO));
        assert_eq!(meshes[1].positions[1], [1.1, 0.0, 0.0]);
        let given = [DVec3::new(500_000.0, 4_649_000.0, 0.0)];
        let (mut meshes, wide): (Vec<_>, Vec<_>) = [mesh(&UTM), mesh(&NEAR)].into_iter().unzip();
        assert_eq!(settle(&mut meshes, &wide, Origins::Given(&given)), [given[0], DVec3::ZERO]);
        assert_eq!(meshes[0].positions[0], [123.456, 776.654, 112.345]);
    }

    #[test]
    fn what_cannot_be_shown_has_no_say() {
        let mut bad = UTM.to_vec();
        bad.extend([[f64::NAN, 0.0, 0.0], [1.0e39, 0.0, 0.0], [f64::INFINITY, 0.0, 0.0]]);
        let (mut meshes, wide): (Vec<_>, Vec<_>) = [mesh(&bad)].into_iter().unzip();
        let origins = settle(&mut meshes, &wide, Origins::Own);
        assert!(origins[0].y > 4.6e6);
        let bad = &meshes[0].positions[3..];
        assert!(bad[0][0].is_nan() && bad[1][0].is_infinite() && bad[2][0].is_infinite());
        let mut none = Mesh { indices: vec![0, 1, 9], ..Mesh::default() };
        let wide = [vec![DVec3::ZERO; 2]];
        assert_eq!(settle(std::slice::from_mut(&mut none), &wide, Origins::Own), [DVec3::ZERO]);
    }
}
