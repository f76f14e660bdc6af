//! Scenes made in code: built-in ones, poses, default views, and the needs of workloads.

mod builtin_page;
mod builtin_scenes;
mod closed_scenes;
mod default_view;
mod deforming;
mod facing_of_scenes;
mod made;
mod needs_default_view;
mod needs_of_scenes;
mod poses;
mod stadium;
