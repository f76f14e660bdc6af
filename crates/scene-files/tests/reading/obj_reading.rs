//! OBJ and MTL statements one by one, on files written by the tests.

use approx::assert_abs_diff_eq;
use std::fs;
use std::path::PathBuf;

use proptest::prelude::*;
use rasray_scene::{AlphaMode, Scene, SceneError, Wrap};
use rasray_scene_files::{LoadOptions, obj};

/// Makes a folder for this test alone.
fn folder(test: &str) -> PathBuf {
    let folder = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join("obj_reading").join(test);
    fs::create_dir_all(&folder).expect("a folder for the test");
    folder
}

fn read(test: &str, text: impl AsRef<[u8]>) -> Result<Scene, SceneError> {
    let path = folder(test).join("scene.obj");
    fs::write(&path, text).expect("written");
    obj::load(&path, &LoadOptions::default())
}

fn read_with_mtl(test: &str, mtl: &str) -> Result<Scene, SceneError> {
    let folder = folder(test);
    fs::write(folder.join("scene.mtl"), mtl).expect("written");
    let image = |name: &str, texel: [u8; 4], side: u32| {
        let image = image::RgbaImage::from_pixel(side, side, image::Rgba(texel));
        image.save(folder.join(name)).expect("written");
    };
    image("color.png", [200, 100, 50, 255], 4);
    image("grey.png", [64, 64, 64, 255], 8);
    image("cut.png", [255, 255, 255, 30], 2);
    read(
        test,
        "mtllib scene.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\nusemtl m\nf 1/1 2/2 3/3\n",
    )
}

fn warned(scene: &Scene, kind: &str) -> bool {
    scene.warnings.iter().any(|warning| warning.kind == kind)
}

const TRIANGLE: &str = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";

#[test]
fn all_forms_of_corners_are_read() {
    let table = [
        ("f 1 2 3", false, false),
        ("f 1/1 2/2 3/3", true, false),
        ("f 1//1 2//1 3//1", false, true),
        ("f 1/1/1 2/2/1 3/3/1", true, true),
        ("f 1/ 2/ 3/", false, false),
        ("f 1// 2// 3//", false, false),
        ("f -3/-3/-1 -2/-2/-1 -1/-1/-1", true, true),
        ("f 1/1/1 2/2 3/3/1", true, false),
        ("f\t1   2\t3  # a comment", false, false),
        ("f 1 \\\n 2 3", false, false),
        ("fo 1 2 3", false, false),
    ];
    for (place, (face, uvs, normals)) in table.into_iter().enumerate() {
        let text = format!("{TRIANGLE}vt 0 0\nvt 1 0\nvt 0 1\nvn 0 0 1\n{face}\n");
        let scene = read(&format!("forms-{place}"), text).unwrap_or_else(|error| panic!("{face}: {error}"));
        let mesh = &scene.meshes[0];
        assert_eq!(mesh.positions, [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]], "{face}");
        assert_eq!(mesh.indices, [0, 1, 2], "{face}");
        assert_eq!((mesh.uvs[0].is_some(), mesh.normals.is_some()), (uvs, normals), "{face}");
        if let Some(uvs) = &mesh.uvs[0] {
            assert_eq!(
                uvs[..],
                [[0.0, 1.0], [1.0, 1.0], [0.0, 0.0]],
                "v counts from the bottom of the image"
            );
        }
    }
}

#[test]
fn polygons_are_fans_from_the_first_corner_in_file_order() {
    let scene =
        read("fans", "v 0 0 0\nv 1 0 0\nv 2 1 0\nv 1 2 0\nv 0 1 0\nf 3 4 5 1 2\nf 1 2 3\n").expect("scene");
    let mesh = &scene.meshes[0];
    // Vertices in the order of their first use: 3 4 5 1 2.
    assert_eq!(mesh.positions[0], [2.0, 1.0, 0.0]);
    assert_eq!(mesh.indices, [0, 1, 2, 0, 2, 3, 0, 3, 4, 3, 4, 0]);
}

#[test]
fn vertices_are_shared_where_all_three_indices_agree() {
    let text = format!("{TRIANGLE}v 1 1 0\nvt 0 0\nvt 1 1\nf 1/1 2/1 3/1\nf 2/1 4/1 3/2\n");
    let scene = read("shared", text).expect("scene");
    let mesh = &scene.meshes[0];
    assert_eq!(mesh.indices, [0, 1, 2, 1, 3, 4]);
    assert_eq!(mesh.positions[2], mesh.positions[4]);
}

#[test]
fn materials_split_meshes_in_file_order() {
    let text = format!(
        "{TRIANGLE}o part\nusemtl a\nf 1 2 3\nusemtl b\nf 3 2 1\nusemtl b\nf 1 3 2\nusemtl a\nf 2 3 1\nusemtl unused\n"
    );
    let scene = read("materials", text).expect("scene");
    let materials: Vec<_> = scene.meshes.iter().map(|mesh| mesh.material).collect();
    assert_eq!(materials, [0, 1, 0]);
    assert_eq!(scene.meshes[1].triangle_count(), 2);
    assert_eq!(scene.materials.len(), 2, "only what faces use");
    assert_eq!(scene.instances.len(), 3);
    let names: Vec<_> = scene.instances.iter().map(|instance| &*instance.name).collect();
    assert_eq!(names, ["part", "part 2", "part 3"]);
    assert!(warned(&scene, "missing-material"));
}

#[test]
fn attributes_that_come_and_go_split_meshes_too() {
    let text = format!("{TRIANGLE}vn 0 0 1\nf 1//1 2//1 3//1\nf 1 2 3\nf 3//1 2//1 1//1\n");
    let scene = read("attributes", text).expect("scene");
    let normals: Vec<_> = scene.meshes.iter().map(|mesh| mesh.normals.is_some()).collect();
    assert_eq!(normals, [true, false, true]);
    assert!(scene.meshes.iter().all(|mesh| mesh.material == 0));
}

#[test]
fn bad_lines_are_errors_that_name_file_and_line() {
    let table = [
        ("v 0 0", "line 1: `v` needs 3 numbers"),
        ("v 0 0 zero", "line 1: `zero` is not a number"),
        ("v 0,5 0 0", "line 1: `0,5` is not a number"),
        ("\n\nvn 1 0", "line 3"),
        ("v 0 0 0\nf 1 1 2", "line 2: vertex index 2, but there are only 1 vertices"),
        ("v 0 0 0\nf 1 1 0", "line 2: vertex 0 does not exist"),
        ("v 0 0 0\nf 1 1 -2", "line 2: vertex -2 does not exist"),
        ("v 0 0 0\nf 1/1 1/1 1/1", "line 2: texture coordinate 1 does not exist"),
        ("v 0 0 0\nf 1 1 x", "line 2: `x` is not a corner"),
        ("v 0 0 0\nf 1/2/3/4 1 1", "line 2"),
        ("v 0 0 0\nvt 0 0\nf /1 1 1", "line 3: `/1` is not a corner"),
        ("v 0 0 0\nf 99999999999999999999 1 1", "line 2"),
    ];
    for (place, (text, part)) in table.into_iter().enumerate() {
        let error =
            read(&format!("bad-{place}"), text).err().unwrap_or_else(|| panic!("{text} was accepted"));
        let message = error.to_string();
        assert!(message.contains(part) && message.contains("scene.obj"), "{text}: {message}");
    }
}

#[test]
fn numbers_that_are_not_finite_drop_their_triangles() {
    let text = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv nan 0 0\nv 1e39 0 0\nv -1.#IND 0 0\nf 1 2 3\nf 1 2 4\nf 1 2 5\nf 1 2 6\n";
    let scene = read("not-finite", text).expect("scene");
    assert_eq!(scene.meshes[0].triangle_count(), 1);
    assert!(!scene.warnings.is_empty());
    assert!(scene.meshes[0].positions.iter().flatten().all(|value| value.is_finite()));
}

#[test]
fn line_ends_byte_order_marks_and_foreign_bytes_are_tolerated() {
    let with_ends = |end: &str| format!("{TRIANGLE}f 1 2 3\n").replace('\n', end);
    for (place, text) in [
        with_ends("\r\n").into_bytes(),
        with_ends("\r").into_bytes(),
        [b"\xEF\xBB\xBF".to_vec(), with_ends("\n").into_bytes()].concat(),
        [b"o caf\xE9\n# \xFF\n".to_vec(), with_ends("\n").into_bytes()].concat(),
        with_ends("\n").trim_end().to_owned().into_bytes(),
    ]
    .into_iter()
    .enumerate()
    {
        let scene = read(&format!("ends-{place}"), text).expect("scene");
        assert_eq!(scene.meshes[0].triangle_count(), 1, "{place}");
    }
}

#[test]
fn limits_are_kept() {
    let path = folder("limits").join("scene.obj");
    fs::write(&path, format!("{TRIANGLE}f 1 2 3 1 2 3\n")).expect("written");
    let mut options = LoadOptions::default();
    options.limits.triangles = 3;
    let error = obj::load(&path, &options).expect_err("four triangles");
    assert!(matches!(error, SceneError::TooLarge { option: "triangles", found: 4, .. }), "{error}");
    options = LoadOptions::default();
    options.limits.file_bytes = 10;
    assert!(matches!(obj::load(&path, &options), Err(SceneError::TooLarge { option: "file_bytes", .. })));
    options = LoadOptions::default();
    options.limits.vertices = 2;
    assert!(matches!(obj::load(&path, &options), Err(SceneError::TooLarge { option: "vertices", .. })));
}

#[test]
fn a_plain_material_is_translated() {
    let scene = read_with_mtl(
        "plain",
        "newmtl m\nKd 0.1 0.2 0.3\nKs 0.25 0.5 0.0\nNs 30\nKe 1 2 3\nNi 1.33\nillum 2\nd 1\nTr 0\n",
    )
    .expect("scene");
    let material = &scene.materials[0];
    assert_eq!(material.name, "m");
    assert_eq!(material.base_color, [0.1, 0.2, 0.3, 1.0]);
    assert_eq!((material.metallic, material.specular), (0.0, 0.5));
    assert_eq!(material.specular_color, [0.5, 1.0, 0.0]);
    assert_abs_diff_eq!(material.roughness, 0.5, epsilon = 1.0e-6);
    assert_eq!(material.emission, [1.0, 2.0, 3.0]);
    assert_eq!(material.ior, 1.33);
    assert_eq!((material.transmission, material.alpha_mode), (0.0, AlphaMode::Opaque));
    assert!(scene.warnings.is_empty(), "{:?}", scene.warnings);
}

#[test]
fn opacity_glass_and_mirrors() {
    let material = |name: &str, mtl: &str| read_with_mtl(name, mtl).expect("scene").materials.remove(0);
    for (name, mtl) in [
        ("d", "newmtl m\nd 0.25\n"),
        ("tr", "newmtl m\nTr 0.75\n"),
        ("both", "newmtl m\nTr 0\nd 0.25\nTr 1\n"),
    ] {
        let material = material(name, mtl);
        assert_eq!((material.alpha_mode, material.base_color[3]), (AlphaMode::Blend, 0.25), "{mtl}");
    }
    let glass = material("glass", "newmtl m\nKd 0 0 0\nTf 0.9 1 0.9\nillum 7\nNi 1.5\n");
    assert_eq!((glass.transmission, glass.roughness, glass.specular), (1.0, 0.0, 1.0));
    assert_eq!(glass.base_color[..3], [0.9, 1.0, 0.9]);
    assert!(glass.thickness > 0.0);
    assert_eq!(material("pane", "newmtl m\nillum 4\n").thickness, 0.0);
    let mirror = material("mirror", "newmtl m\nKd 0 0 0\nKs 0.9 0.9 0.9\nillum 3\n");
    assert_eq!((mirror.metallic, mirror.roughness, mirror.base_color[0]), (1.0, 0.0, 0.9));
}

#[test]
fn masks_and_colours_become_one_image() {
    let scene = read_with_mtl("mask", "newmtl m\nmap_Kd color.png\nmap_d grey.png\n").expect("scene");
    assert_eq!(scene.materials[0].alpha_mode, AlphaMode::Mask { cutoff: 0.5 });
    assert_eq!(scene.images.len(), 1);
    let image = &scene.images[0];
    assert_eq!((image.width, image.height), (8, 8), "the larger of the two");
    assert!(image.rgba8.chunks_exact(4).all(|texel| texel == [200, 100, 50, 64]));

    let scene = read_with_mtl("own-alpha", "newmtl m\nmap_d cut.png\n").expect("scene");
    assert_eq!(scene.images[0].rgba8[..4], [255, 255, 255, 30], "its own alpha cuts, not its brightness");

    let scene = read_with_mtl("lost-mask", "newmtl m\nmap_Kd color.png\nmap_d gone.png\n").expect("scene");
    assert_eq!(scene.materials[0].alpha_mode, AlphaMode::Opaque);
    assert!(warned(&scene, "missing-texture"));
}

#[test]
fn texture_options_names_and_folders() {
    let scene = read_with_mtl(
        "options",
        "newmtl m\nmap_Kd -s 2 4 1 -o 0.25 0.5 0 -clamp on .\\color.png\nKe 0 0 0\nmap_Ke color.png\n",
    )
    .expect("scene");
    let material = &scene.materials[0];
    let color = material.base_color_texture.expect("texture");
    assert_eq!(color.uv_transform, [[2.0, 0.0, 0.25], [0.0, 4.0, 1.0 - 4.0 - 0.5]]);
    assert_eq!(scene.textures[color.texture].wrap_u, Wrap::Clamp);
    let emission = material.emission_texture.expect("texture");
    assert_eq!(scene.textures[emission.texture].wrap_u, Wrap::Repeat);
    assert_eq!(material.emission, [1.0; 3]);
    assert_eq!(scene.images.len(), 1, "the same file twice is one image");

    let folder = folder("spaces");
    image::RgbaImage::new(1, 1).save(folder.join("my color.png")).expect("written");
    let scene = read_with_mtl("spaces", "newmtl m\nmap_Kd my color.png\n").expect("scene");
    assert_eq!(scene.images.len(), 1, "{:?}", scene.warnings);
}

#[test]
fn what_is_not_supported_is_named() {
    let table = [
        ("map_Kd gone.png", "missing-texture"),
        ("map_Kd scene.mtl", "unreadable-texture"),
        ("map_Ks color.png", "unsupported-material-statements"),
        ("map_Bump -bm 0.3 color.png", "height-map"),
        ("bump color.png", "height-map"),
        ("Kd 0 0 0\nmap_Kd color.png", "black-diffuse"),
        ("Kd spectral file.rfl", "unsupported-material-statements"),
        ("map_Kd -mm 0 2 color.png", "unsupported-material-statements"),
    ];
    for (place, (line, kind)) in table.into_iter().enumerate() {
        let scene = read_with_mtl(&format!("named-{place}"), &format!("newmtl m\n{line}\n")).expect("scene");
        assert!(warned(&scene, kind), "{line}: {:?}", scene.warnings);
        assert_eq!(scene.meshes[0].triangle_count(), 1);
    }
    for (place, line) in ["Kd 1 two 3", "Ns", "Ke inf 0 0", "d nan"].into_iter().enumerate() {
        let error = read_with_mtl(&format!("wrong-{place}"), &format!("newmtl m\n{line}\n")).expect_err(line);
        assert!(error.to_string().contains("scene.mtl: line 2"), "{error}");
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 64, failure_persistence: None, ..ProptestConfig::default() })]

    /// Written meshes are read back: positions in order of use, triangles in file order.
    #[test]
    fn written_meshes_are_read_back(
        points in prop::collection::vec(prop::array::uniform3(-1.0e3_f32..1.0e3), 3..40),
        picks in prop::collection::vec(prop::array::uniform3(0_usize..1000), 1..40),
        backwards in any::<bool>(),
    ) {
        let mut text: String = points.iter().map(|[x, y, z]| format!("v {x} {y} {z}\n")).collect();
        let count = points.len();
        let faces: Vec<[usize; 3]> = picks.iter().map(|pick| pick.map(|index| index % count)).collect();
        for face in &faces {
            let corner = |index: usize| if backwards { index as i64 - count as i64 } else { index as i64 + 1 };
            let [a, b, c] = face.map(corner);
            text.push_str(&format!("f {a} {b} {c}\n"));
        }
        let name = format!("property-{:x}", text.len() * 2 + usize::from(backwards));
        let scene = read(&name, text).expect("scene");
        let mesh = &scene.meshes[0];
        prop_assert_eq!(mesh.triangle_count(), faces.len());
        for (indices, face) in mesh.indices.chunks_exact(3).zip(&faces) {
            for (index, original) in indices.iter().zip(face) {
                prop_assert_eq!(mesh.positions[*index as usize], points[*original]);
            }
        }
    }

    /// Any bytes get an answer.
    #[test]
    fn random_statements_never_panic(
        lines in prop::collection::vec("(v|vt|vn|f|usemtl|mtllib|o|g|s|l|#|junk) ?[-0-9./ \\\\aeinf#]{0,24}", 0..20),
    ) {
        let text = lines.join("\n");
        let _ = read("random", text);
    }
}
