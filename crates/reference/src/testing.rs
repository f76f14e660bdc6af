//! Small scenes and statistics for the tests of this crate.

use glam::{DAffine3, DMat3, DVec3, Vec3};
use rasray_scene::{Camera, Instance, Material, Mesh, Projection, Sampler, Scene};

use crate::{integrators::Image, shading::View};

/// Makes a diffuse material without any specular reflection.
pub fn diffuse(albedo: f32) -> Material {
    Material {
        base_color: [albedo, albedo, albedo, 1.0],
        metallic: 0.0,
        specular: 0.0,
        ..Material::default()
    }
}

/// Makes a parallelogram, counter-clockwise seen from the side that `u x v` points to; texture coordinates
/// run along u and against v.
pub fn quad(corner: Vec3, u: Vec3, v: Vec3, material: usize) -> Mesh {
    Mesh {
        name: "quad".to_owned(),
        positions: [corner, corner + u, corner + u + v, corner + v].map(|p| p.to_array()).to_vec(),
        uvs: [Some(vec![[0.0, 1.0], [1.0, 1.0], [1.0, 0.0], [0.0, 0.0]]), None],
        indices: vec![0, 1, 2, 0, 2, 3],
        material,
        ..Mesh::default()
    }
}

/// Makes the six faces of the box from -half to half; their fronts face outwards, or inwards.
pub fn cube(half: f32, inwards: bool, material: usize) -> Mesh {
    let mut mesh = Mesh { name: "cube".to_owned(), material, ..Mesh::default() };
    for axis in 0..3 {
        for sign in [1.0, -1.0] {
            let mut normal = Vec3::ZERO;
            normal[axis] = sign;
            let mut u = Vec3::ZERO;
            u[(axis + 1) % 3] = 2.0 * half;
            let outward = normal.cross(u);
            let (u, v) = if inwards { (outward, u) } else { (u, outward) };
            let face = quad(normal * half - (u + v) * 0.5, u, v, material);
            let first = mesh.positions.len() as u32;
            mesh.positions.extend(face.positions);
            mesh.indices.extend(face.indices.iter().map(|index| first + index));
        }
    }
    mesh
}

/// Makes a unit sphere of 4 * 4^level * 2 triangles: an octahedron divided `level` times.
pub fn sphere(level: u32, inwards: bool, smooth: bool, material: usize) -> Mesh {
    let [x, y, z] = [Vec3::X, Vec3::Y, Vec3::Z];
    let mut triangles: Vec<[Vec3; 3]> = Vec::new();
    for (sx, sy, sz) in [(1.0, 1.0, 1.0), (-1.0, 1.0, 1.0), (1.0, -1.0, 1.0), (1.0, 1.0, -1.0)]
        .into_iter()
        .flat_map(|(a, b, c)| [(a, b, c), (-a, -b, -c)])
    {
        let corner = [x * sx, y * sy, z * sz];
        triangles.push(if sx * sy * sz > 0.0 { corner } else { [corner[0], corner[2], corner[1]] });
    }
    for _ in 0..level {
        triangles = triangles
            .into_iter()
            .flat_map(|[a, b, c]| {
                let (ab, bc, ca) = ((a + b).normalize(), (b + c).normalize(), (c + a).normalize());
                [[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]]
            })
            .collect();
    }
    if inwards {
        triangles.iter_mut().for_each(|corners| corners.swap(1, 2));
    }
    let positions: Vec<[f32; 3]> = triangles.iter().flatten().map(|p| p.to_array()).collect();
    let sign = if inwards { -1.0 } else { 1.0 };
    Mesh {
        name: "sphere".to_owned(),
        normals: smooth.then(|| positions.iter().map(|p| p.map(|x| x * sign)).collect()),
        indices: (0..positions.len() as u32).collect(),
        positions,
        material,
        ..Mesh::default()
    }
}

/// Makes a scene of meshes at their own coordinates, one instance each.
pub fn scene(materials: Vec<Material>, meshes: Vec<Mesh>) -> Scene {
    let instances = (0..meshes.len())
        .map(|mesh| Instance { name: format!("{mesh}"), mesh, world_from_mesh: DAffine3::IDENTITY })
        .collect();
    Scene { name: "test".to_owned(), meshes, instances, materials, ..Scene::default() }
}

fn placement(eye: DVec3, target: DVec3) -> DAffine3 {
    let back = (eye - target).normalize();
    let right = back.any_orthonormal_vector();
    DAffine3::from_mat3_translation(DMat3::from_cols(right, back.cross(right), back), eye)
}

/// Makes a perspective view with a full vertical angle of 0.5 radians.
pub fn view(eye: [f64; 3], target: [f64; 3], size: u32, samples: u32) -> View {
    let world_from_camera = placement(DVec3::from(eye), DVec3::from(target));
    let camera = Camera {
        name: "test".to_owned(),
        world_from_camera,
        projection: Projection::Perspective { fov_y: 0.5 },
        aspect_ratio: None,
        lens: None,
    };
    View { camera, width: size, height: size, samples, seed: 1, sampler: Sampler::default() }
}

/// Makes a parallel view that shows a square of twice `half_height` metres.
pub fn parallel_view(eye: [f64; 3], target: [f64; 3], half_height: f32, size: u32, samples: u32) -> View {
    let mut view = view(eye, target, size, samples);
    view.camera.projection = Projection::Orthographic { half_height };
    view
}

/// True if the mean of the pixels' first channel is `expected` within four standard errors plus `slack`.
pub fn agrees(image: &Image, expected: f64, slack: f64) -> bool {
    let values: Vec<f64> = image.pixels.iter().map(|pixel| f64::from(pixel[0])).collect();
    let count = values.len() as f64;
    let mean = values.iter().sum::<f64>() / count;
    let variance = values.iter().map(|value| (value - mean) * (value - mean)).sum::<f64>() / (count - 1.0);
    (mean - expected).abs() <= 4.0 * (variance / count).sqrt() + slack
}

/// Asserts the mean, and that the test would have noticed a deviation of `power` of it.
pub fn assert_mean(image: &Image, expected: f64, slack: f64, power: f64) {
    assert!(agrees(image, expected, slack), "mean {} instead of {expected}", image.mean()[0]);
    for factor in [1.0 + power, 1.0 - power] {
        let mut mutant = image.clone();
        mutant.pixels.iter_mut().flatten().for_each(|value| *value *= factor as f32);
        assert!(!agrees(&mutant, expected, slack), "a deviation of {power} would go unnoticed");
    }
}
