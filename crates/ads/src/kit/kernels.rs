//! Kernels that trace a queue: one set of pipelines per structure, recorded in the same way for all
//! structures.

use bytemuck::bytes_of;
use rasray_gpu::{
    Access, BindingSet, ComputePipeline, ComputePipelineDesc, Device, Recorder, SetLayout, Stage,
};
use rasray_shaders_glsl::Shader;
use rasray_shaders_glsl::constant_ids::contract::{COUNTERS, NESTED_SEARCH};
use rasray_shaders_glsl::constants::ads::{PART_AFTER, PART_FIRST, PART_NEXT, PART_WHOLE};
use rasray_shaders_glsl::records::{NextRoundConstants, TraceConstants};

use crate::kit::TraceModules;
use crate::kit::addressing::halves;
use crate::kit::design::nests_searches;
use crate::{
    AdsError, Counters, Domain, Geometry, QueueHeader, RayQueue, SceneBinding, Start, Trace, TraceMode,
};

/// Part of a geometry whose hits get surfaces.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TracedPart {
    /// All triangles of the geometry.
    Whole,
    /// The part that was traced first.
    First {
        /// Number of parts that were traced after this part.
        after: u32,
    },
    /// A part that was traced later, starting from the hits that the parts before it left in the queue.
    Next {
        /// Number of parts that were traced after this part.
        after: u32,
    },
}

impl TracedPart {
    fn constant(self) -> u32 {
        match self {
            Self::Whole => PART_WHOLE,
            Self::First { after } => PART_FIRST + after * PART_AFTER,
            Self::Next { after } => PART_NEXT + after * PART_AFTER,
        }
    }
}

/// Inputs to make the kernels of a structure from.
#[derive(Clone, Debug)]
pub struct TraceKernelsDesc<'a> {
    /// Trace modules of the structure.
    pub modules: TraceModules,
    /// Layout of the structure's set.
    pub structure_layout: &'a SetLayout,
    /// Specialisation constants of the structure: id and bits.
    pub constants: &'a [(u32, u32)],
    /// Counters of their work that rays record.
    pub counters: Counters,
    /// Work units that a ray may spend per dispatch.
    pub work_budget: u32,
    /// The scene, needed for surfaces and alpha masks.
    pub scene: Option<&'a SceneBinding>,
}

/// Pipelines that trace a queue through one structure.
#[derive(Debug)]
pub struct TraceKernels {
    source: Source,
    trace: ComputePipeline,
    /// Labels of traces for nearest hits and for occlusion.
    trace_labels: [String; 2],
    surfaces: Option<Kernel>,
    first_hits: Option<Kernel>,
    next_round: ComputePipeline,
    scene: Option<SceneBinding>,
    work_budget: u32,
}

#[derive(Debug)]
struct Kernel {
    label: &'static str,
    pipeline: ComputePipeline,
}

/// Inputs of the pipelines that all of them share, and the module of the trace.
#[derive(Debug)]
struct Source {
    trace: &'static Shader,
    sets: Vec<SetLayout>,
    constants: Vec<(u32, u32)>,
}

impl Source {
    fn pipeline(
        &self,
        device: &Device,
        shader: &'static Shader,
        counters: Counters,
    ) -> Result<ComputePipeline, AdsError> {
        let constants = [&[(COUNTERS, counters.constant())], &self.constants[..]].concat();
        Ok(device.create_compute_pipeline(&ComputePipelineDesc {
            name: shader.name,
            module: &shader.module(),
            sets: &self.sets.iter().collect::<Vec<_>>(),
            push_constant_bytes: size_of::<TraceConstants>() as u32,
            constants: &constants,
        })?)
    }
}

impl TraceKernels {
    /// Makes the pipelines.
    ///
    /// # Errors
    /// The device refuses a pipeline.
    pub fn new(device: &Device, geometry: &Geometry, desc: &TraceKernelsDesc<'_>) -> Result<Self, AdsError> {
        let queue_layout = RayQueue::layout(device)?;
        let TraceModules { trace, surfaces, first_hits } = desc.modules;
        let mut sets = vec![geometry.layout().clone(), desc.structure_layout.clone(), queue_layout.clone()];
        sets.extend(desc.scene.map(|scene| scene.layout.clone()));
        let mut constants = vec![(NESTED_SEARCH, u32::from(nests_searches(device.driver())))];
        constants.extend_from_slice(desc.constants);
        constants.extend(desc.scene.iter().flat_map(|scene| &scene.constants));
        let source = Source { trace, sets, constants };
        let kernel = |shader: &'static Shader| -> Result<Kernel, AdsError> {
            let pipeline = source.pipeline(device, shader, desc.counters)?;
            Ok(Kernel { label: shader.name, pipeline })
        };
        let next_round = device.create_compute_pipeline(&ComputePipelineDesc {
            name: "ads/queue_next_round",
            module: &rasray_shaders_glsl::ADS_QUEUE_NEXT_ROUND.module(),
            sets: &[geometry.layout(), desc.structure_layout, &queue_layout],
            push_constant_bytes: size_of::<NextRoundConstants>() as u32,
            constants: &[],
        })?;
        Ok(Self {
            trace: source.pipeline(device, trace, desc.counters)?,
            trace_labels: ["/trace_closest", "/trace_occluded"]
                .map(|label| trace.name.replacen("/trace", label, 1)),
            surfaces: surfaces.filter(|_| desc.scene.is_some()).map(kernel).transpose()?,
            first_hits: first_hits.map(kernel).transpose()?,
            next_round,
            scene: desc.scene.cloned(),
            work_budget: desc.work_budget,
            source,
        })
    }

    /// Chooses how much of their work rays count, from the next recording on. Nothing changes after an error.
    ///
    /// # Errors
    /// The device refuses the pipeline.
    pub fn set_counters(&mut self, device: &Device, counters: Counters) -> Result<(), AdsError> {
        self.trace = self.source.pipeline(device, self.source.trace, counters)?;
        Ok(())
    }

    /// Makes the kernels read another scene from the next recording on. The kernels do not change after an
    /// error.
    ///
    /// # Errors
    /// The kernels of `structure` were made without a scene, or for a scene with other properties that
    /// kernels are compiled for.
    pub fn set_scene(&mut self, structure: &'static str, scene: &SceneBinding) -> Result<(), AdsError> {
        let made_for = self.scene.as_mut().ok_or(AdsError::NoScene { structure })?;
        if let Some(what) = made_for.difference(scene) {
            return Err(AdsError::OtherScene { structure, what });
        }
        *made_for = scene.clone();
        Ok(())
    }

    fn constants(&self, address: u64, domain: Domain, part: u32) -> TraceConstants {
        TraceConstants {
            structure: halves(address),
            domain: domain.word(),
            work_budget: self.work_budget,
            part,
            any_hit: 0,
            is_last: 0,
        }
    }

    fn bind(
        &self,
        recorder: &mut Recorder<'_>,
        pipeline: &ComputePipeline,
        geometry: &Geometry,
        structure: Option<&BindingSet>,
        queue: &RayQueue,
        constants: TraceConstants,
    ) {
        recorder.bind_compute(pipeline);
        recorder.bind_sets(0, &[geometry.set()]);
        if let Some(structure) = structure {
            recorder.bind_sets(1, &[structure]);
        }
        recorder.bind_sets(2, &[queue.set()]);
        if let Some(scene) = &self.scene {
            recorder.bind_sets(3, &[&scene.set]);
        }
        recorder.push_constants(bytes_of(&constants));
    }

    /// Records a trace: one dispatch for all rays, then up to `rounds - 1` for rays that paused. Rays still
    /// paused after the last dispatch are counted as unfinished. `rounds` replaces [`Trace::rounds`]. With
    /// [`Start::Part`], the queue already lists the rays as paused, with states.
    #[expect(clippy::too_many_arguments, reason = "everything a trace depends on, each of its own type")]
    pub fn record_trace(
        &self,
        recorder: &mut Recorder<'_>,
        geometry: &Geometry,
        structure: Option<&BindingSet>,
        address: u64,
        queue: &RayQueue,
        trace: Trace<'_>,
        rounds: u32,
    ) {
        let Trace { domain, mode, start, .. } = trace;
        let (part, listed) = match start {
            Start::New => (PART_WHOLE, false),
            Start::Continue => (PART_NEXT, false),
            Start::Part(_) => (PART_NEXT, true),
        };
        let any_hit = mode == TraceMode::Occluded;
        let constants = TraceConstants { any_hit: any_hit.into(), ..self.constants(address, domain, part) };
        let rounds = rounds.max(1);
        let bind = |recorder: &mut Recorder<'_>, round| {
            let constants = TraceConstants { is_last: (round + 1 == rounds).into(), ..constants };
            self.bind(recorder, &self.trace, geometry, structure, queue, constants);
        };
        recorder.begin_pass(Stage::Trace(mode), &self.trace_labels[usize::from(any_hit)]);
        if !listed {
            record_first_round(recorder, queue);
            bind(recorder, 0);
            queue.record_dispatch(recorder, domain);
        }
        for round in u32::from(!listed)..rounds {
            self.record_next_round(recorder, queue, false);
            bind(recorder, round);
            recorder.dispatch_indirect(queue.header(), 0);
        }
        self.record_next_round(recorder, queue, true);
        recorder.end_pass();
    }

    fn record_next_round(&self, recorder: &mut Recorder<'_>, queue: &RayQueue, last: bool) {
        recorder.barrier(Access::COMPUTE, Access::COMPUTE);
        recorder.bind_compute(&self.next_round);
        recorder.bind_sets(2, &[queue.set()]);
        recorder.push_constants(bytes_of(&NextRoundConstants { last: last.into() }));
        recorder.dispatch([1, 1, 1]);
        recorder.barrier(Access::COMPUTE, Access::COMPUTE | Access::INDIRECT_READ | Access::TRANSFER);
    }

    /// Returns the lookup of the surfaces of hits on a part; absent if the kernels were made without a scene.
    /// Hits name triangles by their ids, so the whole geometry is bound even for a part.
    pub fn surfaces(&self, part: TracedPart) -> Option<Lookup<'_>> {
        let kernel = self.surfaces.as_ref()?;
        Some(Lookup { kernels: self, kernel, stage: Stage::Surfaces, part })
    }

    /// Returns the lookup of first hits of camera rays, which replaces a trace; absent if the structure has
    /// no first hits.
    pub fn first_hits(&self) -> Option<Lookup<'_>> {
        let kernel = self.first_hits.as_ref()?;
        Some(Lookup { kernels: self, kernel, stage: Stage::Visible, part: TracedPart::Whole })
    }
}

/// Records the state before the first round: no ray of the queue has been traced, and none is paused.
pub(crate) fn record_first_round(recorder: &mut Recorder<'_>, queue: &RayQueue) {
    let round = std::mem::offset_of!(QueueHeader, round) as u64;
    let after_paused = std::mem::offset_of!(QueueHeader, unfinished) as u64;
    recorder.barrier(Access::COMPUTE, Access::TRANSFER_WRITE);
    recorder.fill(queue.header(), round, after_paused - round, 0);
    recorder.barrier(Access::TRANSFER_WRITE, Access::COMPUTE);
}

/// One dispatch that looks up data for the slots of a queue.
#[derive(Clone, Copy, Debug)]
pub struct Lookup<'a> {
    kernels: &'a TraceKernels,
    kernel: &'a Kernel,
    stage: Stage,
    part: TracedPart,
}

impl Lookup<'_> {
    /// Records the lookup for the slots of `domain`. Its results are visible to the commands that follow.
    pub fn record(
        &self,
        recorder: &mut Recorder<'_>,
        geometry: &Geometry,
        structure: Option<&BindingSet>,
        address: u64,
        queue: &RayQueue,
        domain: Domain,
    ) {
        let constants = self.kernels.constants(address, domain, self.part.constant());
        recorder.begin_pass(self.stage, self.kernel.label);
        self.kernels.bind(recorder, &self.kernel.pipeline, geometry, structure, queue, constants);
        queue.record_dispatch(recorder, domain);
        recorder.barrier(Access::COMPUTE, Access::COMPUTE | Access::TRANSFER);
        recorder.end_pass();
    }
}
