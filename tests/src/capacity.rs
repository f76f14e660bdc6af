//! Builds in pools of every edge capacity.

use rasray_ads::{Check, Ray, Sizes, Structure};

use crate::harness::Bench;

/// Builds a structure with the binning builder in room for none, one, half, all but one and all of the triangles with many
/// cells, `sizes` being its pools with room for so many. What has no room is counted and grown, and nothing is answered until it
/// has. Returns how many such triangles there are.
///
/// # Panics
/// If the device fails, or any of that does not hold.
pub fn check_capacities_of_pairs(
    bench: &Bench,
    structure: &mut dyn Structure,
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
    let pairs = ample.demand("pairs").expect("the pool has a status");
    assert!(ample.complete && grown.is_none() && pairs > 10, "{ample:?}");
    for room in [0, 1, pairs / 2, pairs - 1] {
        let (status, grown, _) = build(room);
        assert_eq!((status.complete, status.demand("pairs")), (false, Some(pairs)), "room for {room}");
        assert_eq!(grown, Some(sizes(pairs).elements("scratch")), "room for {room}");
    }
    let (status, _, hits) = build(pairs);
    assert!(status.complete && hits == expected);
    pairs
}
