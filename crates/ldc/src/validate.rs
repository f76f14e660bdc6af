//! Checks of the contents of a built layered depth cube.

use rasray_ads::ListCounts;
use rasray_shaders_glsl::constants::ldc::{LDC_LEVEL_BLOCKS, LDC_SLICES};

use crate::{Accept, Config, Depth, Header, Occupancy, Payload, cell_count};

/// Downloaded contents of all pools, in words.
#[derive(Clone, Debug)]
pub struct Contents {
    /// Configuration of the build.
    pub config: Config,
    /// Header after the build.
    pub header: Header,
    /// End of each cell's list: one past its last place.
    pub lists: Vec<u32>,
    /// Depths of fragments.
    pub depths: Vec<u32>,
    /// Payload of fragments: a triangle, or two words with colour and normal.
    pub payload: Vec<u32>,
    /// Smallest depth (its complement) and largest depth of each block, and the block's slices with
    /// [`Occupancy::Slices`]. The second level follows the first.
    pub blocks: Vec<u32>,
    /// Head of each cell's conservative list: its first link.
    pub heads: Vec<u32>,
    /// Triangle, next link and depths of each node of the conservative lists.
    pub conservative: Vec<u32>,
}

/// Fault in a list.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum Fault {
    /// List that leaves the pool, or ends before it begins.
    #[error("cell {cell}: the list from {begin} to {end} leaves the pool or runs backwards")]
    Range {
        /// Index of the cell.
        cell: usize,
        /// First place of the list.
        begin: u32,
        /// One past the last place of the list.
        end: u32,
    },
    /// Sorted list that is not in order, or contains a fragment twice.
    #[error("cell {cell}: the fragment at place {place} is out of order")]
    Order {
        /// Index of the cell.
        cell: usize,
        /// Place of the fragment.
        place: u32,
    },
    /// Depth that is NaN or lies outside of the bounds of its blocks.
    #[error("cell {cell}: depth {z} at place {place} is outside of its blocks'")]
    Depth {
        /// Index of the cell.
        cell: usize,
        /// Place of the fragment.
        place: u32,
        /// The depth, as text: it may be NaN.
        z: String,
    },
    /// Fragment, or node of a conservative list, without a valid triangle.
    #[error("cell {cell}: there is no triangle {primitive}")]
    Primitive {
        /// Index of the cell.
        cell: usize,
        /// Triangle index, as stored.
        primitive: u32,
    },
    /// Link of a conservative list that points to no node.
    #[error("cell {cell}: link {link} points to no node")]
    Dangling {
        /// Index of the cell.
        cell: usize,
        /// Link at fault.
        link: u32,
    },
    /// Places or nodes that are in no list, or in more than one.
    #[error("{stored} places or nodes were counted and {listed} are in lists")]
    Count {
        /// Number of places or nodes that the build counted.
        stored: usize,
        /// Number of places or nodes found in lists.
        listed: usize,
    },
}

impl Contents {
    /// Returns the places of a cell's list: the first, and one past the last.
    ///
    /// # Errors
    /// The list leaves the pool or runs backwards.
    pub fn list(&self, cell: usize) -> Result<std::ops::Range<u32>, Fault> {
        let before = if cell == 0 { 0 } else { self.lists[cell - 1] };
        let begin = if self.config.depth == Depth::Bits16 { before.next_multiple_of(2) } else { before };
        let end = self.lists[cell];
        if begin > end || end > self.header.demand.min(self.header.capacity) {
            return Err(Fault::Range { cell, begin, end });
        }
        Ok(begin..end)
    }

    /// Returns the bits of a depth. Bits have the order of their depths.
    pub fn depth_bits(&self, place: u32) -> u32 {
        match self.config.depth {
            Depth::Bits32 => self.depths[place as usize],
            Depth::Bits16 => (self.depths[place as usize / 2] >> (16 * (place % 2))) & 0xFFFF,
        }
    }

    /// Returns a depth in metres.
    pub fn depth(&self, place: u32) -> f32 {
        let bits = self.depth_bits(place);
        match self.config.depth {
            Depth::Bits32 => f32::from_bits(bits),
            Depth::Bits16 => half(bits) * self.header.size,
        }
    }

    /// Returns the triangles of a cell's conservative list.
    ///
    /// # Errors
    /// A link points to no node, or the list is a cycle.
    pub fn conservative_list_of(&self, cell: usize) -> Result<Vec<u32>, Fault> {
        let stored = self.header.conservative_demand.min(self.header.conservative_capacity) as usize;
        let mut found = Vec::new();
        let mut link = self.heads.get(cell).copied().unwrap_or(0);
        while link != 0 {
            if link as usize > stored || found.len() == stored {
                return Err(Fault::Dangling { cell, link });
            }
            let node = 3 * (link as usize - 1);
            found.push(self.conservative[node]);
            link = self.conservative[node + 1];
        }
        Ok(found)
    }

    /// Counts the layers in the cells of each view. Triangles of conservative lists do not count as layers.
    ///
    /// # Errors
    /// A list leaves the pool or runs backwards.
    pub fn list_counts(&self) -> Result<Vec<ListCounts>, Fault> {
        let depth_bytes = if self.config.depth == Depth::Bits16 { 2 } else { 4 };
        let bytes = depth_bytes + self.config.payload_bytes();
        let cells = cell_count(self.config.resolution) as usize / 3;
        let mut counts = ListCounts::AXES.map(|axis| ListCounts::new(axis, bytes));
        for cell in 0..3 * cells {
            let layers = self.list(cell)?.len();
            counts[cell / cells].add_cell(layers, layers, layers);
        }
        Ok(counts.into())
    }

    /// Returns true if the blocks of a cell, on all levels, say that something lies at a depth in metres.
    fn blocks_hold(&self, cell: usize, z: f32) -> bool {
        let side = self.config.resolution as usize;
        let (view, x, y) = (cell / (side * side), cell % side, cell / side % side);
        let words = if self.config.occupancy == Occupancy::Slices { 4 } else { 2 };
        // The device may round a half's share of the side differently in the last place.
        let slack = if self.config.depth == Depth::Bits16 { 1.0e-6 * z } else { 0.0 };
        let (mut before, mut cells) = (0, self.config.block.map(|side| side as usize));
        for _ in 0..self.config.levels {
            let [columns, rows] = cells.map(|cells| side.div_ceil(cells));
            let word = words * (before + (view * rows + y / cells[1]) * columns + x / cells[0]);
            let [z_min, z_max] = [!self.blocks[word], self.blocks[word + 1]].map(f32::from_bits);
            let slices = match self.blocks[word..word + words] {
                [_, _, low, high] => u64::from(high) << 32 | u64::from(low),
                _ => u64::MAX,
            };
            let slice =
                |z: f32| (z * self.header.slices_per_metre).clamp(0.0, (LDC_SLICES - 1) as f32) as u32;
            let marked = (slice(z - slack)..=slice(z + slack)).any(|slice| slices >> slice & 1 != 0);
            if !(z >= z_min - slack && z <= z_max + slack && marked) {
                return false;
            }
            before += 3 * columns * rows;
            cells = cells.map(|cells| cells * LDC_LEVEL_BLOCKS as usize);
        }
        true
    }
}

/// Returns the value of a non-negative half.
fn half(bits: u32) -> f32 {
    let (exponent, mantissa) = ((bits >> 10) & 31, (bits & 1023) as f32);
    match exponent {
        0 => mantissa * 2.0_f32.powi(-24),
        31 => f32::NAN,
        _ => (1.0 + mantissa / 1024.0) * 2.0_f32.powi(exponent as i32 - 15),
    }
}

/// Checks that lists are contiguous and hold all counted fragments, that they are sorted where they should
/// be, that depths lie within the bounds of their blocks, that triangle indices of fragments are valid, and
/// that every node of the conservative lists is in exactly one list.
///
/// # Errors
/// The first fault found.
pub fn well_formed(contents: &Contents, triangles: u32) -> Result<(), Fault> {
    let sorted = contents.header.unsorted == 0;
    let named = contents.config.payload == Payload::Index;
    let (mut listed, mut nodes) = (0, 0);
    for cell in 0..cell_count(contents.config.resolution) as usize {
        let list = contents.list(cell)?;
        let mut previous: Option<(u32, u32)> = None;
        for place in list.clone() {
            // Fragments of one depth without a triangle index may be in any order.
            let primitive = if named { contents.payload[place as usize] } else { 0 };
            if named && primitive >= triangles {
                return Err(Fault::Primitive { cell, primitive });
            }
            let z = contents.depth(place);
            // A triangle that may be hit at any depth has no depth of its own; its blocks have the depths of
            // its corners.
            let anywhere = contents.config.accept == Accept::Triangle && contents.depth_bits(place) == 0;
            if !anywhere && !contents.blocks_hold(cell, z) {
                return Err(Fault::Depth { cell, place, z: z.to_string() });
            }
            let key = (contents.depth_bits(place), primitive);
            if sorted && previous.is_some_and(|before| key < before || (named && key == before)) {
                return Err(Fault::Order { cell, place });
            }
            previous = Some(key);
        }
        listed = list.end as usize;
        let conservative = contents.conservative_list_of(cell)?;
        if let Some(&primitive) = conservative.iter().find(|&&primitive| primitive >= triangles) {
            return Err(Fault::Primitive { cell, primitive });
        }
        nodes += conservative.len();
    }
    let listed = if contents.config.depth == Depth::Bits16 { listed.next_multiple_of(2) } else { listed };
    let stored = contents.header.demand as usize;
    if listed != stored {
        return Err(Fault::Count { stored, listed });
    }
    let kept = contents.config.has_conservative_lists();
    let stored = if kept { contents.header.conservative_demand as usize } else { 0 };
    if nodes == stored { Ok(()) } else { Err(Fault::Count { stored, listed: nodes }) }
}
