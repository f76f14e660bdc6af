//! Surfaces seen edge-on, rays along seams of the cube map, near planes, and the pixel grid.

use super::case::{AIMED, Answer, Content, Context, Entry, Expectation, Triangle};
use super::edges::watertight_sphere;
use super::geometry::{aim, along, cube, plate, point_on, quad, sphere};
use rasray_reference::oracle::Ray;

/// Number of pixels along an edge of a cube face.
const FACE: usize = 512;

pub(super) const CASES: &[Entry] = &[
    Entry { id: "V1", title: "quad seen edge-on from the eye", parameter: 0.0, build: edge_on },
    Entry { id: "V2-0", title: "plane at 1 rad to the view ray", parameter: 1.0, build: tilted },
    Entry { id: "V2-1", title: "plane at 1e-1 rad to the view ray", parameter: 1e-1, build: tilted },
    Entry { id: "V2-2", title: "plane at 1e-2 rad to the view ray", parameter: 1e-2, build: tilted },
    Entry { id: "V2-3", title: "plane at 1e-3 rad to the view ray", parameter: 1e-3, build: tilted },
    Entry { id: "V2-4", title: "plane at 1e-4 rad to the view ray", parameter: 1e-4, build: tilted },
    Entry { id: "V2-5", title: "plane at 1e-5 rad to the view ray", parameter: 1e-5, build: tilted },
    Entry { id: "V2-6", title: "plane at 1e-6 rad to the view ray", parameter: 1e-6, build: tilted },
    Entry { id: "V3", title: "rays parallel to the image plane", parameter: 0.0, build: parallel_to_image },
    Entry {
        id: "V4",
        title: "45-degree wall hit head-on: slopes of ray and wall are opposite",
        parameter: 0.0,
        build: head_on,
    },
    Entry {
        id: "V11",
        title: "rays that cross the near plane or never leave the near slab",
        parameter: 0.0,
        build: near_plane,
    },
    Entry { id: "V12", title: "geometry closer than the near plane", parameter: 0.0, build: near_geometry },
    Entry {
        id: "V13",
        title: "rays parallel to axes and along pixel columns",
        parameter: 0.0,
        build: along_columns,
    },
    Entry { id: "V14", title: "hits on pixel edges and corners", parameter: 0.0, build: pixel_grid },
    Entry {
        id: "V15",
        title: "eye in the middle of a closed sphere",
        parameter: 100.0,
        build: inside_sphere,
    },
    Entry {
        id: "V15-near",
        title: "eye one unit in the last place inside a sphere's pole",
        parameter: 1.999_999_9,
        build: at_pole,
    },
    Entry {
        id: "V15-vertex",
        title: "eye on a sphere's pole, which is a vertex",
        parameter: 2.0,
        build: at_pole,
    },
    Entry { id: "V15-surface", title: "eye inside a face of a box", parameter: 0.0, build: on_face },
    Entry {
        id: "V16",
        title: "geometry in the outermost ring of pixels only",
        parameter: 0.0,
        build: outer_ring,
    },
];

fn edge_on(context: &Context) -> Content {
    let triangles = quad([0.0, -1.0, 1.0], [0.0, 1.0, 1.0], [0.0, 1.0, 10.0], [0.0, -1.0, 10.0]).to_vec();
    let rays = context.rays(|random, _| {
        let (y, z) = (random.between(-0.99, 0.99), random.between(1.01, 9.99));
        aim([-0.5, y, z], [0.5, y, z])
    });
    Content::new(triangles, rays, Expectation::All(Answer::HitAt { t: 0.5, tolerance: 1e-6 }))
}

fn tilted(context: &Context) -> Content {
    // Rays run in the plane: along the y axis, and along the view ray of the middle pixel turned by the angle
    // about y.
    let pixel = 1.0 / FACE as f32;
    let (sine, cosine) = context.parameter.sin_cos();
    let slope = [cosine * pixel + sine, 0.0, cosine - sine * pixel];
    let center = [0.0, 0.0, 5.0];
    let corner = |s: f32, y: f32| along(along(center, slope, s), [0.0, 1.0, 0.0], y);
    let triangles = quad(corner(-3.0, -2.0), corner(3.0, -2.0), corner(3.0, 2.0), corner(-3.0, 2.0));
    let rays = context.rays(|random, index| {
        let target = point_on(&triangles[index % 2], random.weights(0.02));
        let normal = [slope[2], 0.0, -slope[0]];
        let aside = along(target, normal, random.sign() * random.between(0.2, 1.0));
        aim(random.near(aside, 0.15), target)
    });
    Content::new(triangles.to_vec(), rays, Expectation::Oracle)
}

fn parallel_to_image(context: &Context) -> Content {
    let (sine, cosine) = 20.0_f32.to_radians().sin_cos();
    let corner = |s: f32, y: f32| [1.0 + sine * s, y, 5.0 + cosine * s];
    let triangles = quad(corner(-2.0, -2.0), corner(2.0, -2.0), corner(2.0, 2.0), corner(-2.0, 2.0));
    let rays = context.rays(|random, index| {
        let (y, z) =
            if index == 0 { (0.01, 5.0) } else { (random.between(-1.9, 1.9), random.between(3.3, 6.7)) };
        aim([-4.0, y, z], [4.0, y, z])
    });
    Content::new(triangles.to_vec(), rays, Expectation::All(Answer::Hit))
}

fn head_on(context: &Context) -> Content {
    let corner = |x: f32, y: f32| [x, y, 5.0 + x];
    let triangles = quad(corner(-4.0, -4.0), corner(4.0, -4.0), corner(4.0, 4.0), corner(-4.0, 4.0)).to_vec();
    let rays = context.rays(|random, _| {
        let x = random.between(-2.5, 3.9);
        let target = corner(x, random.between(-3.9, 3.9));
        // In depth over screen position, the wall falls by z^2 / 5 where this ray rises by it.
        aim(along(target, [5.0 - x, 0.0, -(5.0 + x)], -0.1 * random.between(0.5, 1.5)), target)
    });
    Content::new(triangles, rays, Expectation::All(AIMED))
}

fn near_plane(context: &Context) -> Content {
    let mut triangles = cube([0.0; 3], 6.0);
    triangles.extend(quad([0.5, -0.3, -0.2], [0.5, 0.4, -0.2], [0.5, 0.4, 0.25], [0.5, -0.3, 0.25]));
    let rays = context.rays(|random, index| match index {
        0 => aim([0.0, 0.0, -1.0], [0.0, 0.0, 5.0]),
        1 => aim([-1.0, 0.0, 0.05], [1.0, 0.0, 0.05]),
        _ if index % 2 == 0 => aim(random.near([0.0, 0.0, -1.0], 0.5), random.near([0.0, 0.0, 5.0], 0.5)),
        // Rays stay within 0.1 of the eye plane from end to end.
        _ => {
            let depth = |scale: f32| {
                [scale * random.between(0.1, 1.0), random.between(-0.5, 0.5), random.between(0.0, 0.1)]
            };
            let [origin, target] = [-1.0, 1.0].map(depth);
            aim(origin, target)
        }
    });
    Content::new(triangles, rays, Expectation::All(Answer::Hit))
}

fn near_geometry(context: &Context) -> Content {
    let triangle = [[-0.02, 0.0, 0.01], [0.02, 0.0, 0.01], [0.0, 0.02, 0.01]];
    let rays = context.rays(|random, index| {
        if index == 0 {
            return aim([0.0, 0.005, -1.0], [0.0, 0.005, 1.0]);
        }
        aim(random.near([0.0, 0.005, -1.0], 0.5), point_on(&triangle, random.weights(0.02)))
    });
    Content::new(vec![triangle], rays, Expectation::All(Answer::Hit))
}

fn along_columns(context: &Context) -> Content {
    let rays = context.rays(|random, index| {
        if index % 2 == 0 {
            let mut direction = [0.0; 3];
            direction[index / 2 % 3] = random.sign();
            return Ray::new(random.near([0.0; 3], 50.0), direction);
        }
        let column = (1 + random.below(FACE - 1)) as f32 * 2.0 / FACE as f32 - 1.0;
        // The product column * 99 is exact: nine bits times seven.
        let row = random.between(-1.0, 1.0);
        Ray::new([column, row, 1.0], [column * 99.0, random.between(-50.0, 50.0), 99.0])
    });
    Content::new(sphere([0.0; 3], 200.0, 48), rays, Expectation::All(Answer::Hit))
}

fn pixel_grid(context: &Context) -> Content {
    // Depths, each with a depth in front of it at which its rays start.
    const DEPTHS: [[f32; 2]; 4] = [[0.25, 0.5], [0.75, 1.0], [4.0, 7.3], [50.0, 100.0]];
    let triangles = DEPTHS.iter().flat_map(|[_, z]| plate(*z, 1.01 * z)).collect();
    let rays = context.rays(|random, index| {
        let [start, z] = DEPTHS[index % 4];
        let place = |pixel: f32| (2.0 * pixel / FACE as f32 - 1.0) * z;
        let line = |place: usize| place as f32;
        let (mut i, j) = (line(random.below(FACE + 1)), line(random.below(FACE + 1)));
        // Every other ray leaves the corner along the pixel's edge.
        if index / 4 % 2 == 1 {
            i = (i + random.between(0.0, 1.0)).min(FACE as f32);
        }
        let target = if index % 8 < 4 { [place(i), place(j), z] } else { [place(j), place(i), z] };
        let reach = 0.9 * start;
        aim([random.between(-reach, reach), random.between(-reach, reach), start], target)
    });
    Content::new(triangles, rays, Expectation::All(AIMED))
}

fn inside_sphere(context: &Context) -> Content {
    watertight_sphere(context, [0.0; 3])
}

fn at_pole(context: &Context) -> Content {
    let eye = [0.0, 0.0, context.parameter];
    let rays = context.rays(|random, _| {
        // Rays run inward, and clear of the fan of triangles around the pole, which leans by 1.8 degrees.
        let [x, y, z] = random.direction();
        Ray { t_min: 1e-3, ..Ray::new(eye, [x, y, -z.abs() - 0.05]) }
    });
    Content::new(sphere([0.0; 3], 2.0, 100), rays, Expectation::All(Answer::Hit)).seen_from(eye)
}

fn on_face(context: &Context) -> Content {
    let eye = [0.3, 0.2, 2.0];
    let rays = context.rays(|random, _| {
        let [x, y, z] = random.direction();
        Ray { t_min: 1e-3, ..Ray::new(eye, [x, y, -z.abs() - 0.05]) }
    });
    Content::new(cube([0.0; 3], 2.0), rays, Expectation::All(Answer::Hit)).seen_from(eye)
}

/// Makes triangles over the outermost pixels of the face towards +z, for views of `size` pixels along a side,
/// at least two.
pub fn outermost_pixels(size: usize) -> Vec<Triangle> {
    let (inner, outer) = (5.0 * (1.0 - 2.0 / size as f32), 5.0);
    let side = |turn: usize| {
        let corner = |x: f32, y: f32| match turn {
            0 => [x, y, 5.0],
            1 => [-y, x, 5.0],
            2 => [-x, -y, 5.0],
            _ => [y, -x, 5.0],
        };
        quad(corner(inner, -inner), corner(outer, -inner), corner(outer, outer), corner(inner, outer))
    };
    (0..4).flat_map(side).collect()
}

fn outer_ring(context: &Context) -> Content {
    let triangles = outermost_pixels(FACE);
    let rays = context.rays(|random, index| {
        let target = point_on(&triangles[random.below(8)], random.weights(0.02));
        aim(if index % 2 == 0 { [0.0; 3] } else { random.near([0.0; 3], 2.0) }, target)
    });
    Content::new(triangles.clone(), rays, Expectation::Oracle)
}
