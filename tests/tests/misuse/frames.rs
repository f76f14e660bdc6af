//! Several frames of one structure: builds that are pending together, structures that are dropped or resized
//! while they are in use, demand that increases.

use ash::vk;
use rasray_ads::{AdsError, BuildStatus, Check, Domain, Hit, Ray, RayQueue, Trace};
use rasray_gpu::{Recorder, Timing};
use rasray_systems::Spec;
use rasray_tests::harness::{Bench, bits};
use rasray_tests::invariance::Subject;
use rasray_tests::shapes::{closed_box, sphere};
use rasray_tracer::build_until_complete;

use crate::misuse::{dirty_memory, larger};

/// Each recording has its own header, and each slot keeps the demand of its build: the second one's are not
/// the first one's.
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
            // A tree of the host is made for one recording at a time, and does not depend on the eye.
            continue;
        }
        let submitted = device.submit(|recorder| {
            for ((eye, queue), slot) in eyes.iter().zip(&queues).zip(1..) {
                structure.record_build(recorder, slot, (*eye).into())?;
                structure.record_trace(recorder, queue, Trace::closest(Domain::First(count)));
            }
            Ok::<_, AdsError>(())
        });
        submitted.expect("the device works").value.expect("it is recorded");
        let found = [1, 2].map(|slot| structure.status(slot).expect("the header is readable"));
        // The number of begun pages depends slightly on which threads collide: demands may differ by an
        // eighth.
        for (found, expected) in found.iter().zip(statuses) {
            assert!(found.complete && expected.complete, "{}", subject.name());
            for (found, expected) in found.pools.iter().zip(&expected.pools) {
                let tolerance = expected.demand / 8;
                assert!(found.demand.abs_diff(expected.demand) <= tolerance, "{}: {found:?}", subject.name());
            }
        }
        let demands = |status: &BuildStatus| status.pools.iter().map(|pool| pool.demand).collect::<Vec<_>>();
        statuses_differ += usize::from(demands(&found[0]) != demands(&found[1]));
        let depends = structure.description().depends_on;
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

/// Objects that a recording for a host uses live as long as the recording, whatever happens to structure and
/// queue.
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
            structure.record_trace(&mut recorder, &rays_of, Trace::closest(Domain::First(8)));
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

/// A scene whose demand increases slightly per frame grows rarely with headroom, and each time without.
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
