//! Structures built for one input and traced with another: other triangles, another scene, frames that were
//! never recorded.

use rasray_ads::{
    AdsError, BoundsPass, BruteForce, BufferOffset, Combined, Geometry, GeometryDesc, Hit, IndexFormat, Ray,
    Structure, TraceMode,
};
use rasray_gpu::{BufferUsage, Timing};
use rasray_gpu_scene::{GpuScene, Parts, SceneTables, View};
use rasray_scene::builtin::builtin;
use rasray_scene::needs::Needs;
use rasray_tests::harness::{Bench, bits_of_any_build};
use rasray_tests::invariance::Subject;
use rasray_tests::shapes::{closed_box, sphere};
use rasray_tracer::{
    BatchTracer, FrameOutcome, FrameSettings, FrameStructure, TracerError, build_until_complete,
};

use crate::misuse::dirty_memory;

pub const EYE: [f32; 3] = [0.0; 3];

/// Rays that all hit what surrounds the eye.
pub fn rays() -> Vec<Ray> {
    let at = |k: u8| Ray::new(EYE, [f32::from(k % 8) / 5.0 - 0.7, f32::from(k / 8) / 5.0 - 0.6, 1.0]);
    (0..64).map(at).collect()
}

/// That no ray has an answer, nearest or occluded, and that the status says so.
fn assert_no_answers(bench: &Bench, structure: &dyn Structure, what: &str) {
    let rays = rays();
    let tracer = BatchTracer::new(bench.device(), 64).expect("a queue fits");
    for mode in [TraceMode::Closest, TraceMode::Occluded] {
        match tracer.trace(structure, &rays, mode, Timing::None) {
            Err(TracerError::NotReady { rays: 64 }) => {}
            Ok(outcome) => {
                let hits = outcome.hits.iter().filter(|hit| hit.is_hit()).count();
                panic!("{what}: {hits} hits, and the others miss");
            }
            Err(error) => panic!("{what}: {error}"),
        }
    }
    assert!(!structure.status(0).expect("the header is readable").complete, "{what}");
}

/// Every preset, and bricks that keep corners and so never look at triangles again.
fn subjects() -> Vec<Subject> {
    let mut subjects = Subject::all();
    let bricks = subjects.iter().find(|subject| subject.name() == "bricks robust").cloned();
    let corners = bricks.and_then(|bricks| bricks.with(&[("corners", "on")]));
    subjects.push(corners.expect("bricks keep corners"));
    subjects
}

#[test]
fn triangles_that_nothing_was_built_for_are_not_traced() {
    let bench = Bench::new();
    let device = bench.device();
    let rays = rays();
    let triangles: Vec<_> = [closed_box([-2.0; 3], [2.0; 3]), sphere(EYE, 1.0, 12)].concat();
    let first = bench.geometry(&triangles);
    let fewer = bench.geometry(&triangles[..12]);
    let moved: Vec<_> = triangles.iter().map(|triangle| triangle.map(|[x, y, z]| [x, y, z + 0.25])).collect();
    let more = [triangles.clone(), sphere(EYE, 0.5, 12)].concat();
    let others = [("fewer", &fewer), ("as many", &bench.geometry(&moved)), ("more", &bench.geometry(&more))];
    for subject in subjects() {
        let mut structure = subject.spec.create(device, &first, None).expect("it can be made");
        let hits = |structure: &dyn Structure| -> Vec<_> {
            bench.trace(structure, &rays).hits.iter().map(bits_of_any_build).collect()
        };
        let build = |structure: &mut dyn Structure| {
            build_until_complete(device, structure, EYE, Timing::None).expect("it is built");
        };
        build(structure.as_mut());
        let before = hits(structure.as_ref());
        for (what, other) in others {
            let what = format!("{}: {what}", subject.name());
            structure.set_geometry(device, other).expect("it fits");
            let mut fresh = subject.spec.create(device, other, None).expect("it can be made");
            build(fresh.as_mut());
            if subject.spec.system().name == "brute-force" {
                // It reads the triangles themselves.
                assert_eq!(hits(structure.as_ref()), hits(fresh.as_ref()), "{what}");
                continue;
            }
            assert_no_answers(&bench, structure.as_ref(), &what);
            // Nothing of it was too small, so nothing grows.
            let status = structure.status(0).expect("the header is readable");
            structure.check(&status, 50).expect("there are sizes");
            build(structure.as_mut());
            assert_eq!(hits(structure.as_ref()), hits(fresh.as_ref()), "{what}");
        }
        structure.set_geometry(device, &first).expect("it fits");
        build(structure.as_mut());
        assert_eq!(hits(structure.as_ref()), before, "{}", subject.name());
        // Those that it was built for, handed over once more.
        structure.set_geometry(device, &fewer).expect("it fits");
        structure.set_geometry(device, &first).expect("it fits");
        assert!(structure.status(0).expect("the header is readable").complete, "{}", subject.name());
        assert_eq!(hits(structure.as_ref()), before, "{}", subject.name());
    }
}

/// The status of a frame that is in flight stays what it was, whatever the next frame is given.
#[test]
fn a_build_of_the_triangles_before_was_complete() {
    let bench = Bench::new();
    let device = bench.device();
    let [first, second] = [1.0, 2.0].map(|size| bench.geometry(&closed_box([-size; 3], [size; 3])));
    for subject in Subject::all() {
        let mut structure = subject.spec.create(device, &first, None).expect("it can be made");
        structure.set_slots(device, 2).expect("it fits");
        build_until_complete(device, structure.as_mut(), EYE, Timing::None).expect("it is built");
        structure.set_geometry(device, &second).expect("it fits");
        let status = structure.status(0).expect("the header is readable");
        let is_brute = subject.spec.system().name == "brute-force";
        assert_eq!((status.complete, status.was_complete), (is_brute, true), "{}", subject.name());
        let check = structure.check(&status, 50).expect("there are sizes");
        assert_eq!(check, rasray_ads::Check::Complete, "{}", subject.name());
    }
}

#[test]
fn parts_that_nothing_was_built_for_are_not_traced() {
    let bench = Bench::new();
    let device = bench.device();
    let triangles: Vec<_> = [closed_box([-2.0; 3], [2.0; 3]), sphere(EYE, 1.0, 8)].concat();
    let whole = bench.geometry(&triangles);
    let parts = |moving| whole.parts(device, &[moving], [whole.bounds(); 2]).expect("they are parts");
    let subject = Subject::all().into_iter().find(|subject| subject.name() == "bricks robust");
    let subject = subject.expect("the registry has bricks");
    let make = |part: &Geometry| subject.spec.create(device, part, None);
    let mut structure = Combined::new(&parts(0..12), make).expect("it finds every triangle");
    build_until_complete(device, &mut structure, EYE, Timing::None).expect("it is built");
    let expected: Vec<_> = bench.trace(&structure, &rays()).hits.iter().map(bits_of_any_build).collect();
    structure.set_parts(device, &parts(12..30)).expect("they fit");
    assert_no_answers(&bench, &structure, "other parts");
    // One of them is not enough.
    let build = |structure: &mut Combined, moving| {
        let submitted = device.submit(|recorder| {
            structure.change_part(moving, |part| part.record_build(recorder, 0, EYE.into()))
        });
        submitted.expect("the device works").value.expect("it is recorded");
    };
    build(&mut structure, 1);
    assert_no_answers(&bench, &structure, "the moving part alone");
    build_until_complete(device, &mut structure, EYE, Timing::None).expect("it is built");
    let found: Vec<_> = bench.trace(&structure, &rays()).hits.iter().map(bits_of_any_build).collect();
    assert_eq!(found, expected);
}

/// The device reads another number of triangles in the build of another structure.
#[test]
fn a_number_of_triangles_that_changed_makes_builds_stale() {
    let bench = Bench::new();
    let device = bench.device();
    let triangles: Vec<_> = [closed_box([-2.0; 3], [2.0; 3]), sphere(EYE, 1.0, 8)].concat();
    let packed = bench.geometry(&triangles);
    let count =
        device.create_buffer_with("count", BufferUsage::ALL, &[packed.triangle_count()]).expect("it fits");
    let counted = BufferOffset { buffer: count.clone(), offset: 0 };
    let desc = GeometryDesc { count: Some(counted), ..packed.desc().clone() };
    let geometry = Geometry::new(device, desc).expect("the buffers hold it");
    let subject = Subject::all().into_iter().find(|subject| subject.name() == "bricks robust");
    let subject = subject.expect("the registry has bricks");
    for options in [&[("corners", "on")][..], &[]] {
        let subject = subject.with(options).expect("bricks have it");
        let [mut one, mut other] =
            [(); 2].map(|()| subject.spec.create(device, &geometry, None).expect("it can be made"));
        build_until_complete(device, one.as_mut(), EYE, Timing::None).expect("it is built");
        build_until_complete(device, other.as_mut(), EYE, Timing::None).expect("it is built");
        // With an equal number, both answer.
        assert!(bench.trace(one.as_ref(), &rays()).hits.iter().all(Hit::is_hit));
        assert!(bench.trace(other.as_ref(), &rays()).hits.iter().all(Hit::is_hit));
        device.upload_slice(&count, 0, &[1_u32]).expect("the device works");
        build_until_complete(device, other.as_mut(), EYE, Timing::None).expect("it is built");
        let traced = BatchTracer::new(device, 64).expect("a queue fits");
        let traced = traced.trace(one.as_ref(), &rays(), TraceMode::Closest, Timing::None);
        assert!(matches!(traced, Err(TracerError::NotReady { rays: 64 })), "{traced:?}");
        build_until_complete(device, one.as_mut(), EYE, Timing::None).expect("it is built");
        let hits = [&one, &other].map(|structure| bench.trace(structure.as_ref(), &rays()).hits);
        assert!(hits.iter().flatten().all(|hit| !hit.is_hit() || hit.primitive == 0));
        device.upload_slice(&count, 0, &[packed.triangle_count()]).expect("the device works");
    }
}

/// No ray is answered before indices are gathered and triangles counted.
#[test]
fn brute_force_waits_for_indices_that_are_gathered_and_triangles_that_are_counted() {
    let bench = Bench::new();
    let device = bench.device();
    let packed = bench.geometry(&closed_box([-2.0; 3], [2.0; 3]));
    let short: Vec<u16> = (0..36).collect();
    let short = device.create_buffer_with("short", BufferUsage::ALL, &short).expect("it fits");
    let mut gathered = packed.desc().clone();
    gathered.indices.buffer = short;
    gathered.indices.format = IndexFormat::U16;
    let count = device.create_buffer_with("count", BufferUsage::ALL, &[12_u32]).expect("it fits");
    let counted =
        GeometryDesc { count: Some(BufferOffset { buffer: count, offset: 0 }), ..packed.desc().clone() };
    for desc in [gathered, counted] {
        dirty_memory(&bench);
        let geometry = Geometry::new(device, desc).expect("the buffers hold it");
        // Parts of the geometry are tried, too.
        let parts = match geometry.desc().count {
            None => vec![
                geometry
                    .parts(device, std::slice::from_ref(&(0..6)), [geometry.bounds(); 2])
                    .expect("they are parts"),
            ],
            Some(_) => Vec::new(),
        };
        let of_parts = parts.iter().flat_map(|parts| [parts.static_part(), &parts.parts()[1]]);
        for (geometry, is_whole) in
            std::iter::once((&geometry, true)).chain(of_parts.map(|part| (part, false)))
        {
            let mut brute = BruteForce::new(device, &packed, None, false).expect("kernels");
            brute.set_geometry(device, geometry).expect("it is taken");
            assert_no_answers(&bench, &brute, "not gathered");
            let status = bench.build_once(&mut brute, EYE);
            assert!(status.complete && status.was_complete);
            let hits = bench.trace(&brute, &rays()).hits;
            assert!(hits.iter().any(Hit::is_hit) || !is_whole);
            assert!(!is_whole || hits.iter().all(Hit::is_hit), "{hits:?}");
        }
    }
}

/// The bounds of triangles that are counted need no gathered indices, and leave them as they were.
#[test]
fn brute_force_waits_for_indices_of_triangles_that_were_counted_for_their_bounds_alone() {
    let bench = Bench::new();
    let device = bench.device();
    let packed = bench.geometry(&closed_box([-2.0; 3], [2.0; 3]));
    let short: Vec<u16> = (0..36).collect();
    let short = device.create_buffer_with("short", BufferUsage::ALL, &short).expect("it fits");
    let count = device.create_buffer_with("count", BufferUsage::ALL, &[6_u32]).expect("it fits");
    let mut desc = packed.desc().clone();
    desc.indices.buffer = short;
    desc.indices.format = IndexFormat::U16;
    desc.count = Some(BufferOffset { buffer: count.clone(), offset: 0 });
    dirty_memory(&bench);
    let geometry = Geometry::new(device, desc).expect("the buffers hold it");
    let bounds = BoundsPass::new(device).expect("pipelines");
    let measure = || {
        device.submit(|recorder| bounds.record(recorder, &geometry)).expect("the device works");
    };
    let tracer = BatchTracer::new(device, 64).expect("a queue fits");
    let trace = |brute: &BruteForce| tracer.trace(brute, &rays(), TraceMode::Closest, Timing::None);
    let mut brute = BruteForce::new(device, &geometry, None, false).expect("kernels");
    measure();
    assert_no_answers(&bench, &brute, "counted, not gathered");
    assert!(bench.build_once(&mut brute, EYE).complete);
    let six = trace(&brute).expect("it is built").hits;
    // Bounds of the same triangles leave what is built as it is.
    measure();
    assert_eq!(trace(&brute).expect("it is built").hits, six);
    // There are more of them, of which the indices are missing.
    device.upload_slice(&count, 0, &[12_u32]).expect("the device works");
    measure();
    let traced = trace(&brute);
    assert!(matches!(traced, Err(TracerError::NotReady { rays: 64 })), "{traced:?}");
    assert!(bench.build_once(&mut brute, EYE).complete);
    let hits = trace(&brute).expect("it is built").hits;
    assert!(hits.iter().all(Hit::is_hit) && !six.iter().all(Hit::is_hit), "{hits:?}");
}

/// Structures of fragments hold what the scene was when they were built: its masks and what they keep of its
/// surfaces.
#[test]
fn a_scene_that_nothing_was_built_for_is_not_traced() {
    let bench = Bench::new();
    let device = bench.device();
    let scene = builtin("cornell").expect("it is built in").expect("it has no parameters");
    let camera = scene.cameras.first().cloned().expect("it has a camera");
    let tables =
        SceneTables::new(&scene, glam::DVec3::ZERO, &Parts::from(&Needs::all())).expect("valid tables");
    let view = View { camera, width: 16, height: 16, seed: 1 };
    let [first, second] = [(); 2].map(|()| GpuScene::upload(device, &tables, &view).expect("it fits"));
    let rays: Vec<_> = rays();
    let tracer = BatchTracer::new(device, 64).expect("a queue fits");
    let (mut waited, mut ready) = (0, 0);
    for subject in Subject::all() {
        let subject = match subject.spec.preset().name() {
            "published" => subject.with(&[("payload", "surface")]).unwrap_or(subject),
            _ => subject,
        };
        let eye = first.eye();
        let mut structure =
            subject.spec.create(device, first.geometry(), Some(first.binding())).expect("it can be made");
        build_until_complete(device, structure.as_mut(), eye, Timing::None).expect("it is built");
        let expected = bench.trace(structure.as_ref(), &rays).hits;
        structure.set_scene(second.binding()).expect("it is the same scene");
        match tracer.trace(structure.as_ref(), &rays, TraceMode::Closest, Timing::None) {
            Ok(outcome) => {
                // Nothing of the scene is in it.
                let is_same = |(found, expected)| bits_of_any_build(found) == bits_of_any_build(expected);
                assert!(outcome.hits.iter().zip(&expected).all(is_same), "{}", subject.name());
                assert!(structure.status(0).expect("readable").complete, "{}", subject.name());
                ready += 1;
            }
            Err(TracerError::NotReady { rays: 64 }) => {
                assert!(!structure.status(0).expect("readable").complete, "{}", subject.name());
                waited += 1;
            }
            Err(error) => panic!("{}: {error}", subject.name()),
        }
        build_until_complete(device, structure.as_mut(), eye, Timing::None).expect("it is built");
        let found = bench.trace(structure.as_ref(), &rays).hits;
        let is_same = |(found, expected)| bits_of_any_build(found) == bits_of_any_build(expected);
        assert!(found.iter().zip(&expected).all(is_same), "{}", subject.name());
    }
    assert!(waited > 0 && ready > 0, "{waited} waited, {ready} did not");
}

#[test]
fn frames_are_finished_in_the_slots_that_they_were_recorded_for() {
    let bench = Bench::new();
    let device = bench.device();
    let geometry = bench.geometry(&closed_box([-1.0; 3], [1.0; 3]));
    for name in ["bricks robust", "brute-force robust"] {
        let subject = Subject::all().into_iter().find(|subject| subject.name() == name).expect("a system");
        let structure = subject.spec.create(device, &geometry, None).expect("it can be made");
        let mut frames =
            FrameStructure::new(device, structure, FrameSettings { slots: 3, headroom: 0 }).expect("it fits");
        let record = |frames: &mut FrameStructure, slot| {
            device
                .submit(|recorder| frames.record(recorder, slot, EYE.into()))
                .expect("the device works")
                .value
        };
        let is_refused = |outcome: Result<_, AdsError>, wrong| matches!(outcome.map(drop), Err(AdsError::Slot { slot, slots: 3, .. }) if slot == wrong);
        for slot in [0, 2, 3, u32::MAX] {
            assert!(is_refused(frames.finish(device, slot), slot), "{name}: {slot} was not recorded");
        }
        // Until the pools suffice.
        loop {
            record(&mut frames, 0).expect("it is recorded");
            if frames.finish(device, 0).expect("sizes suffice") == FrameOutcome::Complete {
                break;
            }
        }
        assert!(is_refused(frames.finish(device, 0), 0), "{name}: finished already");
        record(&mut frames, 1).expect("it is recorded");
        record(&mut frames, 2).expect("it is recorded");
        assert!(is_refused(frames.finish(device, 0), 0), "{name}: another slot");
        assert!(is_refused(frames.finish(device, 2), 2), "{name}: not the oldest");
        assert!(is_refused(record(&mut frames, 1).map(|_| FrameOutcome::Complete), 1), "{name}: in flight");
        assert_eq!(frames.finish(device, 1).expect("it is the oldest"), FrameOutcome::Complete);
        assert_eq!(frames.finish(device, 2).expect("it is the oldest"), FrameOutcome::Complete);
        // A frame that was not submitted does not end.
        record(&mut frames, 0).expect("it is recorded");
        frames.take_back(0);
        assert!(is_refused(frames.finish(device, 0), 0), "{name}: taken back");
        let counts = frames.counts();
        assert_eq!(counts.frames - counts.incomplete, 4, "{name}: refusals are no frames");
    }
}
