use super::{Demand, Measured, Prepared, Row};

/// What of a measurement breaks the row's demand on this case; empty if nothing does.
pub fn judge(row: &Row, prepared: &Prepared, measured: &Measured) -> Vec<String> {
    let mut faults = Vec::new();
    let case = &prepared.case;
    let mut fault =
        |what: String| faults.push(format!("{} on {} ({}): {what}", row.name, case.id, case.title));
    if measured.confusion.non_finite.count > 0 {
        fault(format!("{} hits have a t that is no number", measured.confusion.non_finite.count));
    }
    let rate = measured.errors.value().unwrap_or(0.0);
    let deviation = row.deviations.iter().find(|deviation| deviation.case == case.id);
    if let Some(deviation) = deviation {
        if rate < deviation.at_least_rate {
            fault(format!(
                "passes unexpectedly: the error rate is {rate:.4}, and the deviation ({}) is at least {}; remove it",
                deviation.reason, deviation.at_least_rate
            ));
        }
        if rate > deviation.at_most_rate {
            fault(format!(
                "the error rate is {rate:.4}, more than the {} of the deviation ({})",
                deviation.at_most_rate, deviation.reason
            ));
        }
        return faults;
    }
    match row.demand {
        Demand::Exact { .. } => {
            if let Some(&first) = measured.rejected.first() {
                fault(format!(
                    "{} of {} rays get a wrong answer; the first: ray {first}, {:?}, the truth is {:?}; {:?}",
                    measured.rejected.len(),
                    case.rays.len(),
                    case.rays[first],
                    prepared.verdicts[first],
                    measured.confusion
                ));
            }
        }
        Demand::Law { resolution, per_cell, laws, .. } => {
            let law = laws.iter().find(|law| law.case == case.id);
            let limit = law.map_or(per_cell, |law| law.per_cell) / f64::from(resolution);
            if rate > limit {
                fault(format!("the error rate is {rate:.4}, more than {limit:.4}: {:?}", measured.confusion));
            }
        }
    }
    faults
}
