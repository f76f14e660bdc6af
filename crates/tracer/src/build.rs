//! Loop that builds a structure, checks the outcome and grows the pools until a build is complete.

use std::time::Instant;

use rasray_ads::{AdsError, BuildStatus, Check, PoolStatus, Structure, Viewpoint};
use rasray_gpu::{Device, PassTiming, Recorder, Timing};

use crate::{FrameOutcome, FrameStructure, TracerError};

/// Maximum number of rebuilds; a structure that needs more counts as unstable. One rebuild is enough if one
/// build counts the demand for all pools. More are needed where the demand for a later pool is known only
/// once an earlier pool sufficed: cells of divided cells, for example, may be divided themselves. The demand
/// for pages differs slightly from build to build, for which [`Structure::check`] adds a margin.
const REBUILDS: u32 = 8;

/// Outcome and cost of a build.
#[derive(Clone, Debug, Default)]
pub struct BuildOutcome {
    /// Times of the passes of the last build, which is complete.
    pub passes: Vec<PassTiming>,
    /// Number of times that the structure had to grow.
    pub regrows: u32,
    /// Duration of the last build as measured on the host, milliseconds: the host's own part, submission and
    /// wait.
    pub host_milliseconds: f64,
    /// Duration of [`Structure::prepare_build`] within `host_milliseconds`: the host's work before it
    /// recorded the build.
    pub prepare_milliseconds: f64,
    /// Status of the last build.
    pub status: BuildStatus,
}

/// Builds the structure for a viewpoint (or for an eye alone, metres relative to the frame origin), and grows
/// it until a build is complete.
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

/// Builds the stale parts of a structure over frames for a viewpoint, in its first slot, and grows them until
/// all are complete. Any frame of the structure that was in flight must have ended. The passes and the sums
/// of the outcome cover the parts that were built; there are none if no part is stale.
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

/// Outcome of one build.
enum Step {
    Complete,
    /// Pools that were too small have grown.
    Grown,
    /// The build is incomplete, and growing does not help or is not allowed any more. Holds the pool that
    /// lacked most elements.
    Stuck(Option<PoolStatus>),
}

/// A structure, or a structure over frames, that [`until_complete`] builds.
trait Builds {
    fn prepare(&mut self, device: &Device, viewpoint: Viewpoint) -> Result<(), AdsError>;
    fn record(&mut self, recorder: &mut Recorder<'_>, viewpoint: Viewpoint) -> Result<(), AdsError>;
    /// Reads the outcome of the build and grows pools that were too small, if `may_grow`.
    fn finish(&mut self, device: &Device, may_grow: bool) -> Result<Step, AdsError>;
    fn structure(&self) -> &dyn Structure;
    /// Undoes the recording of a build that was not submitted.
    fn take_back(&mut self) {}
}

/// A structure that each build builds completely.
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
