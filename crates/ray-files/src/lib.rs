//! Rays and hits in files, so that another tracer can be compared with the systems of rasray on the same
//! rays. `rasray compare` reads and writes them.
//!
//! - [`load_rays`] and [`load_hits`] read a file. They return rays and hits that can be traced and compared,
//!   or an error that names the file, the place and the fix.
//! - [`write_rays`], [`rays_to_npy`], [`hits_to_npy`], [`truth_to_npy`] and [`triangles_to_npy`] write files.
//!
//! `docs/ray-files.md` describes the formats.

mod binary;
mod error;
mod hits;
mod limit;
mod literal;
mod npy;
mod rays;

pub use binary::{read_rays, write_rays};
pub use error::{FileError, FormatError};
pub use hits::{HitsFile, TrueHit, hits_from_npy, hits_to_npy, truth_to_npy};
pub use limit::LIMIT;
pub use rays::{Place, RaysFile, rays_from_npy, rays_to_npy, triangles_to_npy, words_to_npy};

use std::path::Path;

/// Reads rays from a `.rays` or `.npy` file.
///
/// # Errors
/// An error if the file cannot be read, has neither extension, or does not match its name.
pub fn load_rays(path: &Path) -> Result<RaysFile, FileError> {
    let read = match extension(path).as_deref() {
        Some("rays") => read_rays,
        Some("npy") => rays_from_npy,
        _ => return Err(FileError::NotRays { path: path.to_owned() }),
    };
    read(&read_file(path)?).map_err(|source| FileError::Format { path: path.to_owned(), source })
}

/// Reads hits from a `.npy` file; `name` is the name in reports of the tracer that found them.
///
/// # Errors
/// An error if the file cannot be read, is no `.npy` by its name, or does not hold hits.
pub fn load_hits(name: &str, path: &Path) -> Result<HitsFile, FileError> {
    if extension(path).as_deref() != Some("npy") {
        return Err(FileError::NotHits { path: path.to_owned() });
    }
    let hits = hits_from_npy(&read_file(path)?);
    let hits = hits.map_err(|source| FileError::Format { path: path.to_owned(), source })?;
    Ok(HitsFile { name: name.to_owned(), hits })
}

fn extension(path: &Path) -> Option<String> {
    path.extension().and_then(|text| text.to_str()).map(str::to_ascii_lowercase)
}

fn read_file(path: &Path) -> Result<Vec<u8>, FileError> {
    std::fs::read(path).map_err(|source| FileError::Unreadable { path: path.to_owned(), source })
}

/// Compiles the examples of the readme.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;

#[cfg(test)]
mod tests;
