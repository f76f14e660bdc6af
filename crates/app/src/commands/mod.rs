//! Commands of the program, one per word.

mod ablate;
mod campaign;
mod compare;
mod denoise;
mod documents;
mod frames;
mod hard;
mod images;
mod info;
mod merge;
mod merge_cells;
mod picture_targets;
mod pictures;
mod render;
mod replicate;
mod sheets;
mod steps;
mod subject;
mod targets;
mod view;

pub(crate) use ablate::ablate;
pub(crate) use compare::compare;
pub(crate) use documents::{completions, man};
pub(crate) use info::info;
pub(crate) use merge::merge;
pub(crate) use render::render;
pub(crate) use replicate::replicate;
pub(crate) use view::view;
