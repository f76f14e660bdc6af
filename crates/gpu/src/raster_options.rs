//! Options of raster pipelines.

/// Options of a raster pipeline that most pipelines do not need.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub struct RasterOptions {
    /// True if draws cover every pixel that a triangle touches; needs
    /// [`crate::Feature::ConservativeRasterization`].
    pub conservative: bool,
    /// Mask of the views drawn at once, one bit each; 0 turns multiview off. Other values need
    /// [`crate::Feature::Multiview`], and [`crate::RenderArea::view_mask`] with the same value.
    pub view_mask: u32,
}
