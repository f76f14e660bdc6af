//! Checks of the contents of built bricks.

use rasray_shaders_glsl::constants::bricks::BRICKS_EMPTY;

use crate::grid::BRICK_SIDE;
use crate::{Config, Header};

/// Downloaded contents of all pools, in words.
#[derive(Clone, Debug)]
pub struct Contents {
    /// Configuration of the build.
    pub config: Config,
    /// Header after the build.
    pub header: Header,
    /// Words of bricks, [`Config::brick_words`] each.
    pub bricks: Vec<u32>,
    /// End of the list of each cell that lists something or is divided. If cells are divided, as many words
    /// again follow.
    pub lists: Vec<u32>,
    /// Entries of all lists.
    pub entries: Vec<u32>,
    /// Triangles in the near region.
    pub near: Vec<u32>,
}

/// Fault in a brick or a list.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum Fault {
    /// List that reaches beyond the pool.
    #[error("list {list}: {end} is not a valid end")]
    Dangling {
        /// Number of the list, among the cells that have one.
        list: usize,
        /// End of the list.
        end: u32,
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
    #[error("list {list}: there is no triangle {primitive}")]
    Primitive {
        /// Number of the list.
        list: usize,
        /// Triangle index, as stored.
        primitive: u32,
    },
    /// Triangle that is in a list twice.
    #[error("list {list}: triangle {primitive} is in the list twice")]
    Twice {
        /// Number of the list.
        list: usize,
        /// Index of the triangle.
        primitive: u32,
    },
    /// Brick whose lists have numbers of another brick's lists or beyond the last, or whose word says that it
    /// is empty although it is not.
    #[error("brick {brick}: its word {word:#x} does not fit its {cells} cells that list something")]
    Word {
        /// Index of the brick.
        brick: usize,
        /// Word of the brick.
        word: u32,
        /// Number of cells that list something or are divided.
        cells: u32,
    },
    /// Divided cell that has no brick, the brick of another cell, or a list as well.
    #[error("brick {brick}: its cell {cell} is divided into brick {child}, which is not that cell's")]
    Division {
        /// Index of the brick.
        brick: usize,
        /// Divided cell, as the bit of the mask.
        cell: u32,
        /// Index of the divided cell's brick.
        child: usize,
    },
    /// Cell beyond the first, along an axis that is not divided.
    #[error("brick {brick}: there is no cell {cell} along the axes that level {level} divides")]
    Beyond {
        /// Index of the brick.
        brick: usize,
        /// Cell at fault, as the bit of the mask.
        cell: u32,
        /// Level of the brick.
        level: u32,
    },
    /// Brick that lists something, but that a distance skips.
    #[error("brick {brick}: towards octant {octant} its distance skips a brick that lists something")]
    Distance {
        /// Index of the empty brick with the distance.
        brick: usize,
        /// Octant of the distance.
        octant: u32,
    },
}

impl Contents {
    /// Returns the number of cells that have a list.
    pub fn list_count(&self) -> usize {
        self.header.cell_demand.min(self.header.cell_capacity) as usize
    }

    /// Returns the number of entries that were stored.
    fn stored(&self) -> usize {
        self.header.demand.min(self.header.capacity) as usize
    }

    /// Returns the triangles of a list, in the order in which they are stored. Lists are numbered by the
    /// cells that have one.
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

/// Cell that lists something.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Cell {
    /// Number of times that a cell of the views was divided to make this one.
    pub level: u32,
    /// Index of the cube's face; 0 along the axes.
    pub view: u32,
    /// Column, row and slice, among the cells of the cell's level.
    pub place: [u32; 3],
    /// Number of the cell's list.
    pub list: usize,
}

/// Place of a brick in the views.
#[derive(Clone, Copy, Debug)]
struct Place {
    brick: usize,
    level: u32,
    view: u32,
    /// Column, row and slice, among the bricks of the level.
    at: [u32; 3],
}

impl Contents {
    /// Returns the words of a brick.
    fn words(&self, brick: usize) -> &[u32] {
        let words = self.config.brick_words() as usize;
        &self.bricks[words * brick..words * (brick + 1)]
    }

    /// Returns two masks of a brick: the cells that list something, and the cells that are divided.
    fn masks(&self, brick: usize) -> [u64; 2] {
        let words = self.words(brick);
        let mask = |at: usize| u64::from(words[at]) | u64::from(words[at + 1]) << 32;
        [mask(1), if self.config.divides() { mask(3) } else { 0 }]
    }

    /// Returns the columns, rows and slices of the views, in bricks.
    fn bricks_along(&self) -> [u32; 3] {
        [self.header.columns, self.header.rows, self.header.slices].map(|cells| cells / 4)
    }

    /// Returns the places of the bricks of the views.
    fn of_views(&self) -> impl Iterator<Item = Place> + use<> {
        let [columns, rows, deep] = self.bricks_along();
        (0..self.config.views.count() * columns * rows * deep).map(move |brick| Place {
            brick: brick as usize,
            level: 0,
            view: brick / (deep * columns * rows),
            at: [brick / deep % columns, brick / (deep * columns) % rows, brick % deep],
        })
    }

    /// Returns the places of all bricks, each before those of its divided cells.
    ///
    /// # Errors
    /// The brick of a divided cell belongs to another cell.
    fn all_bricks(&self) -> Result<Vec<Place>, Fault> {
        let mut places: Vec<Place> = self.of_views().collect();
        let (first, stored) =
            (places.len(), self.header.brick_demand.min(self.header.brick_capacity) as usize);
        let mut seen = vec![false; stored.saturating_sub(first)];
        let mut next = 0;
        while next < places.len() {
            let parent = places[next];
            let [_, divided] = self.masks(parent.brick);
            for (child, cell) in bits_of(divided).enumerate() {
                let child = self.words(parent.brick)[5] as usize + child;
                let place = Place {
                    brick: child,
                    level: parent.level + 1,
                    view: parent.view,
                    at: self.cell_at(parent, cell),
                };
                let fault = Fault::Division { brick: parent.brick, cell, child };
                let known = child.checked_sub(first).and_then(|child| seen.get_mut(child));
                let Some(known) = known.filter(|known| !**known) else { return Err(fault) };
                *known = true;
                let words = self.words(child);
                if [words[6] & 0xFFFF, words[6] >> 16, words[7]] != place.at {
                    return Err(fault);
                }
                places.push(place);
            }
            next += 1;
        }
        Ok(places)
    }

    /// Returns the number of cells of a brick along each axis, on a level: 4, or 1 along an axis that was not
    /// divided.
    fn side(&self, level: u32) -> [u32; 3] {
        self.header.depths.map(|depth| if level <= depth { BRICK_SIDE } else { 1 })
    }

    /// Returns the place of a bit of a brick, among the cells of the brick's level.
    fn cell_at(&self, brick: Place, bit: u32) -> [u32; 3] {
        let (side, within) = (self.side(brick.level), within_brick(bit));
        std::array::from_fn(|axis| side[axis] * brick.at[axis] + within[axis])
    }

    /// Returns all cells that list something.
    ///
    /// # Errors
    /// The brick of a divided cell belongs to another cell.
    pub fn cells(&self) -> Result<Vec<Cell>, Fault> {
        let mut cells = Vec::new();
        for place in self.all_bricks()? {
            let Place { brick, level, view, .. } = place;
            let [listed, divided] = self.masks(brick);
            let list = self.words(brick)[0] as usize;
            cells.extend(
                bits_of(listed | divided).enumerate().filter(|(_, cell)| listed >> cell & 1 != 0).map(
                    |(rank, cell)| Cell { level, view, place: self.cell_at(place, cell), list: list + rank },
                ),
            );
        }
        Ok(cells)
    }
}

/// Returns the numbers of the bits that are set.
fn bits_of(mask: u64) -> impl Iterator<Item = u32> {
    (0..u64::BITS).filter(move |bit| mask >> bit & 1 != 0)
}

/// Returns the column, row and slice of a bit within a brick.
fn within_brick(bit: u32) -> [u32; 3] {
    [bit % 4, bit / 4 % 4, bit / 16]
}

/// Checks that the words of bricks number the cells that list something or are divided, each once, that empty
/// bricks are marked as empty, that no cell lies beyond those of its level, and that the lists of divided
/// cells are empty.
fn words_are_well_formed(contents: &Contents) -> Result<(), Fault> {
    let mut taken = vec![false; contents.list_count()];
    for Place { brick, level, .. } in contents.all_bricks()? {
        let [listed, divided] = contents.masks(brick);
        let (word, cells) = (contents.words(brick)[0], (listed | divided).count_ones());
        let fault = Fault::Word { brick, word, cells };
        if level == 0 && contents.config.skip && (cells == 0) != (word & BRICKS_EMPTY != 0) {
            return Err(fault);
        }
        if cells == 0 {
            continue;
        }
        let side = contents.side(level);
        for (rank, cell) in bits_of(listed | divided).enumerate() {
            if (0..3).any(|axis| within_brick(cell)[axis] >= side[axis]) {
                return Err(Fault::Beyond { brick, cell, level });
            }
            let list = word as usize + rank;
            let taken = taken.get_mut(list).filter(|taken| !**taken).ok_or(fault.clone())?;
            *taken = true;
            if divided >> cell & 1 != 0 && !contents.list(list)?.is_empty() {
                return Err(Fault::Division { brick, cell, child: contents.words(brick)[5] as usize });
            }
        }
    }
    match taken.iter().position(|taken| !taken) {
        None => Ok(()),
        Some(list) => Err(Fault::Dangling { list, end: contents.lists[list] }),
    }
}

/// Checks that no empty brick's distance skips a brick that is not empty.
fn distances_are_well_formed(contents: &Contents) -> Result<(), Fault> {
    let [columns, rows, deep] = contents.bricks_along().map(i64::from);
    let empty = |brick: usize| contents.masks(brick) == [0; 2];
    for Place { brick, view, at, .. } in contents.of_views().filter(|place| empty(place.brick)) {
        let words = contents.words(brick);
        let [x, y, z] = at.map(i64::from);
        for octant in 0..8_u32 {
            let along = |up: u32, at: i64, distance: i64, end: i64| {
                if octant & up != 0 { at..=(at + distance).min(end - 1) } else { (at - distance).max(0)..=at }
            };
            let goes_over = |distance: i64, tall: i64| {
                along(4, y, tall, rows).any(|y| {
                    along(2, x, distance, columns).any(|x| {
                        along(1, z, distance, deep).any(|z| {
                            !empty((((i64::from(view) * rows + y) * columns + x) * deep + z) as usize)
                        })
                    })
                })
            };
            let cube = i64::from(words[0] >> (3 * octant) & 7);
            let layer = words.get(6).map_or(0, |word| i64::from(word >> (4 * (octant & 3)) & 15) - 1);
            if goes_over(cube, cube) || goes_over(layer.max(0), 0) {
                return Err(Fault::Distance { brick, octant });
            }
        }
    }
    Ok(())
}

/// Checks the words of bricks, that every counted entry is in exactly one list and has the index of one of
/// `triangles` triangles, and that no list contains a triangle twice.
///
/// # Errors
/// The first fault found.
pub fn well_formed(contents: &Contents, triangles: u32) -> Result<(), Fault> {
    words_are_well_formed(contents)?;
    if contents.config.skip {
        distances_are_well_formed(contents)?;
    }
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
