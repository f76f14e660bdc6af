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
    /// Colours of the values from 0 to `bright`.
    pub colours: &'static Scale,
    /// Value from which on pixels have the brightest colour.
    pub bright: f64,
    /// Greatest value.
    pub most: f64,
    /// Mean value over all pixels.
    pub mean: f64,
    /// Name of the counted things, or unit of the values.
    pub unit: String,
}

impl Legend {
    /// Writes a value in words.
    pub fn shown(value: f64) -> String {
        if value.fract() == 0.0 { grouped(value as u64) } else { format!("{value:.4}") }
    }

    /// Writes mean and greatest value in words.
    pub fn extent(&self) -> String {
        format!("mean {:.4}, greatest {}", self.mean, Self::shown(self.most))
    }

    /// Describes the scale in a sentence.
    pub fn described(&self) -> String {
        format!("{}: 0 (dark) to {} (bright), {}", self.unit, Self::shown(self.bright), self.extent())
    }
}

/// Pixels, rows from the top.
#[derive(Clone, Debug, PartialEq)]
pub enum Pixels {
    /// Radiance in linear Rec. 709, W/(sr m^2).
    Radiance(Vec<[f32; 3]>),
    /// Colours of a map in sRGB, and their legend.
    Map(Vec<[u8; 3]>, Legend),
}

impl Pixels {
    /// Returns three bytes of sRGB per pixel; radiance is converted as for files of PNG in this tone, while a
    /// tone does not change maps. A number as the tone means stops of exposure.
    pub fn bytes(&self, tone: impl Into<Tone>) -> Vec<u8> {
        match self {
            Self::Radiance(radiance) => tone_map(radiance, tone),
            Self::Map(colours, _) => colours.as_flattened().to_vec(),
        }
    }

    /// Makes a map of counts, with a logarithmic scale.
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

    /// Makes a map of absolute differences: the greatest over a pixel's channels; black means no difference.
    /// A hundredth of the pixels may be beyond the scale: otherwise edges of lamps, which are far brighter
    /// than everything that they light, would leave the rest dark.
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
        // If fewer pixels than that differ at all, all of them are shown.
        let bright = if usual > 0.0 { usual } else { most };
        let scale = if bright > 0.0 { 1.0 / bright } else { 0.0 };
        let colours = differences.iter().map(|difference| colour(MAGMA, difference * scale)).collect();
        let unit = format!("difference from {exact}, W/(sr m^2)");
        Self::Map(colours, Legend { colours: MAGMA, bright, most, mean, unit })
    }
}

/// Picture with its costs.
#[derive(Clone, Debug)]
pub struct Picture {
    /// Width in pixels.
    pub width: u32,
    /// Height in pixels.
    pub height: u32,
    /// Pixels row by row from the top left.
    pub pixels: Pixels,
    /// Settings of the picture; while something moves, the picture has fewer pixels than they say.
    pub settings: Settings,
    /// Number of samples per pixel.
    pub samples: u32,
    /// Name and version of the denoiser; absent for a picture with noise.
    pub denoised: Option<String>,
    /// Number of rays that would have passed more transparent surfaces than a ray may, known once refinement
    /// has ended; everything behind these surfaces is left out.
    pub cut_rays: u32,
    /// Camera of the picture.
    pub camera: Camera,
    /// Time of the last sample, measured by the host, milliseconds.
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
