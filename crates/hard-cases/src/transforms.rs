//! Meshes placed by mirrored, anisotropic, singular and long chains of transforms. The triangles are those
//! that the scene loader and the pose make from a glTF file; their expected positions follow from a matrix
//! written out here.

use super::case::{AIMED, Answer, Content, Context, Entry, Expectation, Triangle};
use super::geometry::{aim, point_on, uv_sphere};
use super::gltf_text::GltfText;
use glam::DVec3;
use rasray_reference::oracle::Ray;
use rasray_reference::shading::PosedScene;
use rasray_scene::Scene;
use rasray_scene_files::{Limits, LoadOptions};

pub(super) const CASES: &[Entry] = &[
    Entry { id: "T1", title: "mirrored tetrahedron", parameter: 0.0, build: outside },
    Entry { id: "T2", title: "sphere scaled by 1, 1e-3 and 1e3", parameter: 0.0, build: from_inside },
    Entry { id: "T3", title: "tetrahedron scaled to no thickness", parameter: 0.0, build: flattened },
    Entry {
        id: "T4",
        title: "sheared and mirrored tetrahedron below a thousand half turns",
        parameter: 0.0,
        build: outside,
    },
];

/// Number of half turns in a row; an even number of them is no turn at all.
const HALF_TURNS: usize = 1000;

/// Mesh placed by transforms, with the matrix of their product in exact arithmetic.
#[derive(Clone, Debug)]
pub struct Transformed {
    /// Scene that the loader made from the file.
    pub scene: Scene,
    /// Rows of the matrix from the mesh to the world; the last column is the translation, metres.
    pub world_from_mesh: [[f64; 4]; 3],
}

impl Transformed {
    /// Returns a point of the mesh in the world, metres.
    pub fn position(&self, point: [f32; 3]) -> [f64; 3] {
        self.world_from_mesh.map(|row| {
            row[0] * f64::from(point[0])
                + row[1] * f64::from(point[1])
                + row[2] * f64::from(point[2])
                + row[3]
        })
    }

    /// Returns the direction of a normal of the mesh in the world, not unit: by the adjugate, which is the
    /// inverse up to a factor and exists for every matrix. The normal stays on the outer side.
    pub fn normal(&self, normal: [f32; 3]) -> [f64; 3] {
        let m = &self.world_from_mesh;
        let minor = |row: usize, column: usize| {
            let (i, j) = ((row + 1) % 3, (row + 2) % 3);
            let (k, l) = ((column + 1) % 3, (column + 2) % 3);
            m[i][k] * m[j][l] - m[i][l] * m[j][k]
        };
        let determinant: f64 = (0..3).map(|column| m[0][column] * minor(0, column)).sum();
        let side = if determinant < 0.0 { -1.0 } else { 1.0 };
        std::array::from_fn(|row| {
            side * (0..3).map(|column| minor(row, column) * f64::from(normal[column])).sum::<f64>()
        })
    }
}

/// Returns the placed mesh of a case about transforms (T1 to T4); `None` for other cases.
pub fn transformed(id: &str) -> Option<Transformed> {
    let identity = [[1.0, 0.0, 0.0, 0.0], [0.0, 1.0, 0.0, 0.0], [0.0, 0.0, 1.0, 0.0]];
    let scaled = |x: f64, y: f64, z: f64, translation: [f64; 3]| {
        let mut matrix = identity;
        for (row, (scale, shift)) in [x, y, z].into_iter().zip(translation).enumerate() {
            matrix[row][row] = scale;
            matrix[row][3] = shift;
        }
        matrix
    };
    let (mesh, nodes, matrix) = match id {
        "T1" => (
            tetrahedron(),
            r#"[{"mesh":0,"scale":[-1,1,1],"translation":[0.5,-0.25,4]}]"#.to_owned(),
            scaled(-1.0, 1.0, 1.0, [0.5, -0.25, 4.0]),
        ),
        "T2" => (
            smooth_sphere(),
            r#"[{"mesh":0,"scale":[1,0.001,1000]}]"#.to_owned(),
            scaled(1.0, 1e-3, 1e3, [0.0; 3]),
        ),
        "T3" => (
            tetrahedron(),
            r#"[{"mesh":0,"scale":[1,1,0],"translation":[-0.5,-0.5,4]}]"#.to_owned(),
            scaled(1.0, 1.0, 0.0, [-0.5, -0.5, 4.0]),
        ),
        "T4" => (tetrahedron(), half_turns(), SHEAR),
        _ => return None,
    };
    let text = GltfText { nodes, ..mesh }.text();
    let limits = Limits { depth: HALF_TURNS as u64 + 2, ..Limits::default() };
    let options = LoadOptions { limits, ..LoadOptions::default() };
    let name = format!("{id}.gltf");
    let scene = rasray_scene_files::gltf::from_slice(name.as_ref(), text.as_bytes(), &options)
        .expect("the file is written to be read");
    Some(Transformed { scene, world_from_mesh: matrix })
}

/// Matrix of a shear, mirrored at x = 0.
const SHEAR: [[f64; 4]; 3] = [[-1.0, 0.5, 0.25, 0.25], [0.0, 1.0, -0.75, -0.5], [0.125, 0.0, 1.0, 5.0]];

/// Makes the shear at the root, and below it half turns about one oblique axis.
fn half_turns() -> String {
    let m = SHEAR;
    let columns: Vec<String> = (0..4)
        .map(|column| {
            let last = if column == 3 { 1 } else { 0 };
            format!("{},{},{},{last}", m[0][column], m[1][column], m[2][column])
        })
        .collect();
    let mut nodes = vec![format!(r#"{{"matrix":[{}],"children":[1]}}"#, columns.join(","))];
    let axis = [1.0_f64, 2.0, 3.0].map(|x| x / 14.0_f64.sqrt());
    for turn in 1..=HALF_TURNS {
        let below = if turn == HALF_TURNS {
            r#""mesh":0"#.to_owned()
        } else {
            format!(r#""children":[{}]"#, turn + 1)
        };
        nodes.push(format!(r#"{{"rotation":[{},{},{},0],{below}}}"#, axis[0], axis[1], axis[2]));
    }
    format!("[{}]", nodes.join(","))
}

/// Makes a tetrahedron. All its edges and faces differ, so that a mirrored one differs from a rotated one.
fn tetrahedron() -> GltfText {
    GltfText {
        positions: vec![[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.75, 0.0], [0.25, 0.25, 0.5]],
        normals: Vec::new(),
        // The order is counter-clockwise from outside.
        indices: vec![0, 2, 1, 0, 1, 3, 1, 2, 3, 2, 0, 3],
        ..GltfText::triangle()
    }
}

/// Makes a unit sphere whose normals are its positions.
fn smooth_sphere() -> GltfText {
    let mut positions: Vec<[f32; 3]> = Vec::new();
    let mut indices = Vec::new();
    for corner in uv_sphere([0.0; 3], 1.0, 16, 24).iter().flatten() {
        let known = positions.iter().position(|position| position == corner);
        indices.push(known.unwrap_or(positions.len()) as u32);
        if known.is_none() {
            positions.push(*corner);
        }
    }
    GltfText { normals: positions.clone(), positions, indices, ..GltfText::triangle() }
}

/// Returns the triangles of a case as they are posed for the device, with the frame origin in the world's.
fn posed(context: &Context) -> Vec<Triangle> {
    let scene = transformed(context.id).expect("every case about transforms has a scene").scene;
    let posed = PosedScene::new(&scene, DVec3::ZERO).expect("a loaded scene is well formed");
    let corner = |index: &u32| posed.positions()[*index as usize];
    posed.indices().as_chunks::<3>().0.iter().map(|corners| corners.each_ref().map(corner)).collect()
}

/// Makes a ray from well outside of a mesh around z = 4 to 5 at a point of one of its triangles.
fn from_outside(random: &mut super::Stream, triangle: &Triangle) -> Ray {
    let target = point_on(triangle, random.weights(0.02));
    let direction = random.direction();
    let origin = std::array::from_fn(|axis| target[axis] + 3.0 * direction[axis]);
    aim(random.near(origin, 0.5), target)
}

fn outside(context: &Context) -> Content {
    let triangles = posed(context);
    let rays = context.rays(|random, index| from_outside(random, &triangles[index % triangles.len()]));
    // From this eye no face of either tetrahedron is seen edge-on.
    let eye = if context.id == "T1" { [0.1, 0.2, 2.0] } else { [0.9, -1.5, 3.5] };
    Content::new(triangles, rays, Expectation::All(Answer::Hit)).seen_from(eye)
}

fn flattened(context: &Context) -> Content {
    let triangles = posed(context);
    let rays = context.rays(|random, index| {
        let target = point_on(&triangles[index % triangles.len()], random.weights(0.02));
        let height = random.sign() * random.between(0.5, 2.0);
        aim(random.near([target[0], target[1], target[2] + height], 0.4), target)
    });
    Content::new(triangles, rays, Expectation::All(AIMED)).seen_from([0.1, 0.2, 2.0])
}

fn from_inside(context: &Context) -> Content {
    let triangles = posed(context);
    let rays = context.rays(|random, index| {
        let target = point_on(&triangles[random.below(triangles.len())], random.weights(0.02));
        match index % 3 {
            // Rays start within the flat and long shape, and all of them hit.
            0 => Ray::new([0.0; 3], random.direction()),
            1 => aim([random.between(-0.1, 0.1), 0.0, random.between(-100.0, 100.0)], target),
            // Rays start above, and cross the shape's thousandth of thickness.
            _ => aim([target[0], target[1] + random.sign(), target[2] + random.between(-1.0, 1.0)], target),
        }
    });
    Content::new(triangles, rays, Expectation::All(Answer::Hit))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Scale, case};
    use glam::{Vec2, Vec3};
    use rasray_reference::oracle::Oracle;
    use rasray_reference::shading;

    const IDS: [&str; 4] = ["T1", "T2", "T3", "T4"];

    /// Returns the largest distance of a posed corner from its position by the matrix, in units in the last
    /// place of the mesh's greatest coordinate, over all corners of the case.
    fn drift(transformed: &Transformed, triangles: &[Triangle]) -> f64 {
        let mesh = &transformed.scene.meshes[0];
        let mut worst = 0.0_f64;
        for (triangle, corners) in triangles.iter().zip(mesh.indices.as_chunks::<3>().0) {
            for (corner, index) in triangle.iter().zip(corners) {
                let truth = transformed.position(mesh.positions[*index as usize]);
                for axis in 0..3 {
                    let unit = f64::from(f32::EPSILON) * truth[axis].abs().max(1e-6);
                    worst = worst.max((f64::from(corner[axis]) - truth[axis]).abs() / unit);
                }
            }
        }
        worst
    }

    #[test]
    fn posed_corners_are_where_the_matrix_puts_them() {
        for id in IDS {
            let triangles = case(id, Scale { rays: 1, ..Scale::QUICK }).expect("it exists").triangles;
            let mut transformed = transformed(id).expect("it is about transforms");
            assert_eq!(triangles.len(), transformed.scene.meshes[0].triangle_count());
            let right = drift(&transformed, &triangles);
            assert!(right <= 1.0, "{id}: off by {right} units");
            // The test would notice the drift that the catalogue allows.
            transformed.world_from_mesh[0][0] += 1e-5;
            let wrong = drift(&transformed, &triangles);
            assert!(wrong > 10.0, "{id}: an error of 1e-5 is {wrong} units only");
        }
    }

    fn angle(a: [f64; 3], b: [f64; 3]) -> f64 {
        let cross: [f64; 3] =
            std::array::from_fn(|i| a[(i + 1) % 3] * b[(i + 2) % 3] - a[(i + 2) % 3] * b[(i + 1) % 3]);
        let dot: f64 = (0..3).map(|i| a[i] * b[i]).sum();
        cross.iter().map(|x| x * x).sum::<f64>().sqrt().atan2(dot)
    }

    /// Returns the largest angle between a normal that the reference shades with and the adjugate's, radians,
    /// and the number of hits whose front is not the side that the mesh calls outside.
    fn normals(id: &str, world_from_mesh: impl Fn(&Transformed) -> [[f64; 4]; 3]) -> (f64, usize) {
        let case = case(id, Scale { rays: 600, ..Scale::QUICK }).expect("it exists");
        let mut transformed = transformed(id).expect("it is about transforms");
        transformed.world_from_mesh = world_from_mesh(&transformed);
        let posed = PosedScene::new(&transformed.scene, DVec3::ZERO).expect("well formed");
        let (positions, indices) = case.buffers();
        let oracle = Oracle::new(&positions, &indices, None).expect("well formed");
        let mesh = &transformed.scene.meshes[0];
        let (mut worst, mut turned) = (0.0_f64, 0);
        for ray in &case.rays {
            let verdict = oracle.closest(ray);
            let Some((primitive, t)) = verdict.outcome.hit().filter(|_| !verdict.ambiguous) else { continue };
            let direction = Vec3::from(ray.direction);
            let unit = shading::Ray {
                origin: Vec3::from(ray.origin),
                direction: direction.normalize(),
                t_max: f32::INFINITY,
                exclude_primitive: None,
                culls_back_faces: false,
                cone_width: 0.0,
                cone_spread: 0.0,
            };
            let surface =
                posed.surface(&unit, t as f32 * direction.length(), primitive, Vec2::splat(1.0 / 3.0));
            let corners = mesh.indices.as_chunks::<3>().0[primitive as usize];
            let [a, b, c] = corners.map(|index| Vec3::from(mesh.positions[index as usize]));
            // The mesh's outside is transformed to the world.
            let outside = transformed.normal((b - a).cross(c - a).to_array());
            let towards: f64 = (0..3).map(|i| outside[i] * f64::from(ray.direction[i])).sum();
            let facing = if towards > 0.0 { -1.0 } else { 1.0 };
            turned += usize::from(surface.front != (towards < 0.0));
            let found = surface.geometric_normal.to_array().map(f64::from);
            worst = worst.max(angle(found, outside.map(|x| x * facing)));
            assert!(surface.geometric_normal.dot(unit.direction) < 0.0, "{id}: the normal faces the ray");
            assert!(surface.normal.is_finite());
        }
        (worst, turned)
    }

    #[test]
    fn normals_face_the_ray_and_are_right() {
        for id in ["T1", "T4"] {
            let (worst, turned) = normals(id, |transformed| transformed.world_from_mesh);
            assert!(worst < 1e-5 && turned == 0, "{id}: {worst} rad, {turned} turned");
            // Were the mesh not mirrored, every hit would be on the other side.
            let (_, turned) =
                normals(id, |transformed| transformed.world_from_mesh.map(|[x, y, z, w]| [-x, y, z, w]));
            assert!(turned > 100, "{id}: {turned} turned");
        }
    }

    /// Interpolated normals transform with the inverse transpose: with the matrix itself they would be far
    /// off.
    #[test]
    fn smooth_normals_go_with_the_inverse_transpose() {
        let transformed = transformed("T2").expect("it is about transforms");
        let posed = PosedScene::new(&transformed.scene, DVec3::ZERO).expect("well formed");
        let mesh = &transformed.scene.meshes[0];
        let (mut worst, mut with_matrix) = (0.0_f64, 0.0_f64);
        for (primitive, corners) in mesh.indices.as_chunks::<3>().0.iter().enumerate() {
            // The normal is that of vertex 0, seen along itself.
            let normal = mesh.normals.as_ref().expect("it is smooth")[corners[0] as usize];
            let truth = transformed.normal(normal);
            let length = truth.iter().map(|x| x * x).sum::<f64>().sqrt();
            let direction = Vec3::from(truth.map(|x| (-x / length) as f32));
            let ray = shading::Ray {
                origin: Vec3::ZERO,
                direction,
                t_max: f32::INFINITY,
                exclude_primitive: None,
                culls_back_faces: false,
                cone_width: 0.0,
                cone_spread: 0.0,
            };
            let surface = posed.surface(&ray, 1.0, primitive as u32, Vec2::ZERO);
            worst = worst.max(angle(surface.normal.to_array().map(f64::from), truth));
            let moved: [f64; 3] = std::array::from_fn(|i| f64::from(normal[i]) * [1.0, 1e-3, 1e3][i]);
            with_matrix = with_matrix.max(angle(moved, truth));
        }
        assert!(worst < 1e-5, "{worst} rad");
        assert!(with_matrix > 1.0, "{with_matrix} rad");
    }
}
