//! Cameras of a session.

use rasray_scene::{Camera, Lens};

use super::{REST, Session};
use crate::camera_control::{CameraControl, Side};

/// Standpoint from which the scene is seen.
pub(super) enum Stand {
    /// Camera of the command line.
    AsGiven,
    /// Camera of the scene, by its index.
    Camera(usize),
    /// Camera moved by hand.
    Moved(CameraControl),
}

impl Session {
    /// Returns the camera, to be moved at `now` (seconds); `None` before the first picture, which tells its
    /// place.
    pub fn move_camera(&mut self, now: f64) -> Option<&mut CameraControl> {
        self.take_camera()?;
        self.moving_until = now + REST;
        match &mut self.stand {
            Stand::Moved(control) => Some(control),
            Stand::AsGiven | Stand::Camera(_) => None,
        }
    }

    /// Returns the camera as it was moved, or else that of the last picture.
    fn camera(&self) -> Option<CameraControl> {
        if let Stand::Moved(control) = &self.stand {
            return Some(control.clone());
        }
        let picture = self.picture.as_ref()?;
        Some(self.control_of(&picture.camera, [picture.width, picture.height]))
    }

    /// Makes a control for moving a camera by hand; the size is that of its picture, pixels.
    fn control_of(&self, camera: &Camera, size: [u32; 2]) -> CameraControl {
        let frame = &camera.world_from_camera;
        let (low, high) = self.opening.bounds;
        let forward = (-frame.matrix3.z_axis).normalize_or_zero();
        // The camera turns around the middle of the scene, or around a point in front if it has passed the
        // middle.
        let ahead = (0.5 * (low + high) - frame.translation).dot(forward);
        let distance = ahead.max(0.2 * self.radius());
        CameraControl::from_camera(camera, size, distance)
    }

    /// Takes the camera of the last picture.
    pub(super) fn take_camera(&mut self) -> Option<()> {
        self.stand = Stand::Moved(self.camera()?);
        Some(())
    }

    /// Returns the lens of the camera, as [`CameraControl::lens`]; `None` before the first picture.
    pub fn lens(&self) -> Option<Lens> {
        self.camera().map(|camera| camera.lens())
    }

    /// Changes the lens at `now` (seconds).
    pub fn set_lens(&mut self, lens: Lens, now: f64) {
        if let Some(camera) = self.move_camera(now) {
            camera.set_lens(lens);
        }
    }

    /// Returns the camera to the place that the command line gave.
    pub fn reset_camera(&mut self) {
        self.stand = Stand::AsGiven;
    }

    /// True if the camera was moved.
    pub fn is_camera_moved(&self) -> bool {
        matches!(self.stand, Stand::Moved(_))
    }

    /// Returns the cameras of the scene, as the command line names them.
    pub fn cameras(&self) -> impl Iterator<Item = &str> {
        self.opening.cameras.iter().map(|(_, word)| word.as_str())
    }

    /// Looks through a camera of the scene, by its place in [`Session::cameras`], and moves with it.
    pub fn choose_camera(&mut self, place: usize) {
        if let Some((index, _)) = self.opening.cameras.get(place) {
            self.stand = Stand::Camera(*index);
        }
    }

    /// Returns the place in [`Session::cameras`] of the camera that is looked through.
    pub fn chosen_camera(&self) -> Option<usize> {
        let Stand::Camera(chosen) = self.stand else { return None };
        self.opening.cameras.iter().position(|(index, _)| *index == chosen)
    }

    /// Looks through the camera that a scene without cameras gets.
    pub fn choose_default_camera(&mut self) {
        let camera = self.opening.default_camera.clone();
        self.stand = Stand::Moved(self.control_of(&camera, [self.frame.width, self.frame.height]));
    }

    /// Brings the whole scene, as it is at rest, into the picture at `now` (seconds).
    pub fn frame_all(&mut self, now: f64) {
        let (bounds, size) = (self.opening.bounds, [self.frame.width, self.frame.height]);
        if let Some(camera) = self.move_camera(now) {
            camera.frame_all(bounds, size);
        }
    }

    /// Looks from a side at the point that the camera turns around, at `now` (seconds).
    pub fn view_along(&mut self, side: Side, now: f64) {
        if let Some(camera) = self.move_camera(now) {
            camera.view_along(side);
        }
    }
}
