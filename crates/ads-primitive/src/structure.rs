//! Primitive lists as a structure.

use rasray_ads::{
    AdsError, BuildPipelines, BuildStatus, BuildTarget, Check, Counters, Geometry, InlineTrace, Modules,
    PoolSize, PoolStatus, Pools, RayQueue, SceneBinding, Sizes, Structure, StructureKind, StructureReport,
    TraceKernels, TraceKernelsDesc, TraceMode, Viewpoint,
};
use rasray_gpu::{Device, Feature, GpuError, Recorder, Requirements};
use rasray_shaders_glsl::constants::ads::{NEAR_BOX, TRIANGLE_ROUNDING};
use rasray_shaders_glsl::constants::contract::{STATUS_COMPLETE, TRACE_WORK_BUDGET};
use rasray_shaders_glsl::constants::primitive as numbers;

use crate::build::Build;
use crate::build_bricks::BuildBricks;
use crate::centre::centre_within;
use crate::config::BRICK_SIDE;
use crate::layout::{
    Demand, bin_groups, brick_words, cells_pool, first_plan, formula_bytes, plan, triangle_words,
};
use crate::views::placed;
use crate::{Builder, Centre, Config, Contents, Header, Storage, Views};

/// The passes of a storage.
#[derive(Debug)]
enum Passes {
    Lists(Build),
    Bricks(BuildBricks),
}

/// Lists of triangles per tile and depth bucket, or in bricks of cells.
#[derive(Debug)]
pub struct PrimitiveLists {
    config: Config,
    geometry: Geometry,
    build: Passes,
    kernels: TraceKernels,
    pools: Pools,
}

/// Its shaders.
fn modules(config: &Config) -> Modules {
    Modules { structure: "dirt", prefix: "primitive", addressing: config.addressing }
}

impl PrimitiveLists {
    /// Makes pipelines and a first set of pools. `scene` is needed for alpha masks and surfaces.
    ///
    /// # Errors
    /// An option is out of range or needs what the device does not provide; out of memory; a pool exceeds
    /// what one binding can hold (then use device addresses).
    pub fn new(
        device: &Device,
        config: Config,
        geometry: &Geometry,
        scene: Option<&SceneBinding>,
    ) -> Result<Self, AdsError> {
        let sizes = first_plan(&config, geometry)?;
        config.addressing.check(device)?;
        device.require("the primitive lists", &Self::requirements_of(&config))?;
        let pools = Pools::new(device, "primitive", config.addressing, &sizes)?;
        let modules = modules(&config);
        let constants = config.constants();
        let pipelines = BuildPipelines::new(device, modules, geometry, &pools, None, &constants);
        let build = match config.storage {
            Storage::Bricks => Passes::Bricks(BuildBricks::new(&pipelines, &config)?),
            Storage::Linked | Storage::Contiguous => Passes::Lists(Build::new(&pipelines, &config)?),
        };
        let kernels = TraceKernels::new(
            device,
            geometry,
            &TraceKernelsDesc {
                modules: modules.trace(scene)?,
                structure_layout: pools.layout(),
                constants: &constants,
                counters: config.counters,
                work_budget: config.work_budget,
                scene,
            },
        )?;

        Ok(Self { config, geometry: geometry.clone(), build, kernels, pools })
    }

    /// What a device must and may offer for a configuration.
    pub fn requirements_of(config: &Config) -> Requirements {
        let mut requirements = Requirements::floor();
        if config.builder() == Builder::Raster {
            requirements.required.push(Feature::FragmentStoresAndAtomics);
        }
        modules(config).add_to(&mut requirements);
        requirements
    }

    /// The configuration it was made with.
    pub fn config(&self) -> &Config {
        &self.config
    }

    /// Columns, rows and slices of each view, one brick where there is no room for those that the geometry
    /// asks for; and whether there is.
    fn cells(&self) -> ([u32; 3], bool) {
        let wanted = self.config.cells(&self.geometry);
        let room = self.pools.sizes().elements(cells_pool(self.config.storage));
        let fits = self.config.storage != Storage::Bricks || brick_words(&self.config, wanted) <= room;
        (if fits { wanted } else { [BRICK_SIDE; 3] }, fits)
    }

    /// The header that the next build starts from.
    fn first_header(&self, eye: [f32; 3]) -> Header {
        let [lower, upper] = self.geometry.bounds();
        let (cells, fits) = self.cells();
        let along_axes = (self.config.views == Views::Axes).then(|| placed(eye, [lower, upper], cells));
        let centre = match (&along_axes, self.config.centre) {
            (Some(at), _) => at.centre,
            (None, Centre::Eye) => eye,
            (None, Centre::Scene) => centre_within(eye, [lower, upper]),
        };
        let relative =
            |corner: [f32; 3]| std::array::from_fn::<f32, 3, _>(|axis| corner[axis] - centre[axis]);
        let (lower, upper) = (relative(lower), relative(upper));
        let farthest = lower.iter().chain(&upper).fold(0.0_f32, |far, x| far.max(x.abs()));
        let farthest = along_axes.map_or(farthest, |at| at.reach);
        // A difference of two coordinates is rounded relative to itself, so it does not matter how far the
        // centre is from the frame origin.
        let rounding = match self.config.storage {
            Storage::Bricks => numbers::PRIMITIVE_BRICK_ROUNDING,
            Storage::Linked | Storage::Contiguous => TRIANGLE_ROUNDING,
        } * farthest;
        // What a ray outside of the near box meets is not behind the centre, also where tiles are few.
        let near_size = (NEAR_BOX * self.config.tiles() as f32 * farthest).max(2.0 * rounding);
        Header {
            capacity: self.pools.sizes().elements("entries") as u32,
            near_capacity: self.pools.sizes().elements("near") as u32,
            tiles: if self.config.storage == Storage::Bricks { cells[0] } else { self.config.tiles() },
            tile: self.config.tile,
            reach: farthest,
            // Depths are positive, also where all geometry is at the eye.
            near_size: near_size.max(1.0e-30),
            rounding,
            centre,
            lower: lower.map(|x| x - rounding),
            upper: upper.map(|x| x + rounding),
            bounds_address: self.pools.address_of(cells_pool(self.config.storage)),
            lists_address: self.pools.address_of("lists"),
            entries_address: self.pools.address_of("entries"),
            sums_address: self.pools.address_of("sums"),
            near_address: self.pools.address_of("near"),
            records_address: self.pools.address_of("records"),
            triangles_address: self.pools.address_of("triangles"),
            slices: cells[2],
            rows: cells[1],
            record_capacity: self.pools.sizes().elements("records") as u32,
            cell_capacity: self.pools.sizes().elements("lists") as u32,
            // None where bricks do not fit, so that the build is not complete.
            triangle_capacity: if fits { self.pools.sizes().elements("triangles") as u32 } else { 0 },
            groups: [0, 0, bin_groups(&self.config)],
            cells_lower: along_axes.map_or([0.0; 3], |at| at.lower),
            cells_per_metre: along_axes.map_or([0.0; 3], |at| at.per_metre),
            ..Header::default()
        }
    }

    /// What there is room for.
    fn allocated(&self) -> Demand {
        let elements = |name| self.pools.sizes().elements(name);
        Demand {
            entries: elements("entries"),
            near: elements("near"),
            records: elements("records"),
            cells: elements("lists"),
            triangles: elements("triangles"),
            grid: self.config.cells(&self.geometry),
        }
    }

    /// The header as the last build left it. The caller has waited for the submission.
    ///
    /// # Errors
    /// Host-visible memory could not be read.
    pub fn header(&self) -> Result<Header, GpuError> {
        self.pools.header()
    }

    /// Downloads all pools, for checks. Submits and waits: for tests and tools.
    ///
    /// # Errors
    /// The device failed.
    pub fn download(&self, device: &Device) -> Result<Contents, GpuError> {
        let words = |name| self.pools.download_words(device, name);
        Ok(Contents {
            config: self.config,
            header: device.download_as::<Header>(self.pools.pool("header"), 0, 1)?[0],
            bounds: words(cells_pool(self.config.storage))?,
            lists: words("lists")?,
            entries: words("entries")?,
            near: words("near")?,
        })
    }

    /// Writes these pools back, as [`PrimitiveLists::download`] returned them or changed. Submits and waits: for tests
    /// and tools. Traces end within their bounds whatever lists say; the header is taken at its word.
    ///
    /// # Errors
    /// A pool is larger than what was allocated, or the device failed.
    pub fn upload(&self, device: &Device, contents: &Contents) -> Result<(), GpuError> {
        device.upload(self.pools.pool("header"), 0, bytemuck::bytes_of(&contents.header))?;
        device.upload_slice(self.pools.pool(cells_pool(self.config.storage)), 0, &contents.bounds)?;
        device.upload_slice(self.pools.pool("lists"), 0, &contents.lists)?;
        device.upload_slice(self.pools.pool("entries"), 0, &contents.entries)?;
        device.upload_slice(self.pools.pool("near"), 0, &contents.near)
    }

    /// Rounds that nearly every ray is finished in.
    fn first_rounds(&self) -> u32 {
        // Rays from far outside are tested against every triangle, others against what a few cells list.
        let budget = self.config.work_budget.unwrap_or(TRACE_WORK_BUDGET);
        16 + 2 * self.geometry.triangle_count().div_ceil(budget)
    }
}

impl Structure for PrimitiveLists {
    fn name(&self) -> &'static str {
        "dirt"
    }

    fn kind(&self) -> StructureKind {
        if self.config.is_exact() { StructureKind::Primitive } else { StructureKind::LossyPrimitive }
    }

    fn requirements(&self) -> Requirements {
        Self::requirements_of(&self.config)
    }

    fn counters(&self) -> Counters {
        self.kernels.counters()
    }

    fn sizes(&self) -> &Sizes {
        self.pools.sizes()
    }

    fn resize(&mut self, device: &Device, sizes: &Sizes) -> Result<(), AdsError> {
        self.pools.resize(device, sizes)
    }

    fn set_geometry(&mut self, device: &Device, geometry: &Geometry) -> Result<(), AdsError> {
        let triangles = u64::from(geometry.triangle_count());
        let now = self.allocated();
        let triangles = triangles.max(now.triangles);
        let sizes = plan(&self.config, &Demand { triangles, grid: self.config.cells(geometry), ..now })?;
        let grows = |pool: &PoolSize| pool.elements > self.pools.sizes().elements(pool.name);
        if sizes.pools.iter().any(grows) {
            self.pools.resize(device, &sizes)?;
        }
        self.geometry = geometry.clone();
        Ok(())
    }

    fn record_build(&mut self, recorder: &mut Recorder<'_>, viewpoint: Viewpoint) -> Result<(), AdsError> {
        self.pools.set_header(&self.first_header(viewpoint.eye));
        let target = BuildTarget { geometry: &self.geometry, pools: &self.pools, scene: None };
        match &self.build {
            Passes::Lists(build) => build.record(recorder, &self.config, target),
            Passes::Bricks(build) => build.record(recorder, &self.config, self.cells().0, target),
        }
        Ok(())
    }

    fn status(&self) -> Result<BuildStatus, GpuError> {
        let header = self.header()?;
        let pool = |name, demand: u32, capacity: u32| PoolStatus {
            name,
            demand: demand.into(),
            capacity: capacity.into(),
        };
        let mut pools = vec![
            pool("entries", header.demand, header.capacity),
            pool("near", header.near_demand, header.near_capacity),
        ];
        if self.config.storage == Storage::Bricks {
            pools.push(pool("records", header.record_demand, header.record_capacity));
            // Cells are marked by records that were stored. Where some were not, none has more cells than entries.
            let all = header.record_demand <= header.record_capacity;
            let cells = if all { header.cell_demand } else { header.demand };
            pools.push(pool("lists", cells, header.cell_capacity));
        }
        Ok(BuildStatus {
            complete: header.status & STATUS_COMPLETE != 0,
            pools,
            unsorted: 0,
            outside: self.pools.outside()?,
            corrupted: header.corrupted.into(),
        })
    }

    fn check(&self, status: &BuildStatus, headroom: u32) -> Result<Check, AdsError> {
        let demand = |name| status.demand(name).unwrap_or(0);
        let allocated = self.allocated();
        status.check(headroom, |growth| {
            let demand = Demand {
                entries: growth.of(demand("entries"), allocated.entries),
                near: growth.of(demand("near"), allocated.near),
                records: growth.of(demand("records"), allocated.records),
                cells: growth.of(demand("lists"), allocated.cells),
                triangles: allocated.triangles.max(self.geometry.triangle_count().into()),
                grid: allocated.grid,
            };
            plan(&self.config, &demand)
        })
    }

    fn rounds(&self) -> u32 {
        self.pools.rounds(self.first_rounds())
    }

    fn allow_more_rounds(&self) -> bool {
        let budget = self.config.work_budget.unwrap_or(TRACE_WORK_BUDGET);
        self.pools.allow_rounds_to_read_all(self.first_rounds(), budget)
    }

    fn record_trace(
        &self,
        recorder: &mut Recorder<'_>,
        queue: &RayQueue,
        count: u32,
        mode: TraceMode,
        rounds: u32,
    ) {
        self.pools.record_trace(recorder, &self.kernels, &self.geometry, queue, count, mode, rounds);
    }

    fn record_surfaces(
        &self,
        recorder: &mut Recorder<'_>,
        queue: &RayQueue,
        count: u32,
    ) -> Result<(), AdsError> {
        self.pools.record_surfaces(recorder, &self.kernels, &self.geometry, queue, count)
    }

    fn inline_trace(&self) -> Option<InlineTrace<'_>> {
        Some(self.pools.inline_trace(self.config.constants()))
    }

    fn report(&self) -> Result<StructureReport, GpuError> {
        let header = self.header()?;
        let bricks = self.config.storage == Storage::Bricks;
        let demand = Demand {
            entries: header.demand.into(),
            near: header.near_demand.into(),
            records: header.record_demand.into(),
            cells: header.cell_demand.into(),
            triangles: self.geometry.triangle_count().into(),
            grid: self.config.cells(&self.geometry),
        };
        let needed = plan(&self.config, &demand);
        let needed = |pool| needed.as_ref().map_or(0, |sizes| sizes.elements(pool));
        let bytes_by_part = self.pools.bytes_by_part(|pool| match pool.name {
            "entries" => demand.entries,
            "near" => demand.near,
            "records" => demand.records,
            "lists" if bricks => demand.cells,
            "bricks" | "sums" => needed(pool.name),
            "triangles" if triangle_words(&self.config) > 0 => demand.triangles,
            _ => pool.elements,
        });
        Ok(StructureReport {
            options: self.config.options(demand.grid),
            paths: self.config.paths(),
            bytes_by_part,
            formula_bytes: formula_bytes(&self.config, &demand).total(),
            diagnostic_bytes: 0,
            stored: Some(demand.entries),
            lost: None,
        })
    }
}
