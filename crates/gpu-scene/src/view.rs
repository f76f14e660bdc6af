//! The camera as shaders read it.

use glam::DVec3;
use rasray_scene::{BackFaces, Camera, Projection, Sampler};
use rasray_shaders_glsl::constants::contract::RAY_CULL_BACK_FACES;
use rasray_shaders_glsl::constants::scene::{
    PROJECTION_ORTHOGRAPHIC, PROJECTION_PERSPECTIVE, SAMPLER_PCG, SAMPLER_SOBOL,
};

use crate::layout::Frame;

/// View to render: a camera, the size of the image, and the seed of its random numbers.
#[derive(Clone, Debug)]
pub struct View {
    /// Placement and projection of the camera, world.
    pub camera: Camera,
    /// Pixels per row of the whole image, at least 1.
    pub width: u32,
    /// Number of rows of the whole image, at least 1.
    pub height: u32,
    /// Seed of all random numbers.
    pub seed: u32,
}

/// Sampling of pixels, except for the seed of the view, and choice of the surfaces that their rays pass.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Sampling {
    /// Source of random numbers.
    pub sampler: Sampler,
    /// Number of samples per pixel that share a pixel's footprint on textures, at least 1.
    pub samples: u32,
    /// Rays that pass the backs of single-sided surfaces.
    pub back_faces: BackFaces,
}

impl Default for Sampling {
    fn default() -> Self {
        Self { sampler: Sampler::default(), samples: 1, back_faces: BackFaces::default() }
    }
}

impl Sampling {
    /// Writes the fields of `frame` that depend on the sampling. Without a single-sided surface the rays need
    /// no test for one.
    pub fn write(self, frame: &mut Frame, has_single_sided: bool) {
        let flags = |passes: bool| if passes && has_single_sided { RAY_CULL_BACK_FACES } else { 0 };
        frame.camera_ray_flags = flags(self.back_faces.lets_camera_rays());
        frame.spawned_ray_flags = flags(self.back_faces.lets_other_rays());
        frame.sampling = match self.sampler {
            Sampler::Sobol => SAMPLER_SOBOL,
            Sampler::Pcg => SAMPLER_PCG,
        };
        frame.footprint_scale = 1.0 / (self.samples.max(1) as f32).sqrt();
    }
}

impl View {
    /// Returns the position of the eye, world, metres.
    pub fn eye(&self) -> DVec3 {
        self.camera.world_from_camera.translation
    }

    /// Writes the fields of `frame` that depend on the view; `frame_origin` is in metres, world. The axes of
    /// the camera are normalised: scale in its placement does not change the picture.
    pub fn write(&self, frame: &mut Frame, frame_origin: DVec3) {
        let axes = self.camera.world_from_camera.matrix3;
        let unit = |axis: DVec3, otherwise: DVec3| axis.normalize_or(otherwise).as_vec3().to_array();
        let [half_width, half_height] = self.camera.half_extents(self.width, self.height);
        let pixel = 2.0 * half_height / f64::from(self.height.max(1));
        frame.camera_position = (self.eye() - frame_origin).as_vec3().to_array();
        frame.camera_right = unit(axes.x_axis, DVec3::X);
        frame.camera_up = unit(axes.y_axis, DVec3::Y);
        frame.camera_forward = unit(-axes.z_axis, DVec3::NEG_Z);
        frame.width = self.width.max(1);
        frame.height = self.height.max(1);
        frame.seed = self.seed;
        (frame.half_width, frame.half_height) = (half_width as f32, half_height as f32);
        (frame.lens_radius, frame.focus_distance) = (0.0, 0.0);
        match self.camera.projection {
            Projection::Perspective { .. } => {
                frame.projection = PROJECTION_PERSPECTIVE;
                (frame.cone_spread, frame.cone_width) = (pixel.atan() as f32, 0.0);
                if let Some(lens) = self.camera.lens {
                    (frame.lens_radius, frame.focus_distance) = (0.5 * lens.aperture, lens.focus);
                }
            }
            Projection::Orthographic { .. } => {
                frame.projection = PROJECTION_ORTHOGRAPHIC;
                (frame.cone_spread, frame.cone_width) = (0.0, pixel as f32);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::{DAffine3, DMat3};
    use rasray_scene::Lens;

    fn camera(projection: Projection) -> Camera {
        let linear = DMat3::from_rotation_y(std::f64::consts::FRAC_PI_2) * 3.0;
        let world_from_camera = DAffine3::from_mat3_translation(linear, DVec3::new(1e6, 2.0, 3.0));
        Camera { name: "test".to_owned(), world_from_camera, projection, aspect_ratio: None, lens: None }
    }

    #[test]
    fn a_turned_and_scaled_camera_looks_along_its_own_z() {
        let view = View {
            camera: camera(Projection::Perspective { fov_y: std::f32::consts::FRAC_PI_2 }),
            width: 200,
            height: 100,
            seed: 7,
        };
        let mut frame = Frame::default();
        view.write(&mut frame, DVec3::new(1e6, 0.0, 0.0));
        assert_eq!(frame.camera_position, [0.0, 2.0, 3.0]);
        for (axis, expected) in [
            (frame.camera_forward, [-1.0, 0.0, 0.0]),
            (frame.camera_right, [0.0, 0.0, -1.0]),
            (frame.camera_up, [0.0, 1.0, 0.0]),
        ] {
            assert!((0..3).all(|i| (axis[i] - expected[i]).abs() < 1e-7), "{axis:?}");
        }
        assert!((frame.half_height - 1.0).abs() < 1e-6 && (frame.half_width - 2.0).abs() < 1e-6);
        assert!((frame.cone_spread - 0.02).abs() < 1e-5 && frame.cone_width == 0.0);
        assert_eq!((frame.width, frame.height, frame.seed), (200, 100, 7));
    }

    #[test]
    fn an_image_narrower_than_the_frame_shows_all_of_it() {
        let framed =
            Camera { aspect_ratio: Some(2.0), ..camera(Projection::Orthographic { half_height: 1.0 }) };
        for (width, height, halves) in [(90, 90, [2.0, 2.0]), (180, 90, [2.0, 1.0]), (270, 90, [3.0, 1.0])] {
            let mut frame = Frame::default();
            View { camera: framed.clone(), width, height, seed: 0 }.write(&mut frame, DVec3::ZERO);
            assert_eq!([frame.half_width, frame.half_height], halves, "{width}x{height}");
            assert_eq!(frame.cone_width, 2.0 * halves[1] / 90.0, "pixels are as large as they are high");
        }
    }

    #[test]
    fn a_perspective_has_a_lens_where_the_camera_does() {
        let written = |camera| {
            let mut frame = Frame { lens_radius: 7.0, ..Frame::default() };
            View { camera, width: 4, height: 4, seed: 0 }.write(&mut frame, DVec3::ZERO);
            [frame.lens_radius, frame.focus_distance]
        };
        let lens = Some(Lens { aperture: 0.5, focus: 3.0 });
        let pinhole = camera(Projection::Perspective { fov_y: 1.0 });
        assert_eq!(written(Camera { lens, ..pinhole.clone() }), [0.25, 3.0]);
        assert_eq!(written(pinhole), [0.0; 2]);
        let parallel = camera(Projection::Orthographic { half_height: 1.0 });
        assert_eq!(written(Camera { lens, ..parallel }), [0.0; 2]);
    }

    #[test]
    fn a_sample_has_its_share_of_the_pixel() {
        let mut frame = Frame::default();
        Sampling { sampler: Sampler::Pcg, samples: 16, ..Sampling::default() }.write(&mut frame, false);
        assert_eq!((frame.sampling, frame.footprint_scale), (SAMPLER_PCG, 0.25));
        Sampling::default().write(&mut frame, false);
        assert_eq!((frame.sampling, frame.footprint_scale), (SAMPLER_SOBOL, 1.0));
    }

    #[test]
    fn rays_look_for_backs_where_they_pass_them_and_there_are_any() {
        let flags = |back_faces, has_single_sided| {
            let mut frame = Frame::default();
            Sampling { back_faces, ..Sampling::default() }.write(&mut frame, has_single_sided);
            [frame.camera_ray_flags, frame.spawned_ray_flags]
        };
        assert_eq!(flags(BackFaces::Camera, true), [RAY_CULL_BACK_FACES, 0]);
        assert_eq!(flags(BackFaces::All, true), [RAY_CULL_BACK_FACES; 2]);
        assert_eq!(flags(BackFaces::None, true), [0; 2]);
        assert!(BackFaces::ALL.iter().all(|back_faces| flags(*back_faces, false) == [0; 2]));
    }

    #[test]
    fn a_parallel_projection_has_pixels_of_one_size() {
        let view = View {
            camera: camera(Projection::Orthographic { half_height: 4.0 }),
            width: 30,
            height: 40,
            seed: 0,
        };
        let mut frame = Frame::default();
        view.write(&mut frame, DVec3::ZERO);
        assert_eq!((frame.half_height, frame.half_width), (4.0, 3.0));
        assert_eq!((frame.cone_width, frame.cone_spread), (0.2, 0.0));
    }
}
