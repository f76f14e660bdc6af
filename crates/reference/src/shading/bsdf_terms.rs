//! Terms of scattering at one surface towards one direction: shares, probabilities and the light that leaves
//! the facets after several scatterings.

use std::f32::consts::PI;

use glam::{Mat3, Vec2, Vec3};

use super::{
    Surface, albedo, basis_around,
    facet_normal::facet_normal,
    glass_albedo::{self, Block},
    luminance,
    microfacet::fresnel_power,
};

/// Perceptual roughness below which the microfacet lobes are perfect mirrors.
pub const SMOOTH_ROUGHNESS: f32 = 0.03;
/// Largest difference of an index from 1 at which light is not bent.
const STRAIGHT_INDEX: f32 = 1.0e-3;
/// Bounds of the probability of the cosine family where both families exist.
const COSINE_BOUNDS: (f32, f32) = (0.05, 0.95);
/// Multiple of the cosine family's share of the light that the lower bound does not exceed.
const COSINE_FACTOR: f32 = 4.0;

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Side {
    Reflected,
    Transmitted,
}

pub struct Terms {
    pub f0: Vec3,
    pub f90: f32,
    pub base_color: Vec3,
    pub metallic: f32,
    pub transmission: f32,
    /// Alpha of the facets; 0 for perfect mirrors. For facets that are rougher along one direction it is the
    /// root mean square.
    pub alpha: f32,
    /// Alphas along x and y of the frame, if they differ.
    pub alphas: Option<Vec2>,
    /// Alphas of Ward's lobe, if the surface reflects by it.
    pub ward: Option<Vec2>,
    /// Ratio of the index on the side of o to that on the other side; 1 means straight on.
    pub eta: f32,
    pub mirror: bool,
    /// True if light that goes straight through is followed separately, and is in no lobe.
    pane: bool,
    /// Rotation from local to world; z is the normal of the facets.
    pub frame: Mat3,
    /// Shading normal, local: the cosine family lies around it.
    pub base: Vec3,
    /// Direction o, local.
    pub o: Vec3,
    /// Terms of glass, for a rough volume.
    glass: Option<Glass>,
    energy: Energy,
}

/// Light that one scattering at the boundary of a rough volume loses, and its distribution.
struct Glass {
    table: &'static glass_albedo::Table,
    roughness: f32,
    /// Side of o.
    side: Block,
    /// Share that is lost from o, its mean over the hemisphere, and the mean on the other side.
    loss: f32,
    mean: f32,
    beyond: f32,
    /// Shares of the lost light that are reflected, and that are transmitted.
    returned: Vec3,
    passed: Vec3,
}

/// Light that one scattering at the facets loses, and its distribution.
#[derive(Default)]
struct Energy {
    /// Share that is lost from o, and its mean over the hemisphere.
    loss: f32,
    loss_mean: f32,
    /// Shares of the lost light that are reflected, and that are transmitted by a thin wall.
    returned: Vec3,
    passed: Vec3,
    /// Largest channel of the share that the dielectric reflects.
    returned_most: f32,
    /// Share of the light from o that the dielectric lets in, and its mean over the hemisphere.
    entering: f32,
    entering_mean: f32,
}

/// Probability of the cosine family, and within it of transmission.
pub struct CosineProbability {
    pub family: f32,
    pub through: f32,
}

/// Returns a frame along whose x axis facets are rougher, and the alphas along x and y; `None` if the facets
/// are equally rough in all directions.
fn anisotropy(surface: &Surface, normal: Vec3) -> Option<(Mat3, Vec2)> {
    let along = surface.rougher - normal * normal.dot(surface.rougher);
    if !(surface.anisotropy > 0.0) || !(along.length_squared() > 0.0) {
        return None;
    }
    let along = along / along.length();
    let roughness = surface.roughness.max(SMOOTH_ROUGHNESS);
    let least = roughness * roughness;
    let alphas = Vec2::new(least + (1.0 - least) * surface.anisotropy * surface.anisotropy, least);
    Some((Mat3::from_cols(along, normal.cross(along), normal), alphas))
}

impl Terms {
    pub fn new(surface: &Surface, o: Vec3) -> Self {
        let ior = if surface.ior > 1.0e-3 { surface.ior } else { 1.0 };
        let root = (surface.ior.max(0.0) - 1.0) / (surface.ior.max(0.0) + 1.0);
        let straight =
            surface.thickness <= 0.0 || surface.transmission <= 0.0 || (ior - 1.0).abs() < STRAIGHT_INDEX;
        let normal = facet_normal(surface.normal, surface.geometric_normal, o);
        let anisotropy = anisotropy(surface, normal);
        let frame = anisotropy.map_or_else(|| basis_around(normal), |(frame, _)| frame);
        let alphas = anisotropy.map(|(_, alphas)| alphas);
        let mirror = surface.roughness < SMOOTH_ROUGHNESS && alphas.is_none();
        let rough = alphas.unwrap_or(Vec2::splat(surface.roughness * surface.roughness));
        let ward = (surface.is_ward && !(surface.transmission > 0.0) && !mirror).then_some(rough);
        let mut terms = Self {
            f0: (root * root * surface.specular_color).min(Vec3::ONE) * surface.specular,
            f90: surface.specular,
            base_color: surface.base_color,
            metallic: surface.metallic,
            transmission: surface.transmission,
            // Losses of Ward's lobe are not compensated: the other lobes are as below a mirror.
            alpha: match alphas {
                _ if ward.is_some() => 0.0,
                Some(alphas) => (0.5 * alphas.length_squared()).sqrt(),
                None if mirror => 0.0,
                None => surface.roughness * surface.roughness,
            },
            alphas,
            ward,
            eta: match (straight, surface.front) {
                (true, _) => 1.0,
                (false, true) => 1.0 / ior,
                (false, false) => ior,
            },
            mirror,
            pane: surface.is_pane,
            frame,
            base: frame.transpose() * surface.normal,
            o: frame.transpose() * o,
            glass: None,
            energy: Energy::default(),
        };
        if terms.eta != 1.0 && terms.alpha >= albedo::LOSSLESS_ALPHA {
            terms.glass = Some(terms.glass(ior, surface));
        }
        terms.set_energy();
        terms
    }

    /// Computes the terms of glass. Lost light is transmitted in the share that the facets transmit, but no
    /// more than is lost for light that takes the same way back.
    fn glass(&self, ior: f32, surface: &Surface) -> Glass {
        let table = glass_albedo::table(ior, self.f0.max_element(), self.f90);
        let roughness = if self.alphas.is_some() { self.alpha.sqrt() } else { surface.roughness };
        let side = if surface.front { Block::Front } else { Block::Back };
        let (mean, beyond) = (table.mean(side, roughness), table.mean(side.beyond(), roughness));
        let mut glass = Glass {
            table,
            roughness,
            side,
            loss: 0.0,
            mean: 0.0,
            beyond: 0.0,
            returned: Vec3::ZERO,
            passed: Vec3::ZERO,
        };
        if !(mean > 0.0) || !(beyond > 0.0) {
            return glass;
        }
        let through = self.facet_through() * (beyond / mean).min(1.0);
        let facet = self.facet_mean();
        let tinted = self.eta < 1.0 && facet.max_element() > 0.0;
        let tint = if tinted { facet / facet.max_element() } else { Vec3::ONE };
        glass.loss = table.share(side, roughness, self.o.z.max(0.0));
        (glass.mean, glass.beyond) = (mean, beyond);
        glass.returned = tint * (self.volume_share() * (1.0 - through));
        glass.passed = self.base_color * (self.volume_share() * through);
        glass
    }

    /// Returns the share of the surface that lets light through.
    fn volume_share(&self) -> f32 {
        (1.0 - self.metallic) * self.transmission
    }

    /// Returns the mean reflectance of the dielectric's facets on the side of the smaller index.
    fn facet_mean(&self) -> Vec3 {
        self.f0 + (Vec3::splat(self.f90) - self.f0) * albedo::SCHLICK_MEAN
    }

    /// Returns the mean share that facets let through, by the brightest channel.
    fn facet_through(&self) -> f32 {
        let through = 1.0 - self.facet_mean().max_element();
        if self.eta > 1.0 { through / (self.eta * self.eta) } else { through }
    }

    /// Sets the energy of surfaces that are no volume. Light that the dielectric loses on the side of the
    /// larger index counts as let in.
    fn set_energy(&mut self) {
        let cosine = self.o.z.max(0.0);
        self.energy.loss = albedo::loss(cosine, self.alpha);
        self.energy.loss_mean = albedo::loss_mean(self.alpha);
        let loss_mean = self.energy.loss_mean;
        let metal = self.base_color + (Vec3::ONE - self.base_color) * albedo::SCHLICK_MEAN;
        let mut returned =
            if self.eta > 1.0 { Vec3::ZERO } else { albedo::returned(self.facet_mean(), loss_mean) };
        self.energy.returned_most = returned.max_element();
        if self.eta != 1.0 {
            returned *= 1.0 - self.transmission;
        }
        self.energy.returned = returned.lerp(albedo::returned(metal, loss_mean), self.metallic);
        let through = if self.eta == 1.0 { self.volume_share() } else { 0.0 };
        self.energy.passed = self.base_color * (through * (1.0 - self.energy.returned_most));
        self.energy.entering = self.entering(cosine, self.energy.loss);
        self.energy.entering_mean = self.entering_mean();
    }

    /// Returns the share of the light that the dielectric as a whole does not reflect, by its brightest
    /// channel.
    fn entering(&self, cosine: f32, loss: f32) -> f32 {
        if self.eta > 1.0 {
            return match &self.glass {
                Some(glass) => 1.0 - glass.table.share(Block::Reflected, glass.roughness, cosine),
                None => 1.0 - self.fresnel(cosine).max_element(),
            };
        }
        let schlick = albedo::schlick(cosine, self.alpha, loss);
        let once = self.f0.max_element() * (1.0 - loss - schlick) + self.f90 * schlick;
        (1.0 - once - self.energy.returned_most * loss).max(0.0)
    }

    fn entering_mean(&self) -> f32 {
        if self.eta > 1.0 {
            let entering = match &self.glass {
                Some(glass) => 1.0 - glass.table.mean(Block::Reflected, glass.roughness),
                None => self.facet_through(),
            };
            return entering.max(1.0e-6);
        }
        let (schlick, loss) = (albedo::schlick_mean(self.alpha), self.energy.loss_mean);
        let once = self.f0.max_element() * (1.0 - loss - schlick) + self.f90 * schlick;
        (1.0 - once - self.energy.returned_most * loss).max(1.0e-3)
    }

    /// Returns the reflected share of the dielectric at a facet seen under `cosine`.
    pub fn fresnel(&self, cosine: f32) -> Vec3 {
        let mut x = cosine;
        if self.eta > 1.0 {
            let sine_squared = self.eta * self.eta * (1.0 - cosine * cosine);
            if sine_squared >= 1.0 {
                return Vec3::ONE;
            }
            x = (1.0 - sine_squared).sqrt();
        }
        self.f0 + (Vec3::splat(self.f90) - self.f0) * fresnel_power(x)
    }

    pub fn reflected(&self, cosine: f32) -> Vec3 {
        let metal = self.base_color + (Vec3::ONE - self.base_color) * fresnel_power(cosine);
        self.fresnel(cosine).lerp(metal, self.metallic)
    }

    pub fn transmitted(&self, cosine: f32) -> Vec3 {
        if self.pane { Vec3::ZERO } else { self.facet_transmitted(cosine) }
    }

    fn facet_transmitted(&self, cosine: f32) -> Vec3 {
        let through = 1.0 - self.fresnel(cosine).max_element();
        self.base_color * (self.volume_share() * through)
    }

    /// Returns the share of the light that a pane lets through in a straight line, and the probability with
    /// which paths take it.
    pub fn straight(&self) -> (Vec3, f32) {
        let share = if self.pane && self.o.z > 0.0 { self.facet_transmitted(self.o.z) } else { Vec3::ZERO };
        let through = luminance(share);
        if !(through > 0.0) {
            return (share, 0.0);
        }
        let rest = luminance(self.reflected(self.o.z))
            + luminance(self.base_color) * (self.diffuse_share() * self.energy.entering);
        (share, through / (through + rest))
    }

    fn diffuse_share(&self) -> f32 {
        (1.0 - self.metallic) * (1.0 - self.transmission)
    }

    /// Returns the light that leaves the boundary of a rough volume after several scatterings; 1/sr.
    fn several_in_glass(&self, cosine: f32, side: Side) -> Vec3 {
        let Some(glass) = self.glass.as_ref().filter(|glass| glass.mean > 0.0) else { return Vec3::ZERO };
        let share = |block| glass.loss * glass.table.share(block, glass.roughness, cosine) / PI;
        match side {
            Side::Reflected => glass.returned * (share(glass.side) / glass.mean),
            Side::Transmitted => glass.passed * (share(glass.side.beyond()) / glass.beyond),
        }
    }

    /// Returns the diffuse base, and the light that leaves the facets after several scatterings; 1/sr.
    pub fn cosine_family(&self, cosine: f32, side: Side) -> Vec3 {
        let energy = &self.energy;
        let loss = albedo::loss(cosine, self.alpha);
        let several = if energy.loss > 0.0 { energy.loss * loss / (energy.loss_mean * PI) } else { 0.0 };
        let glass = self.several_in_glass(cosine, side);
        if side == Side::Transmitted {
            return energy.passed * several + glass;
        }
        let share = self.diffuse_share();
        if share <= 0.0 {
            return energy.returned * several + glass;
        }
        let through = energy.entering * self.entering(cosine, loss) / energy.entering_mean;
        energy.returned * several + glass + self.base_color * (share * through / PI)
    }

    pub fn cosine_probability(&self) -> CosineProbability {
        let energy = &self.energy;
        let (mut loss, mut down) = (energy.loss, luminance(energy.passed) * energy.loss);
        let mut up = luminance(energy.returned) * energy.loss
            + luminance(self.base_color) * (self.diffuse_share() * energy.entering);
        if let Some(glass) = self.glass.as_ref().filter(|glass| glass.mean > 0.0) {
            down += luminance(glass.passed) * glass.loss;
            up += luminance(glass.returned) * glass.loss;
            loss += (glass.loss - loss) * self.volume_share();
        }
        let total = up + down;
        let facets = (1.0 - loss) * luminance(self.reflected(self.o.z) + self.transmitted(self.o.z));
        let through = if total > 0.0 { down / total } else { 0.0 };
        let family = if total <= 0.0 {
            0.0
        } else if facets <= 0.0 {
            1.0
        } else {
            let share = total / (total + facets);
            share.clamp(COSINE_BOUNDS.0.min(COSINE_FACTOR * share), COSINE_BOUNDS.1)
        };
        CosineProbability { family, through }
    }
}
