//! Rays that leave a surface, as light transport makes them.

use super::case::{Answer, Content, Context, Entry, Expectation};
use super::departure::Departure;
use super::geometry::{quad, sphere};
use rasray_reference::oracle::Ray;

pub(super) const CASES: &[Entry] = &[
    Entry {
        id: "P3",
        title: "mirror corridor: bounce k starts at a height that is linear in k",
        parameter: 0.0,
        build: corridor,
    },
    Entry { id: "P4-1", title: "leaving the ground at 1e-1 rad", parameter: 1e-1, build: grazing },
    Entry { id: "P4-2", title: "leaving the ground at 1e-2 rad", parameter: 1e-2, build: grazing },
    Entry { id: "P4-3", title: "leaving the ground at 1e-3 rad", parameter: 1e-3, build: grazing },
    Entry { id: "P4-4", title: "leaving the ground at 1e-4 rad", parameter: 1e-4, build: grazing },
    Entry { id: "P4-5", title: "leaving the ground at 1e-5 rad", parameter: 1e-5, build: grazing },
    Entry {
        id: "P5",
        title: "leaving a convex sphere outwards: nothing is hit",
        parameter: 0.0,
        build: leaving_sphere,
    },
];

fn corridor(context: &Context) -> Content {
    // The walls' diagonals cross the plane z = 0 far above and below the path.
    let wall = |x: f32| quad([x, -3.0, -5.0], [x, 9.0, -5.0], [x, 9.0, 4.0], [x, -3.0, 4.0]);
    let triangles = wall(0.0).into_iter().chain(wall(1.0)).collect();
    let (rays, expect) = context.answered(|_, index| {
        let bounce = index % 101;
        let forth = bounce % 2 == 0;
        if bounce == 0 {
            let t = Answer::HitAt { t: 0.5, tolerance: 1e-6 };
            return (Ray::new([0.5, 0.0, 0.0], [1.0, 0.01, 0.0]), t);
        }
        let height = (0.01 * (bounce as f64 - 0.5)) as f32;
        let (from, direction) = if forth { (0.0, 1.0) } else { (1.0, -1.0) };
        let leave = Ray { t_min: 1e-4, ..Ray::new([from, height, 0.0], [direction, 0.01, 0.0]) };
        (leave, Answer::HitAt { t: 1.0, tolerance: 1e-6 })
    });
    Content::new(triangles, rays, expect).seen_from([0.5, 0.0, 0.0])
}

fn grazing(context: &Context) -> Content {
    let size = 500.0;
    let ground = quad([-size, 0.0, -size], [-size, 0.0, size], [size, 0.0, size], [size, 0.0, -size]);
    let (sine, cosine) = context.parameter.sin_cos();
    let rays = context.rays(|random, _| {
        let triangle = random.below(2);
        let mut origin = Departure::new(&ground[triangle], random.weights(0.0)).origin;
        // All heights are 0, so the bound comes from the other axes: the move that renderers make is the
        // same.
        origin[1] = origin[1].max(f32::MIN_POSITIVE);
        let azimuth = random.between(0.0, std::f32::consts::TAU);
        Ray {
            exclude_primitive: Some(triangle as u32),
            ..Ray::new(origin, [cosine * azimuth.cos(), sine, cosine * azimuth.sin()])
        }
    });
    let eye = [0.0, 10.0, 0.0];
    Content::new(ground.to_vec(), rays, Expectation::All(Answer::Miss)).seen_from(eye)
}

fn leaving_sphere(context: &Context) -> Content {
    let triangles = sphere([0.0; 3], 2.0, 100);
    let rays = context.rays(|random, _| {
        let primitive = random.below(triangles.len());
        let departure = Departure::new(&triangles[primitive], random.weights(0.05));
        let outwards = departure.away(random.direction(), 0.05);
        Ray { exclude_primitive: Some(primitive as u32), ..Ray::new(departure.origin, outwards) }
    });
    Content::new(triangles, rays, Expectation::All(Answer::Miss)).seen_from([0.0, 0.0, -6.0])
}
