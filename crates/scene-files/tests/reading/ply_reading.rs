//! PLY files written by the tests, and files from other programs.

use approx::assert_abs_diff_eq;
use std::fs;
use std::path::{Path, PathBuf};

use proptest::prelude::*;
use rasray_scene::{Scene, SceneError};
use rasray_scene_files::{LoadOptions, ply};

use crate::gltf_support::placed_triangles;

fn load(path: &Path) -> Result<Scene, SceneError> {
    ply::load(path, &LoadOptions::default())
}

fn read(test: &str, bytes: impl AsRef<[u8]>) -> Result<Scene, SceneError> {
    let folder = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join("ply_reading");
    fs::create_dir_all(&folder).expect("a folder for the test");
    let path = folder.join(format!("{test}.ply"));
    fs::write(&path, bytes).expect("written");
    load(&path)
}

fn warned(scene: &Scene, kind: &str) -> bool {
    scene.warnings.iter().any(|warning| warning.kind == kind)
}

/// Encoding of one value stream; all three are written by hand.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Encoding {
    Ascii,
    Little,
    Big,
}

const ENCODINGS: [Encoding; 3] = [Encoding::Ascii, Encoding::Little, Encoding::Big];

struct Writer {
    encoding: Encoding,
    bytes: Vec<u8>,
}

macro_rules! writers {
    ($($type:ident),*) => { impl Writer { $(
        fn $type(&mut self, value: $type) -> &mut Self {
            match self.encoding {
                Encoding::Ascii => self.bytes.extend(format!("{value} ").bytes()),
                Encoding::Little => self.bytes.extend(value.to_le_bytes()),
                Encoding::Big => self.bytes.extend(value.to_be_bytes()),
            }
            self
        }
    )* } };
}
writers!(u8, i16, i32, u32, f32, f64);

impl Writer {
    fn new(encoding: Encoding, header: &str) -> Self {
        let format = match encoding {
            Encoding::Ascii => "ascii",
            Encoding::Little => "binary_little_endian",
            Encoding::Big => "binary_big_endian",
        };
        Self { encoding, bytes: format!("ply\nformat {format} 1.0\n{header}\nend_header\n").into_bytes() }
    }

    fn end_row(&mut self) {
        if self.encoding == Encoding::Ascii {
            self.bytes.push(b'\n');
        }
    }
}

#[test]
fn all_attributes_in_all_encodings() {
    let header = "comment made by hand\nobj_info nothing\nelement vertex 4\nproperty double x\nproperty float y\n\
        property float z\nproperty float nx\nproperty float ny\nproperty float nz\nproperty uchar red\n\
        property uchar green\nproperty uchar blue\nproperty uchar alpha\nproperty float quality\n\
        property list uchar short extra\nproperty float s\nproperty float t\nelement edge 2\n\
        property int vertex1\nproperty list int float weights\nelement face 2\nproperty uchar flags\n\
        property list uchar int vertex_indices\nproperty list uchar float texcoord";
    for encoding in ENCODINGS {
        let mut writer = Writer::new(encoding, header);
        for corner in 0..4_u8 {
            let (x, y) = (corner % 2, corner / 2);
            writer.f64(f64::from(x)).f32(f32::from(y)).f32(0.5).f32(0.0).f32(0.0).f32(1.0);
            writer.u8(255).u8(0).u8(188).u8(128).f32(9.0);
            writer.u8(2).i16(-7).i16(8).f32(f32::from(x)).f32(0.25).end_row();
        }
        for edge in 0..2 {
            writer.i32(edge).i32(edge);
            for _ in 0..edge {
                writer.f32(1.5);
            }
            writer.end_row();
        }
        writer.u8(1).u8(4).i32(0).i32(1).i32(3).i32(2).u8(1).f32(0.5).end_row();
        writer.u8(1).u8(3).i32(0).i32(2).i32(1).u8(0).end_row();
        let scene =
            read(&format!("all-{encoding:?}"), &writer.bytes).unwrap_or_else(|error| panic!("{error}"));
        let mesh = &scene.meshes[0];
        assert_eq!(mesh.indices, [0, 1, 3, 0, 3, 2, 0, 2, 1], "{encoding:?}");
        assert_eq!(mesh.positions[3], [1.0, 1.0, 0.5]);
        assert_eq!(mesh.normals.as_ref().expect("normals")[2], [0.0, 0.0, 1.0]);
        assert_eq!(mesh.uvs[0].as_ref().expect("uvs")[1], [1.0, 0.75]);
        let [red, green, blue, alpha] = mesh.colors.as_ref().expect("colours")[0];
        assert_eq!((red, green), (1.0, 0.0));
        assert_abs_diff_eq!(blue, 0.503, epsilon = 1.0e-3);
        assert_abs_diff_eq!(alpha, 128.0 / 255.0, epsilon = 1.0e-6);
        let kinds: Vec<_> = scene.warnings.iter().map(|warning| warning.kind).collect();
        assert_eq!(kinds, ["color-alpha", "unread-properties", "unread-elements"]);
        assert_eq!(scene.materials[0].base_color, [1.0; 4], "colours are not dimmed");
    }
}

#[test]
fn every_integer_type_can_index() {
    for scalar in [
        "char", "uchar", "short", "ushort", "int", "uint", "int8", "uint8", "int16", "uint16", "int32",
        "uint32",
    ] {
        let text = format!(
            "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n\
             element face 1\nproperty list {scalar} {scalar} vertex_index\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n"
        );
        let scene = read(&format!("index-{scalar}"), text).unwrap_or_else(|error| panic!("{error}"));
        assert_eq!(scene.meshes[0].indices, [0, 1, 2]);
    }
}

#[test]
fn faces_may_stand_before_vertices() {
    let text = "ply\r\nformat ascii 1.0\r\nelement face 1\r\nproperty list uchar int vertex_indices\r\nelement vertex 3\r\n\
        property float x\r\nproperty float y\r\nproperty float z\r\nend_header\r\n3 0 1 2\r\n0 0 0\r\n1 0 0\r\n0 1 0\r\n";
    assert_eq!(placed_triangles(&read("order", text).expect("scene")), 1);
}

#[test]
fn malformed_files_are_typed_errors_with_a_place() {
    let vertices = "element vertex 1\nproperty float x\nproperty float y\nproperty float z\n";
    let faces = "element face 1\nproperty list uchar int vertex_indices\n";
    let body = |header: &str, body: &str| format!("ply\nformat ascii 1.0\n{header}end_header\n{body}");
    let table: Vec<(String, &str)> = vec![
        (String::new(), "is empty, not a PLY file"),
        ("plx\n".to_owned(), "line 1: a PLY file begins"),
        ("ply".to_owned(), "line 1: a PLY file begins"),
        ("ply\n".to_owned(), "line 2: the header does not end"),
        ("solid cube\nfacet\n".to_owned(), "is an STL file, not a PLY file; convert it"),
        ("\u{1}\0\n".to_owned(), "is binary data, not a PLY file"),
        ("ply\nformat ascii 2.0\n".to_owned(), "line 2: `2.0` is no version"),
        ("ply\nformat utf8 1.0\n".to_owned(), "line 2: `utf8` is no format"),
        ("ply\nend_header\n".to_owned(), "no line `format`"),
        ("ply\nformat ascii 1.0\nproperty float x\n".to_owned(), "line 3: a property stands before"),
        ("ply\nformat ascii 1.0\nelement vertex -1\n".to_owned(), "line 3: `-1` is not a whole number"),
        (body("element vertex 1\nproperty half x\n", "0"), "line 4: `half` is no type"),
        (
            body("element face 1\nproperty list float int vertex_indices\n", "0"),
            "line 4: the length of a list",
        ),
        (body("nonsense\n", ""), "line 3: `nonsense` is no line"),
        (body("element vertex 1\nproperty float x\n", "0"), "lacks one of the properties"),
        (body("element face 1\nproperty float x\n", "0"), "lacks the list"),
        (body("element face 1\nproperty list uchar float vertex_indices\n", "0"), "whole numbers"),
        (body(vertices, "0"), "the file can hold"),
        (body(vertices, "0    0   "), "line 8: the file ends before"),
        (body(vertices, "0 zero 0"), "line 8: `zero` is not a number"),
        (body("element vertex 99999999999999999999\n", ""), "line 3"),
        (
            body(
                "element vertex 999999999999\nproperty float x\nproperty float y\nproperty float z\n",
                "0 0 0",
            ),
            "the file can hold",
        ),
        (body(&format!("{vertices}{faces}"), "0 0 0\n3 0 0 1\n"), "vertex index 1"),
        (body(&format!("{vertices}{faces}"), "0 0 0\n3 0 0 -1\n"), "vertex index -1"),
        (body(&format!("{vertices}{faces}"), "0 0 0\n-3 0 0 0\n"), "cannot have -3 entries"),
        (body(&format!("{vertices}{faces}"), "0 0 0\n250 0 0 0\n"), "more than the rest of the file"),
        (body(&format!("{vertices}{faces}"), "0 0 0\n3 0 0 0.5\n"), "`0.5` is not a whole number"),
    ];
    for (place, (text, part)) in table.into_iter().enumerate() {
        let error =
            read(&format!("bad-{place}"), &text).err().unwrap_or_else(|| panic!("{text} was accepted"));
        let message = error.to_string();
        assert!(message.contains(part) && message.contains(".ply"), "{text}: {message}");
    }
}

#[test]
fn elements_without_properties_take_no_time() {
    let text = "ply\nformat ascii 1.0\nelement nothing 18446744073709551615\nend_header\n";
    assert!(warned(&read("nothing", text).expect("scene"), "no-triangles"));
}

#[test]
fn limits_are_kept() {
    let text = "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n\
        element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n4 0 1 2 0\n";
    read("limits", text).expect("within the default limits");
    let path = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join("ply_reading/limits.ply");
    for option in ["triangles", "vertices", "file_bytes"] {
        let mut options = LoadOptions::default();
        match option {
            "triangles" => options.limits.triangles = 1,
            "vertices" => options.limits.vertices = 2,
            _ => options.limits.file_bytes = 20,
        }
        let error = ply::load(&path, &options).expect_err(option);
        assert!(matches!(error, SceneError::TooLarge { option: found, .. } if found == option), "{error}");
    }
}

#[test]
fn files_of_others_end_as_the_table_says() {
    let Some(folder) = std::env::var_os("RASRAY_SCENES").map(PathBuf::from) else {
        eprintln!("skipped: files_of_others_end_as_the_table_says needs RASRAY_SCENES");
        return;
    };
    let table: [(&str, Result<usize, &str>); 12] = [
        ("organic/stanford_dragon_res3/dragon_vrip_res3.ply", Ok(47_794)),
        ("deforming/cloth_ball/cloth_ball92.ply", Ok(92_230)),
        ("deforming/cloth_ball/cloth_ball93.ply", Ok(92_230)),
        ("degenerate/trimesh_odd/empty.ply", Ok(0)),
        ("degenerate/trimesh_odd/points_ascii.ply", Ok(0)),
        ("degenerate/trimesh_odd/points_ascii_with_lists.ply", Ok(0)),
        ("degenerate/trimesh_odd/points_emptyascii.ply", Ok(0)),
        ("degenerate/trimesh_odd/points_emptyface.ply", Ok(0)),
        ("degenerate/trimesh_odd/emptyIO/ply_empty_ascii.ply", Ok(0)),
        ("degenerate/trimesh_odd/emptyIO/ply_empty_header.ply", Ok(0)),
        ("degenerate/trimesh_odd/emptyIO/ply_points_ascii.ply", Ok(0)),
        ("degenerate/trimesh_odd/emptyIO/ply_points_bin.ply", Ok(0)),
    ];
    for (file, expected) in table {
        match (load(&folder.join(file)), expected) {
            (Ok(scene), Ok(count)) => {
                assert_eq!(placed_triangles(&scene), count, "{file}");
                assert_eq!(warned(&scene, "no-triangles"), count == 0, "{file}");
            }
            (Err(error), Err(part)) => assert!(error.to_string().contains(part), "{error}"),
            (Ok(_), Err(_)) => panic!("{file} was accepted"),
            (Err(error), Ok(_)) => panic!("{error}"),
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 48, failure_persistence: None, ..ProptestConfig::default() })]

    /// The three encodings of one mesh are read as the same mesh, which is the one that was written.
    #[test]
    fn encodings_agree(
        points in prop::collection::vec(prop::array::uniform3(-1.0e6_f32..1.0e6), 3..30),
        faces in prop::collection::vec(prop::collection::vec(0_u32..1000, 3..7), 1..20),
    ) {
        let header = format!(
            "element vertex {}\nproperty float x\nproperty float y\nproperty float z\nelement face {}\n\
             property list uchar uint vertex_indices", points.len(), faces.len());
        let mut meshes = Vec::new();
        for encoding in ENCODINGS {
            let mut writer = Writer::new(encoding, &header);
            for point in &points {
                // Text has as many digits as the binary number: it is read in double precision.
                point.iter().for_each(|value| match encoding {
                    Encoding::Ascii => { writer.f64(f64::from(*value)); }
                    _ => { writer.f32(*value); }
                });
                writer.end_row();
            }
            for face in &faces {
                writer.u8(face.len() as u8);
                face.iter().for_each(|index| { writer.u32(index % points.len() as u32); });
                writer.end_row();
            }
            let scene = read("property", &writer.bytes).expect("scene");
            let mesh = &scene.meshes[0];
            prop_assert_eq!(&mesh.positions, &points);
            // The filling of polygons is tested elsewhere; here triangles come in the order of the file.
            let mut triangles = mesh.indices.chunks_exact(3);
            for face in &faces {
                let face: Vec<u32> = face.iter().map(|index| index % points.len() as u32).collect();
                let filled: Vec<&[u32]> = triangles.by_ref().take(face.len() - 2).collect();
                prop_assert_eq!(filled.len(), face.len() - 2);
                prop_assert!(filled.iter().copied().flatten().all(|corner| face.contains(corner)));
                prop_assert!(face.len() > 3 || filled == [&face[..]]);
            }
            prop_assert!(triangles.next().is_none());
            meshes.push(mesh.indices.clone());
        }
        prop_assert!(meshes.iter().all(|indices| *indices == meshes[0]));
    }

    /// A file cut off anywhere, or with a changed byte, still gets an answer.
    #[test]
    fn damaged_files_are_answered(cut in 0_usize..400, place in 0_usize..400, byte in any::<u8>(), big in any::<bool>()) {
        let encoding = if big { Encoding::Big } else { Encoding::Little };
        let mut writer = Writer::new(encoding, "element vertex 3\nproperty float x\nproperty float y\nproperty float z\n\
            element face 1\nproperty list int int vertex_indices");
        for value in [0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0] {
            writer.f32(value);
        }
        writer.i32(3).i32(0).i32(1).i32(2);
        let mut bytes = writer.bytes;
        let length = bytes.len();
        bytes[place % length] = byte;
        bytes.truncate(length - cut % length);
        let _ = read("damaged", &bytes);
    }
}

/// Corners close triangles with the two before them, all facing one way; -1 ends a strip.
#[test]
fn strips_become_triangles_that_face_one_way() {
    let header = "element vertex 5\nproperty float x\nproperty float y\nproperty float z\n\
                  element tristrips 1\nproperty list int int vertex_indices\n";
    for encoding in ENCODINGS {
        let mut writer = Writer::new(encoding, header);
        for place in [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [1.0, 1.0], [0.0, 2.0_f32]] {
            writer.f32(place[0]).f32(place[1]).f32(0.0);
        }
        for index in [9, 0, 1, 2, 3, 4, -1, 0, 1, 3] {
            writer.i32(index);
        }
        let scene = read(&format!("strips-{encoding:?}"), &writer.bytes).expect("a good file");
        assert_eq!(scene.meshes[0].indices, [0, 1, 2, 2, 1, 3, 2, 3, 4, 0, 1, 3], "{encoding:?}");
    }
}

/// No process writes to the pipe: a reader that opened it would wait.
#[cfg(unix)]
#[test]
fn a_pipe_or_a_folder_is_an_error_at_once() {
    let folder = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join("ply_reading");
    let (pipe, below) = (folder.join("pipe.ply"), folder.join("folder.ply"));
    fs::create_dir_all(&below).expect("a folder");
    let _ = fs::remove_file(&pipe);
    let made = std::process::Command::new("mkfifo").arg(&pipe).status().expect("mkfifo");
    assert!(made.success());
    for path in [pipe, below] {
        let error = load(&path).expect_err("not a file").to_string();
        assert!(error.contains("not a regular file") && error.contains(".ply"), "{error}");
    }
}
