//! `EXT_meshopt_compression` and `KHR_meshopt_compression`: buffer views whose bytes are stored compressed.
//!
//! The library meshoptimizer decodes the streams. It refuses malformed ones; sizes, strides and words, which
//! it does not check, are checked here before.

use ::gltf::json::Value;
use meshopt::ffi;

use super::document::Document;
use rasray_scene::SceneError;

/// Names of the extensions, which differ in what their exporters write: the decoder reads the streams of
/// either.
pub(super) const EXTENSIONS: [&str; 2] = ["KHR_meshopt_compression", "EXT_meshopt_compression"];

/// Largest number of bytes that one byte of a stream can stand for: 256 elements of four bytes, none of which
/// changes.
const MOST_BYTES: u64 = 1024;

/// Compression of a buffer view.
struct Compressed {
    /// Place for messages, such as `bufferViews[3].extensions.EXT_meshopt_compression`.
    place: String,
    buffer: usize,
    offset: u64,
    length: u64,
    /// Number of elements, and bytes of each.
    count: u64,
    stride: usize,
    mode: Mode,
    filter: Filter,
}

/// Kind of data that a stream encodes.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Mode {
    Attributes,
    Triangles,
    Indices,
}

/// Filter undone on decoded elements.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Filter {
    None,
    Octahedral,
    Quaternion,
    Exponential,
    Color,
}

/// Bytes of a view; elements begin at multiples of four.
pub(super) struct Decoded(Vec<u32>);

impl Decoded {
    /// Returns as many bytes as the view has.
    pub fn bytes(&self, length: usize) -> &[u8] {
        &bytemuck::cast_slice(&self.0)[..length]
    }
}

/// Decodes a buffer view; `None` if it is not compressed.
pub(super) fn decode(document: &Document<'_>, view: usize) -> Result<Option<Decoded>, SceneError> {
    let Some(compressed) = Compressed::of(document, view)? else { return Ok(None) };
    let claim = document.root.buffer_views[view].byte_length.0;
    compressed.check(claim).map_err(|reason| document.invalid(&compressed.place, reason))?;
    let bytes = compressed.stream(document)?;
    if claim > MOST_BYTES * bytes.len() as u64 {
        return Err(compressed.damaged(document));
    }
    document.spend_bytes(claim)?;
    let words = claim.div_ceil(4) as usize;
    let mut decoded = Vec::new();
    decoded.try_reserve_exact(words).map_err(|_| {
        let what = format!("the size of {} in bytes", compressed.place);
        SceneError::too_large(document.path, what, claim, document.limits.file_bytes, "file_bytes")
    })?;
    decoded.resize(words, 0);
    if !compressed.decode_into(bytes, &mut decoded) {
        return Err(compressed.damaged(document));
    }
    Ok(Some(Decoded(decoded)))
}

impl Compressed {
    /// Reads the compression of a view in the form that the schema asks for; `None` if the view has none.
    fn of(document: &Document<'_>, view: usize) -> Result<Option<Self>, SceneError> {
        let extensions = document.root.buffer_views[view].extensions.as_ref();
        let found = EXTENSIONS.iter().find_map(|&name| Some((name, extensions?.others.get(name)?)));
        let Some((name, found)) = found else { return Ok(None) };
        let place = format!("bufferViews[{view}].extensions.{name}");
        let number = |member: &str| found.get(member).and_then(Value::as_u64).unwrap_or_default();
        let word = |member: &str| found.get(member).and_then(Value::as_str).unwrap_or("NONE");
        let unknown = |member: &str| {
            let place = format!("{place}.{member}");
            let reason = document.unknown(&place);
            document.invalid(place, reason)
        };
        let mode = match word("mode") {
            "ATTRIBUTES" => Mode::Attributes,
            "TRIANGLES" => Mode::Triangles,
            "INDICES" => Mode::Indices,
            _ => return Err(unknown("mode")),
        };
        let filter = match word("filter") {
            "NONE" => Filter::None,
            "OCTAHEDRAL" => Filter::Octahedral,
            "QUATERNION" => Filter::Quaternion,
            "EXPONENTIAL" => Filter::Exponential,
            "COLOR" => Filter::Color,
            _ => return Err(unknown("filter")),
        };
        Ok(Some(Self {
            buffer: number("buffer") as usize,
            offset: number("byteOffset"),
            length: number("byteLength"),
            count: number("count"),
            stride: number("byteStride") as usize,
            mode,
            filter,
            place,
        }))
    }

    /// Checks the requirements of the extensions on a view of `claim` bytes.
    fn check(&self, claim: u64) -> Result<(), String> {
        let Self { count, stride, mode, filter, .. } = *self;
        let strides: &[usize] = match (mode, filter) {
            (Mode::Attributes, Filter::None | Filter::Exponential) => {
                if stride == 0 || stride > 256 || !stride.is_multiple_of(4) {
                    return Err(format!("has a byteStride of {stride}, not a multiple of 4 from 4 to 256"));
                }
                &[stride]
            }
            (Mode::Attributes, Filter::Octahedral | Filter::Color) => &[4, 8],
            (Mode::Attributes, Filter::Quaternion) => &[8],
            (Mode::Triangles | Mode::Indices, Filter::None) => &[2, 4],
            (Mode::Triangles | Mode::Indices, _) => {
                return Err("has a filter, which only streams of mode ATTRIBUTES have".to_owned());
            }
        };
        if !strides.contains(&stride) {
            let known: Vec<String> = strides.iter().map(usize::to_string).collect();
            return Err(format!("has a byteStride of {stride}, not of {}", known.join(" or ")));
        }
        if mode == Mode::Triangles && !count.is_multiple_of(3) {
            return Err(format!("has {count} indices, which do not make whole triangles"));
        }
        if u128::from(count) * stride as u128 != u128::from(claim) {
            return Err(format!("has {count} elements of {stride} bytes, but its view has {claim} bytes"));
        }
        Ok(())
    }

    /// Returns the bytes of the stream.
    fn stream<'a>(&self, document: &'a Document<'_>) -> Result<&'a [u8], SceneError> {
        let Self { buffer, offset, length, .. } = *self;
        let buffers = document.root.buffers.len();
        if buffer >= buffers {
            let reason = format!("refers to element {buffer}, but there are only {buffers}");
            return Err(document.invalid(format!("{}.buffer", self.place), reason));
        }
        let bytes = document.buffer(buffer)?;
        let end = offset.saturating_add(length);
        if end > bytes.len() as u64 {
            let reason = format!(
                "is stored in bytes {offset} to {end} of buffers[{buffer}], which has only {}",
                bytes.len()
            );
            return Err(document.invalid(&self.place, reason));
        }
        // Both are at most the length of a slice.
        Ok(&bytes[offset as usize..end as usize])
    }

    /// Decodes a stream into as many bytes as [`Compressed::check`] accepted; false if the stream is
    /// malformed.
    fn decode_into(&self, stream: &[u8], decoded: &mut [u32]) -> bool {
        // The product of both is a length that was allocated, as `check` found.
        let (count, stride) = (self.count as usize, self.stride);
        assert!(count * stride <= size_of_val(decoded));
        let (to, from, size) = (decoded.as_mut_ptr().cast(), stream.as_ptr(), stream.len());
        // SAFETY: `to` has room for `count` elements of `stride` bytes and is aligned for the widest numbers
        // that are written, which have 32 bits; `from` has `size` bytes. Strides and counts are among those
        // that the functions allow for their mode and filter (`check` tests this), and the decoders promise
        // to stay inside both ranges for any bytes.
        unsafe {
            let status = match self.mode {
                Mode::Attributes => ffi::meshopt_decodeVertexBuffer(to, count, stride, from, size),
                Mode::Triangles => ffi::meshopt_decodeIndexBuffer(to, count, stride, from, size),
                Mode::Indices => ffi::meshopt_decodeIndexSequence(to, count, stride, from, size),
            };
            match self.filter {
                _ if status != 0 => {}
                Filter::None => {}
                Filter::Octahedral => ffi::meshopt_decodeFilterOct(to, count, stride),
                Filter::Quaternion => ffi::meshopt_decodeFilterQuat(to, count, stride),
                Filter::Exponential => ffi::meshopt_decodeFilterExp(to, count, stride),
                Filter::Color => ffi::meshopt_decodeFilterColor(to, count, stride),
            }
            status == 0
        }
    }

    fn damaged(&self, document: &Document<'_>) -> SceneError {
        let Self { buffer, offset, length, count, stride, .. } = self;
        let end = offset.saturating_add(*length);
        let mode = format!("{:?}", self.mode).to_uppercase();
        let reason = format!(
            "bytes {offset} to {end} of buffers[{buffer}] are no {mode} of {count} elements of {stride} bytes; \
             the file is damaged: export it again"
        );
        document.invalid(&self.place, reason)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn decoded(stream: &[u8], mode: Mode, stride: usize, count: usize) -> Option<Vec<u8>> {
        let compressed = Compressed {
            place: String::new(),
            buffer: 0,
            offset: 0,
            length: stream.len() as u64,
            count: count as u64,
            stride,
            mode,
            filter: Filter::None,
        };
        let bytes = count * stride;
        compressed.check(bytes as u64).expect("a view that is right");
        let mut words = vec![0; bytes.div_ceil(4)];
        compressed.decode_into(stream, &mut words).then(|| Decoded(words).bytes(bytes).to_vec())
    }

    /// The test covers every mode with its smallest and widest elements, as the encoders of meshoptimizer
    /// write them.
    #[test]
    fn streams_of_every_mode_come_back() {
        let indices: Vec<u32> = (0..600).map(|i| i % 301 + i / 3).collect();
        let wide: Vec<u8> = indices.iter().flat_map(|index| index.to_le_bytes()).collect();
        let narrow: Vec<u8> = indices.iter().flat_map(|&index| (index as u16).to_le_bytes()).collect();
        let sequence = meshopt::encode_index_sequence(&indices, 1000).expect("encoded");
        assert_eq!(decoded(&sequence, Mode::Indices, 4, 600), Some(wide.clone()));
        assert_eq!(decoded(&sequence, Mode::Indices, 2, 600), Some(narrow));
        let elements: &[[u8; 256]] = bytemuck::cast_slice(&wide[..2304]);
        let attributes = meshopt::encode_vertex_buffer(elements).expect("encoded");
        assert_eq!(decoded(&attributes, Mode::Attributes, 256, 9), Some(wide[..2304].to_vec()));
        let elements: &[[u8; 4]] = bytemuck::cast_slice(&wide);
        let attributes = meshopt::encode_vertex_buffer(elements).expect("encoded");
        assert_eq!(decoded(&attributes, Mode::Attributes, 4, 600), Some(wide));
        // Decoded triangles may begin at any of their corners.
        let triangles = meshopt::encode_index_buffer(&indices, 1000).expect("encoded");
        let found = decoded(&triangles, Mode::Triangles, 4, 600).expect("decoded");
        let found: Vec<u32> =
            found.chunks_exact(4).map(|x| u32::from_le_bytes([x[0], x[1], x[2], x[3]])).collect();
        for (before, after) in indices.chunks_exact(3).zip(found.chunks_exact(3)) {
            let turned = (0..3).any(|turn| (0..3).all(|k| before[k] == after[(k + turn) % 3]));
            assert!(turned, "{before:?} became {after:?}");
        }
        // Streams of another mode, or of another number of elements, are not decoded.
        assert_eq!(decoded(&triangles, Mode::Indices, 4, 600), None);
        assert_eq!(decoded(&sequence, Mode::Attributes, 4, 600), None);
        assert_eq!(decoded(&attributes, Mode::Attributes, 4, 700), None);
    }

    /// The longest output of a stream is the memory that is reserved for it.
    #[test]
    fn no_stream_stands_for_more_than_is_allowed() {
        for elements in [1 << 12, 1 << 16] {
            let still = vec![[0_u8; 4]; elements];
            let stream = meshopt::encode_vertex_buffer_level(&still, 3, Some(1)).expect("encoded");
            assert!(4 * elements as u64 <= MOST_BYTES * stream.len() as u64, "{}", stream.len());
        }
    }
}
