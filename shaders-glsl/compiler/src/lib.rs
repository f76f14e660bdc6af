//! Compiles GLSL to SPIR-V.
pub use shaderc;
