//! Checks the contents of built primitive lists.

use rasray_shaders_glsl::constants::ads::BRICK_EMPTY;

use crate::{Config, Header, Storage, cell_count};

/// All pools as downloaded, in words.
#[derive(Clone, Debug)]
pub struct Contents {
    /// The configuration they were built with.
    pub config: Config,
    /// The header.
    pub header: Header,
    /// Bounds of each cell, and of the blocks of the pyramid; bricks, three words each.
    pub bounds: Vec<u32>,
    /// Head, or end, of each bucket of each cell.
    pub lists: Vec<u32>,
    /// Entries of all lists.
    pub entries: Vec<u32>,
    /// Triangles of the near box.
    pub near: Vec<u32>,
}

/// What is wrong with a list.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum Fault {
    /// A link names no node, or a list reaches beyond the pool.
    #[error("cell {cell}, bucket {bucket}: {link} names no entry")]
    Dangling {
        /// Cell.
        cell: usize,
        /// Bucket.
        bucket: usize,
        /// The link, or the end of the list.
        link: u32,
    },
    /// An entry is in no list, or in more than one.
    #[error("{stored} entries were counted and {listed} are in lists")]
    Count {
        /// Entries counted.
        stored: usize,
        /// Entries found in lists.
        listed: usize,
    },
    /// An entry names no triangle.
    #[error("cell {cell}, bucket {bucket}: there is no triangle {primitive}")]
    Primitive {
        /// Cell.
        cell: usize,
        /// Bucket.
        bucket: usize,
        /// What is stored.
        primitive: u32,
    },
    /// A triangle stands twice in a list.
    #[error("cell {cell}, bucket {bucket}: triangle {primitive} stands there twice")]
    Twice {
        /// Cell.
        cell: usize,
        /// Bucket.
        bucket: usize,
        /// The triangle.
        primitive: u32,
    },
    /// The word of a brick does not count the cells before it, or calls a brick empty that lists something.
    #[error("brick {brick}: its word {word:#x} is not that of {cells} cells before it")]
    Word {
        /// Brick.
        brick: usize,
        /// Its word.
        word: u32,
        /// Cells that list something in the bricks before it.
        cells: u32,
    },
    /// A brick is stepped over that lists something.
    #[error("brick {brick}: towards octant {octant} its distance goes over a brick that lists something")]
    Distance {
        /// The empty brick.
        brick: usize,
        /// The octant.
        octant: u32,
    },
}

impl Contents {
    /// How many lists a cell has, and how many cells have them: bricks number cells that list something, and each
    /// has one list.
    fn lists(&self) -> (usize, usize) {
        if self.config.storage == Storage::Bricks {
            return (1, self.header.cell_demand.min(self.header.cell_capacity) as usize);
        }
        (self.config.buckets as usize, cell_count(self.config.tiles()) as usize)
    }

    /// The triangles of a list, in the order they are stored in. In bricks `cell` counts cells that list something, and
    /// `bucket` is 0.
    ///
    /// # Errors
    /// The list leaves the pool.
    pub fn list(&self, cell: usize, bucket: usize) -> Result<Vec<u32>, Fault> {
        let list = cell * self.lists().0 + bucket;
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
            // More entries than there are: the list is a ring.
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

/// Checks that words of bricks number the cells that list something, and that no empty brick's distance goes over one
/// that is not.
fn bricks_are_well_formed(contents: &Contents) -> Result<(), Fault> {
    let header = &contents.header;
    let [columns, rows, deep] = [header.tiles, header.rows, header.slices].map(|cells| i64::from(cells) / 4);
    let views = i64::from(contents.config.view_count());
    let bricks = (views * columns * rows * deep) as usize;
    let cells_of = |brick: usize| {
        contents.bounds[3 * brick + 1].count_ones() + contents.bounds[3 * brick + 2].count_ones()
    };
    let mut cells = 0;
    for (brick, word) in contents.bounds.iter().copied().step_by(3).take(bricks).enumerate() {
        let empty = contents.config.skip && cells_of(brick) == 0;
        if empty != (word & BRICK_EMPTY != 0) || (!empty && word != cells) {
            return Err(Fault::Word { brick, word, cells });
        }
        cells += cells_of(brick);
        if !empty {
            continue;
        }
        let place = brick as i64;
        let (z, x, y, face) = (
            place % deep,
            place / deep % columns,
            place / (deep * columns) % rows,
            place / (deep * columns * rows),
        );
        for octant in 0..8 {
            let distance = i64::from(word >> (3 * octant) & 7);
            let along = |up: bool, at: i64, end: i64| {
                if up { at..=(at + distance).min(end - 1) } else { (at - distance).max(0)..=at }
            };
            let goes_over = along(octant & 4 != 0, y, rows).any(|y| {
                along(octant & 2 != 0, x, columns).any(|x| {
                    along(octant & 1 != 0, z, deep)
                        .any(|z| cells_of((((face * rows + y) * columns + x) * deep + z) as usize) != 0)
                })
            });
            if goes_over {
                return Err(Fault::Distance { brick, octant });
            }
        }
    }
    Ok(())
}

/// Checks that every counted entry is in exactly one list and names one of `triangles` triangles, and that no
/// list names a triangle twice.
///
/// # Errors
/// The first fault found.
pub fn well_formed(contents: &Contents, triangles: u32) -> Result<(), Fault> {
    let stored = contents.header.demand.min(contents.header.capacity) as usize;
    let mut listed = 0;
    if contents.config.storage == Storage::Bricks {
        bricks_are_well_formed(contents)?;
    }
    let (buckets, cells) = contents.lists();
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
