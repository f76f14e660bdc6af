//! Frames in flight: nothing is shown that is not right, nothing is built that is not stale, and nothing is
//! left behind.

mod adaptive;
mod bands;
mod changing;
mod crowd;
mod kept;
mod nearer_part;
mod objects;
mod parts;
mod pictures;
mod refresh;
mod scenes;
mod shadows;
mod soak;
mod stale;
