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
    /// Binds a pipeline. Of the sets that are bound those stay that Vulkan keeps: they precede the first set
    /// whose layout differs from that of the pipeline before, and the push constants are alike.
    pub(super) fn replace(&mut self, pipeline: &Arc<PipelineInner>) {
        let kept = self.pipeline.as_ref().map_or(0, |before| before.sets_kept_by(pipeline));
        self.sets.truncate(kept);
        self.constants.clear();
        self.pipeline = Some(pipeline.clone());
    }

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
        let lacks_constants = self.constants.len() < pipeline.push_constant_bytes as usize;
        lacks_constants.then(|| format!("`{}` has push constants, which were not set", pipeline.name))
    }
}
