//! Frames in flight: nothing is shown that is not right, nothing is built that is not stale, and nothing is left behind.

mod crowd;
mod pictures;
mod soak;
mod stale;
