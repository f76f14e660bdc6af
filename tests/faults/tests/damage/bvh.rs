//! Damaged trees.

use rasray_bvh::{Addressing, Builder, Bvh, Config, Contents};
use rasray_faults::{in_child, scrambled};

use crate::damage::survive::{self, Flag, survive};

type Damage = survive::Damage<Contents>;

/// Sets both children and the parent of every node; `change` is given the node's number and their values.
fn each_node(contents: &mut Contents, mut change: impl FnMut(u32, [u32; 3]) -> [u32; 3]) {
    for (index, node) in contents.nodes.iter_mut().enumerate() {
        [node.child_0, node.child_1, node.parent] =
            change(index as u32, [node.child_0, node.child_1, node.parent]);
    }
}

const DAMAGES: [Damage; 7] = [
    ("every node is its own child", |c| each_node(c, |own, _| [own, own, 2 * own]), Flag::Unfinished),
    ("every child is the root", |c| each_node(c, |_, [_, _, parent]| [0, 0, parent]), Flag::Unfinished),
    (
        "children just past the end",
        |c| {
            let past = c.header.node_capacity;
            each_node(c, |_, [_, _, parent]| [past, past, parent]);
        },
        Flag::Corrupted,
    ),
    (
        "leaves past the end",
        |c| {
            let past = 0x8000_0000 | c.header.record_capacity;
            each_node(c, |_, [_, _, parent]| [past, past, parent]);
        },
        Flag::Corrupted,
    ),
    ("children that are all ones", |c| each_node(c, |_, _| [u32::MAX; 3]), Flag::Corrupted),
    (
        "children and parents at random",
        |c| {
            let mut next = scrambled(0x9E37_79B9);
            each_node(c, |_, _| [next(), next(), next()]);
        },
        Flag::Corrupted,
    ),
    ("every record is another leaf's", |c| c.records.rotate_left(1), Flag::Contents),
];

fn check(config: Config) {
    survive(
        |device, geometry, scene| Bvh::new(device, config, geometry, Some(scene)).expect("valid options"),
        &DAMAGES,
    );
}

#[test]
fn damaged_trees_are_survived_and_told() {
    if in_child("damage::bvh::damaged_trees_are_survived_and_told") {
        for builder in [Builder::Sah, Builder::Lbvh, Builder::Refit] {
            for addressing in [Addressing::Descriptor, Addressing::Address] {
                check(Config { addressing, ..Config::new(builder) });
            }
        }
    }
}
