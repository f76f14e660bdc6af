//! The point at which the faces of a cube touch, where that need not be the eye.

/// Rays from farther than `ORIGIN_LIMIT` times the geometry are tested one by one; eyes stay nearer than this.
const EYE_LIMIT: f32 = 3.5;

/// Share of the bounds, on each side, that a centre keeps away from their sides: about a quarter, and no
/// fraction at which a scene is likely to have a wall.
const MARGIN: f32 = 0.2718;

/// Bounds flatter than this, shortest over longest side, have no inside: from a centre among their triangles, all of
/// them would be seen edge-on and cover many tiles.
const FLATTEST: f32 = 0.25;

/// The centre of faces for an eye and geometry within `bounds` (lower, upper), metres: the eye itself within
/// them, or where they are flat; else the point of about their inner half that is nearest to it, as far back
/// towards the eye as rays from there need.
///
/// From an eye far outside, all geometry would lie in a small part of the faces, in few tiles.
pub fn centre_within(eye: [f32; 3], [lower, upper]: [[f32; 3]; 2]) -> [f32; 3] {
    let extent: [f32; 3] = std::array::from_fn(|axis| upper[axis] - lower[axis]);
    let longest = extent.into_iter().fold(0.0_f32, f32::max);
    // Written so that bounds that are not finite keep the centre at the eye.
    let has_inside = extent.into_iter().all(|side| side > FLATTEST * longest) && longest < f32::MAX;
    let is_inside = (0..3).all(|axis| lower[axis] <= eye[axis] && eye[axis] <= upper[axis]);
    if is_inside || !has_inside {
        return eye;
    }
    let within: [f32; 3] = std::array::from_fn(|axis| {
        let margin = MARGIN * extent[axis];
        eye[axis].max(lower[axis] + margin).min(upper[axis] - margin)
    });
    let farthest = |of: &dyn Fn(usize) -> f32| (0..3).map(of).fold(0.0_f32, f32::max);
    let away = farthest(&|axis| (eye[axis] - within[axis]).abs());
    let reach = farthest(&|axis| (upper[axis] - within[axis]).max(within[axis] - lower[axis]));
    // The geometry is at least as far from the centre as that is from where it came, and as `reach`.
    let back = (away - EYE_LIMIT * reach).min(away / (EYE_LIMIT + 1.0)).max(0.0);
    std::array::from_fn(|axis| within[axis] + (eye[axis] - within[axis]) * (back / away))
}

#[cfg(test)]
mod tests {
    use super::*;

    const BOUNDS: [[f32; 3]; 2] = [[-2.0, -1.5, 0.0], [2.0, 1.5, 8.0]];

    /// How far the eye is from the centre over how far the geometry is, along an axis.
    fn ratio(eye: [f32; 3]) -> f32 {
        let centre = centre_within(eye, BOUNDS);
        let most = |of: &dyn Fn(usize) -> f32| (0..3).map(of).fold(0.0_f32, f32::max);
        let reach = |axis: usize| (BOUNDS[1][axis] - centre[axis]).max(centre[axis] - BOUNDS[0][axis]);
        most(&|axis| (eye[axis] - centre[axis]).abs()) / most(&reach)
    }

    #[test]
    fn an_eye_within_the_bounds_is_the_centre() {
        for eye in [[0.0, 0.0, 1.0], [2.0, 1.0, 8.0], [-1.9, 0.0, 0.1]] {
            assert_eq!(centre_within(eye, BOUNDS), eye);
        }
    }

    #[test]
    fn an_eye_outside_moves_into_the_inner_half() {
        assert_eq!(centre_within([0.5, 0.25, 12.0], BOUNDS), [0.5, 0.25, 8.0 - 8.0 * MARGIN]);
        assert_eq!(centre_within([3.0, -7.0, 4.0], BOUNDS), [2.0 - 4.0 * MARGIN, -1.5 + 3.0 * MARGIN, 4.0]);
    }

    #[test]
    fn rays_from_the_eye_are_never_too_far_from_the_centre() {
        for distance in [3.0, 10.0, 28.0, 40.0, 1.0e3, 1.0e6, 1.0e12] {
            for direction in [[1.0, 0.0, 0.0], [0.0, -1.0, 0.0], [0.3, 0.2, 1.0], [-1.0, 1.0, -1.0]] {
                let eye = direction.map(|x: f32| x * distance + 0.5);
                assert!(ratio(eye) < 3.6, "{eye:?}: {}", ratio(eye));
            }
        }
        // No farther from the geometry than that asks for.
        assert!(ratio([0.0, 0.0, 1.0e3]) > 3.4);
    }

    /// For bounds without an inside, empty or not finite, the centre is the eye.
    #[test]
    fn odd_bounds_leave_the_eye() {
        for bounds in [
            [[0.0; 3]; 2],
            [[4.0, 0.0, 0.0], [4.0, 2.5, 3.5]],
            [[-10.0, -10.0, 0.0], [10.0, 10.0, 2.0]],
            [[f32::MAX; 3], [f32::MIN; 3]],
            [[-3.0e38; 3], [3.0e38; 3]],
            [[f32::NAN; 3]; 2],
        ] {
            for eye in [[1.0, 2.0, 30.0], [-5.0, 0.0, 3.0]] {
                assert_eq!(centre_within(eye, bounds), eye, "{bounds:?}");
            }
        }
    }
}
