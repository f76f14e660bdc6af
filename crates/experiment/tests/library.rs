//! Tests of experiments as another program runs them: without a command line.

#[path = "library/further_images.rs"]
mod further_images;

use std::collections::BTreeSet;
use std::ffi::OsStr;
use std::ops::ControlFlow;

use rasray_ads::PRIMITIVE_NONE;
use rasray_experiment::{
    Aov, AovSelection, CompareJob, Comparison, DeviceChoice, ExperimentError, FinishedRun, Frame,
    FrameBefore, HardJob, IntegratorRow, IntegratorSpec, KeptScene, OccluderKind, OptionValues, Primary,
    RaySet, Refresh, RenderJob, RenderOutput, Sampler, Shard, SystemConfig, open,
};
use rasray_hard_cases::Scale;
use rasray_options::Value;
use rasray_ray_files::HitsFile;
use rasray_report::{ListRecord, Run};
use rasray_scene::Moment;
use rasray_scene::needs::Needs;
use rasray_scene_source::{LoadedScene, default_view, load};
use rasray_systems::{Preset, System};

const RAYS: u32 = 500;

const SEED: u32 = 7;

fn systems(names: &[&str]) -> Vec<SystemConfig> {
    let config = |name: &&str| {
        let system = System::named(name).expect("a system of the registry");
        SystemConfig::new(system, Preset::Robust, OptionValues::default())
    };
    names.iter().map(config).collect()
}

fn job<'a>(loaded: &'a LoadedScene, names: &[&str], ray_sets: &[RaySet]) -> CompareJob<'a> {
    let frame = Frame {
        integrator: IntegratorRow::named("raycast").expect("registered").into(),
        width: 32,
        height: 32,
        spp: 1,
        adaptive: None,
        seed: SEED,
        sampler: Sampler::Sobol,
        primary: Primary::Trace,
        occluder: OccluderKind::Structure,
        back_faces: rasray_scene::BackFaces::Camera,
    };
    let needs = Needs::of(&loaded.scene, frame.workload());
    CompareJob {
        scene: &loaded.scene,
        camera: default_view(&loaded.scene).camera,
        systems: systems(names),
        ray_sets: ray_sets.to_vec(),
        rays: RAYS,
        frame,
        image: false,
        figures: false,
        lists: false,
        repetitions: 1,
        rays_file: None,
        hits_files: Vec::new(),
        keep: true,
        replay: None,
        needs,
        only: None,
    }
}

#[test]
fn systems_are_compared_on_the_same_rays_and_a_wrong_hit_is_counted() {
    let mut loaded = load(OsStr::new("cornell")).expect("a built-in scene");
    loaded.light(None);
    let mut backend = open(&DeviceChoice::default()).expect("a device");
    let names = ["bricks", "brute-force"];
    let sets = [RaySet::Incoherent, RaySet::Surface];
    let Comparison { runs, mut kept, .. } = backend
        .compare(&job(&loaded, &names, &sets), &mut |_| ControlFlow::Continue(()), &mut |_| {
            ControlFlow::Continue(())
        })
        .expect("the device works");
    let shape: Vec<_> = runs.iter().map(|run| (run.system.as_str(), run.ray_set.as_deref())).collect();
    let expected = sets.map(|set| names.map(|name| (name, Some(set.name())))).concat();
    assert_eq!(shape, expected);
    for run in &runs {
        let accuracy = run.accuracy.as_ref().expect("hits were compared");
        assert_eq!(
            (accuracy.missed, accuracy.false_hits, accuracy.wrong_primitive),
            (0, 0, Some(0)),
            "{run:?}"
        );
    }

    // Cells by themselves give equal answers, each reported as soon as it is complete; another set is not
    // traced.
    let mut one = job(&loaded, &names, &sets);
    one.only = Some(BTreeSet::from([3]));
    let mut told = Vec::new();
    let mut finished = |FinishedRun { place, run, .. }: FinishedRun<'_>| {
        told.push((place, run.system.clone()));
        ControlFlow::Continue(())
    };
    let alone =
        backend.compare(&one, &mut finished, &mut |_| ControlFlow::Continue(())).expect("the device works");
    assert_eq!((alone.places, told), (vec![3], vec![(3, "brute-force".to_owned())]));
    assert_eq!(alone.runs[0].accuracy, runs[3].accuracy);
    assert_eq!(alone.kept.sets.len(), 1);
    let mut stopped = |_: FinishedRun<'_>| ControlFlow::Break(());
    let first = backend
        .compare(&job(&loaded, &names, &sets), &mut stopped, &mut |_| ControlFlow::Continue(()))
        .expect("the device works");
    assert_eq!(first.places, [0, 1], "systems take turns on a set");

    // The hits are given again, except one, which is lost.
    let set = kept.sets.swap_remove(0);
    let mut hits = set.answers[0].hits.clone();
    let sure = |ray: usize| !set.truth[ray].ambiguous && set.truth[ray].primitive != PRIMITIVE_NONE;
    let lost = (0..hits.len()).find(|&ray| sure(ray)).expect("a ray hits something");
    hits[lost].primitive = PRIMITIVE_NONE;
    let mut again = job(&loaded, &names[..1], &sets[..1]);
    again.hits_files = vec![HitsFile { name: "given".to_owned(), hits }];
    let runs = backend
        .compare(&again, &mut |_| ControlFlow::Continue(()), &mut |_| ControlFlow::Continue(()))
        .expect("the device works")
        .runs;
    let missed: Vec<_> =
        runs.iter().map(|run| run.accuracy.as_ref().map(|accuracy| accuracy.missed)).collect();
    assert_eq!(missed, [Some(0), Some(1)]);
}

#[test]
fn what_lists_hold_is_counted_where_it_is_asked_for() {
    let mut loaded = load(OsStr::new("cornell")).expect("a built-in scene");
    loaded.light(None);
    let mut backend = open(&DeviceChoice::default()).expect("a device");
    let names = ["mmrt", "selective", "bvh"];
    let mut job = job(&loaded, &names, &[RaySet::Incoherent]);
    for config in &mut job.systems[..2] {
        // Only fragments are counted: entries of conservative lists are not layers.
        let fragments = OptionValues::default().with("coverage", Value::Word("exact"));
        config.options = fragments.with("resolution", 32);
    }
    let of_pages = job.systems[1].options.clone().with("storage", Value::Word("paged"));
    job.systems[1].options = of_pages;
    let mut runs = |job: &CompareJob<'_>| {
        let compared =
            backend.compare(job, &mut |_| ControlFlow::Continue(()), &mut |_| ControlFlow::Continue(()));
        compared.expect("the device works").runs
    };
    let counters = |run: &Run| run.counters.clone().expect("they were counted");
    assert!(runs(&job).iter().all(|run| counters(run).lists.is_empty()));
    job.lists = true;
    for run in runs(&job) {
        let counters = counters(&run);
        let named: Vec<_> = counters.lists.iter().map(|list| list.cells_of.as_str()).collect();
        let expected: &[&str] = match run.system.as_str() {
            "mmrt" => &["all", "+x", "-x", "+y", "-y", "+z", "-z"],
            "selective" => &["all", "x", "y", "z", "voxels"],
            _ => &[],
        };
        assert_eq!(named, expected, "{}", run.system);
        let Some(all) = counters.lists.first() else { continue };
        assert_eq!(Some(all.entries), counters.fragments, "{all:?}");
        let sum = |field: fn(&ListRecord) -> u64| {
            counters.lists[1..].iter().filter(|list| list.cells_of != "voxels").map(field).sum::<u64>()
        };
        assert_eq!(
            [all.cells, all.layers, all.slots],
            [sum(|list| list.cells), sum(|list| list.layers), sum(|list| list.slots)]
        );
        assert_eq!(all.waste_bytes > 0, run.system == "selective", "only its lists have pages: {all:?}");
        assert_eq!(all.waste_bytes, 8 * (all.slots - all.entries), "a depth and a triangle each");
    }
}

#[test]
fn a_hard_case_has_a_verdict_and_a_wrong_answer_breaks_it() {
    let scale = Scale { rays: RAYS as usize, seed: SEED.into(), full: false };
    let case = rasray_hard_cases::case("E5", scale).expect("a case of the catalogue");
    let systems = systems(&["bricks"]);
    let mut hard = HardJob {
        case: &case,
        systems: &systems,
        repetitions: 1,
        seed: SEED,
        figures: false,
        hits_files: &[],
        keep: true,
        replay: None,
        only: None,
    };
    let mut backend = open(&DeviceChoice::default()).expect("a device");
    let whole = backend.hard(&hard, &mut |_| ControlFlow::Continue(())).expect("the device works");
    let met = |comparison: &Comparison| -> Vec<_> {
        comparison.runs.iter().map(|run| run.hard.as_ref().and_then(|hard| hard.met)).collect()
    };
    assert_eq!(met(&whole), [Some(true)]);
    let mut hits = whole.kept.sets[0].answers[0].hits.clone();
    let found = hits.iter().position(|hit| hit.is_hit()).expect("a ray hits something");
    hits[found].t *= 2.0;
    let given = [HitsFile { name: "given".to_owned(), hits }];
    hard.hits_files = &given;
    let with_given = backend.hard(&hard, &mut |_| ControlFlow::Continue(())).expect("the device works");
    assert_eq!(met(&with_given), [Some(true), Some(false)]);
}

/// Renders an image of one sample per pixel, through a tree.
fn render(name: &str, integrator: (&str, OptionValues), [width, height]: [u32; 2]) -> RenderOutput {
    let mut loaded = load(OsStr::new(name)).expect("a built-in scene");
    loaded.light(None);
    let mut backend = open(&DeviceChoice { validation: true, ..DeviceChoice::default() }).expect("a device");
    let row = IntegratorRow::named(integrator.0).expect("registered");
    let integrator = IntegratorSpec::new(row, &integrator.1).expect("values that are taken");
    let frame = Frame { integrator, width, height, ..job(&loaded, &["bvh"], &[]).frame };
    let job = RenderJob {
        scene: &loaded.scene,
        moment: None,
        camera: default_view(&loaded.scene).camera,
        system: systems(&["bvh"]).remove(0),
        refresh: Refresh::All,
        needs: Needs::of(&loaded.scene, frame.workload()),
        frame,
        shard: None,
        aovs: AovSelection::default(),
        before: None,
        repetitions: 0,
    };
    let mut kept = KeptScene::default();
    backend.render(&job, &mut kept, &mut |_| ControlFlow::Continue(())).expect("the device works")
}

/// Checks the share against the scene, which knows how many pixels show a mirror first, counted when it was
/// made; all other surfaces are Lambertian.
#[test]
fn the_share_of_samples_that_are_traced_on_is_that_of_pixels_with_a_mirror() {
    for (name, expected) in [("mirror-hall:0", 0.0), ("mirror-hall:40", 0.4)] {
        let options = OptionValues::default().with("select", "reflective");
        let counters = render(name, ("whitted", options), [160, 90]).counters.expect("it was counted");
        let share = counters.selected_share.expect("it selects");
        println!("{name}: {share}");
        assert!((share - expected).abs() <= if expected > 0.0 { 0.01 } else { 0.0 }, "{name}: {share}");
    }
}

/// Checks the bytes of the buffers of an image, slot by slot: ray 48, hit 16, traversal 64, lists 16 and
/// surface 128 bytes; per pixel of the film 16; the header of a queue, its two placeholders, and the counters
/// of the film.
#[test]
fn bytes_of_an_image_are_those_of_its_slots_and_pixels() {
    let slots = 32 * 24;
    let output = render("cornell", ("raycast", OptionValues::default()), [32, 24]);
    assert_eq!(output.counters.expect("it was counted").selected_share, None, "nothing is traced on");
    let memory = output.memory.expect("it was counted");
    let bytes = slots * (48 + 16 + 64 + 16 + 128) + 112 + 2 * 16 + 16 * slots + 24;
    assert_eq!(memory.frame_bytes, Some(bytes), "{:?}", memory.by_part);
    assert_eq!(memory.frame_bytes_per_pixel, Some(bytes as f64 / slots as f64));
    let of_image = memory.by_part.iter().filter(|(name, _)| name.starts_with("image "));
    assert_eq!(of_image.map(|(_, bytes)| bytes).sum::<u64>(), bytes);
    assert_eq!(memory.by_part["image surfaces"], 128 * slots);
}

/// Checks that the time of fetching surfaces is separate from the time of shading them, and that buffers for
/// fetching by drawing have bytes of their own.
#[test]
fn fetching_by_drawing_is_a_stage_and_a_part_of_memory() {
    let path = |fetch: &'static str| {
        let options = OptionValues::default().with("fetch", fetch).with("bounces", 1);
        render("cornell", ("path", options), [32, 24])
    };
    let [direct, raster] = ["direct", "raster"].map(path);
    let fetch = |output: &RenderOutput| {
        output.memory.as_ref().and_then(|memory| memory.by_part.get("image fetch").copied())
    };
    assert_eq!(fetch(&direct), None);
    assert!(fetch(&raster) > Some(0));
    let added = raster
        .memory
        .as_ref()
        .and_then(|memory| memory.frame_bytes)
        .zip(direct.memory.and_then(|memory| memory.frame_bytes));
    assert_eq!(added.map(|(raster, direct)| raster - direct), fetch(&raster));
    let stages =
        |output: &RenderOutput| output.stages.iter().map(|stage| stage.stage.clone()).collect::<Vec<_>>();
    for stage in ["surfaces", "shade"] {
        assert!(stages(&raster).iter().any(|found| found == stage), "{:?}", stages(&raster));
    }
    let drawn: Vec<_> = raster.passes.iter().filter(|pass| pass.label.contains("fetch")).collect();
    assert!(drawn.len() >= 2, "{:?}", raster.passes);
    assert!(drawn.iter().all(|pass| pass.stage.as_deref() == Some("surfaces")), "{drawn:?}");
}

/// Checks pictures after any job before: at another moment, of another size, seed, share, system or part that
/// is built.
#[test]
fn pictures_do_not_depend_on_what_was_kept() {
    let mut loaded = load(OsStr::new("walker:8k")).expect("a built-in scene");
    loaded.show(0.0, None).expect("it moves");
    loaded.light(None);
    let mut backend = open(&DeviceChoice { validation: true, ..DeviceChoice::default() }).expect("a device");
    let frame = Frame {
        integrator: IntegratorRow::named("path").expect("registered").into(),
        spp: 2,
        ..job(&loaded, &["bvh"], &[]).frame
    };
    let camera = default_view(&loaded.scene).camera;
    let small = Frame { width: 24, height: 16, ..frame.clone() };
    let reseeded = Frame { seed: 3, ..small.clone() };
    let second = Shard::new(2, 2);
    let (all, moving, objects) = (Refresh::All, Refresh::Moving, Refresh::Objects);
    let mut kept = KeptScene::default();
    let mut kept_kernels = 0;
    for (seconds, system, frame, shard, refresh) in [
        (0.0, "bvh", &frame, None, all),
        (0.5, "bvh", &frame, None, all),
        (0.5, "bvh", &small, None, all),
        (0.75, "bvh", &small, second, all),
        (0.75, "bvh", &reseeded, second, all),
        (1.0, "bvh", &small, None, moving),
        (1.25, "bvh", &small, None, moving),
        (1.25, "brute-force", &small, None, moving),
        // The hits of this system are of fragments.
        (1.25, "hu", &small, None, moving),
        (1.5, "bvh", &small, None, objects),
        (1.75, "bvh", &small, None, objects),
    ] {
        loaded.show(seconds, None).expect("it moves");
        // Nothing has moved since the frame before, but the structure that was built is that of another
        // frame.
        let step = if refresh == objects { 0.0 } else { 0.04 };
        let before =
            Moment { seconds: seconds - step, clips: loaded.moment.clone().expect("it is posed").clips };
        let job = RenderJob {
            scene: &loaded.scene,
            moment: loaded.moment.as_ref(),
            camera: camera.clone(),
            system: systems(&[system]).remove(0),
            refresh,
            frame: frame.clone(),
            shard,
            aovs: AovSelection::from_iter([Aov::Depth, Aov::Motion, Aov::Variance]),
            before: Some(FrameBefore { moment: before, camera: camera.clone() }),
            needs: Needs::of(&loaded.scene, frame.workload()),
            repetitions: 0,
        };
        let mut render = |kept: &mut KeptScene| {
            backend.render(&job, kept, &mut |_| ControlFlow::Continue(())).expect("the device works")
        };
        let (after, fresh) = (render(&mut kept), render(&mut KeptScene::default()));
        let bits =
            |pixels: &[[f32; 3]]| pixels.iter().map(|pixel| pixel.map(f32::to_bits)).collect::<Vec<_>>();
        assert_eq!(bits(&after.beauty), bits(&fresh.beauty), "{system} at {seconds} s");
        assert_eq!((&after.sums, &after.aovs), (&fresh.sums, &fresh.aovs), "{system} at {seconds} s");
        assert!(after.beauty.iter().flatten().any(|value| *value > 0.0));
        kept_kernels += u32::from(after.times.first_use_ms.is_none());
        assert!(fresh.times.first_use_ms.is_some());
    }
    // The kernels are kept at 0.5 s, at 1.25 s and at 1.75 s.
    assert_eq!(kept_kernels, 3);
}

/// Checks that an option which asks for a missing feature of the device gives an error of the job that names
/// the option.
#[test]
fn an_option_whose_feature_the_device_lacks_is_to_be_left_out() {
    let mut loaded = load(OsStr::new("cornell")).expect("a built-in scene");
    loaded.light(None);
    let mut backend = open(&DeviceChoice::default()).expect("a device");
    let mut job = job(&loaded, &["dirt"], &[RaySet::Incoherent]);
    let extension = OptionValues::default().with("coverage", Value::Word("conservative-extension"));
    let dirt = System::named("dirt").expect("a system of the registry");
    job.systems = vec![SystemConfig::new(dirt, Preset::Robust, extension)];
    let goes_on = || ControlFlow::Continue(());
    match backend.compare(&job, &mut |_| goes_on(), &mut |_| goes_on()) {
        Ok(_) => println!("skipped: the device has VK_EXT_conservative_rasterization"),
        Err(error) => {
            assert!(
                matches!(error, ExperimentError::OptionNeedsFeature { option: "coverage", .. }),
                "{error:?}"
            );
            assert!(error.to_string().contains("VK_EXT_conservative_rasterization"), "{error}");
        }
    }
}
