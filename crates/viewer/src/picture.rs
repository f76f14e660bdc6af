//! What an engine shows.

use crate::settings::Settings;
use rasray_experiment::Resolved;
use rasray_metrics::tone_map;
use rasray_report::colour_scale::{MAGMA, Scale, VIRIDIS, colour, place};
use rasray_report::{Memory, Pass, grouped};
use rasray_scene::Camera;

/// What the colours of a map mean.
#[derive(Clone, Debug, PartialEq)]
pub struct Legend {
    /// Colours from 0 to the greatest value.
    pub colours: &'static Scale,
    /// The greatest value, which has the brightest colour.
    pub most: f64,
    /// The mean over all pixels.
    pub mean: f64,
    /// What is counted or measured.
    pub unit: String,
}

impl Legend {
    /// The greatest value in words.
    pub fn most_shown(&self) -> String {
        if self.most.fract() == 0.0 { grouped(self.most as u64) } else { format!("{:.4}", self.most) }
    }

    /// The scale in a sentence.
    pub fn described(&self) -> String {
        format!("{}: 0 (dark) to {} (bright), mean {:.4}", self.unit, self.most_shown(), self.mean)
    }
}

/// Pixels, rows from the top.
#[derive(Clone, Debug, PartialEq)]
pub enum Pixels {
    /// Linear Rec. 709, W/(sr m^2).
    Radiance(Vec<[f32; 3]>),
    /// A map in colours of sRGB.
    Map(Vec<[u8; 3]>, Legend),
}

impl Pixels {
    /// Three bytes of sRGB per pixel; exposure in stops, of radiance alone. Radiance is mapped as files of PNG are.
    pub fn bytes(&self, exposure: f32) -> Vec<u8> {
        match self {
            Self::Radiance(radiance) => tone_map(radiance, exposure),
            Self::Map(colours, _) => colours.as_flattened().to_vec(),
        }
    }

    /// A map of counts, logarithmic.
    pub(crate) fn of_counts(counts: &[u32], unit: &str) -> Self {
        let most = counts.iter().copied().max().unwrap_or(0);
        let mean = counts.iter().map(|count| f64::from(*count)).sum::<f64>() / counts.len().max(1) as f64;
        let colours = counts.iter().map(|count| colour(VIRIDIS, place(*count, most))).collect();
        Self::Map(colours, Legend { colours: VIRIDIS, most: most.into(), mean, unit: unit.to_owned() })
    }

    /// A map of absolute differences: the greatest of a pixel's channels; black is none.
    pub(crate) fn of_difference(one: &[[f32; 3]], other: &[[f32; 3]], exact: &str) -> Self {
        let far = |(one, other): (&[f32; 3], &[f32; 3])| {
            (0..3).map(|channel| f64::from((one[channel] - other[channel]).abs())).fold(0.0, f64::max)
        };
        let differences: Vec<f64> = one.iter().zip(other).map(far).collect();
        let most = differences.iter().copied().fold(0.0, f64::max);
        let mean = differences.iter().sum::<f64>() / differences.len().max(1) as f64;
        let scale = if most > 0.0 { 1.0 / most } else { 0.0 };
        let colours = differences.iter().map(|difference| colour(MAGMA, difference * scale)).collect();
        let unit = format!("difference from {exact}, W/(sr m^2)");
        Self::Map(colours, Legend { colours: MAGMA, most, mean, unit })
    }
}

/// A picture and what it took.
#[derive(Clone, Debug)]
pub struct Picture {
    /// Pixels a row.
    pub width: u32,
    /// Rows.
    pub height: u32,
    /// Row by row from the top left.
    pub pixels: Pixels,
    /// What it was made from; while something moves it has fewer pixels.
    pub settings: Settings,
    /// Samples per pixel in it.
    pub samples: u32,
    /// From where.
    pub camera: Camera,
    /// Milliseconds of the last sample, as the host saw it.
    pub sample_ms: f64,
    /// Times of the passes of builds, then of samples.
    pub passes: Vec<Pass>,
    /// Bytes of the structure and the scene, by part.
    pub memory: Memory,
    /// Options and paths as the structure resolved them.
    pub resolved: Resolved,
}

impl Picture {
    /// Whether refinement has ended.
    pub fn is_finished(&self) -> bool {
        !self.settings.moving && self.samples >= self.settings.frame.spp
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn radiance_is_mapped_as_in_files_and_maps_stay() {
        let radiance = Pixels::Radiance(vec![[1.0, 0.0, 0.5]]);
        assert_eq!(radiance.bytes(0.0), [255, 0, 188]);
        assert_eq!(radiance.bytes(-1.0), tone_map(&[[0.5, 0.0, 0.25]], 0.0));
        let map = Pixels::of_counts(&[0, 7], "cells");
        assert_eq!(map.bytes(0.0), map.bytes(3.0));
        assert_eq!(map.bytes(0.0), [VIRIDIS[0], VIRIDIS[9]].as_flattened());
    }

    #[test]
    fn equal_pictures_have_a_black_difference_and_an_unequal_pixel_the_brightest() {
        let one = [[0.25, 0.5, 1.0], [0.0; 3]];
        let Pixels::Map(colours, legend) = Pixels::of_difference(&one, &one, "bvh") else { panic!("a map") };
        assert_eq!((colours, legend.most), (vec![MAGMA[0]; 2], 0.0));
        let other = [[0.25, 0.5, 1.0], [0.0, 0.25, 0.125]];
        let Pixels::Map(colours, legend) = Pixels::of_difference(&one, &other, "bvh") else {
            panic!("a map")
        };
        assert_eq!((colours, legend.most, legend.mean), (vec![MAGMA[0], MAGMA[9]], 0.25, 0.125));
    }
}
