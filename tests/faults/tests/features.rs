//! Devices that lack a feature or have small limits: the same hits, or an error that names what is missing.

use rasray_faults::{
    Failure, device, device_with, finish, hits, picture_of, requirements, spec, specs, stage_of,
    textured_room,
};
use rasray_gpu::faults::{with_limits, without};
use rasray_gpu::{Device, Feature, GpuError, Limits, Requirements, Timing};
use rasray_gpu_scene::{GpuSceneError, Parts, TexelDemand, TexelRuns, View};
use rasray_integrators::{AovPass, Film, Integrator, IntegratorDesc, Raycast, Wave};
use rasray_scene::{Scene, builtin};
use rasray_systems::{Preset, Spec};
use rasray_tests::tier::is_full;
use rasray_tracer::build_until_complete;

/// Rays of each comparison.
const RAYS: u32 = 1000;

/// Bits of the hits of a system.
fn bits(device: &Device, spec: &Spec) -> Result<Vec<[u32; 4]>, Failure> {
    let (_, hits) = hits(device, spec, RAYS)?;
    Ok(hits.iter().map(|hit| bytemuck::cast::<_, [u32; 4]>(*hit)).collect())
}

fn name(spec: &Spec) -> String {
    format!("{} {}", spec.system().name, spec.preset().name())
}

/// True if hits of a preset are compared: the full tier compares those of all, the quick one of each system's
/// own.
fn is_compared(spec: &Spec) -> bool {
    is_full() || spec.preset() == Preset::Robust
}

/// Presets of the registry whose hits are compared, and pools reached by address.
fn subjects() -> Vec<Spec> {
    let mut subjects: Vec<_> = specs().expect("registered").into_iter().filter(is_compared).collect();
    let by_address = spec("mmrt", "robust").and_then(|spec| Ok(spec.with_option("addressing", "address")?));
    subjects.push(by_address.expect("an option of mmrt"));
    subjects
}

#[test]
fn every_feature_can_be_missing_or_is_missed_by_name() {
    let device = device().expect("a device");
    let all = device.enabled();
    let subjects = subjects();
    let expected: Vec<_> = subjects.iter().map(|spec| bits(&device, spec).expect("hits")).collect();
    let found = expected.iter().flatten().filter(|hit| hit[1] != u32::MAX).count();
    assert!(found > 400 * subjects.len(), "{found} hits are too few to compare");
    let (mut compared, mut refused) = (0, 0);
    for feature in Feature::ALL {
        let made = without(&[feature], || device_with(requirements()));
        if Requirements::floor().required.contains(&feature) {
            let error = made.map(finish).expect_err("the floor is required");
            assert!(matches!(error, GpuError::NoSuitableDevice { .. }), "{error}");
            assert!(error.to_string().contains(feature.name()), "{error}");
            refused += 1;
            continue;
        }
        let lacking = made.expect("a device without what is optional");
        assert!(!lacking.has(feature));
        // A feature that was never enabled cannot be missed: such a device is the same as before.
        let is_same = lacking.enabled() == all && lacking.limits() == device.limits();
        assert_eq!(is_same, !all.contains(&feature) && feature != Feature::TimestampQueries);
        for (spec, expected) in subjects.iter().zip(&expected) {
            if spec.requirements().expect("valid").required.contains(&feature) {
                let error = hits(&lacking, spec, 1).map(|_| ()).expect_err("it is required").to_string();
                assert!(error.contains(feature.name()), "{} without {feature}: {error}", name(spec));
                refused += 1;
            } else if !is_same || is_full() {
                let found = bits(&lacking, spec).expect("hits without what is optional");
                assert_eq!(found, *expected, "{} without {feature}", name(spec));
                compared += 1;
            }
        }
        assert_eq!(finish(lacking), Vec::<String>::new());
    }
    println!("{compared} comparisons, {refused} refusals");
    assert!(compared > 0 && refused > 3);
    // Hits of coarse fragments are not the same: the comparison can fail.
    let coarse = spec("selective", "robust")
        .and_then(|spec| Ok(spec.with_option("coverage", "exact")?.with_option("resolution", "16")?));
    let position = subjects.iter().position(|spec| name(spec) == "selective robust").expect("registered");
    assert_ne!(bits(&device, &coarse.expect("an option")).expect("hits"), expected[position]);
    assert_eq!(finish(device), Vec::<String>::new());
}

/// Storage buffers that every device of Vulkan's Roadmap 2022 profile lets a stage use.
const ROADMAP_BUFFERS: u32 = 30;

#[test]
fn the_buffers_of_the_roadmap_profile_are_enough() {
    let whole = device().expect("a device");
    let small = with_limits(|limits| limits.max_storage_buffers_per_stage = ROADMAP_BUFFERS, device);
    let small = small.expect("a device");
    let tiny = with_limits(|limits| limits.max_storage_buffers_per_stage = 4, device).expect("a device");
    for spec in specs().expect("registered") {
        let requirements = spec.requirements().expect("valid");
        assert!(small.supports(&requirements), "{}: {:?}", name(&spec), small.lacks(&requirements));
        if is_compared(&spec) {
            let same = bits(&small, &spec).expect("hits") == bits(&whole, &spec).expect("hits");
            assert!(same, "{}", name(&spec));
        }
        if requirements.storage_buffers > 4 {
            // Said before anything is made.
            let lacks = tiny.lacks(&requirements).join(", ");
            assert!(
                lacks.contains("storage buffers per shader stage (it has 4)"),
                "{}: {lacks}",
                name(&spec)
            );
        }
    }
    assert_eq!(finish(tiny), Vec::<String>::new());
    assert_eq!(finish(small), Vec::<String>::new());
    assert_eq!(finish(whole), Vec::<String>::new());
}

/// A queue without timestamps is timed by the host.
#[test]
fn without_timestamps_the_host_times() {
    let device = without(&[Feature::TimestampQueries], device).expect("a device");
    assert_eq!(device.best_timing(), rasray_gpu::Timing::Host);
    let error = device.create_timers(1).map(|_| ()).expect_err("there are no timestamps").to_string();
    assert!(error.contains("timestamp"), "{error}");
    assert_eq!(finish(device), Vec::<String>::new());
}

/// Pools beyond one binding are refused by name, or reached by address with the same hits.
#[test]
fn a_small_binding_is_refused_by_name_or_reached_by_address() {
    // The lists of 6 * 130^2 cells and 4 buckets have 3,244,800 bytes.
    let sized =
        [("resolution", "128"), ("buckets", "4")].map(|(name, value)| (name.to_owned(), value.to_owned()));
    let descriptor = spec("mmrt", "robust").and_then(|spec| Ok(spec.with_options(sized)?));
    let descriptor = descriptor.expect("options of mmrt");
    let address = descriptor.with_option("addressing", "address").expect("an option of mmrt");
    let whole = device().expect("a device");
    let expected = bits(&whole, &descriptor).expect("hits");
    let (mut fitting, mut refused) = (0, 0);
    let mut exponents = vec![21, 22];
    if is_full() {
        exponents = (20..=27).collect();
    }
    for exponent in exponents {
        let small = with_limits(move |limits| limits.max_storage_buffer_range = 1 << exponent, device)
            .expect("a device");
        match bits(&small, &descriptor) {
            Ok(found) => {
                assert_eq!(found, expected, "2^{exponent} bytes");
                fitting += 1;
            }
            Err(error) => {
                let Some(GpuError::TooLarge { name, size, limit }) = error.gpu() else { panic!("{error}") };
                assert!(name.contains("abuffer") && size > limit && *limit == 1 << exponent, "{error}");
                refused += 1;
            }
        }
        assert_eq!(bits(&small, &address).expect("hits by address"), expected, "2^{exponent} bytes");
        assert_eq!(finish(small), Vec::<String>::new());
    }
    assert!(fitting > 0 && refused > 0, "{fitting} fit, {refused} were refused");
    assert_eq!(finish(whole), Vec::<String>::new());
}

/// Texels beyond one binding lie in several buffers: the same picture. Where all of these are too few, a
/// scene is refused by number, and fits with a smaller image.
#[test]
fn texels_beyond_one_binding_lie_in_several_or_are_fewer() {
    let spec = spec("brute-force", "robust").expect("registered");
    let picture = |device: &Device, scene: &Scene| {
        let stage = stage_of(device, scene)?;
        Ok::<_, Failure>((stage.features().texel_runs, picture_of(device, &spec, &stage)?))
    };
    let mut scene = textured_room(700);
    let demand = TexelDemand::of(&scene, &Parts::ALL).expect("the scene is whole");
    let whole = device().expect("a device");
    let (is_split, expected) = picture(&whole, &scene).expect("a picture");
    assert!(!is_split && demand.bytes() > 2 << 20);
    let small = |exponent: u32| {
        let device = with_limits(move |limits| limits.max_storage_buffer_range = 1 << exponent, device);
        device.expect("a device")
    };
    let halves = small(20);
    let found = picture(&halves, &scene).expect("a picture");
    assert_eq!(found, (true, expected.clone()));
    assert_eq!(finish(halves), Vec::<String>::new());

    let too_small = small(19);
    let capacity = TexelRuns::of(too_small.limits()).most_texels();
    match picture(&too_small, &scene) {
        Err(Failure::Scene(GpuSceneError::TooManyTexels { count, limit })) => {
            assert_eq!((count, limit), (demand.texels(), capacity));
        }
        other => panic!("{} texels do not fit, got {:?}", demand.texels(), other.map(|_| ())),
    }
    let smaller = demand.smaller_images(capacity).expect("half as many rows fit");
    assert_eq!(smaller.iter().map(|image| image.to).collect::<Vec<_>>(), [[350, 350]]);
    smaller[0].apply(&mut scene);
    let (is_split, found) = picture(&too_small, &scene).expect("a picture");
    let (_, of_whole) = picture(&whole, &scene).expect("a picture");
    assert!(is_split && found == of_whole && found != expected);
    assert_eq!(finish(too_small), Vec::<String>::new());
    assert_eq!(finish(whole), Vec::<String>::new());
}

/// Pixels beyond one binding lie in several buffers: the same picture.
#[test]
fn films_beyond_one_binding_lie_in_several() {
    let picture = |device: &Device| {
        let (scene, [width, height]) = (builtin::cornell(), [256, 128]);
        let mut gpu = stage_of(device, &scene)?;
        gpu.update_camera(&View { camera: scene.cameras[0].clone(), width, height, seed: 1 })?;
        let mut structure = spec("bvh", "robust")?.create(device, gpu.geometry(), Some(gpu.binding()))?;
        build_until_complete(device, structure.as_mut(), gpu.eye(), device.best_timing())?;
        let film = Film::new(device, width, height)?;
        let desc = IntegratorDesc { wave_capacity: 1024, ..IntegratorDesc::new(device, &gpu, &film) };
        let raycast = Raycast::new(&desc)?;
        device.submit(|recorder| raycast.record_reset(recorder))?;
        for wave in film.bands().waves([0], raycast.wave_capacity()) {
            raycast.render_wave(device, Timing::None, structure.as_ref().into(), wave)?;
        }
        let pixels = film.read(device)?.into_iter().map(|pixel| pixel.map(f32::to_bits));
        // Records that are larger than those of films.
        let aov = AovPass::with_surfaces(device, &gpu, film.bands(), 1024)?;
        let mut surfaces = Vec::new();
        for band in aov.bands().ranges() {
            device.submit(|recorder| aov.record_reset(recorder))?;
            for wave in Wave::cut(band.clone(), 0, 1024) {
                device.submit(|recorder| aov.record_wave(recorder, structure.as_ref().into(), wave))?.value?;
            }
            surfaces.extend(aov.read_surfaces(device, band.len() as u32)?);
        }
        let bands = [film.pixels().len(), aov.bands().ranges().count()];
        Ok::<_, Failure>((bands, (pixels.collect::<Vec<_>>(), surfaces)))
    };
    let whole = device().expect("a device");
    let (one, expected) = picture(&whole).expect("a picture");
    let small = with_limits(|limits| limits.max_storage_buffer_range = 1 << 18, device).expect("a device");
    let (several, found) = picture(&small).expect("a picture");
    assert_eq!((one, several), ([1; 2], [3, 7]));
    assert!(found == expected && found.0.iter().any(|pixel| *pixel != [0; 3]));
    assert!(found.1.iter().any(|surface| surface.albedo != [0.0; 3]));
    assert_eq!(finish(small), Vec::<String>::new());
    assert_eq!(finish(whole), Vec::<String>::new());
}

/// A limit that is too small, and what the error then says.
type Small = (fn(&mut Limits), &'static str);

/// Each limit that a pass needs, made too small: an error that states what was requested, and no message of
/// the layer.
#[test]
fn small_limits_are_errors_with_a_name() {
    let small: [Small; 8] = [
        (|limits| limits.max_workgroup_count = [4; 3], "workgroups"),
        (|limits| limits.max_storage_buffers_per_stage = 4, "storage buffers"),
        (|limits| limits.max_bound_sets = 2, "sets"),
        (|limits| limits.max_push_constants = 4, "push constants"),
        (|limits| limits.max_framebuffer_size = [16, 16], "width"),
        (|limits| limits.max_memory_allocation = 4096, "maxMemoryAllocationSize"),
        (|limits| limits.max_storage_buffer_range = 4096, "binding"),
        (|limits| limits.max_workgroup_count = [u32::MAX; 3], ""),
    ];
    let spec = spec("mmrt", "robust").expect("registered");
    let whole = device().expect("a device");
    let expected = bits(&whole, &spec).expect("hits");
    for (change, text) in small {
        let device = with_limits(change, device).expect("a device");
        match bits(&device, &spec) {
            // Limits beyond what is needed change nothing.
            Ok(found) => assert!(text.is_empty() && found == expected, "no error about {text}"),
            Err(error) => {
                let message = error.to_string();
                assert!(!text.is_empty() && message.contains(text), "`{text}` is not in `{message}`");
                assert!(error.gpu().is_some(), "{message}");
            }
        }
        assert_eq!(device.allocated_bytes(), 0);
        assert_eq!(finish(device), Vec::<String>::new());
    }
    assert_eq!(finish(whole), Vec::<String>::new());
}
