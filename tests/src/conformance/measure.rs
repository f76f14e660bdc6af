use rasray_ads::{Hit, PRIMITIVE_UNKNOWN, Structure};
use rasray_metrics::{DeviceHit, HitConfusion, Percentiles, Rate, Truth};
use rasray_reference::oracle::Verdict;

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
    /// Of the ambiguous rays, the share that got an answer that is not admissible, give or take the tolerance in t.
    pub inadmissible: Rate,
    /// The first ambiguous ray with such an answer, by index.
    pub first_inadmissible: Option<usize>,
    /// The rays that count in [`Measured::judged`], by index.
    pub wrong: Vec<usize>,
    /// Rays whose answer a structure that finds triangles may not give, by index.
    pub rejected: Vec<usize>,
    /// Those of [`Measured::rejected`] that got a hit, with depths off by the tolerance allowed.
    pub rejected_hits: Vec<usize>,
    /// Rays that a stated answer says hit and that got no hit although a watertight test finds one.
    pub lost: usize,
    /// Unambiguous and ambiguous rays that are not judged: what they meet lies outside of what the camera sees.
    pub unseen: usize,
    /// |dt| / t of the hits on the right triangle.
    pub dt_right: Option<Percentiles>,
    /// The ray with the largest of these.
    pub farthest_off: Option<usize>,
}

/// A hit as the metrics know it; a miss is absent. Ids are the case's.
pub fn device_hit(prepared: &Prepared, hit: &Hit) -> Option<DeviceHit> {
    hit.is_hit().then(|| DeviceHit {
        t: hit.t,
        primitive: (hit.primitive != PRIMITIVE_UNKNOWN)
            .then(|| prepared.primitive(hit.primitive).unwrap_or(u32::MAX)),
    })
}

/// Builds and traces: what became of each ray, a miss being absent.
///
/// # Panics
/// If the device fails or rays do not finish.
pub fn answers(bench: &Bench, structure: &mut dyn Structure, prepared: &Prepared) -> Vec<Option<DeviceHit>> {
    structure.set_geometry(bench.device(), &prepared.geometry).expect("geometry is taken");
    let hits = bench.build_and_trace(structure, prepared.viewpoint, &prepared.rays);
    hits.iter().map(|hit| device_hit(prepared, hit)).collect()
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
    compare(prepared, &answers(bench, structure, prepared), depth_tolerance, rounding)
}

/// The first ray that two traces of the same rays answer otherwise, bit for bit.
pub fn first_other(expected: &[Option<DeviceHit>], found: &[Option<DeviceHit>]) -> Option<usize> {
    let bits = |hit: &Option<DeviceHit>| hit.map(|hit| (hit.t.to_bits(), hit.primitive));
    expected.iter().map(bits).zip(found.iter().map(bits)).position(|(expected, found)| expected != found)
}

/// Compares answers with the truth, as [`measure`] does with a structure's.
///
/// # Panics
/// If there are not as many answers as rays.
pub fn compare(
    prepared: &Prepared,
    hits: &[Option<DeviceHit>],
    depth_tolerance: f64,
    rounding: f64,
) -> Measured {
    let confusion =
        HitConfusion::measure(&prepared.verdicts, hits, depth_tolerance).expect("there is one hit a ray");
    let mut measured = Measured {
        confusion,
        errors: Rate::default(),
        inadmissible: Rate::default(),
        first_inadmissible: None,
        wrong: Vec::new(),
        rejected: Vec::new(),
        rejected_hits: Vec::new(),
        lost: 0,
        unseen: 0,
        dt_right: None,
        farthest_off: None,
    };
    let (mut dt_right, mut inadmissible) = (Vec::new(), Vec::new());
    let mut largest_dt = 0.0;
    for (index, (verdict, hit)) in prepared.verdicts.iter().zip(hits).enumerate() {
        if !prepared.case.accepts(index, verdict, *hit, rounding) {
            measured.rejected.push(index);
        }
        if hit.is_some() && !prepared.case.accepts(index, verdict, *hit, rounding.max(depth_tolerance)) {
            measured.rejected_hits.push(index);
        }
        let answer = prepared.case.answer(index);
        let must_hit = matches!(answer, Answer::Hit | Answer::HitAt { .. } | Answer::HitOn { .. });
        measured.lost += usize::from(must_hit && hit.is_none());
        if matches!(answer, Answer::Anything { .. }) {
            continue;
        }
        if prepared.is_unseen(index) {
            measured.unseen += 1;
            continue;
        }
        if verdict.is_ambiguous() {
            measured.inadmissible.total += 1;
            if !admissible(verdict, hit.as_ref(), depth_tolerance) {
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
                !(dt <= depth_tolerance || verdict.admits_hit(hit.primitive, f64::from(hit.t)))
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
    measured
}

impl Measured {
    /// The rate that laws bound: that of errors, or of inadmissible answers where every ray of a case is ambiguous
    /// (surfaces that coincide).
    pub fn judged(&self) -> Rate {
        if self.errors.total > 0 { self.errors } else { self.inadmissible }
    }
}

/// Whether an ambiguous ray may get this answer, on whatever triangle.
fn admissible(verdict: &Verdict, hit: Option<&DeviceHit>, depth_tolerance: f64) -> bool {
    hit.map_or(verdict.miss_allowed, |hit| {
        let (t, slack) = (f64::from(hit.t), depth_tolerance * f64::from(hit.t).abs());
        verdict.candidates.iter().any(|one| one.t_low - slack <= t && t <= one.t_high + slack)
    })
}
