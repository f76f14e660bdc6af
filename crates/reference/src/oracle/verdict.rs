/// Hit or miss of a ray, in exact arithmetic.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Outcome {
    /// The nearest hit.
    Hit {
        /// Running index of the triangle.
        primitive: u32,
        /// Ray parameter in units of the direction's length; relative error below 2^-38.
        t: f64,
        /// Barycentric weights of vertices 1 and 2.
        barycentrics: [f64; 2],
    },
    /// No hit in range.
    Miss,
}

impl Outcome {
    /// Returns the triangle and t of a hit.
    pub fn hit(&self) -> Option<(u32, f64)> {
        match *self {
            Self::Hit { primitive, t, .. } => Some((primitive, t)),
            Self::Miss => None,
        }
    }
}

/// Triangle that a careful single-precision test may report for an ambiguous ray.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Candidate {
    /// Running index of the triangle.
    pub primitive: u32,
    /// Least t that may be reported.
    pub t_low: f64,
    /// Greatest t that may be reported.
    pub t_high: f64,
    /// True if the test must find this triangle, unless another one lies in front.
    pub certain: bool,
}

/// Answer for one ray.
#[derive(Clone, Debug, PartialEq)]
pub struct Verdict {
    /// Hit or miss in exact arithmetic.
    pub outcome: Outcome,
    /// Interval of the t that a careful single-precision test may report for the triangle of the outcome;
    /// empty (`[inf, -inf]`) for a miss.
    pub t_range: [f64; 2],
    /// True if single precision may give another answer: the ray passes within rounding of an edge that
    /// matters, two hits are within rounding of each other, or a hit is within rounding of the end of the
    /// range.
    pub ambiguous: bool,
    /// True if a miss is admissible. For ambiguous rays it is false if some hit is certain, or if the
    /// candidates share edges all around the ray, so that a watertight test finds one.
    pub miss_allowed: bool,
    /// Admissible triangles by ascending id, for ambiguous rays only.
    pub candidates: Vec<Candidate>,
}

/// Empty interval, which holds no t.
pub(super) const NO_RANGE: [f64; 2] = [f64::INFINITY, f64::NEG_INFINITY];

impl Verdict {
    pub(super) fn miss() -> Self {
        Self {
            outcome: Outcome::Miss,
            t_range: NO_RANGE,
            ambiguous: false,
            miss_allowed: true,
            candidates: Vec::new(),
        }
    }
}

impl rasray_metrics::Truth for Verdict {
    fn hit(&self) -> Option<(u32, f64)> {
        self.outcome.hit()
    }

    fn is_ambiguous(&self) -> bool {
        self.ambiguous
    }

    fn admits_miss(&self) -> bool {
        self.miss_allowed
    }

    fn admits_hit(&self, primitive: Option<u32>, t: f64) -> bool {
        let admits =
            |id: u32, low: f64, high: f64| primitive.is_none_or(|p| p == id) && low <= t && t <= high;
        if self.ambiguous {
            return self.candidates.iter().any(|c| admits(c.primitive, c.t_low, c.t_high));
        }
        self.hit().is_some_and(|(primitive, _)| admits(primitive, self.t_range[0], self.t_range[1]))
    }
}

/// Answer of an occlusion test.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Occlusion {
    /// True if anything is hit, in exact arithmetic.
    pub occluded: bool,
    /// True if single precision may give the other answer.
    pub ambiguous: bool,
}
