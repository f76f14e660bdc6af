//! Parts of scenes with known images.

use glam::{DAffine3, DMat3, DVec3};
use rasray_scene::{Camera, Instance, Material, Mesh, Projection, Scene};

/// Makes a material that reflects exactly `albedo`, evenly, from both sides, without specular reflection.
pub fn diffuse(albedo: [f32; 3]) -> Material {
    let [red, green, blue] = albedo;
    Material {
        base_color: [red, green, blue, 1.0],
        metallic: 0.0,
        specular: 0.0,
        double_sided: true,
        ..Material::default()
    }
}

/// Makes [`diffuse`] with emission, W/(sr m^2).
pub fn glowing(albedo: [f32; 3], emission: [f32; 3]) -> Material {
    Material { emission, ..diffuse(albedo) }
}

/// Makes a material that shows `radiance` from both sides and scatters nothing; light samples do not include
/// it.
pub fn unlit(radiance: f32) -> Material {
    Material { unlit: true, ..diffuse([radiance; 3]) }
}

/// Makes clear and perfectly smooth glass with an inside.
pub fn glass(ior: f32) -> Material {
    Material { specular: 1.0, transmission: 1.0, roughness: 0.0, thickness: 1.0, ior, ..diffuse([1.0; 3]) }
}

/// Makes a parallelogram with corners at `centre` plus and minus `u` and `v`; counter-clockwise seen from the
/// side that u x v points to.
pub fn square(centre: DVec3, u: DVec3, v: DVec3, material: usize) -> Mesh {
    let corners = [centre - u - v, centre + u - v, centre + u + v, centre - u + v];
    Mesh {
        name: "square".to_owned(),
        positions: corners.map(|corner| corner.as_vec3().to_array()).to_vec(),
        indices: vec![0, 1, 2, 0, 2, 3],
        material,
        ..Mesh::default()
    }
}

/// Makes the six faces of the box with half sizes `half` around `centre`, fronts outwards.
pub fn box_faces(centre: DVec3, half: DVec3, material: usize) -> Vec<Mesh> {
    let faces = (0..3).flat_map(|axis| [-1.0, 1.0].map(|sign| (axis, sign)));
    faces
        .map(|(axis, sign)| {
            let mut normal = DVec3::ZERO;
            normal[axis] = sign;
            let mut u = DVec3::ZERO;
            u[(axis + 1) % 3] = half[(axis + 1) % 3];
            let mut v = DVec3::ZERO;
            v[(axis + 2) % 3] = sign * half[(axis + 2) % 3];
            square(centre + normal * half, u, v, material)
        })
        .collect()
}

/// Makes [`box_faces`] with fronts inwards.
pub fn box_around(centre: DVec3, half: DVec3, material: usize) -> Vec<Mesh> {
    let mut faces = box_faces(centre, half, material);
    for face in &mut faces {
        face.indices.chunks_exact_mut(3).for_each(|triangle| triangle.swap(1, 2));
    }
    faces
}

/// Makes a sphere of 8 * 4^level facets inscribed in `radius`: an octahedron divided `level` times, fronts
/// outwards, flat.
pub fn octahedron_sphere(centre: DVec3, radius: f64, level: u32, material: usize) -> Mesh {
    let mut triangles = Vec::new();
    for octant in 0..8_u32 {
        let sign = |bit: u32| if octant >> bit & 1 == 0 { 1.0 } else { -1.0 };
        let corners = [DVec3::X * sign(0), DVec3::Y * sign(1), DVec3::Z * sign(2)];
        let even = octant.count_ones().is_multiple_of(2);
        triangles.push(if even { corners } else { [corners[0], corners[2], corners[1]] });
    }
    for _ in 0..level {
        let divide = |[a, b, c]: [DVec3; 3]| {
            let (ab, bc, ca) = ((a + b).normalize(), (b + c).normalize(), (c + a).normalize());
            [[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]]
        };
        triangles = triangles.into_iter().flat_map(divide).collect();
    }
    let positions: Vec<[f32; 3]> =
        triangles.iter().flatten().map(|p| (centre + *p * radius).as_vec3().to_array()).collect();
    Mesh {
        name: "sphere".to_owned(),
        indices: (0..positions.len() as u32).collect(),
        positions,
        material,
        ..Mesh::default()
    }
}

/// Returns the corners of the triangles of a mesh, as they are uploaded.
pub fn triangles(mesh: &Mesh) -> Vec<[DVec3; 3]> {
    let corner = |index: u32| DVec3::from(mesh.positions[index as usize].map(f64::from));
    mesh.indices.chunks_exact(3).map(|t| [corner(t[0]), corner(t[1]), corner(t[2])]).collect()
}

/// Makes a scene of meshes in place, one instance each, without light.
pub fn scene_of(meshes: Vec<Mesh>, materials: Vec<Material>) -> Scene {
    let instances = (0..meshes.len())
        .map(|mesh| Instance { name: format!("{mesh}"), mesh, world_from_mesh: DAffine3::IDENTITY })
        .collect();
    Scene { name: "image truth".to_owned(), meshes, instances, materials, ..Scene::default() }
}

/// Makes a pinhole camera with a full vertical angle of `fov_y` radians.
pub fn looking(eye: DVec3, target: DVec3, fov_y: f32) -> Camera {
    let back = (eye - target).normalize();
    let right = back.any_orthonormal_vector();
    let axes = DMat3::from_cols(right, back.cross(right), back);
    Camera {
        name: "truth".to_owned(),
        world_from_camera: DAffine3::from_mat3_translation(axes, eye),
        projection: Projection::Perspective { fov_y },
        aspect_ratio: None,
        lens: None,
    }
}

/// Makes a parallel view along `eye` to `target` of a square of twice `half_height` metres.
pub fn parallel(eye: DVec3, target: DVec3, half_height: f32) -> Camera {
    Camera { projection: Projection::Orthographic { half_height }, ..looking(eye, target, 1.0) }
}
