//! Values that options choose between, and their numbers in shaders.

use rasray_ads::words;
use rasray_shaders_glsl::constants::abuffer as numbers;

/// Method of stepping a ray through cells.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum March {
    /// Steps of equal length on the screen, at most [`Config::samples`](crate::Config::samples) per face.
    /// Cells between are not visited.
    Samples,
    /// As many steps as keep each to a cell of the longer axis, as the paper's march without its limit.
    Dda,
    /// Every cell the ray crosses.
    Exact,
    /// The hits of [`March::Exact`] with skips over blocks of cells that hold nothing at the ray's depths.
    Pyramid,
}

words! { March { Samples "samples", Dda "dda", Exact "exact", Pyramid "pyramid" } }

impl March {
    pub(crate) fn number(self) -> u32 {
        match self {
            Self::Samples => numbers::ABUFFER_MARCH_SAMPLES,
            Self::Dda => numbers::ABUFFER_MARCH_DDA,
            Self::Exact => numbers::ABUFFER_MARCH_EXACT,
            Self::Pyramid => numbers::ABUFFER_MARCH_PYRAMID,
        }
    }
}

/// When a fragment counts as hit.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Accept {
    /// Its depth lies in the ray's half-open depth interval within the cell.
    Interval,
    /// As [`Accept::Interval`], with each fragment extended away from the eye by
    /// [`Config::thickness`](crate::Config::thickness).
    Thickness,
    /// The depths that its triangle takes within the cell overlap those of the ray. Needs [`Payload::Index`].
    Slope,
    /// The ray intersects the plane of its triangle within the cell. Needs [`Payload::Index`] or
    /// [`Payload::Plane`].
    Plane,
}

words! { Accept { Interval "interval", Thickness "thickness", Slope "slope", Plane "plane" } }

impl Accept {
    /// True if it looks at more of the fragment's triangle than its depth; then cells store how far triangles
    /// reach in depth.
    pub fn needs_triangles(self) -> bool {
        matches!(self, Self::Slope | Self::Plane)
    }

    pub(crate) fn number(self) -> u32 {
        match self {
            Self::Interval => numbers::ABUFFER_ACCEPT_INTERVAL,
            Self::Thickness => numbers::ABUFFER_ACCEPT_THICKNESS,
            Self::Slope => numbers::ABUFFER_ACCEPT_SLOPE,
            Self::Plane => numbers::ABUFFER_ACCEPT_PLANE,
        }
    }
}

/// Data that a fragment carries in addition to its node.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Payload {
    /// The triangle's id, 4 bytes: plane and surface come from the posed triangle.
    Index,
    /// The paper's quantised attributes for path tracing, 16 bytes. Needs a scene.
    Attributes,
    /// The paper's payload for ambient occlusion: the quantised normal that is shaded by, alone, 4 bytes.
    /// Needs a scene.
    Normal,
    /// The triangle's plane in full, 16 bytes: rays intersect it without reading the triangle, and know
    /// nothing else of it.
    Plane,
}

words! { Payload { Index "index", Attributes "attributes", Normal "normal", Plane "plane" } }

impl Payload {
    /// True if it is read from a scene while fragments are stored.
    pub fn needs_scene(self) -> bool {
        matches!(self, Self::Attributes | Self::Normal)
    }

    pub(crate) fn number(self) -> u32 {
        match self {
            Self::Index => numbers::ABUFFER_PAYLOAD_INDEX,
            Self::Attributes => numbers::ABUFFER_PAYLOAD_ATTRIBUTES,
            Self::Normal => numbers::ABUFFER_PAYLOAD_NORMAL,
            Self::Plane => numbers::ABUFFER_PAYLOAD_PLANE,
        }
    }
}

/// Test of which cells a triangle covers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Coverage {
    /// The rasterizer, with its sub-pixel grid.
    Hardware,
    /// A watertight test of the cell's centre against the triangle; the rasterizer only proposes.
    Exact,
    /// As [`Coverage::Exact`], and a triangle that reaches into a cell outside of its centre is kept in the
    /// cell's conservative list: edge-on ones, silhouettes, and what is smaller than a cell. Rays then test
    /// triangles, not their planes, and find what brute force finds
    /// ([`Config::is_exact`](crate::Config::is_exact)). Needs [`Accept::Plane`].
    Conservative,
    /// As [`Coverage::Exact`], and of the triangles that reach into a cell outside of its centre, those are
    /// kept that have no fragment in any view, or whose planes are seen edge-on there: what the paper
    /// mentions as its open limitation. Rays intersect the planes of fragments, and the triangles of
    /// conservative lists. Needs [`Accept::Plane`].
    EdgeOn,
}

words! { Coverage { Hardware "hardware", Exact "exact", Conservative "conservative", EdgeOn "edge-on" } }

impl Coverage {
    pub(crate) fn number(self) -> u32 {
        match self {
            Self::Hardware => numbers::ABUFFER_COVERAGE_HARDWARE,
            Self::Exact => numbers::ABUFFER_COVERAGE_EXACT,
            Self::Conservative => numbers::ABUFFER_COVERAGE_CONSERVATIVE,
            Self::EdgeOn => numbers::ABUFFER_COVERAGE_EDGE_ON,
        }
    }
}

/// Depths that the bounds of a cell enclose before its fragments are stored. Changes no hit.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Bounds {
    /// The fragments that it will have: all triangles are drawn once more.
    Geometry,
    /// The boxes around objects that are over it: looser, and a box is drawn in place of its triangles. An
    /// object is a draw of the geometry; of more than 4096 draws several in a row share a box.
    Boxes,
}

words! { Bounds { Geometry "geometry", Boxes "boxes" } }

impl Bounds {
    pub(crate) fn number(self) -> u32 {
        match self {
            Self::Geometry => numbers::ABUFFER_BOUNDS_GEOMETRY,
            Self::Boxes => numbers::ABUFFER_BOUNDS_BOXES,
        }
    }
}

/// Views that are drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Views {
    /// Six faces of a cube around the eye: all that is around it.
    Cube,
    /// The faces of the cube, and the camera's view with
    /// [`Config::camera_resolution`](crate::Config::camera_resolution) columns and rows.
    CubeCamera,
    /// The camera's view and nothing else: rays hit nothing outside of its pyramid.
    Camera,
}

words! { Views { Cube "cube", CubeCamera "cube+camera", Camera "camera" } }

impl Views {
    /// True if the faces of the cube are among them.
    pub fn has_cube(self) -> bool {
        self != Self::Camera
    }

    /// True if the camera's view is among them.
    pub fn has_camera(self) -> bool {
        self != Self::Cube
    }

    pub(crate) fn number(self) -> u32 {
        let cube = if self.has_cube() { numbers::ABUFFER_VIEWS_CUBE } else { 0 };
        cube | if self.has_camera() { numbers::ABUFFER_VIEWS_CAMERA } else { 0 }
    }
}

/// Method by which a ray passes from one view to the next.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ViewSwitching {
    /// At the sides of the views' pyramids, which leave nothing out; every view that sees a part of the ray
    /// is searched over it.
    Exact,
    /// The paper's: each part of a ray is searched in one view at most. A view ends half a cell before its
    /// side, and the ray goes on half a cell behind it, in the face that it is in there. The camera's view is
    /// searched only from the start of a ray that it sees.
    Snap,
}

words! { ViewSwitching { Exact "exact", Snap "snap" } }

impl ViewSwitching {
    pub(crate) fn number(self) -> u32 {
        match self {
            Self::Exact => numbers::ABUFFER_SWITCH_EXACT,
            Self::Snap => numbers::ABUFFER_SWITCH_SNAP,
        }
    }
}

/// Storage of the fragments of a cell (MMRT table 2). Changes no hit.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Storage {
    /// One linked list per cell, read from its near end.
    Ll,
    /// One doubly linked list per cell, read from either end.
    Dll,
    /// A linked list per depth bucket.
    Llb,
    /// A doubly linked list per depth bucket: the paper's own.
    Dllb,
    /// Contiguous, counted first (S-buffer). Sorted lists of a cell are searched by bisection.
    Sb,
    /// A linked list of pages per depth bucket; a page holds [`Config::page`](crate::Config::page) fragments.
    Paged,
}

words! { Storage { Ll "ll", Dll "dll", Llb "llb", Dllb "dllb", Sb "sb", Paged "paged" } }

impl Storage {
    /// True if a cell has depth bounds and a list per bucket.
    pub fn is_bucketed(self) -> bool {
        matches!(self, Self::Llb | Self::Dllb | Self::Paged)
    }

    /// True if nodes link both ways.
    pub fn is_doubly_linked(self) -> bool {
        matches!(self, Self::Dll | Self::Dllb)
    }

    pub(crate) fn number(self) -> u32 {
        match self {
            Self::Ll => numbers::ABUFFER_STORAGE_LL,
            Self::Dll => numbers::ABUFFER_STORAGE_DLL,
            Self::Llb => numbers::ABUFFER_STORAGE_LLB,
            Self::Dllb => numbers::ABUFFER_STORAGE_DLLB,
            Self::Sb => numbers::ABUFFER_STORAGE_SB,
            Self::Paged => numbers::ABUFFER_STORAGE_PAGED,
        }
    }
}
