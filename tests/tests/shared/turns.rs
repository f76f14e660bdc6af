//! Loops with different numbers of iterations per invocation of a workgroup, on which traversals and builds
//! depend.

use rasray_shaders_glsl::{ADS_TEST_TURNS, ADS_TEST_TURNS_BARRIER, Shader};
use rasray_tests::harness::Bench;
use rasray_tests::visits::run_kernel;

const THREADS: usize = 64;

/// Turns that invocations of one workgroup made of those wanted.
fn made(bench: &Bench, shader: &Shader, wanted: &[u32; THREADS]) -> Vec<u32> {
    run_kernel(bench.device(), shader, bytemuck::cast_slice(wanted), THREADS, None, THREADS, &()).0
}

/// Half of a workgroup makes `few` turns, the other half ten.
fn halves(few: u32) -> [u32; THREADS] {
    std::array::from_fn(|thread| if thread < THREADS / 2 { few } else { 10 })
}

#[test]
fn every_turn_of_a_loop_is_made() {
    let bench = Bench::new();
    for few in [0, 1, 2, 5] {
        let wanted = halves(few);
        assert_eq!(made(&bench, &ADS_TEST_TURNS, &wanted), wanted);
    }
    let wanted = std::array::from_fn(|thread| thread as u32 * 7 % 31);
    assert_eq!(made(&bench, &ADS_TEST_TURNS, &wanted), wanted);
}

/// A memory barrier orders memory and nobody waits at it. Software drivers before Mesa 22.3.7 wait all the
/// same, and end a workgroup with the first of its vectors to finish (docs/measurements/bvh.md): no shader
/// here has such a loop.
#[test]
fn turns_with_a_memory_barrier_are_made_but_by_some_software_drivers() {
    let bench = Bench::new();
    for few in [0, 1, 2, 3, 5, 8] {
        let wanted = halves(few);
        let made = made(&bench, &ADS_TEST_TURNS_BARRIER, &wanted);
        println!("{few} and 10 turns wanted: {} and {} made", made[0], made[THREADS - 1]);
        assert!(made.iter().zip(&wanted).all(|(made, wanted)| made <= wanted), "{made:?}");
        if !bench.device().is_software() {
            assert_eq!(made, wanted);
        }
    }
}
