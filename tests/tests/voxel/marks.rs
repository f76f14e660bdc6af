//! Occupied voxels, and the axes along which they are searched.

use rasray_shaders_glsl::constants::voxel::VOXEL_OCCUPIED;
use rasray_tests::harness::Bench;
use rasray_tests::random::Random;
use rasray_tests::shapes::{Triangle, closed_box};
use rasray_tests::voxels::{built, contents};
use rasray_voxel::{Axes, Config, Marking};

/// Twice the area vector of a triangle.
fn area_vector(triangle: &Triangle) -> [f64; 3] {
    let [a, b, c] = triangle.map(|p| p.map(f64::from));
    let (u, v): ([f64; 3], [f64; 3]) =
        (std::array::from_fn(|k| b[k] - a[k]), std::array::from_fn(|k| c[k] - a[k]));
    [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]]
}

/// Bits of the axes that a triangle may be said to face most: several where rounding decides.
fn dominant(triangle: &Triangle) -> u32 {
    let size = area_vector(triangle).map(f64::abs);
    let largest = size.iter().fold(0.0_f64, |largest, x| largest.max(*x));
    let length = |k: usize| {
        (0..3).map(|axis| f64::from((triangle[k][axis] - triangle[0][axis]).abs())).fold(0.0, f64::max)
    };
    let rounding = 1e-6 * length(1) * length(2);
    (0..3).filter(|&axis| size[axis] >= largest - rounding).map(|axis| 1 << axis).sum()
}

/// Every point of every triangle lies in a voxel that is searched along the triangle's axis, or, where all
/// views keep all and triangles mark voxels, in one that is searched at all. Fragments do not mark as many.
#[test]
fn every_voxel_that_a_triangle_reaches_into_is_searched() {
    let bench = Bench::new();
    let mut random = Random::new(71);
    let mut triangles: Vec<Triangle> = (0..300)
        .map(|index| {
            let base = random.point(-2.0, 2.0);
            // From specks to triangles that cross everything, and slivers.
            let size = [0.01, 0.3, 3.0][index % 3];
            let thin = if index / 3 % 3 == 0 { 1e-5 } else { 1.0 };
            let (u, v) = (random.direction(), random.direction());
            let at =
                |s: f32, t: f32| std::array::from_fn(|k| base[k] + s * size * u[k] + t * thin * size * v[k]);
            [at(0.0, 0.0), at(1.0, 0.0), at(0.5, 1.0)]
        })
        .collect();
    triangles.extend(closed_box([-4.0; 3], [4.0; 3]));
    let of_triangle = (Axes::Triangle, None);
    let all_by = |marking| (Axes::All, Some(marking));
    for (grid, resolution, (axes, voxels)) in [
        (16, 64, of_triangle),
        (39, 100, of_triangle),
        (16, 64, all_by(Marking::Triangles)),
        (39, 100, all_by(Marking::Triangles)),
        (39, 100, all_by(Marking::Fragments)),
    ] {
        let config = Config { grid: Some(grid), axes, voxels, ..Config::at_centres(resolution) };
        let structure = built(&bench, config, &triangles);
        let contents = contents(&bench, &structure);
        let header = structure.header().expect("the header is readable");
        let lost = |voxels: &[u32]| {
            let mut random = Random::new(72);
            let mut lost = 0;
            for triangle in &triangles {
                let wanted = if axes == Axes::All { VOXEL_OCCUPIED } else { dominant(triangle) };
                for _ in 0..300 {
                    let (mut s, mut t) = (random.between(0.0, 1.0), random.between(0.0, 1.0));
                    if s + t > 1.0 {
                        (s, t) = (1.0 - s, 1.0 - t);
                    }
                    let voxel: [usize; 3] = std::array::from_fn(|k| {
                        let [a, b, c] = triangle.map(|p| f64::from(p[k]));
                        let p =
                            a + f64::from(s) * (b - a) + f64::from(t) * (c - a) - f64::from(header.lower[k]);
                        ((p / f64::from(header.voxel)).floor() as usize).min(grid as usize - 1)
                    });
                    let side = grid as usize;
                    let index = (voxel[2] * side + voxel[1]) * side + voxel[0];
                    let bits = voxels[index / 8] >> (4 * (index % 8)) & 15;
                    lost += usize::from(bits & wanted == 0);
                }
            }
            lost
        };
        let lost_points = lost(&contents.voxels);
        if voxels == Some(Marking::Fragments) {
            assert!(lost_points > 0, "cells' centres miss the specks");
            continue;
        }
        assert_eq!(lost_points, 0, "{grid} voxels along a side, {axes:?}");
        // The comparison notices a word of voxels that is missing.
        let mut missing = contents.voxels.clone();
        let marked = missing.iter().position(|word| *word != 0).expect("something is marked");
        missing[marked] = 0;
        let half = missing.len() / 2;
        missing[half..].fill(0);
        assert!(lost(&missing) > 0);
        let occupied =
            (0..(grid as usize).pow(3)).filter(|&k| contents.voxels[k / 8] >> (4 * (k % 8)) & 8 != 0);
        // The huge triangles cross the grid, and most of it is empty all the same.
        assert!(occupied.count() * 2 < (grid as usize).pow(3));
    }
}

/// Specks without a fragment, however many, do not change the axis of a voxel with fragments, and give one
/// without fragments their own. Marked only by fragments, that one is empty.
#[test]
fn triangles_decide_axes_where_there_are_no_fragments() {
    const GRID: u32 = 16;
    const SPECKS: usize = 100;
    let bench = Bench::new();
    // They face y most, and x nearly as much.
    let speck = |at: [f32; 3]| -> Triangle {
        let [x, y, z] = at;
        [at, [x - 0.8e-4, y + 0.6e-4, z], [x, y, z + 1.0e-4]]
    };
    let specks_around = |x: f32, index: usize| speck([x, 0.05 + 4.0e-4 * index as f32, 0.05]);
    let corner = |x: f32, y: f32, z: f32| [x, y, z];
    let wall = |x: f32| {
        let [a, b] = [corner(x, -1.0, -1.0), corner(x, 1.0, 1.0)];
        [[a, corner(x, 1.0, -1.0), b], [a, b, corner(x, -1.0, 1.0)]]
    };
    let (with_wall, alone) = (0.3, -0.3);
    let walls: Vec<Triangle> = [-1.0, with_wall, 1.0].into_iter().flat_map(wall).collect();
    let mut triangles = walls.clone();
    for x in [with_wall, alone] {
        triangles.extend((0..SPECKS).map(|index| specks_around(x, index)));
    }
    for marking in [Marking::Triangles, Marking::Fragments] {
        let config =
            Config { axes: Axes::All, voxels: Some(marking), grid: Some(GRID), ..Config::at_centres(128) };
        let structure = built(&bench, config, &triangles);
        let header = structure.header().expect("the header is readable");
        let of_walls = built(&bench, config, &walls).header().expect("the header is readable").fragments;
        assert_eq!(header.fragments, of_walls, "specks cover no centre of a cell");
        let contents = contents(&bench, &structure);
        let bits_at = |x: f32| {
            let at = [x, 0.05, 0.05];
            let [x, y, z] = std::array::from_fn(|k| ((at[k] - header.lower[k]) / header.voxel) as usize);
            let index = (z * GRID as usize + y) * GRID as usize + x;
            contents.voxels[index / 8] >> (4 * (index % 8)) & 15
        };
        assert_eq!(bits_at(with_wall), VOXEL_OCCUPIED | 1, "{marking:?}");
        let expected = if marking == Marking::Triangles { VOXEL_OCCUPIED | 2 } else { 0 };
        assert_eq!(bits_at(alone), expected, "{marking:?}");
    }
}
