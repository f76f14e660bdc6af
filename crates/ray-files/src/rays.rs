//! Rays as a file holds them, and as the device traces them.

use super::error::FormatError;
use super::npy::{self, Array, Kind};
use rasray_ads::Ray;

/// Rays of a file.
#[derive(Clone, Debug, PartialEq)]
pub struct RaysFile {
    /// Rays; [`RaysFile::place`] says what their origins are relative to.
    pub rays: Vec<Ray>,
    /// Point to which the origins are relative.
    pub place: Place,
}

/// Reference of the origins.
#[derive(Clone, Debug, PartialEq)]
pub enum Place {
    /// Point of the world, metres; [`Ray::origin`] holds the offset from it.
    Point([f64; 3]),
    /// World coordinates: one origin per ray, metres, which [`Ray::origin`] holds rounded.
    World(Vec<[f64; 3]>),
}

impl RaysFile {
    /// Returns the rays relative to a frame origin (world, metres). If that is the point they are stored for,
    /// they are equal bit for bit; otherwise origins are shifted in f64 and rounded once.
    pub fn relative_to(&self, frame_origin: [f64; 3]) -> Vec<Ray> {
        let shifted = |ray: &Ray, world: [f64; 3]| Ray {
            origin: std::array::from_fn(|axis| (world[axis] - frame_origin[axis]) as f32),
            ..*ray
        };
        match &self.place {
            Place::Point(point) if *point == frame_origin => self.rays.clone(),
            Place::Point(point) => self
                .rays
                .iter()
                .map(|ray| {
                    shifted(ray, std::array::from_fn(|axis| point[axis] + f64::from(ray.origin[axis])))
                })
                .collect(),
            Place::World(origins) => {
                self.rays.iter().zip(origins).map(|(ray, origin)| shifted(ray, *origin)).collect()
            }
        }
    }
}

/// Checks that a ray can be traced.
pub(super) fn check(index: usize, ray: &Ray) -> Result<(), FormatError> {
    let wrong = |what| Err(FormatError::Entry { index, what });
    if !ray.origin.iter().all(|x| x.is_finite()) {
        return wrong("its origin is not finite");
    }
    if !ray.direction.iter().all(|x| x.is_finite()) {
        return wrong("its direction is not finite");
    }
    if ray.direction.iter().all(|x| *x == 0.0) {
        return wrong("its direction is zero");
    }
    if ray.t_min.is_nan() || ray.t_max.is_nan() {
        return wrong("t_min or t_max is NaN");
    }
    Ok(())
}

/// Reads an array of N x 6, 7 or 8 numbers: origin in the world (metres), direction, t_min (0 if absent) and
/// t_max (infinite if absent).
///
/// # Errors
/// An error if the bytes are no such array, or a ray cannot be traced.
pub fn rays_from_npy(bytes: &[u8]) -> Result<RaysFile, FormatError> {
    const WANTED: &str = "N x 6, 7 or 8 numbers of float32 or float64 (origin, direction, t_min, t_max)";
    let array = npy::read(bytes)?;
    let columns = match (array.shape.as_slice(), array.single_kind()) {
        ([_, columns @ 6..=8], Some(Kind::F4 | Kind::F8)) => *columns,
        _ => return Err(FormatError::Content { what: array.describe(), wanted: WANTED }),
    };
    let kind = array.single_kind();
    let mut rays = Vec::with_capacity(array.shape[0]);
    let mut origins = Vec::new();
    for index in 0..array.shape[0] {
        let at = |column: usize| array.number(index * columns + column, 0);
        let vector = |first: usize| -> [f64; 3] { std::array::from_fn(|axis| at(first + axis)) };
        let end =
            |column: usize, otherwise: f32| if column < columns { at(column) as f32 } else { otherwise };
        let ray = Ray {
            t_min: end(6, 0.0),
            t_max: end(7, f32::INFINITY),
            ..Ray::new(vector(0).map(|x| x as f32), vector(3).map(|x| x as f32))
        };
        check(index, &ray)?;
        rays.push(ray);
        if kind == Some(Kind::F8) {
            origins.push(vector(0));
        }
    }
    let place = if kind == Some(Kind::F8) { Place::World(origins) } else { Place::Point([0.0; 3]) };
    Ok(RaysFile { rays, place })
}

/// Writes rays as an array of N x 8 numbers in the world: float32 where the frame origin is the world's,
/// which keeps every bit, else float64. The array holds neither a ray's exclusion nor its flag of passing
/// backs.
pub fn rays_to_npy(rays: &[Ray], frame_origin: [f64; 3]) -> Vec<u8> {
    let rows = rays.iter().flat_map(|ray| {
        let world: [f64; 3] = std::array::from_fn(|axis| frame_origin[axis] + f64::from(ray.origin[axis]));
        let [x, y, z] = ray.direction.map(f64::from);
        [world[0], world[1], world[2], x, y, z, ray.t_min.into(), ray.t_max.into()]
    });
    numbers_to_npy(rows, &[rays.len(), 8], frame_origin, || {
        rays.iter()
            .flat_map(|ray| {
                let ([a, b, c], [x, y, z]) = (ray.origin, ray.direction);
                [a, b, c, x, y, z, ray.t_min, ray.t_max]
            })
            .collect()
    })
}

/// Writes the corners of triangles as an array of N x 3 x 3 numbers in the world, by global triangle id.
pub fn triangles_to_npy(triangles: &[[[f32; 3]; 3]], frame_origin: [f64; 3]) -> Vec<u8> {
    let world = |corner: &[f32; 3]| -> [f64; 3] {
        std::array::from_fn(|axis| frame_origin[axis] + f64::from(corner[axis]))
    };
    let corners = triangles.as_flattened();
    numbers_to_npy(corners.iter().flat_map(world), &[triangles.len(), 3, 3], frame_origin, || {
        corners.as_flattened().to_vec()
    })
}

/// Writes float32 if the frame origin is the world's, from `exact`, else float64.
fn numbers_to_npy(
    world: impl Iterator<Item = f64>,
    shape: &[usize],
    frame_origin: [f64; 3],
    exact: impl Fn() -> Vec<f32>,
) -> Vec<u8> {
    if frame_origin == [0.0; 3] {
        let bytes = exact().into_iter().flat_map(f32::to_le_bytes).collect();
        Array::plain(Kind::F4, shape, bytes).to_bytes()
    } else {
        Array::plain(Kind::F8, shape, world.flat_map(f64::to_le_bytes).collect()).to_bytes()
    }
}

/// Writes one word for each ray or triangle, such as an id or flags, as an array of uint32.
pub fn words_to_npy(words: &[u32]) -> Vec<u8> {
    let bytes = words.iter().flat_map(|word| word.to_le_bytes()).collect();
    Array::plain(Kind::U4, &[words.len()], bytes).to_bytes()
}
