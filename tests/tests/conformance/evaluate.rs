//! The evaluation of conformance reports exactly the faults that it is for.

use rasray_metrics::{DeviceHit, Rate, Truth};
use rasray_tests::conformance::{
    Demand, Deviation, FALSE_ALARM, Prepared, ROWS, Row, compare, comparisons, confidence, evaluate,
    first_other, measure,
};
use rasray_tests::hard_cases::{self, Answer, Expectation, Scale};
use rasray_tests::harness::Bench;

type Hits = Vec<Option<DeviceHit>>;

fn prepare(bench: &Bench, id: &str, rays: usize) -> Prepared {
    let case = hard_cases::case(id, Scale { rays, ..Scale::QUICK }).expect("the id is in the catalogue");
    Prepared::new(bench, case)
}

fn row(name: &str) -> &'static Row {
    ROWS.iter().find(|row| row.name == name).expect("the row exists")
}

/// Answers of a structure without errors.
fn perfect(prepared: &Prepared) -> Hits {
    let hit = |(primitive, t): (u32, f64)| DeviceHit { t: t as f32, primitive: Some(primitive) };
    prepared.verdicts.iter().map(|verdict| verdict.hit().map(hit)).collect()
}

fn faults(row: &Row, prepared: &Prepared, hits: &Hits) -> Vec<String> {
    let (depth_tolerance, rounding) = row.tolerances();
    evaluate(row, prepared, &compare(prepared, hits, depth_tolerance, rounding))
}

/// A ray whose answer nothing but the oracle decides, with or without a hit.
fn certain(prepared: &Prepared, hits: bool) -> usize {
    prepared
        .verdicts
        .iter()
        .position(|verdict| !verdict.is_ambiguous() && verdict.hit().is_some() == hits)
        .expect("there is such a ray")
}

/// One perturbed answer among two thousand is enough for a row that finds triangles.
#[test]
fn one_wrong_answer_is_noticed() {
    let bench = Bench::new();
    let exact = row("brute-force");
    for id in ["C2", "G10", "X6"] {
        let prepared = prepare(&bench, id, 2000);
        assert_eq!(faults(exact, &prepared, &perfect(&prepared)), Vec::<String>::new(), "{id}");
        let hit = certain(&prepared, true);
        let miss = prepared.verdicts.iter().position(|verdict| verdict.hit().is_none());
        let right = perfect(&prepared)[hit].expect("it hits");
        let mut perturbed = vec![
            (hit, Some(DeviceHit { t: right.t * (1.0 + 1e-4), ..right })),
            (hit, Some(DeviceHit { t: right.t * (1.0 - 1e-4), ..right })),
            (hit, Some(DeviceHit { primitive: right.primitive.map(|id| id + 1), ..right })),
            (hit, None),
            (hit, Some(DeviceHit { t: f32::NAN, ..right })),
            (hit, Some(DeviceHit { t: f32::INFINITY, ..right })),
        ];
        perturbed.extend(miss.map(|miss| (miss, Some(right))));
        for (ray, answer) in perturbed {
            let mut hits = perfect(&prepared);
            hits[ray] = answer;
            let faults = faults(exact, &prepared, &hits);
            assert!(!faults.is_empty(), "{id}: {answer:?} for ray {ray} goes unseen");
            let command = format!(
                "rasray compare hard:{id} --systems brute-force --presets robust --seed 1 --replay {ray}"
            );
            assert!(faults.iter().all(|fault| fault.contains(&command)), "{faults:?}");
        }
    }
}

/// The command of a message traces the ray that failed.
#[test]
fn the_ray_of_a_message_can_be_replayed() {
    let bench = Bench::new();
    for id in ["E2", "X3", "T4", "P1"] {
        let prepared = prepare(&bench, id, 300);
        for ray in [0, 123, 299] {
            assert_eq!(hard_cases::replay(id, prepared.case.scale.seed, ray), Some(prepared.case.rays[ray]));
        }
    }
    let fragments = row("mmrt-published-128").replay_command("V4", 7, 3);
    let expected = "rasray compare hard:V4 --systems mmrt --presets published --seed 7 --replay 3 mmrt.resolution=128 mmrt.payload=index";
    assert_eq!(fragments, expected);
}

/// Drops the first hits, a share of all rays.
fn dropped(prepared: &Prepared, share: f64) -> Hits {
    let mut hits = perfect(prepared);
    let count = (share * hits.len() as f64).round() as usize;
    for hit in hits.iter_mut().filter(|hit| hit.is_some()).take(count) {
        *hit = None;
    }
    hits
}

/// A law is broken by a rate that the number of rays can tell from its limit, and by no smaller one.
#[test]
fn laws_and_deviations_are_held_from_both_sides() {
    let bench = Bench::new();
    let prepared = prepare(&bench, "Z8", 20_000);
    let law = row("mmrt-centres-64");
    // The limit is one in a hundred.
    for (share, broken) in [(0.0, false), (0.009, false), (0.011, false), (0.016, true), (0.5, true)] {
        assert_eq!(!faults(law, &prepared, &dropped(&prepared, share)).is_empty(), broken, "{share}");
    }
    let deviations = &[Deviation { case: "Z8", reason: "made up", at_least_rate: 0.2, at_most_rate: 0.3 }];
    let deviating = Row { deviations, ..*law };
    for (share, complaint) in [
        (0.0, Some("passes unexpectedly")),
        (0.17, Some("passes unexpectedly")),
        (0.25, None),
        (0.33, Some("more than the 0.3")),
        (1.0, Some("more than the 0.3")),
    ] {
        let faults = faults(&deviating, &prepared, &dropped(&prepared, share));
        match complaint {
            Some(complaint) => {
                assert!(faults.iter().any(|fault| fault.contains(complaint)), "{share}: {faults:?}")
            }
            None => assert_eq!(faults, Vec::<String>::new(), "{share}"),
        }
    }
    // Rows that find triangles have no such choice: a deviation excuses nothing, and is refused itself.
    let excused = Row { deviations, ..*row("brute-force") };
    for share in [0.0, 0.25] {
        let faults = faults(&excused, &prepared, &dropped(&prepared, share));
        assert!(faults.iter().any(|fault| fault.contains("may not deviate")), "{faults:?}");
        assert_eq!(faults.iter().any(|fault| fault.contains("wrong answer")), share > 0.0);
    }
}

/// A depth that is off by more than the catalogue allows is a fault even where rounding would allow more.
#[test]
fn depths_beyond_what_a_case_states_are_noticed() {
    let bench = Bench::new();
    let prepared = prepare(&bench, "G10", 2000);
    let exact = row("brute-force");
    assert_eq!(prepared.case.largest_dt, Some(1e-6));
    for (off, broken) in [(0.0, false), (4e-7, false), (3e-6, true)] {
        let mut hits = perfect(&prepared);
        let ray = certain(&prepared, true);
        hits[ray] = hits[ray].map(|hit| DeviceHit { t: (f64::from(hit.t) * (1.0 + off)) as f32, ..hit });
        let faults = faults(exact, &prepared, &hits);
        assert_eq!(faults.iter().any(|fault| fault.contains("|dt| / t")), broken, "{off}: {faults:?}");
    }
}

/// One bit of one answer of a repeated build.
#[test]
fn another_answer_of_a_repeated_build_is_noticed() {
    let bench = Bench::new();
    let hits = perfect(&prepare(&bench, "Z4", 200));
    assert_eq!(first_other(&hits, &hits), None);
    let ray = hits.iter().position(Option::is_some).expect("some ray hits");
    let right = hits[ray].expect("it hits");
    let other = right.primitive.map(|primitive| primitive ^ 1);
    let moved = f32::from_bits(right.t.to_bits() ^ 1);
    for answer in [None, Some(DeviceHit { primitive: other, ..right }), Some(DeviceHit { t: moved, ..right })]
    {
        let mut again = hits.clone();
        again[ray] = answer;
        assert_eq!(first_other(&hits, &again), Some(ray), "{answer:?}");
    }
}

/// Where nothing can be hit, one hit of a structure of fragments is a fault, whatever its law.
#[test]
fn a_hit_on_what_has_no_area_is_noticed() {
    let bench = Bench::new();
    let prepared = prepare(&bench, "G3", 2000);
    let law = row("mmrt-centres-64");
    let nothing = vec![None; prepared.rays.len()];
    assert_eq!(faults(law, &prepared, &nothing), Vec::<String>::new());
    for ray in [0, 1000] {
        let mut hits = nothing.clone();
        hits[ray] = Some(DeviceHit { t: 1.0, primitive: Some(0) });
        let faults = faults(law, &prepared, &hits);
        assert!(faults.iter().any(|fault| fault.contains("hits are wrong")), "{ray}: {faults:?}");
    }
}

/// Rays that rounding decides are held as well: to an admissible answer, but for a share.
#[test]
fn inadmissible_answers_are_held_from_both_sides() {
    let bench = Bench::new();
    let prepared = prepare(&bench, "V6", 2000);
    let lose = |share: f64| {
        let mut hits = perfect(&prepared);
        let ambiguous = prepared.verdicts.iter().enumerate().filter(|(_, verdict)| verdict.is_ambiguous());
        let ambiguous: Vec<usize> = ambiguous.map(|(ray, _)| ray).collect();
        assert!(ambiguous.len() >= 1000, "{}", ambiguous.len());
        for (place, &ray) in ambiguous.iter().enumerate() {
            let lost = (place as f64) < share * ambiguous.len() as f64;
            // The oracle's first candidate is admissible.
            let first = prepared.verdicts[ray].candidates[0];
            let hit = DeviceHit {
                t: (0.5 * (first.t_low + first.t_high)) as f32,
                primitive: Some(first.primitive),
            };
            hits[ray] = (!lost).then_some(hit);
        }
        hits
    };
    for (name, share, broken) in [
        ("mmrt-centres-64", 0.0, false),
        ("mmrt-centres-64", 0.04, false),
        ("mmrt-centres-64", 0.2, true),
        // One that is excused up to a share, and from one.
        ("hu-centres-64", 0.33, false),
        ("hu-centres-64", 0.6, true),
        ("hu-centres-64", 0.0, true),
    ] {
        let faults = faults(row(name), &prepared, &lose(share));
        assert_eq!(
            faults.iter().any(|fault| fault.contains("ambiguous")),
            broken,
            "{name}, {share}: {faults:?}"
        );
    }
}

/// The probability of `least` or more of `total` where each happens with probability `p`.
fn binomial_tail(total: u64, least: u64, p: f64) -> f64 {
    let mut term = (total as f64 * (-p).ln_1p()).exp();
    let mut sum = 0.0;
    for k in 0..=total {
        if k >= least {
            sum += term;
        }
        term *= (total - k) as f64 / (k + 1) as f64 * p / (1.0 - p);
    }
    sum
}

/// All evaluations of a run together are wrong with the stated probability at most, whatever the seed, where
/// every law holds with nothing to spare.
#[test]
fn false_alarms_are_as_rare_as_stated() {
    let least = |total: u64, limit: f64, confidence: f64| {
        (0..=total).find(|&count| {
            let [low, _] = Rate { count, total }.interval_at(confidence).expect("rays were traced");
            low > limit
        })
    };
    let share = FALSE_ALARM / comparisons() as f64;
    assert!(comparisons() > 1000);
    for (total, limit) in [(2000, 0.01), (2000, 0.005), (2000, 0.3), (500, 0.04), (20_000, 0.01)] {
        let alarm = least(total, limit, confidence()).expect("some rate is beyond the limit");
        let tail = binomial_tail(total, alarm, limit);
        assert!(tail <= share, "{total} rays, {limit}: {tail:e} is more than {share:e}");
        // Bounds of 95 % per comparison would raise the alarm in every other run.
        let naive = least(total, limit, 0.95).expect("some rate is beyond the limit");
        let tail = binomial_tail(total, naive, limit);
        assert!(tail > 1e4 * share, "{total} rays, {limit}: {tail:e}");
    }
}

/// On the device: another scene's answers, and a statement that does not hold.
#[test]
fn a_structure_of_another_scene_is_noticed() {
    let bench = Bench::new();
    let exact = row("brute-force");
    let mut prepared = prepare(&bench, "Z10", 2000);
    let mut structure = exact.make(&bench, &prepared.geometry);
    let measured = measure(&bench, structure.as_mut(), &prepared, 0.0, 1e-6);
    assert_eq!(evaluate(exact, &prepared, &measured), Vec::<String>::new());
    let other = prepare(&bench, "Z8", 2000);
    prepared.geometry = other.geometry.clone();
    let measured = measure(&bench, structure.as_mut(), &prepared, 0.0, 1e-6);
    assert!(evaluate(exact, &prepared, &measured).iter().any(|fault| fault.contains("wrong answer")));
    let lenient = Row {
        demand: Demand::Law { resolution: 64, per_cell: 1.0, depth_tolerance: 1e-3, laws: &[] },
        ..*exact
    };
    assert!(evaluate(&lenient, &prepared, &measured).iter().any(|fault| fault.contains("error rate")));
    let mut prepared = other;
    prepared.case.expect = Expectation::All(Answer::HitAt { t: 1.001, tolerance: 1e-6 });
    let measured = measure(&bench, structure.as_mut(), &prepared, 0.0, 1e-6);
    assert_eq!(measured.rejected.len(), prepared.rays.len());
}
