//! Primitive lists as a structure.

use bytemuck::cast_slice;
use rasray_ads::{
    AdsError, BuildPipelines, Common, Design, Geometry, Outcome, Parts, PoolSize, Pooled, SceneBinding,
    Sizes, StructureKind, StructureReport, Viewpoint,
};
use rasray_gpu::{BindingSet, Device, GpuError, Recorder, Requirements};
use rasray_shaders_glsl::constants::ads::{NEAR_BOX, TRIANGLE_ROUNDING};
use rasray_shaders_glsl::constants::contract::TRACE_WORK_BUDGET;
use rasray_shaders_glsl::constants::primitive as numbers;

use crate::build::Build;
use crate::build_bricks::BuildBricks;
use crate::centre::centre_within;
use crate::config::BRICK_SIDE;
use crate::layout::{
    Demand, bin_groups, brick_words, cells_pool, first_plan, formula_bytes, plan, triangle_words,
};
use crate::views::placed;
use crate::{Centre, Config, Contents, Header, Storage, Views};

/// Lists of triangles per tile and depth bucket, or in bricks of cells; made from a [`Config`].
pub type PrimitiveLists = Pooled<Passes>;

/// Pipelines of the build: the design of [`PrimitiveLists`].
#[derive(Debug)]
pub struct Passes(OfStorage);

#[derive(Debug)]
enum OfStorage {
    Lists(Build),
    Bricks(BuildBricks),
}

/// Columns, rows and slices of each view, one brick where there is no room for those that the geometry
/// asks for; and whether there is.
fn cells(parts: &Parts<Config>) -> ([u32; 3], bool) {
    let Parts { config, geometry, .. } = parts;
    let wanted = config.cells(geometry);
    let room = parts.elements(cells_pool(config.storage));
    let fits = config.storage != Storage::Bricks || brick_words(config, wanted) <= room;
    (if fits { wanted } else { [BRICK_SIDE; 3] }, fits)
}

/// The header that the next build starts from.
fn first_header(parts: &Parts<Config>, eye: [f32; 3]) -> Header {
    let Parts { config, geometry, pools } = parts;
    let [lower, upper] = geometry.bounds();
    let (cells, fits) = cells(parts);
    let along_axes = (config.views == Views::Axes).then(|| placed(eye, [lower, upper], cells));
    let centre = match (&along_axes, config.centre) {
        (Some(at), _) => at.centre,
        (None, Centre::Eye) => eye,
        (None, Centre::Scene) => centre_within(eye, [lower, upper]),
    };
    let relative = |corner: [f32; 3]| std::array::from_fn::<f32, 3, _>(|axis| corner[axis] - centre[axis]);
    let (lower, upper) = (relative(lower), relative(upper));
    let farthest = lower.iter().chain(&upper).fold(0.0_f32, |far, x| far.max(x.abs()));
    let farthest = along_axes.map_or(farthest, |at| at.reach);
    // A difference of two coordinates is rounded relative to itself, so it does not matter how far the
    // centre is from the frame origin.
    let rounding = match config.storage {
        Storage::Bricks => numbers::PRIMITIVE_BRICK_ROUNDING,
        Storage::Linked | Storage::Contiguous => TRIANGLE_ROUNDING,
    } * farthest;
    // What a ray outside of the near box meets is not behind the centre, also where tiles are few.
    let near_size = (NEAR_BOX * config.tiles() as f32 * farthest).max(2.0 * rounding);
    Header {
        capacity: parts.elements("entries") as u32,
        near_capacity: parts.elements("near") as u32,
        tiles: if config.storage == Storage::Bricks { cells[0] } else { config.tiles() },
        tile: config.tile,
        reach: farthest,
        // Depths are positive, also where all geometry is at the eye.
        near_size: near_size.max(1.0e-30),
        rounding,
        centre,
        lower: lower.map(|x| x - rounding),
        upper: upper.map(|x| x + rounding),
        bounds_address: pools.address_of(cells_pool(config.storage)),
        lists_address: pools.address_of("lists"),
        entries_address: pools.address_of("entries"),
        sums_address: pools.address_of("sums"),
        near_address: pools.address_of("near"),
        records_address: pools.address_of("records"),
        triangles_address: pools.address_of("triangles"),
        slices: cells[2],
        rows: cells[1],
        record_capacity: parts.elements("records") as u32,
        cell_capacity: parts.elements("lists") as u32,
        // None where bricks do not fit, so that the build is not complete.
        triangle_capacity: if fits { parts.elements("triangles") as u32 } else { 0 },
        groups: [0, 0, bin_groups(config)],
        cells_lower: along_axes.map_or([0.0; 3], |at| at.lower),
        cells_per_metre: along_axes.map_or([0.0; 3], |at| at.per_metre),
        ..Header::default()
    }
}

impl rasray_ads::Demand for Demand {
    fn zip(self, other: Self, mut with: impl FnMut(&'static str, u64, u64) -> u64) -> Self {
        let (entries, near) =
            (with("entries", self.entries, other.entries), with("near", self.near, other.near));
        // Lists have no slices, nor what is counted for bricks alone.
        if self.grid[2] == 0 {
            return Self { entries, near, ..self };
        }
        let records = with("records", self.records, other.records);
        Self { entries, near, records, cells: with("lists", self.cells, other.cells), ..self }
    }
}

impl Design for Passes {
    type Config = Config;
    type Header = Header;
    type Demand = Demand;
    type Contents = Contents;

    const NAME: &'static str = "dirt";
    const PREFIX: &'static str = "primitive";
    const TITLE: &'static str = "the primitive lists";
    const BUILD_READS_SCENE: bool = false;

    fn common(config: &Config) -> Common {
        let Config { addressing, counters, work_budget, .. } = *config;
        Common { addressing, counters, work_budget }
    }

    fn kind(config: &Config) -> StructureKind {
        if config.is_exact() { StructureKind::Primitive } else { StructureKind::LossyPrimitive }
    }

    fn requirements(config: &Config) -> Requirements {
        config.builder().requirements()
    }

    fn constants(config: &Config) -> Vec<(u32, u32)> {
        config.constants()
    }

    fn first_plan(config: &Config, geometry: &Geometry) -> Result<Sizes, AdsError> {
        first_plan(config, geometry)
    }

    fn plan(config: &Config, demand: &Demand) -> Result<Sizes, AdsError> {
        plan(config, demand)
    }

    fn plan_for(parts: &Parts<Config>, geometry: &Geometry) -> Result<Option<Sizes>, AdsError> {
        let now = Self::room(parts);
        let triangles = u64::from(geometry.triangle_count()).max(parts.elements("triangles"));
        let grid = parts.config.cells(geometry);
        let sizes = plan(&parts.config, &Demand { triangles, grid, ..now })?;
        let grows = |pool: &PoolSize| pool.elements > parts.elements(pool.name);
        Ok(sizes.pools.iter().any(grows).then_some(sizes))
    }

    fn make(
        pipelines: &BuildPipelines<'_>,
        config: &Config,
        _scene: Option<&SceneBinding>,
    ) -> Result<Self, AdsError> {
        Ok(Self(match config.storage {
            Storage::Bricks => OfStorage::Bricks(BuildBricks::new(pipelines, config)?),
            Storage::Linked | Storage::Contiguous => OfStorage::Lists(Build::new(pipelines, config)?),
        }))
    }

    fn first_header(&mut self, parts: &Parts<Config>, viewpoint: Viewpoint) -> Result<Header, AdsError> {
        Ok(first_header(parts, viewpoint.eye))
    }

    fn record_passes(&self, recorder: &mut Recorder<'_>, parts: &Parts<Config>, scene: Option<&BindingSet>) {
        let target = parts.target(scene);
        match &self.0 {
            OfStorage::Lists(build) => build.record(recorder, &parts.config, target),
            OfStorage::Bricks(build) => build.record(recorder, &parts.config, cells(parts).0, target),
        }
    }

    fn outcome(header: &Header) -> Outcome {
        Outcome { status: header.status, unsorted: 0, corrupted: header.corrupted }
    }

    fn asked(&self, parts: &Parts<Config>, header: &Header) -> Demand {
        // Cells are marked by records that were stored. Where some were not, none has more cells than entries.
        let all = header.record_demand <= header.record_capacity;
        Demand {
            entries: header.demand.into(),
            near: header.near_demand.into(),
            records: header.record_demand.into(),
            cells: if all { header.cell_demand } else { header.demand }.into(),
            triangles: parts.geometry.triangle_count().into(),
            grid: parts.config.cells(&parts.geometry),
        }
    }

    fn room(parts: &Parts<Config>) -> Demand {
        Demand {
            entries: parts.elements("entries"),
            near: parts.elements("near"),
            records: parts.elements("records"),
            cells: parts.elements("lists"),
            triangles: parts.elements("triangles").max(parts.geometry.triangle_count().into()),
            grid: parts.config.cells(&parts.geometry),
        }
    }

    fn first_rounds(parts: &Parts<Config>, _header: &Header) -> u32 {
        // Rays from far outside are tested against every triangle, others against what a few cells list.
        let budget = parts.config.work_budget.unwrap_or(TRACE_WORK_BUDGET);
        16 + 2 * parts.geometry.triangle_count().div_ceil(budget)
    }

    fn used(parts: &Parts<Config>, asked: &Demand, pool: &str) -> Option<u64> {
        let config = &parts.config;
        match pool {
            "entries" => Some(asked.entries),
            "near" => Some(asked.near),
            "records" => Some(asked.records),
            "lists" if config.storage == Storage::Bricks => Some(asked.cells),
            "bricks" | "sums" => Some(plan(config, asked).map_or(0, |sizes| sizes.elements(pool))),
            "triangles" if triangle_words(config) > 0 => Some(asked.triangles),
            _ => None,
        }
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

    fn download(&self, parts: &Parts<Config>, device: &Device, header: Header) -> Result<Contents, GpuError> {
        let words = |name| parts.pools.download_words(device, name);
        Ok(Contents {
            config: parts.config,
            header,
            bounds: words(cells_pool(parts.config.storage))?,
            lists: words("lists")?,
            entries: words("entries")?,
            near: words("near")?,
        })
    }

    fn pools_of(contents: &Contents) -> (Header, Vec<(&'static str, &[u8])>) {
        let pools = vec![
            (cells_pool(contents.config.storage), cast_slice(&contents.bounds)),
            ("lists", cast_slice(&contents.lists)),
            ("entries", cast_slice(&contents.entries)),
            ("near", cast_slice(&contents.near)),
        ];
        (contents.header, pools)
    }
}
