//! Options that may change a hit: every system of the registry, one option at a time, in pairs, and in other
//! processes with other numbers of driver threads; which slots of a queue are traced. Hits are compared bit
//! for bit.

use std::collections::BTreeSet;
use std::process::Command;

use rasray_ads::{PRIMITIVE_NONE, StructureKind};
use rasray_systems::{OPTIONS, SYSTEMS, StructureOption};
use rasray_tests::harness::Bench;
use rasray_tests::invariance::{
    EYE, Pairs, Subject, assert_same, choices, first_difference, pairwise, ray_count, rays, scene,
    speed_options, takes,
};
use rasray_tests::random::Random;
use rasray_tests::shapes::Triangle;
use rasray_tests::tier::is_full;

#[path = "invariance/selection.rs"]
mod selection;

/// Rays for each value and each pair of values of options: structures that promise every hit are held to it
/// on more.
fn option_rays(kind: StructureKind) -> usize {
    if is_full() && kind == StructureKind::Primitive { 100_000 } else { ray_count() }
}

#[test]
fn every_option_of_every_system_is_tried() {
    let subjects = Subject::all();
    for subject in &subjects {
        for StructureOption { row, .. } in subject.spec.system().options() {
            // Another preset of the system may be the one that has it.
            let mut others = subjects.iter().filter(|other| other.spec.system() == subject.spec.system());
            let taken = others
                .any(|other| row.tried().iter().any(|value| other.with(&[(row.name, *value)]).is_some()));
            assert!(taken, "{}: no value of --{} is tried", subject.name(), row.name);
        }
    }
    for StructureOption { row, hits, .. } in OPTIONS {
        for value in row.tried() {
            // Options that may change no hit are tried alone or in pairs, others are only taken.
            let tried = |subject: &Subject| {
                if hits.may_change(subject.kind) {
                    takes(subject, OPTIONS.iter(), (row.name, value))
                } else {
                    let options = speed_options(subject);
                    options.iter().any(|(option, values)| *option == row.name && values.contains(&value))
                }
            };
            assert!(subjects.iter().any(tried), "no system takes --{} {value}", row.name);
        }
    }
}

#[test]
fn one_option_at_a_time_changes_no_hit() {
    let bench = Bench::new();
    let triangles = scene(true);
    let every_triangle = Subject::all().into_iter().find(|subject| subject.name() == "brute-force robust");
    let every_triangle = every_triangle.expect("the registry has brute force");
    let every_hit = every_triangle.answers(&bench, EYE, &triangles, &rays(option_rays(every_triangle.kind)));
    for subject in Subject::all() {
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
        let options = speed_options(&subject);
        // A value in company is a value tried: the quick tier tries them together, and the full tier says
        // which it is.
        if options.len() > 1 && !is_full() {
            continue;
        }
        for (option, values) in options {
            for value in values {
                // Values that need another choice are among the pairs.
                let Some(changed) = subject.with(&[(option, value)]) else { continue };
                let found = changed.answers(&bench, EYE, &triangles, &rays);
                assert_same(&format!("{}: --{option} {value}", subject.name()), &rays, &expected, &found);
            }
        }
    }
}

/// Number of pairs of a subject's options that exclude each other: cells along the axes have no slices, those
/// of a cube's faces are not divided; layers are peeled by drawing, and several passes draw; trees by codes
/// and treelets have one triangle per leaf; boxes give bounds to three of six storages, and are drawn.
const REFUSED: &[(&str, usize)] = &[
    ("bricks robust", 10),
    ("bricks robust with views=cube", 10),
    ("bvh robust", 3),
    ("ldc robust", 2),
    ("ldc robust with accept=plane", 2),
    ("mmrt robust", 4),
    ("mmrt robust with coverage=exact", 4),
    ("mmrt robust with payload=plane", 4),
];

#[test]
fn options_in_pairs_change_no_hit() {
    let bench = Bench::new();
    let triangles = scene(true);
    for subject in Subject::all() {
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
            // The full tier holds every pair, the quick one every value.
            let mut seen = BTreeSet::new();
            rows.retain(|row| {
                row.iter().enumerate().fold(false, |new, value| seen.insert((value.0, *value.1)) | new)
            });
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
    for subject in Subject::all() {
        if subject.kind == StructureKind::Primitive {
            continue;
        }
        let expected = subject.answers(&bench, EYE, &triangles, &rays);
        let size = subject.spec.system().size_option().expect("what is found depends on cells");
        let changed = subject.with(&[(size, "12")]).expect("so few cells are valid");
        let found = changed.answers(&bench, EYE, &triangles, &rays);
        assert!(first_difference(&expected, &found).is_some(), "{}", subject.name());
    }
    // A single bit of a single ray.
    let subjects = Subject::all();
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
    for subject in Subject::all() {
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
    let order = random.shuffled(triangles.len());
    let shuffled: Vec<Triangle> = order.iter().map(|&index| triangles[index]).collect();
    for subject in Subject::all() {
        let expected = subject.answers(&bench, EYE, &triangles, &rays);
        let mut found = subject.answers(&bench, EYE, &shuffled, &rays);
        for answer in &mut found.closest {
            answer[1] = order.get(answer[1] as usize).map_or(answer[1], |&index| index as u32);
        }
        assert_same(&format!("{}: triangles in another order", subject.name()), &rays, &expected, &found);
    }
}

/// Number of driver threads of a child process; its answers are printed as text.
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
    for subject in Subject::all() {
        println!("ANSWERS {} {:?}", subject.name(), subject.answers(&bench, EYE, &triangles, &rays));
    }
}

#[test]
fn the_number_of_driver_threads_changes_no_hit() {
    let answers = |threads: &str| -> Vec<String> {
        let binary = std::env::current_exe().expect("a test knows its binary");
        let output = Command::new(binary)
            .args(["--exact", "invariance::answers_are_printed_for_another_process", "--nocapture"])
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
    let subjects = Subject::all().len();
    assert!(one.len() == subjects && subjects > SYSTEMS.iter().map(|system| system.presets.len()).sum());
    assert!(one.iter().all(|line| line.contains("closest: [[")), "{one:?}");
    for threads in if is_full() { &["2", "1", "2"][..] } else { &["2"] } {
        assert_eq!(one, answers(threads), "{threads} driver threads");
    }
}
