//! Facts about a structure.

use rasray_gpu::Requirements;

use crate::{Counters, Viewpoint};

/// Meaning of a structure's hits, which determines the demands that tests make on them.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum StructureKind {
    /// Hits are on triangles: no missed, false or wrong hit on unambiguous rays.
    Primitive,
    /// Hits are on triangles, by the rules of a paper that lose some of them: the share of lost hits does not
    /// fall with the resolution.
    LossyPrimitive,
    /// Hits are on stored fragments: their errors follow a law in the resolution.
    Fragment,
}

impl StructureKind {
    /// Returns true if hits are on triangles, with barycentrics, and not on stored fragments.
    pub fn finds_triangles(self) -> bool {
        self != Self::Fragment
    }
}

/// Changes of the viewpoint that make a build stale, in addition to changes of the triangles, which always
/// do. If none of them happened, a new build would equal the last one.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Dependencies {
    /// The eye moved.
    pub eye: bool,
    /// The camera's view changed.
    pub camera: bool,
}

impl Dependencies {
    /// Returns true if a build for `built` differs from one for `wanted`.
    pub fn are_stale(self, built: Viewpoint, wanted: Viewpoint) -> bool {
        (self.eye && built.eye != wanted.eye) || (self.camera && built.camera != wanted.camera)
    }
}

/// Facts about a structure
/// ([`Structure::description`](crate::Structure::description)).
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Description {
    /// Name in shaders, pages and reports.
    pub name: &'static str,
    /// Kind of the structure's hits.
    pub kind: StructureKind,
    /// Device features that the structure uses.
    pub requirements: Requirements,
    /// Amount of their work that rays record; the only fact that can be changed
    /// ([`Structure::set_counters`](crate::Structure::set_counters)).
    pub counters: Counters,
    /// Changes of the viewpoint that make a build stale
    /// ([`Structure::is_stale`](crate::Structure::is_stale)).
    pub depends_on: Dependencies,
    /// True if the surface of every hit is that of its triangle at its barycentrics (`scene_surface`), which
    /// needs no data of the structure: kernels that shade may look it up in place of
    /// [`Structure::record_surfaces`](crate::Structure::record_surfaces). False without a scene.
    pub surfaces_of_triangles: bool,
    /// True if [`Structure::prepare_build`](crate::Structure::prepare_build) reads the triangles. The
    /// vertices must then already be at the positions to be built when it is called.
    pub builds_on_host: bool,
    /// True if a build stays valid while a map moves its triangles
    /// ([`Geometry::record_map`](crate::Geometry::record_map)), because the build is in a space of its own.
    pub follows: bool,
    /// True if the structure has first hits of camera rays
    /// ([`Structure::record_first_hits`](crate::Structure::record_first_hits)).
    pub first_hits: bool,
}
