//! Hits on a hard case against the oracle and against what is stated of the case.

use rasray_ads::StructureKind;
use rasray_hard_cases::{Answer, HardCase};
use rasray_metrics::{DeviceHit, HitConfusion, MetricsError, Percentiles, Rate, Truth};
use rasray_reference::oracle::Verdict;

/// 64 units of rounding: what a hit may differ by beyond the bounds that the oracle derives from the test
/// itself, relative to t.
pub const HIT_ROUNDING: f64 = 64.0 / 16_777_216.0;

/// Depth that a fragment may be off by and count as right, relative.
const FRAGMENT_DEPTH: f64 = 1.0e-3;

/// Errors of t that are allowed, relative to t.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tolerance {
    /// Up to this a depth counts as right for [`Measured::errors`].
    pub depth: f64,
    /// That of [`Measured::rejected`], beyond the oracle's own bounds.
    pub rounding: f64,
}

impl Tolerance {
    /// Tolerance that the command allows a kind of structure.
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
    /// Rays that got a hit.
    pub hits: usize,
    /// Against the oracle; wrong ids are forgiven where t is right to the tolerance.
    pub confusion: HitConfusion,
    /// Share of the unambiguous rays that was missed, false, or wrong in t beyond the tolerance.
    pub errors: Rate,
    /// Share of the ambiguous rays that got an answer that is not admissible, give or take the tolerance in
    /// t.
    pub inadmissible: Rate,
    /// The first ambiguous ray with such an answer, by index.
    pub first_inadmissible: Option<usize>,
    /// The rays that count in [`Measured::evaluated`], by index.
    pub wrong: Vec<usize>,
    /// Rays whose answer a structure that finds triangles may not give, by index.
    pub rejected: Vec<usize>,
    /// Those of [`Measured::rejected`] that got a hit, with depths off by the tolerance allowed.
    pub rejected_hits: Vec<usize>,
    /// Those of [`Measured::rejected`] with a hit outside of the range of t that is all that is stated.
    pub out_of_range: usize,
    /// Rays that a stated answer says hit and that got no hit although a watertight test finds one.
    pub lost: usize,
    /// Unambiguous and ambiguous rays that are not evaluated: their hits lie outside of what the camera sees.
    pub unseen: usize,
    /// |dt| / t of the hits on the right triangle.
    pub dt_right: Option<Percentiles>,
    /// The ray with the largest of these.
    pub farthest_off: Option<usize>,
}

impl Measured {
    /// Compares answers, one for each verdict, a miss being absent; ids are the case's. Rays that `is_unseen`
    /// accepts count in [`Measured::unseen`] and in no rate.
    ///
    /// # Errors
    /// There are not as many answers as verdicts.
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
                    // Written so that NaN is wrong.
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

    /// The rate that laws bound: that of errors, or of inadmissible answers where every ray of a case is
    /// ambiguous (surfaces that coincide).
    pub fn evaluated(&self) -> Rate {
        if self.errors.total > 0 { self.errors } else { self.inadmissible }
    }
}

/// True if an ambiguous ray may get this answer, on whatever triangle.
fn admissible(verdict: &Verdict, hit: Option<&DeviceHit>, depth_tolerance: f64) -> bool {
    hit.map_or(verdict.miss_allowed, |hit| {
        let (t, slack) = (f64::from(hit.t), depth_tolerance * f64::from(hit.t).abs());
        verdict.candidates.iter().any(|one| one.t_low - slack <= t && t <= one.t_high + slack)
    })
}
