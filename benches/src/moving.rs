//! Arguments of benches of scenes that move, after the words of the command.

use std::error::Error;

/// Arguments `[SCENE] [WIDTHxHEIGHT] [FRAMES] [MORE]`.
pub struct Arguments {
    /// Name of the scene, `walker` by default.
    pub scene: String,
    /// Width and height in pixels, 320x180 by default.
    pub size: [u32; 2],
    /// Number of frames, greater than 0.
    pub frames: u32,
    /// Fourth word, where given.
    pub more: Option<String>,
}

impl Arguments {
    /// Reads the arguments; `frames` is the default number of frames.
    ///
    /// # Errors
    /// A word is not a size, or not a number of frames greater than 0.
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
