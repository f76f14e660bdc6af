use glam::Vec3;
use rayon::prelude::*;

use crate::shading::{View, random::Numbers};

/// Linear RGB image, rows top first.
#[derive(Clone, Debug, PartialEq)]
pub struct Image {
    /// Number of pixels per row.
    pub width: u32,
    /// Number of rows.
    pub height: u32,
    /// Pixels in W/(sr m^2), or shares of 1 for ambient occlusion.
    pub pixels: Vec<[f32; 3]>,
}

impl Image {
    /// Computes the mean of all samples of each pixel, added in f64 in the order of the samples.
    pub(super) fn render(view: &View, sample: impl Fn(Numbers) -> Vec3 + Sync) -> Self {
        let pixels = (0..view.width * view.height)
            .into_par_iter()
            .map(|pixel| {
                let mut sum = glam::DVec3::ZERO;
                for number in 0..view.samples {
                    sum += sample(view.numbers(pixel, number)).as_dvec3();
                }
                (sum / f64::from(view.samples)).as_vec3().to_array()
            })
            .collect();
        Self { width: view.width, height: view.height, pixels }
    }

    /// Returns the mean over all pixels, by channel.
    pub fn mean(&self) -> [f64; 3] {
        let count = self.pixels.len().max(1) as f64;
        std::array::from_fn(|channel| {
            self.pixels.iter().map(|pixel| f64::from(pixel[channel])).sum::<f64>() / count
        })
    }
}
