//! Element `vertex`: positions and attributes.

use std::path::Path;

use glam::DVec3;

use super::body::Body;
use super::header::{Element, Property, Scalar};
use super::mesh::skip;
use crate::kinds::Kinds;
use rasray_scene::SceneError;

/// Vertices of a file.
#[derive(Default)]
pub(super) struct Vertices {
    /// Positions as the file has them.
    pub positions: Vec<DVec3>,
    pub normals: Option<Vec<[f32; 3]>>,
    /// Texture coordinates as the file has them: v counts from the bottom of the image.
    pub uvs: Option<Vec<[f64; 2]>>,
    /// Linear colours.
    pub colors: Option<Vec<[f32; 4]>>,
}

/// Properties of a vertex, each with its index in a row of twelve numbers.
const COLUMNS: [(&str, usize); 14] = [
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
    ("texture_s", 6),
    ("texture_t", 7),
];

/// Index of the first colour in such a row.
const COLOR: usize = 8;

/// Returns the channel of a colour that a property holds; 3 stands for alpha.
pub(super) fn channel(property: &Property) -> Option<usize> {
    let names: [[&str; 3]; 4] = [
        ["red", "diffuse_red", "r"],
        ["green", "diffuse_green", "g"],
        ["blue", "diffuse_blue", "b"],
        ["alpha", "diffuse_alpha", "a"],
    ];
    let found = names.iter().position(|names| names.contains(&property.name.as_str()));
    found.filter(|_| property.length.is_none())
}

/// Reads all vertices; `unread` counts the properties that are not used.
pub(super) fn read(
    path: &Path,
    body: &mut Body<'_>,
    element: &Element,
    unread: &mut Kinds,
) -> Result<Vertices, SceneError> {
    let column = |property: &Property| {
        let named = COLUMNS.iter().find(|(name, _)| *name == property.name);
        let place = named.filter(|_| property.length.is_none()).map(|(_, column)| *column);
        place.or_else(|| channel(property).map(|channel| COLOR + channel))
    };
    let columns: Vec<Option<usize>> = element.properties.iter().map(column).collect();
    let has = |wanted: &[usize]| wanted.iter().all(|column| columns.contains(&Some(*column)));
    if !has(&[0, 1, 2]) {
        return Err(SceneError::syntax(path, "element vertex lacks one of the properties x, y, z"));
    }
    let (has_normals, has_uvs, has_colors) =
        (has(&[3, 4, 5]), has(&[6, 7]), has(&[COLOR, COLOR + 1, COLOR + 2]));
    let is_shown = |column: usize| match column {
        0..3 => true,
        3..6 => has_normals,
        6..COLOR => has_uvs,
        _ => has_colors,
    };
    for (property, column) in element.properties.iter().zip(&columns) {
        if !column.is_some_and(is_shown) {
            unread.add(&format!("vertex {}", property.name), element.count as usize);
        }
    }
    let color_scalars: [Option<Scalar>; 4] = std::array::from_fn(|channel| {
        let place = columns.iter().position(|column| *column == Some(COLOR + channel))?;
        Some(element.properties[place].scalar)
    });

    let count = element.count as usize;
    let mut positions = Vec::with_capacity(count);
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
        let [x, y, z, ..] = row;
        positions.push(DVec3::new(x, y, z));
        if has_normals {
            normals.push(std::array::from_fn(|axis| row[3 + axis] as f32));
        }
        if has_uvs {
            uvs.push([row[6], row[7]]);
        }
        if has_colors {
            colors.push(color(std::array::from_fn(|channel| row[COLOR + channel]), color_scalars));
        }
    }
    Ok(Vertices {
        positions,
        normals: has_normals.then_some(normals),
        uvs: has_uvs.then_some(uvs),
        colors: has_colors.then_some(colors),
    })
}

/// Converts a colour to linear values; a channel without a type is 1. Whole numbers are relative to the
/// largest value of their type and are sRGB, except alpha.
pub(super) fn color(values: [f64; 4], scalars: [Option<Scalar>; 4]) -> [f32; 4] {
    std::array::from_fn(|channel| match scalars[channel] {
        Some(scalar) => linear(values[channel], scalar, channel == 3),
        None => 1.0,
    })
}

fn linear(value: f64, scalar: Scalar, is_alpha: bool) -> f32 {
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
