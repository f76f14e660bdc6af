//! Checks the contents of built voxels and axis A-buffers.

use crate::{Config, Header, Payload, list_count};

/// What rays read, as downloaded, in words.
#[derive(Clone, Debug)]
pub struct Contents {
    /// The configuration they were built with.
    pub config: Config,
    /// The header.
    pub header: Header,
    /// Four bits a voxel: the axes it is searched along, and whether something lies in it.
    pub voxels: Vec<u32>,
    /// Where the fragments of each cell end.
    pub lists: Vec<u32>,
    /// Depth and triangle of each fragment; or depth, triangle or terms of the material, colour and normal.
    pub fragments: Vec<u32>,
}

/// A fragment.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Fragment {
    /// Depth at the cell's centre, metres from the lower side of the cube.
    pub z: f32,
    /// Global triangle id; 0 where fragments do not say.
    pub primitive: u32,
}

/// What is wrong with a list or a voxel.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum Fault {
    /// A list reaches beyond the pool, or ends before it begins.
    #[error("list {list} ends at {end}, which is not in the pool behind its beginning")]
    Dangling {
        /// The list: view, row and column as one number.
        list: usize,
        /// Where it ends.
        end: u32,
    },
    /// A fragment is in no list, or in more than one.
    #[error("{stored} fragments were counted and {listed} are in lists")]
    Count {
        /// Fragments counted.
        stored: usize,
        /// Fragments found in lists.
        listed: usize,
    },
    /// A fragment names no triangle.
    #[error("list {list}: there is no triangle {primitive}")]
    Primitive {
        /// The list.
        list: usize,
        /// What is stored.
        primitive: u32,
    },
    /// A sorted list is not in order, or names a triangle twice.
    #[error("list {list}: fragment {fragment:?} is out of order")]
    Order {
        /// The list.
        list: usize,
        /// The fragment.
        fragment: Fragment,
    },
    /// A depth lies outside of the cube or is no number.
    #[error("list {list}: {z} is no depth of the cube")]
    Depth {
        /// The list.
        list: usize,
        /// The depth, as text: it may be no number.
        z: String,
    },
    /// A voxel that is searched holds nothing, or one that holds something is not searched.
    #[error("voxel {voxel} has the bits {bits:04b}")]
    Voxel {
        /// The voxel.
        voxel: usize,
        /// Its bits.
        bits: u32,
    },
}

impl Contents {
    /// The fragments of a list.
    ///
    /// # Errors
    /// The list leaves the pool.
    pub fn list(&self, list: usize) -> Result<Vec<Fragment>, Fault> {
        let page = self.config.page();
        let stored = self.header.demand.min(self.header.capacity);
        let begin = if list == 0 { 0 } else { self.lists[list - 1].next_multiple_of(page) };
        let end = self.lists[list];
        if begin > end || end > stored {
            return Err(Fault::Dangling { list, end });
        }
        let stride = self.config.payload.fragment_bytes() as usize / 4;
        let named = self.config.payload != Payload::Material;
        let words = &self.fragments[stride * begin as usize..stride * end as usize];
        Ok(words
            .chunks_exact(stride)
            .map(|node| Fragment { z: f32::from_bits(node[0]), primitive: if named { node[1] } else { 0 } })
            .collect())
    }
}

/// Checks that every counted fragment is in one list, has a depth within the cube and, where it names a triangle, names
/// one of `triangles`, that lists are sorted where they should be, and that voxels are searched iff something lies in them.
///
/// # Errors
/// The first fault found.
pub fn well_formed(contents: &Contents, triangles: u32) -> Result<(), Fault> {
    let stored = contents.header.fragments as usize;
    let sorted = contents.config.sort && contents.header.unsorted == 0;
    let side = contents.header.cell * contents.header.resolution as f32 * 1.0001;
    // Without a name fragments of one depth may stand in any order.
    let named = contents.config.payload != Payload::Material;
    let mut listed = 0;
    for list in 0..list_count(contents.config.resolution) as usize {
        let fragments = contents.list(list)?;
        listed += fragments.len();
        for (index, fragment) in fragments.iter().enumerate() {
            if fragment.primitive >= triangles {
                return Err(Fault::Primitive { list, primitive: fragment.primitive });
            }
            if !(fragment.z >= 0.0 && fragment.z <= side) {
                return Err(Fault::Depth { list, z: fragment.z.to_string() });
            }
            let before = index.checked_sub(1).map(|before| fragments[before]);
            let key = |fragment: &Fragment| (fragment.z, fragment.primitive);
            let disorder =
                |before: Fragment| key(&before) > key(fragment) || (named && key(&before) == key(fragment));
            if sorted && before.is_some_and(disorder) {
                return Err(Fault::Order { list, fragment: *fragment });
            }
        }
    }
    if listed != stored {
        return Err(Fault::Count { stored, listed });
    }
    let grid = contents.config.grid() as usize;
    for voxel in 0..grid * grid * grid {
        let bits = contents.voxels[voxel / 8] >> (4 * (voxel % 8)) & 15;
        if (bits & 8 != 0) != (bits & 7 != 0) {
            return Err(Fault::Voxel { voxel, bits });
        }
    }
    Ok(())
}
