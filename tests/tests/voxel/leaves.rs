//! Voxels that rays hit themselves: what is hit and where, and how far from the surface.

use rasray_ads::{Addressing, BruteForce, Hit, PRIMITIVE_NONE, Ray};
use rasray_metrics::Percentiles;
use rasray_tests::harness::{Bench, bits};
use rasray_tests::random::Random;
use rasray_tests::rays::{along_axis, towards};
use rasray_tests::shapes::{Triangle, all_sizes, sphere};
use rasray_tests::voxels::{built, contents};
use rasray_voxel::{Builder, Config, Contents, Ends, Leaves, well_formed};

fn voxels(grid: u32) -> Config {
    Config { leaves: Leaves::Voxels, grid: Some(grid), ends: Ends::Touching, ..Config::at_centres(grid) }
}

/// From outside of everything to points within.
fn from_outside(count: usize, reach: f32) -> Vec<Ray> {
    let mut random = Random::new(41);
    let ray = |_| {
        let away = random.direction();
        let origin = away.map(|x| 4.0 * reach * x);
        let target = random.point(-reach, reach);
        towards(origin, target)
    };
    (0..count).map(ray).collect()
}

/// From points within, along the axes as well.
fn from_within(count: usize, reach: f32) -> Vec<Ray> {
    let mut random = Random::new(42);
    let ray = |index| {
        let mut direction = random.direction();
        if index % 4 == 0 {
            direction = along_axis(index / 4);
        }
        Ray::new(random.point(-reach, reach), direction)
    };
    (0..count).map(ray).collect()
}

/// A point in voxels from the lower corner of the cube.
fn place(contents: &Contents, ray: &Ray, t: f64) -> [f64; 3] {
    let header = &contents.header;
    std::array::from_fn(|axis| {
        let p = f64::from(ray.origin[axis]) + t * f64::from(ray.direction[axis]);
        (p - f64::from(header.lower[axis])) / f64::from(header.voxel)
    })
}

/// The running index of the voxel with a point; absent outside of the grid, and within `margin` voxels of a
/// voxel's side.
fn voxel_at(grid: f64, p: [f64; 3], margin: f64) -> Option<usize> {
    let is_clear = |x: &f64| (x - x.round()).abs() > margin && (0.0..grid).contains(x);
    p.iter().all(is_clear).then(|| {
        let [x, y, z] = p.map(|x| x.floor() as usize);
        (z * grid as usize + y) * grid as usize + x
    })
}

fn is_occupied(contents: &Contents, voxel: usize) -> bool {
    contents.voxels[voxel / 8] >> (4 * (voxel % 8)) & 15 != 0
}

/// Voxels in which a ray is for more than rounding, in order, with where it enters each: in double precision.
fn crossed(contents: &Contents, ray: &Ray) -> Vec<(f64, Option<usize>)> {
    let grid = f64::from(contents.config.grid());
    let (origin, ahead) = (place(contents, ray, 0.0), place(contents, ray, 1.0));
    let mut sides: Vec<f64> = (0..3)
        .filter(|axis| ray.direction[*axis] != 0.0)
        .flat_map(|axis| {
            (0..=grid as u32).map(move |side| (f64::from(side) - origin[axis]) / (ahead[axis] - origin[axis]))
        })
        .filter(|t| *t > 0.0)
        .collect();
    sides.push(0.0);
    sides.sort_by(f64::total_cmp);
    let between =
        |pair: &[f64]| (pair[0], voxel_at(grid, place(contents, ray, 0.5 * (pair[0] + pair[1])), 0.0));
    sides.windows(2).map(between).collect()
}

/// A hit is on the side of the first occupied voxel that the ray enters after that in which it begins, and
/// names that voxel's triangle. Where the ray passes an edge within rounding, either voxel next to it may be
/// first.
#[test]
fn rays_hit_the_first_occupied_voxel_that_they_enter() {
    let bench = Bench::new();
    let triangles = all_sizes();
    for grid in [5, 16, 39] {
        let structure = built(&bench, voxels(grid), &triangles);
        let contents = contents(&bench, &structure);
        well_formed(&contents, triangles.len() as u32).expect("voxels are well formed");
        for (rays, least) in [(from_outside(2000, 8.0), 1000), (from_within(2000, 8.0), 500)] {
            let hits = bench.trace(&structure, &rays).hits;
            let occluded = bench.occluded(&structure, &rays);
            let (mut found, mut other) = (0, 0);
            for ((ray, hit), occluded) in rays.iter().zip(&hits).zip(occluded) {
                assert_eq!(hit.is_hit(), occluded, "{ray:?}");
                let begins_in = voxel_at(f64::from(grid), place(&contents, ray, 0.0), 0.0);
                let entered = |(_, voxel): &(f64, Option<usize>)| {
                    *voxel != begins_in && voxel.is_some_and(|voxel| is_occupied(&contents, voxel))
                };
                let first = crossed(&contents, ray).into_iter().find(entered);
                let expected = first.map(|(t, voxel)| (t, !contents.lists[voxel.expect("it was found")]));
                let got = hit.is_hit().then_some((f64::from(hit.t), hit.primitive));
                let is_same = match (expected, got) {
                    (Some((t, primitive)), Some(got)) => {
                        (t - got.0).abs() <= 1e-5 * (1.0 + t) && primitive == got.1
                    }
                    (None, None) => true,
                    _ => false,
                };
                found += usize::from(got.is_some());
                other += usize::from(!is_same);
            }
            println!("{grid} voxels: {found} hits, {other} at edges within rounding");
            assert!(found >= least, "{found} hits");
            assert!(other <= 2, "{other} of {} rays hit another voxel than the first", rays.len());
        }
    }
}

/// A voxel holds every part of every triangle, so a ray from outside that hits a triangle hits a voxel, and
/// no later.
#[test]
fn no_ray_passes_a_triangle() {
    let bench = Bench::new();
    // Without the room around them, which every ray hits.
    let mut triangles = all_sizes();
    triangles.retain(|triangle| triangle.iter().flatten().any(|x| x.abs() < 10.0));
    let rays = from_outside(4000, 8.0);
    let brute = BruteForce::new(bench.device(), &bench.geometry(&triangles), None, false);
    let exact = bench.trace(&brute.expect("pipelines can be made"), &rays).hits;
    for grid in [4, 37] {
        let hits = bench.trace(&built(&bench, voxels(grid), &triangles), &rays).hits;
        let is_late = |(hit, exact): &(&Hit, &Hit)| exact.is_hit() && hit.t > exact.t * (1.0 + 1e-5);
        assert_eq!(hits.iter().zip(&exact).filter(is_late).count(), 0);
        let false_hits =
            hits.iter().zip(&exact).filter(|(hit, exact)| hit.is_hit() && !exact.is_hit()).count();
        assert!(false_hits > 0 && exact.iter().filter(|hit| hit.is_hit()).count() > 500, "{false_hits}");
    }
}

/// The distance of hits from the surface, and the false hits, are as wide as a voxel.
#[test]
fn errors_fall_with_the_size_of_a_voxel() {
    let bench = Bench::new();
    let triangles = sphere([0.0; 3], 1.0, 48);
    let rays: Vec<Ray> = from_outside(8000, 1.2);
    let brute = BruteForce::new(bench.device(), &bench.geometry(&triangles), None, false);
    let exact = bench.trace(&brute.expect("pipelines can be made"), &rays).hits;
    let error = |grid| {
        let hits = bench.trace(&built(&bench, voxels(grid), &triangles), &rays).hits;
        let pairs = || rays.iter().zip(&hits).zip(&exact);
        let distance = |((ray, hit), exact): ((&Ray, &Hit), &Hit)| {
            let length = ray.direction.iter().map(|x| x * x).sum::<f32>().sqrt();
            exact.is_hit().then(|| f64::from((exact.t - hit.t) * length))
        };
        let distances: Vec<f64> = pairs().filter_map(distance).collect();
        let distances = Percentiles::of(&distances).expect("rays hit");
        let false_hits = pairs().filter(|((_, hit), exact)| hit.is_hit() && !exact.is_hit()).count();
        println!(
            "{grid} voxels: {:.5} m at the median, {:.5} m at 99 %, {false_hits} false hits",
            distances.p50, distances.p99
        );
        (distances.p50, false_hits as f64)
    };
    let [coarse, middle, fine] = [16, 64, 256].map(error);
    for (coarse, fine) in [(coarse, middle), (middle, fine)] {
        assert!((3.0..5.0).contains(&(coarse.0 / fine.0)), "{} and {} m", coarse.0, fine.0);
        assert!((2.5..6.0).contains(&(coarse.1 / fine.1)), "{} and {} false hits", coarse.1, fine.1);
    }
}

/// Hits do not depend on how voxels are marked and reached, nor on what a dispatch may do.
#[test]
fn voxels_that_are_hit_do_not_depend_on_how_they_are_built_and_traced() {
    let bench = Bench::new();
    let triangles = all_sizes();
    let rays = [from_outside(1000, 8.0), from_within(1000, 8.0)].concat();
    let answers = |config: Config| {
        let hits = bench.trace(&built(&bench, config, &triangles), &rays).hits;
        hits.iter().map(bits).collect::<Vec<_>>()
    };
    let expected = answers(voxels(24));
    assert!(expected.iter().filter(|hit| hit[1] != PRIMITIVE_NONE).count() > 1000);
    for config in [
        Config { builder: Builder::Binning, ..voxels(24) },
        Config { addressing: Addressing::Address, ..voxels(24) },
        Config { work_budget: Some(2), ..voxels(24) },
    ] {
        assert!(answers(config) == expected, "{config:?}");
    }
}

/// A ray that leaves the triangle of a voxel does not hit it, nor its neighbours where ends are clear.
#[test]
fn rays_that_leave_a_wall_do_not_hit_its_voxels() {
    let bench = Bench::new();
    let wall: Vec<Triangle> = vec![
        [[-1.0, -1.0, 0.1], [1.0, -1.0, 0.1], [1.0, 1.0, 0.1]],
        [[-1.0, -1.0, 0.1], [1.0, 1.0, 0.1], [-1.0, 1.0, 0.1]],
    ];
    let mut random = Random::new(43);
    let leaving = |_| {
        let [x, y, _] = random.point(-0.9, 0.9);
        let [dx, dy, dz] = random.direction();
        let primitive = u32::from(y > x);
        Ray { exclude_primitive: primitive, ..Ray::new([x, y, 0.1], [dx, dy, dz.abs() + 0.05]) }
    };
    let rays: Vec<Ray> = (0..1000).map(leaving).collect();
    let hit = |ends| {
        let config = Config { ends, ..voxels(32) };
        bench.occluded(&built(&bench, config, &wall), &rays).iter().filter(|hit| **hit).count()
    };
    let (clear, touching) = (hit(Ends::Clear), hit(Ends::Touching));
    println!("{clear} of 1000 rays hit what they leave with clear ends, {touching} with touching ones");
    assert_eq!(clear, 0);
    assert!(touching > 20, "the other triangle's voxels are in the way: {touching}");
}
