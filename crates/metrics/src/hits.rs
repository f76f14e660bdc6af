use crate::error::MetricsError;
use crate::rate::Rate;
use crate::statistics::Percentiles;

/// True answer for one ray.
pub trait Truth {
    /// Returns triangle and t of the nearest hit in exact arithmetic.
    fn hit(&self) -> Option<(u32, f64)>;

    /// True if rounding of a careful test may lead to another answer.
    fn is_ambiguous(&self) -> bool;

    /// True if a miss is admissible.
    fn admits_miss(&self) -> bool;

    /// True if a hit at this t, on this triangle if it is known, is admissible.
    fn admits_hit(&self, primitive: Option<u32>, t: f64) -> bool;
}

/// Hit that a structure reports.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DeviceHit {
    /// Ray parameter in units of the direction's length.
    pub t: f32,
    /// Running index of the triangle, if the structure knows it.
    pub primitive: Option<u32>,
}

/// Differences of a structure's answers from the truth.
///
/// Rates are over unambiguous rays, unless their name says otherwise: cases that single precision cannot tell
/// apart are no faults. A hit whose t is not finite counts in `non_finite` and nowhere else.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct HitConfusion {
    /// Number of all rays.
    pub rays: u64,
    /// Number of rays with more than one admissible answer.
    pub ambiguous: u64,
    /// Rate of rays without a hit, among the ambiguous rays whose surroundings are closed.
    pub ambiguous_lost: Rate,
    /// Rate of inadmissible hits, among the ambiguous rays that got a hit.
    pub ambiguous_wrong: Rate,
    /// Rate of rays without a hit, among the rays that hit.
    pub missed: Rate,
    /// Rate of rays with a hit, among the rays that miss.
    pub false_hits: Rate,
    /// Rate of wrong triangles whose t is off by more than the tolerance, among the rays that hit and got a
    /// hit with a known triangle. Absent if no triangle is known.
    pub wrong_primitive: Option<Rate>,
    /// Rate of errors of t that rounding does not explain, among the rays that hit and got a hit on the right
    /// triangle (or on an unknown one).
    pub t_off: Rate,
    /// Percentiles of |dt| / t of the rays that hit and got a hit; absent if there are none.
    pub dt_rel: Option<Percentiles>,
    /// Rate of hits with a t that is NaN or infinite, among all rays.
    pub non_finite: Rate,
}

impl HitConfusion {
    /// Compares answers, one for each verdict; `None` is a miss.
    ///
    /// `wrong_primitive_tolerance` is the |dt| / t up to which another triangle's id is accepted: 0 for
    /// structures that find triangles, the promised depth error for those that find samples.
    ///
    /// # Errors
    /// An error if the numbers of hits and truths differ.
    pub fn measure<T: Truth>(
        truths: &[T],
        hits: &[Option<DeviceHit>],
        wrong_primitive_tolerance: f64,
    ) -> Result<Self, MetricsError> {
        if truths.len() != hits.len() {
            return Err(MetricsError::RayCountMismatch { truths: truths.len(), hits: hits.len() });
        }
        let mut confusion = Self { rays: hits.len() as u64, ..Self::default() };
        confusion.non_finite.total = confusion.rays;
        let mut dt_rel = Vec::new();
        for (truth, hit) in truths.iter().zip(hits) {
            confusion.ambiguous += u64::from(truth.is_ambiguous());
            if hit.is_some_and(|hit| !hit.t.is_finite()) {
                confusion.non_finite.count += 1;
            } else if truth.is_ambiguous() {
                confusion.evaluate_ambiguous(truth, hit);
            } else {
                dt_rel.extend(confusion.evaluate(truth, hit, wrong_primitive_tolerance));
            }
        }
        confusion.dt_rel = Percentiles::of(&dt_rel);
        Ok(confusion)
    }

    fn evaluate_ambiguous(&mut self, truth: &impl Truth, hit: &Option<DeviceHit>) {
        if !truth.admits_miss() {
            count(&mut self.ambiguous_lost, hit.is_none());
        }
        if let Some(hit) = hit {
            count(&mut self.ambiguous_wrong, !truth.admits_hit(hit.primitive, f64::from(hit.t)));
        }
    }

    /// Returns |dt| / t if there is one.
    fn evaluate(
        &mut self,
        truth: &impl Truth,
        hit: &Option<DeviceHit>,
        wrong_primitive_tolerance: f64,
    ) -> Option<f64> {
        let Some((primitive, t)) = truth.hit() else {
            count(&mut self.false_hits, hit.is_some());
            return None;
        };
        count(&mut self.missed, hit.is_none());
        let hit = hit.as_ref()?;
        let difference = (f64::from(hit.t) - t).abs();
        let dt_rel = if difference == 0.0 { 0.0 } else { difference / t.abs() };
        if let Some(found) = hit.primitive {
            let wrong = found != primitive
                && (wrong_primitive_tolerance <= 0.0 || dt_rel > wrong_primitive_tolerance);
            count(self.wrong_primitive.get_or_insert_default(), wrong);
        }
        if hit.primitive.is_none_or(|found| found == primitive) {
            count(&mut self.t_off, !truth.admits_hit(hit.primitive, f64::from(hit.t)));
        }
        Some(dt_rel)
    }

    /// True if a structure that finds triangles kept its promise: nothing missed, false, wrong, lost or not
    /// finite. (How exact t is, `dt_rel` and `t_off` say.)
    pub fn is_clean(&self) -> bool {
        let wrong = self.wrong_primitive.unwrap_or_default();
        [self.missed, self.false_hits, wrong, self.ambiguous_lost, self.ambiguous_wrong, self.non_finite]
            .iter()
            .all(|rate| rate.count == 0)
    }
}

/// Iterates over the true t and the found t of each unambiguous ray that hits and got a hit with a finite t.
///
/// If there are fewer hits than truths, the remaining truths are left out.
pub fn common_hits<'a, T: Truth>(
    truths: &'a [T],
    hits: &'a [Option<DeviceHit>],
) -> impl Iterator<Item = (f64, f32)> + 'a {
    truths.iter().zip(hits).filter(|(truth, _)| !truth.is_ambiguous()).filter_map(|(truth, hit)| {
        let hit = hit.filter(|hit| hit.t.is_finite())?;
        Some((truth.hit()?.1, hit.t))
    })
}

fn count(rate: &mut Rate, happened: bool) {
    rate.total += 1;
    rate.count += u64::from(happened);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[derive(Clone)]
    enum Fact {
        Hit(u32, f64),
        Miss,
        Unsure { closed: bool },
    }

    impl Truth for Fact {
        fn hit(&self) -> Option<(u32, f64)> {
            match self {
                Self::Hit(primitive, t) => Some((*primitive, *t)),
                Self::Miss => None,
                Self::Unsure { .. } => Some((3, 1.0)),
            }
        }

        fn is_ambiguous(&self) -> bool {
            matches!(self, Self::Unsure { .. })
        }

        fn admits_miss(&self) -> bool {
            matches!(self, Self::Unsure { closed: false })
        }

        fn admits_hit(&self, primitive: Option<u32>, t: f64) -> bool {
            let admits = |ids: &[u32], truth: f64| {
                primitive.is_none_or(|p| ids.contains(&p)) && (t - truth).abs() < 1e-6
            };
            match self {
                Self::Hit(primitive, t) => admits(&[*primitive], *t),
                Self::Miss => false,
                Self::Unsure { .. } => admits(&[3, 4], 1.0),
            }
        }
    }

    fn hit(primitive: u32, t: f32) -> Option<DeviceHit> {
        Some(DeviceHit { t, primitive: Some(primitive) })
    }

    fn truths() -> Vec<Fact> {
        vec![
            Fact::Hit(1, 2.0),
            Fact::Hit(2, 4.0),
            Fact::Miss,
            Fact::Unsure { closed: true },
            Fact::Unsure { closed: false },
        ]
    }

    fn right() -> Vec<Option<DeviceHit>> {
        vec![hit(1, 2.0), hit(2, 4.0), None, hit(4, 1.0), None]
    }

    #[test]
    fn right_answers_are_clean() {
        let confusion = HitConfusion::measure(&truths(), &right(), 0.0).expect("same length");
        assert!(confusion.is_clean(), "{confusion:?}");
        assert_eq!((confusion.rays, confusion.ambiguous), (5, 2));
        assert_eq!(confusion.missed, Rate { count: 0, total: 2 });
        assert_eq!(confusion.false_hits, Rate { count: 0, total: 1 });
        assert_eq!(confusion.ambiguous_lost, Rate { count: 0, total: 1 });
        assert_eq!(confusion.dt_rel.map(|p| (p.count, p.max)), Some((2, 0.0)));
    }

    #[test]
    fn every_wrong_answer_is_counted_in_its_place() {
        type Place = fn(&HitConfusion) -> Rate;
        let cases: [(usize, Option<DeviceHit>, Place); 7] = [
            (0, None, |c| c.missed),
            (2, hit(1, 1.0), |c| c.false_hits),
            (1, hit(1, 4.0), |c| c.wrong_primitive.unwrap_or_default()),
            (3, None, |c| c.ambiguous_lost),
            (3, hit(7, 1.0), |c| c.ambiguous_wrong),
            (4, hit(3, 1.5), |c| c.ambiguous_wrong),
            (1, hit(2, f32::NAN), |c| c.non_finite),
        ];
        for (ray, answer, place) in cases {
            let mut hits = right();
            hits[ray] = answer;
            let confusion = HitConfusion::measure(&truths(), &hits, 0.0).expect("same length");
            assert!(!confusion.is_clean(), "{answer:?} for ray {ray} went unseen");
            assert_eq!(place(&confusion).count, 1, "{answer:?} for ray {ray}: {confusion:?}");
        }
    }

    #[test]
    fn distance_errors_and_tolerance() {
        let mut hits = right();
        hits[1] = hit(9, 4.5);
        let confusion = HitConfusion::measure(&truths(), &hits, 0.2).expect("same length");
        assert_eq!(confusion.wrong_primitive, Some(Rate { count: 0, total: 2 }));
        assert_eq!(confusion.dt_rel.map(|p| (p.p50, p.max)), Some((0.0625, 0.125)));
        let confusion = HitConfusion::measure(&truths(), &hits, 0.1).expect("same length");
        assert_eq!(confusion.wrong_primitive, Some(Rate { count: 1, total: 2 }));
    }

    #[test]
    fn depth_beyond_rounding_is_counted() {
        let mut hits = right();
        hits[1] = hit(2, 4.01);
        let confusion = HitConfusion::measure(&truths(), &hits, 0.0).expect("same length");
        assert_eq!(confusion.t_off, Rate { count: 1, total: 2 });
        assert!(confusion.is_clean());
        hits[1] = hit(2, 4.0);
        let confusion = HitConfusion::measure(&truths(), &hits, 0.0).expect("same length");
        assert_eq!(confusion.t_off, Rate { count: 0, total: 2 });
    }

    #[test]
    fn common_hits_leave_out_what_cannot_be_compared() {
        let pairs = |hits: &[_]| common_hits(&truths(), hits).collect::<Vec<_>>();
        assert_eq!(pairs(&right()), [(2.0, 2.0), (4.0, 4.0)]);
        let mut hits = right();
        (hits[0], hits[2]) = (hit(1, f32::INFINITY), hit(1, 1.0));
        assert_eq!(pairs(&hits), [(4.0, 4.0)]);
    }

    #[test]
    fn unknown_triangles_are_not_measured() {
        let hits: Vec<_> =
            right().iter().map(|hit| hit.map(|hit| DeviceHit { primitive: None, ..hit })).collect();
        let confusion = HitConfusion::measure(&truths(), &hits, 0.0).expect("same length");
        assert_eq!(confusion.wrong_primitive, None);
        assert!(confusion.is_clean());
        let short = HitConfusion::measure(&truths(), &hits[1..], 0.0);
        assert_eq!(short, Err(MetricsError::RayCountMismatch { truths: 5, hits: 4 }));
    }
}
