//! `KHR_draco_mesh_compression`: primitives whose indices and attributes are one stream in a buffer view.
//!
//! The accessors of such a primitive describe its elements, and the stream holds them. Morph targets are
//! never in the stream.

use std::cell::OnceCell;
use std::collections::HashMap;
use std::path::Path;

use ::gltf::json::accessor::ComponentType;
use ::gltf::json::mesh::{Mode, Primitive};
use ::gltf::json::validation::Checked;
use ::gltf::json::{Root, Value};
use draco_core::{
    DataType, DecodeLimits, DecoderBuffer, ErrorKind, Mesh, MeshDecoder, PointAttribute, PointIndex,
};

use super::document::Document;
use rasray_scene::SceneError;

const EXTENSION: &str = "KHR_draco_mesh_compression";

/// Streams of a file, decoded when they are first needed.
#[derive(Default)]
pub(super) struct Streams {
    /// Parts of streams by the accessor of a compressed primitive that stands for them.
    parts: HashMap<usize, Part>,
    /// Decoded streams by buffer view.
    decoded: HashMap<usize, OnceCell<Decoded>>,
}

#[derive(Clone, Copy, PartialEq)]
struct Part {
    view: usize,
    /// Number of an attribute in the stream; `None` for the indices.
    attribute: Option<u32>,
}

/// Elements of all parts of a stream.
struct Decoded {
    indices: Elements,
    attributes: HashMap<u32, Elements>,
}

/// Elements of one type, one after the other, little-endian.
pub(super) struct Elements {
    pub bytes: Vec<u8>,
    pub count: usize,
    pub component: ComponentType,
    pub components: usize,
}

impl Streams {
    /// Collects the streams of the primitives of `root`, whose accessors are in range.
    pub fn of(path: &Path, root: &Root) -> Result<Self, SceneError> {
        let mut streams = Self::default();
        for (i, mesh) in root.meshes.iter().enumerate() {
            for (k, primitive) in mesh.primitives.iter().enumerate() {
                let Some(found) = extension(primitive) else { continue };
                let place = format!("meshes[{i}].primitives[{k}].extensions.{EXTENSION}");
                let whole = |value: Option<&Value>| value.and_then(Value::as_u64).unwrap_or_default();
                let (view, views) = (whole(found.get("bufferView")) as usize, root.buffer_views.len());
                if view >= views {
                    let reason = format!("refers to element {view}, but there are only {views}");
                    return Err(SceneError::invalid(path, format!("{place}.bufferView"), reason));
                }
                let named = primitive.attributes.iter().filter_map(|(semantic, accessor)| {
                    let Checked::Valid(semantic) = semantic else { return None };
                    let number = found.get("attributes")?.get(semantic.to_string())?.as_u64()?;
                    Some((accessor.value(), Some(number as u32)))
                });
                for (accessor, attribute) in named.chain(primitive.indices.map(|found| (found.value(), None)))
                {
                    let part = Part { view, attribute };
                    if streams.parts.insert(accessor, part).is_some_and(|before| before != part) {
                        let reason =
                            format!("gives accessors[{accessor}], which is of another stream, elements");
                        return Err(SceneError::invalid(path, place, reason));
                    }
                }
                streams.decoded.entry(view).or_default();
            }
        }
        Ok(streams)
    }
}

/// Refuses compressed primitives that are not lists of triangles with indices.
pub(super) fn check(document: &Document<'_>, place: &str, primitive: &Primitive) -> Result<(), SceneError> {
    let fault = match extension(primitive) {
        Some(_) if primitive.mode != Checked::Valid(Mode::Triangles) => "is of another mode than TRIANGLES",
        Some(_) if primitive.indices.is_none() => "is of a primitive without indices",
        _ => return Ok(()),
    };
    let fix = "decompress it: npx @gltf-transform/cli copy in.glb out.glb";
    Err(document.invalid(format!("{place}.extensions.{EXTENSION}"), format!("{fault}; {fix}")))
}

fn extension(primitive: &Primitive) -> Option<&Value> {
    primitive.extensions.as_ref()?.others.get(EXTENSION)
}

/// Returns the elements of an accessor that is part of a stream; `None` for any other.
pub(super) fn elements<'a>(
    document: &'a Document<'_>,
    accessor: usize,
) -> Result<Option<&'a Elements>, SceneError> {
    let Streams { parts, decoded } = &document.draco;
    let Some(&Part { view, attribute }) = parts.get(&accessor) else { return Ok(None) };
    // Each view that a primitive refers to has a cell.
    let Some(cell) = decoded.get(&view) else { return Ok(None) };
    let stream = match cell.get() {
        Some(stream) => stream,
        None => {
            let stream = decode(document, view)?;
            cell.get_or_init(|| stream)
        }
    };
    let Some(number) = attribute else { return Ok(Some(&stream.indices)) };
    stream.attributes.get(&number).map(Some).ok_or_else(|| {
        let reason = format!("is attribute {number} of bufferViews[{view}], whose stream does not have it");
        document.invalid(format!("accessors[{accessor}]"), reason)
    })
}

fn decode(document: &Document<'_>, view: usize) -> Result<Decoded, SceneError> {
    let bytes = document.view(view)?;
    let limits = document.limits;
    let limits = DecodeLimits::default()
        .with_max_points(limits.vertices)
        .with_max_faces(limits.triangles)
        .with_max_decoded_bytes(limits.file_bytes.saturating_sub(document.buffers.held.get()));
    let damaged = |reason: String| document.invalid(format!("bufferViews[{view}]"), reason);
    let mut mesh = Mesh::new();
    let mut buffer = DecoderBuffer::new(bytes).with_limits(limits);
    MeshDecoder::new().decode(&mut buffer, &mut mesh).map_err(|error| match error.kind() {
        ErrorKind::LimitExceeded => {
            damaged(format!("is too large for the limits of scenes: {}", error.message()))
        }
        _ => damaged(format!(
            "is no mesh that Draco compressed ({}); the file is damaged: export it again",
            error.message()
        )),
    })?;
    let points = mesh.num_points();
    let attributes: Vec<&PointAttribute> = (0..mesh.num_attributes()).map(|i| mesh.attribute(i)).collect();
    let size = |attribute: &PointAttribute| {
        usize::from(attribute.num_components()) * attribute.data_type().byte_length()
    };
    let held = attributes.iter().map(|attribute| size(attribute) as u64).sum::<u64>() * points as u64;
    document.spend_bytes(held + 12 * mesh.num_faces() as u64)?;
    let mut decoded = Decoded {
        indices: Elements {
            bytes: mesh.faces().iter().flatten().flat_map(|corner| corner.0.to_le_bytes()).collect(),
            count: 3 * mesh.num_faces(),
            component: ComponentType::U32,
            components: 1,
        },
        attributes: HashMap::new(),
    };
    for attribute in attributes {
        let Some(component) = component(attribute.data_type()) else { continue };
        let (size, data) = (size(attribute), attribute.buffer().data());
        let stride = attribute.byte_stride() as usize;
        let mut bytes = Vec::with_capacity(size * points);
        for point in 0..points {
            let at = attribute.mapped_index(PointIndex(point as u32)).0 as usize * stride;
            let element = data.get(at..at + size);
            bytes.extend_from_slice(
                element
                    .ok_or_else(|| damaged("has points without values; the file is damaged".to_owned()))?,
            );
        }
        let components = usize::from(attribute.num_components());
        let elements = Elements { bytes, count: points, component, components };
        decoded.attributes.insert(attribute.unique_id(), elements);
    }
    Ok(decoded)
}

/// Returns the format's type of the same numbers; `None` if it has none.
fn component(found: DataType) -> Option<ComponentType> {
    Some(match found {
        DataType::Int8 => ComponentType::I8,
        DataType::Uint8 => ComponentType::U8,
        DataType::Int16 => ComponentType::I16,
        DataType::Uint16 => ComponentType::U16,
        DataType::Uint32 => ComponentType::U32,
        DataType::Float32 => ComponentType::F32,
        _ => return None,
    })
}
