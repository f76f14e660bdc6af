//! Structures that do not find every triangle, in parts: hits are the nearer of those that each part alone
//! has, and what is shaded is the fragment that was hit.

use std::ops::{ControlFlow, Range};

use glam::DVec3;
use rasray_ads::{
    Combined, Counters, Geometry, Hit, MovingPart, PRIMITIVE_NONE, PRIMITIVE_UNKNOWN, Ray, Structure,
    StructureKind, Surface, Viewpoint,
};
use rasray_frame::{FrameInput, FrameRenderer, render_in_order};
use rasray_gpu::Timing;
use rasray_gpu_scene::{GpuScene, Parts, PosePass, Sampling, SceneTables};
use rasray_integrators::{Film, IntegratorDesc, Path};
use rasray_scene::{Moment, Scene};
use rasray_shaders_glsl::constants::contract::{HIT_EARLIER, HIT_STORED};
use rasray_systems::Spec;
use rasray_tests::harness::{Bench, bits_of_any_build};
use rasray_tests::invariance::Subject;
use rasray_tests::random::Random;
use rasray_tests::shapes::Triangle;
use rasray_tests::tier::{first, is_full};
use rasray_tracer::{FrameSettings, build_until_complete};

use crate::frames::kept::{Kept, Recorded};
use crate::frames::parts::{bounds, divisions, doubled, many, rays};
use crate::frames::refresh::{header, rays as rays_towards};
use crate::frames::scenes::{among, made, swinging_hall, third, view};

/// Presets whose hits in parts may differ from those of one structure.
fn that_may_differ() -> Vec<Subject> {
    Subject::all().into_iter().filter(|subject| subject.kind != StructureKind::Primitive).collect()
}

/// True if a hit lies on its triangle, not only on the plane of it.
fn is_inside(hit: &Hit) -> bool {
    hit.a >= 0.0 && hit.b >= 0.0 && hit.a + hit.b <= 1.000_001
}

/// True if a hit is on a stored fragment, with or without the id of its triangle.
fn is_stored(hit: &Hit) -> bool {
    hit.is_hit() && (hit.primitive == PRIMITIVE_UNKNOWN || hit.b.to_bits() == HIT_STORED)
}

/// The nearer of what both parts alone have; where they are as near a triangle before a stored fragment, the
/// one that is on its triangle, then the one with the lower id; of two stored fragments the static one.
fn nearer<'a>(of_static: &'a Hit, of_moving: &'a Hit) -> &'a Hit {
    match (of_static.is_hit(), of_moving.is_hit()) {
        (_, false) => of_static,
        (false, true) => of_moving,
        (true, true) => {
            let rank = |hit: &Hit| match is_stored(hit) {
                true => (hit.t.to_bits(), true, true, 0),
                false => (hit.t.to_bits(), false, !is_inside(hit), hit.primitive),
            };
            if rank(of_moving) < rank(of_static) { of_moving } else { of_static }
        }
    }
}

/// A part of triangles as a geometry of its own, which knows nothing of the whole, and the ids that its
/// triangles have there.
struct Alone {
    geometry: Geometry,
    ids: Vec<u32>,
}

impl Alone {
    fn new(bench: &Bench, triangles: &[Triangle], moving: &[Range<u32>], of_moving: bool) -> Self {
        let is_moving = |id: &u32| moving.iter().any(|ids| ids.contains(id));
        let ids: Vec<u32> = (0..triangles.len() as u32).filter(|id| is_moving(id) == of_moving).collect();
        let own: Vec<Triangle> = ids.iter().map(|id| triangles[*id as usize]).collect();
        Self { geometry: bench.geometry(&own), ids }
    }

    /// Hits of its structure, by the ids of the whole.
    fn hits(&self, bench: &Bench, subject: &Subject, eye: [f32; 3], rays: &[Ray]) -> (Vec<Hit>, Vec<bool>) {
        let number = |id: u32| self.ids.binary_search(&id).map_or(PRIMITIVE_NONE, |at| at as u32);
        let own = |ray: &Ray| Ray { exclude_primitive: number(ray.exclude_primitive), ..*ray };
        let rays: Vec<Ray> = rays.iter().map(own).collect();
        let mut structure = subject.structure(bench, &self.geometry);
        let mut hits = bench.build_and_trace(structure.as_mut(), eye, &rays);
        for hit in &mut hits {
            hit.primitive = self.ids.get(hit.primitive as usize).copied().unwrap_or(hit.primitive);
        }
        (hits, bench.occluded(structure.as_ref(), &rays))
    }
}

#[test]
fn hits_are_the_nearer_of_both_parts() {
    let bench = Bench::new();
    let mut random = Random::new(37);
    let triangles = doubled(&mut random);
    let rays = rays(&mut random, &triangles);
    let whole = bench.geometry(&triangles);
    let eye = [0.5; 3];
    let mut names = Vec::new();
    for subject in that_may_differ() {
        let name = subject.name();
        // Rays pause often with so little to spend.
        let paused = Subject { spec: subject.spec.clone().with_work_budget(7), kind: subject.kind };
        let (mut ties, mut of_parts) = (0, [0; 2]);
        for (which, moving) in divisions(triangles.len() as u32) {
            let bounds = [false, true].map(|of_moving| bounds(&triangles, &moving, of_moving));
            let parts = whole.parts(bench.device(), &moving, bounds).expect("they are parts");
            let [of_static, of_moving] = [false, true].map(|of_moving| {
                Alone::new(&bench, &triangles, &moving, of_moving).hits(&bench, &subject, eye, &rays)
            });
            for subject in [&subject, &paused] {
                let make = |part: &Geometry| subject.spec.create(bench.device(), part, None);
                let mut structure = Combined::new(&parts, make).expect("any structure can be in parts");
                let found = bench.build_and_trace(&mut structure, eye, &rays);
                let occluded = bench.occluded(&structure, &rays);
                for (at, found) in found.iter().enumerate() {
                    let (own_static, own_moving) = (&of_static.0[at], &of_moving.0[at]);
                    let expected = nearer(own_static, own_moving);
                    assert_eq!(
                        bits_of_any_build(found),
                        bits_of_any_build(expected),
                        "{name}, {which} move: {:?}, {own_static:?}, {own_moving:?}",
                        rays[at]
                    );
                    assert_eq!(
                        occluded[at],
                        of_static.1[at] || of_moving.1[at],
                        "{name}, {which}: {:?}",
                        rays[at]
                    );
                    ties += usize::from(found.is_hit() && own_static.t == own_moving.t);
                    of_parts[0] += usize::from(found.is_hit() && found.t == own_static.t);
                    of_parts[1] += usize::from(found.is_hit() && found.t == own_moving.t);
                }
            }
        }
        println!("{name}: {of_parts:?} hits in the static and the moving part, {ties} as near in both");
        assert!(of_parts.iter().all(|hits| *hits > 100), "{name}: {of_parts:?}");
        names.push(subject.spec.system().name);
    }
    for system in ["mmrt", "hu", "selective", "ldc"] {
        assert!(names.contains(&system), "{system} is not among {names:?}");
    }
}

/// The nearest of what each of many parts alone has.
#[test]
fn hits_are_the_nearest_of_many_parts() {
    let bench = Bench::new();
    let mut random = Random::new(71);
    let triangles = doubled(&mut random);
    let rays = rays(&mut random, &triangles);
    let whole = bench.geometry(&triangles);
    let eye = [0.5; 3];
    let moving = many(triangles.len() as u32);
    let all = moving.concat();
    let of = |ids: &Vec<Range<u32>>| MovingPart {
        ids: ids.clone(),
        bounds: bounds(&triangles, ids, true),
        rest: None,
    };
    let moving_parts: Vec<MovingPart> = moving.iter().map(of).collect();
    let parts = whole.in_parts(bench.device(), &moving_parts, bounds(&triangles, &all, false));
    let parts = parts.expect("they are parts");
    for subject in first(&that_may_differ(), 3) {
        let name = subject.name();
        let alone = std::iter::once((&all, false)).chain(moving.iter().map(|ids| (ids, true)));
        let alone: Vec<(Vec<Hit>, Vec<bool>)> = alone
            .map(|(ids, inside)| {
                Alone::new(&bench, &triangles, ids, inside).hits(&bench, subject, eye, &rays)
            })
            .collect();
        let make = |part: &Geometry| subject.spec.create(bench.device(), part, None);
        let mut structure = Combined::new(&parts, make).expect("any structure can be in parts");
        let found = bench.build_and_trace(&mut structure, eye, &rays);
        let occluded = bench.occluded(&structure, &rays);
        let mut of_parts = vec![0; alone.len()];
        for (at, hit) in found.iter().enumerate() {
            let expected = alone.iter().map(|part| &part.0[at]).reduce(nearer).expect("there are parts");
            assert_eq!(bits_of_any_build(hit), bits_of_any_build(expected), "{name}: {:?}", rays[at]);
            assert_eq!(occluded[at], alone.iter().any(|part| part.1[at]), "{name}: {:?}", rays[at]);
            let own = alone.iter().position(|part| std::ptr::eq(&part.0[at], expected));
            of_parts[own.expect("it is of one")] += usize::from(hit.is_hit());
        }
        println!("{name}: {of_parts:?} hits in the parts");
        let hit = |part: usize| of_parts[part] > 5;
        assert!([0, 1, 2, 4, 5].into_iter().all(hit) && of_parts[3] == 0, "{name}: {of_parts:?}");
    }
}

/// Payloads of the papers, with and without the ids of triangles, and what finds planes.
fn payloads() -> Vec<Spec> {
    let spec = |system: &str, preset: &str, options: &[(&str, &str)]| {
        let given = options.iter().map(|(name, value)| ((*name).to_owned(), (*value).to_owned()));
        Spec::new(system, preset, given).expect("the options are the system's")
    };
    vec![
        spec("ldc", "published", &[("resolution", "96")]),
        spec("selective", "published", &[("resolution", "96"), ("grid", "24")]),
        spec("mmrt", "published", &[("resolution", "64"), ("capacity", "400000")]),
        spec("hu", "published", &[("resolution", "96")]),
        spec("ldc", "published", &[("resolution", "96"), ("ids", "on")]),
        spec("hu", "robust", &[("resolution", "96"), ("coverage", "exact")]),
        spec("mmrt", "robust", &[("resolution", "64"), ("coverage", "exact")]),
        spec(
            "selective",
            "robust",
            &[("resolution", "96"), ("grid", "24"), ("coverage", "exact"), ("storage", "paged")],
        ),
        spec("ldc", "robust", &[("resolution", "96"), ("accept", "plane")]),
        spec("hu", "robust", &[("leaves", "voxels"), ("resolution", "48")]),
    ]
}

fn built(
    bench: &Bench,
    spec: &Spec,
    part: &Geometry,
    scene: &GpuScene,
    from: Viewpoint,
) -> Box<dyn Structure> {
    let mut structure =
        spec.create(bench.device(), part, Some(scene.binding())).expect("the options are valid");
    build_until_complete(bench.device(), structure.as_mut(), from, Timing::None).expect("it is built");
    structure
}

/// Values of a surface that are the same in every build: where hits are triangles it is known as well as the
/// coarser part says.
fn shaded(surface: &Surface, is_stored: bool) -> Vec<u8> {
    let error = if is_stored { surface.position_error } else { 0.0 };
    bytemuck::bytes_of(&Surface { position_error: error, ..*surface }).to_vec()
}

/// Hits and surfaces of frames in which only the moving part is built are those of the nearer of two
/// structures that are made for each frame.
fn hold(bench: &Bench, name: &str, scene: &Scene, times: &[f64], specs: &[Spec]) {
    let device = bench.device();
    let tables = SceneTables::new(scene, DVec3::ZERO, &Parts::ALL).expect("the scene is whole");
    let gpu = GpuScene::upload(device, &tables, &view(scene, [16, 16], 0.0)).expect("it fits");
    let mut pass = PosePass::new(device, scene, &tables, &gpu).expect("it fits");
    let parts = pass.parts(device).expect("it fits");
    let viewpoint = gpu.viewpoint();
    for spec in specs {
        let system = format!("{name}, {} {}", spec.system().name, spec.preset().name());
        let make = |part: &Geometry| spec.create(device, part, Some(gpu.binding()));
        let combined = Combined::new(&parts, make).expect("any structure can be in parts");
        let mut kept = Kept::new(bench, combined);
        let mut random = Random::new(41);
        let (mut of_parts, mut stored, mut recorded) = ([0; 2], [0; 2], Vec::new());
        let mut static_builds = 0;
        for (frame, &seconds) in times.iter().enumerate() {
            let moment = Moment { seconds, clips: vec![0] };
            let posed = pass.frame(scene, &moment).expect("it is the same scene");
            device.submit(|recorder| pass.record(recorder, 0, &posed)).expect("the device works");
            kept.frames.geometry_moved();
            recorded.push(kept.build(bench, viewpoint).dispatches);
            let counts = kept.frames.counts();
            if frame == 0 {
                static_builds = counts.static_builds;
            }
            assert_eq!(counts.static_builds, static_builds, "{system}: the static part is built once");
            let alone = [parts.static_part(), &parts.parts()[1]]
                .map(|part| built(bench, spec, part, &gpu, viewpoint));
            let [all, of_moving] = [gpu.geometry(), &parts.parts()[1]].map(|part| {
                let header = header(bench, part.header());
                [header.lower, header.upper]
            });
            let rays = rays_towards(&mut random, all, of_moving);
            let found = bench.surfaces(kept.frames.structure(), &rays);
            let [of_static, of_moving] = alone.each_ref().map(|alone| bench.surfaces(alone.as_ref(), &rays));
            for (at, (hit, surface)) in found.iter().enumerate() {
                let ray = &rays[at];
                let expected = nearer(&of_static[at].0, &of_moving[at].0);
                let is_static = std::ptr::eq(expected, &of_static[at].0);
                let own = if is_static { &of_static[at] } else { &of_moving[at] };
                let known = |hit: &Hit| (hit.t.to_bits(), hit.primitive);
                assert_eq!(known(hit), known(expected), "{system}, frame {frame}: {ray:?}");
                // In a stored fragment's hit b says which part it is in.
                let is_stored = is_stored(&own.0);
                assert_eq!(hit.b.to_bits() == HIT_EARLIER, is_stored && is_static, "{system}: {hit:?}");
                assert_eq!(
                    shaded(surface, is_stored),
                    shaded(&own.1, is_stored),
                    "{system}, frame {frame}: {ray:?}, {hit:?}: {surface:?} is not {:?}",
                    own.1
                );
                assert!(surface.position_error >= own.1.position_error, "{system}: {surface:?}");
                of_parts[usize::from(!is_static)] += usize::from(hit.is_hit());
                stored[usize::from(!is_static)] += usize::from(is_stored);
            }
        }
        println!(
            "{system}: {of_parts:?} hits in both parts, {stored:?} of stored fragments; dispatches {recorded:?}, \
             {:?}",
            kept.frames.counts()
        );
        assert!(of_parts.iter().all(|hits| *hits > 30), "{system}: {of_parts:?}");
    }
}

#[test]
fn a_figure_of_fragments_walks_on_ground_that_is_built_once() {
    let bench = Bench::new();
    let hall = among(made("walker:8k"), &made("atrium:detail=0.25"));
    hold(&bench, "walker:8k in atrium", &hall, &[0.0, 0.9, 1.8], first(&payloads(), 4));
}

#[test]
fn fragments_of_a_hall_swing_with_masks() {
    let bench = Bench::new();
    hold(&bench, "every third", &swinging_hall(third), &[0.0, 0.3, 0.7], &payloads());
}

/// Rays that hit another place than exact ones, by more than this, metres.
const PLACE: f32 = 0.02;

/// Hits of two structures, each with cells around its own part, beside those of one over all: where rays err,
/// and what a frame builds.
fn compare(bench: &Bench, name: &str, scene: &Scene) {
    let device = bench.device();
    let tables = SceneTables::new(scene, DVec3::ZERO, &Parts::ALL).expect("the scene is whole");
    let gpu = GpuScene::upload(device, &tables, &view(scene, [16, 16], 0.0)).expect("it fits");
    let mut pass = PosePass::new(device, scene, &tables, &gpu).expect("it fits");
    let parts = pass.parts(device).expect("it fits");
    let counts = [&parts.parts()[1], gpu.geometry()].map(Geometry::triangle_count);
    println!("{name}: {} of {} triangles move", counts[0], counts[1]);
    let pose = |seconds: f64| {
        let posed = pass.frame(scene, &Moment { seconds, clips: vec![0] }).expect("it is the same scene");
        device.submit(|recorder| pass.record(recorder, 0, &posed)).expect("the device works");
    };
    let viewpoint = gpu.viewpoint();
    let robust = |system: &str, options: &[(&str, &str)]| {
        let given = options.iter().map(|(name, value)| ((*name).to_owned(), (*value).to_owned()));
        Spec::new(system, "robust", given).expect("the options are the system's")
    };
    // Where cells keep all that reaches into them rays find every triangle: here they keep fragments alone.
    let of_fragments: [(&str, &[(&str, &str)]); 4] = [
        ("mmrt", &[("coverage", "exact"), ("march", "exact"), ("storage", "dllb")]),
        ("hu", &[("coverage", "exact")]),
        ("selective", &[("coverage", "exact"), ("storage", "paged")]),
        ("ldc", &[("accept", "plane")]),
    ];
    for (system, options) in of_fragments {
        let given = [("resolution", "192")].into_iter().chain(options.iter().copied()).collect::<Vec<_>>();
        let spec = robust(system, &given).with_counters(Counters::Sums);
        let make = |part: &Geometry| spec.create(device, part, Some(gpu.binding()));
        let whole = make(gpu.geometry()).expect("the options are valid");
        let combined = Combined::new(&parts, make).expect("any structure can be in parts");
        let mut kept = [Kept::new(bench, whole), Kept::new(bench, combined)];
        let mut recorded = [Recorded::default(); 2];
        for seconds in [0.0, 0.5, 0.9] {
            pose(seconds);
            for (kept, recorded) in kept.iter_mut().zip(&mut recorded) {
                kept.frames.geometry_moved();
                *recorded = kept.build(bench, viewpoint);
            }
        }
        let [all, of_moving] = [gpu.geometry(), &parts.parts()[1]].map(|part| {
            let header = header(bench, part.header());
            [header.lower, header.upper]
        });
        let mut random = Random::new(43);
        let rays: Vec<Ray> = (0..6).flat_map(|_| rays_towards(&mut random, all, of_moving)).collect();
        let exact = built(bench, &robust("bvh", &[]), gpu.geometry(), &gpu, viewpoint);
        let truth = bench.trace(exact.as_ref(), &rays).hits;
        let found = kept.each_ref().map(|kept| {
            let traced = bench.trace(kept.frames.structure(), &rays);
            let is_wrong = |at: &usize| {
                let (hit, exact) = (&traced.hits[*at], &truth[*at]);
                let length = rays[*at].direction.iter().map(|part| part * part).sum::<f32>().sqrt();
                hit.is_hit() != exact.is_hit() || hit.is_hit() && (hit.t - exact.t).abs() * length > PLACE
            };
            let counters = traced.counters;
            let work = [counters.cells, counters.entries, counters.tests];
            ((0..rays.len()).filter(is_wrong).count(), work.map(|sum| sum as f64 / rays.len() as f64))
        });
        let [(of_whole, work), (of_parts, work_in_parts)] = found;
        println!("{system}: {of_whole} of {} rays err in one structure, {of_parts} in parts", rays.len());
        println!("  the last build of all, and of what moves: {recorded:?}");
        println!("  cells, entries and tests per ray {work:.1?}, {work_in_parts:.1?}");
        println!("  bytes {:?}", kept.each_ref().map(|kept| kept.frames.structure().sizes().bytes()));
        println!("  {:?}", kept[1].frames.counts());
        if is_full() {
            let seconds = kept.each_mut().map(|kept| kept.timed(bench, viewpoint));
            println!("  processor time of a build {seconds:.4?} s");
        }
        // A hundredth of the rays is what the two may differ by where each errs elsewhere.
        assert!(of_parts <= of_whole + rays.len() / 100, "{name}, {system}: {of_whole}, {of_parts}");
    }
}

#[test]
fn parts_err_no_more_than_a_whole() {
    let bench = Bench::new();
    compare(&bench, "walker:8k in atrium", &among(made("walker:8k"), &made("atrium:detail=0.25")));
    if is_full() {
        compare(&bench, "walker:30k", &made("walker:30k"));
    }
}

/// Pictures of frames of which three are in flight are those of one at a time, with light that is scattered
/// from surfaces that fragments of either part store.
#[test]
fn pictures_in_flight_are_those_of_one_at_a_time() {
    let bench = Bench::new();
    let (device, scene, size) = (bench.device(), swinging_hall(third), [20, 12]);
    let pictures = |spec: &Spec, slots: u32| {
        let tables = SceneTables::new(&scene, DVec3::ZERO, &Parts::ALL).expect("the scene is whole");
        let gpu = GpuScene::upload(device, &tables, &view(&scene, size, 0.0)).expect("it fits");
        let mut pass = PosePass::new(device, &scene, &tables, &gpu).expect("it fits");
        let parts = pass.parts(device).expect("it fits");
        let make = |part: &Geometry| spec.create(device, part, Some(gpu.binding()));
        let structure = Combined::new(&parts, make).expect("any structure can be in parts");
        let film = Film::new(device, size[0], size[1]).expect("it fits");
        let path = Path::new(&IntegratorDesc::new(device, &gpu, &film), 2).expect("it fits");
        let input = |frame: u32| {
            let moment = Moment { seconds: 0.2 * f64::from(frame), clips: vec![0] };
            FrameInput {
                view: view(&scene, size, 0.0),
                sampling: Sampling { samples: 2, ..Sampling::default() },
                scene: None,
                pose: Some(pass.frame(&scene, &moment).expect("the same scene")),
                samples: (0..2).into(),
                continues: false,
            }
        };
        let inputs: Vec<FrameInput> = (0..4).map(input).collect();
        let rest = (FrameSettings { slots, ..FrameSettings::default() }, Timing::None, true);
        let mut renderer = FrameRenderer::new(device, (gpu, Some(pass)), structure, Box::new(path), rest)
            .expect("the device works");
        let mut found = Vec::new();
        let done = render_in_order(&mut renderer, inputs, |picture| {
            found.push(picture.film.means());
            ControlFlow::Continue(())
        });
        done.expect("all frames have pictures");
        (found, renderer.structure().counts())
    };
    for spec in &payloads()[..2] {
        let name = spec.system().name;
        let ((one, _), (in_flight, counts)) = (pictures(spec, 1), pictures(spec, 3));
        println!("{name}: {counts:?}");
        assert!(one == in_flight, "{name}");
        assert!(
            one.windows(2).all(|pair| pair[0] != pair[1]),
            "{name}: frames differ, or nothing could go wrong"
        );
        assert!(counts.static_builds < counts.builds, "{name}: {counts:?}");
    }
}
