//! rasray: gpu-scene.
