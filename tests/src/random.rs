//! Numbers for tests: the same on every machine.

use rasray_hard_cases::Stream;

/// The generator of the hard cases, started from a seed alone.
#[derive(Clone, Debug)]
pub struct Random {
    stream: Stream,
}

impl Random {
    /// A stream of numbers.
    pub fn new(seed: u64) -> Self {
        Self { stream: Stream::of_seed(seed) }
    }

    /// 64 random bits.
    pub fn bits(&mut self) -> u64 {
        self.stream.bits()
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
