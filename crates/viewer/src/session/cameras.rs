//! From where the scene of a session is seen.

use rasray_scene::{Camera, Lens};

use super::{REST, Session};
use crate::camera_control::{CameraControl, Side};

/// From where the scene is seen.
pub(super) enum Stand {
    /// As the command line said.
    AsGiven,
    /// A camera of the scene, by its position there.
    Camera(usize),
    /// Moved by hand.
    Moved(CameraControl),
}

impl Session {
    /// The camera, to be moved at `now` (seconds); nothing before the first picture says where it is.
    pub fn move_camera(&mut self, now: f64) -> Option<&mut CameraControl> {
        self.take_camera()?;
        self.moving_until = now + REST;
        match &mut self.stand {
            Stand::Moved(control) => Some(control),
            Stand::AsGiven | Stand::Camera(_) => None,
        }
    }

    /// The camera as it was moved, or else that of the last picture.
    fn camera(&self) -> Option<CameraControl> {
        if let Stand::Moved(control) = &self.stand {
            return Some(control.clone());
        }
        let picture = self.picture.as_ref()?;
        Some(self.control_of(&picture.camera, [picture.width, picture.height]))
    }

    /// A camera, to be moved by hand; the size is of its picture, pixels.
    fn control_of(&self, camera: &Camera, size: [u32; 2]) -> CameraControl {
        let frame = &camera.world_from_camera;
        let (low, high) = self.opening.bounds;
        let forward = (-frame.matrix3.z_axis).normalize_or_zero();
        // Around the middle of the scene, or what is in front of a camera that has passed it.
        let ahead = (0.5 * (low + high) - frame.translation).dot(forward);
        let distance = ahead.max(0.2 * self.radius());
        CameraControl::from_camera(camera, size, distance)
    }

    /// Takes the camera from where the last picture was seen.
    pub(super) fn take_camera(&mut self) -> Option<()> {
        self.stand = Stand::Moved(self.camera()?);
        Some(())
    }

    /// The lens of the camera, as [`CameraControl::lens`]; nothing before the first picture says where it is.
    pub fn lens(&self) -> Option<Lens> {
        self.camera().map(|camera| camera.lens())
    }

    /// Changes it at `now` (seconds).
    pub fn set_lens(&mut self, lens: Lens, now: f64) {
        if let Some(camera) = self.move_camera(now) {
            camera.set_lens(lens);
        }
    }

    /// Puts the camera back to where the command line had it.
    pub fn reset_camera(&mut self) {
        self.stand = Stand::AsGiven;
    }

    /// True if the camera was moved.
    pub fn is_camera_moved(&self) -> bool {
        matches!(self.stand, Stand::Moved(_))
    }

    /// The cameras of the scene, as the command line names them.
    pub fn cameras(&self) -> impl Iterator<Item = &str> {
        self.opening.cameras.iter().map(|(_, word)| word.as_str())
    }

    /// Looks through a camera of the scene, by its place in [`Session::cameras`], and moves with it.
    pub fn choose_camera(&mut self, place: usize) {
        if let Some((index, _)) = self.opening.cameras.get(place) {
            self.stand = Stand::Camera(*index);
        }
    }

    /// The one of [`Session::cameras`] that is looked through.
    pub fn chosen_camera(&self) -> Option<usize> {
        let Stand::Camera(chosen) = self.stand else { return None };
        self.opening.cameras.iter().position(|(index, _)| *index == chosen)
    }

    /// Looks from where a scene without cameras is seen from.
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

    /// Looks from a side at what is turned around, at `now` (seconds).
    pub fn view_along(&mut self, side: Side, now: f64) {
        if let Some(camera) = self.move_camera(now) {
            camera.view_along(side);
        }
    }
}
