//! A structure that was never built answers "not ready", whatever its fresh memory holds.

use rasray_ads::{Ray, TraceMode};
use rasray_gpu::{BufferDesc, BufferUsage, MemoryLocation, Timing};
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

#[test]
fn structures_that_were_never_built_say_so() {
    let bench = Bench::new();
    let device = bench.device();
    let geometry = bench.geometry(&closed_box([-1.0; 3], [1.0; 3]));
    let rays = [Ray::new([0.0; 3], [0.1, 0.2, 1.0]); 5];
    let tracer = BatchTracer::new(device, 8).expect("a queue fits");
    let mut refused = 0;
    for subject in Subject::all(&bench) {
        if subject.spec.system().name == "brute-force" {
            // It builds nothing, so it is always ready.
            continue;
        }
        for _ in 0..4 {
            dirty_memory(&bench);
            let mut structure = subject.spec.create(device, &geometry, None).expect("it can be made");
            for mode in [TraceMode::Closest, TraceMode::Occluded] {
                let outcome = tracer.trace(structure.as_ref(), &rays, mode, Timing::None);
                let error = outcome.map(drop).expect_err("nothing was built");
                assert!(matches!(error, TracerError::NotReady { rays: 5 }), "{}: {error}", subject.name());
                refused += 1;
            }
            build_until_complete(device, structure.as_mut(), [0.0; 3], Timing::None)
                .expect("the build completes");
            let hits = bench.trace(structure.as_ref(), &rays).hits;
            assert!(hits.iter().all(rasray_ads::Hit::is_hit), "{}: {hits:?}", subject.name());
        }
    }
    assert!(refused >= 16);
}
