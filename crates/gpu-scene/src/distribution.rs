//! Cumulative shares of weights, by which lights and texels are chosen.

/// Returns the luminance of linear Rec. 709, the weight by which light is chosen. Negative and non-finite
/// channels count as 0.
pub fn luminance(rgb: [f32; 3]) -> f64 {
    let channel = |x: f32| if x.is_finite() { f64::from(x).max(0.0) } else { 0.0 };
    0.2126 * channel(rgb[0]) + 0.7152 * channel(rgb[1]) + 0.0722 * channel(rgb[2])
}

/// Turns weights (finite, not negative) into cumulative shares rounded to f32: summed in f64 in
/// order, exactly 1 from the last weight above zero on. Returns the sum and the shares; all shares
/// are 1 where the sum is 0.
pub fn cumulative_shares(weights: &[f64]) -> (f64, Vec<f32>) {
    let total: f64 = weights.iter().sum();
    let last = weights.iter().rposition(|&weight| weight > 0.0);
    let Some(last) = last.filter(|_| total > 0.0) else { return (0.0, vec![1.0; weights.len()]) };
    let mut sum = 0.0;
    let shares = weights
        .iter()
        .enumerate()
        .map(|(index, weight)| {
            sum += weight;
            if index >= last { 1.0 } else { (sum / total) as f32 }
        })
        .collect();
    (total, shares)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shares_grow_to_one_at_the_last_weight() {
        let (total, shares) = cumulative_shares(&[1.0, 0.0, 3.0, 0.0]);
        assert_eq!(total, 4.0);
        assert_eq!(shares, [0.25, 0.25, 1.0, 1.0]);
        let many = vec![0.1; 1000];
        let (_, shares) = cumulative_shares(&many);
        assert!(shares.windows(2).all(|pair| pair[0] <= pair[1]));
        assert_eq!(shares.last(), Some(&1.0));
    }

    #[test]
    fn nothing_to_choose_is_not_a_division_by_zero() {
        assert_eq!(cumulative_shares(&[0.0, 0.0]), (0.0, vec![1.0, 1.0]));
        assert_eq!(cumulative_shares(&[]), (0.0, vec![]));
        assert_eq!(luminance([f32::NAN, -1.0, f32::INFINITY]), 0.0);
    }
}
