//! Eye of a build, and the view of a camera at that eye.

use rasray_shaders_glsl::constants::ads::PLACEMENT_EYE_LIMIT;

use crate::GeometryExtent;

/// View of a camera: a pyramid whose apex is the eye. The axes are unit vectors, perpendicular to each other.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CameraView {
    /// Unit vector towards the right of the image.
    pub right: [f32; 3],
    /// Unit vector towards the top of the image.
    pub up: [f32; 3],
    /// Unit vector into the image.
    pub forward: [f32; 3],
    /// Half the image's width at a distance of one along `forward`; positive.
    pub half_width: f32,
    /// Half the image's height at a distance of one along `forward`; positive.
    pub half_height: f32,
}

impl CameraView {
    /// Returns the rows of the matrix under which the pyramid is `|x| <= z`, `|y| <= z`: depth is z.
    pub fn rows(&self) -> [[f32; 3]; 3] {
        [self.right.map(|x| x / self.half_width), self.up.map(|x| x / self.half_height), self.forward]
    }

    /// Returns true if a point, given relative to the eye, lies within the pyramid.
    pub fn sees(&self, point: [f64; 3]) -> bool {
        let along = |axis: [f32; 3]| (0..3).map(|i| f64::from(axis[i]) * point[i]).sum::<f64>();
        let depth = along(self.forward);
        depth > 0.0
            && along(self.right).abs() <= depth * f64::from(self.half_width)
            && along(self.up).abs() <= depth * f64::from(self.half_height)
    }

    /// Returns true if all numbers are finite and the pyramid has a positive width and height.
    pub fn is_valid(&self) -> bool {
        let halves = [self.half_width, self.half_height];
        let finite = self.rows().iter().flatten().all(|x| x.is_finite());
        finite && halves.iter().all(|half| *half > 0.0 && half.is_finite())
    }
}

/// The eye and the camera for which a build is made. Structures without views ignore both; those without a
/// view of the camera ignore the camera.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Viewpoint {
    /// Position of the eye, metres relative to the frame origin.
    pub eye: [f32; 3],
    /// View of the camera at the eye; absent if there is no camera, or no perspective one.
    pub camera: Option<CameraView>,
}

impl Viewpoint {
    /// Returns the same camera with another eye.
    pub fn at(self, eye: [f32; 3]) -> Self {
        Self { eye, ..self }
    }
}

impl From<[f32; 3]> for Viewpoint {
    /// Makes a viewpoint of an eye without a camera.
    fn from(eye: [f32; 3]) -> Self {
        Self { eye, camera: None }
    }
}

/// Returns true if cells of one box over the stated bounds of a geometry are the same for both viewpoints.
pub fn box_is_same(extent: &GeometryExtent, built: Viewpoint, wanted: Viewpoint) -> bool {
    [built, wanted].iter().all(|viewpoint| box_ignores_eye(extent, viewpoint.eye))
}

/// Returns true if cells of one box over the stated bounds of a geometry are the same for this eye as for
/// every other eye that is as near. An eye farther away than `PLACEMENT_EYE_LIMIT` times half the longest
/// side, and outside of the whole geometry of which this one is a part, gives cells with wider margins
/// (`box_placement` in `ads/placement.glsl`).
fn box_ignores_eye(extent: &GeometryExtent, eye: [f32; 3]) -> bool {
    let [lower, upper] = extent.bounds;
    let [around_lower, around_upper] = extent.around;
    let along = |of: &dyn Fn(usize) -> f32| (0..3).map(of).fold(0.0_f32, f32::max);
    let from_centre =
        |point: [f32; 3], axis: usize| (point[axis] - (0.5 * lower[axis] + 0.5 * upper[axis])).abs();
    let reach = along(&|axis| 0.5 * (upper[axis] - lower[axis]));
    let around = along(&|axis| from_centre(around_lower, axis).max(from_centre(around_upper, axis)));
    along(&|axis| from_centre(eye, axis)) <= (PLACEMENT_EYE_LIMIT * reach).max(around)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_a_camera_sees_is_a_pyramid_under_its_rows() {
        let view = CameraView {
            right: [0.0, 0.0, -1.0],
            up: [0.0, 1.0, 0.0],
            forward: [-1.0, 0.0, 0.0],
            half_width: 2.0,
            half_height: 0.5,
        };
        assert!(view.is_valid());
        for (point, seen) in [
            ([-1.0, 0.0, 0.0], true),
            ([-1.0, 0.0, 1.9], true),
            ([-1.0, 0.0, 2.1], false),
            ([-1.0, 0.6, 0.0], false),
            ([1.0, 0.0, 0.0], false),
        ] {
            assert_eq!(view.sees(point), seen, "{point:?}");
            let [x, y, z] = view.rows().map(|row| (0..3).map(|i| f64::from(row[i]) * point[i]).sum::<f64>());
            assert_eq!(z > 0.0 && x.abs() <= z && y.abs() <= z, seen, "{point:?}");
        }
        assert!(!CameraView { half_width: 0.0, ..view }.is_valid());
    }

    #[test]
    fn a_box_depends_on_eyes_far_outside_of_the_whole() {
        let at = |x: f32| Viewpoint::from([x, 0.0, 0.0]);
        let part = GeometryExtent::new(12, [[-1.0; 3], [1.0; 3]]);
        let limit = PLACEMENT_EYE_LIMIT;
        assert!(box_is_same(&part, at(0.0), at(limit)));
        assert!(
            !box_is_same(&part, at(0.0), at(1.5 * limit)) && !box_is_same(&part, at(-2.0 * limit), at(0.0))
        );
        // An equal box inside a whole geometry that reaches as far as that eye.
        let within = GeometryExtent { around: [[-2.0 * limit; 3], [2.0 * limit; 3]], ..part };
        assert!(box_is_same(&within, at(-2.0 * limit), at(1.5 * limit)));
        assert!(!box_is_same(&within, at(0.0), at(2.5 * limit)));
    }
}
