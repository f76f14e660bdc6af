//! Pictures and maps that an engine shows.

use crate::settings::Settings;
use rasray_experiment::ResolvedOptions;
use rasray_metrics::{Tone, tone_map};
use rasray_report::colour_scale::{MAGMA, Scale, VIRIDIS, colour, place};
use rasray_report::{Memory, Pass, grouped};
use rasray_scene::Camera;

/// Meaning of the colours of a map.
#[derive(Clone, Debug, PartialEq)]
pub struct Legend {
    /// Colours from 0 to `bright`.
    pub colours: &'static Scale,
    /// From this value on pixels have the brightest colour.
    pub bright: f64,
    /// The greatest value.
    pub most: f64,
    /// The mean over all pixels.
    pub mean: f64,
    /// Things counted, or the unit measured in.
    pub unit: String,
}

impl Legend {
    /// A value in words.
    pub fn shown(value: f64) -> String {
        if value.fract() == 0.0 { grouped(value as u64) } else { format!("{value:.4}") }
    }

    /// Mean and greatest value in words.
    pub fn extent(&self) -> String {
        format!("mean {:.4}, greatest {}", self.mean, Self::shown(self.most))
    }

    /// The scale in a sentence.
    pub fn described(&self) -> String {
        format!("{}: 0 (dark) to {} (bright), {}", self.unit, Self::shown(self.bright), self.extent())
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
    /// Three bytes of sRGB per pixel, of radiance as files of PNG are in this tone; maps have none. A number
    /// is stops of exposure alone.
    pub fn bytes(&self, tone: impl Into<Tone>) -> Vec<u8> {
        match self {
            Self::Radiance(radiance) => tone_map(radiance, tone),
            Self::Map(colours, _) => colours.as_flattened().to_vec(),
        }
    }

    /// A map of counts, logarithmic.
    pub(crate) fn of_counts(counts: &[u32], unit: &str) -> Self {
        let most = counts.iter().copied().max().unwrap_or(0);
        let mean = counts.iter().map(|count| f64::from(*count)).sum::<f64>() / counts.len().max(1) as f64;
        let colours = counts.iter().map(|count| colour(VIRIDIS, place(*count, most))).collect();
        let most = f64::from(most);
        Self::Map(
            colours,
            Legend { colours: VIRIDIS, bright: most, most, mean, unit: format!("{unit}, logarithmic") },
        )
    }

    /// A map of absolute differences: the greatest of a pixel's channels; black is none. A hundredth of the
    /// pixels may be beyond the scale: else edges of lamps, which are far brighter than all they light, would
    /// leave the rest dark.
    pub(crate) fn of_difference(one: &[[f32; 3]], other: &[[f32; 3]], exact: &str) -> Self {
        let far = |(one, other): (&[f32; 3], &[f32; 3])| {
            (0..3).map(|channel| f64::from((one[channel] - other[channel]).abs())).fold(0.0, f64::max)
        };
        let differences: Vec<f64> = one.iter().zip(other).map(far).collect();
        let most = differences.iter().copied().fold(0.0, f64::max);
        let mean = differences.iter().sum::<f64>() / differences.len().max(1) as f64;
        let mut sorted = differences.clone();
        sorted.sort_unstable_by(f64::total_cmp);
        let usual = sorted.len().checked_sub(1 + sorted.len() / 100).map_or(0.0, |place| sorted[place]);
        // Where fewer pixels than that differ at all, all of them are seen.
        let bright = if usual > 0.0 { usual } else { most };
        let scale = if bright > 0.0 { 1.0 / bright } else { 0.0 };
        let colours = differences.iter().map(|difference| colour(MAGMA, difference * scale)).collect();
        let unit = format!("difference from {exact}, W/(sr m^2)");
        Self::Map(colours, Legend { colours: MAGMA, bright, most, mean, unit })
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
    /// Settings that it was made from; while something moves it has fewer pixels.
    pub settings: Settings,
    /// Samples per pixel in it.
    pub samples: u32,
    /// Name and version of its denoiser; absent without one.
    pub denoised: Option<String>,
    /// Rays that would have passed more transparent surfaces than a ray may, once refinement has ended: what
    /// lies behind is left out.
    pub cut_rays: u32,
    /// From where.
    pub camera: Camera,
    /// Milliseconds of the last sample, as the host saw it.
    pub sample_ms: f64,
    /// Times of the passes of builds, then of samples.
    pub passes: Vec<Pass>,
    /// Bytes of the structure and the scene, by part.
    pub memory: Memory,
    /// Options and paths as the structure resolved them.
    pub resolved: ResolvedOptions,
}

impl Picture {
    /// True if refinement has ended.
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

    #[test]
    fn a_lamp_s_edge_does_not_hide_what_differs_elsewhere() {
        let exact = vec![[0.0; 3]; 200];
        let with = |usual: f32| {
            let mut other = vec![[usual, 0.0, 0.0]; 200];
            other[7] = [0.0, 17.0, 0.0];
            match Pixels::of_difference(&exact, &other, "bvh") {
                Pixels::Map(colours, legend) => (colours, legend),
                Pixels::Radiance(_) => panic!("a map"),
            }
        };
        let (colours, legend) = with(0.25);
        assert_eq!((legend.bright, legend.most), (0.25, 17.0));
        assert!(colours.iter().all(|colour| *colour == MAGMA[9]), "beyond the scale is brightest");
        let (colours, legend) = with(0.0);
        assert_eq!((legend.bright, legend.most), (17.0, 17.0));
        assert_eq!((colours[7], colours[8]), (MAGMA[9], MAGMA[0]));
        assert_eq!(
            legend.described(),
            "difference from bvh, W/(sr m^2): 0 (dark) to 17 (bright), mean 0.0850, greatest 17"
        );
    }
}
