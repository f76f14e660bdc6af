//! Arguments of a trace.

use rasray_gpu::TraceMode;

use crate::{Domain, PartRays};

/// Arguments of [`Structure::record_trace`](crate::Structure::record_trace): the rays of a queue that are
/// traced, and the kind of answer that they get. [`Trace::closest`] and [`Trace::occluded`] make the usual
/// ones.
#[derive(Clone, Copy, Debug)]
pub struct Trace<'a> {
    /// Slots of the queue whose rays are traced.
    pub domain: Domain,
    /// Kind of answer: the nearest hit, or whether there is any hit.
    pub mode: TraceMode,
    /// Maximum number of rounds; 0 counts as 1. If absent, it is
    /// [`Structure::rounds`](crate::Structure::rounds).
    pub rounds: Option<u32>,
    /// Hits from which the rays start.
    pub start: Start<'a>,
}

/// Hits from which the rays of a trace start.
#[derive(Clone, Copy, Debug, Default)]
pub enum Start<'a> {
    /// The rays start without hits.
    #[default]
    New,
    /// The rays start from the hits in their slots, which a trace through another structure, over other
    /// triangles of the same geometry and in the same mode, left there. A slot keeps its hit unless a better
    /// one is found. Slots without an answer, because that structure was not ready, get no answer.
    Continue,
    /// The rays start from the hits in their slots, as for [`Start::Continue`], before one of several parts
    /// is traced. If the structure finds all triangles, rays that miss the bounds of the part need not be
    /// traced.
    Part(PartRays<'a>),
}

impl Start<'_> {
    /// Returns the start for all rays of the trace, for a structure that does not select rays that meet a
    /// part.
    pub(crate) fn of_all_rays(self) -> Self {
        match self {
            Self::Part(_) => Self::Continue,
            start => start,
        }
    }
}

impl Trace<'_> {
    /// Makes a trace of rays without hits, in as many rounds as the structure asks for.
    pub fn new(domain: Domain, mode: TraceMode) -> Self {
        Self { domain, mode, rounds: None, start: Start::New }
    }

    /// Makes [`Trace::new`] for nearest hits.
    pub fn closest(domain: Domain) -> Self {
        Self::new(domain, TraceMode::Closest)
    }

    /// Makes [`Trace::new`] for occlusion.
    pub fn occluded(domain: Domain) -> Self {
        Self::new(domain, TraceMode::Occluded)
    }
}
