//! Checks the contents of built bricks.

use rasray_shaders_glsl::constants::bricks::BRICK_EMPTY;

use crate::{Config, Header};

/// All pools as downloaded, in words.
#[derive(Clone, Debug)]
pub struct Contents {
    /// The configuration they were built with.
    pub config: Config,
    /// The header.
    pub header: Header,
    /// Bricks, three words each.
    pub bricks: Vec<u32>,
    /// Where the list of each cell that lists something ends.
    pub lists: Vec<u32>,
    /// Entries of all lists.
    pub entries: Vec<u32>,
    /// Triangles in the near region.
    pub near: Vec<u32>,
}

/// What is wrong with a brick or a list.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum Fault {
    /// A list reaches beyond the pool.
    #[error("list {list}: {end} is not a valid end")]
    Dangling {
        /// List, numbered by the cells that have one.
        list: usize,
        /// The end of the list.
        end: u32,
    },
    /// An entry is in no list, or in more than one.
    #[error("{stored} entries were counted and {listed} are in lists")]
    Count {
        /// Entries counted.
        stored: usize,
        /// Entries found in lists.
        listed: usize,
    },
    /// An entry has an invalid triangle index.
    #[error("list {list}: there is no triangle {primitive}")]
    Primitive {
        /// List.
        list: usize,
        /// What is stored.
        primitive: u32,
    },
    /// A triangle is in a list twice.
    #[error("list {list}: triangle {primitive} is in the list twice")]
    Twice {
        /// List.
        list: usize,
        /// The triangle.
        primitive: u32,
    },
    /// The word of a brick does not count the cells before it, or calls a brick empty that lists something.
    #[error("brick {brick}: its word {word:#x} does not match the {cells} listed cells before it")]
    Word {
        /// Brick.
        brick: usize,
        /// Its word.
        word: u32,
        /// Cells that list something in the bricks before it.
        cells: u32,
    },
    /// A brick that lists something is skipped.
    #[error("brick {brick}: towards octant {octant} its distance skips a brick that lists something")]
    Distance {
        /// The empty brick.
        brick: usize,
        /// The octant.
        octant: u32,
    },
}

impl Contents {
    /// Cells that have a list.
    pub fn list_count(&self) -> usize {
        self.header.cell_demand.min(self.header.cell_capacity) as usize
    }

    /// Entries that were stored.
    fn stored(&self) -> usize {
        self.header.demand.min(self.header.capacity) as usize
    }

    /// The triangles of a list, in the order they are stored in. Lists are numbered by the cells that have one.
    ///
    /// # Errors
    /// The list leaves the pool.
    pub fn list(&self, list: usize) -> Result<&[u32], Fault> {
        let end = self.lists[list];
        let begin = if list == 0 { 0 } else { self.lists[list - 1] as usize };
        if begin > end as usize || end as usize > self.stored() {
            return Err(Fault::Dangling { list, end });
        }
        Ok(&self.entries[begin..end as usize])
    }
}

/// Checks that words of bricks number the cells that list something, and that no empty brick's distance skips one
/// that is not.
fn words_are_well_formed(contents: &Contents) -> Result<(), Fault> {
    let header = &contents.header;
    let [columns, rows, deep] =
        [header.columns, header.rows, header.slices].map(|cells| i64::from(cells) / 4);
    let views = i64::from(contents.config.views.count());
    let bricks = (views * columns * rows * deep) as usize;
    let cells_of = |brick: usize| {
        contents.bricks[3 * brick + 1].count_ones() + contents.bricks[3 * brick + 2].count_ones()
    };
    let mut cells = 0;
    for (brick, word) in contents.bricks.iter().copied().step_by(3).take(bricks).enumerate() {
        let empty = contents.config.skip && cells_of(brick) == 0;
        if empty != (word & BRICK_EMPTY != 0) || (!empty && word != cells) {
            return Err(Fault::Word { brick, word, cells });
        }
        cells += cells_of(brick);
        if !empty {
            continue;
        }
        let place = brick as i64;
        let (z, x, y, view) = (
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
                        .any(|z| cells_of((((view * rows + y) * columns + x) * deep + z) as usize) != 0)
                })
            });
            if goes_over {
                return Err(Fault::Distance { brick, octant });
            }
        }
    }
    Ok(())
}

/// Checks words of bricks, that every counted entry is in exactly one list and has the index of one of `triangles`
/// triangles, and that no list contains a triangle twice.
///
/// # Errors
/// The first fault found.
pub fn well_formed(contents: &Contents, triangles: u32) -> Result<(), Fault> {
    words_are_well_formed(contents)?;
    let stored = contents.stored();
    let mut listed = 0;
    for list in 0..contents.list_count() {
        let mut entries = contents.list(list)?.to_vec();
        listed += entries.len();
        if listed > stored {
            return Err(Fault::Count { stored, listed });
        }
        if let Some(&primitive) = entries.iter().find(|&&primitive| primitive >= triangles) {
            return Err(Fault::Primitive { list, primitive });
        }
        entries.sort_unstable();
        if let Some(pair) = entries.windows(2).find(|pair| pair[0] == pair[1]) {
            return Err(Fault::Twice { list, primitive: pair[0] });
        }
    }
    if listed == stored { Ok(()) } else { Err(Fault::Count { stored, listed }) }
}
