//! The check of lists notices every fault.

use rasray_abuffer::{ABuffer, Config, Contents, Demand, Fault, Storage, plan, well_formed};
use rasray_ads::{Ray, Structure, TraceMode};
use rasray_tests::conformance::trace_in_rounds;
use rasray_tests::harness::Bench;
use rasray_tests::random::Random;
use rasray_tests::shapes::layers_around_the_eye;

use super::{EYE, capacity, check_well_formed, config, nearby};

#[test]
fn every_fault_of_a_conservative_list_is_noticed() {
    let bench = Bench::new();
    let (geometry, config) = (bench.geometry(&layers_around_the_eye()), nearby(Storage::Dllb));
    let mut structure = ABuffer::new(bench.device(), config, &geometry, None).expect("the options are valid");
    let sizes = plan(&config, Demand { conservative: 1 << 16, ..capacity(50_000, 64) }).expect("in range");
    structure.resize(bench.device(), &sizes).expect("it fits");
    assert!(bench.build_once(&mut structure, EYE).complete);
    let good = check_well_formed(&bench, &structure);
    let cells = rasray_abuffer::cell_count(&config) as usize;
    // Marks follow, fewer than there are cells.
    let stride = good.bounds.len() / cells;
    let head = (0..cells)
        .map(|cell| (cell + 1) * stride - 1)
        .find(|&word| good.bounds[word] != 0)
        .expect("a cell has a conservative list");
    let node = good.bounds[head] as usize - 1;
    let broken = |spoil: &dyn Fn(&mut Contents)| {
        let mut contents = good.clone();
        spoil(&mut contents);
        well_formed(&contents).expect_err("the fault is noticed")
    };
    assert!(matches!(broken(&|c| c.header.conservative_demand += 1), Fault::Count { .. }));
    assert!(matches!(broken(&|c| c.bounds[head] = 0), Fault::Count { .. }));
    assert!(matches!(broken(&|c| c.bounds[head] = u32::MAX), Fault::Conservative { .. }));
    assert!(matches!(broken(&|c| c.conservative[3 * node + 1] = c.bounds[head]), Fault::Conservative { .. }));
    // Traces end whatever links say, and count invalid ones.
    let mut dangling = good.clone();
    for cell in 0..cells {
        dangling.bounds[(cell + 1) * stride - 1] = u32::MAX;
    }
    // SAFETY: the header's capacities and addresses are those that were downloaded, and nothing was resized
    // since.
    unsafe { structure.upload(bench.device(), &dangling) }.expect("the device works");
    // Rays from the eye pass no other cell than their own.
    let mut random = Random::new(900);
    let rays: Vec<Ray> = (0..4000).map(|_| Ray::new(EYE, random.direction())).collect();
    let (_, counters) = trace_in_rounds(&bench, &structure, &rays, TraceMode::Closest, 4);
    assert!(counters.corrupted > 0);
}

/// The links of a list with at least three nodes, and where its head is stored.
fn long_list(contents: &Contents) -> (usize, Vec<usize>) {
    for list in (0..contents.lists.len()).step_by(2) {
        let mut links = Vec::new();
        let mut link = contents.lists[list] as usize;
        while link != 0 {
            links.push(link);
            link = contents.nodes[3 * (link - 1) + 1] as usize;
        }
        if links.len() >= 3 && contents.nodes[3 * (links[0] - 1)] != contents.nodes[3 * (links[2] - 1)] {
            return (list, links);
        }
    }
    panic!("the scene has no list of three nodes");
}

#[test]
fn every_fault_of_a_list_is_noticed() {
    let bench = Bench::new();
    let geometry = bench.geometry(&layers_around_the_eye());
    let config = Config { buckets: 2, ..Config::at_centres(16) };
    let mut structure = ABuffer::new(bench.device(), config, &geometry, None).expect("the options are valid");
    structure
        .resize(bench.device(), &plan(&config, capacity(50_000, 64)).expect("in range"))
        .expect("it fits");
    assert!(bench.build_once(&mut structure, EYE).complete);
    let good = check_well_formed(&bench, &structure);
    let (list, links) = long_list(&good);
    let [next, prev] = [|link: usize| 3 * (link - 1) + 1, |link: usize| 3 * (link - 1) + 2];
    let depth = |link: usize| 3 * (link - 1);
    type Spoil<'a> = Box<dyn Fn(&mut Contents) + 'a>;
    type Is = fn(&Fault) -> bool;
    let faults: Vec<(&str, Spoil<'_>, Is)> = vec![
        ("a link past the pool", Box::new(|c| c.nodes[next(links[0])] = 49_999), |f| {
            matches!(f, Fault::Dangling { .. })
        }),
        ("a head past the pool", Box::new(|c| c.lists[list] = u32::MAX), |f| {
            matches!(f, Fault::Dangling { .. })
        }),
        ("a node that was lost", Box::new(|c| c.header.demand += 1), |f| matches!(f, Fault::Count { .. })),
        ("a list that was lost", Box::new(|c| (c.lists[list], c.lists[list + 1]) = (0, 0)), |f| {
            matches!(f, Fault::Count { .. })
        }),
        ("a wrong backward link", Box::new(|c| c.nodes[prev(links[1])] = 0), |f| {
            matches!(f, Fault::Backward { .. })
        }),
        ("a wrong tail", Box::new(|c| c.lists[list + 1] = links[0] as u32), |f| {
            matches!(f, Fault::Tail { .. })
        }),
        ("two depths exchanged", Box::new(|c| c.nodes.swap(depth(links[0]), depth(links[2]))), |f| {
            matches!(f, Fault::Order { .. })
        }),
        ("no depth", Box::new(|c| c.nodes[depth(links[1])] = f32::NAN.to_bits()), |f| {
            matches!(f, Fault::Depth { .. })
        }),
        ("a depth behind the eye", Box::new(|c| c.nodes[depth(links[0])] = (-1.0_f32).to_bits()), |f| {
            matches!(f, Fault::Depth { .. })
        }),
        ("a depth out of bounds", Box::new(|c| c.nodes[depth(links[2])] = 1.0e9_f32.to_bits()), |f| {
            matches!(f, Fault::Depth { .. })
        }),
        // Reading a cyclic list ends all the same.
        ("a circle", Box::new(|c| c.nodes[next(links[2])] = links[0] as u32), |f| {
            matches!(f, Fault::Backward { .. } | Fault::Order { .. } | Fault::Dangling { .. })
        }),
    ];
    for (name, spoil, is_expected) in faults {
        let mut contents = good.clone();
        spoil(&mut contents);
        match well_formed(&contents) {
            Ok(()) => panic!("{name} goes unnoticed"),
            Err(fault) => assert!(is_expected(&fault), "{name}: {fault}"),
        }
    }
}

#[test]
fn every_fault_of_a_contiguous_list_is_noticed() {
    let bench = Bench::new();
    let geometry = bench.geometry(&layers_around_the_eye());
    let config = config(Storage::Sb);
    let mut structure = ABuffer::new(bench.device(), config, &geometry, None).expect("the options are valid");
    structure
        .resize(bench.device(), &plan(&config, capacity(50_000, 64)).expect("in range"))
        .expect("it fits");
    assert!(bench.build_once(&mut structure, EYE).complete);
    let good = check_well_formed(&bench, &structure);
    let counts = good.lists.len() / 2;
    let cell = (0..counts).find(|cell| good.lists[counts + cell] >= 3).expect("a cell has three fragments");
    let node = 2 * good.lists[cell] as usize;
    type Spoil<'a> = Box<dyn Fn(&mut Contents) + 'a>;
    type Is = fn(&Fault) -> bool;
    let faults: Vec<(&str, Spoil<'_>, Is)> = vec![
        ("a count too many", Box::new(|c| c.lists[counts + cell] += 1), |f| {
            matches!(f, Fault::Place { .. } | Fault::Order { .. })
        }),
        ("a place too far", Box::new(|c| c.lists[cell] += 1), |f| matches!(f, Fault::Place { .. })),
        ("a count past the pool", Box::new(|c| c.lists[counts + cell] = 50_001), |f| {
            matches!(f, Fault::Dangling { .. })
        }),
        ("a node that was lost", Box::new(|c| c.header.demand += 1), |f| matches!(f, Fault::Count { .. })),
        ("two depths exchanged", Box::new(|c| c.nodes.swap(node, node + 4)), |f| {
            matches!(f, Fault::Order { .. })
        }),
        ("no depth", Box::new(|c| c.nodes[node] = f32::NAN.to_bits()), |f| matches!(f, Fault::Depth { .. })),
        ("a payload past the pool", Box::new(|c| c.nodes[node + 1] = 50_001), |f| {
            matches!(f, Fault::Payload { .. })
        }),
        ("a payload twice", Box::new(|c| c.nodes[node + 1] = c.nodes[node + 3]), |f| {
            matches!(f, Fault::Payload { .. })
        }),
    ];
    for (name, spoil, is_expected) in faults {
        let mut contents = good.clone();
        spoil(&mut contents);
        match well_formed(&contents) {
            Ok(()) => panic!("{name} goes unnoticed"),
            Err(fault) => assert!(is_expected(&fault), "{name}: {fault}"),
        }
    }
}

#[test]
fn every_fault_of_a_page_is_noticed() {
    let bench = Bench::new();
    let geometry = bench.geometry(&layers_around_the_eye());
    let config = Config { page: 4, buckets: 1, ..config(Storage::Paged) };
    let mut structure = ABuffer::new(bench.device(), config, &geometry, None).expect("the options are valid");
    structure
        .resize(bench.device(), &plan(&config, capacity(50_000, 64)).expect("in range"))
        .expect("it fits");
    assert!(bench.build_once(&mut structure, EYE).complete);
    let good = check_well_formed(&bench, &structure);
    // A list of two pages; the first one to be read is the younger.
    let page_of = |word: u32| 5 * ((word >> 4) as usize - 1);
    let list = (0..good.lists.len())
        .find(|list| good.lists[*list] != 0 && good.nodes[page_of(good.lists[*list])] != 0)
        .expect("a cell has two pages");
    let first = page_of(good.lists[list]);
    let second = page_of(good.nodes[first]);
    type Spoil<'a> = Box<dyn Fn(&mut Contents) + 'a>;
    type Is = fn(&Fault) -> bool;
    let faults: Vec<(&str, Spoil<'_>, Is)> = vec![
        ("a page past the pool", Box::new(|c| c.nodes[second] = 60_000 << 4 | 1), |f| {
            matches!(f, Fault::Dangling { .. })
        }),
        ("a circle", Box::new(|c| c.nodes[second] = c.lists[list]), |f| matches!(f, Fault::Page { .. })),
        ("a page that was lost", Box::new(|c| c.nodes[first] = 0), |f| matches!(f, Fault::Count { .. })),
        ("a slot too many", Box::new(|c| c.lists[list] ^= 1), |f| matches!(f, Fault::Page { .. })),
        ("two depths exchanged", Box::new(|c| c.nodes.swap(second + 1, second + 4)), |f| {
            matches!(f, Fault::Order { .. })
        }),
        ("no depth", Box::new(|c| c.nodes[second + 4] = f32::NAN.to_bits()), |f| {
            matches!(f, Fault::Depth { .. })
        }),
    ];
    for (name, spoil, is_expected) in faults {
        let mut contents = good.clone();
        spoil(&mut contents);
        match well_formed(&contents) {
            Ok(()) => panic!("{name} goes unnoticed"),
            Err(fault) => assert!(is_expected(&fault), "{name}: {fault}"),
        }
    }
}
