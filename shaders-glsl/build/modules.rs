//! Folders of modules: what lies in them, and what they were made of.
//!
//! `modules.txt` beside the modules says of which GLSL and with which features they were made, and names each with a
//! hash of its bytes. Build folders have it, and so does `prebuilt`, which is one of them in a package.

use std::collections::BTreeSet;
use std::fmt::Write as _;
use std::path::Path;

use crate::{feature_is_on, read, write_changed};

/// A module that was compiled.
pub(crate) struct Built {
    /// Its name in the permutation list.
    pub(crate) name: String,
    /// Entry file relative to the root.
    pub(crate) entry: String,
    /// Features that it is there with.
    pub(crate) features: Vec<String>,
    /// Of its bytes.
    pub(crate) hash: u64,
}

/// The file that holds a module's SPIR-V.
pub(crate) fn file_of(name: &str) -> String {
    format!("{}.spv", name.replace('/', "."))
}

/// FNV-1a: tells files that differ by mistake apart, not by intent.
pub(crate) fn hash(bytes: &[u8]) -> u64 {
    bytes
        .iter()
        .fold(0xcbf2_9ce4_8422_2325, |hash, byte| (hash ^ u64::from(*byte)).wrapping_mul(0x100_0000_01b3))
}

/// Features that are on and decide which modules there are.
fn features() -> BTreeSet<String> {
    let on = std::env::vars_os().filter_map(|(name, _)| name.into_string().ok());
    let on =
        on.filter_map(|name| Some(name.strip_prefix("CARGO_FEATURE_")?.to_lowercase().replace('_', "-")));
    on.filter(|feature| !["default", "compile", "debug-shaders"].contains(&feature.as_str())).collect()
}

/// Says in `out` what its modules were made of.
pub(crate) fn write_index(out: &Path, sources: u64, modules: &[Built]) -> Result<(), String> {
    let features = Vec::from_iter(features()).join(" ");
    let mut text = format!("sources {sources:016x}\nfeatures {features}\n");
    for module in modules {
        let Built { name, entry, features, hash } = module;
        let _ = writeln!(text, "module {name} {entry} {} {hash:016x}", features.join("+"));
    }
    write_changed(&out.join("modules.txt"), text.as_bytes())
}

/// What a folder of modules says of itself.
pub(crate) struct Index {
    sources: u64,
    features: BTreeSet<String>,
    modules: Vec<Built>,
}

impl Index {
    pub(crate) fn read(folder: &Path) -> Result<Self, String> {
        let path = folder.join("modules.txt");
        let mut index = Self { sources: 0, features: BTreeSet::new(), modules: Vec::new() };
        for line in read(&path)?.lines() {
            let words: Vec<_> = line.split_whitespace().collect();
            let number = |word: &str| {
                u64::from_str_radix(word, 16).map_err(|e| format!("{}: {line}: {e}", path.display()))
            };
            match words[..] {
                ["sources", sources] => index.sources = number(sources)?,
                ["features", ref features @ ..] => {
                    index.features = features.iter().map(|&f| f.to_owned()).collect()
                }
                ["module", name, entry, features, hash] => index.modules.push(Built {
                    name: name.to_owned(),
                    entry: entry.to_owned(),
                    features: features.split('+').map(str::to_owned).collect(),
                    hash: number(hash)?,
                }),
                _ => return Err(format!("{}: cannot read `{line}`", path.display())),
            }
        }
        Ok(index)
    }

    /// Features that are on and that no module was made with.
    pub(crate) fn lacks(&self) -> Vec<String> {
        features().difference(&self.features).cloned().collect()
    }

    /// Copies those modules to `out` whose features are on.
    ///
    /// # Errors
    /// They were made of other sources than those, or one is not what it was.
    pub(crate) fn take(self, folder: &Path, out: &Path, sources: u64) -> Result<Vec<Built>, String> {
        if self.sources != sources {
            return Err("they were made of other GLSL than what lies beside them".to_owned());
        }
        let is_on = |module: &Built| module.features.iter().all(|feature| feature_is_on(feature));
        let modules: Vec<_> = self.modules.into_iter().filter(is_on).collect();
        for module in &modules {
            let file = file_of(&module.name);
            let bytes = std::fs::read(folder.join(&file)).map_err(|e| format!("{file}: {e}"))?;
            if hash(&bytes) != module.hash {
                return Err(format!("{file} is not what was compiled"));
            }
            write_changed(&out.join(&file), &bytes)?;
        }
        Ok(modules)
    }
}
