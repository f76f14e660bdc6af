//! Scenes from files and from code: what is read, refused and remarked on.

mod builtin_scenes;
mod default_view;
mod deforming;
mod facing_of_scenes;
mod far_coordinates;
mod foreign_files;
mod gltf_cameras;
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
mod needs_default_view;
mod needs_of_scenes;
mod obj_corpus;
mod obj_dialects;
mod obj_reading;
mod ply_faces;
mod ply_reading;
mod polygons;
mod poses;
