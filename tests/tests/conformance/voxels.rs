//! The law of voxels that are hit themselves, on every hard case.

use rasray_ads::{BruteForce, Hit, PRIMITIVE_NONE, Ray};
use rasray_tests::conformance::Prepared;
use rasray_tests::hard_cases::{self, Scale};
use rasray_tests::harness::Bench;
use rasray_tests::voxels::built_of;
use rasray_voxel::{Config, Ends, Header, Leaves};

/// Rays of a case.
const RAYS: usize = 300;

/// Triangles of a case, at most: brute force is what hits are compared with.
const TRIANGLES: usize = 200_000;

/// Error of t by rounding, in voxels: marks are wider by a 256th.
const ROUNDING: f64 = 1.0 / 64.0;

/// A point of a ray in voxels from the lower corner of the cube.
fn place(header: &Header, ray: &Ray, t: f32) -> [f64; 3] {
    std::array::from_fn(|axis| {
        let p = f64::from(ray.origin[axis]) + f64::from(t) * f64::from(ray.direction[axis]);
        (p - f64::from(header.lower[axis])) / f64::from(header.voxel)
    })
}

/// True if a point lies in the voxel in which the ray begins, within rounding: that voxel is not entered.
fn is_where_it_begins(header: &Header, ray: &Ray, t: f32) -> bool {
    let (begin, end) = (place(header, ray, ray.t_min), place(header, ray, t));
    begin.iter().zip(end).all(|(begin, end)| {
        let voxels = [begin - ROUNDING, begin + ROUNDING].map(f64::floor);
        end >= voxels[0] - ROUNDING && end <= voxels[1] + 1.0 + ROUNDING
    })
}

/// A voxel holds every part of every triangle: a ray that hits a triangle outside of the voxel in which it
/// begins hits a voxel, and no later. Voxels that are coarser find hits earlier, not later.
#[test]
fn no_ray_of_a_hard_case_passes_the_voxel_of_its_hit() {
    let bench = Bench::new();
    let (mut faults, mut compared) = (Vec::new(), [0, 0]);
    for id in hard_cases::ids() {
        let scale = Scale { rays: RAYS, ..Scale::QUICK };
        let prepared =
            Prepared::new(&bench, hard_cases::case(id, scale).expect("the id is in the catalogue"));
        if prepared.case.triangles.len() > TRIANGLES {
            continue;
        }
        let brute = BruteForce::new(bench.device(), &prepared.geometry, None, false);
        let exact = bench.trace(&brute.expect("pipelines can be made"), &prepared.rays).hits;
        for (tried, grid) in [16, 100].into_iter().enumerate() {
            let ends = Ends::Touching;
            let config =
                Config { leaves: Leaves::Voxels, grid: Some(grid), ends, ..Config::at_centres(grid) };
            let structure = built_of(&bench, config, &prepared.geometry);
            let header = structure.header().expect("the header is readable");
            let hits = bench.trace(&structure, &prepared.rays).hits;
            let late = |((ray, hit), exact): &((&Ray, &Hit), &Hit)| {
                let longest = ray.direction.iter().fold(0.0_f32, |longest, x| longest.max(x.abs()));
                let voxels = f64::from(hit.t - exact.t) * f64::from(longest) / f64::from(header.voxel);
                !hit.is_hit() || voxels > ROUNDING
            };
            // A voxel whose triangle is excluded is passed, with the others in it.
            let is_compared = |((ray, _), exact): &((&Ray, &Hit), &Hit)| {
                exact.is_hit()
                    && ray.exclude_primitive == PRIMITIVE_NONE
                    && !is_where_it_begins(&header, ray, exact.t)
            };
            let rays: Vec<_> = prepared.rays.iter().zip(&hits).zip(&exact).filter(is_compared).collect();
            compared[tried] += rays.len();
            let late: Vec<_> = rays.iter().filter(|ray| late(ray)).collect();
            if let Some(((ray, hit), exact)) = late.first() {
                let count = late.len();
                faults.push(format!(
                    "{id}, {grid} voxels: {count} rays, such as {ray:?}: {hit:?}, not {exact:?}"
                ));
            }
        }
    }
    println!("{compared:?} rays compared");
    assert!(faults.is_empty(), "{} cases:\n{}", faults.len(), faults.join("\n"));
    assert!(compared.iter().all(|rays| *rays > 10_000), "{compared:?}");
}
