//! Statistics of the lists of a structure's cells, counted on the host.

/// Statistics of the lists of a group of cells, such as those of one view.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ListCounts {
    /// Name of the group of cells: a face of the cube (`+x`), `camera`, the view along an axis (`x`),
    /// `voxels` or `grid`.
    pub cells_of: &'static str,
    /// Number of cells, including those of a view's border.
    pub cells: u64,
    /// Number of cells that hold a fragment or triangle.
    pub occupied: u64,
    /// Sum of the layers of all these cells: the number of fragments or triangles in a cell. A triangle
    /// counts once per cell, in however many of the cell's buckets it is.
    pub layers: u64,
    /// Number of layers of the cell that has most.
    pub most: u64,
    /// Number of entries in the cells' lists; larger than `layers` if a triangle is in several buckets of a
    /// cell.
    pub entries: u64,
    /// Number of slots taken for the entries; larger than `entries` if lists grow by pages.
    pub slots: u64,
    /// Bytes of a slot, including the payload of its entry. Links between slots and references to lists are
    /// not included.
    pub slot_bytes: u64,
}

impl ListCounts {
    /// Names of a cube's faces, in the order of views.
    pub const FACES: [&'static str; 6] = ["+x", "-x", "+y", "-y", "+z", "-z"];

    /// Names of the views along the axes, in the order of views.
    pub const AXES: [&'static str; 3] = ["x", "y", "z"];

    /// Name of a grid of voxels over the views along the axes: it holds the fragments of these views once
    /// more, sorted by voxel.
    pub const VOXELS: &'static str = "voxels";

    /// Makes the statistics of a group without cells.
    pub fn new(cells_of: &'static str, slot_bytes: u64) -> Self {
        Self { cells_of, cells: 0, occupied: 0, layers: 0, most: 0, entries: 0, slots: 0, slot_bytes }
    }

    /// Adds one cell with its numbers of layers, entries and slots.
    pub fn add_cell(&mut self, layers: usize, entries: usize, slots: usize) {
        let layers = layers as u64;
        self.cells += 1;
        self.occupied += u64::from(layers > 0);
        self.layers += layers;
        self.most = self.most.max(layers);
        self.entries += entries as u64;
        self.slots += slots as u64;
    }

    /// Returns the sum over all views, named `all`; absent if there are no views.
    pub fn all(counts: &[Self]) -> Option<Self> {
        let mut sum: Option<Self> = None;
        for count in counts.iter().filter(|count| counts.len() == 1 || count.cells_of != Self::VOXELS) {
            sum.get_or_insert_with(|| Self::new("all", count.slot_bytes)).add(count);
        }
        sum
    }

    /// Adds the cells of another part of a structure.
    pub fn add(&mut self, other: &Self) {
        self.cells += other.cells;
        self.occupied += other.occupied;
        self.layers += other.layers;
        self.most = self.most.max(other.most);
        self.entries += other.entries;
        self.slots += other.slots;
    }
}
