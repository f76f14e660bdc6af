//! Errors of traced hits and rendered images against the truth, and the confidence in them.
//!
//! - [`HitConfusion`] compares a structure's hits with exact verdicts, ray by ray.
//! - [`ImageError`] compares an image with a reference.
//! - [`Rate`] gives every counted rate a confidence interval, [`Summary`] every measured series its
//!   median and spread.
//!
//! Nothing here knows a device; all of it is arithmetic on slices.

mod beta;
mod error;
#[cfg(feature = "flip")]
mod flip;
mod hits;
mod image;
mod image_error;
mod rate;
mod ssim;
mod statistics;
mod tone;

pub use error::MetricsError;
#[cfg(feature = "flip")]
pub use flip::{Flip, VISIBLE, flip, flip_map};
pub use hits::{DeviceHit, HitConfusion, Truth, common_hits};
pub use image::Image;
pub use image_error::ImageError;
pub use rate::{Rate, confidence_of_each};
pub use ssim::ssim;
pub use statistics::{Percentiles, Summary, median, median_of_means, percentile};
pub use tone::{Tone, ToneCurve, display_values, tone_map};

/// Compiles the examples of the readme.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
