//! Compiled modules in a folder: `prebuilt`, as packages have it.
//!
//! `modules.txt` next to the modules says of which GLSL and with which features they were made, and lists
//! each with a hash of its bytes.

use std::collections::BTreeSet;
use std::fmt::Write as _;
use std::path::Path;

use crate::{feature_is_on, packed, read, write_changed};

/// A module that was compiled.
pub(crate) struct Built {
    /// Its name in the permutation list.
    pub(crate) name: String,
    /// Entry file relative to the root.
    pub(crate) entry: String,
    /// Features that it is there with.
    pub(crate) features: Vec<String>,
}

/// The file that holds a module, packed.
pub(crate) fn file_of(name: &str) -> String {
    format!("{}.packed", name.replace('/', "."))
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

/// Makes a folder of the modules in `out`.
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
    /// With the hashes of their files.
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
