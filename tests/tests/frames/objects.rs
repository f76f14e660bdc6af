//! Objects in depth cubes of their own, which are built once: hits of every frame are those of brute force,
//! and stored fragments are where their objects are.

use glam::{DVec3, Vec3};
use rasray_ads::{Combined, Counters, Domain, GeometryRigid, PRIMITIVE_UNKNOWN, Ray, RayQueue, Trace};
use rasray_gpu_scene::{GpuScene, Parts, PosePass, SceneTables};
use rasray_scene::animation::ChannelValues;
use rasray_scene::{Moment, Scene};

use rasray_systems::Spec;
use rasray_tests::harness::Bench;
use rasray_tests::random::Random;
use rasray_tests::tier::is_full;
use rasray_tracer::Refresh;

use crate::frames::kept::{Kept, Recorded};
use crate::frames::refresh::{header, rays};
use crate::frames::scenes::{hall_of_objects, view};

/// Parts built anew in a frame.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Anew {
    All,
    Moving,
    /// Objects that moved.
    Objects,
    /// Nothing of objects, which have cubes in spaces of their own.
    Deforming,
}

/// Sums over frames.
#[derive(Clone, Debug, Default)]
struct Walked {
    /// Builds of parts after the first frame.
    builds: u64,
    /// Those of the first frame, also of pools that grew.
    first: u64,
    /// Memory of all pools.
    bytes: u64,
    /// Cells, entries and tests per ray.
    work: [f64; 3],
    /// Recorded for a trace of nearest hits.
    dispatches: u32,
    /// Bounds on shifts of objects' corners by rounding, in the last frame.
    errors: Vec<f32>,
}

fn spec(preset: &str, options: &[(&str, &str)]) -> Spec {
    let given = options.iter().map(|(name, value)| ((*name).to_owned(), (*value).to_owned()));
    Spec::new("ldc", preset, given).expect("the options are the system's").with_counters(Counters::Sums)
}

/// Hits and work of the rays of a frame.
struct Held {
    hits: usize,
    /// Cells, entries and tests.
    work: [u64; 3],
}

/// The structure and brute force in a frame.
struct Frame<'a> {
    bench: &'a Bench,
    number: usize,
    kept: &'a Kept,
    brute: &'a Kept,
}

impl Frame<'_> {
    /// Holds that hits are those of brute force, bit for bit.
    fn hold_hits(&self, rays: &[Ray]) -> Held {
        let (expected, answered) =
            (self.brute.answers(self.bench, rays), self.kept.answers(self.bench, rays));
        let is_other = |at: &usize| expected.0[*at] != answered.0[*at] || expected.1[*at] != answered.1[*at];
        let differs = (0..rays.len()).find(is_other);
        assert_eq!(differs, None, "frame {}: {:?}", self.number, differs.map(|at| rays[at]));
        let hits = expected.0.iter().filter(|hit| hit[1] != u32::MAX).count();
        Held { hits, work: answered.2 }
    }
}

/// Frames of a scene through a structure that builds what it has to, each held against brute force.
fn walk(
    bench: &Bench,
    scene: &Scene,
    times: &[f64],
    spec: &Spec,
    anew: Anew,
    hold: &mut dyn FnMut(&Frame<'_>, &[Ray]) -> Held,
) -> Walked {
    let device = bench.device();
    let tables = SceneTables::new(scene, DVec3::ZERO, &Parts::ALL).expect("the scene is whole");
    let gpu = GpuScene::upload(device, &tables, &view(scene, [16, 16], 0.0)).expect("it fits");
    let mut pass = PosePass::new(device, scene, &tables, &gpu).expect("it fits");
    let parts = match anew {
        Anew::All => None,
        Anew::Moving => Some(pass.parts(device).expect("it fits")),
        Anew::Objects => Some(pass.objects(device, None, 32).expect("it fits")),
        Anew::Deforming => Some(pass.objects(device, Some(scene), 32).expect("it fits")),
    };
    let binding = Some(gpu.binding());
    let structure: Refresh = match &parts {
        None => spec.create(device, gpu.geometry(), binding).expect("the options are valid").into(),
        Some(parts) => {
            Combined::new(parts, |part| spec.create(device, part, binding)).expect("it fits").into()
        }
    };
    let mut kept = Kept::new(bench, structure);
    let brute = Spec::new("brute-force", "robust", []).expect("it has no options");
    let mut brute = Kept::new(bench, brute.create(device, gpu.geometry(), binding).expect("it fits"));
    let mut random = Random::new(83);
    let (mut walked, mut before, mut traced, mut hit) = (Walked::default(), None, 0, 0);
    for (frame, &seconds) in times.iter().enumerate() {
        let posed = pass.frame(scene, &Moment { seconds, clips: vec![0] }).expect("it is the same scene");
        device.submit(|recorder| pass.record(recorder, 0, &posed)).expect("the device works");
        match before.as_ref().filter(|_| anew != Anew::Moving) {
            Some(before) => kept.frames.parts_moved(&pass.moved_parts(before, &posed)),
            None => kept.frames.geometry_moved(),
        }
        before = Some(posed);
        brute.frames.geometry_moved();
        kept.build(bench, gpu.viewpoint());
        brute.build(bench, gpu.viewpoint());
        if frame == 0 {
            walked.first = kept.frames.counts().part_builds;
        }
        let towards =
            parts.as_ref().map_or(gpu.geometry(), |parts| &parts.parts()[1 + frame % parts.moving().len()]);
        let [all, towards] = [gpu.geometry(), towards].map(|part| {
            let header = header(bench, part.header());
            [header.lower, header.upper]
        });
        // The first are the same whatever is built anew.
        let aimed = [all, towards].map(|towards| rays(&mut random, all, towards));
        for (place, rays) in aimed.iter().enumerate() {
            let Held { hits, work } = hold(&Frame { bench, number: frame, kept: &kept, brute: &brute }, rays);
            if place == 0 {
                hit += hits;
                traced += rays.len();
                walked.work.iter_mut().zip(work).for_each(|(sum, counted)| *sum += counted as f64);
            }
        }
    }
    assert!(8 * hit > traced, "{hit} hits of {traced} rays");
    walked.work = walked.work.map(|sum| sum / traced as f64);
    walked.builds = kept.frames.counts().part_builds - walked.first;
    walked.bytes = kept.frames.structure().sizes().bytes();
    let queue = RayQueue::new(device, "rays", 1, false).expect("a queue fits");
    let structure = kept.frames.structure();
    let recorded = device.submit(|recorder| {
        structure.record_trace(recorder, &queue, Trace::closest(Domain::First(1)));
        Recorded::of(recorder.passes())
    });
    walked.dispatches = recorded.expect("the device works").value.dispatches;
    if anew == Anew::Deforming {
        let moving = parts.iter().flat_map(|parts| &parts.parts()[1..]);
        let error = |part: &rasray_ads::Geometry| {
            let place = part.header().size() - size_of::<GeometryRigid>() as u64;
            device.download_as::<GeometryRigid>(part.header(), place, 1).expect("the device works")[0].error
        };
        walked.errors = moving.map(error).collect();
    }
    walked
}

#[test]
fn cubes_of_objects_are_built_once() {
    let bench = Bench::new();
    let scene = hall_of_objects();
    let count = if is_full() { 60 } else { 8 };
    let times: Vec<f64> = (0..count).map(|frame| 2.2 * f64::from(frame) / f64::from(count)).collect();
    let spec = spec("robust", &[("resolution", "96")]);
    for anew in [Anew::All, Anew::Moving, Anew::Objects, Anew::Deforming] {
        let walked = walk(&bench, &scene, &times, &spec, anew, &mut |frame, rays| frame.hold_hits(rays));
        println!("{anew:?}, {count} frames: {walked:?}");
        if anew == Anew::Deforming {
            assert_eq!(walked.builds, 0, "{walked:?}");
            assert!(walked.errors.iter().all(|error| *error < 1.0e-4), "{walked:?}");
        } else {
            assert!(walked.builds >= 4, "{walked:?}");
        }
    }
}

/// Where rounding may move corners farther than cells take them in, all triangles of an object are tested.
#[test]
fn objects_far_smaller_than_their_meshes_keep_their_hits() {
    let bench = Bench::new();
    let mut scene = hall_of_objects();
    for channel in &mut scene.animation.rig.clips[0].channels {
        match &mut channel.values {
            ChannelValues::Scale(values) if channel.node == 4 => values[1] = [1.0e-4, -2.0e-4, 1.0e-4],
            ChannelValues::Translation(values) if channel.node == 4 => values[1] = [200.0, 10.0, 0.0],
            _ => {}
        }
    }
    let spec = spec("robust", &[("resolution", "32")]);
    let walked = walk(&bench, &scene, &[0.0, 0.7, 1.4], &spec, Anew::Deforming, &mut |frame, rays| {
        frame.hold_hits(rays)
    });
    println!("{walked:?}");
    assert_eq!(walked.builds, 0, "{walked:?}");
    assert!(walked.errors.iter().any(|error| *error > 1.0e-2), "{walked:?}");
}

/// Counts of hits of stored fragments.
#[derive(Clone, Copy, Debug, Default)]
struct Stored {
    rays: u32,
    /// Hit or missed where brute force does not, or farther than a few cells from there.
    wrong: u32,
    /// Others, of fragments that keep normals.
    right: u32,
    /// Those of `right` whose normals are more than 5 degrees off.
    turned: u32,
}

impl Stored {
    fn add(&mut self, frame: &Frame<'_>, rays: &[Ray]) -> Held {
        const CLOSE: f32 = 0.2;
        let of = |kept: &Kept| frame.bench.surfaces(kept.frames.structure(), rays);
        let (expected, answered) = (of(frame.brute), of(frame.kept));
        let mut hits = 0;
        for (ray, ((true_hit, truth), (hit, surface))) in rays.iter().zip(expected.iter().zip(&answered)) {
            let is_hit = true_hit.primitive != u32::MAX;
            let off = (hit.t - true_hit.t).abs() * Vec3::from(ray.direction).length();
            self.rays += 1;
            hits += usize::from(is_hit);
            if is_hit != (hit.primitive != u32::MAX) || (is_hit && off > CLOSE) {
                self.wrong += 1;
            } else if hit.primitive == PRIMITIVE_UNKNOWN {
                self.right += 1;
                let cosine = Vec3::from(truth.normal).dot(Vec3::from(surface.normal)).abs();
                self.turned += u32::from(cosine < 5.0_f32.to_radians().cos());
            }
        }
        Held { hits, work: [0; 3] }
    }
}

#[test]
fn fragments_turn_with_their_objects() {
    let bench = Bench::new();
    let scene = hall_of_objects();
    let times: Vec<f64> = (0..4).map(|frame| 0.6 * f64::from(frame)).collect();
    for options in [&[][..], &[("accept", "slope"), ("payload", "index"), ("coverage", "conservative")]] {
        let spec = spec("published", &[&[("resolution", "256")], options].concat());
        let [posed, own] = [Anew::Objects, Anew::Deforming].map(|anew| {
            let mut stored = Stored::default();
            let walked =
                walk(&bench, &scene, &times, &spec, anew, &mut |frame, rays| stored.add(frame, rays));
            println!("{options:?}, {anew:?}: {stored:?}, {walked:?}");
            assert_eq!(walked.builds == 0, anew == Anew::Deforming, "{walked:?}");
            stored
        });
        assert!(own.wrong <= posed.wrong + own.rays / 200, "{options:?}: {own:?}, as posed {posed:?}");
        assert!(own.turned <= posed.turned + own.right / 200, "{options:?}: {own:?}, as posed {posed:?}");
        // Rays do not fall back on triangles.
        assert!(own.right >= posed.right - posed.right / 10, "{options:?}: {own:?}, as posed {posed:?}");
    }
}

/// A cube is built where no map says how its object is posed: fragments keep their triangles.
#[test]
fn fragments_of_objects_that_grow_from_nothing_are_where_they_are() {
    let bench = Bench::new();
    let mut scene = hall_of_objects();
    for channel in &mut scene.animation.rig.clips[0].channels {
        if let ChannelValues::Scale(values) = &mut channel.values {
            values[0] = [0.0; 3];
        }
    }
    let spec = spec("published", &[("resolution", "256")]);
    let mut stored = Stored::default();
    let walked = walk(&bench, &scene, &[0.0, 0.45, 2.0], &spec, Anew::Deforming, &mut |frame, rays| {
        stored.add(frame, rays)
    });
    println!("{stored:?}, {walked:?}");
    assert_eq!(walked.builds, 0, "{walked:?}");
    assert!(12 * stored.wrong < stored.rays && 10 * stored.turned < stored.right, "{stored:?}");
}
