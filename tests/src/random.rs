//! Random numbers for tests, equal on every machine.

use rasray_ads::Ray;
use rasray_hard_cases::Stream;

use crate::shapes::Triangle;

/// Generator of the hard cases, started from a seed alone.
#[derive(Clone, Debug)]
pub struct Random {
    stream: Stream,
}

impl Random {
    /// Starts a stream of numbers.
    pub fn new(seed: u64) -> Self {
        Self { stream: Stream::of_seed(seed) }
    }

    /// Returns 64 random bits.
    pub fn bits(&mut self) -> u64 {
        self.stream.bits()
    }

    /// Returns a number in [low, high).
    pub fn between(&mut self, low: f32, high: f32) -> f32 {
        let unit = (self.bits() >> 40) as f32 / (1u64 << 24) as f32;
        low + (high - low) * unit
    }

    /// Returns a point in a box.
    pub fn point(&mut self, low: f32, high: f32) -> [f32; 3] {
        [self.between(low, high), self.between(low, high), self.between(low, high)]
    }

    /// Returns a point within bounds.
    pub fn within(&mut self, [lower, upper]: [[f32; 3]; 2]) -> [f32; 3] {
        std::array::from_fn(|axis| self.between(lower[axis], upper[axis]))
    }

    /// Returns a point no farther from another than `reach` along an axis.
    pub fn near(&mut self, middle: [f32; 3], reach: f32) -> [f32; 3] {
        middle.map(|x| x + self.between(-reach, reach))
    }

    /// Returns a triangle whose corners are [`near`](Self::near) a point.
    pub fn triangle(&mut self, middle: [f32; 3], reach: f32) -> Triangle {
        [(); 3].map(|()| self.near(middle, reach))
    }

    /// Returns the weights of a point of a triangle.
    pub fn weights(&mut self) -> [f32; 3] {
        let (mut u, mut v) = (self.between(0.0, 1.0), self.between(0.0, 1.0));
        if u + v > 1.0 {
            (u, v) = (1.0 - u, 1.0 - v);
        }
        [1.0 - u - v, u, v]
    }

    /// Returns a unit direction.
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

    /// Returns a ray from a point in a box in any direction.
    pub fn ray(&mut self, low: f32, high: f32) -> Ray {
        Ray::new(self.point(low, high), self.direction())
    }

    /// Returns rays from points in a box in any direction.
    pub fn rays(&mut self, count: usize, low: f32, high: f32) -> Vec<Ray> {
        (0..count).map(|_| self.ray(low, high)).collect()
    }

    /// Returns the numbers from 0 to `count` - 1 in random order.
    pub fn shuffled(&mut self, count: usize) -> Vec<usize> {
        let mut order: Vec<usize> = (0..count).collect();
        for last in (1..count).rev() {
            order.swap(last, (self.bits() % (last as u64 + 1)) as usize);
        }
        order
    }
}
