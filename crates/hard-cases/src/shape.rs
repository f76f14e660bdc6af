//! Slivers, degenerate triangles, huge ones, and triangles that reach behind the eye.

use super::case::{AIMED, Answer, Content, Context, Entry, Expectation, Triangle};
use super::geometry::{aim, cube, point_on, quad};
use rasray_reference::oracle::Ray;

const SLIVER: Triangle = [[-5.0, 0.0, 5.0], [5.0, 0.0, 5.0], [0.0, 1e-4, 5.0]];

pub(super) const CASES: &[Entry] = &[
    Entry { id: "G1", title: "sliver far below a pixel in height", parameter: 0.0, build: sliver },
    Entry { id: "G2", title: "needle of aspect 1e6", parameter: 0.0, build: needle },
    Entry { id: "G3", title: "collinear vertices are never hit", parameter: 0.0, build: collinear },
    Entry { id: "G4", title: "a repeated vertex is never hit", parameter: 0.0, build: repeated },
    Entry { id: "G5", title: "triangles that are points, many in one tile", parameter: 0.0, build: points },
    Entry { id: "G6", title: "published triangle without area", parameter: 0.0, build: published_flat },
    Entry { id: "G7", title: "heights of 0 to 8 times 2^-24", parameter: 0.0, build: thinnest },
    Entry { id: "G8", title: "subnormal triangle: hit or miss, never NaN", parameter: 0.0, build: subnormal },
    Entry { id: "G9", title: "mesh finer than the pixels", parameter: 0.0, build: sub_pixel },
    Entry { id: "G10", title: "huge triangle behind a small scene", parameter: 0.0, build: huge },
    Entry { id: "G11", title: "triangle crossing the eye plane", parameter: 0.0, build: across_eye_plane },
    Entry { id: "G12", title: "triangle through the eye", parameter: 0.0, build: through_eye },
];

fn sliver(context: &Context) -> Content {
    let (rays, answers) = (0..=512)
        .take(context.scale.rays)
        .map(|step| {
            let x = -4.0 + step as f32 / 64.0;
            let answer = match x.abs() {
                x if x < 3.5 => AIMED,
                x if x > 3.5 => Answer::Miss,
                _ => Answer::Oracle,
            };
            (aim([0.0; 3], [x, 3e-5, 5.0]), answer)
        })
        .unzip();
    Content::new(vec![SLIVER], rays, Expectation::PerRay(answers))
}

fn needle(context: &Context) -> Content {
    let triangle = [[-1.0, 0.0, 4.0], [1.0, 0.0, 4.0], [0.0, 2e-6, 4.0]];
    let rays = context.rays(|random, _| {
        let weights = random.weights(0.1);
        aim(random.near([0.0, 0.0, -1.0], 1.0), point_on(&triangle, weights))
    });
    Content::new(vec![triangle], rays, Expectation::Oracle)
}

/// Makes rays at points of triangles without area, which are never hit.
fn never_hit(context: &Context, triangles: Vec<Triangle>, target: [[f32; 3]; 2]) -> Content {
    let rays = context.rays(|random, _| {
        let s = random.between(-0.1, 1.1);
        aim(random.near([0.0; 3], 1.0), point_on(&[target[0], target[1], target[0]], [1.0 - s, s, 0.0]))
    });
    Content::new(triangles, rays, Expectation::All(Answer::Miss))
}

fn collinear(context: &Context) -> Content {
    let triangle = [[0.0, 0.0, 5.0], [1.0, 0.0, 5.0], [2.0, 0.0, 5.0]];
    never_hit(context, vec![triangle], [triangle[0], triangle[2]])
}

fn repeated(context: &Context) -> Content {
    let triangle = [[0.0, 0.0, 5.0], [0.0, 0.0, 5.0], [1.0, 0.0, 5.0]];
    never_hit(context, vec![triangle], [triangle[0], triangle[2]])
}

fn points(context: &Context) -> Content {
    let count = if context.scale.full { 100_000 } else { 10_000 };
    let point = [1.0, 1.0, 5.0];
    never_hit(context, vec![[point; 3]; count], [point; 2])
}

fn published_flat(context: &Context) -> Content {
    let triangle = [
        [-1_113.454_6, -79.049_614, -56.243_19],
        [-1_113.454_6, -87.092_27, -56.243_19],
        [-1_113.454_6, -79.209_015, -56.243_19],
    ];
    let rays = context.rays(|random, index| {
        let listed = Ray {
            t_max: 0.9999,
            ..Ray::new([-1_081.479_2, 99.999_954, 87.770_11], [-32.107_3, -183.355_87, -144.607_64])
        };
        if index == 0 {
            return listed;
        }
        aim(random.near(listed.origin, 1.0), point_on(&triangle, random.weights(0.0)))
    });
    Content::new(vec![triangle], rays, Expectation::All(Answer::Miss))
}

fn thinnest(context: &Context) -> Content {
    let height = |k: usize| k as f32 * 2.0_f32.powi(-24);
    let triangles: Vec<Triangle> = (0..=8)
        .map(|k| {
            let x = 2.0 * k as f32 - 8.5;
            [[x, 0.0, 5.0], [x + 1.0, 0.0, 5.0], [x + 0.5, height(k), 5.0]]
        })
        .collect();
    let (rays, expect) = context.answered(|random, index| {
        let k = index % 9;
        let x = 2.0 * k as f32 - 8.0 + random.between(-0.4, 0.4);
        // Rays run straight ahead, so that heights are not rounded away by the direction.
        let ray = Ray::new([x, height(k) * random.between(0.0, 1.0), 0.0], [0.0, 0.0, 1.0]);
        (ray, if k == 0 { Answer::Miss } else { Answer::Oracle })
    });
    Content::new(triangles, rays, expect)
}

fn subnormal(context: &Context) -> Content {
    let tiny = SLIVER.map(|vertex| vertex.map(|x| (f64::from(x) * 1e-39) as f32));
    let rays = context.rays(|random, _| {
        Ray::new([random.between(-3e-39, 3e-39), 3e-44, random.between(-1e-39, 1e-39)], [0.0, 0.0, 1.0])
    });
    Content::new(vec![tiny], rays, Expectation::All(Answer::Anything { t: [0.0, 1e-37] }))
}

fn sub_pixel(context: &Context) -> Content {
    let side = if context.scale.full { 1024 } else { 128 };
    let at = |i: usize| -5.0 + 10.0 * i as f32 / side as f32;
    let triangles = (0..side * side)
        .flat_map(|cell| {
            let (x, y) = (cell % side, cell / side);
            let corner = |x, y| [at(x), at(y), 5.0];
            quad(corner(x, y), corner(x + 1, y), corner(x + 1, y + 1), corner(x, y + 1))
        })
        .collect();
    let rays =
        context.rays(|random, _| aim([0.0; 3], [random.between(-4.9, 4.9), random.between(-4.9, 4.9), 5.0]));
    Content::new(triangles, rays, Expectation::All(AIMED))
}

fn huge(context: &Context) -> Content {
    let huge = [[-1e6, -1e6, 10.0], [1e6, -1e6, 10.0], [0.0, 1e6, 10.0]];
    let mut triangles = vec![huge];
    triangles.extend(cube([0.5, -0.25, 0.5], 0.25));
    let rays = context.rays(|random, index| {
        let origin = random.near([0.0; 3], 1.0);
        match index % 3 {
            0 => aim(origin, point_on(&huge, random.weights(0.05))),
            1 => aim(origin, [random.between(-20.0, 20.0), random.between(-20.0, 20.0), 10.0]),
            _ => aim(origin, random.near([0.5, -0.25, 0.5], 0.3)),
        }
    });
    Content::new(triangles, rays, Expectation::Oracle)
}

fn across_eye_plane(context: &Context) -> Content {
    let triangle = [[-1.0, 0.0, -1.0], [1.0, 0.0, -1.0], [0.0, 0.5, 5.0]];
    let rays = context.rays(|random, index| {
        let target = point_on(&triangle, random.weights(0.0));
        aim(if index % 2 == 0 { [0.0; 3] } else { random.near([0.0, 0.0, 1.0], 2.0) }, target)
    });
    Content::new(vec![triangle], rays, Expectation::Oracle)
}

fn through_eye(context: &Context) -> Content {
    let triangle = [[-1.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 4.0]];
    let rays = context.rays(|random, index| match index % 3 {
        0 => Ray::new([0.0; 3], random.direction()),
        1 => aim([0.0, 0.5, -3.0], point_on(&triangle, random.weights(0.0))),
        _ => aim(random.near([0.0, 0.5, -3.0], 1.0), point_on(&triangle, random.weights(0.02))),
    });
    Content::new(vec![triangle], rays, Expectation::Oracle)
}
