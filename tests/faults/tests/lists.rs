//! Lists that were damaged after a build: traces end, say so, and touch nothing that is not theirs.
//!
//! Nothing checks the accesses but the shaders themselves: robust buffer access is never switched on. So everything
//! runs in a process of its own, which may crash or hang without taking the tests along.

use std::time::Instant;

use rasray_abuffer::{ABuffer, Addressing, Config, Contents, Coverage, Storage, well_formed};
use rasray_ads::{Hit, TraceMode};
use rasray_faults::{device, finish, in_child, rays, scrambled, stage};
use rasray_gpu::Timing;
use rasray_tracer::{BatchTracer, TracerError, build_until_complete};

const RAYS: u32 = 96;

/// How traces say that something is wrong.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Flag {
    /// Rays that go round and round are given up and counted.
    Unfinished,
    /// Entries that name nothing are counted.
    Corrupted,
    /// A trace cannot know: the entries name something, only not what they should. The check of the contents does.
    Contents,
}

/// Damage, and what traces say of it.
type Damage = (&'static str, fn(&mut Contents), Flag);

/// Applies a change to the head, the tail and the nodes of every list that is not empty.
fn each_list(contents: &mut Contents, mut change: impl FnMut(&mut [u32], &mut Vec<u32>)) {
    let nodes = &mut contents.nodes;
    for list in contents.lists.chunks_exact_mut(2).filter(|list| list[0] != 0) {
        change(list, nodes);
    }
}

fn stored(contents: &Contents) -> u32 {
    contents.header.demand.min(contents.header.capacity)
}

/// Changes forward and backward link of every stored node; `change` is given the node's own link.
fn each_node(contents: &mut Contents, change: impl Fn(u32) -> [u32; 2]) {
    let count = stored(contents) as usize;
    for (index, node) in contents.nodes.chunks_exact_mut(3).take(count).enumerate() {
        [node[1], node[2]] = change(index as u32 + 1);
    }
}

const DAMAGES: [Damage; 10] = [
    ("every node is its own neighbour", |c| each_node(c, |own| [own, own]), Flag::Unfinished),
    (
        "every list is a circle",
        |c| {
            each_list(c, |list, nodes| {
                let (head, tail) = (list[0], list[1]);
                nodes[3 * (tail as usize - 1) + 1] = head;
                nodes[3 * (head as usize - 1) + 2] = tail;
            });
        },
        Flag::Unfinished,
    ),
    (
        "links just past the end",
        |c| {
            let past = stored(c) + 1;
            each_node(c, |_| [past, past]);
        },
        Flag::Corrupted,
    ),
    ("links far past the end", |c| each_node(c, |_| [u32::MAX, u32::MAX]), Flag::Corrupted),
    ("links past the end of 31 bits", |c| each_node(c, |_| [0x8000_0001, 0x8000_0000]), Flag::Corrupted),
    (
        "heads and tails just past the end",
        |c| {
            let past = stored(c) + 1;
            each_list(c, |list, _| list.fill(past));
        },
        Flag::Corrupted,
    ),
    ("heads and tails far past the end", |c| each_list(c, |list, _| list.fill(u32::MAX)), Flag::Corrupted),
    (
        "every list is another cell's",
        |c| {
            let count = c.lists.len();
            c.lists.rotate_left(2 * (count / 4));
        },
        Flag::Contents,
    ),
    (
        "links at random",
        |c| {
            let mut next = scrambled(0x9E37_79B9);
            let count = 3 * stored(c) as usize;
            for node in c.nodes[..count].chunks_exact_mut(3) {
                [node[1], node[2]] = [next(), next()];
            }
            each_list(c, |list, _| list.fill_with(&mut next));
        },
        Flag::Corrupted,
    ),
    (
        "nodes, payload, lists and bounds at random",
        |c| {
            let mut next = scrambled(0x2545_F491);
            c.nodes.fill_with(&mut next);
            c.data.fill_with(&mut next);
            c.lists.fill_with(&mut next);
            c.bounds.fill_with(&mut next);
        },
        Flag::Corrupted,
    ),
];

/// Changes the link of every node of the fringe; `change` is given the node's own link.
fn each_fringe_node(contents: &mut Contents, change: impl Fn(u32) -> u32) {
    let count = contents.header.fringe_demand as usize;
    for (index, node) in contents.fringe.chunks_exact_mut(2).take(count).enumerate() {
        node[1] = change(index as u32 + 1);
    }
}

/// Damage to what cells keep beside their centres.
const DAMAGES_OF_FRINGES: [Damage; 4] = [
    ("every node of a fringe is its own neighbour", |c| each_fringe_node(c, |own| own), Flag::Unfinished),
    (
        "links of fringes just past the end",
        |c| {
            let past = c.header.fringe_demand + 1;
            each_fringe_node(c, |_| past);
        },
        Flag::Corrupted,
    ),
    ("links of fringes far past the end", |c| each_fringe_node(c, |_| u32::MAX), Flag::Corrupted),
    (
        "fringes at random",
        |c| {
            let mut next = scrambled(0x1234_5677);
            c.fringe.fill_with(&mut next);
        },
        Flag::Corrupted,
    ),
];

/// Damage to any storage.
const DAMAGES_OF_ANY: [Damage; 3] = [
    (
        "lists at random",
        |c| {
            let mut next = scrambled(0x1234_5677);
            c.lists.fill_with(&mut next);
        },
        Flag::Corrupted,
    ),
    ("lists that are all ones", |c| c.lists.fill(u32::MAX), Flag::Corrupted),
    DAMAGES[9],
];

fn check(config: Config, damages: &[Damage]) {
    let device = device().expect("a device");
    let scene = stage(&device).expect("a scene");
    let mut structure =
        ABuffer::new(&device, config, scene.geometry(), Some(scene.binding())).expect("valid options");
    build_until_complete(&device, &mut structure, scene.eye(), Timing::None).expect("a build");
    let tracer = BatchTracer::new(&device, RAYS).expect("a queue");
    let rays = rays(&scene, RAYS);
    let trace = |structure: &ABuffer, mode| {
        tracer.trace(structure, &rays, mode, Timing::None).map(|outcome| outcome.hits)
    };
    let whole = structure.download(&device).expect("contents");
    well_formed(&whole).expect("an undamaged build");
    let expected = trace(&structure, TraceMode::Closest).expect("hits");
    let found = expected.iter().filter(|hit| hit.is_hit()).count();
    // At this resolution the published preset loses many hits.
    assert!(found > 8, "{found} hits");
    for &(name, damage, flag) in damages {
        let mut contents = whole.clone();
        damage(&mut contents);
        assert!(well_formed(&contents).is_err(), "{name}: the check of the contents finds nothing");
        structure.upload(&device, &contents).expect("damaged contents");
        for mode in [TraceMode::Closest, TraceMode::Occluded] {
            let start = Instant::now();
            let result = trace(&structure, mode);
            println!("{name}, {mode:?}: {} in {:?}", words(&result), start.elapsed());
            // A ray that is answered at its first hit need not come to the damage.
            let any = mode == TraceMode::Occluded && flag == Flag::Unfinished;
            let flagged = match flag {
                Flag::Unfinished => matches!(result, Err(TracerError::Unfinished { .. })),
                Flag::Corrupted => matches!(result, Err(TracerError::Corrupted { .. })),
                Flag::Contents => result.is_ok(),
            };
            assert!(flagged || any && result.is_ok(), "{name}, {mode:?}: {}", words(&result));
            // Damage counts once: the next trace is judged by itself.
            structure.upload(&device, &contents).expect("damaged contents");
        }
    }
    structure.upload(&device, &whole).expect("contents");
    assert_eq!(trace(&structure, TraceMode::Closest).expect("hits"), expected, "the damage outlives it");
    let again = build_until_complete(&device, &mut structure, scene.eye(), Timing::None).expect("a build");
    assert_eq!(again.status.corrupted, 0);
    assert_eq!(trace(&structure, TraceMode::Closest).expect("hits"), expected);
    drop((tracer, structure, scene));
    assert_eq!(finish(device), Vec::<String>::new());
}

fn words(result: &Result<Vec<Hit>, TracerError>) -> String {
    match result {
        Ok(hits) => format!("{} hits", hits.iter().filter(|hit| hit.is_hit()).count()),
        Err(error) => error.to_string(),
    }
}

#[test]
fn damaged_lists_reached_by_descriptor_are_survived_and_told() {
    if in_child("damaged_lists_reached_by_descriptor_are_survived_and_told") {
        check(Config::robust(32), &DAMAGES);
    }
}

#[test]
fn damaged_lists_reached_by_address_are_survived_and_told() {
    if in_child("damaged_lists_reached_by_address_are_survived_and_told") {
        check(Config { addressing: Addressing::Address, ..Config::robust(32) }, &DAMAGES);
    }
}

#[test]
fn damaged_lists_of_the_published_preset_are_survived_and_told() {
    if in_child("damaged_lists_of_the_published_preset_are_survived_and_told") {
        check(Config::published(32), &DAMAGES);
    }
}

#[test]
fn damaged_lists_of_every_storage_are_survived_and_told() {
    if in_child("damaged_lists_of_every_storage_are_survived_and_told") {
        for storage in Storage::ALL {
            for inline in [false, true] {
                println!("{}, inline: {inline}", storage.name());
                check(Config { storage, inline, ..Config::robust(32) }, &DAMAGES_OF_ANY);
            }
        }
    }
}

#[test]
fn damaged_fringes_are_survived_and_told() {
    if in_child("damaged_fringes_are_survived_and_told") {
        let config = Config { coverage: Coverage::Conservative, ..Config::robust(32) };
        for addressing in [Addressing::Descriptor, Addressing::Address] {
            check(Config { addressing, ..config }, &DAMAGES_OF_FRINGES);
        }
    }
}
