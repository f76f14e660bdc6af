//! Frames that build only what moved: their hits and pictures are those of frames that build everything.

use std::mem::size_of;
use std::ops::ControlFlow;
use std::path::PathBuf;

use bytemuck::pod_read_unaligned;
use glam::DVec3;
use rasray_ads::{BoundsPass, Combined, Counters, GeometryHeader, Ray, Structure, TraceMode, Viewpoint};
use rasray_frame::{FrameInput, FrameRenderer, render_in_order};
use rasray_gpu::Timing;
use rasray_gpu_scene::{GpuScene, Parts, PosePass, Sampling, SceneTables};
use rasray_integrators::{Film, IntegratorDesc, Path};
use rasray_scene::{Moment, Scene};
use rasray_scene_files::LoadOptions;
use rasray_systems::Spec;
use rasray_tests::harness::{Bench, bits};
use rasray_tests::random::Random;
use rasray_tests::rays::towards;
use rasray_tests::tier::{first, is_full};
use rasray_tracer::{BatchTracer, FrameOutcome, FrameSettings, Frames, Refresh, TracerError};

use crate::frames::crowd::{Crowd, Shown};
use crate::frames::kept::{Kept, Recorded};
use crate::frames::parts::that_find_all;
use crate::frames::scenes::{among, hall_of_objects, made, swinging_hall, third, view};
use crate::kept_pictures::Compared;

const RAYS: usize = 600;

/// A scene on the device, with its pass.
fn stage(bench: &Bench, scene: &Scene, size: [u32; 2]) -> (GpuScene, PosePass) {
    let tables = SceneTables::new(scene, DVec3::ZERO, &Parts::ALL).expect("the scene is whole");
    let gpu = GpuScene::upload(bench.device(), &tables, &view(scene, size, 0.0)).expect("it fits");
    let pass = PosePass::new(bench.device(), scene, &tables, &gpu).expect("it fits");
    (gpu, pass)
}

fn moment(seconds: f64) -> Moment {
    Moment { seconds, clips: vec![0] }
}

pub fn rays(random: &mut Random, bounds: [[f32; 3]; 2], targets: [[f32; 3]; 2]) -> Vec<Ray> {
    (0..RAYS)
        .map(|number| {
            let origin = random.within(bounds);
            if number % 2 == 0 {
                return Ray::new(origin, random.direction());
            }
            // Towards what moves.
            towards(origin, random.within(targets))
        })
        .collect()
}

pub fn header(bench: &Bench, buffer: &rasray_gpu::Buffer) -> GeometryHeader {
    let bytes = bench.device().download(buffer, 0, size_of::<GeometryHeader>() as u64);
    pod_read_unaligned(&bytes.expect("the device works"))
}

fn specs() -> Vec<Spec> {
    let spec = |system: &str, options: &[(&str, &str)]| {
        let given = options.iter().map(|(name, value)| ((*name).to_owned(), (*value).to_owned()));
        Spec::new(system, "robust", given).expect("the options are the system's")
    };
    vec![
        spec("bricks", &[]),
        spec("bvh", &[("builder", "lbvh")]),
        spec("bricks", &[("views", "cube")]),
        spec("bvh", &[("builder", "sah")]),
        spec("grid", &[]),
        spec("dirt", &[("resolution", "64")]),
    ]
}

/// Hits of frames of a scene at times, of everything built anew and of what moved alone.
fn hold(bench: &Bench, name: &str, scene: &Scene, times: &[f64], specs: &[Spec]) {
    hold_parts(bench, name, (scene, None), times, specs);
}

/// [`hold`] with a part for each of at most that many objects.
fn hold_parts(
    bench: &Bench,
    name: &str,
    (scene, objects): (&Scene, Option<usize>),
    times: &[f64],
    specs: &[Spec],
) {
    let device = bench.device();
    let (gpu, mut pass) = stage(bench, scene, [16, 16]);
    let parts = match objects {
        None => pass.parts(device),
        Some(most) => pass.objects(device, Some(scene), most),
    };
    let parts = parts.expect("it fits");
    let moving: u32 = parts.parts()[1..].iter().map(rasray_ads::Geometry::triangle_count).sum();
    let whole = gpu.geometry().triangle_count();
    let runs: Vec<usize> = parts.moving().iter().map(|part| part.ids.len()).collect();
    println!("{name}: {moving} of {whole} triangles move, in parts of {runs:?} runs");
    let measured = BoundsPass::new(device).expect("the device works");
    let mut still = 0;
    for spec in specs {
        let spec = spec.clone().with_counters(Counters::Sums);
        let binding = Some(gpu.binding());
        let system_name = spec.system().name;
        let system = format!("{name}, {system_name} {:?}", spec.options());
        let all = spec.create(device, gpu.geometry(), binding).expect("the options are valid");
        let combined =
            Combined::new(&parts, |part| spec.create(device, part, binding)).expect("it finds all");
        let (mut all, mut kept) = (Kept::new(bench, all), Kept::new(bench, combined));
        let mut random = Random::new(17);
        let mut found = [0; 2];
        let mut recorded = [Recorded::default(); 2];
        let mut work = [[0; 3]; 2];
        let mut viewpoint = Viewpoint::from([0.0; 3]);
        let mut first = viewpoint;
        let (mut before, mut moved) = (None, 0);
        for (frame, &seconds) in times.iter().enumerate() {
            let posed = pass.frame(scene, &moment(seconds)).expect("it is the same scene");
            device.submit(|recorder| pass.record(recorder, 0, &posed)).expect("the device works");
            let bounds = |header: GeometryHeader| [header.lower, header.upper];
            let [united, of_moving] =
                [gpu.geometry(), &parts.parts()[1]].map(|part| bounds(header(bench, part.header())));
            device.submit(|recorder| measured.record(recorder, gpu.geometry())).expect("the device works");
            assert_eq!(united, bounds(header(bench, gpu.geometry().header())), "{system}, frame {frame}");
            viewpoint = gpu.viewpoint_of(&view(scene, [16, 16], 0.01 * frame as f64));
            first = if frame == 0 { viewpoint } else { first };
            all.frames.geometry_moved();
            match before.filter(|_| objects.is_some()) {
                Some(before) => {
                    let which = pass.moved_parts(&before, &posed);
                    moved += which.iter().filter(|moved| **moved).count() as u64;
                    kept.frames.parts_moved(&which);
                }
                None => kept.frames.geometry_moved(),
            }
            before = Some(posed);
            recorded = [all.build(bench, viewpoint), kept.build(bench, viewpoint)];
            let rays = rays(&mut random, united, of_moving);
            let (expected, answered) = (all.answers(bench, &rays), kept.answers(bench, &rays));
            let differs = (0..RAYS)
                .find(|&ray| expected.0[ray] != answered.0[ray] || expected.1[ray] != answered.1[ray]);
            assert_eq!(differs, None, "{system}, frame {frame}: {:?}", differs.map(|ray| rays[ray]));
            for (work, counted) in work.iter_mut().zip([expected.2, answered.2]) {
                work.iter_mut().zip(counted).for_each(|(sum, counted)| *sum += counted);
            }
            for hit in &answered.0 {
                let moves = parts.moving().iter().flat_map(|part| &part.ids).any(|ids| ids.contains(&hit[1]));
                found[usize::from(moves)] += usize::from(hit[1] != u32::MAX);
            }
        }
        let counts = kept.frames.counts();
        println!("{system}: {found:?} hits on static and moving triangles, {counts:?}");
        println!("  the last build of all, and of what moves: {recorded:?}");
        let bytes = [&all, &kept].map(|kept| kept.frames.structure().sizes().bytes());
        let traced = (RAYS * times.len()) as f64;
        let per_ray = work.map(|work| work.map(|sum| sum as f64 / traced));
        println!("  bytes {bytes:?}; cells, entries and tests per ray {per_ray:.2?}");
        if is_full() {
            let seconds = [all.timed(bench, viewpoint), kept.timed(bench, viewpoint)];
            println!("  processor time of a build {seconds:.4?} s");
        }
        let is_some = |part: u32, hits: usize| (part == 0) == (hits == 0);
        assert!(is_some(whole - moving, found[0]) && is_some(moving, found[1]), "{system}: {found:?}");
        // The static part is built until its pools suffice, and not with every frame, unless the eye's move
        // matters to it. That of the moving part alone is another question: it may be small, and the eye far
        // away for it.
        let static_alone = spec.create(device, parts.static_part(), binding).expect("the options are valid");
        let eye_matters = static_alone.is_stale(first, viewpoint);
        assert!(eye_matters || counts.static_builds <= 4, "{system}: {counts:?}");
        still += usize::from(!eye_matters);
        // Cells of a small part have margins for rays from anywhere in the whole, so that these need not test
        // all of it.
        let tests = work.map(|work| work[2]);
        assert!(objects.is_some() || eye_matters || tests[1] <= 2 * tests[0], "{system}: {tests:?} tests");
        if objects.is_none() {
            assert!(counts.builds >= times.len() as u64, "{system}: {counts:?}");
        } else if system_name == "bvh" {
            // Nothing else makes a tree stale.
            assert_eq!(counts.part_builds, parts.parts().len() as u64 + moved, "{system}: {counts:?}");
        }
    }
    assert!(still >= specs.len().min(2), "{name}: {still} systems whose static part is built once");
}

#[test]
fn a_figure_walks_on_ground_that_is_built_once() {
    let bench = Bench::new();
    let walker = made("walker:30k");
    let times: Vec<f64> = (0..6).map(|frame| 0.9 * f64::from(frame)).collect();
    hold(&bench, "walker:30k", &walker, &times, &specs()[..2]);
    let hall = among(made("walker:8k"), &made("atrium:detail=0.25"));
    hold(&bench, "walker:8k in atrium", &hall, &times, first(&specs(), 5));
}

#[test]
fn parts_of_a_hall_swing_with_masks() {
    let bench = Bench::new();
    let times = [0.0, 0.3, 0.3, 0.7, 1.0, 0.1];
    hold(&bench, "every third", &swinging_hall(third), &times, &specs());
    hold(&bench, "everything", &swinging_hall(|_| true), &times, &specs()[..2]);
    hold(&bench, "nothing", &swinging_hall(|_| false), &times, &specs()[..2]);
}

/// Objects have parts of their own, which are built in frames in which they move.
#[test]
fn objects_are_built_where_they_move() {
    let bench = Bench::new();
    let times: Vec<f64> = (0..12).map(|frame| 0.18 * f64::from(frame)).collect();
    let hall = hall_of_objects();
    hold_parts(&bench, "objects", (&hall, Some(32)), &times, first(&specs(), 3));
    // The largest has a part of its own, the others share one, and so does all of a figure.
    hold_parts(&bench, "one object", (&hall, Some(1)), &times[..6], &specs()[1..2]);
    let figure = among(made("walker:8k"), &made("cornell"));
    hold_parts(&bench, "a figure", (&figure, Some(4)), &[0.0, 0.0, 0.9, 0.9], &specs()[1..2]);
}

#[test]
fn a_real_figure_moves_in_a_hall() {
    let Some(folder) = std::env::var_os("RASRAY_SCENES").map(PathBuf::from) else {
        eprintln!("skipped: RASRAY_SCENES is not set");
        return;
    };
    let bench = Bench::new();
    let file = folder.join("skinned/CesiumMan/CesiumMan.glb");
    let figure = rasray_scene_files::load(&file, &LoadOptions::default()).expect("it is read");
    let hall = among(figure, &made("atrium:detail=0.25"));
    let times: Vec<f64> = (0..5).map(|frame| 0.4 * f64::from(frame)).collect();
    hold(&bench, "CesiumMan in atrium", &hall, &times, &specs()[..2]);
}

/// Pictures of frames in flight, with shadows and light that is scattered.
#[test]
fn pictures_are_the_same() {
    let bench = Bench::new();
    let (device, scene) = (bench.device(), swinging_hall(third));
    let size = [20, 12];
    let pictures = |spec: &Spec, in_parts: bool| {
        let (gpu, mut pass) = stage(&bench, &scene, size);
        let binding = Some(gpu.binding());
        let structure: Refresh = if in_parts {
            let parts = pass.parts(device).expect("it fits");
            Combined::new(&parts, |part| spec.create(device, part, binding)).expect("it finds all").into()
        } else {
            spec.create(device, gpu.geometry(), binding).expect("the options are valid").into()
        };
        let film = Film::new(device, size[0], size[1]).expect("it fits");
        let path = Path::new(&IntegratorDesc::new(device, &gpu, &film), 2).expect("it fits");
        // The last three frames have one pose, and the camera moves.
        let input = |frame: u32| {
            let posed = pass.frame(&scene, &moment(0.2 * f64::from(frame.min(4)))).expect("the same scene");
            let view = view(&scene, size, 0.02 * f64::from(frame));
            let sampling = Sampling { samples: 2, ..Sampling::default() };
            FrameInput {
                view,
                sampling,
                scene: None,
                pose: Some(posed),
                samples: (0..2).into(),
                continues: false,
            }
        };
        let inputs: Vec<FrameInput> = (0..7).map(input).collect();
        let settings = FrameSettings { slots: 3, ..FrameSettings::default() };
        let rest = (settings, Timing::None, true);
        let mut renderer = FrameRenderer::new(device, (gpu, Some(pass)), structure, Box::new(path), rest)
            .expect("the device works");
        let mut found = Vec::new();
        let done = render_in_order(&mut renderer, inputs, |picture| {
            found.push((picture.film.means(), picture.built));
            ControlFlow::Continue(())
        });
        let done = done.expect("all frames have pictures");
        (found, done.repeated, renderer.structure().counts())
    };
    for spec in &specs()[..2] {
        let name = spec.system().name;
        let (expected, _, all) = pictures(spec, false);
        let (found, repeated, counts) = pictures(spec, true);
        println!("{name}: all {all:?}, in parts {counts:?}, {repeated} repeated");
        for (frame, (found, expected)) in found.iter().zip(&expected).enumerate() {
            let compared = Compared { picture: &found.0, reference: &expected.0, width: size[0] };
            compared.assert_bits(format_args!("{name}, frame {frame}"));
        }
        let distinct = found.windows(2).filter(|pair| pair[0].0 != pair[1].0).count();
        assert_eq!(distinct, 6, "{name}: frames differ, or nothing could go wrong");
        // Neither the camera nor a pose that stays makes anything be built.
        let built: Vec<bool> = found.iter().map(|picture| picture.1).collect();
        assert_eq!(built, [true, true, true, true, true, false, false], "{name}");
        if name == "bvh" {
            assert_eq!(repeated, 0, "a tree knows what it takes");
            assert_eq!((counts.builds, counts.static_builds), (5, 1));
            assert_eq!((all.builds, all.static_builds), (5, 5));
        } else {
            assert!(counts.static_builds <= 4 && counts.static_builds < counts.builds, "{name}: {counts:?}");
        }
    }
}

/// Moving parts grow from frame to frame, and their pools with them; those of the static part keep their
/// contents.
#[test]
fn what_moves_outgrows_its_pools() {
    let bench = Bench::new();
    let device = bench.device();
    for subject in that_find_all() {
        let name = subject.name();
        let settings = FrameSettings { slots: 2, headroom: 0 };
        let crowd = Crowd::new(device, settings.slots, 200, 64);
        let mut shown = Shown::random(&mut Random::new(23), 200, 64);
        // Every other ten move.
        let moving: Vec<_> = (10..200).step_by(20).map(|first| first..first + 10).collect();
        let small = shown.clone();
        let whole = crowd.geometry(&shown);
        let everywhere = [shown.bounds(); 2];
        let parts = whole.parts(device, &moving, everywhere).expect("they are parts");
        let combined =
            Combined::new(&parts, |part| subject.spec.create(device, part, None)).expect("it finds all");
        let mut frames = Frames::new(device, combined, settings, Timing::None).expect("the device works");
        let mut static_builds = None;
        let mut static_bytes = None;
        for factor in [1.0_f32, 1.0, 2.0, 4.0, 8.0] {
            for ids in &moving {
                for id in ids.clone() {
                    shown.triangles[id as usize] = small.triangles[id as usize].map(|corner| {
                        std::array::from_fn(|axis| {
                            let first = small.triangles[id as usize][0][axis];
                            first + factor * (corner[axis] - first)
                        })
                    });
                }
            }
            frames.geometry_moved();
            let hits = loop {
                let slot = frames.free_slot().expect("none is in flight");
                crowd.write(slot, &shown);
                frames
                    .submit::<TracerError>(
                        shown.eye.into(),
                        |recorder, slot| crowd.record_move_parts(recorder, slot, &parts),
                        |recorder, slot, structure: &dyn Structure| {
                            crowd.record_trace(recorder, slot, structure);
                            Ok(())
                        },
                    )
                    .expect("the frame is recorded");
                let ended = frames.take().expect("the device works").expect("one is in flight");
                if ended.outcome == FrameOutcome::Complete {
                    break crowd.read(ended.slot).0;
                }
            };
            let mut fresh = subject.structure(&bench, &bench.geometry(&shown.triangles));
            let expected = bench.build_and_trace(fresh.as_mut(), shown.eye, &shown.rays);
            let key = |hits: &[rasray_ads::Hit]| hits.iter().map(bits).collect::<Vec<_>>();
            assert_eq!(key(&hits), key(&expected), "{name}, {factor} times as large");
            let counts = frames.structure().counts();
            let built = *static_builds.get_or_insert(counts.static_builds);
            assert_eq!(counts.static_builds, built, "{name}: the static part stays");
            let bytes = frames.structure().structure().sizes().bytes();
            static_bytes.get_or_insert(bytes);
        }
        println!("{name}: {:?}, {static_bytes:?} bytes at first", frames.structure().counts());
    }
}

/// Masks are looked up by id in either part, and a replay says which part a step is in.
#[test]
fn a_replay_goes_through_both_parts() {
    let bench = Bench::new();
    let device = bench.device();
    let (gpu, mut pass) = stage(&bench, &swinging_hall(third), [16, 16]);
    let parts = pass.parts(device).expect("it fits");
    let spec = specs().remove(0).with_counters(Counters::Steps);
    let mut combined =
        Combined::new(&parts, |part| spec.create(device, part, Some(gpu.binding()))).expect("it finds all");
    let [lower, upper] = gpu.geometry().bounds();
    let middle: [f32; 3] = std::array::from_fn(|axis| 0.5 * (lower[axis] + upper[axis]));
    rasray_tracer::build_until_complete(device, &mut combined, middle, Timing::None).expect("it is built");
    let mut random = Random::new(3);
    let tracer = BatchTracer::new(device, 64).expect("a queue fits");
    for _ in 0..12 {
        let ray = Ray::new(middle, random.direction());
        let traced = tracer.trace(&combined, &[ray], TraceMode::Closest, Timing::None).expect("it finishes");
        let replay = tracer.replay(&combined, &ray, TraceMode::Closest).expect("it is logged");
        assert_eq!(replay.hit.as_ref().map(bits), Some(bits(&traced.hits[0])));
        assert_eq!(replay.logged_work(), replay.work);
        assert_eq!(replay.work, traced.work[0]);
        let sums = (traced.counters.cells, traced.counters.entries, traced.counters.tests);
        let rasray_ads::RayWork { cells, entries, tests, .. } = replay.work;
        assert_eq!(sums, (cells.into(), entries.into(), tests.into()));
        assert!(replay.to_string().contains("round 0 of the next part"), "{replay}");
    }
}
