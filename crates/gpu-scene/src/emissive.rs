//! Emissive triangles, chosen as lights by their power.

use glam::DVec3;
use rasray_scene::{AlphaMode, Scene};

use crate::{
    Posed,
    distribution::{cumulative_shares, luminance},
    layout::{DrawShading, EmissiveTriangle},
    mips::linear_from_srgb,
};

/// Lists all triangles of draws that emit, in order of primitive id, and notes in every such draw
/// where its triangles start. Empty where nothing emits.
///
/// A triangle's power is its area times the luminance of its material's emission bound, twice that
/// if both sides emit. Indices of `scene` must have been checked.
pub fn pack_emissive(
    scene: &Scene,
    posed: &Posed,
    draw_shadings: &mut [DrawShading],
) -> Vec<EmissiveTriangle> {
    let bounds: Vec<f64> = scene.materials.iter().map(|material| power_bound(scene, material)).collect();
    let mut primitives = Vec::new();
    let mut powers = Vec::new();
    let mut first_of_draw = Vec::new();
    for (draw, shading) in posed.draws.iter().zip(draw_shadings.iter()) {
        let bound = bounds[shading.material as usize];
        if bound == 0.0 {
            first_of_draw.push(None);
            continue;
        }
        first_of_draw.push(Some(primitives.len() as u32));
        for primitive in draw.first_triangle..draw.first_triangle + draw.triangle_count {
            primitives.push(primitive);
            powers.push(area(posed, primitive) * bound);
        }
    }
    let (total, shares) = cumulative_shares(&powers);
    if total == 0.0 {
        return Vec::new();
    }
    for (shading, first) in draw_shadings.iter_mut().zip(first_of_draw) {
        if let Some(first) = first {
            shading.first_emissive = first;
        }
    }
    primitives
        .into_iter()
        .zip(shares)
        .map(|(primitive, cumulative)| EmissiveTriangle { primitive, cumulative })
        .collect()
}

/// Luminance of the brightest emission that the material can show, times the number of sides that
/// emit. 0 for unlit materials, which are not lights, and for blended ones, which scattered rays meet
/// as often as their opacity says.
fn power_bound(scene: &Scene, material: &rasray_scene::Material) -> f64 {
    if material.unlit || material.alpha_mode == AlphaMode::Blend {
        return 0.0;
    }
    let mut bound = material.emission;
    let texture = material.emission_texture.as_ref().filter(|_| bound.iter().any(|&x| x > 0.0));
    let image = texture
        .and_then(|reference| scene.textures.get(reference.texture))
        .and_then(|texture| scene.images.get(texture.image));
    if let Some(image) = image {
        let mut largest = [0u8; 3];
        for texel in image.rgba8.chunks_exact(4) {
            for channel in 0..3 {
                largest[channel] = largest[channel].max(texel[channel]);
            }
        }
        for channel in 0..3 {
            bound[channel] *= linear_from_srgb(f32::from(largest[channel]) / 255.0);
        }
    }
    luminance(bound) * if material.double_sided { 2.0 } else { 1.0 }
}

fn area(posed: &Posed, primitive: u32) -> f64 {
    let corner = |index: usize| {
        let vertex = posed.indices[3 * primitive as usize + index];
        DVec3::from(posed.positions[vertex as usize].map(f64::from))
    };
    let (a, b, c) = (corner(0), corner(1), corner(2));
    0.5 * (b - a).cross(c - a).length()
}
