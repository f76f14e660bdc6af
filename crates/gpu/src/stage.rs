//! Stage of a frame that a pass belongs to.

use std::fmt;

/// Kind of answer of a trace.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum TraceMode {
    /// The nearest hit.
    Closest,
    /// The presence of any hit.
    Occluded,
}

/// Stage of a frame that a pass belongs to, in the order of a frame. Reports sum times by stage.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Stage {
    /// Posing: instances to posed positions, with bounds and lights.
    Pose,
    /// Building: posed positions to a structure that can be traced.
    Build,
    /// Drawing of shadow maps: posed positions and lights to maps of the surfaces that lights see.
    ShadowMaps,
    /// Drawing of first hits and their surfaces.
    Visible,
    /// Tracing: rays to hits.
    Trace(TraceMode),
    /// Lookup of surfaces: hits to surfaces.
    Surfaces,
    /// Shading: surfaces to radiance and to further rays, camera rays included.
    Shade,
    /// Film: radiance to pixels, by passes that do nothing else.
    Film,
}

impl Stage {
    /// All stages, in order.
    pub const ALL: [Self; 9] = [
        Self::Pose,
        Self::Build,
        Self::ShadowMaps,
        Self::Visible,
        Self::Trace(TraceMode::Closest),
        Self::Trace(TraceMode::Occluded),
        Self::Surfaces,
        Self::Shade,
        Self::Film,
    ];

    /// Returns the name of the stage in reports.
    pub fn name(self) -> &'static str {
        match self {
            Self::Pose => "pose",
            Self::Build => "build",
            Self::ShadowMaps => "shadow-maps",
            Self::Visible => "visible",
            Self::Trace(TraceMode::Closest) => "trace-closest",
            Self::Trace(TraceMode::Occluded) => "trace-occluded",
            Self::Surfaces => "surfaces",
            Self::Shade => "shade",
            Self::Film => "film",
        }
    }
}

impl fmt::Display for Stage {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str(self.name())
    }
}
