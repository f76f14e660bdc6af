//! Emissive triangles, chosen as lights by their power.

use std::f64::consts::PI;

use glam::DVec3;
use rasray_scene::{AlphaMode, Image, Mesh, Scene, Texture, TextureRef, Wrap};

use crate::{
    Posed,
    distribution::{cumulative_shares, luminance},
    layout::{DrawShading, EmissiveTriangle},
    mips::linear_from_srgb,
};

/// Most parts a side into which a triangle is cut to look at its texels.
const MOST_PARTS: f64 = 128.0;

/// Lists all triangles of draws that emit, in order of primitive id, and notes in every such draw
/// where its triangles start. Answers their power, W, by luminance; nothing where nothing emits.
///
/// Indices of `scene` must have been checked.
pub fn pack_emissive(
    scene: &Scene,
    posed: &Posed,
    draw_shadings: &mut [DrawShading],
) -> (f64, Vec<EmissiveTriangle>) {
    let mut primitives = Vec::new();
    let mut powers = Vec::new();
    let mut first_of_draw = Vec::new();
    for (draw, shading) in posed.draws.iter().zip(draw_shadings.iter()) {
        let material = &scene.materials[shading.material as usize];
        let radiosity = PI * luminance(material.emission) * if material.double_sided { 2.0 } else { 1.0 };
        // Unlit materials are not lights; scattered rays hit what blends, as often as its opacity says.
        if material.unlit || material.alpha_mode == AlphaMode::Blend || radiosity == 0.0 {
            first_of_draw.push(None);
            continue;
        }
        let glow = material.emission_texture.as_ref().and_then(|used| {
            let mesh = &scene.meshes[scene.instances[shading.instance as usize].mesh];
            Glow::new(scene, used, mesh, material.emission)
        });
        first_of_draw.push(Some(primitives.len() as u32));
        for primitive in draw.first_triangle..draw.first_triangle + draw.triangle_count {
            let corners = [0, 1, 2].map(|corner| posed.indices[3 * primitive as usize + corner]);
            let share = glow.as_ref().map_or(1.0, |glow| {
                glow.share(corners.map(|vertex| vertex.saturating_sub(shading.first_vertex) as usize))
            });
            primitives.push(primitive);
            powers.push(area(posed, primitive) * radiosity * share);
        }
    }
    let (total, shares) = cumulative_shares(&powers);
    if total == 0.0 {
        return (0.0, Vec::new());
    }
    for (shading, first) in draw_shadings.iter_mut().zip(first_of_draw) {
        if let Some(first) = first {
            shading.first_emissive = first;
        }
    }
    let entries = primitives.into_iter().zip(shares);
    let entries = entries.map(|(primitive, cumulative)| EmissiveTriangle { primitive, cumulative });
    (total, entries.collect())
}

/// An emission texture on a mesh.
struct Glow<'a> {
    image: &'a Image,
    texture: &'a Texture,
    uvs: Option<&'a [[f32; 2]]>,
    rows: [[f32; 3]; 2],
    /// Luminance of the factor times a texel, over that of the factor, for every byte of a channel.
    channels: [[f64; 256]; 3],
}

impl<'a> Glow<'a> {
    fn new(scene: &'a Scene, used: &TextureRef, mesh: &'a Mesh, factor: [f32; 3]) -> Option<Self> {
        let texture = scene.textures.get(used.texture)?;
        let image = scene.images.get(texture.image)?;
        let channels = std::array::from_fn(|channel| {
            let mut alone = [0.0; 3];
            alone[channel] = factor[channel];
            let weight = luminance(alone) / luminance(factor);
            std::array::from_fn(|byte| weight * f64::from(linear_from_srgb(byte as f32 / 255.0)))
        });
        let uvs = mesh.uvs[(used.uv_set as usize).min(1)].as_deref();
        Some(Self { image, texture, uvs, rows: used.uv_transform, channels })
    }

    /// Mean over the triangle of what the texture lets through: the texels at the centroids of n by n parts, n such
    /// that a part has about the area of a texel.
    fn share(&self, vertices: [usize; 3]) -> f64 {
        let corners = vertices.map(|vertex| {
            let [u, v] = self.uvs.and_then(|uvs| uvs.get(vertex)).map_or([0.0; 2], |uv| uv.map(f64::from));
            self.rows.map(|row| row.map(f64::from)).map(|[a, b, c]| a * u + b * v + c)
        });
        let [[ax, ay], [bx, by], [cx, cy]] = corners;
        let (width, height) = (self.image.width, self.image.height);
        let doubled = ((bx - ax) * (cy - ay) - (by - ay) * (cx - ax)).abs();
        let parts = (0.5 * doubled * f64::from(width) * f64::from(height)).sqrt().ceil();
        let parts = if parts.is_finite() { parts.clamp(1.0, MOST_PARTS) as u32 } else { 1 };
        let mut sum = 0.0;
        for row in 0..parts {
            for column in 0..2 * (parts - row) - 1 {
                // Parts alternate between those that stand on the first edge and those that hang from it.
                let third = if column % 2 == 0 { 1.0 } else { 2.0 } / 3.0;
                let b = (f64::from(column / 2) + third) / f64::from(parts);
                let c = (f64::from(row) + third) / f64::from(parts);
                let u = ax + (bx - ax) * b + (cx - ax) * c;
                let v = ay + (by - ay) * b + (cy - ay) * c;
                let x = texel(u, width, self.texture.wrap_u);
                let y = texel(v, height, self.texture.wrap_v);
                let first = 4 * (y * width as usize + x);
                let texel = &self.image.rgba8[first..first + 3];
                sum += (0..3).map(|channel| self.channels[channel][texel[channel] as usize]).sum::<f64>();
            }
        }
        sum / f64::from(parts * parts)
    }
}

/// The texel that holds a coordinate.
fn texel(coordinate: f64, size: u32, wrap: Wrap) -> usize {
    let within = match wrap {
        Wrap::Repeat => coordinate - coordinate.floor(),
        Wrap::Mirror => {
            let turned = coordinate - 2.0 * (0.5 * coordinate).floor();
            if turned < 1.0 { turned } else { 2.0 - turned }
        }
        Wrap::Clamp => coordinate,
    };
    // What is not finite becomes 0, as in the shaders.
    ((within * f64::from(size)) as usize).min(size as usize - 1)
}

fn area(posed: &Posed, primitive: u32) -> f64 {
    let corner = |index: usize| {
        let vertex = posed.indices[3 * primitive as usize + index];
        DVec3::from(posed.positions[vertex as usize].map(f64::from))
    };
    let (a, b, c) = (corner(0), corner(1), corner(2));
    0.5 * (b - a).cross(c - a).length()
}
