//! Conversion of elements to meshes.

use std::path::Path;

use glam::DVec3;

use super::body::Body;
use super::faces::{Faces, Group, Shape, Wedge};
use super::header::{Element, Header, Property};
use super::vertices::{self, Vertices};
use crate::Limits;
use crate::kinds::Kinds;
use crate::polygon::CROSSING;
use rasray_scene::remarks::Remarks;
use rasray_scene::text::shown;
use rasray_scene::{Mesh, SceneError};

/// Contents of a file.
#[derive(Default)]
pub(super) struct Content {
    /// Meshes, one for each texture that faces use, without positions, texture coordinates, names and
    /// materials. Empty if there are no triangles.
    pub meshes: Vec<Mesh>,
    /// Positions of each mesh as the file has them.
    pub positions: Vec<Vec<DVec3>>,
    /// Texture coordinates of each mesh as the file has them, if there are any.
    pub uvs: Vec<Option<Vec<[f64; 2]>>>,
    /// Name of the texture of each mesh.
    pub texture_of: Vec<Option<String>>,
    /// Number of vertices of the file.
    pub vertices: usize,
}

/// Reads all elements of the body.
pub(super) fn read(
    path: &Path,
    bytes: &[u8],
    header: &Header,
    limits: &Limits,
    remarks: &mut Remarks,
) -> Result<Content, SceneError> {
    let mut body = Body::new(path, bytes, header);
    let mut vertices = Vertices::default();
    let mut faces = Faces::new(header);
    let (mut unread, mut elements) = (Kinds::default(), Kinds::default());
    let mut has_vertices = false;
    for element in &header.elements {
        // Elements without properties take no space in the file, however many there are.
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
                vertices = vertices::read(path, &mut body, element, &mut unread)?;
            }
            "face" => faces.read(path, &mut body, element, Shape::Face, limits, &mut unread)?,
            "tristrips" => faces.read(path, &mut body, element, Shape::Strip, limits, &mut unread)?,
            name => {
                elements.add(name, element.count as usize);
                for _ in 0..element.count {
                    skip(&mut body, &element.properties)?;
                }
            }
        }
    }
    faces.cut(&vertices.positions);
    report(&faces, &vertices, &unread, &elements, remarks);
    let count = vertices.positions.len();
    let mut content = Content { vertices: count, ..Content::default() };
    let splits = faces.splits;
    for group in faces.groups.into_iter().filter(|group| !group.indices.is_empty()) {
        content.texture_of.push(group.texture.map(|texture| header.textures[texture].clone()));
        let (mesh, Points { positions, uvs }) =
            if splits { split(path, &vertices, group)? } else { whole(&mut vertices, group) };
        content.meshes.push(mesh);
        content.positions.push(positions);
        content.uvs.push(uvs);
    }
    Ok(content)
}

/// Coordinates of a mesh before rounding.
struct Points {
    positions: Vec<DVec3>,
    uvs: Option<Vec<[f64; 2]>>,
}

/// Makes the mesh of a group that refers to the vertices of the file; it is the only mesh.
fn whole(vertices: &mut Vertices, group: Group) -> (Mesh, Points) {
    let Vertices { positions, normals, uvs, colors } = std::mem::take(vertices);
    (Mesh { normals, colors, indices: group.indices, ..Mesh::default() }, Points { positions, uvs })
}

/// Makes the mesh of a group with vertices of its own.
fn split(path: &Path, vertices: &Vertices, group: Group) -> Result<(Mesh, Points), SceneError> {
    let Group { indices, wedges, .. } = group;
    let count = vertices.positions.len();
    if let Some(wedge) = wedges.iter().find(|wedge| wedge.vertex as usize >= count) {
        return Err(SceneError::IndexOutOfRange {
            path: path.to_owned(),
            mesh: crate::finish::scene_name(path),
            index: u64::from(wedge.vertex),
            vertices: count as u64,
        });
    }
    let place = |wedge: &Wedge| wedge.vertex as usize;
    let positions = wedges.iter().map(|wedge| vertices.positions[place(wedge)]).collect();
    let normals = vertices.normals.as_ref();
    let normals = normals.map(|normals| wedges.iter().map(|wedge| normals[place(wedge)]).collect());
    let has_uvs = vertices.uvs.is_some() || wedges.iter().any(|wedge| wedge.uv.is_some());
    let uv = |wedge: &Wedge| match (wedge.uv, &vertices.uvs) {
        (Some(uv), _) => uv.map(f64::from_bits),
        (None, Some(uvs)) => uvs[place(wedge)],
        // Texture coordinates count from the bottom of the image.
        (None, None) => [0.0, 1.0],
    };
    let uvs = has_uvs.then(|| wedges.iter().map(uv).collect());
    let has_colors = vertices.colors.is_some() || wedges.iter().any(|wedge| wedge.color.is_some());
    let color = |wedge: &Wedge| match (wedge.color, &vertices.colors) {
        (Some(color), _) => color.map(f32::from_bits),
        (None, Some(colors)) => colors[place(wedge)],
        (None, None) => [1.0; 4],
    };
    let colors = has_colors.then(|| wedges.iter().map(color).collect());
    Ok((Mesh { normals, colors, indices, ..Mesh::default() }, Points { positions, uvs }))
}

/// Notes remarks on parts of a file that are not shown, or not shown as written.
fn report(faces: &Faces, vertices: &Vertices, unread: &Kinds, elements: &Kinds, remarks: &mut Remarks) {
    let text = "faces or strips have fewer than three corners and were dropped";
    remarks.count("short-faces", "", faces.short, text);
    remarks.count("crossing-faces", "", faces.crossing, CROSSING);
    let text = "faces do not have two texture coordinates for each corner; theirs were set to 0";
    remarks.count("bad-texture-coordinates", "", faces.bare, text);
    let of_vertices = vertices.colors.as_deref().unwrap_or_default();
    let text = "vertices have colours, but those of the faces are shown";
    remarks.count("vertex-colors", "", if faces.colored { of_vertices.len() } else { 0 }, text);
    let faded = of_vertices.iter().filter(|color| !faces.colored && color[3] < 1.0).count();
    let text = "colours have an alpha below 1, which is not shown";
    remarks.count("color-alpha", "", faces.faded + faded, text);
    let properties = unread.list(|_| true);
    if !properties.is_empty() {
        remarks.note("unread-properties", "", format!("properties are not shown: {properties}"));
    }
    let elements = elements.list(|_| true);
    if !elements.is_empty() {
        remarks.note("unread-elements", "", format!("elements are not shown: {elements}"));
    }
}

/// Refuses counts that the rest of the file cannot hold, before memory is reserved.
fn check_length(body: &Body<'_>, element: &Element) -> Result<(), SceneError> {
    // Every encoding takes at least one byte per property.
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

/// Skips one value of each property.
pub(super) fn skip(body: &mut Body<'_>, properties: &[Property]) -> Result<(), SceneError> {
    for property in properties {
        let count = match property.length {
            Some(length) => body.length(length)?,
            None => 1,
        };
        body.skip(property.scalar, count)?;
    }
    Ok(())
}
