//! Checks of the contents of a built grid.

use rasray_ads::ListCounts;

use crate::Header;
use crate::layout::cell_count;

/// Downloaded contents of all pools, in words.
#[derive(Clone, Debug)]
pub struct Contents {
    /// Header after the build.
    pub header: Header,
    /// End of the list of each cell.
    pub lists: Vec<u32>,
    /// Entries of all lists.
    pub entries: Vec<u32>,
}

/// Fault in a list.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum Fault {
    /// List that reaches beyond the pool, or ends before it begins.
    #[error("cell {cell}: {end} is not a valid end of its list")]
    Dangling {
        /// Index of the cell, in the order of lists.
        cell: usize,
        /// End of the cell's list.
        end: u32,
    },
    /// Entry that is in no list.
    #[error("{stored} entries were counted and {listed} are in lists")]
    Count {
        /// Number of entries that the build counted.
        stored: usize,
        /// Number of entries found in lists.
        listed: usize,
    },
    /// Entry with an invalid triangle index.
    #[error("cell {cell}: there is no triangle {primitive}")]
    Primitive {
        /// Index of the cell.
        cell: usize,
        /// Triangle index, as stored.
        primitive: u32,
    },
    /// Triangle that is in a list twice.
    #[error("cell {cell}: triangle {primitive} is in the list twice")]
    Twice {
        /// Index of the cell.
        cell: usize,
        /// Index of the triangle.
        primitive: u32,
    },
}

impl Contents {
    /// Returns the number of cells of the grid.
    pub fn cell_count(&self) -> usize {
        (cell_count(self.header.cells) as usize).min(self.lists.len())
    }

    /// Returns the number of entries that were stored.
    fn stored(&self) -> usize {
        self.header.demand.min(self.header.capacity) as usize
    }

    /// Returns the triangles of a cell, in the order in which they are stored.
    ///
    /// # Errors
    /// The list leaves the pool.
    pub fn list(&self, cell: usize) -> Result<&[u32], Fault> {
        let end = self.lists[cell];
        let begin = if cell == 0 { 0 } else { self.lists[cell - 1] as usize };
        if begin > end as usize || end as usize > self.stored() {
            return Err(Fault::Dangling { cell, end });
        }
        Ok(&self.entries[begin..end as usize])
    }
}

impl Contents {
    /// Counts the triangles in the cells.
    ///
    /// # Errors
    /// A list leaves the pool.
    pub fn list_counts(&self) -> Result<ListCounts, Fault> {
        let mut counts = ListCounts::new("grid", 4);
        for cell in 0..self.cell_count() {
            let triangles = self.list(cell)?.len();
            counts.add_cell(triangles, triangles, triangles);
        }
        Ok(counts)
    }
}

/// Checks that lists are contiguous and hold every counted entry, that entries are indices of `triangles`
/// triangles, and that no list contains a triangle twice.
///
/// # Errors
/// The first fault found.
pub fn well_formed(contents: &Contents, triangles: u32) -> Result<(), Fault> {
    let stored = contents.stored();
    let mut listed = 0;
    for cell in 0..contents.cell_count() {
        let mut entries = contents.list(cell)?.to_vec();
        listed += entries.len();
        if let Some(&primitive) = entries.iter().find(|&&primitive| primitive >= triangles) {
            return Err(Fault::Primitive { cell, primitive });
        }
        entries.sort_unstable();
        if let Some(pair) = entries.windows(2).find(|pair| pair[0] == pair[1]) {
            return Err(Fault::Twice { cell, primitive: pair[0] });
        }
    }
    if listed == stored { Ok(()) } else { Err(Fault::Count { stored, listed }) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_fault_is_found() {
        let header = Header { cells: [3, 1, 1], demand: 3, capacity: 8, ..Header::default() };
        let fault = |lists: [u32; 3], entries: [u32; 3]| {
            well_formed(&Contents { header, lists: lists.to_vec(), entries: entries.to_vec() }, 2).err()
        };
        assert_eq!(fault([1, 1, 3], [0, 0, 1]), None);
        assert_eq!(fault([2, 1, 3], [0, 1, 1]), Some(Fault::Dangling { cell: 1, end: 1 }));
        assert_eq!(fault([1, 1, 4], [0, 0, 1]), Some(Fault::Dangling { cell: 2, end: 4 }));
        assert_eq!(fault([1, 1, 2], [0, 0, 1]), Some(Fault::Count { stored: 3, listed: 2 }));
        assert_eq!(fault([1, 1, 3], [0, 2, 1]), Some(Fault::Primitive { cell: 2, primitive: 2 }));
        assert_eq!(fault([1, 1, 3], [0, 1, 1]), Some(Fault::Twice { cell: 2, primitive: 1 }));
    }
}
