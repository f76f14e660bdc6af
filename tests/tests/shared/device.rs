//! The device floor: missing features are named, features that were not requested are not enabled, and
//! structures run with exactly what they require.

use std::collections::BTreeSet;

use rasray_abuffer::{ABuffer, Addressing, Config};
use rasray_ads::{BruteForce, Draw, Geometry, GeometryDesc, Ray, Structure, TraceMode};
use rasray_gpu::{BufferUsage, Device, DeviceDesc, Feature, GpuError, Requirements, Timing};
use rasray_tests::shapes::sphere;
use rasray_tracer::{BatchTracer, build_until_complete};

fn create(requirements: &Requirements) -> Result<Device, GpuError> {
    Device::create(&DeviceDesc {
        requirements: requirements.clone(),
        validation: true,
        ..DeviceDesc::default()
    })
}

/// The floor and one more.
fn floor_and(feature: Feature) -> Requirements {
    let required = Requirements { required: vec![feature], ..Requirements::default() };
    Requirements::floor().merge(&required)
}

#[test]
fn the_floor_is_enough_and_nothing_else_is_enabled() {
    let device = create(&Requirements::floor()).expect("tests need a Vulkan device and the validation layer");
    let floor: BTreeSet<Feature> = Requirements::floor().required.into_iter().collect();
    for feature in Feature::ALL {
        assert_eq!(device.has(feature), floor.contains(&feature), "{feature}");
    }
    assert_eq!(device.enabled().into_iter().collect::<BTreeSet<_>>(), floor);
    // Addresses exist only where they were requested.
    let buffer = device.create_buffer_with("values", BufferUsage::STORAGE, &[0_u8; 64]).expect("memory");
    assert_eq!(buffer.address(), None);
    assert_eq!(device.validation_messages(), Vec::<String>::new());
}

#[test]
fn a_device_without_a_required_feature_is_refused_by_name() {
    let mut refused = 0;
    for feature in Feature::ALL {
        let requirements = floor_and(feature);
        let devices = Device::list(&requirements).expect("a Vulkan driver");
        match create(&requirements) {
            Ok(device) => {
                let expected: BTreeSet<Feature> = requirements.required.iter().copied().collect();
                assert_eq!(device.enabled().into_iter().collect::<BTreeSet<_>>(), expected, "{feature}");
                assert!(devices.iter().any(|summary| summary.is_suitable()), "{feature}");
            }
            Err(error) => {
                refused += 1;
                assert!(matches!(error, GpuError::NoSuitableDevice { .. }), "{feature}: {error}");
                let text = error.to_string();
                assert!(text.contains(feature.name()), "{feature} is not named: {text}");
                for summary in devices.iter().filter(|summary| summary.usable) {
                    assert_eq!(summary.missing, [feature], "{}", summary.name);
                    assert!(text.contains(&summary.name), "{} is not named: {text}", summary.name);
                }
            }
        }
    }
    println!("{refused} of {} features are missing on every device here", Feature::ALL.len());
}

#[test]
fn a_missing_optional_feature_is_no_reason_to_refuse() {
    let wanted = Requirements {
        optional: Feature::ALL.iter().map(|&feature| (feature, "to see what there is")).collect(),
        ..Requirements::default()
    };
    let device = create(&Requirements::floor().merge(&wanted)).expect("optional features are optional");
    assert!(Requirements::floor().required.iter().all(|&feature| device.has(feature)));
    assert_eq!(device.validation_messages(), Vec::<String>::new());
}

/// The triangles of a sphere on a device with no features beyond those it was made with.
fn geometry(device: &Device) -> Geometry {
    let positions: Vec<[f32; 3]> = sphere([0.0; 3], 2.0, 8).concat();
    let count = positions.len() as u32 / 3;
    let indices: Vec<u32> = (0..positions.len() as u32).collect();
    let draws = [Draw { first_triangle: 0, triangle_count: count, ..Draw::default() }];
    let buffer = |name, bytes: &[u8]| {
        device.create_buffer_with(name, BufferUsage::STORAGE, bytes).expect("geometry fits")
    };
    let desc = GeometryDesc {
        positions: buffer("positions", bytemuck::cast_slice(&positions)).into(),
        indices: buffer("indices", bytemuck::cast_slice(&indices)).into(),
        draws: buffer("draws", bytemuck::cast_slice(&draws)).into(),
        vertex_count: positions.len() as u32,
        triangle_count: count,
        count: None,
        draw_count: 1,
        bounds: [[-2.0; 3], [2.0; 3]],
        frame_origin: [0.0; 3],
    };
    Geometry::new(device, desc).expect("geometry fits")
}

/// Builds and traces; all rays from the inside of the sphere hit it.
fn runs(device: &Device, structure: &mut dyn Structure) {
    build_until_complete(device, structure, [0.1, 0.2, 0.3], Timing::None).expect("the build completes");
    let rays: Vec<Ray> = (0..64)
        .map(|i| {
            let turn = i as f32 * 0.7;
            Ray::new([0.1, 0.2, 0.3], [turn.cos(), 0.3 * (3.0 * turn).sin(), turn.sin()])
        })
        .collect();
    let tracer = BatchTracer::new(device, 64).expect("a queue fits");
    for mode in [TraceMode::Closest, TraceMode::Occluded] {
        let hits = tracer.trace(structure, &rays, mode, Timing::None).expect("all rays finish").hits;
        let missed = hits.iter().filter(|hit| !hit.is_hit()).count();
        assert!(missed <= 2, "{}: {missed} rays leave a closed sphere", structure.description().name);
    }
}

/// A device with what the structure requires, and a check that this is all it has.
fn exact_device(requirements: &Requirements) -> Device {
    let device = create(requirements).expect("a device with what the structure requires");
    let allowed: BTreeSet<Feature> = requirements
        .required
        .iter()
        .copied()
        .chain(requirements.optional.iter().map(|(feature, _)| *feature))
        .collect();
    assert!(device.enabled().iter().all(|feature| allowed.contains(feature)), "{:?}", device.enabled());
    device
}

#[test]
fn brute_force_runs_on_what_it_requires() {
    let device = exact_device(&BruteForce::requirements_of());
    let mut structure = BruteForce::new(&device, &geometry(&device), None, false).expect("that is enough");
    assert_eq!(structure.description().requirements, BruteForce::requirements_of());
    runs(&device, &mut structure);
    drop(structure);
    assert_eq!(device.validation_messages(), Vec::<String>::new());
}

#[test]
fn the_abuffer_runs_with_exactly_what_it_requires() {
    for addressing in [Addressing::Descriptor, Addressing::Address] {
        let config = Config { addressing, ..Config::at_centres(32) };
        let requirements = ABuffer::requirements_of(&config);
        let device = exact_device(&requirements);
        let mut structure =
            ABuffer::new(&device, config, &geometry(&device), None).expect("its requirements are enough");
        assert_eq!(structure.description().requirements, requirements);
        runs(&device, &mut structure);
        drop(structure);
        assert_eq!(device.validation_messages(), Vec::<String>::new(), "{addressing:?}");
    }
}

#[test]
fn the_abuffer_says_which_feature_an_option_lacks() {
    let config = Config { addressing: Addressing::Address, ..Config::at_centres(32) };
    let device = exact_device(&ABuffer::requirements_of(&Config::at_centres(32)));
    let error =
        ABuffer::new(&device, config, &geometry(&device), None).expect_err("addresses are not enabled");
    assert!(error.to_string().contains("bufferDeviceAddress"), "{error}");
    assert_eq!(device.validation_messages(), Vec::<String>::new());
}

/// That validation is silent means something: it speaks where a feature is used that was not enabled.
#[test]
fn using_what_was_not_requested_is_noticed() {
    let device = exact_device(&Requirements::floor());
    let result = ABuffer::new(&device, Config::at_centres(32), &geometry(&device), None);
    let messages = device.validation_messages();
    let text = messages.join("\n");
    match result {
        Err(error) => assert!(error.to_string().contains("fragmentStoresAndAtomics"), "{error}"),
        Ok(_) => assert!(text.contains("fragmentStoresAndAtomics"), "nobody noticed: {text}"),
    }
}
