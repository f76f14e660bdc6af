//! Body of the walker and its clothes: solids around the joints, and the weights by which joints move their
//! surfaces.

use glam::DVec3;

use super::super::solid::{RoundCone, Surface, smooth_max, smooth_min, surface};
use super::skeleton::{CHEST, HEAD, Joint, NECK, PELVIS, SPINE, Side};
use crate::animation::SkinBinding;

/// Distance over which the influence of a joint fades out, metres.
const FADE: f64 = 0.07;

/// Part of the body that has one material.
pub(super) struct Part {
    pub name: &'static str,
    /// Solids, each with the joint that moves it.
    cones: Vec<(usize, RoundCone)>,
    /// Planes that cut the whole part: a point, and the direction of the side that is cut off.
    cuts: Vec<(DVec3, DVec3)>,
    /// Planes that cut one solid each, by its index in `cones`: a point, and the direction of the side that
    /// is cut off.
    ends: Vec<(usize, DVec3, DVec3)>,
    /// Distance over which solids blend into one another, metres.
    seam: f64,
}

impl Part {
    fn new(name: &'static str, seam: f64) -> Self {
        Self { name, cones: Vec::new(), cuts: Vec::new(), ends: Vec::new(), seam }
    }

    fn cone(&mut self, joint: usize, from: DVec3, r0: f64, to: DVec3, r1: f64) {
        self.cones.push((joint, RoundCone { ends: [(from, r0), (to, r1)] }));
    }

    fn ball(&mut self, joint: usize, centre: DVec3, radius: f64) {
        self.cone(joint, centre, radius, centre, radius);
    }

    fn distance(&self, point: DVec3, edge: f64) -> f64 {
        let cut = |whole: f64, place: DVec3, out: DVec3| smooth_max(whole, (point - place).dot(out), edge);
        let whole = self.cones.iter().enumerate().fold(f64::INFINITY, |whole, (index, (_, cone))| {
            let ends = self.ends.iter().filter(|(cut, ..)| *cut == index);
            let next = ends.fold(cone.distance(point), |next, &(_, place, out)| cut(next, place, out));
            if whole.is_finite() { smooth_min(whole, next, self.seam) } else { next }
        });
        self.cuts.iter().fold(whole, |whole, &(place, out)| cut(whole, place, out))
    }

    /// Meshes the surface with triangles of about this size, metres.
    pub fn surface(&self, size: f64) -> Surface {
        let corners = self.cones.iter().flat_map(|(_, cone)| cone.ends);
        let (low, high) =
            corners.fold((DVec3::INFINITY, DVec3::NEG_INFINITY), |(low, high), (centre, radius)| {
                let reach = radius + self.seam;
                (low.min(centre - reach), high.max(centre + reach))
            });
        // Small parts stay round, and edges are no sharper than the triangles can show.
        let largest =
            self.cones.iter().flat_map(|(_, cone)| cone.ends).map(|(_, radius)| radius).fold(0.0, f64::max);
        let size = size.min(0.45 * largest);
        let edge = (1.5 * size).max(0.008);
        surface(&|point| self.distance(point, edge), low, high, size)
    }

    /// Binds each vertex to the four nearest joints, with weights that fade out with the distance from the
    /// solids that each joint moves.
    pub fn binding(&self, positions: &[DVec3]) -> SkinBinding {
        let mut binding = SkinBinding { skin: 0, per_vertex: 4, joints: Vec::new(), weights: Vec::new() };
        for &position in positions {
            let mut near: Vec<(f64, usize)> = Vec::new();
            for &(joint, cone) in &self.cones {
                let distance = cone.distance(position);
                match near.iter_mut().find(|(_, other)| *other == joint) {
                    Some((nearest, _)) => *nearest = nearest.min(distance),
                    None => near.push((distance, joint)),
                }
            }
            near.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
            let nearest = near[0].0;
            let share = |distance: f64| (1.0 - (distance - nearest) / FADE).max(0.0).powi(3);
            near.truncate(4);
            let sum: f64 = near.iter().map(|(distance, _)| share(*distance)).sum();
            for slot in 0..4 {
                let (distance, joint) = near.get(slot).copied().unwrap_or((f64::INFINITY, near[0].1));
                binding.joints.push(joint as u32);
                binding.weights.push((share(distance) / sum) as f32);
            }
        }
        binding
    }
}

fn at(x: f64, y: f64, z: f64) -> DVec3 {
    DVec3::new(x, y, z)
}

/// Makes all parts, in the order of their materials.
pub(super) fn parts(joints: &[Joint]) -> [Part; 6] {
    [skin(joints), shirt(joints), trousers(joints), shoes(joints), hair(), eyes()]
}

fn skin(joints: &[Joint]) -> Part {
    let mut part = Part::new("skin", 0.03);
    part.cone(HEAD, at(0.0, 1.655, -0.02), 0.1, at(0.0, 1.64, 0.02), 0.092);
    part.cone(HEAD, at(0.0, 1.61, 0.03), 0.07, at(0.0, 1.565, 0.062), 0.036);
    part.cone(HEAD, at(0.0, 1.65, 0.108), 0.008, at(0.0, 1.622, 0.122), 0.013);
    part.cone(NECK, at(0.0, 1.42, -0.02), 0.06, at(0.0, 1.58, -0.01), 0.052);
    for side in Side::BOTH {
        part.cone(HEAD, at(0.1 * side.sign(), 1.65, 0.0), 0.016, at(0.096 * side.sign(), 1.62, 0.006), 0.011);
        let place = |joint: usize| joints[joint].place;
        let (shoulder, elbow, wrist) = (place(side.upper_arm()), place(side.forearm()), place(side.hand()));
        let along = side.along_arm();
        part.cone(side.upper_arm(), shoulder.lerp(elbow, 0.5), 0.045, elbow, 0.039);
        part.cone(side.forearm(), elbow, 0.039, elbow.lerp(wrist, 0.3), 0.042);
        part.cone(side.forearm(), elbow.lerp(wrist, 0.3), 0.042, wrist, 0.028);
        // The hand is half closed: knuckles, fingers bent ahead, the thumb in front.
        part.cone(side.hand(), wrist + along * 0.02, 0.029, wrist + along * 0.075 + DVec3::Z * 0.008, 0.034);
        part.cone(
            side.hand(),
            wrist + along * 0.09 + DVec3::Z * 0.005,
            0.026,
            wrist + along * 0.13 + DVec3::Z * 0.03,
            0.02,
        );
        part.cone(
            side.hand(),
            wrist + along * 0.04 + DVec3::Z * 0.03,
            0.016,
            wrist + along * 0.095 + DVec3::Z * 0.055,
            0.012,
        );
    }
    part
}

fn shirt(joints: &[Joint]) -> Part {
    let mut part = Part::new("shirt", 0.05);
    for side in Side::BOTH {
        let x = side.sign();
        part.cone(CHEST, at(0.075 * x, 1.36, -0.01), 0.095, at(0.065 * x, 1.2, 0.0), 0.098);
        part.cone(SPINE, at(0.055 * x, 1.14, 0.0), 0.1, at(0.045 * x, 1.06, 0.0), 0.1);
        part.cone(PELVIS, at(0.05 * x, 1.02, 0.0), 0.104, at(0.062 * x, 0.88, -0.008), 0.118);
        part.cone(CHEST, at(0.03 * x, 1.435, -0.018), 0.056, at(0.16 * x, 1.415, -0.012), 0.058);
        let (shoulder, elbow) = (joints[side.upper_arm()].place, joints[side.forearm()].place);
        part.cone(side.upper_arm(), shoulder, 0.064, shoulder.lerp(elbow, 0.95), 0.058);
        part.ends.push((part.cones.len() - 1, shoulder.lerp(elbow, 0.74), side.along_arm()));
    }
    part.cuts.push((at(0.0, 0.905, 0.0), DVec3::NEG_Y));
    part
}

fn trousers(joints: &[Joint]) -> Part {
    let mut part = Part::new("trousers", 0.035);
    for side in Side::BOTH {
        let x = side.sign();
        let place = |joint: usize| joints[joint].place;
        let (hip, knee, ankle) = (place(side.thigh()), place(side.shin()), place(side.foot()));
        part.cone(PELVIS, at(0.045 * x, 0.99, 0.0), 0.096, at(0.058 * x, 0.9, -0.005), 0.102);
        part.ball(PELVIS, at(0.06 * x, 0.885, -0.035), 0.088);
        part.cone(side.thigh(), hip - DVec3::Y * 0.03, 0.086, knee, 0.06);
        part.cone(side.shin(), knee, 0.06, ankle + DVec3::new(0.0, -0.03, -0.008), 0.058);
        part.ball(side.shin(), knee + DVec3::new(0.0, -0.12, -0.016), 0.056);
    }
    part.cuts.push((at(0.0, 0.085, 0.0), DVec3::NEG_Y));
    part
}

fn shoes(joints: &[Joint]) -> Part {
    let mut part = Part::new("shoes", 0.025);
    for side in Side::BOTH {
        let (ankle, ball) = (joints[side.foot()].place, joints[side.toe()].place);
        let foot = side.foot();
        part.cone(foot, ankle + at(0.0, -0.04, -0.022), 0.044, ankle + at(0.0, -0.05, 0.09), 0.04);
        part.cone(foot, ankle + at(0.0, -0.03, -0.015), 0.044, ankle + at(0.0, 0.03, -0.008), 0.04);
        part.cone(foot, ankle + at(0.0, -0.01, 0.01), 0.04, ankle + at(0.0, -0.048, 0.09), 0.036);
        part.cone(
            side.toe(),
            ball + at(0.0, 0.012, -0.02),
            0.042,
            ball + at(-0.006 * side.sign(), 0.008, 0.055),
            0.034,
        );
    }
    // The plane cuts off everything that would reach into the ground, just above it.
    part.cuts.push((at(0.0, 0.002, 0.0), DVec3::NEG_Y));
    part
}

fn hair() -> Part {
    let mut part = Part::new("hair", 0.03);
    part.cone(HEAD, at(0.0, 1.67, -0.022), 0.108, at(0.0, 1.655, 0.005), 0.102);
    part.ball(HEAD, at(0.0, 1.6, -0.05), 0.075);
    part.cuts.push((at(0.0, 1.69, 0.055), at(0.0, -0.62, 0.78).normalize()));
    part
}

fn eyes() -> Part {
    let mut part = Part::new("eyes", 0.001);
    for side in Side::BOTH {
        part.ball(HEAD, at(0.036 * side.sign(), 1.655, 0.1), 0.0125);
    }
    part
}
