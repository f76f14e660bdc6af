//! What a scene gets that brings none of its own: a camera, light and a material; and its bounds.

use glam::{DAffine3, DMat3, DVec3};

use crate::{Camera, Environment, Material, Projection, Scene, Warning};

/// Full vertical angle of the default camera, radians.
const FOV_Y: f64 = 0.8;

/// A perspective camera at `eye` (metres) that looks at `target`, upright; `fov_y` is the full
/// vertical angle in radians. Looking straight up or down, -z is up in the picture. If eye and target
/// coincide, it looks along -z.
pub fn camera_looking_at(name: &str, eye: DVec3, target: DVec3, fov_y: f32) -> Camera {
    let back = (eye - target).normalize_or(DVec3::Z);
    let right = DVec3::Y.cross(back).try_normalize().unwrap_or(DVec3::X);
    let up = back.cross(right);
    Camera {
        name: name.to_owned(),
        world_from_camera: DAffine3::from_mat3_translation(DMat3::from_cols(right, up, back), eye),
        projection: Projection::Perspective { fov_y },
    }
}

/// Least and greatest corner, in metres, of the triangles as placed by the instances. Vertices that
/// no triangle uses do not count, nor do coordinates that are not finite. `None` without triangles.
pub fn bounds(scene: &Scene) -> Option<(DVec3, DVec3)> {
    let mut used: Vec<Option<Vec<DVec3>>> = vec![None; scene.meshes.len()];
    let mut total: Option<(DVec3, DVec3)> = None;
    for instance in &scene.instances {
        let Some(mesh) = scene.meshes.get(instance.mesh) else { continue };
        let vertices = used[instance.mesh].get_or_insert_with(|| used_positions(mesh));
        for &position in vertices.iter() {
            let point = instance.world_from_mesh.transform_point3(position);
            if point.is_finite() {
                let (low, high) = total.unwrap_or((point, point));
                total = Some((low.min(point), high.max(point)));
            }
        }
    }
    total
}

fn used_positions(mesh: &crate::Mesh) -> Vec<DVec3> {
    let mut marked = vec![false; mesh.positions.len()];
    for &index in &mesh.indices {
        if let Some(mark) = marked.get_mut(index as usize) {
            *mark = true;
        }
    }
    let kept = mesh.positions.iter().zip(marked).filter(|(_, used)| *used);
    kept.map(|(position, _)| DVec3::from_array(position.map(f64::from))).collect()
}

/// A camera that sees the whole scene from the front, somewhat to the right and above, in a picture
/// that is at least as wide as high. Around the origin if the scene has no triangles.
pub fn default_camera(scene: &Scene) -> Camera {
    let (low, high) = bounds(scene).unwrap_or((DVec3::NEG_ONE, DVec3::ONE));
    let centre = low * 0.5 + high * 0.5;
    // A point or a speck still gets a picture with a scale.
    let radius = ((high - low).length() * 0.5).max(centre.abs().max_element() * 1.0e-6).max(1.0e-6);
    let distance = radius / (FOV_Y * 0.5).sin() * 1.05;
    let direction = DVec3::new(0.45, 0.35, 1.0).normalize();
    camera_looking_at("default", centre + direction * distance, centre, FOV_Y as f32)
}

/// Whether anything in the scene sends out light: a light, an environment that is not black, or a
/// material that emits (unlit ones do) and is used by a placed mesh with triangles.
pub fn is_lit(scene: &Scene) -> bool {
    let environment = match &scene.environment {
        Environment::Constant(radiance) => radiance.iter().any(|channel| *channel > 0.0),
        Environment::LatLong { radiance, .. } => radiance.iter().flatten().any(|channel| *channel > 0.0),
    };
    environment
        || !scene.lights.is_empty()
        || scene.instances.iter().any(|instance| {
            let Some(mesh) = scene.meshes.get(instance.mesh) else { return false };
            let Some(material) = scene.materials.get(mesh.material) else { return false };
            !mesh.indices.is_empty() && emits(material)
        })
}

/// Whether surfaces of this material send out light by themselves.
pub fn emits(material: &Material) -> bool {
    let shown = |color: &[f32]| color.iter().any(|channel| *channel > 0.0);
    shown(&material.emission) || (material.unlit && shown(&material.base_color[..3]))
}

/// The light of a scene that brings none: white from everywhere, radiance 1 W/(sr m^2).
pub fn default_light() -> Environment {
    Environment::Constant([1.0; 3])
}

/// Gives a scene in which nothing emits the [`default_light`], with a warning `default-light`.
/// Returns whether it did.
pub fn ensure_lit(scene: &mut Scene) -> bool {
    if is_lit(scene) {
        return false;
    }
    scene.environment = default_light();
    scene.warnings.push(Warning {
        kind: "default-light",
        message: "nothing in the scene emits light; a white environment of radiance 1 was added".to_owned(),
    });
    true
}

/// The material of triangles whose file names none: light grey, rough, no metal.
pub(crate) fn plain_material(name: &str) -> Material {
    Material { name: name.to_owned(), base_color: [0.8, 0.8, 0.8, 1.0], metallic: 0.0, ..Material::default() }
}
