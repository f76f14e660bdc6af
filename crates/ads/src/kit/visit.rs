//! Passes that visit the cells of every triangle, by rasterization or in compute shaders.

use crate::words;
use rasray_gpu::{Access, ComputePipeline, Feature, RasterPipeline, Recorder, Requirements};
use rasray_shaders_glsl::constants::ads::{BIN_GROUP_SIZE, BIN_TURNS};

use crate::AdsError;
use crate::kit::{BuildPipelines, BuildTarget, ViewDraw};

/// Way in which triangles are binned into cells. It does not change any hit.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Builder {
    /// The rasterizer proposes cells, and the shared function decides.
    Raster,
    /// A compute pass visits all cells that a triangle may reach into; the same shared function decides.
    Binning,
}

words! { Builder { Raster "raster", Binning "binning" } }

impl Builder {
    /// Returns the requirements on a device: compute, or drawing with stores of fragment shaders.
    pub fn requirements(self) -> Requirements {
        match self {
            Self::Raster => {
                let mut requirements = Requirements::floor();
                requirements.required.push(Feature::FragmentStoresAndAtomics);
                requirements
            }
            Self::Binning => Requirements::compute(),
        }
    }
}

/// A pass that visits cells, by one builder.
#[derive(Debug)]
pub struct Visit {
    label: String,
    passes: Passes,
}

#[derive(Debug)]
enum Passes {
    Raster(RasterPipeline),
    Binning {
        /// Visits the cells of triangles.
        bin: ComputePipeline,
        /// Visits the cells of triangles of the large-triangle queue.
        large: ComputePipeline,
        /// Byte of the header with the numbers of workgroups for the large-triangle queue.
        groups: u64,
    },
}

impl Visit {
    /// Records the visit. The next pass may be a visit by the same builder, or a compute pass.
    pub fn record(&self, recorder: &mut Recorder<'_>, target: BuildTarget<'_>, draws: &[ViewDraw]) {
        match &self.passes {
            Passes::Raster(draw) => target.raster_views(recorder, &self.label, draw, draws),
            Passes::Binning { bin, large, groups } => {
                let readers = Access::COMPUTE | Access::INDIRECT_READ;
                let label = format!("{}_bin", self.label);
                target.compute_pass(recorder, &label, bin, triangle_groups(target), 0, readers);
                target.indirect_pass(recorder, &format!("{label}_large"), large, *groups, 0, Access::COMPUTE);
            }
        }
    }
}

/// Returns the number of workgroups of binning passes with one invocation per triangle.
fn triangle_groups(target: BuildTarget<'_>) -> u64 {
    u64::from(target.geometry.triangle_count()).div_ceil(BIN_GROUP_SIZE.into())
}

/// Pass before all visits by compute shaders: it fills the large-triangle queue.
#[derive(Debug)]
pub struct LargePass {
    label: String,
    pipeline: ComputePipeline,
}

impl LargePass {
    /// Records the pass.
    pub fn record(&self, recorder: &mut Recorder<'_>, target: BuildTarget<'_>) {
        let readers = Access::COMPUTE | Access::INDIRECT_READ;
        target.compute_pass(recorder, &self.label, &self.pipeline, triangle_groups(target), 0, readers);
    }
}

/// Maker of the visits of a structure that either builder can build. Modules have similar names: a fragment
/// shader `build_3_bounds.alpha` has compute shaders `build_3_bounds_bin.alpha` and
/// `build_3_bounds_bin_large.alpha` next to it, and labels have the same suffixes.
#[derive(Clone, Copy, Debug)]
pub struct Visits<'a> {
    /// Maker of the pipelines.
    pub pipelines: &'a BuildPipelines<'a>,
    /// Builder of the visits.
    pub builder: Builder,
    /// Byte of the header with the numbers of workgroups for the large-triangle queue: three u32.
    pub groups: usize,
}

impl Visits<'_> {
    /// Makes the visit with that name, in that variant (`.alpha`, or the empty string). Drawing uses the
    /// vertex shader; computing ignores it.
    ///
    /// # Errors
    /// A module is not compiled in, or the device refuses it.
    pub fn visit(&self, vertex: &str, name: &str, variant: &str) -> Result<Visit, AdsError> {
        let passes = match self.builder {
            Builder::Raster => Passes::Raster(self.pipelines.raster(vertex, &format!("{name}{variant}"))?),
            Builder::Binning => Passes::Binning {
                bin: self.pipelines.compute(&format!("{name}_bin{variant}"))?,
                large: self.pipelines.compute(&format!("{name}_bin_large{variant}"))?,
                groups: self.groups as u64,
            },
        };
        Ok(Visit { label: self.pipelines.label(name), passes })
    }

    /// Makes the pass with that name that precedes all visits by compute shaders; absent for drawing.
    ///
    /// # Errors
    /// The module is not compiled in, or the device refuses it.
    pub fn large(&self, name: &str) -> Result<Option<LargePass>, AdsError> {
        let made = || -> Result<LargePass, AdsError> {
            Ok(LargePass { label: self.pipelines.label(name), pipeline: self.pipelines.compute(name)? })
        };
        (self.builder == Builder::Binning).then(made).transpose()
    }
}

/// Returns the number of workgroups per triangle of the large-triangle queue: enough that no loop of an
/// invocation has more than `BIN_TURNS` iterations. `turns` is the number of cells of the largest view, times
/// the iterations of a loop within each cell.
pub fn bin_groups(turns: u64) -> u32 {
    turns.div_ceil(u64::from(BIN_GROUP_SIZE) * BIN_TURNS as u64) as u32
}

#[cfg(test)]
mod tests {
    use super::bin_groups;

    #[test]
    fn workgroups_bound_the_cells_of_an_invocation() {
        for (side, groups) in [(3_u64, 1), (514, 1), (1386, 2), (8194, 35)] {
            assert_eq!(bin_groups(side * side), groups, "{side} cells a side");
        }
    }
}
