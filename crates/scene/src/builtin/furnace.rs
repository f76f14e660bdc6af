//! A closed room whose walls all emit and reflect alike, so that the radiance everywhere is known.

use glam::DVec3;

use super::cornell::{diffuse, place_each};
use super::shape::{Icosphere, Shapes};
use crate::default_view::camera_looking_at;
use crate::{Material, Mesh, Scene};

/// Parameters of [`furnace`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Furnace {
    /// Diffuse reflectance of the walls, in [0, 1).
    pub albedo: f32,
    /// Radiance that the walls emit, W/(sr m^2), at least 0.
    pub emission: f32,
    /// Form of the room.
    pub shape: FurnaceShape,
}

/// Form of the [`furnace`] room.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum FurnaceShape {
    /// A sphere of radius 1 m in 1,280 triangles.
    #[default]
    Sphere,
    /// A cube of 2 m in 12 triangles.
    Box,
}

impl Default for Furnace {
    fn default() -> Self {
        Self { albedo: 0.5, emission: 1.0, shape: FurnaceShape::Sphere }
    }
}

/// Makes a closed Lambertian room around the camera, with fronts inwards. With emission E and albedo a, a
/// path of at most n scatterings sees E (1 - a^(n+1)) / (1 - a) in every direction.
///
/// Normals are those of the triangles, so the law holds for the sphere's facets exactly.
/// The camera stands away from the centre, so that no symmetry of the room sends its rays through
/// vertices or edges.
pub fn furnace(parameters: Furnace) -> Scene {
    let Furnace { albedo, emission, shape } = parameters;
    let material = Material { emission: [emission; 3], ..diffuse("wall", [albedo; 3]) };
    let mut shapes = Shapes::new("wall", 0);
    match shape {
        FurnaceShape::Sphere => shapes.sphere(&Icosphere::new(3), DVec3::ZERO, 1.0, true),
        // Swapped corners turn the block inside out.
        FurnaceShape::Box => shapes.block(DVec3::ONE, DVec3::NEG_ONE, [true; 6], 0.5),
    }
    // Flat shading: an interpolated normal would send some light through the wall, and energy would be lost.
    let meshes = vec![Mesh { normals: None, ..shapes.finish() }];
    let eye = DVec3::new(0.11, 0.07, 0.23);
    let camera = camera_looking_at("camera", eye, DVec3::new(-0.4, 0.19, -0.9), 1.0);
    Scene {
        name: "furnace".to_owned(),
        instances: place_each(&meshes),
        meshes,
        materials: vec![material],
        cameras: vec![camera],
        ..Scene::default()
    }
}
