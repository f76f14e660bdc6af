//! Small glTF files as text, with their data in a `data:` URI.

/// File with one mesh, indexed by u32.
pub(super) struct GltfText {
    /// Positions, metres.
    pub positions: Vec<[f32; 3]>,
    /// Unit normals; none for a flat mesh.
    pub normals: Vec<[f32; 3]>,
    /// Corners of the primitive, as indices into `positions`.
    pub indices: Vec<u32>,
    /// Mode of the primitive: 4 for a list of triangles, as the format numbers them.
    pub mode: u32,
    /// List of nodes in JSON; `"mesh":0` places the mesh.
    pub nodes: String,
}

impl GltfText {
    /// Makes a file with one placed triangle.
    pub fn triangle() -> Self {
        Self {
            positions: vec![[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]],
            normals: Vec::new(),
            indices: vec![0, 1, 2],
            mode: 4,
            nodes: r#"[{"mesh":0}]"#.to_owned(),
        }
    }

    /// Returns the text of the file.
    pub fn text(&self) -> String {
        let floats = |list: &[[f32; 3]]| -> Vec<u8> {
            list.as_flattened().iter().flat_map(|x| x.to_le_bytes()).collect()
        };
        let parts = [
            floats(&self.positions),
            floats(&self.normals),
            self.indices.iter().flat_map(|index| index.to_le_bytes()).collect(),
        ];
        let vectors = |view: usize, count: usize| {
            format!(r#"{{"bufferView":{view},"componentType":5126,"count":{count},"type":"VEC3"}}"#)
        };
        let (mut views, mut accessors) = (Vec::new(), Vec::new());
        let mut attributes = r#""POSITION":0"#.to_owned();
        let mut bytes: Vec<u8> = Vec::new();
        let mut append = |part: &[u8], accessor: String| {
            views.push(format!(r#"{{"buffer":0,"byteOffset":{},"byteLength":{}}}"#, bytes.len(), part.len()));
            accessors.push(accessor);
            bytes.extend_from_slice(part);
            accessors.len() - 1
        };
        append(&parts[0], vectors(0, self.positions.len()));
        if !self.normals.is_empty() {
            let accessor = append(&parts[1], vectors(1, self.normals.len()));
            attributes.push_str(&format!(r#","NORMAL":{accessor}"#));
        }
        let view = if self.normals.is_empty() { 1 } else { 2 };
        let indices = append(
            &parts[2],
            format!(
                r#"{{"bufferView":{view},"componentType":5125,"count":{},"type":"SCALAR"}}"#,
                self.indices.len()
            ),
        );
        let escaped: String = bytes.iter().map(|byte| format!("%{byte:02X}")).collect();
        format!(
            r#"{{"asset":{{"version":"2.0"}},
"buffers":[{{"byteLength":{},"uri":"data:application/octet-stream,{escaped}"}}],
"bufferViews":[{}],
"accessors":[{}],
"meshes":[{{"primitives":[{{"attributes":{{{attributes}}},"indices":{indices},"mode":{}}}]}}],
"nodes":{}}}"#,
            bytes.len(),
            views.join(","),
            accessors.join(","),
            self.mode,
            self.nodes
        )
    }
}
