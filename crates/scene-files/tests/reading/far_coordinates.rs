//! Coordinates far from the origin keep the precision of their file: OBJ text, PLY doubles and whole numbers,
//! numbered files.

use std::fmt::Write;
use std::fs;
use std::path::Path;

use glam::{DAffine3, DVec3};
use rasray_scene::{Moment, Scene};
use rasray_scene_files::{LoadOptions, load};

/// Position of the plate: UTM zone 33N.
const UTM: [f64; 3] = [500_123.0, 4_649_776.0, 112.0];
/// Number of vertices of the plate along a side.
const SIDE: usize = 11;

/// Writes the coordinates of a plate of one metre, in text as exporters write it, moved by whole metres.
fn plate(by: [f64; 3]) -> Vec<[String; 3]> {
    let vertex = |place: usize| {
        let (x, y) = (place % SIDE, place / SIDE);
        let z = if (x + y).is_multiple_of(2) { 0.345 } else { 0.375 };
        let point = [0.456 + 0.1 * x as f64, 0.654 + 0.1 * y as f64, z];
        [0, 1, 2].map(|axis| format!("{:.4}", point[axis] + by[axis]))
    };
    (0..SIDE * SIDE).map(vertex).collect()
}

/// Iterates over the corners of the plate's squares.
fn squares() -> impl Iterator<Item = [usize; 4]> {
    (0..(SIDE - 1) * (SIDE - 1)).map(|place| {
        let first = place % (SIDE - 1) + place / (SIDE - 1) * SIDE;
        [first, first + 1, first + SIDE + 1, first + SIDE]
    })
}

fn obj(vertices: &[[String; 3]], behind: &str) -> String {
    let mut text = String::new();
    for [x, y, z] in vertices {
        writeln!(text, "v {x} {y} {z}{behind}").expect("text");
    }
    for corners in squares() {
        let [a, b, c, d] = corners.map(|corner| corner + 1);
        writeln!(text, "f {a} {b} {c} {d}").expect("text");
    }
    text
}

/// Makes a PLY file: ASCII with numbers of type `of`, or binary with either byte order.
fn ply(vertices: &[[f64; 3]], of: &str, format: &str) -> Vec<u8> {
    let mut bytes = format!(
        "ply\nformat {format} 1.0\nelement vertex {}\nproperty {of} x\nproperty {of} y\nproperty {of} z\nelement face {}\n\
         property list uchar int vertex_indices\nend_header\n",
        vertices.len(),
        squares().count()
    )
    .into_bytes();
    let big = format.ends_with("big_endian");
    for value in vertices.iter().flatten() {
        match (format, of) {
            ("ascii", _) => bytes.extend(format!("{value} ").bytes()),
            (_, "double") if big => bytes.extend(value.to_be_bytes()),
            (_, "double") => bytes.extend(value.to_le_bytes()),
            _ if big => bytes.extend((*value as i32).to_be_bytes()),
            _ => bytes.extend((*value as i32).to_le_bytes()),
        }
    }
    for corners in squares() {
        match format {
            "ascii" => bytes
                .extend(format!("4 {} {} {} {}\n", corners[0], corners[1], corners[2], corners[3]).bytes()),
            _ => {
                bytes.push(4);
                for corner in corners {
                    let corner = corner as i32;
                    bytes.extend(if big { corner.to_be_bytes() } else { corner.to_le_bytes() });
                }
            }
        }
    }
    bytes
}

fn values(vertices: &[[String; 3]]) -> Vec<[f64; 3]> {
    vertices.iter().map(|vertex| vertex.each_ref().map(|text| text.parse().expect("a number"))).collect()
}

fn read(folder: &Path, name: &str, bytes: impl AsRef<[u8]>) -> Scene {
    let path = folder.join(name);
    fs::write(&path, bytes).expect("written");
    load(&path, &LoadOptions::default()).unwrap_or_else(|error| panic!("{error}"))
}

/// Returns the corners of all triangles in the world, in double precision.
fn corners(scene: &Scene) -> Vec<DVec3> {
    let placed = scene.instances.iter().flat_map(|instance| {
        let mesh = &scene.meshes[instance.mesh];
        mesh.indices.iter().map(|&index| {
            let position = DVec3::from(mesh.positions[index as usize].map(f64::from));
            instance.world_from_mesh.transform_point3(position)
        })
    });
    placed.collect()
}

/// Returns the corners of the file's triangles, in the order of a fan for each square.
fn truth(vertices: &[[f64; 3]]) -> Vec<DVec3> {
    let fan = squares().flat_map(|[a, b, c, d]| [a, b, c, a, c, d]);
    fan.map(|corner| DVec3::from_array(vertices[corner])).collect()
}

/// Asserts differences of at most half a unit of single precision of the size, and of double precision of the
/// coordinates.
fn assert_close(found: &[DVec3], wanted: &[DVec3], size: f64, what: &str) {
    assert_eq!(found.len(), wanted.len(), "{what}");
    let slack = size * 2.0_f64.powi(-24) + 1.0e-9 * size.max(1.0);
    for (found, wanted) in found.iter().zip(wanted) {
        let off = (*found - *wanted).abs().max_element();
        assert!(off <= slack, "{what}: {wanted} is at {found}, off by {off:e} of {size}");
    }
}

#[test]
fn text_far_from_the_origin_is_what_it_says() {
    let folder = tempfile::tempdir().expect("a folder");
    let far = plate(UTM);
    let wanted = truth(&values(&far));
    let shifted = read(folder.path(), "shifted.obj", obj(&plate([0.0; 3]), ""));
    assert_eq!(shifted.instances[0].world_from_mesh, DAffine3::IDENTITY);
    let from_shifted: Vec<DVec3> =
        corners(&shifted).into_iter().map(|corner| corner + DVec3::from(UTM)).collect();
    for (name, behind) in
        [("plain.obj", ""), ("weight.obj", " 1.0"), ("color.obj", " 1 0.5 0"), ("both.obj", " 1 1 0.5 0")]
    {
        let scene = read(folder.path(), name, obj(&far, behind));
        assert_close(&corners(&scene), &wanted, 1.0, name);
        assert_close(&corners(&scene), &from_shifted, 2.0, "as if it were near");
        assert!(scene.meshes[0].positions.iter().flatten().all(|x| x.abs() < 1.0), "relative to its middle");
    }
    let exponents = far
        .iter()
        .map(|vertex| vertex.each_ref().map(|text| format!("{:e}", text.parse::<f64>().expect("a number"))));
    let scene = read(folder.path(), "exponents.obj", obj(&exponents.collect::<Vec<_>>(), ""));
    assert_close(&corners(&scene), &wanted, 1.0, "exponents");
}

#[test]
fn doubles_and_whole_numbers_far_from_the_origin_are_what_they_are() {
    let folder = tempfile::tempdir().expect("a folder");
    let doubles = values(&plate(UTM));
    // The coordinates are in centimetres.
    let whole: Vec<[f64; 3]> = doubles.iter().map(|vertex| vertex.map(|x| (x * 100.0).round())).collect();
    for format in ["ascii", "binary_little_endian", "binary_big_endian"] {
        for (of, vertices, size) in [("double", &doubles, 1.0), ("int", &whole, 100.0)] {
            let scene = read(folder.path(), &format!("{of}.{format}.ply"), ply(vertices, of, format));
            assert_close(&corners(&scene), &truth(vertices), size, &format!("{of} in {format}"));
            assert_ne!(scene.instances[0].world_from_mesh.translation, DVec3::ZERO);
        }
    }
}

/// Coordinates that single precision holds exactly are kept, wherever they are; so are meshes that are large
/// compared with their distance.
#[test]
fn what_loses_nothing_keeps_its_bits() {
    let folder = tempfile::tempdir().expect("a folder");
    let exact: Vec<[f64; 3]> = values(&plate([0.0; 3]))
        .iter()
        .map(|vertex| [0, 1, 2].map(|axis| UTM[axis] + (vertex[axis] * 10.0).round()))
        .collect();
    let text = |vertices: &[[f64; 3]]| -> Vec<[String; 3]> {
        vertices.iter().map(|vertex| vertex.map(|x| x.to_string())).collect()
    };
    let large: Vec<[f64; 3]> = exact.iter().map(|vertex| [vertex[0] / 3.0, vertex[1] / 3.0, 0.1]).collect();
    let spread: Vec<[f64; 3]> =
        large.iter().map(|vertex| [(vertex[0] - 166_700.0) * 5.0e5, vertex[1], 0.1]).collect();
    for (name, vertices) in [("exact", &exact), ("spread", &spread)] {
        for scene in [
            read(folder.path(), &format!("{name}.obj"), obj(&text(vertices), "")),
            read(folder.path(), &format!("{name}.ply"), ply(vertices, "double", "binary_little_endian")),
        ] {
            assert_eq!(scene.instances[0].world_from_mesh, DAffine3::IDENTITY, "{name}");
            let rounded: Vec<[f32; 3]> = vertices.iter().map(|vertex| vertex.map(|x| x as f32)).collect();
            for position in &scene.meshes[0].positions {
                assert!(rounded.contains(position), "{name}: {position:?}");
            }
        }
    }
    let float = read(folder.path(), "float.ply", {
        let mut bytes =
            b"ply\nformat binary_little_endian 1.0\nelement vertex 3\nproperty float x\nproperty float y\n\
            property float z\nelement face 1\nproperty list uchar uchar vertex_indices\nend_header\n"
                .to_vec();
        for x in [
            500_123.47_f32,
            4_649_776.5,
            112.3,
            500_124.47,
            4_649_776.5,
            112.3,
            500_123.47,
            4_649_777.5,
            112.3,
        ] {
            bytes.extend(x.to_le_bytes());
        }
        bytes.extend([3, 0, 1, 2]);
        bytes
    });
    assert_eq!(float.meshes[0].positions[0], [500_123.47, 4_649_776.5, 112.3]);
    assert_eq!(float.instances[0].world_from_mesh, DAffine3::IDENTITY);
}

/// Meshes of one file that touch share an origin, so that their common corners are the same points; a mesh
/// that stands apart keeps its own precision.
#[test]
fn parts_of_a_file_stay_together() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut text = String::from("o near\nv 0.1 0.2 0.3\nv 1.1 0.2 0.3\nv 0.1 1.2 0.3\nf 1 2 3\n");
    let far = plate(UTM);
    for [x, y, z] in &far {
        writeln!(text, "v {x} {y} {z}").expect("text");
    }
    for (place, corners) in squares().enumerate() {
        let [a, b, c, d] = corners.map(|corner| corner + 4);
        writeln!(text, "usemtl m{}\nf {a} {b} {c} {d}", place % 2).expect("text");
    }
    let scene = read(folder.path(), "parts.obj", text);
    assert_eq!(scene.instances[0].world_from_mesh, DAffine3::IDENTITY);
    assert_eq!(scene.meshes[0].positions[1], [1.1, 0.2, 0.3]);
    let origins: Vec<DVec3> =
        scene.instances[1..].iter().map(|instance| instance.world_from_mesh.translation).collect();
    assert!(origins.len() > 50 && origins.iter().all(|origin| *origin == origins[0] && origin.y > 4.6e6));
    assert_close(&corners(&scene)[3..], &truth(&values(&far)), 1.0, "the plate");
}

/// Faces of one material are one mesh, unless their groups lie so far apart that one origin cannot serve all.
#[test]
fn groups_of_one_material_that_lie_apart_have_origins_of_their_own() {
    let folder = tempfile::tempdir().expect("a folder");
    let (near, far) = (plate([0.0; 3]), plate(UTM));
    let file = |vertices: [&[[String; 3]]; 3]| {
        let mut text = String::from("usemtl m\ns 1\n");
        for (number, vertices) in vertices.into_iter().enumerate() {
            // Each group counts its own vertices, backwards from the last.
            writeln!(text, "g part{number}").expect("text");
            for [x, y, z] in vertices {
                writeln!(text, "v {x} {y} {z}\nvt {x} 0.25").expect("text");
            }
            for corners in squares() {
                let back = corners.map(|corner| corner as i32 - (SIDE * SIDE) as i32);
                let words = back.map(|corner| format!("{corner}/{corner}"));
                writeln!(text, "f {}", words.join(" ")).expect("text");
            }
        }
        text
    };
    let wanted = [&near, &far, &near].map(|vertices| truth(&values(vertices)));
    let scene = read(folder.path(), "apart.obj", file([&near, &far, &near]));
    let names: Vec<&str> = scene.meshes.iter().map(|mesh| &*mesh.name).collect();
    assert_eq!(names, ["part0", "part1", "part2"]);
    let origins: Vec<DVec3> =
        scene.instances.iter().map(|placed| placed.world_from_mesh.translation).collect();
    assert_eq!([origins[0], origins[2]], [DVec3::ZERO; 2]);
    assert!(origins[1].y > 4.6e6, "{origins:?}");
    assert_close(&corners(&scene), &wanted.concat(), 1.0, "all parts, in the order of the file");
    // The near group has the same bits as alone; the attributes follow the vertices.
    let alone = read(folder.path(), "alone.obj", file([&near, &near, &near]));
    assert_eq!((alone.meshes.len(), alone.meshes[0].positions.len()), (1, 3 * SIDE * SIDE));
    let count = SIDE * SIDE;
    for mesh in [0, 2] {
        assert_eq!(scene.meshes[mesh].positions, alone.meshes[0].positions[mesh * count..][..count]);
        assert_eq!(
            scene.meshes[mesh].uvs[0].as_deref(),
            alone.meshes[0].uvs[0].as_ref().map(|uvs| &uvs[mesh * count..][..count])
        );
        assert_eq!(
            scene.meshes[mesh].normals.as_deref(),
            alone.meshes[0].normals.as_ref().map(|normals| &normals[mesh * count..][..count])
        );
    }
    // Groups that are near one another, compared with their size, stay one mesh, wherever they are; so do
    // groups with exact coordinates.
    let beside = plate([UTM[0] + 20.0, UTM[1], UTM[2]]);
    let whole = |vertices: &[[f64; 3]]| -> Vec<[String; 3]> {
        vertices.iter().map(|vertex| vertex.map(|x| (x * 10.0).round().to_string())).collect()
    };
    let (small, large) = (whole(&values(&near)), whole(&values(&plate([50_000.0; 3]))));
    for (name, parts) in [("together", [&far, &beside, &far]), ("exact", [&small, &large, &small])] {
        let scene = read(folder.path(), &format!("{name}.obj"), file(parts.map(|part| &part[..])));
        assert_eq!(scene.meshes.len(), 1, "{name}");
    }
}

/// All files of a sequence are placed like the first, whose own coordinates may be whole metres.
#[test]
fn numbered_files_share_an_origin() {
    let folder = tempfile::tempdir().expect("a folder");
    let moved = |step: f64| -> Vec<[f64; 3]> {
        let exact = values(&plate([0.0; 3]));
        let whole = exact.iter().map(|vertex| vertex.map(|x| (x * 10.0).round()));
        whole.map(|vertex| [0, 1, 2].map(|axis| UTM[axis] + vertex[axis] + step)).collect()
    };
    for extension in ["obj", "ply"] {
        for step in 0..3 {
            let vertices = moved(0.001 * f64::from(step));
            let path = folder.path().join(format!("s.{step}.{extension}"));
            let text: Vec<[String; 3]> =
                vertices.iter().map(|vertex| vertex.map(|x| format!("{x:.4}"))).collect();
            let bytes = match extension {
                "obj" => obj(&text, "").into_bytes(),
                _ => ply(&vertices, "double", "binary_little_endian"),
            };
            fs::write(path, bytes).expect("written");
        }
        let options = LoadOptions { fps: 1.0, ..LoadOptions::default() };
        let scene = load(&folder.path().join(format!("s.#.{extension}")), &options).expect("files");
        for step in 0..3 {
            let shown = scene.at(&Moment { seconds: f64::from(step), clips: Vec::new() }).expect("a file");
            let wanted = truth(&moved(0.001 * f64::from(step)));
            assert_close(&corners(&shown), &wanted, 10.0, &format!("{extension} {step}"));
            assert_eq!(shown.instances[0].world_from_mesh, scene.instances[0].world_from_mesh);
        }
    }
}

/// Texture coordinates are derived from such positions, as planar projections make them: whole repeats of a
/// texture have no effect, and cost precision.
#[test]
fn texture_coordinates_far_from_zero_are_what_they_say() {
    let folder = tempfile::tempdir().expect("a folder");
    image::RgbImage::new(2, 2).save(folder.path().join("color.png")).expect("written");
    let corners = "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 500123.456 4649776.654\nvt 500124.456 4649776.654\nvt 500123.456 -0.25\n\
                   vt 500123.456 4649777.654\nusemtl m\nf 1/1 2/2 3/4\n";
    let ply = format!(
        "ply\nformat ascii 1.0\ncomment TextureFile color.png\nelement vertex 3\nproperty float x\nproperty float y\n\
         property float z\nproperty double s\nproperty double t\nelement face 1\n\
         property list uchar int vertex_indices\nend_header\n{}3 0 1 2\n",
        "0 0 0 500123.456 4649776.654\n1 0 0 500124.456 4649776.654\n0 1 0 500123.456 4649777.654\n"
    );
    let obj = |material: &str| {
        fs::write(folder.path().join("m.mtl"), format!("newmtl m\n{material}\n")).expect("written");
        read(folder.path(), "uvs.obj", format!("mtllib m.mtl\n{corners}"))
    };
    let wanted = [[0.456, 1.0 - 0.654], [0.456, 1.0 - 0.654], [0.456, 1.0 - 0.654]];
    for scene in [
        obj("map_Kd color.png"),
        obj("map_Kd -s 3 2 -o 0.1 0.2 color.png\nmap_Ke color.png"),
        read(folder.path(), "uvs.ply", ply),
    ] {
        for (found, wanted) in scene.meshes[0].uvs[0].as_ref().expect("coordinates").iter().zip(wanted) {
            for axis in 0..2 {
                let off = f64::from(found[axis]) - wanted[axis];
                assert!((off - off.round()).abs() < 2.0e-7 && off.abs() < 3.0, "{found:?} for {wanted:?}");
            }
        }
    }
    // Where a texture ends, or is scaled by a fraction, the number itself counts.
    for material in ["map_Kd -clamp on color.png", "map_Kd -s 0.5 1 color.png", "Kd 1 1 1"] {
        let scene = obj(material);
        let found = scene.meshes[0].uvs[0].as_ref().expect("coordinates")[0];
        assert_eq!(found, [500_123.456_f64 as f32, 1.0 - 4_649_776.654_f64 as f32], "{material}");
    }
}
