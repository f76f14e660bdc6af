//! Lists of any length, sorted on the device.

use rasray_gpu::{Access, ComputePipeline, Recorder};
use rasray_shaders_glsl::constants::ads::{LONG_LIST_ROUNDS, NODE_SORT_LISTS, SORT_GROUP_SIZE};

use crate::AdsError;
use crate::kit::{BuildPipelines, BuildTarget};

/// Sorts each list of a structure in place: `ads/build_sort.comp` and `ads/build_sort_long.comp` as compiled
/// for it, whose `sorted.glsl` says what its lists are. A first pass sorts short lists and stores the others
/// in a table; a second one, of `LONG_LIST_ROUNDS` dispatches, sorts those.
#[derive(Debug)]
pub struct ListSort {
    short: (String, ComputePipeline),
    long: (String, ComputePipeline),
}

impl ListSort {
    /// Makes the pipelines of two modules; the first may have a variant, which its label leaves out
    /// (`.pages`, or nothing).
    ///
    /// # Errors
    /// A module is not compiled in, or the device refuses it.
    pub fn new(
        pipelines: &BuildPipelines<'_>,
        short: &str,
        variant: &str,
        long: &str,
    ) -> Result<Self, AdsError> {
        Ok(Self {
            short: (pipelines.label(short), pipelines.compute(&format!("{short}{variant}"))?),
            long: (pipelines.label(long), pipelines.compute(long)?),
        })
    }

    /// Workgroups of the first pass: a thread for each list, or where they are linked for [`NODE_SORT_LISTS`]
    /// of them.
    fn groups(lists: u64, linked: bool) -> u64 {
        let per_thread = if linked { NODE_SORT_LISTS } else { 1 };
        lists.div_ceil(u64::from(SORT_GROUP_SIZE) * u64::from(per_thread))
    }

    /// Records both passes over `lists` lists, of which `long` fit into the table, visible to `readers`. The
    /// second pass is left out where none does.
    pub fn record(
        &self,
        recorder: &mut Recorder<'_>,
        target: BuildTarget<'_>,
        lists: u64,
        linked: bool,
        long: u64,
        readers: Access,
    ) {
        let (label, pipeline) = &self.short;
        // The second pass reads the table.
        let between = Access::COMPUTE | readers;
        target.compute_pass(recorder, label, pipeline, Self::groups(lists, linked), 0, between);
        let (label, pipeline) = &self.long;
        target.rounds_pass(recorder, label, pipeline, Self::groups(long, false), LONG_LIST_ROUNDS, readers);
    }
}

#[cfg(test)]
mod tests {
    use super::ListSort;

    #[test]
    fn a_thread_sorts_one_list_or_sixteen_linked_ones() {
        for (lists, linked, groups) in
            [(0, false, 0), (64, false, 1), (65, false, 2), (1024, true, 1), (1025, true, 2)]
        {
            assert_eq!(ListSort::groups(lists, linked), groups, "{lists} lists, linked {linked}");
        }
    }
}
