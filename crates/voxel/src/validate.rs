//! Checks the contents of built voxels and axis A-buffers.

use rasray_ads::ListCounts;

use crate::layout::{entry_words, levels};
use crate::{Config, Header, Leaves, Payload, Storage, Traversal, list_count};

/// Pools that rays read, as downloaded, in words.
#[derive(Clone, Debug)]
pub struct Contents {
    /// The configuration they were built with.
    pub config: Config,
    /// The header.
    pub header: Header,
    /// Four bits per voxel: the axes it is searched along, and whether something lies in it.
    pub voxels: Vec<u32>,
    /// Where voxels are the leaves, the complement of each voxel's triangle. Else of each cell: where its
    /// fragments end; or a link to the newest, the place + 1; or the word that leads to the newest page. 0
    /// where a linked list is empty.
    pub lists: Vec<u32>,
    /// Depth and triangle of each fragment, or depth, triangle or terms of the material, colour and normal;
    /// where it is linked its link behind these. Of a page the word that leads to the next one, and
    /// fragments.
    pub fragments: Vec<u32>,
    /// The octree, each level in the order of octants: for a node the octants that hold something, and the
    /// place of the first; in the last level the bits of eight voxels.
    pub nodes: Vec<u32>,
}

/// A fragment.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Fragment {
    /// Depth at the cell's centre, metres from the lower side of the cube.
    pub z: f32,
    /// Global triangle id; 0 where fragments do not say.
    pub primitive: u32,
}

/// Fault of a list or a voxel.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum Fault {
    /// A list reaches beyond the pool, or ends before it begins.
    #[error("list {list} leads to {place}, which is outside of the pool or before its beginning")]
    Dangling {
        /// The list: view, row and column as one number.
        list: usize,
        /// Its end, or its target: a fragment or a page.
        place: u32,
    },
    /// A word that leads to a page has no used slot, or more than a page has.
    #[error("list {list}: the word of page {page} has {used} used slots")]
    Page {
        /// The list.
        list: usize,
        /// Number of the page.
        page: u32,
        /// Used slots according to the word.
        used: u32,
    },
    /// A list is a cycle.
    #[error("list {list} is longer than all that is stored")]
    Circle {
        /// The list.
        list: usize,
    },
    /// A fragment is in more than one list.
    #[error("list {list}: the fragment at {place} is in two lists")]
    Shared {
        /// The second list.
        list: usize,
        /// Place of the fragment.
        place: u32,
    },
    /// A fragment is in no list.
    #[error("{stored} fragments were counted and {listed} are in lists")]
    Count {
        /// Fragments counted.
        stored: usize,
        /// Fragments found in lists.
        listed: usize,
    },
    /// A fragment has an invalid triangle index.
    #[error("list {list}: there is no triangle {primitive}")]
    Primitive {
        /// The list.
        list: usize,
        /// Index stored.
        primitive: u32,
    },
    /// A sorted list is not in order, or contains a triangle twice.
    #[error("list {list}: fragment {fragment:?} is out of order")]
    Order {
        /// The list.
        list: usize,
        /// The fragment.
        fragment: Fragment,
    },
    /// A depth lies outside of the cube or is NaN.
    #[error("list {list}: the depth {z} is outside of the cube")]
    Depth {
        /// The list.
        list: usize,
        /// The depth, as text: it may be NaN.
        z: String,
    },
    /// The octree says something else of a voxel than the voxel.
    #[error("voxel {voxel} has the bits {bits:04b}, and {found:04b} in the octree")]
    Octree {
        /// The voxel.
        voxel: usize,
        /// Its bits.
        bits: u32,
        /// Its bits in the octree.
        found: u32,
    },
    /// An occupied voxel that is hit itself has an invalid triangle index, or an empty one has a triangle.
    #[error("voxel {voxel} is occupied without a triangle or empty with one: {primitive}")]
    Triangle {
        /// The voxel.
        voxel: usize,
        /// Its triangle.
        primitive: u32,
    },
    /// An empty voxel is searched, or an occupied one is not.
    #[error("voxel {voxel} has the bits {bits:04b}")]
    Voxel {
        /// The voxel.
        voxel: usize,
        /// Its bits.
        bits: u32,
    },
}

impl Contents {
    /// Places of fragments that a build may have filled; of pages all slots.
    fn stored(&self) -> u32 {
        let entries = self.header.demand.min(self.header.capacity);
        if self.config.storage == Storage::Paged { entries * self.config.page } else { entries }
    }

    /// The first word of a fragment.
    fn first_word(&self, place: u32) -> usize {
        let entry = entry_words(&self.config) as usize;
        if self.config.storage == Storage::Paged {
            let (page, slot) = ((place / self.config.page) as usize, (place % self.config.page) as usize);
            return page * entry + 1 + slot * self.config.fragment_words() as usize;
        }
        place as usize * entry
    }

    /// Places of the fragments of a list, in the order in which they are read.
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
            // A page is filled from its end.
            places.extend(slots * (page + 1) - used..slots * (page + 1));
            word = self.fragments[page as usize * entry_words(&self.config) as usize];
        }
        Ok(places)
    }

    /// Counts the fragments in the cells of each view, then those in the voxels. A voxel is occupied where
    /// rays search it; its layers are the fragments of all views at whose depths it lies.
    ///
    /// # Errors
    /// As [`Contents::list`].
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
            // A voxel that is hit itself holds a triangle.
            let layers = if views.is_empty() { usize::from(is_searched(&voxel)) } else { layers };
            voxels.add_cell(layers, layers, layers);
        }
        voxels.occupied = (0..grid.pow(3)).filter(is_searched).count() as u64;
        counts.push(voxels);
        Ok(counts)
    }

    /// Slots that a list of so many fragments takes.
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

    /// The voxel in which a fragment of a view's cell lies, at a depth in metres.
    fn voxel_at(&self, axis: usize, cell: u32, z: f32) -> usize {
        let (resolution, grid) = (self.config.resolution, self.config.grid());
        let centre = |cell: u32| (cell as f32 + 0.5) * self.header.cell;
        let [x, y, z] = [centre(cell % resolution), centre(cell / resolution), z]
            .map(|metres| ((metres / self.header.voxel).max(0.0) as u32).min(grid - 1) as usize);
        let grid = grid as usize;
        // From the axes of the view to those of the world.
        let [x, y, z] = [[z, x, y], [y, z, x], [x, y, z]][axis];
        (z * grid + y) * grid + x
    }

    /// The bits of a voxel of the grid.
    fn bits(&self, voxel: usize) -> u32 {
        self.voxels[voxel / 8] >> (4 * (voxel % 8)) & 15
    }

    /// The bits of a voxel as the octree has them; absent where a node leads out of the pool.
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

    /// The fragments of a list, in the order in which they are read.
    ///
    /// # Errors
    /// The list leaves the pool or is a cycle.
    pub fn list(&self, list: usize) -> Result<Vec<Fragment>, Fault> {
        Ok(self.places(list)?.into_iter().map(|place| self.fragment(place)).collect())
    }
}

/// Checks of a complete build that every counted fragment is in one list, has a depth within the cube and,
/// where it has a triangle index, that of one of `triangles`, that lists are sorted where they should be,
/// that voxels are searched if and only if they hold something, and that the octree says the same of each.
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
