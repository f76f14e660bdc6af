//! Normals, tangents, texture coordinates and colours.

use glam::{DVec3, Vec3};

use super::triangles::face_normal;
use super::warn;
use crate::{Mesh, Warning};

/// A normal whose length is off by more than this is reported; below, it is rounding.
const LENGTH_TOLERANCE: f32 = 1e-2;

/// Brings every attribute to its promise or drops it.
pub(super) fn clean(mesh: &mut Mesh, warnings: &mut Vec<Warning>) {
    let vertices = mesh.positions.len();
    let name = mesh.name.clone();
    same_length(&name, "normals", vertices, &mut mesh.normals, warnings);
    same_length(&name, "tangents", vertices, &mut mesh.tangents, warnings);
    same_length(&name, "texture coordinates 0", vertices, &mut mesh.uvs[0], warnings);
    same_length(&name, "texture coordinates 1", vertices, &mut mesh.uvs[1], warnings);
    same_length(&name, "colours", vertices, &mut mesh.colors, warnings);
    clean_normals(mesh, warnings);
    clean_tangents(mesh, warnings);
    for set in mesh.uvs.iter_mut().flatten() {
        let bad = replace(set, |x| if x.is_finite() { x } else { 0.0 });
        warn(warnings, "bad-texture-coordinates", bad, || {
            format!("mesh {name}: {bad} texture coordinates are not finite and were set to 0")
        });
    }
    if let Some(colors) = &mut mesh.colors {
        let bad = replace(colors, |x| if x.is_finite() { x.max(0.0) } else { 1.0 });
        warn(warnings, "bad-colors", bad, || {
            format!(
                "mesh {name}: {bad} vertex colour components are negative or not finite and were replaced by 0 or 1"
            )
        });
    }
}

fn same_length<T>(
    name: &str,
    what: &str,
    vertices: usize,
    attribute: &mut Option<Vec<T>>,
    warnings: &mut Vec<Warning>,
) {
    if let Some(found) = attribute.as_ref().map(Vec::len).filter(|&found| found != vertices) {
        *attribute = None;
        warn(warnings, "attribute-length", 1, || {
            format!("mesh {name}: {found} {what} for {vertices} vertices; they were dropped")
        });
    }
}

/// Applies `fix` to every component and counts those that changed.
fn replace<const N: usize>(elements: &mut [[f32; N]], fix: impl Fn(f32) -> f32) -> usize {
    let mut changed = 0;
    for x in elements.iter_mut().flatten() {
        let fixed = fix(*x);
        if fixed.to_bits() != x.to_bits() && !(fixed == 0.0 && *x == 0.0) {
            changed += 1;
        }
        *x = fixed;
    }
    changed
}

/// The unit vector along `v`, computed in f64 so that no finite length overflows or vanishes.
fn unit(v: [f32; 3]) -> Option<Vec3> {
    let v = DVec3::from(v.map(f64::from));
    v.is_finite().then(|| v.try_normalize()).flatten().map(|unit| unit.as_vec3())
}

fn clean_normals(mesh: &mut Mesh, warnings: &mut Vec<Warning>) {
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
    let name = &mesh.name;
    if unusable.len() == normals.len() {
        warn(warnings, "bad-normals", normals.len(), || {
            format!("mesh {name}: no normal has a direction; they were dropped, the mesh is flat")
        });
        mesh.normals = None;
        return;
    }
    warn(warnings, "bad-normals", rescaled, || {
        format!("mesh {name}: {rescaled} normals were not of unit length; they were rescaled")
    });
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
    warn(warnings, "bad-normals", unusable.len(), || {
        format!(
            "mesh {name}: {} normals have no direction; those of their triangles took their place",
            unusable.len()
        )
    });
}

fn clean_tangents(mesh: &mut Mesh, warnings: &mut Vec<Warning>) {
    let Some(tangents) = &mut mesh.tangents else { return };
    let name = &mesh.name;
    if mesh.normals.is_none() {
        warn(warnings, "bad-tangents", 1, || {
            format!("mesh {name}: tangents without normals mean nothing; they were dropped")
        });
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
    warn(warnings, "bad-tangents", unusable, || {
        format!(
            "mesh {name}: {unusable} tangents have no direction; all were dropped and are derived where needed"
        )
    });
    if unusable > 0 {
        mesh.tangents = None;
    }
}
