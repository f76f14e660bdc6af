//! Errors of traced hits and rendered images against the truth, and the confidence in them. Comparisons,
//! reports and tests measure with this crate. All of it is arithmetic on slices, without a device.
//!
//! - [`HitConfusion`] compares a structure's hits with exact verdicts, ray by ray.
//! - [`ImageError`] compares an image with a reference; [`flip()`] and [`ssim()`] are perceptual measures.
//! - [`Rate`] gives a counted rate its confidence interval, [`Summary`] a measured series its median and
//!   spread.
//! - [`ToneCurve`] maps linear colours to those of a display.

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
