//! The bucket function: monotone, defined for every range, the same number on both sides.

use proptest::prelude::*;
use proptest::strategy::ValueTree;
use proptest::test_runner::{Config, RngAlgorithm, TestRng, TestRunner};
use rasray_shaders_glsl::ADS_TEST_BUCKET;
use rasray_shaders_glsl::records::test_kernels::{BucketCase as Case, BucketTestConstants};
use rasray_tests::harness::Bench;
use rasray_tests::visits::run_kernel;

/// The scale of `ads/bucket.glsl`, by its arithmetic.
fn scale(z_min: f32, z_max: f32, buckets: u32) -> f32 {
    let range = z_max - z_min;
    if range <= z_max * 9.536_743e-7 {
        return 0.0;
    }
    let exponent = (range.to_bits() >> 23).clamp(1, 236);
    let divisor = ((range.to_bits() & 0x007F_FFFF | 0x0080_0000) >> 8) + 1;
    (u32::MAX / divisor) as f32 * buckets as f32 * f32::from_bits((237 - exponent) << 23)
}

fn expected(case: &Case) -> u32 {
    let position = (case.z - case.z_min) * scale(case.z_min, case.z_max, case.buckets);
    position.clamp(0.0, case.buckets as f32 - 1.0) as u32
}

fn on_device(bench: &Bench, cases: &[Case]) -> Vec<u32> {
    let bytes = bytemuck::cast_slice(cases);
    let constants = BucketTestConstants { case_count: cases.len() as u32 };
    run_kernel::<u32, _>(bench.device(), &ADS_TEST_BUCKET, bytes, cases.len(), None, cases.len(), &constants)
        .0
}

/// A range of depths and depths within it, ascending.
fn cells() -> impl Strategy<Value = (f32, f32, Vec<f32>, u32)> {
    let depth = (-30.0_f32..30.0).prop_map(f32::exp2);
    let relative = prop_oneof![Just(0.0_f32), (-30.0_f32..20.0).prop_map(f32::exp2)];
    let shares = prop::collection::vec(0.0_f32..=1.0, 0..30);
    (depth, relative, shares, 1_u32..=32).prop_map(|(z_min, relative, shares, buckets)| {
        let z_max = z_min + z_min * relative;
        let mut depths: Vec<f32> =
            shares.iter().map(|s| (z_min + (z_max - z_min) * s).clamp(z_min, z_max)).collect();
        // Both ends, their neighbours, and what lies outside as a ray's depths may.
        let neighbours = [z_min.next_up().min(z_max), z_max.next_down().max(z_min)];
        depths.extend([z_min, z_max, 0.0, z_min * 0.5, z_max * 2.0, -z_min, f32::MAX]);
        depths.extend(neighbours);
        depths.sort_unstable_by(f32::total_cmp);
        (z_min, z_max, depths, buckets)
    })
}

#[test]
fn buckets_are_monotone_and_agree_with_the_cpu() {
    let bench = Bench::new();
    let seed = TestRng::from_seed(RngAlgorithm::ChaCha, &[7; 32]);
    let mut runner = TestRunner::new_with_rng(Config::default(), seed);
    let cells: Vec<_> =
        (0..400).map(|_| cells().new_tree(&mut runner).expect("nothing is rejected").current()).collect();
    let cases: Vec<Case> = cells
        .iter()
        .flat_map(|(z_min, z_max, depths, buckets)| {
            depths.iter().map(|&z| Case { z_min: *z_min, z_max: *z_max, z, buckets: *buckets })
        })
        .collect();
    let found = on_device(&bench, &cases);
    let mut spread = 0;
    for (i, (case, &bucket)) in cases.iter().zip(&found).enumerate() {
        assert_eq!(bucket, expected(case), "{case:?}");
        assert!(bucket < case.buckets, "{case:?}: {bucket}");
        // Depths of a cell follow each other in ascending order.
        if i > 0 && cases[i - 1].z <= case.z && cases[i - 1] == (Case { z: cases[i - 1].z, ..*case }) {
            assert!(found[i - 1] <= bucket, "{:?}: {}, {case:?}: {bucket}", cases[i - 1], found[i - 1]);
        }
        spread += usize::from(bucket > 0 && bucket + 1 < case.buckets);
    }
    assert!(spread > 1_000, "only {spread} depths are between the first and the last bucket");
}

/// Z9: the fragment at the far end always exists, and belongs to the last bucket.
#[test]
fn the_ends_of_the_range_are_in_the_first_and_the_last_bucket() {
    let bench = Bench::new();
    let mut cases = Vec::new();
    for buckets in 1..=32 {
        for (z_min, z_max) in [(1.0, 2.0), (0.1, 0.7), (1.0e-6, 1.0e6), (999.0, 1000.3), (3.0, 3.000_01)] {
            cases.push(Case { z_min, z_max, z: z_min, buckets });
            cases.push(Case { z_min, z_max, z: z_max, buckets });
        }
    }
    let found = on_device(&bench, &cases);
    for (pair, buckets) in cases.chunks(2).zip(found.chunks(2)) {
        assert_eq!(buckets[0], 0, "{:?}", pair[0]);
        assert_eq!(buckets[1], pair[1].buckets - 1, "{:?}", pair[1]);
    }
}

/// The scale is that of a division to 2^-14, and never above it.
#[test]
fn scales_are_those_of_divisions() {
    for exponent in -20..30 {
        for step in 0..64 {
            let z_max = (exponent as f32 + step as f32 / 64.0).exp2();
            let exact = 8.0 / f64::from(z_max);
            let share = f64::from(scale(0.0, z_max, 8)) / exact;
            assert!((1.0 - 1.0 / 16384.0..=1.0).contains(&share), "{z_max}: {share}");
        }
    }
}

/// Z8: no division by zero, no NaN that becomes a bucket.
#[test]
fn ranges_without_extent_have_one_bucket() {
    let bench = Bench::new();
    let mut cases = Vec::new();
    for z in [1.0e-30, 1.0e-3, 5.0, 5.000_000_5, 1.0e8, 1.0e30] {
        for z_max in [z, f32::next_up(z), f32::next_up(f32::next_up(z))] {
            cases.extend([z, z_max].map(|at| Case { z_min: z, z_max, z: at, buckets: 8 }));
        }
    }
    let found = on_device(&bench, &cases);
    assert!(found.iter().all(|&bucket| bucket == 0), "{found:?}");
}
