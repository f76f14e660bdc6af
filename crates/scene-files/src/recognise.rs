//! Recognition of files whose content differs from their name, by their first bytes.

use std::path::Path;

use rasray_scene::SceneError;

/// Kind of file other than the expected one.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Foreign {
    /// Name of the kind, with its article.
    pub what: &'static str,
    pub fix: &'static str,
}

impl Foreign {
    /// Makes the error of a scene file that should have the format `format`.
    pub fn refuse(self, path: &Path, format: &str) -> SceneError {
        SceneError::NotThisFormat {
            path: path.to_owned(),
            found: format!("is {}, not {format}", self.what),
            fix: self.fix,
        }
    }
}

const DOWNLOAD: &str = "download the file itself, not a page about it";
const FETCH: &str = "fetch the file it stands for with `git lfs pull`";
const ANNEX: &str = "fetch the file it stands for with `git annex get`";
const UNPACK: &str = "unpack it first";
pub(crate) const RENAME: &str = "give the file the extension of its format";
const CONVERT: &str = "convert it to glTF, OBJ or PLY";
const AGAIN: &str = "export or download the file again";

/// First bytes of files, in lower case where they are text.
const BEGINNINGS: [(&[u8], &str, &str); 23] = [
    (b"<!doctype html", "an HTML page", DOWNLOAD),
    (b"<html", "an HTML page", DOWNLOAD),
    (b"<head", "an HTML page", DOWNLOAD),
    (b"<?xml", "an XML document", CONVERT),
    (b"<collada", "a COLLADA document", CONVERT),
    (b"version https://git-lfs", "a Git LFS pointer", FETCH),
    (b"/annex/objects/", "a git-annex pointer", ANNEX),
    (b"gltf", "a GLB file", RENAME),
    (b"ply\n", "a PLY file", RENAME),
    (b"ply\r", "a PLY file", RENAME),
    (b"kaydara fbx", "an FBX file", CONVERT),
    (b"blender", "a Blender file", CONVERT),
    (b"#usda", "a USD file", CONVERT),
    (b"pxr-usdc", "a USD file", CONVERT),
    (b"solid ", "an STL file", CONVERT),
    (b"pk\x03\x04", "a ZIP archive", UNPACK),
    (b"\x1f\x8b", "a gzip archive", UNPACK),
    (b"7z\xbc\xaf", "a 7-Zip archive", UNPACK),
    (b"\x28\xb5\x2f\xfd", "a Zstandard archive", UNPACK),
    (b"\xfd7zxz", "an XZ archive", UNPACK),
    (b"\x89png", "a PNG image", AGAIN),
    (b"\xff\xd8\xff", "a JPEG image", AGAIN),
    (b"%pdf", "a PDF document", AGAIN),
];

/// Recognises the kind of `bytes`, if possible; formats of scenes and images are included.
pub(crate) fn recognise(bytes: &[u8]) -> Option<Foreign> {
    if bytes.is_empty() {
        return Some(Foreign { what: "empty", fix: AGAIN });
    }
    let bytes = bytes.strip_prefix(b"\xEF\xBB\xBF").unwrap_or(bytes).trim_ascii_start();
    let begins = |beginning: &[u8]| {
        bytes.get(..beginning.len()).is_some_and(|head| head.eq_ignore_ascii_case(beginning))
    };
    let found = BEGINNINGS.iter().find(|(beginning, ..)| begins(beginning));
    found.map(|&(_, what, fix)| Foreign { what, fix })
}

/// Kind of bytes that are not text.
pub(crate) const BINARY: Foreign = Foreign { what: "binary data", fix: AGAIN };

/// Returns [`BINARY`] for bytes that should be text but are not: text has no zero bytes.
pub(crate) fn binary(bytes: &[u8]) -> Option<Foreign> {
    let head = &bytes[..bytes.len().min(4096)];
    head.contains(&0).then_some(BINARY)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_downloaded_by_mistake_is_known() {
        let table: [(&[u8], &str); 8] = [
            (b"", "empty"),
            (b"\n<!DOCTYPE html><html>", "an HTML page"),
            (b"\xEF\xBB\xBF<HTML lang=en>", "an HTML page"),
            (b"version https://git-lfs.github.com/spec/v1\noid sha256:00", "a Git LFS pointer"),
            (b"/annex/objects/SHA256E-s1--00.glb\n", "a git-annex pointer"),
            (b"glTF\x02\0\0\0", "a GLB file"),
            (b"PK\x03\x04\x14", "a ZIP archive"),
            (b"\x89PNG\r\n", "a PNG image"),
        ];
        for (bytes, what) in table {
            assert_eq!(recognise(bytes).map(|found| found.what), Some(what));
        }
        for bytes in [&b"v 0 0 0\n"[..], b"{\"asset\":{}}", b"# ply\n", b"plywood", b"g", b" "] {
            assert_eq!(recognise(bytes), None, "{bytes:?}");
        }
    }

    #[test]
    fn zero_bytes_are_no_text() {
        assert!(binary(b"v 0 0 0\n\0").is_some());
        assert!(binary("v 0 0 0 # \u{fc}\n\u{7f}".as_bytes()).is_none() && binary(b"").is_none());
    }
}
