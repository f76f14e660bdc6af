//! Verdict on a run: whether its counts meet the demand of a hard case on the kind of structure.

use rasray_ads::StructureKind;
use rasray_hard_cases::{HardCase, Target};
use rasray_metrics::Rate;
use serde_json::Value;

use rasray_report::HardRecord;

use crate::measured::Measured;

/// Largest |dt| / t of a run, and the bound of the case for structures that find triangles.
type LargestDt = Option<(f64, f64)>;

/// Makes the record of a run on a case for the report; `resolution` is the run's option of that name.
pub(super) fn hard_record(
    case: &HardCase,
    kind: StructureKind,
    measured: &Measured,
    dt: LargestDt,
    resolution: Option<&Value>,
) -> HardRecord {
    let target = match kind {
        StructureKind::Primitive | StructureKind::LossyPrimitive => case.target.primitives,
        StructureKind::Fragment => case.target.fragments,
    };
    let (met, reason) = verdict(target, kind, measured, dt, resolution.and_then(Value::as_f64));
    HardRecord {
        id: case.id.to_owned(),
        title: case.title.to_owned(),
        measure: case.measure.to_owned(),
        target: target.to_string(),
        triangles: case.triangles.len() as u64,
        met,
        reason,
        rejected: Some(measured.rejected.len() as u64),
        first_rejected: measured.rejected.first().map(|&ray| ray as u64),
        lost: Some(measured.lost as u64),
    }
}

/// Returns true if the target was met, `None` if one run cannot tell, and the reason.
fn verdict(
    target: Target,
    kind: StructureKind,
    measured: &Measured,
    dt: LargestDt,
    resolution: Option<f64>,
) -> (Option<bool>, String) {
    let Measured { hits, lost, out_of_range, .. } = *measured;
    let (rays, non_finite) = (measured.confusion.rays, measured.confusion.non_finite.count);
    let (rejected, rejected_hits) = (measured.rejected.len() as u64, measured.rejected_hits.len());
    let rate = Rate { count: rejected, total: rays };
    let share = match (rate.value(), rate.interval()) {
        (Some(value), Some([low, high])) => {
            format!(
                "{rejected} of {rays} answers are wrong ({value:.2e}, with 95 % in {low:.2e} to {high:.2e})"
            )
        }
        _ => "there are no rays".to_owned(),
    };
    if non_finite > 0 {
        return (Some(false), format!("{non_finite} hits have a t that is no number"));
    }
    match target {
        // Such a case does not test the hits that a fragment structure leaves out.
        Target::Exact if kind == StructureKind::Fragment => {
            (Some(rejected_hits == 0), format!("{rejected_hits} of {hits} hits are wrong"))
        }
        // The tests hold the bounds of the losses by a paper's rules.
        Target::NoneMissed | Target::Exact if kind == StructureKind::LossyPrimitive => {
            (None, format!("{share}; {lost} rays are lost; the rules that were chosen promise none"))
        }
        Target::NoneMissed | Target::Exact if dt.is_some_and(|(largest, limit)| largest > limit) => {
            let (largest, limit) = dt.unwrap_or_default();
            (Some(false), format!("{share}; |dt|/t is {largest:.1e}, more than {limit:.1e}"))
        }
        Target::NoneMissed | Target::Exact => (Some(rejected == 0), format!("{share}; {lost} rays are lost")),
        Target::Law => {
            let law = match (resolution, rate.value()) {
                (Some(resolution), Some(value)) => {
                    format!("; times the {resolution} cells a side that is {:.3}", value * resolution)
                }
                _ => String::new(),
            };
            (None, format!("{share}{law}; a law shows over several resolutions"))
        }
        Target::Counted => (None, format!("{hits} of {rays} rays hit; both answers are legal")),
        Target::Finite => (
            Some(out_of_range == 0),
            format!("all hits are finite; {out_of_range} lie outside of the stated range of t"),
        ),
        _ => (None, share),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use rasray_metrics::HitConfusion;

    fn met(target: Target, kind: StructureKind, measured: &Measured) -> Option<bool> {
        verdict(target, kind, measured, None, Some(64.0)).0
    }

    #[test]
    fn a_wrong_answer_breaks_the_target_that_it_is_about_and_no_other() {
        use StructureKind::{Fragment, LossyPrimitive, Primitive};
        let confusion = HitConfusion { rays: 100, ..HitConfusion::default() };
        let right = Measured { confusion, hits: 60, ..Measured::default() };
        let miss = Measured { rejected: vec![7], lost: 1, ..right.clone() };
        let false_hit = Measured { rejected: vec![7], rejected_hits: vec![7], ..right.clone() };
        let out = Measured { out_of_range: 1, ..false_hit.clone() };
        let mut broken = false_hit.clone();
        broken.confusion.non_finite.count = 1;
        for (target, kind, by_miss, by_hit, by_range) in [
            (Target::NoneMissed, Primitive, Some(false), Some(false), Some(false)),
            (Target::Exact, Primitive, Some(false), Some(false), Some(false)),
            (Target::Exact, Fragment, Some(true), Some(false), Some(false)),
            (Target::Exact, LossyPrimitive, None, None, None),
            (Target::Law, Fragment, None, None, None),
            (Target::Counted, Primitive, None, None, None),
            (Target::Finite, Primitive, Some(true), Some(true), Some(false)),
        ] {
            assert_ne!(met(target, kind, &right), Some(false), "{target}");
            assert_eq!(met(target, kind, &miss), by_miss, "{target}");
            assert_eq!(met(target, kind, &false_hit), by_hit, "{target}");
            assert_eq!(met(target, kind, &out), by_range, "{target}");
            assert_eq!(met(target, kind, &broken), Some(false), "{target}");
        }
        for (largest, expected) in [(0.9, Some(true)), (1.1, Some(false))] {
            let dt = Some((largest, 1.0));
            assert_eq!(verdict(Target::NoneMissed, Primitive, &right, dt, None).0, expected);
        }
        let law = verdict(Target::Law, Fragment, &miss, None, Some(64.0)).1;
        assert!(law.contains("1 of 100") && law.contains("0.640"), "{law}");
    }
}
