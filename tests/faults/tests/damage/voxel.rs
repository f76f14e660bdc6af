//! Damaged lists of voxels' views.

use rasray_faults::{in_child, scrambled};
use rasray_tests::tier::in_turn;
use rasray_voxel::{Addressing, Config, Contents, Payload, Storage, Traversal, Voxels};

use crate::damage::survive::{self, Flag, survive};

type Damage = survive::Damage<Contents>;

/// Words of a fragment or a page, and that of its link among them.
fn link_word(config: &Config) -> (usize, usize) {
    let words = config.fragment_words() as usize;
    if config.storage == Storage::Paged { (1 + config.page as usize * words, 0) } else { (words + 1, words) }
}

/// Changes the link of every fragment or page; `change` is given what leads to the fragment or page itself.
fn each_link(contents: &mut Contents, mut change: impl FnMut(u32) -> u32) {
    let (stride, word) = link_word(&contents.config);
    let paged = contents.config.storage == Storage::Paged;
    let count = contents.header.demand.min(contents.header.capacity) as usize;
    for (index, entry) in contents.fragments.chunks_exact_mut(stride).take(count).enumerate() {
        let own = index as u32 + 1;
        entry[word] = change(if paged { own << 4 | 1 } else { own });
    }
}

/// Link to just past the end.
fn past(contents: &Contents) -> u32 {
    let link = contents.header.demand.min(contents.header.capacity) + 1;
    if contents.config.storage == Storage::Paged { link << 4 | 1 } else { link }
}

/// Damage to links.
const OF_LINKS: [Damage; 6] = [
    ("everything is its own neighbour", |c| each_link(c, |own| own), Flag::Corrupted),
    (
        "every list is a circle",
        |c| {
            let config = c.config;
            let (stride, word) = link_word(&config);
            for list in (0..c.lists.len()).filter(|&list| c.lists[list] != 0).collect::<Vec<_>>() {
                let last =
                    *c.places(list).expect("it is whole so far").last().expect("it is not empty") as usize;
                let last = if config.storage == Storage::Paged { last / config.page as usize } else { last };
                c.fragments[stride * last + word] = c.lists[list];
            }
        },
        Flag::Corrupted,
    ),
    (
        "links just past the end",
        |c| {
            let past = past(c);
            each_link(c, |_| past);
        },
        Flag::Corrupted,
    ),
    ("links far past the end", |c| each_link(c, |_| u32::MAX), Flag::Corrupted),
    (
        "lists just past the end",
        |c| {
            let past = past(c);
            c.lists.fill(past);
        },
        Flag::Corrupted,
    ),
    (
        "links at random",
        |c| {
            let mut next = scrambled(0x9E37_79B9);
            each_link(c, |_| next());
        },
        Flag::Corrupted,
    ),
];

/// Damage to any storage.
const OF_ANY: [Damage; 3] = [
    (
        "lists at random",
        |c| {
            let mut next = scrambled(0x1234_5677);
            c.lists.fill_with(&mut next);
        },
        Flag::Corrupted,
    ),
    ("lists that are all ones", |c| c.lists.fill(u32::MAX), Flag::Corrupted),
    (
        "lists and fragments at random",
        |c| {
            let mut next = scrambled(0x2545_F491);
            c.lists.fill_with(&mut next);
            c.fragments.fill_with(&mut next);
        },
        Flag::Corrupted,
    ),
];

const OF_NODES: [Damage; 4] = [
    (
        "nodes at random",
        |c| {
            let mut next = scrambled(0x9E37_79B9);
            c.nodes.fill_with(&mut next);
        },
        Flag::Corrupted,
    ),
    ("nodes that are all ones", |c| c.nodes.fill(u32::MAX), Flag::Corrupted),
    ("octants that begin at the root", |c| c.nodes.iter_mut().for_each(|node| *node &= 0xFF), Flag::Contents),
    ("no node holds anything", |c| c.nodes.fill(0), Flag::Contents),
];

fn check(config: Config, damages: &[Damage]) {
    survive(
        |device, geometry, scene| Voxels::new(device, config, geometry, Some(scene)).expect("valid options"),
        damages,
    );
}

#[test]
fn damaged_links_of_voxels_are_survived_and_told() {
    if in_child("damage::voxel::damaged_links_of_voxels_are_survived_and_told") {
        for storage in [Storage::Linked, Storage::Paged] {
            println!("{}", storage.name());
            check(Config { storage, ..Config::at_centres(32) }, &OF_LINKS);
            check(Config { storage, ..Config::published_hu(32) }, &OF_LINKS);
        }
    }
}

#[test]
fn damaged_links_of_voxels_reached_by_address_are_survived_and_told() {
    if in_child("damage::voxel::damaged_links_of_voxels_reached_by_address_are_survived_and_told") {
        for storage in [Storage::Linked, Storage::Paged] {
            let addressing = Addressing::Address;
            check(Config { storage, addressing, ..Config::at_centres(32) }, &OF_LINKS);
        }
    }
}

#[test]
fn damaged_lists_of_voxels_of_every_storage_are_survived_and_told() {
    if in_child("damage::voxel::damaged_lists_of_voxels_of_every_storage_are_survived_and_told") {
        for (turn, storage) in Storage::ALL.into_iter().enumerate() {
            println!("{}", storage.name());
            let planes = Config { storage, ..Config::at_centres(32) };
            let parity = Config { storage, payload: Payload::Index, ..Config::published_selective(32) };
            for &config in in_turn(&[planes, parity], turn) {
                check(config, &OF_ANY);
            }
        }
    }
}

#[test]
fn damaged_nodes_of_the_octree_are_survived_and_told() {
    if in_child("damage::voxel::damaged_nodes_of_the_octree_are_survived_and_told") {
        let octree = Config { traversal: Traversal::Octree, ..Config::at_centres(32) };
        check(octree, &OF_NODES);
    }
}
