//! Built-in scenes for the tests of this program, and their triangle counts.

use rasray_scene::Scene;
use rasray_scene::builtin::builtin;

/// Makes a built-in scene.
pub fn scene(spec: &str) -> Scene {
    builtin(spec).unwrap_or_else(|| panic!("{spec} is a built-in")).unwrap_or_else(|error| panic!("{error}"))
}

/// Counts the triangles of all instances.
pub fn placed_triangles(scene: &Scene) -> usize {
    scene.instances.iter().map(|instance| scene.meshes[instance.mesh].triangle_count()).sum()
}
