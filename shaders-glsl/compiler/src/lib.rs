//! Compiles GLSL to SPIR-V with shaderc, for build scripts and for shader hot reload.
//!
//! This crate exists to hold the link line that Debian 12's libshaderc needs (see its build script)
//! and the options that every module of rasray is compiled with: Vulkan 1.2, no optimisation, debug names kept,
//! `#include` resolved from one root folder. Drivers optimise a module once more whatever it comes as: optimised here
//! it takes seven times as long to compile, and drivers as long to make a pipeline of it.

mod reduce;

use std::path::{Path, PathBuf};

use shaderc::{
    CompileOptions, Compiler, EnvVersion, IncludeType, OptimizationLevel, ResolvedInclude, ShaderKind,
    SourceLanguage, TargetEnv,
};

pub use reduce::without_debug_text;

/// Why a module was not compiled.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum CompileError {
    /// The entry file could not be read.
    #[error("cannot read {path}: {source}")]
    Read {
        /// The entry file.
        path: PathBuf,
        /// What the system said.
        source: std::io::Error,
    },
    /// The file name does not end in a known stage.
    #[error("{path}: the name must end in .comp, .vert or .frag")]
    Stage {
        /// The entry file.
        path: PathBuf,
    },
    /// shaderc could not be started.
    #[error("shaderc could not be initialised: {0}")]
    Shaderc(String),
    /// The compiler's own messages.
    #[error("{0}")]
    Glsl(String),
}

/// What is done to every module beside what its text says: words that were kept from before are of the same module only
/// where this is the same as well.
const OPTIONS: &str = "// Vulkan 1.2, not optimised, what the entry point reaches\n";

/// One module to compile.
#[derive(Clone, Debug)]
pub struct Module<'a> {
    /// Entry file relative to the root, such as `ads/surfaces.comp`.
    pub entry: &'a str,
    /// Macros: name and value (empty for none).
    pub defines: &'a [(String, String)],
}

/// Compiles a module whose includes are relative to `root`. Returns SPIR-V words: what its entry point reaches.
///
/// # Errors
/// The entry cannot be read, its name has no stage, or the GLSL is wrong; the message then names
/// file and line.
pub fn compile(root: &Path, module: &Module<'_>) -> Result<Vec<u32>, CompileError> {
    let (source, kind) = entry(root, module)?;
    let artifact = compiler()?
        .compile_into_spirv(&source, kind, module.entry, "main", Some(&options(root, module)?))
        .map_err(|error| CompileError::Glsl(error.to_string()))?;
    Ok(reduce::only_reached(artifact.as_binary()))
}

/// The text of a module with includes and macros expanded, after a line of options: all that its SPIR-V depends on, at
/// a fraction of the cost of compiling it.
///
/// # Errors
/// As [`compile`], as far as directives go.
pub fn preprocess(root: &Path, module: &Module<'_>) -> Result<String, CompileError> {
    let (source, _) = entry(root, module)?;
    let artifact = compiler()?
        .preprocess(&source, module.entry, "main", Some(&options(root, module)?))
        .map_err(|error| CompileError::Glsl(error.to_string()))?;
    Ok(OPTIONS.to_owned() + &artifact.as_text())
}

fn entry(root: &Path, module: &Module<'_>) -> Result<(String, ShaderKind), CompileError> {
    let path = root.join(module.entry);
    let kind = match path.extension().and_then(|e| e.to_str()) {
        Some("comp") => ShaderKind::Compute,
        Some("vert") => ShaderKind::Vertex,
        Some("frag") => ShaderKind::Fragment,
        _ => return Err(CompileError::Stage { path }),
    };
    let source = std::fs::read_to_string(&path).map_err(|source| CompileError::Read { path, source })?;
    Ok((source, kind))
}

fn compiler() -> Result<Compiler, CompileError> {
    Compiler::new().map_err(|e| CompileError::Shaderc(e.to_string()))
}

fn options(root: &Path, module: &Module<'_>) -> Result<CompileOptions<'static>, CompileError> {
    let mut options = CompileOptions::new().map_err(|e| CompileError::Shaderc(e.to_string()))?;
    options.set_source_language(SourceLanguage::GLSL);
    options.set_target_env(TargetEnv::Vulkan, EnvVersion::Vulkan1_2 as u32);
    options.set_optimization_level(OptimizationLevel::Zero);
    options.set_generate_debug_info();
    for (name, value) in module.defines {
        options.add_macro_definition(name, (!value.is_empty()).then_some(value.as_str()));
    }
    let include_root = root.to_owned();
    options.set_include_callback(move |requested, kind, from, _depth| {
        if kind == IncludeType::Standard {
            return Err(format!("{from}: write #include \"{requested}\" with quotes"));
        }
        let content = std::fs::read_to_string(include_root.join(requested))
            .map_err(|error| format!("{from}: cannot include {requested}: {error}"))?;
        Ok(ResolvedInclude { resolved_name: requested.to_owned(), content })
    });
    Ok(options)
}

/// A line of the permutation list.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Permutation {
    /// Name of the module, such as `abuffer/trace_closest`.
    pub name: String,
    /// Entry file relative to the root.
    pub entry: String,
    /// Macros: name and value.
    pub defines: Vec<(String, String)>,
    /// Cargo features that must all be on.
    pub features: Vec<String>,
}

/// Reads the permutation list: `[feature+feature]` heads a section, `name = entry MACRO=value ...` is
/// a module, `#` starts a comment.
///
/// # Errors
/// Names the line that is neither.
pub fn read_permutations(text: &str) -> Result<Vec<Permutation>, String> {
    let mut features = Vec::new();
    let mut permutations = Vec::new();
    for (number, line) in text.lines().enumerate() {
        let line = line.split('#').next().unwrap_or("").trim();
        if line.is_empty() {
            continue;
        }
        if let Some(section) = line.strip_prefix('[').and_then(|l| l.strip_suffix(']')) {
            features = section.split('+').map(|f| f.trim().to_owned()).collect();
            continue;
        }
        let (name, rest) = line
            .split_once('=')
            .ok_or_else(|| format!("line {}: expected `name = entry MACRO=value ...`", number + 1))?;
        let mut words = rest.split_whitespace();
        let entry = words.next().ok_or_else(|| format!("line {}: no entry file", number + 1))?;
        let defines = words
            .map(|word| word.split_once('=').unwrap_or((word, "")))
            .map(|(macro_name, value)| (macro_name.to_owned(), value.to_owned()))
            .collect();
        permutations.push(Permutation {
            name: name.trim().to_owned(),
            entry: entry.to_owned(),
            defines,
            features: features.clone(),
        });
    }
    Ok(permutations)
}
