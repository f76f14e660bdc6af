//! Images computed on the CPU, one sample of one pixel after the other, with exact hits.
//!
//! The random numbers are those of the device, so that a reference image differs from a device image by
//! rounding and by wrong hits, not by noise.

#![expect(
    clippy::neg_cmp_op_on_partial_ord,
    reason = "`!(x > 0.0)` fails for NaN as well, as in the shaders"
)]

mod ambient_occlusion;
mod cube_map;
mod image;
mod layers;
mod path;
mod photons;
mod raycast;
mod whitted;

#[cfg(test)]
mod tests;

pub use ambient_occlusion::render_ambient_occlusion;
pub use image::Image;
pub use path::{PathOptions, render_path};

use glam::{DVec3, Vec2};
use rasray_options::OptionValues;
use rasray_scene::Camera;

use crate::{
    oracle::{Oracle, Outcome},
    shading::{
        PosedScene, Ray, ReferenceError, Surface, View, bsdf::SMOOTH_ROUGHNESS, camera_ray, lens_numbers,
        pixel_position, random::Numbers, through_lens,
    },
};

/// Function that renders a view with the values of an integrator's options; options without a value are
/// absent.
type Render = fn(&PosedScene<'_>, &View, &OptionValues) -> Result<Image, ReferenceError>;

/// Naive integrator, written down as it is defined.
#[derive(Clone, Copy, Debug)]
pub struct NaiveIntegrator {
    /// Name of the device integrator for which it is the reference.
    pub name: &'static str,
    render: Render,
}

/// All naive integrators.
pub static INTEGRATORS: &[NaiveIntegrator] = &[
    path::ROW,
    whitted::ROW,
    photons::ROW,
    cube_map::ROW,
    ambient_occlusion::ROW,
    raycast::ROW,
    layers::ROW,
];

impl NaiveIntegrator {
    /// Returns the integrator of that name.
    pub fn named(name: &str) -> Option<&'static Self> {
        INTEGRATORS.iter().find(|row| row.name == name)
    }

    /// Renders a view with the values of the integrator's options.
    ///
    /// # Errors
    /// An error if the image is empty or the scene has more triangles than ids.
    pub fn render(
        &self,
        posed: &PosedScene<'_>,
        view: &View,
        values: &OptionValues,
    ) -> Result<Image, ReferenceError> {
        (self.render)(posed, view, values)
    }
}

/// Scene and oracle, ready to be rendered.
struct Tracer<'a> {
    posed: &'a PosedScene<'a>,
    oracle: Oracle<'a>,
    /// True if light goes straight through smooth thin panes.
    passes_panes: bool,
    /// Roughness below which surfaces are perfectly smooth.
    mirror_roughness: f32,
}

impl Tracer<'_> {
    fn closest(&self, ray: &Ray) -> Option<Surface> {
        match self.oracle.closest(&ray.to_oracle()).outcome {
            Outcome::Hit { primitive, t, barycentrics } => {
                let barycentrics = Vec2::from(barycentrics.map(|weight| weight as f32));
                let mut surface = self.posed.surface(ray, t as f32, primitive, barycentrics);
                if surface.roughness < self.mirror_roughness {
                    surface.roughness = 0.0;
                }
                surface.is_pane = self.passes_panes
                    && surface.transmission > 0.0
                    && surface.thickness <= 0.0
                    && surface.anisotropy <= 0.0
                    && surface.roughness < SMOOTH_ROUGHNESS;
                Some(surface)
            }
            Outcome::Miss => None,
        }
    }

    fn occluded(&self, ray: &Ray) -> bool {
        self.oracle.occluded(&self.spawned(*ray).to_oracle()).occluded
    }

    /// Returns the ray of one sample of a pixel.
    fn camera_ray(&self, view: &View, random: Numbers) -> Ray {
        let ray = camera_ray(view, self.posed.frame_origin(), pixel_position(view.width, random));
        let ray = through_lens(&view.camera, ray, lens_numbers(random));
        Ray { culls_back_faces: self.posed.back_faces().lets_camera_rays(), ..ray }
    }

    /// Marks a ray that left a surface with the backs that such rays pass.
    fn spawned(&self, ray: Ray) -> Ray {
        Ray { culls_back_faces: self.posed.back_faces().lets_other_rays(), ..ray }
    }
}

impl PosedScene<'_> {
    fn render(
        &self,
        view: &View,
        passes_panes: bool,
        sample: impl Fn(&Tracer<'_>, Numbers) -> glam::Vec3 + Sync,
    ) -> Result<Image, ReferenceError> {
        self.render_smoothed(view, (passes_panes, 0.0), sample)
    }

    /// Renders with the two values of `smoothed`: true if light goes straight through smooth thin panes, and
    /// the roughness below which surfaces are perfectly smooth.
    fn render_smoothed(
        &self,
        view: &View,
        smoothed: (bool, f32),
        sample: impl Fn(&Tracer<'_>, Numbers) -> glam::Vec3 + Sync,
    ) -> Result<Image, ReferenceError> {
        self.render_prepared(view, smoothed, |_| (), |tracer, (), random| sample(tracer, random))
    }

    /// Renders with a value that `prepare` makes once for all samples.
    fn render_prepared<P: Sync>(
        &self,
        view: &View,
        (passes_panes, mirror_roughness): (bool, f32),
        prepare: impl FnOnce(&Tracer<'_>) -> P,
        sample: impl Fn(&Tracer<'_>, &P, Numbers) -> glam::Vec3 + Sync,
    ) -> Result<Image, ReferenceError> {
        view.check()?;
        let accept = |primitive: u32, barycentrics: [f64; 2]| self.alpha_accepts(primitive, barycentrics);
        let accept: Option<crate::oracle::Accept<'_>> =
            if self.has_alpha_masks() { Some(&accept) } else { None };
        let oracle = Oracle::new(self.positions(), self.indices(), accept)?.with_backs(|id| self.back_of(id));
        let tracer = Tracer { posed: self, oracle, passes_panes, mirror_roughness };
        let prepared = prepare(&tracer);
        Ok(Image::render(view, |random| sample(&tracer, &prepared, random)))
    }
}

fn eye(camera: &Camera) -> DVec3 {
    camera.world_from_camera.translation
}
