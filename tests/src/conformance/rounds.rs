use rasray_ads::{Domain, Hit, QueueCounters, Ray, RayQueue, Structure, Trace, TraceMode};

use crate::harness::Bench;

/// Traces in at most `rounds` dispatches, whatever number the structure states, and returns the contents of
/// the queue afterwards, even if rays were given up or the structure was not ready.
///
/// # Panics
/// If the device fails.
pub fn trace_in_rounds(
    bench: &Bench,
    structure: &dyn Structure,
    rays: &[Ray],
    mode: TraceMode,
    rounds: u32,
) -> (Vec<Hit>, QueueCounters) {
    let device = bench.device();
    let count = rays.len() as u32;
    let queue = RayQueue::new(device, "rounds", count, false).expect("a queue fits");
    device.submit(|recorder| queue.record_reset(recorder)).expect("the device works");
    device.upload_slice(queue.rays(), 0, rays).expect("the device works");
    device
        .submit(|recorder| {
            structure.record_trace(
                recorder,
                &queue,
                Trace { rounds: Some(rounds), ..Trace::new(Domain::First(count), mode) },
            )
        })
        .expect("the device works");
    let hits = device.download_as::<Hit>(queue.hits(), 0, rays.len()).expect("the device works");
    (hits, queue.download_counters(device).expect("the device works"))
}
