//! Checks of the contents of built voxels and axis A-buffers.

use rasray_ads::ListCounts;

use crate::layout::{entry_words, levels};
use crate::{Config, Header, Leaves, Payload, Storage, Traversal, list_count};

/// Downloaded contents of the pools that rays read, in words.
#[derive(Clone, Debug)]
pub struct Contents {
    /// Configuration of the build.
    pub config: Config,
    /// Header after the build.
    pub header: Header,
    /// Four bits per voxel: three for the axes along which it is searched, one for occupancy.
    pub voxels: Vec<u32>,
    /// Word of each list. If voxels are the leaves, the complement of each voxel's triangle. Otherwise, for
    /// each cell, the end of its fragments, the link to its newest fragment (the place + 1), or the word that
    /// leads to its newest page. 0 for an empty linked list.
    pub lists: Vec<u32>,
    /// Fragments: depth and triangle, or depth, triangle or terms of the material, colour and normal. A
    /// linked fragment has its link behind these words. A page has the word that leads to the next page,
    /// followed by fragments.
    pub fragments: Vec<u32>,
    /// Nodes of the octree, each level in the order of octants. A node has the octants that hold something,
    /// and the place of the first of them; a node of the last level has the bits of eight voxels.
    pub nodes: Vec<u32>,
}

/// Fragment as a cell keeps it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Fragment {
    /// Depth at the cell's centre, in metres from the lower side of the cube.
    pub z: f32,
    /// Global triangle id; 0 if fragments have none.
    pub primitive: u32,
}

/// Fault in a list or a voxel.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum Fault {
    /// List that reaches beyond the pool, or ends before it begins.
    #[error("list {list} leads to {place}, which is outside of the pool or before its beginning")]
    Dangling {
        /// Number of the list: view, row and column as one number.
        list: usize,
        /// End of the list, or its target: a fragment or a page.
        place: u32,
    },
    /// Word that leads to a page with no used slot, or with more than a page has.
    #[error("list {list}: the word of page {page} has {used} used slots")]
    Page {
        /// Number of the list.
        list: usize,
        /// Number of the page.
        page: u32,
        /// Number of used slots according to the word.
        used: u32,
    },
    /// List that is a cycle.
    #[error("list {list} is longer than all that is stored")]
    Circle {
        /// Number of the list.
        list: usize,
    },
    /// Fragment that is in more than one list.
    #[error("list {list}: the fragment at {place} is in two lists")]
    Shared {
        /// Number of the second list.
        list: usize,
        /// Place of the fragment.
        place: u32,
    },
    /// Fragment that is in no list.
    #[error("{stored} fragments were counted and {listed} are in lists")]
    Count {
        /// Number of fragments that the build counted.
        stored: usize,
        /// Number of fragments found in lists.
        listed: usize,
    },
    /// Fragment with an invalid triangle index.
    #[error("list {list}: there is no triangle {primitive}")]
    Primitive {
        /// Number of the list.
        list: usize,
        /// Triangle index, as stored.
        primitive: u32,
    },
    /// Sorted list that is not in order, or contains a triangle twice.
    #[error("list {list}: fragment {fragment:?} is out of order")]
    Order {
        /// Number of the list.
        list: usize,
        /// Fragment out of order.
        fragment: Fragment,
    },
    /// Depth that lies outside of the cube or is NaN.
    #[error("list {list}: the depth {z} is outside of the cube")]
    Depth {
        /// Number of the list.
        list: usize,
        /// The depth, as text: it may be NaN.
        z: String,
    },
    /// Voxel whose bits in the octree differ from its own.
    #[error("voxel {voxel} has the bits {bits:04b}, and {found:04b} in the octree")]
    Octree {
        /// Index of the voxel.
        voxel: usize,
        /// Bits of the voxel.
        bits: u32,
        /// Bits of the voxel in the octree.
        found: u32,
    },
    /// Occupied leaf voxel with an invalid triangle index, or empty one with a triangle.
    #[error("voxel {voxel} is occupied without a triangle or empty with one: {primitive}")]
    Triangle {
        /// Index of the voxel.
        voxel: usize,
        /// Triangle of the voxel.
        primitive: u32,
    },
    /// Empty voxel that is searched, or occupied one that is not.
    #[error("voxel {voxel} has the bits {bits:04b}")]
    Voxel {
        /// Index of the voxel.
        voxel: usize,
        /// Bits of the voxel.
        bits: u32,
    },
}

impl Contents {
    /// Returns the number of places of fragments that a build may have filled; of a page all slots count.
    fn stored(&self) -> u32 {
        let entries = self.header.demand.min(self.header.capacity);
        if self.config.storage == Storage::Paged { entries * self.config.page } else { entries }
    }

    /// Returns the index of the first word of a fragment.
    fn first_word(&self, place: u32) -> usize {
        let entry = entry_words(&self.config) as usize;
        if self.config.storage == Storage::Paged {
            let (page, slot) = ((place / self.config.page) as usize, (place % self.config.page) as usize);
            return page * entry + 1 + slot * self.config.fragment_words() as usize;
        }
        place as usize * entry
    }

    /// Returns the places of the fragments of a list, in the order in which rays read them.
    ///
    /// # Errors
    /// The list leaves the pool or is a cycle.
    pub fn places(&self, list: usize) -> Result<Vec<u32>, Fault> {
        match self.config.storage {
            Storage::Contiguous => {
                let begin = if list == 0 { 0 } else { self.lists[list - 1] };
                let end = self.lists[list];
                if begin > end || end > self.stored() {
                    return Err(Fault::Dangling { list, place: end });
                }
                Ok((begin..end).collect())
            }
            Storage::Linked => self.follow(list),
            Storage::Paged => self.turn_pages(list),
        }
    }

    fn follow(&self, list: usize) -> Result<Vec<u32>, Fault> {
        let (stored, link) = (self.stored(), self.config.fragment_words() as usize);
        let mut places = Vec::new();
        let mut next = self.lists[list];
        while let Some(place) = next.checked_sub(1) {
            if place >= stored {
                return Err(Fault::Dangling { list, place });
            }
            if places.len() >= stored as usize {
                return Err(Fault::Circle { list });
            }
            places.push(place);
            next = self.fragments[self.first_word(place) + link];
        }
        Ok(places)
    }

    fn turn_pages(&self, list: usize) -> Result<Vec<u32>, Fault> {
        let (stored, slots) = (self.stored(), self.config.page);
        let mut places = Vec::new();
        let mut word = self.lists[list];
        while word != 0 {
            let (page, used) = ((word >> 4).wrapping_sub(1), word & 15);
            if page >= stored / slots {
                return Err(Fault::Dangling { list, place: page });
            }
            if used == 0 || used > slots {
                return Err(Fault::Page { list, page, used });
            }
            if places.len() >= stored as usize {
                return Err(Fault::Circle { list });
            }
            // The build fills a page from its end.
            places.extend(slots * (page + 1) - used..slots * (page + 1));
            word = self.fragments[page as usize * entry_words(&self.config) as usize];
        }
        Ok(places)
    }

    /// Counts the fragments in the cells of each view, then those in the voxels. A voxel is occupied if rays
    /// search it. Its layers are the fragments of all views whose depths lie in it.
    ///
    /// # Errors
    /// Those of [`Contents::list`].
    pub fn list_counts(&self) -> Result<Vec<ListCounts>, Fault> {
        let bytes = 4 * self.config.fragment_words();
        let (grid, cells) = (self.config.grid() as usize, self.config.resolution.pow(2) as usize);
        let mut counts = Vec::new();
        let mut layers = vec![0_usize; grid.pow(3)];
        let views = if self.config.leaves == Leaves::Fragments { &ListCounts::AXES[..] } else { &[] };
        for (axis, cells_of) in views.iter().enumerate() {
            let mut view = ListCounts::new(cells_of, bytes);
            for cell in 0..cells {
                let places = self.places(axis * cells + cell)?;
                for place in &places {
                    layers[self.voxel_at(axis, cell as u32, self.fragment(*place).z)] += 1;
                }
                view.add_cell(places.len(), places.len(), self.slots_of(&places));
            }
            counts.push(view);
        }
        let is_searched = |voxel: &usize| self.bits(*voxel) != 0;
        let mut voxels = ListCounts::new(ListCounts::VOXELS, bytes);
        for (voxel, layers) in layers.into_iter().enumerate() {
            // A leaf voxel holds one triangle.
            let layers = if views.is_empty() { usize::from(is_searched(&voxel)) } else { layers };
            voxels.add_cell(layers, layers, layers);
        }
        voxels.occupied = (0..grid.pow(3)).filter(is_searched).count() as u64;
        counts.push(voxels);
        Ok(counts)
    }

    /// Returns the number of slots that a list with these fragments takes.
    fn slots_of(&self, places: &[u32]) -> usize {
        match self.config.storage {
            Storage::Paged => {
                let page = self.config.page;
                let pages = places.chunk_by(|one, next| one / page == next / page).count();
                page as usize * pages
            }
            Storage::Contiguous | Storage::Linked => places.len(),
        }
    }

    /// Returns the voxel that contains a fragment of a view's cell, at a depth in metres.
    fn voxel_at(&self, axis: usize, cell: u32, z: f32) -> usize {
        let (resolution, grid) = (self.config.resolution, self.config.grid());
        let centre = |cell: u32| (cell as f32 + 0.5) * self.header.cell;
        let [x, y, z] = [centre(cell % resolution), centre(cell / resolution), z]
            .map(|metres| ((metres / self.header.voxel).max(0.0) as u32).min(grid - 1) as usize);
        let grid = grid as usize;
        // Converts the axes of the view to those of the world.
        let [x, y, z] = [[z, x, y], [y, z, x], [x, y, z]][axis];
        (z * grid + y) * grid + x
    }

    /// Returns the bits of a voxel of the grid.
    fn bits(&self, voxel: usize) -> u32 {
        self.voxels[voxel / 8] >> (4 * (voxel % 8)) & 15
    }

    /// Returns the bits of a voxel in the octree, or `None` if a node leads out of the pool.
    fn bits_in_octree(&self, voxel: [u32; 3]) -> Option<u32> {
        let octant = |level: u32| voxel.iter().rev().fold(0, |octant, x| octant << 1 | x >> level & 1);
        let mut place = 0;
        for level in (1..levels(&self.config)).rev() {
            let word = *self.nodes.get(place as usize)?;
            if word >> octant(level) & 1 == 0 {
                return Some(0);
            }
            place = (word >> 8) + (word & ((1 << octant(level)) - 1)).count_ones();
        }
        self.nodes.get(place as usize).map(|word| word >> (4 * octant(0)) & 15)
    }

    fn fragment(&self, place: u32) -> Fragment {
        let word = self.first_word(place);
        let named = self.config.payload != Payload::Material;
        let primitive = if named { self.fragments[word + 1] } else { 0 };
        Fragment { z: f32::from_bits(self.fragments[word]), primitive }
    }

    /// Returns the fragments of a list, in the order in which rays read them.
    ///
    /// # Errors
    /// The list leaves the pool or is a cycle.
    pub fn list(&self, list: usize) -> Result<Vec<Fragment>, Fault> {
        Ok(self.places(list)?.into_iter().map(|place| self.fragment(place)).collect())
    }
}

/// Checks a complete build: that every counted fragment is in one list, has a depth within the cube and, if
/// it has a triangle index, that of one of `triangles`; that lists are sorted where they should be; that
/// voxels are searched if and only if they hold something; and that the octree agrees with every voxel.
///
/// # Errors
/// The first fault found.
pub fn well_formed(contents: &Contents, triangles: u32) -> Result<(), Fault> {
    let stored = contents.header.fragments as usize;
    let sorted = contents.config.sorts() && contents.header.unsorted == 0;
    let side = contents.header.cell * contents.header.resolution as f32 * 1.0001;
    // Fragments of one depth without a triangle index may be in any order.
    let named = contents.config.payload != Payload::Material;
    let mut listed = 0;
    let mut seen = vec![false; contents.stored() as usize];
    let keeps = contents.config.leaves == Leaves::Fragments;
    let lists = if keeps { list_count(contents.config.resolution) as usize } else { 0 };
    for list in 0..lists {
        let places = contents.places(list)?;
        listed += places.len();
        for &place in &places {
            if std::mem::replace(&mut seen[place as usize], true) {
                return Err(Fault::Shared { list, place });
            }
        }
        let fragments: Vec<Fragment> = places.iter().map(|&place| contents.fragment(place)).collect();
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
        let bits = contents.bits(voxel);
        if contents.config.traversal == Traversal::Octree {
            let place = [voxel % grid, voxel / grid % grid, voxel / grid / grid].map(|x| x as u32);
            let found = contents.bits_in_octree(place).unwrap_or(0);
            if found != bits {
                return Err(Fault::Octree { voxel, bits, found });
            }
        }
        if (bits & 8 != 0) != (bits & 7 != 0) {
            return Err(Fault::Voxel { voxel, bits });
        }
        let primitive = if keeps { u32::MAX } else { !contents.lists[voxel] };
        if !keeps && (bits != 0) != (primitive < triangles) {
            return Err(Fault::Triangle { voxel, primitive });
        }
    }
    Ok(())
}
