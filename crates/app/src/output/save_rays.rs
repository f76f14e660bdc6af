//! Writer of traced rays and their answers into folders.

use super::destination::Destination;
use crate::error::AppError;
use crate::interrupt::Interrupt;
use rasray_experiment::{NamedBytes, SavedRays};
use std::path::{Path, PathBuf};

/// Folders that were named, and accept files.
#[derive(Clone, Debug, Default)]
pub(crate) struct SaveTargets {
    rays: Option<PathBuf>,
    hits: Option<PathBuf>,
}

impl SaveTargets {
    /// Checks the folders.
    ///
    /// # Errors
    /// A folder does not exist or accepts no files.
    pub(crate) fn check(rays: Option<&Path>, hits: Option<&Path>) -> Result<Self, AppError> {
        for folder in [rays, hits].into_iter().flatten() {
            Destination::check(&folder.join("triangles.npy"))?;
        }
        Ok(Self { rays: rays.map(Path::to_owned), hits: hits.map(Path::to_owned) })
    }

    /// True if anything is to be saved.
    pub(crate) fn any(&self) -> bool {
        self.rays.is_some() || self.hits.is_some()
    }
}

/// Writes rays, triangles and hits. Existing files are replaced.
///
/// # Errors
/// A file cannot be written.
pub(crate) fn save(targets: &SaveTargets, kept: &SavedRays, interrupt: &Interrupt) -> Result<(), AppError> {
    let write = |folder: &Path, (name, bytes): NamedBytes| {
        Destination::check(&folder.join(name))?.write(&bytes, interrupt)
    };
    if let Some(folder) = &targets.rays {
        kept.ray_files().try_for_each(|file| write(folder, file))?;
    }
    if let Some(folder) = &targets.hits {
        kept.hit_files().try_for_each(|file| write(folder, file))?;
    }
    Ok(())
}
