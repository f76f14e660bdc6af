//! Distribution of texels over buffers in runs of equal length, so that all together may exceed one binding.

use rasray_gpu::Limits;
use rasray_shaders_glsl::constants::scene::SCENE_TEXEL_RUNS;

/// Bytes of a texel.
pub const TEXEL_BYTES: u64 = 4;

/// Largest exponent of a run's length: four runs then hold all texels that 32 bits can number.
const LARGEST_SHIFT: u32 = 30;

/// Length of a run of texels, a power of two. Textures are not aligned to runs: one may begin in one run and
/// end in the next.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct TexelRuns {
    shift: u32,
}

impl TexelRuns {
    /// Longest run that the shaders can address.
    pub const LONGEST: Self = Self { shift: LARGEST_SHIFT };

    /// Returns the longest run that a device can bind and allocate. Vulkan guarantees bindings of 128 MiB, so
    /// that every device holds 512 MiB of texels.
    pub fn of(limits: &Limits) -> Self {
        Self::at_most(limits.max_storage_buffer_range.min(limits.max_memory_allocation) / TEXEL_BYTES)
    }

    /// Returns the longest run of at most this many texels.
    pub fn at_most(texels: u64) -> Self {
        Self { shift: texels.max(1).ilog2().min(LARGEST_SHIFT) }
    }

    /// Returns the exponent of the length.
    pub fn shift(self) -> u32 {
        self.shift
    }

    /// Returns the number of texels of a run; the last may have fewer.
    pub fn length(self) -> u64 {
        1 << self.shift
    }

    /// Returns the number of texels that all runs hold together and that 32 bits can number.
    pub fn most_texels(self) -> u64 {
        (u64::from(SCENE_TEXEL_RUNS) << self.shift).min(u32::MAX.into())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn runs_are_the_longest_powers_of_two() {
        for (texels, length) in [(0, 1), (1, 1), (2, 2), (1023, 512), (1 << 25, 1 << 25), (u64::MAX, 1 << 30)]
        {
            let runs = TexelRuns::at_most(texels);
            assert_eq!(runs.length(), length, "{texels}");
            assert_eq!(runs.length(), 1 << runs.shift());
        }
        assert_eq!(TexelRuns::at_most(1 << 25).most_texels() * TEXEL_BYTES, 512 << 20);
        assert_eq!(TexelRuns::LONGEST.most_texels(), u64::from(u32::MAX));
    }
}
