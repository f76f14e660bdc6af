//! Interfaces that light passes one after the other: nested and touching glass, sheets, a closed box, a
//! coarse sphere at its terminator, and rays at the critical angle.

use super::case::{AIMED, Answer, Content, Context, Entry, Triangle};
use super::departure::Departure;
use super::geometry::{aim, cube, cuboid, plate, sphere, uv_sphere};
use rasray_reference::oracle::Ray;

pub(super) const CASES: &[Entry] = &[
    Entry {
        id: "P1",
        title: "three nested spheres of glass, air and water",
        parameter: 0.0,
        build: nested_glass,
    },
    Entry {
        id: "P2",
        title: "glass that touches water: faces that coincide are one interface",
        parameter: 0.0,
        build: touching,
    },
    Entry { id: "P6", title: "closed black box: nothing gets in", parameter: 0.0, build: black_box },
    Entry {
        id: "P7",
        title: "coarse sphere with smooth normals, light at its terminator",
        parameter: 0.0,
        build: terminator,
    },
    Entry { id: "P8-1", title: "one sheet hit head-on", parameter: 1.0, build: sheets },
    Entry { id: "P8-2", title: "two sheets hit head-on", parameter: 2.0, build: sheets },
    Entry { id: "P8-4", title: "four sheets hit head-on", parameter: 4.0, build: sheets },
    Entry { id: "P8-8", title: "eight sheets hit head-on", parameter: 8.0, build: sheets },
    Entry { id: "P9", title: "critical angle give or take rounding", parameter: 0.0, build: critical_angle },
];

fn nested_glass(context: &Context) -> Content {
    const RADII: [f64; 3] = [1.0, 0.9, 0.5];
    // Poles that the ray along the axis passes, in order.
    const INTERFACES: [f32; 6] = [-1.0, -0.9, -0.5, 0.5, 0.9, 1.0];
    let triangles: Vec<Triangle> = RADII.iter().flat_map(|radius| sphere([0.0; 3], *radius, 48)).collect();
    let shell = triangles.len() / RADII.len();
    let (rays, expect) = context.answered(|random, index| {
        if let Some(interface) = INTERFACES.get(index) {
            let start = if index == 0 { -3.0 } else { 0.5 * (INTERFACES[index - 1] + interface) };
            let ray = Ray { t_min: start + 3.0, ..Ray::new([0.0, 0.0, -3.0], [0.0, 0.0, 1.0]) };
            return (ray, Answer::HitAt { t: interface + 3.0, tolerance: 1e-6 });
        }
        // Rays leave an interface for the next one, outwards or inwards.
        let primitive = random.below(triangles.len());
        let outwards = index % 2 == 0;
        let [a, b, c] = triangles[primitive];
        let facing = if outwards { [a, b, c] } else { [a, c, b] };
        let departure = Departure::new(&facing, random.weights(0.05));
        let direction = departure.away(random.direction(), 0.05);
        let ray = Ray { exclude_primitive: Some(primitive as u32), ..Ray::new(departure.origin, direction) };
        (ray, if outwards && primitive < shell { Answer::Miss } else { Answer::Hit })
    });
    Content::new(triangles, rays, expect).seen_from([0.0, 0.0, -3.0])
}

fn touching(context: &Context) -> Content {
    let glass = cuboid([-1.0, -1.0, -1.0], [0.0, 1.0, 1.0]);
    let water = cuboid([0.0, -1.0, -1.0], [1.0, 1.0, 1.0]);
    // The glass has the lower ids: its triangles 2 and 3 lie in the common face, on either side of y = z.
    let triangles: Vec<Triangle> = glass.into_iter().chain(water).collect();
    let (rays, expect) = context.answered(|random, index| {
        let target = [0.0, random.between(-0.95, 0.95), random.between(-0.95, 0.95)];
        let [_, y, z] = random.near(target, 0.05);
        let x = random.between(0.2, 0.9) * if index % 2 == 0 { -1.0 } else { 1.0 };
        let answer = if (target[1] - target[2]).abs() < 1e-3 {
            AIMED
        } else {
            let primitive = if target[1] > target[2] { 2 } else { 3 };
            Answer::HitOn { primitive, t: 1.0, tolerance: 1e-5 }
        };
        (aim([x, y.clamp(-0.99, 0.99), z.clamp(-0.99, 0.99)], target), answer)
    });
    Content::new(triangles, rays, expect).seen_from([-0.4, 0.1, 0.2])
}

fn black_box(context: &Context) -> Content {
    const HALF: f32 = 2.0;
    let (rays, expect) = context.answered(|random, index| {
        let origin = random.near([0.0; 3], 1.9);
        let ray = match index % 4 {
            0 | 1 => Ray::new(origin, random.direction()),
            kind => {
                // Targets are at edges, and at corners.
                let mut target = [(); 3].map(|()| HALF * random.sign());
                if kind == 2 {
                    target[index / 4 % 3] = random.between(-HALF, HALF);
                }
                aim(origin, target)
            }
        };
        // The exit is through the nearest of the three walls ahead.
        let exit = (0..3)
            .filter(|&axis| ray.direction[axis] != 0.0)
            .map(|axis| {
                let (o, d) = (f64::from(ray.origin[axis]), f64::from(ray.direction[axis]));
                (f64::from(HALF).copysign(d) - o) / d
            })
            .fold(f64::INFINITY, f64::min);
        (ray, Answer::HitAt { t: exit as f32, tolerance: 1e-5 })
    });
    Content::new(cube([0.0; 3], HALF), rays, expect)
}

fn terminator(context: &Context) -> Content {
    const TO_LIGHT: [f32; 3] = [1.0, 0.0, 0.0];
    let triangles = uv_sphere([0.0; 3], 1.0, 8, 16);
    let (rays, expect) = context.answered(|random, _| {
        // The point's smooth normal is nearly at right angles to the light, which may be below the flat
        // triangle.
        let mut primitive = random.below(triangles.len());
        let mut weights = random.weights(0.02);
        for _ in 0..256 {
            let point = super::geometry::point_on(&triangles[primitive], weights);
            if point[0].abs() < 0.25 {
                break;
            }
            primitive = random.below(triangles.len());
            weights = random.weights(0.02);
        }
        let departure = Departure::new(&triangles[primitive], weights);
        let ray = Ray { exclude_primitive: Some(primitive as u32), ..Ray::new(departure.origin, TO_LIGHT) };
        (ray, if departure.normal[0] > 0.02 { Answer::Miss } else { Answer::Oracle })
    });
    Content::new(triangles, rays, expect).seen_from([0.0, 0.0, -4.0])
}

fn sheets(context: &Context) -> Content {
    let faces = 2 * context.parameter as usize;
    let z = |face: usize| 1.0 + 0.1 * face as f32;
    let triangles = (0..faces).flat_map(|face| plate(z(face), 3.0)).collect();
    let (rays, expect) = context.answered(|random, index| {
        let (x, y) = (random.between(-2.9, 2.9), random.between(-2.9, 2.9));
        let on = |face: usize| 2 * face as u32 + u32::from(y > x);
        let forth = index % 2 == 0;
        // Rays start outside at first, then go from each face to the next and from the last to nothing.
        let step = index / 2 % (faces + 1);
        let place = |step: usize| if forth { step } else { faces - 1 - step };
        let from = match step {
            0 if forth => 0.5,
            0 => z(faces - 1) + 0.5,
            _ => z(place(step - 1)),
        };
        let ray = Ray::new([x, y, from], [0.0, 0.0, if forth { 1.0 } else { -1.0 }]);
        let leaving = (step > 0).then(|| on(place(step - 1)));
        let answer = if step == faces {
            Answer::Miss
        } else if (x - y).abs() < 1e-3 {
            Answer::Hit
        } else {
            let t = (z(place(step)) - from).abs();
            Answer::HitOn { primitive: on(place(step)), t, tolerance: 1e-5 }
        };
        (Ray { exclude_primitive: leaving, ..ray }, answer)
    });
    Content::new(triangles, rays, expect).seen_from([0.0, 0.0, 0.5])
}

fn critical_angle(context: &Context) -> Content {
    const INDEX: f32 = 1.5;
    let triangles = cube([0.0; 3], 1.0);
    // The face y = 1 is the second pair of the second axis.
    let top = [6, 7];
    let (rays, expect) = context.answered(|random, index| {
        let mut sine = 1.0 / INDEX;
        for _ in 0..index / 2 % 5 {
            sine = if index / 10 % 2 == 0 { sine.next_up() } else { sine.next_down() };
        }
        let (turn_sine, turn_cosine) = random.between(0.0, std::f32::consts::TAU).sin_cos();
        let leaned = |sine: f32, cosine: f32| [sine * turn_cosine, cosine, sine * turn_sine];
        if index % 2 == 0 {
            // Rays start inside, towards the face.
            let cosine = (1.0 - sine * sine).sqrt();
            let depth = random.between(0.1, 0.5);
            let [x, _, z] = leaned(sine, cosine).map(|d| -d * depth / cosine);
            let ray = Ray::new([x, 1.0 - depth, z], leaned(sine, cosine));
            let t = f64::from(1.0 - ray.origin[1]) / f64::from(ray.direction[1]);
            return (ray, Answer::HitAt { t: t as f32, tolerance: 1e-5 });
        }
        // Outside, the light is bent as far as possible: along the face where reflection would be total.
        let bent = INDEX * sine;
        let cosine = (1.0 - bent * bent).max(0.0).sqrt();
        let primitive = top[random.below(2)];
        let mut departure = Departure::new(&triangles[primitive], random.weights(0.05));
        // The target avoids the edges of the face, which the ray would pass within rounding.
        for _ in 0..256 {
            if departure.origin[0].abs() < 0.5 && departure.origin[2].abs() < 0.5 {
                break;
            }
            departure = Departure::new(&triangles[primitive], random.weights(0.05));
        }
        let ray = Ray { t_max: 0.4, ..Ray::new(departure.origin, leaned(bent.min(1.0), cosine)) };
        (Ray { exclude_primitive: Some(primitive as u32), ..ray }, Answer::Miss)
    });
    Content::new(triangles, rays, expect).seen_from([0.1, 0.2, 0.15])
}
