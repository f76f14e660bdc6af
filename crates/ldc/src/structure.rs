//! The layered depth cube as a structure.

use rasray_ads::{
    AdsError, BuildPipelines, BuildStatus, BuildTarget, Check, Counters, Geometry, InlineTrace, Modules,
    PoolStatus, Pools, RayQueue, SceneBinding, Sizes, Structure, StructureKind, StructureReport,
    TraceKernels, TraceKernelsDesc, TraceMode, Viewpoint, bin_groups,
};
use rasray_gpu::{BindingSet, Device, Feature, GpuError, Recorder, Requirements};
use rasray_shaders_glsl::constants::contract::{STATUS_COMPLETE, TRACE_WORK_BUDGET};
use rasray_shaders_glsl::constants::ldc::LDC_SLICES;

use crate::build::Build;
use crate::layout::{
    Demand, first_plan, formula_bytes, layer_capacity, long_capacity, pair_capacity, plan, scratch_words,
};
use crate::{Builder, Config, Contents, Header};

/// Fragments of three orthographic views, each triangle in the one it faces most.
#[derive(Debug)]
pub struct LayeredDepthCube {
    config: Config,
    geometry: Geometry,
    build: Build,
    kernels: TraceKernels,
    pools: Pools,
    scene: Option<BindingSet>,
}

/// Its shaders.
fn modules(config: &Config) -> Modules {
    Modules { structure: "ldc", prefix: "ldc", addressing: config.addressing }
}

impl LayeredDepthCube {
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
        device.require("the layered depth cube", &Self::requirements_of(&config))?;
        let pools = Pools::new(device, "ldc", config.addressing, &sizes)?;
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
        let [lower, upper] = self.geometry.bounds();
        let largest = lower.iter().chain(&upper).fold(0.0_f32, |largest, x| largest.max(x.abs()));
        let extent = (0..3).fold(0.0_f32, |extent, axis| extent.max(upper[axis] - lower[axis]));
        // Room for the rounding of what is subtracted from corner and ray.
        let rounding = 4.8e-7 * largest;
        // Where all geometry is one point its cells have a size all the same.
        let size = (extent + 4.0 * rounding).max(1.0e-30);
        Header {
            capacity: self.pools.sizes().elements("payload") as u32,
            fringe_capacity: self.pools.sizes().elements("fringe") as u32,
            long_capacity: long_capacity(&self.config, self.pools.sizes()) as u32,
            layer_capacity: layer_capacity(&self.config, self.pools.sizes()) as u32,
            layer_limit: self.config.layers,
            slices_a_metre: LDC_SLICES as f32 / size,
            resolution: self.config.resolution,
            cell: size / self.config.resolution as f32,
            size,
            tolerance: self.config.tolerance * size,
            origin: lower.map(|x| x - 2.0 * rounding),
            lower: lower.map(|x| x - rounding),
            upper: upper.map(|x| x + rounding),
            lists_address: self.pools.address_of("lists"),
            depths_address: self.pools.address_of("depths"),
            payload_address: self.pools.address_of("payload"),
            blocks_address: self.pools.address_of("blocks"),
            heads_address: self.pools.address_of("heads"),
            fringe_address: self.pools.address_of("fringe"),
            scratch_address: self.pools.address_of("scratch"),
            pair_capacity: pair_capacity(&self.config, self.pools.sizes()) as u32,
            groups: [0, 0, bin_groups(u64::from(self.config.resolution + 2).pow(2))],
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

    /// Downloads all pools, for checks. Submits and waits: for tests and tools.
    ///
    /// # Errors
    /// The device failed.
    pub fn download(&self, device: &Device) -> Result<Contents, GpuError> {
        let words = |name| self.pools.download_words(device, name);
        Ok(Contents {
            config: self.config,
            header: device.download_as::<Header>(self.pools.pool("header"), 0, 1)?[0],
            lists: words("lists")?,
            depths: words("depths")?,
            payload: words("payload")?,
            blocks: words("blocks")?,
            heads: words("heads")?,
            fringe: words("fringe")?,
        })
    }

    /// Writes all pools back, as [`LayeredDepthCube::download`] returned them or changed. Submits and waits: for tests
    /// and tools. Traces end within their bounds whatever places and links say; the header is taken at its word.
    ///
    /// # Errors
    /// A pool is larger than what was allocated, or the device failed.
    pub fn upload(&self, device: &Device, contents: &Contents) -> Result<(), GpuError> {
        device.upload(self.pools.pool("header"), 0, bytemuck::bytes_of(&contents.header))?;
        device.upload_slice(self.pools.pool("lists"), 0, &contents.lists)?;
        device.upload_slice(self.pools.pool("depths"), 0, &contents.depths)?;
        device.upload_slice(self.pools.pool("payload"), 0, &contents.payload)?;
        device.upload_slice(self.pools.pool("blocks"), 0, &contents.blocks)?;
        device.upload_slice(self.pools.pool("heads"), 0, &contents.heads)?;
        device.upload_slice(self.pools.pool("fringe"), 0, &contents.fringe)
    }

    /// Rounds that nearly every ray is finished in.
    fn first_rounds(&self) -> u32 {
        // One cell may hold all of the fringe: a small object in a large world.
        let budget = self.config.work_budget.unwrap_or(TRACE_WORK_BUDGET);
        let room = self.pools.sizes().elements("fringe") as u32;
        // Before the first build the header may hold anything.
        16 + self.header().map_or(0, |header| header.fringe_demand.min(room)).div_ceil(budget)
    }
}

impl Structure for LayeredDepthCube {
    fn name(&self) -> &'static str {
        "ldc"
    }

    fn kind(&self) -> StructureKind {
        StructureKind::Fragment
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
        let layers = layer_capacity(&self.config, sizes);
        if layers > self.config.layers.into() {
            return Err(AdsError::Option {
                option: "layers",
                value: format!("{}, and the deepest cell has {layers} fragments", self.config.layers),
                expected: "as many layers as the deepest cell has fragments, up to 1024, or `build=single`",
            });
        }
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
                    name: "fringe",
                    demand: header.fringe_demand.into(),
                    capacity: header.fringe_capacity.into(),
                },
                PoolStatus {
                    name: "long",
                    demand: header.long_demand.into(),
                    capacity: header.long_capacity.into(),
                },
                PoolStatus {
                    name: "layers",
                    demand: header.layer_demand.into(),
                    capacity: header.layer_capacity.into(),
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
        status.check(headroom, |growth| {
            let demand = Demand {
                fragments: growth.of(demand("fragments"), sizes.elements("payload")),
                fringe: growth.of(demand("fringe"), sizes.elements("fringe")),
                long_lists: growth.of(demand("long"), long_capacity(&self.config, sizes)),
                layers: growth.of(demand("layers"), layer_capacity(&self.config, sizes)),
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
            fragments: header.demand.into(),
            fringe: header.fringe_demand.into(),
            long_lists: header.long_demand.into(),
            layers: header.layer_demand.into(),
            pairs: header.pairs.into(),
        };
        let depth_words = demand.fragments.div_ceil(u64::from(32 / self.config.depth.bits()));
        let bytes_by_part = self.pools.bytes_by_part(|pool| match pool.name {
            "depths" => depth_words,
            "payload" => demand.fragments,
            "fringe" => demand.fringe,
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
            stored: Some(demand.fragments + demand.fringe),
            lost: None,
        })
    }
}
