//! Properties of hits that a workload looks at.

/// Properties of hits that are looked at. Alpha masks, motion, and what these read are looked at by all.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Workload {
    /// Light that surfaces and the environment emit is seen.
    pub emission: bool,
    /// Base colours and shading normals are shown, lit in whatever way.
    pub shades: bool,
    /// Materials scatter light, and lights are sampled.
    pub scatters: bool,
    /// Rays go on through surfaces of partial opacity.
    pub blends: bool,
    /// Why nothing else is looked at: one sentence without a full stop.
    pub why: &'static str,
}

impl Workload {
    /// Only what is visible: no material is looked at.
    pub const VISIBILITY: Self = Self {
        emission: false,
        shades: false,
        scatters: false,
        blends: false,
        why: "only visibility is asked for",
    };

    /// Everything that light does.
    pub const ALL: Self =
        Self { emission: true, shades: true, scatters: true, blends: true, why: "it is not looked at" };

    /// True if only visibility is asked for.
    pub fn is_visibility(self) -> bool {
        !(self.emission || self.shades || self.scatters || self.blends)
    }
}
