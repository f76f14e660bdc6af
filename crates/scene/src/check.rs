//! Checks and repairs of every mesh before other code sees it, whatever format it came from.

mod attributes;
mod place;
mod textures;
mod triangles;

use std::path::Path;

use crate::remarks::Remarks;
use crate::{Mesh, SceneError, Warning};

pub use textures::textured;
pub use triangles::MAX_COORDINATE;

/// Brings a mesh into the state that [`Mesh`] promises.
///
/// - Triangles with a corner that is not finite or beyond [`MAX_COORDINATE`] are dropped; the
///   position of such a vertex becomes the origin, no triangle uses it any more.
/// - Subnormal coordinates become zero.
/// - Triangles of zero area are kept (no ray hits them) and counted.
/// - Normals become unit; one that cannot is replaced by that of its triangles. If none is usable
///   the attribute is dropped, and the mesh is flat.
/// - Tangents become unit with w = -1 or 1; they are dropped if any is unusable, or without normals.
/// - Texture coordinates that are not finite become 0, colours that are not finite become 1 and
///   negative ones 0; alpha becomes at most 1.
/// - An attribute with another number of elements than there are vertices is dropped.
///
/// Every drop and replacement is counted in one [`Warning`] a kind.
///
/// # Errors
/// [`SceneError::IndexOutOfRange`] if an index is not below the number of vertices, and
/// [`SceneError::Invalid`] if the number of indices is not a multiple of three.
pub fn clean_mesh(path: &Path, mesh: &mut Mesh, warnings: &mut Vec<Warning>) -> Result<(), SceneError> {
    let mut remarks = Remarks::default();
    clean(path, mesh, &mut remarks)?;
    warnings.extend(remarks.into_warnings());
    Ok(())
}

/// Cleans a mesh as [`clean_mesh`] does and notes remarks instead of warnings.
pub fn clean(path: &Path, mesh: &mut Mesh, remarks: &mut Remarks) -> Result<(), SceneError> {
    clean_deformed(path, mesh, None, remarks)
}

/// Cleans a mesh in its pose at rest as [`clean`] does; `before` are its positions before joints and morph
/// targets deform it. Only triangles without area in `before` are remarked on: a deformation that flattens
/// others for a while is no fault of the file.
pub fn clean_deformed(
    path: &Path,
    mesh: &mut Mesh,
    before: Option<&[[f32; 3]]>,
    remarks: &mut Remarks,
) -> Result<(), SceneError> {
    triangles::check_indices(path, mesh)?;
    triangles::clean(mesh, before, remarks);
    attributes::clean(mesh, remarks);
    Ok(())
}

/// True if no triangle has an area. Indices need not have been checked.
pub(crate) fn is_flattened(mesh: &Mesh) -> bool {
    let is_whole = |corners: &[u32]| corners.iter().all(|&corner| (corner as usize) < mesh.positions.len());
    let mut triangles = mesh.indices.chunks_exact(3);
    triangles.all(|corners| is_whole(corners) && triangles::is_degenerate(&mesh.positions, corners))
}

/// Does the part of [`clean`] that concerns normals, tangents, texture coordinates and colours.
pub(crate) fn clean_attributes(mesh: &mut Mesh, remarks: &mut Remarks) {
    attributes::clean(mesh, remarks);
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Makes two triangles over four corners of the unit square.
    fn square() -> Mesh {
        Mesh {
            name: "square".to_owned(),
            positions: vec![[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [1.0, 1.0, 0.0]],
            indices: vec![0, 1, 2, 2, 1, 3],
            ..Mesh::default()
        }
    }

    fn cleaned(mesh: &mut Mesh) -> Vec<&'static str> {
        let mut warnings = Vec::new();
        clean_mesh(Path::new("square"), mesh, &mut warnings).expect("indices in range");
        warnings.iter().map(|warning| warning.kind).collect()
    }

    #[test]
    fn a_good_mesh_is_left_alone() {
        let mut mesh = square();
        mesh.normals = Some(vec![[0.0, 0.0, 1.0]; 4]);
        mesh.tangents = Some(vec![[1.0, 0.0, 0.0, -1.0]; 4]);
        mesh.uvs[1] = Some(vec![[-3.0, 1e6]; 4]);
        mesh.colors = Some(vec![[2.0, 0.0, -0.0, 1.0]; 4]);
        let before = mesh.clone();
        assert!(cleaned(&mut mesh).is_empty());
        assert_eq!(format!("{mesh:?}").replace("-0.0", "0.0"), format!("{before:?}").replace("-0.0", "0.0"));
    }

    #[test]
    fn indices_are_checked_first() {
        let path = Path::new("square");
        for index in [4, 5, u32::MAX] {
            let mut mesh = square();
            mesh.indices[4] = index;
            match clean_mesh(path, &mut mesh, &mut Vec::new()) {
                Err(SceneError::IndexOutOfRange { index: found, vertices: 4, .. }) => {
                    assert_eq!(found, u64::from(index));
                }
                other => panic!("{index}: {other:?}"),
            }
        }
        let mut mesh = square();
        mesh.indices.pop();
        assert!(matches!(clean_mesh(path, &mut mesh, &mut Vec::new()), Err(SceneError::Invalid { .. })));
        assert!(cleaned(&mut Mesh::default()).is_empty(), "an empty mesh is fine");
    }

    #[test]
    fn a_bad_corner_takes_its_triangles_along() {
        for (bad, left) in [(0, vec![2, 1, 3]), (3, vec![0, 1, 2]), (1, vec![])] {
            let mut mesh = square();
            mesh.positions[bad][1] = f32::NAN;
            assert_eq!(cleaned(&mut mesh), ["dropped-triangles"]);
            assert_eq!(mesh.indices, left);
            assert_eq!(mesh.positions[bad], [0.0; 3]);
        }
    }

    #[test]
    fn alpha_is_at_most_one() {
        let mut mesh = square();
        mesh.colors = Some(vec![[2.0, 3.0, 4.0, 1.5]; 4]);
        assert_eq!(cleaned(&mut mesh), ["bad-colors"]);
        assert_eq!(mesh.colors, Some(vec![[2.0, 3.0, 4.0, 1.0]; 4]));
    }

    #[test]
    fn unusable_normals_are_replaced_or_dropped() {
        let mut mesh = square();
        mesh.normals = Some(vec![[0.0, 0.0, 3.0], [f32::NAN, 0.0, 0.0], [0.0; 3], [1e-30, 0.0, 0.0]]);
        assert_eq!(cleaned(&mut mesh), ["bad-normals", "bad-normals"]);
        let normals = mesh.normals.expect("some were usable");
        assert_eq!(normals, [[0.0, 0.0, 1.0], [0.0, 0.0, 1.0], [0.0, 0.0, 1.0], [1.0, 0.0, 0.0]]);
        let mut mesh = square();
        mesh.normals = Some(vec![[0.0; 3]; 4]);
        assert_eq!(cleaned(&mut mesh), ["bad-normals"]);
        assert!(mesh.normals.is_none());
    }

    #[test]
    fn tangents_are_all_good_or_absent() {
        let mut mesh = square();
        mesh.normals = Some(vec![[0.0, 0.0, 1.0]; 4]);
        mesh.tangents = Some(vec![[0.0, 2.0, 0.0, 0.5]; 4]);
        assert!(cleaned(&mut mesh).is_empty());
        assert_eq!(mesh.tangents, Some(vec![[0.0, 1.0, 0.0, 1.0]; 4]));
        mesh.tangents =
            Some(vec![[1.0, 0.0, 0.0, 1.0], [0.0; 4], [1.0, 0.0, 0.0, 1.0], [1.0, 0.0, 0.0, 1.0]]);
        assert_eq!(cleaned(&mut mesh), ["bad-tangents"]);
        assert!(mesh.tangents.is_none());
        let mut mesh = square();
        mesh.tangents = Some(vec![[1.0, 0.0, 0.0, 1.0]; 4]);
        assert_eq!(cleaned(&mut mesh), ["bad-tangents"]);
        assert!(mesh.tangents.is_none(), "tangents need normals");
    }

    #[test]
    fn other_attributes_become_finite() {
        let mut mesh = square();
        mesh.uvs[0] = Some(vec![[f32::NAN, 1.0], [0.0, f32::INFINITY], [0.0; 2], [1.0; 2]]);
        mesh.colors = Some(vec![[f32::NAN, -1.0, 0.5, 1.0]; 4]);
        mesh.uvs[1] = Some(vec![[0.0; 2]; 3]);
        assert_eq!(cleaned(&mut mesh), ["attribute-length", "bad-texture-coordinates", "bad-colors"]);
        assert_eq!(mesh.uvs[0].as_ref().map(|set| set[..2].to_vec()), Some(vec![[0.0, 1.0], [0.0, 0.0]]));
        assert_eq!(mesh.colors.as_ref().map(|set| set[0]), Some([1.0, 0.0, 0.5, 1.0]));
        assert!(mesh.uvs[1].is_none());
    }
}
