//! Named files of traced rays and their answers.

use crate::jobs::SavedRays;
use rasray_ads::PRIMITIVE_NONE;
use rasray_ray_files::{hits_to_npy, rays_to_npy, triangles_to_npy, truth_to_npy, words_to_npy, write_rays};

/// Name within a folder, and bytes of the file.
pub type NamedBytes = (String, Vec<u8>);

impl SavedRays {
    /// Encodes rays and triangles as files: `<set>.rays` and `<set>.npy`, `<set>.exclude.npy` if a ray
    /// excludes a triangle, `<set>.flags.npy` if a ray passes backs, `triangles.npy` (`<case>.triangles.npy`
    /// for a hard case), and `triangles.backs.npy` if a triangle has a back. Files are encoded one by one as
    /// they are asked for.
    pub fn ray_files(&self) -> impl Iterator<Item = NamedBytes> {
        let origin = self.frame_origin;
        let name =
            self.case.as_ref().map_or("triangles.npy".to_owned(), |case| format!("{case}.triangles.npy"));
        let triangles = std::iter::once_with(move || (name, triangles_to_npy(&self.triangles, origin)));
        let rays = self.sets.iter().flat_map(move |set| {
            [
                (format!("{}.rays", set.name), write_rays(&set.rays, origin)),
                (format!("{}.npy", set.name), rays_to_npy(&set.rays, origin)),
            ]
        });
        let excluding = self.sets.iter().filter_map(|set| {
            let excluded: Vec<u32> = set.rays.iter().map(|ray| ray.exclude_primitive).collect();
            let excludes = excluded.iter().any(|id| *id != PRIMITIVE_NONE);
            excludes.then(|| (format!("{}.exclude.npy", set.name), words_to_npy(&excluded)))
        });
        let flagged = self.sets.iter().filter_map(|set| {
            let flags: Vec<u32> = set.rays.iter().map(|ray| ray.flags).collect();
            let is_flagged = flags.iter().any(|flags| *flags != 0);
            is_flagged.then(|| (format!("{}.flags.npy", set.name), words_to_npy(&flags)))
        });
        let backs = self.backs.iter().any(|back| *back != 0);
        let backs = backs.then(|| ("triangles.backs.npy".to_owned(), words_to_npy(&self.backs)));
        triangles.chain(backs).chain(rays).chain(excluding).chain(flagged)
    }

    /// Encodes the oracle's answers to each set (`<set>.oracle.npy`) and those of each system
    /// (`<set>.<system>-<preset>.npy`, with its [variant](crate::SystemConfig::variant) before the ending
    /// where there are several).
    pub fn hit_files(&self) -> impl Iterator<Item = NamedBytes> {
        self.sets.iter().flat_map(|set| {
            let truth =
                std::iter::once_with(move || (format!("{}.oracle.npy", set.name), truth_to_npy(&set.truth)));
            let answers = set.answers.iter().map(move |answers| {
                let bytes = hits_to_npy(&answers.hits, answers.kind);
                (format!("{}.{}.npy", set.name, answers.name), bytes)
            });
            truth.chain(answers)
        })
    }
}
