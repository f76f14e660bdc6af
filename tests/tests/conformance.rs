//! Every structure against every hard case. A new structure is one row of `conformance::ROWS`.

use std::collections::HashSet;

use rasray_tests::conformance::{Demand, Prepared, ROWS, Row, judge, measure};
use rasray_tests::hard_cases::{self, Answer, Expectation, Scale};
use rasray_tests::harness::Bench;

/// Ray-triangle tests that a row which tests every triangle may spend on a case.
const TESTS: usize = 50_000_000;

fn tolerances(row: &Row) -> (f64, f64) {
    match row.demand {
        Demand::Exact { rounding } => (0.0, rounding),
        Demand::Law { depth_tolerance, .. } => (depth_tolerance, 0.0),
    }
}

/// Holds rows against all their cases and reports every fault at once.
fn hold(is_meant: fn(&Row) -> bool) {
    let bench = Bench::new();
    let placeholder = bench.geometry(&[[[0.0, 0.0, 1.0], [1.0, 0.0, 1.0], [0.0, 1.0, 1.0]]]);
    let mut rows: Vec<_> =
        ROWS.iter().filter(|row| is_meant(row)).map(|row| (row, (row.make)(&bench, &placeholder))).collect();
    assert!(!rows.is_empty());
    let mut faults = Vec::new();
    for id in hard_cases::ids() {
        if !rows.iter().any(|(row, _)| row.cases.contain(id)) {
            continue;
        }
        let case = hard_cases::case(id, Scale::QUICK).expect("the id is in the catalogue");
        let mut prepared = Prepared::new(&bench, case);
        for (row, structure) in &mut rows {
            if !row.cases.contain(id) {
                continue;
            }
            if matches!(row.demand, Demand::Exact { .. }) {
                prepared.truncate(TESTS / prepared.case.triangles.len().max(1));
            }
            let (depth_tolerance, rounding) = tolerances(row);
            let measured = measure(&bench, structure.as_mut(), &prepared, depth_tolerance, rounding);
            faults.extend(judge(row, &prepared, &measured));
        }
    }
    assert!(faults.is_empty(), "{} faults:\n{}", faults.len(), faults.join("\n"));
}

#[test]
fn structures_that_find_triangles_are_exact() {
    hold(|row| matches!(row.demand, Demand::Exact { .. }));
}

#[test]
fn robust_fragments_keep_their_law() {
    hold(|row| row.name.starts_with("mmrt-robust"));
}

#[test]
fn published_fragments_keep_their_law() {
    hold(|row| row.name.starts_with("mmrt-published"));
}

#[test]
fn every_row_is_held_and_every_deviation_names_a_case() {
    let ids: HashSet<_> = hard_cases::ids().into_iter().collect();
    let mut names = HashSet::new();
    for row in ROWS {
        assert!(names.insert(row.name), "{} twice", row.name);
        let held =
            ["brute-force", "mmrt-robust", "mmrt-published"].iter().any(|held| row.name.starts_with(held));
        assert!(held, "no test holds {}", row.name);
        if let Demand::Law { laws, .. } = row.demand {
            assert!(laws.iter().all(|law| ids.contains(law.case) && law.per_cell > 0.0));
        } else {
            assert!(row.deviations.is_empty(), "{} finds triangles and may not deviate", row.name);
        }
        let mut cases = HashSet::new();
        for deviation in row.deviations {
            assert!(ids.contains(deviation.case) && row.cases.contain(deviation.case), "{deviation:?}");
            assert!(cases.insert(deviation.case), "{} twice in {}", deviation.case, row.name);
            assert!(0.0 < deviation.at_least_rate && deviation.at_least_rate <= deviation.at_most_rate);
            assert!(deviation.at_most_rate <= 1.0 && !deviation.reason.is_empty());
        }
    }
    for id in ids {
        let rows = ROWS.iter().filter(|row| row.cases.contain(id)).count();
        assert!(rows >= 3, "{id} is met by {rows} rows only");
    }
}

/// Shows that the judgement notices what it is there for.
#[test]
fn wrong_answers_and_unexpected_passes_are_noticed() {
    let bench = Bench::new();
    let row = ROWS.iter().find(|row| row.name == "brute-force").expect("the judge is always there");
    let mut prepared = Prepared::new(&bench, hard_cases::case("Z10", Scale::QUICK).expect("it exists"));
    let mut structure = (row.make)(&bench, &prepared.geometry);
    let measured = measure(&bench, structure.as_mut(), &prepared, 0.0, 1e-6);
    assert_eq!(judge(row, &prepared, &measured), Vec::<String>::new());

    // A structure that answers another scene.
    let other = Prepared::new(&bench, hard_cases::case("Z8", Scale::QUICK).expect("it exists"));
    prepared.geometry = other.geometry.clone();
    let measured = measure(&bench, structure.as_mut(), &prepared, 0.0, 1e-6);
    assert!(judge(row, &prepared, &measured).iter().any(|fault| fault.contains("wrong answer")));
    let lenient = Row {
        demand: Demand::Law { resolution: 64, per_cell: 1.0, depth_tolerance: 1e-3, laws: &[] },
        ..*row
    };
    assert!(judge(&lenient, &prepared, &measured).iter().any(|fault| fault.contains("error rate")));

    // A statement that does not hold.
    let mut prepared = other;
    prepared.case.expect = Expectation::All(Answer::HitAt { t: 1.001, tolerance: 1e-6 });
    let measured = measure(&bench, structure.as_mut(), &prepared, 0.0, 1e-6);
    assert_eq!(measured.rejected.len(), prepared.rays.len());

    // A deviation that is none.
    let deviating = Row {
        deviations: &[rasray_tests::conformance::Deviation {
            case: "Z8",
            reason: "made up",
            at_least_rate: 0.5,
            at_most_rate: 1.0,
        }],
        ..*row
    };
    assert!(
        judge(&deviating, &prepared, &measured).iter().any(|fault| fault.contains("passes unexpectedly"))
    );
}

/// What loaders drop is not on the device, and ids are still those of the file.
#[test]
fn bad_coordinates_are_dropped_before_they_poison_anything() {
    let bench = Bench::new();
    let prepared = Prepared::new(&bench, hard_cases::case("C5", Scale::QUICK).expect("it exists"));
    let on_device = prepared.geometry.triangle_count() as usize;
    assert_eq!(prepared.case.triangles.len() - on_device, hard_cases::POISONED_DROPPED);
    assert!(prepared.geometry.bounds().iter().flatten().all(|x| x.abs() < 1e3));
    assert_ne!(prepared.primitive(on_device as u32 - 1), Some(on_device as u32 - 1));
    let empty = Prepared::new(&bench, hard_cases::case("C1", Scale::QUICK).expect("it exists"));
    assert_eq!(empty.geometry.triangle_count(), 0);
}
