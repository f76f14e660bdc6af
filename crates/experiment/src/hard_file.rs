//! Hard cases that are files: checks that a loader refuses or reads them, as stated.

use crate::error::ExperimentError;
use rasray_hard_cases::{HardFile, Loading};
use rasray_report::{HardRecord, Run};
use rasray_scene_files::LoadOptions;

/// System and preset of the run of a file.
pub(super) const LOADER: (&str, &str) = ("loader", "file");

/// Loads a file that must be refused, or must be read as stated, and makes a run with the verdict.
///
/// # Errors
/// The folder for temporary files does not accept a file.
pub fn compare_file(file: &HardFile) -> Result<Run, ExperimentError> {
    let failed = |source| ExperimentError::TemporaryFile { path: std::env::temp_dir(), source };
    let folder = tempfile::Builder::new().prefix("rasray-").tempdir().map_err(failed)?;
    let place = folder.path().join(file.name);
    std::fs::write(&place, &file.bytes).map_err(failed)?;
    let loaded = rasray_scene_files::load(&place, &LoadOptions::default());
    let reason = match &loaded {
        // The name of the temporary folder is meaningless to a reader and is left out.
        Err(error) => format!(
            "refused: {}",
            error.to_string().replace(&*folder.path().to_string_lossy(), "").trim_start_matches('/')
        ),
        Ok(scene) => format!("read, with {} warnings", scene.warnings.len()),
    };
    let wanted = match file.loading {
        Loading::Refused(_) => "refused with a typed error",
        Loading::Read { .. } => "read as stated",
    };
    Ok(Run {
        system: LOADER.0.to_owned(),
        structure: "scene".to_owned(),
        preset: LOADER.1.to_owned(),
        ray_set: Some(file.id.to_owned()),
        hard: Some(HardRecord {
            id: file.id.to_owned(),
            title: file.title.to_owned(),
            measure: file.measure.to_owned(),
            target: wanted.to_owned(),
            triangles: 0,
            met: Some(file.loading.describes(&loaded)),
            reason,
            ..HardRecord::default()
        }),
        ..Run::default()
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn files_of_the_catalogue_are_refused_as_stated_and_another_demand_is_not_met() {
        let mut file = rasray_hard_cases::files().next().expect("a file");
        let hard = compare_file(&file).expect("a temporary file").hard.expect("a verdict");
        assert_eq!(hard.met, Some(true), "{hard:?}");
        file.loading = Loading::Read { triangles: 1, warning: None };
        let hard = compare_file(&file).expect("a temporary file").hard.expect("a verdict");
        assert_eq!(hard.met, Some(false), "{hard:?}");
    }
}
