//! Prefix sums on the device, which turn lengths of lists into offsets.

use rasray_gpu::{Access, ComputePipeline, Recorder, Stage};
use rasray_shaders_glsl::constants::ads::SCAN_BLOCK;

use crate::AdsError;
use crate::kit::{BuildPipelines, BuildTarget};

/// Replaces each number by the sum of all numbers before it, with the pipelines of `ads/scan_*.comp` as
/// compiled for a structure. The structure's `scanned.glsl` locates the numbers. Three dispatches; O(n) work.
#[derive(Debug)]
pub struct Scan {
    blocks: ComputePipeline,
    sums: ComputePipeline,
    places: ComputePipeline,
}

impl Scan {
    /// Makes the pipelines of the modules `<name>_blocks`, `<name>_sums` and `<name>_places`.
    ///
    /// # Errors
    /// A module is not compiled in, or the device refuses it.
    pub fn new(pipelines: &BuildPipelines<'_>, name: &str) -> Result<Self, AdsError> {
        let compute = |part: &str| pipelines.compute(&format!("{name}_{part}"));
        Ok(Self { blocks: compute("blocks")?, sums: compute("sums")?, places: compute("places")? })
    }

    /// Returns the number of words that a structure keeps for the sums of `numbers` numbers.
    pub fn sums(numbers: u64) -> u64 {
        numbers.div_ceil(SCAN_BLOCK.into())
    }

    /// Records a labelled pass over `numbers` numbers, visible to `readers`; `scan_count` of the structure
    /// gives the same number. The total is written even if there is no number.
    pub fn record(
        &self,
        recorder: &mut Recorder<'_>,
        target: BuildTarget<'_>,
        label: &str,
        numbers: u64,
        step: u32,
        readers: Access,
    ) {
        let blocks = Self::sums(numbers);
        recorder.begin_pass(Stage::Build, label);
        target.dispatch(recorder, &self.blocks, blocks, step);
        recorder.barrier(Access::COMPUTE, Access::COMPUTE);
        target.dispatch(recorder, &self.sums, 1, step);
        recorder.barrier(Access::COMPUTE, Access::COMPUTE);
        target.dispatch(recorder, &self.places, blocks, step);
        recorder.barrier(Access::COMPUTE, readers);
        recorder.end_pass();
    }
}
