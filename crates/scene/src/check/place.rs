//! Texts that name the place of a remark.

use crate::Mesh;

/// Names a mesh as the place of a remark.
pub(super) fn place(mesh: &Mesh) -> String {
    format!("mesh {}", mesh.name)
}
