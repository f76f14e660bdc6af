//! All GLSL of rasray as SPIR-V, compiled when this crate is built, and the numbers that shaders and
//! Rust share.
//!
//! A module is compiled iff it is listed in `permutations.txt` and the features of its section are
//! on, so an embedder of one structure builds the modules of that structure alone. No compiler is
//! needed at run time. [`layout`] reads names, offsets and sizes of buffer members back out of a
//! module; tests hold the Rust structs against them.

pub mod layout;

/// Numbers generated from the shared GLSL files.
pub mod constants {
    include!(concat!(env!("OUT_DIR"), "/constants.rs"));
}

include!(concat!(env!("OUT_DIR"), "/shaders.rs"));

/// SPIR-V is read word by word, so its bytes are kept on word boundaries.
#[repr(C, align(4))]
struct Aligned<T: ?Sized>(T);

/// A compiled module.
pub struct Shader {
    /// Name in the permutation list; also the label of its pass.
    pub name: &'static str,
    /// Entry file relative to the shader root.
    pub entry: &'static str,
    bytes: &'static Aligned<[u8]>,
}

impl Shader {
    /// The module's words.
    pub fn words(&self) -> &'static [u32] {
        // SPIR-V modules are whole words by definition, and `Aligned` keeps them on word boundaries.
        bytemuck::cast_slice(&self.bytes.0)
    }
}

impl std::fmt::Debug for Shader {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Shader").field("name", &self.name).field("entry", &self.entry).finish_non_exhaustive()
    }
}

/// The module of that name, if it was compiled.
pub fn shader(name: &str) -> Option<&'static Shader> {
    ALL.iter().copied().find(|shader| shader.name == name)
}

/// The module's words.
///
/// # Panics
/// If no module of that name was compiled: the name is misspelt or its feature is off.
pub fn spirv(name: &str) -> &'static [u32] {
    shader(name).unwrap_or_else(|| panic!("no shader module `{name}` was compiled")).words()
}
