//! Numbers that a report leaves out.

/// JSON cannot say that a number is not finite, so such a number is absent.
pub(crate) fn absent(value: &Option<f64>) -> bool {
    !value.is_some_and(f64::is_finite)
}
