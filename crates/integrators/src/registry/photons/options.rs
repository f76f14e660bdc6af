//! Options of photons, and their rows.

use rasray_options::{Least, OptionRow, Unit, Value, Values, Word};

use crate::{IntegratorSpec, PathOptions, WAVE_LIMIT};

pub(super) const PHOTONS: OptionRow = OptionRow::words(
    "photons",
    &[PhotonKind::Caustic.word(), PhotonKind::All.word()],
    "Light that photons bring; paths bring the rest",
)
.by_default(Value::Word(PhotonKind::Caustic.name()));

pub(super) const PHOTON_PATHS: OptionRow = OptionRow::new(
    "photon-paths",
    Values::Whole(1, WAVE_LIMIT),
    "Photons that lights emit for each sample of the picture",
)
.by_default(Value::Whole(16_384))
.trying(&["1", "3000"]);

pub(super) const RADIUS: OptionRow = OptionRow::new(
    "radius",
    Values::Number(Unit::Metres, Least::AboveZero),
    "Metres around a surface within which photons of the first sample count, of later samples less; a hundredth of the scene if not given",
)
.trying(&["0.2"]);

/// Light that photons carry.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum PhotonKind {
    /// Light that reaches a rough surface from perfectly smooth ones alone: caustics.
    #[default]
    Caustic,
    /// All light that reaches a rough surface from other surfaces.
    All,
}

impl PhotonKind {
    /// All choices.
    pub const ALL: [Self; 2] = [Self::Caustic, Self::All];

    /// Name on the command line.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Caustic => "caustic",
            Self::All => "all",
        }
    }

    /// Description, one line of help.
    pub const fn doc(self) -> &'static str {
        match self {
            Self::Caustic => "Light that smooth mirrors and smooth glass alone send to rough surfaces",
            Self::All => "All indirect light of the first rough surface that the camera sees",
        }
    }

    const fn word(self) -> Word {
        (self.name(), self.doc())
    }
}

/// Options of [`Photons`](super::Photons).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PhotonOptions {
    /// Options of the camera's paths and of photons together: `bounces` counts scatterings from the light to
    /// the eye. Panes are always opaque, and surfaces of photons' hits are always found directly.
    pub paths: PathOptions,
    /// Light that photons carry.
    pub kind: PhotonKind,
    /// Number of photons that lights emit for each sample, from 1 to [`WAVE_LIMIT`].
    pub photon_paths: u32,
    /// Radius of the first sample, metres, above 0; if absent, a hundredth of the diagonal of the bounds of
    /// all triangles.
    pub radius: Option<f32>,
}

impl Default for PhotonOptions {
    fn default() -> Self {
        Self { paths: PathOptions::from(8), kind: PhotonKind::default(), photon_paths: 16_384, radius: None }
    }
}

impl PhotonOptions {
    pub(super) fn of(spec: &IntegratorSpec) -> Self {
        Self {
            paths: PathOptions::of(spec),
            kind: spec.choice(&PHOTONS, &PhotonKind::ALL, PhotonKind::name),
            photon_paths: spec.get(PHOTON_PATHS.name).and_then(Value::whole).unwrap_or_default(),
            radius: spec.get(RADIUS.name).and_then(Value::number),
        }
    }

    pub(super) fn check(&self) -> Result<(), rasray_options::ValueError> {
        PHOTON_PATHS.check(Value::Whole(self.photon_paths))?;
        self.radius.map_or(Ok(()), |radius| RADIUS.check(Value::Number(radius)).map(drop))
    }
}
