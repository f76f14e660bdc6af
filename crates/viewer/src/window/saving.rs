//! Saving of pictures from the window.

use std::path::Path;

use rasray_metrics::Tone;

/// Picture to save.
#[derive(Clone, Debug)]
pub struct SavedPicture<'a> {
    /// File of the picture.
    pub place: &'a Path,
    /// Width and height, pixels.
    pub size: [u32; 2],
    /// Three bytes of sRGB per pixel, rows from the top.
    pub pixels: &'a [u8],
    /// Tone of the colours; absent for maps.
    pub tone: Option<Tone>,
    /// Name and version of the denoiser; absent for a picture with noise.
    pub denoised: Option<&'a str>,
    /// Command line that makes the picture at the end of its refinement; absent for maps, which `rasray
    /// compare --html` makes.
    pub command_line: Option<&'a str>,
    /// Meaning of the colours of a map, in a sentence; absent for pictures.
    pub scale: Option<String>,
    /// True if the refinement has ended.
    pub is_finished: bool,
}

/// Function that writes a picture.
pub type SavePicture<'a> = dyn FnMut(&SavedPicture<'_>) -> Result<(), String> + 'a;
