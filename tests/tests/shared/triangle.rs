//! The t of a ray and a triangle against double precision: never farther off than its bound says, and close
//! to the truth on triangles of any shape and size.

use rasray_shaders_glsl::ADS_TEST_TRIANGLE;
use rasray_shaders_glsl::records::test_kernels::{
    TriangleCase as Case, TriangleResult, TriangleTestConstants,
};
use rasray_tests::harness::Bench;
use rasray_tests::random::Random;
use rasray_tests::shapes::Triangle;
use rasray_tests::visits::run_kernel;

const CASES: usize = 20_000;

fn minus(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    std::array::from_fn(|axis| a[axis] - b[axis])
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    (0..3).map(|axis| a[axis] * b[axis]).sum()
}

/// Hit of the ray on the triangle's plane, within the range of its corners along the ray's longest axis, and
/// how far double precision may be off.
fn truth(case: &Case) -> (f64, f64) {
    let wide = |p: [f32; 3]| p.map(f64::from);
    let [a, b, c] = case.triangle.map(wide);
    let (origin, direction) = (wide(case.origin), wide(case.direction));
    let (u, v, p) = (minus(b, a), minus(c, a), minus(a, origin));
    let pairs: [[f64; 2]; 3] = std::array::from_fn(|axis| {
        let (y, z) = ((axis + 1) % 3, (axis + 2) % 3);
        [u[y] * v[z], u[z] * v[y]]
    });
    let normal = pairs.map(|[along, against]| along - against);
    let reach = pairs.map(|[along, against]| along.abs() + against.abs());
    let facing = dot(normal, direction);
    let t = dot(normal, p) / facing;
    let sum = dot(reach, p.map(f64::abs)) + t.abs() * dot(reach, direction.map(f64::abs));
    let longest = (0..3).max_by(|&i, &j| direction[i].abs().total_cmp(&direction[j].abs())).unwrap_or(0);
    let ends = [a, b, c].map(|corner| (corner[longest] - origin[longest]) / direction[longest]);
    let low = ends.into_iter().fold(f64::INFINITY, f64::min);
    let high = ends.into_iter().fold(f64::NEG_INFINITY, f64::max);
    (t.clamp(low, high), 1e-14 * sum / facing.abs())
}

/// A point and a few metres around it.
fn nearby(random: &mut Random, [x, y, z]: [f32; 3], size: f32) -> [f32; 3] {
    let d = random.direction();
    [x + size * d[0], y + size * d[1], z + size * d[2]]
}

/// A ray from near the origin to a point of the triangle.
fn aimed(random: &mut Random, triangle: Triangle, near: f32) -> Case {
    let (u, v) = (random.between(0.05, 0.9), random.between(0.05, 0.9));
    let [a, b, c] = triangle;
    let origin = nearby(random, [0.0; 3], near);
    let direction = std::array::from_fn(|axis| {
        let target = a[axis] + u * (b[axis] - a[axis]) + v * (1.0 - u) * (c[axis] - a[axis]);
        target - origin[axis]
    });
    Case { triangle, origin, direction }
}

fn cases(make: impl Fn(&mut Random) -> Case) -> Vec<Case> {
    let mut random = Random::new(0x7472_6961);
    (0..CASES).map(|_| make(&mut random)).collect()
}

/// The largest error of t relative to t, and relative to its bound. Panics where it is beyond.
fn worst(bench: &Bench, name: &str, cases: &[Case]) -> (f64, f64) {
    let (found, _) = run_kernel::<TriangleResult, _>(
        bench.device(),
        &ADS_TEST_TRIANGLE,
        bytemuck::cast_slice(cases),
        cases.len(),
        None,
        cases.len(),
        &TriangleTestConstants { case_count: cases.len() as u32 },
    );
    let (mut hits, mut relative, mut of_bound) = (0, 0.0_f64, 0.0_f64);
    for (case, found) in cases.iter().zip(&found).filter(|(_, found)| found.hit == 1) {
        let (t, rounding) = truth(case);
        let off = (f64::from(found.t) - t).abs();
        assert!(
            off <= f64::from(found.t_error) + rounding,
            "{name}: {off} from {t} is beyond its bound: {found:?}, {case:?}"
        );
        hits += 1;
        if t != 0.0 {
            relative = relative.max(off / t.abs());
        }
        of_bound = of_bound.max(off / f64::from(found.t_error));
    }
    println!("{name}: {hits} hits, at most {relative:.1e} of t and {of_bound:.2} of the bound off");
    assert!(hits > cases.len() / 2, "{name}: {hits} hits of {}", cases.len());
    (relative, of_bound)
}

/// A floor, a wall or a ceiling as large as a world, a few metres away.
fn huge_and_straight(random: &mut Random) -> Case {
    let size = 10.0_f32.powf(random.between(3.0, 7.0));
    let axis = random.bits() as usize % 3;
    let height = random.between(1.0, 30.0) * [1.0, -1.0][random.bits() as usize % 2];
    let angle = random.between(0.0, std::f32::consts::TAU);
    let triangle = [0.0_f32, 2.1, 4.2].map(|turn| {
        let mut corner = [height; 3];
        corner[(axis + 1) % 3] = size * (angle + turn).cos();
        corner[(axis + 2) % 3] = size * (angle + turn).sin();
        corner
    });
    let origin = nearby(random, [0.0; 3], 0.9);
    let mut direction = random.direction().map(|x| 20.0 * x);
    direction[axis] = height;
    Case { triangle, origin, direction }
}

/// A triangle hit at a grazing angle, with one corner at the depth of the origin: the weights of the corners
/// are lost in rounding, and no product with the corner next to the origin hides the distance of the others.
fn grazed(random: &mut Random) -> Case {
    let step = 2.0_f32.powi(-(6 + random.bits() as i32 % 12));
    let scale = [1.0_f32, 3.0, 10.0][random.bits() as usize % 3];
    let (slope, far) = (random.between(0.1, 0.9), 1000.0 * scale);
    let width = random.between(0.5, 2.0);
    // Seen along (0, slope, 1), the first corner is half as far below the ray as the others are above it, or
    // about.
    let triangle = [
        [0.0, -step * random.between(0.5, 2.0), 0.0],
        [width, slope * far + step, far],
        [-width, slope * far + step, far],
    ];
    let turn = random.bits() as usize % 3;
    let turned = |p: [f32; 3]| [p[turn % 3], p[(turn + 1) % 3], p[(turn + 2) % 3]];
    Case { triangle: triangle.map(turned), origin: [0.0; 3], direction: turned([0.0, slope, 1.0]) }
}

#[test]
fn t_is_within_its_bound() {
    let bench = Bench::new();
    let ordinary = cases(|random| {
        let base = random.direction().map(|x| 5.0 * x);
        let triangle = [base, nearby(random, base, 2.0), nearby(random, base, 2.0)];
        aimed(random, triangle, 2.0)
    });
    let (_, of_bound) = worst(&bench, "ordinary", &ordinary);
    assert!(of_bound > 0.02, "a bound that is fifty times too large says little: {of_bound}");
    // Their planes lose digits that their corners keep.
    let needles = cases(|random| {
        let base = random.direction().map(|x| 4.0 * x);
        let far = nearby(random, base, 2.0);
        let middle: [f32; 3] = std::array::from_fn(|axis| 0.5 * (base[axis] + far[axis]));
        let width = 10.0_f32.powf(random.between(-5.0, -1.0));
        let triangle = [base, far, nearby(random, middle, width)];
        aimed(random, triangle, 1.0)
    });
    worst(&bench, "needles", &needles);
    let far = cases(|random| {
        let base = random.direction().map(|x| 1.0e5 * x);
        let triangle = [base, nearby(random, base, 3.0), nearby(random, base, 3.0)];
        aimed(random, triangle, 5.0)
    });
    worst(&bench, "small and far", &far);
    let huge = cases(|random| {
        let size = 10.0_f32.powf(random.between(3.0, 7.0));
        let middle = random.direction().map(|x| 10.0 * x);
        let first = nearby(random, middle, size);
        let second = nearby(random, middle, size);
        // The middle is inside.
        let third: [f32; 3] = std::array::from_fn(|axis| 3.0 * middle[axis] - first[axis] - second[axis]);
        let origin = nearby(random, [0.0; 3], 1.0);
        let target = nearby(random, middle, 1.0);
        let direction = std::array::from_fn(|axis| target[axis] - origin[axis]);
        Case { triangle: [first, second, third], origin, direction }
    });
    worst(&bench, "huge", &huge);
    let tiny = cases(|random| {
        let base = random.direction().map(|x| 1.0e-9 * x);
        let triangle = [base, nearby(random, base, 1.0e-9), nearby(random, base, 1.0e-9)];
        let case = aimed(random, triangle, 1.0e-9);
        Case { direction: case.direction.map(|x| x * 1.0e9), ..case }
    });
    worst(&bench, "a nanometre", &tiny);
    worst(&bench, "grazed", &cases(grazed));
}

/// Mixing corners a thousand kilometres away, as tests by shearing do, is off by metres there.
#[test]
fn floors_as_large_as_worlds_are_where_they_are() {
    let bench = Bench::new();
    let (relative, _) = worst(&bench, "huge and straight", &cases(huge_and_straight));
    assert!(relative < 1e-6, "{relative}");
}
