//! Area of a rendering.

/// Area of a rendering: a number of pixels, without images.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct RenderArea {
    /// Width in pixels.
    pub width: u32,
    /// Height in pixels.
    pub height: u32,
    /// Layers that the vertex shader can choose from; ignored with a view mask.
    pub layers: u32,
    /// Mask of the views drawn at once, one bit each; 0 turns multiview off.
    pub view_mask: u32,
}
