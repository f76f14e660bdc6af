//! Hits do not know where a scene lies where that is exact, nor how a ray is cut: scenes scaled by powers of
//! two and turned by right angles, rays split in two, segments traced from both ends. Structures that find
//! triangles, hits compared bit for bit. And of all structures: where the device moved the vertices, hits are
//! those of a structure that was made for where they are.

use rasray_ads::{BoundsPass, GeometryHeader, PRIMITIVE_NONE, Ray, StructureKind};
use rasray_metrics::Truth;
use rasray_reference::oracle::Oracle;
use rasray_tests::harness::{Bench, oracle_ray};
use rasray_tests::invariance::{EYE, Subject, assert_same, general_rays, ray_count, scene};
use rasray_tests::random::Random;
use rasray_tests::rays::segment;
use rasray_tests::shapes::Triangle;

/// Only structures that find triangles: their hits do not know where the scene lies, if that is exact.
fn primitive_subjects() -> Vec<Subject> {
    Subject::all().into_iter().filter(|subject| subject.kind == StructureKind::Primitive).collect()
}

#[test]
fn scale_by_powers_of_two_changes_no_bit_but_of_the_exponent() {
    let bench = Bench::new();
    let (triangles, rays) = (scene(false), general_rays(ray_count()));
    for subject in primitive_subjects() {
        let expected = subject.answers(&bench, EYE, &triangles, &rays);
        for scale in [0.125_f32, 1024.0] {
            let grow = |point: [f32; 3]| point.map(|x| x * scale);
            let scaled: Vec<Triangle> = triangles.iter().map(|triangle| triangle.map(grow)).collect();
            let scaled_rays: Vec<Ray> =
                rays.iter().map(|ray| Ray { origin: grow(ray.origin), ..*ray }).collect();
            let mut found = subject.answers(&bench, grow(EYE), &scaled, &scaled_rays);
            for answer in &mut found.closest {
                answer[0] = (f32::from_bits(answer[0]) / scale).to_bits();
            }
            assert_same(&format!("{}: scaled by {scale}", subject.name()), &rays, &expected, &found);
        }
    }
}

#[test]
fn rotation_by_90_degrees_changes_no_hit() {
    let bench = Bench::new();
    let (triangles, rays) = (scene(false), general_rays(ray_count()));
    type Rotation = fn([f32; 3]) -> [f32; 3];
    let rotations: [(&str, Rotation); 3] = [
        ("about z", |[x, y, z]| [-y, x, z]),
        ("about x", |[x, y, z]| [x, -z, y]),
        ("about y, twice", |[x, y, z]| [-x, y, -z]),
    ];
    for subject in primitive_subjects() {
        let expected = subject.answers(&bench, EYE, &triangles, &rays);
        for (name, rotate) in rotations {
            let turned: Vec<Triangle> = triangles.iter().map(|triangle| triangle.map(rotate)).collect();
            let turned_rays: Vec<Ray> = rays
                .iter()
                .map(|ray| Ray { origin: rotate(ray.origin), direction: rotate(ray.direction), ..*ray })
                .collect();
            let found = subject.answers(&bench, rotate(EYE), &turned, &turned_rays);
            assert_same(&format!("{}: rotated {name}", subject.name()), &rays, &expected, &found);
        }
    }
}

#[test]
fn a_ray_split_in_two_finds_the_same_hits() {
    let bench = Bench::new();
    let (triangles, rays) = (scene(false), general_rays(ray_count()));
    for subject in primitive_subjects() {
        let whole = subject.answers(&bench, EYE, &triangles, &rays);
        let cut = |ray: usize| 1.0 + (ray % 7) as f32;
        let pieces = |front: bool| -> Vec<Ray> {
            let piece = |(index, ray): (usize, &Ray)| {
                let at = cut(index);
                if front { Ray { t_max: at, ..*ray } } else { Ray { t_min: at, ..*ray } }
            };
            rays.iter().enumerate().map(piece).collect()
        };
        let front = subject.answers(&bench, EYE, &triangles, &pieces(true));
        let back = subject.answers(&bench, EYE, &triangles, &pieces(false));
        let mut crossed = 0;
        for ray in 0..rays.len() {
            let expected = whole.closest[ray];
            let t = f32::from_bits(expected[0]);
            if expected[1] != PRIMITIVE_NONE && t == cut(ray) {
                continue;
            }
            let in_front = front.closest[ray][1] != PRIMITIVE_NONE;
            crossed += usize::from(!in_front && back.occluded[ray]);
            let found = if in_front { front.closest[ray] } else { back.closest[ray] };
            assert_eq!(found, expected, "{}: ray {ray} cut at {}", subject.name(), cut(ray));
        }
        assert!(crossed > 20, "{crossed} rays go on behind the cut");
    }
}

#[test]
fn a_segment_is_occluded_from_both_ends_or_from_none() {
    let bench = Bench::new();
    let triangles = scene(false);
    // Ends on a coarse grid, so that direction and far end are exact.
    let mut random = Random::new(31);
    let mut end = || random.point(-6.0, 6.0).map(|x| (x * 64.0).round() / 64.0);
    let ends: Vec<_> = (0..ray_count()).map(|_| (end(), end())).collect();
    let there: Vec<Ray> = ends.iter().map(|&(a, b)| segment(a, b)).collect();
    let back: Vec<Ray> = ends.iter().map(|&(a, b)| segment(b, a)).collect();
    let positions: Vec<[f32; 3]> = triangles.as_flattened().to_vec();
    let indices: Vec<u32> = (0..positions.len() as u32).collect();
    let oracle = Oracle::new(&positions, &indices, None).expect("indices are in order");
    let clear: Vec<usize> = (0..ends.len())
        .filter(|&i| [&there[i], &back[i]].iter().all(|ray| !oracle.closest(&oracle_ray(ray)).is_ambiguous()))
        .collect();
    assert!(clear.len() > ends.len() / 2);
    for subject in primitive_subjects() {
        let first = subject.answers(&bench, EYE, &triangles, &there);
        let second = subject.answers(&bench, EYE, &triangles, &back);
        for &i in &clear {
            assert_eq!(
                first.occluded[i],
                second.occluded[i],
                "{}: segment {i} {:?}",
                subject.name(),
                ends[i]
            );
        }
        let occluded = clear.iter().filter(|&&i| first.occluded[i]).count();
        assert!(occluded > 20 && occluded < clear.len(), "{occluded} of {}", clear.len());
    }
}

/// The host states where the triangles were, the device computes where they are.
#[test]
fn positions_that_the_device_moved_are_built_where_they_are() {
    let bench = Bench::new();
    let device = bench.device();
    let (triangles, rays) = (scene(false), general_rays(ray_count()));
    let moved_point = |[x, y, z]: [f32; 3]| [1.7 * x - 3.0, 0.6 * y + 0.25, z + 1.0];
    let moved: Vec<Triangle> = triangles.iter().map(|triangle| triangle.map(moved_point)).collect();
    let bounds_pass = BoundsPass::new(device).expect("the device works");
    for subject in Subject::all() {
        let name = subject.name();
        let expected = subject.answers(&bench, EYE, &moved, &rays);
        let geometry = bench.geometry(&triangles);
        let mut structure = subject.structure(&bench, &geometry);
        device.upload_slice(&geometry.desc().positions.buffer, 0, &moved).expect("the device works");
        let unmeasured = bench.build_once(structure.as_mut(), EYE);
        // Structures without pools need no bounds.
        let is_found = !unmeasured.complete && unmeasured.outside > 0;
        assert!(is_found || unmeasured.pools.is_empty(), "{name}: {unmeasured:?}");
        device.submit(|recorder| bounds_pass.record(recorder, &geometry)).expect("the device works");
        let found = subject.answers_of(&bench, EYE, structure.as_mut(), &rays);
        assert_same(&format!("{name}: moved"), &rays, &expected, &found);
    }
}

/// Bounds as the device measures them are those of the host: of corners that are numbers, zeros of none, both
/// zeros alike.
#[test]
fn bounds_are_measured_exactly() {
    let bench = Bench::new();
    let device = bench.device();
    let bounds_pass = BoundsPass::new(device).expect("the device works");
    let mut random = Random::new(5);
    let corner = |random: &mut Random| random.point(-1.0, 1.0).map(|x| x * 1.0e-3);
    let many: Vec<Triangle> = (0..20_000).map(|_| [(); 3].map(|()| corner(&mut random))).collect();
    let mut odd = many[..3].to_vec();
    odd[1][0] = [f32::NAN, 1.0, 1.0];
    odd[2][1] = [f32::INFINITY, 1.0, 1.0];
    let below: Vec<Triangle> = vec![[[-3.0e38, -2.0, -1.0e-40], [-1.0, -5.0, -1.0], [-2.0, -2.0, -0.0]]];
    for triangles in [many, odd, below, vec![[[1.0, -0.0, 3.0]; 3]], Vec::new()] {
        let corners = || triangles.iter().flatten().filter(|corner| corner.iter().all(|x| x.is_finite()));
        let expected: [[f32; 3]; 2] = if corners().next().is_none() {
            [[0.0; 3]; 2]
        } else {
            let over = |with: fn(f32, f32) -> f32| {
                std::array::from_fn(|axis| corners().map(|corner| corner[axis]).reduce(with).expect("some"))
            };
            [over(f32::min), over(f32::max)]
        };
        let stated: Vec<Triangle> = vec![[[0.0; 3]; 3]; triangles.len()];
        let geometry = bench.geometry(&stated);
        device.upload_slice(&geometry.desc().positions.buffer, 0, &triangles).expect("the device works");
        device.submit(|recorder| bounds_pass.record(recorder, &geometry)).expect("the device works");
        let header =
            device.download_as::<GeometryHeader>(geometry.header(), 0, 1).expect("the device works")[0];
        assert_eq!([header.lower, header.upper], expected, "{} triangles", triangles.len());
    }
}
