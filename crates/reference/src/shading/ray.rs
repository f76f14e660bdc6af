//! Rays.

use glam::Vec3;

use crate::oracle;

/// Ray with the cone over which textures are filtered.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ray {
    /// Origin, metres relative to the frame origin.
    pub origin: Vec3,
    /// Unit direction.
    pub direction: Vec3,
    /// Upper end of the range, metres; may be infinite.
    pub t_max: f32,
    /// Id of a triangle that is never hit.
    pub exclude_primitive: Option<u32>,
    /// True if backs of single-sided surfaces are no hits.
    pub culls_back_faces: bool,
    /// Width of the cone at the origin, metres.
    pub cone_width: f32,
    /// Growth of the cone's width per metre, radians.
    pub cone_spread: f32,
}

impl Ray {
    /// Converts the ray for the oracle.
    pub fn to_oracle(self) -> oracle::Ray {
        oracle::Ray {
            origin: self.origin.to_array(),
            t_min: 0.0,
            direction: self.direction.to_array(),
            t_max: self.t_max,
            exclude_primitive: self.exclude_primitive,
            culls_back_faces: self.culls_back_faces,
        }
    }
}
