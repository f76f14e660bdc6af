//! Incomplete beta function, on which the confidence intervals are based.

/// Returns ln of the gamma function for x > 0; absolute error about 1e-14 times the result.
fn ln_gamma(x: f64) -> f64 {
    // Stirling's series is accurate from 12 on; the recurrence leads smaller numbers there.
    let (mut x, mut shift) = (x, 0.0);
    while x < 12.0 {
        shift -= x.ln();
        x += 1.0;
    }
    let square = 1.0 / (x * x);
    let series = (1.0 / 12.0
        - square * (1.0 / 360.0 - square * (1.0 / 1260.0 - square * (1.0 / 1680.0 - square / 1188.0))))
        / x;
    shift + (x - 0.5) * x.ln() - x + 0.5 * (2.0 * std::f64::consts::PI).ln() + series
}

/// Returns the regularised incomplete beta function I_x(a, b) for a, b > 0 and x in [0, 1]: the probability
/// that a variable with that beta distribution is at most x.
pub(crate) fn incomplete_beta(a: f64, b: f64, x: f64) -> f64 {
    if x <= 0.0 {
        return 0.0;
    }
    if x >= 1.0 {
        return 1.0;
    }
    // The continued fraction converges quickly on this side of the mean only.
    if x > (a + 1.0) / (a + b + 2.0) {
        return 1.0 - incomplete_beta_fraction(b, a, 1.0 - x);
    }
    incomplete_beta_fraction(a, b, x)
}

fn incomplete_beta_fraction(a: f64, b: f64, x: f64) -> f64 {
    let ln_front = ln_gamma(a + b) - ln_gamma(a) - ln_gamma(b) + a * x.ln() + b * (-x).ln_1p();
    // The fraction is evaluated front to back (modified Lentz); TINY replaces a vanishing denominator.
    const TINY: f64 = 1e-300;
    let guard = |value: f64| if value.abs() < TINY { TINY } else { value };
    let mut numerator = 1.0;
    let mut denominator = 1.0 / guard(1.0 - (a + b) * x / (a + 1.0));
    let mut fraction = denominator;
    for step in 1..100_000_u32 {
        let m = f64::from(step);
        let even = m * (b - m) * x / ((a + 2.0 * m - 1.0) * (a + 2.0 * m));
        let odd = -(a + m) * (a + b + m) * x / ((a + 2.0 * m) * (a + 2.0 * m + 1.0));
        let mut change = 1.0;
        for term in [even, odd] {
            denominator = 1.0 / guard(1.0 + term * denominator);
            numerator = guard(1.0 + term / numerator);
            change = numerator * denominator;
            fraction *= change;
        }
        if (change - 1.0).abs() < 1e-15 {
            break;
        }
    }
    (ln_front.exp() * fraction / a).clamp(0.0, 1.0)
}

/// Returns the x with I_x(a, b) = probability.
pub(crate) fn inverse_incomplete_beta(a: f64, b: f64, probability: f64) -> f64 {
    let (mut low, mut high) = (0.0_f64, 1.0_f64);
    // The bisection goes to the last bit, so that small rates keep their relative precision.
    for _ in 0..200 {
        let middle = 0.5 * (low + high);
        if middle <= low || middle >= high {
            break;
        }
        if incomplete_beta(a, b, middle) < probability {
            low = middle;
        } else {
            high = middle;
        }
    }
    0.5 * (low + high)
}

#[cfg(test)]
mod tests {
    use approx::assert_abs_diff_eq;

    use super::*;

    #[test]
    fn ln_gamma_of_integers_and_halves() {
        let mut factorial: f64 = 1.0;
        for n in 1..30 {
            assert_abs_diff_eq!(
                ln_gamma(f64::from(n)),
                factorial.ln(),
                epsilon = 1e-13 * (1.0 + factorial.ln())
            );
            factorial *= f64::from(n);
        }
        assert_abs_diff_eq!(ln_gamma(0.5), 0.5 * std::f64::consts::PI.ln(), epsilon = 1e-13);
    }

    #[test]
    fn closed_forms() {
        for x in [0.01, 0.2, 0.5, 0.77, 0.99] {
            // The closed forms are I_x(a, 1) = x^a, I_x(1, b) = 1 - (1-x)^b, I_x(2, 2) = x^2 (3 - 2x),
            // arcsine law.
            assert_abs_diff_eq!(incomplete_beta(3.5, 1.0, x), x.powf(3.5), epsilon = 1e-13);
            assert_abs_diff_eq!(incomplete_beta(1.0, 7.0, x), (1.0 - (1.0 - x).powi(7)), epsilon = 1e-13);
            assert_abs_diff_eq!(incomplete_beta(2.0, 2.0, x), x * x * (3.0 - 2.0 * x), epsilon = 1e-13);
            let arcsine = 2.0 / std::f64::consts::PI * x.sqrt().asin();
            assert_abs_diff_eq!(incomplete_beta(0.5, 0.5, x), arcsine, epsilon = 1e-12);
        }
    }

    #[test]
    fn inverse_undoes() {
        for (a, b) in [(1.0, 50.0), (12.0, 3.0), (400.0, 100_000.0)] {
            for p in [0.025, 0.5, 0.975] {
                let x = inverse_incomplete_beta(a, b, p);
                assert_abs_diff_eq!(incomplete_beta(a, b, x), p, epsilon = 1e-9);
            }
        }
    }
}
