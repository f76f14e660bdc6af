//! Traces and surfaces of selected slots: those slots and no others, whatever a shader left in the list.

use std::mem::offset_of;

use rasray_ads::{Domain, Hit, QueueHeader, Ray, RayQueue, Structure, Trace, TraceMode};
use rasray_gpu::Device;
use rasray_tests::harness::{Bench, bits};
use rasray_tests::invariance::Subject;
use rasray_tests::random::Random;
use rasray_tests::shapes::sphere;
use rasray_tracer::build_until_complete;

/// Slots, and rays.
const SLOTS: u32 = 300;

/// Work units per dispatch: more than any structure needs at once, less than most rays spend.
const BUDGET: u32 = 128;

/// A hit that no trace writes.
const UNTOUCHED: Hit = Hit { t: -7.0, primitive: 7, a: -7.0, b: -7.0 };

/// Selects slots as shaders would, by the host: the list that the next take makes valid, and its length.
fn select(device: &Device, queue: &RayQueue, slots: &[u32], length: u32) {
    let header = device.download_as::<QueueHeader>(queue.header(), 0, 1).expect("the device works")[0];
    let list = 2 + (header.takes + 1) % 2;
    device.upload_slice(queue.list(), u64::from(list * SLOTS) * 4, slots).expect("the device works");
    let place = offset_of!(QueueHeader, selecting) as u64;
    device.upload_slice(queue.header(), place, &[length]).expect("the device works");
}

/// Traces what is selected; the hits of all slots, and the number of rays that a trace began.
fn traced(device: &Device, queue: &RayQueue, structure: &dyn Structure, mode: TraceMode) -> Vec<Hit> {
    device.upload_slice(queue.hits(), 0, &[UNTOUCHED; SLOTS as usize]).expect("the device works");
    device
        .submit(|recorder| {
            queue.record_take(recorder);
            structure.record_trace(recorder, queue, Trace::new(Domain::Selected, mode));
        })
        .expect("the device works");
    let header = device.download_as::<QueueHeader>(queue.header(), 0, 1).expect("the device works")[0];
    let counters = RayQueue::counters(&header);
    assert_eq!((counters.unfinished, counters.not_ready, header.selecting), (0, 0, 0));
    device.download_as::<Hit>(queue.hits(), 0, SLOTS as usize).expect("the device works")
}

#[test]
fn selected_slots_are_traced_and_no_others() {
    let bench = Bench::new();
    let device = bench.device();
    let geometry = bench.geometry(&sphere([0.0; 3], 1.0, 12));
    let mut random = Random::new(11);
    let rays: Vec<Ray> = (0..SLOTS)
        .map(|_| {
            let origin = random.point(-1.5, 1.5);
            Ray::new(origin, random.direction())
        })
        .collect();
    // Out of order, across groups, and none at all.
    let selections: [Vec<u32>; 4] = [
        (0..SLOTS).rev().filter(|slot| slot % 3 == 1).collect(),
        vec![299],
        vec![],
        (0..SLOTS).map(|k| (k * 7) % SLOTS).collect(),
    ];
    let subjects = Subject::all();
    assert!(subjects.len() >= 8);
    for subject in subjects {
        // A small budget makes rays pause, so that lists of paused rays and of selected slots are used
        // together.
        let spec = subject.spec.clone().with_work_budget(BUDGET);
        let mut structure = spec.create(device, &geometry, None).expect("it can be made");
        build_until_complete(device, structure.as_mut(), [0.1, 0.2, 0.3], rasray_gpu::Timing::None)
            .expect("the build completes");
        let queue = RayQueue::new(device, "selected", SLOTS, false).expect("it fits");
        device.submit(|recorder| queue.record_reset(recorder)).expect("the device works");
        device.upload_slice(queue.rays(), 0, &rays).expect("the device works");
        let expected = bench.trace(structure.as_ref(), &rays).hits;
        assert!(expected.iter().filter(|hit| hit.is_hit()).count() > 30, "{}", subject.name());
        for slots in &selections {
            select(device, &queue, slots, slots.len() as u32);
            let hits = traced(device, &queue, structure.as_ref(), TraceMode::Closest);
            for (slot, (hit, wanted)) in hits.iter().zip(&expected).enumerate() {
                let wanted = if slots.contains(&(slot as u32)) { wanted } else { &UNTOUCHED };
                assert_eq!(bits(hit), bits(wanted), "{}: slot {slot} of {slots:?}", subject.name());
            }
            select(device, &queue, slots, slots.len() as u32);
            let hits = traced(device, &queue, structure.as_ref(), TraceMode::Occluded);
            for (slot, (hit, wanted)) in hits.iter().zip(&expected).enumerate() {
                let untouched = bits(hit) == bits(&UNTOUCHED);
                assert_eq!(untouched, !slots.contains(&(slot as u32)), "{}: slot {slot}", subject.name());
                assert!(untouched || hit.is_hit() == wanted.is_hit(), "{}: slot {slot}", subject.name());
            }
        }
    }
}

/// A list that a shader filled wrongly costs answers, not memory.
#[test]
fn slots_that_are_not_there_are_left_out() {
    let bench = Bench::new();
    let device = bench.device();
    let geometry = bench.geometry(&sphere([0.0; 3], 1.0, 6));
    let rays = vec![Ray::new([0.0; 3], [0.0, 0.1, 1.0]); SLOTS as usize];
    let structure = rasray_ads::BruteForce::new(device, &geometry, None, false).expect("it can be made");
    let queue = RayQueue::new(device, "selected", SLOTS, false).expect("it fits");
    device.submit(|recorder| queue.record_reset(recorder)).expect("the device works");
    device.upload_slice(queue.rays(), 0, &rays).expect("the device works");
    // Slots beyond the queue, and more of them than it has.
    let mut slots: Vec<u32> = (0..SLOTS).map(|k| if k % 2 == 0 { k } else { u32::MAX - k }).collect();
    slots[1] = SLOTS;
    select(device, &queue, &slots, u32::MAX);
    let hits = traced(device, &queue, &structure, TraceMode::Closest);
    for (slot, hit) in hits.iter().enumerate() {
        assert_eq!(hit.is_hit() && bits(hit) != bits(&UNTOUCHED), slot % 2 == 0, "slot {slot}: {hit:?}");
    }
    // Nothing is selected any more.
    let hits = traced(device, &queue, &structure, TraceMode::Closest);
    assert!(hits.iter().all(|hit| bits(hit) == bits(&UNTOUCHED)));
    select(device, &queue, &slots, SLOTS);
    device.submit(|recorder| queue.record_select_none(recorder)).expect("the device works");
    let hits = traced(device, &queue, &structure, TraceMode::Closest);
    assert!(hits.iter().all(|hit| bits(hit) == bits(&UNTOUCHED)));
}
