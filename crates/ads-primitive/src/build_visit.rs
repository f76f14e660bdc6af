//! A pass that visits all cells each triangle reaches into, by drawing or by computing.

use std::mem::offset_of;

use rasray_ads::{AdsError, BuildPipelines, BuildTarget};
use rasray_gpu::{Access, ComputePipeline, RasterPipeline, Recorder};
use rasray_shaders_glsl::constants::primitive::PRIMITIVE_GROUP_SIZE;

use crate::{Builder, Config, Header};

/// Pipelines of one such pass.
#[derive(Debug)]
pub(crate) struct Visit {
    label: String,
    passes: Passes,
}

#[derive(Debug)]
enum Passes {
    Raster(RasterPipeline),
    /// Triangles, and those with many columns of a face.
    Binning(ComputePipeline, ComputePipeline),
}

impl Visit {
    /// `name` is what the modules' names begin with: they end in `_draw`, `_bin` and `_bin_many`.
    pub(crate) fn new(
        pipelines: &BuildPipelines<'_>,
        config: &Config,
        name: &'static str,
    ) -> Result<Self, AdsError> {
        let passes = match config.builder() {
            Builder::Raster => Passes::Raster(pipelines.raster("build_raster", &format!("{name}_draw"))?),
            Builder::Binning => Passes::Binning(
                pipelines.compute(&format!("{name}_bin"))?,
                pipelines.compute(&format!("{name}_bin_many"))?,
            ),
        };
        Ok(Self { label: format!("primitive/{name}"), passes })
    }

    /// Records it; the next pass may be of either kind.
    ///
    /// `side`: columns along the longer side of a view, the border of one not counted.
    pub(crate) fn record(
        &self,
        recorder: &mut Recorder<'_>,
        config: &Config,
        side: u32,
        target: BuildTarget<'_>,
    ) {
        match &self.passes {
            Passes::Raster(draw) => {
                target.raster_pass(
                    recorder,
                    &format!("{}_draw", self.label),
                    draw,
                    side + 2,
                    config.view_count(),
                );
            }
            Passes::Binning(bin, many) => {
                let triangles = u64::from(target.geometry.triangle_count());
                let groups = triangles.div_ceil(PRIMITIVE_GROUP_SIZE.into());
                let readers = Access::COMPUTE | Access::INDIRECT_READ;
                target.compute_pass(recorder, &format!("{}_bin", self.label), bin, groups, 0, readers);
                let groups = offset_of!(Header, groups) as u64;
                let label = format!("{}_bin_many", self.label);
                target.indirect_pass(recorder, &label, many, groups, Access::COMPUTE);
            }
        }
    }
}
