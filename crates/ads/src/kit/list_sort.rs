//! Passes that sort lists of any length on the device.

use rasray_gpu::{Access, ComputePipeline, Recorder};
use rasray_shaders_glsl::constants::ads::{LONG_LIST_ROUNDS, NODE_SORT_LISTS, SORT_GROUP_SIZE};

use crate::AdsError;
use crate::kit::{BuildPipelines, BuildTarget};

/// Sorts each list of a structure in place with `ads/build_sort.comp` and `ads/build_sort_long.comp` as
/// compiled for the structure, whose `sorted.glsl` defines the lists. A first pass sorts short lists and
/// stores the other lists in a table; a second pass, of `LONG_LIST_ROUNDS` dispatches, sorts the lists in the
/// table.
#[derive(Debug)]
pub struct ListSort {
    short: (String, ComputePipeline),
    long: (String, ComputePipeline),
}

impl ListSort {
    /// Makes the pipelines of two modules. The first module may have a variant, `.pages` or none, which its
    /// label leaves out.
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

    /// Returns the number of workgroups of the first pass: one thread per list, or per [`NODE_SORT_LISTS`]
    /// lists if the lists are linked.
    fn groups(lists: u64, linked: bool) -> u64 {
        let per_thread = if linked { NODE_SORT_LISTS } else { 1 };
        lists.div_ceil(u64::from(SORT_GROUP_SIZE) * u64::from(per_thread))
    }

    /// Records both passes over `lists` lists, visible to `readers`; `long` is the number of lists that fit
    /// into the table. The second pass is left out if `long` is 0.
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
        // The second pass reads the table that the first pass writes.
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
