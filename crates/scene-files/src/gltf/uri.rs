//! References to bytes outside the JSON: `data:` URIs and files below the scene's folder.

use std::path::{Component, Path, PathBuf};

use rasray_scene::SceneError;

/// Target of a reference.
#[derive(Debug)]
pub(super) enum Reference {
    /// Bytes that are in the URI itself.
    Data(Vec<u8>),
    /// File, relative to the folder of the scene and not outside of it.
    File(PathBuf),
}

/// Largest number of characters of a reference that a message shows.
const SHOWN: usize = 80;

/// Resolves a reference. `place` is its place in the file, for messages. At most `limit` bytes are decoded.
pub(super) fn resolve(path: &Path, place: &str, uri: &str, limit: u64) -> Result<Reference, SceneError> {
    let refused = |reason: &'static str| SceneError::UnsafeReference {
        path: path.to_owned(),
        place: place.to_owned(),
        uri: uri.chars().take(SHOWN).collect(),
        reason,
    };
    if let Some(rest) = strip_scheme(uri, "data:") {
        crate::Limits::check(
            path,
            &format!("the length of the data: URI of {place}"),
            rest.len() as u64,
            limit.saturating_mul(2),
            "file_bytes",
        )?;
        let (head, payload) = rest.split_once(',').ok_or_else(|| refused("has no comma after data:"))?;
        let bytes = if head.to_ascii_lowercase().ends_with(";base64") {
            decode_base64(payload.as_bytes()).ok_or_else(|| refused("is not valid base64"))?
        } else {
            percent_decode(payload).ok_or_else(|| refused("has a malformed percent escape"))?
        };
        return Ok(Reference::Data(bytes));
    }
    let decoded = percent_decode(uri).ok_or_else(|| refused("has a malformed percent escape"))?;
    let relative = String::from_utf8(decoded).map_err(|_| refused("is not UTF-8"))?;
    if relative.is_empty() {
        return Err(refused("is empty"));
    }
    // A colon is a scheme, a drive letter or an alternate stream; a backslash is a separator on
    // some systems: neither is needed in a portable file.
    if relative.contains(':') {
        return Err(refused("has a scheme or drive letter"));
    }
    if relative.contains(['\\', '\0']) {
        return Err(refused("has a backslash or a NUL"));
    }
    let below = Path::new(&relative);
    let stays = below.components().all(|part| matches!(part, Component::Normal(_) | Component::CurDir));
    if !stays || relative.starts_with('/') {
        return Err(refused("is absolute or goes upwards"));
    }
    Ok(Reference::File(path.parent().unwrap_or(Path::new("")).join(below)))
}

/// True if a reference holds its bytes itself.
pub(super) fn is_data(uri: &str) -> bool {
    strip_scheme(uri, "data:").is_some()
}

/// Returns a reference with its percent escapes replaced, as far as possible.
pub(super) fn decoded(uri: &str) -> String {
    percent_decode(uri).map_or_else(|| uri.to_owned(), |bytes| String::from_utf8_lossy(&bytes).into_owned())
}

/// Returns `text` without its scheme, which may be in upper or lower case.
fn strip_scheme<'a>(text: &'a str, scheme: &str) -> Option<&'a str> {
    let (head, rest) = text.split_at_checked(scheme.len())?;
    head.eq_ignore_ascii_case(scheme).then_some(rest)
}

/// Replaces escapes such as `%41` by the bytes they stand for; `None` if an escape is cut short.
fn percent_decode(text: &str) -> Option<Vec<u8>> {
    let mut bytes = text.bytes();
    let mut decoded = Vec::with_capacity(text.len());
    while let Some(byte) = bytes.next() {
        if byte == b'%' {
            let high = char::from(bytes.next()?).to_digit(16)?;
            let low = char::from(bytes.next()?).to_digit(16)?;
            decoded.push((high * 16 + low) as u8);
        } else {
            decoded.push(byte);
        }
    }
    Some(decoded)
}

/// Decodes base64 with either alphabet; white space is skipped and padding optional. `None` on any other
/// character, or an impossible length.
fn decode_base64(text: &[u8]) -> Option<Vec<u8>> {
    let mut decoded = Vec::with_capacity(text.len() / 4 * 3 + 3);
    let (mut bits, mut count, mut padding) = (0_u32, 0_u32, 0_u32);
    for &byte in text {
        let digit = match byte {
            b'A'..=b'Z' => byte - b'A',
            b'a'..=b'z' => byte - b'a' + 26,
            b'0'..=b'9' => byte - b'0' + 52,
            b'+' | b'-' => 62,
            b'/' | b'_' => 63,
            b'=' => {
                padding += 1;
                continue;
            }
            b' ' | b'\t' | b'\r' | b'\n' => continue,
            _ => return None,
        };
        if padding > 0 {
            return None;
        }
        bits = (bits << 6 | u32::from(digit)) & 0xFF_FFFF;
        count += 1;
        if count.is_multiple_of(4) {
            decoded.extend_from_slice(&bits.to_be_bytes()[1..]);
        }
    }
    match count % 4 {
        0 => {}
        2 => decoded.push((bits >> 4) as u8),
        3 => decoded.extend_from_slice(&((bits >> 2) as u16).to_be_bytes()),
        _ => return None,
    }
    (padding <= 2).then_some(decoded)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn base64_of_every_length() {
        let cases: [(&str, &[u8]); 7] = [
            ("", b""),
            ("Zg==", b"f"),
            ("Zm8=", b"fo"),
            ("Zm9v", b"foo"),
            ("Zm9vYg", b"foob"),
            ("Zm9v YmE=\n", b"fooba"),
            ("_-8", &[0xFF, 0xEF]),
        ];
        for (text, bytes) in cases {
            assert_eq!(decode_base64(text.as_bytes()).as_deref(), Some(bytes), "{text:?}");
        }
        for text in ["Z", "Zm9vY", "Zg==Zg", "Z*==", "Zg==="] {
            assert_eq!(decode_base64(text.as_bytes()), None, "{text:?}");
        }
    }

    #[test]
    fn references_stay_below_the_folder() {
        let path = Path::new("folder/scene.gltf");
        let outside = [
            "../a.bin",
            "a/../../b.bin",
            "a/..",
            "%2e%2e/a.bin",
            "/etc/passwd",
            "%2Fetc/passwd",
            "file:///etc/passwd",
            "http://host/a.bin",
            "C:\\a.bin",
            "C:/a.bin",
            "..\\a.bin",
            "\\\\host\\a.bin",
            "a%00.bin",
            "",
            "%f",
            "%ff",
        ];
        for uri in outside {
            let result = resolve(path, "buffers[0]", uri, 1000);
            assert!(matches!(result, Err(SceneError::UnsafeReference { .. })), "{uri:?}: {result:?}");
        }
        for (uri, file) in
            [("a.bin", "folder/a.bin"), ("a/b%20c.bin", "folder/a/b c.bin"), ("./a.bin", "folder/a.bin")]
        {
            match resolve(path, "buffers[0]", uri, 1000) {
                Ok(Reference::File(found)) => assert_eq!(found, Path::new(file)),
                other => panic!("{uri:?}: {other:?}"),
            }
        }
        let data = resolve(path, "buffers[0]", "DATA:application/gltf-buffer;base64,Zm9v", 1000);
        assert!(matches!(data, Ok(Reference::Data(bytes)) if bytes == b"foo"));
        let huge = format!("data:;base64,{}", "A".repeat(3000));
        assert!(matches!(resolve(path, "buffers[0]", &huge, 1000), Err(SceneError::TooLarge { .. })));
    }
}
