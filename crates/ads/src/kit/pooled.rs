//! Structures that consist of a header, pools and passes: the code that they share.

use std::sync::{Mutex, PoisonError};

use bytemuck::{bytes_of, pod_read_unaligned};
use rasray_gpu::{Access, BindingSet, Device, GpuError, Recorder, Requirements};
use rasray_shaders_glsl::constants::contract::STATUS_COMPLETE;

use crate::kit::{
    BuildPipelines, Common, Configured, Demand, Design, FIRST_ROUNDS, Modules, Parts, PoolContents, PoolName,
    Pools, TraceKernels, TraceKernelsDesc, default_work_budget,
};
use crate::{
    AdsError, BuildStatus, Check, Counters, Description, Domain, Geometry, GeometryRigid, InlineTrace,
    Inspect, ListCounts, PoolSize, PoolStatus, RayQueue, RecordLayout, SceneBinding, Sizes, Start, Structure,
    StructureKind, StructureReport, Trace, TracedPart, Viewpoint,
};

/// Share of a demand that is added as margin if the demand [varies](Design::varies): one in this number. The
/// number of pages of a small scene differs by up to one in 33 from build to build if tens of thousands of
/// threads run at a time.
pub const VARYING_SHARE: u64 = 16;

/// Bytes of the linear part of a [`GeometryRigid`], which is at its start.
const LINEAR_BYTES: u64 = std::mem::offset_of!(GeometryRigid, centre) as u64;

/// Structure of a [`Design`]: it implements [`Structure`] with a header, pools and the passes of the design.
/// All structures except brute force and structures in parts are of this type; `rasray_bvh::Bvh`, for
/// example, is `Pooled<rasray_bvh::Passes>`.
#[derive(Debug)]
pub struct Pooled<D: Design> {
    description: Description,
    design: D,
    parts: Parts<D::Config>,
    /// Triangles that are traced: those that builds read, or if these are in a space of their own, the same
    /// triangles as posed.
    traced: Geometry,
    kernels: TraceKernels,
    /// The scene's set, if passes of the build read it.
    scene: Option<BindingSet>,
    /// True if the last recorded build read another set than `scene`.
    is_scene_new: bool,
    /// Header as [`Structure::status`] last read it; zeros until then. Reports and rounds refer to this
    /// build, even if triangles or pools have changed since: consecutive frames have nearly the same demand.
    known: Mutex<D::Header>,
}

fn modules<D: Design>(config: &D::Config) -> Modules {
    Modules { structure: D::NAME, prefix: D::NAME, addressing: config.common().addressing }
}

impl<D: Design> Pooled<D> {
    /// Records that the structure shares with its shaders, the header first.
    pub const RECORDS: &'static [RecordLayout] = D::RECORDS;

    /// Makes the pipelines and a first set of pools. `scene` is needed for alpha masks, for surfaces, and for
    /// payloads that keep data of the scene.
    ///
    /// # Errors
    /// An option is out of range or needs a feature or input that neither the device nor the caller provides;
    /// out of memory; a pool exceeds the maximum size of a binding (device addresses avoid that limit).
    pub fn new(
        device: &Device,
        mut config: D::Config,
        geometry: &Geometry,
        scene: Option<&SceneBinding>,
    ) -> Result<Self, AdsError> {
        let traced = geometry;
        let rest = geometry.rest().filter(|_| D::follow(&mut config, &geometry.extent()));
        let geometry = rest.unwrap_or(geometry);
        let sizes = D::first_plan(&config, &geometry.extent())?;
        let common = config.common();
        let Common { addressing, counters, .. } = common;
        let work_budget = common.work_budget.unwrap_or_else(|| default_work_budget(device));
        addressing.check(device)?;
        let requirements = Self::requirements_of(&config);
        device.require(D::TITLE, &requirements)?;
        D::complete(device, &mut config);
        let pools = Pools::new(device, D::NAME, addressing, &sizes)?;
        let modules = modules::<D>(&config);
        let mut constants = D::constants(&config);
        constants.extend(D::FOLLOWING.iter().filter(|_| rest.is_some()));
        let build_scene = scene.filter(|_| D::BUILD_READS_SCENE);
        let pipelines = BuildPipelines::new(device, modules, geometry, &pools, build_scene, &constants);
        let design = D::make(&pipelines, &config, build_scene)?;
        let header_pass = pipelines.compute("build_0_header")?;
        let variant = D::trace_variant(&config) + if rest.is_some() { ".rigid" } else { "" };
        let mut trace_modules = modules.trace_variant(&variant, scene)?;
        if D::has_first_hits(&config) {
            trace_modules.first_hits = Some(modules.find("first_hits")?);
        }
        let kernels = TraceKernels::new(
            device,
            geometry,
            &TraceKernelsDesc {
                modules: trace_modules,
                structure_layout: pools.layout(),
                constants: &constants,
                counters,
                work_budget,
                scene,
            },
        )?;
        let scene = build_scene.map(|scene| scene.set.clone());
        let surfaces_of_triangles =
            D::HAS_SURFACES_OF_TRIANGLES && kernels.surfaces(TracedPart::Whole).is_some();
        let description = Description {
            name: D::NAME,
            kind: D::kind(&config),
            requirements,
            counters,
            depends_on: D::depends_on(&config),
            surfaces_of_triangles,
            builds_on_host: D::builds_on_host(&config),
            follows: rest.is_some(),
            first_hits: kernels.first_hits().is_some(),
        };
        Ok(Self {
            description,
            design,
            parts: Parts { config, geometry: geometry.clone(), pools, work_budget, header_pass },
            traced: traced.clone(),
            kernels,
            scene,
            is_scene_new: false,
            known: Mutex::new(bytemuck::Zeroable::zeroed()),
        })
    }

    /// Returns the features that a configuration requires of a device, and those that it uses if present.
    pub fn requirements_of(config: &D::Config) -> Requirements {
        let mut requirements = D::requirements(config);
        modules::<D>(config).add_to(&mut requirements);
        requirements
    }

    /// Returns the kind of the hits of a configuration.
    pub fn kind_of(config: &D::Config) -> StructureKind {
        D::kind(config)
    }

    /// Returns the configuration that the structure was made with.
    pub fn config(&self) -> &D::Config {
        &self.parts.config
    }

    /// Returns the header after the last build of slot 0. The caller has waited for the submission.
    ///
    /// # Errors
    /// Host-visible memory could not be read.
    pub fn header(&self) -> Result<D::Header, GpuError> {
        self.parts.pools.header(0)
    }

    /// Returns the header that the host last read.
    fn known(&self) -> D::Header {
        *self.known.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Downloads the data that rays read, for checks. Submits and waits: for tests and tools.
    ///
    /// # Errors
    /// The device failed.
    pub fn download(&self, device: &Device) -> Result<D::Contents, GpuError> {
        let header = device.download_as::<D::Header>(self.parts.pools.header_buffer(), 0, 1)?[0];
        D::Contents::download(&self.parts, device, header)
    }

    /// Writes back contents that [`Pooled::download`] returned, changed or not. Submits and waits: for tests
    /// and tools. Traces stay within their bounds whatever the pools other than the header contain.
    ///
    /// # Safety
    /// Capacities and addresses in the header are those that were downloaded from this structure since its
    /// last resize.
    ///
    /// # Errors
    /// A pool is larger than what was allocated, or the device failed.
    pub unsafe fn upload(&self, device: &Device, contents: &D::Contents) -> Result<(), GpuError> {
        self.design.overwritten();
        let (header, pools) = contents.pools();
        device.upload(self.parts.pools.header_buffer(), 0, bytes_of(&header))?;
        pools.into_iter().try_for_each(|(pool, bytes)| device.upload(self.parts.pools.pool(pool), 0, bytes))
    }

    /// Returns the capacity of the pools, in the terms of the demand.
    fn capacity(&self) -> D::Demand {
        D::capacity(&self.parts.config, self.parts.pools.sizes(), &self.parts.extent())
    }

    fn ample_rounds(&self) -> u32 {
        D::ample_rounds(&self.parts, &self.known())
    }
}

impl<D: Design> Structure for Pooled<D> {
    fn description(&self) -> &Description {
        &self.description
    }

    fn sizes(&self) -> &Sizes {
        self.parts.pools.sizes()
    }

    fn resize(&mut self, device: &Device, sizes: &Sizes) -> Result<(), AdsError> {
        if sizes == self.sizes() {
            return Ok(());
        }
        self.sizes().check_pools(D::NAME, sizes)?;
        D::accepts(&self.parts.config, sizes)?;
        self.parts.pools.resize(device, sizes)?;
        self.design.forget();
        Ok(())
    }

    fn set_geometry(&mut self, device: &Device, geometry: &Geometry) -> Result<(), AdsError> {
        let built = match (self.description.follows, geometry.rest()) {
            (false, _) => geometry,
            (true, Some(rest)) => rest,
            (true, None) => {
                let reason = "a part that was built in a space of its own stays in one";
                return Err(AdsError::InParts { structure: D::NAME, reason });
            }
        };
        if let Some(sizes) = D::plan_for(&self.parts.config, self.sizes(), &built.extent())? {
            self.resize(device, &sizes)?;
        }
        self.parts.geometry = built.clone();
        self.traced = geometry.clone();
        self.design.forget();
        Ok(())
    }

    fn set_scene(&mut self, scene: &SceneBinding) -> Result<(), AdsError> {
        self.kernels.set_scene(D::NAME, scene)?;
        if let Some(read) = &mut self.scene {
            *read = scene.set.clone();
            self.is_scene_new = true;
        }
        Ok(())
    }

    fn set_counters(&mut self, device: &Device, counters: Counters) -> Result<(), AdsError> {
        self.kernels.set_counters(device, counters)?;
        self.description.counters = counters;
        Ok(())
    }

    fn prepare_build(&mut self, device: &Device) -> Result<(), AdsError> {
        self.design.prepare(&mut self.parts, device)
    }

    fn set_slots(&mut self, device: &Device, slots: u32) -> Result<(), AdsError> {
        self.parts.pools.set_slots(device, slots)
    }

    fn is_stale(&self, built: Viewpoint, wanted: Viewpoint) -> bool {
        D::is_stale(&self.parts, built, wanted)
    }

    fn record_build(
        &mut self,
        recorder: &mut Recorder<'_>,
        slot: u32,
        viewpoint: Viewpoint,
    ) -> Result<(), AdsError> {
        let header = self.design.first_header(&self.parts, viewpoint)?;
        self.parts.pools.begin::<D::Pool>(slot, header)?;
        self.is_scene_new = false;
        if self.description.follows {
            self.traced.record_gather(recorder);
        }
        self.design.record_passes(recorder, &self.parts, self.scene.as_ref());
        Ok(())
    }

    fn status(&self, slot: u32) -> Result<BuildStatus, GpuError> {
        let header: D::Header = self.parts.pools.header(slot)?;
        *self.known.lock().unwrap_or_else(PoisonError::into_inner) = header;
        let word = |at: usize| pod_read_unaligned::<u32>(&bytes_of(&header)[at..at + size_of::<u32>()]);
        let mut pools = Vec::new();
        let _ = self.design.asked(&self.parts, &header).zip(self.capacity(), |name, demand, capacity| {
            pools.push(PoolStatus { name, demand, capacity });
            demand
        });
        let was_complete = word(0) & STATUS_COMPLETE != 0;
        let is_current = self.parts.pools.are_of(slot);
        if was_complete && is_current {
            self.design.completed(&header);
        }
        let answers = is_current && self.parts.geometry.is_of(word(0)) && !self.is_scene_new;
        Ok(BuildStatus {
            complete: was_complete && answers,
            was_complete,
            pools,
            unsorted: D::UNSORTED.map_or(0, word).into(),
            outside: if is_current { self.parts.pools.outside(slot)? } else { 0 },
            corrupted: word(D::CORRUPTED).into(),
            parts: Vec::new(),
        })
    }

    fn check(&self, status: &BuildStatus, headroom: u32) -> Result<Check, AdsError> {
        let config = &self.parts.config;
        let capacity = self.capacity();
        status.check(headroom, |growth| {
            let wanted = capacity.zip(capacity, |name, capacity, _| {
                let mut demand = status.demand(name).unwrap_or(0);
                if demand > capacity && D::varies(config, name) {
                    demand += demand / VARYING_SHARE;
                }
                growth.of(demand, capacity)
            });
            D::plan(config, &wanted)
        })
    }

    fn rounds(&self) -> u32 {
        self.parts.pools.rounds(FIRST_ROUNDS.min(self.ample_rounds()))
    }

    fn allow_more_rounds(&self) -> bool {
        let (pools, ample) = (&self.parts.pools, self.ample_rounds());
        let most = D::most_rounds(&self.parts);
        let most = most.unwrap_or_else(|| pools.rounds_to_read_all(ample, self.parts.work_budget));
        pools.allow_more_rounds(FIRST_ROUNDS.min(ample), most)
    }

    fn record_trace(&self, recorder: &mut Recorder<'_>, queue: &RayQueue, mut trace: Trace<'_>) {
        let (Parts { pools, .. }, geometry, kernels) = (&self.parts, &self.traced, &self.kernels);
        if self.is_scene_new {
            pools.record_forget(recorder);
        }
        if self.description.kind != StructureKind::Primitive {
            trace.start = trace.start.of_all_rays();
        }
        if let Start::Part(rays) = trace.start {
            rays.record(recorder, pools.header_buffer(), queue, trace.domain, trace.mode);
        }
        self.design.keep(recorder);
        let rounds = trace.rounds.unwrap_or_else(|| self.rounds());
        pools.record_trace(recorder, kernels, geometry, queue, trace, rounds, D::CORRUPTED);
    }

    fn record_surfaces(
        &self,
        recorder: &mut Recorder<'_>,
        queue: &RayQueue,
        domain: Domain,
        part: TracedPart,
    ) -> Result<(), AdsError> {
        let (Parts { pools, .. }, geometry) = (&self.parts, &self.traced);
        let lookup = self.kernels.surfaces(part).ok_or(AdsError::NoScene { structure: D::NAME })?;
        if let Some((header, place)) = geometry.map_place().filter(|_| self.description.follows)
            && let Some(at) = D::RIGID
        {
            recorder.barrier(Access::COMPUTE | Access::TRANSFER, Access::TRANSFER);
            recorder.copy(header, place, pools.header_buffer(), at as u64, LINEAR_BYTES);
            recorder.barrier(Access::TRANSFER_WRITE, Access::COMPUTE | Access::TRANSFER);
        }
        pools.record_lookup(recorder, lookup, geometry.whole(), queue, domain, D::CORRUPTED);
        Ok(())
    }

    fn record_first_hits(
        &self,
        recorder: &mut Recorder<'_>,
        queue: &RayQueue,
        domain: Domain,
    ) -> Result<(), AdsError> {
        let lookup = self.kernels.first_hits().ok_or(AdsError::NoFirstHits { structure: D::NAME })?;
        let (Parts { pools, .. }, geometry) = (&self.parts, &self.traced);
        if self.is_scene_new {
            pools.record_forget(recorder);
        }
        pools.record_lookup(recorder, lookup, geometry, queue, domain, D::CORRUPTED);
        Ok(())
    }

    fn inline_trace(&self) -> Option<InlineTrace<'_>> {
        // Rays would have to be mapped if the structure was built in a space of its own.
        (!self.description.follows).then(|| self.parts.pools.inline_trace(D::constants(&self.parts.config)))
    }

    fn inspect(&self) -> Option<&dyn Inspect> {
        Some(self)
    }

    fn report(&self) -> Result<StructureReport, GpuError> {
        let header = self.known();
        let asked = self.design.asked(&self.parts, &header);
        let used = |size: &PoolSize| {
            let pool = D::Pool::ALL.iter().find(|pool| pool.name() == size.name);
            pool.and_then(|pool| D::used(&self.parts, &asked, *pool)).unwrap_or(size.elements)
        };
        let mut bytes_by_part = self.parts.pools.bytes_by_part(used);
        bytes_by_part.extend(self.design.bytes_outside_of_pools());
        Ok(StructureReport { bytes_by_part, ..D::report(&self.parts, &header, &asked) })
    }
}

impl<D: Design> Inspect for Pooled<D> {
    fn download_pools(&self, device: &Device) -> Result<Vec<(&'static str, Vec<u32>)>, GpuError> {
        let words = |pool: &D::Pool| Ok((pool.name(), self.parts.pools.download_words(device, *pool)?));
        D::Pool::ALL.iter().map(words).collect()
    }

    unsafe fn upload_pools(
        &self,
        device: &Device,
        pools: &[(&'static str, Vec<u32>)],
    ) -> Result<(), GpuError> {
        self.design.overwritten();
        pools.iter().try_for_each(|(name, words)| {
            let pool = D::Pool::ALL.iter().find(|pool| pool.name() == *name);
            let pool = pool.ok_or_else(|| GpuError::InvalidUse {
                name: (*name).to_owned(),
                reason: format!("is no pool of {}", D::TITLE),
            })?;
            device.upload(self.parts.pools.pool(*pool), 0, bytemuck::cast_slice(words))
        })
    }

    fn fault(&self, device: &Device) -> Result<Option<String>, GpuError> {
        Ok(D::fault(&self.download(device)?, self.parts.geometry.download_count(device)?))
    }

    fn list_counts(&self, device: &Device) -> Result<Vec<ListCounts>, AdsError> {
        D::list_counts(&self.download(device)?)
            .map_err(|fault| AdsError::Damaged { structure: D::NAME, fault })
    }
}
