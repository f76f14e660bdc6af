//! The traversal over a flat grid of layered depth cubes: stopped and resumed at any square, it goes on as if
//! it had not been, columns without rows included.

use rasray_ads::Ray;
use rasray_shaders_glsl::LDC_TEST_MARCH;
use rasray_shaders_glsl::records::test_kernels::SquareMarchTestConstants;
use rasray_tests::harness::Bench;
use rasray_tests::random::Random;
use rasray_tests::visits::{run_kernel, runs};

/// A square, and how many rows its column has left; none or less where the column has none.
type Visit = [i32; 3];

/// Rays through the surroundings of an area from `first` to `last`: across it, close along its borders, and
/// through its corners, where a column is touched by rounding alone.
fn rays(random: &mut Random, first: i32, last: i32) -> Vec<Ray> {
    let (low, high) = (first as f32, (last + 1) as f32);
    let side = high - low;
    let mut rays = Vec::new();
    for k in 0..3000 {
        let mut through = [random.between(low, high), random.between(low, high)];
        if k % 3 > 0 {
            through[k % 2] = if k / 2 % 2 == 0 { low } else { high };
        }
        if k % 3 > 1 {
            through[(k + 1) % 2] = through[(k + 1) % 2].round();
        }
        let [x, y, _] = random.direction();
        let back = random.between(0.0, 2.0) * side;
        let ray = Ray::new([through[0] - back * x, through[1] - back * y, 0.0], [x, y, 0.0]);
        rays.push(Ray { t_min: 0.0, t_max: back + random.between(0.0, 2.0) * side, ..ray });
    }
    rays
}

#[test]
fn a_traversal_resumes_wherever_it_was_stopped() {
    let bench = Bench::new();
    let mut random = Random::new(0x70_6175_7365);
    // The first block, one within, and the last one of the largest view.
    for (first, last) in [(0, 7), (8, 15), (8184, 8191)] {
        let rays = rays(&mut random, first, last);
        let limit = 64_usize;
        let ray_count = rays.len() as u32;
        let constants = SquareMarchTestConstants { ray_count, first, last, limit: limit as u32 };
        let (found, counts) = run_kernel::<Visit, _>(
            bench.device(),
            &LDC_TEST_MARCH,
            bytemuck::cast_slice(&rays),
            2 * rays.len() * limit,
            Some(2 * rays.len()),
            rays.len(),
            &constants,
        );
        let traversals = runs(&found, &counts, limit);
        // Squares; columns without rows, and of those such as stand before the first row or past the last, by
        // side.
        let (mut squares, mut without_rows, mut outside) = (0, 0, [0; 2]);
        for (ray, traversal) in rays.iter().zip(traversals.chunks(2)) {
            let [Some(whole), Some(stopped)] = traversal else {
                panic!("{ray:?} visits more than {limit} squares")
            };
            assert_eq!(whole, stopped, "{ray:?}, squares {first} to {last}");
            squares += whole.len();
            for &[x, y, rows] in whole {
                without_rows += usize::from(rows <= 0);
                for (side, place) in [x, y].into_iter().enumerate() {
                    outside[side] += usize::from(!(first..=last).contains(&place));
                }
            }
        }
        println!(
            "{first} to {last}: {squares} squares, {without_rows} columns without rows, {outside:?} outside"
        );
        assert!(squares > 2 * rays.len() && without_rows > 200);
        assert!(outside.iter().all(|&count| count > 50), "columns are along both sides");
    }
}
