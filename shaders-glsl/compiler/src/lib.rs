//! Compiles GLSL to SPIR-V with shaderc, for build scripts.
//!
//! This crate exists to hold the link line that Debian 12's libshaderc needs (see its build script)
//! and the options that every module of rasray is compiled with: Vulkan 1.2, no optimisation, debug names
//! kept, `#include` resolved from root folders, by way of folders that macros name. Drivers optimise a module
//! once more whatever it comes as: optimised here, a module takes seven times as long to compile, and drivers
//! need as long as before to make a pipeline of it.
//!
//! # A shader of one's own
//!
//! The `build.rs` of a crate that traces from a shader of its own, `shaders/shadow.comp`, which includes
//! `bricks/trace.glsl`. `rasray-shaders-glsl` is among its dependencies and tells it where the GLSL is; this
//! crate is among its build dependencies.
//!
//! ```no_run
//! use std::path::{Path, PathBuf};
//!
//! use rasray_shader_compiler::{Module, bytes, compile, without_debug_text};
//!
//! fn main() -> Result<(), Box<dyn std::error::Error>> {
//!     println!("cargo::rerun-if-changed=shaders");
//!     // Set by the build script of rasray-shaders-glsl for the crates that name it as a dependency.
//!     let rasray = PathBuf::from(std::env::var("DEP_RASRAY_SHADERS_GLSL_ROOT")?);
//!     let module = Module { entry: "shadow.comp", defines: &[] };
//!     let words = compile(&[Path::new("shaders"), &rasray], &module)?;
//!     let out = PathBuf::from(std::env::var("OUT_DIR")?);
//!     std::fs::write(out.join("shadow.spv"), bytes(&without_debug_text(&words)))?;
//!     Ok(())
//! }
//! ```

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

use shaderc::{
    CompileOptions, Compiler, EnvVersion, IncludeType, OptimizationLevel, ResolvedInclude, ShaderKind,
    SourceLanguage, TargetEnv,
};

pub use rasray_spirv::without_debug_text;

/// Reason for which a module was not compiled.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum CompileError {
    /// The entry file could not be read.
    #[error("cannot read {path}: {source}")]
    Read {
        /// Path of the entry file.
        path: PathBuf,
        /// Error of the operating system.
        source: std::io::Error,
    },
    /// The file name does not end in a known stage.
    #[error("{path}: the name must end in .comp, .vert or .frag")]
    Stage {
        /// Path of the entry file.
        path: PathBuf,
    },
    /// shaderc could not be started.
    #[error("shaderc could not be initialised: {0}")]
    Shaderc(String),
    /// The GLSL is wrong; the text holds the compiler's own messages.
    #[error("{0}")]
    Glsl(String),
}

/// Options of every module in addition to its text: kept words belong to the module only if these are equal
/// as well.
const OPTIONS: &str = "// Vulkan 1.2, not optimised, what the entry point reaches\n";

/// Module to compile.
#[derive(Clone, Debug)]
pub struct Module<'a> {
    /// Entry file relative to a root, such as `ads/surfaces.comp`.
    pub entry: &'a str,
    /// Macros: name and value (empty for none).
    pub defines: &'a [(String, String)],
}

/// Compiles a module, and returns the SPIR-V words of everything that its entry point reaches. The entry and
/// its includes are relative to the roots; a file is read from the first root that has it.
///
/// # Errors
/// No root has the entry, its name has no stage, or the GLSL is wrong; the message then names file and line.
pub fn compile(roots: &[impl AsRef<Path>], module: &Module<'_>) -> Result<Vec<u32>, CompileError> {
    let roots = owned(roots);
    let (source, kind) = entry(&roots, module)?;
    let artifact = compiler()?
        .compile_into_spirv(&source, kind, module.entry, "main", Some(&options(roots, module)?))
        .map_err(|error| CompileError::Glsl(error.to_string()))?;
    Ok(rasray_spirv::only_reached(artifact.as_binary()))
}

/// Expands includes and macros in the text of a module, after a line of options. The result is everything
/// that the SPIR-V depends on, at a fraction of the cost of compiling it.
///
/// # Errors
/// As for [`compile`], as far as directives are concerned.
pub fn preprocess(roots: &[impl AsRef<Path>], module: &Module<'_>) -> Result<String, CompileError> {
    let roots = owned(roots);
    let (source, _) = entry(&roots, module)?;
    let artifact = compiler()?
        .preprocess(&source, module.entry, "main", Some(&options(roots, module)?))
        .map_err(|error| CompileError::Glsl(error.to_string()))?;
    Ok(OPTIONS.to_owned() + &artifact.as_text())
}

/// Converts SPIR-V words to the bytes of a file.
pub fn bytes(words: &[u32]) -> Vec<u8> {
    words.iter().flat_map(|word| word.to_le_bytes()).collect()
}

fn owned(roots: &[impl AsRef<Path>]) -> Vec<PathBuf> {
    roots.iter().map(|root| root.as_ref().to_owned()).collect()
}

/// Reads the text of a file from the first root that has it; the error is that of the last root.
fn read(roots: &[PathBuf], name: &str) -> std::io::Result<String> {
    let mut missing = std::io::Error::other("there is no root folder");
    for root in roots {
        match std::fs::read_to_string(root.join(name)) {
            Err(error) if error.kind() == std::io::ErrorKind::NotFound => missing = error,
            found => return found,
        }
    }
    Err(missing)
}

fn entry(roots: &[PathBuf], module: &Module<'_>) -> Result<(String, ShaderKind), CompileError> {
    let path = PathBuf::from(module.entry);
    let kind = match path.extension().and_then(|e| e.to_str()) {
        Some("comp") => ShaderKind::Compute,
        Some("vert") => ShaderKind::Vertex,
        Some("frag") => ShaderKind::Fragment,
        _ => return Err(CompileError::Stage { path }),
    };
    let source = read(roots, module.entry).map_err(|source| CompileError::Read { path, source })?;
    Ok((source, kind))
}

fn compiler() -> Result<Compiler, CompileError> {
    Compiler::new().map_err(|e| CompileError::Shaderc(e.to_string()))
}

fn options(roots: Vec<PathBuf>, module: &Module<'_>) -> Result<CompileOptions<'static>, CompileError> {
    let mut options = CompileOptions::new().map_err(|e| CompileError::Shaderc(e.to_string()))?;
    options.set_source_language(SourceLanguage::GLSL);
    options.set_target_env(TargetEnv::Vulkan, EnvVersion::Vulkan1_2 as u32);
    options.set_optimization_level(OptimizationLevel::Zero);
    options.set_generate_debug_info();
    for (name, value) in module.defines {
        options.add_macro_definition(name, (!value.is_empty()).then_some(value.as_str()));
    }
    let defines = module.defines.to_owned();
    options.set_include_callback(move |requested, kind, from, _depth| {
        let resolved_name = resolved(requested, &defines);
        // A file that is requested with quotes and not found is requested again as if it were in angle
        // brackets.
        if kind == IncludeType::Standard {
            return Err(format!(
                "{from}: cannot include {resolved_name}: no root folder has it, or it is not in quotes"
            ));
        }
        let content = read(&roots, &resolved_name)
            .map_err(|error| format!("{from}: cannot include {resolved_name}: {error}"))?;
        Ok(ResolvedInclude { resolved_name, content })
    });
    Ok(options)
}

/// Returns the file that an include names: if its first folder is a macro's name in lower case, the value of
/// the macro replaces it. `structure/trace.glsl` with `STRUCTURE=bvh` is `bvh/trace.glsl`.
fn resolved(requested: &str, defines: &[(String, String)]) -> String {
    let (folder, file) = requested.split_once('/').unwrap_or(("", requested));
    match defines.iter().find(|(name, value)| name.to_lowercase() == folder && !value.is_empty()) {
        Some((_, value)) => format!("{value}/{file}"),
        None => requested.to_owned(),
    }
}

/// Line of the permutation list.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Permutation {
    /// Name of the module, such as `bvh/trace`.
    pub name: String,
    /// Entry file relative to the root.
    pub entry: String,
    /// Macros: name and value.
    pub defines: Vec<(String, String)>,
    /// Cargo features that must all be on.
    pub features: Vec<String>,
}

impl Permutation {
    /// Returns this module with pools reached by address.
    fn by_address(&self) -> Self {
        let mut twin = self.clone();
        twin.name += ".address";
        twin.defines.push(("ADDRESSING_ADDRESS".to_owned(), String::new()));
        twin
    }

    /// Returns a module for each pair of `structures` if a macro is `A<B=*`: the two structures are the
    /// values of A and B, and replace them in its name and features. Otherwise returns the module itself.
    ///
    /// # Errors
    /// `A<B` has another value than `*`.
    fn pairs(&self, structures: &BTreeSet<String>) -> Result<Vec<Self>, String> {
        let Some((place, first, second)) = self.defines.iter().enumerate().find_map(|(place, (name, _))| {
            name.split_once('<').map(|(first, second)| (place, first.to_owned(), second.to_owned()))
        }) else {
            return Ok(vec![self.clone()]);
        };
        if self.defines[place].1 != "*" {
            return Err(format!("only `*` may stand behind `{first}<{second}=`"));
        }
        let pairs = structures.iter().flat_map(|one| {
            structures.iter().filter(move |other| one < *other).map(move |other| (one, other))
        });
        let pairs = pairs.map(|(one, other)| {
            let mut pair = self.clone();
            let named = |text: &str| text.replace(&first, one).replace(&second, other);
            pair.name = named(&pair.name);
            pair.features.iter_mut().for_each(|feature| *feature = named(feature));
            let values = [(first.clone(), one.clone()), (second.clone(), other.clone())];
            pair.defines.splice(place..=place, values);
            pair
        });
        Ok(pairs.collect())
    }
}

/// Expands a line with `{x,y}` into one line for each choice in the name; the group at the same place after
/// the `=` takes its choice at the same place. A choice may be empty.
fn choices(line: &str) -> Result<Vec<String>, String> {
    let (name, rest) = line.split_once('=').ok_or("expected `name = entry MACRO=value ...`")?;
    let group = |text: &str| -> Option<[String; 3]> {
        let (before, behind) = text.split_once('{')?;
        let (within, after) = behind.split_once('}')?;
        Some([before, within, after].map(str::to_owned))
    };
    let ([before, within, after], [rest_before, rest_within, rest_after]) = match (group(name), group(rest)) {
        (None, None) => return Ok(vec![line.to_owned()]),
        (Some(of_name), Some(of_rest)) => (of_name, of_rest),
        _ => return Err("the name has as many `{...}` as what follows `=`".to_owned()),
    };
    let (named, chosen): (Vec<_>, Vec<_>) = (within.split(',').collect(), rest_within.split(',').collect());
    if named.len() != chosen.len() {
        return Err(format!("`{{{within}}}` has not as many choices as `{{{rest_within}}}`"));
    }
    let mut lines = Vec::new();
    for (name, choice) in named.into_iter().zip(chosen) {
        lines.extend(choices(&format!("{before}{name}{after}={rest_before}{choice}{rest_after}"))?);
    }
    Ok(lines)
}

/// Returns the folder of a module if its entry is in another one: the structure that a shared entry is
/// compiled for.
fn structure_of<'a>(name: &'a str, entry: &str) -> Option<&'a str> {
    let (folder, _) = name.split_once('/')?;
    (entry.split('/').next() != Some(folder)).then_some(folder)
}

/// Reads the permutation list, `permutations.txt` of `rasray-shaders-glsl`, which describes its lines. `#`
/// starts a comment.
///
/// # Errors
/// A line has none of these forms; the message names it.
pub fn read_permutations(text: &str) -> Result<Vec<Permutation>, String> {
    let (mut features, mut by_address) = (Vec::new(), false);
    let mut permutations = Vec::new();
    let mut structures = BTreeSet::new();
    for (number, line) in text.lines().enumerate() {
        let line = line.split('#').next().unwrap_or("").trim();
        if line.is_empty() {
            continue;
        }
        if let Some((section, ending)) = line.strip_prefix('[').and_then(|line| line.split_once(']')) {
            features = section.split('+').map(|f| f.trim().to_owned()).collect();
            by_address = match ending.trim() {
                "" => false,
                ".address" => true,
                _ => return Err(format!("line {}: only `.address` may stand after a section", number + 1)),
            };
            continue;
        }
        for line in choices(line).map_err(|wrong| format!("line {}: {wrong}", number + 1))? {
            let (name, rest) = line.split_once('=').unwrap_or_default();
            let mut words = rest.split_whitespace();
            let entry = words.next().ok_or_else(|| format!("line {}: no entry file", number + 1))?;
            let own: Vec<_> = words.map(|word| word.split_once('=').unwrap_or((word, ""))).collect();
            let implied = structure_of(name.trim(), entry).map(|structure| ("STRUCTURE", structure));
            if implied.is_some() && own.iter().any(|(name, _)| *name == "STRUCTURE") {
                return Err(format!("line {}: the folder of the module says its STRUCTURE", number + 1));
            }
            let defines = implied
                .into_iter()
                .chain(own)
                .map(|(macro_name, value)| (macro_name.to_owned(), value.to_owned()))
                .collect();
            let line = Permutation {
                name: name.trim().to_owned(),
                entry: entry.to_owned(),
                defines,
                features: features.clone(),
            };
            if by_address {
                let values = line.defines.iter().filter(|(name, _)| name == "STRUCTURE");
                structures.extend(values.map(|(_, value)| value.clone()));
            }
            let modules = line.pairs(&structures).map_err(|wrong| format!("line {}: {wrong}", number + 1))?;
            for module in modules {
                let twin = by_address.then(|| module.by_address());
                permutations.extend([Some(module), twin].into_iter().flatten());
            }
        }
    }
    Ok(permutations)
}

/// Compiles the examples of the readme as documentation tests.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;

#[cfg(test)]
mod tests {
    use super::*;

    fn names(text: &str) -> Vec<String> {
        let list = read_permutations(text).expect("the list is well formed");
        list.into_iter()
            .map(|module| {
                let defines = module.defines.iter().map(|(name, value)| format!(" {name}={value}"));
                module.name + &defines.collect::<String>()
            })
            .collect()
    }

    #[test]
    fn sections_choices_and_pairs_stand_for_several_modules() {
        assert_eq!(names("[a]\nx = x.comp M=1 # why\n"), ["x M=1"]);
        assert_eq!(names("[a]\nx{,.r} = x.comp M=1 {,R}"), ["x M=1", "x.r M=1 R="]);
        assert_eq!(
            names("[a]\nx{.p,.q}{.r,.s} = x{_1,_2}.comp M={R,S}"),
            ["x.p.r M=R", "x.p.s M=S", "x.q.r M=R", "x.q.s M=S"]
        );
        let entries = read_permutations("[a]\nx_{p,q} = y_{p,q}.comp").expect("the list is well formed");
        assert_eq!(
            entries.into_iter().map(|module| module.entry).collect::<Vec<_>>(),
            ["y_p.comp", "y_q.comp"]
        );
        for wrong in
            ["x{p,q} = x.comp", "x = x.comp M={P,Q}", "x{p,q} = x.comp M={P,Q,R}", "x{p = x.comp {P}"]
        {
            let error = read_permutations(&format!("[a]\n{wrong}\n")).expect_err(wrong);
            assert!(error.contains("line 2") && error.contains('{'), "{error}");
        }
        assert_eq!(
            names("[a+b] .address\nx = x.comp M=1\n[c]\ny = y.comp"),
            ["x M=1", "x.address M=1 ADDRESSING_ADDRESS=", "y"]
        );
        assert_eq!(
            names("[a]\np/x = all/x.comp M=1\np/y = p/y.comp M=1"),
            ["p/x STRUCTURE=p M=1", "p/y M=1"]
        );
        let all = "[q] .address\nq/x = x.comp\n[p] .address\np/x = x.comp\np/y = y.comp
            [r]\nr/x = x.comp\n[s] .address\ns/x = x.comp\n[t+A+B]\nt.A.B = t.comp A<B=*\n";
        let pairs = ["t.p.q A=p B=q", "t.p.s A=p B=s", "t.q.s A=q B=s"];
        assert!(names(all).ends_with(&pairs.map(str::to_owned)));
        let pair = read_permutations(all).expect("the list is well formed").pop().expect("a pair");
        assert_eq!(pair.features, ["t", "q", "s"]);
        let error = read_permutations("[t+A+B]\nt.A.B = t.comp A<B=p,q\n").expect_err("it names the pair");
        assert!(error.contains("line 2") && error.contains("A<B"), "{error}");
        let error = read_permutations("[a]\np/x = all/x.comp STRUCTURE=q\n").expect_err("two structures");
        assert!(error.contains("line 2") && error.contains("STRUCTURE"), "{error}");
        assert!(read_permutations("[a] .else\n").is_err());
        assert!(read_permutations("[a]\nx x.comp\n").is_err());
    }

    #[test]
    fn a_file_is_read_from_the_first_root_that_has_it() {
        let folder = std::env::temp_dir().join(format!("rasray-roots-{}", std::process::id()));
        let (own, other) = (folder.join("own"), folder.join("other"));
        for (root, name, text) in [
            (
                &own,
                "main.comp",
                "#version 460\n#include \"both.glsl\"\n#include \"shared.glsl\"\nvoid main() {}\n",
            ),
            (&own, "both.glsl", "const int OWN = 1;\n"),
            (&other, "both.glsl", "const int OTHER = 1;\n"),
            (&other, "shared.glsl", "const int SHARED = 1;\n"),
        ] {
            std::fs::create_dir_all(root).expect("a folder");
            std::fs::write(root.join(name), text).expect("a file");
        }
        let module = Module { entry: "main.comp", defines: &[] };
        let text = preprocess(&[&own, &other], &module).expect("both roots are searched");
        assert!(text.contains("OWN") && text.contains("SHARED") && !text.contains("OTHER"), "{text}");
        let error = preprocess(&[&own], &module).expect_err("one root lacks a file").to_string();
        assert!(error.contains("cannot include shared.glsl"), "{error}");
        assert!(matches!(preprocess(&[&other], &module), Err(CompileError::Read { .. })));
        std::fs::remove_dir_all(&folder).expect("the folder goes");
    }

    #[test]
    fn includes_are_read_from_the_folder_that_a_macro_names() {
        let defines =
            [("STRUCTURE".to_owned(), "bvh".to_owned()), ("CONSERVATIVE".to_owned(), String::new())];
        assert_eq!(resolved("structure/trace.glsl", &defines), "bvh/trace.glsl");
        assert_eq!(resolved("conservative/trace.glsl", &defines), "conservative/trace.glsl");
        assert_eq!(resolved("trace.glsl", &defines), "trace.glsl");
    }
}
