//! Pictures that are saved from the window.

use std::path::Path;

use rasray_metrics::Tone;

/// A picture to be saved.
#[derive(Clone, Debug)]
pub struct SavedPicture<'a> {
    /// The file.
    pub place: &'a Path,
    /// Pixels a row and rows.
    pub size: [u32; 2],
    /// Three bytes of sRGB per pixel, rows from the top.
    pub pixels: &'a [u8],
    /// Tone of its colours; absent for maps.
    pub tone: Option<Tone>,
    /// Name and version of its denoiser; absent without one.
    pub denoised: Option<&'a str>,
    /// The command line that makes it when its refinement has ended; absent for maps, which `rasray compare
    /// --html` makes.
    pub command_line: Option<&'a str>,
    /// Meaning of the colours of a map, in a sentence; absent for pictures.
    pub scale: Option<String>,
    /// True if its refinement has ended.
    pub is_finished: bool,
}

/// Writes a picture.
pub type SavePicture<'a> = dyn FnMut(&SavedPicture<'_>) -> Result<(), String> + 'a;
