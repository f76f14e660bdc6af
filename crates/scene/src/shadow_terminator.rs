/// Origin of shadow rays of smooth surfaces.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum ShadowTerminator {
    /// On the triangle: its edges show where light grazes a coarse mesh.
    #[default]
    None,
    /// On the smooth shape that the normals of its vertices suggest, which also decides what faces a light.
    Offset,
}

impl ShadowTerminator {
    /// Both.
    pub const ALL: [Self; 2] = [Self::None, Self::Offset];

    /// Its name on the command line.
    pub const fn name(self) -> &'static str {
        match self {
            Self::None => "none",
            Self::Offset => "offset",
        }
    }

    /// Meaning, in one line of help.
    pub const fn doc(self) -> &'static str {
        match self {
            Self::None => "On the triangle: true to the mesh, whose edges show where light grazes it",
            Self::Offset => {
                "On the smooth shape that the normals suggest: coarse meshes are lit as what they stand for"
            }
        }
    }
}
