//! Tests of the law of shadow maps: a ray has the answer of a naive map in double precision, which looks at
//! every triangle along the line from the light through the centre of the ray's texel. If rounding decides,
//! either answer is right.

use std::f64::consts::{PI, TAU};

use glam::DVec3;
use rasray_ads::{PRIMITIVE_NONE, Ray};
use rasray_scene::Light;
use rasray_shaders_glsl::constants::scene::{LIGHT_DIRECTIONAL, LIGHT_SPOT};
use rasray_shaders_glsl::constants::shadow_maps::SHADOW_MAPS_WIDENED;
use rasray_shadow_maps::{Config, views_of};

use crate::lit::{Lit, cluttered_room, device, expect_silence, lights, scene_of};

/// View as the page describes it: axes divided by its half sides.
struct View {
    origin: DVec3,
    axes: [DVec3; 3],
    parallel: bool,
}

fn vector(v: [f32; 3]) -> DVec3 {
    glam::Vec3::from(v).as_dvec3()
}

fn axes_across(forward: DVec3) -> [DVec3; 2] {
    let aside = if forward.x.abs() < 0.6 { DVec3::X } else { DVec3::Y };
    let right = aside.cross(forward).normalize();
    [right, forward.cross(right)]
}

impl View {
    /// Returns the view of a light that contains a point.
    fn of(light: &rasray_shadow_maps::Light, triangles: &[[DVec3; 3]], p: DVec3) -> Self {
        let (origin, direction) = (vector(light.position), vector(light.direction));
        if light.kind == LIGHT_DIRECTIONAL {
            let corners = || triangles.iter().flatten().copied();
            let lower = corners().fold(DVec3::INFINITY, DVec3::min);
            let upper = corners().fold(DVec3::NEG_INFINITY, DVec3::max);
            let [right, up] = axes_across(direction);
            let half = (upper - lower) / 2.0;
            let [x, y, z] = [right, up, direction].map(|axis| axis.abs().dot(half) * 1.0001);
            let origin = (lower + upper) / 2.0 - z * direction;
            return Self { origin, axes: [right / x, up / y, direction], parallel: true };
        }
        if light.kind == LIGHT_SPOT && views_of(light) == 1 {
            let cosine = f64::from(-light.cone_offset / light.cone_scale);
            let tangent = f64::from(SHADOW_MAPS_WIDENED) * cosine.acos().tan();
            let [right, up] = axes_across(direction);
            return Self { origin, axes: [right / tangent, up / tangent, direction], parallel: false };
        }
        let q = p - origin;
        let m = q.abs();
        let axis = if m.x >= m.y && m.x >= m.z {
            0
        } else if m.y >= m.z {
            1
        } else {
            2
        };
        let sign = if q[axis] < 0.0 { -1.0 } else { 1.0 };
        let unit = |axis: usize| DVec3::from_array(std::array::from_fn(|k| f64::from(u8::from(k == axis))));
        let axes = [unit((axis + 1) % 3), unit((axis + 2) % 3), sign * unit(axis)];
        Self { origin, axes, parallel: false }
    }

    fn at(&self, p: DVec3) -> DVec3 {
        DVec3::from(self.axes.map(|axis| axis.dot(p - self.origin)))
    }
}

/// Answer of a naive map to a ray.
pub enum Naive {
    Occluded,
    Open,
    /// Answer that is within rounding of both others.
    Unsure,
}

/// Returns the origin and the direction, in a view, of the line from the light through a place on its map.
fn line(view: &View, [x, y]: [f64; 2]) -> (DVec3, DVec3) {
    match view.parallel {
        true => (DVec3::new(x, y, 0.0), DVec3::Z),
        false => (DVec3::ZERO, DVec3::new(x, y, 1.0)),
    }
}

/// Returns the depth of a triangle (in a view) at a texel's centre with the bias, or `None` if the triangle
/// does not cover the centre. Returns an error if rounding decides the coverage.
fn stored(view: &View, [a, b, c]: [DVec3; 3], centre: [f64; 2], half_texel: f64) -> Result<Option<f64>, ()> {
    let (origin, direction) = line(view, centre);
    let edges = [(b, c), (c, a), (a, b)].map(|(from, to)| {
        direction.dot((from - origin).cross(to - origin)) / ((to - from).length() + 1.0e-9)
    });
    let [lowest, highest] = [f64::min, f64::max].map(|pick| edges.into_iter().reduce(pick).unwrap_or(0.0));
    let normal = (b - a).cross(c - a);
    let facing = normal.dot(direction);
    let is_certain = facing.abs() > 1.0e-2 * normal.length() * direction.length();
    if edges.iter().any(|edge| edge.abs() < 2.0e-6) || (!is_certain && lowest * highest >= 0.0) {
        return Err(());
    }
    if lowest < 0.0 && highest > 0.0 {
        return Ok(None);
    }
    let z = normal.dot(a - origin) / facing;
    if z <= 0.0 {
        return if z < -1.0e-4 { Ok(None) } else { Err(()) };
    }
    let swing = (normal.x.abs() + normal.y.abs()) * half_texel;
    let extent = match view.parallel {
        true => swing / normal.z.abs(),
        false if facing.abs() > 1.001 * swing => z * facing.abs() / (facing.abs() - swing) - z,
        false => f64::INFINITY,
    };
    Ok(Some(z + extent))
}

/// Returns the answer of the map of a light to a ray. The triangle `excluded` is not on the map.
pub fn naive(
    light: &rasray_shadow_maps::Light,
    excluded: Option<u32>,
    triangles: &[[DVec3; 3]],
    ray: &Ray,
    resolution: u32,
) -> Naive {
    let p = vector(ray.origin);
    let view = View::of(light, triangles, p);
    let at = view.at(p);
    let place = if view.parallel { [at.x, at.y] } else { [at.x / at.z, at.y / at.z] };
    let texels = place.map(|x| (x + 1.0) * 0.5 * f64::from(resolution));
    if texels.iter().any(|x| (x - x.round()).abs() < 2.0e-3) {
        return Naive::Unsure;
    }
    let centre = texels.map(|x| (x.floor() + 0.5) * 2.0 / f64::from(resolution) - 1.0);
    let mut nearest = f64::INFINITY;
    for (_, corners) in (0..).zip(triangles).filter(|(triangle, _)| Some(*triangle) != excluded) {
        let corners = corners.map(|corner| view.at(corner));
        match stored(&view, corners, centre, 1.0 / f64::from(resolution)) {
            Ok(found) => nearest = nearest.min(found.unwrap_or(f64::INFINITY)),
            Err(()) => return Naive::Unsure,
        }
    }
    let [a, b, c] = triangles[ray.exclude_primitive as usize].map(|corner| view.at(corner));
    let (origin, direction) = line(&view, centre);
    let normal = (b - a).cross(c - a);
    let facing = normal.dot(direction);
    if facing.abs() < 1.0e-2 * normal.length() * direction.length() {
        return Naive::Unsure;
    }
    let plane = normal.dot(a - origin) / facing;
    let receiver = if plane > 0.0 || view.parallel { plane.min(at.z) } else { at.z };
    // The device adds a bound of its rounding to depths.
    match receiver - nearest {
        beyond if beyond > 2.0e-4 => Naive::Occluded,
        beyond if beyond < 1.0e-6 => Naive::Open,
        _ => Naive::Unsure,
    }
}

#[test]
fn answers_are_those_of_a_naive_map() {
    let (device, _turn) = device();
    let scene = scene_of(&cluttered_room(60), lights());
    let mut lit = Lit::new(&device, &scene, Config::new(64));
    for resolution in [64, 100, 512] {
        lit = lit.with(Config::new(resolution));
        lit.build();
        let triangles = lit.triangles();
        for (light, record) in lit.scene.lights().to_vec().iter().enumerate() {
            let rays = lit.shadow_rays(light as u32, 1500);
            let found = lit.occluded(&rays, true);
            let (mut counts, mut unsure) = ([0, 0], 0);
            for (ray, occluded) in rays.iter().zip(found) {
                let expected = match naive(record, None, &triangles, ray, resolution) {
                    Naive::Occluded => true,
                    Naive::Open => false,
                    Naive::Unsure => {
                        unsure += 1;
                        continue;
                    }
                };
                assert_eq!(occluded, expected, "light {light}, {resolution} texels: {ray:?}");
                counts[usize::from(expected)] += 1;
            }
            let [open, occluded] = counts;
            println!("light {light}, {resolution} texels: {open} open, {occluded} occluded, {unsure} unsure");
            assert!(open > 50 && occluded > 50 && 5 * unsure < rays.len(), "light {light}");
        }
    }
    expect_silence(&device);
}

/// Checks that no point of a flat surface is in its own shadow, however steep the surface is. The bias
/// suffices for this, and so does the known triangle of the point without a bias.
#[test]
fn a_surface_does_not_shade_itself() {
    let (device, _turn) = device();
    let slope = |tilt: f64| {
        let (u, v) = (DVec3::new(1.0, tilt, 0.0), DVec3::Z);
        [[-u - v, u - v, u + v], [-u - v, u + v, -u + v]]
    };
    for tilt in [0.0, 0.7, 5.0, 60.0] {
        let sun =
            Light::Directional { direction: DVec3::new(0.1, -1.0, 0.2).normalize(), irradiance: [1.0; 3] };
        let lamp =
            Light::Point { position: DVec3::new(-1.5, 70.0, 0.3), intensity: [1.0; 3], range: f32::INFINITY };
        let mut lit = Lit::new(&device, &scene_of(&slope(tilt), vec![sun, lamp]), Config::new(64));
        let mut shaded = [0; 4];
        let kinds = [(1.0, true), (0.0, true), (1.0, false), (0.0, false)];
        for ((bias, is_known), shaded) in kinds.into_iter().zip(&mut shaded) {
            lit = lit.with(Config { bias, ..Config::new(64) });
            lit.build();
            for light in 0..2 {
                let mut rays = lit.shadow_rays(light, 4000);
                if !is_known {
                    rays.iter_mut().for_each(|ray| ray.exclude_primitive = PRIMITIVE_NONE);
                }
                *shaded += lit.occluded(&rays, true).iter().filter(|occluded| **occluded).count();
            }
        }
        println!("tilt {tilt}: {shaded:?} of 8000 rays");
        assert_eq!(shaded[..3], [0; 3], "tilt {tilt}");
        assert!(shaded[3] > 1000 || tilt == 0.0, "tilt {tilt}: {shaded:?}");
    }
    expect_silence(&device);
}

/// Checks that maps shade at most 0.2 % of the lit points of a ball, whose triangles are smaller and larger
/// than texels, by lights outside and within.
#[test]
fn a_ball_shades_at_most_one_in_500_of_its_lit_points() {
    let (device, _turn) = device();
    let corner = |column: usize, row: usize| {
        let (u, v) = (TAU * column as f64 / 96.0, PI * row as f64 / 48.0);
        DVec3::new(v.sin() * u.cos(), v.cos(), v.sin() * u.sin())
    };
    let cells = (0..96).flat_map(|column| (0..48).map(move |row| (column, row)));
    let triangles: Vec<_> = cells
        .flat_map(|(column, row)| {
            let [a, b, c, d] = [(0, 0), (1, 0), (1, 1), (0, 1)].map(|(u, v)| corner(column + u, row + v));
            [[a, b, c], [a, c, d]]
        })
        .filter(|[a, b, c]| (*b - *a).cross(*c - *a).length() > 1.0e-6)
        .collect();
    let lamp = |position| Light::Point { position, intensity: [1.0; 3], range: f32::INFINITY };
    let sun = Light::Directional { direction: DVec3::new(0.4, -0.8, 0.3).normalize(), irradiance: [1.0; 3] };
    let lights = vec![lamp(DVec3::new(1.5, 2.0, -1.0)), sun, lamp(DVec3::new(0.2, -0.1, 0.3))];
    let mut lit = Lit::new(&device, &scene_of(&triangles, lights), Config::new(16));
    for resolution in [16, 32, 128] {
        lit = lit.with(Config::new(resolution));
        lit.build();
        for light in 0..3 {
            let rays = lit.shadow_rays(light, 5000);
            let (found, traced) = (lit.occluded(&rays, true), lit.occluded(&rays, false));
            let open = traced.iter().filter(|occluded| !**occluded).count();
            let shaded = found.iter().zip(&traced).filter(|(found, traced)| **found && !**traced).count();
            println!("light {light}, {resolution} texels: {shaded} of {open} open rays are shaded");
            assert!(open > 1000 && 500 * shaded <= open, "light {light}, {resolution} texels");
        }
    }
    expect_silence(&device);
}
