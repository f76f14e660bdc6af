//! Voxels with axis A-buffers as a structure.

use rasray_ads::{
    AdsError, BuildPipelines, BuildStatus, BuildTarget, Check, Counters, Geometry, InlineTrace, Modules,
    PoolStatus, Pools, RayQueue, SceneBinding, Sizes, Structure, StructureKind, StructureReport,
    TraceKernels, TraceKernelsDesc, TraceMode, Viewpoint, bin_groups,
};
use rasray_gpu::{BindingSet, Device, Feature, GpuError, Recorder, Requirements};
use rasray_shaders_glsl::constants::contract::{STATUS_COMPLETE, TRACE_WORK_BUDGET};
use rasray_shaders_glsl::constants::voxel::VOXEL_REFINEMENTS;

use crate::build::Build;
use crate::layout::{
    Demand, cube, first_plan, formula_bytes, long_capacity, pair_capacity, plan, scratch_words, widest_view,
};
use crate::{Accept, Builder, Config, Contents, Coverage, Header, March, Storage};

/// Lists as long as the longest that a ray is given the rounds to read.
const LONG_LISTS_A_RAY: u32 = 64;

/// A voxel grid over three axis A-buffers.
#[derive(Debug)]
pub struct Voxels {
    config: Config,
    geometry: Geometry,
    build: Build,
    kernels: TraceKernels,
    pools: Pools,
    scene: Option<BindingSet>,
}

/// Its shaders.
fn modules(config: &Config) -> Modules {
    Modules { structure: "voxel", prefix: "voxel", addressing: config.addressing }
}

impl Voxels {
    /// Makes pipelines and a first set of pools. `scene` is needed for alpha masks, surfaces and attributes.
    ///
    /// # Errors
    /// An option is out of range or needs what the device or the caller does not provide; out of memory; a pool
    /// exceeds what one binding can hold (then use device addresses).
    pub fn new(
        device: &Device,
        config: Config,
        geometry: &Geometry,
        scene: Option<&SceneBinding>,
    ) -> Result<Self, AdsError> {
        let sizes = first_plan(&config)?;
        config.addressing.check(device)?;
        device.require("the voxels", &Self::requirements_of(&config))?;
        let pools = Pools::new(device, "voxel", config.addressing, &sizes)?;
        let modules = modules(&config);
        let constants = config.constants();
        let pipelines = BuildPipelines::new(device, modules, geometry, &pools, scene, &constants);
        let build = Build::new(&pipelines, &config, scene)?;
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
        let scene = scene.map(|scene| scene.set.clone());
        Ok(Self { config, geometry: geometry.clone(), build, kernels, pools, scene })
    }

    /// What a device must and may offer for a configuration.
    pub fn requirements_of(config: &Config) -> Requirements {
        let mut requirements = Requirements::floor();
        if config.builder == Builder::Raster {
            requirements.required.push(Feature::FragmentStoresAndAtomics);
        }
        modules(config).add_to(&mut requirements);
        requirements
    }

    /// The configuration it was made with.
    pub fn config(&self) -> &Config {
        &self.config
    }

    /// The header that the next build starts from.
    fn first_header(&self) -> Header {
        let (lower, side) = cube(self.geometry.bounds());
        let (resolution, grid) = (self.config.resolution as f32, self.config.grid() as f32);
        Header {
            capacity: self.pools.sizes().elements("fragments") as u32,
            long_capacity: long_capacity(&self.config, self.pools.sizes()) as u32,
            resolution: self.config.resolution,
            grid: self.config.grid(),
            samples: self.config.samples,
            cell: side / resolution,
            voxel: side / grid,
            cells_per_metre: resolution / side,
            voxels_per_metre: grid / side,
            lower,
            voxels_address: self.pools.address_of("voxels"),
            normals_address: self.pools.address_of("normals"),
            lists_address: self.pools.address_of("lists"),
            fragments_address: self.pools.address_of("fragments"),
            scratch_address: self.pools.address_of("scratch"),
            pair_capacity: pair_capacity(&self.config, self.pools.sizes()) as u32,
            groups: [0, 0, bin_groups(widest_view(&self.config))],
            ..Header::default()
        }
    }

    /// The header as the last build left it. The caller has waited for the submission.
    ///
    /// # Errors
    /// Host-visible memory could not be read.
    pub fn header(&self) -> Result<Header, GpuError> {
        self.pools.header()
    }

    /// Downloads what rays read, for checks. Submits and waits: for tests and tools.
    ///
    /// # Errors
    /// The device failed.
    pub fn download(&self, device: &Device) -> Result<Contents, GpuError> {
        let words = |name| self.pools.download_words(device, name);
        Ok(Contents {
            config: self.config,
            header: device.download_as::<Header>(self.pools.pool("header"), 0, 1)?[0],
            voxels: words("voxels")?,
            lists: words("lists")?,
            fragments: words("fragments")?,
        })
    }

    /// Writes back what [`Voxels::download`] returned, or what was made of it. Submits and waits: for tests and tools.
    /// Traces end within their bounds whatever voxels, lists and fragments say; the header is taken at its word.
    ///
    /// # Errors
    /// A pool is larger than what was allocated, or the device failed.
    pub fn upload(&self, device: &Device, contents: &Contents) -> Result<(), GpuError> {
        device.upload(self.pools.pool("header"), 0, bytemuck::bytes_of(&contents.header))?;
        device.upload_slice(self.pools.pool("voxels"), 0, &contents.voxels)?;
        device.upload_slice(self.pools.pool("lists"), 0, &contents.lists)?;
        device.upload_slice(self.pools.pool("fragments"), 0, &contents.fragments)
    }

    /// Rounds that nearly every ray is finished in.
    fn first_rounds(&self) -> u32 {
        // Three views' cells and the voxels along a ray, and lists that hold every triangle, where they are
        // not bisected at most so many as are as long as the longest: there each point of a parity reads one,
        // where a voxel is entered, the steps in it, halvings, and for the nearest.
        let budget = u64::from(self.config.work_budget.unwrap_or(TRACE_WORK_BUDGET));
        let steps = 12 * u64::from(self.config.resolution) + 6 * u64::from(self.config.grid());
        let points = match (self.config.accept, self.config.march) {
            (Accept::Plane, _) => 1,
            (Accept::Parity, March::Samples) => 1 + u64::from(self.config.samples),
            (Accept::Parity, March::Exact) => 2,
        };
        let parity = self.config.accept == Accept::Parity && !self.config.bisects();
        let reads = if parity { points + u64::from(VOXEL_REFINEMENTS) + 1 } else { 1 };
        let triangles = self.geometry.triangle_count();
        let longest = match self.config.bisects() {
            true => triangles,
            // Before the first build the header may hold anything.
            false => self
                .header()
                .map_or(triangles, |header| header.longest.saturating_mul(LONG_LISTS_A_RAY).min(triangles)),
        };
        let entries = reads * u64::from(longest);
        16 + (steps + entries).div_ceil(budget).min(u64::from(u32::MAX) - 16) as u32
    }
}

impl Structure for Voxels {
    fn name(&self) -> &'static str {
        "voxel"
    }

    fn kind(&self) -> StructureKind {
        match self.config.coverage {
            Coverage::Conservative => StructureKind::Primitive,
            Coverage::Exact | Coverage::Hardware => StructureKind::Fragment,
        }
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

    fn set_geometry(&mut self, _device: &Device, geometry: &Geometry) -> Result<(), AdsError> {
        self.geometry = geometry.clone();
        Ok(())
    }

    fn record_build(&mut self, recorder: &mut Recorder<'_>, _viewpoint: Viewpoint) -> Result<(), AdsError> {
        self.pools.set_header(&self.first_header());
        let target = BuildTarget { geometry: &self.geometry, pools: &self.pools, scene: self.scene.as_ref() };
        self.build.record(recorder, &self.config, target);
        Ok(())
    }

    fn status(&self) -> Result<BuildStatus, GpuError> {
        let header = self.header()?;
        Ok(BuildStatus {
            complete: header.status & STATUS_COMPLETE != 0,
            pools: vec![
                PoolStatus {
                    name: "fragments",
                    demand: header.demand.into(),
                    capacity: header.capacity.into(),
                },
                PoolStatus {
                    name: "long",
                    demand: header.long_demand.into(),
                    capacity: header.long_capacity.into(),
                },
                PoolStatus {
                    name: "pairs",
                    demand: header.pairs.into(),
                    capacity: header.pair_capacity.into(),
                },
            ],
            unsorted: header.unsorted.into(),
            outside: self.pools.outside()?,
            corrupted: header.corrupted.into(),
        })
    }

    fn check(&self, status: &BuildStatus, headroom: u32) -> Result<Check, AdsError> {
        let demand = |name| status.demand(name).unwrap_or(0);
        let sizes = self.pools.sizes();
        let mut entries = demand("fragments");
        if self.config.storage == Storage::Paged && entries > sizes.elements("fragments") {
            // How many pages are begun depends a little on which threads meet.
            entries += entries / 64;
        }
        status.check(headroom, |growth| {
            let demand = Demand {
                entries: growth.of(entries, sizes.elements("fragments")),
                long_lists: growth.of(demand("long"), long_capacity(&self.config, sizes)),
                pairs: growth.of(demand("pairs"), pair_capacity(&self.config, sizes)),
            };
            plan(&self.config, demand)
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
        let demand = Demand {
            entries: header.demand.into(),
            long_lists: header.long_demand.into(),
            pairs: header.pairs.into(),
        };
        let bytes_by_part = self.pools.bytes_by_part(|pool| match pool.name {
            "fragments" => demand.entries,
            "scratch" => scratch_words(&self.config, demand),
            _ => pool.elements,
        });
        let formula = formula_bytes(&self.config, demand);
        Ok(StructureReport {
            options: self.config.options(),
            paths: self.config.paths(),
            bytes_by_part,
            formula_bytes: formula.total(),
            diagnostic_bytes: formula.ids,
            stored: Some(header.fragments.into()),
            lost: None,
        })
    }
}
