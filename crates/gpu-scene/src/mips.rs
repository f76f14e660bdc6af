//! Smaller levels of an image: means of two by two texels in linear light.

/// Encoding of the first three bytes of a texel; the fourth, alpha, is always linear.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Encoding {
    /// Byte / 255.
    Linear,
    /// The sRGB curve of IEC 61966-2-1.
    Srgb,
}

/// Level of an image: RGBA texels with red in the lowest byte, rows top first.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Level {
    /// Texels per row.
    pub width: u32,
    /// Rows.
    pub height: u32,
    /// Texels, `width * height` of them.
    pub texels: Vec<u32>,
}

/// Returns the linear value of an sRGB value, both in [0, 1].
pub fn linear_from_srgb(srgb: f32) -> f32 {
    if srgb <= 0.04045 { srgb / 12.92 } else { ((srgb + 0.055) / 1.055).powf(2.4) }
}

/// Returns the sRGB value of a linear value, both in [0, 1].
pub fn srgb_from_linear(linear: f32) -> f32 {
    if linear <= 0.003_130_8 { linear * 12.92 } else { 1.055 * linear.powf(1.0 / 2.4) - 0.055 }
}

/// Returns the number of levels of an image down to one texel.
pub fn level_count(width: u32, height: u32) -> u32 {
    32 - width.max(height).max(1).leading_zeros()
}

/// Returns the number of texels of all levels of an image, or of the first alone where `mipmapped` is false.
pub fn texel_count(width: u32, height: u32, mipmapped: bool) -> u64 {
    let levels = if mipmapped { level_count(width, height) } else { 1 };
    (0..levels).map(|level| u64::from((width >> level).max(1)) * u64::from((height >> level).max(1))).sum()
}

/// Makes all levels of an image, or the first alone where `mipmapped` is false.
///
/// Texel (x, y) of a level is the mean, in linear light, of texels (2x + a, 2y + b) of the level
/// above, a and b in {0, 1}, clamped to its last column and row, and is rounded to the nearest
/// byte before the next level is made from it.
///
/// `rgba8` must hold `width * height` texels of four bytes.
pub fn levels(width: u32, height: u32, rgba8: &[u8], encoding: Encoding, mipmapped: bool) -> Vec<Level> {
    let mut levels = vec![first_level(width, height, rgba8)];
    if !mipmapped {
        return levels;
    }
    let values = Values::of(encoding);
    for _ in 1..level_count(width, height) {
        let smaller = halve(&levels[levels.len() - 1], &values);
        levels.push(smaller);
    }
    levels
}

/// Makes the level with index `number` of those that [`levels`] makes, 0 being the first. An index beyond the
/// last gives the last.
pub fn level(width: u32, height: u32, rgba8: &[u8], encoding: Encoding, number: u32) -> Level {
    let values = Values::of(encoding);
    let smaller = 0..number.min(level_count(width, height) - 1);
    smaller.fold(first_level(width, height, rgba8), |level, _| halve(&level, &values))
}

fn first_level(width: u32, height: u32, rgba8: &[u8]) -> Level {
    let texels = rgba8.chunks_exact(4).map(|t| u32::from_le_bytes([t[0], t[1], t[2], t[3]])).collect();
    Level { width, height, texels }
}

/// Values that bytes stand for, in a colour and in alpha.
struct Values {
    color: [f32; 256],
    alpha: [f32; 256],
    encoding: Encoding,
}

impl Values {
    fn of(encoding: Encoding) -> Self {
        let alpha = std::array::from_fn(|byte| byte as f32 / 255.0);
        let color = match encoding {
            Encoding::Linear => alpha,
            Encoding::Srgb => alpha.map(linear_from_srgb),
        };
        Self { color, alpha, encoding }
    }
}

fn halve(level: &Level, values: &Values) -> Level {
    let (width, height) = ((level.width / 2).max(1), (level.height / 2).max(1));
    let mut texels = Vec::with_capacity(width as usize * height as usize);
    for y in 0..height {
        for x in 0..width {
            let mut sum = [0.0f32; 4];
            for (a, b) in [(0, 0), (1, 0), (0, 1), (1, 1)] {
                let column = (2 * x + a).min(level.width - 1) as usize;
                let row = (2 * y + b).min(level.height - 1) as usize;
                let texel = level.texels[row * level.width as usize + column].to_le_bytes();
                for channel in 0..3 {
                    sum[channel] += values.color[texel[channel] as usize];
                }
                sum[3] += values.alpha[texel[3] as usize];
            }
            texels.push(pack(sum.map(|s| s * 0.25), values.encoding));
        }
    }
    Level { width, height, texels }
}

fn pack(texel: [f32; 4], encoding: Encoding) -> u32 {
    let byte = |value: f32| (value.clamp(0.0, 1.0) * 255.0 + 0.5).floor() as u8;
    let encode = |value: f32| match encoding {
        Encoding::Linear => byte(value),
        Encoding::Srgb => byte(srgb_from_linear(value)),
    };
    u32::from_le_bytes([encode(texel[0]), encode(texel[1]), encode(texel[2]), byte(texel[3])])
}

#[cfg(test)]
mod tests {
    use super::*;

    fn bytes(texel: u32) -> [u8; 4] {
        texel.to_le_bytes()
    }

    #[test]
    fn sizes_halve_down_to_one_texel() {
        let image = vec![200; 5 * 3 * 4];
        let all = levels(5, 3, &image, Encoding::Linear, true);
        let sizes: Vec<_> = all.iter().map(|l| (l.width, l.height)).collect();
        assert_eq!(sizes, [(5, 3), (2, 1), (1, 1)]);
        assert_eq!(level_count(5, 3), 3);
        assert_eq!(texel_count(5, 3, true), all.iter().map(|l| l.texels.len() as u64).sum::<u64>());
        assert_eq!(texel_count(5, 3, false), 15);
        assert_eq!(levels(5, 3, &image, Encoding::Linear, false).len(), 1);
        assert_eq!(levels(1, 1, &image[..4], Encoding::Srgb, true).len(), 1);
        for number in 0..5 {
            let one = level(5, 3, &image, Encoding::Linear, number);
            assert_eq!(one, all[(number as usize).min(2)], "{number}");
        }
    }

    #[test]
    fn black_and_white_average_in_linear_light() {
        let image = [0, 0, 0, 0, 255, 255, 255, 255];
        assert_eq!(bytes(levels(2, 1, &image, Encoding::Srgb, true)[1].texels[0]), [188, 188, 188, 128]);
        assert_eq!(bytes(levels(2, 1, &image, Encoding::Linear, true)[1].texels[0]), [128, 128, 128, 128]);
    }

    #[test]
    fn a_last_odd_column_is_left_out() {
        let image = [10, 10, 10, 10, 20, 20, 20, 20, 250, 250, 250, 250];
        assert_eq!(bytes(levels(3, 1, &image, Encoding::Linear, true)[1].texels[0]), [15; 4]);
    }

    #[test]
    fn a_constant_image_stays_constant_in_both_encodings() {
        for encoding in [Encoding::Linear, Encoding::Srgb] {
            for value in 0..=255u8 {
                let image = vec![value; 7 * 6 * 4];
                for level in levels(7, 6, &image, encoding, true) {
                    assert!(level.texels.iter().all(|&t| bytes(t) == [value; 4]), "{value} {encoding:?}");
                }
            }
        }
    }
}
