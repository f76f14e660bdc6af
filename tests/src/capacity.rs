//! Tests of builds in pools of every edge capacity.

use rasray_ads::kit::VARYING_SHARE;
use rasray_ads::{Check, Hit, Ray, Sizes, Structure, Viewpoint};
use rasray_gpu::{Device, Timing};
use rasray_tracer::build_until_complete;

use crate::harness::Bench;

/// Count of a build, and the pool whose capacity must be that count.
#[derive(Clone, Copy, Debug)]
pub struct Counted {
    /// Name of the count in the status of a build.
    pub demand: &'static str,
    /// Name of the pool that grows with the count.
    pub pool: &'static str,
    /// True for a count of pages, which differs a little between builds: the number of begun pages depends on
    /// the threads that collide.
    pub pages: bool,
}

/// Divisor of the pages that gives the difference allowed between builds of larger scenes, on any device.
const SPREAD_OF_PAGES: u64 = 64;

/// Returns the largest difference between the demands of two builds in pages: the number of begun pages
/// depends on the threads that collide. On a processor so few threads run at a time that small scenes have
/// equal pages in every build.
pub fn spread_of_pages(device: &Device, demand: u64) -> u64 {
    if device.is_software() { 0 } else { demand / 4 }
}

/// Builds in pools that have just grown: once or, if demands `vary`, until the pools have grown enough.
///
/// # Panics
/// If the device fails, or the build is not complete afterwards.
pub fn complete_grown(bench: &Bench, structure: &mut dyn Structure, viewpoint: Viewpoint, vary: bool) {
    if vary {
        build_until_complete(bench.device(), structure, viewpoint, Timing::None)
            .expect("the build completes");
    } else {
        let status = bench.build_once(structure, viewpoint);
        assert!(status.complete, "once grown to its exact demand a build completes");
    }
}

/// Checks as [`check_capacities`] a count whose pool is scratch, seen from the origin; the answers are hits.
///
/// # Panics
/// As [`check_capacities`], or if no ray hits anything.
pub fn check_capacities_of(
    bench: &Bench,
    structure: &mut dyn Structure,
    demand: &'static str,
    sizes: impl Fn(u64) -> Sizes,
    rays: &[Ray],
) -> u64 {
    let hits = |structure: &dyn Structure| {
        let hits = bench.trace(structure, rays).hits;
        assert!(hits.iter().any(Hit::is_hit), "something is hit");
        hits
    };
    let counted = Counted { demand, pool: "scratch", pages: false };
    check_capacities(bench, structure, [0.0; 3].into(), counted, sizes, hits)
}

/// Builds a structure with capacity for none, one, half, all but one and all of the counted entries; `sizes`
/// returns its pools with capacity for that many. Entries without capacity are counted, and the pool grows by
/// the count; no build is complete before that, and the count is enough. The answers of complete builds are
/// those of a build in ample capacity. Returns the number of counted entries, which is more than ten.
///
/// # Panics
/// If the device fails, or any of these conditions does not hold.
pub fn check_capacities<T: PartialEq>(
    bench: &Bench,
    structure: &mut dyn Structure,
    viewpoint: Viewpoint,
    counted: Counted,
    sizes: impl Fn(u64) -> Sizes,
    answers: impl Fn(&dyn Structure) -> T,
) -> u64 {
    let built = |structure: &mut dyn Structure, sizes: &Sizes| {
        structure.resize(bench.device(), sizes).expect("it fits");
        let status = bench.build_once(structure, viewpoint);
        let answers = status.complete.then(|| answers(structure));
        let found = status.demand(counted.demand).expect("it is counted");
        (structure.check(&status, 0).expect("sizes that do"), found, answers)
    };
    let (check, demand, expected) = built(structure, &sizes(1 << 16));
    assert!(check == Check::Complete && expected.is_some() && demand > 10, "{demand} with ample capacity");
    let spread =
        if counted.pages { spread_of_pages(bench.device(), demand).max(demand / SPREAD_OF_PAGES) } else { 0 };
    for capacity in [0, 1, demand / 2, demand - 1] {
        let (check, found, answers) = built(structure, &sizes(capacity));
        assert!(found.abs_diff(demand) <= spread, "capacity for {capacity}: {found} for {demand}");
        let Check::Grow(mut grown) = check else {
            assert!(
                found <= capacity && answers == expected,
                "capacity for {capacity}: complete with {found}"
            );
            continue;
        };
        assert!(found > capacity && answers.is_none(), "capacity for {capacity}: incomplete with {found}");
        // Pools of pages get a little more capacity than the count.
        let more = if counted.pages { found / VARYING_SHARE } else { 0 };
        let enough = sizes(found + more).elements(counted.pool);
        assert_eq!(grown.elements(counted.pool), enough, "capacity for {capacity}");
        // Pools that are counted later, or other pools, may have to grow afterwards.
        let answers = (0..4).find_map(|_| {
            let (check, _, answers) = built(structure, &grown);
            if let Check::Grow(more) = check {
                grown = more;
            }
            answers
        });
        assert!(answers == expected, "capacity for {capacity}: its demand is not enough, or changes answers");
    }
    let (check, found, answers) = built(structure, &sizes(demand + spread));
    assert!(check == Check::Complete && answers == expected, "capacity for {demand}: {found}");
    demand
}
