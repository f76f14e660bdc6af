//! Options of raster pipelines.

/// Options of a raster pipeline beyond the common case.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub struct RasterOptions {
    /// Cover every pixel a triangle touches; needs [`crate::Feature::ConservativeRasterization`].
    pub conservative: bool,
    /// Views drawn at once, one bit each; 0 is off. Needs [`crate::Feature::Multiview`] and
    /// [`crate::RenderArea::view_mask`] of the same value.
    pub view_mask: u32,
}
