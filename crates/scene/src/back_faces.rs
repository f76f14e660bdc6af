/// Choice of the rays that pass through the backs of single-sided surfaces
/// ([`Material::culls_back`](crate::Material::culls_back)).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum BackFaces {
    /// Camera rays alone, also where they go on behind blended surfaces: a camera can look into rooms, which
    /// are lit as if their walls were there.
    #[default]
    Camera,
    /// Every ray.
    All,
    /// No ray.
    None,
}

impl BackFaces {
    /// All choices.
    pub const ALL: [Self; 3] = [Self::Camera, Self::All, Self::None];

    /// Name of the choice on the command line.
    pub fn name(self) -> &'static str {
        match self {
            Self::Camera => "camera",
            Self::All => "all",
            Self::None => "none",
        }
    }

    /// Meaning of the choice, in one line of help.
    pub fn doc(self) -> &'static str {
        match self {
            Self::Camera => {
                "Camera rays alone: what the camera sees has no backs, and light is blocked by both sides"
            }
            Self::All => "Every ray: what is seen, mirrored and lit has no backs",
            Self::None => "No ray: both sides of all surfaces are there",
        }
    }

    /// True if camera rays pass through backs.
    pub fn lets_camera_rays(self) -> bool {
        self != Self::None
    }

    /// True if scattered rays and shadow rays pass through backs.
    pub fn lets_other_rays(self) -> bool {
        self == Self::All
    }
}
