//! Motion: the position, one frame before, of the point that a pixel shows.

use glam::{DVec2, DVec3};
use rasray_integrators::{AovPixel, AovSurface};
use rasray_scene::{Camera, Moment, Projection};

/// Frame before the one that is shown.
#[derive(Clone, Debug)]
pub struct FrameBefore {
    /// Moment of the frame before.
    pub moment: Moment,
    /// Camera of the frame before.
    pub camera: Camera,
}

/// Triangles of the frame before, as the device posed them: metres relative to the frame origin.
pub(crate) struct TrianglesBefore {
    pub positions: Vec<[f32; 3]>,
    pub indices: Vec<u32>,
}

impl TrianglesBefore {
    /// Returns the earlier position of a point of a triangle; `None` if there is no such triangle.
    fn point(&self, triangle: u32, [b, c]: [f32; 2]) -> Option<DVec3> {
        let first = 3 * triangle as usize;
        let corners = self.indices.get(first..first + 3)?;
        let corner = |index: usize| {
            let position = self.positions.get(corners[index] as usize)?;
            Some(DVec3::from_array(position.map(f64::from)))
        };
        let (b, c) = (f64::from(b), f64::from(c));
        Some(corner(0)? * (1.0 - b - c) + corner(1)? * b + corner(2)? * c)
    }
}

/// Camera with the size of its image.
struct Screen<'a> {
    camera: &'a Camera,
    /// Size of the image, pixels.
    size: DVec2,
    half: DVec2,
}

impl<'a> Screen<'a> {
    fn new(camera: &'a Camera, [width, height]: [u32; 2]) -> Self {
        let half = DVec2::from_array(camera.half_extents(width, height));
        Self { camera, size: DVec2::new(width.into(), height.into()), half }
    }

    fn axes(&self) -> [DVec3; 3] {
        let axes = self.camera.world_from_camera.matrix3;
        [axes.x_axis, axes.y_axis, axes.z_axis].map(DVec3::normalize_or_zero)
    }

    /// Returns the place in the image of a direction, pixels from the lower left; `None` if the direction is
    /// beside or behind the eye.
    fn of_direction(&self, direction: DVec3) -> Option<DVec2> {
        let [right, up, back] = self.axes();
        let depth = match self.camera.projection {
            Projection::Perspective { .. } => -direction.dot(back),
            Projection::Orthographic { .. } => 1.0,
        };
        let across = DVec2::new(direction.dot(right), direction.dot(up)) / (depth * self.half);
        (depth > 0.0).then(|| 0.5 * (across + 1.0) * self.size)
    }

    /// Returns the place in the image of a point of the world, pixels from the lower left; `None` if the
    /// point is beside or behind the eye.
    fn of_point(&self, point: DVec3) -> Option<DVec2> {
        self.of_direction(point - self.camera.world_from_camera.translation)
    }

    /// Returns the direction from which a perspective receives light at a place, pixels from the lower left.
    fn direction(&self, place: DVec2) -> DVec3 {
        let [right, up, back] = self.axes();
        let across = (2.0 * place / self.size - 1.0) * self.half;
        right * across.x + up * across.y - back
    }
}

/// Computes the motion of a run of pixels that begins at pixel `first` of the image, from each pixel to the
/// earlier place of its point: pixels to the right and upwards. Points at infinity move with the camera
/// alone. The motion is 0 if the point was beside or behind the eye, or if its triangle is not known.
pub(crate) fn motion(
    (before, camera): (&FrameBefore, &Camera),
    triangles: &TrianglesBefore,
    frame_origin: DVec3,
    size: [u32; 2],
    (first, pixels, surfaces): (usize, &[AovPixel], &[AovSurface]),
) -> impl Iterator<Item = [f32; 2]> {
    let [width, height] = size.map(|side| side as usize);
    let (now, then) = (Screen::new(camera, size), Screen::new(&before.camera, size));
    let is_perspective = matches!(camera.projection, Projection::Perspective { .. });
    let of_pixel = move |(place, (pixel, surface)): (usize, (&AovPixel, &AovSurface))| {
        let (column, row) = (place % width, place / width);
        let centre = DVec2::new(column as f64 + 0.5, height as f64 - row as f64 - 0.5);
        let was = match pixel.distance > 0.0 {
            true => then.of_point(triangles.point(pixel.primitive, surface.weights)? + frame_origin),
            false if is_perspective => then.of_direction(now.direction(centre)),
            false => None,
        };
        Some((was? - centre).as_vec2().to_array())
    };
    (first..).zip(pixels.iter().zip(surfaces)).map(move |pixel| of_pixel(pixel).unwrap_or_default())
}

#[cfg(test)]
mod tests {
    use super::*;
    use rasray_scene::default_view::camera_looking_at;

    /// Makes a camera that looks along -z from the origin over a width and a height of two at a distance of
    /// one.
    fn camera(eye: DVec3) -> Camera {
        camera_looking_at("test", eye, eye - DVec3::Z, std::f32::consts::FRAC_PI_2)
    }

    fn of_triangle(before: Camera, moved: [f32; 3], pixel: AovPixel) -> Vec<[f32; 2]> {
        let corners = [[-9.0, -9.0, -2.0], [9.0, -9.0, -2.0], [-9.0, 9.0, -2.0_f32]];
        let positions = corners.map(|corner| [0, 1, 2].map(|axis| corner[axis] + moved[axis]));
        let triangles = TrianglesBefore { positions: positions.to_vec(), indices: vec![0, 1, 2] };
        // The first pixel of two by two shows the point (-1, 1, -2).
        let weights = [8.0 / 18.0, 10.0 / 18.0];
        let surfaces = [AovSurface { weights, ..AovSurface::default() }; 4];
        let before = FrameBefore { moment: Moment { seconds: 0.0, clips: Vec::new() }, camera: before };
        let now = camera(DVec3::ZERO);
        let moved = |first, count| {
            let band = (first, &[pixel; 4][..count], &surfaces[..count]);
            motion((&before, &now), &triangles, DVec3::ZERO, [2, 2], band).collect::<Vec<_>>()
        };
        // The result does not depend on the bands of pixels.
        let whole = moved(0, 4);
        assert_eq!(whole, [moved(0, 1), moved(1, 3)].concat());
        whole
    }

    #[test]
    fn points_lead_to_where_they_were_and_the_sky_moves_with_the_camera_alone() {
        let hit = AovPixel { distance: 2.0, primitive: 0, ..AovPixel::default() };
        let sky = AovPixel { distance: 0.0, primitive: u32::MAX, ..AovPixel::default() };
        let leads = |eye: [f64; 3], moved, pixel, expected: [f32; 2]| {
            let found = of_triangle(camera(DVec3::from_array(eye)), moved, pixel)[0];
            let far = (found[0] - expected[0]).abs().max((found[1] - expected[1]).abs());
            assert!(far < 1.0e-6, "{found:?} in place of {expected:?}");
        };
        leads([0.0; 3], [0.0; 3], hit, [0.0; 2]);
        // A pixel is two metres wide at this distance.
        leads([0.0; 3], [1.0, 0.5, 0.0], hit, [0.5, 0.25]);
        leads([2.0, 0.0, 0.0], [0.0; 3], hit, [-1.0, 0.0]);
        leads([2.0, 0.0, 0.0], [0.0; 3], sky, [0.0; 2]);
        // The first point is behind the eye, the second on a triangle that does not exist.
        leads([0.0, 0.0, -9.0], [0.0; 3], hit, [0.0; 2]);
        leads([2.0, 0.0, 0.0], [0.0; 3], AovPixel { primitive: 7, ..hit }, [0.0; 2]);
        let turned = camera_looking_at("test", DVec3::ZERO, DVec3::new(-1.0, 0.0, -1.0), 1.57);
        let sideways = of_triangle(turned, [0.0; 3], sky);
        assert!(sideways[0][0] > 0.4, "what is seen now was farther to the right: {sideways:?}");
    }
}
