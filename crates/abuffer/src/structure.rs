//! The A-buffer as a structure.

use rasray_ads::{
    AdsError, BuildPipelines, BuildStatus, BuildTarget, Check, Counters, Geometry, InlineTrace, Modules,
    PoolStatus, Pools, RayQueue, SceneBinding, Sizes, Structure, StructureKind, StructureReport,
    TraceKernels, TraceKernelsDesc, TraceMode, Viewpoint, bin_groups,
};
use rasray_gpu::{BindingSet, Device, Feature, GpuError, Recorder, Requirements};
use rasray_shaders_glsl::constants::ads::{NEAR_BOX, TRIANGLE_ROUNDING};
use rasray_shaders_glsl::constants::contract::{STATUS_COMPLETE, TRACE_WORK_BUDGET};

use crate::build::Build;
use crate::layout::{
    Demand, bounds_and_blocks, first_plan, formula_bytes, long_capacity, pair_capacity, plan, scratch_words,
    widest_view,
};
use crate::{Builder, Config, Contents, Header, March, Storage};

/// A multiview, multilayer A-buffer.
#[derive(Debug)]
pub struct ABuffer {
    config: Config,
    geometry: Geometry,
    build: Build,
    kernels: TraceKernels,
    pools: Pools,
    scene: Option<BindingSet>,
}

/// Its shaders.
fn modules(config: &Config) -> Modules {
    Modules { structure: "mmrt", prefix: "abuffer", addressing: config.addressing }
}

impl ABuffer {
    /// Makes pipelines and a first set of pools. `scene` is needed for alpha masks, surfaces and the
    /// published payload.
    ///
    /// # Errors
    /// An option is out of range or needs what the device or the caller does not provide; out of
    /// memory; a pool exceeds what one binding can hold (then use device addresses).
    pub fn new(
        device: &Device,
        config: Config,
        geometry: &Geometry,
        scene: Option<&SceneBinding>,
    ) -> Result<Self, AdsError> {
        let sizes = first_plan(&config, geometry.triangle_count())?;
        config.addressing.check(device)?;
        device.require("the A-buffer", &Self::requirements_of(&config))?;
        let pools = Pools::new(device, "abuffer", config.addressing, &sizes)?;
        let modules = modules(&config);
        let constants = config.constants();
        let pipelines = BuildPipelines::new(device, modules, geometry, &pools, scene, &constants);
        let build = Build::new(&pipelines, &config, scene)?;
        let kernels = TraceKernels::new(
            device,
            geometry,
            &TraceKernelsDesc {
                modules: modules.trace_variant(&config.trace_variant(), scene)?,
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
    ///
    /// # Errors
    /// A camera's view is asked for and there is no camera.
    fn first_header(&self, viewpoint: Viewpoint) -> Result<Header, AdsError> {
        let eye = viewpoint.eye;
        let config = &self.config;
        let camera = viewpoint.camera.filter(|camera| config.views.has_camera() && camera.is_valid());
        if config.views.has_camera() && camera.is_none() {
            return Err(AdsError::Option {
                option: "views",
                value: config.views.name().to_owned(),
                expected: "the build was given no perspective camera; without one use `cube`",
            });
        }
        let [lower, upper] = self.geometry.bounds();
        let relative = |corner: [f32; 3]| std::array::from_fn::<f32, 3, _>(|axis| corner[axis] - eye[axis]);
        let (lower, upper) = (relative(lower), relative(upper));
        let farthest = lower.iter().chain(&upper).fold(0.0_f32, |far, x| far.max(x.abs()));
        // The subtraction above rounds, and so does the one in the shaders.
        let rounding = 4.0e-7 * (farthest + eye.iter().fold(0.0_f32, |far, x| far.max(x.abs())));
        let faces = if config.views.has_cube() { config.resolution } else { 0 };
        let (camera_rows, camera_stretch, camera_cells, camera_width) =
            camera.map_or_else(Default::default, |camera| {
                let cells = config.camera_cells();
                let side = cells[0].max(cells[1]) as f32;
                let halves = [camera.half_width, camera.half_height];
                let mut rows = camera.rows();
                for axis in 0..2 {
                    rows[axis] = rows[axis].map(|x| x * (cells[axis] as f32 / side));
                }
                let width = |axis: usize| 2.0 * halves[axis] / cells[axis] as f32;
                // A point's place in the camera's view is also turned and stretched: twice the rounding, and
                // narrow views more.
                let stretch = 2.0 / camera.half_width.min(camera.half_height).min(1.0);
                (rows, stretch, stretch * side, width(0).max(width(1)))
            });
        let widest = if faces > 0 { (2.0 / faces as f32).max(camera_width) } else { camera_width };
        let stretch = if camera.is_some() { camera_stretch.max(1.0) } else { 1.0 };
        let triangle_rounding =
            if config.has_fringe() { stretch * TRIANGLE_ROUNDING * farthest } else { 0.0 };
        // Planes and depths stand for all that is in their cell, so they are met up to a cell beyond the geometry. A
        // ray that ended at the bounds would not come behind what lies on them.
        let margin = if config.tests_triangles() { triangle_rounding } else { rounding + widest * farthest };
        // Half as deep as a ray moves sideways from one look at lists to the next, where steps are widest.
        let step = match config.march {
            March::Samples => widest.max(2.0 / config.samples as f32),
            March::Dda | March::Exact | March::Pyramid => widest,
        };
        let thickness = config.thickness.unwrap_or(0.5 * step * farthest);
        let cells = (faces as f32).max(camera_cells);
        // Closer to the eye than this a point's cell is lost in rounding (docs/core.md). Where nothing may be
        // lost the march needs more, and what a ray meets outside of the near box is not behind the eye.
        let near_size = if config.has_fringe() {
            (NEAR_BOX * cells * farthest).max(2.0 * triangle_rounding).max(1.0e-30)
        } else {
            4.8e-7 * cells * farthest
        };
        let [camera_x, camera_y, camera_z] = camera_rows;
        let [columns, rows] = config.camera_cells();
        Ok(Header {
            capacity: self.pools.sizes().elements("nodes") as u32,
            near_capacity: self.pools.sizes().elements("near") as u32,
            long_capacity: long_capacity(config, self.pools.sizes()) as u32,
            resolution: self.config.resolution,
            samples: self.config.samples,
            thickness,
            near_size,
            eye,
            lower: lower.map(|x| x - margin),
            upper: upper.map(|x| x + margin),
            camera_cells: if camera.is_some() { columns | rows << 16 } else { 0 },
            camera_x,
            camera_y,
            camera_z,
            triangles: (32 * self.mark_words()).min(u32::MAX.into()) as u32,
            reach: farthest,
            rounding: triangle_rounding,
            bounds_address: self.pools.address_of("bounds"),
            lists_address: self.pools.address_of("lists"),
            nodes_address: self.pools.address_of("nodes"),
            data_address: self.pools.address_of("data"),
            near_address: self.pools.address_of("near"),
            scratch_address: self.pools.address_of("scratch"),
            fringe_capacity: self.pools.sizes().elements("fringe") as u32,
            fringe_address: self.pools.address_of("fringe"),
            pair_capacity: pair_capacity(&self.config, self.pools.sizes()) as u32,
            groups: [0, 0, bin_groups(widest_view(config))],
            ..Header::default()
        })
    }

    /// Words of a set of marks of triangles.
    fn mark_words(&self) -> u64 {
        (self.pools.sizes().elements("bounds") - bounds_and_blocks(&self.config)) / self.config.mark_sets()
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
            bounds: words("bounds")?,
            lists: words("lists")?,
            nodes: words("nodes")?,
            data: words("data")?,
            near: words("near")?,
            scratch: words("scratch")?,
            fringe: words("fringe")?,
        })
    }

    /// Writes all pools back, as [`ABuffer::download`] returned them or changed. Submits and waits: for tests
    /// and tools. Traces end within their bounds whatever links and depths say; the header is taken at its word.
    ///
    /// # Errors
    /// A pool is larger than what was allocated, or the device failed.
    pub fn upload(&self, device: &Device, contents: &Contents) -> Result<(), GpuError> {
        device.upload(self.pools.pool("header"), 0, bytemuck::bytes_of(&contents.header))?;
        device.upload_slice(self.pools.pool("bounds"), 0, &contents.bounds)?;
        device.upload_slice(self.pools.pool("lists"), 0, &contents.lists)?;
        device.upload_slice(self.pools.pool("nodes"), 0, &contents.nodes)?;
        device.upload_slice(self.pools.pool("data"), 0, &contents.data)?;
        device.upload_slice(self.pools.pool("near"), 0, &contents.near)?;
        device.upload_slice(self.pools.pool("scratch"), 0, &contents.scratch)?;
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

impl Structure for ABuffer {
    fn name(&self) -> &'static str {
        "mmrt"
    }

    fn kind(&self) -> StructureKind {
        if self.config.is_exact() { StructureKind::Primitive } else { StructureKind::Fragment }
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

    fn record_build(&mut self, recorder: &mut Recorder<'_>, viewpoint: Viewpoint) -> Result<(), AdsError> {
        self.pools.set_header(&self.first_header(viewpoint)?);
        let target = BuildTarget { geometry: &self.geometry, pools: &self.pools, scene: self.scene.as_ref() };
        self.build.record(recorder, &self.config, target);
        Ok(())
    }

    fn status(&self) -> Result<BuildStatus, GpuError> {
        let header = self.header()?;
        Ok(BuildStatus {
            complete: header.status & STATUS_COMPLETE != 0,
            pools: vec![
                PoolStatus { name: "nodes", demand: header.demand.into(), capacity: header.capacity.into() },
                PoolStatus {
                    name: "near",
                    demand: header.near_demand.into(),
                    capacity: header.near_capacity.into(),
                },
                PoolStatus {
                    name: "long",
                    demand: header.long_demand.into(),
                    capacity: header.long_capacity.into(),
                },
                PoolStatus {
                    name: "fringe",
                    demand: header.fringe_demand.into(),
                    capacity: header.fringe_capacity.into(),
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
        let mut nodes = demand("nodes");
        if self.config.storage == Storage::Paged && nodes > sizes.elements("nodes") {
            // How many pages are begun depends a little on which threads meet.
            nodes += nodes / 64;
        }
        let triangles = u64::from(self.geometry.triangle_count()).max(32 * self.mark_words());
        status.check(headroom, |growth| {
            let demand = Demand {
                nodes: growth.of(nodes, sizes.elements("nodes")),
                near_triangles: growth.of(demand("near"), sizes.elements("near")),
                long_lists: growth.of(demand("long"), long_capacity(&self.config, sizes)),
                triangles,
                fringe: growth.of(demand("fringe"), sizes.elements("fringe")),
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
            nodes: header.demand.into(),
            near_triangles: header.near_demand.into(),
            long_lists: header.long_demand.into(),
            triangles: self.geometry.triangle_count().into(),
            fringe: header.fringe_demand.into(),
            pairs: header.pairs.into(),
        };
        let bytes_by_part = self.pools.bytes_by_part(|pool| match pool.name {
            "nodes" | "data" => demand.nodes,
            "near" => demand.near_triangles,
            "scratch" => scratch_words(&self.config, demand),
            "fringe" => demand.fringe,
            "bounds" => {
                bounds_and_blocks(&self.config) + self.config.mark_sets() * demand.triangles.div_ceil(32)
            }
            _ => pool.elements,
        });
        let formula = formula_bytes(&self.config, demand);
        Ok(StructureReport {
            options: self.config.options(),
            paths: self.config.paths(),
            bytes_by_part,
            formula_bytes: formula.total(),
            diagnostic_bytes: formula.ids,
            stored: Some(
                demand.fringe
                    + match self.config.storage {
                        Storage::Paged => header.fragments.into(),
                        _ => demand.nodes,
                    },
            ),
            lost: Some(header.lost.into()),
        })
    }
}
