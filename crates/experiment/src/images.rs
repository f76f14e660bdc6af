//! Images of the systems against the naive reference with equal random numbers.

use rasray_metrics as metrics;
use rasray_reference::integrators::{INTEGRATORS, Image, NaiveIntegrator};
use rasray_reference::shading::{PosedScene, View};

use crate::backend::{FinishedRun, OnProgress, OnRun};
use crate::built::Built;
use crate::compare::Setting;
use crate::contestant::Contestant;
use crate::error::ExperimentError;
use crate::jobs::{Comparison, Frame, OccluderKind, Primary};
use crate::progressive_image::ProgressiveImage;
use crate::render_job::{Kept, render_pixels};
use rasray_report::figures::{Images, SystemImage};
use rasray_report::{ImageError, PassOf, Run};

/// Renders the reference image of a frame; `None` for integrators that the reference does not have.
fn reference_image(
    scene: &PosedScene<'_>,
    view: &View,
    frame: &Frame,
) -> Result<Option<Image>, ExperimentError> {
    let Some(naive) = NaiveIntegrator::named(frame.integrator.name()) else { return Ok(None) };
    Ok(Some(naive.render(scene, view, &frame.integrator.values())?))
}

/// Computes the error of an image against the reference, as a whole and, if wanted, in each pixel.
fn image_error(
    frame: &Frame,
    test: &[[f32; 3]],
    reference: &Image,
    map: bool,
) -> Result<(ImageError, Vec<f32>), ExperimentError> {
    let (width, height) = (frame.width as usize, frame.height as usize);
    let test = metrics::Image::new(width, height, test)?;
    let reference = metrics::Image::new(width, height, &reference.pixels)?;
    let error = metrics::ImageError::measure(&test, &reference)?;
    let map = if map { metrics::flip_map(&test, &reference)? } else { Vec::new() };
    let error = ImageError {
        flip_mean: Some(error.flip.mean),
        flip_p99: Some(error.flip.p99),
        flip_max: Some(error.flip.max),
        flip_visible: Some(error.flip.visible),
        rmse: Some(error.rmse),
        relmse: Some(error.relmse),
        relmse_trimmed: Some(error.relmse_trimmed),
        bias: Some(error.bias),
        bias_sigma: Some(error.bias_sigma),
        psnr: error.psnr.is_finite().then_some(error.psnr),
        ssim: Some(error.ssim),
        non_finite: Some(error.non_finite as u64),
    };
    Ok((error, map))
}

/// Names that stand for system and preset in the run of the reference with another seed.
pub(super) const NOISE: (&str, &str) = ("reference", "another-seed");

/// Renders the frame through each system whose image is wanted and compares it with the reference. The run
/// named `reference` is the reference with another seed: it shows the errors that noise alone causes.
pub(super) fn compare_images(
    setting: &Setting<'_>,
    comparison: &mut Comparison,
    finished: &mut OnRun<'_>,
    progress: &mut OnProgress<'_>,
) -> Result<(), ExperimentError> {
    let Setting { device, job, stage, posed, view } = *setting;
    let frame = &job.frame;
    let of_noise = job.first_image() + job.systems.len();
    let systems = || (job.first_image()..).zip(&job.systems).filter(|(place, _)| job.wants(*place));
    if systems().next().is_none() && !job.wants(of_noise) {
        return Ok(());
    }
    let Some(reference) = reference_image(posed, view, frame)? else {
        let known: Vec<_> = INTEGRATORS.iter().map(|row| row.name).collect();
        return Err(ExperimentError::NoReference { known: known.join(", ") });
    };
    if job.figures {
        comparison.figures.images = Some(Images {
            width: frame.width,
            height: frame.height,
            reference: reference.pixels.clone(),
            systems: Vec::new(),
        });
    }
    let mut add = |place: usize, mut run: Run, pixels: Vec<[f32; 3]>| {
        let (error, flip) = image_error(frame, &pixels, &reference, job.figures)?;
        run.image = Some(error);
        let end = finished(FinishedRun { place, run: &run, pixels: Some(&pixels) });
        if let Some(images) = &mut comparison.figures.images {
            images.systems.push(SystemImage { run: comparison.runs.len(), pixels, flip });
        }
        comparison.add(place, run);
        Ok::<_, ExperimentError>(end)
    };
    for (place, config) in systems() {
        // Images are rendered as by a render job: through a structure built around the camera.
        let spec = config.spec()?;
        let mut built = Built::new(device, &spec, &stage.scene, stage.scene.eye())?;
        for _ in 0..job.repetitions {
            built.build_again(device)?;
        }
        let task = format!("image {}", config.system.name);
        let mut rendering = ProgressiveImage::new(device, (stage, &built), frame, None, &job.needs)?;
        let mut pixels =
            render_pixels(device, &mut rendering, &built, (true, &task, Kept::default()), progress)?;
        if pixels.samples_done < frame.spp {
            return Ok(());
        }
        let of_camera = Contestant { config, spec, built, lists: Vec::new() };
        let mut run = of_camera.run(device)?;
        frame.describe(&mut run);
        rendering.write_memory(run.memory.get_or_insert_default());
        run.adaptive = frame.adaptive.map(|rule| pixels.adaptive(rule));
        pixels.write_times(&mut run.times);
        let beauty = std::mem::take(&mut pixels.means);
        run.stages.extend(pixels.passes.stages());
        run.passes.extend(pixels.passes.report(Some(PassOf::Image)));
        run.counters = Some(pixels.counters);
        if add(place, run, beauty)?.is_break() {
            return Ok(());
        }
    }
    if !job.wants(of_noise) {
        return Ok(());
    }
    let other = View { seed: frame.seed.wrapping_add(1), ..view.clone() };
    if let Some(noise) = reference_image(posed, &other, frame)? {
        let mut run = Run {
            system: NOISE.0.to_owned(),
            structure: "oracle".to_owned(),
            preset: NOISE.1.to_owned(),
            ..Run::default()
        };
        // The reference traces all rays.
        let (primary, occluder) = (Primary::Trace, OccluderKind::Structure);
        Frame { seed: other.seed, primary, occluder, ..frame.clone() }.describe(&mut run);
        _ = add(of_noise, run, noise.pixels)?;
    }
    Ok(())
}
