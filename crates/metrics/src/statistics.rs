//! Medians and percentiles: errors and times have heavy tails that distort means.

/// Returns a percentile by linear interpolation between order statistics; `fraction` in [0, 1]. NaN values
/// are left out; `None` if no value is left.
pub fn percentile(values: &[f64], fraction: f64) -> Option<f64> {
    percentile_of_sorted(&sorted(values), fraction)
}

/// Returns the middle value, or the mean of the middle two. NaN values are left out.
pub fn median(values: &[f64]) -> Option<f64> {
    percentile(values, 0.5)
}

/// Returns the median of the means of `groups` runs of neighbours: a mean that a few outliers cannot move.
/// NaN values are left out; fewer values than groups make one group each.
pub fn median_of_means(values: &[f64], groups: usize) -> Option<f64> {
    let values: Vec<f64> = values.iter().copied().filter(|x| !x.is_nan()).collect();
    let groups = groups.clamp(1, values.len().max(1));
    let means: Vec<f64> = (0..groups)
        .map(|group| &values[group * values.len() / groups..(group + 1) * values.len() / groups])
        .filter(|run| !run.is_empty())
        .map(|run| run.iter().sum::<f64>() / run.len() as f64)
        .collect();
    median(&means)
}

fn sorted(values: &[f64]) -> Vec<f64> {
    let mut values: Vec<f64> = values.iter().copied().filter(|x| !x.is_nan()).collect();
    values.sort_unstable_by(f64::total_cmp);
    values
}

fn percentile_of_sorted(sorted: &[f64], fraction: f64) -> Option<f64> {
    let last = sorted.len().checked_sub(1)?;
    let place = fraction.clamp(0.0, 1.0) * last as f64;
    let below = place.floor() as usize;
    let (low, high) = (sorted[below], sorted[(below + 1).min(last)]);
    let part = place - below as f64;
    // The case without interpolation is separate: infinite values must not turn into NaN.
    Some(if part == 0.0 || low == high { low } else { low + part * (high - low) })
}

/// Tail of a distribution of errors.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Percentiles {
    /// Number of values, without NaN.
    pub count: usize,
    /// Median.
    pub p50: f64,
    /// 90th percentile.
    pub p90: f64,
    /// 99th percentile.
    pub p99: f64,
    /// 99.9th percentile.
    pub p999: f64,
    /// Greatest value.
    pub max: f64,
}

impl Percentiles {
    /// Computes the percentiles; `None` if no value is left after NaN values are left out.
    pub fn of(values: &[f64]) -> Option<Self> {
        let sorted = sorted(values);
        let at = |fraction| percentile_of_sorted(&sorted, fraction);
        Some(Self {
            count: sorted.len(),
            p50: at(0.5)?,
            p90: at(0.9)?,
            p99: at(0.99)?,
            p999: at(0.999)?,
            max: at(1.0)?,
        })
    }
}

/// Summary of a measured series, such as the times of a pass.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Summary {
    /// Number of values, without NaN.
    pub count: usize,
    /// Middle value.
    pub median: f64,
    /// First quartile: a quarter of the values is at most this, interpolated as by [`percentile`].
    pub first_quartile: f64,
    /// Third quartile; the interquartile range lies between the two.
    pub third_quartile: f64,
    /// Median distance from the median. (1.4826 times it estimates a normal distribution's sigma.)
    pub median_deviation: f64,
    /// Least value.
    pub min: f64,
    /// Greatest value.
    pub max: f64,
}

impl Summary {
    /// Computes the summary; `None` if no value is left after NaN values are left out.
    pub fn of(values: &[f64]) -> Option<Self> {
        let sorted_values = sorted(values);
        let median = percentile_of_sorted(&sorted_values, 0.5)?;
        let distances: Vec<f64> = sorted_values.iter().map(|x| (x - median).abs()).collect();
        Some(Self {
            count: sorted_values.len(),
            median,
            first_quartile: percentile_of_sorted(&sorted_values, 0.25)?,
            third_quartile: percentile_of_sorted(&sorted_values, 0.75)?,
            median_deviation: percentile(&distances, 0.5).unwrap_or(0.0),
            min: *sorted_values.first()?,
            max: *sorted_values.last()?,
        })
    }
}

#[cfg(test)]
mod tests {
    use approx::assert_abs_diff_eq;

    use super::*;

    #[test]
    fn percentiles_of_a_ramp() {
        let ramp: Vec<f64> = (0..=100).rev().map(f64::from).collect();
        let p = Percentiles::of(&ramp).expect("not empty");
        assert_eq!((p.count, p.p50, p.p90, p.p99, p.max), (101, 50.0, 90.0, 99.0, 100.0));
        assert_abs_diff_eq!(p.p999, 99.9, epsilon = 1e-9);
        let summary = Summary::of(&ramp).expect("not empty");
        assert_eq!((summary.first_quartile, summary.third_quartile), (25.0, 75.0));
        // One value beyond the rest moves the tail, but none of the quartiles.
        let mut tailed = ramp.clone();
        tailed[0] = 1e9;
        let moved = Percentiles::of(&tailed).expect("not empty");
        assert!(moved.p999 > 1e8 && moved.p99 == 99.0, "{moved:?}");
        assert_eq!(Summary::of(&tailed).expect("not empty").third_quartile, 75.0);
        assert_eq!(percentile(&[1.0, 2.0], 0.25), Some(1.25));
        assert_eq!(percentile(&[1.0, f64::INFINITY, f64::INFINITY], 0.75), Some(f64::INFINITY));
        assert_eq!(Percentiles::of(&[f64::NAN]), None);
    }

    #[test]
    fn one_outlier_moves_the_mean_and_not_the_median() {
        let mut values = vec![1.0; 160];
        values[7] = 1e6;
        let summary = Summary::of(&values).expect("not empty");
        assert_eq!((summary.median, summary.median_deviation, summary.max), (1.0, 0.0, 1e6));
        assert_eq!(median_of_means(&values, 16), Some(1.0));
        assert!(median_of_means(&values, 1).is_some_and(|mean| mean > 6000.0));
        assert_eq!(median_of_means(&[], 16), None);
    }

    #[test]
    fn a_shift_is_seen() {
        let values: Vec<f64> = (0..50).map(|i| f64::from(i % 7)).collect();
        let shifted: Vec<f64> = values.iter().map(|x| x + 0.25).collect();
        let [a, b] = [&values, &shifted].map(|v| Summary::of(v).expect("not empty"));
        assert_eq!(b.median - a.median, 0.25);
        assert_eq!(a.median_deviation, b.median_deviation);
    }
}
