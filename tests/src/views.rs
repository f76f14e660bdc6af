//! Views of cameras in tests.

use rasray_ads::CameraView;

/// Right angle of view along z: exactly the cube's face towards +z, so that rays through the cells' centres
/// are easily written.
pub const ALONG_Z: CameraView = CameraView {
    right: [1.0, 0.0, 0.0],
    up: [0.0, 1.0, 0.0],
    forward: [0.0, 0.0, 1.0],
    half_width: 1.0,
    half_height: 1.0,
};

/// View that leans downwards, and is wider than high.
pub const LEANING: CameraView = CameraView {
    right: [1.0, 0.0, 0.0],
    up: [0.0, 0.8, 0.6],
    forward: [0.0, -0.6, 0.8],
    half_width: 0.7,
    half_height: 0.5,
};

/// View that is turned about all axes, and is twice as wide as high.
pub const TURNED: CameraView = CameraView {
    right: [-1.0 / 3.0, -2.0 / 3.0, 2.0 / 3.0],
    up: [14.0 / 15.0, -1.0 / 3.0, 2.0 / 15.0],
    forward: [2.0 / 15.0, 2.0 / 3.0, 11.0 / 15.0],
    half_width: 0.9,
    half_height: 0.45,
};
