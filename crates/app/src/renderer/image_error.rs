//! Images against the naive reference with the same random numbers.

use rasray_metrics as metrics;
use rasray_reference::integrators::Image;
use rasray_reference::shading::{PosedScene, View};

use super::stage::device_error;
use crate::backend::{Frame, Integrator};
use crate::error::AppError;
use crate::report::ImageError;

/// The reference image of a frame; absent for integrators that it does not have.
pub(super) fn reference_image(
    scene: &PosedScene<'_>,
    view: &View,
    frame: &Frame,
) -> Result<Option<Image>, AppError> {
    let image = match frame.integrator {
        Integrator::Path { bounces } => scene.render_path(view, bounces),
        Integrator::AmbientOcclusion { distance } => {
            scene.render_ambient_occlusion(view, distance.unwrap_or(f32::INFINITY))
        }
        Integrator::Raycast => return Ok(None),
    };
    image.map(Some).map_err(|error| AppError::usage(error.to_string(), ""))
}

/// How far an image is from the reference.
pub(super) fn image_error(
    frame: &Frame,
    test: &[[f32; 3]],
    reference: &Image,
) -> Result<ImageError, AppError> {
    let (width, height) = (frame.width as usize, frame.height as usize);
    let test = metrics::Image::new(width, height, test).map_err(device_error)?;
    let reference = metrics::Image::new(width, height, &reference.pixels).map_err(device_error)?;
    let error = metrics::ImageError::measure(&test, &reference).map_err(device_error)?;
    Ok(ImageError {
        flip_mean: Some(error.flip.mean),
        flip_p99: Some(error.flip.p99),
        rmse: Some(error.rmse),
        relmse: Some(error.relmse),
        psnr: error.psnr.is_finite().then_some(error.psnr),
        ssim: Some(error.ssim),
    })
}
