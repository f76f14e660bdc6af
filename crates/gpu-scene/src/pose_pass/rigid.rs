//! Objects in spaces of their own, and the maps from their posed positions to these spaces.

use glam::{DAffine3, DVec3};
use rasray_ads::GeometryRigid;
use rasray_scene::pose::Pose;
use rasray_scene::{Scene, animation::Rig};

use super::sources::DrawPlace;

/// Half a unit of rounding of f32, relative to the number.
const HALF_UNIT: f64 = 1.0 / 16_777_216.0;

/// Object that its node alone moves, in a space that differs from that of the node only by its origin, the
/// middle of the object. Metres.
#[derive(Clone, Debug)]
pub struct RigidObject {
    carrier: usize,
    /// Middle of the object in the space of the node.
    centre: DVec3,
    /// Distance between the corners of the object and its middle.
    radius: f64,
    draws: Vec<RigidDraw>,
    /// Corners of the object's bounds.
    pub bounds: [[f32; 3]; 2],
}

/// Draw of an object, as its vertices are posed.
#[derive(Clone, Debug)]
struct RigidDraw {
    carrier_from_mesh: DAffine3,
    /// Pivot of the positions in mesh space, and their largest distance from it along each axis.
    pivot: DVec3,
    half: DVec3,
}

impl RigidObject {
    /// Makes the object of these draws and writes its positions to their vertices. `None` if some are not
    /// finite.
    pub fn new(
        scene: &Scene,
        carrier: usize,
        places: &[&DrawPlace],
        positions: &mut [[f32; 3]],
    ) -> Option<Self> {
        let rig = &scene.animation.rig;
        let mut draws = Vec::with_capacity(places.len());
        let (mut lower, mut upper) = (DVec3::INFINITY, DVec3::NEG_INFINITY);
        for place in places {
            let carrier_from_mesh = carrier_from_mesh(rig, carrier, place.instance);
            let mut half = DVec3::ZERO;
            for position in mesh_positions(scene, place) {
                half = half.max((position - place.pivot).abs());
                let position = carrier_from_mesh.transform_point3(position);
                (lower, upper) = (lower.min(position), upper.max(position));
            }
            draws.push(RigidDraw { carrier_from_mesh, pivot: place.pivot, half });
        }
        let centre = 0.5 * (lower + upper);
        let mut bounds = [[f32::INFINITY; 3], [f32::NEG_INFINITY; 3]];
        for (place, draw) in places.iter().zip(&draws) {
            let own = positions.get_mut(place.first_vertex as usize..)?.iter_mut();
            for (own, position) in own.zip(mesh_positions(scene, place)) {
                *own = (draw.carrier_from_mesh.transform_point3(position) - centre).as_vec3().to_array();
                for axis in 0..3 {
                    bounds[0][axis] = bounds[0][axis].min(own[axis]);
                    bounds[1][axis] = bounds[1][axis].max(own[axis]);
                }
            }
        }
        let radius = (0.5 * (upper - lower)).length();
        let is_finite = bounds.iter().flatten().all(|corner| corner.is_finite());
        (radius.is_finite() && is_finite).then_some(Self { carrier, centre, radius, draws, bounds })
    }

    /// Returns the map from the posed positions, relative to the frame origin. If its node is flat or a
    /// number exceeds f32, the map has an infinite error.
    pub fn map(&self, pose: &Pose, frame_origin: DVec3) -> GeometryRigid {
        let world = pose.world(self.carrier);
        let centre = world.transform_point3(self.centre) - frame_origin;
        let linear = world.matrix3.inverse();
        let about = centre.as_vec3();
        // An upper bound of the length to which the matrix maps a unit vector.
        let norm = |matrix: glam::DMat3| {
            let squares = matrix.to_cols_array().into_iter().map(|x| x * x);
            squares.sum::<f64>().sqrt()
        };
        let stretch = norm(linear);
        let reach = stretch * norm(world.matrix3) * self.radius;
        // The error adds the products and sums of the pose's kernel, the rounded matrix times its operands,
        // and then the distance to the frame origin.
        let posed = self.draws.iter().map(|draw| {
            let place = world * draw.carrier_from_mesh;
            let moved = (0..3).map(|row| place.matrix3.row(row).abs().dot(draw.half)).fold(0.0, f64::max);
            let way = place.transform_point3(draw.pivot) - frame_origin;
            HALF_UNIT * (8.0 * moved + 4.0 * way.abs().max_element())
        });
        let posed = posed.fold(0.0, f64::max);
        let error = 2.0 * (3.0_f64.sqrt() * stretch * posed + HALF_UNIT * self.radius);
        let map = GeometryRigid {
            x: linear.x_axis.as_vec3().to_array(),
            y: linear.y_axis.as_vec3().to_array(),
            z: linear.z_axis.as_vec3().to_array(),
            centre: about.to_array(),
            offset: (linear * (about.as_dvec3() - centre)).as_vec3().to_array(),
            stretch: (stretch * 1.000_001) as f32,
            reach: (reach * 1.000_001) as f32,
            error: (error * 1.000_001) as f32,
        };
        let numbers = [map.x, map.y, map.z, map.centre, map.offset, [map.stretch, map.reach, map.error]];
        let holds = numbers.iter().flatten().all(|number| number.is_finite()) && map.stretch > 0.0;
        GeometryRigid { error: if holds { map.error } else { f32::INFINITY }, ..map }
    }
}

fn mesh_positions<'a>(scene: &'a Scene, place: &DrawPlace) -> impl Iterator<Item = DVec3> + 'a {
    let mesh = &scene.meshes[scene.instances[place.instance].mesh];
    mesh.positions.iter().map(|position| DVec3::from(position.map(f64::from)))
}

/// Returns the transform between an instance and the node that carries it; no node between them moves.
fn carrier_from_mesh(rig: &Rig, carrier: usize, instance: usize) -> DAffine3 {
    let placement = rig.placements[instance];
    let (mut from_mesh, mut node) = (placement.node_from_mesh, placement.node);
    // A forest has no cycle; a chain longer than the number of nodes would be one.
    for _ in 0..rig.nodes.len() {
        if node == carrier {
            break;
        }
        from_mesh = rig.nodes[node].transform.to_affine() * from_mesh;
        let Some(parent) = rig.nodes[node].parent else { break };
        node = parent;
    }
    from_mesh
}
