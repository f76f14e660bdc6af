//! Rays and hits in files, so that another tracer can be held against the systems here on the same
//! rays. `docs/ray-files.md` describes the formats.
//!
//! Whatever a file holds, reading it gives rays and hits that can be traced and judged, or an error that
//! names the file, the place and the fix.

mod binary;
mod error;
mod hits;
mod literal;
mod npy;
mod rays;
mod save;

pub use binary::{read_rays, write_rays};
pub use error::FormatError;
pub use hits::{HitsFile, hits_from_npy, hits_to_npy, truth_to_npy};
pub use rays::{Place, RaysFile, rays_from_npy, rays_to_npy, triangles_to_npy};
pub(crate) use save::{SaveTargets, save};

use crate::error::AppError;
use std::path::Path;

/// Most rays or hits that a file may hold.
pub const LIMIT: usize = 100_000_000;

/// Reads rays from a `.rays` or `.npy` file.
///
/// # Errors
/// The file cannot be read, is neither by its name, or is not what its name says.
pub fn load_rays(path: &Path) -> Result<RaysFile, AppError> {
    let read = match extension(path).as_deref() {
        Some("rays") => read_rays,
        Some("npy") => rays_from_npy,
        _ => {
            return Err(AppError::input(
                path,
                "is not a file of rays by its name",
                "name a .rays file or a .npy array of N x 6, 7 or 8 numbers",
            ));
        }
    };
    let bytes = read_file(path)?;
    read(&bytes).map_err(|error| AppError::input(path, &error, error.help()))
}

/// Reads hits from a `.npy` file; `name` is what the report calls the tracer that found them.
///
/// # Errors
/// The file cannot be read, is no `.npy` by its name, or does not hold hits.
pub fn load_hits(name: &str, path: &Path) -> Result<HitsFile, AppError> {
    if extension(path).as_deref() != Some("npy") {
        return Err(AppError::input(
            path,
            "is not a file of hits by its name",
            "name a .npy array with fields t and primitive",
        ));
    }
    let bytes = read_file(path)?;
    let hits = hits_from_npy(&bytes).map_err(|error| AppError::input(path, &error, error.help()))?;
    Ok(HitsFile { name: name.to_owned(), hits })
}

fn extension(path: &Path) -> Option<String> {
    path.extension().and_then(|text| text.to_str()).map(str::to_ascii_lowercase)
}

fn read_file(path: &Path) -> Result<Vec<u8>, AppError> {
    std::fs::read(path).map_err(|error| {
        AppError::input(
            path,
            format!("cannot be read: {error}"),
            "check the name and that you may read the file",
        )
    })
}

#[cfg(test)]
mod tests;
