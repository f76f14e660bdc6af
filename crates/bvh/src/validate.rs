//! Checks the contents of a built tree.

use rasray_shaders_glsl::constants::bvh::{BVH_LEAF, BVH_LEAF_SHIFT, BVH_NONE};

use crate::host::{Box3, union};
use crate::{Header, Node, Record};

/// A tree as downloaded.
#[derive(Clone, Debug)]
pub struct Contents {
    /// The header.
    pub header: Header,
    /// Inner nodes.
    pub nodes: Vec<Node>,
    /// Triangles in the order of the leaves.
    pub records: Vec<Record>,
}

/// What a sound tree looks like.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Shape {
    /// Leaves.
    pub leaves: usize,
    /// Inner nodes on the longest path from the root to a leaf.
    pub levels: usize,
    /// Expected nodes and triangles that a ray through the root's box hits, by surface area; 0 where that
    /// box has none.
    pub cost: f64,
}

/// What is wrong with a tree.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum Fault {
    /// A child is neither a node nor a range of records.
    #[error("node {node}: child {reference:#010x} points to neither a node nor records")]
    Dangling {
        /// The node.
        node: u32,
        /// The reference.
        reference: u32,
    },
    /// A node is reached by a link other than the one it stores, or a second time.
    #[error("node {node} is reached by link {link} and stores link {parent}")]
    Parent {
        /// The node.
        node: u32,
        /// The link by which it was reached.
        link: u32,
        /// The link it stores.
        parent: u32,
    },
    /// A box is not the union of what is below it.
    #[error("link {link}: the box is {stored}, its contents have {contents}")]
    Bounds {
        /// The link of the child.
        link: u32,
        /// The box stored.
        stored: String,
        /// The union of what is below.
        contents: String,
    },
    /// A record is in no leaf, or in several.
    #[error("record {record} is in {times} leaves")]
    Leaves {
        /// The record.
        record: usize,
        /// How often.
        times: usize,
    },
    /// A triangle has no record, or several.
    #[error("triangle {primitive} has {times} records")]
    Triangles {
        /// The triangle.
        primitive: usize,
        /// How many.
        times: usize,
    },
}

/// Checks that every triangle has one record and every record one leaf, that nodes store the link by which they
/// are reached, and that every box is the union of what is below it, subnormal coordinates being zeros.
///
/// # Errors
/// The first fault found.
pub fn well_formed(contents: &Contents) -> Result<Shape, Fault> {
    let mut shape = Shape::default();
    let mut in_leaves = vec![0_usize; contents.records.len()];
    let mut reached = vec![false; contents.nodes.len()];
    // Nodes in an order in which each comes after its parent.
    let mut order = Vec::new();
    let mut below: Vec<[Box3; 2]> = vec![[EMPTY; 2]; contents.nodes.len()];
    let mut pending = Vec::new();
    if contents.header.root != BVH_NONE {
        pending.push((contents.header.root, BVH_NONE, 0));
    }
    while let Some((reference, link, levels)) = pending.pop() {
        shape.levels = shape.levels.max(levels);
        let node = link >> 1;
        if reference & BVH_LEAF != 0 {
            let first = (reference & ((1 << BVH_LEAF_SHIFT) - 1)) as usize;
            let count = ((reference & !BVH_LEAF) >> BVH_LEAF_SHIFT) as usize + 1;
            let records = contents.records.get(first..first + count);
            let records = records.ok_or(Fault::Dangling { node, reference })?;
            shape.leaves += 1;
            in_leaves[first..first + count].iter_mut().for_each(|times| *times += 1);
            if link != BVH_NONE {
                let corners = records.iter().flat_map(Record::corners);
                below[node as usize][(link & 1) as usize] = corners.fold(EMPTY, |all, p| union(all, [p, p]));
            }
            continue;
        }
        let found = contents.nodes.get(reference as usize).ok_or(Fault::Dangling { node, reference })?;
        if found.parent != link || std::mem::replace(&mut reached[reference as usize], true) {
            return Err(Fault::Parent { node: reference, link, parent: found.parent });
        }
        order.push(reference);
        pending.push((found.child_1, 2 * reference + 1, levels + 1));
        pending.push((found.child_0, 2 * reference, levels + 1));
    }
    for &node in order.iter().rev() {
        let [first, second] = below[node as usize];
        let parent = contents.nodes[node as usize].parent;
        if parent != BVH_NONE {
            below[(parent >> 1) as usize][(parent & 1) as usize] = union(first, second);
        }
    }
    for &node in &order {
        for (child, (_, stored)) in contents.nodes[node as usize].children().into_iter().enumerate() {
            let contents = below[node as usize][child];
            if without_subnormals(stored) != without_subnormals(contents) {
                let (stored, contents) = (format!("{stored:?}"), format!("{contents:?}"));
                return Err(Fault::Bounds { link: 2 * node + child as u32, stored, contents });
            }
        }
    }
    each_once(&in_leaves).map_err(|(record, times)| Fault::Leaves { record, times })?;
    let mut records = vec![0_usize; contents.records.len()];
    for record in &contents.records {
        if let Some(times) = records.get_mut(record.primitive as usize) {
            *times += 1;
        }
    }
    each_once(&records).map_err(|(primitive, times)| Fault::Triangles { primitive, times })?;
    shape.cost = cost(contents, &order);
    Ok(shape)
}

const EMPTY: Box3 = [[f32::INFINITY; 3], [f32::NEG_INFINITY; 3]];

/// Devices may take subnormal numbers for zeros.
fn without_subnormals(bounds: Box3) -> Box3 {
    bounds.map(|corner| corner.map(|x| if x.is_subnormal() { 0.0 } else { x }))
}

fn each_once(times: &[usize]) -> Result<(), (usize, usize)> {
    times.iter().position(|&times| times != 1).map_or(Ok(()), |index| Err((index, times[index])))
}

fn area([lower, upper]: Box3) -> f64 {
    let side = |axis: usize| f64::from(upper[axis]) - f64::from(lower[axis]);
    side(0) * side(1) + side(1) * side(2) + side(2) * side(0)
}

fn cost(contents: &Contents, order: &[u32]) -> f64 {
    let Some(&root) = order.first() else { return contents.records.len() as f64 };
    let [(_, first), (_, second)] = contents.nodes[root as usize].children();
    let whole = area(union(first, second));
    let mut sum = whole;
    for &node in order {
        for (reference, bounds) in contents.nodes[node as usize].children() {
            let units = match reference & BVH_LEAF {
                0 => 1.0,
                _ => f64::from(((reference & !BVH_LEAF) >> BVH_LEAF_SHIFT) + 1),
            };
            sum += units * area(bounds);
        }
    }
    if whole > 0.0 { sum / whole } else { 0.0 }
}
