//! GLSL of rasray.
