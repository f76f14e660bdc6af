//! What is uploaded of a scene.

mod tables;
mod texels;
mod upload;
