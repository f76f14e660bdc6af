//! Checks of indices and positions: the requirements of a triangle that can be traced.

use std::path::Path;

use glam::DVec3;

use super::place::place;
use crate::remarks::Remarks;
use crate::{Mesh, SceneError};

/// Largest magnitude of a coordinate, metres: cross products of edges are then finite in f32.
pub const MAX_COORDINATE: f32 = 1.8e18;

/// Refuses indices that are not below the number of vertices, or not a multiple of three.
pub(super) fn check_indices(path: &Path, mesh: &Mesh) -> Result<(), SceneError> {
    if !mesh.indices.len().is_multiple_of(3) {
        return Err(SceneError::invalid(
            path,
            mesh.name.clone(),
            format!("{} indices do not make whole triangles", mesh.indices.len()),
        ));
    }
    let vertices = mesh.positions.len() as u64;
    match mesh.indices.iter().find(|&&index| u64::from(index) >= vertices) {
        Some(&index) => Err(SceneError::IndexOutOfRange {
            path: path.to_owned(),
            mesh: mesh.name.clone(),
            index: u64::from(index),
            vertices,
        }),
        None => Ok(()),
    }
}

/// Drops triangles with unusable corners, flushes subnormals, counts zero areas.
pub(super) fn clean(mesh: &mut Mesh, before: Option<&[[f32; 3]]>, remarks: &mut Remarks) {
    let place = place(mesh);
    let mut unusable = Vec::new();
    let mut flushed = 0;
    for (vertex, position) in mesh.positions.iter_mut().enumerate() {
        // Written so that NaN fails the comparison.
        if !position.iter().all(|x| x.abs() <= MAX_COORDINATE) {
            unusable.push(vertex as u32);
            *position = [0.0; 3];
        }
        for x in position.iter_mut().filter(|x| x.is_subnormal()) {
            *x = 0.0;
            flushed += 1;
        }
    }
    if !unusable.is_empty() {
        let before = mesh.indices.len() / 3;
        // `unusable` is ascending: it was filled in vertex order.
        let usable = |corner: &u32| unusable.binary_search(corner).is_err();
        mesh.indices = mesh
            .indices
            .chunks_exact(3)
            .filter(|triangle| triangle.iter().all(usable))
            .flatten()
            .copied()
            .collect();
        let dropped = before - mesh.indices.len() / 3;
        let text = format!(
            "triangles were dropped: a corner of theirs is not finite or exceeds {MAX_COORDINATE:e} m"
        );
        remarks.count("dropped-triangles", &place, dropped, text);
    }
    remarks.count("subnormal-coordinates", &place, flushed, "subnormal coordinates were set to 0");
    let positions = before.unwrap_or(&mesh.positions);
    let degenerate = mesh.indices.chunks_exact(3).filter(|corners| is_degenerate(positions, corners)).count();
    let text = "triangles have no area; they are kept and never hit";
    remarks.count("degenerate-triangles", &place, degenerate, text);
}

/// True if the area of a triangle is zero, in f64.
pub(super) fn is_degenerate(positions: &[[f32; 3]], corners: &[u32]) -> bool {
    face_normal(positions, corners) == DVec3::ZERO
}

/// Returns a triangle's normal with twice the area as length, square metres.
pub(super) fn face_normal(positions: &[[f32; 3]], corners: &[u32]) -> DVec3 {
    let corner = |k: usize| DVec3::from(positions[corners[k] as usize].map(f64::from));
    (corner(1) - corner(0)).cross(corner(2) - corner(0))
}
