//! Random numbers: one integer-exact function of pixel, sample, dimension and seed.

/// Position inside the pixel, along the row.
pub const RANDOM_CAMERA_X: u32 = 0;
/// Position inside the pixel, down the column.
pub const RANDOM_CAMERA_Y: u32 = 1;
/// First dimension of the first scattering.
pub const RANDOM_BOUNCE_FIRST: u32 = 4;
/// Dimensions of one scattering.
pub const RANDOM_BOUNCE_STRIDE: u32 = 12;
/// Offset: which kind of light.
pub const RANDOM_LIGHT_KIND: u32 = 0;
/// Offset: which light of the kind.
pub const RANDOM_LIGHT_PICK: u32 = 1;
/// Offset: place on the light.
pub const RANDOM_LIGHT_U: u32 = 2;
/// Offset: place on the light.
pub const RANDOM_LIGHT_V: u32 = 3;
/// Offset: which family of lobes.
pub const RANDOM_BSDF_LOBE: u32 = 4;
/// Offset: reflected or transmitted.
pub const RANDOM_BSDF_SIDE: u32 = 5;
/// Offset: direction.
pub const RANDOM_BSDF_U: u32 = 6;
/// Offset: direction.
pub const RANDOM_BSDF_V: u32 = 7;
/// Offset: whether the path goes on.
pub const RANDOM_ROULETTE: u32 = 8;
/// Dimension of the first blended surface that a path meets; the n-th adds n.
pub const RANDOM_OPACITY_FIRST: u32 = 65536;

/// Which stream of random numbers is drawn from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct RandomStream {
    /// Seed of the image.
    pub seed: u32,
    /// `row * width + column` in the whole image.
    pub pixel: u32,
    /// Running number of the sample.
    pub sample: u32,
}

impl RandomStream {
    /// Uniform in [0, 1), a multiple of 2^-24.
    pub fn float(self, dimension: u32) -> f32 {
        (self.bits(dimension) >> 8) as f32 * (1.0 / 16_777_216.0)
    }

    /// Four numbers of consecutive dimensions.
    pub fn four(self, dimension: u32) -> [f32; 4] {
        std::array::from_fn(|index| self.float(dimension + index as u32))
    }

    /// 32 random bits: the first word of pcg4d.
    pub fn bits(self, dimension: u32) -> u32 {
        let [mut x, mut y, mut z, mut w] = [self.pixel, self.sample, dimension, self.seed]
            .map(|word| word.wrapping_mul(1_664_525).wrapping_add(1_013_904_223));
        x = x.wrapping_add(y.wrapping_mul(w));
        y = y.wrapping_add(z.wrapping_mul(x));
        z = z.wrapping_add(x.wrapping_mul(y));
        w = w.wrapping_add(y.wrapping_mul(z));
        [x, y, w] = [x, y, w].map(|word| word ^ (word >> 16));
        x.wrapping_add(y.wrapping_mul(w))
    }
}

/// Dimension of one use at scattering `bounce`; `offset` is one of the offsets above.
pub fn random_dimension(bounce: u32, offset: u32) -> u32 {
    RANDOM_BOUNCE_FIRST + bounce * RANDOM_BOUNCE_STRIDE + offset
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The shaders' table is the source; this one is a second copy only for this crate's independence.
    #[test]
    fn dimensions_are_those_of_the_shaders() {
        let source = include_str!("../../../../shaders-glsl/scene/random_dimensions.glsl");
        let mut found = 0;
        for line in source.lines() {
            let words: Vec<_> = line.split_whitespace().collect();
            let ["#define", name, value] = words[..] else { continue };
            let value: u32 = value.trim_end_matches('u').parse().expect("a number");
            let ours = match name {
                "RANDOM_CAMERA_X" => RANDOM_CAMERA_X,
                "RANDOM_CAMERA_Y" => RANDOM_CAMERA_Y,
                "RANDOM_BOUNCE_FIRST" => RANDOM_BOUNCE_FIRST,
                "RANDOM_BOUNCE_STRIDE" => RANDOM_BOUNCE_STRIDE,
                "RANDOM_LIGHT_KIND" => RANDOM_LIGHT_KIND,
                "RANDOM_LIGHT_PICK" => RANDOM_LIGHT_PICK,
                "RANDOM_LIGHT_U" => RANDOM_LIGHT_U,
                "RANDOM_LIGHT_V" => RANDOM_LIGHT_V,
                "RANDOM_BSDF_LOBE" => RANDOM_BSDF_LOBE,
                "RANDOM_BSDF_SIDE" => RANDOM_BSDF_SIDE,
                "RANDOM_BSDF_U" => RANDOM_BSDF_U,
                "RANDOM_BSDF_V" => RANDOM_BSDF_V,
                "RANDOM_ROULETTE" => RANDOM_ROULETTE,
                "RANDOM_OPACITY_FIRST" => RANDOM_OPACITY_FIRST,
                other => panic!("{other} is not known here"),
            };
            assert_eq!(ours, value, "{name}");
            found += 1;
        }
        assert_eq!(found, 14);
    }

    /// Mean, variance and correlation of neighbours in every argument, each within five standard
    /// deviations of a uniform, independent source.
    #[test]
    fn numbers_are_uniform_and_neighbours_independent() {
        let count = 1 << 16;
        let at = |pixel: u32, sample: u32, dimension: u32, seed: u32| {
            f64::from(RandomStream { seed, pixel, sample }.float(dimension)) - 0.5
        };
        let root = f64::from(count).sqrt();
        for step in [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1], [640, 0, 0, 0]] {
            let (mut mean, mut square, mut product) = (0.0, 0.0, 0.0);
            for index in 0..count {
                let (pixel, sample) = (index / 16, index % 16);
                let first = at(pixel, sample, 9, 1);
                let second = at(pixel + step[0], sample + step[1], 9 + step[2], 1 + step[3]);
                mean += first;
                square += first * first;
                product += first * second;
            }
            assert!((mean / root).abs() < 5.0 * (1.0_f64 / 12.0).sqrt(), "mean {step:?}");
            assert!((square / f64::from(count) - 1.0 / 12.0).abs() < 5.0 * (1.0_f64 / 180.0).sqrt() / root);
            assert!((product / root).abs() < 5.0 / 12.0, "correlation {step:?}: {}", product / root);
        }
    }

    #[test]
    fn numbers_stay_below_one() {
        let largest = (0..1_000_000)
            .map(|pixel| RandomStream { seed: 3, pixel, sample: 5 }.float(7))
            .fold(0.0_f32, f32::max);
        assert!(largest < 1.0 && largest > 0.9999);
    }
}
