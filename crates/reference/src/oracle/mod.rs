//! Oracle of true hits: decided exactly on the single-precision data that the device got.
//!
//! A ray is inside a triangle if and only if no two of its three edge determinants have strictly different
//! signs (edges and vertices count as inside); if all three are zero the ray lies in the triangle's plane and
//! does not hit it. Signs are exact, see [`exact`]. `t` is the plane's, in double precision. Triangles
//! without area are therefore never hit, and a closed mesh has no gaps.
//!
//! Single precision cannot be blamed for rays that it cannot tell apart. Every triangle therefore carries the
//! interval of t that a careful single-precision test may report, and a ray for which more than one answer
//! fits is *ambiguous*: its [`Verdict`] lists the admissible answers.

mod bvh;
mod contact;
mod coverage;
mod error;
pub mod exact;
mod ray;
mod replay;
mod t_bound;
mod verdict;

#[cfg(test)]
mod tests;

pub use error::OracleError;
pub use ray::Ray;
pub use replay::{OracleReplay, TestClass, TestedTriangle, VisitedNode};
pub use verdict::{Candidate, Occlusion, Outcome, Verdict};

use bvh::Bvh;
use contact::{Contact, ContactTest};
use rayon::prelude::*;
use verdict::NO_RANGE;

/// Largest magnitude of a usable coordinate, metres: the square of a larger one exceeds single precision.
/// Triangles with larger coordinates are dropped, as loaders must do too.
pub const COORDINATE_LIMIT: f32 = 1.8e18;

/// Largest number of triangles that are tested one by one; more triangles get a hierarchy.
const BRUTE_FORCE_LIMIT: usize = 64;

/// Function that decides if a crossing of an alpha-masked triangle counts: `(primitive, [weight of vertex 1,
/// weight of vertex 2])` to `true` for a hit. Called from several threads.
pub type Accept<'a> = &'a (dyn Fn(u32, [f64; 2]) -> bool + Sync);

/// Side of a triangle: the one from which its corners are seen in this order.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Side {
    /// Counter-clockwise.
    CounterClockwise,
    /// Clockwise.
    Clockwise,
}

/// Triangles of a scene, ready for rays. Primitive ids are running triangle indices.
pub struct Oracle<'a> {
    triangles: Vec<[[f32; 3]; 3]>,
    primitives: Vec<u32>,
    bvh: Option<Bvh>,
    accept: Option<Accept<'a>>,
    /// Back of each triangle that has one, by slot; empty if none has one.
    backs: Vec<Option<Side>>,
    dropped: usize,
    collapsed: usize,
}

impl std::fmt::Debug for Oracle<'_> {
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        formatter
            .debug_struct("Oracle")
            .field("triangles", &self.triangles.len())
            .field("dropped", &self.dropped)
            .field("collapsed", &self.collapsed)
            .finish_non_exhaustive()
    }
}

impl<'a> Oracle<'a> {
    /// Takes posed positions (metres, as uploaded) and three indices per triangle.
    ///
    /// Triangles with a coordinate that is not finite or beyond [`COORDINATE_LIMIT`] are never hit; they are
    /// counted in [`Oracle::dropped`], and the ids of others do not change. `accept` is the alpha test;
    /// `None` accepts everything.
    ///
    /// # Errors
    /// An error if the number of indices is no multiple of three, an index has no position, or there are more
    /// than `u32::MAX - 1` triangles.
    pub fn new(
        positions: &[[f32; 3]],
        indices: &[u32],
        accept: Option<Accept<'a>>,
    ) -> Result<Self, OracleError> {
        Self::with_search(positions, indices, accept, Search::Automatic)
    }

    /// Makes an oracle like [`Oracle::new`] that tests every triangle for every ray, to check the hierarchy.
    ///
    /// # Errors
    /// Errors of [`Oracle::new`].
    pub fn brute_force(
        positions: &[[f32; 3]],
        indices: &[u32],
        accept: Option<Accept<'a>>,
    ) -> Result<Self, OracleError> {
        Self::with_search(positions, indices, accept, Search::BruteForce)
    }

    fn with_search(
        positions: &[[f32; 3]],
        indices: &[u32],
        accept: Option<Accept<'a>>,
        search: Search,
    ) -> Result<Self, OracleError> {
        if !indices.len().is_multiple_of(3) {
            return Err(OracleError::IncompleteTriangle { indices: indices.len() });
        }
        let count = indices.len() / 3;
        if count >= u32::MAX as usize {
            return Err(OracleError::TooManyTriangles { triangles: count });
        }
        let mut triangles = Vec::with_capacity(count);
        let mut primitives = Vec::with_capacity(count);
        let (mut dropped, mut collapsed) = (0, 0);
        for (primitive, corners) in indices.as_chunks::<3>().0.iter().enumerate() {
            let mut triangle = [[0.0_f32; 3]; 3];
            for (vertex, &index) in triangle.iter_mut().zip(corners) {
                *vertex = *positions.get(index as usize).ok_or(OracleError::IndexOutOfRange {
                    primitive,
                    index,
                    positions: positions.len(),
                })?;
            }
            let [a, b, c] = triangle;
            // Written so that NaN fails.
            if !triangle.iter().flatten().all(|x| x.abs() <= COORDINATE_LIMIT) {
                dropped += 1;
            } else if a == b || b == c || c == a {
                // Any test rounds equal vertices equally, so the area stays zero.
                collapsed += 1;
            } else {
                triangles.push(triangle);
                primitives.push(primitive as u32);
            }
        }
        let hierarchy = match search {
            Search::BruteForce => false,
            Search::Automatic => triangles.len() > BRUTE_FORCE_LIMIT,
        };
        let bvh = hierarchy.then(|| Bvh::build(&triangles));
        Ok(Self { triangles, primitives, bvh, accept, backs: Vec::new(), dropped, collapsed })
    }

    /// Adds backs to triangles, through which rays that cull back faces pass. `back_of` returns the back by
    /// the id of the triangle; `None` if every ray hits both sides.
    #[must_use]
    pub fn with_backs(self, back_of: impl Fn(u32) -> Option<Side>) -> Self {
        let backs: Vec<_> = self.primitives.iter().map(|&primitive| back_of(primitive)).collect();
        let backs = if backs.iter().any(Option::is_some) { backs } else { Vec::new() };
        Self { backs, ..self }
    }

    /// Returns the number of triangles that rays are tested against: those neither dropped nor collapsed.
    pub fn triangle_count(&self) -> usize {
        self.triangles.len()
    }

    /// Returns the number of triangles left out because a coordinate is not finite or too large.
    pub fn dropped(&self) -> usize {
        self.dropped
    }

    /// Returns the number of triangles left out because two of their vertices are equal.
    pub fn collapsed(&self) -> usize {
        self.collapsed
    }

    /// Returns the nearest hit of a ray with `t_min < t < t_max`. Hits at equal t go to the lowest id. A ray
    /// that is not valid ([`Ray::is_valid`]) hits nothing.
    pub fn closest(&self, ray: &Ray) -> Verdict {
        let Some(test) = ContactTest::new(ray) else { return Verdict::miss() };
        let mut found = Found { contacts: Vec::new(), cutoff: f64::INFINITY };
        match &self.bvh {
            Some(bvh) => bvh.visit(&test, |slot, cutoff| {
                self.consider(ray, &test, slot, &mut found);
                *cutoff = found.cutoff;
            }),
            None => (0..self.triangles.len()).for_each(|slot| self.consider(ray, &test, slot, &mut found)),
        }
        let cutoff = found.cutoff;
        found.contacts.retain(|(_, contact)| contact.t_low <= cutoff);
        found.contacts.sort_unstable_by_key(|(slot, _)| *slot);
        self.evaluate(&found.contacts)
    }

    /// Returns [`Oracle::closest`] of many rays, computed on all threads, in the order of the rays.
    pub fn closest_batch(&self, rays: &[Ray]) -> Vec<Verdict> {
        rays.par_iter().map(|ray| self.closest(ray)).collect()
    }

    /// Tests if anything is hit with `t_min < t < t_max`.
    pub fn occluded(&self, ray: &Ray) -> Occlusion {
        let verdict = self.closest(ray);
        let occluded = matches!(verdict.outcome, Outcome::Hit { .. });
        // A certain hit anywhere in range settles the question, however unsure the nearest hit is.
        Occlusion { occluded, ambiguous: verdict.ambiguous && verdict.miss_allowed }
    }

    /// Returns [`Oracle::occluded`] of many rays, computed on all threads, in the order of the rays.
    pub fn occluded_batch(&self, rays: &[Ray]) -> Vec<Occlusion> {
        rays.par_iter().map(|ray| self.occluded(ray)).collect()
    }

    fn consider(&self, ray: &Ray, test: &ContactTest, slot: usize, found: &mut Found) {
        let primitive = self.primitives[slot];
        if ray.exclude_primitive == Some(primitive) {
            return;
        }
        let Some(contact) = test.contact(&self.triangles[slot]) else { return };
        let Some(contact) = self.met(ray, slot, contact) else { return };
        if contact.t_low > found.cutoff {
            return;
        }
        if self.accept.is_some_and(|accept| !accept(primitive, contact.barycentrics)) {
            return;
        }
        // Hits behind a certain hit cannot be answers. Hits that single precision may miss stop nothing.
        if contact.certain {
            found.cutoff = found.cutoff.min(contact.t_high);
        }
        found.contacts.push((slot, contact));
    }

    /// Returns the contact as it counts for a ray that passes backs: `None` for a back that single precision
    /// sees as well. If rounding decides the side, the triangle may be reported, but need not be.
    fn met(&self, ray: &Ray, slot: usize, contact: Contact) -> Option<Contact> {
        let back = self.backs.get(slot).copied().flatten().filter(|_| ray.culls_back_faces);
        let Some(back) = back else { return Some(contact) };
        let is_back = contact.side == back;
        match (contact.side_is_certain, is_back) {
            (true, true) => None,
            (true, false) => Some(contact),
            (false, _) => {
                let hit = contact.hit && !is_back;
                Some(Contact { hit, certain: false, in_range: false, ..contact })
            }
        }
    }

    /// Computes the verdict; `contacts` are sorted by primitive.
    fn evaluate(&self, contacts: &[(usize, Contact)]) -> Verdict {
        if contacts.is_empty() {
            return Verdict::miss();
        }
        let hits = || contacts.iter().filter(|(_, contact)| contact.hit);
        let nearest_t = hits().map(|(_, contact)| contact.t).fold(f64::INFINITY, f64::min);
        // Two planes that intersect in a point of the ray give t with a relative error below 2^-38 each.
        let tie = nearest_t + nearest_t.abs() * 2.0_f64.powi(-36);
        let (outcome, t_range) = match hits().find(|(_, contact)| contact.t <= tie) {
            Some((slot, contact)) => {
                let (t, barycentrics) = (contact.t, contact.barycentrics);
                let primitive = self.primitives[*slot];
                (Outcome::Hit { primitive, t, barycentrics }, [contact.t_low, contact.t_high])
            }
            None => (Outcome::Miss, NO_RANGE),
        };
        if let [(_, contact)] = contacts
            && contact.certain
        {
            let candidates = Vec::new();
            return Verdict { outcome, t_range, ambiguous: false, miss_allowed: false, candidates };
        }
        let certain = contacts.iter().any(|(_, contact)| contact.certain);
        let candidates = contacts
            .iter()
            .map(|(slot, contact)| Candidate {
                primitive: self.primitives[*slot],
                t_low: contact.t_low,
                t_high: contact.t_high,
                certain: contact.certain,
            })
            .collect();
        let miss_allowed = !certain
            && !coverage::covered(contacts.iter().map(|(slot, contact)| (&self.triangles[*slot], contact)));
        Verdict { outcome, t_range, ambiguous: true, miss_allowed, candidates }
    }
}

enum Search {
    Automatic,
    BruteForce,
}

struct Found {
    contacts: Vec<(usize, Contact)>,
    /// Largest t at which an answer can lie.
    cutoff: f64,
}
