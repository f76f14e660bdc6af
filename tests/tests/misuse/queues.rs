//! Queues that nobody wrote to, and queues of buffers of a host.

use rasray_ads::{
    AdsError, BruteForce, Domain, Hit, QueueBuffers, QueueParts, Ray, RayQueue, Structure, Trace,
};
use rasray_gpu::{Buffer, BufferDesc, BufferUsage, Device, MemoryLocation, RawDevice, vk};
use rasray_integrators::Film;
use rasray_tests::harness::{Bench, bits_of_any_build};
use rasray_tests::shapes::closed_box;

use crate::misuse::dirty_memory;
use crate::misuse::unbuilt::{EYE, rays};

/// The first thing recorded of a queue may be a trace.
#[test]
fn a_fresh_queue_selects_nothing_and_its_rays_miss() {
    let bench = Bench::new();
    let device = bench.device();
    let geometry = bench.geometry(&closed_box([-2.0; 3], [2.0; 3]));
    let mut brute = BruteForce::new(device, &geometry, None, false).expect("kernels");
    bench.build_once(&mut brute, EYE);
    for slots in [1, 64, 5000] {
        dirty_memory(&bench);
        let parts = QueueParts { surfaces: true, work: true, steps: 4 };
        let queue = RayQueue::with_parts(device, "fresh", slots, parts).expect("it fits");
        let words = |buffer: &Buffer| -> Vec<u32> {
            device.download_as(buffer, 0, (buffer.size() / 4) as usize).expect("the device works")
        };
        let header = words(queue.header());
        assert!(
            header.iter().enumerate().all(|(at, word)| *word == if at == 3 { slots } else { 0 }),
            "{header:?}"
        );
        for buffer in [queue.rays(), queue.hits(), queue.list(), queue.surfaces(), queue.work()] {
            assert!(words(buffer).iter().all(|word| *word == 0), "{}", buffer.name());
        }
        let trace = |domain| {
            let submitted = device.submit(|recorder| {
                brute.record_trace(recorder, &queue, Trace::closest(domain));
            });
            submitted.expect("the device works");
            device.download_as::<Hit>(queue.hits(), 0, slots as usize).expect("the device works")
        };
        let untouched = trace(Domain::Selected);
        assert!(untouched.iter().all(|hit| hit.t == 0.0 && hit.primitive == 0), "{untouched:?}");
        assert!(trace(Domain::First(slots)).iter().all(|hit| !hit.is_hit()));
        assert_eq!(queue.download_counters(device).expect("the device works"), Default::default());
        assert_eq!(queue.download_steps(device).expect("the device works"), (Vec::new(), 0));
        // Without a reset of the caller's own it answers.
        let ray = vec![Ray::new(EYE, [0.1, 0.2, 1.0]); slots as usize];
        device.upload_slice(queue.rays(), 0, &ray).expect("the device works");
        assert!(trace(Domain::First(slots)).iter().all(Hit::is_hit));
    }
    dirty_memory(&bench);
    let film = Film::new(device, 7, 5).expect("it fits");
    assert!(
        film.read_pixels(device).expect("the device works").iter().all(|pixel| *pixel == Default::default())
    );
    assert_eq!(film.read_faults(device).expect("the device works"), Default::default());
}

#[test]
fn a_queue_of_buffers_of_the_host_traces_what_is_in_them() {
    let bench = Bench::new();
    let device = bench.device();
    let geometry = bench.geometry(&closed_box([-2.0; 3], [2.0; 3]));
    let mut brute = BruteForce::new(device, &geometry, None, false).expect("kernels");
    bench.build_once(&mut brute, EYE);
    let rays = rays();
    let expected: Vec<_> = bench.trace(&brute, &rays).hits.iter().map(bits_of_any_build).collect();
    let of_host = |name: &str, bytes: u64, usage| {
        let desc = BufferDesc { name, size: bytes, usage, location: MemoryLocation::Device };
        device.create_buffer(&desc).expect("it fits")
    };
    let up = BufferUsage::STORAGE | BufferUsage::TRANSFER_SRC | BufferUsage::TRANSFER_DST;
    let down = BufferUsage::STORAGE | BufferUsage::TRANSFER_SRC;
    dirty_memory(&bench);
    let fill = |buffer: &Buffer| device.upload_slice(buffer, 0, &rays).expect("the device works");
    // Rays and hits alone, and everything; larger than they have to be.
    let alone = QueueBuffers::new(of_host("rays", 48 * 70, up), of_host("hits", 16 * 80, down));
    let all = QueueBuffers {
        header: Some(of_host("header", 112, BufferUsage::ALL)),
        states: Some(of_host("states", 64 * 64, BufferUsage::STORAGE)),
        list: Some(of_host("list", 16 * 64, BufferUsage::STORAGE)),
        surfaces: Some(of_host("surfaces", 128 * 64, BufferUsage::STORAGE)),
        work: Some(of_host("work", 24 * 64, BufferUsage::STORAGE)),
        ..QueueBuffers::new(of_host("rays", 48 * 64, up), of_host("hits", 16 * 64, down))
    };
    for buffers in [alone.clone(), all.clone()] {
        fill(&buffers.rays);
        let resets = buffers.header.is_some();
        let (hits, queue) = (buffers.hits.clone(), RayQueue::from_buffers(device, "of a host", 64, buffers));
        let queue = queue.expect("they are large enough");
        let trace = || {
            let submitted = device.submit(|recorder| {
                if resets {
                    queue.record_reset(recorder);
                }
                brute.record_trace(recorder, &queue, Trace::closest(Domain::First(64)));
            });
            submitted.expect("the device works");
        };
        trace();
        let found: Vec<Hit> = device.download_as(&hits, 0, 64).expect("the device works");
        assert_eq!(found.iter().map(bits_of_any_build).collect::<Vec<_>>(), expected);
    }
    type Change = fn(&mut QueueBuffers, &dyn Fn(&str, u64, BufferUsage) -> Buffer);
    let wrong: [(Change, &str); 7] = [
        (
            |of, make| of.rays = make("short", 48 * 63, BufferUsage::STORAGE),
            "rays of 64 slots take 3072 bytes",
        ),
        (|of, make| of.hits = make("short", 1023, BufferUsage::STORAGE), "buffer `short` has 1023"),
        (|of, make| of.hits = make("copied", 1024, BufferUsage::TRANSFER_DST), "as a storage buffer"),
        (|of, make| of.header = Some(make("header", 112, BufferUsage::STORAGE)), "with all usages"),
        (|of, make| of.list = Some(make("list", 4 * 64, BufferUsage::STORAGE)), "list of 64 slots"),
        (|of, make| of.states = Some(make("states", 64, BufferUsage::STORAGE)), "states of 64 slots"),
        (|of, _| of.hits = of.rays.clone(), "is given twice, also for hits"),
    ];
    for (change, says) in wrong {
        let mut buffers = all.clone();
        change(&mut buffers, &of_host);
        let error = RayQueue::from_buffers(device, "wrong", 64, buffers).map(drop).expect_err(says);
        assert!(matches!(error, AdsError::Queue { .. }) && error.to_string().contains(says), "{error}");
    }
}

/// A host may hand in a device without a queue, through which nothing can be cleared.
#[test]
fn a_queue_on_a_device_that_cannot_submit_selects_nothing() {
    let bench = Bench::new();
    let of_bench = bench.device();
    let raw = RawDevice {
        instance: of_bench.raw_instance().clone(),
        physical: of_bench.raw_physical(),
        device: of_bench.raw().clone(),
        queue: vk::Queue::null(),
        queue_family: of_bench.queue_family(),
        api_version: of_bench.api_version(),
        enabled: of_bench.enabled(),
        debug_utils: false,
        pipeline_cache: vk::PipelineCache::null(),
        memory: None,
        memory_limit: None,
    };
    // SAFETY: all of it is the bench's, which goes last, with the features that it enabled; nothing is
    // submitted.
    let device = unsafe { Device::from_raw(raw) }.expect("it is a device");
    let parts = QueueParts { steps: 4, ..QueueParts::default() };
    let queue = RayQueue::with_parts(&device, "of a host", 9, parts).expect("it fits");
    let header: Vec<u32> = device.download_as(queue.header(), 0, 23).expect("the host reads it");
    assert!(header.iter().enumerate().all(|(at, word)| *word == if at == 3 { 9 } else { 0 }), "{header:?}");
    assert_eq!(queue.download_steps(&device).expect("the host reads it"), (Vec::new(), 0));
    drop(Film::new(&device, 4, 4).expect("it fits"));
}
