//! What every mesh must satisfy before anything else sees it, whatever format it came from.

mod attributes;
mod triangles;

use std::path::Path;

use crate::{Mesh, SceneError, Warning};

/// Largest magnitude of a coordinate, metres: its square is still finite in f32.
pub const MAX_COORDINATE: f32 = 1.8e18;

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
///   negative ones 0.
/// - An attribute with another number of elements than there are vertices is dropped.
///
/// Every drop and replacement is counted in one [`Warning`] a kind.
///
/// # Errors
/// [`SceneError::IndexOutOfRange`] if an index is not below the number of vertices, and
/// [`SceneError::Invalid`] if the number of indices is not a multiple of three.
pub fn clean_mesh(path: &Path, mesh: &mut Mesh, warnings: &mut Vec<Warning>) -> Result<(), SceneError> {
    triangles::check_indices(path, mesh)?;
    triangles::clean(mesh, warnings);
    attributes::clean(mesh, warnings);
    Ok(())
}

/// Adds a warning if `count` is not zero.
fn warn(warnings: &mut Vec<Warning>, kind: &'static str, count: usize, message: impl FnOnce() -> String) {
    if count > 0 {
        warnings.push(Warning { kind, message: message() });
    }
}
