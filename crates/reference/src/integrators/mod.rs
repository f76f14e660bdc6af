//! Images computed on the CPU, one sample of one pixel after the other, with exact hits.
//!
//! The random numbers are those of the device, so that an image from here differs from one of a
//! device by rounding and by wrong hits, not by noise.

#![expect(
    clippy::neg_cmp_op_on_partial_ord,
    reason = "`!(x > 0.0)` fails for NaN as well, as in the shaders"
)]

mod ambient_occlusion;
mod image;
mod path;

#[cfg(test)]
mod tests;

pub use image::Image;

use glam::{DVec3, Vec2};
use rasray_scene::{Camera, Scene};

use crate::{
    oracle::{Oracle, Outcome},
    shading::{
        PosedScene, Ray, ReferenceError, Sampler, Surface, View, bsdf::SMOOTH_ROUGHNESS, camera_ray,
        pixel_position, random::Numbers,
    },
};

/// What paths do.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct PathOptions {
    /// At most this many scatterings.
    pub bounces: u32,
    /// Whether light goes straight through smooth thin panes and takes their tint, unless there are no bounces; else panes
    /// stop shadow rays, and going through is a scattering.
    pub passes_panes: bool,
}

impl From<u32> for PathOptions {
    /// This many bounces; light passes panes.
    fn from(bounces: u32) -> Self {
        Self { bounces, passes_panes: true }
    }
}

/// Scene and oracle, ready to be rendered.
struct Tracer<'a> {
    posed: &'a PosedScene<'a>,
    oracle: Oracle<'a>,
    /// Whether light goes straight through smooth thin panes.
    passes_panes: bool,
}

impl Tracer<'_> {
    fn closest(&self, ray: &Ray) -> Option<Surface> {
        match self.oracle.closest(&ray.to_oracle()).outcome {
            Outcome::Hit { primitive, t, barycentrics } => {
                let barycentrics = Vec2::from(barycentrics.map(|weight| weight as f32));
                let mut surface = self.posed.surface(ray, t as f32, primitive, barycentrics);
                surface.is_pane = self.passes_panes
                    && surface.transmission > 0.0
                    && surface.thickness <= 0.0
                    && surface.roughness < SMOOTH_ROUGHNESS;
                Some(surface)
            }
            Outcome::Miss => None,
        }
    }

    fn occluded(&self, ray: &Ray) -> bool {
        self.oracle.occluded(&self.spawned(*ray).to_oracle()).occluded
    }

    /// The ray of one sample of a pixel.
    fn camera_ray(&self, view: &View, random: Numbers) -> Ray {
        let ray = camera_ray(view, self.posed.frame_origin(), pixel_position(view.width, random));
        Ray { culls_back_faces: self.posed.back_faces().lets_camera_rays(), ..ray }
    }

    /// A ray that left a surface, with the backs that such rays pass.
    fn spawned(&self, ray: Ray) -> Ray {
        Ray { culls_back_faces: self.posed.back_faces().lets_other_rays(), ..ray }
    }
}

impl PosedScene<'_> {
    /// Cosine-weighted visibility of a white environment within `distance` metres; background 1.
    ///
    /// # Errors
    /// If the image is empty or the scene has more triangles than ids.
    pub fn render_ambient_occlusion(&self, view: &View, distance: f32) -> Result<Image, ReferenceError> {
        self.render(view, false, |tracer, random| tracer.ambient_occlusion(view, distance, random))
    }

    /// Path tracing; W/(sr m^2). A number of bounces will do for the options.
    ///
    /// # Errors
    /// If the image is empty or the scene has more triangles than ids.
    pub fn render_path(&self, view: &View, options: impl Into<PathOptions>) -> Result<Image, ReferenceError> {
        let PathOptions { bounces, passes_panes } = options.into();
        self.render(view, passes_panes && bounces > 0, |tracer, random| tracer.path(view, bounces, random))
    }

    fn render(
        &self,
        view: &View,
        passes_panes: bool,
        sample: impl Fn(&Tracer<'_>, Numbers) -> glam::Vec3 + Sync,
    ) -> Result<Image, ReferenceError> {
        view.check()?;
        let accept = |primitive: u32, barycentrics: [f64; 2]| self.alpha_accepts(primitive, barycentrics);
        let accept: Option<crate::oracle::Accept<'_>> =
            if self.has_alpha_masks() { Some(&accept) } else { None };
        let oracle = Oracle::new(self.positions(), self.indices(), accept)?.with_backs(|id| self.back_of(id));
        let tracer = Tracer { posed: self, oracle, passes_panes };
        Ok(Image::render(view, |random| sample(&tracer, random)))
    }
}

/// [`PosedScene::render_ambient_occlusion`] with the frame origin at the eye.
///
/// # Errors
/// If the scene names what it does not have, or the image is empty.
pub fn render_ambient_occlusion(
    scene: &Scene,
    camera: &Camera,
    width: u32,
    height: u32,
    samples: u32,
    seed: u32,
    distance: f32,
) -> Result<Image, ReferenceError> {
    let view = View { camera: camera.clone(), width, height, samples, seed, sampler: Sampler::default() };
    PosedScene::new(scene, eye(camera))?.render_ambient_occlusion(&view, distance)
}

/// [`PosedScene::render_path`] with the frame origin at the eye.
///
/// # Errors
/// If the scene names what it does not have, or the image is empty.
pub fn render_path(
    scene: &Scene,
    camera: &Camera,
    width: u32,
    height: u32,
    samples: u32,
    seed: u32,
    options: impl Into<PathOptions>,
) -> Result<Image, ReferenceError> {
    let view = View { camera: camera.clone(), width, height, samples, seed, sampler: Sampler::default() };
    PosedScene::new(scene, eye(camera))?.render_path(&view, options)
}

fn eye(camera: &Camera) -> DVec3 {
    camera.world_from_camera.translation
}
