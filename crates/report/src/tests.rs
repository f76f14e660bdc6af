//! Tests of reports as files, and of the confidence of all rates of a report together.

use super::*;
use rasray_metrics::Rate;
use std::collections::BTreeMap;

fn run(counts: &[(&str, u64, u64)]) -> Run {
    let rates = counts
        .iter()
        .map(|(name, count, total)| {
            let rate = Rate { count: *count, total: *total };
            ((*name).to_owned(), RateRecord::of(rate).expect("something was tried"))
        })
        .collect();
    let accuracy = Accuracy { rays: 100, rates, dt_rel_p999: Some(0.5), ..Default::default() };
    let spread = Spread { count: 5, min: 1.0, q1: 1.25, q3: 2.5, max: 4.0 };
    Run {
        system: "mmrt".to_owned(),
        accuracy: Some(accuracy),
        spread: BTreeMap::from([("trace_ms".to_owned(), spread)]),
        hard: Some(HardRecord { id: "E5".to_owned(), met: Some(false), ..Default::default() }),
        image: Some(ImageError { bias: Some(-0.25), non_finite: Some(1), ..Default::default() }),
        passes: vec![Pass { label: "a".to_owned(), ms_q1: Some(0.5), count: Some(3), ..Default::default() }],
        ..Run::default()
    }
}

fn report(runs: Vec<Run>) -> Report {
    let scene = SceneRecord { name: "box".to_owned(), triangles: 12, sha256: None, ..SceneRecord::default() };
    let command = Some("rasray compare box".to_owned());
    Report::new(Origin { command, ..Origin::default() }, Device::default(), scene, runs)
}

#[test]
fn a_report_is_read_back_as_it_was_written() {
    let report = report(vec![run(&[("missed", 1, 4)]), Run::default()]);
    let read: Report = serde_json::from_str(&report.to_json()).expect("the schema");
    assert_eq!(read, report);
    // A field that the schema does not have is refused, so that a misspelt one is noticed.
    let changed = report.to_json().replace("dt_rel_p999", "dt_rel_p9999");
    assert!(serde_json::from_str::<Report>(&changed).is_err());
}

#[test]
fn a_report_of_the_first_runs_is_still_read() {
    let old = r#"{"schema":"rasray-report/1","version":"0.1.0","device":{"name":"a","driver":"b","software":true},
        "scene":{"name":"cornell","triangles":36},"runs":[{"system":"mmrt","structure":"abuffer",
        "preset":"robust","options":{},"paths":{},"accuracy":{"rays":5,"ambiguous":0,"ambiguous_lost":0,
        "missed":1,"false_hits":0,"non_finite":0},"passes":[{"label":"a","ms_median":1.0,"ms_min":1.0,"ms_max":1.0}]}]}"#;
    let report: Report = serde_json::from_str(old).expect("fields were only added");
    assert_eq!(report.statistics, None);
    assert!(report.runs[0].accuracy.as_ref().is_some_and(|accuracy| accuracy.rates.is_empty()));
}

#[test]
fn every_rate_has_an_interval_alone_and_one_among_all() {
    let alone = report(vec![run(&[("missed", 1, 1000)])]);
    let rate = |report: &Report, run: usize, name: &str| {
        report.runs[run].accuracy.as_ref().expect("judged").rates[name]
    };
    let one = rate(&alone, 0, "missed");
    assert_eq!(one.family_interval, Some(one.interval));

    let many = report(vec![
        run(&[("missed", 1, 1000), ("false_hits", 0, 1000)]),
        run(&[("missed", 7, 1000), ("t_off", 1000, 1000)]),
    ]);
    let statistics = many.statistics.expect("rates were estimated");
    assert_eq!((statistics.rates, statistics.confidence, statistics.family_confidence), (4, 0.95, 0.95));
    assert!((statistics.confidence_of_each - 0.9875).abs() < 1e-12);
    let wide = rate(&many, 0, "missed");
    let [low, high] = wide.family_interval.expect("one of four");
    assert_eq!(wide.interval, one.interval);
    assert!(low < wide.interval[0] && wide.interval[1] < high && wide.bound == Bound::ClopperPearson);
    // The upper end is 3 of 1000 for a single rate whose event was never seen, and greater for one of four
    // such rates.
    let never = rate(&many, 0, "false_hits");
    assert_eq!((never.bound, never.interval[0]), (Bound::OneSided, 0.0));
    assert!((never.interval[1] - 0.002_996).abs() < 1e-6, "{never:?}");
    assert!((never.family_interval.expect("one of four")[1] + 0.0125_f64.ln() / 1000.0).abs() < 1e-9);
    assert_eq!(rate(&many, 1, "t_off").interval[1], 1.0);
}

#[test]
fn a_report_without_rates_says_nothing_of_them() {
    let report = report(vec![Run::default()]);
    assert_eq!(report.statistics, None);
    assert!(!report.to_json().contains("statistics"));
}
