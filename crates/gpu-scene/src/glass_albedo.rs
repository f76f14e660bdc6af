//! Light that rough glass loses in one scattering, as tables (`docs/shading.md`, "Energy").
//!
//! A table has three blocks: the share of light that is lost where it arrives at the front, the share that is
//! lost at the back, and the share that is reflected once where light arrives on the side of the larger
//! index. A block has a row for every roughness, and a row has a value for every cosine and their mean over
//! the hemisphere.

use std::{collections::HashMap, f64::consts::PI};

use glam::{DVec3, Vec3};
use rasray_scene::Scene;
use rasray_shaders_glsl::constants::scene::{
    ALBEDO_LOSSLESS_ALPHA, BSDF_STRAIGHT_INDEX, GLASS_ROW_WORDS, GLASS_ROWS,
};

use crate::{GpuSceneError, layout::Material, words::Words};

const ROWS: usize = GLASS_ROWS as usize;
const ROW_WORDS: usize = GLASS_ROW_WORDS as usize;
const TABLE_WORDS: usize = 3 * ROWS * ROW_WORDS;
/// Number of cosines of a row; the last word of a row is the mean.
const COSINES: usize = ROW_WORDS - 1;
/// Number of points of the Fibonacci lattice that integrates over visible normals, and its step: neighbours
/// in the Fibonacci sequence.
const POINTS: u32 = 2584;
const STEP: u32 = 1597;
/// Smallest cosine that is integrated: under a cosine of 0 the integrand has only a limit.
const LEAST_COSINE: f64 = 1.0e-6;

/// Parameters of a table.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Glass {
    /// Ratio of the index of the inside to that of the outside.
    ior: f32,
    /// Reflected share at normal incidence and at grazing incidence, of the brightest channel.
    f0: f32,
    f90: f32,
}

impl Glass {
    /// Returns the parameters of a material; `None` if it is never a rough volume that bends light.
    fn of(material: &rasray_scene::Material) -> Option<Self> {
        let bends = material.ior > 1.0e-3 && (material.ior - 1.0).abs() >= BSDF_STRAIGHT_INDEX;
        let volume = material.transmission > 0.0 && material.thickness > 0.0 && !material.unlit;
        let rough = material.roughness * material.roughness >= ALBEDO_LOSSLESS_ALPHA;
        let root = (material.ior - 1.0) / (material.ior + 1.0);
        let normal = (root * root * Vec3::from(material.specular_color)).min(Vec3::ONE) * material.specular;
        (bends && volume && rough).then(|| Self {
            ior: material.ior,
            f0: normal.max_element(),
            f90: material.specular,
        })
    }

    fn key(self) -> [u32; 3] {
        [self.ior, self.f0, self.f90].map(f32::to_bits)
    }

    fn table(self) -> Vec<f32> {
        let ior = f64::from(self.ior);
        let interfaces =
            [1.0 / ior, ior].map(|eta| Interface { eta, f0: self.f0.into(), f90: self.f90.into() });
        let [front, back] = interfaces.map(|interface| interface.rows());
        let dense = if interfaces[0].eta > 1.0 { &front } else { &back };
        let lost = |share: &Share| 1.0 - share.reflected - share.refracted;
        let mut table = Vec::with_capacity(TABLE_WORDS);
        append_block(&mut table, &front, lost);
        append_block(&mut table, &back, lost);
        append_block(&mut table, dense, |share| share.reflected);
        table
    }
}

/// Appends the tables of all materials that need one, equal tables once, and notes their first words.
///
/// # Errors
/// `TooManyVertices` where 32-bit word offsets do not reach.
pub fn append_glass_albedos(
    scene: &Scene,
    materials: &mut [Material],
    words: &mut Words,
) -> Result<(), GpuSceneError> {
    let mut offsets: HashMap<[u32; 3], u32> = HashMap::new();
    for (material, packed) in scene.materials.iter().zip(materials) {
        let Some(glass) = Glass::of(material) else { continue };
        packed.albedo = match offsets.get(&glass.key()) {
            Some(&offset) => offset,
            None => {
                let first = words.append(TABLE_WORDS, || glass.table())?;
                offsets.insert(glass.key(), first);
                first
            }
        };
    }
    Ok(())
}

/// Shares of the light that one scattering reflects and transmits.
#[derive(Clone, Copy, Debug, Default)]
struct Share {
    reflected: f64,
    refracted: f64,
}

/// Boundary seen from one of its sides.
#[derive(Clone, Copy, Debug)]
struct Interface {
    /// Ratio of the index on this side to that on the other.
    eta: f64,
    f0: f64,
    f90: f64,
}

impl Interface {
    fn rows(self) -> Vec<[Share; COSINES]> {
        let row = |row| {
            let roughness = row as f64 / (ROWS - 1) as f64;
            std::array::from_fn(|column| {
                let root = column as f64 / (COSINES - 1) as f64;
                self.share(root * root, roughness * roughness)
            })
        };
        (0..ROWS).map(row).collect()
    }

    /// Integrates over the normals that are visible under `cosine` (Dupuy and Benyoub 2023).
    fn share(self, cosine: f64, alpha: f64) -> Share {
        if alpha == 0.0 {
            return Share { reflected: self.fresnel(cosine), refracted: 1.0 - self.fresnel(cosine) };
        }
        let cosine = cosine.max(LEAST_COSINE);
        let o = DVec3::new((1.0 - cosine * cosine).sqrt(), 0.0, cosine);
        let stretched = DVec3::new(alpha * o.x, 0.0, o.z).normalize();
        let mut sum = Share::default();
        for point in 0..POINTS {
            // The folded coordinate makes the periodic integrand of the lattice continuous.
            let place = 1.0 - (2.0 * (f64::from(point) + 0.5) / f64::from(POINTS) - 1.0).abs();
            let azimuth = 2.0 * PI * f64::from(point * STEP % POINTS) / f64::from(POINTS);
            let z = (1.0 - place) * (1.0 + stretched.z) - stretched.z;
            let sine = (1.0 - z * z).max(0.0).sqrt();
            let h = DVec3::new(sine * azimuth.cos(), sine * azimuth.sin(), z) + stretched;
            let h = DVec3::new(alpha * h.x, alpha * h.y, h.z.max(1.0e-12)).normalize();
            self.add(o, h, alpha, &mut sum);
        }
        let points = f64::from(POINTS);
        Share { reflected: sum.reflected / points, refracted: sum.refracted / points }
    }

    /// Adds the light that a facet sends to the correct side and that the other facets do not block.
    fn add(self, o: DVec3, h: DVec3, alpha: f64, sum: &mut Share) {
        let cosine = o.dot(h);
        let fresnel = self.fresnel(cosine);
        let mirrored = 2.0 * cosine * h.z - o.z;
        if mirrored > 0.0 {
            sum.reflected += fresnel * passing(o.z, mirrored, alpha);
        }
        let sine_squared = self.eta * self.eta * (1.0 - cosine * cosine).max(0.0);
        if sine_squared < 1.0 {
            let refracted = self.eta * o.z - (self.eta * cosine - (1.0 - sine_squared).sqrt()) * h.z;
            if refracted > 0.0 {
                sum.refracted += (1.0 - fresnel) * passing(o.z, refracted, alpha);
            }
        }
    }

    fn fresnel(self, cosine: f64) -> f64 {
        let mut x = cosine;
        if self.eta > 1.0 {
            let sine_squared = self.eta * self.eta * (1.0 - cosine * cosine);
            if sine_squared >= 1.0 {
                return 1.0;
            }
            x = (1.0 - sine_squared).sqrt();
        }
        self.f0 + (self.f90 - self.f0) * (1.0 - x).clamp(0.0, 1.0).powi(5)
    }
}

/// Returns the ratio of the masking of both directions to that of the first: height-correlated Smith.
fn passing(cosine_o: f64, cosine_i: f64, alpha: f64) -> f64 {
    let root = |cosine: f64| (alpha * alpha + (1.0 - alpha * alpha) * cosine * cosine).sqrt();
    cosine_i * (cosine_o + root(cosine_o)) / (cosine_o * root(cosine_i) + cosine_i * root(cosine_o))
}

fn append_block(table: &mut Vec<f32>, rows: &[[Share; COSINES]], value: impl Fn(&Share) -> f64) {
    for row in rows {
        let values = row.each_ref().map(|share| value(share).clamp(0.0, 1.0) as f32);
        table.extend(values);
        table.push(mean(&values) as f32);
    }
}

/// Returns the mean of the interpolated values, over the hemisphere and weighted by the cosine: `4 y³ dy`
/// with y the root of the cosine.
fn mean(values: &[f32; COSINES]) -> f64 {
    let step = 1.0 / (COSINES - 1) as f64;
    let mut sum = 0.0;
    for (index, pair) in values.windows(2).enumerate() {
        let [a, b] = [pair[0], pair[1]].map(f64::from);
        let [from, to] = [index, index + 1].map(|node| node as f64 * step);
        let slope = (b - a) / step;
        sum += (a - slope * from) * (to.powi(4) - from.powi(4)) + slope * 0.8 * (to.powi(5) - from.powi(5));
    }
    sum
}
