//! Hits on a hard case, measured against the oracle and against the statement of the case.

use rasray_ads::StructureKind;
use rasray_hard_cases::{Answer, HardCase};
use rasray_metrics::{DeviceHit, HitConfusion, MetricsError, Percentiles, Rate, Truth};
use rasray_reference::oracle::Verdict;

/// Tolerance of a hit relative to t, beyond the bounds that the oracle derives from the test itself: 64 units
/// of rounding.
pub const HIT_ROUNDING: f64 = 64.0 / 16_777_216.0;

/// Relative error of depth up to which a fragment counts as right.
const FRAGMENT_DEPTH: f64 = 1.0e-3;

/// Tolerated errors of t, relative to t.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tolerance {
    /// Largest error at which a depth counts as right for [`Measured::errors`].
    pub depth: f64,
    /// Largest error for [`Measured::rejected`], beyond the oracle's own bounds.
    pub rounding: f64,
}

impl Tolerance {
    /// Returns the tolerance that the command allows for a kind of structure.
    pub fn of(kind: StructureKind) -> Self {
        let both = match kind {
            StructureKind::Primitive | StructureKind::LossyPrimitive => HIT_ROUNDING,
            StructureKind::Fragment => FRAGMENT_DEPTH,
        };
        Self { depth: both, rounding: both }
    }
}

/// Results of one structure on one case.
#[derive(Clone, Debug, Default)]
pub struct Measured {
    /// Number of rays that got a hit.
    pub hits: usize,
    /// Counts of hits against the oracle; wrong ids are forgiven if t is right to the tolerance.
    pub confusion: HitConfusion,
    /// Share of the unambiguous rays whose answer was missed, false, or wrong in t beyond the tolerance.
    pub errors: Rate,
    /// Share of the ambiguous rays whose answer is not admissible within the tolerance in t.
    pub inadmissible: Rate,
    /// Index of the first ambiguous ray with such an answer.
    pub first_inadmissible: Option<usize>,
    /// Indices of the rays that count in [`Measured::evaluated`].
    pub wrong: Vec<usize>,
    /// Indices of the rays whose answer a structure that finds triangles may not give.
    pub rejected: Vec<usize>,
    /// Indices of the rays in [`Measured::rejected`] that got a hit, with depths off by the tolerance
    /// allowed.
    pub rejected_hits: Vec<usize>,
    /// Number of rays in [`Measured::rejected`] with a hit outside the range of t, where the case states only
    /// a range.
    pub out_of_range: usize,
    /// Number of rays without a hit, although the statement gives a hit that a watertight test finds.
    pub lost: usize,
    /// Number of unambiguous and ambiguous rays that are not evaluated, because their hits lie outside the
    /// camera's view.
    pub unseen: usize,
    /// Percentiles of |dt| / t over the hits on the right triangle.
    pub dt_right: Option<Percentiles>,
    /// Index of the ray with the largest |dt| / t of these hits.
    pub farthest_off: Option<usize>,
}

impl Measured {
    /// Compares answers with verdicts, one for each verdict; a miss is absent, and ids are the case's. Rays
    /// that `is_unseen` accepts count in [`Measured::unseen`] and in no rate.
    ///
    /// # Errors
    /// The number of answers is not that of the verdicts.
    pub fn of(
        case: &HardCase,
        verdicts: &[Verdict],
        hits: &[Option<DeviceHit>],
        tolerance: Tolerance,
        is_unseen: impl Fn(usize) -> bool,
    ) -> Result<Self, MetricsError> {
        let confusion = HitConfusion::measure(verdicts, hits, tolerance.depth)?;
        let mut measured = Self { confusion, hits: hits.iter().flatten().count(), ..Self::default() };
        let (mut dt_right, mut inadmissible) = (Vec::new(), Vec::new());
        let mut largest_dt = 0.0;
        for (index, (verdict, hit)) in verdicts.iter().zip(hits).enumerate() {
            let answer = case.answer(index);
            if !case.accepts(index, verdict, *hit, tolerance.rounding) {
                measured.rejected.push(index);
                measured.out_of_range += usize::from(matches!(answer, Answer::Anything { .. }));
            }
            if hit.is_some() && !case.accepts(index, verdict, *hit, tolerance.rounding.max(tolerance.depth)) {
                measured.rejected_hits.push(index);
            }
            let must_hit = matches!(answer, Answer::Hit | Answer::HitAt { .. } | Answer::HitOn { .. });
            measured.lost += usize::from(must_hit && hit.is_none());
            if matches!(answer, Answer::Anything { .. }) {
                continue;
            }
            if is_unseen(index) {
                measured.unseen += 1;
                continue;
            }
            if verdict.is_ambiguous() {
                measured.inadmissible.total += 1;
                if !admissible(verdict, hit.as_ref(), tolerance.depth) {
                    measured.inadmissible.count += 1;
                    inadmissible.push(index);
                }
                continue;
            }
            measured.errors.total += 1;
            let wrong = match (verdict.hit(), hit) {
                (None, None) => false,
                (Some((primitive, t)), Some(hit)) => {
                    let dt = (f64::from(hit.t) - t).abs() / t.abs();
                    if hit.primitive == Some(primitive) {
                        dt_right.push(dt);
                        if dt > largest_dt {
                            largest_dt = dt;
                            measured.farthest_off = Some(index);
                        }
                    }
                    // The comparison is written so that NaN counts as wrong.
                    !(dt <= tolerance.depth || verdict.admits_hit(hit.primitive, f64::from(hit.t)))
                }
                _ => true,
            };
            if wrong {
                measured.errors.count += 1;
                measured.wrong.push(index);
            }
        }
        measured.first_inadmissible = inadmissible.first().copied();
        if measured.errors.total == 0 {
            measured.wrong = inadmissible;
        }
        measured.dt_right = Percentiles::of(&dt_right);
        Ok(measured)
    }

    /// Returns the rate that laws bound: the rate of errors, or of inadmissible answers if every ray of a
    /// case is ambiguous (surfaces that coincide).
    pub fn evaluated(&self) -> Rate {
        if self.errors.total > 0 { self.errors } else { self.inadmissible }
    }
}

/// True if an ambiguous ray may get this answer, on any triangle.
fn admissible(verdict: &Verdict, hit: Option<&DeviceHit>, depth_tolerance: f64) -> bool {
    hit.map_or(verdict.miss_allowed, |hit| {
        let (t, slack) = (f64::from(hit.t), depth_tolerance * f64::from(hit.t).abs());
        verdict.candidates.iter().any(|one| one.t_low - slack <= t && t <= one.t_high + slack)
    })
}
