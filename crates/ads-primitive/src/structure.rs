//! Primitive lists as a structure.

use bytemuck::{bytes_of, from_bytes, pod_read_unaligned};
use rasray_ads::{
    AdsError, BuildStatus, Check, Counters, Geometry, PoolStatus, RayQueue, SceneBinding, Sizes, Structure,
    StructureKind, StructureReport, TraceKernels, TraceKernelsDesc, TraceMode,
};
use rasray_gpu::{
    BindingSet, Buffer, BufferDesc, BufferUsage, Device, Feature, GpuError, MemoryLocation, Recorder,
    Requirements, SetLayout,
};
use rasray_shaders_glsl::constants::contract::{STATUS_COMPLETE, TRACE_WORK_BUDGET};
use rasray_shaders_glsl::constants::primitive as numbers;

use crate::build::{Build, Target, trace_modules};
use crate::layout::{first_plan, formula_bytes, plan};
use crate::{Addressing, Config, Contents, Header};

/// Bindings of the structure's set: header, bounds, lists, entries, sums, near list.
const BINDINGS: u32 = 6;

/// Lists of triangles per tile and depth bucket.
#[derive(Debug)]
pub struct PrimitiveLists {
    config: Config,
    geometry: Geometry,
    build: Build,
    kernels: TraceKernels,
    layout: SetLayout,
    sizes: Sizes,
    pools: Pools,
}

/// Buffers of one size.
#[derive(Debug)]
struct Pools {
    header_source: Buffer,
    header_readback: Buffer,
    header: Buffer,
    bounds: Buffer,
    lists: Buffer,
    entries: Buffer,
    sums: Buffer,
    near: Buffer,
    set: Option<BindingSet>,
    /// Whether a build was recorded since: until then device memory holds anything.
    built: bool,
}

impl Pools {
    fn new(
        device: &Device,
        layout: &SetLayout,
        addressing: Addressing,
        sizes: &Sizes,
    ) -> Result<Self, AdsError> {
        let buffer = |name: &str, size: u64, location| {
            device.create_buffer(&BufferDesc {
                name: &format!("primitive {name}"),
                size,
                usage: BufferUsage::STORAGE | BufferUsage::TRANSFER_SRC | BufferUsage::TRANSFER_DST,
                location,
            })
        };
        let pool = |name: &'static str| {
            let size =
                sizes.pools.iter().find(|pool| pool.name == name).map_or(0, |p| p.elements * p.element_bytes);
            buffer(name, size, MemoryLocation::Device)
        };
        let header_bytes = size_of::<Header>() as u64;
        let header_source = buffer("header source", header_bytes, MemoryLocation::Upload)?;
        let header_readback = buffer("header readback", header_bytes, MemoryLocation::Readback)?;
        let (header, bounds, lists) = (pool("header")?, pool("bounds")?, pool("lists")?);
        let (entries, sums, near) = (pool("entries")?, pool("sums")?, pool("near")?);
        let set = match addressing {
            Addressing::Descriptor => Some(device.create_binding_set(
                layout,
                "primitive",
                &[&header, &bounds, &lists, &entries, &sums, &near],
            )?),
            Addressing::Address => None,
        };
        Ok(Self {
            header_source,
            header_readback,
            header,
            bounds,
            lists,
            entries,
            sums,
            near,
            set,
            built: false,
        })
    }
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
        config.validate()?;
        if config.addressing == Addressing::Address && !device.has(Feature::BufferDeviceAddress) {
            return Err(AdsError::Option {
                option: "addressing",
                value: "address".to_owned(),
                expected: "device addresses need the feature bufferDeviceAddress, which was not enabled on this device",
            });
        }
        device.require("the primitive lists", &Self::requirements_of(&config))?;
        let modules = trace_modules(&config, scene)?;
        let bindings = match config.addressing {
            Addressing::Descriptor => BINDINGS,
            Addressing::Address => 0,
        };
        let layout = device.create_set_layout("primitive", bindings)?;
        let build = Build::new(device, &config, geometry, &layout)?;
        let kernels = TraceKernels::new(
            device,
            geometry,
            &TraceKernelsDesc {
                closest: modules.closest,
                occluded: modules.occluded,
                surfaces: modules.surfaces,
                structure_layout: &layout,
                constants: &config.constants(),
                counters: config.counters,
                work_budget: config.work_budget,
                scene,
            },
        )?;
        let sizes = first_plan(&config)?;
        let pools = Pools::new(device, &layout, config.addressing, &sizes)?;
        Ok(Self { config, geometry: geometry.clone(), build, kernels, layout, sizes, pools })
    }

    /// What a device must and may offer for a configuration.
    pub fn requirements_of(config: &Config) -> Requirements {
        let mut requirements = Requirements::floor();
        requirements.required.push(Feature::FragmentStoresAndAtomics);
        if config.addressing == Addressing::Address {
            requirements.required.push(Feature::BufferDeviceAddress);
        }
        requirements
    }

    /// The configuration it was made with.
    pub fn config(&self) -> &Config {
        &self.config
    }

    fn address(&self) -> u64 {
        match self.config.addressing {
            Addressing::Descriptor => 0,
            Addressing::Address => self.pools.header.address().unwrap_or(0),
        }
    }

    /// The header that the next build starts from.
    fn first_header(&self, eye: [f32; 3]) -> Header {
        let [lower, upper] = self.geometry.bounds();
        let relative = |corner: [f32; 3]| std::array::from_fn::<f32, 3, _>(|axis| corner[axis] - eye[axis]);
        let (lower, upper) = (relative(lower), relative(upper));
        let farthest = lower.iter().chain(&upper).fold(0.0_f32, |far, x| far.max(x.abs()));
        // A difference of two coordinates is rounded relative to itself, so it does not matter how far the
        // eye is from the frame origin.
        let rounding = numbers::PRIMITIVE_ROUNDING * farthest;
        let near_size = numbers::PRIMITIVE_NEAR * self.config.tiles() as f32 * farthest;
        let address = |buffer: &Buffer| match self.config.addressing {
            Addressing::Descriptor => [0; 2],
            Addressing::Address => {
                let address = buffer.address().unwrap_or(0);
                [address as u32, (address >> 32) as u32]
            }
        };
        Header {
            capacity: self.sizes.elements("entries") as u32,
            near_capacity: self.sizes.elements("near") as u32,
            tiles: self.config.tiles(),
            reach: farthest,
            // Depths are positive, also where all geometry is at the eye.
            near_size: near_size.max(1.0e-30),
            rounding,
            eye,
            lower: lower.map(|x| x - rounding),
            upper: upper.map(|x| x + rounding),
            bounds_address: address(&self.pools.bounds),
            lists_address: address(&self.pools.lists),
            entries_address: address(&self.pools.entries),
            sums_address: address(&self.pools.sums),
            near_address: address(&self.pools.near),
            ..Header::default()
        }
    }

    /// The header as the last build left it. The caller has waited for the submission.
    ///
    /// # Errors
    /// Host-visible memory could not be read.
    pub fn header(&self) -> Result<Header, GpuError> {
        let bytes = self.pools.header_readback.read(0, size_of::<Header>() as u64)?;
        Ok(pod_read_unaligned(&bytes))
    }

    /// Downloads all pools, for checks. Submits and waits: for tests and tools.
    ///
    /// # Errors
    /// The device failed.
    pub fn download(&self, device: &Device) -> Result<Contents, GpuError> {
        let header =
            *from_bytes::<Header>(&device.download(&self.pools.header, 0, size_of::<Header>() as u64)?);
        let words = |pool: &Buffer, name: &str| {
            let size =
                self.sizes.pools.iter().find(|p| p.name == name).map_or(0, |p| p.elements * p.element_bytes);
            device.download_as::<u32>(pool, 0, (size / 4) as usize)
        };
        Ok(Contents {
            config: self.config,
            header,
            bounds: words(&self.pools.bounds, "bounds")?,
            lists: words(&self.pools.lists, "lists")?,
            entries: words(&self.pools.entries, "entries")?,
            near: words(&self.pools.near, "near")?,
        })
    }
}

impl Structure for PrimitiveLists {
    fn name(&self) -> &'static str {
        "dirt"
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
        &self.sizes
    }

    fn resize(&mut self, device: &Device, sizes: &Sizes) -> Result<(), AdsError> {
        self.pools = Pools::new(device, &self.layout, self.config.addressing, sizes)?;
        self.sizes = sizes.clone();
        Ok(())
    }

    fn set_geometry(&mut self, _device: &Device, geometry: &Geometry) -> Result<(), AdsError> {
        self.geometry = geometry.clone();
        Ok(())
    }

    fn record_build(&mut self, recorder: &mut Recorder<'_>, eye: [f32; 3]) -> Result<(), AdsError> {
        self.pools.header_source.write(0, bytes_of(&self.first_header(eye)))?;
        self.build.record(
            recorder,
            &Target {
                config: &self.config,
                geometry: &self.geometry,
                set: self.pools.set.as_ref(),
                address: self.address(),
                header_source: &self.pools.header_source,
                header: &self.pools.header,
                header_readback: &self.pools.header_readback,
                bounds: &self.pools.bounds,
                lists: &self.pools.lists,
            },
        );
        self.pools.built = true;
        Ok(())
    }

    fn status(&self) -> Result<BuildStatus, GpuError> {
        let header = self.header()?;
        Ok(BuildStatus {
            complete: header.status & STATUS_COMPLETE != 0,
            pools: vec![
                PoolStatus {
                    name: "entries",
                    demand: header.demand.into(),
                    capacity: header.capacity.into(),
                },
                PoolStatus {
                    name: "near",
                    demand: header.near_demand.into(),
                    capacity: header.near_capacity.into(),
                },
            ],
            unsorted: 0,
            corrupted: header.corrupted.into(),
        })
    }

    fn check(&self, status: &BuildStatus) -> Check {
        let demand = |name| status.pools.iter().find(|pool| pool.name == name).map_or(0, |pool| pool.demand);
        if status.complete {
            return Check::Complete;
        }
        let entries = demand("entries").max(self.sizes.elements("entries"));
        let near = demand("near").max(self.sizes.elements("near"));
        // Where the demand exceeds what 32 bits can name, nothing can be planned and the build stays incomplete.
        plan(&self.config, entries, near).map_or(Check::Complete, Check::Grow)
    }

    fn rounds(&self) -> u32 {
        // Rays from far outside are tested against every triangle, others against what a few cells list.
        let budget = self.config.work_budget.unwrap_or(TRACE_WORK_BUDGET);
        16 + 2 * self.geometry.triangle_count().div_ceil(budget)
    }

    fn record_trace(
        &self,
        recorder: &mut Recorder<'_>,
        queue: &RayQueue,
        count: u32,
        mode: TraceMode,
        rounds: u32,
    ) {
        if !self.pools.built {
            rasray_ads::record_not_ready(recorder, &self.pools.header);
        }
        let set = self.pools.set.as_ref();
        self.kernels.record_trace(recorder, &self.geometry, set, self.address(), queue, count, mode, rounds);
    }

    fn record_surfaces(
        &self,
        recorder: &mut Recorder<'_>,
        queue: &RayQueue,
        count: u32,
    ) -> Result<(), AdsError> {
        let set = self.pools.set.as_ref();
        if self.kernels.record_surfaces(recorder, &self.geometry, set, self.address(), queue, count) {
            Ok(())
        } else {
            Err(AdsError::NoScene { structure: self.name() })
        }
    }

    fn report(&self) -> Result<StructureReport, GpuError> {
        let header = self.header()?;
        let (entries, near) = (u64::from(header.demand), u64::from(header.near_demand));
        let mut slack = 0;
        let mut bytes_by_part = Vec::new();
        for pool in &self.sizes.pools {
            let used = match pool.name {
                "entries" => entries.min(pool.elements),
                "near" => near.min(pool.elements),
                _ => pool.elements,
            };
            bytes_by_part.push((pool.name, used * pool.element_bytes));
            slack += (pool.elements - used) * pool.element_bytes;
        }
        bytes_by_part.push(("slack", slack));
        Ok(StructureReport {
            options: self.config.options(),
            paths: self.config.paths(),
            bytes_by_part,
            formula_bytes: formula_bytes(&self.config, entries, near).total(),
            stored: Some(entries),
        })
    }
}
