//! Compiler of the modules of `permutations.txt`.
//!
//! With the feature `debug-shaders` names and source text stay in the modules; without it they are left out,
//! since they are more than half of all bytes. `RASRAY_SHADER_CACHE` names a folder that builds of several
//! profiles share, so that a module is compiled once for all of them.

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Mutex, PoisonError};

use rasray_shader_compiler::{
    Module, Permutation, bytes, compile, preprocess, read_permutations, without_debug_text,
};

use crate::modules::{Built, hash};
use crate::{feature_is_on, pack, packed, read, write_changed};

/// Compiles every module whose features are on into `out`.
pub(crate) fn modules(root: &Path, out: &Path) -> Result<Vec<Built>, String> {
    println!("cargo::rerun-if-env-changed=RASRAY_SHADER_CACHE");
    let list = read(&root.join("permutations.txt"))?;
    let mut permutations = read_permutations(&list).map_err(|e| format!("permutations.txt: {e}"))?;
    check_features(&permutations, &read(&root.join("Cargo.toml"))?)?;
    permutations.retain(|permutation| permutation.features.iter().all(|feature| feature_is_on(feature)));
    compile_all(root, out, &permutations)?;
    let built = permutations.into_iter().map(|Permutation { name, entry, features, .. }| Built {
        name,
        entry,
        features,
    });
    Ok(built.collect())
}

/// Refuses a module of a feature that the manifest does not have: nothing could ever turn it on.
fn check_features(permutations: &[Permutation], manifest: &str) -> Result<(), String> {
    let rows = manifest.lines().skip_while(|line| *line != "[features]").skip(1);
    let rows = rows.take_while(|line| !line.starts_with('['));
    let known: BTreeSet<&str> = rows.filter_map(|line| Some(line.split_once('=')?.0.trim())).collect();
    for Permutation { name, features, .. } in permutations {
        if let Some(unknown) = features.iter().find(|feature| !known.contains(feature.as_str())) {
            return Err(format!("permutations.txt: {name}: Cargo.toml has no feature `{unknown}`"));
        }
    }
    Ok(())
}

/// Compiles modules on as many threads as cargo grants. The error describes the first module of the list that
/// fails.
fn compile_all(root: &Path, out: &Path, permutations: &[Permutation]) -> Result<(), String> {
    let threads = std::env::var("NUM_JOBS").ok().and_then(|jobs| jobs.parse().ok()).unwrap_or(1);
    let next = AtomicUsize::new(0);
    let results = Mutex::new(BTreeMap::new());
    std::thread::scope(|scope| {
        for _ in 0..threads {
            scope.spawn(|| {
                while let Some((place, permutation)) = take(permutations, &next) {
                    let result = compile_one(root, out, permutation)
                        .map_err(|message| format!("{}: {message}", permutation.name));
                    results.lock().unwrap_or_else(PoisonError::into_inner).insert(place, result);
                }
            });
        }
    });
    results.into_inner().unwrap_or_else(PoisonError::into_inner).into_values().collect()
}

/// Takes the next module that no thread has taken yet, with its place in the list.
fn take<'a>(permutations: &'a [Permutation], next: &AtomicUsize) -> Option<(usize, &'a Permutation)> {
    let place = next.fetch_add(1, Ordering::Relaxed);
    permutations.get(place).map(|permutation| (place, permutation))
}

/// Writes a module in packed form, compiled unless the cache has it.
fn compile_one(root: &Path, out: &Path, permutation: &Permutation) -> Result<(), String> {
    let module = Module { entry: &permutation.entry, defines: &permutation.defines };
    let text = preprocess(&[root], &module).map_err(|e| e.to_string())?;
    let cache = std::env::var_os("RASRAY_SHADER_CACHE").map_or_else(|| out.join("cache"), PathBuf::from);
    let kept = cache.join(format!("{:016x}", hash(text.as_bytes())));
    let words = match read_kept(&kept, &text) {
        Some(words) => words,
        None => {
            let words = compile(&[root], &module).map_err(|e| e.to_string())?;
            keep(&kept, &text, &words)?;
            words
        }
    };
    let words = if feature_is_on("debug-shaders") { words } else { without_debug_text(&words) };
    let packed = pack::pack(&words).filter(|packed| packed::unpack(packed).as_deref() == Some(&words));
    let packed = packed.ok_or("its SPIR-V cannot be packed")?;
    write_changed(&out.join(crate::modules::file_of(&permutation.name)), &packed)
}

/// Reads the words that are kept for a text with includes and macros expanded; `None` if nothing or another
/// text is kept.
fn read_kept(kept: &Path, text: &str) -> Option<Vec<u32>> {
    if std::fs::read_to_string(kept.with_extension("txt")).ok()? != text {
        return None;
    }
    let bytes = std::fs::read(kept.with_extension("spv")).ok()?;
    let (words, rest) = bytes.as_chunks::<4>();
    rest.is_empty().then(|| words.iter().map(|word| u32::from_le_bytes(*word)).collect())
}

/// Keeps words for a text. Each file appears as a whole, since other builds may look for it; the text comes
/// last, because it vouches for both files.
fn keep(kept: &Path, text: &str, words: &[u32]) -> Result<(), String> {
    let put = |extension: &str, bytes: &[u8]| {
        let path = kept.with_extension(extension);
        let begun = kept.with_extension(format!("{extension}.{}", std::process::id()));
        std::fs::create_dir_all(kept.parent().unwrap_or(kept))
            .and_then(|()| std::fs::write(&begun, bytes))
            .and_then(|()| std::fs::rename(&begun, &path))
            .map_err(|e| format!("{}: {e}", path.display()))
    };
    put("spv", &bytes(words))?;
    put("txt", text.as_bytes())
}
