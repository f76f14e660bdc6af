//! Checks the contents of a built A-buffer.

use crate::structure::bounds_words;
use crate::{Config, Header, cell_count};

/// All pools as downloaded, in words.
#[derive(Clone, Debug)]
pub struct Contents {
    /// The configuration they were built with.
    pub config: Config,
    /// The header.
    pub header: Header,
    /// Bounds of each cell.
    pub bounds: Vec<u32>,
    /// Head and tail of each bucket of each cell.
    pub lists: Vec<u32>,
    /// Depth, next, previous of each node.
    pub nodes: Vec<u32>,
    /// Payload of each node.
    pub data: Vec<u32>,
    /// Triangles of the near box.
    pub near: Vec<u32>,
}

/// What is wrong with a list.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum Fault {
    /// A link names no node.
    #[error("cell {cell}, bucket {bucket}: link {link} names no node")]
    Dangling {
        /// Cell.
        cell: usize,
        /// Bucket.
        bucket: usize,
        /// The link.
        link: u32,
    },
    /// A node is in no list, or in more than one.
    #[error("{stored} nodes were allocated and {linked} are in lists")]
    Count {
        /// Nodes allocated.
        stored: usize,
        /// Nodes found in lists.
        linked: usize,
    },
    /// Forward and backward links disagree.
    #[error("cell {cell}, bucket {bucket}: the backward link of node {link} is {prev}, expected {expected}")]
    Backward {
        /// Cell.
        cell: usize,
        /// Bucket.
        bucket: usize,
        /// The node's link.
        link: u32,
        /// What is stored.
        prev: u32,
        /// What should be.
        expected: u32,
    },
    /// The tail is not the last node.
    #[error("cell {cell}, bucket {bucket}: the tail is {tail}, the last node is {last}")]
    Tail {
        /// Cell.
        cell: usize,
        /// Bucket.
        bucket: usize,
        /// What is stored.
        tail: u32,
        /// The last node's link.
        last: u32,
    },
    /// A sorted list is not in order.
    #[error("cell {cell}, bucket {bucket}: node {link} is out of order")]
    Order {
        /// Cell.
        cell: usize,
        /// Bucket.
        bucket: usize,
        /// The node's link.
        link: u32,
    },
    /// A depth lies outside of the cell's bounds or is not a positive number.
    #[error("cell {cell}, bucket {bucket}: depth {z} of node {link} is outside of [{z_min}, {z_max}]")]
    Depth {
        /// Cell.
        cell: usize,
        /// Bucket.
        bucket: usize,
        /// The node's link.
        link: u32,
        /// The depth, as text: it may be no number.
        z: String,
        /// Smallest depth of the cell.
        z_min: String,
        /// Largest depth of the cell.
        z_max: String,
    },
}

/// Checks that every allocated node is in exactly one list, that links agree in both directions, that
/// depths lie within bounds and that lists are sorted where they should be.
///
/// # Errors
/// The first fault found.
pub fn well_formed(contents: &Contents) -> Result<(), Fault> {
    let buckets = contents.config.buckets as usize;
    let stored = contents.header.demand.min(contents.header.capacity) as usize;
    let stride = bounds_words(&contents.config);
    let sorted = contents.config.sort && contents.header.unsorted == 0;
    let mut linked = 0;
    for cell in 0..cell_count(contents.config.resolution) as usize {
        let z_min = f32::from_bits(!contents.bounds[cell * stride]);
        let z_max = f32::from_bits(contents.bounds[cell * stride + 1]);
        for bucket in 0..buckets {
            let list = 2 * (cell * buckets + bucket);
            let (mut link, mut last, mut previous) = (contents.lists[list], 0, (f32::MIN, 0));
            while link != 0 {
                if link as usize > stored || linked >= stored {
                    return Err(Fault::Dangling { cell, bucket, link });
                }
                linked += 1;
                let node = &contents.nodes[3 * (link as usize - 1)..][..3];
                let z = f32::from_bits(node[0]);
                if !(z > 0.0 && z >= z_min && z <= z_max) {
                    return Err(Fault::Depth {
                        cell,
                        bucket,
                        link,
                        z: z.to_string(),
                        z_min: z_min.to_string(),
                        z_max: z_max.to_string(),
                    });
                }
                if node[2] != last {
                    return Err(Fault::Backward { cell, bucket, link, prev: node[2], expected: last });
                }
                let words = contents.data.len() / (contents.nodes.len() / 3).max(1);
                let key = (z, contents.data[(link as usize - 1) * words]);
                if sorted && (key.0 < previous.0 || (key.0 == previous.0 && key.1 < previous.1)) {
                    return Err(Fault::Order { cell, bucket, link });
                }
                previous = key;
                last = link;
                link = node[1];
            }
            if contents.lists[list + 1] != last {
                return Err(Fault::Tail { cell, bucket, tail: contents.lists[list + 1], last });
            }
        }
    }
    if linked == stored { Ok(()) } else { Err(Fault::Count { stored, linked }) }
}
