use glam::{Vec2, Vec3};
use rasray_scene::Environment;

use crate::shading::{EnvironmentTable, random::RandomStream};

fn uneven() -> EnvironmentTable {
    let (width, height) = (7, 5);
    let radiance = (0..width * height).map(|texel: u32| match texel % 11 {
        0 => [0.0; 3],
        3 => [40.0, 20.0, 5.0],
        other => [other as f32, 0.5, 1.0],
    });
    EnvironmentTable::new(&Environment::LatLong { width, height, radiance: radiance.collect() })
}

fn samples() -> impl Iterator<Item = (f32, Vec2)> {
    (0..40_000).map(|pixel| {
        let [pick, u, v, _] = RandomStream { seed: 5, pixel, sample: 0 }.four(0);
        (pick, Vec2::new(u, v))
    })
}

#[test]
fn the_density_of_a_sample_is_that_of_its_direction() {
    let table = uneven();
    let mut differ = 0;
    for (pick, place) in samples() {
        let (direction, radiance, pdf) = table.sample(pick, place);
        assert!((direction.length() - 1.0).abs() < 1.0e-5);
        assert!(pdf > 0.0 && radiance.max_element() > 0.0, "black texels are never chosen");
        // Directions on the border of a texel may round into its neighbour.
        if table.radiance(direction) != radiance || (table.pdf(direction) / pdf - 1.0).abs() > 1.0e-4 {
            differ += 1;
        }
    }
    assert!(differ < 40, "{differ}");
}

/// The mean of f / pdf is the integral of f: of 1 where there is light, and of the direction's height.
#[test]
fn samples_cover_the_sphere_by_density() {
    let white =
        EnvironmentTable::new(&Environment::LatLong { width: 9, height: 4, radiance: vec![[2.0; 3]; 36] });
    for table in [EnvironmentTable::new(&Environment::Constant([2.0; 3])), white] {
        let (mut area, mut square) = (0.0_f64, 0.0_f64);
        for (pick, place) in samples() {
            let (direction, radiance, pdf) = table.sample(pick, place);
            assert_eq!(radiance, Vec3::splat(2.0));
            area += f64::from(1.0 / pdf) / 40_000.0;
            square += f64::from(direction.y * direction.y / pdf) / 40_000.0;
        }
        let sphere = 4.0 * std::f64::consts::PI;
        assert!((area - sphere).abs() < 1.0e-3, "{area}");
        // The mean of y^2 is a third, with a standard deviation of 0.298.
        assert!((square / sphere - 1.0 / 3.0).abs() < 4.0 * 0.298 / 200.0, "{square}");
    }
}

#[test]
fn rows_run_from_the_top_and_columns_from_x_over_z() {
    let mut radiance = vec![[0.0; 3]; 8];
    radiance.iter_mut().enumerate().for_each(|(index, texel)| *texel = [index as f32; 3]);
    let table = EnvironmentTable::new(&Environment::LatLong { width: 4, height: 2, radiance });
    let at = |x: f32, y: f32, z: f32| table.radiance(Vec3::new(x, y, z).normalize()).x;
    assert_eq!(at(1.0, 0.5, 0.1), 0.0);
    assert_eq!(at(0.1, 0.5, 1.0), 0.0);
    assert_eq!(at(-0.1, 0.5, 1.0), 1.0);
    assert_eq!(at(-1.0, 0.5, -0.1), 2.0);
    assert_eq!(at(1.0, 0.5, -0.1), 3.0);
    assert_eq!(at(1.0, -0.5, 0.1), 4.0);
}

#[test]
fn a_black_environment_is_not_sampled() {
    assert!(!EnvironmentTable::new(&Environment::default()).is_sampled());
    let black = Environment::LatLong { width: 2, height: 1, radiance: vec![[0.0; 3]; 2] };
    assert!(!EnvironmentTable::new(&black).is_sampled());
    assert!(uneven().is_sampled());
}
