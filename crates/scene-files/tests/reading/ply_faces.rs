//! Values of faces in PLY files, and those that are not read.

use std::fs;
use std::path::Path;

use approx::assert_abs_diff_eq;
use rasray_scene::{Scene, SceneError};
use rasray_scene_files::{LoadOptions, load};

fn try_read(folder: &Path, text: &str) -> Result<Scene, SceneError> {
    let path = folder.join("scene.ply");
    fs::write(&path, text).expect("written");
    load(&path, &LoadOptions::default())
}

fn read(folder: &Path, text: &str) -> Scene {
    try_read(folder, text).unwrap_or_else(|error| panic!("{error}"))
}

fn kinds(scene: &Scene) -> Vec<&'static str> {
    scene.warnings.iter().map(|warning| warning.kind).collect()
}

fn message<'a>(scene: &'a Scene, kind: &str) -> &'a str {
    let found = scene.warnings.iter().find(|warning| warning.kind == kind);
    &found.unwrap_or_else(|| panic!("{kind}: {:?}", scene.warnings)).message
}

fn square(comments: &str, vertex: &str, face: &str, behind: [&str; 4], faces: &str) -> String {
    let [a, b, c, d] = behind;
    format!(
        "ply\nformat ascii 1.0\n{comments}element vertex 4\nproperty float x\nproperty float y\nproperty float z\n{vertex}\
         element face 2\nproperty list uchar int vertex_indices\n{face}end_header\n\
         -1 -1 0{a}\n1 -1 0{b}\n1 1 0{c}\n-1 1 0{d}\n{faces}"
    )
}

const BARE: [&str; 4] = ["", "", "", ""];
const COLOR: &str = "property uchar red\nproperty uchar green\nproperty uchar blue\nproperty uchar alpha\n";

#[test]
fn colours_of_faces_are_shown() {
    let folder = tempfile::tempdir().expect("a folder");
    let text = square("", "", COLOR, BARE, "3 0 1 2 255 0 0 255\n3 0 2 3 0 0 255 255\n");
    let scene = read(folder.path(), &text);
    assert!(scene.warnings.is_empty(), "{:?}", scene.warnings);
    let mesh = &scene.meshes[0];
    let colors = mesh.colors.as_ref().expect("colours");
    let of_triangle = |triangle: usize| [0, 1, 2].map(|k| colors[mesh.indices[3 * triangle + k] as usize]);
    assert_eq!(of_triangle(0), [[1.0, 0.0, 0.0, 1.0]; 3]);
    assert_eq!(of_triangle(1), [[0.0, 0.0, 1.0, 1.0]; 3]);
    assert_eq!(mesh.positions[mesh.indices[5] as usize], [-1.0, 1.0, 0.0]);
    assert_eq!((mesh.positions.len(), scene.materials[0].base_color), (6, [1.0; 4]));

    // One colour for all faces is no reason to split; floats are linear; alpha below 1 is named.
    let float = COLOR.replace("uchar", "float");
    let text = square("", "", &float, BARE, "3 0 1 2 0.5 0.25 0 0.5\n3 0 2 3 0.5 0.25 0 0.5\n");
    let scene = read(folder.path(), &text);
    assert_eq!(scene.meshes[0].positions.len(), 4);
    assert_eq!(scene.meshes[0].colors.as_ref().expect("colours")[0], [0.5, 0.25, 0.0, 0.5]);
    assert_eq!(kinds(&scene), ["color-alpha"]);
    assert!(message(&scene, "color-alpha").starts_with("2 colours"));

    // Colours of faces replace those of vertices, with a remark.
    let vertex = "property uchar red\nproperty uchar green\nproperty uchar blue\n";
    let behind = [" 0 255 0"; 4];
    let text = square("", vertex, COLOR, behind, "3 0 1 2 255 0 0 255\n3 0 2 3 0 0 255 255\n");
    let scene = read(folder.path(), &text);
    assert_eq!(kinds(&scene), ["vertex-colors"]);
    assert!(scene.meshes[0].colors.as_ref().expect("colours").iter().all(|color| color[1] == 0.0));
}

#[test]
fn colours_under_other_names_are_read() {
    let folder = tempfile::tempdir().expect("a folder");
    for names in [["red", "green", "blue"], ["diffuse_red", "diffuse_green", "diffuse_blue"], ["r", "g", "b"]]
    {
        let colors: String = names.iter().map(|name| format!("property uchar {name}\n")).collect();
        let of_vertices = square("", &colors, "", [" 255 0 0"; 4], "3 0 1 2\n3 0 2 3\n");
        let of_faces = square("", "", &colors, BARE, "3 0 1 2 255 0 0\n3 0 2 3 255 0 0\n");
        for text in [of_vertices, of_faces] {
            let scene = read(folder.path(), &text);
            assert!(scene.warnings.is_empty(), "{:?}", scene.warnings);
            assert_eq!(scene.meshes[0].colors, Some(vec![[1.0, 0.0, 0.0, 1.0]; 4]));
        }
    }
}

/// A face whose vertex does not exist is an error, with colours and without.
#[test]
fn faces_with_colours_are_checked() {
    let folder = tempfile::tempdir().expect("a folder");
    let text = square("", "", COLOR, BARE, "3 0 1 4 255 0 0 255\n3 0 2 3 0 0 255 255\n");
    match try_read(folder.path(), &text) {
        Err(error @ SceneError::IndexOutOfRange { index: 4, vertices: 4, .. }) => {
            assert!(error.to_string().contains("scene.ply"), "{error}");
        }
        other => panic!("{other:?}"),
    }
}

fn image(folder: &Path, name: &str, texel: [u8; 3]) {
    image::RgbImage::from_pixel(2, 2, image::Rgb(texel)).save(folder.join(name)).expect("written");
}

/// MeshLab writes files in this form: images named by comments, coordinates at the corners of faces.
#[test]
fn textures_of_faces_are_shown() {
    let folder = tempfile::tempdir().expect("a folder");
    image(folder.path(), "first one.png", [255, 0, 0]);
    image(folder.path(), "second.png", [0, 0, 255]);
    let comments =
        "comment VCGLIB generated\ncomment TextureFile first one.png\ncomment TextureFile second.png\n";
    let face = "property list uchar float texcoord\nproperty int texnumber\n";
    let faces = "3 0 1 2 6 0 0 1 0 1 0.75 1\n3 0 2 3 6 0 0 1 1 0 1 0\n";
    let scene = read(folder.path(), &square(comments, "", face, BARE, faces));
    assert!(scene.warnings.is_empty(), "{:?}", scene.warnings);
    assert_eq!((scene.meshes.len(), scene.images.len()), (2, 2));
    let image_of = |mesh: usize| {
        let material = &scene.materials[scene.meshes[mesh].material];
        assert_eq!(material.base_color, [1.0; 4]);
        let texture = material.base_color_texture.expect("a texture");
        scene.images[scene.textures[texture.texture].image].rgba8[..3].to_vec()
    };
    assert_eq!((image_of(0), image_of(1)), (vec![0, 0, 255], vec![255, 0, 0]));
    let mesh = &scene.meshes[0];
    assert_eq!(mesh.uvs[0], Some(vec![[0.0, 1.0], [1.0, 1.0], [1.0, 0.25]]), "v counts from the bottom");
    assert_eq!(scene.instances.iter().map(|instance| instance.mesh).collect::<Vec<_>>(), [0, 1]);

    // All faces have one texture, with coordinates at the vertices.
    let comments = "comment TextureFile second.png\n";
    let vertex = "property float texture_u\nproperty float texture_v\n";
    let behind = [" 0 0", " 1 0", " 1 1", " 0 1"];
    let scene = read(folder.path(), &square(comments, vertex, "", behind, "3 0 1 2\n3 0 2 3\n"));
    assert!(scene.warnings.is_empty(), "{:?}", scene.warnings);
    assert!(scene.materials[0].base_color_texture.is_some());
    assert_eq!((scene.meshes[0].positions.len(), scene.files.len()), (4, 1));

    // Faces without a texture are plain, and those without coordinates get 0, with a remark.
    let face = "property list uchar float texcoord\nproperty int texnumber\n";
    let faces = "3 0 1 2 0 0\n3 0 2 3 6 0 0 1 1 0 1 -1\n";
    let scene = read(folder.path(), &square(comments, "", face, BARE, faces));
    assert_eq!(kinds(&scene), ["bad-texture-coordinates"]);
    assert_eq!((scene.meshes.len(), scene.materials[1].base_color_texture), (2, None));
}

#[test]
fn missing_textures_are_told() {
    let folder = tempfile::tempdir().expect("a folder");
    let face = "property list uchar float texcoord\n";
    let faces = "3 0 1 2 6 0 0 1 0 1 1\n3 0 2 3 6 0 0 1 1 0 1\n";
    for name in ["gone.png", "C:\\models\\gone.png", "../gone.png", "/etc/passwd"] {
        let scene =
            read(folder.path(), &square(&format!("comment TextureFile {name}\n"), "", face, BARE, faces));
        assert_eq!(kinds(&scene), ["missing-texture"], "{name}");
        assert!(scene.images.is_empty() && scene.meshes[0].triangle_count() == 2);
    }
    image(folder.path(), "here.png", [9, 9, 9]);
    let text = square("comment TextureFile D:\\a\\here.png\n", "", face, BARE, faces);
    let scene = read(folder.path(), &text);
    assert_eq!((kinds(&scene), scene.images.len()), (vec!["texture-elsewhere"], 1));
}

#[test]
fn what_is_not_read_is_named() {
    let folder = tempfile::tempdir().expect("a folder");
    let text = "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n\
        property float quality\nproperty uchar alpha\nproperty int material_index\nelement face 1\n\
        property list uchar int vertex_indices\nproperty float quality\nproperty list uchar float texcoord\n\
        element edge 2\nproperty int vertex1\nproperty int vertex2\nelement range_grid 1\n\
        property list uchar int vertex_indices\nend_header\n\
        0 0 0 1 255 0\n1 0 0 1 255 0\n0 1 0 1 255 0\n3 0 1 2 0.5 6 0 0 1 0 0 1\n0 1\n1 2\n1 0\n";
    let scene = read(folder.path(), text);
    assert_eq!(kinds(&scene), ["unread-properties", "unread-elements"]);
    assert_eq!(
        message(&scene, "unread-properties"),
        "properties are not shown: face quality (1), face texcoord (1), vertex alpha (3), vertex material_index (3), \
         vertex quality (3)"
    );
    assert_eq!(message(&scene, "unread-elements"), "elements are not shown: edge (2), range_grid (1)");

    let alpha = square("", COLOR, "", [" 255 0 0 0"; 4], "3 0 1 2\n3 0 2 3\n");
    let scene = read(folder.path(), &alpha);
    assert_eq!(message(&scene, "color-alpha"), "4 colours have an alpha below 1, which is not shown");
    assert_abs_diff_eq!(scene.meshes[0].colors.as_ref().expect("colours")[0][3], 0.0);
}

/// Coloured faces and strips in one file, and a polygon that is cut.
#[test]
fn strips_beside_coloured_faces_keep_their_vertices() {
    let folder = tempfile::tempdir().expect("a folder");
    let text = "ply\nformat ascii 1.0\nelement face 1\nproperty list uchar int vertex_indices\nproperty uchar red\n\
        property uchar green\nproperty uchar blue\nelement tristrips 1\nproperty list int int vertex_indices\n\
        element vertex 5\nproperty double x\nproperty double y\nproperty double z\nend_header\n\
        4 0 1 2 3 0 255 0\n4 0 1 4 -1\n0 0 0\n1 1 0\n0 2 0\n0.4 1 0\n0 0 1\n";
    let scene = read(folder.path(), text);
    assert!(scene.warnings.is_empty(), "{:?}", scene.warnings);
    let mesh = &scene.meshes[0];
    assert_eq!(mesh.triangle_count(), 3);
    let colors = mesh.colors.as_ref().expect("colours");
    let last = &mesh.indices[6..];
    assert_eq!(last.iter().map(|corner| colors[*corner as usize]).collect::<Vec<_>>(), [[1.0; 4]; 3]);
    assert_eq!(mesh.positions[last[2] as usize], [0.0, 0.0, 1.0]);
    let corner = |index: u32| glam::DVec3::from(mesh.positions[index as usize].map(f64::from));
    let area: f64 = mesh.indices[..6]
        .chunks_exact(3)
        .map(|t| (corner(t[1]) - corner(t[0])).cross(corner(t[2]) - corner(t[0])).length() / 2.0)
        .sum();
    assert!((area - 0.6).abs() < 1.0e-6, "{area}");
}
