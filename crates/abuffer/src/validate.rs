//! Checks of the contents of a built A-buffer.

use rasray_ads::ListCounts;
use rasray_shaders_glsl::constants::ads::CONSERVATIVE_SLICE;

use crate::layout::{
    bounds_words, data_words, fragment_words, node_slots, node_words, slot_bytes, view_cells,
};
use crate::{Config, Fault, Header, Storage, cell_count};

/// Downloaded contents of all pools, in words, without the large-triangle queue of the binning builder.
#[derive(Clone, Debug)]
pub struct Contents {
    /// Configuration of the build.
    pub config: Config,
    /// Header after the build.
    pub header: Header,
    /// Bounds of each cell, and of the blocks of the pyramid; marks of triangles; boxes around objects.
    pub bounds: Vec<u32>,
    /// Head of each list, and its tail if lists are doubly linked. For contiguous lists all first places,
    /// then all counts. For paged lists the word that leads to the first page.
    pub lists: Vec<u32>,
    /// Nodes. Each has a depth, the inline payload, and then its next link, its previous link, or the place
    /// of its payload. A page has the word that leads to the next page, followed by nodes without links.
    pub nodes: Vec<u32>,
    /// Payload of each fragment, if it is not inline.
    pub data: Vec<u32>,
    /// Triangles in the near region.
    pub near: Vec<u32>,
    /// Sums of the scan of contiguous lists, and the lists that are too long for one dispatch to sort, each
    /// with how far it is sorted.
    pub scratch: Vec<u32>,
    /// Triangle, next link and depths of each node of the conservative lists; of a slice of a long list, the
    /// link of its first triangle, the next slice, and the depths of all its triangles.
    pub conservative: Vec<u32>,
}

/// Fragment as a node stores it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Fragment<'a> {
    /// Depth at the cell's centre, in metres.
    pub z: f32,
    /// Words of the fragment's payload.
    pub payload: &'a [u32],
}

impl Contents {
    /// Returns the number of fragment slots that the stored nodes have; of a page all slots count.
    fn stored(&self) -> usize {
        self.header.demand.min(self.header.capacity) as usize * self.slots()
    }

    /// Returns true if the pool has stored every node that the build asked for.
    fn complete(&self) -> bool {
        self.header.demand <= self.header.capacity
    }

    /// Returns the capacity of a node, in fragments.
    fn slots(&self) -> usize {
        node_slots(&self.config) as usize
    }

    fn node(&self, link: u32) -> &[u32] {
        let (node, slot) = ((link as usize - 1) / self.slots(), (link as usize - 1) % self.slots());
        let words = fragment_words(&self.config) as usize;
        let next = usize::from(self.config.storage == Storage::Paged);
        &self.nodes[node_words(&self.config) as usize * node + next + slot * words..][..words]
    }

    /// Returns the word of a page that leads to the next page.
    fn next_page(&self, page: usize) -> u32 {
        self.nodes[node_words(&self.config) as usize * page]
    }

    fn z(&self, link: u32) -> f32 {
        f32::from_bits(self.node(link)[0])
    }

    /// Returns the place of a node's payload in the payload pool. Meaningless if the payload is inline.
    fn payload_place(&self, link: u32) -> u32 {
        if self.config.storage == Storage::Sb { self.node(link)[1] } else { link - 1 }
    }

    /// Returns the words of a fragment's payload. The first word orders fragments of equal depth.
    fn payload(&self, link: u32) -> &[u32] {
        let words = data_words(&self.config) as usize;
        if self.config.inline {
            &self.node(link)[1..][..words]
        } else {
            &self.data[self.payload_place(link) as usize * words..][..words]
        }
    }

    /// Returns the links of a node: next, and previous if lists are doubly linked.
    fn links(&self, link: u32) -> &[u32] {
        let inline = if self.config.inline { data_words(&self.config) as usize } else { 0 };
        &self.node(link)[1 + inline..]
    }

    /// Returns the triangles of a cell's conservative list, as far as the pool has stored them.
    ///
    /// # Errors
    /// A link points to no node, or leads in a circle, or a slice does not hold its triangles.
    pub fn conservative_list_of(&self, cell: usize) -> Result<Vec<u32>, Fault> {
        Ok(self.conservative_nodes_of(cell)?.0)
    }

    /// Returns the triangles of a cell's conservative list and the number of its slices.
    fn conservative_nodes_of(&self, cell: usize) -> Result<(Vec<u32>, usize), Fault> {
        let (mut triangles, mut slices) = (Vec::new(), 0);
        if !self.config.has_conservative_lists() {
            return Ok((triangles, slices));
        }
        let stored = self.header.conservative_demand.min(self.header.conservative_capacity) as usize;
        let mut link = self.bounds[(cell + 1) * bounds_words(&self.config) as usize - 1];
        // Depths of the slice around the node, and the slice next to it. A list that is not divided is like
        // one slice.
        let (mut around, mut behind) = ([0, 0x7FFF], 0);
        while link != 0 {
            if link as usize > stored || triangles.len() + slices >= stored {
                return Err(Fault::Conservative { cell, link });
            }
            let &[first, next, depths] =
                self.conservative[3 * (link as usize - 1)..].first_chunk().expect("the pool has whole nodes");
            let [low, high] = [depths & 0xFFFF, (depths & !CONSERVATIVE_SLICE) >> 16];
            if depths & CONSERVATIVE_SLICE != 0 {
                if slices != 0 && link != behind {
                    return Err(Fault::Slice { cell, link });
                }
                slices += 1;
                (around, behind, link) = ([low, high], next, first);
            } else {
                if low < around[0] || high > around[1] || (slices != 0 && link == behind) {
                    return Err(Fault::Slice { cell, link });
                }
                triangles.push(first);
                link = next;
            }
        }
        if behind == 0 { Ok((triangles, slices)) } else { Err(Fault::Slice { cell, link: behind }) }
    }

    /// Returns the fragment to which a hit without a triangle id refers by the bits of its `a`, or `None` if
    /// no fragment is stored there.
    pub fn fragment(&self, link: u32) -> Option<Fragment<'_>> {
        let is_stored = link != 0 && link as usize <= self.stored();
        is_stored.then(|| Fragment { z: self.z(link), payload: self.payload(link) })
    }

    /// Returns the fragments of each cell, over all its buckets.
    ///
    /// # Errors
    /// A link points to no node, or a list is damaged in another way.
    pub fn fragments(&self) -> Result<Vec<Vec<Fragment<'_>>>, Fault> {
        let mut pages = vec![false; self.stored() / self.slots()];
        let (mut linked, mut place) = (0, 0);
        let mut cells = Vec::new();
        for cell in 0..cell_count(&self.config) as usize {
            let mut found = Vec::new();
            for bucket in 0..self.config.lists() as usize {
                let links = links(self, cell, bucket, linked, &mut place, &mut pages)?;
                linked += links.len();
                let fragment = |link| Fragment { z: self.z(link), payload: self.payload(link) };
                found.extend(links.into_iter().map(fragment));
            }
            cells.push(found);
        }
        Ok(cells)
    }

    /// Counts the fragments in the cells of each view. Triangles of conservative lists do not count as
    /// layers.
    ///
    /// # Errors
    /// Those of [`Contents::fragments`].
    pub fn list_counts(&self) -> Result<Vec<ListCounts>, Fault> {
        let slots = self.slots();
        let mut pages = vec![false; self.stored() / slots];
        let (mut linked, mut place, mut cell) = (0, 0, 0);
        let mut counts = Vec::new();
        for (cells_of, cells) in view_cells(&self.config) {
            let mut view = ListCounts::new(cells_of, slot_bytes(&self.config));
            for _ in 0..cells {
                let (mut fragments, mut taken) = (0, 0);
                for bucket in 0..self.config.lists() as usize {
                    let links = links(self, cell, bucket, linked, &mut place, &mut pages)?;
                    linked += links.len();
                    fragments += links.len();
                    let page = |link: &u32| (*link as usize - 1) / slots;
                    taken += slots * links.chunk_by(|one, next| page(one) == page(next)).count();
                }
                view.add_cell(fragments, fragments, taken);
                cell += 1;
            }
            counts.push(view);
        }
        Ok(counts)
    }

    fn head(&self, list: usize) -> u32 {
        if self.config.storage.is_doubly_linked() { self.lists[2 * list] } else { self.lists[list] }
    }
}

/// Checks that every allocated node is in exactly one list, that links agree in both directions, that depths
/// lie within bounds, that lists are sorted where they should be, and that every node of the conservative
/// lists is in exactly one of these lists.
///
/// # Errors
/// The first fault found.
pub fn well_formed(contents: &Contents) -> Result<(), Fault> {
    let config = &contents.config;
    let buckets = config.lists() as usize;
    let stored = contents.stored();
    // Incomplete lists are not sorted.
    let sorted = config.sort && contents.header.unsorted == 0 && contents.complete();
    let mut named = vec![false; stored];
    let mut pages = vec![false; stored / contents.slots()];
    let (mut linked, mut in_conservative, mut slices) = (0, 0, 0);
    let mut place = 0;
    for cell in 0..cell_count(config) as usize {
        for bucket in 0..buckets {
            let links = links(contents, cell, bucket, linked, &mut place, &mut pages)?;
            for &link in &links {
                check_depth(contents, cell, bucket, link)?;
                if config.storage == Storage::Sb && !config.inline {
                    let place = contents.payload_place(link);
                    match named.get_mut(place as usize) {
                        Some(named) if !*named => *named = true,
                        _ => return Err(Fault::Payload { cell, link, place }),
                    }
                }
            }
            let key = |link| (contents.z(link), contents.payload(link)[0]);
            // A paged list is sorted within each page only.
            let together = |pair: &[u32]| {
                config.storage != Storage::Paged || (pair[0] - 1) / config.page == (pair[1] - 1) / config.page
            };
            let disordered = |pair: &[u32]| sorted && together(pair) && key(pair[0]) > key(pair[1]);
            if let Some(pair) = links.windows(2).find(|pair| disordered(pair)) {
                return Err(Fault::Order { cell, bucket, link: pair[1] });
            }
            linked += links.len();
        }
        let (triangles, slices_of) = contents.conservative_nodes_of(cell)?;
        in_conservative += triangles.len() + slices_of;
        slices += slices_of;
    }
    // Fragments in pages beyond the capacity cannot be found in lists.
    let expected = match config.storage {
        Storage::Paged if contents.complete() => contents.header.fragments as usize,
        Storage::Paged => linked,
        _ => stored,
    };
    if linked != expected {
        return Err(Fault::Count { stored: expected, linked });
    }
    let header = &contents.header;
    let [demand, room, wanted] =
        [header.conservative_demand, header.conservative_capacity, header.conservative_slices]
            .map(|count| count as usize);
    let (fits, is_linked) = (demand <= room, in_conservative == demand.min(room));
    // Slices that do not fit leave their places empty.
    if if fits { is_linked && slices == wanted } else { is_linked || slices < wanted } {
        Ok(())
    } else {
        Err(Fault::Count { stored: demand.min(room), linked: in_conservative })
    }
}

/// Returns the links of a list. The lists before this one contain `linked` nodes and the pages marked in
/// `pages`; a contiguous list begins at `place`.
fn links(
    contents: &Contents,
    cell: usize,
    bucket: usize,
    linked: usize,
    place: &mut usize,
    pages: &mut [bool],
) -> Result<Vec<u32>, Fault> {
    match contents.config.storage {
        Storage::Sb => contiguous(contents, cell, place),
        Storage::Paged => turn_pages(contents, cell, bucket, pages),
        _ => follow(contents, cell, bucket, linked),
    }
}

/// Returns the links of a paged list, as far as the pool has stored its pages.
fn turn_pages(
    contents: &Contents,
    cell: usize,
    bucket: usize,
    pages: &mut [bool],
) -> Result<Vec<u32>, Fault> {
    let slots = contents.slots();
    let mut links = Vec::new();
    let mut word = contents.lists[cell * contents.config.lists() as usize + bucket];
    while word != 0 {
        let (page, used) = ((word >> 4) as usize, (word & 15) as usize);
        let Some(page) = page.checked_sub(1).filter(|page| *page < pages.len()) else {
            if contents.complete() {
                return Err(Fault::Dangling { cell, bucket, link: word });
            }
            return Ok(links);
        };
        let first = page * slots + 1;
        let unused = (first..first + slots).take_while(|link| contents.z(*link as u32) == 0.0).count();
        if std::mem::replace(&mut pages[page], true) || used == 0 || used + unused != slots {
            return Err(Fault::Page { cell, bucket, page });
        }
        links.extend((first + unused..first + slots).map(|link| link as u32));
        word = contents.next_page(page);
    }
    Ok(links)
}

/// Returns the links of a contiguous list, as far as the pool has stored them; the list should begin at
/// `place`.
fn contiguous(contents: &Contents, cell: usize, place: &mut usize) -> Result<Vec<u32>, Fault> {
    let lists = contents.lists.len() / 2;
    let (first, count) = (contents.lists[cell], contents.lists[lists + cell] as usize);
    if first as usize != *place {
        return Err(Fault::Place { cell, first, expected: *place });
    }
    *place = place.saturating_add(count);
    if *place > contents.header.demand as usize {
        return Err(Fault::Dangling {
            cell,
            bucket: 0,
            link: place.saturating_add(1).min(u32::MAX as usize) as u32,
        });
    }
    let stored = contents.stored();
    Ok(((first as usize).min(stored)..(*place).min(stored)).map(|place| place as u32 + 1).collect())
}

/// Returns the links of a linked list in order; the lists before this one contain `linked` nodes.
fn follow(contents: &Contents, cell: usize, bucket: usize, linked: usize) -> Result<Vec<u32>, Fault> {
    let doubly = contents.config.storage.is_doubly_linked();
    let list = cell * contents.config.lists() as usize + bucket;
    let stored = contents.stored();
    let mut links = Vec::new();
    let (mut link, mut last) = (contents.head(list), 0);
    while link != 0 {
        if link as usize > stored || linked + links.len() >= stored {
            return Err(Fault::Dangling { cell, bucket, link });
        }
        let found = contents.links(link);
        if doubly && found[1] != last {
            return Err(Fault::Backward { cell, bucket, link, prev: found[1], expected: last });
        }
        links.push(link);
        last = link;
        link = found[0];
    }
    if doubly && contents.lists[2 * list + 1] != last {
        return Err(Fault::Tail { cell, bucket, tail: contents.lists[2 * list + 1], last });
    }
    Ok(links)
}

/// Checks that a depth lies within the cell's bounds. A cell without stored ends has no bounds, and any
/// positive number is a valid depth.
fn check_depth(contents: &Contents, cell: usize, bucket: usize, link: u32) -> Result<(), Fault> {
    let (mut z_min, mut z_max) = (0.0, f32::MAX);
    if contents.config.has_ends() {
        let word = cell * bounds_words(&contents.config) as usize;
        z_min = f32::from_bits(!contents.bounds[word]);
        z_max = f32::from_bits(contents.bounds[word + 1]);
    }
    let z = contents.z(link);
    if z > 0.0 && z >= z_min && z <= z_max {
        return Ok(());
    }
    let [z, z_min, z_max] = [z, z_min, z_max].map(|depth| depth.to_string());
    Err(Fault::Depth { cell, bucket, link, z, z_min, z_max })
}
