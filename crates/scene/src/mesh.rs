//! Triangle meshes.

/// Indexed triangles with optional attributes. Every index is below `positions.len()`;
/// attribute arrays, where present, have the length of `positions`.
#[derive(Clone, Debug, Default)]
pub struct Mesh {
    /// Name from the file, or a generated one.
    pub name: String,
    /// Positions of the vertices, metres, mesh space. Finite, magnitude at most 1.8e18.
    pub positions: Vec<[f32; 3]>,
    /// Unit shading normals; absent means flat.
    pub normals: Option<Vec<[f32; 3]>>,
    /// Unit tangents; w is the sign of the bitangent.
    pub tangents: Option<Vec<[f32; 4]>>,
    /// Texture coordinates of set 0 and set 1.
    pub uvs: [Option<Vec<[f32; 2]>>; 2],
    /// Linear RGBA colours of vertices, multiplied into the base colour.
    pub colors: Option<Vec<[f32; 4]>>,
    /// Indices of vertices, three per triangle.
    pub indices: Vec<u32>,
    /// Index into `Scene::materials`.
    pub material: usize,
}

impl Mesh {
    /// Returns the number of triangles.
    pub fn triangle_count(&self) -> usize {
        self.indices.len() / 3
    }
}
