use std::f64::consts::PI;

use glam::{DVec3, Vec2, Vec3};

use crate::shading::{
    albedo,
    glass_albedo::{self, Block},
    microfacet::{fresnel_power, ggx_visibility, ggx_visibility_one, ggx_visible_normal},
};

/// The polynomials are compared with the integrals to which they were fitted.
#[test]
fn albedos_are_those_of_the_integrals() {
    // The integrals use samples of visible normals: facets of reflectance 1 and (1 - x)^5.
    let integrals = |cosine: f32, alpha: f32| {
        let o = Vec3::new((1.0 - cosine * cosine).sqrt(), 0.0, cosine);
        let (steps, mut sums) = (200, [0.0_f64; 2]);
        for step in 0..steps * steps {
            let place = Vec2::new((step % steps) as f32 + 0.5, (step / steps) as f32 + 0.5) / steps as f32;
            let h = ggx_visible_normal(o, Vec2::splat(alpha), place);
            let i = 2.0 * o.dot(h) * h - o;
            if i.z > 0.0 {
                let kept = ggx_visibility(o.z, i.z, alpha) / ggx_visibility_one(o.z, alpha) * i.z;
                sums[0] += f64::from(kept);
                sums[1] += f64::from(kept * fresnel_power(o.dot(h)));
            }
        }
        sums.map(|sum| sum / f64::from(steps * steps))
    };
    let (mut loss_error, mut least, mut most) = (0.0_f64, 0.0_f64, 0.0_f64);
    for roughness in [0.1_f32, 0.15, 0.25, 0.4, 0.6, 0.8, 1.0] {
        let alpha = roughness * roughness;
        for cosine in [0.03_f32, 0.06, 0.1, 0.17, 0.3, 0.5, 0.8, 1.0] {
            let [whole, schlick] = integrals(cosine, alpha);
            let loss = albedo::loss(cosine, alpha);
            loss_error = loss_error.max((1.0 - f64::from(loss) - whole).abs());
            let error = f64::from(albedo::schlick(cosine, alpha, loss)) - schlick;
            (least, most) = (least.min(error), most.max(error));
        }
        // The means are those of the polynomials, so that lost and returned light agree.
        let (steps, mut means) = (2000, [0.0_f64; 2]);
        for step in 0..steps {
            let cosine = (step as f32 + 0.5) / steps as f32;
            let loss = albedo::loss(cosine, alpha);
            means[0] += 2.0 * f64::from(loss * cosine) / f64::from(steps);
            means[1] += 2.0 * f64::from(albedo::schlick(cosine, alpha, loss) * cosine) / f64::from(steps);
        }
        assert!((means[0] - f64::from(albedo::loss_mean(alpha))).abs() < 0.006, "{roughness} {means:?}");
        assert!((means[1] - f64::from(albedo::schlick_mean(alpha))).abs() < 0.004, "{roughness} {means:?}");
    }
    assert!(loss_error < 0.003 && least > -0.004 && most < 0.009, "{loss_error} {least} {most}");
}

/// The tables are compared with integrals over the slopes of facets.
#[test]
fn glass_tables_are_those_of_the_integrals() {
    let share = |interface: Interface, cosine: f64, alpha: f64| {
        let (o, root) = (DVec3::new((1.0 - cosine * cosine).sqrt(), 0.0, cosine), |x: f64| {
            (alpha * alpha + (1.0 - alpha * alpha) * x * x).sqrt()
        });
        let (rows, columns, mut sums) = (400, 200, [0.0_f64; 2]);
        for step in 0..rows * columns {
            let place = (f64::from(step / columns) + 0.5) / f64::from(rows);
            let azimuth = PI * (f64::from(step % columns) + 0.5) / f64::from(columns);
            let tangent = alpha * (1.0 - place * place).sqrt() / place;
            let up = (1.0 + tangent * tangent).sqrt().recip();
            let h = DVec3::new(up * tangent * azimuth.cos(), up * tangent * azimuth.sin(), up);
            if o.dot(h) <= 0.0 {
                continue;
            }
            let weight = 4.0 * place * o.dot(h) / (up * f64::from(rows * columns));
            // The factor has both ends of the height-correlated masking; the facet's own share is in the
            // weight.
            let visible = |x: f64| x / (cosine * root(x) + x * root(cosine)) * weight;
            let fresnel = interface.fresnel(o.dot(h));
            let mirrored = 2.0 * o.dot(h) * h - o;
            sums[0] += if mirrored.z > 0.0 { fresnel * visible(mirrored.z) } else { 0.0 };
            let refracted = (-o).refract(h, interface.eta);
            sums[1] += if refracted.z < 0.0 { (1.0 - fresnel) * visible(-refracted.z) } else { 0.0 };
        }
        sums
    };
    for (ior, f0, f90) in
        [(1.33_f32, 0.02_f32, 1.0_f32), (1.5, 0.02, 0.5), (2.4, 0.17, 1.0), (0.7, 0.03, 1.0)]
    {
        let table = glass_albedo::table(ior, f0, f90);
        let (mut worst, mut squares, mut count) = (0.0_f64, 0.0, 0.0);
        let mut compare = |found: f32, expected: f64| {
            let error = f64::from(found) - expected;
            worst = worst.max(error.abs());
            (squares, count) = (squares + error * error, count + 1.0);
        };
        for (side, eta) in [(Block::Front, 1.0 / f64::from(ior)), (Block::Back, f64::from(ior))] {
            let interface = Interface { eta, f0: f0.into(), f90: f90.into() };
            for row in [2_u8, 5, 9, 15] {
                for column in [1_u8, 4, 8, 11, 15] {
                    let (roughness, root) = (f64::from(row) / 15.0, f64::from(column) / 15.0);
                    let [reflected, refracted] = share(interface, root * root, roughness * roughness);
                    let (roughness, cosine) = (roughness as f32, (root * root) as f32);
                    compare(table.share(side, roughness, cosine), 1.0 - reflected - refracted);
                    if eta > 1.0 {
                        compare(table.share(Block::Reflected, roughness, cosine), reflected);
                    }
                }
            }
        }
        let root_mean = (squares / count).sqrt();
        assert!(worst < 3.0e-3 && root_mean < 6.0e-4, "{ior}: {worst} {root_mean}");
        // Means are those of the interpolated values.
        for roughness in [0.2_f32, 0.55, 1.0] {
            for block in [Block::Front, Block::Back, Block::Reflected] {
                let (steps, mut mean) = (3000_u16, 0.0);
                for step in 0..steps {
                    let cosine = (f32::from(step) + 0.5) / f32::from(steps);
                    mean +=
                        2.0 * f64::from(table.share(block, roughness, cosine) * cosine) / f64::from(steps);
                }
                assert!((mean - f64::from(table.mean(block, roughness))).abs() < 1.0e-5, "{ior} {block:?}");
            }
        }
    }
}

#[derive(Clone, Copy)]
struct Interface {
    eta: f64,
    f0: f64,
    f90: f64,
}

impl Interface {
    fn fresnel(self, cosine: f64) -> f64 {
        let squared = 1.0 - self.eta * self.eta * (1.0 - cosine * cosine);
        let outer = if self.eta > 1.0 { squared.max(0.0).sqrt() } else { cosine };
        let total = self.eta > 1.0 && squared <= 0.0;
        if total { 1.0 } else { self.f0 + (self.f90 - self.f0) * (1.0 - outer).powi(5) }
    }
}
