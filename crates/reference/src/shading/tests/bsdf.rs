use std::f64::consts::PI;

use glam::Vec3;

use crate::shading::{
    Surface, bsdf::SMOOTH_ROUGHNESS, bsdf_evaluate, bsdf_pdf, bsdf_sample, bsdf_times_cosine,
    random::RandomStream,
};

/// Returns surfaces that exercise every lobe; glass from both sides.
fn surfaces() -> Vec<(&'static str, Surface)> {
    let base = Surface { specular: 1.0, ..Surface::default() };
    let colored = Vec3::new(0.9, 0.6, 0.3);
    let mut all = Vec::new();
    for roughness in [0.2, 0.5, 1.0] {
        let rough = Surface { roughness, ..base };
        let glass = Surface { transmission: 1.0, thickness: 1.0, ..rough };
        all.extend([
            ("plastic", rough),
            ("metal", Surface { metallic: 1.0, base_color: colored, ..rough }),
            ("half metal", Surface { metallic: 0.5, base_color: colored, ..rough }),
            ("thin wall", Surface { transmission: 1.0, ..rough }),
            ("glass", glass),
            ("glass from inside", Surface { front: false, ..glass }),
            ("milky", Surface { transmission: 0.5, base_color: colored, ..glass }),
            ("dense", Surface { ior: 2.5, specular_color: Vec3::new(0.2, 0.9, 1.0), ..glass }),
            ("bubble", Surface { ior: 0.7, transmission: 0.8, ..glass }),
            ("bubble from inside", Surface { ior: 0.7, transmission: 0.8, front: false, ..glass }),
            ("weak glass", Surface { specular: 0.2, ior: 1.8, ..glass }),
            ("weak milk from inside", Surface { specular: 0.0, transmission: 0.5, front: false, ..glass }),
            ("part metal", Surface { metallic: 0.3, ..glass }),
            ("straight volume", Surface { ior: 1.0, ..glass }),
            ("weak specular", Surface { specular: 0.3, ior: 1.8, ..rough }),
        ]);
    }
    all
}

/// Returns surfaces whose facets are rougher along one direction, which leans out of the surface.
fn anisotropic() -> Vec<(&'static str, Surface)> {
    let rougher = Vec3::new(3.0, -1.0, 0.5);
    let base = Surface { specular: 1.0, rougher, ..Surface::default() };
    let mut all = Vec::new();
    for (roughness, anisotropy) in [(0.3, 0.5), (0.5, 1.0), (0.6, 0.2)] {
        let brushed = Surface { roughness, anisotropy, ..base };
        let glass = Surface { transmission: 1.0, thickness: 1.0, ..brushed };
        all.extend([
            ("brushed plastic", brushed),
            ("brushed metal", Surface { metallic: 1.0, base_color: Vec3::new(0.9, 0.6, 0.3), ..brushed }),
            ("brushed thin wall", Surface { transmission: 1.0, ..brushed }),
            ("brushed glass", glass),
            ("brushed glass from inside", Surface { front: false, ..glass }),
        ]);
    }
    all
}

/// Returns surfaces that reflect by Ward's lobe.
fn of_ward() -> Vec<(&'static str, Surface)> {
    let base =
        Surface { specular: 1.0, is_ward: true, rougher: Vec3::new(3.0, -1.0, 0.5), ..Surface::default() };
    let mut all = Vec::new();
    for (roughness, anisotropy) in [(0.3, 0.0), (0.7, 0.0), (1.0, 0.0), (0.4, 0.6)] {
        let ward = Surface { roughness, anisotropy, ..base };
        all.extend([
            ("Ward plastic", ward),
            ("Ward metal", Surface { metallic: 1.0, base_color: Vec3::new(0.9, 0.6, 0.3), ..ward }),
            ("Ward half metal", Surface { metallic: 0.5, ..ward }),
        ]);
    }
    all
}

pub(super) fn directions() -> [Vec3; 3] {
    [0.05_f32, 0.7, 1.35].map(|angle| Vec3::new(angle.sin() * 0.6, angle.sin() * 0.8, angle.cos()))
}

pub(super) fn random(index: u32) -> [f32; 4] {
    RandomStream { seed: 11, pixel: index, sample: 0 }.four(0)
}

/// Integrates over the sphere, by the midpoint rule in polar angle and azimuth about z. Lobes lie around the
/// mirrored and refracted directions of light from `o`: azimuths are dense there.
fn over_sphere<const N: usize>(o: Vec3, value: impl Fn(Vec3) -> [f64; N]) -> [f64; N] {
    over_sphere_in_rows(720, o, value)
}

fn over_sphere_in_rows<const N: usize>(rows: u32, o: Vec3, value: impl Fn(Vec3) -> [f64; N]) -> [f64; N] {
    let columns = 160;
    let ahead = f64::from(o.y).atan2(f64::from(o.x)) + PI;
    let mut sums = [0.0; N];
    for row in 0..rows {
        let angle = PI * (f64::from(row) + 0.5) / f64::from(rows);
        for column in 0..columns {
            let place = 2.0 * (f64::from(column) + 0.5) / f64::from(columns) - 1.0;
            let azimuth = ahead + PI * place * place.abs();
            let direction =
                glam::DVec3::new(angle.sin() * azimuth.cos(), angle.sin() * azimuth.sin(), angle.cos());
            let steradians =
                angle.sin() * PI / f64::from(rows) * 2.0 * PI * place.abs() * 2.0 / f64::from(columns);
            for (sum, term) in sums.iter_mut().zip(value(direction.as_vec3())) {
                *sum += term * steradians;
            }
        }
    }
    sums
}

/// The density adds up to the share of samples that are not absorbed, and samples follow it: the
/// means of the direction agree as well.
#[test]
fn densities_describe_the_samples() {
    let count = 20_000;
    for (name, surface) in surfaces().into_iter().chain(anisotropic()).chain(of_ward()) {
        for o in directions() {
            let mut sums = [0.0; 4];
            for index in 0..count {
                let Some(sample) = bsdf_sample(&surface, o, random(index)) else { continue };
                let d = sample.direction.as_dvec3();
                for (sum, value) in sums.iter_mut().zip([1.0, d.x, d.y, d.z]) {
                    *sum += value / f64::from(count);
                }
            }
            let integrals = over_sphere(o, |i| {
                let pdf = f64::from(bsdf_pdf(&surface, o, i));
                [pdf, pdf * f64::from(i.x), pdf * f64::from(i.y), pdf * f64::from(i.z)]
            });
            for (axis, (sampled, expected)) in sums.into_iter().zip(integrals).enumerate() {
                // Values lie in [-1, 1]: one standard error is at most 1 / sqrt(count).
                let error = (sampled - expected).abs();
                assert!(
                    error < 4.5 / f64::from(count).sqrt(),
                    "{name} {o}: moment {axis} {sampled} {expected}"
                );
            }
        }
    }
}

/// The test above notices a density that is 5 percent off, at its own tolerance.
#[test]
fn a_wrong_density_would_be_seen() {
    let surface = Surface { specular: 1.0, roughness: 0.5, ..Surface::default() };
    let [total] = over_sphere(Vec3::Z, |i| [f64::from(bsdf_pdf(&surface, Vec3::Z, i)) * 1.05]);
    assert!((total - 1.0).abs() > 4.5 / 20_000.0_f64.sqrt());
}

/// Weights are value times cosine over density, and their mean is the integral of value times cosine.
#[test]
fn weights_are_value_times_cosine_over_density() {
    for (name, surface) in surfaces().into_iter().chain(anisotropic()).chain(of_ward()) {
        for o in directions() {
            for index in 0..200 {
                let Some(sample) = bsdf_sample(&surface, o, random(index)) else { continue };
                let value = bsdf_evaluate(&surface, o, sample.direction);
                let expected = value * sample.direction.z.abs() / sample.pdf;
                assert!(
                    (sample.weight - expected).abs().max_element() < 1.0e-3 * expected.max_element(),
                    "{name}"
                );
                assert_eq!(sample.transmitted, sample.direction.z < 0.0, "{name}");
                assert!((sample.direction.length() - 1.0).abs() < 1.0e-5, "{name}");
            }
        }
    }
}

pub(super) fn directional_albedo(surface: &Surface, o: Vec3) -> f64 {
    // The lobe of light that little roughness refracts straight on is narrow.
    let narrow = surface.thickness > 0.0 && surface.roughness < 0.2;
    over_sphere_in_rows(if narrow { 2160 } else { 720 }, o, |i| {
        [f64::from(bsdf_evaluate(surface, o, i).max_element() * i.z.abs())]
    })[0]
}

/// No surface sends out more light than it receives, for any angle.
#[test]
fn surfaces_do_not_make_energy() {
    for (name, surface) in surfaces() {
        for o in directions() {
            let white = Surface { base_color: Vec3::ONE, ..surface };
            let total = directional_albedo(&white, o);
            assert!(total < 1.003, "{name} {o}: {total}");
            assert!(total > 0.3, "{name} {o}: {total} is too dark to be plausible");
        }
    }
    // The diffuse weight of the glTF specification, 1 - F(o.h), is over 1 near grazing angles.
    let smooth = Surface { specular: 1.0, roughness: 0.2, ..Surface::default() };
    let o = Vec3::new(1.45_f32.sin(), 0.0, 1.45_f32.cos());
    let fresnel = |x: f32| 0.04 + 0.96 * (1.0 - x).max(0.0).powi(5);
    let [mutant] = over_sphere(o, |i| {
        if i.z <= 0.0 {
            return [0.0];
        }
        let diffuse = |weight: f32| f64::from(weight / std::f32::consts::PI * i.z);
        let ours = diffuse((1.0 - fresnel(o.z)) * (1.0 - fresnel(i.z)));
        let theirs = diffuse(1.0 - fresnel(o.dot((o + i).normalize())));
        [f64::from(bsdf_evaluate(&smooth, o, i).x * i.z) - ours + theirs]
    });
    assert!(
        mutant > 1.1 && directional_albedo(&smooth, o) < 1.003,
        "{mutant} {}",
        directional_albedo(&smooth, o)
    );
}

/// White surfaces without absorption send back all light, from every angle and at every roughness.
#[test]
fn white_surfaces_lose_nothing() {
    let base = Surface { specular: 1.0, ..Surface::default() };
    let kinds = [
        ("metal", Surface { metallic: 1.0, ..base }),
        ("dielectric", base),
        ("dense dielectric", Surface { ior: 2.5, ..base }),
        ("half metal", Surface { metallic: 0.5, ..base }),
        ("thin wall", Surface { transmission: 1.0, ..base }),
        ("milky thin wall", Surface { transmission: 0.5, ..base }),
    ];
    let mut kinds = Vec::from(kinds);
    for ior in [1.33, 1.5, 2.4, 0.7] {
        for transmission in [1.0, 0.5] {
            let volume = Surface { ior, transmission, thickness: 1.0, ..base };
            kinds.push(("volume", volume));
            kinds.push(("volume from inside", Surface { front: false, ..volume }));
        }
    }
    for (name, kind) in kinds {
        for roughness in [0.15, 0.3, 0.5, 0.7, 0.85, 1.0] {
            for degrees in [0.0_f32, 30.0, 60.0, 75.0, 80.0] {
                let angle = degrees.to_radians();
                let o = Vec3::new(angle.sin(), 0.0, angle.cos());
                let total = directional_albedo(&Surface { roughness, ..kind }, o);
                assert!(
                    (total - 1.0).abs() < 0.015,
                    "{name} {} {} {roughness} at {degrees} degrees: {total}",
                    kind.ior,
                    kind.transmission
                );
            }
        }
    }
}

#[test]
fn lambert_is_exact_without_specular() {
    let surface = Surface { base_color: Vec3::splat(0.5), ..Surface::default() };
    for i in directions() {
        let value = bsdf_evaluate(&surface, directions()[1], i);
        assert!((value - 0.5 / std::f32::consts::PI).abs().max_element() < 1.0e-7);
        assert!((bsdf_pdf(&surface, directions()[1], i) - i.z / std::f32::consts::PI).abs() < 1.0e-6);
    }
}

/// Reflected light has f(o, i) = f(i, o); through a boundary the two differ by the square of the ratio of the
/// indices.
#[test]
fn light_paths_can_be_reversed() {
    let mut compared = 0;
    for (name, surface) in surfaces().into_iter().chain(anisotropic()).chain(of_ward()) {
        for index in 0..300 {
            let o = directions()[index as usize % 3];
            let Some(sample) = bsdf_sample(&surface, o, random(index)) else { continue };
            let i = sample.direction;
            let forward = bsdf_evaluate(&surface, o, i);
            let (reverse, factor) = if i.z > 0.0 {
                (bsdf_evaluate(&surface, i, o), 1.0)
            } else {
                let behind = Surface {
                    normal: -Vec3::Z,
                    geometric_normal: -Vec3::Z,
                    front: !surface.front,
                    ..surface
                };
                let bends = surface.thickness > 0.0 && surface.ior != 1.0;
                let ratio = if surface.front { surface.ior } else { 1.0 / surface.ior };
                (bsdf_evaluate(&behind, i, o), if bends { ratio * ratio } else { 1.0 })
            };
            let scale = forward.max_element();
            // Very steep lobes lose digits in the half vector.
            if i.z.abs() < 0.05 || scale > 1.0e4 {
                continue;
            }
            assert!(
                (forward - reverse * factor).abs().max_element() < 0.01 * scale,
                "{name} {o} {i}: {forward} {reverse}"
            );
            compared += 1;
        }
    }
    assert!(compared > 5000, "{compared}");
}

#[test]
fn smooth_surfaces_are_perfect_mirrors() {
    let glass = Surface {
        specular: 1.0,
        roughness: SMOOTH_ROUGHNESS * 0.99,
        transmission: 1.0,
        thickness: 1.0,
        ..Surface::default()
    };
    let o = directions()[1];
    let (mut reflected, mut refracted) = (0, 0);
    for index in 0..4000 {
        let sample = bsdf_sample(&glass, o, random(index)).expect("nothing is absorbed");
        assert!(sample.delta);
        assert!((sample.weight - 1.0).abs().max_element() < 1.0e-5, "one of the two happens");
        assert_eq!(bsdf_evaluate(&glass, o, sample.direction), Vec3::ZERO);
        if sample.transmitted {
            refracted += 1;
            let sine = |d: Vec3| (d.x * d.x + d.y * d.y).sqrt();
            assert!((sine(o) / sine(sample.direction) - 1.5).abs() < 1.0e-4, "Snell");
        } else {
            reflected += 1;
            assert!((sample.direction - Vec3::new(-o.x, -o.y, o.z)).length() < 1.0e-5);
        }
    }
    let expected = 0.04 + 0.96 * (1.0 - o.z).powi(5);
    let share = reflected as f32 / (reflected + refracted) as f32;
    assert!((share - expected).abs() < 4.0 * (expected / 4000.0_f32).sqrt(), "{share} {expected}");
}

#[test]
fn beyond_the_critical_angle_everything_is_reflected() {
    let glass = Surface {
        specular: 1.0,
        roughness: 0.0,
        transmission: 1.0,
        thickness: 1.0,
        front: false,
        ..Surface::default()
    };
    let o = Vec3::new(0.7, 0.0, (1.0_f32 - 0.49).sqrt());
    for index in 0..500 {
        let sample = bsdf_sample(&glass, o, random(index)).expect("nothing is absorbed");
        assert!(!sample.transmitted && (sample.weight - 1.0).abs().max_element() < 1.0e-6);
    }
}

/// No light leaks through where the shading normal and the true surface disagree.
#[test]
fn tilted_shading_normals_do_not_leak() {
    let normal = Vec3::new(0.8, 0.0, 0.6);
    for (name, surface) in surfaces() {
        let tilted = Surface { normal, ..surface };
        for index in 0..300 {
            let Some(sample) = bsdf_sample(&tilted, directions()[0], random(index)) else { continue };
            let through = sample.direction.z < 0.0;
            assert_eq!(through, sample.transmitted, "{name}");
            assert!(!through || surface.transmission > 0.0, "{name}");
        }
    }
}

/// A dull surface whose normals lean away sends on the part of its lobe that is not below it, for every view:
/// the normal is bent for facets alone.
#[test]
fn a_dull_surface_keeps_its_normal_from_every_view() {
    for degrees in [0.0_f32, 30.0, 50.0, 80.0] {
        let lean = degrees.to_radians();
        let normal = Vec3::new(-lean.sin(), 0.0, lean.cos());
        let dull =
            Surface { normal, base_color: Vec3::ONE, specular: 0.0, roughness: 1.0, ..Surface::default() };
        for view in [0.0_f32, 45.0, 70.0] {
            let o = Vec3::new(view.to_radians().sin(), 0.0, view.to_radians().cos());
            let sent = over_sphere(o, |i| [f64::from(bsdf_times_cosine(&dull, o, i).x)])[0];
            let expected = 0.5 * (1.0 + f64::from(lean.cos()));
            assert!((sent - expected).abs() < 5.0e-3, "{degrees} from {view}: {sent}, {expected}");
        }
    }
}

/// Extreme inputs give no value that is not a number.
#[test]
fn values_stay_finite_at_the_edges() {
    for roughness in [0.0, SMOOTH_ROUGHNESS, 1.0] {
        for ior in [0.0, 1.0, 1.0005, 1.001, 3.0, 100.0] {
            for front in [true, false] {
                let surface = Surface {
                    specular: 1.0,
                    roughness,
                    ior,
                    front,
                    transmission: 0.9,
                    thickness: 0.1,
                    metallic: 0.1,
                    ..Surface::default()
                };
                for cosine in [1.0e-6_f32, 1.0e-3, 0.5, 1.0] {
                    let o = Vec3::new((1.0 - cosine * cosine).sqrt(), 0.0, cosine);
                    for index in 0..50 {
                        let Some(sample) = bsdf_sample(&surface, o, random(index)) else { continue };
                        assert!(
                            sample.weight.is_finite()
                                && sample.direction.is_finite()
                                && sample.pdf.is_finite()
                        );
                        assert!(
                            sample.weight.max_element() < 30.0,
                            "{roughness} {ior} {cosine} {}",
                            sample.weight
                        );
                    }
                }
            }
        }
    }
}
