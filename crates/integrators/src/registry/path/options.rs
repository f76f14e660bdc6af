//! Options of paths, and their rows.

use rasray_options::{OptionRow, Value, Values, Word};
use rasray_scene::ShadowTerminator;

use crate::IntegratorSpec;

/// Maximum number of scatterings of a path. A wave records up to this number of rounds.
pub const BOUNCE_LIMIT: u32 = 1024;

/// Option of bounces. The default lets light go through two glasses with two walls in a row: light that
/// enters and leaves one such glass has scattered four times before it is seen on the surface behind.
pub(in crate::registry) const BOUNCES: OptionRow = OptionRow::new(
    "bounces",
    Values::Whole(0, BOUNCE_LIMIT),
    "At most this many scatterings (0: emission alone, 1: direct light; through thick or rough glass each surface is one)",
)
.by_default(Value::Whole(8))
.trying(&["0", "2", "8"]);

pub(super) const GLASS_SHADOWS: OptionRow = OptionRow::words(
    "glass-shadows",
    &[GlassShadows::Tint.word(), GlassShadows::Opaque.word()],
    "Effect of smooth thin panes of glass on light",
)
.by_default(Value::Word(GlassShadows::Tint.name()));

pub(in crate::registry) const SHADOW_TERMINATOR: OptionRow = OptionRow::words(
    "shadow-terminator",
    &[terminator_word(ShadowTerminator::None), terminator_word(ShadowTerminator::Offset)],
    "Origin of shadow rays of smooth surfaces",
)
.by_default(Value::Word(ShadowTerminator::None.name()));

pub(in crate::registry) const SPECULAR: OptionRow = OptionRow::words(
    "specular",
    &[SpecularLobe::Ggx.word(), SpecularLobe::Ward.word()],
    "Reflection of rough surfaces that let no light through",
)
.by_default(Value::Word(SpecularLobe::Ggx.name()));

pub(super) const FETCH: OptionRow = OptionRow::words(
    "fetch",
    &[Fetching::Direct.word(), Fetching::Raster.word()],
    "Method that finds the surfaces of hits",
)
.by_default(Value::Word(Fetching::Direct.name()));

const fn terminator_word(terminator: ShadowTerminator) -> Word {
    (terminator.name(), terminator.doc())
}

/// Effect of smooth thin panes of glass on light from lamps, the sun and the sky. Thin walls whose
/// transmission is rough, and glass with a thickness, scatter light either way, and stop shadow rays.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum GlassShadows {
    /// Light goes straight through the panes and takes their tint. The passage is no scattering, and so no
    /// bounce.
    #[default]
    Tint,
    /// The panes stop shadow rays, and the passage is a scattering: surfaces behind them are lit by the light
    /// that scattered rays find, which is never that of lights without extent.
    Opaque,
}

impl GlassShadows {
    /// All choices.
    pub const ALL: [Self; 2] = [Self::Tint, Self::Opaque];

    /// Name on the command line.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Tint => "tint",
            Self::Opaque => "opaque",
        }
    }

    /// Description, one line of help.
    pub const fn doc(self) -> &'static str {
        match self {
            Self::Tint => "Light goes straight through smooth thin panes and takes their tint",
            Self::Opaque => "Panes stop it; what scattered rays meet behind them counts alone",
        }
    }

    const fn word(self) -> Word {
        (self.name(), self.doc())
    }
}

/// Reflection of rough surfaces that let no light through.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum SpecularLobe {
    /// Facets with the distribution GGX, which mask each other, with compensation of the lost energy.
    #[default]
    Ggx,
    /// Gaussian of slopes, as on the teapot of Hu et al.
    Ward,
}

impl SpecularLobe {
    /// All choices.
    pub const ALL: [Self; 2] = [Self::Ggx, Self::Ward];

    /// Name on the command line.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Ggx => "ggx",
            Self::Ward => "ward",
        }
    }

    /// Description, one line of help.
    pub const fn doc(self) -> &'static str {
        match self {
            Self::Ggx => "Facets of GGX, as glTF has them; what they lose is made up for",
            Self::Ward => {
                "Ward's lobe, a Gaussian of slopes, as in Hu et al.; it is darker where light grazes"
            }
        }
    }

    const fn word(self) -> Word {
        (self.name(), self.doc())
    }
}

/// Method that finds the surfaces of hits. Pictures do not depend on it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Fetching {
    /// Look-up by the structure: for triangles, by the id of the triangle.
    #[default]
    Direct,
    /// Drawing of the triangles that were hit against lists of hits, as DIRT does ([`crate::Fetch`]).
    Raster,
}

impl Fetching {
    /// All choices.
    pub const ALL: [Self; 2] = [Self::Direct, Self::Raster];

    /// Name on the command line.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Direct => "direct",
            Self::Raster => "raster",
        }
    }

    /// Description, one line of help.
    pub const fn doc(self) -> &'static str {
        match self {
            Self::Direct => "By the structure: of triangles, by their ids",
            Self::Raster => {
                "By drawing the triangles that were hit against lists of hits, as in DIRT; the same surfaces"
            }
        }
    }

    const fn word(self) -> Word {
        (self.name(), self.doc())
    }
}

/// Options of paths.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct PathOptions {
    /// Largest number of scatterings, up to [`BOUNCE_LIMIT`]: 1 is direct light only, 0 emission only.
    pub bounces: u32,
    /// Effect of smooth thin panes on light; with 0 bounces they are opaque.
    pub glass_shadows: GlassShadows,
    /// Origin of shadow rays on smooth surfaces.
    pub shadow_terminator: ShadowTerminator,
    /// Reflection of rough surfaces.
    pub specular: SpecularLobe,
    /// Method that finds the surfaces of hits; drawing needs a structure of triangles.
    pub fetch: Fetching,
}

impl PathOptions {
    /// Reads the options from a spec.
    pub(in crate::registry) fn of(spec: &IntegratorSpec) -> Self {
        Self {
            bounces: spec.get(BOUNCES.name).and_then(Value::whole).unwrap_or_default(),
            glass_shadows: spec.choice(&GLASS_SHADOWS, &GlassShadows::ALL, GlassShadows::name),
            shadow_terminator: spec.choice(
                &SHADOW_TERMINATOR,
                &ShadowTerminator::ALL,
                ShadowTerminator::name,
            ),
            specular: spec.choice(&SPECULAR, &SpecularLobe::ALL, SpecularLobe::name),
            fetch: spec.choice(&FETCH, &Fetching::ALL, Fetching::name),
        }
    }
}

impl From<u32> for PathOptions {
    /// Makes options with this many bounces, and all other defaults.
    fn from(bounces: u32) -> Self {
        Self { bounces, ..Self::default() }
    }
}
