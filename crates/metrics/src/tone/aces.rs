//! ACES 1 for a standard screen: the reference rendering transform and the output transform for sRGB at 100
//! cd/m^2, in Stephen Hill's fit (<https://github.com/TheRealMJP/BakingLab>, MIT). Its greys lie within a
//! step of 255 of the transforms themselves, other colours within twelve.

use super::transform;

/// Matrix from linear Rec. 709 to the primaries of the curve, with the desaturation of the rendering
/// transform.
const IN: [[f32; 3]; 3] =
    [[0.59719, 0.35458, 0.04823], [0.07600, 0.90834, 0.01566], [0.02840, 0.13383, 0.83777]];

/// Matrix back to linear Rec. 709, with the desaturation of the output transform.
const OUT: [[f32; 3]; 3] =
    [[1.60475, -0.53108, -0.07367], [-0.10208, 1.10813, -0.00605], [-0.00327, -0.07276, 1.07602]];

/// Converts linear Rec. 709 to the linear light of a screen; values may lie outside of 0 to 1.
pub(super) fn aces(linear: [f32; 3]) -> [f32; 3] {
    let curve =
        |x: f32| (x * (x + 0.024_578_6) - 0.000_090_537) / (x * (0.983_729 * x + 0.432_951) + 0.238_081);
    transform(&OUT, transform(&IN, linear).map(curve))
}

#[cfg(test)]
mod tests {
    use super::super::ToneCurve;
    use super::super::tests::farthest;

    #[test]
    fn colours_are_near_those_of_aces() {
        // Reference values of OpenColorIO 2.6, cg-config-v2.1.0_aces-v1.3: Linear Rec.709 to sRGB - Display,
        // ACES 1.0 - SDR Video; in steps of 255, clamped.
        let grey = [
            ([0.0; 3], [0.0; 3]),
            ([0.18; 3], [90.77; 3]),
            ([1.0; 3], [207.05; 3]),
            ([100.0; 3], [255.0; 3]),
        ];
        let far = farthest(ToneCurve::Aces, &grey);
        assert!(far < 1.0, "{far}");
        let colours = [
            ([0.5, 0.2, 0.1], [158.97, 100.5, 64.05]),
            ([4.0, 0.0, 0.0], [255.0, 114.18, 48.35]),
            ([0.0, 4.0, 0.0], [211.08, 244.8, 161.78]),
            ([0.0, 0.0, 4.0], [92.39, 14.66, 253.37]),
            ([1.0, 0.0, 0.0], [204.96, 0.0, 6.25]),
            ([0.0, 1.0, 0.0], [84.11, 208.64, 43.1]),
            ([0.0, 0.0, 1.0], [0.0, 0.0, 209.97]),
            ([0.02, 0.01, 0.005], [10.63, 3.49, 1.27]),
            ([16.0, 8.0, 1.0], [255.0, 251.36, 232.57]),
            ([1.0, 0.5, 0.0], [211.13, 167.03, 24.81]),
            ([0.3, 0.6, 0.9], [136.25, 178.1, 201.1]),
            ([2.0, 2.0, 0.1], [233.48, 230.62, 139.7]),
        ];
        let far = farthest(ToneCurve::Aces, &colours);
        assert!(far < 12.0, "{far}");
    }
}
