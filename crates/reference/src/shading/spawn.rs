//! Rays that leave a surface, with origins from which rounding does not make them hit it again.

use glam::Vec3;

use super::{Ray, Surface};

/// Returns the float next to x in the direction of `offset`. Tiny x stay, so that no subnormal is made.
fn outward(x: f32, offset: f32) -> f32 {
    if offset == 0.0 || x.abs() < 1.0e-30 {
        x
    } else if offset > 0.0 {
        x.next_up()
    } else {
        x.next_down()
    }
}

/// Returns `position` moved along the normal, to the side `direction` points to, beyond its error.
pub(super) fn spawn_position(position: Vec3, position_error: f32, normal: Vec3, direction: Vec3) -> Vec3 {
    let absolute = normal.abs();
    let distance = position_error * (absolute.x + absolute.y + absolute.z);
    let offset = normal * if normal.dot(direction) < 0.0 { -distance } else { distance };
    let moved = position + offset;
    Vec3::new(outward(moved.x, offset.x), outward(moved.y, offset.y), outward(moved.z, offset.z))
}

/// Makes a ray from the surface along the unit `direction`, `t_max` in metres, with an empty cone, that
/// passes no backs.
pub fn spawn_ray(surface: &Surface, direction: Vec3, t_max: f32) -> Ray {
    Ray {
        origin: spawn_position(surface.position, surface.position_error, surface.geometric_normal, direction),
        direction,
        t_max,
        exclude_primitive: surface.primitive,
        culls_back_faces: false,
        cone_width: 0.0,
        cone_spread: 0.0,
    }
}

/// Makes the open segment to `target`, which has been moved off its own surface. `None` if it is empty.
pub fn spawn_segment(surface: &Surface, target: Vec3) -> Option<Ray> {
    let mut ray = spawn_ray(surface, target - surface.position, 0.0);
    let towards = target - ray.origin;
    let distance = towards.length();
    if !(distance > 0.0) {
        return None;
    }
    ray.direction = towards / distance;
    ray.t_max = distance * (1.0 - 1.0 / 1_048_576.0);
    Some(ray)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn origins_move_by_the_error_to_the_side_of_the_direction() {
        let normal = Vec3::new(0.6, -0.8, 0.0);
        let position = Vec3::new(100.0, -3.0, 0.0);
        for sign in [1.0, -1.0] {
            let moved = spawn_position(position, 1.0e-4, normal, normal * sign);
            let along = (moved - position).dot(normal) * sign;
            assert!((1.39e-4..1.6e-4).contains(&along), "{along}");
            assert_eq!(moved.z, 0.0, "an axis without offset stays");
        }
    }

    #[test]
    fn the_smallest_offset_is_one_float() {
        let position = Vec3::splat(1.0);
        let moved = spawn_position(position, 1.0e-12, Vec3::new(0.6, -0.8, 0.0), Vec3::X);
        assert_eq!(moved, Vec3::new(1.0_f32.next_up(), 1.0_f32.next_down(), 1.0));
    }
}
