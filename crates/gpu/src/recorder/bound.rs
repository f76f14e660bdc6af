//! Pipeline, sets and push constants bound while commands are recorded.

use std::sync::Arc;

use crate::binding::BindingSet;
use crate::pipeline::PipelineInner;
use crate::set_layout::SetLayout;

/// State that is bound: pipeline, sets and bytes of push constants.
#[derive(Default)]
pub(super) struct Bound {
    pub(super) pipeline: Option<Arc<PipelineInner>>,
    pub(super) sets: Vec<Option<BindingSet>>,
    pub(super) constants: Vec<u8>,
}

impl Bound {
    /// Returns what the bound pipeline uses and lacks, in words.
    pub(super) fn missing(&self) -> Option<String> {
        let pipeline = self.pipeline.as_ref()?;
        let is_bound = |set: usize, layout: &SetLayout| {
            self.sets
                .get(set)
                .is_some_and(|bound| bound.as_ref().is_some_and(|bound| bound.inner.layout().is_like(layout)))
        };
        let used = pipeline.used.iter().zip(&pipeline.sets).enumerate().filter(|(_, (mask, _))| **mask != 0);
        if let Some((set, _)) = used.into_iter().find(|(set, (_, layout))| !is_bound(*set, layout)) {
            return Some(format!("`{}` uses set {set}, which is not bound", pipeline.name));
        }
        let lacks_constants = pipeline.push_constant_bytes > 0 && self.constants.is_empty();
        lacks_constants.then(|| format!("`{}` has push constants, which were not set", pipeline.name))
    }
}
