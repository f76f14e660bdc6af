//! Tone of pictures of 8 bits.

use super::options::choice;
use super::values::Quantity;
use clap::Args;
use clap::builder::TypedValueParser;
use rasray_metrics::{Tone, ToneCurve};

/// Makes a parser that reads the name of a curve.
pub fn tone_parser() -> impl TypedValueParser<Value = ToneCurve> {
    choice(ToneCurve::ALL, |curve| (curve.name(), curve.doc()))
}

/// Map from linear colours to those of a PNG.
#[derive(Clone, Copy, Debug, Default, Args)]
pub struct ToneArguments {
    /// Stops of exposure for .png
    #[arg(long, value_name = "STOPS", value_parser = Quantity::STOPS.parser::<f32>(), allow_hyphen_values = true)]
    pub exposure: Option<f32>,
    /// Curve for .png, after the exposure [default: exposure]
    #[arg(long, value_parser = tone_parser())]
    pub tone: Option<ToneCurve>,
}

impl ToneArguments {
    /// Returns the tone that was asked for.
    pub fn tone(self) -> Tone {
        Tone { curve: self.tone.unwrap_or_default(), exposure: self.exposure.unwrap_or_default() }
    }

    /// Returns a tone option that was given, for messages; `None` without one.
    pub fn given(self) -> Option<&'static str> {
        self.tone.map(|_| "--tone").or(self.exposure.map(|_| "--exposure"))
    }
}
