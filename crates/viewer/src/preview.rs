//! Preview while something moves: direct light on the visible surfaces, from few rays, with smoothed noise.

use rasray_experiment::{
    Built, DeviceScene, ExperimentError, Frame, IntegratorRow, IntegratorSpec, OccluderKind, ProgressiveImage,
};
use rasray_gpu::Device;
use rasray_scene::needs::Needs;

/// Distances in pixels from each pixel to the pixels that each pass of [`smoothed`] averages with it. For a
/// sample at 320x180, mean errors as shown fall from 3.1 to 1.2 of 255 (cornell) and from 24.7 to 6.4
/// (walker:8k); with a fourth pass, of 8, to 2.0 and 6.0, since it blurs shadows.
const STEPS: [usize; 3] = [1, 2, 4];

/// Relative difference of two surfaces' colours at which light of one has a quarter of the weight for the
/// other.
const APART: f32 = 0.08;

/// Summand of the colours of surfaces, so that light on black ones is defined.
const BLACK: f32 = 0.02;

/// Returns the frame of a preview of `size`: for paths only their first scattering, which is direct light;
/// for other integrators with materials, paths as well, since they differ only after the first scattering;
/// otherwise the frame that was chosen.
fn light_frame(frame: &Frame, [width, height]: [u32; 2]) -> Frame {
    let chosen = &frame.integrator;
    let path = IntegratorRow::named("path").expect("it is registered");
    let integrator = match chosen.get("bounces").and_then(|value| value.whole()) {
        Some(bounces) => chosen.with("bounces", bounces.min(1)),
        None if frame.workload().scatters => IntegratorSpec::from(path).with("bounces", 1),
        None => Ok(chosen.clone()),
    };
    let integrator = integrator.expect("a value that the option takes");
    Frame { integrator, width, height, adaptive: None, ..frame.clone() }
}

/// Returns the frame of the visible surfaces without light; `None` if `light` has no noise, as for every
/// integrator that traces only camera rays.
fn surface_frame(light: &Frame) -> Option<Frame> {
    let raycast = IntegratorRow::named("raycast").expect("it is registered");
    let is_noisy = light.integrator.row().rays.len() > 1;
    is_noisy.then(|| Frame { integrator: raycast.into(), occluder: OccluderKind::Structure, ..light.clone() })
}

/// Preview with its films.
pub(crate) struct Preview {
    /// Width and height in pixels.
    pub(crate) size: [u32; 2],
    light: ProgressiveImage,
    surfaces: Option<ProgressiveImage>,
}

impl Preview {
    /// Makes the films with their kernels.
    pub(crate) fn new(
        device: &Device,
        stage: &DeviceScene,
        frame: &Frame,
        size: [u32; 2],
        needs: &Needs,
        built: &Built,
    ) -> Result<Self, ExperimentError> {
        let open = |frame: &Frame| -> Result<ProgressiveImage, ExperimentError> {
            let mut made = ProgressiveImage::new(device, (stage, built), frame, None, needs)?;
            made.warm_up(built)?;
            Ok(made)
        };
        let light = light_frame(frame, size);
        let surfaces = surface_frame(&light).as_ref().map(open).transpose()?;
        Ok(Self { size, light: open(&light)?, surfaces })
    }

    /// Returns all films.
    pub(crate) fn films(&mut self) -> impl Iterator<Item = &mut ProgressiveImage> {
        std::iter::once(&mut self.light).chain(&mut self.surfaces)
    }

    /// Returns the film with fewer samples, whose wave is next.
    pub(crate) fn next(&mut self) -> &mut ProgressiveImage {
        let done = self.light.image().samples_done();
        match &mut self.surfaces {
            Some(surfaces) if surfaces.image().samples_done() <= done => surfaces,
            _ => &mut self.light,
        }
    }

    /// True if the films can show the structure that is traced.
    pub(crate) fn serves(&self, built: &Built) -> bool {
        self.light.serves(built) && self.surfaces.as_ref().is_none_or(|surfaces| surfaces.serves(built))
    }

    /// Returns the film of the light, the last to get a sample.
    pub(crate) fn light(&self) -> &ProgressiveImage {
        &self.light
    }

    /// True if all films have equally many samples, at least one.
    pub(crate) fn is_whole(&self) -> bool {
        let done = self.light.image().samples_done();
        done > 0 && self.surfaces.as_ref().is_none_or(|surfaces| surfaces.image().samples_done() == done)
    }

    /// Reads the picture.
    pub(crate) fn read(&self, device: &Device) -> Result<Vec<[f32; 3]>, ExperimentError> {
        let light = self.light.read(device)?;
        Ok(match &self.surfaces {
            Some(surfaces) => smoothed(light, &surfaces.read(device)?, self.size[0] as usize),
            None => light,
        })
    }
}

/// Smooths light over the pixels around each whose surfaces look alike. Light is divided by the colours of
/// the surfaces, averaged in a few passes over pixels farther and farther apart ("à trous"), and multiplied
/// by these colours again, so that edges and textures stay. Both pictures are `width` pixels wide.
fn smoothed(light: Vec<[f32; 3]>, surfaces: &[[f32; 3]], width: usize) -> Vec<[f32; 3]> {
    let colours: Vec<[f32; 3]> = surfaces.iter().map(|colour| colour.map(|value| value + BLACK)).collect();
    let scaled = |picture: &[[f32; 3]], by: fn(f32, f32) -> f32| -> Vec<[f32; 3]> {
        let both = picture.iter().zip(&colours);
        both.map(|(one, colour)| [0, 1, 2].map(|channel| by(one[channel], colour[channel]))).collect()
    };
    let mut irradiance = scaled(&light, |light, colour| light / colour);
    for step in STEPS {
        irradiance = pass(&irradiance, &colours, width, step);
    }
    scaled(&irradiance, |irradiance, colour| irradiance * colour)
}

/// Computes one pass: for each pixel the weighted mean with its eight neighbours `step` pixels away.
fn pass(picture: &[[f32; 3]], colours: &[[f32; 3]], width: usize, step: usize) -> Vec<[f32; 3]> {
    let height = picture.len() / width.max(1);
    let mean = |index: usize| {
        let (x, y) = (index % width, index / width);
        let (mut sum, mut weights) = ([0.0; 3], 0.0);
        for (row, across) in [(y.checked_sub(step), 0.25), (Some(y), 0.5), (Some(y + step), 0.25)] {
            let Some(row) = row.filter(|row| *row < height) else { continue };
            for (column, along) in [(x.checked_sub(step), 0.25), (Some(x), 0.5), (Some(x + step), 0.25)] {
                let Some(column) = column.filter(|column| *column < width) else { continue };
                let other = row * width + column;
                let weight = across * along * alike(colours[index], colours[other]);
                for channel in 0..3 {
                    sum[channel] += weight * picture[other][channel];
                }
                weights += weight;
            }
        }
        sum.map(|sum| sum / weights)
    };
    (0..picture.len()).map(mean).collect()
}

/// Returns the likeness of two surfaces, 0 to 1.
fn alike(one: [f32; 3], other: [f32; 3]) -> f32 {
    let apart = |channel: usize| (one[channel] - other[channel]) / (one[channel] + other[channel]);
    let squared: f32 = (0..3).map(|channel| apart(channel) * apart(channel)).sum();
    let fall = 1.0 + squared / (APART * APART);
    1.0 / (fall * fall)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::settings::tests::{integrator, some};

    #[test]
    fn previews_are_direct_light_whatever_comes_after_it() {
        let of = |name: &str| {
            let frame = Frame { integrator: integrator(name), ..some().frame };
            let light = light_frame(&frame, [20, 15]);
            assert_eq!([light.width, light.height], [20, 15]);
            let surfaces = surface_frame(&light).map(|frame| frame.integrator.name());
            (
                light.integrator.name(),
                light.integrator.get("bounces").and_then(|value| value.whole()),
                surfaces,
            )
        };
        assert_eq!(of("path"), ("path", Some(1), Some("raycast")));
        assert_eq!(of("whitted"), ("path", Some(1), Some("raycast")));
        assert_eq!(of("ao"), ("ao", None, Some("raycast")));
        assert_eq!(of("raycast"), ("raycast", None, None));
        assert_eq!(of("layers"), ("layers", None, None));
        let unlit = integrator("path").with("bounces", 0).expect("valid");
        let frame = Frame { integrator: unlit.clone(), ..some().frame };
        assert_eq!(light_frame(&frame, [1, 1]).integrator, unlit);
    }

    /// Checks two surfaces side by side; light falls on every other pixel, twice as strong on the right.
    #[test]
    fn noise_is_averaged_and_edges_and_textures_stay() {
        let (width, height) = (64, 32);
        let is_right = |index: usize| index % width >= width / 2;
        let surface = |index: usize| if is_right(index) { [0.8, 0.2, 0.2] } else { [0.2, 0.2, 0.8] };
        let surfaces: Vec<[f32; 3]> = (0..width * height).map(surface).collect();
        let lit = |index: usize| {
            let strength = if is_right(index) { 4.0 } else { 2.0 };
            let on = (index % width + index / width) % 2;
            surfaces[index].map(|value| value * strength * on as f32)
        };
        let light: Vec<[f32; 3]> = (0..width * height).map(lit).collect();
        let smooth = smoothed(light, &surfaces, width);
        for (index, pixel) in smooth.iter().enumerate() {
            let strength = if is_right(index) { 2.0 } else { 1.0 };
            for channel in 0..3 {
                let expected = strength * surfaces[index][channel];
                let error = (pixel[channel] / expected - 1.0).abs();
                assert!(error < 0.06, "pixel {index}, channel {channel}: {} for {expected}", pixel[channel]);
            }
        }
    }

    #[test]
    fn even_light_stays_as_it_is() {
        let surfaces = [[0.0, 0.5, 1.0], [1.0; 3], [0.3; 3], [0.0; 3], [5.0; 3], [0.1; 3]];
        let light: Vec<[f32; 3]> =
            surfaces.iter().map(|colour| colour.map(|value| 3.0 * (value + BLACK))).collect();
        let smooth = smoothed(light.clone(), &surfaces, 2);
        for (one, other) in smooth.as_flattened().iter().zip(light.as_flattened()) {
            assert!((one - other).abs() <= 1.0e-5 * other, "{one} for {other}");
        }
    }
}
