//! Damaged lists of the A-buffer.

use rasray_abuffer::{ABuffer, Addressing, Config, Contents, Coverage, Storage};
use rasray_faults::{in_child, scrambled};
use rasray_tests::tier::in_turn;

use crate::damage::survive::{self, Flag, each_conservative_node, survive};

type Damage = survive::Damage<Contents>;

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

/// Damage to conservative lists.
const DAMAGES_OF_CONSERVATIVE_LISTS: [Damage; 4] = [
    (
        "every node of a conservative list is its own neighbour",
        |c| each_conservative_node(&mut c.conservative, c.header.conservative_demand, |own| own),
        Flag::Unfinished,
    ),
    (
        "links of conservative lists just past the end",
        |c| {
            let past = c.header.conservative_demand + 1;
            each_conservative_node(&mut c.conservative, c.header.conservative_demand, |_| past);
        },
        Flag::Corrupted,
    ),
    (
        "links of conservative lists far past the end",
        |c| each_conservative_node(&mut c.conservative, c.header.conservative_demand, |_| u32::MAX),
        Flag::Corrupted,
    ),
    (
        "conservative lists at random",
        |c| {
            let mut next = scrambled(0x1234_5677);
            c.conservative.fill_with(&mut next);
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
    survive(
        |device, geometry, scene| ABuffer::new(device, config, geometry, Some(scene)).expect("valid options"),
        damages,
    );
}

#[test]
fn damaged_lists_reached_by_descriptor_are_survived_and_told() {
    if in_child("damage::abuffer::damaged_lists_reached_by_descriptor_are_survived_and_told") {
        check(Config::at_centres(32), &DAMAGES);
    }
}

#[test]
fn damaged_lists_reached_by_address_are_survived_and_told() {
    if in_child("damage::abuffer::damaged_lists_reached_by_address_are_survived_and_told") {
        check(Config { addressing: Addressing::Address, ..Config::at_centres(32) }, &DAMAGES);
    }
}

#[test]
fn damaged_lists_of_the_published_preset_are_survived_and_told() {
    if in_child("damage::abuffer::damaged_lists_of_the_published_preset_are_survived_and_told") {
        check(Config::published(32), &DAMAGES);
    }
}

#[test]
fn damaged_lists_of_every_storage_are_survived_and_told() {
    if in_child("damage::abuffer::damaged_lists_of_every_storage_are_survived_and_told") {
        for (turn, storage) in Storage::ALL.into_iter().enumerate() {
            for &inline in in_turn(&[false, true], turn) {
                println!("{}, inline: {inline}", storage.name());
                check(Config { storage, inline, ..Config::at_centres(32) }, &DAMAGES_OF_ANY);
            }
        }
    }
}

#[test]
fn damaged_conservative_lists_are_survived_and_told() {
    if in_child("damage::abuffer::damaged_conservative_lists_are_survived_and_told") {
        let config = Config { coverage: Coverage::Conservative, ..Config::at_centres(32) };
        for addressing in [Addressing::Descriptor, Addressing::Address] {
            check(Config { addressing, ..config }, &DAMAGES_OF_CONSERVATIVE_LISTS);
        }
    }
}
