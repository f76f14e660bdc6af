//! Bounds of a scene.

use glam::DVec3;

use crate::Scene;

/// Returns the least and greatest corner, in metres, of the triangles as placed by the instances. Vertices
/// that no triangle uses do not count, nor do coordinates that are not finite. `None` without triangles.
pub fn bounds(scene: &Scene) -> Option<(DVec3, DVec3)> {
    let mut used: Vec<Option<Vec<DVec3>>> = vec![None; scene.meshes.len()];
    let mut total: Option<(DVec3, DVec3)> = None;
    for instance in &scene.instances {
        let Some(mesh) = scene.meshes.get(instance.mesh) else { continue };
        let vertices = used[instance.mesh].get_or_insert_with(|| used_positions(mesh));
        for &position in vertices.iter() {
            let point = instance.world_from_mesh.transform_point3(position);
            if point.is_finite() {
                let (low, high) = total.unwrap_or((point, point));
                total = Some((low.min(point), high.max(point)));
            }
        }
    }
    total
}

fn used_positions(mesh: &crate::Mesh) -> Vec<DVec3> {
    let mut marked = vec![false; mesh.positions.len()];
    for &index in &mesh.indices {
        if let Some(mark) = marked.get_mut(index as usize) {
            *mark = true;
        }
    }
    let kept = mesh.positions.iter().zip(marked).filter(|(_, used)| *used);
    kept.map(|(position, _)| DVec3::from_array(position.map(f64::from))).collect()
}
