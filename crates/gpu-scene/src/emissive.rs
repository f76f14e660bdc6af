//! Emissive triangles, which are chosen as lights by their power.

use std::f64::consts::PI;

use glam::DVec3;
use rasray_scene::{AlphaMode, Image, Material, Mesh, Scene, Texture, TextureRef, Wrap};

use crate::{
    Posed,
    distribution::{cumulative_shares, luminance},
    layout::{DrawShading, EmissiveTriangle},
    mips::linear_from_srgb,
};

/// Largest number of parts per side into which a triangle is cut to sample its texels.
const MOST_PARTS: f64 = 128.0;

/// Triangles of draws that emit, in order of primitive id.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct EmissiveSources {
    /// Global ids of the triangles.
    pub primitives: Vec<u32>,
    /// Power per area of each triangle, W/m^2, by luminance; it stays when triangles move.
    pub radiosities: Vec<f64>,
}

impl EmissiveSources {
    /// Lists all triangles of draws that emit, and notes in every such draw the index of its first one. The
    /// list is empty if no surface emits, whatever its area.
    ///
    /// Indices of `scene` must have been checked.
    pub fn new(scene: &Scene, posed: &Posed, draw_shadings: &mut [DrawShading]) -> Self {
        let mut sources = Self::default();
        let mut first_of_draw = Vec::new();
        for (draw, shading) in posed.draws.iter().zip(draw_shadings.iter()) {
            let material = &scene.materials[shading.material as usize];
            let sides = if material.double_sided { 2.0 } else { 1.0 };
            let radiosity = PI * luminance(material.emission) * sides * opacity(material);
            // Unlit materials are not lights.
            if material.unlit || radiosity == 0.0 {
                first_of_draw.push(None);
                continue;
            }
            let mesh = &scene.meshes[scene.instances[shading.instance as usize].mesh];
            let glow = material
                .emission_texture
                .as_ref()
                .and_then(|used| Glow::new(scene, used, mesh, material.emission));
            first_of_draw.push(Some(sources.primitives.len() as u32));
            for (primitive, corners) in (draw.first_triangle..).zip(mesh.indices.chunks_exact(3)) {
                let corners = [0, 1, 2].map(|corner| corners[corner] as usize);
                let share = glow.as_ref().map_or(1.0, |glow| glow.share(corners));
                sources.primitives.push(primitive);
                sources.radiosities.push(radiosity * share);
            }
        }
        if sources.radiosities.iter().all(|&radiosity| radiosity == 0.0) {
            return Self::default();
        }
        for (shading, first) in draw_shadings.iter_mut().zip(first_of_draw) {
            if let Some(first) = first {
                shading.first_emissive = first;
            }
        }
        sources
    }

    /// Returns the table of triangles with these areas, m^2, and their total power, W, by luminance.
    pub fn pack(&self, areas: &[f64]) -> (f64, Vec<EmissiveTriangle>) {
        let powers: Vec<f64> = areas.iter().zip(&self.radiosities).map(|(area, of)| area * of).collect();
        let (total, shares) = cumulative_shares(&powers);
        let entries = self.primitives.iter().zip(shares);
        let entries = entries.map(|(&primitive, cumulative)| EmissiveTriangle { primitive, cumulative });
        (total, entries.collect())
    }

    /// Returns the areas of the triangles with the positions of `posed`, m^2.
    pub fn areas(&self, posed: &Posed) -> Vec<f64> {
        let corner = |index: u32| posed.positions[index as usize];
        let of = |primitive: u32| {
            let first = 3 * primitive as usize;
            area([0, 1, 2].map(|place| corner(posed.indices[first + place])))
        };
        self.primitives.iter().map(|&primitive| of(primitive)).collect()
    }
}

/// Returns the share of the emission that leaves a surface, as far as its material alone decides it: a
/// blended surface emits in proportion to its opacity.
fn opacity(material: &Material) -> f64 {
    match material.alpha_mode {
        AlphaMode::Blend => f64::from(material.base_color[3].clamp(0.0, 1.0)),
        AlphaMode::Opaque | AlphaMode::Mask { .. } => 1.0,
    }
}

/// Returns the area of a triangle, m^2.
pub fn area(corners: [[f32; 3]; 3]) -> f64 {
    let [a, b, c] = corners.map(|corner| DVec3::from(corner.map(f64::from)));
    0.5 * (b - a).cross(c - a).length()
}

/// Emission texture on a mesh.
struct Glow<'a> {
    image: &'a Image,
    texture: &'a Texture,
    uvs: Option<&'a [[f32; 2]]>,
    rows: [[f32; 3]; 2],
    /// Ratio of the luminance of the factor times a texel to that of the factor, for every byte of a channel.
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

    /// Returns the mean over the triangle of the texture's factor: of the texels at the centroids of n by n
    /// parts, n such that a part has about the area of a texel.
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

/// Returns the index of the texel that holds a coordinate.
fn texel(coordinate: f64, size: u32, wrap: Wrap) -> usize {
    let within = match wrap {
        Wrap::Repeat => coordinate - coordinate.floor(),
        Wrap::Mirror => {
            let turned = coordinate - 2.0 * (0.5 * coordinate).floor();
            if turned < 1.0 { turned } else { 2.0 - turned }
        }
        Wrap::Clamp => coordinate,
    };
    // Values that are not finite become 0, as in the shaders.
    ((within * f64::from(size)) as usize).min(size as usize - 1)
}
