/// Ray as the device gets it. Points on it are `origin + t * direction`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ray {
    /// Origin, metres.
    pub origin: [f32; 3],
    /// Lower end of the range: hits count for `t > t_min`.
    pub t_min: f32,
    /// Direction; it need not be unit, but must be finite and not zero.
    pub direction: [f32; 3],
    /// Upper end of the range: hits count for `t < t_max`, in units of the direction's length; may be
    /// infinite.
    pub t_max: f32,
    /// Id of a triangle that is never hit.
    pub exclude_primitive: Option<u32>,
    /// True if backs are no hits, on triangles that have one
    /// ([`Oracle::with_backs`](super::Oracle::with_backs)).
    pub culls_back_faces: bool,
}

impl Ray {
    /// Makes a ray that counts hits from its origin to infinity.
    pub fn new(origin: [f32; 3], direction: [f32; 3]) -> Self {
        Self {
            origin,
            t_min: 0.0,
            direction,
            t_max: f32::INFINITY,
            exclude_primitive: None,
            culls_back_faces: false,
        }
    }

    /// Makes a ray through `point` at t = 1, up to the rounding of `point - origin`.
    pub fn towards(origin: [f32; 3], point: [f32; 3]) -> Self {
        Self::new(origin, std::array::from_fn(|axis| point[axis] - origin[axis]))
    }

    /// True if origin and direction are finite, the direction is not zero, and no end is NaN. (An empty range
    /// is valid and hits nothing.)
    pub fn is_valid(&self) -> bool {
        self.origin.iter().chain(&self.direction).all(|x| x.is_finite())
            && self.direction.iter().any(|x| *x != 0.0)
            && !self.t_min.is_nan()
            && !self.t_max.is_nan()
    }
}
