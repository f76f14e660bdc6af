//! Facts about a structure.

use rasray_gpu::Requirements;

use crate::{Counters, Viewpoint};

/// Meaning of a structure's hits, and hence what may be demanded of them.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum StructureKind {
    /// Triangles: no missed, false or wrong hit on unambiguous rays.
    Primitive,
    /// Triangles, by the rules of a paper that lose some of them: a share of the hits that does not fall with
    /// the resolution.
    LossyPrimitive,
    /// Stored fragments: errors follow a law in the resolution.
    Fragment,
}

impl StructureKind {
    /// Returns true where hits are on triangles, with barycentrics, and not on stored fragments.
    pub fn finds_triangles(self) -> bool {
        self != Self::Fragment
    }
}

/// Changes that make a build stale, in addition to those of the triangles, which always do. Where none of
/// them happened, a new build would be the same as the last.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Dependencies {
    /// The eye moved.
    pub eye: bool,
    /// The camera sees something else.
    pub camera: bool,
}

impl Dependencies {
    /// Returns true if a build for `built` differs from one for `wanted`.
    pub fn are_stale(self, built: Viewpoint, wanted: Viewpoint) -> bool {
        (self.eye && built.eye != wanted.eye) || (self.camera && built.camera != wanted.camera)
    }
}

/// Facts about a structure that do not change while it lives
/// ([`Structure::description`](crate::Structure::description)).
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Description {
    /// Name in shaders, pages and reports.
    pub name: &'static str,
    /// Kind of its hits.
    pub kind: StructureKind,
    /// Device features that it uses.
    pub requirements: Requirements,
    /// Amount of work that its rays record.
    pub counters: Counters,
    /// Changes of the viewpoint that make a build stale
    /// ([`Structure::is_stale`](crate::Structure::is_stale)).
    pub depends_on: Dependencies,
    /// True where the surface of every hit is that of its triangle at its barycentrics (`scene_surface`),
    /// which needs nothing of the structure: kernels that shade may look it up in place of
    /// [`Structure::record_surfaces`](crate::Structure::record_surfaces). False without a scene.
    pub surfaces_of_triangles: bool,
    /// True where [`Structure::prepare_build`](crate::Structure::prepare_build) works on the triangles, so
    /// that these must be where they are to be built before it is called.
    pub builds_on_host: bool,
    /// True where a build stays while its triangles are moved by a map
    /// ([`Geometry::record_map`](crate::Geometry::record_map)), because it is in a space of its own.
    pub follows: bool,
    /// True where it has first hits of camera rays
    /// ([`Structure::record_first_hits`](crate::Structure::record_first_hits)).
    pub first_hits: bool,
}
