//! Mistakes of callers give errors that name the object or pass.

use std::time::Duration;

use crate::device::common::{Scale, bytes_of, device, finish, module, shaders, storage};
use rasray_gpu::*;

/// Returns the error of a recording; its message must contain `text`.
fn mistake(device: &Device, text: &str, record: impl FnOnce(&mut Recorder<'_>)) -> GpuError {
    let error = device.submit(record).expect_err(text);
    assert!(error.to_string().contains(text), "`{error}` does not say `{text}`");
    error
}

#[test]
fn the_order_of_commands_is_checked() {
    let device = device();
    let scale = Scale::new(&device, 64);
    for timing in [Timing::None, Timing::Host] {
        let options = SubmitOptions { timing, ..SubmitOptions::default() };
        let error = device.submit_with(&options, |recorder| {
            recorder.begin_pass(Stage::Build, "outer");
            recorder.begin_pass(Stage::Build, "inner");
        });
        assert!(error.expect_err("nested").to_string().contains("within the pass `outer`"));
    }
    mistake(&device, "without a compute pipeline", |recorder| recorder.dispatch([1, 1, 1]));
    mistake(&device, "sets were bound without a pipeline", |recorder| recorder.bind_sets(0, &[&scale.set]));
    mistake(&device, "`scale` uses set 0, which is not bound", |recorder| {
        recorder.bind_compute(&scale.pipeline);
        recorder.push_constants(bytes_of(&[64, 2]));
        recorder.dispatch([1, 1, 1]);
    });
    for constants in [&[][..], &[64]] {
        mistake(&device, "`scale` has push constants, which were not set", |recorder| {
            recorder.bind_compute(&scale.pipeline);
            recorder.bind_sets(0, &[&scale.set]);
            recorder.push_constants(bytes_of(constants));
            recorder.dispatch([1, 1, 1]);
        });
    }
    // Vulkan drops sets where push constants or layouts before them differ.
    let wider = ComputePipelineDesc {
        name: "wider",
        module: &module(shaders::SCALE),
        sets: &[&scale.layout],
        push_constant_bytes: 16,
        constants: &[],
    };
    let wider = device.create_compute_pipeline(&wider).expect("pipeline");
    mistake(&device, "`wider` uses set 0, which is not bound", |recorder| {
        scale.bind(recorder, 1);
        recorder.bind_compute(&wider);
        recorder.push_constants(bytes_of(&[64, 1, 0, 0]));
        recorder.dispatch([1, 1, 1]);
    });
    mistake(&device, "`open`: the pass was not ended", |recorder| recorder.begin_pass(Stage::Build, "open"));
    mistake(&device, "a pass was ended that was not begun", |recorder| recorder.end_pass());
    mistake(&device, "rendering was not ended", |recorder| recorder.begin_rendering(4, 4));
    mistake(&device, "rendering was ended that was not begun", |recorder| recorder.end_rendering());
    mistake(&device, "at least one pixel", |recorder| recorder.begin_rendering(0, 4));
    mistake(&device, "fill was called between begin_rendering", |recorder| {
        recorder.begin_rendering(4, 4);
        recorder.fill(&scale.buffer, 0, 4, 1);
        recorder.end_rendering();
    });
    mistake(&device, "a draw was recorded without a raster pipeline", |recorder| {
        scale.bind(recorder, 1);
        recorder.draw(3, 1, 0);
    });
    assert_eq!(scale.values(&device), (0..64).collect::<Vec<u32>>(), "nothing of the above was executed");
    drop((scale, wider));
    finish(device);
}

#[test]
fn ranges_usages_and_limits_are_checked() {
    let device = device();
    let scale = Scale::new(&device, 64);
    let source = device
        .create_buffer(&BufferDesc {
            name: "source",
            size: 64,
            usage: BufferUsage::TRANSFER_SRC,
            location: MemoryLocation::Device,
        })
        .expect("memory");
    let before = scale.values(&device);
    mistake(&device, "`values`", |recorder| recorder.fill(&scale.buffer, 252, 8, 1));
    mistake(&device, "multiples of 4", |recorder| recorder.fill(&scale.buffer, 2, 4, 1));
    mistake(&device, "`source`: was not created for being filled", |recorder| {
        // The first mistake prevents all later commands.
        recorder.fill(&source, 0, 4, 1);
        recorder.fill(&scale.buffer, 0, 256, 1);
    });
    mistake(&device, "overlap", |recorder| recorder.copy(&scale.buffer, 0, &scale.buffer, 4, 8));
    mistake(&device, "indirect arguments", |recorder| {
        scale.bind(recorder, 1);
        recorder.dispatch_indirect(&source, 0);
    });
    let most = device.limits().max_workgroup_count[1];
    if let Some(too_many) = most.checked_add(1) {
        let error = mistake(&device, "`big`: the number of workgroups", |recorder| {
            recorder.begin_pass(Stage::Build, "big");
            scale.bind(recorder, 1);
            recorder.dispatch([1, too_many, 1]);
            recorder.end_pass();
        });
        assert!(matches!(error, GpuError::LimitExceeded { .. }));
    }
    mistake(&device, "12 bytes of push constants", |recorder| {
        recorder.bind_compute(&scale.pipeline);
        recorder.push_constants(&[0; 12]);
    });
    mistake(&device, "the pipeline has 1", |recorder| {
        recorder.bind_compute(&scale.pipeline);
        recorder.bind_sets(1, &[&scale.set]);
    });
    assert_eq!(scale.values(&device), before, "nothing of the above was executed");
    assert!(matches!(
        device.upload(&source, 0, &[1]),
        Err(GpuError::InvalidUse { name, .. }) if name == "source"
    ));
    drop((scale, source));
    finish(device);
}

#[test]
fn creation_names_what_is_wrong() {
    let device = device();
    let layout = device.create_set_layout("one", 1).expect("set layout");
    let buffer = storage(&device, "values", 64);
    let error = device.create_binding_set(&layout, "set", &[&buffer, &buffer]).expect_err("one binding");
    assert!(error.to_string().contains("2 buffers are given"), "{error}");
    // SAFETY: words whose header is not that of a module are refused.
    let refused = |words: Vec<u32>| unsafe { TrustedModule::new(words.into()) };
    let desc = ComputePipelineDesc {
        name: "broken",
        module: &refused(vec![1, 2, 3, 4, 5, 6]),
        sets: &[&layout],
        push_constant_bytes: 0,
        constants: &[],
    };
    let error = device.create_compute_pipeline(&desc).expect_err("no module");
    assert!(matches!(&error, GpuError::InvalidShader { name, .. } if name == "broken"), "{error}");
    let swapped = refused(shaders::SCALE.iter().map(|word| word.swap_bytes()).collect());
    let error = device.create_compute_pipeline(&ComputePipelineDesc { module: &swapped, ..desc });
    assert!(error.expect_err("reversed").to_string().contains("byte order"));
    let too_many = device.limits().max_push_constants + 4;
    let scale = module(shaders::SCALE);
    let desc = ComputePipelineDesc { module: &scale, push_constant_bytes: too_many, ..desc };
    assert!(matches!(device.create_compute_pipeline(&desc), Err(GpuError::LimitExceeded { .. })));
    let too_many = device.limits().max_storage_buffers_per_stage.saturating_add(1);
    assert!(matches!(device.create_set_layout("many", too_many), Err(GpuError::LimitExceeded { .. })));

    let other = crate::device::common::device();
    let error = other.create_binding_set(&layout, "set", &[&buffer]).expect_err("of another device");
    assert!(error.to_string().contains("another device"), "{error}");
    finish(other);
    drop((layout, buffer));
    finish(device);
}

#[test]
fn buffers_of_another_device_are_refused() {
    let (device, other) = (device(), device());
    let (ours, theirs) = (storage(&device, "ours", 64), storage(&other, "theirs", 64));
    let refused = |record: &dyn Fn(&mut Recorder<'_>)| {
        let error = mistake(&device, "`theirs`: belongs to another device", record);
        assert!(matches!(error, GpuError::InvalidUse { .. }));
    };
    refused(&|recorder| recorder.fill(&theirs, 0, 4, 1));
    refused(&|recorder| recorder.update(&theirs, 0, &[0; 4]));
    refused(&|recorder| recorder.copy(&theirs, 0, &ours, 0, 4));
    refused(&|recorder| recorder.copy(&ours, 0, &theirs, 0, 4));
    let range = [BufferRange { buffer: &theirs, offset: 0, size: 4 }];
    refused(&|recorder| recorder.acquire(&range, 1, Access::COMPUTE_READ));
    refused(&|recorder| recorder.release(&range, 1, Access::COMPUTE_WRITE));
    let scale = Scale::new(&device, 64);
    refused(&|recorder| {
        scale.bind(recorder, 1);
        recorder.dispatch_indirect(&theirs, 0);
    });
    drop((ours, theirs, scale));
    finish(other);
    finish(device);
}

#[test]
fn a_binding_beyond_the_range_of_the_device_is_refused_by_name() {
    let device = device();
    let limit = device.limits().max_storage_buffer_range;
    if limit < (1 << 30) {
        let buffer = storage(&device, "node pool", limit + 16);
        let layout = device.create_set_layout("pool", 1).expect("set layout");
        let error = device.create_binding_set(&layout, "pool", &[&buffer]).expect_err("too large");
        assert!(
            matches!(&error, GpuError::TooLarge { name, size, .. } if name == "node pool" && *size == limit + 16),
            "{error}"
        );
    }
    finish(device);
}

#[test]
fn memory_is_counted_and_limited() {
    let device = device();
    assert_eq!(device.allocated_bytes(), 0);
    let first = storage(&device, "first", 1 << 20);
    assert!(device.allocated_bytes() >= 1 << 20);
    device.set_memory_limit(Some(3 << 20));
    let desc = BufferDesc {
        name: "second",
        size: 4 << 20,
        usage: BufferUsage::STORAGE,
        location: MemoryLocation::Device,
    };
    let error = device.create_buffer(&desc).expect_err("over the limit");
    let GpuError::OutOfDeviceMemory { name, asked, limit, .. } = &error else { panic!("{error}") };
    assert_eq!((name.as_str(), *asked >= 4 << 20, *limit), ("second", true, 3 << 20));
    device.set_memory_limit(None);
    drop(device.create_buffer(&desc).expect("no limit any more"));
    drop(first);
    assert_eq!(device.allocated_bytes(), 0);
    assert!(device.peak_bytes() >= 5 << 20);
    device.reset_peak_bytes();
    assert_eq!(device.peak_bytes(), 0);

    let desc = BufferDesc { name: "endless", size: u64::MAX, ..desc };
    let error = device.create_buffer(&desc).expect_err("more than exists");
    assert!(matches!(&error, GpuError::OutOfDeviceMemory { name, .. } if name == "endless"), "{error}");
    let desc = BufferDesc { name: "useless", size: 16, usage: BufferUsage::default(), ..desc };
    assert!(matches!(device.create_buffer(&desc), Err(GpuError::InvalidUse { .. })));
    finish(device);
}

#[test]
fn a_timeout_names_the_pass_and_abandons_the_device() {
    // The device has no validation: an abandoned device is never destroyed, which the layer would report at
    // exit.
    let desc = DeviceDesc { requirements: crate::device::common::requirements(), ..DeviceDesc::default() };
    let device = Device::create(&desc).expect("a Vulkan device");
    let buffer = storage(&device, "values", 256);
    let layout = device.create_set_layout("slow", 1).expect("set layout");
    let set = device.create_binding_set(&layout, "slow", &[&buffer]).expect("binding set");
    let pipeline = device
        .create_compute_pipeline(&ComputePipelineDesc {
            name: "slow",
            module: &module(shaders::SLOW),
            sets: &[&layout],
            push_constant_bytes: 0,
            constants: &[],
        })
        .expect("pipeline");
    let options = SubmitOptions { timeout: Some(Duration::from_millis(1)), ..SubmitOptions::default() };
    let submitted = device.submit_with(&options, |recorder| {
        recorder.begin_pass(Stage::Build, "endless");
        recorder.bind_compute(&pipeline);
        recorder.bind_sets(0, &[&set]);
        recorder.dispatch([256, 64, 1]);
        recorder.end_pass();
    });
    let error = submitted.expect_err("a millisecond is too short");
    assert!(matches!(&error, GpuError::Timeout { pass, .. } if pass == "endless"), "{error}");
    let error = device.submit(|_| ()).expect_err("abandoned");
    assert!(matches!(error, GpuError::Abandoned { .. }), "{error}");
    drop((pipeline, set, buffer, layout, device));
    // The work ends by itself; without this pause the process might end while it still runs.
    std::thread::sleep(Duration::from_secs(2));
}
