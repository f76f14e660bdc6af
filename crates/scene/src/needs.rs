//! What of a scene a render can observe; the rest need not be uploaded, stored, compiled in or traced.
//!
//! Two things decide whether a [`Term`] is needed: the scene must have it where a ray can hit it,
//! and the integrator must look at it. Every verdict comes with a sentence that says why.
//!
//! Positions, indices and the table of draws are always needed and have no term.

mod moving;
mod reads;
mod survey;

pub use moving::moving_instances;

use crate::Scene;

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

/// A part of scenes that may or may not be needed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Term {
    /// Shading normals of vertices.
    Normals,
    /// Tangents of vertices.
    Tangents,
    /// Texture coordinates of set 0.
    Uv0,
    /// Texture coordinates of set 1.
    Uv1,
    /// Colours of vertices.
    Colors,
    /// Base colour textures, as colour. Those of alpha masks come with [`Term::AlphaMask`].
    BaseColorTextures,
    /// Metallic-roughness textures.
    MetallicRoughnessTextures,
    /// Normal maps.
    NormalTextures,
    /// Emission textures.
    EmissionTextures,
    /// Transmission textures.
    TransmissionTextures,
    /// Surfaces that show light of their own.
    Emission,
    /// Specular reflection, of metals and of dielectrics.
    Specular,
    /// Light that passes through surfaces.
    Transmission,
    /// Absorption inside of bodies.
    Volume,
    /// Alpha tested against a cutoff.
    AlphaMask,
    /// Partial opacity.
    AlphaBlend,
    /// Point lights.
    PointLights,
    /// Directional lights.
    DirectionalLights,
    /// Spot lights.
    SpotLights,
    /// Emissive triangles as lights to sample.
    AreaLights,
    /// Radiance from outside.
    Environment,
    /// Geometry that changes with time.
    Motion,
}

impl Term {
    /// All terms, in the order that reports list them.
    pub const ALL: [Self; 22] = [
        Self::Normals,
        Self::Tangents,
        Self::Uv0,
        Self::Uv1,
        Self::Colors,
        Self::BaseColorTextures,
        Self::MetallicRoughnessTextures,
        Self::NormalTextures,
        Self::EmissionTextures,
        Self::TransmissionTextures,
        Self::Emission,
        Self::Specular,
        Self::Transmission,
        Self::Volume,
        Self::AlphaMask,
        Self::AlphaBlend,
        Self::PointLights,
        Self::DirectionalLights,
        Self::SpotLights,
        Self::AreaLights,
        Self::Environment,
        Self::Motion,
    ];

    /// The term as reports write it.
    pub fn name(self) -> &'static str {
        match self {
            Self::Normals => "shading normals",
            Self::Tangents => "tangents",
            Self::Uv0 => "texture coordinates 0",
            Self::Uv1 => "texture coordinates 1",
            Self::Colors => "vertex colours",
            Self::BaseColorTextures => "base colour textures",
            Self::MetallicRoughnessTextures => "metallic-roughness textures",
            Self::NormalTextures => "normal maps",
            Self::EmissionTextures => "emission textures",
            Self::TransmissionTextures => "transmission textures",
            Self::Emission => "emission",
            Self::Specular => "specular reflection",
            Self::Transmission => "transmission",
            Self::Volume => "volumes",
            Self::AlphaMask => "alpha masks",
            Self::AlphaBlend => "alpha blending",
            Self::PointLights => "point lights",
            Self::DirectionalLights => "directional lights",
            Self::SpotLights => "spot lights",
            Self::AreaLights => "area lights",
            Self::Environment => "environment",
            Self::Motion => "motion",
        }
    }
}

/// Whether a term is needed, and why.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Verdict {
    /// What the verdict is on.
    pub term: Term,
    /// Whether the render can observe it.
    pub needed: bool,
    /// One sentence, without a full stop.
    pub why: String,
}

/// The verdicts on all terms for a scene and a workload.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Needs {
    verdicts: Vec<Verdict>,
}

impl Needs {
    /// What `workload` can observe of `scene`.
    pub fn of(scene: &Scene, workload: Workload) -> Self {
        let survey = survey::Survey::of(scene, workload);
        let verdicts = Term::ALL
            .into_iter()
            .map(|term| {
                let unseen = survey::unseen(term, workload).map(str::to_owned);
                let found = survey.found(term);
                let needed = unseen.is_none() && found.count > 0;
                Verdict { term, needed, why: unseen.unwrap_or_else(|| found.sentence(term)) }
            })
            .collect();
        Self { verdicts }
    }

    /// Everything, whatever the scene has: to show that leaving out what is not needed changes nothing.
    pub fn all() -> Self {
        let verdict = |term| Verdict { term, needed: true, why: "everything was asked for".to_owned() };
        Self { verdicts: Term::ALL.into_iter().map(verdict).collect() }
    }

    /// Whether a term is needed.
    pub fn requires(&self, term: Term) -> bool {
        self.verdicts.iter().any(|verdict| verdict.term == term && verdict.needed)
    }

    /// All verdicts in the order of [`Term::ALL`].
    pub fn verdicts(&self) -> &[Verdict] {
        &self.verdicts
    }
}
