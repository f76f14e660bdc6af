//! The part of a frame that a pass belongs to.

use std::fmt;

/// Question that a trace answers.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum TraceMode {
    /// The nearest hit.
    Closest,
    /// The presence of any hit.
    Occluded,
}

/// The part of a frame that a pass belongs to, in the order of a frame: what times are summed by.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Stage {
    /// Instances to posed positions, with bounds and lights.
    Pose,
    /// Posed positions to a structure that can be traced.
    Build,
    /// Posed positions and lights to maps of what lights see.
    ShadowMaps,
    /// First hits and their surfaces, by drawing.
    Visible,
    /// Rays to hits.
    Trace(TraceMode),
    /// Hits to surfaces.
    Surfaces,
    /// Surfaces to radiance and to further rays, camera rays included.
    Shade,
    /// Radiance to pixels, by passes that do nothing else.
    Film,
}

impl Stage {
    /// All of them.
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

    /// Its name in reports.
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
