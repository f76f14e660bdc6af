//! Implementation of bricks as a structure.

use std::mem::offset_of;

use rasray_ads::kit::{BuildPipelines, Design, Parts, Pooled, box_is_same};
use rasray_ads::{
    AdsError, Dependencies, GeometryExtent, RecordLayout, SceneBinding, Sizes, StructureKind,
    StructureReport, Viewpoint,
};
use rasray_gpu::{BindingSet, Recorder, Requirements};

use rasray_shaders_glsl::constants::ads::BUILD_GROUP_SIZE;
use rasray_shaders_glsl::constants::bricks::BRICKS_GROUPS_MOST;

use crate::build::Build;
use crate::grid::BRICK_SIDE;
use crate::layout::{Demand, bricks_of, first_demand, first_plan, formula_bytes, plan};
use crate::{Config, Contents, Header, Pool, Views, well_formed};

/// Structure with lists of triangles in bricks of cells, made from a [`Config`].
pub type Bricks = Pooled<Passes>;

/// Pipelines of the build, which are the design of [`Bricks`].
#[derive(Debug)]
pub struct Passes(Build);

/// Returns the columns, rows and slices of each view, and true if the capacity suffices for the bricks that
/// the geometry needs. If the capacity does not suffice, each view has one brick.
fn cells(config: &Config, sizes: &Sizes, extent: &GeometryExtent) -> ([u32; 3], bool) {
    let wanted = config.cells(extent);
    let fits = bricks_of(config.views, wanted).1 <= sizes.elements_of(Pool::Bricks);
    (if fits { wanted } else { [BRICK_SIDE; 3] }, fits)
}

/// Returns the group counts of an indirect dispatch per level: `first` for the first level, and none for the
/// others before the device counts them.
fn groups_of_levels(first: u32) -> [u32; 12] {
    std::array::from_fn(|word| match word {
        0 => first,
        word => u32::from(word % 3 != 0),
    })
}

/// Returns the header that the next build starts from.
fn first_header(config: &Config, sizes: &Sizes, extent: &GeometryExtent, eye: [f32; 3]) -> Header {
    let (cells, fits) = cells(config, sizes, extent);
    let of_views = bricks_of(config.views, cells).1 as u32;
    let capacity = |pool| sizes.elements_of(pool) as u32;
    Header {
        depths: [config.depth_for(cells); 3],
        brick_demand: of_views,
        brick_capacity: capacity(Pool::Bricks),
        brick_first: [0, of_views, 0, 0, 0],
        brick_groups: groups_of_levels(of_views.div_ceil(BUILD_GROUP_SIZE).min(BRICKS_GROUPS_MOST)),
        record_groups: groups_of_levels(0),
        capacity: capacity(Pool::Entries),
        near_capacity: capacity(Pool::Near),
        columns: cells[0],
        rows: cells[1],
        slices: cells[2],
        eye,
        record_capacity: capacity(Pool::Records),
        cell_capacity: capacity(Pool::Lists),
        // A capacity of zero, if bricks do not fit, makes the build incomplete.
        triangle_capacity: if fits { capacity(Pool::Triangles) } else { 0 },
        groups: [0, 0, 1],
        ..Header::default()
    }
}

impl rasray_ads::kit::Demand for Demand {
    fn zip(self, other: Self, mut with: impl FnMut(&'static str, u64, u64) -> u64) -> Self {
        Self {
            entries: with("entries", self.entries, other.entries),
            near: with("near", self.near, other.near),
            records: with("records", self.records, other.records),
            bricks: with("bricks", self.bricks, other.bricks),
            cells: with("lists", self.cells, other.cells),
            ..self
        }
    }
}

impl Design for Passes {
    type Config = Config;
    type Header = Header;
    type Demand = Demand;
    type Pool = Pool;
    type Contents = Contents;

    const NAME: &'static str = "bricks";
    const TITLE: &'static str = "the bricks";
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

    /// Returns true if the eye has moved so that the bricks are stale. Cells along the axes depend on the eye
    /// only through a margin for an eye far away.
    fn is_stale(parts: &Parts<Config>, built: Viewpoint, wanted: Viewpoint) -> bool {
        let is_same = parts.config.views == Views::Axes && box_is_same(&parts.extent(), built, wanted);
        !is_same && Self::depends_on(&parts.config).are_stale(built, wanted)
    }

    fn requirements(config: &Config) -> Requirements {
        config.builder.requirements()
    }

    fn constants(config: &Config) -> Vec<(u32, u32)> {
        config.constants()
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
        config: &Config,
        _scene: Option<&SceneBinding>,
    ) -> Result<Self, AdsError> {
        Build::new(pipelines, config).map(Self)
    }

    fn first_header(&mut self, parts: &Parts<Config>, viewpoint: Viewpoint) -> Result<Header, AdsError> {
        Ok(first_header(&parts.config, parts.pools.sizes(), &parts.extent(), viewpoint.eye))
    }

    fn record_passes(&self, recorder: &mut Recorder<'_>, parts: &Parts<Config>, scene: Option<&BindingSet>) {
        let (cells, _) = cells(&parts.config, parts.pools.sizes(), &parts.extent());
        self.0.record(recorder, &parts.config, cells, parts.target(scene));
    }

    fn asked(&self, parts: &Parts<Config>, header: &Header) -> Demand {
        // Only stored records mark cells. Unless all records are stored, the bound is one cell per entry.
        let all = header.record_demand <= header.record_capacity;
        let extent = parts.extent();
        let counted = Demand {
            entries: header.demand.into(),
            near: header.near_demand.into(),
            records: header.record_demand.into(),
            bricks: header.brick_demand.into(),
            cells: if all { header.cell_demand } else { header.demand }.into(),
            triangles: extent.triangle_count.into(),
            grid: parts.config.cells(&extent),
        };
        let fits =
            all && header.cell_demand <= header.cell_capacity && header.brick_demand <= header.brick_capacity;
        if fits || !parts.config.divides() {
            return counted;
        }
        // The build counts the cells of a level only if those of the level before fit. The demand is at least
        // the first guess, so that few builds are needed.
        let guess = first_demand(&parts.config, &extent);
        Demand {
            records: counted.records.max(guess.records),
            bricks: counted.bricks.max(guess.bricks),
            cells: counted.cells.max(guess.cells),
            ..counted
        }
    }

    fn capacity(config: &Config, sizes: &Sizes, extent: &GeometryExtent) -> Demand {
        Demand {
            entries: sizes.elements_of(Pool::Entries),
            near: sizes.elements_of(Pool::Near),
            records: sizes.elements_of(Pool::Records),
            bricks: sizes.elements_of(Pool::Bricks),
            cells: sizes.elements_of(Pool::Lists),
            triangles: sizes.elements_of(Pool::Triangles).max(extent.triangle_count.into()),
            grid: config.cells(extent),
        }
    }

    fn ample_rounds(parts: &Parts<Config>, _header: &Header) -> u32 {
        parts.rounds_with_distant_rays()
    }

    fn report(parts: &Parts<Config>, _header: &Header, asked: &Demand) -> StructureReport {
        StructureReport {
            options: parts.config.options(asked.grid),
            paths: parts.config.paths(),
            formula_bytes: formula_bytes(&parts.config, asked).total(),
            stored: Some(asked.entries),
            ..StructureReport::default()
        }
    }

    fn fault(contents: &Contents, triangles: u32) -> Option<String> {
        well_formed(contents, triangles).err().map(|fault| fault.to_string())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const BOUNDS: [[f32; 3]; 2] = [[0.0; 3], [4.0, 2.0, 1.0]];

    #[test]
    fn pools_are_planned_without_a_device() {
        let extent = GeometryExtent::new(1_000, BOUNDS);
        for config in [Config::new(Views::Cube), Config::new(Views::Axes)] {
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
    fn bricks_that_do_not_fit_are_not_built() {
        let [few, many] = [1_000, 1_000_000].map(|triangles| GeometryExtent::new(triangles, BOUNDS));
        for config in [Config::new(Views::Cube), Config::new(Views::Axes)] {
            let sizes = Passes::first_plan(&config, &few).expect("options are in range");
            assert_eq!(cells(&config, &sizes, &few), (config.cells(&few), true));
            assert_eq!(cells(&config, &sizes, &many), ([BRICK_SIDE; 3], false));
            let capacity = |extent| first_header(&config, &sizes, extent, [0.0; 3]).triangle_capacity;
            assert_eq!([&few, &many].map(capacity), [1_000, 0]);
        }
    }
}
