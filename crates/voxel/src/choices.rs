//! Enums of the options, and the number of each choice in shaders.

use rasray_ads::words;
use rasray_shaders_glsl::constants::voxel as numbers;

/// Rule for the view that keeps a fragment, and for the axes along which a voxel is searched.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Axes {
    /// All views keep all fragments. A voxel is searched along the axis of its averaged normal.
    All,
    /// A view keeps the fragments in voxels whose averaged normal has the view's axis.
    Voxel,
    /// A view keeps the triangles that face it most. A voxel is searched along the axes of all its triangles.
    Triangle,
}

words! { Axes { All "all", Voxel "voxel", Triangle "triangle" } }

impl Axes {
    pub(crate) fn number(self) -> u32 {
        match self {
            Self::All => numbers::VOXEL_AXES_ALL,
            Self::Voxel => numbers::VOXEL_AXES_VOXEL,
            Self::Triangle => numbers::VOXEL_AXES_TRIANGLE,
        }
    }
}

/// Test of a voxel for occupancy.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Marking {
    /// A voxel is occupied only by fragments in it, which the pass that counts or stores fragments marks. A
    /// voxel that a triangle reaches into only between the centres of cells counts as empty. Needs
    /// [`Axes::All`].
    Fragments,
    /// A voxel is occupied by the triangles that reach into it, which a separate pass marks before fragments
    /// are stored. No voxel with a part of a triangle counts as empty.
    Triangles,
}

words! { Marking { Fragments "fragments", Triangles "triangles" } }

impl Marking {
    pub(crate) fn number(self) -> u32 {
        match self {
            Self::Fragments => numbers::VOXEL_MARKED_BY_FRAGMENTS,
            Self::Triangles => numbers::VOXEL_MARKED_BY_TRIANGLES,
        }
    }
}

/// Object that a ray hits in an occupied voxel.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Leaves {
    /// Fragments of the voxel, which the views keep.
    Fragments,
    /// The voxel itself, at the point where the ray enters it; the triangle with the lowest id in the voxel
    /// stands for it. There are no views and no fragments. Needs [`Axes::Triangle`] and [`Payload::Index`].
    Voxels,
}

words! { Leaves { Fragments "fragments", Voxels "voxels" } }

impl Leaves {
    pub(crate) fn number(self) -> u32 {
        match self {
            Self::Fragments => numbers::VOXEL_LEAVES_FRAGMENTS,
            Self::Voxels => numbers::VOXEL_LEAVES_VOXELS,
        }
    }
}

/// Method of stepping a ray from voxel to voxel. Changes no hit.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Traversal {
    /// Steps from one voxel to the next.
    Dda,
    /// Steps from one voxel to the next, and over the empty nodes of a sparse octree that is built from the
    /// voxels.
    Octree,
}

words! { Traversal { Dda "dda", Octree "octree" } }

impl Traversal {
    pub(crate) fn number(self) -> u32 {
        match self {
            Self::Dda => numbers::VOXEL_TRAVERSAL_DDA,
            Self::Octree => numbers::VOXEL_TRAVERSAL_OCTREE,
        }
    }
}

/// Method of stepping a ray within a voxel.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum March {
    /// Takes [`Config::samples`](crate::Config::samples) steps of equal length.
    Samples,
    /// Steps through every cell that the ray crosses.
    Exact,
}

words! { March { Samples "samples", Exact "exact" } }

impl March {
    pub(crate) fn number(self) -> u32 {
        match self {
            Self::Samples => numbers::VOXEL_MARCH_SAMPLES,
            Self::Exact => numbers::VOXEL_MARCH_EXACT,
        }
    }
}

/// Condition under which a ray hits a fragment.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Accept {
    /// The hit lies between two points of the ray, one with an even and one with an odd number of fragments
    /// before it in its cell.
    Parity,
    /// The ray intersects the plane of the fragment's triangle within the cell. Needs [`March::Exact`].
    Plane,
}

words! { Accept { Parity "parity", Plane "plane" } }

impl Accept {
    pub(crate) fn number(self) -> u32 {
        match self {
            Self::Parity => numbers::VOXEL_ACCEPT_PARITY,
            Self::Plane => numbers::VOXEL_ACCEPT_PLANE,
        }
    }
}

/// Fragments that decide whether a point is inside. Needs [`Accept::Parity`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Inside {
    /// All fragments that lie before the point in its cell. Closed objects that end before the voxel
    /// contribute an even number.
    Column,
    /// Fragments before the point at the depths of its voxel only. Objects need not be closed, since
    /// fragments of other voxels change no parity.
    Voxel,
}

words! { Inside { Column "column", Voxel "voxel" } }

impl Inside {
    pub(crate) fn number(self) -> u32 {
        match self {
            Self::Column => numbers::VOXEL_INSIDE_COLUMN,
            Self::Voxel => numbers::VOXEL_INSIDE_VOXEL,
        }
    }
}

/// Cells that keep a triangle.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Coverage {
    /// Cells whose centre the rasterizer covers, with its sub-pixel grid.
    Hardware,
    /// Cells whose centre the triangle covers by a watertight test; the rasterizer only proposes cells.
    Exact,
    /// All cells that the triangle reaches into. Hits are those of the triangles, and none is lost. Needs
    /// [`Axes::Triangle`] and [`Accept::Plane`].
    Conservative,
}

words! { Coverage { Hardware "hardware", Exact "exact", Conservative "conservative" } }

impl Coverage {
    pub(crate) fn number(self) -> u32 {
        match self {
            Self::Hardware => numbers::VOXEL_COVERAGE_HARDWARE,
            Self::Exact => numbers::VOXEL_COVERAGE_EXACT,
            Self::Conservative => numbers::VOXEL_COVERAGE_CONSERVATIVE,
        }
    }
}

/// Storage of the lists of cells. Changes no hit.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Storage {
    /// Contiguous fragments, counted before they are stored. Sorted lists of this kind can be bisected.
    Contiguous,
    /// Linked fragments, each with a link to the one before it in its list, stored in one pass.
    Linked,
    /// Linked pages of [`Config::page`](crate::Config::page) fragments, stored in one pass.
    Paged,
}

words! { Storage { Contiguous "sb", Linked "ll", Paged "paged" } }

impl Storage {
    pub(crate) fn number(self) -> u32 {
        match self {
            Self::Contiguous => numbers::VOXEL_STORAGE_CONTIGUOUS,
            Self::Linked => numbers::VOXEL_STORAGE_LINKED,
            Self::Paged => numbers::VOXEL_STORAGE_PAGED,
        }
    }
}

/// Data that a fragment carries in addition to its depth.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Payload {
    /// Triangle id, 4 bytes. Surfaces come from the posed triangle.
    Index,
    /// Payload of Hu et al.: colour and opacity, normal, and terms of the material; 12 bytes, read from a
    /// scene. Hits do not name their triangle, and rays cannot exclude it. Needs [`Accept::Parity`], as does
    /// [`Payload::Mirror`].
    Material,
    /// Payload of the selective variant: colour and reflectivity, normal, and triangle; 12 bytes, read from a
    /// scene.
    Mirror,
}

impl Payload {
    pub(crate) fn number(self) -> u32 {
        match self {
            Self::Index => numbers::VOXEL_PAYLOAD_INDEX,
            Self::Material => numbers::VOXEL_PAYLOAD_MATERIAL,
            Self::Mirror => numbers::VOXEL_PAYLOAD_MIRROR,
        }
    }
}
