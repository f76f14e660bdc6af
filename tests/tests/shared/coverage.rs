//! Cell centres that a triangle covers: held against the oracle, on the test kernel and in what a build
//! stores. Centres that single precision cannot decide are left out.

use std::collections::HashMap;

use rasray_abuffer::{ABuffer, Config, Contents, well_formed};
use rasray_gpu::Timing;
use rasray_reference::oracle::{Oracle, Outcome, Ray, Verdict};
use rasray_shaders_glsl::ADS_TEST_COVERAGE;
use rasray_shaders_glsl::records::test_kernels::{
    CoverageCase as Case, CoverageResult, CoverageTestConstants,
};
use rasray_tests::harness::{Bench, oracle_of};
use rasray_tests::random::Random;
use rasray_tests::shapes::Triangle;
use rasray_tests::visits::{cell_center, face_from_world, run_kernel, world_from_face};
use rasray_tracer::build_until_complete;

/// The ray through a cell's centre, in face space; its t is the depth.
fn center_ray(x: i32, y: i32, resolution: u32) -> Ray {
    Ray::new([0.0; 3], [cell_center(x, resolution), cell_center(y, resolution), 1.0])
}

/// A triangle as a face sees it. The oracle is queried there: which axis a test shears along decides its
/// rounding, and in border cells the depth is not the longest axis.
fn seen_by(triangle: &Triangle, face: u32) -> Triangle {
    triangle.map(|p| face_from_world(p.map(f64::from), face).map(|x| x as f32))
}

/// The depth of a covered centre; `None` where it is not covered.
fn depth(verdict: &Verdict) -> Option<[f64; 2]> {
    matches!(verdict.outcome, Outcome::Hit { .. }).then_some(verdict.t_range)
}

/// Triangles about the eye: ordinary ones, slivers, huge ones, ones that reach behind the eye, edge-on
/// ones, tiny ones, and ones with corners exactly on cell centres.
fn triangles(resolution: u32, random: &mut Random, count: usize) -> Vec<Triangle> {
    (0..count)
        .map(|index| {
            let base = random.direction().map(|x| x * random.between(0.5, 8.0));
            let nearby = |random: &mut Random, size: f32| {
                let d = random.direction();
                std::array::from_fn(|axis| base[axis] + size * d[axis])
            };
            match index % 7 {
                0 => [base, nearby(random, 2.0), nearby(random, 2.0)],
                1 => {
                    let far: [f32; 3] = nearby(random, 6.0);
                    let off = random.direction();
                    let width = 10.0_f32.powf(random.between(-5.0, -1.0));
                    let middle =
                        std::array::from_fn(|axis| 0.5 * (base[axis] + far[axis]) + width * off[axis]);
                    [base, far, middle]
                }
                2 => [base, nearby(random, 1.0e4), nearby(random, 1.0e4)],
                3 => [base, base.map(|x| -0.7 * x + 0.3), nearby(random, 3.0)],
                4 => {
                    // In a plane through the eye, or nearly so.
                    let other = random.direction();
                    let tilt = if index % 2 == 0 { 0.0 } else { 1.0e-4 };
                    let edge = std::array::from_fn(|axis| 3.0 * other[axis] + tilt);
                    [base, edge, std::array::from_fn(|axis| base[axis] + 0.5 * edge[axis])]
                }
                5 => {
                    let size = base.iter().fold(0.0_f32, |far, x| far.max(x.abs())) / resolution as f32;
                    [base, nearby(random, size), nearby(random, size)]
                }
                _ => {
                    let corner = |random: &mut Random| {
                        let cell = |random: &mut Random| random.between(0.0, resolution as f32) as i32;
                        let (x, y) = (cell(random), cell(random));
                        let z = [0.5, 1.0, 2.0, 4.0][random.bits() as usize % 4];
                        let q = [cell_center(x, resolution) * z, cell_center(y, resolution) * z, z];
                        world_from_face(q, index as u32 / 7 % 6)
                    };
                    [corner(random), corner(random), corner(random)]
                }
            }
        })
        .collect()
}

/// Results of the test kernel on cases.
fn evaluated(bench: &Bench, cases: &[Case], resolution: u32) -> Vec<CoverageResult> {
    let constants = CoverageTestConstants { case_count: cases.len() as u32, resolution };
    let (found, _) = run_kernel::<CoverageResult, _>(
        bench.device(),
        &ADS_TEST_COVERAGE,
        bytemuck::cast_slice(cases),
        cases.len(),
        None,
        cases.len(),
        &constants,
    );
    found
}

/// A wall beside the eye is proposed from where it begins in front of the eye, not all over the face ahead.
#[test]
fn what_reaches_behind_the_eye_is_proposed_where_it_is_in_front() {
    let bench = Bench::new();
    let (resolution, face) = (32, 4);
    for side in [-1.0, 1.0] {
        // x/z is at least 1/1.2 in front of the eye, and at most -1/1.2 behind it.
        let wall = [[side, -1.2, -1.2], [side, -1.2, 1.2], [side, 1.2, 1.2]];
        let triangle = wall.map(|corner| world_from_face(corner, face));
        let places = -1..=resolution as i32;
        let cases: Vec<_> =
            places.clone().flat_map(|y| places.clone().map(move |x| Case { triangle, face, x, y })).collect();
        for (case, found) in cases.iter().zip(evaluated(&bench, &cases, resolution)) {
            let is_in_front = side * cell_center(case.x, resolution) >= 1.0 / 1.2;
            assert_eq!(found.proposed == 1, is_in_front, "{case:?}");
        }
    }
}

#[test]
fn coverage_of_centres_agrees_with_the_oracle() {
    let bench = Bench::new();
    let mut random = Random::new(31);
    for resolution in [16_u32, 33, 512] {
        let triangles = triangles(resolution, &mut random, 1_400);
        let mut cases = Vec::new();
        for triangle in &triangles {
            // Cells about points of the triangle, so that many are covered and many just not.
            for _ in 0..24 {
                let (u, v) = (random.between(-0.1, 1.0), random.between(-0.1, 1.0));
                let p: [f32; 3] = std::array::from_fn(|axis| {
                    let [a, b, c] = triangle.map(|vertex| vertex[axis]);
                    a + u * (b - a) + v * (1.0 - u) * (c - a)
                });
                let face = (0..6)
                    .max_by(|&f, &g| {
                        let along = |face: u32| world_from_face([0.0, 0.0, 1.0], face);
                        let dot = |n: [f32; 3]| n.iter().zip(&p).map(|(n, x)| n * x).sum::<f32>();
                        dot(along(f)).total_cmp(&dot(along(g)))
                    })
                    .expect("there are six faces");
                let q = face_from_world(p.map(f64::from), face);
                let cell = |x: f64| (((x / q[2] + 1.0) * 0.5 * f64::from(resolution)).floor()) as i32;
                let (x, y) = (cell(q[0]), cell(q[1]));
                if [x, y].iter().all(|i| (-1..=resolution as i32).contains(i)) {
                    cases.push(Case { triangle: *triangle, face, x, y });
                }
            }
        }
        let found = evaluated(&bench, &cases, resolution);
        let (mut covered, mut uncovered, mut ambiguous) = (0, 0, 0);
        for (case, found) in cases.iter().zip(&found) {
            let verdict = oracle_of(&[seen_by(&case.triangle, case.face)])
                .closest(&center_ray(case.x, case.y, resolution));
            if verdict.ambiguous {
                ambiguous += 1;
                continue;
            }
            match depth(&verdict) {
                Some([low, high]) => {
                    covered += 1;
                    let z = f64::from(found.z);
                    assert!(found.covered == 1 && low <= z && z <= high, "{case:?}: {found:?}, {verdict:?}");
                    assert_eq!(found.proposed, 1, "{case:?}: {found:?}");
                }
                None => {
                    uncovered += 1;
                    assert_eq!(found.covered, 0, "{case:?}: {found:?}, {verdict:?}");
                }
            }
        }
        println!("resolution {resolution}: {covered} covered, {uncovered} not, {ambiguous} ambiguous");
        assert!(covered > 2_000 && uncovered > 2_000 && ambiguous < cases.len() / 4);
    }
}

/// Depths of the fragments of each cell and triangle.
fn fragments(contents: &Contents) -> HashMap<(usize, u32), Vec<f32>> {
    let mut found: HashMap<(usize, u32), Vec<f32>> = HashMap::new();
    let buckets = contents.config.buckets as usize;
    for (list, ends) in contents.lists.chunks_exact(2).enumerate() {
        let mut link = ends[0];
        while link != 0 {
            let node = &contents.nodes[3 * (link as usize - 1)..][..3];
            let primitive = contents.data[link as usize - 1];
            found.entry((list / buckets, primitive)).or_default().push(f32::from_bits(node[0]));
            link = node[1];
        }
    }
    found
}

/// The first way in which what is stored differs from what the triangles cover.
fn fault(contents: &Contents, triangles: &[Triangle], resolution: u32) -> Option<String> {
    let found = fragments(contents);
    let (side, mut cell) = (resolution as i32, 0_usize);
    for face in 0..6 {
        let oracles: Vec<Oracle<'_>> =
            triangles.iter().map(|triangle| oracle_of(&[seen_by(triangle, face)])).collect();
        for y in -1..=side {
            for x in -1..=side {
                let ray = center_ray(x, y, resolution);
                for (primitive, oracle) in oracles.iter().enumerate() {
                    let verdict = oracle.closest(&ray);
                    let stored = found.get(&(cell, primitive as u32)).map_or(&[][..], Vec::as_slice);
                    let right = match depth(&verdict) {
                        _ if verdict.ambiguous => stored.len() <= 1,
                        Some([low, high]) => {
                            stored.len() == 1
                                && stored.iter().all(|&z| low <= f64::from(z) && f64::from(z) <= high)
                        }
                        None => stored.is_empty(),
                    };
                    if !right {
                        let triangle = triangles[primitive];
                        return Some(format!(
                            "face {face}, cell ({x}, {y}): {triangle:?} is stored with {stored:?}, {verdict:?}"
                        ));
                    }
                }
                cell += 1;
            }
        }
    }
    None
}

fn built(bench: &Bench, triangles: &[Triangle], resolution: u32, eye: [f32; 3]) -> Contents {
    let geometry = bench.geometry(triangles);
    let mut structure =
        ABuffer::new(bench.device(), Config::at_centres(resolution), &geometry, None).expect("an A-buffer");
    build_until_complete(bench.device(), &mut structure, eye, Timing::None).expect("the build completes");
    structure.download(bench.device()).expect("the device answers")
}

/// The rasterizer proposes every covered centre, borders included, and each is stored exactly once.
#[test]
fn a_build_stores_every_covered_centre_once() {
    let bench = Bench::new();
    let mut random = Random::new(32);
    for (resolution, eye) in [(8_u32, [0.0; 3]), (33, [0.0; 3]), (32, [0.25, -1.5, 0.75])] {
        let triangles = triangles(resolution, &mut random, 84);
        let contents = built(&bench, &triangles, resolution, eye);
        assert_eq!(well_formed(&contents), Ok(()));
        assert!(contents.header.demand > 1_000, "{} fragments", contents.header.demand);
        // The device sees vertices relative to the eye, rounded once.
        let seen: Vec<Triangle> = triangles
            .iter()
            .map(|triangle| triangle.map(|p| std::array::from_fn(|axis| p[axis] - eye[axis])))
            .collect();
        assert_eq!(fault(&contents, &seen, resolution), None, "resolution {resolution}, eye {eye:?}");
    }
}

/// The checker itself: a fragment that is lost, or that belongs to another triangle, is noticed.
#[test]
fn a_lost_fragment_is_noticed() {
    let bench = Bench::new();
    let triangles = [
        [[-1.3, -1.1, 2.0], [1.7, -0.9, 2.5], [0.1, 1.9, 3.0]],
        [[-1.3, 1.1, -2.0], [1.7, 0.9, -2.5], [0.1, -1.9, -3.0]],
    ];
    let contents = built(&bench, &triangles, 16, [0.0; 3]);
    assert_eq!(fault(&contents, &triangles, 16), None);
    let list = contents.lists.iter().position(|&link| link != 0).expect("something is stored");
    let mut lost = contents.clone();
    lost.lists[list] = 0;
    assert!(fault(&lost, &triangles, 16).is_some());
    let mut wrong = contents.clone();
    wrong.data[0] ^= 1;
    assert!(fault(&wrong, &triangles, 16).is_some());
}
