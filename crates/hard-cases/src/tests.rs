use super::*;
use rasray_metrics::{DeviceHit, HitConfusion};
use rasray_reference::oracle::{Oracle, Outcome, Verdict};

/// Returns the answer of a perfect single-precision device.
fn device_hit(verdict: &Verdict) -> Option<DeviceHit> {
    verdict.outcome.hit().map(|(primitive, t)| DeviceHit { t: t as f32, primitive: Some(primitive) })
}

/// Checks a case with the verdicts of its rays; returns the faults.
fn failures(case: &HardCase) -> Vec<String> {
    let (positions, indices) = case.buffers();
    let oracle = Oracle::new(&positions, &indices, None).expect("buffers are well formed");
    let verdicts = oracle.closest_batch(&case.rays);
    let mut failures = Vec::new();
    for (index, verdict) in verdicts.iter().enumerate() {
        let answer = case.answer(index);
        let hit = device_hit(verdict);
        // The case says that a watertight test hits, so no rounding may excuse a miss.
        let may_leak = !matches!(answer, Answer::Oracle | Answer::Miss | Answer::Anything { .. })
            && verdict.ambiguous
            && verdict.miss_allowed;
        if !answer.holds_for(hit) || may_leak {
            failures
                .push(format!("{} ray {index}: {answer:?}, {verdict:?}, {:?}", case.id, case.rays[index]));
        }
    }
    failures
}

fn check(ids: &[&str]) {
    for id in ids {
        let case = case(id, Scale::QUICK).expect("the id is in the catalogue");
        let failures = failures(&case);
        assert!(
            failures.is_empty(),
            "{} of {} rays disagree with what is stated; the first: {}",
            failures.len(),
            case.rays.len(),
            failures[0]
        );
    }
}

#[test]
fn the_oracle_agrees_with_every_stated_answer() {
    let slow = ["E2-400", "E2-400-far"];
    let ids: Vec<_> = ids().into_iter().filter(|id| !slow.contains(id)).collect();
    check(&ids);
}

#[test]
fn the_oracle_agrees_on_fine_spheres() {
    check(&["E2-400", "E2-400-far"]);
}

#[test]
fn a_wrong_statement_is_noticed() {
    let mut case = case("E5", Scale::QUICK).expect("the id is in the catalogue");
    case.expect = Expectation::All(Answer::HitAt { t: 1.001, tolerance: 1e-5 });
    assert_eq!(failures(&case).len(), case.rays.len());
    case.expect = Expectation::All(Answer::Miss);
    assert_eq!(failures(&case).len(), case.rays.len());
    // A box without one triangle leaks.
    case.triangles.pop();
    case.expect = Expectation::All(Answer::Hit);
    assert!(!failures(&case).is_empty());
}

#[test]
fn ids_are_unique_and_cases_are_not_empty() {
    let mut ids = ids();
    assert!(ids.len() > 60, "{} cases", ids.len());
    ids.sort_unstable();
    assert!(ids.windows(2).all(|pair| pair[0] != pair[1]));
    for case in cases(Scale { rays: 40, ..Scale::QUICK }) {
        assert!(!case.rays.is_empty() && case.rays.len() <= 40, "{}", case.id);
        assert_eq!(case.triangles.is_empty(), case.id == "C1");
        assert!(case.eye.iter().all(|x| x.is_finite()));
        if let Expectation::PerRay(answers) = &case.expect {
            assert_eq!(answers.len(), case.rays.len(), "{}", case.id);
        }
    }
    assert!(case("E99", Scale::QUICK).is_none());
}

#[test]
fn rays_do_not_depend_on_how_many_are_asked_for() {
    let bits = |ray: Ray| ray.origin.map(f32::to_bits).into_iter().chain(ray.direction.map(f32::to_bits));
    for long in cases(Scale { rays: 50, seed: 7, full: false }) {
        let index = long.rays.len() - 1;
        let alone = replay(long.id, 7, index).expect("the ray exists");
        assert!(bits(alone).eq(bits(long.rays[index])), "{}", long.id);
    }
    let [one, other] = [1, 2].map(|seed| replay("E3", seed, 5).expect("the ray exists"));
    assert_ne!(one, other);
}

#[test]
fn loaders_and_the_oracle_drop_the_same_poisoned_triangles() {
    let case = case("C5", Scale::QUICK).expect("the id is in the catalogue");
    let (positions, indices) = case.buffers();
    let oracle = Oracle::new(&positions, &indices, None).expect("buffers are well formed");
    assert_eq!((case.triangles.len(), oracle.dropped()), (1045, POISONED_DROPPED));
    let hits = oracle.closest_batch(&case.rays).iter().filter(|v| v.outcome != Outcome::Miss).count();
    assert!(hits > 1900, "{hits}");
}

#[test]
fn most_rays_of_most_cases_are_unambiguous() {
    // If rounding decides nothing, a structure has no excuse.
    for id in
        ["G9", "G10", "V1", "V3", "V4", "V7", "Z1", "Z2-6", "Z3-5", "Z6", "Z8", "Z9", "Z13", "C2", "C4", "C5"]
    {
        let case = case(id, Scale::QUICK).expect("the id is in the catalogue");
        let (positions, indices) = case.buffers();
        let oracle = Oracle::new(&positions, &indices, None).expect("buffers are well formed");
        let verdicts = oracle.closest_batch(&case.rays);
        let hits: Vec<_> = verdicts.iter().map(device_hit).collect();
        let confusion = HitConfusion::measure(&verdicts, &hits, 0.0).expect("one hit per verdict");
        assert!(confusion.is_clean(), "{id}: {confusion:?}");
        let share = confusion.ambiguous as f64 / confusion.rays as f64;
        let limit = if id == "Z2-6" { 0.8 } else { 0.05 };
        assert!(share < limit, "{id}: {share} ambiguous");
    }
}

#[test]
fn acceptance_follows_oracle_and_statement() {
    let case = case("Z10", Scale::QUICK).expect("the id is in the catalogue");
    let (positions, indices) = case.buffers();
    let oracle = Oracle::new(&positions, &indices, None).expect("buffers are well formed");
    let verdict = oracle.closest(&case.rays[0]);
    let hit = |primitive, t| Some(DeviceHit { t, primitive: Some(primitive) });
    assert!(case.accepts(0, &verdict, hit(1, 3.5), 1e-6));
    for wrong in [None, hit(0, 6.0), hit(0, 3.5), hit(1, 3.6), hit(1, f32::NAN)] {
        assert!(!case.accepts(0, &verdict, wrong, 1e-6), "{wrong:?}");
    }
}

/// Returns a target's name in the tables of the page, which explains the names above the tables.
fn short(target: Target) -> String {
    let words = target.to_string();
    let name = words.split(':').next().unwrap_or_default();
    name.split(" with ").next().unwrap_or_default().to_owned()
}

/// The page has a row for every file and for every number of the catalogue that has rays, with the ids of all
/// its cases and, for a single case, the title.
#[test]
fn the_page_lists_every_case() {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../../docs/hard-cases.md");
    let page = std::fs::read_to_string(path).expect("the page is there");
    let rows = |row: &CatalogueRow| -> Vec<(String, String)> {
        let dt = row.largest_dt.map_or_else(String::new, |dt| format!(", dt/t at most {dt:.0e}"));
        let primitives = format!("{}{dt}", short(row.target.primitives));
        let fragments = short(row.target.fragments);
        let target = if primitives == fragments { primitives } else { format!("{primitives}; {fragments}") };
        // Most cases have this target, and the page then leaves it out.
        let target = if target == "P1; P2" { String::new() } else { target };
        let cases: Vec<_> = titles().into_iter().filter(|(id, _)| catalogue_row(id) == Some(row)).collect();
        let end = format!("| {target} |");
        if cases.len() == 1 || row.target.primitives == Target::Refused {
            return cases.iter().map(|(id, title)| (format!("| {id} | {title} |"), end.clone())).collect();
        }
        let ids: Vec<_> = cases.iter().map(|(id, _)| *id).collect();
        vec![(format!("| {} |", ids.join(", ")), end)]
    };
    let has =
        |begin: &str, end: &str| page.lines().any(|line| line.starts_with(begin) && line.ends_with(end));
    let missing: Vec<_> = CATALOGUE.iter().flat_map(rows).filter(|(begin, end)| !has(begin, end)).collect();
    assert!(missing.is_empty(), "docs/hard-cases.md lacks rows that begin and end like {missing:#?}");
}
