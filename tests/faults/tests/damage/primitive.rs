//! Damaged primitive lists, linked and contiguous.

use rasray_faults::{in_child, scrambled};
use rasray_primitive::{Addressing, Config, Contents, PrimitiveLists, Storage};

use crate::damage::survive::{self, Flag, survive};

type Damage = survive::Damage<Contents>;

fn stored(contents: &Contents) -> u32 {
    contents.header.demand.min(contents.header.capacity)
}

/// Changes the link of every node; `change` is given the node's own link.
fn each_link(contents: &mut Contents, change: impl Fn(u32) -> u32) {
    let count = stored(contents) as usize;
    for (index, node) in contents.entries.chunks_exact_mut(2).take(count).enumerate() {
        node[1] = change(index as u32 + 1);
    }
}

/// Damage to linked lists.
const OF_LINKS: [Damage; 4] = [
    ("every node is its own neighbour", |c| each_link(c, |own| own), Flag::Unfinished),
    (
        "links just past the end",
        |c| {
            let past = stored(c) + 1;
            each_link(c, |_| past);
        },
        Flag::Corrupted,
    ),
    ("links far past the end", |c| each_link(c, |_| u32::MAX), Flag::Corrupted),
    (
        "heads just past the end",
        |c| {
            let past = stored(c) + 1;
            c.lists.iter_mut().filter(|head| **head != 0).for_each(|head| *head = past);
        },
        Flag::Corrupted,
    ),
];

/// Damage to any storage.
const OF_ANY: [Damage; 4] = [
    (
        "lists at random",
        |c| {
            let mut next = scrambled(0x1234_5677);
            c.lists.fill_with(&mut next);
        },
        Flag::Corrupted,
    ),
    ("lists that are all ones", |c| c.lists.fill(u32::MAX), Flag::Corrupted),
    ("entries with invalid triangle indices", |c| c.entries.fill(u32::MAX - 1), Flag::Corrupted),
    (
        "lists, entries and bounds at random",
        |c| {
            let mut next = scrambled(0x2545_F491);
            c.lists.fill_with(&mut next);
            c.entries.fill_with(&mut next);
            c.bounds.fill_with(&mut next);
        },
        Flag::Corrupted,
    ),
];

fn check(config: Config, damages: &[Damage]) {
    survive(
        |device, geometry, scene| {
            PrimitiveLists::new(device, config, geometry, Some(scene)).expect("valid options")
        },
        damages,
    );
}

#[test]
fn damaged_links_of_primitives_are_survived_and_told() {
    if in_child("damage::primitive::damaged_links_of_primitives_are_survived_and_told") {
        for addressing in [Addressing::Descriptor, Addressing::Address] {
            check(Config { storage: Storage::Linked, addressing, ..Config::robust(32) }, &OF_LINKS);
        }
        check(Config::published(32), &OF_LINKS);
    }
}

#[test]
fn damaged_lists_of_primitives_of_every_storage_are_survived_and_told() {
    if in_child("damage::primitive::damaged_lists_of_primitives_of_every_storage_are_survived_and_told") {
        for storage in [Storage::Linked, Storage::Contiguous] {
            println!("{storage:?}");
            check(Config { storage, ..Config::robust(32) }, &OF_ANY);
        }
    }
}
