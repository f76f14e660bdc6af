//! Harness: a device shared by the tests of one binary, geometry from plain triangles, and traces of both
//! sides.

use std::collections::BTreeSet;
use std::sync::{Mutex, MutexGuard, OnceLock, PoisonError};

use rasray_ads::{
    BuildStatus, Domain, Draw, Geometry, GeometryDesc, Hit, PRIMITIVE_UNKNOWN, Ray, RayQueue, Structure,
    Surface, Trace, TraceMode, TracedPart, Viewpoint,
};
pub use rasray_experiment::oracle_ray;
use rasray_gpu::{BufferUsage, Device, DeviceDesc, Feature, Recorder, Requirements, Timing};
use rasray_reference::oracle;
use rasray_systems::Spec;
use rasray_tracer::{BatchTracer, TraceOutcome, build_until_complete};

/// Device with an active validation layer. Dropping the bench fails the test if the layer reported anything.
pub struct Bench {
    device: Device,
    /// Processor time of this process when the test began, seconds.
    begun: Option<f64>,
    _turn: MutexGuard<'static, ()>,
}

/// Number of pipelines kept, enough for every preset of every system: tests make the same structures again
/// and again, and most of their time is spent compiling shaders.
const KEPT_PIPELINES: usize = 512;

/// Returns the features that any test may use.
pub fn requirements() -> Requirements {
    let mut requirements = Requirements::floor();
    requirements.required.push(Feature::FragmentStoresAndAtomics);
    requirements.optional.push((Feature::BufferDeviceAddress, "pools reached by address"));
    let queried = "the driver's tree";
    requirements.optional.push((Feature::AccelerationStructure, queried));
    requirements.optional.push((Feature::RayQuery, queried));
    requirements.optional.push((Feature::ConservativeRasterization, "lists of tiles that it touches"));
    requirements.optional.push((Feature::Int64, "nodes read in words of 64 bits"));
    requirements
}

/// Returns the device of the tests of one binary.
fn shared_device() -> &'static Device {
    static DEVICE: OnceLock<Device> = OnceLock::new();
    DEVICE.get_or_init(|| {
        let desc = DeviceDesc { requirements: requirements(), validation: true, ..DeviceDesc::default() };
        let device = Device::create(&desc).expect("tests need a Vulkan device and the validation layer");
        device.keep_pipelines(KEPT_PIPELINES);
        device
    })
}

/// True if the device of the tests can have a structure. If it cannot, this is reported once, like a skipped
/// test.
///
/// # Panics
/// If there is no suitable device, or an option has an impossible value.
pub fn is_offered(spec: &Spec) -> bool {
    let requirements = spec.requirements().expect("the options are valid");
    let lacks = shared_device().lacks(&requirements);
    if !lacks.is_empty() {
        static SAID: Mutex<BTreeSet<&str>> = Mutex::new(BTreeSet::new());
        let name = spec.system().name;
        if SAID.lock().unwrap_or_else(PoisonError::into_inner).insert(name) {
            eprintln!("skipped: {name} needs {}, which the device has not", lacks.join(" and "));
        }
    }
    lacks.is_empty()
}

impl Bench {
    /// Takes the device; tests of one binary take turns, so that each message belongs to one of them.
    ///
    /// # Panics
    /// If there is no suitable device or no validation layer.
    pub fn new() -> Self {
        static TURN: Mutex<()> = Mutex::new(());
        let turn = TURN.lock().unwrap_or_else(PoisonError::into_inner);
        Self { device: shared_device().clone(), begun: processor_seconds(), _turn: turn }
    }

    /// Returns the device.
    pub fn device(&self) -> &Device {
        &self.device
    }

    /// Uploads triangles; ids follow the order given.
    ///
    /// # Panics
    /// If the device fails.
    pub fn geometry(&self, triangles: &[[[f32; 3]; 3]]) -> Geometry {
        self.geometry_of_draws(&[triangles])
    }

    /// Uploads posed triangles of several draws, at least one.
    ///
    /// # Panics
    /// If the device fails.
    pub fn geometry_of_draws(&self, objects: &[&[[[f32; 3]; 3]]]) -> Geometry {
        let positions: Vec<[f32; 3]> = objects.iter().copied().flatten().flatten().copied().collect();
        let indices: Vec<u32> = (0..positions.len() as u32).collect();
        let mut count = 0;
        let mut draws = Vec::new();
        for object in objects {
            let triangle_count = object.len() as u32;
            draws.push(Draw { first_triangle: count, triangle_count, ..Draw::default() });
            count += triangle_count;
        }
        let mut bounds = [[f32::INFINITY; 3], [f32::NEG_INFINITY; 3]];
        for p in &positions {
            for axis in 0..3 {
                bounds[0][axis] = bounds[0][axis].min(p[axis]);
                bounds[1][axis] = bounds[1][axis].max(p[axis]);
            }
        }
        if positions.is_empty() {
            bounds = [[0.0; 3]; 2];
        }
        let buffer = |name, bytes: &[u8]| {
            self.device.create_buffer_with(name, BufferUsage::ALL, bytes).expect("geometry fits")
        };
        let desc = GeometryDesc {
            positions: buffer("positions", bytemuck::cast_slice(&positions)).into(),
            indices: buffer("indices", bytemuck::cast_slice(&indices)).into(),
            draws: buffer("draws", bytemuck::cast_slice(&draws)).into(),
            vertex_count: positions.len() as u32,
            triangle_count: count,
            count: None,
            draw_count: draws.len() as u32,
            bounds,
            frame_origin: [0.0; 3],
        };
        Geometry::new(&self.device, desc).expect("geometry fits")
    }

    /// Builds once, with the pools at their present size.
    ///
    /// # Panics
    /// If the device fails.
    pub fn build_once(&self, structure: &mut dyn Structure, viewpoint: impl Into<Viewpoint>) -> BuildStatus {
        let viewpoint = viewpoint.into();
        structure.prepare_build(&self.device).expect("the device works");
        self.device
            .submit(|recorder| structure.record_build(recorder, 0, viewpoint))
            .expect("the device works")
            .value
            .expect("the header is written");
        structure.status(0).expect("the header is readable")
    }

    /// Builds and traces the nearest hits.
    ///
    /// # Panics
    /// If the device fails or rays do not finish.
    pub fn build_and_trace(
        &self,
        structure: &mut dyn Structure,
        viewpoint: impl Into<Viewpoint>,
        rays: &[Ray],
    ) -> Vec<Hit> {
        build_until_complete(&self.device, structure, viewpoint, Timing::None).expect("the build completes");
        self.trace(structure, rays).hits
    }

    /// Traces the nearest hits.
    ///
    /// # Panics
    /// If the device fails or rays do not finish.
    pub fn trace(&self, structure: &dyn Structure, rays: &[Ray]) -> TraceOutcome {
        let tracer =
            BatchTracer::new(&self.device, rays.len().clamp(1, 65_536) as u32).expect("a queue fits");
        tracer.trace(structure, rays, TraceMode::Closest, Timing::None).expect("all rays finish")
    }

    /// Returns the hits of rays, and the surfaces shaded there.
    ///
    /// # Panics
    /// If the device fails, or the structure was made without a scene.
    pub fn surfaces(&self, structure: &dyn Structure, rays: &[Ray]) -> Vec<(Hit, Surface)> {
        let device = self.device();
        let count = rays.len() as u32;
        let queue = RayQueue::new(device, "surfaces", count, true).expect("a queue fits");
        device.upload_slice(queue.rays(), 0, rays).expect("the device works");
        let trace = |recorder: &mut Recorder<'_>| {
            queue.record_reset(recorder);
            structure.record_trace(recorder, &queue, Trace::closest(Domain::First(count)));
            structure.record_surfaces(recorder, &queue, Domain::First(count), TracedPart::Whole)
        };
        let counters = loop {
            let submitted = device.submit(trace).expect("the device works");
            submitted.value.expect("the scene has surfaces");
            let counters = queue.download_counters(device).expect("the device works");
            if counters.unfinished == 0 || !structure.allow_more_rounds() {
                break counters;
            }
        };
        let hits = device.download_as::<Hit>(queue.hits(), 0, rays.len()).expect("the device works");
        let surfaces =
            device.download_as::<Surface>(queue.surfaces(), 0, rays.len()).expect("the device works");
        assert_eq!((counters.unfinished, counters.not_ready, counters.corrupted), (0, 0, 0));
        hits.into_iter().zip(surfaces).collect()
    }

    /// Returns true for each ray that hits anything, otherwise false.
    ///
    /// # Panics
    /// If the device fails or rays do not finish.
    pub fn occluded(&self, structure: &dyn Structure, rays: &[Ray]) -> Vec<bool> {
        let tracer =
            BatchTracer::new(&self.device, rays.len().clamp(1, 65_536) as u32).expect("a queue fits");
        let outcome =
            tracer.trace(structure, rays, TraceMode::Occluded, Timing::None).expect("all rays finish");
        outcome.hits.iter().map(Hit::is_hit).collect()
    }
}

impl Default for Bench {
    fn default() -> Self {
        Self::new()
    }
}

impl Drop for Bench {
    fn drop(&mut self) {
        if let (Some(begun), Some(ended)) = (self.begun, processor_seconds()) {
            println!("processor time: {:.1} s", ended - begun);
        }
        let messages = self.device.validation_messages();
        if !std::thread::panicking() {
            assert!(messages.is_empty(), "the validation layer says: {messages:#?}");
        }
    }
}

/// Returns the processor time of all threads of this process so far, in seconds; `None` where the system does
/// not have it in `/proc`. Tests take turns, so the time between two calls within a turn belongs to one test.
pub fn processor_seconds() -> Option<f64> {
    // Ticks of user and system time are fields 14 and 15; the name before them may hold spaces. Linux counts
    // 100 a second.
    let stat = std::fs::read_to_string("/proc/self/stat").ok()?;
    let fields: Vec<&str> = stat.rsplit_once(')')?.1.split_whitespace().collect();
    let ticks = |field: usize| fields.get(field - 3)?.parse::<f64>().ok();
    Some((ticks(14)? + ticks(15)?) / 100.0)
}

/// Returns all bits of a hit, so that equality covers every one of them.
pub fn bits(hit: &Hit) -> [u32; 4] {
    [hit.t.to_bits(), hit.primitive, hit.a.to_bits(), hit.b.to_bits()]
}

/// Returns the bits of a hit that are equal in every build. For fragments without an id, a and b refer to a
/// node, whose number follows the order of threads.
pub fn bits_of_any_build(hit: &Hit) -> [u32; 4] {
    let [t, primitive, a, b] = bits(hit);
    if primitive == PRIMITIVE_UNKNOWN { [t, primitive, 0, 0] } else { [t, primitive, a, b] }
}

/// Makes an oracle over the triangles.
pub fn oracle_of(triangles: &[[[f32; 3]; 3]]) -> oracle::Oracle<'static> {
    let positions: Vec<[f32; 3]> = triangles.iter().flatten().copied().collect();
    let indices: Vec<u32> = (0..positions.len() as u32).collect();
    oracle::Oracle::new(&positions, &indices, None).expect("the triangles are indexed in order")
}
