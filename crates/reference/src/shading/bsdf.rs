//! Scattering at a surface: value, density and sampling of its lobes.
//!
//! The lobes are diffuse and GGX reflection, thin-wall and volume transmission, and the light that leaves the
//! facets after several scatterings. Below [`SMOOTH_ROUGHNESS`] the microfacet lobes are perfect mirrors,
//! which are sampled but neither evaluated nor given a density.

use std::f32::consts::PI;

use glam::{Vec2, Vec3};

use super::{
    Surface, basis_around,
    bsdf_terms::{CosineProbability, Side, Terms},
    cosine_hemisphere, luminance,
    microfacet::{
        ggx_distribution, ggx_distribution_along, ggx_visibility, ggx_visibility_along, ggx_visibility_one,
        ggx_visibility_one_along, ggx_visible_normal,
    },
    ward::{ward_distribution, ward_half},
};

pub use super::bsdf_terms::SMOOTH_ROUGHNESS;

/// Direction chosen by the surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BsdfSample {
    /// Unit direction.
    pub direction: Vec3,
    /// Density, 1/sr; for delta lobes the probability of the choice.
    pub pdf: f32,
    /// Value times |cosine| over pdf.
    pub weight: Vec3,
    /// True for a perfect mirror or a smooth refraction.
    pub delta: bool,
    /// True if the direction goes through the surface.
    pub transmitted: bool,
}

/// Rough microfacet family towards a direction.
struct Facets {
    /// Cosine of o at the facet.
    cosine: f32,
    /// Value per unit of light reflected or transmitted at the facet.
    value: f32,
    pdf: f32,
}

impl Terms {
    fn reflect_probability(&self, cosine: f32) -> f32 {
        let (reflected, transmitted) =
            (luminance(self.reflected(cosine)), luminance(self.transmitted(cosine)));
        if transmitted > 0.0 { reflected / (reflected + transmitted) } else { 1.0 }
    }

    /// Returns D(h), 1/sr.
    fn distribution(&self, h: Vec3) -> f32 {
        self.alphas
            .map_or_else(|| ggx_distribution(h, self.alpha), |alphas| ggx_distribution_along(h, alphas))
    }

    /// Returns G(o, i) / (4 |cos o cos i|) and G1(o) / (4 cos o).
    fn visibilities(&self, i: Vec3) -> [f32; 2] {
        let (o, alpha) = (self.o, self.alpha);
        match self.alphas {
            Some(alphas) => [ggx_visibility_along(o, i, alphas), ggx_visibility_one_along(o, alphas)],
            None => [ggx_visibility(o.z, i.z.abs(), alpha), ggx_visibility_one(o.z, alpha)],
        }
    }

    fn facets(&self, i: Vec3, side: Side) -> Facets {
        let o = self.o;
        let [both, one] = self.visibilities(i);
        if side == Side::Reflected || self.eta == 1.0 {
            let up = Vec3::new(i.x, i.y, i.z.abs());
            let h = (o + up).normalize();
            if let Some(alphas) = self.ward {
                let (cosine, halves) = (o.dot(h), ward_distribution(h, alphas));
                let value = halves / (4.0 * cosine * cosine);
                return Facets { cosine, value, pdf: halves * h.z / (4.0 * cosine) };
            }
            let distribution = self.distribution(h);
            return Facets { cosine: o.dot(h), value: distribution * both, pdf: distribution * one };
        }
        let h = (self.eta * o + i).normalize();
        let h = if h.z < 0.0 { -h } else { h };
        let (cosine_o, cosine_i) = (o.dot(h), i.dot(h));
        // Both ends of a refraction lie on opposite sides of the facet.
        if cosine_o <= 0.0 || cosine_i >= 0.0 {
            return Facets { cosine: 0.0, value: 0.0, pdf: 0.0 };
        }
        let sum = self.eta * cosine_o + cosine_i;
        let jacobian = -cosine_i / (sum * sum);
        let distribution = self.distribution(h);
        Facets {
            cosine: cosine_o,
            value: distribution * both * 4.0 * cosine_o * jacobian,
            pdf: distribution * one * 4.0 * cosine_o * jacobian,
        }
    }

    fn refract(&self, h: Vec3) -> Option<Vec3> {
        let cosine = self.o.dot(h);
        if self.eta == 1.0 {
            let reflected = 2.0 * cosine * h - self.o;
            return Some(Vec3::new(reflected.x, reflected.y, -reflected.z));
        }
        let sine_squared = self.eta * self.eta * (1.0 - cosine * cosine).max(0.0);
        (sine_squared < 1.0)
            .then(|| (self.eta * cosine - (1.0 - sine_squared).sqrt()) * h - self.eta * self.o)
    }
}

/// Returns the side that the direction leads to, `cosine` being its cosine at a normal; `None` if that normal
/// and the geometric one disagree or the direction grazes.
fn side_of(surface: &Surface, world_i: Vec3, cosine: f32) -> Option<Side> {
    let geometric = surface.geometric_normal.dot(world_i);
    if cosine > 0.0 && geometric > 0.0 {
        Some(Side::Reflected)
    } else if cosine < 0.0 && geometric < 0.0 {
        Some(Side::Transmitted)
    } else {
        None
    }
}

/// Returns the light that leaves towards a direction, cosine included, in 1/sr, and the density with which
/// [`bsdf_sample`] chooses it. The families lie around different normals if one was bent. Delta lobes are
/// left out.
fn towards(terms: &Terms, surface: &Surface, i: Vec3) -> (Vec3, f32) {
    let (mut value, mut pdf) = (Vec3::ZERO, 0.0);
    if terms.o.z <= 0.0 {
        return (value, pdf);
    }
    let local = terms.frame.transpose() * i;
    let CosineProbability { family, through } = terms.cosine_probability();
    let base = terms.base.dot(local);
    if let Some(side) = side_of(surface, i, base) {
        let share = if side == Side::Reflected { 1.0 - through } else { through };
        value = terms.cosine_family(base.abs(), side) * base.abs();
        pdf = family * share * base.abs() / PI;
    }
    let Some(side) = side_of(surface, i, local.z).filter(|_| !terms.mirror) else { return (value, pdf) };
    let facets = terms.facets(local, side);
    let reflect_share = terms.reflect_probability(facets.cosine);
    let (colour, share) = match side {
        Side::Reflected => (terms.reflected(facets.cosine), reflect_share),
        Side::Transmitted => (terms.transmitted(facets.cosine), 1.0 - reflect_share),
    };
    (value + facets.value * local.z.abs() * colour, pdf + (1.0 - family) * facets.pdf * share)
}

/// Returns the light from `o` that leaves towards `i`, times the cosine of `i` at the normal of its lobe;
/// 1/sr. Delta lobes are left out. `o` and `i` are unit and point away.
pub fn bsdf_times_cosine(surface: &Surface, o: Vec3, i: Vec3) -> Vec3 {
    towards(&Terms::new(surface, o), surface, i).0
}

/// Returns [`bsdf_times_cosine`] over the cosine at the shading normal.
pub fn bsdf_evaluate(surface: &Surface, o: Vec3, i: Vec3) -> Vec3 {
    let cosine = surface.normal.dot(i).abs();
    if cosine > 0.0 { bsdf_times_cosine(surface, o, i) / cosine } else { Vec3::ZERO }
}

/// Returns the density in 1/sr with which [`bsdf_sample`] chooses `i`; delta lobes are left out.
pub fn bsdf_pdf(surface: &Surface, o: Vec3, i: Vec3) -> f32 {
    towards(&Terms::new(surface, o), surface, i).1
}

/// True if a surface scatters in more than single directions; `o` as in [`bsdf_times_cosine`].
pub fn bsdf_is_rough(surface: &Surface, o: Vec3) -> bool {
    let terms = Terms::new(surface, o);
    terms.cosine_probability().family > 0.0 || !terms.mirror
}

/// Returns the share of the light that goes straight through a pane ([`Surface::is_pane`]) towards `o`, and
/// the probability with which paths take it; 0 for every other surface.
pub fn bsdf_straight(surface: &Surface, o: Vec3) -> (Vec3, f32) {
    if surface.is_pane { Terms::new(surface, o).straight() } else { (Vec3::ZERO, 0.0) }
}

/// Chooses a direction. The random numbers choose lobe and side; two choose the direction. `None` if the
/// light is absorbed.
pub fn bsdf_sample(surface: &Surface, o: Vec3, [lobe, side, u, v]: [f32; 4]) -> Option<BsdfSample> {
    let terms = Terms::new(surface, o);
    if terms.o.z <= 0.0 {
        return None;
    }
    let CosineProbability { family, through } = terms.cosine_probability();
    let mut expected = Side::Reflected;
    let local = if lobe < family {
        let up = basis_around(terms.base) * cosine_hemisphere(Vec2::new(u, v));
        if side < through {
            expected = Side::Transmitted;
            up - 2.0 * up.dot(terms.base) * terms.base
        } else {
            up
        }
    } else {
        let alphas = terms.alphas.unwrap_or(Vec2::splat(terms.alpha));
        let h = match terms.ward {
            _ if terms.mirror => Vec3::Z,
            Some(alphas) => ward_half(alphas, Vec2::new(u, v)),
            None => ggx_visible_normal(terms.o, alphas, Vec2::new(u, v)),
        };
        let cosine = terms.o.dot(h);
        let reflect_share = terms.reflect_probability(cosine);
        let reflects = side < reflect_share;
        let local = if reflects {
            2.0 * cosine * h - terms.o
        } else {
            expected = Side::Transmitted;
            terms.refract(h)?
        };
        if terms.mirror {
            let probability = (1.0 - family) * if reflects { reflect_share } else { 1.0 - reflect_share };
            let share = if reflects { terms.reflected(cosine) } else { terms.transmitted(cosine) };
            let world = (terms.frame * local).normalize();
            if side_of(surface, world, local.z) != Some(expected) || !(probability > 0.0) {
                return None;
            }
            return Some(BsdfSample {
                direction: world,
                pdf: probability,
                weight: share / probability,
                delta: true,
                transmitted: !reflects,
            });
        }
        local
    };
    let world = (terms.frame * local).normalize();
    // A facet can send light through the surface as a whole; the cosine family compensates for this loss.
    let cosine = if lobe < family { local.dot(terms.base) } else { local.z };
    if side_of(surface, world, cosine) != Some(expected) {
        return None;
    }
    let (value, pdf) = towards(&terms, surface, world);
    if !(pdf > 0.0) || pdf > 1.0e30 {
        return None;
    }
    let weight = value / pdf;
    (weight.max_element() > 0.0).then_some(BsdfSample {
        direction: world,
        pdf,
        weight,
        delta: false,
        transmitted: expected == Side::Transmitted,
    })
}
