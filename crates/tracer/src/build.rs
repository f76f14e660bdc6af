//! The one loop that builds, checks and grows.

use std::time::Instant;

use rasray_ads::{AdsError, BuildStatus, Check, PoolStatus, Structure, Viewpoint};
use rasray_gpu::{Device, PassTiming, Recorder, Timing};

use crate::{FrameOutcome, FrameStructure, TracerError};

/// Rebuilds after which a structure counts as unstable. One is enough where all pools are counted at once; a
/// later pool's demand may only be known once an earlier pool sufficed, such as that of the cells of divided
/// cells, which may be divided themselves, and the demand for pages differs slightly from build to build, for
/// which [`Structure::check`] adds a margin.
const REBUILDS: u32 = 8;

/// Cost of a build.
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
    until_complete(device, &mut Whole { structure }, viewpoint.into(), timing)
}

/// Builds what of a structure over frames is stale from a viewpoint, in its first slot, until all of it is
/// complete. A frame of it that is in flight has ended before. Passes, and the sums of the outcome, are those
/// of the parts that were built; none where nothing is stale.
///
/// # Errors
/// As [`build_until_complete`].
pub fn refresh_until_complete(
    device: &Device,
    structure: &mut FrameStructure,
    viewpoint: impl Into<Viewpoint>,
    timing: Timing,
) -> Result<BuildOutcome, TracerError> {
    until_complete(device, structure, viewpoint.into(), timing)
}

/// Outcome of a build.
enum Step {
    Complete,
    /// Pools that were too small have grown.
    Grown,
    /// Incomplete, and growing does not help or is not allowed any more; with the pool that lacked most.
    Stuck(Option<PoolStatus>),
}

/// A structure, or one over frames, that [`until_complete`] builds.
trait Builds {
    fn prepare(&mut self, device: &Device, viewpoint: Viewpoint) -> Result<(), AdsError>;
    fn record(&mut self, recorder: &mut Recorder<'_>, viewpoint: Viewpoint) -> Result<(), AdsError>;
    /// After the build.
    fn finish(&mut self, device: &Device, may_grow: bool) -> Result<Step, AdsError>;
    fn structure(&self) -> &dyn Structure;
    /// Takes back a recording that was not submitted.
    fn take_back(&mut self) {}
}

/// A structure that every build builds anew.
struct Whole<'a> {
    structure: &'a mut dyn Structure,
}

impl Builds for Whole<'_> {
    fn prepare(&mut self, device: &Device, _viewpoint: Viewpoint) -> Result<(), AdsError> {
        self.structure.prepare_build(device)
    }

    fn record(&mut self, recorder: &mut Recorder<'_>, viewpoint: Viewpoint) -> Result<(), AdsError> {
        self.structure.record_build(recorder, 0, viewpoint)
    }

    fn finish(&mut self, device: &Device, may_grow: bool) -> Result<Step, AdsError> {
        let status = self.structure.status(0)?;
        match self.structure.check(&status, 0)? {
            Check::Complete if status.complete => Ok(Step::Complete),
            Check::Grow(sizes) if may_grow => {
                tracing::debug!(
                    structure = self.structure.description().name,
                    bytes = sizes.bytes(),
                    "grows to the demand of the build"
                );
                self.structure.resize(device, &sizes)?;
                Ok(Step::Grown)
            }
            Check::Complete | Check::Grow(_) => Ok(Step::Stuck(status.shortest_pool())),
        }
    }

    fn structure(&self) -> &dyn Structure {
        self.structure
    }
}

impl Builds for FrameStructure {
    fn prepare(&mut self, device: &Device, viewpoint: Viewpoint) -> Result<(), AdsError> {
        FrameStructure::prepare(self, device, viewpoint)
    }

    fn record(&mut self, recorder: &mut Recorder<'_>, viewpoint: Viewpoint) -> Result<(), AdsError> {
        FrameStructure::record(self, recorder, 0, viewpoint).map(drop)
    }

    fn finish(&mut self, device: &Device, may_grow: bool) -> Result<Step, AdsError> {
        Ok(match FrameStructure::finish(self, device, 0)? {
            FrameOutcome::Complete => Step::Complete,
            FrameOutcome::Incomplete { .. } if may_grow => Step::Grown,
            FrameOutcome::Incomplete { pool } => Step::Stuck(pool),
        })
    }

    fn structure(&self) -> &dyn Structure {
        FrameStructure::structure(self)
    }

    fn take_back(&mut self) {
        FrameStructure::take_back(self, 0);
    }
}

fn until_complete(
    device: &Device,
    built: &mut impl Builds,
    viewpoint: Viewpoint,
    timing: Timing,
) -> Result<BuildOutcome, TracerError> {
    let mut outcome = BuildOutcome::default();
    loop {
        let started = Instant::now();
        built.prepare(device, viewpoint)?;
        outcome.prepare_milliseconds = started.elapsed().as_secs_f64() * 1.0e3;
        let submitted = device
            .submit_passes(timing, |recorder| built.record(recorder, viewpoint))
            .inspect_err(|_| built.take_back())?;
        submitted.value?;
        outcome.host_milliseconds = started.elapsed().as_secs_f64() * 1.0e3;
        outcome.passes = submitted.passes;
        match built.finish(device, outcome.regrows < REBUILDS)? {
            Step::Complete => {
                outcome.status = built.structure().status(0)?;
                return Ok(outcome);
            }
            Step::Grown => outcome.regrows += 1,
            Step::Stuck(pool) => {
                let structure = built.structure().description().name;
                return Err(TracerError::Unstable { structure, rebuilds: outcome.regrows, pool });
            }
        }
    }
}
