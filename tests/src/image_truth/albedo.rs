//! Directional albedo of the material model by quadrature: the radiance of a plane under a white sky.
//!
//! Written from the formulas of `docs/shading.md`, "Reflection and transmission", in f64 and without any
//! sampling, so that it shares nothing with the integrators but the formulas.

use std::f64::consts::PI;

/// Number of steps of the polar angle and of half the azimuth.
const STEPS: [usize; 2] = [800, 400];

/// Plastic: a diffuse base under a dielectric coat.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Plastic {
    /// Colour of the base, in [0, 1].
    pub base_color: f64,
    /// Perceptual roughness, in [0.03, 1].
    pub roughness: f64,
    /// Index of refraction.
    pub ior: f64,
}

fn schlick(f0: f64, cosine: f64) -> f64 {
    f0 + (1.0 - f0) * (1.0 - cosine).powi(5)
}

/// Integrates the mean over the upper hemisphere of `value(i . n, o . h, lobe)` weighted with the cosine,
/// where `lobe` is D G over four cosines.
fn integrate(cosine_o: f64, roughness: f64, value: impl Fn(f64, f64, f64) -> f64) -> f64 {
    let alpha_squared = roughness.powi(4);
    let sine_o = (1.0 - cosine_o * cosine_o).sqrt();
    let shadow = |cosine: f64| (cosine * cosine * (1.0 - alpha_squared) + alpha_squared).sqrt();
    let mut sum = 0.0;
    for polar in 0..STEPS[0] {
        let theta = 0.5 * PI * (polar as f64 + 0.5) / STEPS[0] as f64;
        let (sine_i, cosine_i) = theta.sin_cos();
        for azimuth in 0..STEPS[1] {
            let phi = PI * (azimuth as f64 + 0.5) / STEPS[1] as f64;
            let between = cosine_o * cosine_i + sine_o * sine_i * phi.cos();
            // By |o + i|^2 = 2 + 2 o.i, the half vector's cosines need no vector.
            let length = (2.0 + 2.0 * between).sqrt();
            let (facet, normal) = ((1.0 + between) / length, (cosine_o + cosine_i) / length);
            let slope = normal * normal * (alpha_squared - 1.0) + 1.0;
            let distribution = alpha_squared / (PI * slope * slope);
            let visibility = 0.5 / (cosine_i * shadow(cosine_o) + cosine_o * shadow(cosine_i));
            sum += value(cosine_i, facet, distribution * visibility) * cosine_i * sine_i;
        }
    }
    // Half of the azimuth stands for both halves.
    sum * 2.0 * (0.5 * PI / STEPS[0] as f64) * (PI / STEPS[1] as f64)
}

/// Shares of a white sky's light, for facets of one roughness.
#[derive(Clone, Copy)]
struct Facets {
    /// Share that facets of reflectance 1 lose in one scattering, at the given cosine.
    lost: f64,
    /// Share that facets of reflectance (1 - o.h)^5 send back.
    schlick: f64,
    /// Mean of `lost` over the hemisphere, weighted with the cosine.
    mean_lost: f64,
}

impl Facets {
    fn new(roughness: f64, cosine: f64) -> Self {
        const MEANS: usize = 48;
        let lost = |cosine| 1.0 - integrate(cosine, roughness, |_, _, lobe| lobe);
        let mean: f64 = (0..MEANS)
            .map(|step| (step as f64 + 0.5) / MEANS as f64)
            .map(|cosine| 2.0 * cosine * lost(cosine))
            .sum();
        Self {
            lost: lost(cosine),
            schlick: integrate(cosine, roughness, |_, facet, lobe| schlick(0.0, facet) * lobe),
            mean_lost: mean / MEANS as f64,
        }
    }

    /// Returns the share that facets of this reflectance at normal incidence send back, after any number of
    /// scatterings.
    fn reflected(&self, f0: f64) -> f64 {
        let once = f0 * (1.0 - self.lost - self.schlick) + self.schlick;
        // Light that is lost hits facets again, each time with their mean reflectance.
        let mean = f0 + (1.0 - f0) / 21.0;
        let returned = mean * mean * (1.0 - self.mean_lost) / (1.0 - mean * self.mean_lost);
        once + returned * self.lost
    }
}

/// Returns the share of a white sky that a metal of this base colour shows at the cosine `cosine_o`.
pub fn metal_albedo(base_color: f64, roughness: f64, cosine_o: f64) -> f64 {
    Facets::new(roughness, cosine_o).reflected(base_color)
}

/// Returns the share of a white sky that a plastic shows at the cosine `cosine_o`.
pub fn plastic_albedo(plastic: Plastic, cosine_o: f64) -> f64 {
    let f0 = ((plastic.ior - 1.0) / (plastic.ior + 1.0)).powi(2);
    let reflected = Facets::new(plastic.roughness, cosine_o).reflected(f0);
    // The base gets the light that passes the coat, and the coat lets an equal share out again.
    reflected + plastic.base_color * (1.0 - reflected)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_base_without_coat_shows_its_colour() {
        // This checks the quadrature itself: a constant lobe integrates to pi.
        assert!((integrate(0.7, 0.5, |_, _, _| 1.0 / PI) - 1.0).abs() < 1e-5);
    }

    #[test]
    fn smooth_facets_lose_nothing_and_rough_ones_what_others_return() {
        let smooth = Facets::new(0.3, 0.9);
        assert!(smooth.lost > 0.0 && smooth.lost < 0.02, "{}", smooth.lost);
        let rough = Facets::new(1.0, 0.5);
        assert!(rough.lost > 0.2 && rough.lost < 0.6, "{}", rough.lost);
        for facets in [smooth, rough] {
            assert!((facets.reflected(1.0) - 1.0).abs() < 1e-12);
            assert!(facets.reflected(0.7) < 0.75);
        }
        for cosine in [0.1, 0.5, 1.0] {
            let plastic = Plastic { base_color: 1.0, roughness: 0.6, ior: 1.5 };
            assert!((plastic_albedo(plastic, cosine) - 1.0).abs() < 1e-12);
        }
    }
}
