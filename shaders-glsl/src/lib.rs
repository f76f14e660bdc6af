//! All GLSL of rasray, the same as SPIR-V, and what shaders and Rust share, generated from the GLSL:
//! [numbers](constants), [records] of buffers, and [ids of specialisation constants](constant_ids).
//!
//! A module is there iff it is listed in `permutations.txt` and the features of its section are
//! on, so an embedder of one structure has the modules of that structure alone. Packages hold the modules
//! ready made; with the feature `compile`, and in the repository, they are compiled when this crate is built.
//! No compiler is needed at run time.
//!
//! A shader of one's own includes files of this crate (`bricks/trace.glsl`): its compiler is told [`ROOT`],
//! which the build script of a crate that names this one as a dependency finds in
//! `DEP_RASRAY_SHADERS_GLSL_ROOT`; the crate `rasray-shader-compiler` has an example. [`layout`] reads names,
//! offsets and sizes of buffer members back out of a module; tests hold [records] against them.

use rasray_spirv::TrustedModule;

pub mod layout;
mod packed;
pub mod records;

/// Ids of specialisation constants, generated from the GLSL that declares them. No two constants have one id.
pub mod constant_ids {
    include!(concat!(env!("OUT_DIR"), "/constant_ids.rs"));
}

/// Numbers generated from the shared GLSL files.
pub mod constants {
    include!(concat!(env!("OUT_DIR"), "/constants.rs"));
}

include!(concat!(env!("OUT_DIR"), "/shaders.rs"));
include!(concat!(env!("OUT_DIR"), "/files.rs"));

/// Folder that all includes are relative to, on the machine where this crate was built. Programs that run
/// elsewhere, or later, use [`files`].
pub const ROOT: &str = env!("CARGO_MANIFEST_DIR");

/// File with GLSL.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct GlslFile {
    /// Name of the file relative to [`ROOT`], with `/` between folders, as an include names it.
    pub name: &'static str,
    /// Whole text of the file.
    pub text: &'static str,
}

/// Returns all GLSL files, in the order of names, whatever features are on.
pub fn files() -> &'static [GlslFile] {
    FILES
}

/// Compiled module.
pub struct Shader {
    /// Name in the permutation list; also the label of its pass.
    pub name: &'static str,
    /// Entry file relative to the shader root.
    pub entry: &'static str,
    packed: &'static [u8],
}

impl Shader {
    /// Unpacks the module's words, which programs hold in a quarter of their bytes; this takes a few
    /// milliseconds for the largest module.
    pub fn words(&self) -> Vec<u32> {
        packed::unpack(self.packed).expect("the build script unpacks every module once")
    }

    /// Unpacks the module for a pipeline, in the time that [`Shader::words`] takes.
    pub fn module(&self) -> TrustedModule {
        // SAFETY: the words are those that the compiler made of the GLSL in this crate. Its shaders compare
        // each index with the length of a buffer or with a capacity in a header, and follow the addresses of
        // pools in headers. Headers are written by the crates that own them, whose documentation says that
        // their counts are trusted.
        unsafe { TrustedModule::new(self.words().into()) }
    }
}

impl std::fmt::Debug for Shader {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Shader").field("name", &self.name).field("entry", &self.entry).finish_non_exhaustive()
    }
}

/// Returns the module of that name, if it was compiled.
pub fn shader(name: &str) -> Option<&'static Shader> {
    ALL.iter().copied().find(|shader| shader.name == name)
}

// These modules are parts of the build script, included here for their tests.
#[cfg(test)]
#[path = "../build/comments.rs"]
mod comments;
#[cfg(test)]
#[path = "../build/constant_ids.rs"]
mod constant_ids_of_glsl;
#[cfg(test)]
#[path = "../build/pack.rs"]
mod pack;
#[cfg(test)]
#[path = "../build/records.rs"]
mod records_of_glsl;

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn packed_modules_are_the_same_once_unpacked() {
        let (mut bytes, mut packed_bytes) = (0, 0);
        for shader in ALL {
            let words = shader.words();
            let packed = pack::pack(&words).expect("it is SPIR-V");
            assert_eq!(packed, shader.packed, "{}", shader.name);
            assert_eq!(packed::unpack(&packed[..packed.len() - 1]), None, "{}", shader.name);
            bytes += size_of_val(&words[..]);
            packed_bytes += packed.len();
        }
        assert!(packed_bytes < bytes / 2, "{packed_bytes} of {bytes}");
        assert!(!ALL.is_empty() && pack::pack(&[1, 2, 3, 4, 5, 0]).is_none());
        // The words are numbers of every size, and an instruction whose end is missing.
        let words = [1, 2, 3, 4, 5, 4 << 16 | 400, u32::MAX, 0, 70_000];
        assert_eq!(
            pack::pack(&words).and_then(|packed| packed::unpack(&packed)).as_deref(),
            Some(&words[..])
        );
        assert!(pack::pack(&words[..8]).is_none());
    }

    /// Counts the instructions of a module's entry point after every call is replaced by the called function,
    /// as drivers compile it.
    fn expanded_length(words: &[u32]) -> usize {
        // A function's contents are its own instructions, and the functions that it calls.
        let mut functions: std::collections::HashMap<u32, (usize, Vec<u32>)> =
            std::collections::HashMap::new();
        let (mut entry, mut function, mut place) = (None, None, 5);
        while place < words.len() {
            let (length, operation) = ((words[place] >> 16) as usize, words[place] & 0xFFFF);
            match operation {
                // OpEntryPoint, OpFunction, OpFunctionEnd
                15 => entry = entry.or(Some(words[place + 2])),
                54 => function = Some(words[place + 2]),
                56 => function = None,
                // These are lines of source, variables, labels and instructions that only name where branches
                // meet again.
                8 | 317 | 59 | 246 | 247 | 248 => {}
                _ => {
                    if let Some(function) = function {
                        let (own, calls) = functions.entry(function).or_default();
                        *own += 1;
                        // OpFunctionCall
                        if operation == 57 {
                            calls.push(words[place + 3]);
                        }
                    }
                }
            }
            place += length;
        }
        let mut open = vec![entry.expect("a module has an entry point")];
        let mut sum = 0;
        while let Some(function) = open.pop() {
            let (own, calls) = &functions[&function];
            sum += own;
            open.extend(calls);
        }
        sum
    }

    /// Checks that no function is called at too many places: a driver compiles it as often, which takes most
    /// of the time to a first picture and of the tests on drivers that compile on the processor.
    #[test]
    fn no_module_holds_many_copies_of_a_long_function() {
        let mut longer = Vec::new();
        for shader in ALL.iter().filter(|shader| !shader.name.contains("/test_")) {
            let structure = shader.name.split('/').next().unwrap_or_default();
            let most = match (shader.entry, structure) {
                ("ads/surfaces.comp" | "integrators/visibility_resolve.comp", _) => 5_000,
                // Masks, backs and hits find data of a triangle by its id, which parts of a geometry look up.
                ("ads/trace.comp", "brute" | "bvh" | "bricks" | "grid") => 10_000,
                // Anisotropic materials have a texture and tangents of their own.
                ("integrators/path_shade.comp", _) if shader.name.ends_with(".hits") => 25_000,
                // Gathering photons asks all lobes for their value, as light samples do.
                ("integrators/path_shade.comp", _) if shader.name.ends_with(".photons") => 25_000,
                ("integrators/path_shade.comp", _) => 20_000,
                _ => 32_000,
            };
            let length = expanded_length(&shader.words());
            if length > most {
                longer.push(format!(
                    "{} has {length} instructions, and at most {most} were meant",
                    shader.name
                ));
            }
        }
        assert!(longer.is_empty(), "{}", longer.join("\n"));
    }

    #[test]
    fn records_without_default_are_records() {
        for name in records_of_glsl::ZEROS_MISLEAD {
            assert!(records::ALL.iter().any(|record| record.name == name), "{name}");
        }
    }

    #[test]
    fn files_are_those_of_the_root() {
        let names: Vec<_> = files().iter().map(|file| file.name).collect();
        assert!(
            names.is_sorted() && names.contains(&"contract/select.glsl") && names.len() > 200,
            "{names:?}"
        );
        for file in files() {
            let path = std::path::Path::new(ROOT).join(file.name);
            assert_eq!(std::fs::read_to_string(path).expect("it is there"), file.text, "{}", file.name);
        }
        let entries = ALL.iter().all(|shader| names.contains(&shader.entry));
        assert!(entries, "a module's entry is among the files");
    }
}
