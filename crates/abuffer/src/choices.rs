//! Enums of the options, and the number of each choice in shaders.

use rasray_ads::words;
use rasray_shaders_glsl::constants::abuffer as numbers;

/// Method of stepping a ray through cells.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum March {
    /// Steps of equal length on the screen, at most [`Config::samples`](crate::Config::samples) per face.
    /// Rays do not visit the cells between two steps.
    Samples,
    /// Enough steps that each spans one cell along the longer axis: the paper's march without its limit of
    /// samples.
    Dda,
    /// Steps through every cell that the ray crosses.
    Exact,
    /// Steps through cells as [`March::Exact`], which skip blocks of cells that hold nothing at the ray's
    /// depths. Hits are those of [`March::Exact`].
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

/// Condition under which a ray hits a fragment.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Accept {
    /// The fragment's depth lies in the ray's half-open depth interval within the cell.
    Interval,
    /// The condition of [`Accept::Interval`], with each fragment extended away from the eye by
    /// [`Config::thickness`](crate::Config::thickness).
    Thickness,
    /// The depths that the fragment's triangle takes within the cell overlap those of the ray. Needs
    /// [`Payload::Index`].
    Slope,
    /// The ray intersects the plane of the fragment's triangle within the cell. Needs [`Payload::Index`] or
    /// [`Payload::Plane`].
    Plane,
}

words! { Accept { Interval "interval", Thickness "thickness", Slope "slope", Plane "plane" } }

impl Accept {
    /// Returns true if the test reads more of the fragment's triangle than its depth. Cells then store how
    /// far triangles reach in depth.
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
    /// Triangle id, 4 bytes. Plane and surface come from the posed triangle.
    Index,
    /// Quantised attributes for path tracing, as in the paper, 16 bytes. Needs a scene.
    Attributes,
    /// Quantised shading normal alone, the paper's payload for ambient occlusion, 4 bytes. Needs a scene.
    Normal,
    /// Plane of the triangle in full, 16 bytes. Rays intersect it without reading the triangle, and know
    /// nothing else of the triangle.
    Plane,
}

words! { Payload { Index "index", Attributes "attributes", Normal "normal", Plane "plane" } }

impl Payload {
    /// Returns true if the build reads the payload from a scene while it stores fragments.
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

/// Test that decides which cells a triangle covers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Coverage {
    /// Coverage of the rasterizer, with its sub-pixel grid.
    Hardware,
    /// Watertight test of the cell's centre against the triangle; the rasterizer only proposes cells.
    Exact,
    /// Test of [`Coverage::Exact`]. A triangle that reaches into a cell without covering its centre is kept
    /// in the cell's conservative list: edge-on triangles, silhouettes, and triangles smaller than a cell.
    /// Rays then test triangles, not their planes, and find the hits of brute force
    /// ([`Config::is_exact`](crate::Config::is_exact)). Needs [`Accept::Plane`].
    Conservative,
    /// Test of [`Coverage::Exact`]. A triangle that reaches into a cell without covering its centre is kept
    /// only if it has no fragment in any view, or if its plane is seen edge-on there: the open limitation
    /// that the paper mentions. Rays intersect the planes of fragments, and the triangles of conservative
    /// lists. Needs [`Accept::Plane`].
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

/// Source of the depth bounds that a cell has before its fragments are stored. Changes no hit.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Bounds {
    /// Fragments that the cell will have: the build draws all triangles once more.
    Geometry,
    /// Boxes around objects that cover the cell. These bounds are looser, and the build draws a box in place
    /// of the triangles in it. An object is a draw of the geometry; if there are more than 4096 draws,
    /// several in a row share a box.
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

/// Views that the build draws.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Views {
    /// Six faces of a cube around the eye, which see everything around it.
    Cube,
    /// Faces of the cube, and the camera's view with
    /// [`Config::camera_resolution`](crate::Config::camera_resolution) columns and rows.
    CubeCamera,
    /// Camera's view alone: rays hit nothing outside of its pyramid.
    Camera,
}

words! { Views { Cube "cube", CubeCamera "cube+camera", Camera "camera" } }

impl Views {
    /// Returns true if the views include the faces of the cube.
    pub fn has_cube(self) -> bool {
        self != Self::Camera
    }

    /// Returns true if the views include the camera's view.
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
    /// Passes at the sides of the views' pyramids, so that no part of a ray is left out. Every view that sees
    /// a part of the ray is searched over that part.
    Exact,
    /// Passes as in the paper: each part of a ray is searched in one view at most. A view ends half a cell
    /// before its side, and the ray continues half a cell behind that side, in the face that contains it
    /// there. The camera's view is searched only from the start of a ray that it sees.
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
    /// Linked list per cell, read from its near end.
    Ll,
    /// Doubly linked list per cell, read from either end.
    Dll,
    /// Linked list per depth bucket.
    Llb,
    /// Doubly linked list per depth bucket: the paper's own storage.
    Dllb,
    /// Contiguous list per cell, counted before it is stored (S-buffer). Sorted lists are searched by
    /// bisection.
    Sb,
    /// Linked list of pages per depth bucket; a page holds [`Config::page`](crate::Config::page) fragments.
    Paged,
}

words! { Storage { Ll "ll", Dll "dll", Llb "llb", Dllb "dllb", Sb "sb", Paged "paged" } }

impl Storage {
    /// Returns true if a cell has depth bounds and a list per bucket.
    pub fn is_bucketed(self) -> bool {
        matches!(self, Self::Llb | Self::Dllb | Self::Paged)
    }

    /// Returns true if nodes have links in both directions.
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
