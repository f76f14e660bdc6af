//! Scene with every instance in place, from which surfaces and lights are computed.

use glam::{DMat3, DVec3, Vec3, Vec4};
use rasray_scene::{AlphaMode, BackFaces, Environment, Material, Mesh, Scene, TextureRef};

use crate::oracle::Side;

use super::{
    ReferenceError,
    environment::EnvironmentTable,
    light_table::LightTable,
    texture::{TextureTable, Use},
};

/// Run of triangles of one instance.
#[derive(Clone, Debug)]
pub(super) struct Draw {
    pub first_triangle: u32,
    pub first_vertex: u32,
    pub mesh: usize,
    pub material: usize,
    /// True if the instance turns counter-clockwise triangles into clockwise ones.
    pub mirrored: bool,
    /// Unit normals, world; one for each vertex.
    pub normals: Option<Vec<Vec3>>,
    /// Unit tangents, world, w the sign of the bitangent; one for each vertex.
    pub tangents: Option<Vec<Vec4>>,
}

/// Scene with every instance in place.
pub struct PosedScene<'a> {
    pub(super) scene: &'a Scene,
    pub(super) draws: Vec<Draw>,
    pub(super) textures: TextureTable<'a>,
    pub(super) lights: LightTable,
    pub(super) environment: EnvironmentTable,
    back_faces: BackFaces,
    draw_of_triangle: Vec<u32>,
    frame_origin: DVec3,
    positions: Vec<[f32; 3]>,
    indices: Vec<u32>,
}

impl std::fmt::Debug for PosedScene<'_> {
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        formatter
            .debug_struct("PosedScene")
            .field("name", &self.scene.name)
            .field("triangles", &self.draw_of_triangle.len())
            .finish_non_exhaustive()
    }
}

impl<'a> PosedScene<'a> {
    /// Assembles all parts but the lights.
    pub(super) fn assemble(
        scene: &'a Scene,
        frame_origin: DVec3,
        positions: Vec<[f32; 3]>,
    ) -> Result<Self, ReferenceError> {
        let mut draws = Vec::new();
        let mut draw_of_triangle = Vec::new();
        let mut indices = Vec::new();
        let mut first_vertex = 0_u32;
        for instance in &scene.instances {
            let mesh = &scene.meshes[instance.mesh];
            let draw = draws.len() as u32;
            draws.push(Draw {
                first_triangle: draw_of_triangle.len() as u32,
                first_vertex,
                mesh: instance.mesh,
                material: mesh.material,
                mirrored: instance.world_from_mesh.matrix3.determinant() < 0.0,
                normals: posed_normals(mesh, instance.world_from_mesh.matrix3),
                tangents: posed_tangents(mesh, instance.world_from_mesh.matrix3),
            });
            draw_of_triangle.resize(draw_of_triangle.len() + mesh.triangle_count(), draw);
            indices
                .extend(mesh.indices[..3 * mesh.triangle_count()].iter().map(|index| first_vertex + index));
            first_vertex += mesh.positions.len() as u32;
        }
        let mut textures = TextureTable::new(scene);
        for material in &scene.materials {
            for (reference, usage) in texture_uses(material) {
                textures.prepare(reference, usage);
            }
        }
        Ok(Self {
            scene,
            draws,
            textures,
            lights: LightTable::default(),
            environment: EnvironmentTable::new(&scene.environment),
            back_faces: BackFaces::default(),
            draw_of_triangle,
            frame_origin,
            positions,
            indices,
        })
    }

    /// Sets the rays that pass the backs of single-sided surfaces.
    #[must_use]
    pub fn with_back_faces(self, back_faces: BackFaces) -> Self {
        Self { back_faces, ..self }
    }

    /// Returns the choice of rays that pass the backs of single-sided surfaces.
    pub fn back_faces(&self) -> BackFaces {
        self.back_faces
    }

    /// Returns the back of a triangle, if its surface is single-sided.
    pub fn back_of(&self, primitive: u32) -> Option<Side> {
        let draw = self.draw_of(primitive);
        let back = if draw.mirrored { Side::CounterClockwise } else { Side::Clockwise };
        self.material(draw).culls_back.then_some(back)
    }

    /// Returns the posed positions, metres relative to the frame origin, instance after instance.
    pub fn positions(&self) -> &[[f32; 3]] {
        &self.positions
    }

    /// Returns three indices per triangle, into [`PosedScene::positions`].
    pub fn indices(&self) -> &[u32] {
        &self.indices
    }

    /// Returns the frame origin, world, metres.
    pub fn frame_origin(&self) -> DVec3 {
        self.frame_origin
    }

    /// Returns the number of triangles; global triangle ids are below it.
    pub fn triangle_count(&self) -> u32 {
        self.draw_of_triangle.len() as u32
    }

    /// Returns the material of a triangle.
    pub(crate) fn material_of(&self, primitive: u32) -> &'a Material {
        self.material(self.draw_of(primitive))
    }

    pub(super) fn draw_of_index(&self, primitive: u32) -> usize {
        self.draw_of_triangle[primitive as usize] as usize
    }

    pub(super) fn draw_of(&self, primitive: u32) -> &Draw {
        &self.draws[self.draw_of_index(primitive)]
    }

    pub(super) fn material(&self, draw: &Draw) -> &'a Material {
        &self.scene.materials[draw.material]
    }

    pub(super) fn mesh(&self, draw: &Draw) -> &'a Mesh {
        &self.scene.meshes[draw.mesh]
    }

    /// Returns the corners of a triangle, metres relative to the frame origin.
    pub(super) fn vertices(&self, primitive: u32) -> [Vec3; 3] {
        let first = 3 * primitive as usize;
        std::array::from_fn(|corner| Vec3::from(self.positions[self.indices[first + corner] as usize]))
    }

    /// Returns the vertices of a triangle, as indices into its mesh.
    pub(super) fn mesh_vertices(&self, draw: &Draw, primitive: u32) -> [usize; 3] {
        let first = 3 * primitive as usize;
        std::array::from_fn(|corner| (self.indices[first + corner] - draw.first_vertex) as usize)
    }

    /// Returns the share of light left after `distance` metres inside a material.
    pub(crate) fn transmittance(&self, material: usize, distance: f32) -> Vec3 {
        let material = &self.scene.materials[material];
        let unit = material.attenuation_distance;
        if !(unit > 0.0 && unit < 3.0e38) {
            return Vec3::ONE;
        }
        let color = Vec3::from(material.attenuation_color).clamp(Vec3::splat(1.0e-6), Vec3::ONE);
        color.powf(distance / unit)
    }

    /// True if any draw needs the alpha test.
    pub fn has_alpha_masks(&self) -> bool {
        self.draws.iter().any(|draw| matches!(self.material(draw).alpha_mode, AlphaMode::Mask { .. }))
    }
}

/// Iterates over the textures of a material with the encoding of their colours.
pub(super) fn texture_uses(material: &Material) -> impl Iterator<Item = (TextureRef, Use)> {
    [
        (material.base_color_texture, Use::Color),
        (material.metallic_roughness_texture, Use::Linear),
        (material.anisotropy_texture, Use::Linear),
        (material.normal_texture, Use::Linear),
        (material.emission_texture, Use::Color),
        (material.transmission_texture, Use::Linear),
    ]
    .into_iter()
    .filter_map(|(reference, usage)| Some((reference?, usage)))
}

fn posed_normals(mesh: &Mesh, matrix: DMat3) -> Option<Vec<Vec3>> {
    // The cofactor matrix is the inverse transpose up to the determinant, and also exists for singular
    // matrices.
    let cofactor = DMat3::from_cols(
        matrix.y_axis.cross(matrix.z_axis),
        matrix.z_axis.cross(matrix.x_axis),
        matrix.x_axis.cross(matrix.y_axis),
    );
    let sign = if matrix.determinant() < 0.0 { -1.0 } else { 1.0 };
    let pose = |normal: &[f32; 3]| {
        (cofactor * DVec3::from(normal.map(f64::from)) * sign).normalize_or_zero().as_vec3()
    };
    mesh.normals.as_ref().map(|normals| normals.iter().map(pose).collect())
}

fn posed_tangents(mesh: &Mesh, matrix: DMat3) -> Option<Vec<Vec4>> {
    let sign = if matrix.determinant() < 0.0 { -1.0 } else { 1.0 };
    let pose = |tangent: &[f32; 4]| {
        let [x, y, z, w] = tangent.map(f64::from);
        (matrix * DVec3::new(x, y, z)).normalize_or_zero().as_vec3().extend(if w < 0.0 {
            -sign
        } else {
            sign
        })
    };
    mesh.tangents.as_ref().map(|tangents| tangents.iter().map(pose).collect())
}

/// Checks every index that shading later uses without a check.
pub(super) fn check(scene: &Scene) -> Result<(), ReferenceError> {
    let missing = |what: String, count: usize| Err(ReferenceError::Malformed { what, count });
    for instance in &scene.instances {
        if instance.mesh >= scene.meshes.len() {
            return missing(
                format!("instance {} names mesh {}", instance.name, instance.mesh),
                scene.meshes.len(),
            );
        }
    }
    for mesh in &scene.meshes {
        let count = mesh.positions.len();
        if mesh.material >= scene.materials.len() {
            return missing(
                format!("mesh {} names material {}", mesh.name, mesh.material),
                scene.materials.len(),
            );
        }
        if let Some(index) = mesh.indices.iter().find(|index| **index as usize >= count) {
            return missing(format!("mesh {} names vertex {index}", mesh.name), count);
        }
        let lengths = [
            mesh.normals.as_ref().map(Vec::len),
            mesh.tangents.as_ref().map(Vec::len),
            mesh.uvs[0].as_ref().map(Vec::len),
            mesh.uvs[1].as_ref().map(Vec::len),
            mesh.colors.as_ref().map(Vec::len),
        ];
        if let Some(length) = lengths.into_iter().flatten().find(|length| *length != count) {
            return missing(
                format!("mesh {} has an attribute of {length} for {count} vertices", mesh.name),
                count,
            );
        }
    }
    for material in &scene.materials {
        for (reference, _) in texture_uses(material) {
            let Some(texture) = scene.textures.get(reference.texture) else {
                let what = format!("material {} names texture {}", material.name, reference.texture);
                return missing(what, scene.textures.len());
            };
            let Some(image) = scene.images.get(texture.image) else {
                return missing(
                    format!("texture {} names image {}", reference.texture, texture.image),
                    scene.images.len(),
                );
            };
            let texels = image.width as usize * image.height as usize;
            if texels == 0 || image.rgba8.len() != 4 * texels {
                let what =
                    format!("image {} has {} bytes for {texels} texels", image.name, image.rgba8.len());
                return missing(what, texels);
            }
        }
    }
    if let Environment::LatLong { width, height, radiance } = &scene.environment {
        let texels = *width as usize * *height as usize;
        if texels == 0 || radiance.len() != texels {
            return missing(format!("the environment has {} texels for {texels}", radiance.len()), texels);
        }
    }
    Ok(())
}
