//! Builds in pools of every edge capacity.

use rasray_ads::{Check, Hit, Ray, Sizes, Structure, Viewpoint};

use crate::harness::Bench;

/// What a build counts, and the pool that has room for so many.
#[derive(Clone, Copy, Debug)]
pub struct Counted {
    /// Its name in the status of a build.
    pub demand: &'static str,
    /// The name of the pool that grows with it.
    pub pool: &'static str,
}

/// As [`check_capacities`], for what is counted in a pool of scratch, seen from the origin: answers are hits.
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
    let counted = Counted { demand, pool: "scratch" };
    check_capacities(bench, structure, [0.0; 3].into(), counted, sizes, hits)
}

/// Builds a structure in room for none, one, half, all but one and all of what is counted, `sizes` being its
/// pools with room for so many. What has no room is counted and grown, and no build is said to be complete
/// until it has; the answers of the last are those of one in ample room. Returns how many there are, which is
/// more than ten.
///
/// # Panics
/// If the device fails, or any of that does not hold.
pub fn check_capacities<T: PartialEq>(
    bench: &Bench,
    structure: &mut dyn Structure,
    viewpoint: Viewpoint,
    counted: Counted,
    sizes: impl Fn(u64) -> Sizes,
    answers: impl Fn(&dyn Structure) -> T,
) -> u64 {
    let mut build = |room| {
        structure.resize(bench.device(), &sizes(room)).expect("it fits");
        let status = bench.build_once(structure, viewpoint);
        let answers = status.complete.then(|| answers(structure));
        let grown = match structure.check(&status) {
            Check::Complete => None,
            Check::Grow(sizes) => Some(sizes.elements(counted.pool)),
        };
        (status, grown, answers)
    };
    let (ample, grown, expected) = build(1 << 16);
    let demand = ample.demand(counted.demand).expect("it is counted");
    assert!(ample.complete && grown.is_none() && demand > 10, "{ample:?}");
    // Pages come with a little more room: how many are begun depends on which threads meet.
    let enough = sizes(demand).elements(counted.pool)..=sizes(demand + demand / 64).elements(counted.pool);
    for room in [0, 1, demand / 2, demand - 1] {
        let (status, grown, _) = build(room);
        assert_eq!(
            (status.complete, status.demand(counted.demand)),
            (false, Some(demand)),
            "room for {room}"
        );
        assert!(
            grown.is_some_and(|grown| enough.contains(&grown)),
            "room for {room}: {grown:?} of {enough:?}"
        );
    }
    let (status, _, answers) = build(demand);
    assert!(status.complete && answers == expected);
    demand
}
