//! The A-buffer as a structure.

use bytemuck::{bytes_of, from_bytes, pod_read_unaligned};
use rasray_ads::{
    AdsError, BuildStatus, Check, Counters, Geometry, PoolStatus, RayQueue, SceneBinding, Sizes, Structure,
    StructureKind, StructureReport, TraceKernels, TraceKernelsDesc, TraceMode,
};
use rasray_gpu::{
    Access, BindingSet, Buffer, BufferDesc, BufferUsage, Device, Feature, GpuError, MemoryLocation, Recorder,
    Requirements, SetLayout,
};
use rasray_shaders_glsl::constants::contract::STATUS_COMPLETE;

use crate::build::{Build, Target, modules};
use crate::layout::{first_plan, formula_bytes, plan};
use crate::{Accept, Addressing, Config, Contents, Header};

/// Bindings of the structure's set: header, bounds, lists, nodes, data, near list.
const BINDINGS: u32 = 6;

/// A multiview, multilayer A-buffer.
#[derive(Debug)]
pub struct ABuffer {
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
    nodes: Buffer,
    data: Buffer,
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
                name: &format!("abuffer {name}"),
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
        let (nodes, data, near) = (pool("nodes")?, pool("data")?, pool("near")?);
        let set = match addressing {
            Addressing::Descriptor => Some(device.create_binding_set(
                layout,
                "abuffer",
                &[&header, &bounds, &lists, &nodes, &data, &near],
            )?),
            Addressing::Address => None,
        };
        Ok(Self {
            header_source,
            header_readback,
            header,
            bounds,
            lists,
            nodes,
            data,
            near,
            set,
            built: false,
        })
    }
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
        config.validate()?;
        if config.addressing == Addressing::Address && !device.has(Feature::BufferDeviceAddress) {
            return Err(AdsError::Option {
                option: "addressing",
                value: "address".to_owned(),
                expected: "device addresses need the feature bufferDeviceAddress, which was not enabled on this device",
            });
        }
        device.require("the A-buffer", &Self::requirements_of(&config))?;
        let modules = modules(&config, scene)?;
        let bindings = match config.addressing {
            Addressing::Descriptor => BINDINGS,
            Addressing::Address => 0,
        };
        let layout = device.create_set_layout("abuffer", bindings)?;
        let build = Build::new(device, &config, &modules, geometry, &layout, scene)?;
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
        // The subtraction above rounds, and so does the one in the shaders.
        let rounding = 4.0e-7 * (farthest + eye.iter().fold(0.0_f32, |far, x| far.max(x.abs())));
        // Planes stand for all that is in their cell, so they are met up to a cell beyond the geometry.
        let margin = match self.config.accept {
            Accept::Plane => rounding + 2.0 / self.config.resolution as f32 * farthest,
            Accept::Interval | Accept::Thickness => rounding,
        };
        let address = |buffer: &Buffer| match self.config.addressing {
            Addressing::Descriptor => [0; 2],
            Addressing::Address => {
                let address = buffer.address().unwrap_or(0);
                [address as u32, (address >> 32) as u32]
            }
        };
        Header {
            capacity: self.sizes.elements("nodes") as u32,
            near_capacity: self.sizes.elements("near") as u32,
            resolution: self.config.resolution,
            samples: self.config.samples,
            thickness: self.config.thickness,
            // Closer to the eye than this a point's cell is lost in rounding (docs/core.md).
            near_size: 4.8e-7 * self.config.resolution as f32 * farthest,
            eye,
            lower: lower.map(|x| x - margin),
            upper: upper.map(|x| x + margin),
            bounds_address: address(&self.pools.bounds),
            lists_address: address(&self.pools.lists),
            nodes_address: address(&self.pools.nodes),
            data_address: address(&self.pools.data),
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
            nodes: words(&self.pools.nodes, "nodes")?,
            data: words(&self.pools.data, "data")?,
            near: words(&self.pools.near, "near")?,
        })
    }

    /// Writes all pools back, as [`ABuffer::download`] returned them or changed. Submits and waits: for tests
    /// and tools. Traces end within their bounds whatever links and depths say; the header is taken at its word.
    ///
    /// # Errors
    /// A pool is larger than what was allocated, or the device failed.
    pub fn upload(&self, device: &Device, contents: &Contents) -> Result<(), GpuError> {
        device.upload(&self.pools.header, 0, bytes_of(&contents.header))?;
        device.upload_slice(&self.pools.bounds, 0, &contents.bounds)?;
        device.upload_slice(&self.pools.lists, 0, &contents.lists)?;
        device.upload_slice(&self.pools.nodes, 0, &contents.nodes)?;
        device.upload_slice(&self.pools.data, 0, &contents.data)?;
        device.upload_slice(&self.pools.near, 0, &contents.near)
    }
}

impl Structure for ABuffer {
    fn name(&self) -> &'static str {
        "mmrt"
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
                nodes: &self.pools.nodes,
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
                PoolStatus { name: "nodes", demand: header.demand.into(), capacity: header.capacity.into() },
                PoolStatus {
                    name: "near",
                    demand: header.near_demand.into(),
                    capacity: header.near_capacity.into(),
                },
            ],
            unsorted: header.unsorted.into(),
            corrupted: header.corrupted.into(),
        })
    }

    fn check(&self, status: &BuildStatus) -> Check {
        let demand = |name| status.pools.iter().find(|pool| pool.name == name).map_or(0, |pool| pool.demand);
        if status.complete {
            return Check::Complete;
        }
        let fragments = demand("nodes").max(self.sizes.elements("nodes"));
        let near = demand("near").max(self.sizes.elements("near"));
        // Demands are 32-bit counts, so planning them again cannot exceed what links can name.
        plan(&self.config, fragments, near).map_or(Check::Complete, Check::Grow)
    }

    fn rounds(&self) -> u32 {
        16
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
        // Traces count entries that name no node: `status` tells of them as well.
        recorder.copy(&self.pools.header, 0, &self.pools.header_readback, 0, size_of::<Header>() as u64);
        recorder.barrier(Access::TRANSFER, Access::COMPUTE | Access::TRANSFER | Access::HOST_READ);
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
        let (fragments, near) = (u64::from(header.demand), u64::from(header.near_demand));
        let mut slack = 0;
        let mut bytes_by_part = Vec::new();
        for pool in &self.sizes.pools {
            let used = match pool.name {
                "nodes" | "data" => fragments.min(pool.elements),
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
            formula_bytes: formula_bytes(&self.config, fragments, near).total(),
            stored: Some(fragments),
        })
    }
}

/// Whether this configuration stores what plane acceptance needs.
pub(crate) fn bounds_words(config: &Config) -> usize {
    if config.accept == Accept::Plane { 4 } else { 2 }
}
