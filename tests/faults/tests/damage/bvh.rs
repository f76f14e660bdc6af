//! Damaged trees.

use rasray_bvh::{Addressing, Builder, Bvh, Children, Config, Contents, Loads};
use rasray_faults::{in_child, scrambled};

use crate::damage::survive::{self, Flag, survive};

type Damage = survive::Damage<Contents>;

/// A node as damages see it.
struct Own {
    number: u32,
    /// The link of its first child.
    link: u32,
    /// The link by which it is reached.
    parent: u32,
}

/// Sets children and parent of every node: `change` says a first child, what all others are, and the parent.
fn each_node(contents: &mut Contents, mut change: impl FnMut(Own) -> [u32; 3]) {
    for (number, node) in (0..).zip(&mut contents.nodes) {
        let own = Own { number, link: 2 * number, parent: node.parent };
        [node.child_0, node.child_1, node.parent] = change(own);
    }
    for (number, node) in (0..).zip(&mut contents.nodes_of_four) {
        let own = Own { number, link: 4 * number, parent: node.parent };
        let [first, others, parent] = change(own);
        (node.children, node.parent) = ([first, others, others, others], parent);
    }
}

const DAMAGES: [Damage; 7] = [
    (
        "every node is its own child",
        |c| each_node(c, |own| [own.number, own.number, own.link]),
        Flag::Unfinished,
    ),
    ("every child is the root", |c| each_node(c, |own| [0, 0, own.parent]), Flag::Unfinished),
    (
        "children just past the end",
        |c| {
            let past = c.header.node_capacity;
            each_node(c, |own| [past, past, own.parent]);
        },
        Flag::Corrupted,
    ),
    (
        "leaves past the end",
        |c| {
            let past = 0x8000_0000 | c.header.record_capacity;
            each_node(c, |own| [past, past, own.parent]);
        },
        Flag::Corrupted,
    ),
    ("children that are all ones", |c| each_node(c, |_| [u32::MAX; 3]), Flag::Corrupted),
    (
        "children and parents at random",
        |c| {
            let mut next = scrambled(0x9E37_79B9);
            each_node(c, |_| [next(), next(), next()]);
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
        let builders = [Builder::Sah, Builder::Ploc, Builder::Trbvh, Builder::Refit];
        for (builder, children) in
            builders.into_iter().flat_map(|b| [(b, Children::Two), (b, Children::Four)])
        {
            let config = Config { children: Some(children), ..Config::new(builder) };
            if builder == Builder::Refit && children == Children::Two {
                continue;
            }
            for addressing in [Addressing::Descriptor, Addressing::Address] {
                // By default software devices read in words of 64 bits.
                for loads in [None, Some(Loads::Bits32)] {
                    check(Config { addressing, loads, ..config });
                }
            }
        }
    }
}
