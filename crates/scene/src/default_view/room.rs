//! Tests whether a scene is a room, and a camera that stands in it.

use std::f64::consts::{FRAC_1_SQRT_2, PI, TAU};

use glam::DVec3;

use super::bounds::bounds;
use super::looking::camera_looking_at;
use super::sight::Sight;
use crate::{Camera, Scene};

/// Heights of points, as shares of the height of the bounds, preferred ones first: of the region in the
/// middle of the bounds that is searched for a room, and of the eye.
const HEIGHTS: [f64; 5] = [0.35, 0.25, 0.5, 0.15, 0.7];
/// Number of directions, over the whole sphere, in which a point's surroundings are examined.
const DIRECTIONS: usize = 96;
/// Least shares of directions that end on the front of a surface: of all directions, and of the downward
/// ones. A hollow object with walls of its own, such as a helmet, lacks the floor.
const FRONTS: f64 = 0.6;
const FRONTS_BELOW: f64 = 0.9;
/// Least share of fronts in each quarter of the horizon, among the directions that do not rise by more than
/// 30 degrees: the camera stands only in a room that is one in all directions. The face of a mask is open.
const FRONTS_AROUND: f64 = 0.75;
/// Cosine of the angle between straight up and the steepest of those directions.
const STEEPEST: f64 = 0.5;
/// Largest share of the surface that may lie outside. Of a lined hollow object, such as a helmet or the shell
/// of a machine, more than half does, since a lining is smaller than the outer shell; of a building that is
/// modelled for its inside, with its outer walls, a third and less.
const OUTER: f64 = 0.42;
/// Number of points on the surface that are examined for that share, and number of directions from each,
/// three in four of which must be free.
const PLACES_ON_SURFACE: usize = 1024;
const DIRECTIONS_FROM_SURFACE: usize = 12;
/// Least share of the directions that an open side takes, as of a box for show, and least length of the mean
/// of all directions that end nowhere (1 if all are equal).
const OPEN_SIDE: f64 = 0.08;
const OPEN_SIDE_MEAN: f64 = 0.7;
/// Least cosine of the angle between that mean and the axis that the side lies across.
const OPEN_SIDE_AXIS: f64 = 0.95;
/// Full vertical angle through an open side, degrees, and the margin of the view around the side.
const OPEN_SIDE_FOV_Y: f64 = 40.0;
const OPEN_SIDE_MARGIN: f64 = 1.05;
/// Least distance from the eye to any surface, in diagonals of the bounds.
const CLEARANCE: f64 = 0.02;
/// Number of level directions among which the view is chosen.
const HEADINGS: usize = 64;
/// Angles from a heading at which rays are cast, radians. The way ahead is as long as the shortest of these
/// rays, so that a gap between two columns is no view.
const FAN: [f64; 5] = [0.0, -0.035, 0.035, -0.07, 0.07];
/// Number of positions tried for each heading, from the middle back to the bounds.
const PLACES: usize = 13;
/// Factor by which a view must be longer to be better; among views almost as long the first stays.
const LONGER: f64 = 1.03;
/// Least length of the way ahead, in longest level edges of the bounds; a room with a shorter one is only a
/// nook.
const LEAST_WAY: f64 = 0.3;
/// Fall of the view over its length: about three degrees.
const FALL: f64 = 0.05;
/// Full vertical angles, degrees, for ways that are as long as they are broad, and for ways at least three
/// times as long.
const FOV_Y: (f64, f64) = (70.0, 60.0);

/// Places a camera in the room that the scene is; `None` if the scene is no room.
pub(super) fn camera_inside(scene: &Scene) -> Option<Camera> {
    let (low, high) = bounds(scene)?;
    let extent = high - low;
    let clearance = extent.length() * CLEARANCE;
    // The test excludes bounds that are too flat to stand in, and bounds too large for arithmetic.
    if !(clearance > 0.0 && clearance.is_finite() && extent.min_element() >= 2.0 * clearance) {
        return None;
    }
    let room = Room { sight: Sight::new(scene, low, high)?, clearance };
    let middles = HEIGHTS.map(|share| (low + extent * DVec3::new(0.5, share, 0.5)).min(high));
    let &middle = middles.iter().find(|&&middle| room.is_around(middle))?;
    if let Some(camera) = room.camera_at_open_side(middle) {
        return Some(camera);
    }
    if !(room.is_around_everywhere(middle) && room.outer_share() <= OUTER) {
        return None;
    }
    let mut best: Option<View> = None;
    for middle in middles {
        room.look_from(middle, &mut best);
    }
    let view = best.filter(|view| view.way >= LEAST_WAY * extent.x.max(extent.z))?;
    Some(room.camera(&view))
}

/// Position and level direction of a view.
struct View {
    eye: DVec3,
    forward: DVec3,
    /// Length of the free way ahead up to the first surface, metres.
    way: f64,
}

/// Surfaces seen from a point.
struct Surroundings {
    /// Distance to the nearest surface, metres; infinite if nothing is seen.
    nearest: f64,
    /// Share of all directions that end on a front.
    fronts: f64,
    /// Share of the directions within 45 degrees of straight down that end on a front.
    fronts_below: f64,
}

struct Room<'a> {
    sight: Sight<'a>,
    /// Least distance from the eye to any surface, metres.
    clearance: f64,
}

impl Room<'_> {
    fn is_around(&self, point: DVec3) -> bool {
        let seen = self.surroundings(point);
        seen.nearest >= self.clearance && seen.fronts >= FRONTS && seen.fronts_below >= FRONTS_BELOW
    }

    fn is_around_everywhere(&self, point: DVec3) -> bool {
        let (mut all, mut fronts) = ([0_u32; 4], [0_u32; 4]);
        for direction in sphere().filter(|direction| direction.y <= STEEPEST) {
            let quarter =
                2 * usize::from(direction.x + direction.z > 0.0) + usize::from(direction.x > direction.z);
            all[quarter] += 1;
            fronts[quarter] += u32::from(self.sight.first(point, direction).is_some_and(|hit| hit.front));
        }
        all.iter().zip(fronts).all(|(&all, fronts)| f64::from(fronts) >= FRONTS_AROUND * f64::from(all))
    }

    /// Returns the share of the surface, by area, whose front is open to the outside: three in four
    /// directions from there, by the cosine law, hit nothing.
    fn outer_share(&self) -> f64 {
        let places = self.sight.places(PLACES_ON_SURFACE);
        // A hit closer than this is on the surface that the point lies on.
        let own = self.clearance * 1.0e-4;
        let is_outside = |&(place, normal): &(DVec3, DVec3)| {
            let ways = sphere_of(DIRECTIONS_FROM_SURFACE).map(|point| (normal + point).normalize_or(normal));
            let free = ways.filter(|&way| self.sight.first_beyond(place, way, own).is_none()).count();
            4 * free >= 3 * DIRECTIONS_FROM_SURFACE
        };
        let outside = places.iter().filter(|place| is_outside(place)).count();
        outside as f64 / places.len().max(1) as f64
    }

    fn surroundings(&self, point: DVec3) -> Surroundings {
        let mut nearest = f64::INFINITY;
        let (mut fronts, mut below, mut fronts_below) = (0_u32, 0_u32, 0_u32);
        for direction in sphere() {
            let hit = self.sight.first(point, direction);
            nearest = nearest.min(hit.map_or(f64::INFINITY, |hit| hit.t));
            let front = u32::from(hit.is_some_and(|hit| hit.front));
            fronts += front;
            if direction.y < -FRAC_1_SQRT_2 {
                below += 1;
                fronts_below += front;
            }
        }
        // Walls often lie across the axes, which are between the directions of the sphere.
        for axis in DVec3::AXES {
            for direction in [axis, -axis] {
                nearest = self.sight.first(point, direction).map_or(nearest, |hit| hit.t.min(nearest));
            }
        }
        let share = |part: u32, whole: u32| f64::from(part) / f64::from(whole);
        Surroundings {
            nearest,
            fronts: share(fronts, DIRECTIONS as u32),
            fronts_below: share(fronts_below, below),
        }
    }

    /// Replaces the best view by better ones whose way passes through the middle or near it. An object in the
    /// middle may hide the rest, so positions behind it count too.
    fn look_from(&self, middle: DVec3, best: &mut Option<View>) {
        for heading in 0..HEADINGS {
            let angle = TAU * heading as f64 / HEADINGS as f64;
            let forward = level(angle);
            // The eye is a little more than clear, so that rounding does not decide.
            let room_behind = self.exit(middle, -forward) - self.clearance * 1.01;
            for place in 0..PLACES {
                let eye = middle - forward * (room_behind * place as f64 / (PLACES - 1) as f64);
                let Some(way) = self.way_to_front(eye, angle) else { continue };
                let longer = best.as_ref().is_none_or(|best| way > best.way * LONGER);
                if longer && self.is_around(eye) {
                    *best = Some(View { eye, forward, way });
                }
            }
        }
    }

    /// Places a camera before the one open side of the room, looking straight in; `None` if there is no such
    /// side, or it is the top.
    fn camera_at_open_side(&self, middle: DVec3) -> Option<Camera> {
        let open: Vec<DVec3> =
            sphere().filter(|&direction| self.sight.first(middle, direction).is_none()).collect();
        if (open.len() as f64) < OPEN_SIDE * DIRECTIONS as f64 {
            return None;
        }
        let mean = open.iter().sum::<DVec3>() / open.len() as f64;
        let sides = [DVec3::Z, DVec3::NEG_Z, DVec3::X, DVec3::NEG_X];
        let axis = sides.into_iter().find(|axis| axis.dot(mean) >= OPEN_SIDE_AXIS * mean.length())?;
        if mean.length() < OPEN_SIDE_MEAN {
            return None;
        }
        let (centre, half) =
            ((self.sight.low + self.sight.high) * 0.5, (self.sight.high - self.sight.low) * 0.5);
        let across = half.y.max(axis.cross(DVec3::Y).abs().dot(half));
        let angle = OPEN_SIDE_FOV_Y.to_radians();
        let distance = axis.abs().dot(half) + OPEN_SIDE_MARGIN * across / (angle * 0.5).tan();
        Some(camera_looking_at("default", centre + axis * distance, centre, angle as f32))
    }

    fn camera(&self, view: &View) -> Camera {
        let side = view.forward.cross(DVec3::Y);
        let breadth = self.reach(view.eye, side) + self.reach(view.eye, -side);
        let slender = ((view.way / breadth - 1.0) / 2.0).clamp(0.0, 1.0);
        let fov_y = (FOV_Y.0 + (FOV_Y.1 - FOV_Y.0) * slender).to_radians();
        let target = view.eye + (view.forward - DVec3::Y * FALL) * view.way;
        camera_looking_at("default", view.eye, target, fov_y as f32)
    }

    /// Returns the length of the free way in the fan around a heading, metres; `None` if any ray of the fan
    /// leaves the scene or ends on the back of a surface, since a view must show surfaces.
    fn way_to_front(&self, from: DVec3, angle: f64) -> Option<f64> {
        let ray = |turn: &f64| self.sight.first(from, level(angle + turn)).filter(|hit| hit.front);
        FAN.iter().try_fold(f64::INFINITY, |way, turn| Some(way.min(ray(turn)?.t)))
    }

    /// Returns the distance to the first surface, or to the bounds if there is none, metres.
    fn reach(&self, from: DVec3, direction: DVec3) -> f64 {
        self.sight.first(from, direction).map_or_else(|| self.exit(from, direction), |hit| hit.t)
    }

    /// Returns the distance to the bounds from inside, metres.
    fn exit(&self, from: DVec3, direction: DVec3) -> f64 {
        let border = DVec3::select(direction.cmpgt(DVec3::ZERO), self.sight.high, self.sight.low);
        let crossed = (0..3).filter(|&axis| direction[axis] != 0.0);
        crossed.map(|axis| (border[axis] - from[axis]) / direction[axis]).fold(f64::INFINITY, f64::min)
    }
}

/// Returns the level direction at an angle from -z towards -x, radians.
fn level(angle: f64) -> DVec3 {
    DVec3::new(-angle.sin(), 0.0, -angle.cos())
}

fn sphere() -> impl Iterator<Item = DVec3> {
    sphere_of(DIRECTIONS)
}

/// Iterates over directions spread evenly over the sphere: a spiral that turns by the golden angle.
fn sphere_of(count: usize) -> impl Iterator<Item = DVec3> {
    let golden = PI * (3.0 - 5.0_f64.sqrt());
    (0..count).map(move |step| {
        let height = 1.0 - (2.0 * step as f64 + 1.0) / count as f64;
        let radius = (1.0 - height * height).sqrt();
        let (sine, cosine) = (golden * step as f64).sin_cos();
        DVec3::new(radius * cosine, height, radius * sine)
    })
}
