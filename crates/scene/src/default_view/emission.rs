//! Light that the surfaces of a scene emit, averaged over all of them.

use glam::DVec3;

use super::emitters::{emits, shown_materials};
use crate::{Image, Instance, Material, Mesh, Scene, TextureRef, Wrap};

/// Barycentric weights of the points of a triangle at which its emission is looked up.
const PLACES: [[f64; 3]; 4] = [
    [1.0 / 3.0, 1.0 / 3.0, 1.0 / 3.0],
    [2.0 / 3.0, 1.0 / 6.0, 1.0 / 6.0],
    [1.0 / 6.0, 2.0 / 3.0, 1.0 / 6.0],
    [1.0 / 6.0, 1.0 / 6.0, 2.0 / 3.0],
];

/// Returns the mean, over the area of all placed triangles, of the luminance of the radiance that they emit,
/// W/(sr m^2). A side that does not emit adds nothing, an emitting side counts in full. 0 without area.
/// Textures are looked up at four points of each triangle; holes that alpha cuts are ignored.
pub(super) fn mean_emission(scene: &Scene) -> f64 {
    // Most scenes have no emissive surface, and some have millions of triangles.
    if !shown_materials(scene).any(emits) {
        return 0.0;
    }
    let (mut emitted, mut area) = (0.0, 0.0);
    for instance in &scene.instances {
        let Some(mesh) = scene.meshes.get(instance.mesh) else { continue };
        let material = scene.materials.get(mesh.material).filter(|material| emits(material));
        for corners in mesh.indices.chunks_exact(3) {
            let own = triangle_area(instance, mesh, corners);
            if own.is_finite() {
                area += own;
                emitted += own * material.map_or(0.0, |material| luminance(scene, material, mesh, corners));
            }
        }
    }
    if area > 0.0 { emitted / area } else { 0.0 }
}

/// Returns the area of a triangle in square metres; not finite where a corner is missing or not finite.
fn triangle_area(instance: &Instance, mesh: &Mesh, corners: &[u32]) -> f64 {
    let place = |index: u32| {
        let position = mesh.positions.get(index as usize).map_or([f64::NAN; 3], |p| p.map(f64::from));
        instance.world_from_mesh.transform_point3(DVec3::from_array(position))
    };
    let [a, b, c] = [0, 1, 2].map(|corner| place(corners[corner]));
    0.5 * (b - a).cross(c - a).length()
}

/// Returns the luminance that a triangle emits on average, once for each side that emits.
fn luminance(scene: &Scene, material: &Material, mesh: &Mesh, corners: &[u32]) -> f64 {
    let (color, texture) = if material.unlit {
        let [red, green, blue, _] = material.base_color;
        ([red, green, blue], material.base_color_texture.as_ref())
    } else {
        (material.emission, material.emission_texture.as_ref())
    };
    let sides = if material.unlit || material.double_sided { 2.0 } else { 1.0 };
    let at = |weights: &[f64; 3]| -> f64 {
        let texel = texture.and_then(|texture| texel(scene, mesh, texture, corners, weights));
        let texel = texel.unwrap_or([1.0; 3]);
        let [red, green, blue] = [0, 1, 2].map(|channel| f64::from(color[channel]) * texel[channel]);
        0.2126 * red + 0.7152 * green + 0.0722 * blue
    };
    sides * PLACES.iter().map(at).sum::<f64>() / PLACES.len() as f64
}

/// Returns the linear colour of the texel at a point of a triangle; `None` where there is no such texel.
fn texel(
    scene: &Scene,
    mesh: &Mesh,
    reference: &TextureRef,
    corners: &[u32],
    weights: &[f64; 3],
) -> Option<[f64; 3]> {
    let texture = scene.textures.get(reference.texture)?;
    let image = scene.images.get(texture.image)?;
    let uvs = mesh.uvs.get(reference.uv_set as usize)?.as_ref()?;
    let mut uv = [0.0; 2];
    for (&corner, weight) in corners.iter().zip(weights) {
        let [u, v] = uvs.get(corner as usize)?.map(f64::from);
        uv = [uv[0] + weight * u, uv[1] + weight * v];
    }
    let row = |row: [f32; 3]| {
        let [u, v, shift] = row.map(f64::from);
        u * uv[0] + v * uv[1] + shift
    };
    let column = position(row(reference.uv_transform[0]), texture.wrap_u, image.width);
    let line = position(row(reference.uv_transform[1]), texture.wrap_v, image.height);
    decoded(image, column, line)
}

/// Returns the row or column of texels in which a coordinate lies.
fn position(coordinate: f64, wrap: Wrap, size: u32) -> u32 {
    let share = match wrap {
        Wrap::Repeat => coordinate.rem_euclid(1.0),
        Wrap::Mirror => 1.0 - (coordinate.rem_euclid(2.0) - 1.0).abs(),
        Wrap::Clamp => coordinate.clamp(0.0, 1.0),
    };
    // The cast turns not-a-number into 0.
    ((share * f64::from(size)) as u32).min(size.saturating_sub(1))
}

fn decoded(image: &Image, column: u32, line: u32) -> Option<[f64; 3]> {
    let start = 4 * (line as usize * image.width as usize + column as usize);
    let texel = image.rgba8.get(start..start + 3)?;
    let linear = |byte: u8| {
        let encoded = f64::from(byte) / 255.0;
        if encoded <= 0.04045 { encoded / 12.92 } else { ((encoded + 0.055) / 1.055).powf(2.4) }
    };
    Some([linear(texel[0]), linear(texel[1]), linear(texel[2])])
}
