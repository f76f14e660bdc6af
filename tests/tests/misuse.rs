//! Safe functions called as they should not be: each is impossible, an error with a name, or a status that says so.

use ash::vk;
use rasray_ads::{
    Addressing, AdsError, BufferOffset, BuildStatus, Check, Domain, Draw, Geometry, GeometryDesc, Hit,
    IndexFormat, Indexing, Pools, Ray, RayQueue, Sizes, TraceMode,
};
use rasray_gpu::{BufferDesc, BufferUsage, Device, GpuError, MemoryLocation, Recorder, Timing};
use rasray_systems::Spec;
use rasray_tests::harness::{Bench, bits};
use rasray_tests::invariance::Subject;
use rasray_tests::shapes::{closed_box, sphere};
use rasray_tracer::{BatchTracer, TracerError, build_until_complete};

rasray_ads::pool_names! {
    /// Pools of no structure.
    pub enum Pool {
        /// What shaders start from.
        Header = "header",
        /// Something else.
        Nodes = "nodes",
    }
}

/// Leaves words of ones behind for whoever is given the memory next: every status bit set.
fn dirty_memory(bench: &Bench) {
    let buffers: Vec<_> = [256_u64, 4096, 1 << 16, 1 << 20, 8 << 20]
        .into_iter()
        .map(|size| {
            let desc = BufferDesc {
                name: "dirt",
                size,
                usage: BufferUsage::STORAGE | BufferUsage::TRANSFER_DST,
                location: MemoryLocation::Device,
            };
            bench.device().create_buffer(&desc).expect("it fits")
        })
        .collect();
    let fill = |buffer: &rasray_gpu::Buffer| {
        bench
            .device()
            .submit(|recorder| recorder.fill(buffer, 0, buffer.size(), u32::MAX))
            .expect("it is filled");
    };
    buffers.iter().for_each(fill);
}

/// The same with more elements in the last pool.
fn larger(mut sizes: Sizes) -> Sizes {
    if let Some(pool) = sizes.pools.last_mut() {
        pool.elements += 256;
    }
    sizes
}

#[test]
fn structures_that_were_never_built_say_so() {
    let bench = Bench::new();
    let device = bench.device();
    let geometry = bench.geometry(&closed_box([-1.0; 3], [1.0; 3]));
    let rays = [Ray::new([0.0; 3], [0.1, 0.2, 1.0]); 5];
    let tracer = BatchTracer::new(device, 8).expect("a queue fits");
    let mut refused = 0;
    for subject in Subject::all() {
        if subject.spec.system().name == "brute-force" {
            // It builds nothing, so it is always ready.
            continue;
        }
        for _ in 0..4 {
            dirty_memory(&bench);
            let mut structure = subject.spec.create(device, &geometry, None).expect("it can be made");
            let status = structure.status(0).expect("the header is readable");
            assert!(!status.complete && status.outside == 0, "{}: {status:?}", subject.name());
            // A build whose status was lost asks for nothing more than there is, so that those after it are not lost, too.
            let wanted = structure.check(&status, 50).expect("there are sizes");
            assert_eq!(wanted, Check::Grow(structure.sizes().clone()), "{}", subject.name());
            for mode in [TraceMode::Closest, TraceMode::Occluded] {
                let outcome = tracer.trace(structure.as_ref(), &rays, mode, Timing::None);
                let error = outcome.map(drop).expect_err("nothing was built");
                assert!(matches!(error, TracerError::NotReady { rays: 5 }), "{}: {error}", subject.name());
                refused += 1;
            }
            build_until_complete(device, structure.as_mut(), [0.0; 3], Timing::None)
                .expect("the build completes");
            let hits = bench.trace(structure.as_ref(), &rays).hits;
            assert!(hits.iter().all(Hit::is_hit), "{}: {hits:?}", subject.name());
            // What it asked for last is what it has: nothing is lost.
            let sizes = structure.sizes().clone();
            structure.resize(device, &sizes).expect("it fits");
            assert!(structure.status(0).expect("the header is readable").complete, "{}", subject.name());
            // Larger, it is a new one.
            dirty_memory(&bench);
            structure.resize(device, &larger(sizes)).expect("it fits");
            assert!(!structure.status(0).expect("the header is readable").complete, "{}", subject.name());
            assert!(!structure.status(0).expect("the header is readable").complete, "{}", subject.name());
            let outcome = tracer.trace(structure.as_ref(), &rays, TraceMode::Closest, Timing::None);
            assert!(matches!(outcome, Err(TracerError::NotReady { rays: 5 })), "{}", subject.name());
        }
    }
    assert!(refused >= 16);
}

/// Shaders of an embedder look at the header, which no recording of ours comes before.
#[test]
fn fresh_headers_are_zero() {
    let bench = Bench::new();
    let device = bench.device();
    let sizes = Sizes::of("test", [(Pool::Header, 64, 4), (Pool::Nodes, 16, 4)]).expect("small pools");
    dirty_memory(&bench);
    let mut pools = Pools::new(device, "test", Addressing::Descriptor, &sizes).expect("it fits");
    for _ in 0..2 {
        assert_eq!(pools.download_words(device, Pool::Header).expect("the device works"), [0; 64]);
        dirty_memory(&bench);
        pools.resize(device, &sizes).expect("it fits");
    }
}

#[test]
fn slots_beyond_the_queue_are_refused() {
    let bench = Bench::new();
    let device = bench.device();
    let geometry = bench.geometry(&closed_box([-1.0; 3], [1.0; 3]));
    let queue = RayQueue::new(device, "rays", 8, false).expect("it fits");
    for subject in Subject::all() {
        let structure = subject.spec.create(device, &geometry, None).expect("it can be made");
        let submitted = device
            .submit(|recorder| {
                structure.record_trace(recorder, &queue, Domain::First(9), TraceMode::Closest, 1)
            })
            .map(drop);
        let error = submitted.expect_err("there are 8 slots").to_string();
        assert!(error.contains("9 slots of a queue of 8"), "{}: {error}", subject.name());
    }
}

fn desc_of(device: &Device, triangles: u32) -> GeometryDesc {
    let buffer = |name, bytes: u64| {
        let usage = BufferUsage::STORAGE;
        device.create_buffer(&BufferDesc { name, size: bytes, usage, location: MemoryLocation::Device })
    };
    let bytes = u64::from(triangles);
    GeometryDesc {
        positions: buffer("positions", 36 * bytes).expect("it fits").into(),
        indices: buffer("indices", 12 * bytes).expect("it fits").into(),
        draws: buffer("draws", size_of::<Draw>() as u64).expect("it fits").into(),
        vertex_count: 3 * triangles,
        triangle_count: triangles,
        count: None,
        draw_count: 1,
        bounds: [[-1.0; 3], [1.0; 3]],
        frame_origin: [0.0; 3],
    }
}

#[test]
fn a_geometry_that_its_buffers_do_not_hold_is_an_error() {
    let bench = Bench::new();
    let device = bench.device();
    let desc = desc_of(device, 4);
    drop(Geometry::new(device, desc.clone()).expect("it is right"));
    type Change = fn(&mut GeometryDesc);
    let wrong: [(Change, &str); 17] = [
        (|desc| desc.positions.stride = 8, "a stride of 8 bytes"),
        (|desc| desc.positions.stride = 14, "a stride of 14 bytes"),
        (|desc| desc.positions.stride = 16, "12 vertices are 188 bytes from byte 0"),
        (|desc| desc.positions.offset = 2, "byte 2 of buffer `positions`"),
        (|desc| desc.positions.offset = 4, "12 vertices are 144 bytes from byte 4"),
        (|desc| desc.positions.offset = u64::MAX - 3, "12 vertices"),
        (|desc| desc.indices.offset = 2, "byte 2 of buffer `indices`, which must be a multiple of 4"),
        (
            |desc| (desc.indices.format, desc.indices.offset) = (IndexFormat::U16, 1),
            "byte 1 of buffer `indices`, which must be a multiple of 2",
        ),
        (|desc| desc.indices.indexing = Indexing::PerDraw { index_count: 13 }, "13 indices are 52 bytes"),
        (|desc| desc.draws.offset = 4, "byte 4 of buffer `draws`"),
        (
            |desc| desc.count = Some(BufferOffset { buffer: desc.draws.buffer.clone(), offset: 24 }),
            "the number of triangles",
        ),
        (|desc| desc.vertex_count = 13, "13 vertices"),
        (|desc| desc.triangle_count = u32::MAX, "4294967295 triangles"),
        (|desc| desc.draw_count = 2, "2 draws"),
        (|desc| desc.bounds[1][2] = f32::NAN, "finite"),
        (|desc| desc.bounds[0][0] = f32::NEG_INFINITY, "finite"),
        (|desc| desc.bounds[0][1] = 1.5, "the lower corner first"),
    ];
    for (change, text) in wrong {
        let mut desc = desc.clone();
        change(&mut desc);
        let error = Geometry::new(device, desc).map(drop).expect_err(text);
        assert!(matches!(error, AdsError::Geometry { .. }), "{error}");
        assert!(error.to_string().contains(text), "{error}");
    }
}

/// Bounds are what cells are placed by: a triangle outside of them would be lost without a word.
#[test]
fn triangles_outside_of_the_stated_bounds_are_counted_and_no_build_is_complete() {
    let bench = Bench::new();
    let device = bench.device();
    let triangles = closed_box([-1.0; 3], [1.0; 3]);
    let sound = bench.geometry(&triangles);
    let tight = GeometryDesc { bounds: [[-1.0, -1.0, -1.0], [1.0, 1.0, 0.5]], ..sound.desc().clone() };
    let tight = Geometry::new(device, tight).expect("the host cannot see it");
    let few = GeometryDesc { vertex_count: 35, ..sound.desc().clone() };
    let few = Geometry::new(device, few).expect("the host cannot see it");
    let reaching = triangles.iter().filter(|triangle| triangle.iter().any(|corner| corner[2] > 0.5)).count();
    let rays = [Ray::new([0.0; 3], [0.1, 0.2, 1.0]); 5];
    let tracer = BatchTracer::new(device, 8).expect("a queue fits");
    for subject in Subject::all() {
        if subject.spec.system().name == "brute-force" {
            // It asks for no bounds, and takes a vertex that there is not for the origin.
            continue;
        }
        for (geometry, outside) in [(&tight, reaching as u32), (&few, 1)] {
            let mut structure = subject.spec.create(device, geometry, None).expect("it can be made");
            let status = bench.build_once(structure.as_mut(), [0.0; 3]);
            assert_eq!((status.complete, status.outside), (false, outside), "{}", subject.name());
            let error = structure.check(&status, 0).expect_err("no size helps");
            assert!(
                matches!(error, AdsError::OutsideBounds { triangles } if triangles == outside),
                "{error}"
            );
            let outcome = tracer.trace(structure.as_ref(), &rays, TraceMode::Closest, Timing::None);
            assert!(matches!(outcome, Err(TracerError::NotReady { .. })), "{}", subject.name());
            // It is as good as new once the triangles are.
            structure.set_geometry(device, &sound).expect("it fits");
            build_until_complete(device, structure.as_mut(), [0.0; 3], Timing::None).expect("it is sound");
            assert!(bench.trace(structure.as_ref(), &rays).hits.iter().all(Hit::is_hit));
        }
    }
}

/// Each recording has its own header, and each slot keeps what its build asked for: the second one's are not the first
/// one's.
#[test]
fn builds_that_wait_for_the_device_together_keep_their_eyes() {
    let bench = Bench::new();
    let device = bench.device();
    let geometry = bench.geometry(&sphere([0.0, 0.0, 4.0], 1.0, 12));
    let eyes = [[0.0, 0.0, 0.0], [3.0, 1.0, 4.0]];
    let rays: Vec<_> = (0..200_u8)
        .map(|k| {
            Ray::new([0.3, 0.2, 0.0], [f32::from(k) / 400.0 - 0.25, f32::from(k % 13) / 50.0 - 0.1, 1.0])
        })
        .collect();
    let count = rays.len() as u32;
    let (mut differing, mut statuses_differ) = (0, 0);
    for subject in Subject::all() {
        let mut structure = subject.spec.create(device, &geometry, None).expect("it can be made");
        for eye in eyes {
            // Pools grow for both.
            build_until_complete(device, structure.as_mut(), eye, Timing::None).expect("it is built");
        }
        structure.set_slots(device, 3).expect("it fits");
        assert_eq!(structure.slots(), 3);
        let alone = eyes.map(|eye| {
            let hits = bench.build_and_trace(structure.as_mut(), eye, &rays);
            (hits, structure.status(0).expect("the header is readable"))
        });
        let expected = alone.each_ref().map(|(hits, _)| hits);
        let statuses = alone.each_ref().map(|(_, status)| status);
        let queues = [(); 2].map(|()| {
            let queue = RayQueue::new(device, "rays", count, false).expect("it fits");
            device.submit(|recorder| queue.record_reset(recorder)).expect("the device works");
            device.upload_slice(queue.rays(), 0, &rays).expect("the device works");
            queue
        });
        if structure.prepare_build(device).is_err() || subject.spec.system().name == "bvh" {
            // A tree of the host is made for one recording at a time, and looks at no eye.
            continue;
        }
        let submitted = device.submit(|recorder| {
            for ((eye, queue), slot) in eyes.iter().zip(&queues).zip(1..) {
                structure.record_build(recorder, slot, (*eye).into())?;
                structure.record_trace(
                    recorder,
                    queue,
                    Domain::First(count),
                    TraceMode::Closest,
                    structure.rounds(),
                );
            }
            Ok::<_, AdsError>(())
        });
        submitted.expect("the device works").value.expect("it is recorded");
        let found = [1, 2].map(|slot| structure.status(slot).expect("the header is readable"));
        // What depends a little on which threads meet is compared where it does not.
        for (found, expected) in found.iter().zip(statuses) {
            assert!(found.complete && expected.complete, "{}", subject.name());
            for (found, expected) in found.pools.iter().zip(&expected.pools) {
                let tolerance = expected.demand / 8;
                assert!(found.demand.abs_diff(expected.demand) <= tolerance, "{}: {found:?}", subject.name());
            }
        }
        let demands = |status: &BuildStatus| status.pools.iter().map(|pool| pool.demand).collect::<Vec<_>>();
        statuses_differ += usize::from(demands(&found[0]) != demands(&found[1]));
        let depends = structure.depends_on();
        let same = expected[0].iter().map(bits).eq(expected[1].iter().map(bits));
        assert!(depends.eye || same, "{}: hits depend on the eye", subject.name());
        let beyond = device.submit(|recorder| structure.record_build(recorder, 3, eyes[0].into()));
        let beyond = beyond.expect("the device works").value.map(drop);
        assert!(matches!(beyond, Err(AdsError::Slot { slot: 3, slots: 3, .. })), "{}", subject.name());
        assert!(structure.status(3).is_err(), "{}", subject.name());
        for (queue, expected) in queues.iter().zip(expected) {
            let found: Vec<Hit> = device.download_as(queue.hits(), 0, rays.len()).expect("the device works");
            let same = found.iter().zip(expected).all(|(found, expected)| bits(found) == bits(expected));
            assert!(same, "{}", subject.name());
        }
        differing += usize::from(expected[0].iter().map(bits).ne(expected[1].iter().map(bits)));
    }
    assert!(differing > 0, "no structure's hits depend on the eye: the test cannot fail");
    assert!(statuses_differ > 0, "no structure's demand depends on the eye: the test cannot fail");
}

/// What was recorded for a host lives as long as the record of it, whatever happens to structure and queue.
#[test]
fn a_structure_may_be_dropped_or_resized_while_the_device_has_yet_to_use_it() {
    let bench = Bench::new();
    let device = bench.device();
    let geometry = bench.geometry(&closed_box([-1.0; 3], [1.0; 3]));
    let rays = [Ray::new([0.0; 3], [0.1, 0.2, 1.0]); 8];
    let (raw, queue) = (device.raw(), device.raw_queue());
    let subjects = Subject::all();
    let by_address = subjects.iter().filter_map(|subject| subject.with(&[("addressing", "address")]));
    for subject in subjects.iter().cloned().chain(by_address) {
        let mut structure = subject.spec.create(device, &geometry, None).expect("it can be made");
        build_until_complete(device, structure.as_mut(), [0.0; 3], Timing::None).expect("it is built");
        structure.prepare_build(device).expect("the device works");
        let rays_of = RayQueue::new(device, "rays", 8, false).expect("it fits");
        device.upload_slice(rays_of.rays(), 0, &rays).expect("the device works");
        let hits = rays_of.hits().clone();
        // SAFETY: pool and command buffer are this test's alone, and `recorded` is dropped after the wait.
        unsafe {
            let info = vk::CommandPoolCreateInfo::default().queue_family_index(device.queue_family());
            let pool = raw.create_command_pool(&info, None).expect("a pool");
            let info = vk::CommandBufferAllocateInfo::default().command_pool(pool).command_buffer_count(1);
            let commands = raw.allocate_command_buffers(&info).expect("a command buffer");
            raw.begin_command_buffer(commands[0], &vk::CommandBufferBeginInfo::default()).expect("begun");
            let mut recorder = Recorder::from_raw(device, commands[0]);
            rays_of.record_reset(&mut recorder);
            structure.record_build(&mut recorder, 0, [0.0; 3].into()).expect("it is recorded");
            structure.record_trace(
                &mut recorder,
                &rays_of,
                Domain::First(8),
                TraceMode::Closest,
                structure.rounds(),
            );
            let recorded = recorder.finish().expect("no mistake");
            raw.end_command_buffer(commands[0]).expect("ended");
            let sizes = larger(structure.sizes().clone());
            structure.resize(device, &sizes).expect("it fits");
            drop((structure, rays_of));
            dirty_memory(&bench);
            let submit = vk::SubmitInfo::default().command_buffers(&commands);
            raw.queue_submit(queue, &[submit], vk::Fence::null()).expect("submitted");
            raw.queue_wait_idle(queue).expect("done");
            drop(recorded);
            raw.destroy_command_pool(pool, None);
        }
        let hits: Vec<Hit> = device.download_as(&hits, 0, rays.len()).expect("the device works");
        assert!(hits.iter().all(Hit::is_hit), "{}: {hits:?}", subject.name());
    }
}

/// A scene that asks for a little more each frame grows seldom with headroom, and each time without.
#[test]
fn headroom_spares_frames_that_grow() {
    let bench = Bench::new();
    let device = bench.device();
    let spec =
        Spec::new("mmrt", "robust", [("resolution".to_owned(), "64".to_owned())]).expect("it is valid");
    let spec = spec.with_option("capacity", "100").expect("it is valid");
    let incomplete = |headroom| {
        let frame = |radius| bench.geometry(&sphere([0.0, 0.0, 4.0], radius, 10));
        let mut structure = spec.create(device, &frame(0.5), None).expect("it can be made");
        build_until_complete(device, structure.as_mut(), [0.0; 3], Timing::None).expect("it is built");
        let mut incomplete = 0;
        for step in 1..=12_u8 {
            let geometry = frame(0.5 + 0.1 * f32::from(step));
            structure.set_geometry(device, &geometry).expect("it fits");
            let mut whole = true;
            while let Check::Grow(sizes) = {
                let status = bench.build_once(structure.as_mut(), [0.0; 3]);
                structure.check(&status, headroom).expect("there are sizes that do")
            } {
                structure.resize(device, &sizes).expect("it fits");
                whole = false;
            }
            incomplete += u32::from(!whole);
        }
        incomplete
    };
    let (exact, roomy) = (incomplete(0), incomplete(50));
    println!(
        "of 12 frames {exact} were incomplete at first with exact growth, {roomy} with 50 percent headroom"
    );
    assert!(exact > 2 * roomy, "{exact}, {roomy}");
}

#[test]
fn a_recording_that_was_refused_is_an_error() {
    let bench = Bench::new();
    let submitted = bench.device().submit(|recorder| recorder.refuse("because")).map(drop);
    assert!(matches!(submitted, Err(GpuError::InvalidUse { reason, .. }) if reason == "because"));
}
