//! Gait of the walker: a circle of whole strides, so that the end of the clip equals its beginning.
//!
//! Feet stand still where they are set down; legs follow by inverse kinematics, and the body above the legs
//! swings against them.

use std::f64::consts::{PI, TAU};

use glam::{DMat3, DQuat, DVec3};

use super::skeleton::{
    ANKLE, ARM_ANGLE, BALL, CHEST, COUNT, HEAD, HEEL, Joint, NECK, PELVIS, SHIN, SPINE, Side, THIGH,
};

/// Number of strides (two steps each) of the circle; one takes a second.
pub(super) const STRIDES: usize = 6;
/// Length of a stride, metres.
const STRIDE: f64 = 1.12;
/// Radius of the circle, metres.
pub(super) const RADIUS: f64 = STRIDES as f64 * STRIDE / TAU;
/// Share of a stride during which a foot stands.
const STANCE: f64 = 0.62;
/// Number of strides from the moment when a foot is set down until the body is above it.
const REACH: f64 = 0.25;
/// Distance from the feet to the line of walking, metres.
const TRACK: f64 = 0.065;

/// Rotations of all joints, and the position of the first.
pub(super) struct Stance {
    /// Position of the pelvis, metres, world.
    pub pelvis: DVec3,
    /// Rotation of each joint, relative to its parent.
    pub rotations: [DQuat; COUNT],
}

/// Returns the pose after the given number of strides, at least 0.
pub(super) fn stance(joints: &[Joint], strides: f64) -> Stance {
    let swing = TAU * strides;
    let heading = heading(strides);
    let turn = |x: f64, y: f64, z: f64| {
        DQuat::from_rotation_y(y) * DQuat::from_rotation_z(z) * DQuat::from_rotation_x(x)
    };
    // The hip of the leg that reaches forward turns forward, the side of the swinging leg hangs, and the body
    // is above the standing foot.
    let pelvis_turn = heading * turn(0.03, -0.09 * swing.cos(), 0.05 * swing.sin());
    let bob = 0.018 * (2.0 * swing - PI).cos();
    let pelvis = place(strides, DVec3::new(0.022 * swing.sin(), 0.912 + bob, 0.0));

    let mut rotations = [DQuat::IDENTITY; COUNT];
    rotations[PELVIS] = pelvis_turn;
    // The body leans into the curve; shoulders turn against hips, and the head looks ahead.
    rotations[SPINE] = turn(0.05, 0.09 * swing.cos(), -0.03 * swing.sin() - 0.035);
    rotations[CHEST] = turn(0.01, 0.10 * swing.cos(), -0.02 * swing.sin() - 0.015);
    rotations[NECK] = turn(-0.02, -0.05 * swing.cos(), 0.01);
    rotations[HEAD] = turn(-0.05 + 0.015 * (2.0 * swing).sin(), 0.06 - 0.05 * swing.cos(), 0.02);
    for side in Side::BOTH {
        arm(side, swing, &mut rotations);
        leg(joints, side, strides, pelvis, pelvis_turn, &mut rotations);
    }
    Stance { pelvis, rotations }
}

/// Returns the rotation of the body: by the angle of the circle that it has walked.
fn heading(strides: f64) -> DQuat {
    DQuat::from_rotation_y(strides / STRIDES as f64 * TAU)
}

/// Returns the world position of a point relative to the walking body (x to its left, z ahead).
fn place(strides: f64, relative: DVec3) -> DVec3 {
    heading(strides) * (relative - DVec3::X * RADIUS)
}

/// Swings an arm with the leg of the other side.
fn arm(side: Side, swing: f64, rotations: &mut [DQuat; COUNT]) {
    let back = swing.cos() * side.sign();
    let hang = DQuat::from_rotation_z(-(ARM_ANGLE - 0.24) * side.sign());
    rotations[side.upper_arm()] = DQuat::from_rotation_x(0.42 * back - 0.04) * hang;
    let axis = DVec3::new(ARM_ANGLE.cos(), side.sign() * ARM_ANGLE.sin(), 0.0);
    rotations[side.forearm()] = DQuat::from_axis_angle(axis, -(0.38 - 0.2 * back));
    rotations[side.hand()] = DQuat::from_axis_angle(axis, -0.12);
}

/// Position and rotation of a foot.
struct Foot {
    /// Position of the ankle, metres, world.
    ankle: DVec3,
    /// Rotation of the foot about the vertical, radians.
    yaw: f64,
    /// Slope from the toes up to the heel, radians.
    pitch: f64,
    /// Bend of the toes upwards, radians.
    bend: f64,
}

/// Returns a standing foot after a share of its time on the ground: it lands on the heel and leaves over the
/// ball.
fn standing(side: Side, landing: f64, share: f64) -> Foot {
    let over = landing + REACH;
    let ground = place(over, DVec3::new(TRACK * side.sign(), 0.0, 0.0));
    let yaw = over / STRIDES as f64 * TAU + 0.10 * side.sign();
    let landing = -0.36 * (1.0 - ease(share / 0.16));
    let leaving = 0.95 * ease((share - 0.5) / 0.6).powf(1.3);
    let pivot = if landing < 0.0 { HEEL } else { BALL };
    let pitch = landing + leaving;
    let flat = DQuat::from_rotation_y(yaw);
    let ankle = ground + DVec3::Y * ANKLE + flat * (pivot - DQuat::from_rotation_x(pitch) * pivot);
    Foot { ankle, yaw, pitch, bend: leaving }
}

/// Returns a smooth step: 0 before 0, 1 after 1, with level ends.
fn ease(share: f64) -> f64 {
    let share = share.clamp(0.0, 1.0);
    share * share * (3.0 - 2.0 * share)
}

fn foot(side: Side, strides: f64) -> Foot {
    let offset = if side == Side::Left { 0.0 } else { 0.5 };
    let landing = (strides - offset).floor() + offset;
    let since = strides - landing;
    if since <= STANCE {
        return standing(side, landing, since / STANCE);
    }
    let share = (since - STANCE) / (1.0 - STANCE);
    let (from, to) = (standing(side, landing, 1.0), standing(side, landing + 1.0, 0.0));
    let along = ease(share);
    let mix = |a: f64, b: f64| a + (b - a) * along;
    // The knee is lifted early, while the foot hangs.
    let lift = 0.055 * (PI * share.powf(0.8)).sin();
    Foot {
        ankle: from.ankle.lerp(to.ankle, along) + DVec3::Y * lift,
        yaw: mix(from.yaw, to.yaw),
        pitch: from.pitch + (to.pitch - from.pitch) * ease(share * 1.15),
        bend: from.bend * (1.0 - ease(share * 2.5)),
    }
}

/// Rotates thigh, shin, foot and toes so that the ankle is where the foot has it.
fn leg(
    joints: &[Joint],
    side: Side,
    strides: f64,
    pelvis: DVec3,
    pelvis_turn: DQuat,
    rotations: &mut [DQuat; COUNT],
) {
    let foot = foot(side, strides);
    let hip = pelvis + pelvis_turn * (joints[side.thigh()].place - joints[PELVIS].place);
    let level = DQuat::from_rotation_y(foot.yaw);
    let ahead = (heading(strides) * DVec3::Z * 0.5 + level * DVec3::Z).normalize();
    let knee = knee(hip, foot.ankle, ahead);
    let thigh = hanging(hip, knee, ahead);
    let shin = hanging(knee, foot.ankle, ahead);
    let world_foot = level * DQuat::from_rotation_x(foot.pitch);
    rotations[side.thigh()] = pelvis_turn.inverse() * thigh;
    rotations[side.shin()] = thigh.inverse() * shin;
    rotations[side.foot()] = shin.inverse() * world_foot;
    rotations[side.toe()] = DQuat::from_rotation_x(-foot.bend);
}

/// Returns the position of the knee between hip and ankle, bent ahead; the leg is straight where they are too
/// far apart.
fn knee(hip: DVec3, ankle: DVec3, ahead: DVec3) -> DVec3 {
    let down = (ankle - hip).normalize();
    let distance = hip.distance(ankle).min((THIGH + SHIN) * 0.9999);
    let along = (THIGH * THIGH - SHIN * SHIN + distance * distance) / (2.0 * distance);
    let out = (THIGH * THIGH - along * along).max(0.0).sqrt();
    let forward = (ahead - down * ahead.dot(down)).normalize();
    hip + down * along + forward * out
}

/// Returns the rotation of a limb that hangs down in the bind pose and now leads from `from` to `to`.
fn hanging(from: DVec3, to: DVec3, ahead: DVec3) -> DQuat {
    let up = (from - to).normalize();
    let left = up.cross(ahead).normalize();
    DQuat::from_mat3(&DMat3::from_cols(left, up, left.cross(up)))
}

#[cfg(test)]
mod tests {
    use super::super::skeleton::joints;
    use super::*;

    #[test]
    fn legs_reach_their_feet_and_the_end_is_the_beginning() {
        let joints = joints();
        for step in 0..=STRIDES * 50 {
            let strides = step as f64 / 50.0;
            let Stance { pelvis, rotations } = stance(&joints, strides);
            for side in Side::BOTH {
                let hip = pelvis + rotations[PELVIS] * (joints[side.thigh()].place - joints[PELVIS].place);
                let distance = hip.distance(foot(side, strides).ankle);
                assert!(distance < THIGH + SHIN, "{strides}: {distance}");
            }
        }
        let (first, last) = (stance(&joints, 0.0), stance(&joints, STRIDES as f64));
        assert!(first.pelvis.distance(last.pelvis) < 1.0e-12);
        let same = |(a, b): (&DQuat, &DQuat)| a.dot(*b).abs() > 1.0 - 1.0e-12;
        assert!(first.rotations.iter().zip(&last.rotations).all(same));
    }
}
