//! Arguments of a trace.

use rasray_gpu::TraceMode;

use crate::{Domain, PartRays};

/// Arguments of [`Structure::record_trace`](crate::Structure::record_trace): the rays of a queue that are
/// traced, and the answer that they get. [`Trace::closest`] and [`Trace::occluded`] make the usual ones.
#[derive(Clone, Copy, Debug)]
pub struct Trace<'a> {
    /// Slots of the queue whose rays are traced.
    pub domain: Domain,
    /// Nearest hits, or whether there is any.
    pub mode: TraceMode,
    /// Maximum number of rounds, counted as 1 where it is 0; [`Structure::rounds`](crate::Structure::rounds)
    /// where absent.
    pub rounds: Option<u32>,
    /// Hits that the rays start from.
    pub start: Start<'a>,
}

/// Hits that the rays of a trace start from.
#[derive(Clone, Copy, Debug, Default)]
pub enum Start<'a> {
    /// None.
    #[default]
    New,
    /// Those that the slots have: of another structure over other triangles of the same geometry, traced
    /// before in the same mode. A slot keeps its hit unless a better one is found. Slots without an answer
    /// because that structure was not ready get none.
    Continue,
    /// Those that the slots have, as for [`Start::Continue`], before one part of several is traced. Where all
    /// triangles are found, rays that pass by its bounds need not be traced.
    Part(PartRays<'a>),
}

impl Start<'_> {
    /// All rays of the trace, where the structure does not select those that meet a part.
    pub(crate) fn of_all_rays(self) -> Self {
        match self {
            Self::Part(_) => Self::Continue,
            start => start,
        }
    }
}

impl Trace<'_> {
    /// A trace of rays without hits, in as many rounds as the structure asks for.
    pub fn new(domain: Domain, mode: TraceMode) -> Self {
        Self { domain, mode, rounds: None, start: Start::New }
    }

    /// [`Trace::new`] for nearest hits.
    pub fn closest(domain: Domain) -> Self {
        Self::new(domain, TraceMode::Closest)
    }

    /// [`Trace::new`] for occlusion.
    pub fn occluded(domain: Domain) -> Self {
        Self::new(domain, TraceMode::Occluded)
    }
}
