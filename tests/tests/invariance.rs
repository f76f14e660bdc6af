//! Which options may change a hit: every system of the registry, one option at a time, in pairs, in other
//! processes with other numbers of driver threads, and on scenes that are moved about. Hits are compared
//! bit for bit.

use std::process::Command;

use rasray_ads::{PRIMITIVE_NONE, Ray, StructureKind};
use rasray_metrics::Truth;
use rasray_reference::oracle::Oracle;
use rasray_systems::SYSTEMS;
use rasray_tests::hard_cases::{self, Scale};
use rasray_tests::harness::{Bench, oracle_ray};
use rasray_tests::invariance::{
    Answers, LAWS, Pairs, SUBJECTS, Subject, Value, choices, first_difference, law, pairwise, speed_options,
    takes,
};
use rasray_tests::random::Random;
use rasray_tests::shapes::{Triangle, closed_box, sphere};
use rasray_tests::tier::is_full;

const EYE: [f32; 3] = [0.125, -0.25, 0.375];

/// Rays a comparison: what the full tier affords, and what every run does.
fn ray_count() -> usize {
    if is_full() { 2000 } else { 400 }
}

/// Rays for each value and each pair of values of options: structures that promise every hit are held to it on more.
fn option_rays(kind: StructureKind) -> usize {
    if is_full() && kind == StructureKind::Primitive { 100_000 } else { ray_count() }
}

/// Scattered layers, a sphere, and a room around them. `twins` adds triangles that coincide with others.
fn scene(twins: bool) -> Vec<Triangle> {
    let mut triangles = hard_cases::case("C4", Scale::QUICK).expect("the case exists").triangles;
    triangles.extend(sphere([-3.0, 0.5, -2.0], 1.5, 6));
    triangles.extend(closed_box([-10.0; 3], [10.0; 3]));
    if twins {
        triangles.extend(triangles.clone().into_iter().step_by(3));
    }
    triangles
}

fn rays(count: usize) -> Vec<Ray> {
    let mut random = Random::new(11);
    (0..count)
        .map(|index| {
            let origin = random.point(-6.0, 6.0);
            match index % 8 {
                // Along an axis, with a limited range, from the views' centre.
                0 => {
                    let mut direction = [0.0; 3];
                    direction[index / 8 % 3] = if index / 24 % 2 == 0 { 1.0 } else { -1.0 };
                    Ray::new(origin, direction)
                }
                1 => Ray { t_max: 2.0, t_min: 0.5, ..Ray::new(origin, random.direction()) },
                2 => Ray::new(EYE, random.direction()),
                _ => Ray::new(origin, random.direction()),
            }
        })
        .collect()
}

/// Rays in general position, for scenes that are moved about.
fn general_rays(count: usize) -> Vec<Ray> {
    let mut random = Random::new(23);
    (0..count).map(|_| Ray::new(random.point(-6.0, 6.0), random.direction())).collect()
}

fn assert_same(what: &str, rays: &[Ray], expected: &Answers, found: &Answers) {
    if let Some(ray) = first_difference(expected, found) {
        panic!(
            "{what}: ray {ray} ({:?}) hits {:x?} (occluded: {}), and {:x?} (occluded: {}) without the change",
            rays[ray], found.closest[ray], found.occluded[ray], expected.closest[ray], expected.occluded[ray]
        );
    }
}

#[test]
fn every_option_of_every_system_has_a_law_and_a_value() {
    let bench = Bench::new();
    let subjects = Subject::all(&bench);
    for subject in &subjects {
        for option in subject.spec.system().options {
            let law = law(option).unwrap_or_else(|| panic!("the law of --{option} is not in LAWS"));
            // Another preset or structure of the system may be the one that has it.
            let others =
                subjects.iter().filter(|other| other.spec.system().name == subject.spec.system().name);
            let taken = others
                .flat_map(|other| {
                    law.values.iter().filter(|value| other.with(&[(*option, **value)]).is_some())
                })
                .count();
            assert!(taken > 0, "{}: no value of --{option} is tried", subject.name());
        }
    }
    for law in LAWS {
        if SYSTEMS.iter().any(|system| system.options.contains(&law.option)) {
            for value in law.values {
                // What may change no hit is tried alone or in pairs, what may is only taken.
                let tried = |subject: &Subject| match law.of(subject.kind) {
                    Value::MayChange => takes(subject, LAWS.iter(), (law.option, value)),
                    _ => speed_options(subject)
                        .iter()
                        .any(|(option, values)| *option == law.option && values.contains(value)),
                };
                assert!(subjects.iter().any(tried), "no system takes --{} {value}", law.option);
            }
        }
    }
    for (system, preset, _) in SUBJECTS {
        assert!(subjects.iter().any(|subject| subject.name() == format!("{system} {preset}")));
    }
}

#[test]
fn one_option_at_a_time_changes_no_hit() {
    let bench = Bench::new();
    let triangles = scene(true);
    let every_triangle =
        Subject::all(&bench).into_iter().find(|subject| subject.name() == "brute-force robust");
    let every_triangle = every_triangle.expect("the registry has brute force");
    let every_hit = every_triangle.answers(&bench, EYE, &triangles, &rays(option_rays(every_triangle.kind)));
    for subject in Subject::all(&bench) {
        let rays = rays(option_rays(subject.kind));
        let expected = subject.answers(&bench, EYE, &triangles, &rays);
        if subject.kind == StructureKind::Primitive {
            assert_same(&format!("{}: the structure", subject.name()), &rays, &every_hit, &expected);
        }
        let hit = expected.occluded.iter().filter(|occluded| **occluded).count();
        assert!(hit > rays.len() / 4 && hit < rays.len(), "{}: {hit} rays hit", subject.name());
        for (ray, (closest, occluded)) in expected.closest.iter().zip(&expected.occluded).enumerate() {
            assert_eq!(closest[1] != PRIMITIVE_NONE, *occluded, "{}: ray {ray}", subject.name());
        }
        let counted = Subject { spec: subject.spec.clone().with_counters(true), ..subject.clone() };
        let what = format!("{}: counters", subject.name());
        assert_same(&what, &rays, &expected, &counted.answers(&bench, EYE, &triangles, &rays));
        for (option, values) in speed_options(&subject) {
            for value in values {
                // What goes only beside another choice is among the pairs.
                let Some(changed) = subject.with(&[(option, value)]) else { continue };
                let found = changed.answers(&bench, EYE, &triangles, &rays);
                assert_same(&format!("{}: --{option} {value}", subject.name()), &rays, &expected, &found);
            }
        }
    }
}

/// How many pairs of a subject's options exclude each other: cells along the axes have no slices, and are bricks; layers are peeled
/// by drawing.
const REFUSED: &[(&str, usize)] = &[("dirt robust", 16), ("ldc robust", 1)];

#[test]
fn options_in_pairs_change_no_hit() {
    let bench = Bench::new();
    let triangles = scene(true);
    for subject in Subject::all(&bench) {
        let rays = rays(option_rays(subject.kind));
        let options = speed_options(&subject);
        let expected = subject.answers(&bench, EYE, &triangles, &rays);
        let choices = choices(&subject, &options);
        let chosen = |row: &[usize]| -> Vec<(&str, &str)> {
            let values = choices.iter().zip(row);
            values.filter_map(|((option, values), index)| Some((*option, values[*index]?))).collect()
        };
        let counts: Vec<_> = choices.iter().map(|(_, values)| values.len()).collect();
        let Pairs { mut rows, refused } = pairwise(&counts, |row| subject.with(&chosen(row)).is_some());
        // Some pairs exclude each other by the system's own rules, which its tests hold.
        for [left, right] in &refused {
            let pair = [left, right].map(|&(option, value)| {
                let (name, values) = &choices[option];
                format!("{name} {}", values[value].unwrap_or("as it is"))
            });
            println!("{}: {} goes with no other choice", subject.name(), pair.join(", "));
        }
        let expected_refusals =
            REFUSED.iter().find(|(name, _)| *name == subject.name()).map_or(0, |row| row.1);
        assert_eq!(
            refused.len(),
            expected_refusals,
            "{}: other pairs than known are refused",
            subject.name()
        );
        let all = rows.len();
        if !is_full() {
            // The full tier holds them all.
            rows.truncate(6);
        }
        for row in &rows {
            let chosen = chosen(row);
            let changed = subject.with(&chosen).expect("the row is allowed");
            let found = changed.answers(&bench, EYE, &triangles, &rays);
            assert_same(&format!("{}: {chosen:?}", subject.name()), &rays, &expected, &found);
        }
        assert!(!rows.is_empty() || options.len() < 2, "{}: no pair was tried", subject.name());
        println!(
            "{}: {} of {all} rows of pairs, {} pairs refused, {} rays each",
            subject.name(),
            rows.len(),
            refused.len(),
            rays.len()
        );
    }
}

/// Shows that the comparison would notice.
#[test]
fn options_that_may_change_hits_are_noticed() {
    let bench = Bench::new();
    let (triangles, rays) = (scene(true), rays(ray_count()));
    for subject in Subject::all(&bench) {
        if subject.kind == StructureKind::Primitive {
            continue;
        }
        let expected = subject.answers(&bench, EYE, &triangles, &rays);
        let changed = subject.with(&[("resolution", "12")]).expect("what is found depends on cells");
        let found = changed.answers(&bench, EYE, &triangles, &rays);
        assert!(first_difference(&expected, &found).is_some(), "{}", subject.name());
    }
    // A single bit of a single ray.
    let subjects = Subject::all(&bench);
    let mut answers = subjects[0].answers(&bench, EYE, &triangles, &rays);
    let expected = answers.clone();
    answers.closest[17][0] ^= 1;
    assert_eq!(first_difference(&expected, &answers), Some(17));
    answers.occluded[5] = !answers.occluded[5];
    assert_eq!(first_difference(&expected, &answers), Some(5));
}

#[test]
fn builds_and_traces_repeat() {
    let bench = Bench::new();
    let (triangles, rays) = (scene(true), rays(ray_count()));
    for subject in Subject::all(&bench) {
        let expected = subject.answers(&bench, EYE, &triangles, &rays);
        for _ in 0..if is_full() { 20 } else { 2 } {
            let found = subject.answers(&bench, EYE, &triangles, &rays);
            assert_same(&format!("{}: repeated", subject.name()), &rays, &expected, &found);
        }
    }
}

#[test]
fn the_order_of_triangles_changes_no_hit() {
    let bench = Bench::new();
    let (triangles, rays) = (scene(false), rays(ray_count()));
    let mut random = Random::new(5);
    // Place k of the new list holds triangle order[k] of the old one.
    let mut order: Vec<usize> = (0..triangles.len()).collect();
    for last in (1..order.len()).rev() {
        order.swap(last, (random.bits() % (last as u64 + 1)) as usize);
    }
    let shuffled: Vec<Triangle> = order.iter().map(|&index| triangles[index]).collect();
    for subject in Subject::all(&bench) {
        let expected = subject.answers(&bench, EYE, &triangles, &rays);
        let mut found = subject.answers(&bench, EYE, &shuffled, &rays);
        for answer in &mut found.closest {
            answer[1] = order.get(answer[1] as usize).map_or(answer[1], |&index| index as u32);
        }
        assert_same(&format!("{}: triangles in another order", subject.name()), &rays, &expected, &found);
    }
}

/// How many driver threads a child process is given; its answers are printed as text.
const THREADS: &str = "LP_NUM_THREADS";
const CHILD: &str = "RASRAY_TEST_PRINT_ANSWERS";

/// Runs in a child process only: prints what every subject answers.
#[test]
fn answers_are_printed_for_another_process() {
    if std::env::var_os(CHILD).is_none() {
        return;
    }
    let bench = Bench::new();
    let (triangles, rays) = (scene(true), rays(ray_count()));
    for subject in Subject::all(&bench) {
        println!("ANSWERS {} {:?}", subject.name(), subject.answers(&bench, EYE, &triangles, &rays));
    }
}

#[test]
fn the_number_of_driver_threads_changes_no_hit() {
    let answers = |threads: &str| -> Vec<String> {
        let binary = std::env::current_exe().expect("a test knows its binary");
        let output = Command::new(binary)
            .args(["--exact", "answers_are_printed_for_another_process", "--nocapture"])
            .env(CHILD, "1")
            .env(THREADS, threads)
            .output()
            .expect("the test's own binary runs");
        let text = String::from_utf8_lossy(&output.stdout).into_owned();
        assert!(output.status.success(), "{threads} threads: {text}");
        // The runner puts its own words before the first line.
        text.lines().filter_map(|line| line.split_once("ANSWERS ")).map(|(_, rest)| rest.to_owned()).collect()
    };
    let one = answers("1");
    let subjects = Subject::all(&Bench::new()).len();
    assert!(one.len() == subjects && subjects > SYSTEMS.iter().map(|system| system.presets.len()).sum());
    assert!(one.iter().all(|line| line.contains("closest: [[")), "{one:?}");
    for threads in if is_full() { &["2", "1", "2"][..] } else { &["2"] } {
        assert_eq!(one, answers(threads), "{threads} driver threads");
    }
}

/// Only structures that find triangles: their hits do not know where the scene lies, if that is exact.
fn primitive_subjects(bench: &Bench) -> Vec<Subject> {
    let subjects = Subject::all(bench);
    subjects.into_iter().filter(|subject| subject.kind == StructureKind::Primitive).collect()
}

fn published(subject: &Subject) -> bool {
    subject.name().ends_with("published")
}

#[test]
fn scale_by_powers_of_two_changes_no_bit_but_of_the_exponent() {
    let bench = Bench::new();
    let (triangles, rays) = (scene(false), general_rays(ray_count()));
    for subject in primitive_subjects(&bench).iter().filter(|subject| !published(subject)) {
        let expected = subject.answers(&bench, EYE, &triangles, &rays);
        for scale in [0.125_f32, 1024.0] {
            let grow = |point: [f32; 3]| point.map(|x| x * scale);
            let scaled: Vec<Triangle> = triangles.iter().map(|triangle| triangle.map(grow)).collect();
            let scaled_rays: Vec<Ray> =
                rays.iter().map(|ray| Ray { origin: grow(ray.origin), ..*ray }).collect();
            let mut found = subject.answers(&bench, grow(EYE), &scaled, &scaled_rays);
            for answer in &mut found.closest {
                answer[0] = (f32::from_bits(answer[0]) / scale).to_bits();
            }
            assert_same(&format!("{}: scaled by {scale}", subject.name()), &rays, &expected, &found);
        }
    }
}

#[test]
fn rotation_by_90_degrees_changes_no_hit() {
    let bench = Bench::new();
    let (triangles, rays) = (scene(false), general_rays(ray_count()));
    type Rotation = fn([f32; 3]) -> [f32; 3];
    let rotations: [(&str, Rotation); 3] = [
        ("about z", |[x, y, z]| [-y, x, z]),
        ("about x", |[x, y, z]| [x, -z, y]),
        ("about y, twice", |[x, y, z]| [-x, y, -z]),
    ];
    for subject in primitive_subjects(&bench).iter().filter(|subject| !published(subject)) {
        let expected = subject.answers(&bench, EYE, &triangles, &rays);
        for (name, rotate) in rotations {
            let turned: Vec<Triangle> = triangles.iter().map(|triangle| triangle.map(rotate)).collect();
            let turned_rays: Vec<Ray> = rays
                .iter()
                .map(|ray| Ray { origin: rotate(ray.origin), direction: rotate(ray.direction), ..*ray })
                .collect();
            let found = subject.answers(&bench, rotate(EYE), &turned, &turned_rays);
            assert_same(&format!("{}: rotated {name}", subject.name()), &rays, &expected, &found);
        }
    }
}

#[test]
fn a_ray_split_in_two_finds_the_same_hits() {
    let bench = Bench::new();
    let (triangles, rays) = (scene(false), general_rays(ray_count()));
    for subject in primitive_subjects(&bench).iter().filter(|subject| !published(subject)) {
        let whole = subject.answers(&bench, EYE, &triangles, &rays);
        let cut = |ray: usize| 1.0 + (ray % 7) as f32;
        let pieces = |front: bool| -> Vec<Ray> {
            let piece = |(index, ray): (usize, &Ray)| {
                let at = cut(index);
                if front { Ray { t_max: at, ..*ray } } else { Ray { t_min: at, ..*ray } }
            };
            rays.iter().enumerate().map(piece).collect()
        };
        let front = subject.answers(&bench, EYE, &triangles, &pieces(true));
        let back = subject.answers(&bench, EYE, &triangles, &pieces(false));
        let mut crossed = 0;
        for ray in 0..rays.len() {
            let expected = whole.closest[ray];
            let t = f32::from_bits(expected[0]);
            if expected[1] != PRIMITIVE_NONE && t == cut(ray) {
                continue;
            }
            let in_front = front.closest[ray][1] != PRIMITIVE_NONE;
            crossed += usize::from(!in_front && back.occluded[ray]);
            let found = if in_front { front.closest[ray] } else { back.closest[ray] };
            assert_eq!(found, expected, "{}: ray {ray} cut at {}", subject.name(), cut(ray));
        }
        assert!(crossed > 20, "{crossed} rays go on behind the cut");
    }
}

#[test]
fn a_segment_is_occluded_from_both_ends_or_from_none() {
    let bench = Bench::new();
    let triangles = scene(false);
    // Ends on a coarse grid, so that direction and far end are exact.
    let mut random = Random::new(31);
    let mut end = || random.point(-6.0, 6.0).map(|x| (x * 64.0).round() / 64.0);
    let segment = |from: [f32; 3], to: [f32; 3]| Ray {
        t_max: 1.0,
        ..Ray::new(from, std::array::from_fn(|axis| to[axis] - from[axis]))
    };
    let ends: Vec<_> = (0..ray_count()).map(|_| (end(), end())).collect();
    let there: Vec<Ray> = ends.iter().map(|&(a, b)| segment(a, b)).collect();
    let back: Vec<Ray> = ends.iter().map(|&(a, b)| segment(b, a)).collect();
    let positions: Vec<[f32; 3]> = triangles.as_flattened().to_vec();
    let indices: Vec<u32> = (0..positions.len() as u32).collect();
    let oracle = Oracle::new(&positions, &indices, None).expect("indices are in order");
    let clear: Vec<usize> = (0..ends.len())
        .filter(|&i| [&there[i], &back[i]].iter().all(|ray| !oracle.closest(&oracle_ray(ray)).is_ambiguous()))
        .collect();
    assert!(clear.len() > ends.len() / 2);
    for subject in primitive_subjects(&bench).iter().filter(|subject| !published(subject)) {
        let first = subject.answers(&bench, EYE, &triangles, &there);
        let second = subject.answers(&bench, EYE, &triangles, &back);
        for &i in &clear {
            assert_eq!(
                first.occluded[i],
                second.occluded[i],
                "{}: segment {i} {:?}",
                subject.name(),
                ends[i]
            );
        }
        let occluded = clear.iter().filter(|&&i| first.occluded[i]).count();
        assert!(occluded > 20 && occluded < clear.len(), "{occluded} of {}", clear.len());
    }
}
