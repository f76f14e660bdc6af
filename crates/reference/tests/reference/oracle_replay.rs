//! Classes of the oracle on inputs whose class is known by construction, and the replay of a ray.

use rasray_reference::oracle::{Oracle, OracleReplay, Outcome, Ray, TestClass};

type Triangle = [[f32; 3]; 3];

/// Counter-clockwise from the origin's side reversed; its plane is z = 5.
const TRIANGLE: Triangle = [[-1.0, -1.0, 5.0], [1.0, -1.0, 5.0], [0.0, 1.0, 5.0]];

fn replay(triangles: &[Triangle], ray: &Ray) -> OracleReplay {
    let indices: Vec<u32> = (0..3 * triangles.len() as u32).collect();
    Oracle::new(triangles.as_flattened(), &indices, None).expect("well formed").replay(ray)
}

fn ahead(x: f32, y: f32) -> Ray {
    Ray::new([x, y, 0.0], [0.0, 0.0, 1.0])
}

/// Returns the class of the only triangle, the number of its edges that the ray intersects exactly, true if
/// the ray is ambiguous, and true if a miss is admissible.
fn evaluate(triangle: Triangle, ray: &Ray) -> (TestClass, usize, bool, bool) {
    let replay = replay(&[triangle], ray);
    let (class, zeros) = replay.tests.first().map_or((TestClass::Outside, 0), |tested| {
        (tested.class, tested.signs.iter().filter(|sign| **sign == 0).count())
    });
    (class, zeros, replay.verdict.ambiguous, replay.verdict.miss_allowed)
}

/// Rows of (ray, class, edges intersected exactly, ambiguous, a miss is admissible).
fn table() -> Vec<(&'static str, Ray, TestClass, usize, bool, bool)> {
    // Head-on nothing is rounded, so that a unit in the last place decides. At a slant it does not.
    let slanted = |y: f32| Ray::new([0.3, 0.1, 0.0], [-0.3, y, 5.0]);
    vec![
        ("inside", ahead(0.0, 0.0), TestClass::Certain, 0, false, false),
        ("on an edge", ahead(0.0, -1.0), TestClass::Uncertain, 1, true, true),
        ("on a slanted edge", ahead(-0.5, 0.0), TestClass::Uncertain, 1, true, true),
        ("on a vertex", ahead(1.0, -1.0), TestClass::Uncertain, 2, true, true),
        ("a unit inside, head-on", ahead(0.0, -(1.0_f32.next_down())), TestClass::Certain, 0, false, false),
        ("a unit outside, head-on", ahead(0.0, -(1.0_f32.next_up())), TestClass::Outside, 0, false, true),
        // 0.1 and 1.1 in single precision: y is -1.000000022 and -0.999999903.
        ("barely outside, at a slant", slanted(-1.1), TestClass::Possible, 0, true, true),
        ("barely inside, at a slant", slanted(-(1.1_f32.next_down())), TestClass::Uncertain, 0, true, true),
        ("far beside", ahead(3.0, 0.0), TestClass::Outside, 0, false, true),
        ("in its plane", Ray::new([-3.0, 0.0, 5.0], [1.0, 0.0, 0.0]), TestClass::InPlane, 3, true, true),
        ("behind", Ray::new([0.0, 0.0, 6.0], [0.0, 0.0, 1.0]), TestClass::OutOfRange, 0, false, true),
        (
            "excluded",
            Ray { exclude_primitive: Some(0), ..ahead(0.0, 0.0) },
            TestClass::Excluded,
            0,
            false,
            true,
        ),
        ("range ends on it", Ray { t_max: 5.0, ..ahead(0.0, 0.0) }, TestClass::Possible, 0, true, true),
    ]
}

#[test]
fn classes_of_constructed_rays() {
    for (name, ray, class, zeros, ambiguous, miss_allowed) in table() {
        assert_eq!(evaluate(TRIANGLE, &ray), (class, zeros, ambiguous, miss_allowed), "{name}");
    }
}

fn fits(triangle: Triangle) -> bool {
    table().iter().all(|(_, ray, class, zeros, ambiguous, miss_allowed)| {
        evaluate(triangle, ray) == (*class, *zeros, *ambiguous, *miss_allowed)
    })
}

/// The table distinguishes the true triangle from one whose vertices are off by a few units in the last
/// place.
#[test]
fn a_triangle_moved_by_rounding_does_not_fit_the_table() {
    assert!(fits(TRIANGLE));
    let nudge = |x: f32| f32::from_bits(x.to_bits() + 2);
    for vertex in 0..3 {
        for axis in [1, 2] {
            let mut moved = TRIANGLE;
            moved[vertex][axis] = nudge(moved[vertex][axis]);
            assert!(!fits(moved), "vertex {vertex}, axis {axis}");
        }
    }
}

/// Returns the sign of the edge determinant in plain double precision.
fn rounded_sign(ray: &Ray, a: [f32; 3], b: [f32; 3]) -> i32 {
    let (d, o) = (ray.direction.map(f64::from), ray.origin.map(f64::from));
    let relative = |p: [f32; 3]| -> [f64; 3] { std::array::from_fn(|axis| f64::from(p[axis]) - o[axis]) };
    let (a, b) = (relative(a), relative(b));
    let value = d[0] * (a[1] * b[2] - a[2] * b[1])
        + d[1] * (a[2] * b[0] - a[0] * b[2])
        + d[2] * (a[0] * b[1] - a[1] * b[0]);
    i32::from(value > 0.0) - i32::from(value < 0.0)
}

#[test]
fn signs_are_exact_where_double_precision_is_not() {
    let ray = Ray::new([1.0e18, 1.0e18, 0.0], [1.0, 1.0, 0.0]);
    let a = [0.0, 0.0, 1.0];
    let mut exact = Vec::new();
    for shift in [f32::from_bits(1), 0.0, -f32::from_bits(1)] {
        let b = [shift, 0.0, -1.0];
        // The edge opposite of vertex 2 runs from a to b.
        let triangle = [a, b, [1.0e17, -1.0e17, 0.0]];
        let tested = replay(&[triangle], &Ray { t_min: f32::MIN, ..ray }).tests;
        assert_eq!(tested.len(), 1, "{tested:?}");
        exact.push(tested[0].signs[2]);
        assert_eq!(rounded_sign(&ray, a, b), 0, "double precision sees no difference");
    }
    assert_eq!((exact[1], exact[0] * exact[2]), (0, -1), "{exact:?}");
}

#[test]
fn a_replay_lists_what_was_tested_and_ends_in_the_verdict() {
    let wall = |z: f32| TRIANGLE.map(|[x, y, _]| [x, y, z]);
    let mut triangles: Vec<Triangle> = (1..=100).rev().map(|z| wall(z as f32)).collect();
    triangles.push([[40.0, 0.0, 1.0], [41.0, 0.0, 1.0], [40.0, 1.0, 1.0]]);
    let replay = replay(&triangles, &ahead(0.0, 0.0));
    assert_eq!(replay.verdict.outcome.hit(), Some((99, 1.0)));
    assert!(!replay.nodes.is_empty() && replay.nodes[0].node == 0, "a hierarchy is used");
    let nearest = replay.tests.iter().find(|tested| tested.primitive == 99).expect("the hit was tested");
    assert_eq!((nearest.class, nearest.t.map(|[t, ..]| t)), (TestClass::Certain, Some(1.0)));
    // The far walls are culled as a whole, not tested one by one.
    assert!(replay.tests.len() + replay.outside < 20, "{replay}");
    let text = replay.to_string();
    assert!(text.contains("triangle 99: edges") && text.ends_with("hit: triangle 99, t 1\n"), "{text}");
    let miss = self::replay(&triangles, &ahead(9.0, 9.0));
    assert_eq!(miss.verdict.outcome, Outcome::Miss);
    assert!(miss.to_string().ends_with("miss\n"));
}

/// The classes match the verdict: the nearest hit among them is the outcome.
#[test]
fn the_classes_agree_with_the_verdict() {
    let mut triangles = Vec::new();
    for layer in 0..40 {
        let z = 2.0 + layer as f32 * 0.25;
        triangles.push([[-1.0, -1.0, z], [1.0, -1.0, z], [1.0, 1.0, z]]);
        triangles.push([[-1.0, -1.0, z], [1.0, 1.0, z], [-1.0, 1.0, z]]);
    }
    let mut uncertain = 0;
    for step in 0..400 {
        let (x, y) = ((step % 20) as f32 * 0.1 - 1.0, (step / 20) as f32 * 0.1 - 1.0);
        let replay = replay(&triangles, &Ray::new([x * 0.5, y * 0.5, 0.0], [x * 0.25, y * 0.25, 1.0]));
        let hits =
            replay.tests.iter().filter(|t| matches!(t.class, TestClass::Certain | TestClass::Uncertain));
        let nearest =
            hits.clone().filter_map(|tested| tested.t.map(|[t, ..]| t)).fold(f64::INFINITY, f64::min);
        let expected = replay.verdict.outcome.hit().map_or(f64::INFINITY, |(_, t)| t);
        assert_eq!(nearest, expected, "{replay}");
        let unsure = hits.clone().any(|tested| tested.class == TestClass::Uncertain);
        uncertain += usize::from(unsure);
        assert!(!unsure || replay.verdict.ambiguous, "{replay}");
    }
    assert!(uncertain >= 20, "{uncertain} rays run along the diagonal");
}
