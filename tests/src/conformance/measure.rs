use rasray_ads::{Hit, PRIMITIVE_UNKNOWN, Structure};
use rasray_metrics::{DeviceHit, HitConfusion, Percentiles, Rate, Truth};

use super::Prepared;
use crate::hard_cases::Answer;
use crate::harness::Bench;

/// How one structure fared on one case.
#[derive(Clone, Debug)]
pub struct Measured {
    /// Against the oracle; wrong ids are forgiven where t is right to the tolerance.
    pub confusion: HitConfusion,
    /// Of the unambiguous rays, the share that was missed, false, or wrong in t beyond the tolerance.
    pub errors: Rate,
    /// Rays whose answer a structure that finds triangles may not give, by index.
    pub rejected: Vec<usize>,
    /// Rays that a stated answer says hit and that got no hit although a watertight test finds one.
    pub lost: usize,
    /// |dt| / t of the hits on the right triangle.
    pub dt_right: Option<Percentiles>,
}

/// A hit as the metrics know it; a miss is absent. Ids are the case's.
pub fn device_hit(prepared: &Prepared, hit: &Hit) -> Option<DeviceHit> {
    hit.is_hit().then(|| DeviceHit {
        t: hit.t,
        primitive: (hit.primitive != PRIMITIVE_UNKNOWN)
            .then(|| prepared.primitive(hit.primitive).unwrap_or(u32::MAX)),
    })
}

/// Builds, traces and compares. `depth_tolerance` is the |dt| / t up to which a depth counts as right
/// for [`Measured::errors`]; `rounding` is that of [`Measured::rejected`], beyond the oracle's own bounds.
///
/// # Panics
/// If the device fails or rays do not finish.
pub fn measure(
    bench: &Bench,
    structure: &mut dyn Structure,
    prepared: &Prepared,
    depth_tolerance: f64,
    rounding: f64,
) -> Measured {
    structure.set_geometry(bench.device(), &prepared.geometry).expect("geometry is taken");
    let hits = bench.build_and_trace(structure, prepared.case.eye, &prepared.rays);
    let hits: Vec<_> = hits.iter().map(|hit| device_hit(prepared, hit)).collect();
    compare(prepared, &hits, depth_tolerance, rounding)
}

/// Compares answers with the truth.
pub(super) fn compare(
    prepared: &Prepared,
    hits: &[Option<DeviceHit>],
    depth_tolerance: f64,
    rounding: f64,
) -> Measured {
    let confusion =
        HitConfusion::measure(&prepared.verdicts, hits, depth_tolerance).expect("there is one hit a ray");
    let mut measured =
        Measured { confusion, errors: Rate::default(), rejected: Vec::new(), lost: 0, dt_right: None };
    let mut dt_right = Vec::new();
    for (index, (verdict, hit)) in prepared.verdicts.iter().zip(hits).enumerate() {
        if !prepared.case.accepts(index, verdict, *hit, rounding) {
            measured.rejected.push(index);
        }
        let answer = prepared.case.answer(index);
        let must_hit = matches!(answer, Answer::Hit | Answer::HitAt { .. } | Answer::HitOn { .. });
        measured.lost += usize::from(must_hit && hit.is_none());
        if verdict.is_ambiguous() || matches!(answer, Answer::Anything { .. }) {
            continue;
        }
        measured.errors.total += 1;
        let wrong = match (verdict.hit(), hit) {
            (None, None) => false,
            (Some((primitive, t)), Some(hit)) => {
                let dt = (f64::from(hit.t) - t).abs() / t.abs();
                if hit.primitive == Some(primitive) {
                    dt_right.push(dt);
                }
                // Written so that NaN is wrong.
                !(dt <= depth_tolerance || verdict.admits_hit(hit.primitive, f64::from(hit.t)))
            }
            _ => true,
        };
        measured.errors.count += u64::from(wrong);
    }
    measured.dt_right = Percentiles::of(&dt_right);
    measured
}
