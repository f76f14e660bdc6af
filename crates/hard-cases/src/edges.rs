//! Rays through edges and vertices, rays in the plane of triangles, and rays that start on them.

use super::case::{AIMED, Answer, Content, Context, Entry, Expectation, Triangle};
use super::geometry::{aim, cube, midpoint, point_on, quad, sphere};
use rasray_reference::oracle::Ray;

/// Coordinates at which single-precision numbers are spaced as coarsely as 2^-6.
const FAR: [f32; 3] = [148376.0, 1234.0, -223423.0];

pub(super) const CASES: &[Entry] = &[
    Entry {
        id: "E1",
        title: "shared diagonal of a quad: edge functions must not leak",
        parameter: 0.0,
        build: diagonal,
    },
    Entry {
        id: "E2",
        title: "sphere of 100 x 100: random, vertex, edge and pole rays from inside",
        parameter: 100.0,
        build: sphere_near,
    },
    Entry {
        id: "E2-far",
        title: "E2 far from the origin, where coordinates are coarse",
        parameter: 100.0,
        build: sphere_far,
    },
    Entry { id: "E2-400", title: "E2 with 400 x 400", parameter: 400.0, build: sphere_near },
    Entry {
        id: "E2-400-far",
        title: "E2 with 400 x 400 far from the origin",
        parameter: 400.0,
        build: sphere_far,
    },
    Entry { id: "E3", title: "centre of a fan of 1,024 triangles", parameter: 0.0, build: fan },
    Entry {
        id: "E4",
        title: "T-junction with a hole of 2^-24: a miss is legal at the seam",
        parameter: 0.0,
        build: junction,
    },
    Entry {
        id: "E5",
        title: "corners and edge midpoints of a box seen from inside",
        parameter: 0.0,
        build: box_corners,
    },
    Entry {
        id: "E6",
        title: "rays in the plane of a triangle inside a box",
        parameter: 0.0,
        build: in_plane,
    },
    Entry {
        id: "E7",
        title: "rays along the edges of a box: any answer, but a finite one",
        parameter: 0.0,
        build: along_edges,
    },
    Entry {
        id: "E8",
        title: "shared edge of triangles with opposite winding",
        parameter: 0.0,
        build: opposite_winding,
    },
    Entry {
        id: "E9",
        title: "rays that start on the surface of a small sphere and exclude nothing",
        parameter: 0.0,
        build: on_surface,
    },
];

fn diagonal(context: &Context) -> Content {
    let triangles = quad([0.0, 0.0, 2.0], [1.0, 0.0, 2.0], [1.0, 1.0, 2.0], [0.0, 1.0, 2.0]).to_vec();
    let (rays, expect) = context.answered(|random, index| {
        // The rays go to all 1,025 points in a scattered order (641 and 1,025 have no common divisor).
        let k = index * 641 % 1025;
        let target = [k as f32 / 1024.0, k as f32 / 1024.0, 2.0];
        let origin = [random.between(-2.0, 3.0), random.between(-2.0, 3.0), random.between(-3.0, 1.0)];
        // The ends of the diagonal are corners of an open mesh, where rounding may let a ray pass by.
        (aim(origin, target), if k == 0 || k == 1024 { Answer::Oracle } else { AIMED })
    });
    Content::new(triangles, rays, expect)
}

fn sphere_near(context: &Context) -> Content {
    watertight_sphere(context, [0.0; 3])
}

fn sphere_far(context: &Context) -> Content {
    watertight_sphere(context, FAR)
}

/// Makes rays of five kinds from inside a sphere: random, at a vertex, at the midpoint of an edge, at each
/// pole.
pub(super) fn watertight_sphere(context: &Context, center: [f32; 3]) -> Content {
    let triangles = sphere(center, 2.0, context.parameter as usize);
    let poles = [2.0, -2.0].map(|z| [center[0], center[1], (f64::from(center[2]) + z) as f32]);
    let rays = context.rays(|random, index| {
        let origin = random.near(center, 0.8);
        let triangle = triangles[random.below(triangles.len())];
        let corner = random.below(3);
        match index % 5 {
            0 => Ray::new(origin, random.direction()),
            1 => aim(origin, triangle[corner]),
            2 => aim(origin, midpoint(triangle[corner], triangle[(corner + 1) % 3])),
            kind => aim(origin, poles[kind - 3]),
        }
    });
    Content::new(triangles, rays, Expectation::All(Answer::Hit)).seen_from(center)
}

fn fan(context: &Context) -> Content {
    const CENTER: [f32; 3] = [0.0, 0.0, 3.0];
    let rim = |k: usize| {
        let angle = std::f64::consts::TAU * (k % 1024) as f64 / 1024.0;
        [angle.cos() as f32, angle.sin() as f32, 3.0]
    };
    let triangles = (0..1024).map(|k| [CENTER, rim(k), rim(k + 1)]).collect();
    let rays = context.rays(|random, _| {
        aim([random.between(-2.0, 2.0), random.between(-2.0, 2.0), random.between(-3.0, 2.0)], CENTER)
    });
    Content::new(triangles, rays, Expectation::All(AIMED))
}

fn junction(context: &Context) -> Content {
    let hole = 2.0_f32.powi(-24);
    let middle = [hole, 0.5, 2.0];
    let mut triangles: Vec<Triangle> =
        quad([-1.0, 0.0, 2.0], [0.0, 0.0, 2.0], [0.0, 1.0, 2.0], [-1.0, 1.0, 2.0]).to_vec();
    triangles.extend([
        [[0.0, 0.0, 2.0], [1.0, 0.0, 2.0], middle],
        [[1.0, 0.0, 2.0], [1.0, 1.0, 2.0], middle],
        [[1.0, 1.0, 2.0], [0.0, 1.0, 2.0], middle],
    ]);
    let rays = context.rays(|random, index| {
        let origin = [random.between(-2.0, 2.0), random.between(-1.0, 2.0), random.between(-3.0, 1.0)];
        let x = if index % 2 == 0 { 0.0 } else { random.between(-0.9, 0.9) };
        aim(origin, [x, random.between(0.05, 0.95), 2.0])
    });
    Content::new(triangles, rays, Expectation::Oracle)
}

fn box_corners(context: &Context) -> Content {
    let triangles = cube([0.0; 3], 1.0);
    // Corners have no zero among their coordinates, midpoints of edges have one.
    let targets: Vec<[f32; 3]> = (0..27)
        .map(|i: i32| [i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1].map(|x| x as f32))
        .filter(|target| target.iter().filter(|x| **x == 0.0).count() <= 1)
        .collect();
    let rays = context.rays(|random, index| {
        let jitter = if index < targets.len() { 0.0 } else { 0.05 };
        aim(random.near([0.1, 0.2, 0.3], jitter), targets[index % targets.len()])
    });
    // The tolerance is twice the four roundings that the catalogue allows, since the direction is rounded
    // too.
    Content::new(triangles, rays, Expectation::All(Answer::HitAt { t: 1.0, tolerance: 4.8e-7 }))
}

fn in_plane(context: &Context) -> Content {
    let mut triangles = cube([0.0; 3], 8.0);
    triangles.push([[-1.0, 0.0, 2.0], [1.0, 0.0, 2.0], [0.0, 0.0, 6.0]]);
    let (rays, expect) = context.answered(|random, index| {
        if index == 0 {
            let wall = Answer::HitAt { t: 11.0 / 6.0, tolerance: 1e-5 };
            return (aim([-3.0, 0.0, 4.0], [3.0, 0.0, 4.0]), wall);
        }
        let origin = [random.sign() * random.between(2.0, 4.0), 0.0, random.between(1.0, 7.0)];
        (aim(origin, [random.between(-0.5, 0.5), 0.0, random.between(2.0, 4.0)]), Answer::Hit)
    });
    Content::new(triangles, rays, expect)
}

fn along_edges(_: &Context) -> Content {
    let mut rays = Vec::new();
    for axis in 0..3 {
        for corner in 0..8 {
            let sign = |bit: usize| if corner >> bit & 1 == 1 { 1.0 } else { -1.0 };
            let mut origin = [0.0; 3];
            origin[axis] = 3.0 * sign(0);
            origin[(axis + 1) % 3] = sign(1);
            origin[(axis + 2) % 3] = sign(2);
            let mut target = origin;
            target[axis] = -origin[axis];
            rays.push(aim(origin, target));
        }
    }
    let t = [1.0 / 3.0 - 1e-6, 2.0 / 3.0 + 1e-6];
    Content::new(cube([0.0; 3], 1.0), rays, Expectation::All(Answer::Anything { t }))
}

fn opposite_winding(context: &Context) -> Content {
    let (a, b) = ([0.2, -1.0, 2.0], [-0.3, 1.0, 3.0]);
    // Both triangles run from a to b, with the edge at different positions among their indices.
    let triangles = vec![[a, b, [-1.0, 0.1, 2.5]], [[1.0, -0.2, 2.2], a, b]];
    let edge = triangles[0];
    let rays = context.rays(|random, _| {
        let s = random.between(0.01, 0.99);
        let origin = [random.between(-0.5, 0.5), random.between(-0.5, 0.5), random.between(-2.0, 1.0)];
        aim(origin, point_on(&edge, [1.0 - s, s, 0.0]))
    });
    Content::new(triangles, rays, Expectation::All(AIMED))
}

/// Makes rays that start on triangles; only rounding decides if they hit them.
fn on_surface(context: &Context) -> Content {
    let triangles = sphere([-0.2, -0.3, -0.6], 0.1, 24);
    let rays = context.rays(|random, _| {
        let triangle = &triangles[random.below(triangles.len())];
        Ray::new(point_on(triangle, random.weights(0.0)), random.direction())
    });
    Content::new(triangles, rays, Expectation::Oracle).seen_from([-0.2, -0.3, -0.6])
}
