//! Pools of every edge capacity: exact demands, no partial answers, bytes as the formula says, lists well
//! formed; and the check of lists notices every fault.

mod faults;

use rasray_abuffer::{
    ABuffer, Accept, Addressing, Config, Contents, Coverage, Demand, March, Payload, Storage, formula_bytes,
    plan, well_formed,
};
use rasray_ads::kit::VARYING_SHARE;
use rasray_ads::{BuildStatus, Check, Ray, Structure, TraceMode};
use rasray_tests::capacity::{complete_grown, spread_of_pages};
use rasray_tests::conformance::trace_in_rounds;
use rasray_tests::harness::{Bench, bits_of_any_build};
use rasray_tests::rays::around_the_eye;
use rasray_tests::shapes::{NEAR_TRIANGLES, layers_around_the_eye};
use rasray_tests::tier::{first, in_turn};

const EYE: [f32; 3] = [0.0; 3];

fn config(storage: Storage) -> Config {
    Config { storage, ..Config::at_centres(16) }
}

/// [`config`] with conservative lists.
fn nearby(storage: Storage) -> Config {
    Config { coverage: Coverage::Conservative, ..config(storage) }
}

/// Capacity for that many fragments and triangles around the eye.
fn capacity(fragments: u64, near_triangles: u64) -> Demand {
    Demand {
        nodes: fragments,
        near_triangles,
        triangles: layers_around_the_eye().len() as u64,
        ..Demand::default()
    }
}

/// Hits of rays, bit for bit but for the numbers of nodes.
fn trace(bench: &Bench, structure: &ABuffer, rays: &[Ray]) -> Vec<[u32; 4]> {
    let (hits, counters) = trace_in_rounds(bench, structure, rays, TraceMode::Closest, 4);
    assert_eq!((counters.not_ready, counters.unfinished), (0, 0));
    hits.iter().map(bits_of_any_build).collect()
}

fn demand(status: &BuildStatus, name: &str) -> u64 {
    status.demand(name).expect("the pool is counted")
}

fn check_well_formed(bench: &Bench, structure: &ABuffer) -> Contents {
    let contents = structure.download(bench.device()).expect("the device works");
    well_formed(&contents).expect("lists are well formed");
    contents
}

fn every_edge_capacity(config: Config) {
    let bench = Bench::new();
    let (triangles, rays) = (layers_around_the_eye(), around_the_eye());
    let geometry = bench.geometry(&triangles);
    let mut structure = ABuffer::new(bench.device(), config, &geometry, None).expect("the options are valid");

    // Ample capacity: what the demand and the hits are.
    structure
        .resize(bench.device(), &plan(&config, capacity(1 << 20, 1 << 10)).expect("in range"))
        .expect("it fits");
    let status = bench.build_once(&mut structure, EYE);
    assert!(status.complete);
    let (nodes, near) = (demand(&status, "nodes"), demand(&status, "near"));
    assert!(nodes > 1000 && near == NEAR_TRIANGLES, "{status:?}");
    check_well_formed(&bench, &structure);
    let expected = trace(&bench, &structure, &rays);

    // Pages come with a little more capacity: the number of begun pages depends on which threads collide.
    let pages = config.storage == Storage::Paged;
    let spread = if pages { spread_of_pages(bench.device(), nodes) } else { 0 };
    let enough = nodes + spread;
    let full = [0, 1, nodes / 2, nodes - spread - 1, enough].map(|capacity| (capacity, near));
    let near_full = [0, 1, near / 2, near - 1].map(|capacity| (enough, capacity));
    for (nodes_capacity, near_capacity) in full.into_iter().chain(near_full).chain([(0, 0)]) {
        let sizes = plan(&config, capacity(nodes_capacity, near_capacity)).expect("in range");
        structure.resize(bench.device(), &sizes).expect("it fits");
        let status = bench.build_once(&mut structure, EYE);
        let fits = nodes_capacity >= nodes && near_capacity >= near;
        assert_eq!(status.complete, fits, "{config:?}: capacity for {nodes_capacity} and {near_capacity}");
        let found = demand(&status, "nodes");
        assert!(found.abs_diff(nodes) <= spread, "capacity for {nodes_capacity}: {found} for {nodes}");
        assert_eq!(demand(&status, "near"), near, "capacity for {nodes_capacity}");
        check_well_formed(&bench, &structure);
        if fits {
            assert_eq!(structure.check(&status, 0).expect("sizes that do"), Check::Complete);
            assert_eq!(trace(&bench, &structure, &rays), expected);
            continue;
        }
        for mode in [TraceMode::Closest, TraceMode::Occluded] {
            let (hits, counters) = trace_in_rounds(&bench, &structure, &rays, mode, 4);
            assert_eq!(
                counters.not_ready as usize,
                rays.len(),
                "capacity for {nodes_capacity} and {near_capacity}, {mode:?}"
            );
            assert!(
                hits.iter().all(|hit| !hit.is_hit()),
                "a partial answer with capacity for {nodes_capacity}"
            );
        }
        let Check::Grow(sizes) = structure.check(&status, 0).expect("sizes that do") else {
            panic!("capacity for {nodes_capacity} does not grow")
        };
        let more = if pages { found / VARYING_SHARE } else { 0 };
        let grown = if nodes_capacity < found { found + more } else { nodes_capacity };
        assert_eq!((sizes.elements("nodes"), sizes.elements("near")), (Some(grown), Some(near)));
        structure.resize(bench.device(), &sizes).expect("it fits");
        complete_grown(&bench, &mut structure, EYE.into(), spread > 0);
        check_well_formed(&bench, &structure);
        assert_eq!(
            trace(&bench, &structure, &rays),
            expected,
            "grown from {nodes_capacity} and {near_capacity}"
        );
    }
}

#[test]
fn every_edge_capacity_of_every_storage() {
    for storage in Storage::ALL {
        every_edge_capacity(config(storage));
    }
}

#[test]
fn every_edge_capacity_of_inline_payload() {
    for &storage in first(&[Storage::Dllb, Storage::Paged, Storage::Ll, Storage::Sb], 2) {
        every_edge_capacity(Config { inline: true, ..config(storage) });
    }
}

#[test]
fn every_edge_capacity_of_a_single_layer_and_of_planes() {
    let storages = [Storage::Ll, Storage::Dllb, Storage::Sb, Storage::Paged];
    for (index, storage) in storages.into_iter().enumerate() {
        let config = config(storage);
        let tried = [Config { single_layer: true, ..config }, Config { payload: Payload::Plane, ..config }];
        for &config in in_turn(&tried, index) {
            every_edge_capacity(config);
        }
    }
}

#[test]
fn every_edge_capacity_with_addresses() {
    for &storage in first(&[Storage::Sb, Storage::Dllb], 1) {
        every_edge_capacity(Config { addressing: Addressing::Address, ..config(storage) });
    }
}

/// Triangles beyond the capacity of the conservative list are counted, whether or not the lists have
/// capacity.
#[test]
fn every_edge_capacity_of_the_conservative_lists() {
    let edge_on = Config { coverage: Coverage::EdgeOn, ..config(Storage::Dllb) };
    let storages = [Storage::Ll, Storage::Sb, Storage::Paged, Storage::Dll, Storage::Llb, Storage::Dllb];
    for config in first(&storages, 3).iter().copied().map(nearby).chain([edge_on]) {
        let bench = Bench::new();
        let (triangles, rays, storage) = (layers_around_the_eye(), around_the_eye(), config.storage);
        let geometry = bench.geometry(&triangles);
        let mut structure =
            ABuffer::new(bench.device(), config, &geometry, None).expect("the options are valid");
        let mut build = |nodes, conservative| {
            let sizes =
                plan(&config, Demand { conservative, ..capacity(nodes, NEAR_TRIANGLES) }).expect("in range");
            structure.resize(bench.device(), &sizes).expect("it fits");
            let status = bench.build_once(&mut structure, EYE);
            check_well_formed(&bench, &structure);
            let grown = match structure.check(&status, 0).expect("sizes that do") {
                Check::Complete => None,
                Check::Grow(sizes) => sizes.elements("nodes").zip(sizes.elements("conservative")),
            };
            let (hits, counters) = trace_in_rounds(&bench, &structure, &rays, TraceMode::Closest, 4);
            assert_eq!(status.complete, counters.not_ready == 0, "{config:?}");
            (status, grown, hits)
        };
        let (ample, grown, expected) = build(1 << 20, 1 << 16);
        assert!(ample.complete && grown.is_none());
        let (nodes, conservative) = (demand(&ample, "nodes"), demand(&ample, "conservative"));
        assert!(conservative > 100, "{ample:?}");
        // The pages that are begun depend on the threads that collide.
        let spread = spread_of_pages(bench.device(), nodes).max(nodes / 8);
        let all = if storage == Storage::Paged { nodes + spread } else { nodes };
        for capacity in [0, 1, conservative / 2, conservative - 1, conservative] {
            let (status, grown, hits) = build(all, capacity);
            assert_eq!(demand(&status, "conservative"), conservative, "{storage:?}: capacity for {capacity}");
            if capacity == conservative {
                assert!(status.complete && hits == expected, "{storage:?}");
            } else {
                assert_eq!(grown, Some((all, conservative)), "{storage:?}: capacity for {capacity}");
                assert!(
                    hits.iter().all(|hit| !hit.is_hit()),
                    "a partial answer with capacity for {capacity}"
                );
            }
        }
        let (status, grown, _) = build(nodes / 2, 0);
        assert_eq!(demand(&status, "conservative"), conservative);
        assert!(
            grown.is_some_and(|(capacity, nearby)| capacity >= nodes && nearby == conservative),
            "{grown:?}"
        );
    }
}

#[test]
fn a_structure_that_was_never_built_is_not_ready() {
    let bench = Bench::new();
    let geometry = bench.geometry(&layers_around_the_eye());
    let config = config(Storage::Dllb);
    let structure = ABuffer::new(bench.device(), config, &geometry, None).expect("the options are valid");
    let rays = around_the_eye();
    let (hits, counters) = trace_in_rounds(&bench, &structure, &rays, TraceMode::Closest, 2);
    assert_eq!(counters.not_ready as usize, rays.len());
    assert!(hits.iter().all(|hit| !hit.is_hit()));
}

#[test]
fn formula_equals_allocations_without_slack() {
    let bench = Bench::new();
    let geometry = bench.geometry(&layers_around_the_eye());
    let robust = Config::at_centres;
    let mut configs: Vec<Config> = Storage::ALL.map(config).into();
    let storages = [Storage::Ll, Storage::Sb, Storage::Paged, Storage::Dll, Storage::Llb, Storage::Dllb];
    configs.extend(first(&storages, 3).iter().map(|&storage| Config {
        inline: true,
        accept: Accept::Interval,
        ..config(storage)
    }));
    configs.push(Config { accept: Accept::Interval, buckets: 1, ..robust(9) });
    configs.push(Config { buckets: 32, ..robust(5) });
    configs.extend(
        first(&[Storage::Sb, Storage::Dllb], 1)
            .iter()
            .map(|&storage| Config { march: March::Pyramid, ..config(storage) }),
    );
    configs.extend(first(&[2, 1, 8], 1).iter().map(|&page| Config { page, ..config(Storage::Paged) }));
    configs.extend(first(&[Storage::Ll, Storage::Paged, Storage::Dllb], 2).iter().copied().map(nearby));
    for config in configs {
        let before = bench.device().allocated_bytes();
        let mut structure = ABuffer::new(bench.device(), config, &geometry, None).expect("valid");
        structure
            .resize(
                bench.device(),
                &plan(&config, Demand { conservative: 50_000, ..capacity(50_000, 7) }).expect("in range"),
            )
            .expect("it fits");
        let status = bench.build_once(&mut structure, EYE);
        assert!(status.complete);
        let report = structure.report().expect("the header is readable");
        let part = |name| report.bytes_by_part.iter().find(|part| part.0 == name).expect("the part exists").1;
        assert_eq!(report.formula_bytes, report.bytes() - part("slack"));
        assert!(part("slack") > 0);
        let fragments = match config.storage {
            Storage::Paged => structure.header().expect("the header is readable").fragments.into(),
            _ => demand(&status, "nodes"),
        };
        let conservative = demand(&status, "conservative");
        assert_eq!(conservative > 0, config.coverage == Coverage::Conservative);
        assert_eq!(report.stored, Some(fragments + conservative));
        let counted = Demand { conservative, ..capacity(demand(&status, "nodes"), demand(&status, "near")) };
        assert_eq!(report.formula_bytes, formula_bytes(&config, counted).total());
        // Reported bytes are those allocated: downloads have that size, and so has device memory.
        assert_eq!(report.bytes(), structure.sizes().bytes());
        let contents = check_well_formed(&bench, &structure);
        let words = [
            &contents.bounds,
            &contents.lists,
            &contents.nodes,
            &contents.data,
            &contents.near,
            &contents.scratch,
            &contents.conservative,
        ]
        .iter()
        .map(|pool| pool.len())
        .sum::<usize>();
        assert_eq!(words as u64 * 4 + size_of::<rasray_abuffer::Header>() as u64, report.bytes());
        let allocated = bench.device().allocated_bytes() - before;
        assert!(allocated >= report.bytes(), "{allocated} bytes allocated, {} reported", report.bytes());
        // Two host copies of the header, and every buffer rounded up.
        assert!(
            allocated <= report.bytes() + 10 * 4096,
            "{allocated} allocated, {} reported",
            report.bytes()
        );
    }
}
