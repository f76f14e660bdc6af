//! Numbers for tests: the same on every machine.

/// A counter-based generator: number `i` of a seed does not depend on the ones before it.
#[derive(Clone, Copy, Debug)]
pub struct Random {
    state: u64,
}

impl Random {
    /// A stream of numbers.
    pub fn new(seed: u64) -> Self {
        Self { state: seed.wrapping_mul(0x9E37_79B9_7F4A_7C15) }
    }

    /// 64 random bits (splitmix64).
    pub fn bits(&mut self) -> u64 {
        self.state = self.state.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = self.state;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        z ^ (z >> 31)
    }

    /// In [low, high).
    pub fn between(&mut self, low: f32, high: f32) -> f32 {
        let unit = (self.bits() >> 40) as f32 / (1u64 << 24) as f32;
        low + (high - low) * unit
    }

    /// A point in a box.
    pub fn point(&mut self, low: f32, high: f32) -> [f32; 3] {
        [self.between(low, high), self.between(low, high), self.between(low, high)]
    }

    /// A unit direction.
    pub fn direction(&mut self) -> [f32; 3] {
        loop {
            let p = self.point(-1.0, 1.0);
            let squared: f32 = p.iter().map(|x| x * x).sum();
            if squared > 1.0e-3 && squared <= 1.0 {
                let length = squared.sqrt();
                return p.map(|x| x / length);
            }
        }
    }
}
