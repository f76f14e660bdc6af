//! Safe functions called as they should not be: each is impossible, an error with a name, or a status that
//! says so.

mod devices;
mod frames;
mod geometry;
mod queues;
mod unbuilt;

use rasray_ads::kit::Pools;
use rasray_ads::{
    Addressing, AdsError, Check, Domain, Hit, PoolSize, Ray, RayQueue, Sizes, Trace, TraceMode,
};
use rasray_bvh::{Header, Pool};
use rasray_gpu::{BufferDesc, BufferUsage, GpuError, MemoryLocation, Timing};
use rasray_tests::harness::Bench;
use rasray_tests::invariance::Subject;
use rasray_tests::shapes::closed_box;
use rasray_tracer::{BatchTracer, TracerError, build_until_complete};

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

/// `sizes` with more elements in the last pool.
fn larger(mut sizes: Sizes) -> Sizes {
    if let Some(pool) = sizes.pools.last_mut() {
        pool.elements += 256;
    }
    sizes
}

/// A structure takes sizes of its own pools only, and keeps those that it has.
#[test]
fn sizes_of_other_pools_are_refused() {
    let bench = Bench::new();
    let device = bench.device();
    let geometry = bench.geometry(&closed_box([-1.0; 3], [1.0; 3]));
    for subject in Subject::all() {
        let mut structure = subject.spec.create(device, &geometry, None).expect("it can be made");
        let sizes = structure.sizes().clone();
        let mut wider = sizes.clone();
        wider.pools.iter_mut().for_each(|pool| pool.element_bytes += 4);
        let mut more = sizes.clone();
        more.pools.push(PoolSize { name: "other", elements: 1, element_bytes: 4 });
        let fewer = Sizes::default();
        for other in [wider, more, fewer] {
            if other == sizes {
                // Brute force has no pools.
                continue;
            }
            let error = structure.resize(device, &other).expect_err("they are of other pools");
            assert!(matches!(error, AdsError::OtherPools { .. }), "{}: {error}", subject.name());
            assert_eq!(*structure.sizes(), sizes, "{}", subject.name());
        }
    }
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
            // A build whose status was lost demands no more than the capacity, so that those after it are not
            // lost, too.
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
            // Its last demand is its capacity: nothing is lost.
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
    let sizes = Sizes::of("test", [(Pool::Nodes, 16, 4)]).expect("small pools");
    dirty_memory(&bench);
    let mut pools = Pools::new(device, "test", Addressing::Descriptor, &sizes).expect("it fits");
    for _ in 0..2 {
        assert_eq!(
            pools.download_words(device, Pool::Header).expect("the device works"),
            vec![0; size_of::<Header>() / 4]
        );
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
                structure.record_trace(
                    recorder,
                    &queue,
                    Trace { rounds: Some(1), ..Trace::closest(Domain::First(9)) },
                )
            })
            .map(drop);
        let error = submitted.expect_err("there are 8 slots").to_string();
        assert!(error.contains("9 slots of a queue of 8"), "{}: {error}", subject.name());
    }
}

#[test]
fn a_recording_that_was_refused_is_an_error() {
    let bench = Bench::new();
    let submitted = bench.device().submit(|recorder| recorder.refuse("because")).map(drop);
    assert!(matches!(submitted, Err(GpuError::InvalidUse { reason, .. }) if reason == "because"));
}
