//! Random numbers: integer-exact functions of pixel, sample, dimension and seed.

use rasray_scene::Sampler;

/// Dimension of the position on the lens, first number.
pub const RANDOM_LENS_U: u32 = 0;
/// Dimension of the position on the lens, second number.
pub const RANDOM_LENS_V: u32 = 1;
/// Dimension of the position inside the pixel, along the row.
pub const RANDOM_CAMERA_X: u32 = 2;
/// Dimension of the position inside the pixel, down the column.
pub const RANDOM_CAMERA_Y: u32 = 3;
/// First dimension of the first scattering.
pub const RANDOM_BOUNCE_FIRST: u32 = 4;
/// Number of dimensions of one scattering.
pub const RANDOM_BOUNCE_STRIDE: u32 = 12;
/// Offset of the choice of the kind of light.
pub const RANDOM_LIGHT_KIND: u32 = 0;
/// Offset of the choice of the light among its kind.
pub const RANDOM_LIGHT_PICK: u32 = 1;
/// Offset of the position on the light, first number.
pub const RANDOM_LIGHT_U: u32 = 2;
/// Offset of the position on the light, second number.
pub const RANDOM_LIGHT_V: u32 = 3;
/// Offset of the choice of the family of lobes.
pub const RANDOM_BSDF_LOBE: u32 = 4;
/// Offset of the choice between reflection and transmission.
pub const RANDOM_BSDF_SIDE: u32 = 5;
/// Offset of the direction, first number.
pub const RANDOM_BSDF_U: u32 = 6;
/// Offset of the direction, second number.
pub const RANDOM_BSDF_V: u32 = 7;
/// Offset of the choice to end the path.
pub const RANDOM_ROULETTE: u32 = 8;
/// Dimension of the first blended surface that a path hits; the n-th adds n.
pub const RANDOM_OPACITY_FIRST: u32 = 65536;

/// Stream of random numbers.
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
    /// Returns a number uniform in [0, 1), a multiple of 2^-24.
    pub fn float(self, dimension: u32) -> f32 {
        (self.bits(dimension) >> 8) as f32 * (1.0 / 16_777_216.0)
    }

    /// Returns four numbers of consecutive dimensions.
    pub fn four(self, dimension: u32) -> [f32; 4] {
        std::array::from_fn(|index| self.float(dimension + index as u32))
    }

    /// Returns 32 random bits: the first word of pcg4d.
    pub fn bits(self, dimension: u32) -> u32 {
        words([self.pixel, self.sample, dimension, self.seed])[0]
    }
}

/// Random numbers of one sample of one pixel.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Numbers {
    /// Source of the numbers.
    pub sampler: Sampler,
    /// Stream of the numbers.
    pub stream: RandomStream,
}

impl Numbers {
    /// Returns a number uniform in [0, 1), a multiple of 2^-24.
    pub fn float(self, dimension: u32) -> f32 {
        match self.sampler {
            Sampler::Sobol => unit(self.group(dimension / 4)[dimension as usize % 4]),
            Sampler::Pcg => self.stream.float(dimension),
        }
    }

    /// Returns four numbers of consecutive dimensions.
    pub fn four(self, dimension: u32) -> [f32; 4] {
        std::array::from_fn(|index| self.float(dimension + index as u32))
    }

    fn group(self, group: u32) -> [u32; 4] {
        let RandomStream { seed, pixel, sample } = self.stream;
        let seeds = words([pixel, GROUP_KEY, group, seed]);
        let order = seeds[0] ^ seeds[2].wrapping_mul(0x9e37_79b9);
        let index = scramble(sample, order);
        let point = sobol(index);
        // The first two Sobol dimensions are the last two of the group.
        std::array::from_fn(|dimension| scramble(point[(dimension + 2) % 4], seeds[dimension]))
    }
}

/// Number that is mixed into the key of a group, so that groups share no key with [`RandomStream`].
const GROUP_KEY: u32 = 0x8000_0000;

fn unit(bits: u32) -> f32 {
    (bits >> 8) as f32 * (1.0 / 16_777_216.0)
}

/// Computes the words of pcg4d.
fn words(key: [u32; 4]) -> [u32; 4] {
    let mut k = key.map(|word| word.wrapping_mul(1_664_525).wrapping_add(1_013_904_223));
    let round = |k: &mut [u32; 4]| {
        k[0] = k[0].wrapping_add(k[1].wrapping_mul(k[3]));
        k[1] = k[1].wrapping_add(k[2].wrapping_mul(k[0]));
        k[2] = k[2].wrapping_add(k[0].wrapping_mul(k[1]));
        k[3] = k[3].wrapping_add(k[1].wrapping_mul(k[2]));
    };
    round(&mut k);
    k = k.map(|word| word ^ (word >> 16));
    round(&mut k);
    k
}

/// Scrambles bits as Owen does: each bit is flipped by a hash of those above it.
fn scramble(bits: u32, seed: u32) -> u32 {
    let mut x = bits.reverse_bits();
    x ^= x.wrapping_mul(0x3d20_adea);
    x = x.wrapping_add(seed);
    x = x.wrapping_mul((seed >> 16) | 1);
    x ^= x.wrapping_mul(0x0552_6c56);
    x ^= x.wrapping_mul(0x53a2_2864);
    x.reverse_bits()
}

/// Returns the first four Sobol dimensions of an index; directions of Joe and Kuo 2008.
fn sobol(index: u32) -> [u32; 4] {
    let mut point = [0; 4];
    let mut directions = [[0_u32; 32]; 4];
    for bit in 0..32 {
        let v = |dimension: usize, before: usize| directions[dimension][bit - before];
        let next = [
            1 << (31 - bit),
            if bit < 1 { 1 << 31 } else { v(1, 1) ^ (v(1, 1) >> 1) },
            if bit < 2 { [1, 3][bit] << (31 - bit) } else { v(2, 1) ^ v(2, 2) ^ (v(2, 2) >> 2) },
            if bit < 3 { [1, 3, 1][bit] << (31 - bit) } else { v(3, 2) ^ v(3, 3) ^ (v(3, 3) >> 3) },
        ];
        for dimension in 0..4 {
            directions[dimension][bit] = next[dimension];
            if index >> bit & 1 == 1 {
                point[dimension] ^= next[dimension];
            }
        }
    }
    point
}

/// Returns the dimension of one use at scattering `bounce`; `offset` is one of the offsets above.
pub fn random_dimension(bounce: u32, offset: u32) -> u32 {
    RANDOM_BOUNCE_FIRST + bounce * RANDOM_BOUNCE_STRIDE + offset
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The shaders' table is the source; this one is a second copy that keeps this crate independent.
    #[test]
    fn dimensions_are_those_of_the_shaders() {
        let source = include_str!("../../../../shaders-glsl/scene/random_dimensions.glsl");
        let mut found = 0;
        for line in source.lines() {
            let words: Vec<_> = line.split_whitespace().collect();
            let ["#define", name, value] = words[..] else { continue };
            let value: u32 = value.trim_end_matches('u').parse().expect("a number");
            let ours = match name {
                "RANDOM_LENS_U" => RANDOM_LENS_U,
                "RANDOM_LENS_V" => RANDOM_LENS_V,
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
        assert_eq!(found, 16);
    }

    /// The test checks mean, variance and correlation of neighbours in every argument, each within five
    /// standard deviations of a uniform, independent source.
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

    /// For any power of two of samples of a pixel, each dimension has one in each of as many equal parts, and
    /// a pair of dimensions has one in each rectangle of as many equal ones. Owen's scrambling keeps that
    /// property, independent numbers lack it.
    #[test]
    fn samples_of_a_pixel_are_spread_evenly() {
        for (pixel, group) in [(0, 0), (17, 1), (100_000, 4), (3, 16_384)] {
            for bits in 1..=8_u32 {
                let count = 1_u32 << bits;
                let at = |sample: u32| {
                    let stream = RandomStream { seed: 9, pixel, sample };
                    Numbers { sampler: Sampler::Sobol, stream }.four(4 * group)
                };
                let part = |value: f32, parts: u32| (value * parts as f32) as u32;
                for dimension in 0..4 {
                    let parts: std::collections::BTreeSet<u32> =
                        (0..count).map(|sample| part(at(sample)[dimension], count)).collect();
                    assert_eq!(parts.len() as u32, count, "{pixel} {group} {count} {dimension}");
                }
                for wide in 0..=bits {
                    let (columns, rows) = (1 << wide, 1 << (bits - wide));
                    let places: std::collections::BTreeSet<_> = (0..count)
                        .map(|sample| (part(at(sample)[2], columns), part(at(sample)[3], rows)))
                        .collect();
                    assert_eq!(places.len() as u32, count, "{pixel} {group} {columns} x {rows}");
                }
            }
        }
    }

    /// Pixels, groups and seeds are independent: the first sample is uniform over each of them and neighbours
    /// do not correlate, within five standard deviations of independent numbers.
    #[test]
    fn points_of_neighbours_are_independent() {
        let count = 1 << 14;
        let at = |pixel: u32, group: u32, seed: u32, dimension: u32| {
            let stream = RandomStream { seed, pixel, sample: 5 };
            f64::from(Numbers { sampler: Sampler::Sobol, stream }.float(4 * group + dimension)) - 0.5
        };
        let root = f64::from(count).sqrt();
        for dimension in 0..4 {
            for [pixel, group, seed] in [[1, 0, 0], [0, 1, 0], [0, 0, 1], [640, 0, 0]] {
                let (mut mean, mut product) = (0.0, 0.0);
                for index in 0..count {
                    let first = at(index, 3, 1, dimension);
                    mean += first;
                    product += first * at(index + pixel, 3 + group, 1 + seed, dimension);
                }
                assert!((mean / root).abs() < 5.0 * (1.0_f64 / 12.0).sqrt(), "mean {dimension}");
                assert!((product / root).abs() < 5.0 / 12.0, "{dimension}: {}", product / root);
            }
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
