//! A pass that visits all cells each triangle reaches into, by drawing or by computing.

use std::mem::offset_of;

use rasray_ads::{AdsError, BuildPipelines, Builder, Visit};

use crate::{Config, Header};

/// `name` is what the modules' names begin with: they end in `_draw`, `_bin` and `_bin_many`.
pub(crate) fn visit(pipelines: &BuildPipelines<'_>, config: &Config, name: &str) -> Result<Visit, AdsError> {
    let label = format!("primitive/{name}");
    let module = |ending| format!("{name}_{ending}");
    match config.builder {
        Builder::Raster => Visit::drawn(pipelines, &format!("{label}_draw"), "build_raster", &module("draw")),
        Builder::Binning => {
            let groups = offset_of!(Header, groups);
            Visit::binned(pipelines, &label, &module("bin"), &module("bin_many"), groups)
        }
    }
}
