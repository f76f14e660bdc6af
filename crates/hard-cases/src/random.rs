/// Increment of the state of SplitMix64.
const STEP: u64 = 0x9e37_79b9_7f4a_7c15;

/// Random numbers that depend on a case, a seed and an index, and not on earlier numbers.
#[derive(Clone, Debug)]
pub struct Stream {
    state: u64,
}

impl Stream {
    /// Makes the numbers of one ray.
    pub fn new(id: &str, seed: u64, index: u64) -> Self {
        // The state is FNV-1a over the name, with the seed and the index mixed in one after the other.
        let name = id.bytes().fold(0xcbf2_9ce4_8422_2325_u64, |hash, byte| {
            (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3)
        });
        Self { state: mix(mix(name ^ seed) ^ index) }
    }

    /// Makes the numbers of a seed alone.
    pub fn of_seed(seed: u64) -> Self {
        Self { state: seed.wrapping_mul(STEP) }
    }

    /// Returns 64 random bits (SplitMix64).
    pub fn bits(&mut self) -> u64 {
        self.state = self.state.wrapping_add(STEP);
        mix(self.state)
    }

    /// Returns an index below `count`, which must not be 0.
    pub fn below(&mut self, count: usize) -> usize {
        ((u128::from(self.bits()) * count as u128) >> 64) as usize
    }

    /// Returns a number uniform in `[low, high)`, rounded.
    pub fn between(&mut self, low: f32, high: f32) -> f32 {
        let unit = (self.bits() >> 11) as f64 / (1_u64 << 53) as f64;
        (f64::from(low) + (f64::from(high) - f64::from(low)) * unit) as f32
    }

    /// Returns -1 or 1.
    pub fn sign(&mut self) -> f32 {
        if self.bits() >> 63 == 0 { -1.0 } else { 1.0 }
    }

    /// Returns a point uniform in a cube around a point.
    pub fn near(&mut self, center: [f32; 3], radius: f32) -> [f32; 3] {
        center.map(|x| x + self.between(-radius, radius))
    }

    /// Returns a direction uniform on the unit sphere, rounded.
    pub fn direction(&mut self) -> [f32; 3] {
        let z = self.between(-1.0, 1.0);
        let azimuth = self.between(0.0, std::f32::consts::TAU);
        let radius = (1.0 - z * z).max(0.0).sqrt();
        [radius * azimuth.cos(), radius * azimuth.sin(), z]
    }

    /// Returns the weights of a point inside a triangle, each at least `margin` (below a third).
    pub fn weights(&mut self, margin: f32) -> [f32; 3] {
        let (mut u, mut v) = (self.between(0.0, 1.0), self.between(0.0, 1.0));
        if u + v > 1.0 {
            (u, v) = (1.0 - u, 1.0 - v);
        }
        let span = 1.0 - 3.0 * margin;
        [margin + span * (1.0 - u - v), margin + span * u, margin + span * v]
    }
}

fn mix(bits: u64) -> u64 {
    let bits = (bits ^ (bits >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    let bits = (bits ^ (bits >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    bits ^ (bits >> 31)
}
