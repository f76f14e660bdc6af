//! Triangles in two parts, each with a structure of its own: hits are those of one structure over all, bit
//! for bit.

use std::ops::Range;

use rasray_ads::kit::HEADER_POOL;
use rasray_ads::{
    AdsError, Combined, Domain, Geometry, GeometryParts, Hit, MovingPart, Ray, RayQueue, Structure,
    StructureKind, Trace, TraceMode,
};
use rasray_tests::harness::{Bench, bits};
use rasray_tests::invariance::{Subject, first_difference};
use rasray_tests::random::Random;
use rasray_tests::rays::towards;
use rasray_tests::shapes::Triangle;

const RAYS: usize = 400;

/// Triangles of which every fourth is there twice.
pub fn doubled(random: &mut Random) -> Vec<Triangle> {
    let mut triangles: Vec<Triangle> = (0..120)
        .map(|_| {
            let corner = random.point(-4.0, 4.0);
            random.triangle(corner, 1.0)
        })
        .collect();
    // Coplanar ones that overlap, in front of everything else from most sides.
    triangles.extend([[[-6.0, -6.0, 6.0], [6.0, -6.0, 6.0], [-6.0, 6.0, 6.0]]; 2]);
    triangles.push([[-6.0, -6.0, 6.0], [6.0, -6.0, 6.0], [6.0, 6.0, 6.0]]);
    for copied in (0..120).step_by(4) {
        triangles.push(triangles[copied]);
    }
    triangles
}

pub fn rays(random: &mut Random, triangles: &[Triangle]) -> Vec<Ray> {
    (0..RAYS)
        .map(|number| {
            let origin = random.point(-8.0, 8.0);
            if number % 2 == 0 {
                return Ray::new(origin, random.direction());
            }
            // Towards the middle of a triangle.
            let triangle = triangles[random.bits() as usize % triangles.len()];
            let middle: [f32; 3] =
                std::array::from_fn(|axis| triangle.iter().map(|corner| corner[axis]).sum::<f32>() / 3.0);
            let mut ray = towards(origin, middle);
            if number % 10 == 1 {
                ray.exclude_primitive = random.bits() as u32 % triangles.len() as u32;
            }
            ray
        })
        .collect()
}

/// One run of triangles.
fn run(ids: Range<u32>) -> Vec<Range<u32>> {
    std::iter::once(ids).collect()
}

/// Triangles that move: all, none, one run in the middle, and every third one and some more.
pub fn divisions(count: u32) -> Vec<(&'static str, Vec<Range<u32>>)> {
    let scattered =
        (0..count).filter(|id| id % 3 == 0 || id % 5 == 1 || id % 5 == 3).map(|id| id..id + 1).collect();
    vec![
        ("all", run(0..count)),
        ("none", Vec::new()),
        ("a run", run(20..90)),
        ("those at the end", run(100..count)),
        ("scattered", scattered),
    ]
}

pub fn bounds(triangles: &[Triangle], moving: &[Range<u32>], of_moving: bool) -> [[f32; 3]; 2] {
    let is_moving = |id: usize| moving.iter().any(|ids| ids.contains(&(id as u32)));
    let corners: Vec<[f32; 3]> =
        (0..triangles.len()).filter(|&id| is_moving(id) == of_moving).flat_map(|id| triangles[id]).collect();
    [f32::min, f32::max].map(|with: fn(f32, f32) -> f32| {
        std::array::from_fn(|axis| corners.iter().map(|corner| corner[axis]).reduce(with).unwrap_or(0.0))
    })
}

fn parts(bench: &Bench, whole: &Geometry, triangles: &[Triangle], moving: &[Range<u32>]) -> GeometryParts {
    let bounds = [false, true].map(|of_moving| bounds(triangles, moving, of_moving));
    whole.parts(bench.device(), moving, bounds).expect("they are parts")
}

/// Presets that find every triangle, trees of both builders among them.
pub fn that_find_all() -> Vec<Subject> {
    let mut subjects: Vec<Subject> =
        Subject::all().into_iter().filter(|subject| subject.kind == StructureKind::Primitive).collect();
    let trees: Vec<Subject> = subjects
        .iter()
        .filter(|subject| subject.spec.system().name == "bvh")
        .flat_map(|tree| ["lbvh", "sah"].map(|builder| tree.with(&[("builder", builder)])))
        .flatten()
        .collect();
    subjects.retain(|subject| subject.spec.system().name != "bvh");
    subjects.extend(trees);
    subjects
}

#[test]
fn hits_in_parts_are_those_of_all_triangles() {
    let bench = Bench::new();
    let mut random = Random::new(29);
    let triangles = doubled(&mut random);
    let rays = rays(&mut random, &triangles);
    let whole = bench.geometry(&triangles);
    let subjects = that_find_all();
    let by_queries = subjects.iter().filter(|subject| subject.spec.system().name == "driver-rt").count();
    assert_eq!(subjects.len() - by_queries, 11, "{subjects:?}");
    for subject in &subjects {
        let name = subject.name();
        let expected = subject.answers(&bench, [0.5; 3], &triangles, &rays);
        // Rays pause often with so little to spend; brute force keeps what it has.
        let paused = Subject { spec: subject.spec.clone().with_work_budget(7), kind: subject.kind };
        for (which, moving) in divisions(triangles.len() as u32) {
            let parts = parts(&bench, &whole, &triangles, &moving);
            for subject in [subject, &paused] {
                let mut structure =
                    Combined::new(&parts, |part| subject.spec.create(bench.device(), part, None))
                        .expect("it finds every triangle");
                let found = subject.answers_of(&bench, [0.5; 3], &mut structure, &rays);
                let different = first_difference(&found, &expected);
                assert_eq!(different, None, "{name}, {which} move: {:?}", different.map(|ray| rays[ray]));
                let known = (0..structure.count()).map(|part| structure.part(part).sizes().bytes());
                assert_eq!(known.sum::<u64>(), structure.sizes().bytes());
            }
        }
        // Nothing of this could go wrong unless rays hit what is there twice, with the lower id in either
        // part.
        let (_, scattered) = divisions(triangles.len() as u32).pop().expect("there are some");
        let moves = |id: usize| scattered.iter().any(|ids| ids.contains(&(id as u32)));
        let mut ties = [0; 2];
        for hit in &expected.closest {
            let id = hit[1] as usize;
            let copy = |other: &usize| *other != id && triangles[*other] == triangles[id];
            if id < triangles.len()
                && let Some(other) = (0..triangles.len()).find(copy)
                && moves(id) != moves(other)
            {
                ties[usize::from(moves(id))] += 1;
            }
        }
        assert!(ties.iter().all(|&count| count > 5), "{name}: {ties:?} hits on what is in both parts");
    }
}

/// Five parts that move, of which one has a run in the middle, three have scattered triangles and one has
/// none; the others stay.
pub fn many(count: u32) -> Vec<Vec<Range<u32>>> {
    let scattered =
        |part| (0..count).filter(move |id| id % 5 == part && !(40..60).contains(id)).map(|id| id..id + 1);
    vec![scattered(0).collect(), run(40..60), Vec::new(), scattered(1).collect(), scattered(3).collect()]
}

#[test]
fn hits_in_many_parts_are_those_of_all_triangles() {
    let bench = Bench::new();
    let mut random = Random::new(61);
    let triangles = doubled(&mut random);
    let rays = rays(&mut random, &triangles);
    let whole = bench.geometry(&triangles);
    let moving = many(triangles.len() as u32);
    let all: Vec<Range<u32>> = moving.concat();
    let own = |ids: &Vec<Range<u32>>| MovingPart {
        ids: ids.clone(),
        bounds: bounds(&triangles, ids, true),
        rest: None,
    };
    let moving: Vec<MovingPart> = moving.iter().map(own).collect();
    let parts = whole.in_parts(bench.device(), &moving, bounds(&triangles, &all, false));
    let parts = parts.expect("they are parts");
    for subject in &that_find_all() {
        let name = subject.name();
        let expected = subject.answers(&bench, [0.5; 3], &triangles, &rays);
        let paused = Subject { spec: subject.spec.clone().with_work_budget(7), kind: subject.kind };
        for subject in [subject, &paused] {
            let make = |part: &Geometry| subject.spec.create(bench.device(), part, None);
            let mut structure = Combined::new(&parts, make).expect("it finds every triangle");
            let found = subject.answers_of(&bench, [0.5; 3], &mut structure, &rays);
            let different = first_difference(&found, &expected);
            assert_eq!(different, None, "{name}: {:?}", different.map(|ray| rays[ray]));
        }
        let mut of_parts = vec![0; parts.parts().len()];
        for hit in &expected.closest {
            let part = moving.iter().position(|part| part.ids.iter().any(|ids| ids.contains(&hit[1])));
            of_parts[part.map_or(0, |part| part + 1)] += 1;
        }
        let hit = |part: usize| of_parts[part] > 10;
        assert!([0, 1, 2, 4, 5].into_iter().all(hit) && of_parts[3] == 0, "{name}: {of_parts:?}");
    }
}

/// Nothing is answered unless both parts are built.
#[test]
fn one_part_alone_gives_no_answer() {
    let bench = Bench::new();
    let device = bench.device();
    let mut random = Random::new(31);
    let triangles = doubled(&mut random);
    let rays = rays(&mut random, &triangles);
    let whole = bench.geometry(&triangles);
    let parts = parts(&bench, &whole, &triangles, &run(20..90));
    let subject = that_find_all().into_iter().find(|subject| subject.name() == "bricks robust");
    let subject = subject.expect("the registry has bricks");
    let made = || {
        Combined::new(&parts, |part| subject.spec.create(device, part, None))
            .expect("it finds every triangle")
    };
    for moving in [0, 1] {
        let mut structure = made();
        // Pools as large as they have to be, and one part not built.
        let sizes = {
            let mut built = made();
            rasray_tracer::build_until_complete(device, &mut built, [0.5; 3], rasray_gpu::Timing::None)
                .expect("it is built");
            built.sizes().clone()
        };
        structure.resize(device, &sizes).expect("it fits");
        device
            .submit(|recorder| {
                structure.change_part(moving, |part| part.record_build(recorder, 0, [0.5; 3].into()))
            })
            .expect("the device works")
            .value
            .expect("it is recorded");
        for mode in [TraceMode::Closest, TraceMode::Occluded] {
            let queue = RayQueue::new(device, "rays", rays.len() as u32, false).expect("a queue fits");
            device.submit(|recorder| queue.record_reset(recorder)).expect("the device works");
            device.upload_slice(queue.rays(), 0, &rays).expect("the device works");
            let all = Domain::First(rays.len() as u32);
            device
                .submit(|recorder| structure.record_trace(recorder, &queue, Trace::new(all, mode)))
                .expect("the device works");
            let hits = device.download_as::<Hit>(queue.hits(), 0, rays.len()).expect("the device works");
            let counters = queue.download_counters(device).expect("the device works");
            assert_eq!(counters.not_ready as usize, rays.len(), "{mode:?}, {counters:?}");
            assert!(hits.iter().all(|hit| !hit.is_hit()), "{mode:?}: no ray has an answer");
        }
    }
}

#[test]
fn what_cannot_be_in_parts_is_refused() {
    let bench = Bench::new();
    let device = bench.device();
    let triangles = doubled(&mut Random::new(5));
    let whole = bench.geometry(&triangles);
    let count = triangles.len() as u32;
    let everywhere = [whole.bounds(); 2];
    let refused = |moving: &[Range<u32>]| {
        let error = whole.parts(device, moving, everywhere).expect_err("it is refused");
        assert!(matches!(error, AdsError::Geometry { .. }), "{error}");
        error.to_string()
    };
    assert!(refused(&[0..4, 3..5]).contains("overlap"));
    assert!(refused(&run(7..count + 1)).contains(&count.to_string()));
    let parts = whole.parts(device, &[7..count, 2..2, 5..7], everywhere).expect("they are parts");
    assert_eq!(parts.moving()[0].ids, run(5..count));
    assert!(parts.parts()[1].parts(device, &[], everywhere).is_err(), "a part has no parts");
    // Other triangles: as many as before, or the caller says which of them move.
    let subject = that_find_all().into_iter().find(|subject| subject.name() == "bricks robust");
    let subject = subject.expect("the registry has bricks");
    let mut structure = Combined::new(&parts, |part| subject.spec.create(device, part, None))
        .expect("it finds every triangle");
    let fewer = &triangles[..60];
    let geometry = bench.geometry(fewer);
    let error = structure.set_geometry(device, &geometry).expect_err("another number of triangles");
    assert!(matches!(error, AdsError::InParts { .. }), "{error}");
    let mut random = Random::new(6);
    let rays = rays(&mut random, fewer);
    let few = geometry.parts(device, &[0..3, 10..40], [geometry.bounds(); 2]).expect("they are parts");
    structure.set_parts(device, &few).expect("they fit");
    let found = bench.build_and_trace(&mut structure, [0.5; 3], &rays);
    let expected = bench.build_and_trace(subject.structure(&bench, &geometry).as_mut(), [0.5; 3], &rays);
    assert_eq!(found.iter().map(bits).collect::<Vec<_>>(), expected.iter().map(bits).collect::<Vec<_>>());
    // Each part has pools of its own, which are looked at together.
    let inspected = structure.inspect().expect("bricks have pools");
    let error = inspected.download_pools(device).expect_err("there is no header of all").to_string();
    assert!(error.contains("is in parts"), "{error}");
    assert_eq!(inspected.fault(device).expect("the device works"), None);
    for part in 0..structure.count() {
        let pools = structure.part(part).inspect().expect("bricks have pools").download_pools(device);
        assert_eq!(pools.expect("the device works")[0].0, HEADER_POOL);
    }
}
