//! Polygons of OBJ and PLY files: the area that they cover, and that none is lost without a remark.

use std::fs;
use std::path::Path;

use glam::DVec3;
use rasray_scene::Scene;
use rasray_scene_files::{LoadOptions, load};

fn read(folder: &Path, name: &str, bytes: &str) -> Scene {
    let path = folder.join(name);
    fs::write(&path, bytes).expect("written");
    load(&path, &LoadOptions::default()).unwrap_or_else(|error| panic!("{error}"))
}

/// Writes one polygon in the plane x + z = 0, as OBJ and as PLY with the faces before the vertices.
fn both(folder: &Path, corners: &[[f64; 2]]) -> [Scene; 2] {
    let count = corners.len();
    let vertices: Vec<String> = corners.iter().map(|[x, y]| format!("{x} {y} {}", -x)).collect();
    let obj: String = vertices.iter().map(|vertex| format!("v {vertex}\n")).collect();
    let face: String = (1..=count).map(|corner| format!(" {corner}")).collect();
    let obj = read(folder, "polygon.obj", &format!("{obj}f{face}\n"));
    let face: String = (0..count).map(|corner| format!(" {corner}")).collect();
    let ply = format!(
        "ply\nformat ascii 1.0\nelement face 1\nproperty list uchar int vertex_indices\nelement vertex {count}\n\
         property double x\nproperty double y\nproperty double z\nend_header\n{count}{face}\n{}\n",
        vertices.join("\n")
    );
    [obj, read(folder, "polygon.ply", &ply)]
}

/// Returns the area of all triangles, seen along z, and the area of those that are turned away.
fn area(scene: &Scene) -> (f64, f64) {
    let mesh = &scene.meshes[0];
    let (mut sum, mut turned) = (0.0, 0.0);
    for triangle in mesh.indices.chunks_exact(3) {
        let corner = |k: usize| DVec3::from(mesh.positions[triangle[k] as usize].map(f64::from));
        let twice = (corner(1) - corner(0)).cross(corner(2) - corner(0)).z;
        sum += twice.abs() / 2.0;
        turned += (-twice).max(0.0) / 2.0;
    }
    (sum, turned)
}

fn kinds(scene: &Scene) -> Vec<&'static str> {
    scene.warnings.iter().map(|warning| warning.kind).collect()
}

#[test]
fn concave_polygons_are_not_filled_to_their_hull() {
    let folder = tempfile::tempdir().expect("a folder");
    let quad = read(folder.path(), "09b.obj", "v 0 0 0\nv 1 1 0\nv 0 2 0\nv 0.4 1 0\nf 1 2 3 4\n");
    assert!((area(&quad).0 - 0.6).abs() < 1.0e-6, "{:?}", area(&quad));
    let polygons: [(&[[f64; 2]], f64); 4] = [
        (&[[0.0, 0.0], [1.0, 1.0], [0.0, 2.0], [0.4, 1.0]], 0.6),
        (&[[0.0, 0.0], [2.0, 0.0], [2.0, 1.0], [1.0, 1.0], [1.0, 2.0], [0.0, 2.0]], 3.0),
        // A U shape, with corners on its sides and one of them twice.
        (
            &[
                [0.0, 0.0],
                [1.5, 0.0],
                [3.0, 0.0],
                [3.0, 2.0],
                [2.0, 2.0],
                [2.0, 1.0],
                [1.5, 1.0],
                [1.5, 1.0],
                [1.0, 1.0],
                [1.0, 2.0],
                [0.0, 2.0],
            ],
            5.0,
        ),
        // A frame whose hole is tied to the outside.
        (
            &[
                [0.0, 0.0],
                [3.0, 0.0],
                [3.0, 3.0],
                [0.0, 3.0],
                [0.0, 0.0],
                [1.0, 1.0],
                [1.0, 2.0],
                [2.0, 2.0],
                [2.0, 1.0],
                [1.0, 1.0],
            ],
            8.0,
        ),
    ];
    for (polygon, wanted) in polygons {
        for shift in 0..polygon.len() {
            let mut turned = polygon.to_vec();
            turned.rotate_left(shift);
            for scene in both(folder.path(), &turned) {
                let (sum, away) = area(&scene);
                assert!((sum - wanted).abs() < 1.0e-6 && away < 1.0e-6, "{turned:?}: {sum}, {away}");
                assert_eq!(scene.meshes[0].triangle_count(), turned.len() - 2, "{turned:?}");
                assert!(!kinds(&scene).contains(&"crossing-faces"));
            }
        }
    }
}

#[test]
fn convex_polygons_stay_fans() {
    let folder = tempfile::tempdir().expect("a folder");
    let round: Vec<[f64; 2]> = (0..12)
        .map(|step| f64::from(step) * std::f64::consts::TAU / 12.0)
        .map(|angle| [(1.0e6 * angle.cos()).round() / 1.0e6, (1.0e6 * angle.sin()).round() / 1.0e6])
        .collect();
    let on_sides = vec![[0.0, 0.0], [0.1, 0.1], [0.2, 0.2], [1.0, 1.0], [0.3, 1.0], [0.0, 1.0], [0.0, 1.0]];
    for polygon in [round, on_sides] {
        for scene in both(folder.path(), &polygon) {
            let fan: Vec<u32> =
                (1..polygon.len() as u32 - 1).flat_map(|corner| [0, corner, corner + 1]).collect();
            assert_eq!(scene.meshes[0].indices, fan);
        }
    }
}

#[test]
fn crossing_sides_are_told() {
    let folder = tempfile::tempdir().expect("a folder");
    let star: Vec<[f64; 2]> = [0.0, 2.0, 4.0, 1.0, 3.0]
        .map(|step: f64| (step * std::f64::consts::TAU / 5.0).sin_cos())
        .map(|(sin, cos)| [cos, sin])
        .to_vec();
    for polygon in [vec![[0.0, 0.0], [1.0, 1.0], [1.0, 0.0], [0.0, 1.0]], star] {
        for scene in both(folder.path(), &polygon) {
            assert_eq!(scene.meshes[0].triangle_count(), polygon.len() - 2, "nothing is dropped");
            assert_eq!(kinds(&scene), ["crossing-faces"]);
        }
    }
    // A polygon on a line is not one whose sides cross.
    for scene in both(folder.path(), &[[0.0, 0.0], [1.0, 0.0], [3.0, 0.0], [2.0, 0.0]]) {
        assert_eq!(kinds(&scene), ["degenerate-triangles"]);
    }
}

/// Texture coordinates and normals stay with their corners.
#[test]
fn attributes_follow_their_corners() {
    let folder = tempfile::tempdir().expect("a folder");
    let text = "v 0 0 0\nv 1 1 0\nv 0 2 0\nv 0.4 1 0\nvt 0 0\nvt 1 1\nvt 0 2\nvt 0.4 1\nvn 0 0 1\n\
                f 1/1/1 2/2/1 3/3/1 4/4/1\n";
    let scene = read(folder.path(), "attributes.obj", text);
    let mesh = &scene.meshes[0];
    for (position, uv) in mesh.positions.iter().zip(mesh.uvs[0].as_ref().expect("coordinates")) {
        assert_eq!([position[0], 1.0 - position[1]], *uv);
    }
    assert_eq!((mesh.positions.len(), mesh.triangle_count()), (4, 2));
    assert!((area(&scene).0 - 0.6).abs() < 1.0e-6);
}
