//! Options of Whitted's integrator, and their rows.

use rasray_options::{Least, OptionRow, Unit, Value, Values, Word};
use rasray_shaders_glsl::constants::{
    integrators::{
        WHITTED_SELECTS_ALL, WHITTED_SELECTS_REFLECTIVE, WHITTED_SHADOWS_FIRST, WHITTED_SHADOWS_NONE,
        WHITTED_SHADOWS_SPECULAR,
    },
    scene::BSDF_SMOOTH_ROUGHNESS,
};

use crate::IntegratorSpec;

/// Maximum number of reflections and refractions of a ray. Each may double the number of rays.
pub const RAY_DEPTH_LIMIT: u32 = 8;

pub(super) const RAY_DEPTH: OptionRow = OptionRow::new(
    "ray-depth",
    Values::Whole(0, RAY_DEPTH_LIMIT),
    "At most this many reflections and refractions in a row (0: direct light only)",
)
.by_default(Value::Whole(3))
.trying(&["0", "1", "8"]);

pub(super) const SELECT: OptionRow = OptionRow::words(
    "select",
    &[Select::Expected.word(), Select::All.word(), Select::Reflective.word(), Select::Specular.word()],
    "Surfaces from which mirrored and refracted rays are traced",
)
.by_default(Value::Word(Select::Expected.name()));

pub(super) const THRESHOLD: OptionRow = OptionRow::new(
    "threshold",
    Values::Number(Unit::Share, Least::Zero),
    "With `select` expected: rays are traced where they carry more than this share of what they find",
)
.by_default(Value::Number(0.0))
.trying(&["0.1"]);

pub(in crate::registry) const SHADOWS: OptionRow = OptionRow::words(
    "shadows",
    &[Shadows::All.word(), Shadows::First.word(), Shadows::None.word()],
    "Surfaces that trace shadow rays",
)
.by_default(Value::Word(Shadows::All.name()));

pub(in crate::registry) const MIRROR_ROUGHNESS: OptionRow = OptionRow::new(
    "mirror-roughness",
    Values::Number(Unit::Share, Least::Zero),
    "Surfaces less rough than this are perfectly smooth, as all below 0.03 are",
)
.by_default(Value::Number(BSDF_SMOOTH_ROUGHNESS))
.trying(&["0.4"]);

pub(super) const COMPACTION: OptionRow = OptionRow::words(
    "compaction",
    &[
        ("selected", "Passes work on the rays that there are"),
        ("masked", "Passes work on all pixels, also those without a ray; pictures are the same"),
    ],
    "Pixels that passes after the first work on",
)
.by_default(Value::Word("selected"));

/// Surfaces from which mirrored and refracted rays are traced. Rays that go straight through a blended
/// surface or a pane are traced whenever they carry light.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Select {
    /// Surfaces whose rays carry more than a threshold of the light that they find: with 0 the picture is
    /// that of all rays.
    #[default]
    Expected,
    /// All surfaces, also those that neither mirror nor refract.
    All,
    /// Mirrors that the camera sees; behind them the rules are those of all rays.
    Reflective,
    /// Surfaces that mirror or refract; other surfaces are lit without shadow rays.
    Specular,
}

impl Select {
    /// All choices.
    pub const ALL: [Self; 4] = [Self::Expected, Self::All, Self::Reflective, Self::Specular];

    /// Name on the command line.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Expected => "expected",
            Self::All => "all",
            Self::Reflective => "reflective",
            Self::Specular => "specular",
        }
    }

    /// Description, one line of help.
    pub const fn doc(self) -> &'static str {
        match self {
            Self::Expected => {
                "Those whose rays carry more than `threshold`; with 0 the picture is that of all"
            }
            Self::All => "All, also those whose rays carry nothing",
            Self::Reflective => "Mirrors that the camera sees; beyond them all",
            Self::Specular => "Those that mirror or refract; others are lit without shadow rays",
        }
    }

    const fn word(self) -> Word {
        (self.name(), self.doc())
    }

    fn marks(self) -> u32 {
        match self {
            Self::Expected => 0,
            Self::All => WHITTED_SELECTS_ALL,
            Self::Reflective => WHITTED_SELECTS_REFLECTIVE,
            Self::Specular => WHITTED_SHADOWS_SPECULAR,
        }
    }
}

/// Surfaces from which shadow rays are traced; others are lit as if nothing occluded them.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Shadows {
    /// All surfaces.
    #[default]
    All,
    /// Surfaces that the camera sees.
    First,
    /// No surfaces.
    None,
}

impl Shadows {
    /// All choices.
    pub const ALL: [Self; 3] = [Self::All, Self::First, Self::None];

    /// Name on the command line.
    pub const fn name(self) -> &'static str {
        match self {
            Self::All => "all",
            Self::First => "first",
            Self::None => "none",
        }
    }

    /// Description, one line of help.
    pub const fn doc(self) -> &'static str {
        match self {
            Self::All => "All",
            Self::First => "Those that the camera sees; what mirrors show is lit without shadow rays",
            Self::None => "None",
        }
    }

    const fn word(self) -> Word {
        (self.name(), self.doc())
    }

    fn marks(self) -> u32 {
        match self {
            Self::All => 0,
            Self::First => WHITTED_SHADOWS_FIRST,
            Self::None => WHITTED_SHADOWS_NONE,
        }
    }
}

/// Options of Whitted's integrator.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WhittedOptions {
    /// Largest number of reflections and refractions in a row, up to [`RAY_DEPTH_LIMIT`]; 0 is direct light
    /// only.
    pub ray_depth: u32,
    /// Surfaces from which mirrored and refracted rays are traced.
    pub select: Select,
    /// With [`Select::Expected`]: least share of the light of a ray that must arrive, in its largest channel;
    /// not negative.
    pub threshold: f32,
    /// Surfaces from which shadow rays are traced.
    pub shadows: Shadows,
    /// Perceptual roughness below which surfaces are perfectly smooth; not negative.
    pub mirror_roughness: f32,
    /// True if passes work on all slots of a wave, also those without a ray.
    pub masked: bool,
}

impl Default for WhittedOptions {
    fn default() -> Self {
        Self {
            ray_depth: 3,
            select: Select::default(),
            threshold: 0.0,
            shadows: Shadows::default(),
            mirror_roughness: BSDF_SMOOTH_ROUGHNESS,
            masked: false,
        }
    }
}

impl WhittedOptions {
    /// Reads the options from a spec.
    pub(super) fn of(spec: &IntegratorSpec) -> Self {
        let number = |row: &OptionRow| spec.get(row.name).and_then(Value::number).unwrap_or_default();
        Self {
            ray_depth: spec.get(RAY_DEPTH.name).and_then(Value::whole).unwrap_or_default(),
            select: spec.choice(&SELECT, &Select::ALL, Select::name),
            threshold: number(&THRESHOLD),
            shadows: spec.choice(&SHADOWS, &Shadows::ALL, Shadows::name),
            mirror_roughness: number(&MIRROR_ROUGHNESS),
            masked: spec.get(COMPACTION.name) == Some(Value::Word("masked")),
        }
    }

    /// Returns the options as flags for kernels.
    pub(super) fn marks(self) -> u32 {
        self.select.marks() | self.shadows.marks()
    }
}
