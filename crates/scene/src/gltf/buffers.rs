//! The bytes behind buffers.

use std::borrow::Cow;
use std::path::Path;

use ::gltf::json::Root;

use super::uri::{Reference, resolve};
use crate::load::read_file;
use crate::{Limits, SceneError};

/// Reads all buffers: the binary chunk (a first buffer without a reference), `data:` URIs and files.
pub(super) fn read<'a>(
    path: &Path,
    limits: &Limits,
    root: &Root,
    binary: Option<&'a [u8]>,
) -> Result<Vec<Cow<'a, [u8]>>, SceneError> {
    let mut left = limits.file_bytes;
    let mut buffers = Vec::with_capacity(root.buffers.len());
    for (i, buffer) in root.buffers.iter().enumerate() {
        let place = format!("buffers[{i}]");
        let bytes: Cow<'a, [u8]> = match &buffer.uri {
            Some(uri) => match resolve(path, &place, uri, limits.file_bytes)? {
                Reference::Data(bytes) => bytes.into(),
                Reference::File(file) => read_file(&file, limits.file_bytes)?.into(),
            },
            None if i == 0 && (binary.is_some() || buffer.byte_length.0 == 0) => {
                binary.unwrap_or_default().into()
            }
            None => {
                return Err(SceneError::invalid(path, place, "has neither a reference nor a binary chunk"));
            }
        };
        if (bytes.len() as u64) < buffer.byte_length.0 {
            let reason = format!("claims {} bytes, but there are only {}", buffer.byte_length.0, bytes.len());
            return Err(SceneError::invalid(path, place, reason));
        }
        if matches!(bytes, Cow::Owned(_)) {
            let size = bytes.len() as u64;
            left = left.checked_sub(size).ok_or_else(|| {
                let read = limits.file_bytes - left + size;
                SceneError::too_large(
                    path,
                    "the size of all buffers in bytes",
                    read,
                    limits.file_bytes,
                    "file_bytes",
                )
            })?;
        }
        buffers.push(bytes);
    }
    Ok(buffers)
}

/// Bytes of a buffer view, which must lie within what its buffer claims.
pub(super) fn view_bytes<'b>(
    path: &Path,
    root: &Root,
    buffers: &'b [Cow<'_, [u8]>],
    view: usize,
) -> Result<&'b [u8], SceneError> {
    let claim = &root.buffer_views[view];
    let buffer = claim.buffer.value();
    let start = u128::from(claim.byte_offset.unwrap_or_default().0);
    let end = start + u128::from(claim.byte_length.0);
    let available = root.buffers[buffer].byte_length.0;
    if end > u128::from(available) {
        let reason = format!("bytes {start} to {end}, but buffers[{buffer}] has only {available}");
        return Err(SceneError::invalid(path, format!("bufferViews[{view}]"), reason));
    }
    // Both ends fit: the buffer holds at least `available` bytes.
    Ok(&buffers[buffer][start as usize..end as usize])
}
