//! Protocol of the oracle's work on one ray, in words.

use std::fmt;

use super::contact::{Contact, ContactTest};
use super::exact::{self, Point};
use super::{Oracle, Outcome, Ray, Verdict};

/// Relation of a triangle to a ray.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TestClass {
    /// A hit that every careful single-precision test finds.
    Certain,
    /// A hit in exact arithmetic that single precision may miss.
    Uncertain,
    /// No hit in exact arithmetic; single precision may report one.
    Possible,
    /// The ray passes through the triangle outside of its own range.
    OutOfRange,
    /// The ray lies in the triangle's plane: no hit, though single precision may report one.
    InPlane,
    /// A triangle behind a certain hit.
    Behind,
    /// A triangle that the ray excludes.
    Excluded,
    /// A point that the alpha test refused.
    Transparent,
    /// A back that the ray passes.
    BackFace,
    /// The ray passes outside of the triangle.
    Outside,
}

/// Triangle that the oracle tested.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TestedTriangle {
    /// Running index of the triangle.
    pub primitive: u32,
    /// Signs of the exact edge determinants, each edge named by the vertex opposite; the ray is inside if no
    /// two signs differ strictly.
    pub signs: [i32; 3],
    /// Relation of the triangle to the ray.
    pub class: TestClass,
    /// Ray parameter t of the plane, and the interval that single precision may report; `None` if the ray
    /// passes outside by more than rounding.
    pub t: Option<[f64; 3]>,
}

/// Node of the hierarchy that the ray entered.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct VisitedNode {
    /// Number of the node, the root being 0.
    pub node: usize,
    /// Lower bound of every t in the node.
    pub t: f64,
    /// Number of triangles of a leaf; 0 for an inner node.
    pub triangles: usize,
}

/// Steps of [`Oracle::closest`] for one ray.
#[derive(Clone, Debug)]
pub struct OracleReplay {
    /// Ray that was traced.
    pub ray: Ray,
    /// Nodes in the order of visits; empty if all triangles are tested one by one.
    pub nodes: Vec<VisitedNode>,
    /// Triangles in the order of tests, without those that the ray passes outside.
    pub tests: Vec<TestedTriangle>,
    /// Number of tested triangles that the ray passes outside by more than rounding.
    pub outside: usize,
    /// Answer of the oracle.
    pub verdict: Verdict,
}

impl Oracle<'_> {
    /// Computes [`Oracle::closest`] of one ray with a protocol of its steps. The signs are computed without a
    /// filter.
    pub fn replay(&self, ray: &Ray) -> OracleReplay {
        let verdict = self.closest(ray);
        let mut replay =
            OracleReplay { ray: *ray, nodes: Vec::new(), tests: Vec::new(), outside: 0, verdict };
        let Some(test) = ContactTest::new(ray) else { return replay };
        let mut cutoff = f64::INFINITY;
        let mut nodes = Vec::new();
        let mut look = |slot: usize, cutoff: &mut f64| {
            let (tested, contact) = self.look_at(ray, &test, slot, *cutoff);
            if tested.class == TestClass::Outside {
                replay.outside += 1;
                return;
            }
            if let (TestClass::Certain, Some(contact)) = (tested.class, contact) {
                *cutoff = cutoff.min(contact.t_high);
            }
            replay.tests.push(tested);
        };
        match &self.bvh {
            Some(bvh) => bvh.visit_nodes(
                &test,
                |node, t, triangles| nodes.push(VisitedNode { node, t, triangles }),
                &mut look,
            ),
            None => (0..self.triangles.len()).for_each(|slot| look(slot, &mut cutoff)),
        }
        replay.nodes = nodes;
        replay
    }

    fn look_at(
        &self,
        ray: &Ray,
        test: &ContactTest,
        slot: usize,
        cutoff: f64,
    ) -> (TestedTriangle, Option<Contact>) {
        let (primitive, triangle) = (self.primitives[slot], &self.triangles[slot]);
        let signs = exact_signs(test, triangle);
        let inside = !(signs.contains(&1) && signs.contains(&-1));
        let contact = test.contact(triangle);
        let met = contact.and_then(|contact| self.met(ray, slot, contact));
        let class = if ray.exclude_primitive == Some(primitive) {
            TestClass::Excluded
        } else if contact.is_some() && met.is_none() {
            TestClass::BackFace
        } else if signs == [0; 3] {
            TestClass::InPlane
        } else {
            match &met {
                Some(contact) if contact.t_low > cutoff => TestClass::Behind,
                Some(contact)
                    if self.accept.is_some_and(|accept| !accept(primitive, contact.barycentrics)) =>
                {
                    TestClass::Transparent
                }
                Some(contact) if contact.certain => TestClass::Certain,
                Some(contact) if contact.hit => TestClass::Uncertain,
                Some(_) => TestClass::Possible,
                None if inside => TestClass::OutOfRange,
                None => TestClass::Outside,
            }
        };
        let t = contact.map(|contact| [contact.t, contact.t_low, contact.t_high]);
        (TestedTriangle { primitive, signs, class, t }, contact)
    }
}

/// Returns the signs of the three edge determinants of a triangle, each without rounding.
fn exact_signs(test: &ContactTest, triangle: &[[f32; 3]; 3]) -> [i32; 3] {
    let points: [Point; 3] = triangle.map(|vertex| vertex.map(f64::from));
    [0, 1, 2].map(|opposite: usize| {
        let (a, b) = (points[(opposite + 1) % 3], points[(opposite + 2) % 3]);
        let value =
            exact::edge_determinant(test.direction, test.origin, a, b) * test.direction[test.axis_z].signum();
        i32::from(value > 0.0) - i32::from(value < 0.0)
    })
}

impl fmt::Display for TestClass {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Certain => "hit",
            Self::Uncertain => "hit that single precision may miss",
            Self::Possible => "no hit, but single precision may report one",
            Self::OutOfRange => "outside of the ray's range",
            Self::InPlane => "the ray lies in its plane",
            Self::Behind => "behind a certain hit",
            Self::Excluded => "excluded by the ray",
            Self::Transparent => "transparent",
            Self::BackFace => "a back that the ray passes",
            Self::Outside => "passed outside",
        })
    }
}

impl fmt::Display for TestedTriangle {
    /// Writes one line.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let sign = |value: i32| match value {
            1 => '+',
            -1 => '-',
            _ => '0',
        };
        let [a, b, c] = self.signs.map(sign);
        write!(f, "triangle {}: edges {a}{b}{c}, {}", self.primitive, self.class)?;
        match self.t {
            Some([t, low, high]) => write!(f, ", t {t} ({low} to {high})"),
            None => Ok(()),
        }
    }
}

impl fmt::Display for OracleReplay {
    /// Writes nodes, tested triangles and the answer; one line each.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(f, "oracle: {} nodes, {} triangles passed outside", self.nodes.len(), self.outside)?;
        for VisitedNode { node, t, triangles } in &self.nodes {
            match triangles {
                0 => writeln!(f, "  node {node}, t from {t}")?,
                _ => writeln!(f, "  node {node}, t from {t}, {triangles} triangles")?,
            }
        }
        for tested in &self.tests {
            writeln!(f, "    {tested}")?;
        }
        match self.verdict.outcome {
            Outcome::Hit { primitive, t, .. } => write!(f, "hit: triangle {primitive}, t {t}")?,
            Outcome::Miss => write!(f, "miss")?,
        }
        if !self.verdict.ambiguous {
            return writeln!(f);
        }
        let candidates: Vec<String> = self
            .verdict
            .candidates
            .iter()
            .map(|candidate| format!("triangle {}", candidate.primitive))
            .chain(self.verdict.miss_allowed.then(|| "miss".to_owned()))
            .collect();
        writeln!(f, "; ambiguous, single precision may answer {}", candidates.join(", "))
    }
}
