//! Arguments of benches of scenes that move, behind the words of the command.

use std::error::Error;

/// `[SCENE] [WIDTHxHEIGHT] [FRAMES] [MORE]`.
pub struct Arguments {
    /// Name of a scene, `walker` unless told.
    pub scene: String,
    /// Pixels, 320x180 unless told.
    pub size: [u32; 2],
    /// Above 0.
    pub frames: u32,
    /// The fourth word.
    pub more: Option<String>,
}

impl Arguments {
    /// Reads them; `frames` are made unless told.
    ///
    /// # Errors
    /// A word that is no size, or no number of frames above 0.
    pub fn read(frames: u32) -> Result<Self, Box<dyn Error>> {
        let mut words = std::env::args().skip(1).filter(|word| !word.starts_with("--"));
        let scene = words.next().unwrap_or_else(|| "walker".to_owned());
        let size = words.next().unwrap_or_else(|| "320x180".to_owned());
        let size = size.split_once('x').and_then(|(w, h)| Some([w.parse().ok()?, h.parse().ok()?]));
        let size: [u32; 2] =
            size.filter(|[w, h]| *w > 0 && *h > 0).ok_or("the size is WIDTHxHEIGHT, in pixels")?;
        let frames: u32 = words.next().map_or(Ok(frames), |word| word.parse()).unwrap_or(0);
        if frames == 0 {
            return Err("FRAMES is a whole number above 0".into());
        }
        Ok(Self { scene, size, frames, more: words.next() })
    }
}
