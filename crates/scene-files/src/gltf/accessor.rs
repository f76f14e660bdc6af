//! Accessors: typed arrays in buffers, checked against the actual bytes.

use std::path::Path;

use ::gltf::json::accessor::{ComponentType, GenericComponentType, IndexComponentType, Type};
use ::gltf::json::validation::Checked;

use super::document::Document;
use super::draco::{self, Elements};
use crate::Limits;
use rasray_scene::SceneError;

/// Array of elements in a buffer view, checked to fit.
struct Layout<'a> {
    bytes: &'a [u8],
    stride: usize,
    size: usize,
    count: usize,
}

impl<'a> Layout<'a> {
    /// Returns the `count` elements of `size` bytes that start at `offset` of `view`, `stride` bytes apart.
    fn of(
        document: &'a Document<'_>,
        place: &str,
        view: usize,
        offset: u64,
        size: usize,
        count: u64,
        strided: bool,
    ) -> Result<Self, SceneError> {
        let bytes = document.view(view)?;
        let stride =
            document.root.buffer_views[view].byte_stride.filter(|_| strided).map_or(size, |stride| stride.0);
        if stride < size {
            return Err(
                document.invalid(place, format!("elements of {size} bytes, but a stride of {stride}"))
            );
        }
        let end = match count {
            0 => u128::from(offset),
            _ => u128::from(offset) + stride as u128 * (u128::from(count) - 1) + size as u128,
        };
        if end > bytes.len() as u128 {
            let claim = &document.root.buffer_views[view];
            let (from, length) = (claim.byte_offset.unwrap_or_default().0, claim.byte_length.0);
            let cut = if bytes.len() as u64 == length {
                String::new()
            } else {
                format!(" of its {length}: they start at byte {from} of buffers[{}]", claim.buffer.value())
            };
            let reason = format!("needs {end} bytes, but bufferViews[{view}] has only {}{cut}", bytes.len());
            return Err(document.invalid(place, reason));
        }
        // It holds that offset <= end <= bytes.len(), and no element takes less than a byte.
        Ok(Self { bytes: &bytes[offset as usize..], stride, size, count: count as usize })
    }

    /// Returns the elements of an accessor that Draco compressed; they must match the accessor's claims.
    fn of_stream(
        document: &Document<'_>,
        place: &str,
        stream: &'a Elements,
        component: ComponentType,
        kind: Type,
        count: u64,
    ) -> Result<Self, SceneError> {
        let Elements { bytes, count: found, .. } = stream;
        if (stream.component, stream.components, *found as u64) != (component, kind.multiplicity(), count) {
            let reason = format!(
                "claims {count} elements of {} {}, but its Draco stream has {found} of {} {}",
                kind.multiplicity(),
                component_name(component),
                stream.components,
                component_name(stream.component)
            );
            return Err(document.invalid(place, reason));
        }
        let size = component.size() * stream.components;
        Ok(Self { bytes, stride: size, size, count: *found })
    }

    fn elements(&self) -> impl Iterator<Item = &'a [u8]> + use<'a> {
        let Self { bytes, stride, size, count } = *self;
        (0..count).map(move |i| &bytes[i * stride..i * stride + size])
    }
}

/// Accessor whose base and sparse parts fit.
struct Resolved<'a> {
    place: String,
    component: ComponentType,
    kind: Type,
    normalized: bool,
    count: usize,
    /// Base array; absent means all zeros.
    base: Option<Layout<'a>>,
    sparse: Option<Sparse<'a>>,
}

struct Sparse<'a> {
    indices: Layout<'a>,
    values: Layout<'a>,
}

/// Reads an accessor of `N` components as f32. Integers become their value or, if normalised, their ratio to
/// the largest value of their type, in [-1, 1] or [0, 1].
pub(super) fn read_floats<const N: usize>(
    document: &Document<'_>,
    accessor: usize,
) -> Result<Vec<[f32; N]>, SceneError> {
    let resolved = resolve(document, accessor)?;
    if resolved.components() != Some(N) {
        let reason =
            format!("has elements of type {} where {N} numbers are needed", type_name(resolved.kind));
        return Err(document.invalid(resolved.place, reason));
    }
    resolved.read(
        document,
        |bytes| {
            let size = resolved.component.size();
            std::array::from_fn(|k| {
                component(&bytes[k * size..(k + 1) * size], resolved.component, resolved.normalized)
            })
        },
        [0.0; N],
    )
}

/// Reads an accessor of `N` unsigned integers.
pub(super) fn read_integers<const N: usize>(
    document: &Document<'_>,
    accessor: usize,
) -> Result<Vec<[u32; N]>, SceneError> {
    let resolved = resolve(document, accessor)?;
    let unsigned = matches!(resolved.component, ComponentType::U8 | ComponentType::U16 | ComponentType::U32);
    if resolved.components() != Some(N) || !unsigned {
        let reason = format!(
            "must have elements of {N} unsigned integers, has {} of {}",
            type_name(resolved.kind),
            component_name(resolved.component)
        );
        return Err(document.invalid(resolved.place, reason));
    }
    resolved.read(
        document,
        |bytes| {
            let size = resolved.component.size();
            std::array::from_fn(|k| integer(&bytes[k * size..(k + 1) * size]))
        },
        [0; N],
    )
}

/// Returns the number of components of an element of `accessor`; `None` for matrices of two or three columns.
pub(super) fn components(document: &Document<'_>, accessor: usize) -> Result<Option<usize>, SceneError> {
    Ok(resolve(document, accessor)?.components())
}

/// Returns the number of elements of `accessor`.
pub(super) fn count(document: &Document<'_>, accessor: usize) -> Result<usize, SceneError> {
    Ok(resolve(document, accessor)?.count)
}

impl Resolved<'_> {
    /// Returns the number of components of an element that lie one after the other; `None` where columns are
    /// padded.
    fn components(&self) -> Option<usize> {
        (!matches!(self.kind, Type::Mat2 | Type::Mat3)).then(|| self.kind.multiplicity())
    }

    fn read<T: Copy>(
        &self,
        document: &Document<'_>,
        convert: impl Fn(&[u8]) -> T,
        zero: T,
    ) -> Result<Vec<T>, SceneError> {
        document.spend(self.count)?;
        let mut elements = match &self.base {
            Some(base) => base.elements().map(&convert).collect(),
            None => vec![zero; self.count],
        };
        if let Some(sparse) = &self.sparse {
            for (index, value) in sparse.indices.elements().map(integer).zip(sparse.values.elements()) {
                let slot = elements.get_mut(index as usize).ok_or_else(|| {
                    let reason = format!("sparse index {index}, but there are only {} elements", self.count);
                    document.invalid(self.place.clone(), reason)
                })?;
                *slot = convert(value);
            }
        }
        Ok(elements)
    }
}

fn resolve<'a>(document: &'a Document<'_>, index: usize) -> Result<Resolved<'a>, SceneError> {
    let accessor = &document.root.accessors[index];
    let place = format!("accessors[{index}]");
    let unknown = |member: &str| {
        let place = format!("{place}.{member}");
        let reason = document.unknown(&place);
        document.invalid(place, reason)
    };
    let Checked::Valid(GenericComponentType(component)) = accessor.component_type else {
        return Err(unknown("componentType"));
    };
    let Checked::Valid(kind) = accessor.type_ else { return Err(unknown("type")) };
    let stream = draco::elements(document, index)?;
    // Small integers and indices have the width of their stream; normalised integers refer to their own type.
    let component = match stream {
        Some(stream) if !accessor.normalized && component != ComponentType::F32 => stream.component,
        _ => component,
    };
    let size = element_size(component, kind);
    let base = match stream {
        Some(stream) => Some(Layout::of_stream(document, &place, stream, component, kind, accessor.count.0)?),
        None => accessor
            .buffer_view
            .map(|view| {
                let offset = accessor.byte_offset.unwrap_or_default().0;
                Layout::of(document, &place, view.value(), offset, size, accessor.count.0, true)
            })
            .transpose()?,
    };
    // The count is checked after the bytes: a count that contradicts them is an error of the file, whatever
    // the limits.
    let count = small(document.path, &place, accessor.count.0, document.limits)?;
    let sparse = accessor.sparse.as_ref().map(|sparse| {
        let Checked::Valid(IndexComponentType(index_type)) = sparse.indices.component_type else {
            return Err(unknown("sparse.indices.componentType"));
        };
        let changed = sparse.count.0;
        if changed > count as u64 {
            return Err(document.invalid(place.clone(), format!("{changed} sparse elements of {count}")));
        }
        let (indices, values) = (&sparse.indices, &sparse.values);
        let part = |view: usize, offset: u64, size: usize| {
            Layout::of(document, &place, view, offset, size, changed, false)
        };
        let indices = part(indices.buffer_view.value(), indices.byte_offset.0, index_type.size())?;
        if let Some(index) = indices.elements().map(integer).find(|&index| index as usize >= count) {
            let reason = format!("sparse index {index}, but there are only {count} elements");
            return Err(document.invalid(place.clone(), reason));
        }
        let values = part(values.buffer_view.value(), values.byte_offset.0, size)?;
        Ok(Sparse { indices, values })
    });
    Ok(Resolved {
        base,
        sparse: sparse.transpose()?,
        place,
        component,
        kind,
        normalized: accessor.normalized,
        count,
    })
}

/// Converts a count to `usize` if memory can hold that many elements.
fn small(path: &Path, place: &str, count: u64, limits: &Limits) -> Result<usize, SceneError> {
    Limits::check(path, &format!("the number of elements of {place}"), count, limits.vertices, "vertices")?;
    usize::try_from(count)
        .map_err(|_| SceneError::invalid(path, place, format!("{count} elements do not fit in memory")))
}

/// Returns the bytes of an element. Columns of matrices start at multiples of four bytes.
fn element_size(component: ComponentType, kind: Type) -> usize {
    let (columns, rows) = match kind {
        Type::Mat2 => (2, 2),
        Type::Mat3 => (3, 3),
        Type::Mat4 => (4, 4),
        Type::Scalar | Type::Vec2 | Type::Vec3 | Type::Vec4 => return component.size() * kind.multiplicity(),
    };
    columns * (rows * component.size()).next_multiple_of(4)
}

/// Returns the format's name of a type of elements.
fn type_name(kind: Type) -> &'static str {
    match kind {
        Type::Scalar => "SCALAR",
        Type::Vec2 => "VEC2",
        Type::Vec3 => "VEC3",
        Type::Vec4 => "VEC4",
        Type::Mat2 => "MAT2",
        Type::Mat3 => "MAT3",
        Type::Mat4 => "MAT4",
    }
}

/// Describes a type of components in words.
pub(super) fn component_name(component: ComponentType) -> &'static str {
    match component {
        ComponentType::I8 => "signed 8-bit integers",
        ComponentType::U8 => "unsigned 8-bit integers",
        ComponentType::I16 => "signed 16-bit integers",
        ComponentType::U16 => "unsigned 16-bit integers",
        ComponentType::U32 => "unsigned 32-bit integers",
        ComponentType::F32 => "floats",
    }
}

/// Reads a little-endian unsigned integer of one, two or four bytes.
fn integer(bytes: &[u8]) -> u32 {
    bytes.iter().rev().fold(0, |value, &byte| value << 8 | u32::from(byte))
}

fn component(bytes: &[u8], component: ComponentType, normalized: bool) -> f32 {
    let bits = integer(bytes);
    let (value, largest) = match component {
        ComponentType::F32 => return f32::from_bits(bits),
        ComponentType::I8 => (f32::from(bits as u8 as i8), 127.0),
        ComponentType::U8 => (f32::from(bits as u8), 255.0),
        ComponentType::I16 => (f32::from(bits as u16 as i16), 32767.0),
        ComponentType::U16 => (f32::from(bits as u16), 65535.0),
        ComponentType::U32 => (bits as f32, u32::MAX as f32),
    };
    if normalized { (value / largest).max(-1.0) } else { value }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn components_follow_the_normalisation_rules() {
        assert_eq!(component(&[0x80], ComponentType::I8, true), -1.0);
        assert_eq!(component(&[0x81], ComponentType::I8, true), -1.0);
        assert_eq!(component(&[0x7F], ComponentType::I8, true), 1.0);
        assert_eq!(component(&[0xFF], ComponentType::U8, true), 1.0);
        assert_eq!(component(&[0xFF, 0xFF], ComponentType::I16, false), -1.0);
        assert_eq!(component(&[0x34, 0x12], ComponentType::U16, false), f32::from(0x1234_u16));
        assert_eq!(component(&1.5_f32.to_le_bytes(), ComponentType::F32, true), 1.5);
    }

    #[test]
    fn matrix_columns_are_aligned() {
        assert_eq!(element_size(ComponentType::U8, Type::Mat2), 8);
        assert_eq!(element_size(ComponentType::U8, Type::Mat3), 12);
        assert_eq!(element_size(ComponentType::U16, Type::Mat3), 24);
        assert_eq!(element_size(ComponentType::F32, Type::Mat4), 64);
        assert_eq!(element_size(ComponentType::U16, Type::Vec3), 6);
    }
}
