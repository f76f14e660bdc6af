//! Frames in flight.

use crate::device::common::{Scale, device, finish, storage};
use rasray_gpu::*;

#[test]
fn frames_in_flight_run_in_the_order_of_their_submission() {
    let device = device();
    for timing in [Timing::None, Timing::Device] {
        let scale = Scale::new(&device, 512);
        let results: Vec<Buffer> = (0..3).map(|_| storage(&device, "result", 4 * 512)).collect();
        let mut flights = Flights::new(&device, 3, timing).expect("a ring");
        let mut expected: Vec<u32> = (0..512).collect();
        for frame in 0..12_u32 {
            let slot = frame % flights.slots();
            let passes = flights.wait(slot).expect("the frame ends");
            assert_eq!(passes.is_some(), frame >= 3);
            if let Some(passes) = passes {
                assert_eq!(passes.len(), usize::from(timing == Timing::Device));
                let found = device.download_as::<u32>(&results[slot as usize], 0, 512).expect("download");
                let first = expected_after(frame - 2);
                assert_eq!(found, first, "frame {}", frame - 3);
            }
            flights
                .submit(slot, |recorder| {
                    recorder.begin_pass(Stage::Build, "scale");
                    scale.bind(recorder, 3);
                    scale.dispatch(recorder);
                    recorder.end_pass();
                    recorder.barrier(Access::COMPUTE_WRITE, Access::TRANSFER);
                    recorder.copy(&scale.buffer, 0, &results[slot as usize], 0, 4 * 512);
                })
                .expect("submission");
            assert!(flights.is_pending(slot));
            expected = expected_after(frame + 1);
        }
        flights.wait_all().expect("all end");
        assert!((0..3).all(|slot| flights.is_done(slot).expect("the slot exists")));
        assert_eq!(scale.values(&device), expected);
    }
    finish(device);
}

/// Returns the values 0, 1, 2, ... after a number of dispatches.
fn expected_after(dispatches: u32) -> Vec<u32> {
    let once = |value: u32| value.wrapping_mul(3).wrapping_add(Scale::BIAS);
    (0..512).map(|first| (0..dispatches).fold(first, |value, _| once(value))).collect()
}

#[test]
fn a_slot_is_waited_for_before_it_is_used_again() {
    let device = device();
    let buffer = storage(&device, "filled", 64);
    let mut flights = Flights::new(&device, 2, Timing::None).expect("a ring");
    flights.submit(0, |recorder| recorder.fill(&buffer, 0, 64, 5)).expect("submission");
    let error = flights.submit(0, |_| ()).expect_err("the slot is in use");
    assert!(error.to_string().contains("slot 0 was not waited for"), "{error}");
    // A mistake of the recording prevents the submission and leaves the slot free.
    let error = flights.submit(1, |recorder| recorder.fill(&buffer, 0, 128, 5)).expect_err("beyond the end");
    assert!(!flights.is_pending(1), "{error}");
    flights.submit(1, |recorder| recorder.fill(&buffer, 32, 32, 7)).expect("submission");
    assert!(flights.submit(2, |_| ()).is_err() && flights.wait(2).is_err() && flights.is_done(2).is_err());
    assert!(Flights::new(&device, 2, Timing::Host).is_err());
    flights.wait_all().expect("both end");
    assert_eq!(flights.wait(0).expect("nothing is pending"), None);
    assert_eq!(device.download_as::<u32>(&buffer, 28, 2).expect("download"), [5, 7]);
    drop((flights, buffer));
    finish(device);
}

#[test]
fn what_frames_in_flight_use_lives_until_they_end() {
    let device = device();
    let source = storage(&device, "source", 1 << 20);
    let target = storage(&device, "target", 1 << 20);
    let mut flights = Flights::new(&device, 2, Timing::None).expect("a ring");
    flights
        .submit(0, |recorder| {
            recorder.fill(&source, 0, source.size(), 9);
            recorder.barrier(Access::TRANSFER_WRITE, Access::TRANSFER);
            recorder.copy(&source, 0, &target, 0, source.size());
        })
        .expect("submission");
    drop(source);
    // Dropping the ring waits for its submissions.
    drop(flights);
    let filled = device.download_as::<u32>(&target, 0, 1 << 18).expect("download");
    assert!(filled.iter().all(|word| *word == 9));
    drop(target);
    finish(device);
}
