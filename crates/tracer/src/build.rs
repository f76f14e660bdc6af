//! The one loop that builds, checks and grows.

use std::time::Instant;

use rasray_ads::{BuildStatus, Check, Structure, Viewpoint};
use rasray_gpu::{Device, PassTiming, Timing};

use crate::TracerError;

/// Rebuilds after which a structure counts as unstable. One is enough where all pools are counted at once; a later
/// pool's demand may only be known once an earlier pool sufficed, such as that of the cells of divided cells, which may
/// be divided themselves, and the demand for pages differs slightly from build to build, for which [`Structure::check`]
/// adds a margin.
const REBUILDS: u32 = 8;

/// What a build cost.
#[derive(Clone, Debug, Default)]
pub struct BuildOutcome {
    /// Passes of the last, complete build.
    pub passes: Vec<PassTiming>,
    /// Times the structure had to grow.
    pub regrows: u32,
    /// Milliseconds of the last build as measured on the host: its own part, submission and wait.
    pub host_milliseconds: f64,
    /// Milliseconds of [`Structure::prepare_build`] within that: what the host did before it recorded.
    pub prepare_milliseconds: f64,
    /// The outcome of the last build.
    pub status: BuildStatus,
}

/// Builds for a viewpoint (or an eye alone, metres relative to the frame origin) and grows until complete.
///
/// # Errors
/// The device fails, memory does not suffice, or the demand does not settle.
pub fn build_until_complete(
    device: &Device,
    structure: &mut dyn Structure,
    viewpoint: impl Into<Viewpoint>,
    timing: Timing,
) -> Result<BuildOutcome, TracerError> {
    build_with_headroom(device, structure, viewpoint, timing, 0)
}

/// The same, with pools that grow by `headroom` percent beyond their demand, so that a build with a little more demand is
/// complete at once.
///
/// # Errors
/// As [`build_until_complete`].
pub fn build_with_headroom(
    device: &Device,
    structure: &mut dyn Structure,
    viewpoint: impl Into<Viewpoint>,
    timing: Timing,
    headroom: u32,
) -> Result<BuildOutcome, TracerError> {
    let viewpoint = viewpoint.into();
    let mut outcome = BuildOutcome::default();
    loop {
        let started = Instant::now();
        structure.prepare_build(device)?;
        outcome.prepare_milliseconds = started.elapsed().as_secs_f64() * 1.0e3;
        let submitted =
            device.submit_passes(timing, |recorder| structure.record_build(recorder, 0, viewpoint))?;
        submitted.value?;
        outcome.host_milliseconds = started.elapsed().as_secs_f64() * 1.0e3;
        outcome.passes = submitted.passes;
        outcome.status = structure.status(0)?;
        match structure.check(&outcome.status, headroom)? {
            Check::Complete if outcome.status.complete => return Ok(outcome),
            Check::Grow(sizes) if outcome.regrows < REBUILDS => {
                tracing::debug!(
                    structure = structure.name(),
                    bytes = sizes.bytes(),
                    "grows to the demand of the build"
                );
                structure.resize(device, &sizes)?;
                outcome.regrows += 1;
            }
            Check::Complete | Check::Grow(_) => {
                return Err(TracerError::Unstable { structure: structure.name(), rebuilds: outcome.regrows });
            }
        }
    }
}
