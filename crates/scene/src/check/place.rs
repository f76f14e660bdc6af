//! Places of remarks.

use crate::Mesh;

/// A mesh as the place of a remark.
pub(super) fn place(mesh: &Mesh) -> String {
    format!("mesh {}", mesh.name)
}
