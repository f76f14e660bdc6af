//! Evaluation of hits against the oracle, and the distribution of their errors in t.

use rasray_ads::{Hit, PRIMITIVE_UNKNOWN, StructureKind};
use rasray_metrics::{DeviceHit, HitConfusion, common_hits};
use rasray_reference::oracle::Verdict;

use crate::error::ExperimentError;
use rasray_report::Accuracy;
use rasray_report::figures::DepthErrors;

/// Largest |dt| / t at which a fragment structure may report another triangle: hits on one plane.
const FRAGMENT_TOLERANCE: f64 = 1.0e-5;

/// Converts hits to the form of the metrics, in which a miss is absent.
pub fn device_hits(hits: impl IntoIterator<Item = Hit>) -> Vec<Option<DeviceHit>> {
    hits.into_iter()
        .map(|hit| {
            hit.is_hit().then(|| DeviceHit {
                t: hit.t,
                primitive: (hit.primitive != PRIMITIVE_UNKNOWN).then_some(hit.primitive),
            })
        })
        .collect()
}

/// Counts the errors of the hits.
pub(super) fn accuracy(
    kind: StructureKind,
    verdicts: &[Verdict],
    hits: &[Option<DeviceHit>],
) -> Result<Accuracy, ExperimentError> {
    let tolerance = match kind {
        StructureKind::Primitive | StructureKind::LossyPrimitive => 0.0,
        StructureKind::Fragment => FRAGMENT_TOLERANCE,
    };
    let confusion = HitConfusion::measure(verdicts, hits, tolerance)?;
    Ok(Accuracy::from(&confusion))
}

/// Makes the histogram of |dt|/t of a run.
pub(super) fn depth_errors(run: usize, verdicts: &[Verdict], hits: &[Option<DeviceHit>]) -> DepthErrors {
    let mut errors = DepthErrors { run, zero: 0, bins: vec![0; DepthErrors::BINS] };
    for (truth, found) in common_hits(verdicts, hits) {
        if found == truth as f32 {
            errors.zero += 1;
            continue;
        }
        let relative = (f64::from(found) - truth).abs() / truth.abs();
        let place = (relative.log10() - DepthErrors::LOW) / DepthErrors::WIDTH;
        // The cast saturates, and takes NaN (from 0 / 0) to the first bin.
        errors.bins[(place.floor() as usize).min(DepthErrors::BINS - 1)] += 1;
    }
    errors
}

#[cfg(test)]
mod tests {
    use super::*;
    use rasray_reference::oracle::Outcome;
    use rasray_report::Bound;

    fn verdict(t: f64) -> Verdict {
        Verdict {
            outcome: Outcome::Hit { primitive: 0, t, barycentrics: [0.25; 2] },
            t_range: [t, t],
            ambiguous: false,
            miss_allowed: false,
            candidates: Vec::new(),
        }
    }

    #[test]
    fn an_error_lands_in_the_bin_of_its_size_and_misses_in_none() {
        let hit = |t| Some(DeviceHit { t, primitive: Some(0) });
        let verdicts: Vec<_> = [1.0, 1.0, 1.0, 1.0, 1.0, 0.1].map(verdict).into();
        let hits = [hit(1.0), hit(1.015_625), hit(1.0 + 1.0 / 8_388_608.0), hit(1.0e30), None, hit(0.1)];
        let errors = depth_errors(3, &verdicts, &hits);
        assert_eq!((errors.run, errors.zero, errors.bins.iter().sum::<u64>()), (3, 2, 3));
        // The errors are 10^-1.806 and 10^-6.924, in bins of a quarter decade from 10^-9, and one error
        // beyond the last bin.
        assert_eq!((errors.bins[28], errors.bins[8], errors.bins[39]), (1, 1, 1));
    }

    #[test]
    fn a_perturbed_hit_is_counted() {
        let verdicts = [verdict(2.0), verdict(3.0)];
        let right = [(2.0, 0), (3.0, 0)].map(|(t, primitive)| Hit { t, primitive, a: 0.0, b: 0.0 });
        let evaluate = |hits: &[Hit]| {
            accuracy(StructureKind::Primitive, &verdicts, &device_hits(hits.iter().copied()))
                .expect("a hit a verdict")
        };
        let clean = evaluate(&right);
        assert_eq!((clean.missed, clean.wrong_primitive, clean.dt_rel_max), (0, Some(0), Some(0.0)));
        let lost = Hit { primitive: rasray_ads::PRIMITIVE_NONE, ..right[0] };
        assert_eq!(evaluate(&[lost, right[1]]).missed, 1);
        let missed = evaluate(&[lost, right[1]]).rates["missed"];
        assert_eq!((missed.count, missed.of, missed.bound), (1, 2, Bound::ClopperPearson));
        assert!(!clean.rates.contains_key("false_hits") && clean.rates["missed"].bound == Bound::OneSided);
        assert_eq!(evaluate(&[Hit { primitive: 5, ..right[0] }, right[1]]).wrong_primitive, Some(1));
        assert_eq!(evaluate(&[Hit { t: 2.5, ..right[0] }, right[1]]).dt_rel_max, Some(0.25));
        assert_eq!(evaluate(&[Hit { t: f32::NAN, ..right[0] }, right[1]]).non_finite, 1);
    }
}
