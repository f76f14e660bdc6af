//! Folder of compiled modules: `prebuilt`, as in packages.
//!
//! `modules.txt` next to the modules tells from which GLSL and with which features they were made, and lists
//! each with a hash of its bytes.

use std::collections::BTreeSet;
use std::fmt::Write as _;
use std::path::Path;

use crate::{feature_is_on, packed, read, write_changed};

/// Compiled module.
pub(crate) struct Built {
    /// Name of the module in the permutation list.
    pub(crate) name: String,
    /// Entry file relative to the root.
    pub(crate) entry: String,
    /// Features that the module needs.
    pub(crate) features: Vec<String>,
}

/// Returns the name of the file that holds a module, packed.
pub(crate) fn file_of(name: &str) -> String {
    format!("{}.packed", name.replace('/', "."))
}

/// Computes the FNV-1a hash, which detects mistakes, but not intentional changes.
pub(crate) fn hash(bytes: &[u8]) -> u64 {
    bytes
        .iter()
        .fold(0xcbf2_9ce4_8422_2325, |hash, byte| (hash ^ u64::from(*byte)).wrapping_mul(0x100_0000_01b3))
}

/// Returns the features that are on and decide which modules exist.
fn features() -> BTreeSet<String> {
    let on = std::env::vars_os().filter_map(|(name, _)| name.into_string().ok());
    let on =
        on.filter_map(|name| Some(name.strip_prefix("CARGO_FEATURE_")?.to_lowercase().replace('_', "-")));
    on.filter(|feature| !["default", "compile", "debug-shaders"].contains(&feature.as_str())).collect()
}

/// Writes a folder of the modules in `out`.
pub(crate) fn write_prebuilt(
    folder: &Path,
    out: &Path,
    sources: u64,
    modules: &[Built],
) -> Result<(), String> {
    std::fs::create_dir_all(folder).map_err(|e| format!("{}: {e}", folder.display()))?;
    let features = Vec::from_iter(features()).join(" ");
    let mut text = format!("sources {sources:016x}\nfeatures {features}\n");
    for Built { name, entry, features } in modules {
        let path = out.join(file_of(name));
        let packed = std::fs::read(&path).map_err(|e| format!("{}: {e}", path.display()))?;
        write_changed(&folder.join(file_of(name)), &packed)?;
        let _ = writeln!(text, "module {name} {entry} {} {:016x}", features.join("+"), hash(&packed));
    }
    write_changed(&folder.join("modules.txt"), text.as_bytes())
}

/// Index of a folder of modules.
pub(crate) struct Index {
    sources: u64,
    features: BTreeSet<String>,
    /// Modules with the hashes of their files.
    modules: Vec<(Built, u64)>,
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
                ["module", name, entry, features, hash] => {
                    let features = features.split('+').map(str::to_owned).collect();
                    let built = Built { name: name.to_owned(), entry: entry.to_owned(), features };
                    index.modules.push((built, number(hash)?));
                }
                _ => return Err(format!("{}: cannot read `{line}`", path.display())),
            }
        }
        Ok(index)
    }

    /// Returns the features that are on, but with which no module was made.
    pub(crate) fn lacks(&self) -> Vec<String> {
        features().difference(&self.features).cloned().collect()
    }

    /// Copies the modules whose features are on to `out`.
    ///
    /// # Errors
    /// The modules were made of other sources, or a file differs from its hash.
    pub(crate) fn take(self, folder: &Path, out: &Path, sources: u64) -> Result<Vec<Built>, String> {
        if self.sources != sources {
            return Err("they were made from other GLSL than that next to them".to_owned());
        }
        let is_on = |module: &Built| module.features.iter().all(|feature| feature_is_on(feature));
        let modules = self.modules.into_iter().filter(|(module, _)| is_on(module));
        let copied = modules.map(|(module, expected)| {
            let file = file_of(&module.name);
            let packed = std::fs::read(folder.join(&file)).map_err(|e| format!("{file}: {e}"))?;
            if hash(&packed) != expected || packed::unpack(&packed).is_none() {
                return Err(format!("{file} is not what was compiled"));
            }
            write_changed(&out.join(file), &packed)?;
            Ok(module)
        });
        copied.collect()
    }
}
