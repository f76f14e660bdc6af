//! Damaged lists of the layered depth cube.

use rasray_faults::{in_child, scrambled};
use rasray_ldc::{Accept, Addressing, Config, Contents, LayeredDepthCube};

use crate::damage::survive::{self, Flag, each_conservative_node, survive};

type Damage = survive::Damage<Contents>;

/// Damage to lists of fragments.
const OF_LISTS: [Damage; 4] = [
    ("lists that end just past the pool", |c| c.lists.fill(c.header.demand + 1), Flag::Corrupted),
    ("lists that are all ones", |c| c.lists.fill(u32::MAX), Flag::Corrupted),
    ("lists that run backwards", |c| c.lists.reverse(), Flag::Corrupted),
    (
        "lists, depths, payload and blocks at random",
        |c| {
            let mut next = scrambled(0x2545_F491);
            c.lists.fill_with(&mut next);
            c.depths.fill_with(&mut next);
            c.payload.fill_with(&mut next);
            c.blocks.fill_with(&mut next);
            // Some ends of blocks are no numbers; these hold everything.
            c.blocks.iter_mut().step_by(2).for_each(|word| *word = u32::MAX);
        },
        Flag::Corrupted,
    ),
];

/// Damage to conservative lists.
const OF_CONSERVATIVE_LISTS: [Damage; 4] = [
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
    ("heads of conservative lists that are all ones", |c| c.heads.fill(u32::MAX), Flag::Corrupted),
    (
        "heads and conservative lists at random",
        |c| {
            let mut next = scrambled(0x1234_5677);
            c.heads.fill_with(&mut next);
            c.conservative.fill_with(&mut next);
        },
        Flag::Corrupted,
    ),
];

fn check(config: Config, damages: &[Damage]) {
    survive(
        |device, geometry, scene| {
            LayeredDepthCube::new(device, config, geometry, Some(scene)).expect("valid options")
        },
        damages,
    );
}

#[test]
fn damaged_lists_of_layered_depth_cubes_are_survived_and_told() {
    if in_child("damage::ldc::damaged_lists_of_layered_depth_cubes_are_survived_and_told") {
        for addressing in [Addressing::Descriptor, Addressing::Address] {
            check(Config { addressing, ..Config::robust(32) }, &OF_LISTS);
        }
        check(Config::published(32), &OF_LISTS);
    }
}

#[test]
fn damaged_conservative_lists_of_layered_depth_cubes_are_survived_and_told() {
    if in_child("damage::ldc::damaged_conservative_lists_of_layered_depth_cubes_are_survived_and_told") {
        for addressing in [Addressing::Descriptor, Addressing::Address] {
            let accept = Accept::Plane;
            check(Config { accept, addressing, ..Config::robust(32) }, &OF_CONSERVATIVE_LISTS);
        }
    }
}
