//! No ray through a shared edge or corner is lost.

use super::*;

fn assert_all_hit(name: &str, oracle: &Oracle<'_>, rays: &[Ray]) {
    let verdicts = oracle.closest_batch(rays);
    for (index, (verdict, ray)) in verdicts.iter().zip(rays).enumerate() {
        assert!(verdict.outcome.hit().is_some(), "{name}: ray {index} leaked: {ray:?} {verdict:?}");
        assert!(!verdict.miss_allowed, "{name}: ray {index} may leak: {ray:?} {verdict:?}");
    }
}

#[test]
fn a_shared_diagonal_does_not_leak() {
    let quad = soup(&[
        [[0.0, 0.0, 2.0], [1.0, 0.0, 2.0], [1.0, 1.0, 2.0]],
        [[0.0, 0.0, 2.0], [1.0, 1.0, 2.0], [0.0, 1.0, 2.0]],
    ]);
    let mut random = Random(1);
    let rays: Vec<Ray> = (0..100)
        .flat_map(|_| {
            let origin = [
                random.between(-2.0, 3.0) as f32,
                random.between(-2.0, 3.0) as f32,
                random.between(-3.0, 1.0) as f32,
            ];
            // The ends of the diagonal are corners of an open mesh, where rounding may let the ray pass by.
            (1..1024).map(move |k| Ray::towards(origin, [k as f32 / 1024.0, k as f32 / 1024.0, 2.0]))
        })
        .collect();
    assert_all_hit("diagonal", &oracle(&quad), &rays);
}

#[test]
fn a_closed_sphere_does_not_leak_near_and_far() {
    for center in [[0.0; 3], [148376.0, 1234.0, -223423.0]] {
        let mesh = sphere(center, 2.0, 100);
        let (positions, indices) = &mesh;
        let mut random = Random(2);
        let mut rays = Vec::new();
        for vertex in positions {
            rays.push(Ray::towards(random.point(center, 0.9), *vertex));
        }
        for corners in indices.as_chunks::<3>().0 {
            for edge in 0..3 {
                let [a, b] = [edge, (edge + 1) % 3].map(|i| positions[corners[i] as usize]);
                rays.push(Ray::towards(random.point(center, 0.9), midpoint(a, b)));
            }
        }
        for _ in 0..20_000 {
            let origin = random.point(center, 0.9);
            rays.push(Ray::new(origin, random.point([0.0; 3], 1.0)));
        }
        for _ in 0..1000 {
            for pole in [positions[0], positions[positions.len() - 1]] {
                rays.push(Ray::towards(random.point(center, 0.9), pole));
            }
        }
        assert_all_hit("sphere", &oracle(&mesh), &rays);
    }
}

#[test]
fn a_fan_does_not_leak_at_its_center() {
    let rim = |k: u32| {
        let angle = f64::from(k % 1024) * std::f64::consts::TAU / 1024.0;
        [angle.cos() as f32, angle.sin() as f32, 3.0]
    };
    let triangles: Vec<_> = (0..1024).map(|k| [[0.0, 0.0, 3.0], rim(k), rim(k + 1)]).collect();
    let mut random = Random(3);
    let rays: Vec<Ray> = (0..4000)
        .map(|_| Ray::towards(random.point([0.0, 0.0, 0.0], 2.5), [0.0, 0.0, 3.0]))
        .filter(|ray| ray.direction[2] > 0.1)
        .collect();
    assert_all_hit("fan", &oracle(&soup(&triangles)), &rays);
}

#[test]
fn a_box_does_not_leak_at_corners_and_edges_and_t_is_exact() {
    let (positions, indices) = cube();
    let oracle = oracle(&(positions.clone(), indices));
    let mut targets = positions.clone();
    for (index, a) in positions.iter().enumerate() {
        for b in &positions[index + 1..] {
            if a.iter().zip(b).filter(|(x, y)| x != y).count() == 1 {
                targets.push(midpoint(*a, *b));
            }
        }
    }
    assert_eq!(targets.len(), 20);
    let mut random = Random(4);
    let rays: Vec<Ray> = (0..20_000)
        .map(|index| Ray::towards(random.point([0.1, 0.2, 0.3], 0.05), targets[index % 20]))
        .collect();
    assert_all_hit("box", &oracle, &rays);
    for ray in &rays {
        let (_, t) = oracle.closest(ray).outcome.hit().expect("checked above");
        assert!((t - 1.0).abs() < 4.0 * 2.0_f64.powi(-24), "t = {t} for {ray:?}");
    }
}

#[test]
fn hits_on_pixel_edges_and_corners_are_found() {
    for z in [0.5_f32, 1.0, 7.3, 100.0] {
        let s = 1.5 * z;
        let mesh = soup(&[[[-s, -s, z], [s, -s, z], [s, s, z]], [[-s, -s, z], [s, s, z], [-s, s, z]]]);
        let mut rays = Vec::new();
        for i in 0..=64 {
            for j in 0..=64 {
                let p = [(i as f32 / 32.0 - 1.0) * z, (j as f32 / 32.0 - 1.0) * z, z];
                rays.push(Ray::towards([0.0; 3], p));
                rays.push(Ray::towards([0.37 * z, -0.61 * z, 0.0], p));
            }
        }
        assert_all_hit("pixel grid", &oracle(&mesh), &rays);
    }
}
