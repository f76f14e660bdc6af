//! Axes that the plots share. The page's script sets the colours of text and grid.

use serde_json::{Value, json};

/// Returns the decimal exponents of the smallest and the largest positive value.
fn exponents(values: impl Iterator<Item = f64>) -> Option<(f64, f64)> {
    let (low, high) = values
        .filter(|value| *value > 0.0 && value.is_finite())
        .map(f64::log10)
        .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), value| (low.min(value), high.max(value)));
    (low <= high).then_some((low, high))
}

/// Makes a logarithmic axis over whole decades around the positive values.
pub(super) fn decades(title: &str, values: impl Iterator<Item = f64>) -> Value {
    let (low, high) = exponents(values).map_or((-1.0, 0.0), |(low, high)| (low.floor(), high.ceil()));
    let high = high.max(low + 1.0);
    // The step is great enough for labels to stay apart on a phone.
    let step = ((high - low) / 8.0).ceil();
    json!({
        "type": "log", "title": {"text": title}, "range": [low - 0.15, high + 0.15],
        "dtick": step, "exponentformat": "power", "automargin": true,
    })
}

/// Makes a logarithmic axis that ends where the values end, with labels at powers of ten, and at 2 and 5
/// between them where there are few powers.
pub(super) fn close_log(title: &str, values: impl Iterator<Item = f64>) -> Value {
    let (low, high) = exponents(values).map_or((-0.2, 1.2), |(low, high)| (low - 0.2, high + 0.2));
    let mut axis = json!({
        "type": "log", "title": {"text": title}, "range": [low, high],
        "exponentformat": "none", "automargin": true,
    });
    if high - low > 2.9 {
        axis["dtick"] = json!(1);
    } else if high - low > 1.3 {
        axis["dtick"] = json!("D2");
    } else {
        // There are so few labels that each is written out: a 5 alone does not tell its power of ten.
        let ticks = STEPS.map(|steps| {
            let powers = (low.floor() as i32..=high.floor() as i32).map(|power| 10_f64.powi(power));
            let ticks = powers.flat_map(|power| steps.iter().map(move |step| step * power));
            ticks.filter(|tick| (low..=high).contains(&tick.log10())).collect::<Vec<f64>>()
        });
        let [few, more] = &ticks;
        axis["tickvals"] = json!(if few.len() < LEAST_TICKS { more } else { few });
    }
    axis
}

/// Least number of labels that make a logarithmic axis readable: two labels do not tell the values between
/// them.
const LEAST_TICKS: usize = 3;

/// Labels of a short logarithmic axis, in parts of a power of ten. The coarser set is used where it has
/// enough labels.
const STEPS: [&[f64]; 2] = [&[1.0, 2.0, 5.0], &[1.0, 1.5, 2.0, 2.5, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0, 9.0]];

/// Makes a linear axis from zero.
pub(super) fn linear(title: &str) -> Value {
    json!({"title": {"text": title}, "rangemode": "tozero", "automargin": true})
}

/// Makes a linear axis with a margin below zero, so that symbols at zero are drawn whole.
pub(super) fn around_zero(title: &str, values: impl Iterator<Item = f64>) -> Value {
    let most = values.filter(|value| value.is_finite()).fold(0.0, f64::max);
    let most = if most > 0.0 { most } else { 1.0 };
    json!({"title": {"text": title}, "range": [-0.06 * most, 1.1 * most], "automargin": true})
}

/// Returns the values at the two ends of an axis that has a range.
pub(super) fn ends(axis: &Value) -> Option<[f64; 2]> {
    let end = |index: usize| {
        let value = axis["range"][index].as_f64()?;
        Some(if axis["type"] == "log" { 10_f64.powf(value) } else { value })
    };
    Some([end(0)?, end(1)?])
}

/// Makes an axis of names in this order, the first at the top.
pub(super) fn names(names: impl Iterator<Item = String>) -> Value {
    json!({
        "autorange": "reversed", "automargin": true, "type": "category",
        "categoryorder": "array", "categoryarray": names.collect::<Vec<_>>(),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn decades_are_whole_and_never_none() {
        let axis = decades("t", [2.0e-6, 3.0e-4, 0.0, f64::NAN].into_iter());
        assert_eq!(axis["range"], json!([-6.15, -2.85]));
        assert_eq!(decades("t", [1.0].into_iter())["range"], json!([-0.15, 1.15]));
        assert_eq!(decades("t", [].into_iter())["range"], json!([-1.15, 0.15]));
    }

    #[test]
    fn the_few_labels_of_a_short_axis_are_written_out() {
        let axis = close_log("t", [3500.0, 9500.0].into_iter());
        assert_eq!(
            axis["tickvals"],
            json!([2500.0, 3000.0, 4000.0, 5000.0, 6000.0, 7000.0, 8000.0, 9000.0, 10000.0, 15000.0])
        );
        // A single run fits on the axis, whatever its value.
        for tenth in 0..30 {
            let axis = close_log("t", [10_f64.powf(f64::from(tenth) / 10.0)].into_iter());
            let count = axis["tickvals"].as_array().map_or(0, Vec::len);
            assert!((LEAST_TICKS..=11).contains(&count), "{tenth}: {axis}");
        }
        let axis = close_log("t", [0.011, 0.82].into_iter());
        assert_eq!((&axis["tickvals"], &axis["dtick"]), (&Value::Null, &json!("D2")));
        assert_eq!(close_log("t", [0.01, 9.0].into_iter())["dtick"], json!(1));
    }

    #[test]
    fn ends_are_in_the_units_of_the_values() {
        let [low, high] = ends(&close_log("t", [0.1, 10.0].into_iter())).expect("a range");
        assert!(low < 0.1 && low > 0.05 && high > 10.0 && high < 20.0, "{low} {high}");
        assert_eq!(ends(&around_zero("t", [0.0, 2.0].into_iter())), Some([-0.12, 2.2]));
        assert_eq!(ends(&linear("t")), None);
    }
}
