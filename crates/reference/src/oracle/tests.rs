//! Verdicts of the oracle on single rays and meshes; `watertight` tests that closed ones do not leak.

use super::*;

mod watertight;

/// SplitMix64 generator.
struct Random(u64);

impl Random {
    fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * (self.bits() >> 11) as f64 / (1_u64 << 53) as f64
    }

    fn point(&mut self, center: [f32; 3], radius: f64) -> [f32; 3] {
        center.map(|x| (f64::from(x) + self.between(-radius, radius)) as f32)
    }
}

type Mesh = (Vec<[f32; 3]>, Vec<u32>);

fn sphere(center: [f32; 3], radius: f64, rows: u32) -> Mesh {
    use std::f64::consts::PI;
    let place = |direction: [f64; 3]| {
        std::array::from_fn(|axis| (f64::from(center[axis]) + radius * direction[axis]) as f32)
    };
    let mut positions = vec![place([0.0, 0.0, 1.0])];
    for row in 1..rows {
        let polar = PI * f64::from(row) / f64::from(rows);
        for column in 0..rows {
            let azimuth = 2.0 * PI * f64::from(column) / f64::from(rows);
            positions.push(place([polar.sin() * azimuth.cos(), polar.sin() * azimuth.sin(), polar.cos()]));
        }
    }
    positions.push(place([0.0, 0.0, -1.0]));
    let last = positions.len() as u32 - 1;
    let at = |row: u32, column: u32| 1 + (row - 1) * rows + column % rows;
    let mut indices = Vec::new();
    for column in 0..rows {
        indices.extend([0, at(1, column), at(1, column + 1)]);
        for row in 1..rows - 1 {
            let [a, b, c, d] =
                [at(row, column), at(row + 1, column), at(row + 1, column + 1), at(row, column + 1)];
            indices.extend([a, b, c, a, c, d]);
        }
        indices.extend([at(rows - 1, column), last, at(rows - 1, column + 1)]);
    }
    (positions, indices)
}

fn soup(triangles: &[[[f32; 3]; 3]]) -> Mesh {
    (triangles.as_flattened().to_vec(), (0..triangles.len() as u32 * 3).collect())
}

fn cube() -> Mesh {
    let positions: Vec<[f32; 3]> = (0..8_u32)
        .map(|corner| std::array::from_fn(|axis| if corner >> axis & 1 == 1 { 1.0 } else { -1.0 }))
        .collect();
    let mut indices = Vec::new();
    for axis in 0..3 {
        let (u, v) = (1 << ((axis + 1) % 3), 1 << ((axis + 2) % 3));
        for side in [0, 1 << axis] {
            indices.extend([side, side | u, side | u | v, side, side | u | v, side | v]);
        }
    }
    (positions, indices)
}

fn oracle<'a>((positions, indices): &Mesh) -> Oracle<'a> {
    Oracle::new(positions, indices, None).expect("the mesh is well formed")
}

fn midpoint(a: [f32; 3], b: [f32; 3]) -> [f32; 3] {
    std::array::from_fn(|axis| (0.5 * (f64::from(a[axis]) + f64::from(b[axis]))) as f32)
}

/// From every direction, the ray meets the side that the exact sign of its angle with the normal gives.
#[test]
fn a_back_is_passed_from_behind_alone() {
    let mut random = Random(17);
    let mut passed = 0;
    for _ in 0..2000 {
        let triangle = [(); 3].map(|()| random.point([0.0; 3], 1.0));
        let [a, b, c] = triangle;
        let target = midpoint(midpoint(a, b), c);
        let ray = Ray { culls_back_faces: true, ..Ray::towards(random.point([0.0; 3], 4.0), target) };
        let along =
            exact::normal_along(ray.direction.map(f64::from), triangle.map(|corner| corner.map(f64::from)));
        let mesh = soup(&[triangle]);
        for (back, is_passed) in
            [(Some(Side::Clockwise), along > 0.0), (Some(Side::CounterClockwise), along < 0.0), (None, false)]
        {
            let oracle = oracle(&mesh).with_backs(|_| back);
            let verdict = oracle.closest(&ray);
            if !verdict.ambiguous {
                assert_eq!(verdict.outcome.hit().is_none(), is_passed, "{triangle:?} {ray:?} {back:?}");
                passed += usize::from(is_passed);
            }
            assert!(oracle.closest(&Ray { culls_back_faces: false, ..ray }).outcome.hit().is_some());
            let tested = oracle.replay(&ray).tests;
            assert!(verdict.ambiguous || (tested[0].class == TestClass::BackFace) == is_passed);
        }
    }
    assert!(passed > 1900, "{passed}");
}

/// If rounding may turn a triangle that is seen edge-on, the triangle may be reported, but need not be.
#[test]
fn a_side_that_rounding_decides_is_left_open() {
    let edge_on = [[-1.0, 1.0, 2.0], [1.0, 1.0 + f32::EPSILON, 2.0], [0.0, 2.6, 6.0]];
    let behind = [[-4.0, -4.0, 9.0], [4.0, -4.0, 9.0], [0.0, 8.0, 9.0]];
    let ray = Ray { culls_back_faces: true, ..Ray::towards([-0.25, -1.0, -3.0], [0.25, 3.0, 7.0]) };
    for back in [Side::Clockwise, Side::CounterClockwise] {
        let oracle = oracle(&soup(&[edge_on, behind])).with_backs(|id| (id == 0).then_some(back));
        let verdict = oracle.closest(&ray);
        assert!(verdict.ambiguous && !verdict.miss_allowed, "{verdict:?}");
        let candidates: Vec<_> = verdict.candidates.iter().map(|c| (c.primitive, c.certain)).collect();
        assert_eq!(candidates, [(0, false), (1, true)], "{back:?}");
    }
}

#[test]
fn a_closed_mesh_of_backs_is_open_from_within_and_closed_from_outside() {
    let mut random = Random(23);
    let mesh = sphere([0.3, -0.2, 0.1], 1.0, 9);
    let oracle = oracle(&mesh).with_backs(|_| Some(Side::Clockwise));
    for _ in 0..3000 {
        let (inside, outside) = (random.point([0.3, -0.2, 0.1], 0.3), random.point([0.0; 3], 9.0));
        let distance: f32 = outside.iter().zip([0.3, -0.2, 0.1]).map(|(a, b)| (a - b) * (a - b)).sum();
        if distance < 1.2 {
            continue;
        }
        let culling = |ray: Ray| Ray { culls_back_faces: true, ..ray };
        assert!(!oracle.occluded(&culling(Ray::towards(inside, outside))).occluded);
        let towards = oracle.closest(&culling(Ray::towards(outside, inside)));
        let (_, t) = towards.outcome.hit().expect("the front is met");
        assert!(t < 1.0 && !towards.miss_allowed, "{towards:?}");
    }
}

#[test]
fn a_ray_in_a_triangles_plane_passes_it() {
    let (mut positions, mut indices) = cube();
    for position in &mut positions {
        *position = [position[0] * 4.0, position[1] * 4.0, position[2] * 4.0 + 4.0];
    }
    let blade = positions.len() as u32;
    positions.extend([[-1.0, 0.0, 2.0], [1.0, 0.0, 2.0], [0.0, 0.0, 6.0]]);
    indices.extend([blade, blade + 1, blade + 2]);
    let oracle = oracle(&(positions, indices));
    let ray = Ray::towards([-3.0, 0.0, 4.0], [3.0, 0.0, 4.0]);
    let verdict = oracle.closest(&ray);
    let (primitive, t) = verdict.outcome.hit().expect("the box is hit");
    assert!(primitive < 12);
    assert_eq!(t, 7.0 / 6.0);
    assert!(verdict.ambiguous && !verdict.miss_allowed, "{verdict:?}");
    assert!(verdict.candidates.iter().any(|candidate| candidate.primitive == 12 && !candidate.certain));
}

/// Coordinates are whole numbers that single precision holds, so t is a quotient of two integers. Every
/// second ray nearly lies in the plane, where plain double precision is not enough.
#[test]
fn t_is_that_of_exact_arithmetic() {
    const BOUND: f64 = 1.0 / (1_u64 << 38) as f64;
    let mut random = Random(8);
    let (mut hits, mut worst_of_doubles) = (0, 0.0_f64);
    for index in 0..20_000 {
        let corners: [[f64; 3]; 3] = [(); 3].map(|()| [(); 3].map(|()| random.between(-2e6, 2e6).round()));
        let [a, b, c] = corners;
        let point = |random: &mut Random, low: f64, high: f64| -> [f64; 3] {
            let (s, t) = (random.between(low, high), random.between(low, high));
            std::array::from_fn(|axis| (a[axis] + s * (b[axis] - a[axis]) + t * (c[axis] - a[axis])).round())
        };
        let target = point(&mut random, 0.2, 0.4);
        let origin = if index % 2 == 0 {
            point(&mut random, -0.4, -0.2)
        } else {
            [(); 3].map(|()| random.between(-2e6, 2e6).round())
        };
        let direction: [f64; 3] = std::array::from_fn(|axis| target[axis] - origin[axis]);
        let single = |point: [f64; 3]| point.map(|x| x as f32);
        assert!([origin, direction].iter().all(|point| single(*point).map(f64::from) == *point));

        let whole = |point: [f64; 3]| point.map(|x| x as i128);
        let minus =
            |p: [i128; 3], q: [i128; 3]| -> [i128; 3] { std::array::from_fn(|axis| p[axis] - q[axis]) };
        let dot = |p: [i128; 3], q: [i128; 3]| p[0] * q[0] + p[1] * q[1] + p[2] * q[2];
        let [first, second] = [b, c].map(|corner| minus(whole(corner), whole(a)));
        let normal: [i128; 3] = std::array::from_fn(|axis| {
            let (next, last) = ((axis + 1) % 3, (axis + 2) % 3);
            first[next] * second[last] - first[last] * second[next]
        });
        let offset = dot(normal, minus(whole(a), whole(origin)));
        let along = dot(normal, whole(direction));
        let exact = offset as f64 / along as f64;

        let ray = Ray::new(single(origin), single(direction));
        let Some((_, t)) = oracle(&soup(&[corners.map(single)])).closest(&ray).outcome.hit() else {
            continue;
        };
        hits += 1;
        assert!((t / exact - 1.0).abs() < BOUND, "{t} where {exact} is exact: {corners:?} {ray:?}");
        let normal = normal.map(|x| x as f64);
        let dot = |p: [f64; 3]| normal[0] * p[0] + normal[1] * p[1] + normal[2] * p[2];
        let doubles = dot(std::array::from_fn(|axis| a[axis] - origin[axis])) / dot(direction);
        worst_of_doubles = worst_of_doubles.max((doubles / exact - 1.0).abs());
    }
    assert!(hits > 10_000, "{hits} hits");
    // The comparison would notice plain double precision.
    assert!(worst_of_doubles > BOUND, "{worst_of_doubles}");
}

#[test]
fn triangles_without_area_are_never_hit() {
    let flat: [[[f32; 3]; 3]; 4] = [
        [[0.0, 0.0, 5.0], [1.0, 0.0, 5.0], [2.0, 0.0, 5.0]],
        [[0.0, 0.0, 5.0], [0.0, 0.0, 5.0], [1.0, 0.0, 5.0]],
        [[1.0, 1.0, 5.0]; 3],
        [
            [-1_113.454_6, -79.049_614, -56.243_19],
            [-1_113.454_6, -87.092_27, -56.243_19],
            [-1_113.454_6, -79.209_015, -56.243_19],
        ],
    ];
    let mut random = Random(5);
    for triangle in flat {
        let oracle = oracle(&soup(&[triangle]));
        for index in 0..2000 {
            let [a, b, _] = triangle;
            let s = index as f32 / 2000.0;
            let target: [f32; 3] = std::array::from_fn(|axis| a[axis] + s * (b[axis] - a[axis]));
            let verdict = oracle.closest(&Ray::towards(random.point([0.0; 3], 1.0), target));
            assert_eq!(verdict.outcome, Outcome::Miss);
            assert!(verdict.miss_allowed);
        }
    }
}

#[test]
fn the_hierarchy_and_brute_force_agree_on_everything() {
    let mut random = Random(6);
    for (center, rows) in [([0.0; 3], 24), ([1000.0, -20.0, 3.0], 16)] {
        let (mut positions, mut indices) = sphere(center, 2.0, rows);
        for _ in 0..400 {
            let a = random.point(center, 3.0);
            let size = 10.0_f64.powf(random.between(-7.0, 1.0));
            let first = positions.len() as u32;
            positions.extend([a, random.point(a, size), random.point(a, size)]);
            indices.extend([first, first + 1, first + 2]);
        }
        let fast = Oracle::new(&positions, &indices, None).expect("well formed");
        let slow = Oracle::brute_force(&positions, &indices, None).expect("well formed");
        assert!(fast.bvh.is_some() && slow.bvh.is_none());
        let mut rays = Vec::new();
        for index in 0..9000 {
            let origin = random.point(center, 4.0);
            let corners = indices.as_chunks::<3>().0[random.bits() as usize % (indices.len() / 3)];
            let [a, b, c] = corners.map(|corner| positions[corner as usize]);
            let target = match index % 4 {
                0 => a,
                1 => midpoint(a, b),
                2 => midpoint(midpoint(a, b), c),
                _ => random.point(center, 3.0),
            };
            let mut ray = Ray::towards(origin, target);
            if index % 5 == 0 {
                ray.t_min = 0.5;
                ray.t_max = 1.0;
            }
            if index % 7 == 0 {
                ray.exclude_primitive = Some(random.bits() as u32 % (indices.len() as u32 / 3));
            }
            if index % 11 == 0 {
                ray.direction[index % 3] = 0.0;
            }
            rays.push(ray);
        }
        let (fast, slow) = (fast.closest_batch(&rays), slow.closest_batch(&rays));
        let hits = fast.iter().filter(|verdict| verdict.outcome != Outcome::Miss).count();
        assert!(hits > 4000 && hits < 9000, "{hits} hits");
        assert!(fast.iter().any(|verdict| verdict.ambiguous));
        for ((fast, slow), ray) in fast.iter().zip(&slow).zip(&rays) {
            assert_eq!(fast, slow, "{ray:?}");
        }
    }
}

#[test]
fn most_rays_are_unambiguous_on_a_fine_mesh() {
    let mesh = sphere([0.0; 3], 2.0, 400);
    let oracle = oracle(&mesh);
    let mut random = Random(7);
    let rays: Vec<Ray> =
        (0..20_000).map(|_| Ray::new(random.point([0.0; 3], 1.0), random.point([0.0; 3], 1.0))).collect();
    let ambiguous = oracle.closest_batch(&rays).iter().filter(|verdict| verdict.ambiguous).count();
    assert!(ambiguous < 40, "{ambiguous} of 20000 rays are ambiguous");
}

#[test]
fn coplanar_twins_go_to_the_lowest_id_and_are_ambiguous() {
    let triangle = [[-1.0, -1.0, 5.0], [1.0, -1.0, 5.0], [0.0, 1.0, 5.0]];
    let verdict = oracle(&soup(&[triangle, triangle])).closest(&Ray::new([0.0; 3], [0.0, 0.0, 1.0]));
    assert_eq!(verdict.outcome.hit(), Some((0, 5.0)));
    assert!(verdict.ambiguous && !verdict.miss_allowed);
    assert_eq!(verdict.candidates.iter().map(|c| c.primitive).collect::<Vec<_>>(), [0, 1]);
}

#[test]
fn the_range_is_open_and_its_ends_are_ambiguous() {
    let oracle = oracle(&soup(&[[[-1.0, -1.0, 5.0], [1.0, -1.0, 5.0], [0.0, 1.0, 5.0]]]));
    let ray = Ray::new([0.0; 3], [0.0, 0.0, 1.0]);
    for (t_min, t_max, hit, ambiguous) in [
        (0.0, 5.0, false, true),
        (5.0, 9.0, false, true),
        (0.0, 5.000_000_5, true, true),
        (0.0, 5.1, true, false),
        (4.9, 9.0, true, false),
        (0.0, 4.9, false, false),
        (9.0, 4.0, false, false),
    ] {
        let verdict = oracle.closest(&Ray { t_min, t_max, ..ray });
        assert_eq!(verdict.outcome.hit().is_some(), hit, "{t_min} {t_max}");
        assert_eq!(verdict.ambiguous, ambiguous, "{t_min} {t_max}");
        let occlusion = oracle.occluded(&Ray { t_min, t_max, ..ray });
        assert_eq!(occlusion, Occlusion { occluded: hit, ambiguous });
    }
}

#[test]
fn silhouettes_allow_a_miss_and_shared_edges_do_not() {
    let left = [[0.0, -1.0, 5.0], [0.0, 1.0, 5.0], [-1.0, 0.0, 5.0]];
    let right = [[0.0, 1.0, 5.0], [0.0, -1.0, 5.0], [1.0, 0.0, 5.0]];
    let fold = [[0.0, 1.0, 5.0], [0.0, -1.0, 5.0], [-1.0, 0.0, 6.0]];
    let ray = Ray::new([0.0; 3], [0.0, 0.0, 1.0]);
    for (triangles, miss_allowed) in [
        (vec![left], true),
        (vec![left, right], false),
        (vec![left, fold], true),
        // Three triangles at one edge do not cancel; nothing is guaranteed there.
        (vec![left, fold, right], true),
        (vec![left, left, right, right], false),
    ] {
        let verdict = oracle(&soup(&triangles)).closest(&ray);
        assert!(verdict.outcome.hit().is_some() && verdict.ambiguous);
        assert_eq!(verdict.miss_allowed, miss_allowed, "{triangles:?}");
    }
}

#[test]
fn the_alpha_test_and_the_excluded_primitive_are_respected() {
    let triangle = |z: f32| [[-1.0, -1.0, z], [1.0, -1.0, z], [0.0, 1.0, z]];
    let (positions, indices) = soup(&[triangle(1.0), triangle(2.0), triangle(3.0)]);
    let accept = |primitive: u32, weights: [f64; 2]| {
        assert!((weights[0] - 0.25).abs() < 1e-12 && (weights[1] - 0.5).abs() < 1e-12);
        primitive != 0
    };
    let oracle = Oracle::new(&positions, &indices, Some(&accept)).expect("well formed");
    let ray = Ray::new([0.0; 3], [0.0, 0.0, 1.0]);
    assert_eq!(oracle.closest(&ray).outcome.hit(), Some((1, 2.0)));
    let ray = Ray { exclude_primitive: Some(1), ..ray };
    assert_eq!(oracle.closest(&ray).outcome.hit(), Some((2, 3.0)));
}

#[test]
fn bad_input_is_refused_or_dropped() {
    let positions = [[0.0; 3], [1.0, 0.0, 0.0], [0.0, f32::NAN, 0.0], [0.0, 1.0, 0.0], [2e18, 0.0, 0.0]];
    let refused = Oracle::new(&positions, &[0, 1], None).map(|_| ());
    assert_eq!(refused, Err(OracleError::IncompleteTriangle { indices: 2 }));
    let refused = Oracle::new(&positions, &[0, 1, 5], None).map(|_| ());
    assert_eq!(refused, Err(OracleError::IndexOutOfRange { primitive: 0, index: 5, positions: 5 }));
    let oracle = Oracle::new(&positions, &[0, 1, 2, 0, 1, 4, 0, 1, 0, 0, 1, 3], None).expect("well formed");
    assert_eq!((oracle.dropped(), oracle.collapsed(), oracle.triangle_count()), (2, 1, 1));
    let ray = Ray::new([0.25, 0.25, -1.0], [0.0, 0.0, 1.0]);
    assert_eq!(oracle.closest(&ray).outcome.hit(), Some((3, 1.0)));
    for bad in [f32::NAN, f32::INFINITY] {
        let mut invalid = [ray; 3];
        invalid[0].origin[1] = bad;
        invalid[1].direction[2] = bad;
        invalid[2].direction = [0.0; 3];
        for ray in invalid {
            assert!(!oracle.closest(&ray).ambiguous && oracle.closest(&ray).outcome == Outcome::Miss);
        }
    }
    let empty = Oracle::new(&[], &[], None).expect("a scene may be empty");
    assert_eq!(empty.closest(&ray).outcome, Outcome::Miss);
}

#[test]
fn a_hit_nearer_than_the_devices_bound_may_be_missed() {
    // The device bounds the error of this t by 1.1e-8 m and takes the hit for the surface on which the ray
    // starts.
    let triangle = [
        [-0.246_709_5, -0.341_158_4, -0.676_100_1],
        [-0.234_160_1, -0.349_085, -0.668_141_3],
        [-0.234_160_1, -0.352_709, -0.673_127_9],
    ];
    let oracle = Oracle::new(&triangle, &[0, 1, 2], None).expect("one triangle");
    let ray =
        Ray::new([-0.236_933_11, -0.349_243_1, -0.672_527_55], [0.387_222_74, 0.706_959, -0.591_834_07]);
    let verdict = oracle.closest(&ray);
    let t = verdict.outcome.hit().expect("in exact arithmetic").1;
    assert!((1.06e-8..1.07e-8).contains(&t), "{t}");
    assert!(verdict.ambiguous && verdict.miss_allowed, "{verdict:?}");
    // Ten times as far away nothing is uncertain.
    let before: [f32; 3] = std::array::from_fn(|axis| ray.origin[axis] - 1.0e-6 * ray.direction[axis]);
    let verdict = oracle.closest(&Ray::new(before, ray.direction));
    assert!(verdict.outcome != Outcome::Miss && !verdict.ambiguous, "{verdict:?}");
}
