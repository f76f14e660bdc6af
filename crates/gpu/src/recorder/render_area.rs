//! Areas that are drawn into.

/// Area that is drawn into: a number of pixels, no images.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct RenderArea {
    /// Width in pixels.
    pub width: u32,
    /// Height in pixels.
    pub height: u32,
    /// Layers that the vertex shader can choose from; ignored with a view mask.
    pub layers: u32,
    /// Views drawn at once, one bit each; 0 is off.
    pub view_mask: u32,
}
