//! Damaged bricks.

use rasray_bricks::{Addressing, Bricks, Config, Contents, Views};
use rasray_faults::{in_child, scrambled};

use crate::damage::survive::{self, Flag, survive};

type Damage = survive::Damage<Contents>;

/// Damage to lists.
const OF_LISTS: [Damage; 4] = [
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
        "lists, entries and bricks at random",
        |c| {
            let mut next = scrambled(0x2545_F491);
            c.lists.fill_with(&mut next);
            c.entries.fill_with(&mut next);
            c.bricks.fill_with(&mut next);
        },
        Flag::Corrupted,
    ),
];

/// Damage to the words and masks of bricks.
const OF_BRICKS: [Damage; 3] = [
    // Every cell lists something, and the numbers of most lists are beyond the last.
    ("bricks with full masks", |c| c.bricks.fill(u32::MAX >> 8), Flag::Corrupted),
    (
        "the lists of every brick are those of the first",
        |c| {
            let words = c.config.brick_words() as usize;
            c.bricks
                .chunks_exact_mut(words)
                .filter(|brick| brick[1] | brick[2] != 0)
                .for_each(|brick| brick[0] = 0)
        },
        Flag::Contents,
    ),
    (
        "bricks at random",
        |c| {
            let mut next = scrambled(0x9E37_79B9);
            c.bricks.fill_with(&mut next);
        },
        Flag::Corrupted,
    ),
];

fn check(config: Config, damages: &[Damage]) {
    let config = Config { grid: Some(16), ..config };
    survive(
        |device, geometry, scene| Bricks::new(device, config, geometry, Some(scene)).expect("valid options"),
        damages,
    );
}

#[test]
fn damaged_lists_of_bricks_are_survived_and_told() {
    if in_child("damage::bricks::damaged_lists_of_bricks_are_survived_and_told") {
        for corners in [true, false] {
            println!("corners kept: {corners}");
            check(Config { corners, ..Config::new(Views::Cube) }, &OF_LISTS);
        }
    }
}

#[test]
fn damaged_bricks_are_survived_and_told() {
    if in_child("damage::bricks::damaged_bricks_are_survived_and_told") {
        for addressing in [Addressing::Descriptor, Addressing::Address] {
            check(Config { addressing, ..Config::new(Views::Cube) }, &OF_BRICKS);
        }
        for divisions in [0, 3] {
            check(Config { divisions: Some(divisions), ..Config::new(Views::Axes) }, &OF_BRICKS);
        }
    }
}
