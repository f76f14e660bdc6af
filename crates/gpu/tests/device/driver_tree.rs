//! Trees of the driver: making, building and refusals.

use rasray_gpu::*;

use crate::device::common::{device_with, finish, requirements, storage};

const FEATURES: [Feature; 3] =
    [Feature::BufferDeviceAddress, Feature::AccelerationStructure, Feature::RayQuery];

const DESC: DriverTreeDesc<'_> = DriverTreeDesc { name: "tree", boxes: 100, goal: DriverTreeGoal::Trace };

/// Makes a device with trees; says so if no device has them.
fn device() -> Option<Device> {
    let trees = Requirements { required: FEATURES.to_vec(), ..Requirements::default() };
    let wanted = requirements().merge(&trees);
    let has_one =
        Device::list(&wanted).is_ok_and(|devices| devices.iter().any(|device| device.is_suitable()));
    if !has_one {
        eprintln!("skipped: no device has rayQuery");
    }
    has_one.then(|| device_with(wanted))
}

#[test]
fn trees_are_built_anew_and_outlive_their_owners() {
    let Some(device) = device() else { return };
    // A staircase of boxes.
    let boxes: Vec<[f32; 6]> = (0..100)
        .map(|step| {
            let at = step as f32;
            [at, at, at, at + 0.5, at + 0.5, at + 0.5]
        })
        .collect();
    let buffer = device.create_buffer_with("boxes", BufferUsage::STORAGE, &boxes).expect("they fit");
    let tree = device.create_driver_tree(&DESC).expect("it fits");
    assert!(tree.address() != 0 && tree.boxes() == 100);
    // The tree is larger than the boxes alone, because a driver copies them.
    assert!(tree.bytes() > 100 * DRIVER_BOX_BYTES && tree.scratch_bytes() > 0, "{tree:?}");
    let mut counted = Vec::new();
    for count in [100, 7, 0, 1] {
        device
            .submit(|recorder| {
                recorder.begin_pass(Stage::Build, "tree");
                recorder.build_driver_tree(&tree, &buffer, count);
                recorder.end_pass();
                counted.push(recorder.passes()[0].trees);
            })
            .expect("it is built");
    }
    assert_eq!(counted, [1; 4]);
    let mut flights = Flights::new(&device, 1, Timing::None).expect("a ring");
    flights.submit(0, |recorder| recorder.build_driver_tree(&tree, &buffer, 100)).expect("it is submitted");
    drop((tree, buffer));
    flights.wait_all().expect("the tree was there");
    drop(flights);
    finish(device);
}

#[test]
fn what_no_tree_can_be_built_of_is_refused() {
    let Some(device) = device() else { return };
    let tree = device.create_driver_tree(&DESC).expect("it fits");
    let buffer = storage(&device, "few boxes", 10 * DRIVER_BOX_BYTES);
    let refused = |text: &str, boxes: &Buffer, count| {
        let error = device.submit(|recorder| recorder.build_driver_tree(&tree, boxes, count));
        let error = error.expect_err(text).to_string();
        assert!(error.contains(text), "`{error}` does not say `{text}`");
    };
    refused("few boxes", &buffer, 11);
    let large = storage(&device, "many boxes", 101 * DRIVER_BOX_BYTES);
    refused("the number of boxes of the tree", &large, 101);
    // SAFETY: the buffer is that of `large`, which outlives it.
    let of_a_host = unsafe {
        let (raw, size, usage) = (large.raw(), large.size(), large.usage());
        device.buffer_from_raw(&RawBuffer { name: "of a host", raw, size, usage })
    };
    refused("a storage buffer that was made here", &of_a_host, 100);
    let no_storage = BufferDesc {
        name: "no storage",
        size: 10 * DRIVER_BOX_BYTES,
        usage: BufferUsage::TRANSFER_DST,
        location: MemoryLocation::Device,
    };
    refused("a storage buffer that was made here", &device.create_buffer(&no_storage).expect("it fits"), 10);
    drop((tree, buffer, large, of_a_host));
    finish(device);

    let without = device_with(requirements());
    let error = without.create_driver_tree(&DESC).expect_err("the feature is not enabled").to_string();
    assert!(error.contains("accelerationStructure") && error.contains("tree"), "{error}");
    finish(without);
}
