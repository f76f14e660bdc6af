//! Conversion of trees with two children per node to trees with four.
//!
//! The conversion keeps the nodes of the tree of two that lower the surface area heuristic's cost the most.
//! It finds them from the leaves up: Ylitie, Karras, Laine, "Efficient incoherent ray traversal on GPUs
//! through compressed wide BVHs", HPG 2017, section 3.1. Leaves stay as they are; boxes are stored in steps.

use rasray_shaders_glsl::constants::bvh::{BVH_FOUR, BVH_LEAF, BVH_NONE};

use crate::NodeOfFour;
use crate::host::{Box3, Tree, triangles_of};
use crate::validate::area;

/// Maximum number of children of a node.
const FOUR: usize = BVH_FOUR as usize;

/// Least costs of a subtree as exactly 1, 2, 3 and 4 children of a node (infinity if the subtree has fewer
/// leaves), and the number of these children that its first half takes in each case.
#[derive(Clone, Copy, Debug)]
struct Choice {
    costs: [f64; FOUR],
    first: [u8; FOUR],
}

impl Choice {
    /// Returns the choice of a leaf, which is one child and costs its triangles, by area.
    fn leaf(reference: u32, bounds: Box3) -> Self {
        let mut costs = [f64::INFINITY; FOUR];
        costs[0] = area(bounds) * f64::from(triangles_of(reference));
        Self { costs, first: [0; FOUR] }
    }

    /// Returns the choice of an inner node. The node is either divided between several children, or is one
    /// child: a node of its own, with as many children as it can have. A node with fewer than four children
    /// therefore has leaves only, which bounds the number of nodes.
    fn inner(bounds: Box3, halves: [Self; 2]) -> Self {
        let mut choice = Self { costs: [f64::INFINITY; FOUR], first: [0; FOUR] };
        for children in 2..=FOUR {
            for of_first in 1..children {
                let cost = halves[0].costs[of_first - 1] + halves[1].costs[children - of_first - 1];
                if cost < choice.costs[children - 1] {
                    (choice.costs[children - 1], choice.first[children - 1]) = (cost, of_first as u8);
                }
            }
        }
        choice.costs[0] = area(bounds) + choice.costs[choice.most() - 1];
        choice
    }

    /// Returns the maximum number of children that the subtree can be.
    fn most(&self) -> usize {
        (2..=FOUR).rev().find(|children| self.costs[children - 1] < f64::INFINITY).unwrap_or(1)
    }
}

/// Widens a tree to up to four children per node, with the leaves in the same order. Returns no nodes if the
/// root is a leaf. The root's number is 0 in both trees.
pub(crate) fn with_four_children(tree: &Tree) -> Vec<NodeOfFour> {
    if tree.root == BVH_NONE || tree.root & BVH_LEAF != 0 {
        return Vec::new();
    }
    let mut bounds = vec![Box3::default(); tree.nodes.len()];
    for node in &tree.nodes {
        for (reference, child) in node.children() {
            if reference & BVH_LEAF == 0 {
                bounds[reference as usize] = child;
            }
        }
    }
    let mut choices = vec![Choice::leaf(BVH_LEAF, Box3::default()); tree.nodes.len()];
    // Nodes come after their parents.
    for (number, node) in tree.nodes.iter().enumerate().rev() {
        let halves = node.children().map(|(reference, bounds)| match reference & BVH_LEAF {
            0 => choices[reference as usize],
            _ => Choice::leaf(reference, bounds),
        });
        choices[number] = Choice::inner(bounds[number], halves);
    }
    let mut nodes = Vec::new();
    let mut pending = vec![(0_usize, BVH_NONE)];
    while let Some((source, link)) = pending.pop() {
        let number = nodes.len() as u32;
        if link != BVH_NONE {
            let parent: &mut NodeOfFour = &mut nodes[(link / BVH_FOUR) as usize];
            parent.children[(link % BVH_FOUR) as usize] = number;
        }
        let mut children = Vec::with_capacity(FOUR);
        gather(tree, &choices, source, choices[source].most(), &mut children);
        nodes.push(NodeOfFour::new(link, &children));
        for (slot, (reference, _)) in children.iter().enumerate().rev() {
            if reference & BVH_LEAF == 0 {
                pending.push((*reference as usize, BVH_FOUR * number + slot as u32));
            }
        }
    }
    nodes
}

/// Collects the children that a node of the tree of two becomes, as references into that tree with their
/// boxes.
fn gather(tree: &Tree, choices: &[Choice], source: usize, children: usize, into: &mut Vec<(u32, Box3)>) {
    let of_first = usize::from(choices[source].first[children - 1]);
    for ((reference, bounds), wanted) in
        tree.nodes[source].children().into_iter().zip([of_first, children - of_first])
    {
        if wanted == 1 {
            into.push((reference, bounds));
        } else {
            gather(tree, choices, reference as usize, wanted, into);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Children;
    use crate::host::build;
    use crate::layout::most_nodes;

    /// Returns boxes along a line, at distances that grow.
    fn line(count: usize) -> Vec<Box3> {
        (0..count).map(|i| [[(i * i) as f32, 0.0, 0.0], [(i * i + 1) as f32, 1.0, 1.0]]).collect()
    }

    #[test]
    fn nodes_are_full_or_have_leaves_only() {
        for count in [2, 3, 4, 5, 8, 9, 64, 1000] {
            for leaf in [1, 4] {
                // Boxes along a line, and boxes in one place, whose areas are zero.
                for boxes in [line(count), vec![[[0.5; 3]; 2]; count]] {
                    let tree = build(&boxes, leaf);
                    let nodes = with_four_children(&tree);
                    let mut leaves = 0;
                    for node in &nodes {
                        let below =
                            node.children().filter(|(_, reference, _)| reference & BVH_LEAF != 0).count();
                        let children = node.children().count();
                        assert!(children == FOUR || (children >= 2 && below == children), "{count}, {leaf}");
                        leaves += below;
                    }
                    assert!(
                        nodes.len() as u64 <= most_nodes(Children::Four, count as u64),
                        "{count}, {leaf}"
                    );
                    let leaves_of_two = tree.nodes.len() + 1;
                    assert!(leaves == leaves_of_two || tree.nodes.is_empty(), "{count}, {leaf}");
                }
            }
        }
    }

    #[test]
    fn eight_leaves_of_equal_size_take_three_nodes() {
        let boxes: Vec<Box3> = (0..8).map(|i| [[i as f32, 0.0, 0.0], [i as f32 + 1.0, 1.0, 1.0]]).collect();
        let nodes = with_four_children(&build(&boxes, 1));
        assert_eq!(nodes.len(), 3);
    }
}
