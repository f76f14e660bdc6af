//! The BVH as a structure.

use rasray_ads::{
    AdsError, BuildPipelines, BuildStatus, BuildTarget, Check, Counters, Geometry, InlineTrace, Modules,
    PoolStatus, Pools, RayQueue, SceneBinding, Sizes, Structure, StructureKind, StructureReport,
    TraceKernels, TraceKernelsDesc, TraceMode, Viewpoint,
};
use rasray_gpu::{Device, Feature, GpuError, Recorder, Requirements};
use rasray_shaders_glsl::constants::bvh::{BVH_CODE_CELLS, BVH_LEAF, BVH_NONE};
use rasray_shaders_glsl::constants::contract::{STATUS_COMPLETE, TRACE_WORK_BUDGET};

use crate::build::Build;
use crate::host::{self, Box3};
use crate::layout::{BOX_WORDS, NAME, formula_bytes, plan};
use crate::{Builder, Config, Contents, Header, Node, Record};

/// Rounds that a trace records at first. Each costs two dispatches, also where no ray is left, and only a ray on which
/// hundreds of thousands of boxes lie needs more.
const FIRST_ROUNDS: u32 = 64;

/// A bounding volume hierarchy with two children a node.
#[derive(Debug)]
pub struct Bvh {
    config: Config,
    geometry: Geometry,
    build: Build,
    kernels: TraceKernels,
    pools: Pools,
    /// What the host made for the next build.
    prepared: Option<Prepared>,
    /// Inner nodes of the last build recorded.
    nodes: u64,
}

/// Root and number of inner nodes of a tree in the pools.
#[derive(Clone, Copy, Debug)]
struct Prepared {
    root: u32,
    nodes: u64,
}

/// Its shaders.
fn modules(config: &Config) -> Modules {
    Modules { structure: NAME, prefix: NAME, addressing: config.addressing }
}

impl Bvh {
    /// Makes pipelines and pools for the triangles of `geometry`. `scene` is needed for alpha masks and
    /// surfaces.
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
        let sizes = plan(&config, geometry.triangle_count().into())?;
        config.addressing.check(device)?;
        device.require("the hierarchy", &Self::requirements_of(&config))?;
        let pools = Pools::new(device, NAME, config.addressing, &sizes)?;
        let modules = modules(&config);
        let build = Build::new(&BuildPipelines::new(device, modules, geometry, &pools, None, &[]), &config)?;
        let kernels = TraceKernels::new(
            device,
            geometry,
            &TraceKernelsDesc {
                modules: modules.trace(scene)?,
                structure_layout: pools.layout(),
                constants: &[],
                counters: config.counters,
                work_budget: config.work_budget,
                scene,
            },
        )?;
        let geometry = geometry.clone();
        Ok(Self { config, geometry, build, kernels, pools, prepared: None, nodes: 0 })
    }

    /// Rounds that a ray needs if it meets every box of the tree.
    fn most_rounds(&self) -> u32 {
        // Each triangle is tested once, each node entered once, and after pauses each child left once.
        let units = 4 * u64::from(self.geometry.triangle_count());
        let budget = u64::from(self.config.work_budget.unwrap_or(TRACE_WORK_BUDGET));
        (units / budget + 2).min(u32::MAX.into()) as u32
    }

    /// What a device must and may offer for a configuration.
    pub fn requirements_of(config: &Config) -> Requirements {
        // Nothing is rasterized: of the device floor, dynamic rendering is not needed.
        let mut requirements = Requirements {
            required: vec![Feature::ScalarBlockLayout, Feature::Synchronization2],
            ..Requirements::default()
        };
        modules(config).add_to(&mut requirements);
        requirements
    }

    /// The configuration it was made with.
    pub fn config(&self) -> &Config {
        &self.config
    }

    /// The header as the last build left it. The caller has waited for the submission.
    ///
    /// # Errors
    /// Host-visible memory could not be read.
    pub fn header(&self) -> Result<Header, GpuError> {
        self.pools.header()
    }

    /// Downloads the tree, for checks. Submits and waits: for tests and tools.
    ///
    /// # Errors
    /// The device failed.
    pub fn download(&self, device: &Device) -> Result<Contents, GpuError> {
        let header = device.download_as::<Header>(self.pools.pool("header"), 0, 1)?[0];
        let triangles = header.triangle_count as usize;
        Ok(Contents {
            header,
            nodes: device.download_as::<Node>(self.pools.pool("nodes"), 0, self.nodes as usize)?,
            records: device.download_as::<Record>(self.pools.pool("records"), 0, triangles)?,
        })
    }

    /// Writes the tree back, as [`Bvh::download`] returned it or changed. Submits and waits: for tests and
    /// tools. Traces end within their bounds whatever nodes say; the header is taken at its word.
    ///
    /// # Errors
    /// The tree is larger than what was allocated, or the device failed.
    pub fn upload(&self, device: &Device, contents: &Contents) -> Result<(), GpuError> {
        device.upload(self.pools.pool("header"), 0, bytemuck::bytes_of(&contents.header))?;
        device.upload_slice(self.pools.pool("nodes"), 0, &contents.nodes)?;
        device.upload_slice(self.pools.pool("records"), 0, &contents.records)
    }

    fn target(&self) -> BuildTarget<'_> {
        BuildTarget { geometry: &self.geometry, pools: &self.pools, scene: None }
    }

    /// The tree that the device builds over this many triangles.
    fn on_device(triangles: u64) -> Prepared {
        let root = match triangles {
            0 => BVH_NONE,
            1 => BVH_LEAF,
            _ => 0,
        };
        Prepared { root, nodes: triangles.saturating_sub(1) }
    }

    /// Whether there is room for the tree. It has no partial form: without room for all of it nothing is built.
    fn has_room(&self) -> bool {
        let sizes = self.pools.sizes();
        plan(&self.config, self.geometry.triangle_count().into())
            .is_ok_and(|wanted| wanted.pools.iter().all(|pool| sizes.elements(pool.name) >= pool.elements))
    }

    /// The header that the next build starts from.
    fn first_header(&self, root: u32) -> Header {
        let [lower, upper] = self.geometry.bounds();
        let triangles = self.geometry.triangle_count();
        let has_room = self.has_room();
        let capacity = |pool| if has_room { self.pools.sizes().elements(pool) as u32 } else { 0 };
        // Where the primitive of each record stands: behind the boxes, or in the second word of each key.
        let (order_offset, order_stride) = match self.config.builder {
            Builder::Sah => (BOX_WORDS as u32 * triangles, 1),
            Builder::Lbvh => (1, 2),
        };
        Header {
            root,
            triangle_count: triangles,
            node_capacity: capacity("nodes"),
            record_capacity: capacity("records"),
            scratch_capacity: capacity("scratch"),
            order_offset,
            order_stride,
            lower,
            cells_per_metre: cells_per_metre([lower, upper]),
            nodes_address: self.pools.address_of("nodes"),
            records_address: self.pools.address_of("records"),
            scratch_address: self.pools.address_of("scratch"),
            ..Header::default()
        }
    }
}

/// Cells of the Morton grid a metre, the same along all axes so that cells are cubes.
fn cells_per_metre([lower, upper]: Box3) -> [f32; 3] {
    let extent = (0..3).fold(0.0_f32, |extent, axis| extent.max(upper[axis] - lower[axis]));
    // Kept normal: what does not fit is clamped to the grid, which costs quality and no hit.
    let cells = (BVH_CODE_CELLS / extent.max(f32::MIN_POSITIVE)).clamp(f32::MIN_POSITIVE, f32::MAX);
    [cells; 3]
}

impl Structure for Bvh {
    fn name(&self) -> &'static str {
        NAME
    }

    fn kind(&self) -> StructureKind {
        StructureKind::Primitive
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
        self.pools.resize(device, sizes)?;
        self.prepared = None;
        Ok(())
    }

    fn set_geometry(&mut self, device: &Device, geometry: &Geometry) -> Result<(), AdsError> {
        let sizes = plan(&self.config, geometry.triangle_count().into())?;
        if sizes != *self.pools.sizes() {
            self.resize(device, &sizes)?;
        }
        self.geometry = geometry.clone();
        self.prepared = None;
        Ok(())
    }

    fn prepare_build(&mut self, device: &Device) -> Result<(), AdsError> {
        if self.config.builder != Builder::Sah {
            return Ok(());
        }
        self.prepared = None;
        let triangles = self.geometry.triangle_count() as usize;
        if !self.has_room() {
            // The build will say so.
            self.prepared = Some(Self::on_device(triangles as u64));
            return Ok(());
        }
        self.pools.set_header(&self.first_header(BVH_NONE));
        device.submit(|recorder| self.build.record_boxes(recorder, self.target()))?;
        let boxes = device.download_as::<Box3>(self.pools.pool("scratch"), 0, triangles)?;
        let tree = host::build(&boxes, self.config.leaf);
        device.upload_slice(self.pools.pool("nodes"), 0, &tree.nodes)?;
        let order_at = size_of::<Box3>() * triangles;
        device.upload_slice(self.pools.pool("scratch"), order_at as u64, &tree.order)?;
        self.prepared = Some(Prepared { root: tree.root, nodes: tree.nodes.len() as u64 });
        Ok(())
    }

    fn record_build(&mut self, recorder: &mut Recorder<'_>, _viewpoint: Viewpoint) -> Result<(), AdsError> {
        let prepared = match self.config.builder {
            // The triangles may have moved since, so a tree serves one build.
            Builder::Sah => self.prepared.take().ok_or(AdsError::NotPrepared { structure: NAME })?,
            Builder::Lbvh => Self::on_device(self.geometry.triangle_count().into()),
        };
        self.nodes = prepared.nodes;
        self.pools.set_header(&self.first_header(prepared.root));
        self.build.record(recorder, self.target());
        Ok(())
    }

    fn status(&self) -> Result<BuildStatus, GpuError> {
        let header = self.header()?;
        // What the tree has, and of the rest what its triangles take.
        let wanted = plan(&self.config, self.geometry.triangle_count().into()).unwrap_or_default();
        let pools = wanted.pools.into_iter().filter(|pool| pool.name != "header").map(|pool| PoolStatus {
            name: pool.name,
            demand: if pool.name == "nodes" { self.nodes } else { pool.elements },
            capacity: self.pools.sizes().elements(pool.name),
        });
        Ok(BuildStatus {
            complete: header.status & STATUS_COMPLETE != 0,
            pools: pools.collect(),
            unsorted: 0,
            outside: self.pools.outside()?,
            corrupted: header.corrupted.into(),
        })
    }

    fn check(&self, status: &BuildStatus, headroom: u32) -> Result<Check, AdsError> {
        // A tree grows only after a resize to other sizes than those of its triangles, which say all that it needs.
        status.check(headroom, |_| plan(&self.config, self.geometry.triangle_count().into()))
    }

    fn rounds(&self) -> u32 {
        let most = self.most_rounds();
        self.pools.rounds(most.min(FIRST_ROUNDS))
    }

    fn allow_more_rounds(&self) -> bool {
        let most = self.most_rounds();
        self.pools.allow_more_rounds(most.min(FIRST_ROUNDS), most)
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
        Some(self.pools.inline_trace(Vec::new()))
    }

    fn report(&self) -> Result<StructureReport, GpuError> {
        let triangles = u64::from(self.geometry.triangle_count());
        let bytes_by_part =
            self.pools.bytes_by_part(|pool| if pool.name == "nodes" { self.nodes } else { pool.elements });
        Ok(StructureReport {
            options: self.config.options(),
            paths: self.config.paths(),
            bytes_by_part,
            formula_bytes: formula_bytes(self.config.builder, self.nodes, triangles).total(),
            diagnostic_bytes: 0,
            stored: Some(triangles),
            lost: None,
        })
    }
}
