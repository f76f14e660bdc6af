//! Description of triangles in the buffers of an embedder, and its checks.

use rasray_gpu::{Buffer, BufferRange, Device};

use crate::{AdsError, Draw};

/// Bytes of one position.
const POSITION_BYTES: u64 = size_of::<[f32; 3]>() as u64;

/// Positions in a buffer, read in place: three f32 each, with any other vertex data between them.
#[derive(Clone, Debug)]
pub struct PositionRange {
    /// Buffer that holds the positions.
    pub buffer: Buffer,
    /// Byte of the first position, a multiple of 4.
    pub offset: u64,
    /// Bytes from one position to the next: a multiple of 4, at least 12.
    pub stride: u32,
}

/// Describes positions without padding from the start of a buffer.
impl From<Buffer> for PositionRange {
    fn from(buffer: Buffer) -> Self {
        Self { buffer, offset: 0, stride: POSITION_BYTES as u32 }
    }
}

/// Indices in a buffer. Absolute 32-bit indices are read in place; each build gathers all others.
#[derive(Clone, Debug)]
pub struct IndexRange {
    /// Buffer that holds the indices.
    pub buffer: Buffer,
    /// Byte of the first index, a multiple of the format's bytes.
    pub offset: u64,
    /// Format of the indices.
    pub format: IndexFormat,
    /// Meaning of the indices.
    pub indexing: Indexing,
}

/// Describes absolute u32 indices from the start of a buffer.
impl From<Buffer> for IndexRange {
    fn from(buffer: Buffer) -> Self {
        Self { buffer, offset: 0, format: IndexFormat::U32, indexing: Indexing::Absolute }
    }
}

impl IndexRange {
    /// Returns true if builds gather these indices, so that shaders read the copy.
    pub(crate) fn is_gathered(&self) -> bool {
        self.format != IndexFormat::U32 || self.indexing != Indexing::Absolute
    }
}

/// Format of an index. No value restarts a strip: triangles are three indices each.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum IndexFormat {
    /// 16-bit indices. Shaders read whole words, so the buffer must extend to the next multiple of 4 after
    /// the last index.
    U16,
    /// 32-bit indices.
    U32,
}

impl IndexFormat {
    /// Returns the bytes of one index.
    pub fn bytes(self) -> u32 {
        match self {
            Self::U16 => 2,
            Self::U32 => 4,
        }
    }
}

/// Rule that assigns indices to triangles and vertices to indices.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Indexing {
    /// Triangle i has the three indices from 3 i on, and an index is the number of a vertex.
    Absolute,
    /// The triangles of a draw have the indices from [`Draw::first_index`] on, and [`Draw::base_vertex`] is
    /// added to each index.
    PerDraw {
        /// Number of indices in the range.
        index_count: u32,
    },
}

/// A buffer and an offset into it.
#[derive(Clone, Debug)]
pub struct BufferOffset {
    /// The buffer.
    pub buffer: Buffer,
    /// Offset in bytes.
    pub offset: u64,
}

/// Describes the start of a buffer.
impl From<Buffer> for BufferOffset {
    fn from(buffer: Buffer) -> Self {
        Self { buffer, offset: 0 }
    }
}

/// Buffers and counts to make a [`crate::Geometry`] from. An embedder fills it from the buffers that its
/// engine has.
#[derive(Clone, Debug)]
pub struct GeometryDesc {
    /// Posed positions, metres relative to `frame_origin`.
    pub positions: PositionRange,
    /// Vertex indices, three per triangle; each is below `vertex_count`.
    pub indices: IndexRange,
    /// [`crate::Draw`] records in order of their triangles. The offset is a multiple of
    /// [`rasray_gpu::Limits::min_storage_buffer_offset_alignment`].
    pub draws: BufferOffset,
    /// Number of vertices in `positions`.
    pub vertex_count: u32,
    /// Number of triangles; with `count`, their maximum, which determines the sizes of pools and dispatches.
    pub triangle_count: u32,
    /// A u32 from which the device reads the number of triangles in each build, at an offset that is a
    /// multiple of 4, for geometry that is culled or made on the device. Triangles with that index or a
    /// higher one do not exist. A number larger than `triangle_count` is an error of the build.
    pub count: Option<BufferOffset>,
    /// Number of records in `draws`. With `count`, unused records state a first triangle that does not exist.
    pub draw_count: u32,
    /// Lower and upper corner of all posed positions, metres; any finite value if there are no positions.
    /// They are written to the geometry's header on the device, where a pass of the host or
    /// [`BoundsPass`](crate::BoundsPass) may write others before a build. Structures are planned with the
    /// stated bounds, and built with the bounds in the header. A build that finds a corner outside of the
    /// bounds in the header is not complete, and counts the triangles with such a corner.
    pub bounds: [[f32; 3]; 2],
    /// Origin of positions, metres, world space.
    pub frame_origin: [f64; 3],
}

/// Bytes of one input of the geometry.
struct Span<'a> {
    /// Name of the input, for errors.
    what: String,
    buffer: &'a Buffer,
    offset: u64,
    bytes: u64,
    /// Alignment of the offset, in bytes.
    alignment: u64,
}

impl<'a> Span<'a> {
    /// Returns the range to bind, and the number of bytes in it that precede this input, if bindings begin at
    /// multiples of `alignment`.
    fn binding(&self, alignment: u64) -> (BufferRange<'a>, u64) {
        let Self { buffer, offset, bytes, .. } = *self;
        if bytes == 0 {
            // A binding must not be empty.
            return (BufferRange { buffer, offset: 0, size: buffer.size().min(16) }, 0);
        }
        let before = offset % alignment;
        (BufferRange { buffer, offset: offset - before, size: before + bytes }, before)
    }
}

impl GeometryDesc {
    /// Checks the description against the buffers, as far as the host can.
    pub(crate) fn check(&self, device: &Device) -> Result<(), AdsError> {
        let wrong = |reason: String| Err(AdsError::Geometry { reason });
        let stride = self.positions.stride;
        if u64::from(stride) < POSITION_BYTES || !stride.is_multiple_of(4) {
            return wrong(format!(
                "positions have a stride of {stride} bytes, which must be a multiple of 4 and at least {POSITION_BYTES}"
            ));
        }
        for Span { what, buffer, offset, bytes, alignment } in self.spans(device) {
            let (name, size) = (buffer.name(), buffer.size());
            if !offset.is_multiple_of(alignment) {
                return wrong(format!(
                    "{what} begin at byte {offset} of buffer `{name}`, which must be a multiple of {alignment}"
                ));
            }
            if offset.checked_add(bytes).is_none_or(|end| end > size) {
                return wrong(format!(
                    "{what} are {bytes} bytes from byte {offset}, but buffer `{name}` has {size}"
                ));
            }
        }
        let [lower, upper] = self.bounds;
        let ordered =
            lower.iter().zip(&upper).all(|(low, high)| low.is_finite() && high.is_finite() && low <= high);
        if !ordered {
            return wrong(format!(
                "bounds from {lower:?} to {upper:?} must be finite, the lower corner first"
            ));
        }
        Ok(())
    }

    /// Returns the ranges that are read of the buffers. No byte is in two ranges: ranges that overlap or
    /// touch are joined.
    pub(crate) fn ranges(&self, device: &Device) -> Vec<BufferRange<'_>> {
        let mut spans = self.spans(device);
        spans.retain(|span| span.bytes > 0);
        spans.sort_by_key(|span| (span.buffer.raw(), span.offset));
        let mut joined: Vec<BufferRange<'_>> = Vec::new();
        for Span { buffer, offset, bytes, .. } in spans {
            match joined.last_mut() {
                Some(last) if last.buffer.raw() == buffer.raw() && offset <= last.offset + last.size => {
                    last.size = last.size.max(offset + bytes - last.offset);
                }
                _ => joined.push(BufferRange { buffer, offset, size: bytes }),
            }
        }
        joined
    }

    /// Returns the bytes of positions, indices, draws and count, in this order.
    fn spans(&self, device: &Device) -> Vec<Span<'_>> {
        let Self { positions, indices, draws, .. } = self;
        // The bytes between the last position and the end of its stride need not exist.
        let positions_bytes = match u64::from(self.vertex_count) {
            0 => 0,
            count => (count - 1) * u64::from(positions.stride) + POSITION_BYTES,
        };
        let (what, index_count) = match indices.indexing {
            Indexing::Absolute => {
                (format!("{} triangles", self.triangle_count), 3 * u64::from(self.triangle_count))
            }
            Indexing::PerDraw { index_count } => (format!("{index_count} indices"), index_count.into()),
        };
        let index_bytes = u64::from(indices.format.bytes());
        // Shaders read whole words.
        let into_word = indices.offset % 4;
        let indices_bytes = (into_word + index_bytes * index_count).next_multiple_of(4) - into_word;
        let mut spans = vec![
            Span {
                what: format!("{} vertices", self.vertex_count),
                buffer: &positions.buffer,
                offset: positions.offset,
                bytes: positions_bytes,
                alignment: 4,
            },
            Span {
                what,
                buffer: &indices.buffer,
                offset: indices.offset,
                bytes: if index_count == 0 { 0 } else { indices_bytes },
                alignment: index_bytes,
            },
            Span {
                what: format!("{} draws", self.draw_count),
                buffer: &draws.buffer,
                offset: draws.offset,
                bytes: u64::from(self.draw_count) * size_of::<Draw>() as u64,
                alignment: device.limits().min_storage_buffer_offset_alignment,
            },
        ];
        spans.extend(self.count.as_ref().map(|count| Span {
            what: "the number of triangles".to_owned(),
            buffer: &count.buffer,
            offset: count.offset,
            bytes: 4,
            alignment: 4,
        }));
        spans
    }

    /// Returns the ranges to bind for positions, indices, draws and count, in this order. Each range starts
    /// at the last byte at which a binding may begin before the first byte that is read; the number is that
    /// of the bytes between.
    pub(crate) fn bindings(&self, device: &Device) -> Vec<(BufferRange<'_>, u64)> {
        let alignment = device.limits().min_storage_buffer_offset_alignment.max(4);
        self.spans(device).iter().map(|span| span.binding(alignment)).collect()
    }
}
