//! Dispatches, transfers and timings on a device that this crate made.

use crate::device::common::{Scale, bytes_of, device, finish, module, storage};
use rasray_gpu::*;

#[test]
fn a_dispatch_gives_the_same_values_under_every_timing() {
    let device = device();
    for timing in [Timing::None, Timing::Device, Timing::Host] {
        let scale = Scale::new(&device, 1000);
        let submitted = device
            .submit_passes(timing, |recorder| {
                // State is bound before the passes: it must survive the split into submissions.
                scale.bind(recorder, 3);
                recorder.begin_pass(Stage::Build, "first");
                scale.dispatch(recorder);
                recorder.end_pass();
                recorder.barrier(Access::COMPUTE_WRITE, Access::COMPUTE);
                recorder.begin_pass(Stage::Shade, "second");
                scale.dispatch(recorder);
                recorder.end_pass();
                recorder.device().name().len()
            })
            .expect("submission");
        let expected: Vec<u32> = (0..1000).map(|i| (i * 3 + Scale::BIAS) * 3 + Scale::BIAS).collect();
        assert_eq!(scale.values(&device), expected, "{timing:?}");
        assert_eq!(submitted.value, device.name().len());
        let labels: Vec<_> = submitted.passes.iter().map(|pass| (pass.stage, pass.label.as_str())).collect();
        let kind = match timing {
            Timing::None => {
                assert!(labels.is_empty());
                continue;
            }
            Timing::Device => TimerKind::Device,
            Timing::Host => TimerKind::Host,
        };
        assert_eq!(labels, [(Stage::Build, "first"), (Stage::Shade, "second")]);
        for pass in &submitted.passes {
            assert_eq!(pass.timer, kind);
            assert!(pass.milliseconds >= 0.0 && pass.milliseconds < 60_000.0, "{pass:?}");
        }
        if timing == Timing::Host {
            assert!(submitted.passes.iter().all(|pass| pass.milliseconds > 0.0));
        }
    }
    finish(device);
}

#[test]
fn a_recorder_says_what_each_pass_is_made_of() {
    let device = device();
    let scale = Scale::new(&device, 256);
    let arguments = storage(&device, "arguments", 16);
    device.upload_slice(&arguments, 0, &[2_u32, 1, 1, 0]).expect("upload");
    let submitted = device
        .submit(|recorder| {
            recorder.fill(&arguments, 12, 4, 7);
            scale.bind(recorder, 1);
            recorder.begin_pass(Stage::Build, "one");
            recorder.dispatch([2, 1, 1]);
            recorder.dispatch([1, 1, 1]);
            recorder.end_pass();
            recorder.dispatch([1, 1, 1]);
            recorder.begin_pass(Stage::Film, "two");
            recorder.fill(&arguments, 12, 4, 7);
            recorder.dispatch_indirect(&arguments, 0);
            recorder.end_pass();
            recorder.passes().to_vec()
        })
        .expect("submission");
    let pass = PassCommands::of;
    let expected = [
        PassCommands { dispatches: 2, workgroups: 3, ..pass(Stage::Build, "one") },
        PassCommands { indirect: 1, transfers: 1, ..pass(Stage::Film, "two") },
    ];
    assert_eq!(submitted.value, expected);
    drop((scale, arguments));
    finish(device);
}

/// A set has the bindings that a pipeline uses, in whichever order both were made, and those that other
/// pipelines use.
#[test]
fn a_pipeline_has_the_bindings_that_its_shader_uses() {
    let device = device();
    let scale = Scale::new(&device, 64);
    let other = storage(&device, "other", 256);
    let layout = device.create_set_layout("three", 3).expect("set layout");
    let set = |name| {
        device.create_binding_set(&layout, name, &[&scale.buffer, &other, &other]).expect("binding set")
    };
    let before = set("before");
    // The pipeline does not use sets 1 to 3 at all.
    let desc = ComputePipelineDesc {
        name: "scale of three",
        module: &module(crate::device::common::shaders::SCALE),
        sets: &[&layout; 4],
        push_constant_bytes: 8,
        constants: &[],
    };
    let pipeline = device.create_compute_pipeline(&desc).expect("pipeline");
    let after = set("after");
    for set in [&before, &after] {
        device
            .submit(|recorder| {
                recorder.bind_compute(&pipeline);
                recorder.bind_sets(0, &[set, set]);
                recorder.push_constants(bytes_of(&[64, 2]));
                scale.dispatch(recorder);
            })
            .expect("submission");
    }
    let expected: Vec<u32> = scale.values(&device);
    assert!(expected.windows(2).all(|pair| pair[1] == pair[0] + 4), "{expected:?}");
    let none = device.create_set_layout("none", 0).expect("set layout");
    let error = device.create_compute_pipeline(&ComputePipelineDesc { sets: &[&none], ..desc });
    let error = error.expect_err("a binding that the layout lacks").to_string();
    assert!(error.contains("binding 0 of set 0, whose layout has 0"), "{error}");
    drop((scale, other, layout, before, after, pipeline, none));
    finish(device);
}

/// Makes the pipeline of [`crate::device::common::shaders::SCALE`] with a bias.
fn pipeline(device: &Device, name: &str, bias: u32) -> ComputePipeline {
    let layout = device.create_set_layout(name, 1).expect("set layout");
    let desc = ComputePipelineDesc {
        name,
        module: &module(crate::device::common::shaders::SCALE),
        sets: &[&layout],
        push_constant_bytes: 8,
        constants: &[(7, bias)],
    };
    device.create_compute_pipeline(&desc).expect("pipeline")
}

#[test]
fn what_is_made_alike_is_one_pipeline_and_keeps_its_names() {
    let device = device();
    let (first, same, other) =
        (pipeline(&device, "first", 1), pipeline(&device, "same", 1), pipeline(&device, "other", 2));
    assert_eq!(first.raw(), same.raw());
    assert_ne!(first.raw(), other.raw());
    assert_eq!((first.name(), same.name()), ("first", "same"));
    // The pipeline outlives the handle and the set layout that it was made with.
    drop(first);
    let mut scale = Scale::new(&device, 64);
    scale.pipeline = same;
    device
        .submit(|recorder| {
            scale.bind(recorder, 2);
            scale.dispatch(recorder);
        })
        .expect("submission");
    assert_eq!(scale.values(&device), (0..64).map(|i| 2 * i + 1).collect::<Vec<_>>());
    drop((scale, other));
    finish(device);
}

#[cfg(feature = "fault-injection")]
#[test]
fn as_many_idle_pipelines_are_kept_as_was_asked_for_the_last_used_ones() {
    use rasray_gpu::faults::{calls_of, live_objects};
    let device = device();
    let live =
        || live_objects().into_iter().find(|(kind, _)| *kind == "Pipeline").map_or(0, |(_, count)| count);
    let before = live();
    let compiles = |bias| {
        let (_, calls) = calls_of(|| drop(pipeline(&device, "kept", bias)));
        calls.contains(&"vkCreateComputePipelines")
    };
    // No pipeline is kept by default.
    assert!(compiles(1) && compiles(1));
    assert_eq!(live(), before);
    device.keep_pipelines(2);
    assert!(compiles(1) && compiles(2) && !compiles(1) && compiles(3));
    // The third pipeline replaced the second one, which had been unused for longest.
    assert!(!compiles(1) && !compiles(3) && compiles(2));
    assert_eq!(live(), before + 2);
    // Pipelines in use do not count.
    let used = pipeline(&device, "used", 2);
    assert!(compiles(4) && !compiles(3));
    assert_eq!(live(), before + 3);
    device.keep_pipelines(0);
    assert_eq!(live(), before + 1);
    drop(used);
    assert_eq!(live(), before);
    finish(device);
}

#[test]
fn specialisation_defaults_hold_where_nothing_is_given() {
    let device = device();
    let mut scale = Scale::new(&device, 64);
    scale.pipeline = device
        .create_compute_pipeline(&ComputePipelineDesc {
            name: "scale without bias",
            module: &module(crate::device::common::shaders::SCALE),
            sets: &[&scale.layout],
            push_constant_bytes: 8,
            constants: &[],
        })
        .expect("pipeline");
    device
        .submit(|recorder| {
            scale.bind(recorder, 2);
            scale.dispatch(recorder);
        })
        .expect("submission");
    assert_eq!(scale.values(&device), (0..64).map(|i| 2 * i).collect::<Vec<u32>>());
    drop(scale);
    finish(device);
}

#[test]
fn an_indirect_dispatch_reads_its_size_from_a_buffer() {
    let device = device();
    let scale = Scale::new(&device, 256);
    let arguments = storage(&device, "arguments", 16);
    device.upload_slice(&arguments, 4, &[2_u32, 1, 1]).expect("upload");
    device
        .submit(|recorder| {
            scale.bind(recorder, 0);
            recorder.dispatch_indirect(&arguments, 4);
        })
        .expect("submission");
    let values = scale.values(&device);
    assert!(values[..128].iter().all(|&value| value == Scale::BIAS));
    assert_eq!(values[128..], (128..256).collect::<Vec<u32>>());
    drop((scale, arguments));
    finish(device);
}

#[test]
fn fills_and_copies_touch_exactly_their_ranges() {
    let device = device();
    let first = storage(&device, "first", 64);
    let second = storage(&device, "second", 64);
    device
        .submit(|recorder| {
            recorder.fill(&first, 0, 64, 1);
            recorder.fill(&second, 0, 64, 2);
            recorder.barrier(Access::TRANSFER_WRITE, Access::TRANSFER);
            recorder.copy(&first, 0, &second, 8, 16);
            recorder.fill(&first, 60, 4, 9);
            recorder.fill(&first, 0, 0, 9);
        })
        .expect("submission");
    let words = |buffer: &Buffer| device.download_as::<u32>(buffer, 0, 16).expect("download");
    assert_eq!(words(&first), [1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 9]);
    assert_eq!(words(&second), [2, 2, 1, 1, 1, 1, 2, 2, 2, 2, 2, 2, 2, 2, 2, 2]);
    drop((first, second));
    finish(device);
}

#[test]
fn transfers_larger_than_the_staging_buffer_arrive_whole() {
    let device = device();
    let size = (16 << 20) + 4_097;
    let buffer = storage(&device, "large", size + 3);
    let bytes: Vec<u8> = (0..size).map(|i| (i.wrapping_mul(2_654_435_761) >> 13) as u8).collect();
    device.upload(&buffer, 3, &bytes).expect("upload");
    assert!(device.download(&buffer, 3, size).expect("download") == bytes);
    drop(buffer);
    finish(device);
}

#[test]
fn host_visible_buffers_are_written_and_read_in_place() {
    let device = device();
    let upload = BufferDesc {
        name: "upload",
        size: 16,
        usage: BufferUsage::TRANSFER_SRC,
        location: MemoryLocation::Upload,
    };
    let readback = BufferDesc {
        name: "readback",
        size: 0,
        usage: BufferUsage::TRANSFER_DST,
        location: MemoryLocation::Readback,
    };
    let (upload, readback) =
        (device.create_buffer(&upload).expect("memory"), device.create_buffer(&readback).expect("memory"));
    assert_eq!(readback.size(), 16, "size 0 becomes 16");
    upload.write(4, bytes_of(&[7, 8])).expect("within range");
    device.submit(|recorder| recorder.copy(&upload, 4, &readback, 8, 8)).expect("submission");
    assert_eq!(readback.read(8, 8).expect("within range"), bytes_of(&[7, 8]));
    assert!(matches!(upload.write(13, &[0; 4]), Err(GpuError::OutOfRange { offset: 13, size: 4, .. })));
    assert!(matches!(readback.read(u64::MAX, 2), Err(GpuError::OutOfRange { .. })));
    drop((upload, readback));
    finish(device);
}

#[test]
fn parts_of_a_buffer_can_be_bound() {
    let device = device();
    let mut scale = Scale::new(&device, 256);
    let offset = device.limits().min_storage_buffer_offset_alignment.max(64);
    assert!(offset <= 512, "the test reckons with a small alignment");
    let range = BufferRange { buffer: &scale.buffer, offset, size: 64 };
    scale.set = device.create_binding_set_of_ranges(&scale.layout, "part", &[range]).expect("binding set");
    device
        .submit(|recorder| {
            scale.bind(recorder, 0);
            recorder.push_constants(bytes_of(&[16, 0]));
            recorder.dispatch([1, 1, 1]);
        })
        .expect("submission");
    let first = offset as usize / 4;
    for (index, value) in scale.values(&device).into_iter().enumerate() {
        let expected = if (first..first + 16).contains(&index) { Scale::BIAS } else { index as u32 };
        assert_eq!(value, expected, "at {index}");
    }
    drop(scale);
    finish(device);
}

#[test]
fn threads_may_submit_to_one_device() {
    let device = device();
    std::thread::scope(|scope| {
        for factor in 1..=4 {
            let device = device.clone();
            scope.spawn(move || {
                let scale = Scale::new(&device, 128);
                device
                    .submit(|recorder| {
                        scale.bind(recorder, factor);
                        scale.dispatch(recorder);
                    })
                    .expect("submission");
                let expected: Vec<u32> = (0..128).map(|i| i * factor + Scale::BIAS).collect();
                assert_eq!(scale.values(&device), expected);
            });
        }
    });
    finish(device);
}

#[test]
fn what_a_submission_uses_may_be_dropped_while_it_is_recorded() {
    let device = device();
    let scale = Scale::new(&device, 64);
    let result = storage(&device, "result", 256);
    device
        .submit(move |recorder| {
            scale.bind(recorder, 2);
            scale.dispatch(recorder);
            recorder.barrier(Access::COMPUTE_WRITE, Access::TRANSFER_READ);
            recorder.copy(&scale.buffer, 0, &result, 0, 256);
            drop((scale, result));
        })
        .expect("submission");
    finish(device);
}
