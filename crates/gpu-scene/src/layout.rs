//! Records of the scene tables, and the viewpoint that a frame gives to structures.

use rasray_ads::{CameraView, Viewpoint};
use rasray_shaders_glsl::constants::scene::PROJECTION_PERSPECTIVE;

pub use rasray_shaders_glsl::records::{
    Draw, DrawShading, EmissiveTriangle, Frame, Light, Material, Texture, TextureRef as TextureUse,
};

/// Returns the eye of a frame and the camera's view of it; the view is absent without a perspective.
pub fn viewpoint_of(frame: &Frame) -> Viewpoint {
    let camera = CameraView {
        right: frame.camera_right,
        up: frame.camera_up,
        forward: frame.camera_forward,
        half_width: frame.half_width,
        half_height: frame.half_height,
    };
    let perspective = frame.projection == PROJECTION_PERSPECTIVE && camera.is_valid();
    Viewpoint { eye: frame.camera_position, camera: perspective.then_some(camera) }
}
