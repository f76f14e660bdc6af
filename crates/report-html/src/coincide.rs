//! Curves that coincide, drawn so that each is visible.

/// Heights of a curve at each place, in shares of the axis; absent where the curve has no height.
pub(super) type Curve = Vec<Option<f64>>;

/// Largest difference, in shares of the axis, at which heights look like one line.
const CLOSE: f64 = 0.015;

/// Largest number of curves for which a line below them is widened.
const MOST: usize = 4;

fn coincide(a: &Curve, b: &Curve) -> bool {
    let close = |(a, b): (&Option<f64>, &Option<f64>)| match (a, b) {
        (Some(a), Some(b)) => (a - b).abs() <= CLOSE,
        (a, b) => a.is_none() && b.is_none(),
    };
    a.len() == b.len() && a.iter().zip(b).all(close)
}

/// Returns for each curve the number of later curves that cover it. A covered curve is drawn wider by that
/// number, so that it is visible on both sides of the later ones.
pub(super) fn covered(curves: &[Curve]) -> Vec<usize> {
    let later =
        |index: usize| curves[index + 1..].iter().filter(|other| coincide(&curves[index], other)).count();
    (0..curves.len()).map(|index| later(index).min(MOST)).collect()
}

/// Writes a sentence for each group of curves that coincide, by their names; empty if no curves coincide.
pub(super) fn sentence(curves: &[Curve], names: &[String]) -> String {
    let mut told: Vec<usize> = Vec::new();
    let mut sentences = Vec::new();
    for index in 0..curves.len() {
        let is_of = |other: &usize| !told.contains(other) && coincide(&curves[index], &curves[*other]);
        let group: Vec<usize> = (index..curves.len()).filter(is_of).collect();
        if group.len() > 1 && group[0] == index {
            let names: Vec<&str> = group.iter().map(|one| names[*one].as_str()).collect();
            sentences.push(format!("One line, the narrower on the wider: {}.", names.join(", ")));
            told.extend(group);
        }
    }
    sentences.join(" ")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_line_is_as_wide_as_others_lie_on_it() {
        let at = |height: f64| vec![Some(height), Some(0.5)];
        let curves = [at(0.1), at(0.9), at(0.105), at(0.1), vec![None, Some(0.5)], at(0.9)];
        assert_eq!(covered(&curves), [2, 1, 1, 0, 0, 0]);
        let names: Vec<String> = "abcdef".chars().map(String::from).collect();
        assert_eq!(
            sentence(&curves, &names),
            "One line, the narrower on the wider: a, c, d. One line, the narrower on the wider: b, f."
        );
        assert_eq!((covered(&curves[3..5]), sentence(&curves[3..5], &names)), (vec![0, 0], String::new()));
    }
}
