//! Elements `face` and `tristrips`: triangles, and the attributes of faces.

use std::collections::HashMap;
use std::path::Path;

use glam::DVec3;

use super::body::Body;
use super::header::{Element, Header, Property, Scalar};
use super::mesh::skip;
use super::vertices::{channel, color};
use crate::Limits;
use crate::kinds::Kinds;
use crate::polygon::{Filling, Polygons};
use rasray_scene::SceneError;
use rasray_scene::text::shown;

/// Mark of an index below zero, which ends a strip.
const END: u32 = u32::MAX;

/// Form of the triangles that a list of indices describes.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Shape {
    /// A polygon.
    Face,
    /// Triangle strips: each corner closes a triangle with the two before it. An index below zero ends a
    /// strip and begins the next.
    Strip,
}

/// Vertex of the file with the values of a face. Numbers are stored by their bits, so that equal ones are one
/// vertex.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) struct Wedge {
    pub vertex: u32,
    pub color: Option<[u32; 4]>,
    pub uv: Option<[u64; 2]>,
}

/// Triangles with one texture.
#[derive(Default)]
pub(super) struct Group {
    /// Number of the texture; `None` for the plain material.
    pub texture: Option<usize>,
    /// Indices into `wedges` where faces split vertices, else into the vertices of the file.
    pub indices: Vec<u32>,
    pub wedges: Vec<Wedge>,
    known: HashMap<Wedge, u32>,
    /// Polygons of more than three corners, fans so far: position of the first index, and number of corners.
    polygons: Vec<(usize, usize)>,
}

/// Contents of faces and strips.
#[derive(Default)]
pub(super) struct Faces {
    /// Number of textures that the header names.
    textures: usize,
    /// True if values of faces split vertices.
    pub splits: bool,
    /// Groups in the order of first use.
    pub groups: Vec<Group>,
    /// Number of faces with fewer than three corners.
    pub short: usize,
    /// Number of faces whose sides cross.
    pub crossing: usize,
    /// Number of faces whose texture coordinates are not two numbers for each corner.
    pub bare: usize,
    /// True if any face has a colour.
    pub colored: bool,
    /// Number of faces whose colour has an alpha below 1.
    pub faded: usize,
    triangles: u64,
}

/// Positions of the properties of faces that are shown.
struct Columns {
    indices: usize,
    /// Channel of the colour, by property.
    channels: Vec<Option<usize>>,
    scalars: [Option<Scalar>; 4],
    has_color: bool,
    texcoord: Option<usize>,
    texnumber: Option<usize>,
}

impl Columns {
    fn of(path: &Path, element: &Element, shape: Shape, has_textures: bool) -> Result<Self, SceneError> {
        let properties = &element.properties;
        let indices = index_list(path, element)?;
        let is_face = shape == Shape::Face;
        let named = |name: &str, is_list: bool| {
            properties.iter().position(|property| {
                property.name == name && property.length.is_some() == is_list && is_face && has_textures
            })
        };
        let channels: Vec<_> =
            properties.iter().map(|property| channel(property).filter(|_| is_face)).collect();
        let scalars = std::array::from_fn(|channel| {
            let place = channels.iter().position(|found| *found == Some(channel))?;
            Some(properties[place].scalar)
        });
        let has_color = scalars[..3].iter().all(Option::is_some);
        let (texcoord, texnumber) = (named("texcoord", true), named("texnumber", false));
        Ok(Self { indices, channels, scalars, has_color, texcoord, texnumber })
    }

    fn is_shown(&self, place: usize) -> bool {
        place == self.indices
            || self.has_color && self.channels[place].is_some()
            || self.texcoord == Some(place)
            || self.texnumber == Some(place)
    }
}

impl Faces {
    /// Makes an empty collection for a file with this header.
    pub fn new(header: &Header) -> Self {
        let has_textures = !header.textures.is_empty();
        let splits = |element: &Element| {
            let has = |wanted: usize| element.properties.iter().any(|found| channel(found) == Some(wanted));
            let is_of_texture =
                |property: &Property| matches!(property.name.as_str(), "texcoord" | "texnumber");
            [0, 1, 2].into_iter().all(has) || has_textures && element.properties.iter().any(is_of_texture)
        };
        let splits = header.elements.iter().any(|element| element.name == "face" && splits(element));
        Self { textures: header.textures.len(), splits, ..Self::default() }
    }

    /// Reads the faces or strips of an element; `unread` counts the properties that are not used.
    pub fn read(
        &mut self,
        path: &Path,
        body: &mut Body<'_>,
        element: &Element,
        shape: Shape,
        limits: &Limits,
        unread: &mut Kinds,
    ) -> Result<(), SceneError> {
        let columns = Columns::of(path, element, shape, self.textures > 0)?;
        for (place, property) in element.properties.iter().enumerate() {
            if !columns.is_shown(place) {
                unread.add(&format!("{} {}", shown(&element.name), property.name), element.count as usize);
            }
        }
        let (mut corners, mut uvs) = (Vec::new(), Vec::new());
        for _ in 0..element.count {
            corners.clear();
            uvs.clear();
            let mut channels = [0.0; 4];
            let mut texture = (self.textures > 0).then_some(0);
            for (place, property) in element.properties.iter().enumerate() {
                let length = property.length;
                if place == columns.indices {
                    for _ in 0..body.length(length.unwrap_or(Scalar::U8))? {
                        corners.push(corner(body, property.scalar, shape)?);
                    }
                } else if columns.texcoord == Some(place) {
                    for _ in 0..body.length(length.unwrap_or(Scalar::U8))? {
                        uvs.push(body.number(property.scalar)?);
                    }
                } else if columns.texnumber == Some(place) {
                    let number = body.number(property.scalar)?;
                    texture = (0.0..self.textures as f64).contains(&number).then_some(number as usize);
                } else if let Some(channel) = columns.channels[place].filter(|_| columns.has_color) {
                    channels[channel] = body.number(property.scalar)?;
                } else {
                    skip(body, std::slice::from_ref(property))?;
                }
            }
            self.colored |= columns.has_color;
            let color = columns.has_color.then(|| color(channels, columns.scalars));
            self.faded += usize::from(color.is_some_and(|color| color[3] < 1.0));
            let has_uvs = columns.texcoord.is_some() && texture.is_some();
            let is_bare = has_uvs && uvs.len() != 2 * corners.len();
            self.bare += usize::from(is_bare);
            let uv = |place: usize| match (has_uvs, is_bare) {
                (false, _) => None,
                // Texture coordinates count from the bottom of the image.
                (true, true) => Some([0.0, 1.0]),
                (true, false) => Some([uvs[2 * place], uvs[2 * place + 1]]),
            };
            let group = self.group(texture);
            if self.splits {
                for (place, vertex) in corners.iter_mut().enumerate().filter(|(_, vertex)| **vertex != END) {
                    *vertex = self.groups[group].wedge(Wedge {
                        vertex: *vertex,
                        color: color.map(|color| color.map(f32::to_bits)),
                        uv: uv(place).map(|uv| uv.map(f64::to_bits)),
                    });
                }
            }
            match shape {
                Shape::Face => self.add_face(group, &corners),
                Shape::Strip => {
                    corners.split(|corner| *corner == END).for_each(|strip| self.add_strip(group, strip));
                }
            }
            Limits::check(path, "the number of triangles", self.triangles, limits.triangles, "triangles")?;
        }
        Ok(())
    }

    /// Returns the group of a texture, as an index into `groups`.
    fn group(&mut self, texture: Option<usize>) -> usize {
        let known = self.groups.iter().position(|group| group.texture == texture);
        known.unwrap_or_else(|| {
            self.groups.push(Group { texture, ..Group::default() });
            self.groups.len() - 1
        })
    }

    fn add_face(&mut self, group: usize, corners: &[u32]) {
        if corners.len() < 3 {
            self.short += 1;
            return;
        }
        let Group { indices, polygons, .. } = &mut self.groups[group];
        if corners.len() > 3 {
            polygons.push((indices.len(), corners.len()));
        }
        for pair in corners[1..].windows(2) {
            indices.extend([corners[0], pair[0], pair[1]]);
        }
        self.triangles += corners.len() as u64 - 2;
    }

    /// Adds the triangles of a strip. Every second triangle is flipped, so that all face one way. A corner
    /// that repeats one of the last two joins strips, and makes no triangle.
    fn add_strip(&mut self, group: usize, corners: &[u32]) {
        self.short += usize::from((1..3).contains(&corners.len()));
        for (index, corners) in corners.windows(3).enumerate() {
            let &[a, b, c] = corners else { continue };
            if a != b && b != c && a != c {
                self.groups[group].indices.extend(if index % 2 == 1 { [b, a, c] } else { [a, b, c] });
                self.triangles += 1;
            }
        }
    }

    /// Cuts the polygons that a fan does not fill, now that all vertices are known.
    pub fn cut(&mut self, positions: &[DVec3]) {
        let mut fills = Polygons::default();
        let (mut corners, mut points) = (Vec::new(), Vec::new());
        for group in &mut self.groups {
            let Group { indices, wedges, polygons, .. } = group;
            for (start, count) in polygons.drain(..) {
                let fan = &mut indices[start..start + 3 * (count - 2)];
                corners.clear();
                corners.extend([fan[0], fan[1]]);
                corners.extend(fan.chunks_exact(3).map(|triangle| triangle[2]));
                points.clear();
                points.extend(corners.iter().filter_map(|&corner| {
                    let vertex = wedges.get(corner as usize).map_or(corner, |wedge| wedge.vertex);
                    positions.get(vertex as usize)
                }));
                // A corner beyond the vertices is an error of the finished mesh.
                if points.len() < corners.len() {
                    continue;
                }
                match fills.fill(&points) {
                    Filling::Fan => {}
                    Filling::Crossing => self.crossing += 1,
                    Filling::Cut(triangles) => {
                        for (index, corner) in fan.iter_mut().zip(triangles.iter().flatten()) {
                            *index = corners[*corner as usize];
                        }
                    }
                }
            }
        }
    }
}

impl Group {
    fn wedge(&mut self, wedge: Wedge) -> u32 {
        let Self { wedges, known, .. } = self;
        *known.entry(wedge).or_insert_with(|| {
            wedges.push(wedge);
            (wedges.len() - 1) as u32
        })
    }
}

/// Returns the property of faces or strips that lists the indices of vertices.
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

/// Reads the next index of a list. The index may exceed the vertices read so far, which may stand later in
/// the file: the finished mesh is checked.
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
