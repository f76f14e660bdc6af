//! Every structure against every hard case. A new structure is one row of `conformance::ROWS`.

use std::collections::HashSet;
use std::io::Write as _;
use std::sync::OnceLock;
use std::time::Instant;

use rasray_ads::AdsError;
use rasray_gpu::GpuError;
use rasray_report::Run;
use rasray_systems::SYSTEMS;
use rasray_tests::conformance::{
    Demand, LARGE, Law, Prepared, ROWS, Row, SHARE, Tier, answers, compare, evaluate, first_other, is_held,
    measure, try_answers,
};
use rasray_tests::hard_cases::{self, Scale, Target};
use rasray_tests::harness::{Bench, is_offered};
use rasray_tests::tier::{Counts, is_full};
use rasray_tracer::TracerError;

use crate::conformance::report;

/// Rays of a case for rows that find triangles without loss.
const RAYS: Counts<usize> = Counts { quick: 1000, software: 20_000, full: 150_000 };

/// Maximum product of rays and triangles of a case, for rows that find triangles without loss and build
/// something.
const TESTS: Counts<usize> = Counts { quick: 250_000_000, software: 2_000_000_000, full: 10_000_000_000 };

/// The share of that for brute force, which tests every triangle against every ray.
const BRUTE_FORCE: usize = 20;

/// The largest rate of errors that a law may allow.
const LARGEST_LIMIT: f64 = 0.75;

/// Cases of surfaces that coincide, where answers could depend on the order in which threads ran: built and
/// traced again and again.
const REPEATED: &[&str] = &["Z4", "Z14", "C10"];

/// Repetitions, in the quick tier and in the full one.
const REPEATS: [usize; 2] = [1, 19];

/// Rays of a case for rows that are evaluated by rates in the full tier, with the meshes of the quick one:
/// bounds of rates hold for those.
const RATES_FULL: Scale = Scale { rays: 20_000, ..Scale::QUICK };

/// Results of rows on their cases.
#[derive(Default)]
struct Held {
    faults: Vec<String>,
    runs: Vec<Run>,
}

impl Held {
    /// Reports every fault at once.
    fn check(&self) {
        assert!(self.faults.is_empty(), "{} faults:\n{}", self.faults.len(), self.faults.join("\n"));
    }
}

/// With `RASRAY_PROGRESS` set, says what comes next on the real standard error, with the seconds since the
/// first word: the last line of a log then tells where a driver ended the program, and all of them where its
/// time went.
fn progress(what: &str) {
    static BEGUN: OnceLock<Instant> = OnceLock::new();
    if std::env::var_os("RASRAY_PROGRESS").is_some() {
        let seconds = BEGUN.get_or_init(Instant::now).elapsed().as_secs_f64();
        // Not `eprintln`, which the test harness holds back. A closed stream ends no test.
        let _ = writeln!(std::io::stderr(), "conformance: {seconds:.1} s: {what}");
    }
}

/// Names the rows to be run.
const WANTED: &str = "RASRAY_ROWS";

/// The rows to be run: with `RASRAY_ROWS` set only those whose name holds one of its words, which commas
/// part. These go through all of their cases, in the quick tier as well.
fn wanted_rows() -> Vec<&'static Row> {
    let words = std::env::var_os(WANTED).map(|words| words.to_string_lossy().into_owned());
    let (wanted, others): (Vec<&Row>, Vec<&Row>) = ROWS.iter().partition(|row| {
        words.as_ref().is_none_or(|words| words.split(',').any(|word| row.name.contains(word)))
    });
    for row in others {
        println!("left out: {}, which RASRAY_ROWS does not name", row.name);
    }
    assert!(!wanted.is_empty(), "RASRAY_ROWS matches no row");
    wanted.into_iter().filter(|row| is_offered(&row.spec())).collect()
}

/// Holds rows against their cases.
fn hold(bench: &Bench, rows: &[&'static Row], scale: Scale, tests: usize, held: &mut Held) {
    let placeholder = bench.geometry(&[[[0.0, 0.0, 1.0], [1.0, 0.0, 1.0], [0.0, 1.0, 1.0]]]);
    // Those that trace only some of the rays come last.
    let mut rows = rows.to_vec();
    rows.sort_by_key(|row| (row.is_exact(), row.system == "brute-force"));
    let mut rows: Vec<_> = rows.into_iter().map(|row| (row, row.make(bench, &placeholder))).collect();
    let is_every_pair = std::env::var_os(WANTED).is_some();
    // Those that are named may all belong to another tier or kind.
    assert!(!rows.is_empty() || is_every_pair);
    for (row, structure) in &rows {
        assert_eq!(
            structure.description().kind,
            row.demand.kind(),
            "{} demands what its structure does not promise",
            row.name
        );
    }
    for id in hard_cases::ids() {
        // Ten million triangles have a test of their own.
        let is_huge = scale.full && id.starts_with("C3");
        let is_due = |row: &Row| row.cases.contain(id) && (is_every_pair || is_held(row, id));
        if is_huge || !rows.iter().any(|(row, _)| is_due(row)) {
            continue;
        }
        let mut case = hard_cases::case(id, scale).expect("the id is in the catalogue");
        let most = |row: &Row| {
            let share = if row.system == "brute-force" { BRUTE_FORCE } else { 1 };
            tests / share / case.triangles.len().max(1)
        };
        let most: Vec<_> = rows.iter().map(|(row, _)| most(row)).collect();
        if rows.iter().all(|(row, _)| row.is_exact() || !is_due(row)) {
            case.rays.truncate(most.iter().copied().max().unwrap_or(0));
        }
        let mut prepared = Prepared::new(bench, case);
        for ((row, structure), most) in rows.iter_mut().zip(most) {
            if !is_due(row) {
                continue;
            }
            // Where all triangles are in one place, every structure tests them all.
            if row.is_exact() {
                prepared.truncate(most);
            }
            prepared.only_camera = row.only_camera();
            let (depth_tolerance, rounding) = row.tolerances();
            progress(&format!("{} {id}", row.name));
            let mut by_address = None;
            let hits = match try_answers(bench, structure.as_mut(), &prepared) {
                // Large meshes make pools that a binding of a software driver does not hold.
                Err(TracerError::Ads(AdsError::Gpu(GpuError::TooLarge { .. }))) if scale.full => {
                    let made = by_address.insert(row.make_by_address(bench, &prepared.geometry));
                    answers(bench, made.as_mut(), &prepared)
                }
                hits => hits.expect("the build completes"),
            };
            let structure = by_address.as_mut().unwrap_or(structure);
            let measured = compare(&prepared, &hits, depth_tolerance, rounding);
            if std::env::var_os("RASRAY_RATES").is_some() {
                let rate = measured.evaluated();
                let ambiguous = measured.inadmissible;
                println!(
                    "{} {id} {} of {}, and of ambiguous rays {} of {}",
                    row.name, rate.count, rate.total, ambiguous.count, ambiguous.total
                );
            }
            let mut faults = evaluate(row, &prepared, &measured);
            let repeats = if REPEATED.contains(&id) { REPEATS[usize::from(is_full())] } else { 0 };
            for repeat in 1..=repeats {
                let again = answers(bench, structure.as_mut(), &prepared);
                if let Some(ray) = first_other(&hits, &again) {
                    let (first, now) = (hits[ray], again[ray]);
                    faults.push(format!(
                        "{} on {id}: build {repeat} answers ray {ray} with {now:?}, not {first:?}",
                        row.name
                    ));
                    break;
                }
            }
            held.runs.push(report::run(row, structure.as_ref(), &prepared, &measured, &faults));
            held.faults.extend(faults);
        }
    }
}

#[test]
fn every_row_keeps_its_demand_on_every_case() {
    let quick: Vec<_> = wanted_rows().into_iter().filter(|row| row.tier == Tier::Quick).collect();
    let mut held = Held::default();
    hold(&Bench::new(), &quick, Scale { rays: RAYS.quick, ..Scale::QUICK }, TESTS.quick, &mut held);
    held.check();
}

/// The large counts: full meshes for rows that find triangles, more rays and rows for the others.
#[test]
fn every_row_keeps_its_demand_at_large_counts() {
    if !is_full() {
        eprintln!("skipped: set RASRAY_FULL to 1 for the large counts");
        return;
    }
    let (exact, evaluated_by_rate): (Vec<_>, Vec<_>) =
        wanted_rows().into_iter().partition(|row| row.is_exact());
    let (bench, mut held) = (Bench::new(), Held::default());
    let rays = RAYS.on(bench.device(), "rays of a case for rows that find triangles");
    let tests = TESTS.on(bench.device(), "rays times triangles, at most");
    hold(&bench, &exact, Scale { rays, ..Scale::FULL }, tests, &mut held);
    hold(&bench, &evaluated_by_rate, RATES_FULL, 0, &mut held);
    report::write(&bench, std::mem::take(&mut held.runs));
    held.check();
}

#[test]
fn every_case_and_row_has_its_share_of_the_quick_tier() {
    let ids = hard_cases::ids();
    let quick: Vec<&Row> = ROWS.iter().filter(|row| row.tier == Tier::Quick).collect();
    for row in &quick {
        let own = ids.iter().filter(|id| row.cases.contain(id) && !LARGE.contains(id)).count();
        let held = ids.iter().filter(|id| is_held(row, id)).count();
        assert!(held >= (own / SHARE).max(1), "{} is held to {held} of {own} cases", row.name);
        assert!(ids.iter().all(|id| row.cases.contain(id) || !is_held(row, id)), "{}", row.name);
    }
    let pairs = |row: &&Row| ids.iter().filter(|id| is_held(row, id)).count();
    println!("{} pairs of rows and cases", quick.iter().map(pairs).sum::<usize>());
    for id in &ids {
        for is_exact in [true, false] {
            let held = quick.iter().filter(|row| row.is_exact() == is_exact && is_held(row, id)).count();
            assert!(held >= 1, "no row that finds triangles without loss ({is_exact}) is held to {id}");
        }
    }
}

#[test]
fn every_preset_has_a_row_and_every_deviation_names_a_case() {
    let ids: HashSet<_> = hard_cases::ids().into_iter().collect();
    for system in SYSTEMS {
        for preset in system.presets {
            let stands_for = |row: &Row| row.system == system.name && row.preset == *preset;
            let rows: Vec<&Row> = ROWS.iter().filter(|row| stands_for(row)).collect();
            for id in &ids {
                let held = rows.iter().any(|row| row.cases.contain(id));
                assert!(held, "no row holds {} --preset {} to {id}", system.name, preset.name());
            }
        }
    }
    let mut names = HashSet::new();
    for row in ROWS.iter() {
        assert!(names.insert(row.name), "{} twice", row.name);
        if let Demand::Law { laws, resolution, .. } = row.demand {
            assert!(laws.iter().all(|law| ids.contains(law.case) && law.per_cell > 0.0));
            // A limit near 1 would hold nothing.
            let says_little =
                |law: &&Law| row.cases.contain(law.case) && law.limit(resolution) > LARGEST_LIMIT;
            assert_eq!(laws.iter().find(says_little), None, "{}", row.name);
        } else if row.is_exact() {
            assert!(row.deviations.is_empty(), "{} finds triangles and may not deviate", row.name);
        }
        let mut cases = HashSet::new();
        for deviation in row.deviations {
            assert!(ids.contains(deviation.case) && row.cases.contain(deviation.case), "{deviation:?}");
            assert!(cases.insert(deviation.case), "{} twice in {}", deviation.case, row.name);
            assert!(0.0 < deviation.at_least_rate && deviation.at_least_rate <= deviation.at_most_rate);
            assert!(deviation.at_most_rate <= 1.0 && !deviation.reason.is_empty());
            // Promises of the catalogue for fragments without a law are not negotiable, nor that hits are
            // finite.
            let target = hard_cases::catalogue_row(deviation.case).expect("it is in the catalogue").target;
            let negotiable = match row.demand {
                Demand::Loss { .. } => target.primitives != Target::Finite,
                _ => matches!(target.fragments, Target::Law | Target::Counted),
            };
            assert!(negotiable, "{} may not deviate on {}", row.name, deviation.case);
        }
    }
    for id in ids {
        let rows = ROWS.iter().filter(|row| row.cases.contain(id)).count();
        assert!(rows >= 3, "only {rows} rows are held to {id}");
    }
}

/// Triangles a hundred million times smaller than their distance from the ray, whose edges rounding cannot
/// tell apart: only a structure that tests every triangle tests them.
#[test]
fn tiny_triangles_far_from_a_ray_are_not_hit() {
    let bench = Bench::new();
    let scale = Scale { rays: 20_000, ..Scale::QUICK };
    let prepared = Prepared::new(&bench, hard_cases::case("Z1", scale).expect("it exists"));
    let row = ROWS.iter().find(|row| row.system == "brute-force").expect("there is one");
    let (depth_tolerance, rounding) = row.tolerances();
    let mut structure = row.make(&bench, &prepared.geometry);
    let measured = measure(&bench, structure.as_mut(), &prepared, depth_tolerance, rounding);
    assert_eq!(evaluate(row, &prepared, &measured), Vec::<String>::new());
}

/// Triangles that loaders drop are not on the device, and ids are still those of the file.
#[test]
fn bad_coordinates_are_dropped_before_they_poison_anything() {
    let bench = Bench::new();
    let prepared = Prepared::new(&bench, hard_cases::case("C5", Scale::QUICK).expect("it exists"));
    let on_device = prepared.geometry.triangle_count() as usize;
    assert_eq!(prepared.case.triangles.len() - on_device, hard_cases::POISONED_DROPPED);
    assert!(prepared.geometry.bounds().iter().flatten().all(|x| x.abs() < 1e3));
    assert_ne!(prepared.placed.id(on_device as u32 - 1), on_device as u32 - 1);
    let empty = Prepared::new(&bench, hard_cases::case("C1", Scale::QUICK).expect("it exists"));
    assert_eq!(empty.geometry.triangle_count(), 0);
}
