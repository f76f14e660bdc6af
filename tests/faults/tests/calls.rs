//! Every call of Vulkan that can fail does fail, one at a time.

use std::collections::{BTreeMap, BTreeSet};
use std::time::Duration;

use rasray_faults::{Failure, device, finish, picture, spec, specs, stage};
use rasray_gpu::faults::{At, Injected, With, calls_of, inject, live_objects};
use rasray_gpu::{BufferDesc, BufferUsage, Device, GpuError, MemoryLocation, vk};
use rasray_tests::tier::Counts;

/// More calls than a render has: every one.
const ALL: usize = 100_000;

/// Systems whose renders are failed, the smallest and one built by the rasterizer, with the number of calls
/// that are spread over a render.
const SYSTEMS: [(&str, Counts<usize>); 2] = [
    ("brute-force", Counts { quick: 25, software: ALL, full: ALL }),
    ("mmrt", Counts { quick: 8, software: 100, full: ALL }),
];

/// After so many failed calls it is looked whether the next render gives the same picture; in the full tier
/// after each, as always for what is left behind.
const LOOK: Counts<usize> = Counts { quick: 6, software: 1, full: 1 };

/// State that must be as before after a failure.
#[derive(Debug, PartialEq)]
struct Inventory {
    objects: Vec<(&'static str, i64)>,
    bytes: u64,
    bytes_given_out: Option<u64>,
}

/// Memory blocks stay with the pool for the next allocation; what was given out of them is in the bytes.
fn inventory(device: &Device) -> Inventory {
    let objects = live_objects().into_iter().filter(|(kind, _)| *kind != "DeviceMemory").collect();
    Inventory { objects, bytes: device.allocated_bytes(), bytes_given_out: device.bytes_given_out() }
}

/// Names for debuggers are optional: nothing depends on whether they could be stored.
fn is_courtesy(call: &str) -> bool {
    call == "vkSetDebugUtilsObjectNameEXT"
}

/// Asserts that an error names the call, and says what it was for.
fn check_message(injected: Injected, error: &GpuError) {
    let text = error.to_string();
    assert!(text.contains(injected.call), "{injected:?}: `{text}` does not name the call");
    let purpose = text.split('`').nth(1).unwrap_or_default();
    assert!(!purpose.is_empty(), "{injected:?}: `{text}` does not say what the call was for");
    let typed = match injected.result {
        vk::Result::ERROR_DEVICE_LOST => matches!(error, GpuError::DeviceLost { .. }),
        vk::Result::ERROR_OUT_OF_HOST_MEMORY => matches!(error, GpuError::OutOfHostMemory { .. }),
        vk::Result::ERROR_OUT_OF_DEVICE_MEMORY => {
            matches!(error, GpuError::DeviceMemoryExhausted { .. } | GpuError::OutOfDeviceMemory { .. })
        }
        code => matches!(error, GpuError::Vulkan { result, .. } if *result == code),
    };
    assert!(typed, "{injected:?} became {error:?}");
}

/// Indices of the calls to fail: `count` spread over the run, or all of them. The functions differ as much as
/// they can: of each section of the run, the first call of the function that was chosen least so far.
fn chosen(calls: &[&'static str], count: usize) -> Vec<usize> {
    let mut times: BTreeMap<&str, usize> = BTreeMap::new();
    let length = calls.len().div_ceil(count);
    (0..calls.len())
        .step_by(length)
        .map(|begin| {
            let end = (begin + length).min(calls.len());
            let rarest = |index: &usize| times.get(calls[*index]).copied().unwrap_or(0);
            let index = (begin..end).min_by_key(rarest).unwrap_or(begin);
            *times.entry(calls[index]).or_default() += 1;
            index
        })
        .collect()
}

#[test]
fn each_failing_call_of_a_render_is_one_typed_error_and_leaves_nothing_behind() {
    let device = device().expect("a device");
    let look = LOOK.on(&device, "failed calls between looks at the next render");
    for (system, counts) in SYSTEMS {
        let count = counts.on(&device, &format!("failing calls of a render through {system}, at most"));
        let spec = spec(system, "robust").expect("registered");
        // The first picture fills the pools of memory and the caches of the driver.
        let expected = picture(&device, &spec).expect("a picture");
        assert!(expected.iter().flatten().any(|bits| *bits != 0), "the picture is black");
        let before = inventory(&device);
        let started = std::time::Instant::now();
        let (again, calls) = calls_of(|| picture(&device, &spec));
        let seconds = started.elapsed().as_secs_f64();
        assert_eq!(again.expect("a picture"), expected, "{system}: pictures differ from run to run");
        assert_eq!(inventory(&device), before, "{system}: an undisturbed render leaves something behind");
        let indices = chosen(&calls, count);
        let (mut errors, mut survived) = (0, 0);
        for (number, index) in indices.iter().enumerate() {
            let (result, injected) = inject(At::Call(*index), With::Code(*index), || picture(&device, &spec));
            let injected = injected.expect("the call is made in every run");
            assert_eq!(injected.call, calls[*index], "runs make the same calls");
            match result {
                Ok(made) => {
                    let survives = is_courtesy(injected.call) || injected.call == "vkAllocateMemory";
                    assert!(survives, "{injected:?} at {index} was not noticed");
                    assert_eq!(made, expected, "{injected:?} at {index}");
                    survived += 1;
                }
                Err(error) => {
                    let error = error.gpu().unwrap_or_else(|| panic!("{injected:?} became {error}"));
                    check_message(injected, error);
                    errors += 1;
                }
            }
            assert_eq!(inventory(&device), before, "{injected:?} at {index} leaves something behind");
            if number % look == 0 || number + 1 == indices.len() {
                assert_eq!(picture(&device, &spec).expect("the next run"), expected, "after {injected:?}");
            }
        }
        let functions: BTreeSet<_> = indices.iter().map(|index| calls[*index]).collect();
        let all: BTreeSet<_> = calls.iter().collect();
        assert!(functions.len() >= count.min(all.len() - 2), "{system}: {functions:?} of {all:?}");
        println!(
            "{system}: {} calls in {seconds:.2} s; {} failed: {errors} errors, {survived} survived",
            calls.len(),
            indices.len()
        );
    }
    assert_eq!(finish(device), Vec::<String>::new());
}

#[test]
fn each_failing_call_of_making_a_device_is_one_typed_error_and_leaves_nothing_behind() {
    let (made, calls) = calls_of(|| device().map(finish));
    assert_eq!(made.expect("a device"), Vec::<String>::new());
    assert!(live_objects().is_empty(), "{:?}", live_objects());
    for (index, call) in calls.iter().enumerate() {
        let (result, injected) = inject(At::Call(index), With::Code(index), device);
        let injected = injected.expect("the call is made in every run");
        assert_eq!(injected.call, *call);
        let error = result.expect_err("every call is needed");
        check_message(injected, &error);
        assert!(live_objects().is_empty(), "{injected:?}: {:?}", live_objects());
    }
    println!("{} calls make a device", calls.len());
    // Answers that have a meaning of their own.
    let meaning = [
        ("vkCreateInstance", vk::Result::ERROR_INCOMPATIBLE_DRIVER, "mesa-vulkan-drivers"),
        ("vkCreateInstance", vk::Result::ERROR_LAYER_NOT_PRESENT, "vulkan-validationlayers"),
    ];
    for (call, result, text) in meaning {
        let (made, _) = inject(At::Named(call, 0), With::Result(result), device);
        let error = made.expect_err("it fails").to_string();
        assert!(error.contains(text), "{error}");
    }
    assert_eq!(finish(device().expect("a device")), Vec::<String>::new());
}

/// The wait ended early, the work did not: the device must not be given up, and nothing may be destroyed too
/// soon.
#[test]
fn a_wait_that_fails_is_made_again() {
    let device = device().expect("a device");
    let spec = spec("brute-force", "robust").expect("registered");
    let expected = picture(&device, &spec).expect("a picture");
    for result in [vk::Result::ERROR_OUT_OF_HOST_MEMORY, vk::Result::ERROR_OUT_OF_DEVICE_MEMORY] {
        let (failed, injected) =
            inject(At::Named("vkWaitForFences", 3), With::Result(result), || picture(&device, &spec));
        let failed: Failure = failed.expect_err("the wait failed");
        check_message(injected.expect("a render waits"), failed.gpu().expect("of Vulkan"));
        assert_eq!(picture(&device, &spec).expect("the device is not given up"), expected);
    }
    assert_eq!(finish(device), Vec::<String>::new());
}

/// Whatever is waited for, the wait has an end, and the error says what was waited for.
#[test]
fn a_timeout_of_any_wait_names_the_pass_and_gives_the_device_up() {
    // Not under validation: a device that is given up is never destroyed, which the layer would report at
    // exit.
    let desc = rasray_gpu::DeviceDesc { requirements: rasray_faults::requirements(), ..Default::default() };
    let spec = spec("brute-force", "robust").expect("registered");
    let device = Device::create(&desc).expect("a device");
    let (_, calls) = calls_of(|| picture(&device, &spec));
    let waits = calls.iter().filter(|call| **call == "vkWaitForFences").count();
    assert!(waits > 4, "{waits} waits");
    for wait in [0, waits / 2, waits - 1] {
        let device = Device::create(&desc).expect("a device");
        let timeout = With::Result(vk::Result::TIMEOUT);
        let (result, _) = inject(At::Named("vkWaitForFences", wait), timeout, || picture(&device, &spec));
        let error = result.expect_err("the wait ended");
        let Some(GpuError::Timeout { pass, seconds }) = error.gpu() else { panic!("{error}") };
        assert!(!pass.is_empty(), "{error}");
        assert_eq!(*seconds, device.timeout().as_secs_f64(), "{error}");
        assert!(device.timeout() <= Duration::from_secs(600), "no wait takes longer than that");
        let after = picture(&device, &spec).expect_err("the device was given up");
        assert!(matches!(after.gpu(), Some(GpuError::Abandoned { .. })), "{after}");
    }
}

/// The checks above would notice a leak: of a buffer of this project, and of an object that only validation
/// knows of.
#[test]
fn a_leak_is_noticed() {
    let device = device().expect("a device");
    let before = inventory(&device);
    let desc = BufferDesc {
        name: "leaked",
        size: 64,
        usage: BufferUsage::STORAGE,
        location: MemoryLocation::Device,
    };
    let buffer = device.create_buffer(&desc).expect("memory");
    let with = inventory(&device);
    assert_ne!(with.objects, before.objects);
    assert_ne!(with.bytes, before.bytes);
    assert_ne!(with.bytes_given_out, before.bytes_given_out);
    drop(buffer);
    assert_eq!(inventory(&device), before);
    let info = vk::BufferCreateInfo::default().size(64).usage(vk::BufferUsageFlags::STORAGE_BUFFER);
    // SAFETY: a buffer without conditions; that it is never destroyed is the point.
    unsafe { device.raw().create_buffer(&info, None) }.expect("a buffer");
    assert_ne!(inventory(&device).objects, before.objects);
    let messages = finish(device);
    assert!(messages.iter().any(|message| message.contains("not been destroyed")), "{messages:?}");
}

/// Structures are made and grow between frames of a host, whose queue may be in use. A tree that the host
/// builds reads back triangles where a build is prepared, and not here.
#[test]
fn structures_are_made_and_grow_without_a_submission() {
    let device = device().expect("a device");
    let scene = stage(&device).expect("a scene");
    for spec in specs().expect("all are registered") {
        let ((), calls) = calls_of(|| {
            let binding = Some(scene.binding());
            let mut structure =
                spec.create(&device, scene.geometry(), binding).expect("the options are valid");
            let mut sizes = structure.sizes().clone();
            sizes.pools.iter_mut().skip(1).for_each(|pool| pool.elements *= 2);
            structure.resize(&device, &sizes).expect("it fits");
            structure.set_geometry(&device, scene.geometry()).expect("it is the same");
        });
        assert!(calls.len() > 4, "{}: {calls:?}", spec.system().name);
        let submits = |call: &&&str| call.contains("Submit") || call.contains("Wait");
        assert_eq!(calls.iter().find(submits), None, "{}", spec.system().name);
    }
    drop(scene);
    assert_eq!(finish(device), Vec::<String>::new());
}
