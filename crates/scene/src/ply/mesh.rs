//! Elements to a mesh.

use std::path::Path;

use super::body::Body;
use super::header::{Element, Header, Property, Scalar};
use crate::remarks::Remarks;
use crate::text::shown;
use crate::{Limits, Mesh, SceneError};

/// Reads all elements of the body.
pub(super) fn read(
    path: &Path,
    bytes: &[u8],
    header: &Header,
    limits: &Limits,
    remarks: &mut Remarks,
) -> Result<Mesh, SceneError> {
    let mut body = Body::new(path, bytes, header);
    let mut mesh = Mesh::default();
    let mut faces = Faces::default();
    let mut has_vertices = false;
    for element in &header.elements {
        // Nothing of an element without properties stands in the file, however many there are.
        if element.properties.is_empty() || element.count == 0 {
            continue;
        }
        check_length(&body, element)?;
        match element.name.as_str() {
            "vertex" if !has_vertices => {
                has_vertices = true;
                // Indices are u32, whatever the limit says.
                let limit = limits.vertices.min(u64::from(u32::MAX));
                Limits::check(path, "the number of vertices", element.count, limit, "vertices")?;
                read_vertices(path, &mut body, element, &mut mesh)?;
            }
            "face" => faces.read(path, &mut body, element, Shape::Face, limits, &mut mesh)?,
            "tristrips" => faces.read(path, &mut body, element, Shape::Strip, limits, &mut mesh)?,
            _ => {
                for _ in 0..element.count {
                    skip(&mut body, &element.properties)?;
                }
            }
        }
    }
    let text = "faces or strips have fewer than three corners and were dropped";
    remarks.count("short-faces", "", faces.short, text);
    Ok(mesh)
}

/// Refuses counts that the rest of the file cannot hold, before memory is set aside.
fn check_length(body: &Body<'_>, element: &Element) -> Result<(), SceneError> {
    // At least one byte a property, in every encoding.
    let least = element.count.saturating_mul(element.properties.len() as u64);
    if least > body.left() as u64 {
        let Element { name, count, .. } = element;
        return Err(body.error(&format!(
            "{count} elements `{}` are promised, more than the file can hold",
            shown(name)
        )));
    }
    Ok(())
}

fn skip(body: &mut Body<'_>, properties: &[Property]) -> Result<(), SceneError> {
    for property in properties {
        let count = match property.length {
            Some(length) => body.length(length)?,
            None => 1,
        };
        body.skip(property.scalar, count)?;
    }
    Ok(())
}

/// What a property of a vertex means: place in a row of twelve numbers.
const COLUMNS: [(&str, usize); 16] = [
    ("x", 0),
    ("y", 1),
    ("z", 2),
    ("nx", 3),
    ("ny", 4),
    ("nz", 5),
    ("s", 6),
    ("t", 7),
    ("u", 6),
    ("v", 7),
    ("texture_u", 6),
    ("texture_v", 7),
    ("red", 8),
    ("green", 9),
    ("blue", 10),
    ("alpha", 11),
];

fn read_vertices(
    path: &Path,
    body: &mut Body<'_>,
    element: &Element,
    mesh: &mut Mesh,
) -> Result<(), SceneError> {
    let column = |property: &Property| {
        let named = COLUMNS.iter().find(|(name, _)| *name == property.name);
        named.filter(|_| property.length.is_none()).map(|(_, column)| *column)
    };
    let columns: Vec<Option<usize>> = element.properties.iter().map(column).collect();
    let has = |wanted: &[usize]| wanted.iter().all(|column| columns.contains(&Some(*column)));
    if !has(&[0, 1, 2]) {
        return Err(SceneError::syntax(path, "element vertex lacks one of the properties x, y, z"));
    }
    let (has_normals, has_uvs, has_colors) = (has(&[3, 4, 5]), has(&[6, 7]), has(&[8, 9, 10]));
    let color_scalars: [Option<Scalar>; 4] = std::array::from_fn(|channel| {
        let place = columns.iter().position(|column| *column == Some(8 + channel))?;
        Some(element.properties[place].scalar)
    });

    let count = element.count as usize;
    mesh.positions.reserve_exact(count);
    let mut normals = Vec::with_capacity(if has_normals { count } else { 0 });
    let mut uvs = Vec::with_capacity(if has_uvs { count } else { 0 });
    let mut colors = Vec::with_capacity(if has_colors { count } else { 0 });
    for _ in 0..count {
        let mut row = [0.0_f64; 12];
        for (property, column) in element.properties.iter().zip(&columns) {
            match column {
                Some(column) => row[*column] = body.number(property.scalar)?,
                None => skip(body, std::slice::from_ref(property))?,
            }
        }
        let [x, y, z, nx, ny, nz, u, v] = std::array::from_fn(|column| row[column] as f32);
        mesh.positions.push([x, y, z]);
        if has_normals {
            normals.push([nx, ny, nz]);
        }
        if has_uvs {
            uvs.push([u, 1.0 - v]);
        }
        if has_colors {
            colors.push(std::array::from_fn(|channel| match color_scalars[channel] {
                Some(scalar) => color(row[8 + channel], scalar, channel == 3),
                None => 1.0,
            }));
        }
    }
    mesh.normals = has_normals.then_some(normals);
    mesh.uvs[0] = has_uvs.then_some(uvs);
    mesh.colors = has_colors.then_some(colors);
    Ok(())
}

/// A channel as a linear value. Whole numbers span their type and are sRGB, but for alpha.
fn color(value: f64, scalar: Scalar, is_alpha: bool) -> f32 {
    let largest = match scalar {
        Scalar::F32 | Scalar::F64 => return value as f32,
        Scalar::I8 => f64::from(i8::MAX),
        Scalar::U8 => f64::from(u8::MAX),
        Scalar::I16 => f64::from(i16::MAX),
        Scalar::U16 => f64::from(u16::MAX),
        Scalar::I32 => f64::from(i32::MAX),
        Scalar::U32 => f64::from(u32::MAX),
    };
    let encoded = (value / largest).clamp(0.0, 1.0);
    if is_alpha {
        return encoded as f32;
    }
    let linear = if encoded <= 0.040_45 { encoded / 12.92 } else { ((encoded + 0.055) / 1.055).powf(2.4) };
    linear as f32
}

/// Which property of faces or strips lists the indices of vertices.
fn index_list(path: &Path, element: &Element) -> Result<usize, SceneError> {
    let is_list = |property: &Property| {
        property.length.is_some() && matches!(property.name.as_str(), "vertex_indices" | "vertex_index")
    };
    let Some(list) = element.properties.iter().position(is_list) else {
        let message = format!("element {} lacks the list vertex_indices", element.name);
        return Err(SceneError::syntax(path, message));
    };
    if element.properties[list].scalar.is_float() {
        return Err(SceneError::syntax(path, "vertex_indices must have a type of whole numbers"));
    }
    Ok(list)
}

/// Stands for an index below zero, which ends a strip.
const END: u32 = u32::MAX;

/// What a list of indices makes.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Shape {
    /// A polygon: a fan from its first corner.
    Face,
    /// Triangle strips: each corner closes a triangle with the two before it. An index below zero ends a strip, and
    /// the next begins.
    Strip,
}

/// What was found in faces and strips.
#[derive(Default)]
struct Faces {
    /// Those with fewer than three corners.
    short: usize,
}

impl Faces {
    fn read(
        &mut self,
        path: &Path,
        body: &mut Body<'_>,
        element: &Element,
        shape: Shape,
        limits: &Limits,
        mesh: &mut Mesh,
    ) -> Result<(), SceneError> {
        let list = index_list(path, element)?;
        let Property { scalar, length, .. } = element.properties[list];
        let mut corners = Vec::new();
        for _ in 0..element.count {
            skip(body, &element.properties[..list])?;
            let count = body.length(length.unwrap_or(Scalar::U8))?;
            corners.clear();
            for _ in 0..count {
                corners.push(corner(body, scalar, shape)?);
            }
            skip(body, &element.properties[list + 1..])?;
            match shape {
                Shape::Face => self.add_face(&corners, mesh),
                Shape::Strip => {
                    corners.split(|corner| *corner == END).for_each(|strip| self.add_strip(strip, mesh))
                }
            }
            let triangles = mesh.indices.len() as u64 / 3;
            Limits::check(path, "the number of triangles", triangles, limits.triangles, "triangles")?;
        }
        Ok(())
    }

    fn add_face(&mut self, corners: &[u32], mesh: &mut Mesh) {
        if corners.len() < 3 {
            self.short += 1;
            return;
        }
        for pair in corners[1..].windows(2) {
            mesh.indices.extend([corners[0], pair[0], pair[1]]);
        }
    }

    /// Every second triangle is turned over, so that all face one way. A corner that repeats one of the last two is how
    /// strips are joined, and shows nothing.
    fn add_strip(&mut self, corners: &[u32], mesh: &mut Mesh) {
        self.short += usize::from((1..3).contains(&corners.len()));
        for (index, corners) in corners.windows(3).enumerate() {
            let &[a, b, c] = corners else { continue };
            if a != b && b != c && a != c {
                mesh.indices.extend(if index % 2 == 1 { [b, a, c] } else { [a, b, c] });
            }
        }
    }
}

/// The next index of a list. It may be beyond the vertices, which may stand behind: the finished mesh is checked.
fn corner(body: &mut Body<'_>, scalar: Scalar, shape: Shape) -> Result<u32, SceneError> {
    let index = body.number(scalar)?;
    if (0.0..f64::from(END)).contains(&index) {
        return Ok(index as u32);
    }
    let what = match shape {
        Shape::Strip if index < 0.0 => return Ok(END),
        Shape::Strip => "strip",
        Shape::Face => "face",
    };
    Err(body.error(&format!("a {what} cannot have the vertex index {index}")))
}
