//! What is done with a scene.

/// What is done with the hits of rays.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Integrator {
    /// Emission and base colour of what camera rays hit, lit from the eye.
    Raycast,
    /// Visibility of a white environment; sees no material but alpha masks.
    AmbientOcclusion,
    /// Direct light, perfect reflection and refraction.
    Whitted,
    /// All paths of light.
    Path,
}

/// An integrator and how far it follows light.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Workload {
    /// The integrator.
    pub integrator: Integrator,
    /// Scatterings of a path at most: 0 is emission alone, 1 direct light. Only Whitted and path
    /// tracing look at it.
    pub bounces: u32,
}

impl Workload {
    /// Whether light is scattered by materials.
    pub(crate) fn scatters(self) -> bool {
        matches!(self.integrator, Integrator::Whitted | Integrator::Path) && self.bounces > 0
    }

    /// Whether base colours are shown, lit in whatever way.
    pub(crate) fn shades(self) -> bool {
        self.integrator == Integrator::Raycast || self.scatters()
    }
}
