//! Vertex attributes interpolated over a triangle, with defaults where a mesh has none.

use glam::{Vec2, Vec3, Vec4};
use rasray_scene::Mesh;

use super::posed::Draw;

pub fn uv_at(mesh: &Mesh, uv_set: u32, vertex: usize) -> Vec2 {
    mesh.uvs[uv_set.min(1) as usize].as_ref().map_or(Vec2::ZERO, |uvs| Vec2::from(uvs[vertex]))
}

pub fn uv(mesh: &Mesh, uv_set: u32, triangle: [usize; 3], weights: Vec3) -> Vec2 {
    let [a, b, c] = triangle.map(|vertex| uv_at(mesh, uv_set, vertex));
    weights.x * a + weights.y * b + weights.z * c
}

/// Returns the vertex colour; white if the mesh has no colours.
pub fn color(mesh: &Mesh, triangle: [usize; 3], weights: Vec3) -> Vec4 {
    mesh.colors.as_ref().map_or(Vec4::ONE, |colors| {
        let [a, b, c] = triangle.map(|vertex| Vec4::from(colors[vertex]));
        weights.x * a + weights.y * b + weights.z * c
    })
}

/// Returns the interpolated normal, not normalised; zero if the mesh is flat.
pub fn normal(draw: &Draw, triangle: [usize; 3], weights: Vec3) -> Vec3 {
    draw.normals.as_ref().map_or(Vec3::ZERO, |normals| {
        let [a, b, c] = triangle.map(|vertex| normals[vertex]);
        weights.x * a + weights.y * b + weights.z * c
    })
}

/// Returns the interpolated tangent: xyz not normalised, w the sign of the bitangent; zero if the mesh has no
/// tangents.
pub fn tangent(draw: &Draw, triangle: [usize; 3], weights: Vec3) -> Vec4 {
    draw.tangents.as_ref().map_or(Vec4::ZERO, |tangents| {
        let [a, b, c] = triangle.map(|vertex| tangents[vertex]);
        (weights.x * a + weights.y * b + weights.z * c).truncate().extend(a.w)
    })
}
