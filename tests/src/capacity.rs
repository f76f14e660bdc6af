//! Builds in pools of every edge capacity.

use rasray_ads::{Check, Hit, Ray, Sizes, Structure};

use crate::harness::Bench;

/// Builds a structure in room for none, one, half, all but one and all of what a pool of its scratch counts, `sizes` being its
/// pools with room for so many. What has no room is counted and grown, and nothing is answered until it has. Returns how many
/// there are, which is more than ten.
///
/// # Panics
/// If the device fails, or any of that does not hold.
pub fn check_capacities_of(
    bench: &Bench,
    structure: &mut dyn Structure,
    pool: &str,
    sizes: impl Fn(u64) -> Sizes,
    rays: &[Ray],
) -> u64 {
    let mut build = |room| {
        structure.resize(bench.device(), &sizes(room)).expect("it fits");
        let status = bench.build_once(structure, [0.0; 3]);
        let hits = if status.complete { bench.trace(structure, rays).hits } else { Vec::new() };
        let grown = match structure.check(&status) {
            Check::Complete => None,
            Check::Grow(sizes) => Some(sizes.elements("scratch")),
        };
        (status, grown, hits)
    };
    let (ample, grown, expected) = build(1 << 16);
    let demand = ample.demand(pool).expect("the pool has a status");
    assert!(ample.complete && grown.is_none() && demand > 10, "{ample:?}");
    assert!(expected.iter().any(Hit::is_hit), "something is hit");
    for room in [0, 1, demand / 2, demand - 1] {
        let (status, grown, _) = build(room);
        assert_eq!((status.complete, status.demand(pool)), (false, Some(demand)), "room for {room}");
        assert_eq!(grown, Some(sizes(demand).elements("scratch")), "room for {room}");
    }
    let (status, _, hits) = build(demand);
    assert!(status.complete && hits == expected);
    demand
}
