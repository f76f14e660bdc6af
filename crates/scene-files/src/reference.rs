//! References to other files by plain names, which must stay below the folder of the referring file.

use std::path::{Path, PathBuf};

use rasray_scene::remarks::Remarks;

/// Target of a reference.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum Place {
    /// A file below the folder; it may be missing.
    Below(PathBuf),
    /// Target outside the folder, or no target. Such a file is never read.
    Outside {
        /// Fault, such as `is absolute`.
        reason: &'static str,
        /// File in the folder with the name at the end of the reference; it may be missing.
        beside: Option<PathBuf>,
    },
}

/// Returns the target of `name` from `folder`; backslashes separate folders too. The target is outside if the
/// name is absolute (with a root, a drive or a scheme), has `..` as a part, or holds a zero byte.
pub(crate) fn place(folder: &Path, name: &str) -> Place {
    let forward = name.replace('\\', "/");
    let has_drive = forward.as_bytes().get(1) == Some(&b':');
    if forward.starts_with('/') || has_drive || forward.contains("://") {
        return outside(folder, name, "is absolute");
    }
    if forward.contains('\0') {
        return outside(folder, name, "holds a zero byte");
    }
    let mut resolved = folder.to_owned();
    for part in forward.split('/') {
        match part {
            "" | "." => {}
            ".." => return outside(folder, name, "leaves the folder by `..`"),
            part => resolved.push(part),
        }
    }
    Place::Below(resolved)
}

/// Makes the target of a reference that is not followed for this reason.
pub(crate) fn outside(folder: &Path, name: &str, reason: &'static str) -> Place {
    let last = name.rsplit(['/', '\\', ':']).next().unwrap_or_default();
    let is_name = !matches!(last, "" | "." | "..") && !last.contains('\0');
    Place::Outside { reason, beside: is_name.then(|| folder.join(last)) }
}

/// Returns the file of the texture that a scene calls `name`. If the reference leads outside, a file of its
/// name is looked for beside the referring file, since textures often travel with their scenes while paths
/// stay behind. `None` if there is none; in both cases a remark is noted.
pub(crate) fn texture(place: &Place, name: &str, remarks: &mut Remarks) -> Option<PathBuf> {
    let (reason, beside) = match place {
        Place::Below(file) => return Some(file.clone()),
        Place::Outside { reason, beside } => (reason, beside),
    };
    let shown = format!("texture {name}");
    match beside.as_ref().filter(|file| file.is_file()) {
        Some(file) => {
            let text = format!("the reference {reason}; {} is shown instead", file.display());
            remarks.note("texture-elsewhere", shown, text);
            Some(file.clone())
        }
        None => {
            let text = format!(
                "is not shown: the reference {reason}; put the file beside the scene, only files below its folder are read"
            );
            remarks.note("missing-texture", shown, text);
            None
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn references_stay_below_the_folder() {
        let folder = Path::new("folder");
        for (name, below) in
            [("a.png", "folder/a.png"), ("a\\b.png", "folder/a/b.png"), ("./a//b.png", "folder/a/b.png")]
        {
            assert_eq!(place(folder, name), Place::Below(PathBuf::from(below)), "{name}");
        }
        for (name, last) in [
            ("/a/b.png", Some("b.png")),
            ("C:\\a\\b.png", Some("b.png")),
            ("C:b.png", Some("b.png")),
            ("c:/a/b c.png", Some("b c.png")),
            ("\\\\host\\share\\b.png", Some("b.png")),
            ("file:///a/b.png", Some("b.png")),
            ("../b.png", Some("b.png")),
            ("a/../../b.png", Some("b.png")),
            ("a\\..", None),
            ("..", None),
            ("/", None),
            ("C:", None),
            ("/a\0b", None),
        ] {
            match place(folder, name) {
                Place::Outside { beside, .. } => {
                    assert_eq!(beside, last.map(|last| folder.join(last)), "{name:?}");
                }
                Place::Below(file) => panic!("{name:?} leads to {}", file.display()),
            }
        }
    }
}
