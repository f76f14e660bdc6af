//! Compiles a shader of this crate that includes GLSL of rasray.

use std::path::{Path, PathBuf};

use rasray_shader_compiler::{Module, bytes, compile, without_debug_text};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    println!("cargo::rerun-if-changed=shaders");
    let rasray = PathBuf::from(std::env::var("DEP_RASRAY_SHADERS_GLSL_ROOT")?);
    let module = Module { entry: "shadow.comp", defines: &[] };
    let words = compile(&[Path::new("shaders"), &rasray], &module)?;
    let out = PathBuf::from(std::env::var("OUT_DIR")?);
    std::fs::write(out.join("shadow.spv"), bytes(&without_debug_text(&words)))?;
    Ok(())
}
