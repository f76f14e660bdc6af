//! Properties of hits that a workload observes.

/// Properties of hits that a workload observes. All workloads observe alpha masks, motion, and the terms that
/// these read.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Workload {
    /// True if light that surfaces and the environment emit is seen.
    pub emission: bool,
    /// True if base colours and shading normals are shown, however they are lit.
    pub shades: bool,
    /// True if materials scatter light, and lights are sampled.
    pub scatters: bool,
    /// True if rays go on through surfaces of partial opacity.
    pub blends: bool,
    /// Reason why other properties are not observed: one sentence without a full stop.
    pub why: &'static str,
}

impl Workload {
    /// Workload of visibility alone: no material is observed.
    pub const VISIBILITY: Self = Self {
        emission: false,
        shades: false,
        scatters: false,
        blends: false,
        why: "only visibility is asked for",
    };

    /// Workload of full light transport.
    pub const ALL: Self =
        Self { emission: true, shades: true, scatters: true, blends: true, why: "it is not looked at" };

    /// True if the workload observes visibility alone.
    pub fn is_visibility(self) -> bool {
        !(self.emission || self.shades || self.scatters || self.blends)
    }
}
