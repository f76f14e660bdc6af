//! Images of a picture in addition to its colours.

use std::collections::BTreeMap;
use std::ops::ControlFlow;

use glam::DVec3;
use rasray_gpu::Device;
use rasray_integrators::{AovPixel, AovSurface, FilmPixel};
use rasray_options::Value;

use crate::built::Built;
use crate::device_scene::DeviceScene;
use crate::error::ExperimentError;
use crate::jobs::{Aov, AovImage, Frame, RenderJob};
use crate::motion::{TrianglesBefore, motion};
use crate::progressive_image::ProgressiveImage;
use crate::render_job::Pixels;

/// Makes the images in addition to the colours of `pixels`; `before` are the triangles of the frame before.
/// Each image is made band by band, so that only the wanted values of a pixel are kept.
pub(super) fn further_images(
    device: &Device,
    job: &RenderJob<'_>,
    (stage, built, rendering): (&DeviceScene, &Built, &ProgressiveImage),
    pixels: &mut Pixels,
    before: Option<&TrianglesBefore>,
) -> Result<BTreeMap<Aov, AovImage>, ExperimentError> {
    let (aovs, image) = (job.aovs, rendering.image());
    let (scene, structure) = (&stage.scene, built.structure());
    let made = aovs.iter().filter(|aov| *aov != Aov::Samples);
    let mut images: BTreeMap<_, _> =
        made.map(|aov| (aov, AovImage::with_room(aov, pixels.means.len()))).collect();

    let size = [job.frame.width, job.frame.height];
    let before = job.before.as_ref().zip(before);
    let mut first = 0;
    let mut take = |met: &[AovPixel], surfaces: &[AovSurface]| {
        for (aov, image) in &mut images {
            add_centres(*aov, image, (met, surfaces), scene.frame_origin());
        }
        if let (Some(image), Some((before, triangles))) = (images.get_mut(&Aov::Motion), before) {
            let cameras = (before, &job.camera);
            image.extend(motion(cameras, triangles, scene.frame_origin(), size, (first, met, surfaces)));
        }
        first += met.len();
    };
    if aovs.has_surfaces() {
        image.aovs_with_surfaces(scene, structure, take)?;
    } else if aovs.has_centres() {
        image.aovs(scene, structure, |met| take(met, &[]))?;
    }

    if let (Some(image), Some(variances)) = (images.get_mut(&Aov::Variance), image.variances()) {
        image.extend(variances);
    }
    if aovs.has_direct_light() {
        let direct = direct_light(device, job, stage, built, pixels.samples_done)?;
        let mut first = 0;
        let take = |film: &[FilmPixel]| {
            let direct = film.iter().map(FilmPixel::mean);
            if let Some(image) = images.get_mut(&Aov::Direct) {
                image.extend(direct.clone());
            }
            if let Some(image) = images.get_mut(&Aov::Indirect) {
                let both = pixels.means.iter().skip(first).zip(direct);
                image.extend(
                    both.map(|(all, direct)| [0, 1, 2].map(|channel| all[channel] - direct[channel])),
                );
            }
            first += film.len();
        };
        direct.image().film().read_bands(device, take)?;
    }
    if aovs.contains(Aov::Samples) {
        // The sums of a share need the counts as well, so they are copied for a share.
        let counts = if job.shard.is_some() { pixels.counts.clone() } else { pixels.counts.take() };
        images.insert(Aov::Samples, AovImage::Whole(counts.unwrap_or_default()));
    }
    Ok(images)
}

impl ProgressiveImage {
    /// Makes the images [`Aov::FOR_DENOISING`], which a denoiser takes beside the colours, from the scene and
    /// the structure of the render: one entry per pixel, rows from the top. The scene must be uploaded with
    /// the data that these images need ([`AovSelection::needs`](crate::AovSelection::needs)).
    ///
    /// # Errors
    /// The device fails, or rays have no answer.
    pub fn for_denoising(
        &self,
        stage: &DeviceScene,
        built: &Built,
    ) -> Result<[Vec<[f32; 3]>; 2], ExperimentError> {
        let pixels = self.image.film().pixel_count() as usize;
        let mut images = Aov::FOR_DENOISING.map(|aov| (aov, AovImage::with_room(aov, pixels)));
        self.image.aovs_with_surfaces(&stage.scene, built.structure(), |met, surfaces| {
            for (aov, image) in &mut images {
                add_centres(*aov, image, (met, surfaces), stage.scene.frame_origin());
            }
        })?;
        Ok(images.map(|(_, image)| image.triples().unwrap_or_default()))
    }
}

/// Adds a band of rays through pixels' centres to an image that is only of these rays.
fn add_centres(
    aov: Aov,
    image: &mut AovImage,
    (met, surfaces): (&[AovPixel], &[AovSurface]),
    frame_origin: DVec3,
) {
    match aov {
        Aov::Depth => image.extend(met.iter().map(|pixel| [pixel.distance])),
        Aov::Normal => image.extend(met.iter().map(|pixel| pixel.normal)),
        Aov::Primitive => image.extend_whole(met.iter().map(|pixel| pixel.primitive)),
        Aov::Albedo => image.extend(surfaces.iter().map(|surface| surface.albedo)),
        Aov::Position => image.extend(met.iter().zip(surfaces).map(|(pixel, surface)| {
            let in_world = DVec3::from_array(surface.position.map(f64::from)) + frame_origin;
            if pixel.distance > 0.0 { in_world.as_vec3().to_array() } else { [0.0; 3] }
        })),
        Aov::Uv => image.extend(surfaces.iter().map(|surface| surface.uv)),
        Aov::Material => image.extend_whole(surfaces.iter().map(|surface| surface.material)),
        Aov::Instance => image.extend_whole(surfaces.iter().map(|surface| surface.instance)),
        Aov::Motion | Aov::Samples | Aov::Direct | Aov::Indirect | Aov::Variance => {}
    }
}

/// Renders the picture of light that is scattered at most once: the paths of the picture, with the same
/// random numbers, end earlier, so that the difference is the light that later scatterings gather.
fn direct_light(
    device: &Device,
    job: &RenderJob<'_>,
    stage: &DeviceScene,
    built: &Built,
    samples: u32,
) -> Result<ProgressiveImage, ExperimentError> {
    let bounces = job.frame.integrator.values().get("bounces").and_then(Value::whole).unwrap_or(1);
    let integrator = job.frame.integrator.clone().with("bounces", Value::Whole(bounces.min(1)))?;
    let frame = Frame { integrator, spp: samples, ..job.frame.clone() };
    let mut rendering = ProgressiveImage::new(device, (stage, built), &frame, job.shard, &job.needs)?;
    rendering.render(device, built, "direct light", &mut |_| ControlFlow::Continue(()))?;
    Ok(rendering)
}
