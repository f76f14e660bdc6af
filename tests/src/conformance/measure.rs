use rasray_ads::Structure;
use rasray_experiment::{Measured, Tolerance, device_hits};
use rasray_gpu::Timing;
use rasray_metrics::DeviceHit;
use rasray_tracer::{TracerError, build_until_complete};

use super::Prepared;
use crate::harness::Bench;

/// Builds and traces, and returns the hit of each ray; a miss is `None`.
///
/// # Panics
/// If the device fails or rays do not finish.
pub fn answers(bench: &Bench, structure: &mut dyn Structure, prepared: &Prepared) -> Vec<Option<DeviceHit>> {
    try_answers(bench, structure, prepared).expect("the build completes")
}

/// Builds and traces as [`answers`], with pools that may be larger than the device can hold.
///
/// # Errors
/// The build fails.
///
/// # Panics
/// If the structure does not take the geometry, or rays do not finish.
pub fn try_answers(
    bench: &Bench,
    structure: &mut dyn Structure,
    prepared: &Prepared,
) -> Result<Vec<Option<DeviceHit>>, TracerError> {
    structure.set_geometry(bench.device(), &prepared.geometry).expect("geometry is taken");
    build_until_complete(bench.device(), structure, prepared.viewpoint, Timing::None)?;
    let hits = bench.trace(structure, &prepared.rays).hits;
    Ok(device_hits(hits.into_iter().map(|hit| prepared.placed.named(hit))))
}

/// Builds, traces and compares. `depth_tolerance` is the |dt| / t up to which a depth counts as right for
/// [`Measured::errors`]; `rounding` is the tolerance of [`Measured::rejected`], beyond the oracle's own
/// bounds.
///
/// # Panics
/// If the device fails or rays do not finish.
pub fn measure(
    bench: &Bench,
    structure: &mut dyn Structure,
    prepared: &Prepared,
    depth_tolerance: f64,
    rounding: f64,
) -> Measured {
    compare(prepared, &answers(bench, structure, prepared), depth_tolerance, rounding)
}

/// Returns the index of the first ray whose hits differ in any bit between two traces.
pub fn first_other(expected: &[Option<DeviceHit>], found: &[Option<DeviceHit>]) -> Option<usize> {
    let bits = |hit: &Option<DeviceHit>| hit.map(|hit| (hit.t.to_bits(), hit.primitive));
    expected.iter().map(bits).zip(found.iter().map(bits)).position(|(expected, found)| expected != found)
}

/// Compares answers with the truth, as [`measure`] does for a structure's answers.
///
/// # Panics
/// If the number of answers is not that of the rays.
pub fn compare(
    prepared: &Prepared,
    hits: &[Option<DeviceHit>],
    depth_tolerance: f64,
    rounding: f64,
) -> Measured {
    let tolerance = Tolerance { depth: depth_tolerance, rounding };
    Measured::of(&prepared.case, &prepared.verdicts, hits, tolerance, |index| prepared.is_unseen(index))
        .expect("there is one hit per ray")
}
