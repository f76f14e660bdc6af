//! Checks of the contents of a built tree.

use bytemuck::cast_slice;
use rasray_ads::kit::{Parts, PoolBytes, PoolContents};
use rasray_gpu::{Device, GpuError};
use rasray_shaders_glsl::constants::bvh::{BVH_FOUR, BVH_LEAF, BVH_LEAF_SHIFT, BVH_NONE};

use crate::host::{Box3, triangles_of, union};
use crate::layout::most_nodes;
use crate::{Children, Config, Header, Node, NodeOfFour, Pool, Record};

/// Downloaded contents of a tree.
#[derive(Clone, Debug)]
pub struct Contents {
    /// Header after the build.
    pub header: Header,
    /// Inner nodes of two children; empty in a tree with four children per node.
    pub nodes: Vec<Node>,
    /// Inner nodes of four children; empty in a tree with two children per node.
    pub nodes_of_four: Vec<NodeOfFour>,
    /// Triangles in the order of the leaves.
    pub records: Vec<Record>,
}

impl PoolContents<Config, Pool> for Contents {
    fn download(parts: &Parts<Config>, device: &Device, header: Header) -> Result<Self, GpuError> {
        let triangles = header.triangle_count as usize;
        let children = parts.config.made_children();
        let nodes = most_nodes(children, triangles as u64).min(header.node_count.into()) as usize;
        let [two, four] = match children {
            Children::Two => [nodes, 0],
            Children::Four => [0, nodes],
        };
        Ok(Self {
            header,
            nodes: device.download_as::<Node>(parts.pools.pool(Pool::Nodes), 0, two)?,
            nodes_of_four: device.download_as::<NodeOfFour>(parts.pools.pool(Pool::Nodes), 0, four)?,
            records: device.download_as::<Record>(parts.pools.pool(Pool::Records), 0, triangles)?,
        })
    }

    fn pools(&self) -> (Header, PoolBytes<'_, Pool>) {
        let nodes = match self.nodes[..] {
            [] => cast_slice(&self.nodes_of_four),
            _ => cast_slice(&self.nodes),
        };
        (self.header, vec![(Pool::Nodes, nodes), (Pool::Records, cast_slice(&self.records))])
    }
}

impl Contents {
    /// Returns the number of children slots of a node. A link divided by this number gives the node.
    fn slots(&self) -> u32 {
        if self.nodes_of_four.is_empty() { 2 } else { BVH_FOUR }
    }

    /// Returns the number of inner nodes.
    fn node_count(&self) -> usize {
        self.nodes.len().max(self.nodes_of_four.len())
    }

    /// Returns the link, reference and box of each child that a node has.
    fn children(&self, node: u32) -> Vec<(u32, u32, Box3)> {
        match self.nodes_of_four.get(node as usize) {
            Some(four) => {
                four.children().map(|(slot, child, bounds)| (BVH_FOUR * node + slot, child, bounds)).collect()
            }
            None => (0..)
                .zip(self.nodes[node as usize].children())
                .map(|(slot, (child, bounds))| (2 * node + slot, child, bounds))
                .collect(),
        }
    }

    /// Returns the sizes of a step of a node's boxes along the axes; 0 if they are exact.
    fn steps(&self, node: u32) -> [f32; 3] {
        self.nodes_of_four.get(node as usize).map_or([0.0; 3], NodeOfFour::step_sizes)
    }

    /// Returns the link to its parent that a node stores.
    fn parent(&self, node: u32) -> Option<u32> {
        let two = self.nodes.get(node as usize).map(|node| node.parent);
        two.or_else(|| self.nodes_of_four.get(node as usize).map(|node| node.parent))
    }
}

/// Shape of a tree without faults.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Shape {
    /// Number of leaves.
    pub leaves: usize,
    /// Number of inner nodes on the longest path from the root to a leaf.
    pub levels: usize,
    /// Expected number of nodes and triangles that a ray through the root's box hits, by surface area of the
    /// boxes' contents; 0 if the root's box has no area.
    pub cost: f64,
}

/// Fault in a tree.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum Fault {
    /// Child that is neither a node nor a range of records.
    #[error("node {node}: child {reference:#010x} points to neither a node nor records")]
    Dangling {
        /// Index of the node.
        node: u32,
        /// Reference of the child.
        reference: u32,
    },
    /// Node that is reached by a link other than the one it stores, or a second time.
    #[error("node {node} is reached by link {link} and stores link {parent}")]
    Parent {
        /// Index of the node.
        node: u32,
        /// Link by which the node was reached.
        link: u32,
        /// Link that the node stores.
        parent: u32,
    },
    /// Box that is not the union of the boxes below it or, in a node of four, not the smallest of its steps
    /// around that.
    #[error("link {link}: the box is {stored}, its contents have {contents}")]
    Bounds {
        /// Link of the child.
        link: u32,
        /// Box of the child, as stored.
        stored: String,
        /// Union of the boxes below the child.
        contents: String,
    },
    /// Record that is in no leaf, or in several.
    #[error("record {record} is in {times} leaves")]
    Leaves {
        /// Index of the record.
        record: usize,
        /// Number of leaves that the record is in.
        times: usize,
    },
    /// Triangle that has no record, or several.
    #[error("triangle {primitive} has {times} records")]
    Triangles {
        /// Index of the triangle.
        primitive: usize,
        /// Number of records of the triangle.
        times: usize,
    },
}

/// Checks that every triangle has one record and every record one leaf, that nodes store the link by which
/// they are reached, and that every box is the union of the boxes below it, in nodes of four up to a step.
/// Subnormal coordinates count as zero. Triangles with a corner that is not finite may have any box.
///
/// # Errors
/// The first fault found.
pub fn well_formed(contents: &Contents) -> Result<Shape, Fault> {
    let mut shape = Shape::default();
    let slots = contents.slots();
    let mut in_leaves = vec![0_usize; contents.records.len()];
    let mut reached = vec![false; contents.node_count()];
    // Nodes in an order in which each comes after its parent.
    let mut order = Vec::new();
    // Boxes below each link.
    let mut below: Vec<Box3> = vec![EMPTY; contents.node_count() * slots as usize];
    // Links to boxes that triangles without finite corners may have widened.
    let mut is_loose = vec![false; below.len()];
    let mut pending = Vec::new();
    if contents.header.root != BVH_NONE {
        pending.push((contents.header.root, BVH_NONE, 0));
    }
    while let Some((reference, link, levels)) = pending.pop() {
        shape.levels = shape.levels.max(levels);
        let node = link / slots;
        if reference & BVH_LEAF != 0 {
            let first = (reference & ((1 << BVH_LEAF_SHIFT) - 1)) as usize;
            let count = triangles_of(reference) as usize;
            let records = contents.records.get(first..first + count);
            let records = records.ok_or(Fault::Dangling { node, reference })?;
            shape.leaves += 1;
            in_leaves[first..first + count].iter_mut().for_each(|times| *times += 1);
            if link != BVH_NONE {
                // No ray hits a triangle with a corner that is not finite: its box may be any.
                let is_finite =
                    |record: &&Record| record.corners().as_flattened().iter().all(|x| x.is_finite());
                let corners = records.iter().filter(is_finite).flat_map(Record::corners);
                below[link as usize] = corners.fold(EMPTY, |all, p| union(all, [p, p]));
                is_loose[link as usize] = !records.iter().all(|record| is_finite(&record));
            }
            continue;
        }
        let parent = contents.parent(reference).ok_or(Fault::Dangling { node, reference })?;
        if parent != link || std::mem::replace(&mut reached[reference as usize], true) {
            return Err(Fault::Parent { node: reference, link, parent });
        }
        order.push(reference);
        let children = contents.children(reference);
        pending.extend(children.into_iter().rev().map(|(link, child, _)| (child, link, levels + 1)));
    }
    for &node in order.iter().rev() {
        let links = contents.children(node).into_iter().map(|(link, ..)| link as usize);
        if let Some(parent) = contents.parent(node).filter(|parent| *parent != BVH_NONE) {
            below[parent as usize] = links.clone().map(|link| below[link]).fold(EMPTY, union);
            is_loose[parent as usize] = links.clone().any(|link| is_loose[link]);
        }
    }
    for &node in &order {
        // A box that is not finite widens the steps of all boxes of its node.
        let children = contents.children(node);
        let widens = children.iter().any(|(link, ..)| is_loose[*link as usize]);
        let steps = if widens { [f32::INFINITY; 3] } else { contents.steps(node) };
        for (link, _, stored) in children {
            let contents = below[link as usize];
            if !fits(without_subnormals(stored), without_subnormals(contents), steps) {
                let (stored, contents) = (format!("{stored:?}"), format!("{contents:?}"));
                return Err(Fault::Bounds { link, stored, contents });
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
    shape.cost = cost(contents, &order, &below);
    Ok(shape)
}

const EMPTY: Box3 = [[f32::INFINITY; 3], [f32::NEG_INFINITY; 3]];

/// Replaces subnormal numbers by zero, since devices may do so.
fn without_subnormals(bounds: Box3) -> Box3 {
    bounds.map(|corner| corner.map(|x| if x.is_subnormal() { 0.0 } else { x }))
}

/// True if a stored box contains its contents, and is no more than a step larger on any side, apart from
/// rounding. A box that has no steps is equal.
fn fits(stored: Box3, contents: Box3, steps: [f32; 3]) -> bool {
    (0..3).all(|axis| {
        let side = |bounds: Box3, corner: usize| f64::from(bounds[corner][axis]);
        // A union of no finite triangles is infinite.
        let from = |inner: f64, outer: f64| if inner == outer { 0.0 } else { inner - outer };
        let below = from(side(contents, 0), side(stored, 0));
        let above = from(side(stored, 1), side(contents, 1));
        let step = f64::from(steps[axis]);
        let rounding = 4.0 * f64::from(f32::EPSILON) * side(contents, 0).abs().max(side(contents, 1).abs());
        let most = if step > 0.0 { 1.001 * step + rounding } else { 0.0 };
        (0.0..=most).contains(&below) && (0.0..=most).contains(&above)
    })
}

fn each_once(times: &[usize]) -> Result<(), (usize, usize)> {
    times.iter().position(|&times| times != 1).map_or(Ok(()), |index| Err((index, times[index])))
}

/// Returns half the area of a box, in square metres.
pub(crate) fn area([lower, upper]: Box3) -> f64 {
    let side = |axis: usize| f64::from(upper[axis]) - f64::from(lower[axis]);
    side(0) * side(1) + side(1) * side(2) + side(2) * side(0)
}

/// Returns the cost of a tree; `below` are the boxes below each link.
fn cost(contents: &Contents, order: &[u32], below: &[Box3]) -> f64 {
    let Some(&root) = order.first() else { return contents.records.len() as f64 };
    let of_root = contents.children(root).into_iter().map(|(link, ..)| below[link as usize]);
    let whole = area(of_root.fold(EMPTY, union));
    let mut sum = whole;
    for &node in order {
        for (link, reference, _) in contents.children(node) {
            let bounds = below[link as usize];
            let units = match reference & BVH_LEAF {
                0 => 1.0,
                _ => f64::from(triangles_of(reference)),
            };
            sum += units * area(bounds);
        }
    }
    if whole > 0.0 { sum / whole } else { 0.0 }
}
