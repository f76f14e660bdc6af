//! Positions relative to a pivot, which keeps single precision.

use glam::DVec3;

/// Returns a position relative to a pivot, rounded once.
pub fn relative(position: &[f32; 3], pivot: DVec3) -> [f32; 3] {
    (DVec3::from(position.map(f64::from)) - pivot).as_vec3().to_array()
}

/// Returns the centre of the box around positions, metres; zero if there are none.
pub fn centre<'a>(lists: impl IntoIterator<Item = &'a [[f32; 3]]>) -> DVec3 {
    let (mut lower, mut upper) = (DVec3::INFINITY, DVec3::NEG_INFINITY);
    for position in lists.into_iter().flatten() {
        let position = DVec3::from(position.map(f64::from));
        (lower, upper) = (lower.min(position), upper.max(position));
    }
    let centre = 0.5 * (lower + upper);
    if centre.is_finite() { centre } else { DVec3::ZERO }
}
