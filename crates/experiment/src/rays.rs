//! Ray sets of a comparison, whose numbers do not depend on the device.

use glam::{DVec3, Vec2, Vec3};
use rasray_ads::{PRIMITIVE_NONE, RAY_CULL_BACK_FACES, Ray};
use rasray_gpu_scene::GpuScene;
use rasray_reference::oracle::{Oracle, Outcome};
use rasray_reference::shading::random::RandomStream;
use rasray_reference::shading::{self, View, camera_ray, cosine_hemisphere, spawn_ray, through_lens};

use crate::jobs::RaySet;

/// Inputs from which rays are made.
pub struct RaySource<'a> {
    /// Camera, size of its image in pixels, and seed.
    pub view: &'a View,
    /// Frame origin in the world, metres; rays are relative to it.
    pub frame_origin: DVec3,
    /// Bounds of the geometry relative to the frame origin, metres.
    pub bounds: [[f32; 3]; 2],
    /// The views' centre relative to the frame origin, metres.
    pub center: [f32; 3],
    /// Oracle of the triangles.
    pub oracle: &'a Oracle<'a>,
    /// Vertices relative to the frame origin, metres.
    pub positions: &'a [[f32; 3]],
    /// Indices of vertices, three per triangle.
    pub indices: &'a [u32],
    /// Flags of the rays, which tell the surfaces that they pass.
    pub flags: RayFlags,
}

/// Flags `RAY_*` of the rays of a picture.
#[derive(Clone, Copy, Debug, Default)]
pub struct RayFlags {
    /// Flags of camera rays.
    pub camera: u32,
    /// Flags of all other rays.
    pub others: u32,
}

impl RayFlags {
    /// Returns the flags that a scene on the device gives its own rays.
    pub fn of(scene: &GpuScene) -> Self {
        let frame = scene.frame();
        Self { camera: frame.camera_ray_flags, others: frame.spawned_ray_flags }
    }
}

impl RaySource<'_> {
    /// Makes `count` rays of a set; fewer only if the camera sees too little to bounce off.
    pub fn rays(&self, set: RaySet, count: u32) -> Vec<Ray> {
        let rays = match set {
            RaySet::Incoherent => incoherent_rays(self.bounds, self.view.seed, count),
            RaySet::Eye => (0..count).map(|i| Ray::new(self.center, direction(self.stream(i)))).collect(),
            RaySet::Camera => return (0..count).map(|i| from_shading(&self.camera(i))).collect(),
            RaySet::Bounce => self.bounce(count, diffuse),
            RaySet::Specular => self.bounce(count, mirrored),
            RaySet::Glossy => self.bounce(count, glossy),
            RaySet::Surface => self.surface(count),
            RaySet::Pixel => self.pixels(count),
        };
        rays.into_iter().map(|ray| Ray { flags: self.flags.others, ..ray }).collect()
    }

    /// Makes rays that start on triangles and exclude none, like tools that know no ids: origins uniform over
    /// the area and rounded to f32, directions uniform on the sphere, t_min 0.
    fn surface(&self, count: u32) -> Vec<Ray> {
        let triangles = self.indices.as_chunks::<3>().0;
        let corners =
            |triangle: &[u32; 3]| triangle.map(|id| DVec3::from(Vec3::from(self.positions[id as usize])));
        let mut total = 0.0;
        let areas: Vec<f64> = triangles
            .iter()
            .map(|triangle| {
                let [a, b, c] = corners(triangle);
                total += (b - a).cross(c - a).length();
                total
            })
            .collect();
        if total <= 0.0 {
            return Vec::new();
        }
        let ray = |index| {
            let stream = self.stream(index);
            let share = f64::from(stream.float(16)) * total;
            let triangle = &triangles[areas.partition_point(|area| *area <= share).min(triangles.len() - 1)];
            let [mut u, mut v] = [17, 22].map(|dimension| f64::from(stream.float(dimension)));
            if u + v > 1.0 {
                (u, v) = (1.0 - u, 1.0 - v);
            }
            let [a, b, c] = corners(triangle);
            Ray::new((a * (1.0 - u - v) + b * u + c * v).as_vec3().to_array(), direction(stream))
        };
        (0..count).map(ray).collect()
    }

    fn stream(&self, index: u32) -> RandomStream {
        RandomStream { seed: self.view.seed, pixel: index, sample: 0 }
    }

    /// Makes a ray through random points of the image and of the lens.
    fn camera(&self, index: u32) -> shading::Ray {
        let stream = self.stream(index);
        let place =
            Vec2::new(stream.float(20) * self.view.width as f32, stream.float(21) * self.view.height as f32);
        let culls_back_faces = self.flags.camera & RAY_CULL_BACK_FACES != 0;
        let ray = camera_ray(self.view, self.frame_origin, place);
        let ray = through_lens(&self.view.camera, ray, Vec2::new(stream.float(23), stream.float(24)));
        shading::Ray { culls_back_faces, ..ray }
    }

    /// Makes segments of lines in uniform directions through points that are uniform between the bounds along
    /// camera rays, cut where they leave the pixel or the bounds: the queries that a ray makes of a cell of
    /// the camera's view.
    fn pixels(&self, count: u32) -> Vec<Ray> {
        let eye = self.view.camera.world_from_camera.translation - self.frame_origin;
        let to_centre = Vec3::from(self.center).as_dvec3() - eye;
        let walls = self.box_sides();
        let ray = |index| {
            let stream = self.stream(index);
            let [x, y] = [(20, self.view.width), (21, self.view.height)]
                .map(|(dimension, size)| (stream.float(dimension) * size as f32).min(size as f32 - 1.0));
            let through = |place| {
                let ray = camera_ray(self.view, self.frame_origin, place);
                Line { origin: ray.origin.as_dvec3() + to_centre, direction: ray.direction.as_dvec3() }
            };
            let corner = |[u, v]: [f32; 2]| through(Vec2::new(x.floor() + u, y.floor() + v));
            let corners = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]].map(corner);
            let middle = through(Vec2::new(x, y));
            let [near, far] = middle.inside(&walls, [0.0, f64::INFINITY])?;
            let point = middle.at(near + (far - near) * f64::from(stream.float(22)));
            let line = Line { origin: point, direction: Vec3::from(direction(stream)).as_dvec3() };
            let sides: Vec<_> = (0..4)
                .map(|side| {
                    let [one, next] = [corners[side], corners[(side + 1) % 4]];
                    let normal = one.direction.cross(next.at(1.0) - one.origin);
                    let outwards = if normal.dot(corners[(side + 2) % 4].at(1.0) - one.origin) > 0.0 {
                        -normal
                    } else {
                        normal
                    };
                    Side { normal: outwards, reach: outwards.dot(one.origin) }
                })
                .chain(walls)
                .collect();
            let [first, last] = line.inside(&sides, [f64::NEG_INFINITY, f64::INFINITY])?;
            let ray = Ray::new(line.at(first).as_vec3().to_array(), line.direction.as_vec3().to_array());
            Some(Ray { t_max: (last - first) as f32, ..ray })
        };
        // The number of tries is limited for a camera that looks past the bounds.
        (0..count.saturating_mul(8)).filter_map(ray).take(count as usize).collect()
    }

    fn box_sides(&self) -> [Side; 6] {
        std::array::from_fn(|side| {
            let mut normal = DVec3::ZERO;
            normal[side % 3] = if side < 3 { -1.0 } else { 1.0 };
            Side { normal, reach: normal.dot(Vec3::from(self.bounds[side / 3]).as_dvec3()) }
        })
    }

    /// Makes rays in directions of a lobe from the exact hits of camera rays.
    fn bounce(&self, count: u32, lobe: Lobe) -> Vec<Ray> {
        let mut rays = Vec::with_capacity(count as usize);
        // The number of tries is limited for a camera that sees nothing.
        for index in 0..count.saturating_mul(8) {
            if rays.len() == count as usize {
                break;
            }
            let ray = self.camera(index);
            let Outcome::Hit { primitive, barycentrics, .. } = self.oracle.closest(&ray.to_oracle()).outcome
            else {
                continue;
            };
            let corner =
                |k: usize| Vec3::from(self.positions[self.indices[3 * primitive as usize + k] as usize]);
            let (a, b, c) = (corner(0), corner(1), corner(2));
            let [u, v] = barycentrics.map(|weight| weight as f32);
            let weights = Vec3::new(1.0 - u - v, u, v);
            let normal = (b - a).cross(c - a).normalize_or_zero();
            if normal == Vec3::ZERO {
                continue;
            }
            let normal = if normal.dot(ray.direction) > 0.0 { -normal } else { normal };
            let size = (a.abs() * weights.x + b.abs() * weights.y + c.abs() * weights.z).max_element();
            let surface = shading::Surface {
                position: a * weights.x + b * weights.y + c * weights.z,
                position_error: 4.2e-7 * size,
                geometric_normal: normal,
                primitive: Some(primitive),
                ..shading::Surface::default()
            };
            let stream = self.stream(index);
            let numbers = Vec2::new(stream.float(24), stream.float(25));
            let direction = lobe(ray.direction, normal, numbers);
            rays.push(from_shading(&spawn_ray(&surface, direction, f32::INFINITY)));
        }
        rays
    }
}

/// Line of the points `origin + t direction`.
#[derive(Clone, Copy)]
struct Line {
    origin: DVec3,
    direction: DVec3,
}

/// Half space of the points with `normal . point <= reach`.
#[derive(Clone, Copy)]
struct Side {
    normal: DVec3,
    reach: f64,
}

impl Line {
    fn at(&self, t: f64) -> DVec3 {
        self.origin + self.direction * t
    }

    /// Returns the t of an interval at which the line is within all half spaces; `None` if there are none.
    fn inside(&self, sides: &[Side], [mut first, mut last]: [f64; 2]) -> Option<[f64; 2]> {
        for side in sides {
            let (slope, gap) = (side.normal.dot(self.direction), side.reach - side.normal.dot(self.origin));
            match gap / slope {
                t if slope > 0.0 => last = last.min(t),
                t if slope < 0.0 => first = first.max(t),
                _ if gap < 0.0 => return None,
                _ => {}
            }
        }
        (first < last && first.is_finite() && last.is_finite()).then_some([first, last])
    }
}

/// Lobe: a function from the direction of a ray, the unit normal that faces it and two numbers in [0, 1) to a
/// unit direction above the surface.
type Lobe = fn(Vec3, Vec3, Vec2) -> Vec3;

/// Returns a cosine-weighted direction.
fn diffuse(_: Vec3, normal: Vec3, numbers: Vec2) -> Vec3 {
    shading::basis_around(normal) * cosine_hemisphere(numbers)
}

/// Returns the direction of a plane mirror.
fn mirrored(direction: Vec3, normal: Vec3, _: Vec2) -> Vec3 {
    (direction - 2.0 * direction.dot(normal) * normal).normalize()
}

/// Exponent of [`glossy`]: half of its directions lie within 6.7 degrees of the mirrored one.
const GLOSS: f32 = 100.0;

/// Returns a direction around the mirrored one, with a density proportional to the cosine to the power of
/// [`GLOSS`]; a direction below the surface is mirrored by it.
fn glossy(direction: Vec3, normal: Vec3, numbers: Vec2) -> Vec3 {
    let cosine = (1.0 - numbers.x).powf(1.0 / (GLOSS + 1.0));
    let sine = (1.0 - cosine * cosine).max(0.0).sqrt();
    let azimuth = std::f32::consts::TAU * numbers.y;
    let local = Vec3::new(sine * azimuth.cos(), sine * azimuth.sin(), cosine);
    let around = shading::basis_around(mirrored(direction, normal, numbers)) * local;
    let above = if around.dot(normal) < 0.0 { around - 2.0 * around.dot(normal) * normal } else { around };
    above.normalize()
}

/// Makes rays with origins uniform in a box (corners in metres) and directions uniform on the sphere: the set
/// [`RaySet::Incoherent`]. A ray depends only on the seed and its index.
pub fn incoherent_rays([lower, upper]: [[f32; 3]; 2], seed: u32, count: u32) -> Vec<Ray> {
    let ray = |index| {
        let stream = RandomStream { seed, pixel: index, sample: 0 };
        let origin = std::array::from_fn(|axis| {
            lower[axis] + (upper[axis] - lower[axis]) * stream.float(16 + axis as u32)
        });
        Ray::new(origin, direction(stream))
    };
    (0..count).map(ray).collect()
}

/// Returns a direction uniform on the sphere.
fn direction(stream: RandomStream) -> [f32; 3] {
    let z = 1.0 - 2.0 * stream.float(18);
    let azimuth = std::f32::consts::TAU * stream.float(19);
    let ring = (1.0 - z * z).max(0.0).sqrt();
    [ring * azimuth.cos(), ring * azimuth.sin(), z]
}

pub(super) fn from_shading(ray: &shading::Ray) -> Ray {
    Ray {
        origin: ray.origin.to_array(),
        t_min: 0.0,
        direction: ray.direction.to_array(),
        t_max: ray.t_max,
        exclude_primitive: ray.exclude_primitive.unwrap_or(PRIMITIVE_NONE),
        flags: if ray.culls_back_faces { RAY_CULL_BACK_FACES } else { 0 },
        cone_width: 0.0,
        cone_spread: 0.0,
    }
}

/// Converts a ray for the oracle.
pub fn oracle_ray(ray: &Ray) -> rasray_reference::oracle::Ray {
    rasray_reference::oracle::Ray {
        origin: ray.origin,
        t_min: ray.t_min,
        direction: ray.direction,
        t_max: ray.t_max,
        exclude_primitive: (ray.exclude_primitive != PRIMITIVE_NONE).then_some(ray.exclude_primitive),
        culls_back_faces: ray.flags & RAY_CULL_BACK_FACES != 0,
    }
}

/// Returns the corners of all triangles.
pub(super) fn triangles(positions: &[[f32; 3]], indices: &[u32]) -> Vec<[[f32; 3]; 3]> {
    let corner = |index: u32| positions.get(index as usize).copied().unwrap_or_default();
    indices.as_chunks::<3>().0.iter().map(|corners| corners.map(corner)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_abs_diff_eq;

    #[test]
    fn lobes_lie_above_the_surface_around_their_axis() {
        let normal = Vec3::new(0.6, 0.0, 0.8);
        let grazing = Vec3::new(0.8, 0.0, -0.599).normalize();
        for direction in [-normal, Vec3::NEG_Z, grazing] {
            let mirror = mirrored(direction, normal, Vec2::ZERO);
            assert_abs_diff_eq!(mirror.dot(normal), -direction.dot(normal), epsilon = 1.0e-6);
            assert_abs_diff_eq!(mirror.cross(normal).dot(direction), 0.0, epsilon = 1.0e-6);
            let numbers = (0..4096).map(|index| {
                let stream = RandomStream { seed: 1, pixel: index, sample: 0 };
                Vec2::new(stream.float(24), stream.float(25))
            });
            let numbers: Vec<_> = numbers.collect();
            for lobe in [diffuse, glossy] {
                let lobe = |numbers: &Vec2| lobe(direction, normal, *numbers);
                assert!(numbers.iter().map(lobe).all(|one| one.is_normalized() && one.dot(normal) > -1.0e-6));
            }
            let near = numbers.iter().filter(|numbers| {
                glossy(direction, normal, **numbers).dot(mirror) > 6.7_f32.to_radians().cos()
            });
            let share = near.count() as f64 / numbers.len() as f64;
            // Directions below the surface are mirrored, which brings them nearer.
            assert!(share > 0.47 && (direction == grazing || share < 0.53), "{direction}: {share}");
        }
    }

    #[test]
    fn pieces_of_lines_stay_in_a_pixel_as_the_centre_of_the_views_sees_it() {
        let camera = rasray_scene::Camera {
            name: String::new(),
            world_from_camera: glam::DAffine3::from_rotation_y(0.3)
                * glam::DAffine3::from_translation(DVec3::Z),
            projection: rasray_scene::Projection::Perspective { fov_y: 0.9 },
            aspect_ratio: None,
            lens: None,
        };
        let view =
            View { camera, width: 40, height: 30, samples: 1, seed: 3, sampler: rasray_scene::Sampler::Pcg };
        let positions = [[-1.0, -1.0, -5.0], [1.0, -1.0, -5.0], [0.0, 1.0, -5.0]];
        let oracle = Oracle::new(&positions, &[0, 1, 2], None).expect("a triangle");
        let center = [0.1, 0.2, 0.3];
        let source = RaySource {
            view: &view,
            frame_origin: DVec3::ZERO,
            bounds: [[-2.0, -2.0, -5.0], [2.0, 2.0, 1.0]],
            center,
            oracle: &oracle,
            positions: &positions,
            indices: &[0, 1, 2],
            flags: RayFlags::default(),
        };
        let rays = source.rays(RaySet::Pixel, 500);
        assert_eq!(rays.len(), 500);
        let camera_from_world = view.camera.world_from_camera.inverse();
        let half = view.camera.half_extents(40, 30);
        let pixel = |point: DVec3| {
            let seen = camera_from_world.transform_vector3(point - Vec3::from(center).as_dvec3());
            let [x, y] = [seen.x / -seen.z / half[0], -seen.y / -seen.z / half[1]];
            [20.0 * (x + 1.0), 15.0 * (y + 1.0)]
        };
        let mut longest = 0.0_f64;
        for ray in rays {
            let [origin, direction] = [ray.origin, ray.direction].map(|one| Vec3::from(one).as_dvec3());
            let t = f64::from(ray.t_max);
            let own = pixel(origin + direction * (0.5 * t)).map(f64::floor);
            for end in [origin, origin + direction * t] {
                for (place, own) in pixel(end).into_iter().zip(own) {
                    assert!((own - 1.0e-2..own + 1.01).contains(&place), "{place} of {own}");
                }
                assert!(
                    end.cmpge(DVec3::new(-2.0, -2.0, -5.0) - 1.0e-5).all()
                        && end.cmple(DVec3::new(2.0, 2.0, 1.0) + 1.0e-5).all()
                );
            }
            longest = longest.max(t);
        }
        assert!(longest > 1.0, "{longest}");
    }
}
