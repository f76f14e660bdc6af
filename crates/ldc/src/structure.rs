//! Implementation of the layered depth cube as a structure.

use std::mem::offset_of;

use rasray_ads::kit::{BuildPipelines, Design, Parts, Pooled, bin_groups};
use rasray_ads::{
    AdsError, Dependencies, GeometryExtent, ListCounts, RecordLayout, SceneBinding, Sizes, StructureKind,
    StructureReport, Viewpoint,
};
use rasray_gpu::{BindingSet, Recorder, Requirements};
use rasray_shaders_glsl::constant_ids::ldc::LDC_RIGID;

use crate::build::Build;
use crate::layout::{Demand, first_plan, formula_bytes, layer_capacity, plan, scratch};
use crate::{Accept, Config, Contents, Header, Pool, well_formed};

/// Structure with the fragments of three orthographic views, each triangle in the view it faces most; made
/// from a [`Config`].
pub type LayeredDepthCube = Pooled<Build>;

/// Minimum number of cells along a side of the cube of a small part with few triangles.
const LEAST_RESOLUTION: f64 = 16.0;

/// Returns the header that the next build starts from.
fn first_header(parts: &Parts<Config>) -> Header {
    let Parts { config, pools, .. } = parts;
    Header {
        capacity: parts.elements(Pool::Payload) as u32,
        conservative_capacity: parts.elements(Pool::Conservative) as u32,
        long_capacity: scratch(config).long_capacity(pools.sizes()) as u32,
        layer_capacity: layer_capacity(config, pools.sizes()) as u32,
        layer_limit: config.layers,
        resolution: config.resolution,
        tolerance_per_side: config.tolerance,
        large_capacity: scratch(config).large_capacity(pools.sizes()) as u32,
        groups: [0, 0, bin_groups(u64::from(config.resolution + 2).pow(2))],
        ..Header::default()
    }
}

impl rasray_ads::kit::Demand for Demand {
    fn zip(self, other: Self, mut with: impl FnMut(&'static str, u64, u64) -> u64) -> Self {
        Self {
            fragments: with("fragments", self.fragments, other.fragments),
            conservative: with("conservative", self.conservative, other.conservative),
            long_lists: with("long", self.long_lists, other.long_lists),
            layers: with("layers", self.layers, other.layers),
            large: with("large", self.large, other.large),
        }
    }
}

impl Design for Build {
    type Config = Config;
    type Header = Header;
    type Demand = Demand;
    type Pool = Pool;
    type Contents = Contents;

    const NAME: &'static str = "ldc";
    const TITLE: &'static str = "the layered depth cube";
    const BUILD_READS_SCENE: bool = true;
    const CORRUPTED: usize = offset_of!(Header, corrupted);
    const UNSORTED: Option<usize> = Some(offset_of!(Header, unsorted));
    const RECORDS: &'static [RecordLayout] = &[Header::LAYOUT];

    fn kind(config: &Config) -> StructureKind {
        if config.accept == Accept::Triangle { StructureKind::Primitive } else { StructureKind::Fragment }
    }

    const FOLLOWING: &'static [(u32, u32)] = &[(LDC_RIGID, 1)];
    const RIGID: Option<usize> = Some(offset_of!(Header, rigid_x));

    /// Lowers the resolution of a part: its cells are about as fine as those of the whole, and there are
    /// enough of them along a side that each has a few triangles. A tolerance is a share of the side, so with
    /// [`Accept::Tolerance`] a part keeps the resolution of the whole.
    fn follow(config: &mut Config, part: &GeometryExtent) -> bool {
        match config.accept {
            Accept::Plane => return false,
            Accept::Tolerance => return true,
            Accept::Slope | Accept::Triangle => {}
        }
        let size = |[lower, upper]: [[f32; 3]; 2]| {
            (0..3).map(|axis| f64::from(upper[axis]) - f64::from(lower[axis])).fold(0.0, f64::max)
        };
        let share = f64::from(config.resolution) * size(part.bounds) / size(part.around);
        let wanted = share.max(f64::from(part.triangle_count).sqrt()).max(LEAST_RESOLUTION);
        if wanted < f64::from(config.resolution) {
            config.resolution = wanted.ceil() as u32;
        }
        true
    }

    fn depends_on(_config: &Config) -> Dependencies {
        Dependencies::default()
    }

    fn requirements(config: &Config) -> Requirements {
        config.builder.requirements()
    }

    fn constants(config: &Config) -> Vec<(u32, u32)> {
        config.constants()
    }

    fn first_plan(config: &Config, _extent: &GeometryExtent) -> Result<Sizes, AdsError> {
        first_plan(config)
    }

    fn plan(config: &Config, demand: &Demand) -> Result<Sizes, AdsError> {
        plan(config, *demand)
    }

    fn accepts(config: &Config, sizes: &Sizes) -> Result<(), AdsError> {
        let layers = layer_capacity(config, sizes);
        if layers > config.layers.into() {
            return Err(AdsError::Option {
                option: "layers",
                value: format!("{}, and the deepest cell has {layers} fragments", config.layers),
                expected: "as many layers as the deepest cell has fragments, up to 1024, or `build=single`",
            });
        }
        Ok(())
    }

    fn make(
        pipelines: &BuildPipelines<'_>,
        config: &Config,
        scene: Option<&SceneBinding>,
    ) -> Result<Self, AdsError> {
        Self::new(pipelines, config, scene)
    }

    fn first_header(&mut self, parts: &Parts<Config>, _viewpoint: Viewpoint) -> Result<Header, AdsError> {
        Ok(first_header(parts))
    }

    fn record_passes(&self, recorder: &mut Recorder<'_>, parts: &Parts<Config>, scene: Option<&BindingSet>) {
        self.record(recorder, &parts.config, parts.target(scene));
    }

    fn asked(&self, _parts: &Parts<Config>, header: &Header) -> Demand {
        Demand {
            fragments: header.demand.into(),
            conservative: header.conservative_demand.into(),
            long_lists: header.long_demand.into(),
            layers: header.layer_demand.into(),
            large: header.large_demand.into(),
        }
    }

    fn capacity(config: &Config, sizes: &Sizes, _extent: &GeometryExtent) -> Demand {
        Demand {
            fragments: sizes.elements_of(Pool::Payload),
            conservative: sizes.elements_of(Pool::Conservative),
            long_lists: scratch(config).long_capacity(sizes),
            layers: layer_capacity(config, sizes),
            large: scratch(config).large_capacity(sizes),
        }
    }

    fn ample_rounds(parts: &Parts<Config>, header: &Header) -> u32 {
        // A single cell may hold every triangle, as with a small object in a large world.
        let deepest = match parts.config.accept {
            Accept::Triangle => header.demand.min(parts.geometry.triangle_count()),
            _ => header.conservative_demand.min(parts.elements(Pool::Conservative) as u32),
        };
        parts.usual_rounds() + parts.rounds(deepest)
    }

    fn report(parts: &Parts<Config>, _header: &Header, asked: &Demand) -> StructureReport {
        let formula = formula_bytes(&parts.config, *asked);
        StructureReport {
            options: parts.config.options(),
            paths: parts.config.paths(),
            formula_bytes: formula.total(),
            diagnostic_bytes: formula.ids,
            stored: Some(asked.fragments + asked.conservative),
            ..StructureReport::default()
        }
    }

    fn fault(contents: &Contents, triangles: u32) -> Option<String> {
        well_formed(contents, triangles).err().map(|fault| fault.to_string())
    }

    fn list_counts(contents: &Contents) -> Result<Vec<ListCounts>, String> {
        contents.list_counts().map_err(|fault| fault.to_string())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const BOUNDS: [[f32; 3]; 2] = [[0.0; 3], [4.0, 2.0, 1.0]];

    #[test]
    fn pools_are_planned_without_a_device() {
        let extent = GeometryExtent::new(1_000, BOUNDS);
        for config in [Config::robust(64), Config::published(64)] {
            let sizes = Build::first_plan(&config, &extent).expect("options are in range");
            // The capacity of these pools, expressed as a demand, has to plan these pools again.
            let capacity = Build::capacity(&config, &sizes, &extent);
            assert_eq!(Build::plan(&config, &capacity).expect("options are in range"), sizes, "{config:?}");
        }
    }

    #[test]
    fn parts_have_the_cells_of_the_whole_and_a_few_triangles_in_each() {
        let cells = |accept, triangles, side: f32| {
            let mut config = Config { accept, ..Config::robust(1024) };
            let around = [[0.0; 3], [8.0, 1.0, 1.0]];
            let bounds = [[0.0; 3], [side, 0.0, 0.0]];
            let part = GeometryExtent { around, ..GeometryExtent::new(triangles, bounds) };
            Build::follow(&mut config, &part).then_some(config.resolution)
        };
        assert_eq!(cells(Accept::Slope, 100, 1.0), Some(128));
        assert_eq!(cells(Accept::Triangle, 40_000, 1.0), Some(200));
        assert_eq!(cells(Accept::Slope, 100, 0.01), Some(16));
        assert_eq!(cells(Accept::Slope, 4_000_000, 8.0), Some(1024));
        assert_eq!(cells(Accept::Tolerance, 100, 1.0), Some(1024));
        assert_eq!(cells(Accept::Plane, 100, 1.0), None);
    }
}
