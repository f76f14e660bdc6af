//! Careful single-precision tracer, one triangle after the other: the requirement that a device can meet. If
//! the oracle does not admit its answers, the oracle requires more than single precision holds.

use super::*;
use rasray_metrics::DeviceHit;
use rasray_reference::oracle::Oracle;

/// Largest product of rays and triangles with which a case is tested.
const TESTS: usize = 500_000;

/// Intersects watertightly by shearing (Woop, Benthin, Wald 2013) and decides edges by comparing products.
/// Returns t and a bound of its error. Edges belong to the triangle if it is `closed`.
fn intersect(ray: &Ray, triangle: &Triangle, axis: usize, closed: bool) -> Option<(f32, f32)> {
    let edge = |to: usize| -> [f32; 3] { std::array::from_fn(|i| triangle[to][i] - triangle[0][i]) };
    let (ab, ac) = (edge(1), edge(2));
    if (0..3).all(|i| ab[(i + 1) % 3] * ac[(i + 2) % 3] == ab[(i + 2) % 3] * ac[(i + 1) % 3]) {
        // Shearing may give area to a triangle that has none.
        return None;
    }
    let permute = |p: [f32; 3]| [p[(axis + 1) % 3], p[(axis + 2) % 3], p[axis]];
    let d = permute(ray.direction);
    let (shear_x, shear_y) = (d[0] / d[2], d[1] / d[2]);
    let [a, b, c] = triangle.map(|vertex| {
        let p = permute(std::array::from_fn(|axis| vertex[axis] - ray.origin[axis]));
        let (x_shift, y_shift) = (shear_x * p[2], shear_y * p[2]);
        let (x, y) = (p[0] - x_shift, p[1] - y_shift);
        let scales = [p[0].abs() + x_shift.abs(), p[1].abs() + y_shift.abs()];
        (x, y, p[2] / d[2], scales)
    });
    // Products of corners far to one side may all round to the same value.
    let apart = |x: [f32; 3]| x.iter().all(|x| *x > 0.0) || x.iter().all(|x| *x < 0.0);
    if apart([a.0, b.0, c.0]) || apart([a.1, b.1, c.1]) {
        return None;
    }
    let products = [(b, c), (c, a), (a, b)].map(|(p, q)| (q.0 * p.1, q.1 * p.0));
    if !products.iter().all(|(x, y)| x >= y) && !products.iter().all(|(x, y)| x <= y) {
        return None;
    }
    if !closed && products.iter().any(|(x, y)| x == y) {
        return None;
    }
    let [u, v, w] = products.map(|(x, y)| x - y);
    let sum = u + v + w;
    if sum == 0.0 {
        return None;
    }
    let depths = [a.2, b.2, c.2];
    let t = (u * a.2 + v * b.2 + w * c.2) / sum;
    let t = t.max(a.2.min(b.2).min(c.2)).min(a.2.max(b.2).max(c.2));
    // Every edge function errs by eight roundings of its terms; that moves t by the distance between t and
    // the depth of the vertex opposite. The rest is the rounding of the vertices' own depths.
    let unit = f32::EPSILON / 2.0;
    let mixed: f32 = [(b, c), (c, a), (a, b)]
        .iter()
        .zip(depths)
        .map(|((p, q), depth)| {
            let scale = p.3[0] * q.1.abs() + q.3[1] * p.0.abs() + p.3[1] * q.0.abs() + q.3[0] * p.1.abs();
            8.0 * unit * scale * (depth - t).abs()
        })
        .sum();
    let farthest = depths.iter().fold(0.0_f32, |far, z| far.max(z.abs()));
    let nearest = depths.iter().fold(f32::INFINITY, |near, z| near.min(z.abs()));
    // If all vertices have one depth, t has no error but its own rounding.
    let own = 8.0 * unit * if nearest == farthest { t.abs() } else { farthest };
    Some((t, mixed / sum.abs() + own))
}

fn closest(ray: &Ray, triangles: &[Triangle], closed: bool) -> Option<DeviceHit> {
    if !ray.is_valid() {
        return None;
    }
    let size = ray.direction.map(f32::abs);
    let axis = if size[0] >= size[1] && size[0] >= size[2] {
        0
    } else if size[1] >= size[2] {
        1
    } else {
        2
    };
    let mut best: Option<DeviceHit> = None;
    for (id, triangle) in triangles.iter().enumerate() {
        let primitive = Some(id as u32);
        if ray.exclude_primitive == primitive || !triangle.iter().flatten().all(|x| x.abs() <= 1.8e18) {
            continue;
        }
        if let Some((t, error)) = intersect(ray, triangle, axis, closed)
            && t > ray.t_min.max(error)
            && t < ray.t_max
            && best.is_none_or(|best| t < best.t)
        {
            best = Some(DeviceHit { t, primitive });
        }
    }
    best
}

#[test]
fn single_precision_gives_admissible_answers() {
    let mut wrong = Vec::new();
    // A test's own bound of t decides if a ray of E9 hits the surface on which it starts, and the device's
    // bound, which the oracle follows, is closer than the one above.
    for id in ids().into_iter().filter(|id| *id != "E9") {
        let case = case(id, Scale::QUICK).expect("the id is in the catalogue");
        let (positions, indices) = case.buffers();
        let oracle = Oracle::new(&positions, &indices, None).expect("buffers are well formed");
        let rays = case.rays.len().min(TESTS / case.triangles.len().max(1)).max(10);
        let rays = &case.rays[..rays.min(case.rays.len())];
        let verdicts = oracle.closest_batch(rays);
        let refused: Vec<_> = (0..rays.len())
            .filter(|&ray| {
                !case.accepts(ray, &verdicts[ray], closest(&rays[ray], &case.triangles, true), 0.0)
            })
            .collect();
        if let Some(&ray) = refused.first() {
            let hit = closest(&rays[ray], &case.triangles, true);
            wrong.push(format!(
                "{id}: {} of {}; ray {ray} {:?} found {hit:?}, {:?}, {:?}",
                refused.len(),
                rays.len(),
                rays[ray],
                case.answer(ray),
                verdicts[ray]
            ));
        }
    }
    assert!(wrong.is_empty(), "answers are refused:\n{}", wrong.join("\n"));
}

#[test]
fn a_test_that_leaves_out_edges_is_refused() {
    let case = case("E5", Scale::QUICK).expect("the id is in the catalogue");
    let (positions, indices) = case.buffers();
    let oracle = Oracle::new(&positions, &indices, None).expect("buffers are well formed");
    let refused = |closed: bool| {
        let accepted =
            |ray: &Ray, i| case.accepts(i, &oracle.closest(ray), closest(ray, &case.triangles, closed), 0.0);
        case.rays.iter().enumerate().filter(|(i, ray)| !accepted(ray, *i)).count()
    };
    assert_eq!(refused(true), 0);
    assert!(refused(false) > 10, "{} rays refused", refused(false));
}
