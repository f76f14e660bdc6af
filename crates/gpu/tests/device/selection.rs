//! Selection of a device.

use crate::device::common::requirements;
use rasray_gpu::*;

#[test]
fn a_preference_that_matches_nothing_lists_the_devices() {
    let devices = Device::list(&requirements()).expect("a Vulkan driver");
    let first = devices.first().expect("a Vulkan device");
    let desc = DeviceDesc { preference: Some("no such device".to_owned()), ..DeviceDesc::default() };
    let error = Device::create(&desc).expect_err("no device has that name");
    assert!(matches!(error, GpuError::NoMatchingDevice { .. }));
    let text = error.to_string();
    assert!(text.contains("no such device") && text.contains(&first.name), "{text}");
}

#[test]
fn a_preference_by_index_or_name_is_followed() {
    let devices = Device::list(&requirements()).expect("a Vulkan driver");
    for summary in devices.iter().filter(|summary| summary.is_suitable()) {
        for preference in [summary.index.to_string(), summary.name.to_uppercase()] {
            let desc = DeviceDesc {
                requirements: requirements(),
                preference: Some(preference.clone()),
                ..DeviceDesc::default()
            };
            let device = Device::create(&desc).expect("a suitable device");
            assert_eq!(device.name(), summary.name);
            assert!(device.why_chosen().contains(&preference), "{}", device.why_chosen());
            assert_eq!(device.driver(), summary.driver);
            assert_eq!(device.is_software(), summary.kind == DeviceKind::Software);
        }
    }
}

#[test]
fn only_what_was_asked_for_is_enabled() {
    let device = crate::device::common::device();
    assert_eq!(device.enabled().len(), requirements().required.len());
    assert!(!device.has(Feature::BufferDeviceAddress));
    crate::device::common::finish(device);

    let wanted = Requirements {
        optional: Feature::ALL.iter().map(|feature| (*feature, "to see that it can be enabled")).collect(),
        ..Requirements::default()
    };
    let devices = Device::list(&wanted).expect("a Vulkan driver");
    let device = crate::device::common::device_with(requirements().merge(&wanted));
    let summary = devices.iter().find(|summary| summary.name == device.name()).expect("listed before");
    assert_eq!(device.enabled(), summary.features);
    assert_eq!(summary.missing_optional.len() + summary.features.len(), Feature::ALL.len());
    let buffer = crate::device::common::storage(&device, "values", 64);
    assert_eq!(buffer.address().is_some(), device.has(Feature::BufferDeviceAddress));
    drop(buffer);
    crate::device::common::finish(device);
}

#[test]
fn validation_reports_a_real_mistake() {
    let device = crate::device::common::device();
    let buffer = device
        .create_buffer(&BufferDesc {
            name: "never filled",
            size: 64,
            usage: BufferUsage::STORAGE,
            location: MemoryLocation::Device,
        })
        .expect("memory");
    device
        .submit(|recorder| {
            // SAFETY: filling a buffer that was not made for fills is a mistake without consequences on the
            // tested drivers; the test checks that the validation layer reports it.
            unsafe { recorder.device().raw().cmd_fill_buffer(recorder.raw(), buffer.raw(), 0, 64, 1) };
        })
        .expect("submission");
    let messages = device.validation_messages();
    assert!(messages.iter().any(|message| message.contains("never filled")), "{messages:?}");
}
