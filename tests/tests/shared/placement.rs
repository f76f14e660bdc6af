//! Placement of views and cells by header passes (`ads/placement.glsl`), on the device and held against
//! arithmetic in f64.

use bytemuck::cast_slice;
use rasray_shaders_glsl::ADS_TEST_PLACEMENT;
use rasray_shaders_glsl::constants::ads::{ORIGIN_LIMIT, PLACEMENT_MARGIN};
use rasray_shaders_glsl::records::test_kernels::{
    PlacementCase as Case, PlacementResult, PlacementTestConstants,
};
use rasray_tests::harness::Bench;
use rasray_tests::visits::run_kernel;

const BOUNDS: [[f32; 3]; 2] = [[-2.0, -1.5, 0.0], [2.0, 1.5, 8.0]];

fn placed(cases: &[Case]) -> Vec<PlacementResult> {
    let bench = Bench::new();
    let count = cases.len();
    let constants = PlacementTestConstants { case_count: count as u32 };
    run_kernel(bench.device(), &ADS_TEST_PLACEMENT, cast_slice(cases), count, None, count, &constants).0
}

/// The centres of faces for eyes and bounds.
fn centres(cases: &[([f32; 3], [[f32; 3]; 2])]) -> Vec<[f32; 3]> {
    let cases: Vec<Case> =
        cases.iter().map(|&(eye, bounds)| Case { bounds, around: bounds, eye, cells: [4; 3] }).collect();
    placed(&cases).iter().map(|placed| placed.centre).collect()
}

fn farthest(of: impl Fn(usize) -> f32) -> f32 {
    (0..3).map(of).fold(0.0, f32::max)
}

#[test]
fn an_eye_within_the_bounds_is_the_centre() {
    let eyes = [[0.0, 0.0, 1.0], [2.0, 1.0, 8.0], [-1.9, 0.0, 0.1]];
    assert_eq!(centres(&eyes.map(|eye| (eye, BOUNDS))), eyes);
}

#[test]
fn an_eye_outside_moves_into_the_inner_half() {
    let found = centres(&[([0.5, 0.25, 12.0], BOUNDS), ([3.0, -7.0, 4.0], BOUNDS)]);
    let margin = PLACEMENT_MARGIN;
    assert_eq!(found, [[0.5, 0.25, 8.0 - 8.0 * margin], [2.0 - 4.0 * margin, -1.5 + 3.0 * margin, 4.0]]);
}

#[test]
fn rays_from_the_eye_are_never_too_far_from_the_centre() {
    let mut cases = vec![([0.0, 0.0, 1.0e3], BOUNDS)];
    for distance in [3.0, 10.0, 28.0, 40.0, 1.0e3, 1.0e6, 1.0e12] {
        for direction in [[1.0, 0.0, 0.0], [0.0, -1.0, 0.0], [0.3, 0.2, 1.0], [-1.0, 1.0, -1.0]] {
            cases.push((direction.map(|x: f32| x * distance + 0.5), BOUNDS));
        }
    }
    // Distance of the eye from the centre over that of the geometry, along an axis.
    let ratios: Vec<f32> = centres(&cases)
        .iter()
        .zip(&cases)
        .map(|(centre, (eye, bounds))| {
            farthest(|axis| (eye[axis] - centre[axis]).abs())
                / farthest(|axis| (bounds[1][axis] - centre[axis]).max(centre[axis] - bounds[0][axis]))
        })
        .collect();
    assert!(ratios.iter().all(|ratio| *ratio < 3.6), "{ratios:?}");
    // No farther from the geometry than that asks for.
    assert!(ratios[0] > 3.4, "{}", ratios[0]);
}

/// Bounds without an inside, or of nothing, make no centre worse than the eye.
#[test]
fn odd_bounds_leave_the_eye() {
    let mut cases = Vec::new();
    for bounds in [
        [[0.0; 3]; 2],
        [[4.0, 0.0, 0.0], [4.0, 2.5, 3.5]],
        [[-10.0, -10.0, 0.0], [10.0, 10.0, 2.0]],
        [[-3.0e38; 3], [3.0e38; 3]],
    ] {
        cases.extend([[1.0, 2.0, 30.0], [-5.0, 0.0, 3.0]].map(|eye| (eye, bounds)));
    }
    let eyes: Vec<[f32; 3]> = cases.iter().map(|case| case.0).collect();
    assert_eq!(centres(&cases), eyes);
}

/// Thick bounds have it within, flat ones beside them; it is a number for every size that is one.
#[test]
fn a_centre_that_does_not_follow_the_eye_is_within_bounds_or_beside_flat_ones() {
    let middle = |bounds: [[f32; 3]; 2]| {
        let cases = [[1.0, 2.0, 30.0], [-5.0, 0.0, 3.0]].map(|eye| Case {
            bounds,
            around: bounds,
            eye,
            cells: [4; 3],
        });
        let found = placed(&cases);
        assert_eq!(found[0].middle, found[1].middle, "{bounds:?}: the eye does not matter");
        found[0].middle
    };
    let within = |bounds: [[f32; 3]; 2]| {
        let at = middle(bounds);
        [0, 1, 2].map(|axis| bounds[0][axis] < at[axis] && at[axis] < bounds[1][axis])
    };
    assert_eq!(within(BOUNDS), [true; 3]);
    assert_eq!(within([[-3.0e38; 3], [3.0e38; 3]]), [true; 3]);
    assert_eq!(within([[4.0, 0.0, 0.0], [4.0, 2.5, 3.5]]), [false, true, true]);
    assert_eq!(middle([[4.0, 0.0, 0.0], [4.0, 2.5, 3.5]])[0], 5.75);
    assert_eq!(middle([[-10.0, -10.0, 0.0], [10.0, 10.0, 2.0]])[2], 12.0);
    assert_eq!(middle([[1.0; 3]; 2]), [1.0; 3]);
}

/// Every corner lies within the first and the last cell by more than the margin of a cell, whatever the eye.
#[test]
fn cells_hold_the_geometry_with_its_margins() {
    let mut cases = Vec::new();
    for (bounds, cells) in [
        ([[-1.0, 0.0, 2.0], [3.0, 2.0, 3.0]], [20, 12, 8]),
        ([[-1.0, 0.0, 2.0], [3.0, 2.0, 3.0]], [1, 1, 1]),
        ([[0.0; 3], [5.0, 0.0, 3.0]], [28, 4, 16]),
        ([[0.0; 3], [5.0, 0.0, 3.0]], [1024, 1024, 1024]),
        ([[1.0e6; 3], [1.0e6 + 1.0; 3]], [16; 3]),
        ([[1.0e-20; 3], [3.0e-20; 3]], [16; 3]),
        ([[-2.0e38; 3], [2.0e38; 3]], [16; 3]),
        ([[1.0; 3]; 2], [4; 3]),
    ] {
        cases.extend([0.0, 10.0, 1.0e3, 1.0e9].map(|away| Case {
            bounds,
            around: bounds,
            eye: [away; 3],
            cells,
        }));
    }
    for (at, case) in placed(&cases).iter().zip(&cases) {
        for axis in 0..3 {
            let in_cells = |x: f32| {
                (f64::from(x) - f64::from(at.box_centre[axis]) - f64::from(at.box_lower[axis]))
                    * f64::from(at.box_per_metre[axis])
            };
            let margin = f64::from(at.box_rounding) * f64::from(at.box_per_metre[axis]);
            assert!(at.box_per_metre[axis].is_normal() && margin > 0.0, "{case:?}: {at:?}");
            let (first, last) = (in_cells(case.bounds[0][axis]), in_cells(case.bounds[1][axis]));
            assert!(first > 2.0 * margin, "{case:?}: {first} {margin}");
            assert!(last < f64::from(case.cells[axis]) - 2.0 * margin, "{case:?}: {last} {margin}");
        }
        if case.bounds[0] == case.bounds[1] {
            // A box without size has nothing but margins.
            continue;
        }
        let most = case.cells.into_iter().max().expect("three axes");
        let axis = case.cells.iter().position(|n| *n == most).expect("the largest");
        assert!(
            at.box_rounding * at.box_per_metre[axis] <= 0.126,
            "margins are wider than a share of a cell"
        );
    }
}

/// Cells of a part have margins for rays from anywhere in the whole, and those of a whole none that it does
/// not need.
#[test]
fn rays_may_start_anywhere_around_a_part() {
    let bounds = [[-1.0, 0.0, -1.0], [1.0, 2.0, 1.0]];
    let around = [[-100.0, -1.0, -100.0], [100.0, 2.0, 50.0]];
    let eye = [3.0, 1.0, 0.0];
    let part = Case { bounds, around, eye, cells: [64; 3] };
    let whole = Case { around: bounds, ..part };
    let far = Case { eye: [0.0, 1.0, -100.0], ..whole };
    let many = Case { cells: [1024; 3], ..part };
    let [part, whole, far, many] = placed(&[part, whole, far, many]).try_into().expect("four");
    assert_eq!(whole.box_reach, 1.0);
    assert!(part.box_reach * ORIGIN_LIMIT > 100.0, "{part:?}");
    // As for an eye that far away.
    assert_eq!((part.box_reach, part.box_lower), (far.box_reach, far.box_lower));
    assert!(many.box_rounding * many.box_per_metre[0] <= 0.126, "{many:?}");
}

#[test]
fn cubes_hold_the_bounds() {
    let cases = [
        [[-1.0, -2.0, 0.5], [1.0, 3.0, 0.5]],
        [[1.0e5, -1.0e5, 0.0], [1.0e5 + 2.0, -1.0e5 + 2.0, 2.0]],
        [[1.0e6, -1.0e6, 0.0], [1.0e6 + 1.0, -1.0e6 + 1.0, 1.0]],
        [[1.0e9, 0.0, 0.0], [1.0e9, 0.0, 0.0]],
        [[-1.8e18; 3], [1.8e18; 3]],
        [[0.0; 3]; 2],
    ]
    .map(|bounds| Case { bounds, around: bounds, eye: [0.0; 3], cells: [1; 3] });
    for (at, Case { bounds, .. }) in placed(&cases).iter().zip(&cases) {
        assert!(at.cube_side > 0.0 && at.cube_side.is_finite());
        for axis in 0..3 {
            let (lower, side) = (f64::from(at.cube_lower[axis]), f64::from(at.cube_side));
            assert!(lower <= f64::from(bounds[0][axis]), "{bounds:?}: {at:?}");
            assert!(lower + side >= f64::from(bounds[1][axis]), "{bounds:?}: {at:?}");
        }
    }
}
