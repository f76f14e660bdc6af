//! References to other files, which must stay below the folder of the file that makes them.

use std::path::{Path, PathBuf};

use crate::SceneError;

/// The path of `name` below `folder`; backslashes separate folders too.
///
/// # Errors
/// [`SceneError::UnsafeReference`] if the name is absolute (with a root, a drive or a scheme) or has
/// `..` as a part. `path` and `place` tell where it stands.
pub(super) fn resolve(path: &Path, place: &str, folder: &Path, name: &str) -> Result<PathBuf, SceneError> {
    let refuse = |reason| SceneError::UnsafeReference {
        path: path.to_owned(),
        place: place.to_owned(),
        uri: name.chars().take(80).collect(),
        reason,
    };
    let forward = name.replace('\\', "/");
    let has_drive = forward.as_bytes().get(1) == Some(&b':');
    if forward.starts_with('/') || has_drive || forward.contains("://") {
        return Err(refuse("is absolute"));
    }
    if forward.contains('\0') {
        return Err(refuse("holds a zero byte"));
    }
    let mut resolved = folder.to_owned();
    for part in forward.split('/') {
        match part {
            "" | "." => {}
            ".." => return Err(refuse("leaves the folder by `..`")),
            part => resolved.push(part),
        }
    }
    Ok(resolved)
}
