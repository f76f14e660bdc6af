//! Build on the host: a tree that lowers the surface area heuristic's cost, with triangles in the order of
//! its leaves.
//!
//! The tree's shape comes from `obvhs`: triangles are clustered by the surface area of their union (Meister
//! and Bittner, "Parallel locally-ordered clustering for bounding volume hierarchy construction", 2018),
//! subtrees are reinserted where they lower the cost (by the same authors, "Parallel reinsertion for bounding
//! volume hierarchy optimization", 2018), and subtrees that cost more than their triangles become leaves.
//! This module takes over the shape only, and computes exact boxes from those of the triangles.

use obvhs::aabb::Aabb;
use obvhs::bvh2::Bvh2;
use obvhs::bvh2::leaf_collapser::collapse;
use obvhs::bvh2::reinsertion::ReinsertionOptimizer;
use obvhs::ploc::{PlocBuilder, PlocSearchDistance, SortPrecision};
use std::collections::HashMap;

use rasray_shaders_glsl::constants::bvh::{BVH_LEAF, BVH_LEAF_SHIFT, BVH_NONE};

use crate::Node;

/// Box as its lower and upper corner, in metres relative to the frame origin.
pub(crate) type Box3 = [[f32; 3]; 2];

/// Share of the nodes that the optimization tries at other places of the tree.
const REINSERTED: f32 = 0.2;
/// Cost of reading a node, relative to the cost of testing a triangle.
const NODE_COST: f32 = 1.0;

/// Tree as the pools hold it.
#[derive(Debug)]
pub(crate) struct Tree {
    /// Child reference of the root.
    pub(crate) root: u32,
    /// Inner nodes, each after its parent.
    pub(crate) nodes: Vec<Node>,
    /// Primitive index of each record.
    pub(crate) order: Vec<u32>,
}

/// Returns the union of two boxes.
pub(crate) fn union(a: Box3, b: Box3) -> Box3 {
    [
        std::array::from_fn(|axis| a[0][axis].min(b[0][axis])),
        std::array::from_fn(|axis| a[1][axis].max(b[1][axis])),
    ]
}

/// Builds a tree over triangles with these boxes, with at most `leaf` triangles per leaf.
pub(crate) fn build(boxes: &[Box3], leaf: u32) -> Tree {
    if boxes.is_empty() {
        return Tree { root: BVH_NONE, nodes: Vec::new(), order: Vec::new() };
    }
    // No ray hits a triangle with a corner that is not finite. The check of the build counts triangles with
    // infinite corners.
    let is_finite = |bounds: &Box3| bounds.as_flattened().iter().all(|x| x.is_finite());
    let boxes: Vec<Box3> =
        boxes.iter().map(|bounds| if is_finite(bounds) { *bounds } else { [[0.0; 3]; 2] }).collect();
    let boxes = &boxes[..];
    let (distinct, groups) = grouped(boxes);
    let indices: Vec<u32> = (0..distinct.len() as u32).collect();
    let normalized = normalized(&distinct);
    let mut shape = PlocBuilder::with_capacity(distinct.len()).build(
        PlocSearchDistance::High,
        &normalized,
        indices,
        SortPrecision::U64,
        2,
    );
    let mut optimizer = ReinsertionOptimizer::default();
    optimizer.run(&mut shape, REINSERTED, None);
    collapse(&mut shape, leaf, NODE_COST);
    flatten(&shape, boxes, &groups, leaf as usize)
}

/// Returns the distinct boxes, in order of appearance, and the triangles of each. Clustering takes time in
/// the square of the number of equal boxes, since all their unions cost the same.
fn grouped(boxes: &[Box3]) -> (Vec<Box3>, Vec<Vec<u32>>) {
    let mut places: HashMap<[[u32; 3]; 2], usize> = HashMap::with_capacity(boxes.len());
    let (mut distinct, mut groups) = (Vec::new(), Vec::<Vec<u32>>::new());
    for (triangle, bounds) in boxes.iter().enumerate() {
        let place = *places.entry(bounds.map(|corner| corner.map(f32::to_bits))).or_insert(distinct.len());
        if place == distinct.len() {
            distinct.push(*bounds);
            groups.push(Vec::with_capacity(1));
        }
        groups[place].push(triangle as u32);
    }
    (distinct, groups)
}

/// Returns the boxes in units of the box around all of them, so that no area overflows however large or small
/// the scene is.
fn normalized(boxes: &[Box3]) -> Vec<Aabb> {
    let whole = boxes.iter().copied().fold(boxes[0], union);
    let extent =
        (0..3).fold(0.0_f64, |most, axis| most.max(f64::from(whole[1][axis]) - f64::from(whole[0][axis])));
    let scale = if extent > 0.0 { extent.recip() } else { 1.0 };
    let corner = |corner: [f32; 3]| -> [f32; 3] {
        std::array::from_fn(|axis| ((f64::from(corner[axis]) - f64::from(whole[0][axis])) * scale) as f32)
    };
    boxes.iter().map(|b| Aabb::new(corner(b[0]).into(), corner(b[1]).into())).collect()
}

/// Child of a node.
enum Part {
    /// Index of a node of the shape.
    Node(usize),
    /// Triangles with equal boxes, which the shape does not separate.
    Triangles(Vec<u32>),
}

/// Converts the shape to a tree, depth first, and gives every child its exact box. If there are more than
/// `leaf` triangles with equal boxes, they are halved until they fit into leaves.
fn flatten(shape: &Bvh2, boxes: &[Box3], groups: &[Vec<u32>], leaf: usize) -> Tree {
    let mut tree = Tree { root: BVH_NONE, nodes: Vec::new(), order: Vec::with_capacity(boxes.len()) };
    let mut pending = vec![(Part::Node(0), BVH_NONE)];
    while let Some((part, link)) = pending.pop() {
        let [first, second] = match part {
            Part::Node(source) => {
                let node = &shape.nodes[source];
                let first = node.first_index as usize;
                if node.is_leaf() {
                    let inside = &shape.primitive_indices[first..first + node.prim_count as usize];
                    let triangles = inside.iter().flat_map(|group| &groups[*group as usize]).copied();
                    pending.push((Part::Triangles(triangles.collect()), link));
                    continue;
                }
                [Part::Node(first), Part::Node(first + 1)]
            }
            Part::Triangles(triangles) if triangles.len() <= leaf.max(1) => {
                let run = (triangles.len() as u32 - 1) << BVH_LEAF_SHIFT | tree.order.len() as u32;
                let bounds = triangles.iter().map(|&triangle| boxes[triangle as usize]).reduce(union);
                tree.order.extend_from_slice(&triangles);
                set_child(&mut tree, link, BVH_LEAF | run, bounds.unwrap_or_default());
                continue;
            }
            Part::Triangles(mut triangles) => {
                let second = triangles.split_off(triangles.len() / 2);
                [Part::Triangles(triangles), Part::Triangles(second)]
            }
        };
        let number = tree.nodes.len() as u32;
        tree.nodes.push(Node::empty(link));
        pending.push((second, 2 * number + 1));
        pending.push((first, 2 * number));
        set_child(&mut tree, link, number, Box3::default());
    }
    for number in (1..tree.nodes.len()).rev() {
        let node = tree.nodes[number];
        let [(_, first), (_, second)] = node.children();
        set_child(&mut tree, node.parent, number as u32, union(first, second));
    }
    tree
}

/// Returns the number of triangles in a leaf's reference.
pub(crate) fn triangles_of(leaf: u32) -> u32 {
    ((leaf & !BVH_LEAF) >> BVH_LEAF_SHIFT) + 1
}

fn set_child(tree: &mut Tree, link: u32, reference: u32, bounds: Box3) {
    if link == BVH_NONE {
        tree.root = reference;
    } else {
        tree.nodes[(link >> 1) as usize].set_child(link & 1, reference, bounds);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Returns the number of triangles and of levels of the tree, after a check that it has each triangle
    /// once.
    fn shape(tree: &Tree) -> (usize, usize) {
        let mut triangles = tree.order.clone();
        triangles.sort_unstable();
        assert!(triangles.iter().enumerate().all(|(place, triangle)| place == *triangle as usize));
        let mut levels = vec![1_usize; tree.nodes.len()];
        for (number, node) in tree.nodes.iter().enumerate().skip(1) {
            levels[number] = levels[(node.parent >> 1) as usize] + 1;
        }
        (triangles.len(), levels.into_iter().max().unwrap_or(0))
    }

    #[test]
    fn triangles_in_one_place_are_halved() {
        let point = [[0.25_f32; 3]; 2];
        for (count, leaf) in [(1, 4), (4, 4), (5, 4), (700, 1), (100_000, 4)] {
            let tree = build(&vec![point; count], leaf);
            let levels = count.div_ceil(leaf as usize).next_power_of_two().ilog2() as usize;
            assert_eq!(shape(&tree), (count, levels), "{count} triangles, {leaf} per leaf");
        }
        // Other boxes, which are apart from each other.
        let mut boxes: Vec<Box3> = (0..100).map(|i| [[i as f32; 3], [i as f32 + 0.5; 3]]).collect();
        boxes.extend([point; 100]);
        let (triangles, levels) = shape(&build(&boxes, 2));
        assert!(triangles == 200 && levels < 40, "{levels} levels");
    }
}
