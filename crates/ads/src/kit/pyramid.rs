//! Pyramid of depth bounds of blocks of cells, built on the device: rays skip blocks by it.

use rasray_gpu::{Access, ComputePipeline, Recorder, Stage};
use rasray_shaders_glsl::constants::ads::PYRAMID_THREADS;

use crate::AdsError;
use crate::kit::{BuildPipelines, BuildTarget, ViewDraw};

/// Builds blocks of 2x2, 4x4 and more cells, up to one block per view, with the pipeline of
/// `ads/build_pyramid.comp` as compiled for a structure. The structure's `pyramid.glsl` locates the cells and
/// the blocks. Each level takes one dispatch.
#[derive(Debug)]
pub struct Pyramid {
    level: ComputePipeline,
}

impl Pyramid {
    /// Makes the pipeline of the module with that name.
    ///
    /// # Errors
    /// The module is not compiled in, or the device refuses it.
    pub fn new(pipelines: &BuildPipelines<'_>, name: &str) -> Result<Self, AdsError> {
        Ok(Self { level: pipelines.compute(name)? })
    }

    /// Returns the number of words that a structure keeps for the blocks of views.
    pub fn words(views: &[ViewDraw]) -> u64 {
        let of_view = |view: &ViewDraw| (1..=levels(view)).map(|level| 2 * blocks(view, level)).sum::<u64>();
        views.iter().map(of_view).sum()
    }

    /// Records a labelled pass over views, smallest blocks first, visible to `readers`.
    pub fn record(
        &self,
        recorder: &mut Recorder<'_>,
        target: BuildTarget<'_>,
        label: &str,
        views: &[ViewDraw],
        readers: Access,
    ) {
        recorder.begin_pass(Stage::Build, label);
        for view in views {
            for level in 1..=levels(view) {
                let groups = blocks(view, level).div_ceil(PYRAMID_THREADS.into());
                target.dispatch(recorder, &self.level, groups, level | (view.first << 8));
                recorder.barrier(Access::COMPUTE, Access::COMPUTE | readers);
            }
        }
        recorder.end_pass();
    }
}

/// Returns the number of levels up to one block per view.
fn levels(view: &ViewDraw) -> u32 {
    view.side.next_power_of_two().trailing_zeros()
}

/// Returns the number of blocks of a level, each with 2^level cells along a side.
fn blocks(view: &ViewDraw, level: u32) -> u64 {
    let side = u64::from(view.side).div_ceil(1 << level);
    u64::from(view.views) * side * side
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn levels_end_at_one_block_a_view() {
        let view = |side, views| ViewDraw { side, views, first: 0 };
        assert_eq!(Pyramid::words(&[view(3, 1)]), 2 * (4 + 1));
        assert_eq!(Pyramid::words(&[view(4, 6)]), 2 * 6 * (4 + 1));
        assert_eq!(Pyramid::words(&[view(10, 6), view(5, 1)]), 2 * (6 * (25 + 9 + 4 + 1) + 9 + 4 + 1));
        assert_eq!(levels(&view(8194, 6)), 14);
    }
}
