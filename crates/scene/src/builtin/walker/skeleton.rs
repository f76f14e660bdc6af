//! Joints of the walker, in the pose in which the body is bound to them.

use glam::{DAffine3, DQuat, DVec3};

use crate::animation::{NodeTransform, RigNode, Skin};

/// Number of joints.
pub(super) const COUNT: usize = 19;
pub(super) const PELVIS: usize = 0;
pub(super) const SPINE: usize = 1;
pub(super) const CHEST: usize = 2;
pub(super) const NECK: usize = 3;
pub(super) const HEAD: usize = 4;

/// Angle between the arms and the vertical in the bind pose, radians.
pub(super) const ARM_ANGLE: f64 = 0.5;
/// Lengths, metres.
const UPPER_ARM: f64 = 0.28;
const FOREARM: f64 = 0.25;
pub(super) const THIGH: f64 = 0.42;
pub(super) const SHIN: f64 = 0.41;
/// Height of the ankle above the sole, metres.
pub(super) const ANKLE: f64 = 0.09;
/// Vector from the ankle to the ball of the foot, metres.
pub(super) const BALL: DVec3 = DVec3::new(0.0, -0.065, 0.13);
/// Vector from the ankle to the lowest point of the heel, metres.
pub(super) const HEEL: DVec3 = DVec3::new(0.0, -ANKLE, -0.05);

/// Side of the body.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Side {
    Left,
    Right,
}

impl Side {
    pub const BOTH: [Self; 2] = [Self::Left, Self::Right];

    /// Returns the sign of the side along x: the figure looks along +z, its left hand is at +x.
    pub fn sign(self) -> f64 {
        if self == Self::Left { 1.0 } else { -1.0 }
    }

    pub fn upper_arm(self) -> usize {
        5 + 3 * self as usize
    }

    pub fn forearm(self) -> usize {
        self.upper_arm() + 1
    }

    pub fn hand(self) -> usize {
        self.upper_arm() + 2
    }

    pub fn thigh(self) -> usize {
        11 + 4 * self as usize
    }

    pub fn shin(self) -> usize {
        self.thigh() + 1
    }

    pub fn foot(self) -> usize {
        self.thigh() + 2
    }

    pub fn toe(self) -> usize {
        self.thigh() + 3
    }

    /// Returns the vector from the shoulder to the hand.
    pub fn along_arm(self) -> DVec3 {
        DVec3::new(self.sign() * ARM_ANGLE.sin(), -ARM_ANGLE.cos(), 0.0)
    }
}

/// Joint; in the bind pose all joints have the axes of the world.
#[derive(Clone)]
pub(super) struct Joint {
    pub name: String,
    pub parent: Option<usize>,
    /// Position of the joint, metres, in the space of the mesh.
    pub place: DVec3,
}

/// Returns all joints; parents come first.
pub(super) fn joints() -> Vec<Joint> {
    let joint = |name: &str, parent: Option<usize>, x: f64, y: f64, z: f64| Joint {
        name: name.to_owned(),
        parent,
        place: DVec3::new(x, y, z),
    };
    let mut joints = vec![
        joint("pelvis", None, 0.0, 0.95, 0.0),
        joint("spine", Some(PELVIS), 0.0, 1.06, -0.005),
        joint("chest", Some(SPINE), 0.0, 1.22, -0.01),
        joint("neck", Some(CHEST), 0.0, 1.46, -0.015),
        joint("head", Some(NECK), 0.0, 1.55, 0.0),
    ];
    let word = |side: Side| if side == Side::Left { "left" } else { "right" };
    for side in Side::BOTH {
        let shoulder = DVec3::new(0.18 * side.sign(), 1.41, -0.01);
        let places = [0.0, UPPER_ARM, UPPER_ARM + FOREARM].map(|along| shoulder + side.along_arm() * along);
        let parents = [CHEST, side.upper_arm(), side.forearm()];
        for ((name, place), parent) in ["upper arm", "forearm", "hand"].into_iter().zip(places).zip(parents) {
            joints.push(Joint { name: format!("{} {name}", word(side)), parent: Some(parent), place });
        }
    }
    for side in Side::BOTH {
        let hip = DVec3::new(0.09 * side.sign(), ANKLE + SHIN + THIGH, 0.0);
        let ankle = hip - DVec3::Y * (THIGH + SHIN);
        let places = [hip, hip - DVec3::Y * THIGH, ankle, ankle + BALL];
        let parents = [PELVIS, side.thigh(), side.shin(), side.foot()];
        for ((name, place), parent) in ["thigh", "shin", "foot", "toe"].into_iter().zip(places).zip(parents) {
            joints.push(Joint { name: format!("{} {name}", word(side)), parent: Some(parent), place });
        }
    }
    joints
}

/// Returns the position of each joint relative to its parent in the bind pose.
fn offset(joints: &[Joint], joint: usize) -> DVec3 {
    joints[joint].place - joints[joint].parent.map_or(DVec3::ZERO, |parent| joints[parent].place)
}

/// Makes the nodes of the joints, the first of which will be node `first`.
pub(super) fn nodes(joints: &[Joint], first: usize) -> Vec<RigNode> {
    let node = |(index, joint): (usize, &Joint)| RigNode {
        name: joint.name.clone(),
        parent: joint.parent.map(|parent| first + parent),
        transform: NodeTransform::Parts {
            translation: offset(joints, index),
            rotation: DQuat::IDENTITY,
            scale: DVec3::ONE,
        },
    };
    joints.iter().enumerate().map(node).collect()
}

/// Makes the skin over these joints.
pub(super) fn skin(joints: &[Joint], first: usize) -> Skin {
    Skin {
        name: "walker".to_owned(),
        joints: (first..first + joints.len()).collect(),
        joint_from_mesh: joints.iter().map(|joint| DAffine3::from_translation(-joint.place)).collect(),
    }
}
