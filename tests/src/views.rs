//! Views that cameras have in tests.

use rasray_ads::CameraView;

/// A right angle of view along z: exactly the cube's face towards +z, and the rays through its cells' centres
/// are easily named.
pub const ALONG_Z: CameraView = CameraView {
    right: [1.0, 0.0, 0.0],
    up: [0.0, 1.0, 0.0],
    forward: [0.0, 0.0, 1.0],
    half_width: 1.0,
    half_height: 1.0,
};

/// Leaning downwards, and wider than high.
pub const LEANING: CameraView = CameraView {
    right: [1.0, 0.0, 0.0],
    up: [0.0, 0.8, 0.6],
    forward: [0.0, -0.6, 0.8],
    half_width: 0.7,
    half_height: 0.5,
};

/// Turned about all axes, and twice as wide as high.
pub const TURNED: CameraView = CameraView {
    right: [-1.0 / 3.0, -2.0 / 3.0, 2.0 / 3.0],
    up: [14.0 / 15.0, -1.0 / 3.0, 2.0 / 15.0],
    forward: [2.0 / 15.0, 2.0 / 3.0, 11.0 / 15.0],
    half_width: 0.9,
    half_height: 0.45,
};
