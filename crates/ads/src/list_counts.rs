//! Counts of the lists of a structure's cells, made on the host.

/// Counts of the lists of some cells, such as those of one view.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ListCounts {
    /// Cells: a face of the cube (`+x`), `camera`, the view along an axis (`x`), `voxels` or `grid`.
    pub cells_of: &'static str,
    /// All of them, those of a view's border included.
    pub cells: u64,
    /// Those that hold something.
    pub occupied: u64,
    /// Layers of all these cells together: the fragments or triangles that a cell holds, a triangle once
    /// however many of the cell's buckets it is in.
    pub layers: u64,
    /// Layers of the cell that has most.
    pub most: u64,
    /// Entries in the cells' lists: more than layers where a triangle is in several buckets of a cell.
    pub entries: u64,
    /// Slots that were taken for them: more than entries where lists grow by pages.
    pub slots: u64,
    /// Bytes of a slot, with the payload of what it holds; links and what leads to a list are not among them.
    pub slot_bytes: u64,
}

impl ListCounts {
    /// The names of a cube's faces, in the order of views.
    pub const FACES: [&'static str; 6] = ["+x", "-x", "+y", "-y", "+z", "-z"];

    /// The names of the views along the axes, in their order.
    pub const AXES: [&'static str; 3] = ["x", "y", "z"];

    /// The name of a grid of voxels over those views: their fragments once more, by the voxel in which they
    /// lie.
    pub const VOXELS: &'static str = "voxels";

    /// Counts of no cells yet.
    pub fn new(cells_of: &'static str, slot_bytes: u64) -> Self {
        Self { cells_of, cells: 0, occupied: 0, layers: 0, most: 0, entries: 0, slots: 0, slot_bytes }
    }

    /// Counts one more cell, with its layers, entries and slots.
    pub fn add_cell(&mut self, layers: usize, entries: usize, slots: usize) {
        let layers = layers as u64;
        self.cells += 1;
        self.occupied += u64::from(layers > 0);
        self.layers += layers;
        self.most = self.most.max(layers);
        self.entries += entries as u64;
        self.slots += slots as u64;
    }

    /// All views together, named `all`; absent where there are none.
    pub fn all(counts: &[Self]) -> Option<Self> {
        let mut sum: Option<Self> = None;
        for count in counts.iter().filter(|count| counts.len() == 1 || count.cells_of != Self::VOXELS) {
            sum.get_or_insert_with(|| Self::new("all", count.slot_bytes)).add(count);
        }
        sum
    }

    /// Counts the cells of another part of a structure as well.
    pub fn add(&mut self, other: &Self) {
        self.cells += other.cells;
        self.occupied += other.occupied;
        self.layers += other.layers;
        self.most = self.most.max(other.most);
        self.entries += other.entries;
        self.slots += other.slots;
    }
}
