//! Descriptions of compute and raster pipelines.

use rasray_spirv::TrustedModule;

use crate::set_layout::SetLayout;

/// Description of a compute pipeline to be made. The entry point is `main`.
#[derive(Debug, Clone, Copy)]
pub struct ComputePipelineDesc<'a> {
    /// Name for errors and tools: the path of the shader.
    pub name: &'a str,
    /// Module of the shader.
    pub module: &'a TrustedModule,
    /// Layouts of the sets, from set 0 up.
    pub sets: &'a [&'a SetLayout],
    /// Bytes of push constants, a multiple of 4.
    pub push_constant_bytes: u32,
    /// Specialisation constants: id, and bits of a 32-bit value (0 or 1 for a boolean).
    pub constants: &'a [(u32, u32)],
}

/// Description of a raster pipeline to be made. It draws triangle lists without attachments, vertex input or
/// culling; its only output is the data that its shaders store. Depth is 0 to 1, y is not flipped, viewport
/// and scissor are dynamic.
#[derive(Debug, Clone, Copy)]
pub struct RasterPipelineDesc<'a> {
    /// Name for errors and tools: the path of the shaders.
    pub name: &'a str,
    /// Module of the vertex shader.
    pub vertex_module: &'a TrustedModule,
    /// Module of the fragment shader.
    pub fragment_module: &'a TrustedModule,
    /// Layouts of the sets, from set 0 up.
    pub sets: &'a [&'a SetLayout],
    /// Bytes of push constants, a multiple of 4; both stages can read them.
    pub push_constant_bytes: u32,
    /// Specialisation constants of both stages, as in [`ComputePipelineDesc::constants`].
    pub constants: &'a [(u32, u32)],
}
