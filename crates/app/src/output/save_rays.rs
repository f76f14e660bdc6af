//! Writes what was traced and answered into folders.

use super::destination::Destination;
use crate::error::AppError;
use crate::interrupt::Interrupt;
use rasray_ads::PRIMITIVE_NONE;
use rasray_experiment::Kept;
use rasray_ray_files::{hits_to_npy, ids_to_npy, rays_to_npy, triangles_to_npy, truth_to_npy, write_rays};
use std::path::{Path, PathBuf};

/// Folders that were named, and seen to take files.
#[derive(Clone, Debug, Default)]
pub(crate) struct SaveTargets {
    rays: Option<PathBuf>,
    hits: Option<PathBuf>,
}

impl SaveTargets {
    /// Checks the folders.
    ///
    /// # Errors
    /// A folder that does not exist or takes no files.
    pub(crate) fn check(rays: Option<&Path>, hits: Option<&Path>) -> Result<Self, AppError> {
        for folder in [rays, hits].into_iter().flatten() {
            Destination::check(&folder.join("triangles.npy"))?;
        }
        Ok(Self { rays: rays.map(Path::to_owned), hits: hits.map(Path::to_owned) })
    }

    /// Whether anything is to be saved.
    pub(crate) fn any(&self) -> bool {
        self.rays.is_some() || self.hits.is_some()
    }
}

/// Writes rays, triangles and hits. Files that are there already are replaced.
///
/// # Errors
/// A file cannot be written.
pub(crate) fn save(targets: &SaveTargets, kept: &Kept, interrupt: &Interrupt) -> Result<(), AppError> {
    let origin = kept.frame_origin;
    let write = |folder: &Path, name: String, bytes: Vec<u8>| {
        Destination::check(&folder.join(name))?.write(&bytes, interrupt)
    };
    if let Some(folder) = &targets.rays {
        let name =
            kept.case.as_ref().map_or("triangles.npy".to_owned(), |case| format!("{case}.triangles.npy"));
        write(folder, name, triangles_to_npy(&kept.triangles, origin))?;
        for set in &kept.sets {
            write(folder, format!("{}.rays", set.name), write_rays(&set.rays, origin))?;
            write(folder, format!("{}.npy", set.name), rays_to_npy(&set.rays, origin))?;
            if set.rays.iter().any(|ray| ray.exclude_primitive != PRIMITIVE_NONE) {
                let excluded: Vec<u32> = set.rays.iter().map(|ray| ray.exclude_primitive).collect();
                write(folder, format!("{}.exclude.npy", set.name), ids_to_npy(&excluded))?;
            }
        }
    }
    if let Some(folder) = &targets.hits {
        for set in &kept.sets {
            write(folder, format!("{}.oracle.npy", set.name), truth_to_npy(&set.truth))?;
            for answers in &set.answers {
                let bytes = hits_to_npy(&answers.hits, answers.kind);
                write(folder, format!("{}.{}.npy", set.name, answers.name), bytes)?;
            }
        }
    }
    Ok(())
}
