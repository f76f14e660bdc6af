//! Implementation of the grid as a structure.

use std::mem::offset_of;

use rasray_ads::kit::{BuildPipelines, Design, Parts, Pooled, Scan, bin_groups, box_is_same};
use rasray_ads::{
    AdsError, Dependencies, GeometryExtent, ListCounts, RecordLayout, SceneBinding, Sizes, StructureKind,
    StructureReport, Viewpoint,
};
use rasray_gpu::{BindingSet, Recorder, Requirements};

use crate::build::Build;
use crate::layout::{Demand, cell_count, first_plan, formula_bytes, plan};
use crate::{Config, Contents, Header, Pool, well_formed};

/// Structure with lists of triangles in cells of one size, made from a [`Config`].
pub type Grid = Pooled<Passes>;

/// Pipelines of the build, which are the design of [`Grid`].
#[derive(Debug)]
pub struct Passes(Build);

/// Returns the number of cells along each axis, and true if the capacity suffices for the cells that the
/// geometry needs. If the capacity does not suffice, there is one cell.
fn cells(config: &Config, sizes: &Sizes, extent: &GeometryExtent) -> ([u32; 3], bool) {
    let wanted = config.cells_over(extent);
    let fits = cell_count(wanted) <= sizes.elements_of(Pool::Lists);
    (if fits { wanted } else { [1; 3] }, fits)
}

/// Returns the maximum number of iterations of the loops over the cells of a triangle, in all its
/// invocations. A plane has three times the cells of the largest side of the grid. With the margins of a
/// triangle it has twice as many, and some of its columns have none.
fn turns(cells: [u32; 3]) -> u64 {
    let [x, y, z] = cells.map(u64::from);
    8 * (x * y).max(y * z).max(z * x)
}

/// Returns the header that the next build starts from.
fn first_header(config: &Config, sizes: &Sizes, extent: &GeometryExtent, eye: [f32; 3]) -> Header {
    let (cells, fits) = cells(config, sizes, extent);
    Header {
        capacity: sizes.elements_of(Pool::Entries) as u32,
        cells,
        eye,
        // A capacity of zero, if cells do not fit, makes the build incomplete.
        triangle_capacity: if fits { queue_capacity(sizes, cells) } else { 0 },
        groups: [0, 0, bin_groups(turns(cells))],
        ..Header::default()
    }
}

/// Returns the number of triangles that fit into the large-triangle queue, behind the sums of the scan over
/// `cells`.
fn queue_capacity(sizes: &Sizes, cells: [u32; 3]) -> u32 {
    sizes.elements_of(Pool::Scratch).saturating_sub(Scan::sums(cell_count(cells))) as u32
}

impl rasray_ads::kit::Demand for Demand {
    fn zip(self, other: Self, mut with: impl FnMut(&'static str, u64, u64) -> u64) -> Self {
        Self { entries: with("entries", self.entries, other.entries), ..self }
    }
}

impl Design for Passes {
    type Config = Config;
    type Header = Header;
    type Demand = Demand;
    type Pool = Pool;
    type Contents = Contents;

    const NAME: &'static str = "grid";
    const TITLE: &'static str = "the grid";
    const BUILD_READS_SCENE: bool = false;
    const CORRUPTED: usize = offset_of!(Header, corrupted);
    const RECORDS: &'static [RecordLayout] = &[Header::LAYOUT];
    const HAS_SURFACES_OF_TRIANGLES: bool = true;

    fn kind(_config: &Config) -> StructureKind {
        StructureKind::Primitive
    }

    fn depends_on(_config: &Config) -> Dependencies {
        Dependencies { eye: true, camera: false }
    }

    /// Returns true if the eye has moved so that the grid is stale. Cells depend on the eye only through a
    /// margin for an eye far away.
    fn is_stale(parts: &Parts<Config>, built: Viewpoint, wanted: Viewpoint) -> bool {
        !box_is_same(&parts.extent(), built, wanted)
            && Self::depends_on(&parts.config).are_stale(built, wanted)
    }

    fn requirements(_config: &Config) -> Requirements {
        Requirements::compute()
    }

    fn constants(_config: &Config) -> Vec<(u32, u32)> {
        Vec::new()
    }

    fn first_plan(config: &Config, extent: &GeometryExtent) -> Result<Sizes, AdsError> {
        first_plan(config, extent)
    }

    fn plan(config: &Config, demand: &Demand) -> Result<Sizes, AdsError> {
        plan(config, demand)
    }

    fn plan_for(config: &Config, sizes: &Sizes, extent: &GeometryExtent) -> Result<Option<Sizes>, AdsError> {
        let wanted = plan(config, &Self::capacity(config, sizes, extent))?;
        Ok(wanted.exceed(sizes).then_some(wanted))
    }

    fn make(
        pipelines: &BuildPipelines<'_>,
        _config: &Config,
        _scene: Option<&SceneBinding>,
    ) -> Result<Self, AdsError> {
        Build::new(pipelines).map(Self)
    }

    fn first_header(&mut self, parts: &Parts<Config>, viewpoint: Viewpoint) -> Result<Header, AdsError> {
        Ok(first_header(&parts.config, parts.pools.sizes(), &parts.extent(), viewpoint.eye))
    }

    fn record_passes(&self, recorder: &mut Recorder<'_>, parts: &Parts<Config>, scene: Option<&BindingSet>) {
        let (cells, _) = cells(&parts.config, parts.pools.sizes(), &parts.extent());
        self.0.record(recorder, cell_count(cells), parts.target(scene));
    }

    fn asked(&self, parts: &Parts<Config>, header: &Header) -> Demand {
        let capacity = Self::capacity(&parts.config, parts.pools.sizes(), &parts.extent());
        Demand { entries: header.demand.into(), ..capacity }
    }

    fn capacity(config: &Config, sizes: &Sizes, extent: &GeometryExtent) -> Demand {
        Demand {
            entries: sizes.elements_of(Pool::Entries),
            triangles: extent.triangle_count.into(),
            cells: config.cells_over(extent),
        }
    }

    fn ample_rounds(parts: &Parts<Config>, _header: &Header) -> u32 {
        parts.rounds_with_distant_rays()
    }

    fn report(parts: &Parts<Config>, _header: &Header, asked: &Demand) -> StructureReport {
        StructureReport {
            options: parts.config.options(asked.cells),
            paths: parts.config.paths(),
            formula_bytes: formula_bytes(asked).total(),
            stored: Some(asked.entries),
            ..StructureReport::default()
        }
    }

    fn fault(contents: &Contents, triangles: u32) -> Option<String> {
        well_formed(contents, triangles).err().map(|fault| fault.to_string())
    }

    fn list_counts(contents: &Contents) -> Result<Vec<ListCounts>, String> {
        Ok(vec![contents.list_counts().map_err(|fault| fault.to_string())?])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const BOUNDS: [[f32; 3]; 2] = [[0.0; 3], [4.0, 2.0, 1.0]];

    #[test]
    fn pools_are_planned_without_a_device() {
        let extent = GeometryExtent::new(1_000, BOUNDS);
        for config in [Config::new(), Config { cells: Some(16), ..Config::new() }] {
            let sizes = Passes::first_plan(&config, &extent).expect("options are in range");
            // The capacity of these pools, expressed as a demand, has to plan these pools again.
            let capacity = Passes::capacity(&config, &sizes, &extent);
            assert_eq!(Passes::plan(&config, &capacity).expect("options are in range"), sizes, "{config:?}");
            let of = |triangles| {
                let extent = GeometryExtent::new(triangles, BOUNDS);
                Passes::plan_for(&config, &sizes, &extent).expect("options are in range")
            };
            assert_eq!([0, 1, 500, 1_000].map(of), [const { None }; 4], "{config:?}");
            assert!(of(2_000).is_some_and(|larger| larger.exceed(&sizes)), "{config:?}");
        }
    }

    #[test]
    fn cells_that_do_not_fit_are_not_built() {
        let [few, many] = [1_000, 1_000_000].map(|triangles| GeometryExtent::new(triangles, BOUNDS));
        let config = Config::new();
        let sizes = Passes::first_plan(&config, &few).expect("options are in range");
        assert_eq!(cells(&config, &sizes, &few), (config.cells_over(&few), true));
        assert_eq!(cells(&config, &sizes, &many), ([1; 3], false));
        let capacity = |extent| first_header(&config, &sizes, extent, [0.0; 3]).triangle_capacity;
        assert_eq!([&few, &many].map(capacity), [1_000, 0]);
    }
}
