use rasray_metrics::Rate;

use super::{Demand, Measured, Prepared, Row, comparisons, deviations_ambiguous};
use crate::hard_cases::Target;

/// Probability that any evaluation of any row on any case is wrong although every law and every deviation
/// holds. Each comparison gets an equal share of it (Bonferroni).
pub const FALSE_ALARM: f64 = 1e-6;

/// Returns the confidence of the interval (Clopper-Pearson) of a measured rate, chosen so that a comparison
/// with one end of the interval is wrong with at most its share of [`FALSE_ALARM`].
pub fn confidence() -> f64 {
    1.0 - FALSE_ALARM / comparisons() as f64
}

/// Returns the faults of a measurement against the row's demand on this case; empty if there are none.
///
/// Rates are known up to their interval at [`confidence`]: a limit is broken if the whole interval lies
/// beyond it. Exact rows have no such tolerance: one wrong answer is a fault.
pub fn evaluate(row: &Row, prepared: &Prepared, measured: &Measured) -> Vec<String> {
    let mut faults = Vec::new();
    let case = &prepared.case;
    let mut fault = |what: String, ray: Option<usize>| {
        let replay = ray.map_or_else(String::new, |ray| {
            let command = row.replay_command(case.id, case.scale.seed, ray);
            // A ray depends on the seed and its index, and also aims at the meshes of the tier.
            let meshes = if case.scale.full { " --full" } else { "" };
            format!("\n    replay: {command}{meshes}")
        });
        faults.push(format!("{} on {} ({}): {what}{replay}", row.name, case.id, case.title));
    };
    if measured.confusion.non_finite.count > 0 {
        let what = format!("{} hits have a t that is no number", measured.confusion.non_finite.count);
        fault(what, measured.rejected.first().copied());
    }
    if let (true, Some(limit), Some(dt)) = (row.is_exact(), case.largest_dt, measured.dt_right)
        && dt.max > limit
    {
        fault(format!("|dt| / t is {:.1e}: more than {limit:.1e}", dt.max), measured.farthest_off);
    }
    // Things without area, and rays without direction, have no samples either.
    if matches!(row.demand, Demand::Law { .. })
        && case.target.fragments == Target::Exact
        && let Some(&first) = measured.rejected_hits.first()
    {
        let what =
            format!("{} hits are wrong where nothing may be hit wrongly", measured.rejected_hits.len());
        fault(what, Some(first));
    }
    if matches!(row.demand, Demand::Law { .. }) && case.target.fragments == Target::Counted {
        return faults;
    }
    let deviation = row.deviations.iter().find(|deviation| deviation.case == case.id);
    // A case whose rays are all ambiguous is evaluated by its ambiguous rays alone, below.
    if !row.is_exact() && measured.errors.total > 0 && measured.inadmissible.total > 0 {
        let limit = deviation.map_or_else(|| row.largest_rate(case.id), |deviation| deviation.at_most_rate);
        let ([least, most], reason) = deviations_ambiguous::bounds(row.name, case.id, limit);
        let [low, high] = measured.inadmissible.interval_at(confidence()).unwrap_or([0.0, 1.0]);
        let Rate { count, total } = measured.inadmissible;
        if low > most || high < least {
            let what = format!(
                "of ambiguous rays {count} of {total} get an inadmissible answer, between {low:.4} and {high:.4}, which is not within {least:.4} to {most:.4} ({reason})"
            );
            fault(what, measured.first_inadmissible);
        }
    }
    let evaluated = measured.evaluated();
    let rate = evaluated.value().unwrap_or(0.0);
    let [low, high] = evaluated.interval_at(confidence()).unwrap_or([0.0, 1.0]);
    let first_wrong = measured.wrong.first().copied();
    if let Some(deviation) = deviation.filter(|_| !row.is_exact()) {
        if high < deviation.at_least_rate {
            let what = format!(
                "passes unexpectedly: the error rate is {rate:.4}, at most {high:.4}, and the deviation ({}) is at least {}; remove it",
                deviation.reason, deviation.at_least_rate
            );
            fault(what, None);
        }
        if low > deviation.at_most_rate {
            let what = format!(
                "the error rate is {rate:.4}, at least {low:.4}: more than the {} of the deviation ({})",
                deviation.at_most_rate, deviation.reason
            );
            fault(what, first_wrong);
        }
        return faults;
    }
    if row.is_exact() {
        if let Some(deviation) = deviation {
            let what =
                format!("a row that finds triangles may not deviate ({}); repair it", deviation.reason);
            fault(what, None);
        }
        if let Some(&first) = measured.rejected.first() {
            let what = format!(
                "{} of {} rays get a wrong answer; the first: ray {first}, {:?}, the truth is {:?}; {:?}",
                measured.rejected.len(),
                case.rays.len(),
                case.rays[first],
                prepared.verdicts[first],
                measured.confusion
            );
            fault(what, Some(first));
        }
        return faults;
    }
    let limit = row.largest_rate(case.id);
    if low > limit {
        let what = format!(
            "the error rate is {rate:.4}, at least {low:.4}: more than {limit:.4}: {:?}",
            measured.confusion
        );
        fault(what, first_wrong);
    }
    faults
}
