//! Closed forms and laws that the hits of fragment structures follow.

use rasray_abuffer::{ABuffer, Accept, Config, Coverage, March};
use rasray_ads::PRIMITIVE_NONE;
use rasray_gpu::Timing;
use rasray_metrics::{Percentiles, Rate};
use rasray_tests::conformance::{Measured, Prepared, measure};
use rasray_tests::hard_cases::{self, Scale};
use rasray_tests::harness::{Bench, oracle_of, oracle_ray};
use rasray_tests::random::Random;
use rasray_tests::shapes::{Triangle, sphere};
use rasray_tracer::build_until_complete;

/// Wrong with a probability of one in a million over all tests of this file, which make about 20 comparisons.
const CONFIDENCE: f64 = 1.0 - 5.0e-8;

/// The published acceptance with the exact march and coverage, so that it alone shows.
fn interval(resolution: u32) -> Config {
    Config { accept: Accept::Interval, ..Config::at_centres(resolution) }
}

fn sampled(resolution: u32) -> Config {
    Config { march: March::Samples, coverage: Coverage::Hardware, ..interval(resolution) }
}

fn prepare(bench: &Bench, id: &str, rays: usize) -> Prepared {
    let scale = Scale { rays, ..Scale::QUICK };
    Prepared::new(bench, hard_cases::case(id, scale).expect("the id is in the catalogue"))
}

fn run(bench: &Bench, config: Config, prepared: &Prepared) -> Measured {
    let mut structure =
        ABuffer::new(bench.device(), config, &prepared.geometry, None).expect("the options are valid");
    measure(bench, &mut structure, prepared, 1e-3, 0.0)
}

fn assert_rate(name: &str, rate: Rate, expected: f64, bias: f64) {
    let [low, high] = rate.interval_at(CONFIDENCE).expect("something was measured");
    assert!(
        low - bias <= expected && expected <= high + bias,
        "{name}: {} of {}, in [{low}, {high}] where the law says {expected}",
        rate.count,
        rate.total
    );
}

/// P(hit) = |m_r| / |m_p - m_r| for slopes of ray and wall in depth per cell: a half where they are opposite.
/// The law is of first order in the size of a cell; what is left of it is below 2 / resolution.
#[test]
fn half_of_the_rays_that_hit_a_wall_head_on_pass_between_its_samples() {
    let bench = Bench::new();
    let prepared = prepare(&bench, "V4", 20_000);
    for resolution in [64, 256] {
        let missed = run(&bench, interval(resolution), &prepared).confusion.missed;
        assert_rate("head-on", missed, 0.5, 2.0 / f64::from(resolution));
    }
    // Planes close the gaps between samples. At the open wall's edge cells have no sample.
    let missed = run(&bench, Config::at_centres(256), &prepared).confusion.missed;
    assert!(missed.value().expect("rays hit") < 2.0 / 256.0, "{missed:?}");
}

/// With the depths that the wall takes in each cell no ray that hits it is lost, whatever the resolution, and
/// t is wrong by what the ray takes through a cell: it falls as the cell's size. Without them half is lost.
#[test]
fn slopes_close_the_gaps_of_a_wall_hit_head_on() {
    let bench = Bench::new();
    let prepared = prepare(&bench, "V4", 5_000);
    let median = |resolution: u32| {
        let config = Config { accept: Accept::Slope, ..Config::at_centres(resolution) };
        let measured = run(&bench, config, &prepared);
        // At the open wall's edge cells have no sample.
        let missed = measured.confusion.missed;
        assert!(missed.value().expect("rays hit") < 2.0 / f64::from(resolution), "{missed:?}");
        measured.dt_right.expect("rays hit").p50
    };
    let [coarse, fine] = [64, 256].map(median);
    assert!(fine > 0.0 && (3.0..5.0).contains(&(coarse / fine)), "{coarse} and {fine}");
}

/// With a thickness of one cell's depth at the wall, no ray that hits the wall is lost; with half of it,
/// three quarters are found: P(hit) = (|m_r| + thickness) / |m_p - m_r|.
#[test]
fn thickness_closes_the_gaps_by_its_share() {
    const RESOLUTION: u32 = 256;
    let bench = Bench::new();
    let mut prepared = prepare(&bench, "V4", 40_000);
    // Depth per cell is z^2 / 5 times its width, so the thickness fits one depth: rays that hit near it.
    let near = |z: f32| (z - 5.0).abs() < 0.1;
    let is_near: Vec<bool> = prepared.rays.iter().map(|ray| near(ray.origin[2] + ray.direction[2])).collect();
    prepared.retain(|index| is_near[index]);
    assert!(prepared.rays.len() > 800);
    let per_cell = 5.0 * 2.0 / RESOLUTION as f32;
    for (share, found) in [(0.5, 0.75), (1.1, 1.0)] {
        let config =
            Config { accept: Accept::Thickness, thickness: Some(share * per_cell), ..interval(RESOLUTION) };
        let missed = run(&bench, config, &prepared).confusion.missed;
        // Depth per cell varies by 4 % over the depths kept.
        assert_rate("thickness", missed, 1.0 - found, 0.03);
    }
}

/// A half-open interval of a single depth is empty: rays parallel to the image plane hit no sample, and
/// every plane.
#[test]
fn rays_parallel_to_the_image_plane_need_planes() {
    let bench = Bench::new();
    let prepared = prepare(&bench, "V3", 2000);
    for config in [interval(128), sampled(128)] {
        let measured = run(&bench, config, &prepared);
        assert_eq!(measured.confusion.missed.value(), Some(1.0), "{config:?}");
        assert_eq!(measured.confusion.non_finite.count, 0);
    }
    // The wall is open: within a cell of its edge there may be no sample.
    let missed = run(&bench, Config::at_centres(256), &prepared).confusion.missed;
    assert!(missed.value().expect("rays hit") <= 1.0 / 256.0, "{missed:?}");
}

/// Wrong ids over the resolution, from the mesh alone.
///
/// A hit gets the wrong triangle where an edge parts it from its cell's centre. Along an edge of length l
/// these points have the area l times the mean distance of a cell's points from its centre across the edge,
/// which is h / 4 along the cells and 0.236 h across: a quarter of h = 2 / resolution bounds both. Lengths
/// are measured on the face (x / z), where a solid angle has the density (1 + x^2 + y^2)^(-3/2). Each edge
/// belongs to two triangles.
fn wrong_ids_per_cell(triangles: &[Triangle]) -> f64 {
    let mut sum = 0.0;
    for triangle in triangles {
        for (a, b) in [(0, 1), (1, 2), (2, 0)] {
            let (a, b) = (triangle[a].map(f64::from), triangle[b].map(f64::from));
            let middle: [f64; 3] = std::array::from_fn(|axis| 0.5 * (a[axis] + b[axis]));
            let face = (0..3).max_by(|&i, &j| middle[i].abs().total_cmp(&middle[j].abs())).unwrap_or(0);
            let on_face = |p: [f64; 3]| [p[(face + 1) % 3] / p[face], p[(face + 2) % 3] / p[face]];
            let (p, q, [x, y]) = (on_face(a), on_face(b), on_face(middle));
            let length = (p[0] - q[0]).hypot(p[1] - q[1]);
            sum += 0.5 * length * (1.0 + x * x + y * y).powf(-1.5);
        }
    }
    // A quarter of h is 1 / (2 resolution); 4 pi is the whole solid angle.
    0.5 * sum / (4.0 * std::f64::consts::PI)
}

struct Fares {
    wrong: Rate,
    missed: u64,
    /// Percentiles over all hits.
    dt: Percentiles,
}

/// Rays from all over the inside of a closed sphere.
fn inside_a_sphere(bench: &Bench, triangles: &[Triangle], resolution: u32, count: usize) -> Fares {
    let geometry = bench.geometry(triangles);
    let mut structure =
        ABuffer::new(bench.device(), Config::at_centres(resolution), &geometry, None).expect("valid");
    build_until_complete(bench.device(), &mut structure, [0.0; 3], Timing::None)
        .expect("the build completes");
    let rays = Random::new(21).rays(count, -0.8, 0.8);
    let hits = bench.trace(&structure, &rays).hits;
    let oracle = oracle_of(triangles);
    let truths = oracle.closest_batch(&rays.iter().map(oracle_ray).collect::<Vec<_>>());
    let (mut wrong, mut missed, mut dt) = (Rate::default(), 0, Vec::new());
    for (hit, truth) in hits.iter().zip(&truths) {
        let Some((primitive, t)) = truth.outcome.hit().filter(|_| !truth.ambiguous) else { continue };
        wrong.total += 1;
        wrong.count += u64::from(hit.primitive != primitive);
        missed += u64::from(hit.primitive == PRIMITIVE_NONE);
        dt.push((f64::from(hit.t) - t).abs() / t);
    }
    Fares { wrong, missed, dt: Percentiles::of(&dt).expect("rays hit") }
}

/// Coverage errors fall as 1 / resolution, by the factor that follows from the mesh; depth is at the level of
/// rounding wherever the triangle is right, which is nearly everywhere.
#[test]
fn errors_on_a_closed_mesh_fall_with_the_size_of_a_cell() {
    let bench = Bench::new();
    let triangles = sphere([0.0; 3], 2.0, 10);
    let factor = wrong_ids_per_cell(&triangles);
    let mut points = Vec::new();
    for resolution in [64, 128, 256] {
        let fares = inside_a_sphere(&bench, &triangles, resolution, 30_000);
        // A miss needs more than an edge between hit and centre: the ray must also leave the cell before it
        // hits the plane that represents both sides, which only oblique rays do.
        assert!(
            fares.missed * 10 <= fares.wrong.count,
            "at {resolution}: {} missed, {:?}",
            fares.missed,
            fares.wrong
        );
        let expected = factor / f64::from(resolution);
        let share = fares.wrong.value().expect("rays hit");
        let [low, high] = fares.wrong.interval_at(CONFIDENCE).expect("rays hit");
        // The factor is a mean over directions of edges and bounds them by 6 %; near poles edges are closer
        // than cells and hide each other.
        assert!(
            low <= expected && expected <= 1.3 * high,
            "at {resolution}: {share} in [{low}, {high}], the mesh says {expected}"
        );
        assert!(fares.dt.p90 <= 1.0e-6, "at {resolution}: {:?}", fares.dt);
        points.push((f64::from(resolution).log2(), share.log2()));
    }
    let slope = (points[2].1 - points[0].1) / (points[2].0 - points[0].0);
    assert!((slope + 1.0).abs() <= 0.15, "errors fall with slope {slope}");
}

/// The catalogue's own sphere, whose triangles are as small as cells: the same bound.
#[test]
fn errors_on_a_fine_mesh_are_bounded_by_its_edges() {
    let bench = Bench::new();
    let case = hard_cases::case("E2", Scale::QUICK).expect("it exists");
    let factor = wrong_ids_per_cell(&case.triangles);
    for resolution in [128, 256] {
        let fares = inside_a_sphere(&bench, &case.triangles, resolution, 10_000);
        let [low, _] = fares.wrong.interval_at(CONFIDENCE).expect("rays hit");
        let bound = factor / f64::from(resolution);
        assert!(low <= bound, "at {resolution}: {:?}, the mesh bounds it by {bound}", fares.wrong);
        assert!(
            fares.missed as f64 <= 1e-3 * fares.wrong.total as f64,
            "at {resolution}: {} missed",
            fares.missed
        );
    }
}

/// Coincident surfaces: the lowest id, the same in every build.
#[test]
fn equal_depths_go_to_the_lowest_id_in_every_build() {
    let bench = Bench::new();
    for (id, copies) in [("Z4", 2), ("Z14", 3)] {
        let prepared = prepare(&bench, id, 2000);
        for config in [Config::at_centres(64), interval(64)] {
            let mut structure = ABuffer::new(bench.device(), config, &prepared.geometry, None)
                .expect("the options are valid");
            let mut first: Option<Vec<(u32, u32)>> = None;
            for _ in 0..5 {
                let hits = bench.build_and_trace(&mut structure, prepared.case.eye, &prepared.rays);
                // Only the first of all copies may answer. Cells decide at the diagonal which of its two
                // triangles does.
                assert!(hits.iter().all(|hit| hit.primitive < 2), "{id}, {copies} copies, {config:?}");
                let answers: Vec<_> = hits.iter().map(|hit| (hit.t.to_bits(), hit.primitive)).collect();
                assert_eq!(first.get_or_insert_with(|| answers.clone()), &answers, "{id}: builds differ");
            }
        }
    }
}

/// Depth ranges of a cell that are a single depth, and fragments at their very end.
#[test]
fn a_single_depth_and_the_greatest_depth_are_hit() {
    let bench = Bench::new();
    for id in ["Z8", "Z9"] {
        let prepared = prepare(&bench, id, 2000);
        for config in [Config::at_centres(64), interval(64), sampled(64)] {
            for buckets in [1, 4, 32] {
                let measured = run(&bench, Config { buckets, ..config }, &prepared);
                assert_eq!(measured.lost, 0, "{id}, {buckets} buckets, {config:?}");
                assert_eq!(measured.confusion.missed.count, 0);
                assert_eq!(measured.confusion.non_finite.count, 0);
                assert_eq!(measured.errors.count, 0);
            }
        }
    }
}

/// The thinnest shell whose two sides are told apart, by acceptance.
#[test]
fn thin_shells_are_resolved_down_to_a_known_thickness() {
    let bench = Bench::new();
    let shells = ["Z11-0", "Z11-1", "Z11-2", "Z11-3", "Z11-4", "Z11-5", "Z11-6"];
    let thinnest = |config: Config| {
        let resolved = |id: &&&str| {
            let measured = run(&bench, config, &prepare(&bench, id, 1000));
            measured.errors.count == 0 && measured.errors.total > 0
        };
        shells.iter().take_while(resolved).last().copied()
    };
    // Planes resolve whatever single precision does.
    assert_eq!(thinnest(Config::at_centres(64)), Some("Z11-6"));
    // A sample's depth is taken within the step it lies in: steps are finer than a millimetre at most.
    assert_eq!(thinnest(sampled(64)), Some("Z11-3"));
}
