/// Origin of shadow rays of smooth surfaces.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum ShadowTerminator {
    /// Origin on the triangle: its edges show where light grazes a coarse mesh.
    #[default]
    None,
    /// Origin on the smooth shape that the normals of the vertices suggest. That shape also decides which
    /// surfaces face a light.
    Offset,
}

impl ShadowTerminator {
    /// Both choices.
    pub const ALL: [Self; 2] = [Self::None, Self::Offset];

    /// Name of the choice on the command line.
    pub const fn name(self) -> &'static str {
        match self {
            Self::None => "none",
            Self::Offset => "offset",
        }
    }

    /// Meaning of the choice, in one line of help.
    pub const fn doc(self) -> &'static str {
        match self {
            Self::None => "On the triangle: true to the mesh, whose edges show where light grazes it",
            Self::Offset => {
                "On the smooth shape that the normals suggest: coarse meshes are lit as what they stand for"
            }
        }
    }
}
