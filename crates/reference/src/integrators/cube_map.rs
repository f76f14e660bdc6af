//! Environment mapping, as `docs/cube-map.md` defines it. No map is stored: each look-up computes the four
//! texels that it blends.

use glam::{DVec3, Vec3};
use rasray_options::{OptionValues, Value};

use super::{
    NaiveIntegrator, Tracer, eye,
    whitted::{Node, Rules},
};
use crate::shading::{
    PosedScene, Ray, View,
    random::{Numbers, RANDOM_CAMERA_X, RANDOM_CAMERA_Y, RandomStream},
};

pub(super) const ROW: NaiveIntegrator = NaiveIntegrator {
    name: "cube-map",
    render: |posed, view, values| posed.render_whitted(view, rules(posed, view, values)),
};

/// Branch of the rays of a map, on which their random numbers depend.
const BRANCH: u32 = 1;

/// Cube map that is drawn from a point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct CubeMap {
    /// Number of texels along a side of a face, without the border of one texel around it.
    resolution: u32,
    /// Centre of projection, metres, relative to the frame origin.
    position: Vec3,
    /// Width of the cone of a ray per metre.
    cone_spread: f32,
    /// True if surfaces in the map are in shadow.
    has_shadows: bool,
}

fn rules(posed: &PosedScene<'_>, view: &View, values: &OptionValues) -> Rules {
    let rules = Rules::of(values);
    let origin = posed.frame_origin();
    let given = values.get("cube-position").and_then(Value::point);
    let given = given.map(|point| (DVec3::from(point.map(f64::from)) - origin).as_vec3());
    let resolution = values.get("cube-resolution").and_then(Value::whole).unwrap_or(1);
    let map = CubeMap {
        resolution,
        position: given
            .or_else(|| centre_of_smooth(posed, &rules))
            .unwrap_or_else(|| (eye(&view.camera) - origin).as_vec3()),
        cone_spread: 2.0 / resolution as f32 / (view.samples as f32).sqrt(),
        has_shadows: values.get("shadows") == Some(Value::Word("all")),
    };
    Rules { map: Some(map), ..rules }
}

/// Returns the centre of the bounds of all triangles whose material is perfectly smooth.
fn centre_of_smooth(posed: &PosedScene<'_>, rules: &Rules) -> Option<Vec3> {
    let is_smooth = |primitive: &u32| {
        let material = posed.material_of(*primitive);
        rules.are_smooth(material.roughness) && !material.unlit
    };
    let corners = (0..posed.triangle_count()).filter(is_smooth).flat_map(|primitive| {
        let first = 3 * primitive as usize;
        posed.indices()[first..first + 3].iter().map(|&index| Vec3::from(posed.positions()[index as usize]))
    });
    let bounds = corners.map(|corner| [corner, corner]);
    let whole = bounds.reduce(|[lower, upper], [corner, _]| [lower.min(corner), upper.max(corner)]);
    whole.map(|[lower, upper]| 0.5 * (lower + upper))
}

impl Tracer<'_> {
    /// Returns the light that a cube map shows in a direction, W/(sr m^2).
    pub(super) fn looked_up(&self, rules: &Rules, map: &CubeMap, random: Numbers, direction: Vec3) -> Vec3 {
        let axis = (0..3).fold(
            0,
            |best, axis| {
                if direction[axis].abs() > direction[best].abs() { axis } else { best }
            },
        );
        let face = 2 * axis as u32 + u32::from(direction[axis] < 0.0);
        let along = |step: usize| {
            let across = direction[(axis + step) % 3] / direction[axis].abs();
            let place = (across + 1.0) * 0.5 * map.resolution as f32 + 0.5;
            let first = (place as u32).min(map.resolution);
            (first, place - first as f32)
        };
        let ((column, right), (row, down)) = (along(1), along(2));
        let at = |column, row| self.texel(rules, map, random, [face, column, row]);
        let upper = at(column, row).lerp(at(column + 1, row), right);
        let lower = at(column, row + 1).lerp(at(column + 1, row + 1), right);
        upper.lerp(lower, down)
    }

    /// Computes a texel of a sample's map: the directly lit surface that a ray through a random point of the
    /// texel finds.
    fn texel(&self, rules: &Rules, map: &CubeMap, random: Numbers, [face, column, row]: [u32; 3]) -> Vec3 {
        let side = map.resolution + 2;
        let pixel = (face * side + row) * side + column;
        let random = Numbers { stream: RandomStream { pixel, ..random.stream }, ..random };
        let across = |place: u32, dimension| {
            let place = place as f32 + random.float(dimension + 256 * BRANCH);
            2.0 * (place - 1.0) / map.resolution as f32 - 1.0
        };
        let axis = face as usize / 2;
        let mut direction = Vec3::ZERO;
        direction[axis] = if face.is_multiple_of(2) { 1.0 } else { -1.0 };
        direction[(axis + 1) % 3] = across(column, RANDOM_CAMERA_X);
        direction[(axis + 2) % 3] = across(row, RANDOM_CAMERA_Y);
        let ray = Ray {
            origin: map.position,
            direction: direction.normalize(),
            t_max: f32::INFINITY,
            exclude_primitive: None,
            culls_back_faces: self.posed.back_faces().lets_camera_rays(),
            cone_width: 0.0,
            cone_spread: map.cone_spread,
        };
        let shadow_depth = map.has_shadows.then_some(0);
        let rules = Rules { map: None, passes_backs: true, shadow_depth, ..*rules };
        self.tree(&rules, random, ray, Node::root(BRANCH))
    }
}
