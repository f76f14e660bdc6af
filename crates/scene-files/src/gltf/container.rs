//! GLB: a header and chunks around the JSON and the first buffer.

use std::path::Path;

use rasray_scene::SceneError;
use rasray_scene::remarks::Remarks;

const MAGIC: &[u8; 4] = b"glTF";
const HEADER: usize = 12;
const CHUNK_HEADER: usize = 8;
const JSON: u32 = u32::from_le_bytes(*b"JSON");
const BINARY: u32 = u32::from_le_bytes(*b"BIN\0");

/// Parts of a file. A `.gltf` has only JSON.
pub(super) struct Container<'a> {
    pub json: &'a [u8],
    pub binary: Option<&'a [u8]>,
}

/// Splits a file. Chunks of unknown type are skipped, as the format asks; chunks in the wrong place get a
/// remark.
pub(super) fn split<'a>(
    path: &Path,
    bytes: &'a [u8],
    remarks: &mut Remarks,
) -> Result<Container<'a>, SceneError> {
    if bytes.get(..4) != Some(MAGIC) {
        return Ok(Container { json: without_mark(bytes), binary: None });
    }
    let truncated =
        || SceneError::syntax(path, format!("the GLB container is truncated at byte {}", bytes.len()));
    let word = |at: usize| -> Option<u32> {
        bytes.get(at..at + 4).map(|word| u32::from_le_bytes([word[0], word[1], word[2], word[3]]))
    };
    let version = word(4).ok_or_else(truncated)?;
    if version != 2 {
        return Err(SceneError::NotThisFormat {
            path: path.to_owned(),
            found: format!("is GLB version {version}, and only version 2 is read"),
            fix: "export it as glTF 2.0",
        });
    }
    let length = word(8).ok_or_else(truncated)? as usize;
    if length > bytes.len() {
        return Err(truncated());
    }
    let misplaced = |remarks: &mut Remarks, text: String| remarks.note("glb-chunks", "GLB container", text);
    if length < bytes.len() {
        misplaced(remarks, format!("the {} bytes after its end were ignored", bytes.len() - length));
    }
    let mut json = None;
    let mut binary = None;
    let mut at = HEADER;
    let mut chunks = 0;
    while at + CHUNK_HEADER <= length {
        let size = word(at).ok_or_else(truncated)? as usize;
        let kind = word(at + 4).ok_or_else(truncated)?;
        let start = at + CHUNK_HEADER;
        let chunk = bytes.get(start..length).and_then(|rest| rest.get(..size)).ok_or_else(|| {
            SceneError::syntax(path, format!("the GLB chunk at byte {at} ends behind the file"))
        })?;
        match kind {
            JSON if json.is_none() => json = Some(chunk),
            BINARY if binary.is_none() => {
                binary = Some(chunk);
                if chunks != 1 {
                    misplaced(
                        remarks,
                        "its binary chunk is not the second; it was read all the same".to_owned(),
                    );
                }
            }
            JSON | BINARY => {
                misplaced(remarks, format!("a second chunk of its kind, at byte {at}, was ignored"))
            }
            _ => {}
        }
        if json.is_none() {
            break;
        }
        chunks += 1;
        // A chunk ends on a multiple of four; missing padding is tolerated.
        at = start + size;
    }
    let json = json.ok_or_else(|| {
        let reason = if at + CHUNK_HEADER > length {
            "has no whole chunk; is the file cut short?"
        } else {
            "does not begin with a chunk of JSON"
        };
        SceneError::syntax(path, format!("the GLB container {reason}"))
    })?;
    // Padding is meant to be spaces; some writers use zeros.
    let end = json.iter().rposition(|&byte| byte != 0).map_or(0, |last| last + 1);
    Ok(Container { json: without_mark(&json[..end]), binary })
}

/// Returns text without its byte order mark, which the format forbids and some writers add.
fn without_mark(text: &[u8]) -> &[u8] {
    text.strip_prefix(b"\xEF\xBB\xBF").unwrap_or(text)
}
