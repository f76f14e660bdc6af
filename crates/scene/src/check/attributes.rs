//! Normals, tangents, texture coordinates and colours.

use glam::{DVec3, Vec3};

use super::place::place;
use super::triangles::face_normal;
use crate::Mesh;
use crate::remarks::Remarks;

/// Tolerance of the length of a normal: a larger deviation is reported, a smaller one is rounding.
const LENGTH_TOLERANCE: f32 = 1e-2;

/// Brings every attribute into the state that [`Mesh`] promises, or drops it.
pub(super) fn clean(mesh: &mut Mesh, remarks: &mut Remarks) {
    let vertices = mesh.positions.len();
    let place = place(mesh);
    same_length(&place, "normals", vertices, &mut mesh.normals, remarks);
    same_length(&place, "tangents", vertices, &mut mesh.tangents, remarks);
    same_length(&place, "texture coordinates 0", vertices, &mut mesh.uvs[0], remarks);
    same_length(&place, "texture coordinates 1", vertices, &mut mesh.uvs[1], remarks);
    same_length(&place, "colours", vertices, &mut mesh.colors, remarks);
    clean_normals(mesh, remarks);
    clean_tangents(mesh, remarks);
    for set in mesh.uvs.iter_mut().flatten() {
        let bad = replace(set, |_, x| if x.is_finite() { x } else { 0.0 });
        let text = "texture coordinates are not finite and were set to 0";
        remarks.count("bad-texture-coordinates", &place, bad, text);
    }
    if let Some(colors) = &mut mesh.colors {
        let bad = replace(colors, |channel, x| match (x.is_finite(), channel) {
            (false, _) => 1.0,
            (true, 3) => x.clamp(0.0, 1.0),
            (true, _) => x.max(0.0),
        });
        let text = "vertex colour components are negative, above 1 for alpha, or not finite and were replaced by 0 or 1";
        remarks.count("bad-colors", &place, bad, text);
    }
}

fn same_length<T>(
    place: &str,
    what: &str,
    vertices: usize,
    attribute: &mut Option<Vec<T>>,
    remarks: &mut Remarks,
) {
    if let Some(found) = attribute.as_ref().map(Vec::len).filter(|&found| found != vertices) {
        *attribute = None;
        let text = format!("{found} {what} for {vertices} vertices; they were dropped");
        remarks.note("attribute-length", place, text);
    }
}

/// Applies `fix` to every component (the first argument is the component's index in the element) and counts
/// those that changed.
fn replace<const N: usize>(elements: &mut [[f32; N]], fix: impl Fn(usize, f32) -> f32) -> usize {
    let mut changed = 0;
    for element in elements {
        for (k, x) in element.iter_mut().enumerate() {
            let fixed = fix(k, *x);
            if fixed.to_bits() != x.to_bits() && !(fixed == 0.0 && *x == 0.0) {
                changed += 1;
            }
            *x = fixed;
        }
    }
    changed
}

/// Returns the unit vector along `v`, computed in f64 so that no finite length overflows or vanishes.
fn unit(v: [f32; 3]) -> Option<Vec3> {
    let v = DVec3::from(v.map(f64::from));
    v.is_finite().then(|| v.try_normalize()).flatten().map(|unit| unit.as_vec3())
}

fn clean_normals(mesh: &mut Mesh, remarks: &mut Remarks) {
    let Some(normals) = &mut mesh.normals else { return };
    let mut unusable = Vec::new();
    let mut rescaled = 0;
    for (vertex, normal) in normals.iter_mut().enumerate() {
        match unit(*normal) {
            Some(unit) => {
                let length = Vec3::from(*normal).length();
                if (length - 1.0).abs() > LENGTH_TOLERANCE {
                    rescaled += 1;
                }
                *normal = unit.to_array();
            }
            None => unusable.push(vertex),
        }
    }
    if unusable.len() == normals.len() {
        if !unusable.is_empty() {
            let text = "no normal has a direction; they were dropped, the mesh is flat";
            remarks.note("bad-normals", place(mesh), text);
        }
        mesh.normals = None;
        return;
    }
    let place = format!("mesh {}", mesh.name);
    let text = "normals were not of unit length; they were rescaled";
    remarks.count("bad-normals", &place, rescaled, text);
    if unusable.is_empty() {
        return;
    }
    let mut sums = vec![DVec3::ZERO; mesh.positions.len()];
    for corners in mesh.indices.chunks_exact(3) {
        let face = face_normal(&mesh.positions, corners);
        for &corner in corners {
            sums[corner as usize] += face;
        }
    }
    for &vertex in &unusable {
        normals[vertex] = sums[vertex].try_normalize().unwrap_or(DVec3::Z).as_vec3().to_array();
    }
    let text = "normals have no direction; those of their triangles took their place";
    remarks.count("bad-normals", &place, unusable.len(), text);
}

fn clean_tangents(mesh: &mut Mesh, remarks: &mut Remarks) {
    let Some(tangents) = &mut mesh.tangents else { return };
    let place = format!("mesh {}", mesh.name);
    if mesh.normals.is_none() {
        remarks.note("bad-tangents", place, "tangents without normals mean nothing; they were dropped");
        mesh.tangents = None;
        return;
    }
    let mut unusable = 0;
    for tangent in tangents.iter_mut() {
        let [x, y, z, sign] = *tangent;
        match unit([x, y, z]) {
            Some(unit) if !sign.is_nan() => {
                *tangent = unit.extend(if sign < 0.0 { -1.0 } else { 1.0 }).to_array()
            }
            _ => unusable += 1,
        }
    }
    let text = "tangents have no direction; all of their meshes were dropped and are derived where needed";
    remarks.count("bad-tangents", place, unusable, text);
    if unusable > 0 {
        mesh.tangents = None;
    }
}
