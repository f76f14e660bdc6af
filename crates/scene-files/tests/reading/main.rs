//! Scenes from files: what is read, refused and remarked on.

mod far_coordinates;
mod foreign_files;
mod gltf_cameras;
#[cfg(feature = "meshopt")]
mod gltf_compressed;
mod gltf_content;
mod gltf_corpus;
mod gltf_damaged;
mod gltf_graph;
mod gltf_images;
mod gltf_motion;
mod gltf_refusals;
mod gltf_remarks;
mod gltf_skins;
mod gltf_support;
mod obj_corpus;
mod obj_dialects;
mod obj_reading;
mod ply_faces;
mod ply_reading;
mod polygons;
mod real_scenes;
mod sequences;
