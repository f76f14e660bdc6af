//! An image to make, as plain data.

pub use rasray_integrators::GlassShadows;
use rasray_report::Run;
use rasray_scene::needs::{self, Workload};
use rasray_scene::{BackFaces, ShadowTerminator};

/// What light does.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Integrator {
    /// Path tracing with light sampling.
    Path {
        /// At most this many scatterings; 0 is emission alone, 1 is direct light.
        bounces: u32,
        /// What smooth thin panes do to light.
        glass_shadows: GlassShadows,
    },
    /// Cosine-weighted visibility of a white environment.
    AmbientOcclusion {
        /// Metres within which something occludes; absent: any distance.
        distance: Option<f32>,
    },
    /// What the camera sees, unlit.
    Raycast,
}

impl Integrator {
    /// Paths of at most this many scatterings, with everything else at its default.
    pub const fn path(bounces: u32) -> Self {
        Self::Path { bounces, glass_shadows: GlassShadows::Tint }
    }

    /// Its name in reports and images.
    pub fn name(&self) -> &'static str {
        match self {
            Self::Path { .. } => "path",
            Self::AmbientOcclusion { .. } => "ao",
            Self::Raycast => "raycast",
        }
    }

    /// Bounces, where it has them.
    pub fn bounces(&self) -> Option<u32> {
        match self {
            Self::Path { bounces, .. } => Some(*bounces),
            _ => None,
        }
    }

    /// Metres within which something occludes, where the integrator has such a distance.
    pub fn ao_distance(&self) -> Option<f32> {
        match self {
            Self::AmbientOcclusion { distance } => *distance,
            _ => None,
        }
    }

    /// What smooth thin panes do to light, where the integrator asks.
    pub fn glass_shadows(&self) -> Option<GlassShadows> {
        match self {
            Self::Path { glass_shadows, .. } => Some(*glass_shadows),
            _ => None,
        }
    }
}

/// An image to make.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Frame {
    /// What light does.
    pub integrator: Integrator,
    /// Pixels a row, at least 1.
    pub width: u32,
    /// Rows, at least 1.
    pub height: u32,
    /// Samples per pixel, at least 1.
    pub spp: u32,
    /// Seed of all random numbers.
    pub seed: u32,
    /// Where they come from.
    pub sampler: Sampler,
    /// How what the camera sees first is found.
    pub primary: Primary,
    /// Which rays pass the backs of single-sided surfaces.
    pub back_faces: BackFaces,
    /// Where shadow rays of smooth surfaces start, of paths.
    pub shadow_terminator: ShadowTerminator,
}

/// How what camera rays hit is found.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Primary {
    /// Rays are traced through the structure.
    #[default]
    Trace,
    /// Triangles are drawn, whatever the structure stores, and tested at each pixel's ray.
    Raster,
}

impl Primary {
    /// All of them.
    pub const ALL: [Self; 2] = [Self::Trace, Self::Raster];

    /// Its name on the command line and in reports.
    pub fn name(self) -> &'static str {
        match self {
            Self::Trace => "trace",
            Self::Raster => "raster",
        }
    }

    /// What it is, in one line of help.
    pub fn doc(self) -> &'static str {
        match self {
            Self::Trace => "Rays are traced through the structure",
            Self::Raster => {
                "Triangles are drawn and tested at each pixel's ray: the same hits where the structure finds every one, \
                 exact first hits where it does not"
            }
        }
    }
}

/// What of a structure a picture builds where the scene has moved since the one before.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Refresh {
    /// All of it.
    #[default]
    All,
    /// The part that moves; what stands still is a part of its own, built once.
    Moving,
}

impl Refresh {
    /// All of them.
    pub const ALL: [Self; 2] = [Self::All, Self::Moving];

    /// Its name on the command line and in reports.
    pub fn name(self) -> &'static str {
        match self {
            Self::All => "all",
            Self::Moving => "moving",
        }
    }

    /// What it is, in one line of help.
    pub fn doc(self) -> &'static str {
        match self {
            Self::All => "Everything",
            Self::Moving => {
                "What moves; what stands still has a part of its own, built once. The same hits, for systems that find every \
                 triangle"
            }
        }
    }
}

/// Where random numbers come from.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Sampler {
    /// Points spread evenly over the samples of a pixel: least noise where their number is a power of two.
    #[default]
    Sobol,
    /// Independent numbers.
    Pcg,
}

impl Sampler {
    /// All of them.
    pub const ALL: [Self; 2] = [Self::Sobol, Self::Pcg];

    /// Its name on the command line.
    pub fn name(self) -> &'static str {
        match self {
            Self::Sobol => "sobol",
            Self::Pcg => "pcg",
        }
    }

    /// What it is, in one line of help.
    pub fn doc(self) -> &'static str {
        match self {
            Self::Sobol => {
                "Points spread evenly over the samples of a pixel: least noise where --spp is a power of two"
            }
            Self::Pcg => "Independent numbers",
        }
    }
}

impl Frame {
    /// Adds to a run what was asked for.
    pub(crate) fn describe(&self, run: &mut Run) {
        let paths = matches!(self.integrator, Integrator::Path { .. });
        run.integrator = Some(self.integrator.name().to_owned());
        run.width = Some(self.width);
        run.height = Some(self.height);
        run.spp = Some(self.spp);
        run.bounces = self.integrator.bounces();
        run.primary = Some(self.primary.name().to_owned());
        run.seed = Some(self.seed);
        run.sampler = Some(self.sampler.name().to_owned());
        run.back_faces = Some(self.back_faces.name().to_owned());
        run.glass_shadows = self.integrator.glass_shadows().map(|chosen| chosen.name().to_owned());
        run.shadow_terminator = paths.then(|| self.shadow_terminator.name().to_owned());
        run.ao_distance_m = self.integrator.ao_distance();
    }

    /// What an image like this one looks at in a scene.
    pub fn workload(&self) -> Workload {
        match self.integrator {
            Integrator::Path { bounces, .. } => Workload { integrator: needs::Integrator::Path, bounces },
            Integrator::AmbientOcclusion { .. } => {
                Workload { integrator: needs::Integrator::AmbientOcclusion, bounces: 1 }
            }
            Integrator::Raycast => Workload { integrator: needs::Integrator::Raycast, bounces: 0 },
        }
    }
}
