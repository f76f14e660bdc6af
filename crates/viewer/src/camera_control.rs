//! Camera that is moved by hand.

use crate::error::ViewerError;
use glam::{DMat3, DVec3};
use rasray_options::text::{number, numbers};
use rasray_scene::{Camera, Lens, Projection};
use rasray_scene_source::placed_view;

/// Largest angle up and down, radians: less than straight up, where a camera without roll has no right side.
const STEEPEST: f64 = 89.0 * std::f64::consts::PI / 180.0;

/// Numbers of a camera in the form of the command line: eye and target in metres, the full vertical angle of
/// view in degrees.
#[derive(Clone, Debug, PartialEq)]
pub struct Rounded {
    /// Position of the eye.
    pub eye: String,
    /// Point at which the camera looks.
    pub target: String,
    /// Full vertical angle of view, degrees.
    pub fov: String,
    /// Lens of the camera; absent for a pinhole.
    pub lens: Option<Lens>,
}

impl Rounded {
    /// Returns the camera that these numbers describe.
    ///
    /// # Errors
    /// Eye and target coincide.
    pub fn camera(&self) -> Result<Camera, ViewerError> {
        let point = |text| numbers(text, &[',']);
        let (eye, target) = point(&self.eye).zip(point(&self.target)).ok_or(ViewerError::Nowhere)?;
        let fov = number(&self.fov).ok_or(ViewerError::Nowhere)?;
        Ok(Camera { lens: self.lens, ..placed_view(eye, target, Some(fov))?.camera })
    }
}

/// Side from which a scene is seen: y is up, and the front is towards +z, as in glTF.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Side {
    /// View from +z.
    Front,
    /// View from -z.
    Back,
    /// View from +x.
    Right,
    /// View from -x.
    Left,
    /// View from +y, with -z upwards in the picture.
    Top,
    /// View from -y, with +z upwards in the picture.
    Bottom,
}

impl Side {
    /// All sides, each followed by its opposite.
    pub const ALL: [Self; 6] = [Self::Front, Self::Back, Self::Right, Self::Left, Self::Top, Self::Bottom];

    /// Returns the label of the side.
    pub fn name(self) -> &'static str {
        match self {
            Self::Front => "front",
            Self::Back => "back",
            Self::Right => "right",
            Self::Left => "left",
            Self::Top => "top",
            Self::Bottom => "bottom",
        }
    }

    /// Returns the direction from the scene to the camera.
    fn direction(self) -> DVec3 {
        match self {
            Self::Front => DVec3::Z,
            Self::Back => DVec3::NEG_Z,
            Self::Right => DVec3::X,
            Self::Left => DVec3::NEG_X,
            Self::Top => DVec3::Y,
            Self::Bottom => DVec3::NEG_Y,
        }
    }
}

/// Position of a camera and the point that it turns around, in the world, metres. The camera stays upright: y
/// is up.
#[derive(Clone, Debug, PartialEq)]
pub struct CameraControl {
    eye: DVec3,
    target: DVec3,
    /// Full vertical angle of view, degrees.
    fov: f64,
    /// Lens, whose distance of focus is kept when the camera moves.
    lens: Option<Lens>,
}

impl CameraControl {
    /// Takes over from a camera whose picture is `width` by `height` pixels. The control turns around the
    /// point in front of the camera that is `distance` metres away. A roll is lost; a parallel projection
    /// becomes a perspective that sees as much at that point.
    pub fn from_camera(camera: &Camera, [width, height]: [u32; 2], distance: f64) -> Self {
        let frame = &camera.world_from_camera;
        let eye = frame.translation;
        let forward = (-frame.matrix3.z_axis).normalize_or(DVec3::NEG_Z);
        let distance = if distance.is_finite() && distance > 0.0 { distance } else { 1.0 };
        let [_, half_height] = camera.half_extents(width, height);
        let tangent = match camera.projection {
            Projection::Perspective { .. } => half_height,
            Projection::Orthographic { .. } => half_height / distance,
        };
        let fov = 2.0 * tangent.atan().to_degrees();
        let (target, fov, lens) = (eye + forward * distance, fov.clamp(0.01, 175.0), camera.lens);
        let mut control = Self { eye, target, fov, lens };
        // This keeps the view away from straight up or down.
        control.orbit(0.0, 0.0);
        control
    }

    /// Returns the lens; for a camera without one a closed lens whose focus is the point that the camera
    /// turns around.
    pub fn lens(&self) -> Lens {
        self.lens.unwrap_or(Lens { aperture: 0.0, focus: self.distance() as f32 })
    }

    /// Opens a lens, or closes it to a pinhole with an aperture of 0. Numbers that no lens has change
    /// nothing.
    pub fn set_lens(&mut self, lens: Lens) {
        if !(lens.aperture >= 0.0 && lens.aperture.is_finite() && lens.focus > 0.0 && lens.focus.is_finite())
        {
            return;
        }
        self.lens = (lens.aperture > 0.0).then_some(lens);
    }

    /// Turns towards a point, which is the centre of turns from then on.
    pub fn look_at(&mut self, point: DVec3) {
        if point.is_finite() && (point - self.eye).length() > 1.0e-9 * (1.0 + self.eye.length()) {
            self.target = point;
            // This keeps the view away from straight up or down.
            self.orbit(0.0, 0.0);
        }
    }

    /// Moves back or forward, and aside, so that a box (its least and greatest corner, in the world, metres)
    /// is in the middle and a ball around it fits into a picture of `width` by `height` pixels. The direction
    /// of view stays.
    pub fn frame_all(&mut self, (low, high): (DVec3, DVec3), [width, height]: [u32; 2]) {
        let radius =
            (0.5 * (high - low).length()).max(1.0e-6 * (1.0 + high.abs().max(low.abs()).max_element()));
        let half_height = (0.5 * self.fov.to_radians()).tan();
        let narrowest = half_height * (f64::from(width) / f64::from(height.max(1))).min(1.0);
        let distance = radius / narrowest.atan().sin();
        if distance.is_finite() {
            let back = self.axes().z_axis;
            self.target = 0.5 * (low + high);
            self.eye = self.target + back * distance;
        }
    }

    /// Looks at the target along an axis, at the current distance.
    pub fn view_along(&mut self, side: Side) {
        self.eye = self.target + side.direction() * self.distance();
    }

    fn distance(&self) -> f64 {
        (self.target - self.eye).length()
    }

    /// Returns the directions right, up and back.
    fn axes(&self) -> DMat3 {
        let back = (self.eye - self.target).normalize_or(DVec3::Z);
        let right = DVec3::Y.cross(back).try_normalize().unwrap_or(DVec3::X);
        DMat3::from_cols(right, back.cross(right), back)
    }

    /// Returns the direction of `offset` turned around y and then up, but not beyond [`STEEPEST`]; radians.
    fn turned(offset: DVec3, around: f64, up: f64) -> DVec3 {
        let length = offset.length();
        let pitch = (offset.y / length).clamp(-1.0, 1.0).asin();
        let pitch = (pitch + up).clamp(-STEEPEST, STEEPEST);
        let heading = offset.x.atan2(offset.z) + around;
        length * DVec3::new(heading.sin() * pitch.cos(), pitch.sin(), heading.cos() * pitch.cos())
    }

    /// Turns around the target, radians: to the right of it, and over it.
    pub fn orbit(&mut self, right: f64, over: f64) {
        self.eye = self.target + Self::turned(self.eye - self.target, right, over);
    }

    /// Turns in place, radians: to the right, and upwards.
    pub fn look(&mut self, right: f64, up: f64) {
        self.target = self.eye + Self::turned(self.target - self.eye, -right, up);
    }

    /// Moves along the camera's right and up, in heights of the picture at the target.
    pub fn pan(&mut self, right: f64, up: f64) {
        let height = 2.0 * self.distance() * (0.5 * self.fov.to_radians()).tan();
        let axes = self.axes();
        self.shift((axes.x_axis * right + axes.y_axis * up) * height);
    }

    /// Moves towards the target (positive) or away from it, by a tenth of the distance per step.
    pub fn zoom(&mut self, steps: f64) {
        let distance = self.distance() * 0.9_f64.powf(steps);
        if distance.is_finite() && distance > 1.0e-9 * (1.0 + self.eye.length()) {
            self.eye = self.target + self.axes().z_axis * distance;
        }
    }

    /// Flies forward, right and up (along y), metres.
    pub fn fly(&mut self, forward: f64, right: f64, up: f64) {
        let axes = self.axes();
        self.shift(axes.x_axis * right - axes.z_axis * forward + DVec3::Y * up);
    }

    fn shift(&mut self, by: DVec3) {
        if by.is_finite() {
            self.eye += by;
            self.target += by;
        }
    }

    /// Returns the numbers of the camera, rounded to a millionth of the distance to the target, since no more
    /// digits can be seen.
    pub fn rounded(&self) -> Rounded {
        let digits = (6.0 - self.distance().log10().ceil()).clamp(0.0, 15.0) as usize;
        let number = |value: f64| trimmed(&format!("{value:.digits$}"));
        let point = |point: DVec3| point.to_array().map(number).join(",");
        Rounded {
            eye: point(self.eye),
            target: point(self.target),
            fov: trimmed(&format!("{:.5}", self.fov)),
            lens: self.lens,
        }
    }
}

/// Removes the zeros at the end of a number.
fn trimmed(text: &str) -> String {
    let text = if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.') } else { text };
    if text == "-0" { "0".to_owned() } else { text.to_owned() }
}

#[cfg(test)]
mod tests {
    use super::*;
    use rasray_scene::default_view::camera_looking_at;

    fn control() -> CameraControl {
        let camera = camera_looking_at("", DVec3::new(0.0, 1.0, 5.0), DVec3::new(0.0, 1.0, 0.0), 0.8);
        CameraControl::from_camera(&camera, [16, 9], 5.0)
    }

    fn close(one: DVec3, other: DVec3) -> bool {
        (one - other).length() < 1.0e-9
    }

    #[test]
    fn taking_over_changes_nothing_that_can_be_seen() {
        let camera = control().rounded().camera().expect("a camera");
        let before = camera_looking_at("", DVec3::new(0.0, 1.0, 5.0), DVec3::new(0.0, 1.0, 0.0), 0.8);
        assert!(camera.world_from_camera.abs_diff_eq(before.world_from_camera, 1.0e-6));
        let Projection::Perspective { fov_y } = camera.projection else { panic!("perspective") };
        assert!((fov_y - 0.8).abs() < 1.0e-6);
    }

    #[test]
    fn an_orbit_keeps_target_and_distance_and_a_look_keeps_the_eye() {
        let mut orbit = control();
        orbit.orbit(std::f64::consts::FRAC_PI_2, 0.0);
        assert!(close(orbit.eye, DVec3::new(5.0, 1.0, 0.0)), "{:?}", orbit.eye);
        orbit.orbit(0.3, 0.4);
        assert!(close(orbit.target, control().target) && (orbit.distance() - 5.0).abs() < 1.0e-9);
        let mut look = control();
        look.look(std::f64::consts::FRAC_PI_2, 0.0);
        assert!(close(look.eye, control().eye) && close(look.target, DVec3::new(5.0, 1.0, 5.0)));
        look.look(0.0, 9.0);
        assert!(look.target.y > look.eye.y && look.rounded().camera().is_ok(), "never straight up");
    }

    #[test]
    fn moving_takes_the_target_along_and_zooming_does_not() {
        let mut moved = control();
        moved.fly(1.0, 2.0, 3.0);
        assert!(
            close(moved.eye, DVec3::new(2.0, 4.0, 4.0)) && close(moved.target, DVec3::new(2.0, 4.0, -1.0))
        );
        let mut panned = control();
        panned.pan(0.5, 0.0);
        let half = 5.0 * 0.4_f64.tan();
        assert!((panned.eye - DVec3::new(half, 1.0, 5.0)).length() < 1.0e-6, "{:?}", panned.eye);
        let mut zoomed = control();
        zoomed.zoom(1.0);
        assert!(close(zoomed.target, control().target) && (zoomed.distance() - 4.5).abs() < 1.0e-9);
        zoomed.zoom(1.0e6);
        assert!(zoomed.distance() > 0.0 && zoomed.rounded().camera().is_ok());
    }

    #[test]
    fn everything_is_in_the_middle_and_within_the_picture() {
        let bounds = (DVec3::new(-3.0, -1.0, -2.0), DVec3::new(1.0, 1.0, 0.0));
        for size in [[640, 360], [360, 640]] {
            let mut control = control();
            control.orbit(0.7, 0.3);
            let before = control.axes();
            control.frame_all(bounds, size);
            assert!(control.axes().abs_diff_eq(before, 1.0e-9), "it looks in the same direction");
            let camera = control.rounded().camera().expect("a camera");
            let half = camera.half_extents(size[0], size[1]);
            let camera_from_world = camera.world_from_camera.inverse();
            let mut farthest = 0.0_f64;
            for corner in 0..8 {
                let pick =
                    |axis: usize| if corner >> axis & 1 == 0 { bounds.0[axis] } else { bounds.1[axis] };
                let seen = camera_from_world.transform_point3(DVec3::new(pick(0), pick(1), pick(2)));
                farthest =
                    farthest.max((seen.x / seen.z / half[0]).abs()).max((seen.y / seen.z / half[1]).abs());
            }
            assert!((0.5..=1.0).contains(&farthest), "{size:?}: {farthest}");
        }
        let mut point = control();
        point.frame_all((DVec3::ONE, DVec3::ONE), [16, 9]);
        assert!(point.rounded().camera().is_ok(), "a scene of one point");
    }

    #[test]
    fn sides_are_exact_keep_the_distance_and_can_be_turned_from() {
        for side in Side::ALL {
            let mut control = control();
            control.orbit(0.3, 0.4);
            control.view_along(side);
            let camera = control.rounded().camera().expect("a camera");
            let back = camera.world_from_camera.matrix3.z_axis;
            assert!(close(back, side.direction()), "{}: {back}", side.name());
            assert!((control.distance() - 5.0).abs() < 1.0e-9);
            control.orbit(0.1, 0.0);
            control.pan(0.1, 0.1);
            assert!(control.rounded().camera().is_ok() && control.eye.is_finite());
        }
        let mut top = control();
        top.view_along(Side::Top);
        let camera = top.rounded().camera().expect("a camera");
        assert!(close(camera.world_from_camera.matrix3.y_axis, DVec3::NEG_Z), "north is up");
    }

    #[test]
    fn a_point_that_is_looked_at_is_what_is_turned_around() {
        let mut control = control();
        let point = DVec3::new(1.0, 0.5, 2.0);
        control.look_at(point);
        assert!(close(control.target, point) && close(control.eye, DVec3::new(0.0, 1.0, 5.0)));
        control.orbit(1.0, 0.2);
        assert!(close(control.target, point));
        let before = control.clone();
        control.look_at(control.eye);
        control.look_at(DVec3::NAN);
        assert_eq!(control, before, "what cannot be looked at changes nothing");
    }

    #[test]
    fn a_lens_opens_in_focus_of_the_target_and_closes() {
        let mut control = control();
        assert_eq!(control.lens(), Lens { aperture: 0.0, focus: 5.0 });
        let open = Lens { aperture: 0.1, ..control.lens() };
        control.set_lens(open);
        assert_eq!(control.rounded().camera().expect("a camera").lens, Some(open));
        for (aperture, focus) in [(f32::NAN, 1.0), (-0.1, 1.0), (0.1, 0.0), (0.1, f32::INFINITY)] {
            control.set_lens(Lens { aperture, focus });
            assert_eq!(control.lens(), open);
        }
        control.fly(1.0, 0.0, 0.0);
        assert_eq!(control.lens(), open, "what is in focus stays as far away");
        control.set_lens(Lens { aperture: 0.0, focus: 2.0 });
        assert_eq!(control.rounded().lens, None);
    }

    #[test]
    fn numbers_are_short_and_stand_for_one_camera() {
        let mut control = control();
        control.orbit(0.123, 0.456);
        let rounded = control.rounded();
        assert!(rounded.eye.split(',').all(|number| number.len() <= 9), "{}", rounded.eye);
        assert_eq!(rounded.target, "0,1,0");
        let again =
            CameraControl::from_camera(&rounded.camera().expect("a camera"), [16, 9], control.distance());
        assert!((again.eye - control.eye).length() < 1.0e-4);
        let far = CameraControl { eye: DVec3::splat(3.0e7), target: DVec3::ZERO, fov: 45.0, lens: None };
        assert_eq!(far.rounded().eye, "30000000,30000000,30000000");
    }
}
