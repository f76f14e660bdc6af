//! Pipeline, sets and push constants bound while commands are recorded.

use std::sync::Arc;

use crate::binding::BindingSet;
use crate::pipeline::PipelineInner;

/// State that is bound: pipeline, sets and bytes of push constants.
#[derive(Default)]
pub(super) struct Bound {
    pub(super) pipeline: Option<Arc<PipelineInner>>,
    pub(super) sets: Vec<Option<BindingSet>>,
    pub(super) constants: Vec<u8>,
}
