//! The brute-force structure: every ray tests every triangle. All other structures are compared with it.

use rasray_gpu::{Device, GpuError, Recorder, Requirements};

use crate::kit::{Modules, TraceKernels, TraceKernelsDesc, default_work_budget};
use crate::slots::{check_read, check_recorded};
use crate::{
    Addressing, AdsError, BuildStatus, Check, Counters, Dependencies, Description, Domain, Geometry,
    RayQueue, SceneBinding, Sizes, Structure, StructureKind, StructureReport, Trace, TracedPart, Viewpoint,
};

/// Structure that tests every triangle for every ray: O(rays x triangles), no memory of its own.
///
/// Triangles that are read in place need no build. Otherwise a build gathers the indices, and counts the
/// triangles if only the device knows their number; until then traces answer *not ready*.
#[derive(Debug)]
pub struct BruteForce {
    description: Description,
    geometry: Geometry,
    kernels: TraceKernels,
    sizes: Sizes,
    work_budget: u32,
    slots: u32,
    /// True if a build of these triangles was recorded, or if they need no build.
    is_readable: bool,
}

impl BruteForce {
    /// Returns the requirements on a device.
    pub fn requirements_of() -> Requirements {
        let mut requirements = Requirements::compute();
        MODULES.add_to(&mut requirements);
        requirements
    }

    /// Makes the kernels. Surfaces and alpha masks need `scene`; without a scene all geometry is opaque.
    ///
    /// # Errors
    /// The device refuses a pipeline.
    pub fn new(
        device: &Device,
        geometry: &Geometry,
        scene: Option<&SceneBinding>,
        counters: impl Into<Counters>,
    ) -> Result<Self, AdsError> {
        let empty = device.create_set_layout("brute force", 0)?;
        let (counters, work_budget) = (counters.into(), default_work_budget(device));
        let kernels = TraceKernels::new(
            device,
            geometry,
            &TraceKernelsDesc {
                modules: MODULES.trace(scene)?,
                structure_layout: &empty,
                constants: &[],
                counters,
                work_budget,
                scene,
            },
        )?;
        let description = Description {
            name: MODULES.structure,
            kind: StructureKind::Primitive,
            requirements: Self::requirements_of(),
            counters,
            depends_on: Dependencies::default(),
            surfaces_of_triangles: kernels.surfaces(TracedPart::Whole).is_some(),
            builds_on_host: false,
            follows: false,
            first_hits: false,
        };
        Ok(Self {
            description,
            geometry: geometry.clone(),
            kernels,
            sizes: Sizes::default(),
            work_budget,
            slots: 1,
            is_readable: !geometry.is_gathered(),
        })
    }
}

/// Modules of the structure. It has no pools, so one addressing is enough.
const MODULES: Modules =
    Modules { structure: "brute-force", prefix: "brute", addressing: Addressing::Descriptor };

impl Structure for BruteForce {
    fn description(&self) -> &Description {
        &self.description
    }

    fn sizes(&self) -> &Sizes {
        &self.sizes
    }

    fn resize(&mut self, _device: &Device, sizes: &Sizes) -> Result<(), AdsError> {
        self.sizes.check_pools(self.description.name, sizes)
    }

    fn set_geometry(&mut self, _device: &Device, geometry: &Geometry) -> Result<(), AdsError> {
        self.geometry = geometry.clone();
        self.is_readable = !geometry.is_gathered();
        Ok(())
    }

    fn set_scene(&mut self, scene: &SceneBinding) -> Result<(), AdsError> {
        self.kernels.set_scene(self.description.name, scene)
    }

    fn set_counters(&mut self, device: &Device, counters: Counters) -> Result<(), AdsError> {
        self.kernels.set_counters(device, counters)?;
        self.description.counters = counters;
        Ok(())
    }

    fn set_slots(&mut self, _device: &Device, slots: u32) -> Result<(), AdsError> {
        self.slots = slots.max(1);
        Ok(())
    }

    fn record_build(
        &mut self,
        recorder: &mut Recorder<'_>,
        slot: u32,
        _viewpoint: Viewpoint,
    ) -> Result<(), AdsError> {
        check_recorded(self.description.name, slot, self.slots)?;
        self.geometry.record_gather(recorder);
        self.is_readable = true;
        Ok(())
    }

    fn status(&self, slot: u32) -> Result<BuildStatus, GpuError> {
        check_read(self.description.name, slot, self.slots)?;
        let complete = self.is_readable;
        Ok(BuildStatus { complete, was_complete: complete, ..BuildStatus::default() })
    }

    fn check(&self, status: &BuildStatus, headroom: u32) -> Result<Check, AdsError> {
        // The structure has no pools.
        status.check(headroom, |_| Ok(Sizes::default()))
    }

    fn rounds(&self) -> u32 {
        self.geometry.triangle_count().div_ceil(self.work_budget) + 1
    }

    fn record_trace(&self, recorder: &mut Recorder<'_>, queue: &RayQueue, mut trace: Trace<'_>) {
        trace.start = trace.start.of_all_rays();
        let rounds = trace.rounds.unwrap_or_else(|| self.rounds());
        self.kernels.record_trace(recorder, &self.geometry, None, 0, queue, trace, rounds);
    }

    fn record_surfaces(
        &self,
        recorder: &mut Recorder<'_>,
        queue: &RayQueue,
        domain: Domain,
        _part: TracedPart,
    ) -> Result<(), AdsError> {
        let lookup = self
            .kernels
            .surfaces(TracedPart::Whole)
            .ok_or(AdsError::NoScene { structure: self.description.name })?;
        lookup.record(recorder, self.geometry.whole(), None, 0, queue, domain);
        Ok(())
    }

    fn report(&self) -> Result<StructureReport, GpuError> {
        Ok(StructureReport::default())
    }
}
