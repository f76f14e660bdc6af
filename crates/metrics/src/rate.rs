use crate::beta::inverse_incomplete_beta;

/// Count of an event in a number of trials.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Rate {
    /// Number of trials in which the event happened; at most `total`.
    pub count: u64,
    /// Number of trials.
    pub total: u64,
}

impl Rate {
    /// Returns `count / total`; `None` without trials.
    pub fn value(&self) -> Option<f64> {
        (self.total > 0).then(|| self.count as f64 / self.total as f64)
    }

    /// Returns the 95 % confidence interval of the true rate; `None` without trials.
    pub fn interval(&self) -> Option<[f64; 2]> {
        self.interval_at(0.95)
    }

    /// Returns the confidence interval of the true rate, for a confidence in (0, 1); `None` without trials or
    /// if the confidence is out of range.
    ///
    /// The interval is that of Clopper-Pearson, so the confidence is a lower bound for any rate. If the event
    /// never (or always) happened only one side can err, and the bound is -ln(1 - confidence) / total: 3 /
    /// total at 95 %.
    pub fn interval_at(&self, confidence: f64) -> Option<[f64; 2]> {
        if self.total == 0 || !(0.0 < confidence && confidence < 1.0) {
            return None;
        }
        let (count, total) = (self.count.min(self.total) as f64, self.total as f64);
        let one_sided = (-(1.0 - confidence).ln() / total).min(1.0);
        if self.count == 0 {
            return Some([0.0, one_sided]);
        }
        if self.count >= self.total {
            return Some([1.0 - one_sided, 1.0]);
        }
        let tail = 0.5 * (1.0 - confidence);
        Some([
            inverse_incomplete_beta(count, total - count + 1.0, tail),
            inverse_incomplete_beta(count + 1.0, total - count, 1.0 - tail),
        ])
    }

    /// True if the interval is the one-sided bound of a rate that never or always happened, 3 / total at 95
    /// %; false if it is that of Clopper-Pearson.
    pub fn is_one_sided(&self) -> bool {
        self.total > 0 && (self.count == 0 || self.count >= self.total)
    }

    /// True if the 95 % intervals of two rates do not overlap.
    pub fn differs_from(&self, other: &Self) -> bool {
        match (self.interval(), other.interval()) {
            (Some([low, high]), Some([other_low, other_high])) => high < other_low || other_high < low,
            _ => false,
        }
    }
}

/// Returns the confidence that each of `rates` intervals must have for all of them to hold together with
/// `family_confidence`: 1 - (1 - family_confidence) / rates (Bonferroni; independence is not needed). `None`
/// for no rates and for a confidence outside (0, 1).
pub fn confidence_of_each(family_confidence: f64, rates: u64) -> Option<f64> {
    let valid = rates > 0 && 0.0 < family_confidence && family_confidence < 1.0;
    valid.then(|| 1.0 - (1.0 - family_confidence) / rates as f64)
}

#[cfg(test)]
mod tests {
    use approx::assert_abs_diff_eq;

    use super::*;

    #[test]
    fn a_family_asks_more_of_each_rate() {
        assert_eq!(confidence_of_each(0.95, 1), Some(0.95));
        assert_abs_diff_eq!(confidence_of_each(0.95, 10).expect("valid"), 0.995, epsilon = 1e-12);
        assert_eq!(confidence_of_each(0.95, 0), None);
        assert_eq!(confidence_of_each(1.0, 3), None);
        let rate = Rate { count: 3, total: 100 };
        let [low, high] = rate.interval().expect("something was tried");
        let each = confidence_of_each(0.95, 10).expect("valid");
        let [wider_low, wider_high] = rate.interval_at(each).expect("something was tried");
        assert!(wider_low < low && high < wider_high);
    }

    #[test]
    fn tabulated_interval() {
        // The intervals are two-sided at 95 %, for 10 of 100, and for 1 of 10.
        let [low, high] = Rate { count: 10, total: 100 }.interval().expect("something was tried");
        assert!((low - 0.049_005).abs() < 1e-6 && (high - 0.176_222).abs() < 1e-6, "{low} {high}");
        let [low, high] = Rate { count: 1, total: 10 }.interval().expect("something was tried");
        assert!((low - 0.002_528_6).abs() < 1e-6 && (high - 0.445_016).abs() < 1e-6, "{low} {high}");
    }

    #[test]
    fn the_ends_satisfy_their_definition() {
        // The bounds satisfy P(X >= count
        // low) = 2.5 %, P(X <= count
        // high) = 2.5 %, summed directly.
        let rate = Rate { count: 3, total: 40 };
        let [low, high] = rate.interval().expect("something was tried");
        let at_most = |p: f64, k: u64| -> f64 {
            let mut term = (1.0 - p).powi(40);
            let mut sum = term;
            for i in 1..=k {
                term *= (41 - i) as f64 / i as f64 * p / (1.0 - p);
                sum += term;
            }
            sum
        };
        assert_abs_diff_eq!(at_most(high, 3), 0.025, epsilon = 1e-9);
        assert_abs_diff_eq!(1.0 - at_most(low, 2), 0.025, epsilon = 1e-9);
    }

    #[test]
    fn never_and_always() {
        let [low, high] = Rate { count: 0, total: 150_000 }.interval().expect("something was tried");
        assert_eq!(low, 0.0);
        assert_abs_diff_eq!(high, 2e-5, epsilon = 1e-7);
        assert_eq!(Rate { count: 0, total: 2 }.interval(), Some([0.0, 1.0]));
        let [low, high] = Rate { count: 1000, total: 1000 }.interval().expect("something was tried");
        assert!((low - 0.997).abs() < 1e-5 && high == 1.0);
        assert!(Rate { count: 0, total: 2 }.is_one_sided() && Rate { count: 2, total: 2 }.is_one_sided());
        assert!(!Rate { count: 1, total: 2 }.is_one_sided() && !Rate::default().is_one_sided());
        assert_eq!(Rate::default().interval(), None);
        assert_eq!(Rate { count: 1, total: 2 }.interval_at(1.0), None);
    }

    #[test]
    fn intervals_tell_rates_apart_only_when_they_can() {
        let few = Rate { count: 3, total: 100 };
        let many = Rate { count: 300, total: 10_000 };
        assert!(!few.differs_from(&many));
        assert!(many.differs_from(&Rate { count: 450, total: 10_000 }));
        assert!(!few.differs_from(&Rate { count: 5, total: 100 }));
        assert!(Rate { count: 10_000, total: 10_000_000 }.differs_from(&many));
    }
}
