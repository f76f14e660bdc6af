//! Scales of colours for numbers, in the maps of pages and of the viewer.

/// Scale of colours from dark to light, perceptually uniform and readable without colour: stops at equal
/// distances, linear in sRGB between them.
pub type Scale = [[u8; 3]];

/// Scale from dark blue over green to yellow: stops of viridis, for counts.
pub const VIRIDIS: &Scale = &[
    [0x44, 0x01, 0x54],
    [0x48, 0x28, 0x78],
    [0x3e, 0x49, 0x89],
    [0x31, 0x68, 0x8e],
    [0x26, 0x82, 0x8e],
    [0x1f, 0x9e, 0x89],
    [0x35, 0xb7, 0x79],
    [0x6e, 0xce, 0x58],
    [0xb5, 0xde, 0x2b],
    [0xfd, 0xe7, 0x25],
];

/// Scale from black over purple to pale yellow: stops of magma, as is usual for FLIP.
pub const MAGMA: &Scale = &[
    [0x00, 0x00, 0x04],
    [0x18, 0x0f, 0x3d],
    [0x44, 0x0f, 0x76],
    [0x72, 0x1f, 0x81],
    [0x9e, 0x2f, 0x7f],
    [0xcd, 0x40, 0x71],
    [0xf1, 0x60, 0x5d],
    [0xfd, 0x96, 0x68],
    [0xfe, 0xca, 0x8d],
    [0xfc, 0xfd, 0xbf],
];

/// Returns the colour of `value` in [0, 1]; values outside take the nearest end, not-a-number the dark end.
pub fn colour(scale: &Scale, value: f64) -> [u8; 3] {
    let last = scale.len() - 1;
    let place = if value.is_nan() { 0.0 } else { value.clamp(0.0, 1.0) * last as f64 };
    let below = (place as usize).min(last - 1);
    let part = place - below as f64;
    std::array::from_fn(|channel| {
        let (low, high) = (f64::from(scale[below][channel]), f64::from(scale[below + 1][channel]));
        (low + part * (high - low)).round() as u8
    })
}

/// Returns the place of `count`, in [0, 1], on a scale that ends at `most`: logarithmic, and 0 at 0.
pub fn place(count: u32, most: u32) -> f64 {
    if most == 0 { 0.0 } else { f64::from(count).ln_1p() / f64::from(most).ln_1p() }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn scales_begin_and_end_with_their_stops_and_grow_brighter() {
        for scale in [VIRIDIS, MAGMA] {
            assert_eq!(colour(scale, 0.0), scale[0]);
            assert_eq!(colour(scale, 1.0), scale[scale.len() - 1]);
            assert_eq!(colour(scale, f64::NAN), scale[0]);
            assert_eq!(colour(scale, 7.0), scale[scale.len() - 1]);
            let luma = |value: f64| {
                let [red, green, blue] = colour(scale, value).map(f64::from);
                0.2126 * red + 0.7152 * green + 0.0722 * blue
            };
            assert!((0..100).all(|step| luma(f64::from(step + 1) / 100.0) > luma(f64::from(step) / 100.0)));
        }
    }
}
