//! Frame, the image to make, as plain data.

use rasray_frame::Adaptive;
use rasray_integrators::IntegratorSpec;
use rasray_options::Value;
use rasray_report::Run;
use rasray_scene::needs::Workload;
use rasray_scene::{BackFaces, Sampler};

/// Image to make.
#[derive(Clone, Debug, PartialEq)]
pub struct Frame {
    /// Integrator with its options.
    pub integrator: IntegratorSpec,
    /// Width in pixels, at least 1.
    pub width: u32,
    /// Height in pixels, at least 1.
    pub height: u32,
    /// Samples per pixel, at least 1.
    pub spp: u32,
    /// Rule for the number of samples that a pixel gets; absent if each gets all.
    pub adaptive: Option<Adaptive>,
    /// Seed of all random numbers.
    pub seed: u32,
    /// Source of random numbers.
    pub sampler: Sampler,
    /// Method that finds first hits.
    pub primary: Primary,
    /// Occluder of shadow rays.
    pub occluder: OccluderKind,
    /// Rays that pass the backs of single-sided surfaces.
    pub back_faces: BackFaces,
}

/// Method that finds the hits of camera rays.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Primary {
    /// Traces rays through the structure.
    #[default]
    Trace,
    /// Draws triangles, whatever the structure stores, and tests them at each pixel's ray.
    Raster,
    /// Takes the nearest fragment of the pixel's cell in the structure's view of the camera, if the structure
    /// has one.
    Fragments,
}

impl Primary {
    /// All methods.
    pub const ALL: [Self; 3] = [Self::Trace, Self::Raster, Self::Fragments];

    /// Returns the method with this name.
    pub fn named(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|primary| primary.name() == name)
    }

    /// Returns the name on the command line and in reports.
    pub fn name(self) -> &'static str {
        match self {
            Self::Trace => "trace",
            Self::Raster => "raster",
            Self::Fragments => "fragments",
        }
    }

    /// Returns the description, one line of help.
    pub fn doc(self) -> &'static str {
        match self {
            Self::Trace => "Rays are traced through the structure",
            Self::Raster => {
                "Triangles are drawn and tested at each pixel's ray: the same hits where the structure finds every one, \
                 exact first hits where it does not"
            }
            Self::Fragments => {
                "The nearest fragment in the pixel's cell of the camera's view, of `system` mmrt with such a view"
            }
        }
    }
}

/// Occluder of shadow rays.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum OccluderKind {
    /// Structure that all other rays are traced through.
    #[default]
    Structure,
    /// Shadow maps for each light without extent, and for points on emitting triangles; other rays are
    /// traced.
    ShadowMaps {
        /// Number of texels along a side of a map.
        resolution: u32,
        /// Number of points on each emitting triangle that have maps; with 0 the rays to these triangles are
        /// traced.
        points: u32,
    },
}

impl OccluderKind {
    /// Smallest and largest number of texels along a side of a map.
    pub const RESOLUTIONS: [u32; 2] =
        [rasray_shadow_maps::Config::LEAST_TEXELS, rasray_shadow_maps::Config::MOST_TEXELS];

    /// All kinds of occluders, with the default resolution.
    pub const ALL: [Self; 2] = [
        Self::Structure,
        Self::ShadowMaps { resolution: rasray_shadow_maps::Config::DEFAULT_TEXELS, points: 0 },
    ];

    /// Largest number of points on an emitting triangle.
    pub const MOST_POINTS: u32 = rasray_shadow_maps::Config::MOST_POINTS;

    /// Returns the kind with this name, with the default resolution.
    pub fn named(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|occluder| occluder.name() == name)
    }

    /// Returns the name on the command line and in reports.
    pub fn name(self) -> &'static str {
        match self {
            Self::Structure => "structure",
            Self::ShadowMaps { .. } => "shadow-maps",
        }
    }

    /// Returns the description, one line of help.
    pub fn doc(self) -> &'static str {
        match self {
            Self::Structure => "Rays are traced through the structure",
            Self::ShadowMaps { .. } => {
                "Each point, spot and directional light has a map of depths, drawn where anything moves: fast, and wrong along \
                 the edges of shadows. Emitting triangles have maps with `shadow-points`. Rays to other lights are traced"
            }
        }
    }

    /// Returns the number of texels along a side of a map; `None` without maps.
    pub fn resolution(self) -> Option<u32> {
        match self {
            Self::Structure => None,
            Self::ShadowMaps { resolution, .. } => Some(resolution),
        }
    }

    /// Returns the number of points on each emitting triangle that have maps; `None` without maps.
    pub fn points(self) -> Option<u32> {
        match self {
            Self::ShadowMaps { points, .. } if points > 0 => Some(points),
            _ => None,
        }
    }
}

/// Parts of a structure that a picture builds if the scene has moved since the picture before.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Refresh {
    /// The whole structure.
    #[default]
    All,
    /// The moving part; everything else is a part of its own, built once.
    Moving,
    /// The moving part as in [`Self::Moving`], with a part for each object that only its node moves, built in
    /// the frames in which the object moves.
    Objects,
}

impl Refresh {
    /// All choices.
    pub const ALL: [Self; 3] = [Self::All, Self::Moving, Self::Objects];

    /// Returns the name on the command line and in reports.
    pub fn name(self) -> &'static str {
        match self {
            Self::All => "all",
            Self::Moving => "moving",
            Self::Objects => "objects",
        }
    }

    /// Returns the description, one line of help.
    pub fn doc(self) -> &'static str {
        match self {
            Self::All => "Everything",
            Self::Moving => {
                "Moving triangles; still ones have a part of their own, built once. The same hits of systems that find every \
                 triangle, the nearer of both parts' hits of others"
            }
            Self::Objects => {
                "Moving objects, each a part of its own that is built in frames in which it moves: at most 32, the largest, that a \
                 node alone moves; else as the value moving"
            }
        }
    }
}

impl Frame {
    /// Adds the settings of the frame to a run.
    pub(crate) fn describe(&self, run: &mut Run) {
        run.integrator = Some(self.integrator.name().to_owned());
        run.width = Some(self.width);
        run.height = Some(self.height);
        run.spp = Some(self.spp);
        run.bounces = self.integrator.get("bounces").and_then(Value::whole);
        run.primary = Some(self.primary.name().to_owned());
        run.occluder = Some(self.occluder.name().to_owned());
        run.shadow_resolution = self.occluder.resolution();
        run.shadow_points = self.occluder.points();
        run.seed = Some(self.seed);
        run.sampler = Some(self.sampler.name().to_owned());
        run.back_faces = Some(self.back_faces.name().to_owned());
        let values = self.integrator.values();
        let texts = values.iter().map(|(option, value)| (option, value.to_string()));
        run.integrator_options = rasray_report::options(texts);
    }

    /// Estimates the number of rays of the image: one per sample, and one per bounce of each sample.
    pub fn rays(&self) -> u64 {
        let bounces = self.integrator.get("bounces").and_then(Value::whole).unwrap_or(0);
        u64::from(self.width) * u64::from(self.height) * u64::from(self.spp) * (1 + u64::from(bounces))
    }

    /// Returns the work of an image like this one on a scene.
    pub fn workload(&self) -> Workload {
        self.integrator.workload()
    }
}
