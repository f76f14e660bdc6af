//! Radiance from outside: constant, or a latitude-longitude map of constant texels.

use std::f32::consts::PI;

use glam::{Vec2, Vec3};
use rasray_scene::Environment;

use super::luminance;

/// Environment with its distribution.
#[derive(Clone, Debug, Default)]
pub struct EnvironmentTable {
    constant: Vec3,
    map: Option<Map>,
    sampled: bool,
    irradiance: f64,
}

#[derive(Clone, Debug)]
struct Map {
    width: usize,
    height: usize,
    radiance: Vec<Vec3>,
    rows: Vec<f32>,
    columns: Vec<Vec<f32>>,
}

/// Returns the cumulative shares of `weights`, summed in f64 and rounded once; 1 from the last entry with
/// weight on.
pub(super) fn cumulative_shares(weights: &[f64]) -> (f64, Vec<f32>) {
    let total: f64 = weights.iter().sum();
    let last = weights.iter().rposition(|weight| *weight > 0.0).unwrap_or(0);
    let mut sum = 0.0;
    let shares = weights.iter().enumerate().map(|(index, weight)| {
        sum += weight;
        if index >= last || total <= 0.0 { 1.0 } else { (sum / total) as f32 }
    });
    (total, shares.collect())
}

/// Returns the first entry whose cumulative share exceeds `random`.
pub(super) fn search(shares: &[f32], random: f32) -> usize {
    shares.partition_point(|share| *share <= random).min(shares.len().saturating_sub(1))
}

/// Returns the share of one entry.
pub(super) fn share(shares: &[f32], index: usize) -> f32 {
    if index == 0 { shares[0] } else { shares[index] - shares[index - 1] }
}

impl EnvironmentTable {
    /// Makes the table of an environment whose size fits its texels.
    pub fn new(environment: &Environment) -> Self {
        match environment {
            Environment::Constant(radiance) => {
                let constant = Vec3::from(*radiance);
                let irradiance = 4.0 * std::f64::consts::PI * f64::from(luminance(constant));
                Self { constant, map: None, sampled: constant.max_element() > 0.0, irradiance }
            }
            Environment::LatLong { width, height, radiance } => {
                let (width, height) = (*width as usize, *height as usize);
                let radiance: Vec<Vec3> = radiance.iter().map(|texel| Vec3::from(*texel)).collect();
                let mut columns = Vec::with_capacity(height);
                let mut row_weights = Vec::with_capacity(height);
                for row in 0..height {
                    let step = std::f64::consts::PI / height as f64;
                    let angle = (step * (row as f64 + 0.5)).sin() * (0.5 * step).sin();
                    let solid_angle = 4.0 * std::f64::consts::PI / width as f64 * angle;
                    let weights: Vec<f64> = radiance[row * width..(row + 1) * width]
                        .iter()
                        .map(|texel| f64::from(luminance(*texel)).max(0.0) * solid_angle)
                        .collect();
                    let (total, shares) = cumulative_shares(&weights);
                    columns.push(shares);
                    row_weights.push(total);
                }
                let (total, rows) = cumulative_shares(&row_weights);
                let map = Some(Map { width, height, radiance, rows, columns });
                Self { constant: Vec3::ZERO, map, sampled: total > 0.0, irradiance: total }
            }
        }
    }

    /// True if light samples of the environment are worth taking.
    pub fn is_sampled(&self) -> bool {
        self.sampled
    }

    /// Returns the luminance of the radiance over the whole sphere, W/m^2.
    pub fn irradiance(&self) -> f64 {
        self.irradiance
    }

    /// Returns the radiance that arrives against the unit `direction`, W/(sr m^2).
    pub fn radiance(&self, direction: Vec3) -> Vec3 {
        self.map
            .as_ref()
            .map_or(self.constant, |map| map.radiance[map.row(direction) * map.width + map.column(direction)])
    }

    /// Returns the density of [`EnvironmentTable::sample`], 1/sr.
    pub fn pdf(&self, direction: Vec3) -> f32 {
        self.map.as_ref().map_or(1.0 / (4.0 * PI), |map| map.pdf(map.row(direction), map.column(direction)))
    }

    /// Chooses a direction and returns it with its radiance and pdf: `pick` chooses the row, `place.x` the
    /// column and the azimuth within it, `place.y` the polar angle within the row.
    pub fn sample(&self, pick: f32, place: Vec2) -> (Vec3, Vec3, f32) {
        let (cosine, azimuth, radiance, pdf) = match &self.map {
            None => (1.0 - 2.0 * place.x, 2.0 * PI * place.y, self.constant, 1.0 / (4.0 * PI)),
            Some(map) => {
                let row = search(&map.rows, pick);
                let column = search(&map.columns[row], place.x);
                let share = share(&map.columns[row], column);
                let within = if share > 0.0 { (map.columns[row][column] - place.x) / share } else { 0.5 };
                let azimuth = 2.0 * PI * (column as f32 + within.clamp(0.0, 1.0)) / map.width as f32;
                let upper = (PI * row as f32 / map.height as f32).cos();
                let lower = (PI * (row + 1) as f32 / map.height as f32).cos();
                let cosine = upper + (lower - upper) * place.y;
                (cosine, azimuth, map.radiance[row * map.width + column], map.pdf(row, column))
            }
        };
        let sine = (1.0 - cosine * cosine).max(0.0).sqrt();
        (Vec3::new(sine * azimuth.cos(), cosine, sine * azimuth.sin()), radiance, pdf)
    }
}

impl Map {
    fn column(&self, direction: Vec3) -> usize {
        let turn = direction.z.atan2(direction.x) / (2.0 * PI);
        let turn = if turn < 0.0 { turn + 1.0 } else { turn };
        ((turn * self.width as f32) as usize).min(self.width - 1)
    }

    fn row(&self, direction: Vec3) -> usize {
        let angle = direction.y.clamp(-1.0, 1.0).acos() / PI;
        ((angle * self.height as f32) as usize).min(self.height - 1)
    }

    fn pdf(&self, row: usize, column: usize) -> f32 {
        let step = PI / self.height as f32;
        let angle = (step * (row as f32 + 0.5)).sin() * (0.5 * step).sin();
        let solid_angle = (2.0 * PI / self.width as f32) * 2.0 * angle;
        share(&self.rows, row) * share(&self.columns[row], column) / solid_angle
    }
}
