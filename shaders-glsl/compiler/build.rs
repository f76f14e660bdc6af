//! Build script that links the static archives which Debian 12's libshaderc leaves undefined.
//!
//! Debian 12 ships `libshaderc_combined.a` without glslang and SPIRV-Tools inside it. If exactly that layout
//! is found, this script names the missing archives; every other system (newer distributions, the Vulkan SDK)
//! keeps the plain path of `shaderc-sys`.

use std::path::Path;

const ARCHIVES: [&str; 10] = [
    "glslang",
    "glslang-default-resource-limits",
    "HLSL",
    "MachineIndependent",
    "GenericCodeGen",
    "OSDependent",
    "OGLCompiler",
    "SPIRV",
    "SPIRV-Tools-opt",
    "SPIRV-Tools",
];

fn main() {
    println!("cargo:rerun-if-changed=build.rs");
    let architecture = std::env::var("CARGO_CFG_TARGET_ARCH").unwrap_or_default();
    let folder = format!("/usr/lib/{architecture}-linux-gnu");
    let folder = Path::new(&folder);
    let present = |name: &str| folder.join(format!("lib{name}.a")).exists();
    if !(present("shaderc_combined") && present("MachineIndependent")) {
        return;
    }
    println!("cargo:rustc-link-search=native={}", folder.display());
    println!("cargo:rustc-link-lib=static=shaderc_combined");
    for archive in ARCHIVES {
        if present(archive) {
            println!("cargo:rustc-link-lib=static={archive}");
        }
    }
}
