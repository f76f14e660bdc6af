//! Division of meshes whose groups lie far apart, so that each part can have an origin of its own.

use std::collections::HashMap;

use glam::DVec3;

use super::geometry::Geometry;
use crate::origin::apart;
use rasray_scene::Mesh;

/// Statement `g` or `o` within a mesh.
#[derive(Clone, Debug)]
pub(super) struct Group {
    pub name: String,
    /// Index of the group's first face in the indices of the mesh.
    pub first: usize,
}

/// Divides meshes by the groups of each. Faces keep their order.
pub(super) fn divide(geometry: &mut Geometry, groups: &[Vec<Group>]) {
    let meshes = std::mem::take(&mut geometry.meshes);
    let positions = std::mem::take(&mut geometry.positions);
    let uvs = std::mem::take(&mut geometry.uvs);
    for (((mesh, positions), uvs), groups) in meshes.into_iter().zip(positions).zip(uvs).zip(groups) {
        let ends = groups.iter().skip(1).map(|group| group.first).chain([mesh.indices.len()]);
        let spans: Vec<_> = groups.iter().zip(ends).map(|(group, end)| group.first..end).collect();
        let clusters = apart(spans.iter().map(|span| &mesh.indices[span.clone()]), &positions);
        if clusters.iter().all(|&cluster| cluster == 0) {
            geometry.add(mesh, positions, uvs);
            continue;
        }
        let mut first = 0;
        for run in clusters.chunk_by(|a, b| a == b) {
            let span = spans[first].start..spans[first + run.len() - 1].end;
            let part = part(&mesh, &mesh.indices[span], &positions, uvs.as_deref());
            let name = if first == 0 { &mesh.name } else { &groups[first].name };
            geometry.add(Mesh { name: name.clone(), ..part.0 }, part.1, part.2);
            first += run.len();
        }
    }
}

/// Returns some triangles of a mesh, with the vertices that they use in the order of their first use.
fn part(
    mesh: &Mesh,
    indices: &[u32],
    positions: &[DVec3],
    uvs: Option<&[[f64; 2]]>,
) -> (Mesh, Vec<DVec3>, Option<Vec<[f64; 2]>>) {
    let mut places = HashMap::new();
    let mut used = Vec::new();
    let place = |&index: &u32| {
        *places.entry(index).or_insert_with(|| {
            used.push(index as usize);
            (used.len() - 1) as u32
        })
    };
    let indices = indices.iter().map(place).collect();
    let normals = mesh.normals.as_ref().map(|normals| used.iter().map(|&index| normals[index]).collect());
    let part = Mesh { indices, normals, material: mesh.material, ..Mesh::default() };
    let uvs = uvs.map(|uvs| used.iter().map(|&index| uvs[index]).collect());
    (part, used.iter().map(|&index| positions[index]).collect(), uvs)
}
