//! Light that rough glass loses in one scattering, tabulated for every index and reflectance in use. After
//! Kulla and Conty 2017. The points are those of the shaders' tables, so that the two differ by rounding
//! alone; tests integrate in another way.

use std::{
    collections::HashMap,
    f64::consts::PI,
    sync::{Mutex, OnceLock, PoisonError},
};

/// Number of steps of roughness, and of the root of the cosine.
const STEPS: usize = 15;
/// Number of points of the integral over visible normals: a Fibonacci lattice.
const POINTS: usize = 2584;
const STEP: usize = 1597;

/// Shares of the light, a row for every roughness.
type Rows = [[f32; STEPS + 1]; STEPS + 1];

/// Quantity that is tabulated.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Block {
    /// Share that is lost where light arrives at the front.
    Front,
    /// Share that is lost where light arrives at the back.
    Back,
    /// Share that is reflected once on the side of the larger index.
    Reflected,
}

impl Block {
    /// Returns the block of the other side.
    pub fn beyond(self) -> Self {
        if self == Self::Front { Self::Back } else { Self::Front }
    }
}

/// Table of one glass.
#[derive(Clone, Debug)]
pub struct Table {
    blocks: [(Rows, [f32; STEPS + 1]); 3],
}

/// Returns the table for an index of the inside, and the reflectance at normal incidence and at grazing.
/// Tables are kept for later calls.
pub fn table(ior: f32, f0: f32, f90: f32) -> &'static Table {
    static TABLES: OnceLock<Mutex<HashMap<[u32; 3], &'static Table>>> = OnceLock::new();
    let mut tables = TABLES.get_or_init(Mutex::default).lock().unwrap_or_else(PoisonError::into_inner);
    tables
        .entry([ior, f0, f90].map(f32::to_bits))
        .or_insert_with(|| Box::leak(Box::new(Table::new(ior.into(), f0.into(), f90.into()))))
}

impl Table {
    fn new(ior: f64, f0: f64, f90: f64) -> Self {
        let mut lost = [[[0.0; STEPS + 1]; STEPS + 1]; 2];
        let mut reflected = [[0.0; STEPS + 1]; STEPS + 1];
        for (side, eta) in [1.0 / ior, ior].into_iter().enumerate() {
            for row in 0..=STEPS {
                for column in 0..=STEPS {
                    let roughness = row as f64 / STEPS as f64;
                    let root = column as f64 / STEPS as f64;
                    let (back, on) = sent_on(root * root, roughness * roughness, eta, [f0, f90]);
                    lost[side][row][column] = (1.0 - back - on).clamp(0.0, 1.0) as f32;
                    if eta > 1.0 {
                        reflected[row][column] = back.clamp(0.0, 1.0) as f32;
                    }
                }
            }
        }
        let [front, back] = lost;
        Self { blocks: [front, back, reflected].map(|rows| (rows, rows.map(mean))) }
    }

    /// Returns the interpolated share under `cosine`.
    pub fn share(&self, block: Block, roughness: f32, cosine: f32) -> f32 {
        let (row, above) = place(roughness);
        let (column, right) = place(cosine.clamp(0.0, 1.0).sqrt());
        let rows = &self.blocks[block as usize].0;
        let between = |column: usize| mix(rows[row][column], rows[row + 1][column], above);
        mix(between(column), between(column + 1), right)
    }

    /// Returns the mean share over the hemisphere, weighted by the cosine.
    pub fn mean(&self, block: Block, roughness: f32) -> f32 {
        let (row, above) = place(roughness);
        let means = &self.blocks[block as usize].1;
        mix(means[row], means[row + 1], above)
    }
}

fn mix(a: f32, b: f32, weight: f32) -> f32 {
    a * (1.0 - weight) + b * weight
}

fn place(value: f32) -> (usize, f32) {
    let place = value.clamp(0.0, 1.0) * STEPS as f32;
    let index = (place as usize).min(STEPS - 1);
    (index, place - index as f32)
}

/// Returns the mean of values that are linear in the root y of the cosine: the integral of 4 y³ times the
/// value.
fn mean(values: [f32; STEPS + 1]) -> f32 {
    let fifth = |node: usize| (node as f64 / STEPS as f64).powi(5);
    // Integration by parts gives the value at the end, less the slopes times y⁴.
    let rise = |node: usize| f64::from(values[node + 1]) - f64::from(values[node]);
    let slopes: f64 = (0..STEPS).map(|node| rise(node) * (fifth(node + 1) - fifth(node))).sum();
    (f64::from(values[STEPS]) - slopes * STEPS as f64 / 5.0) as f32
}

/// Returns the shares of the light from `cosine` that one scattering reflects and refracts to the correct
/// side.
fn sent_on(cosine: f64, alpha: f64, eta: f64, [f0, f90]: [f64; 2]) -> (f64, f64) {
    let fresnel = |x: f64| {
        let squared = 1.0 - eta * eta * (1.0 - x * x);
        if eta > 1.0 && squared <= 0.0 {
            return 1.0;
        }
        let outer = if eta > 1.0 { squared.sqrt() } else { x };
        f0 + (f90 - f0) * (1.0 - outer).clamp(0.0, 1.0).powi(5)
    };
    if alpha == 0.0 {
        let reflected = fresnel(cosine);
        return (reflected, 1.0 - reflected);
    }
    let cosine = cosine.max(1.0e-6);
    let sine = (1.0 - cosine * cosine).sqrt();
    let root = |x: f64| (alpha * alpha + (1.0 - alpha * alpha) * x * x).sqrt();
    let passing = |x: f64| x * (cosine + root(cosine)) / (cosine * root(x) + x * root(cosine));
    let length = (alpha * sine).hypot(cosine);
    let (across, up) = (alpha * sine / length, cosine / length);
    let (mut back, mut on) = (0.0, 0.0);
    for point in 0..POINTS {
        let v = 1.0 - (2.0 * (point as f64 + 0.5) / POINTS as f64 - 1.0).abs();
        let azimuth = 2.0 * PI * ((point * STEP) % POINTS) as f64 / POINTS as f64;
        let z = (1.0 - v) * (1.0 + up) - up;
        let radius = (1.0 - z * z).max(0.0).sqrt();
        let x = alpha * (radius * azimuth.cos() + across);
        let y = alpha * radius * azimuth.sin();
        let z = (z + up).max(1.0e-12);
        let scale = (x * x + y * y + z * z).sqrt().recip();
        let (hx, hz) = (x * scale, z * scale);
        let at_facet = sine * hx + cosine * hz;
        let reflectance = fresnel(at_facet);
        let mirrored = 2.0 * at_facet * hz - cosine;
        if mirrored > 0.0 {
            back += reflectance * passing(mirrored);
        }
        let squared = 1.0 - eta * eta * (1.0 - at_facet * at_facet).max(0.0);
        if squared > 0.0 {
            let below = eta * cosine - (eta * at_facet - squared.sqrt()) * hz;
            if below > 0.0 {
                on += (1.0 - reflectance) * passing(below);
            }
        }
    }
    (back / POINTS as f64, on / POINTS as f64)
}
