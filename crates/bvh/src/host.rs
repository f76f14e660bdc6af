//! The host's build: a tree that lowers the surface area heuristic's cost, in the order of its leaves.
//!
//! The tree's shape comes from `obvhs`: triangles are clustered by the surface area of their union (Meister
//! and Bittner, "Parallel locally-ordered clustering for bounding volume hierarchy construction", 2018),
//! subtrees are reinserted where they lower the cost (the same, "Parallel reinsertion for bounding volume
//! hierarchy optimization", 2018), and subtrees that cost more than their triangles become leaves. Only the
//! shape is taken over: boxes are made here, exactly, from those of the triangles.

use obvhs::aabb::Aabb;
use obvhs::bvh2::Bvh2;
use obvhs::bvh2::leaf_collapser::collapse;
use obvhs::bvh2::reinsertion::ReinsertionOptimizer;
use obvhs::ploc::{PlocBuilder, PlocSearchDistance, SortPrecision};
use rasray_shaders_glsl::constants::bvh::{BVH_LEAF, BVH_LEAF_SHIFT, BVH_NONE};

use crate::Node;

/// Lower and upper corner, metres relative to the frame origin.
pub(crate) type Box3 = [[f32; 3]; 2];

/// Share of the nodes that are tried elsewhere in the tree.
const REINSERTED: f32 = 0.2;
/// Cost of reading a node over that of testing a triangle.
const NODE_COST: f32 = 1.0;

/// A tree as the pools hold it.
#[derive(Debug)]
pub(crate) struct Tree {
    /// Child reference of the whole tree.
    pub(crate) root: u32,
    /// Inner nodes; each after its parent.
    pub(crate) nodes: Vec<Node>,
    /// Primitive of each record.
    pub(crate) order: Vec<u32>,
}

/// The union of two boxes.
pub(crate) fn union(a: Box3, b: Box3) -> Box3 {
    [
        std::array::from_fn(|axis| a[0][axis].min(b[0][axis])),
        std::array::from_fn(|axis| a[1][axis].max(b[1][axis])),
    ]
}

/// Builds a tree over triangles with these boxes, with at most `leaf` triangles a leaf.
pub(crate) fn build(boxes: &[Box3], leaf: u32) -> Tree {
    if boxes.is_empty() {
        return Tree { root: BVH_NONE, nodes: Vec::new(), order: Vec::new() };
    }
    let indices: Vec<u32> = (0..boxes.len() as u32).collect();
    let normalized = normalized(boxes);
    let mut shape = PlocBuilder::with_capacity(boxes.len()).build(
        PlocSearchDistance::High,
        &normalized,
        indices,
        SortPrecision::U64,
        2,
    );
    let mut optimizer = ReinsertionOptimizer::default();
    optimizer.run(&mut shape, REINSERTED, None);
    collapse(&mut shape, leaf, NODE_COST);
    flatten(&shape, boxes)
}

/// The boxes in units of the whole, so that no area overflows however large or small the scene is.
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

/// Lays the shape out depth first and gives every child its exact box.
fn flatten(shape: &Bvh2, boxes: &[Box3]) -> Tree {
    let mut tree = Tree { root: BVH_NONE, nodes: Vec::new(), order: Vec::with_capacity(boxes.len()) };
    let mut pending = vec![(0_usize, BVH_NONE)];
    while let Some((source, link)) = pending.pop() {
        let node = &shape.nodes[source];
        let first = node.first_index as usize;
        let (reference, bounds) = if node.is_leaf() {
            let primitives = &shape.primitive_indices[first..first + node.prim_count as usize];
            let run = (primitives.len() as u32 - 1) << BVH_LEAF_SHIFT | tree.order.len() as u32;
            tree.order.extend_from_slice(primitives);
            let bounds = primitives.iter().map(|&primitive| boxes[primitive as usize]).reduce(union);
            (BVH_LEAF | run, bounds.unwrap_or_default())
        } else {
            let number = tree.nodes.len() as u32;
            tree.nodes.push(Node::empty(link));
            pending.push((first + 1, 2 * number + 1));
            pending.push((first, 2 * number));
            (number, Box3::default())
        };
        set_child(&mut tree, link, reference, bounds);
    }
    for number in (1..tree.nodes.len()).rev() {
        let node = tree.nodes[number];
        let [(_, first), (_, second)] = node.children();
        set_child(&mut tree, node.parent, number as u32, union(first, second));
    }
    tree
}

fn set_child(tree: &mut Tree, link: u32, reference: u32, bounds: Box3) {
    if link == BVH_NONE {
        tree.root = reference;
    } else {
        tree.nodes[(link >> 1) as usize].set_child(link & 1, reference, bounds);
    }
}
