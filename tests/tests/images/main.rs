//! Rendered images against closed forms, and how errors fall: `docs/image-truth.md`.

mod convergence;
mod truth;
