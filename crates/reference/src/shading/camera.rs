//! Rays of the pixels of a camera.

use glam::{DVec3, Vec2, Vec3};
use rasray_scene::{Camera, Projection, Sampler};

use super::{
    Ray, ReferenceError, cosine_hemisphere,
    random::{Numbers, RANDOM_CAMERA_X, RANDOM_CAMERA_Y, RANDOM_LENS_U, RANDOM_LENS_V, RandomStream},
};

/// Camera, size, samples and seed of an image.
#[derive(Clone, Debug)]
pub struct View {
    /// Placement and projection, world.
    pub camera: Camera,
    /// Number of pixels per row.
    pub width: u32,
    /// Number of rows.
    pub height: u32,
    /// Number of samples per pixel.
    pub samples: u32,
    /// Seed of all random numbers.
    pub seed: u32,
    /// Source of random numbers.
    pub sampler: Sampler,
}

impl View {
    /// Returns the random numbers of one sample of one pixel.
    pub fn numbers(&self, pixel: u32, sample: u32) -> Numbers {
        Numbers { sampler: self.sampler, stream: RandomStream { seed: self.seed, pixel, sample } }
    }

    /// Checks the size of the image.
    ///
    /// # Errors
    /// An error if the image has no pixels or no samples.
    pub fn check(&self) -> Result<(), ReferenceError> {
        let Self { width, height, samples, .. } = *self;
        if width == 0 || height == 0 || samples == 0 {
            return Err(ReferenceError::EmptyImage { width, height, samples });
        }
        Ok(())
    }
}

/// Returns a position within the pixel of `random`, uniform, in pixels from the top left corner.
pub fn pixel_position(width: u32, random: Numbers) -> Vec2 {
    let pixel = random.stream.pixel;
    let corner = Vec2::new((pixel % width) as f32, (pixel / width) as f32);
    corner + Vec2::new(random.float(RANDOM_CAMERA_X), random.float(RANDOM_CAMERA_Y))
}

/// Returns two numbers that choose a point on the lens.
pub fn lens_numbers(random: Numbers) -> Vec2 {
    Vec2::new(random.float(RANDOM_LENS_U), random.float(RANDOM_LENS_V))
}

/// Returns a ray through a point on the lens, uniform over it for two uniform numbers. It meets `ray`, which
/// goes through the lens's centre, in the plane in focus. Without a lens `ray` itself is returned.
pub fn through_lens(camera: &Camera, ray: Ray, random: Vec2) -> Ray {
    let (Some(lens), Projection::Perspective { .. }) = (camera.lens, camera.projection) else { return ray };
    if !(lens.aperture > 0.0) {
        return ray;
    }
    let [right, up, forward] = axes(camera);
    let place = cosine_hemisphere(random) * (0.5 * lens.aperture);
    let offset = right * place.x + up * place.y;
    let depth = ray.direction.dot(forward);
    Ray {
        origin: ray.origin + offset,
        direction: (ray.direction - offset * (depth / lens.focus)).normalize(),
        ..ray
    }
}

/// Returns the axes of the camera: right, up and into the image.
fn axes(camera: &Camera) -> [Vec3; 3] {
    let axes = camera.world_from_camera.matrix3;
    let axis = |axis: DVec3, otherwise: DVec3| axis.normalize_or(otherwise).as_vec3();
    [axis(axes.x_axis, DVec3::X), axis(axes.y_axis, DVec3::Y), axis(-axes.z_axis, DVec3::NEG_Z)]
}

/// Returns the ray through the centre of the lens and `position` (pixels from the top left corner; the first
/// pixel's centre is (0.5, 0.5)), relative to `frame_origin` (world, metres). Its cone is that of one sample
/// of the pixel; it passes no backs.
pub fn camera_ray(view: &View, frame_origin: DVec3, position: Vec2) -> Ray {
    let [right, up, forward] = axes(&view.camera);
    let eye = (view.camera.world_from_camera.translation - frame_origin).as_vec3();
    let [half_width, half_height] = view.camera.half_extents(view.width, view.height);
    let pixel = 2.0 * half_height / f64::from(view.height);
    let x = (2.0 * position.x / view.width as f32 - 1.0) * half_width as f32;
    let y = (1.0 - 2.0 * position.y / view.height as f32) * half_height as f32;
    let across: Vec3 = right * x + up * y;
    let (origin, direction, cone_width, cone_spread) = match view.camera.projection {
        Projection::Perspective { .. } => (eye, (forward + across).normalize(), 0.0, pixel.atan() as f32),
        Projection::Orthographic { .. } => (eye + across, forward, pixel as f32, 0.0),
    };
    let scale = 1.0 / (view.samples.max(1) as f32).sqrt();
    Ray {
        origin,
        direction,
        t_max: f32::INFINITY,
        exclude_primitive: None,
        culls_back_faces: false,
        cone_width: cone_width * scale,
        cone_spread: cone_spread * scale,
    }
}
