//! Bytes of buffer views; buffers are read when they are first needed.

use std::borrow::Cow;

use super::document::Document;
use super::uri::{Reference, resolve};
use crate::files::read_needed;
use crate::recognise::recognise;
use rasray_scene::SceneError;

impl<'a> Document<'a> {
    /// Returns the bytes of a buffer, at most as many as it claims: from the binary chunk (for a first buffer
    /// without a reference), a `data:` URI or a file.
    pub(super) fn buffer(&self, index: usize) -> Result<&[u8], SceneError> {
        let claim = self.root.buffers[index].byte_length.0;
        let cell = &self.buffers.read[index];
        let bytes = match cell.get() {
            Some(bytes) => bytes,
            None => {
                let bytes = self.read_buffer(index)?;
                if (bytes.len() as u64) < claim {
                    let text = format!("claims {claim} bytes, but there are only {}", bytes.len());
                    self.note("short-buffer", format!("buffers[{index}]"), text);
                }
                cell.get_or_init(|| bytes)
            }
        };
        let end = usize::try_from(claim).map_or(bytes.len(), |claim| claim.min(bytes.len()));
        Ok(&bytes[..end])
    }

    fn read_buffer(&self, index: usize) -> Result<Cow<'a, [u8]>, SceneError> {
        let Self { path, limits, root, buffers, .. } = self;
        let place = format!("buffers[{index}]");
        let buffer = &root.buffers[index];
        let bytes = match (&buffer.uri, buffers.binary) {
            (Some(uri), _) => match resolve(path, &place, uri, limits.file_bytes)? {
                Reference::Data(bytes) => bytes,
                Reference::File(file) => {
                    let bytes = read_needed(path, &place, &file, limits.file_bytes)?;
                    self.remarks.borrow_mut().files.push(file.clone());
                    if (bytes.len() as u64) < buffer.byte_length.0
                        && let Some(foreign) = recognise(&bytes)
                    {
                        return Err(SceneError::NotThisFormat {
                            path: path.to_path_buf(),
                            found: format!("{place} needs {}, which is {}", file.display(), foreign.what),
                            fix: foreign.fix,
                        });
                    }
                    bytes
                }
            },
            (None, Some(binary)) if index == 0 => return Ok(binary.into()),
            (None, _) if buffer.byte_length.0 == 0 => return Ok(Cow::default()),
            (None, _) => return Err(self.invalid(place, "has neither a reference nor a binary chunk")),
        };
        self.spend_bytes(bytes.len() as u64)?;
        Ok(bytes.into())
    }

    /// Returns the bytes of a buffer view, as far as its buffer has them; a compressed view is decoded.
    pub fn view(&self, view: usize) -> Result<&[u8], SceneError> {
        let claim = &self.root.buffer_views[view];
        #[cfg(feature = "meshopt")]
        if let Some(decoded) = self.decoded(view)? {
            return Ok(decoded);
        }
        let buffer = claim.buffer.value();
        let bytes = self.buffer(buffer)?;
        let start = claim.byte_offset.unwrap_or_default().0;
        let end = start.saturating_add(claim.byte_length.0);
        let available = bytes.len() as u64;
        if end > available {
            let text =
                format!("is to have bytes {start} to {end}, but buffers[{buffer}] has only {available}");
            self.note("short-buffer-view", format!("bufferViews[{view}]"), text);
        }
        // Both ends are at most the length of a slice.
        Ok(&bytes[start.min(available) as usize..end.min(available) as usize])
    }

    /// Returns the bytes of a compressed view, decoded when they are first needed; `None` if the view is not
    /// compressed.
    #[cfg(feature = "meshopt")]
    fn decoded(&self, view: usize) -> Result<Option<&[u8]>, SceneError> {
        let cell = &self.buffers.decoded[view];
        let decoded = match cell.get() {
            Some(decoded) => decoded,
            None => {
                let decoded = super::compression::decode(self, view)?;
                cell.get_or_init(|| decoded)
            }
        };
        let length = self.root.buffer_views[view].byte_length.0;
        Ok(decoded.as_ref().map(|decoded| decoded.bytes(length as usize)))
    }
}
