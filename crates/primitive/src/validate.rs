//! Checks of the contents of built primitive lists.

use rasray_ads::ListCounts;

use crate::layout::entry_words;
use crate::{Config, Header, Storage, Views, cell_count};

/// Downloaded contents of all pools, in words.
#[derive(Clone, Debug)]
pub struct Contents {
    /// Configuration of the build.
    pub config: Config,
    /// Header after the build.
    pub header: Header,
    /// Depth bounds of each cell, and of the blocks of the pyramid.
    pub bounds: Vec<u32>,
    /// Head or end of the list of each bucket of each cell.
    pub lists: Vec<u32>,
    /// Entries of all lists.
    pub entries: Vec<u32>,
    /// Triangles in the near region.
    pub near: Vec<u32>,
}

/// Fault in a list.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum Fault {
    /// Link that points to no entry, or list that reaches beyond the pool.
    #[error("cell {cell}, bucket {bucket}: link {link} points to no entry")]
    Dangling {
        /// Index of the cell.
        cell: usize,
        /// Index of the bucket.
        bucket: usize,
        /// Link at fault, or end of the list.
        link: u32,
    },
    /// Entry that is in no list, or in more than one.
    #[error("{stored} entries were counted and {listed} are in lists")]
    Count {
        /// Number of entries that the build counted.
        stored: usize,
        /// Number of entries found in lists.
        listed: usize,
    },
    /// Entry with an invalid triangle index.
    #[error("cell {cell}, bucket {bucket}: there is no triangle {primitive}")]
    Primitive {
        /// Index of the cell.
        cell: usize,
        /// Index of the bucket.
        bucket: usize,
        /// Triangle index, as stored.
        primitive: u32,
    },
    /// Triangle that is in a list twice.
    #[error("cell {cell}, bucket {bucket}: triangle {primitive} is in the list twice")]
    Twice {
        /// Index of the cell.
        cell: usize,
        /// Index of the bucket.
        bucket: usize,
        /// Index of the triangle.
        primitive: u32,
    },
}

impl Contents {
    /// Returns the triangles of a list, in the order in which they are stored.
    ///
    /// # Errors
    /// The list leaves the pool.
    pub fn list(&self, cell: usize, bucket: usize) -> Result<Vec<u32>, Fault> {
        let list = cell * self.config.buckets as usize + bucket;
        let stored = self.header.demand.min(self.header.capacity) as usize;
        let word = self.lists[list];
        let dangling = |link| Fault::Dangling { cell, bucket, link };
        if self.config.storage != Storage::Linked {
            let begin = if list == 0 { 0 } else { self.lists[list - 1] as usize };
            if begin > word as usize || word as usize > stored {
                return Err(dangling(word));
            }
            return Ok(self.entries[begin..word as usize].to_vec());
        }
        let (mut link, mut found) = (word, Vec::new());
        while link != 0 {
            // A list with more entries than were stored is a ring.
            if link as usize > stored || found.len() == stored {
                return Err(dangling(link));
            }
            let node = 2 * (link as usize - 1);
            found.push(self.entries[node]);
            link = self.entries[node + 1];
        }
        Ok(found)
    }
}

impl Contents {
    /// Counts the entries in the tiles of each view. Triangles of the near region do not count.
    ///
    /// # Errors
    /// A list leaves the pool.
    pub fn list_counts(&self) -> Result<Vec<ListCounts>, Fault> {
        let bytes = 4 * entry_words(self.config.storage);
        let views = match self.config.views {
            Views::Cube => &ListCounts::FACES[..],
            Views::Camera => &["camera"],
        };
        let cells = cell_count(&self.config) as usize / views.len();
        let mut counts = Vec::new();
        let mut triangles = Vec::new();
        for (view, cells_of) in views.iter().enumerate() {
            let mut count = ListCounts::new(cells_of, bytes);
            for cell in view * cells..(view + 1) * cells {
                triangles.clear();
                for bucket in 0..self.config.buckets as usize {
                    triangles.extend(self.list(cell, bucket)?);
                }
                let entries = triangles.len();
                triangles.sort_unstable();
                triangles.dedup();
                count.add_cell(triangles.len(), entries, entries);
            }
            counts.push(count);
        }
        Ok(counts)
    }
}

/// Checks that every counted entry is in exactly one list and has the index of one of `triangles` triangles,
/// and that no list contains a triangle twice.
///
/// # Errors
/// The first fault found.
pub fn well_formed(contents: &Contents, triangles: u32) -> Result<(), Fault> {
    let stored = contents.header.demand.min(contents.header.capacity) as usize;
    let mut listed = 0;
    let (buckets, cells) = (contents.config.buckets as usize, cell_count(&contents.config) as usize);
    for cell in 0..cells {
        for bucket in 0..buckets {
            let mut list = contents.list(cell, bucket)?;
            listed += list.len();
            if listed > stored {
                return Err(Fault::Count { stored, listed });
            }
            if let Some(&primitive) = list.iter().find(|&&primitive| primitive >= triangles) {
                return Err(Fault::Primitive { cell, bucket, primitive });
            }
            list.sort_unstable();
            if let Some(pair) = list.windows(2).find(|pair| pair[0] == pair[1]) {
                return Err(Fault::Twice { cell, bucket, primitive: pair[0] });
            }
        }
    }
    if listed == stored { Ok(()) } else { Err(Fault::Count { stored, listed }) }
}
