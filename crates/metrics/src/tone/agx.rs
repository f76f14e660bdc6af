//! AgX: picture formation by Troy Sobotka, in the version of Eary Chow that Blender 4 ships as a table.
//!
//! Colours are brought closer to grey in Rec. 2020, each channel goes through a sigmoid of its logarithm,
//! part of the resulting shift of hue is taken back, and colours are moved away from grey again. All numbers
//! are those that the authors publish (<https://github.com/EaryChow/AgX_LUT_Gen>,
//! <https://github.com/sobotka/SB2383-Configuration-Generation>); the sigmoid is Jed Smith's. It is computed
//! here, where Blender interpolates in a table of 57 x 57 x 57 entries: values differ by 0.2 steps of 255 on
//! average, and in single saturated colours by up to twelve.

use super::transform;

/// Matrices of linear light from Rec. 709 to Rec. 2020 (ITU-R BT.2087), and back.
const REC_2020_FROM_709: [[f32; 3]; 3] = [
    [0.627_403_9, 0.329_283_04, 0.043_313_066],
    [0.069_097_29, 0.919_540_4, 0.011_362_316],
    [0.016_391_44, 0.088_013_31, 0.895_595_25],
];
const REC_709_FROM_2020: [[f32; 3]; 3] = [
    [1.660_491, -0.587_641_1, -0.072_849_86],
    [-0.124_550_48, 1.132_899_9, -0.008_349_423],
    [-0.018_150_763, -0.100_578_9, 1.118_729_7],
];

/// Matrix towards grey: primaries turned by 3, -1 and -2 degrees and moved in by 0.4, 0.22 and 0.13.
const INSET: [[f32; 3]; 3] = [
    [0.856_627_15, 0.095_121_24, 0.048_251_606],
    [0.137_318_97, 0.761_242, 0.101_439_04],
    [0.111_898_21, 0.076_799_42, 0.811_302_4],
];

/// Matrix away from grey: the inverse of primaries moved in by 0.4, 0.22 and 0.04.
const OUTSET: [[f32; 3]; 3] = [
    [1.127_100_6, -0.110_606_64, -0.016_493_939],
    [-0.141_329_76, 1.157_823_7, -0.016_493_939],
    [-0.141_329_76, -0.110_606_64, 1.251_936_4],
];

/// Middle grey: the linear value that is shown unchanged.
const MIDDLE_GREY: f32 = 0.18;
/// Range that is shown, in stops below and above middle grey.
const STOPS: (f32, f32) = (10.0, 6.5);
/// Exponent that is applied to the values of the sigmoid.
const GAMMA: f32 = 2.4;
/// Slope of the sigmoid at middle grey.
const SLOPE: f32 = 2.4;
/// Sharpness of the sigmoid's bend.
const POWER: f32 = 1.5;
/// Share of the shift of hue that remains.
const HUE_SHIFT: f32 = 0.4;
/// Luminance of linear Rec. 709 for the observer of CIE 2015, which the authors use.
const LUMINANCE: [f32; 3] = [0.206_773_79, 0.658_129_8, 0.135_096_42];

/// Converts linear Rec. 709 to the linear light of a screen; values may lie a little outside of 0 to 1.
pub(super) fn agx(linear: [f32; 3]) -> [f32; 3] {
    let inset = transform(&INSET, transform(&REC_2020_FROM_709, linear));
    let formed = inset.map(|value| sigmoid(position(value)).powf(GAMMA));
    let outset = transform(&OUTSET, with_hue_towards(formed, inset));
    inside_screen(transform(&REC_709_FROM_2020, outset))
}

/// Returns the position of light between the darkest and the brightest that are shown, in stops: 0 to 1.
fn position(light: f32) -> f32 {
    // The smallest normal number replaces values without a logarithm.
    let stops = (light.max(f32::MIN_POSITIVE) / MIDDLE_GREY).log2();
    ((stops + STOPS.0) / (STOPS.0 + STOPS.1)).clamp(0.0, 1.0)
}

/// Applies a sigmoid of two hyperbolic arcs that meet at middle grey with the same slope and end at 0 and 1.
fn sigmoid(x: f32) -> f32 {
    let pivot = [STOPS.0 / (STOPS.0 + STOPS.1), MIDDLE_GREY.powf(1.0 / GAMMA)];
    let arc = |x: f32, [width, height]: [f32; 2]| {
        // The scale makes the arc reach its height at its width.
        let line = SLOPE * width;
        let scale = line * ((line / height).powf(POWER) - 1.0).powf(-1.0 / POWER);
        let term = SLOPE * x / scale;
        scale * term / (1.0 + term.powf(POWER)).powf(1.0 / POWER)
    };
    match x >= pivot[0] {
        true => pivot[1] + arc(x - pivot[0], pivot.map(|at| 1.0 - at)),
        false => (pivot[1] - arc(pivot[0] - x, pivot)).max(0.0),
    }
}

/// Returns the least and greatest channel, and the hue as turns around the wheel of HSV; 0 for grey.
fn hue([red, green, blue]: [f32; 3]) -> (f32, f32, f32) {
    let (least, most) = (red.min(green).min(blue), red.max(green).max(blue));
    let range = most - least;
    let sixths = match range {
        0.0 => 0.0,
        _ if most == red => (green - blue) / range,
        _ if most == green => 2.0 + (blue - red) / range,
        _ => 4.0 + (red - green) / range,
    };
    (least, most, sixths / 6.0)
}

/// Returns a colour with its hue turned towards that of another, the shorter way, so that [`HUE_SHIFT`] of
/// their difference remains.
fn with_hue_towards(colour: [f32; 3], other: [f32; 3]) -> [f32; 3] {
    let ((least, most, own), (_, _, other)) = (hue(colour), hue(other));
    let turn = (other - own + 0.5).rem_euclid(1.0) - 0.5;
    let sixths = 6.0 * (own + (1.0 - HUE_SHIFT) * turn).rem_euclid(1.0);
    let weights = [(sixths - 3.0).abs() - 1.0, 2.0 - (sixths - 2.0).abs(), 2.0 - (sixths - 4.0).abs()];
    weights.map(|weight| least + (most - least) * weight.clamp(0.0, 1.0))
}

/// Reduces the saturation of colours outside of Rec. 709. They keep their brightness, but the less the darker
/// they are.
fn inside_screen(colour: [f32; 3]) -> [f32; 3] {
    let least = colour.into_iter().fold(0.0, f32::min);
    if least == 0.0 {
        return colour;
    }
    let raised = colour.map(|value| value - least);
    let (before, after) = (brightness(colour), brightness(raised));
    raised.map(|value| if after > before { value * before / after } else { value })
}

/// Returns the luminance, for dark colours that of the colour and its complement together.
fn brightness(colour: [f32; 3]) -> f32 {
    let luminance = |colour: [f32; 3]| (0..3).map(|at| LUMINANCE[at] * colour[at]).sum::<f32>();
    let most = colour.into_iter().fold(f32::NEG_INFINITY, f32::max);
    let complement = colour.map(|value| most - value);
    let own = luminance(colour);
    let both = complement.into_iter().fold(0.0, f32::max) - luminance(complement) + own;
    both + own.max(0.0).powf(0.08).min(1.0) * (own - both)
}

#[cfg(test)]
mod tests {
    use super::super::ToneCurve;
    use super::super::tests::farthest;
    use super::*;

    #[test]
    fn the_sigmoid_has_the_published_ends_middle_and_slope() {
        let middle = position(MIDDLE_GREY);
        assert!((middle - 10.0 / 16.5).abs() < 1.0e-6);
        for (x, y) in [(0.0, 0.0), (middle, 0.489_437), (1.0, 1.0)] {
            assert!((sigmoid(x) - y).abs() < 1.0e-5, "{x}: {}", sigmoid(x));
        }
        let slope = (sigmoid(middle + 1.0e-3) - sigmoid(middle - 1.0e-3)) / 2.0e-3;
        assert!((slope - SLOPE).abs() < 0.02, "{slope}");
    }

    #[test]
    fn colours_are_those_of_blender() {
        // Reference values of Blender 4.4 (bpy 4.4.0): view transform AgX, no look, saved with 16 bits; in
        // steps of 255.
        let published = [
            ([0.0; 3], [0.0; 3]),
            ([0.18; 3], [117.65; 3]),
            ([1.0; 3], [196.6; 3]),
            ([100.0; 3], [255.0; 3]),
            ([0.5, 0.2, 0.1], [174.26, 122.22, 92.05]),
            ([0.02, 0.01, 0.005], [30.93, 18.07, 8.39]),
            ([0.3, 0.6, 0.9], [153.94, 178.09, 194.38]),
            ([1.0, 0.5, 0.0], [204.54, 161.56, 78.57]),
            ([2.0, 2.0, 0.1], [219.42, 214.61, 160.3]),
            ([16.0, 8.0, 1.0], [254.87, 242.38, 223.88]),
            ([4.0, 0.0, 0.0], [254.6, 148.33, 134.77]),
            ([0.0, 4.0, 0.0], [183.06, 234.39, 168.25]),
            ([1.0, 0.0, 0.0], [218.8, 57.16, 32.96]),
            ([0.0, 1.0, 0.0], [110.28, 197.02, 81.2]),
            ([0.0, 0.18, 0.0], [23.33, 110.25, 0.04]),
        ];
        let far = farthest(ToneCurve::Agx, &published);
        assert!(far < 1.0, "{far}");
        // In these colours Blender's table is coarse.
        let saturated = [
            ([0.0, 0.0, 4.0], [132.25, 157.9, 247.62]),
            ([0.0, 0.0, 1.0], [20.13, 86.08, 209.47]),
            ([0.18, 0.0, 0.0], [109.1, 3.92, 0.0]),
        ];
        let far = farthest(ToneCurve::Agx, &saturated);
        assert!(far < 12.0, "{far}");
    }

    #[test]
    fn hues_are_turned_the_shorter_way() {
        assert_eq!(with_hue_towards([0.5; 3], [1.0, 0.0, 0.0]), [0.5; 3]);
        let [red, green, blue] = with_hue_towards([1.0, 0.1, 0.0], [1.0, 0.0, 0.1]);
        assert!(red == 1.0 && green == 0.0 && (blue - 0.02).abs() < 1.0e-5, "{green} {blue}");
    }
}
