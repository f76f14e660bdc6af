//! Exporters' dialects of materials, references and smoothing groups of OBJ files.

use std::fs;
use std::path::Path;

use approx::assert_abs_diff_eq;
use rasray_scene::{AlphaMode, Material, Scene};
use rasray_scene_files::{LoadOptions, load};

const TRIANGLE: &str = "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\nusemtl m\nf 1/1 2/2 3/3\n";

fn read(folder: &Path, text: &str) -> Scene {
    let path = folder.join("scene.obj");
    fs::write(&path, text).expect("written");
    load(&path, &LoadOptions::default()).unwrap_or_else(|error| panic!("{error}"))
}

fn with_material(folder: &Path, lines: &str) -> Scene {
    fs::write(folder.join("scene.mtl"), format!("newmtl m\n{lines}\n")).expect("written");
    read(folder, &format!("mtllib scene.mtl\n{TRIANGLE}"))
}

fn kinds(scene: &Scene) -> Vec<&'static str> {
    scene.warnings.iter().map(|warning| warning.kind).collect()
}

fn image(folder: &Path, name: &str) {
    image::RgbImage::from_pixel(2, 2, image::Rgb([200, 100, 50])).save(folder.join(name)).expect("written");
}

fn is_opaque(material: &Material) -> bool {
    material.transmission == 0.0 && material.alpha_mode == AlphaMode::Opaque
}

/// Blender writes `illum 9` for an alpha below 1, and 6 for such a metal.
#[test]
fn faded_surfaces_of_blender_are_no_glass() {
    let folder = tempfile::tempdir().expect("a folder");
    let blender = "Ns 250.000000\nKa 1.000000 1.000000 1.000000\nKd 0.800000 0.020000 0.020000\n\
                   Ks 0.500000 0.500000 0.500000\nKe 0.000000 0.000000 0.000000\nNi 1.500000\nd 0.300000\nillum 9";
    for lines in [
        blender.to_owned(),
        blender.replace("illum 9", "illum 6"),
        blender.replace("illum 9", "illum 4"),
        blender.replace("illum 9", "illum 7"),
        blender.replace("d 0.300000", "Tr 0.7"),
        blender.replace("Ni 1.500000\n", ""),
        format!("{blender}\nTf 0 0 0"),
    ] {
        let scene = with_material(folder.path(), &lines);
        let material = &scene.materials[0];
        assert_eq!((material.transmission, material.alpha_mode), (0.0, AlphaMode::Blend), "{lines}");
        assert_eq!(material.base_color[..3], [0.8, 0.02, 0.02]);
        assert_abs_diff_eq!(material.base_color[3], 0.3, epsilon = 1.0e-6);
        assert!(scene.warnings.is_empty(), "{:?}", scene.warnings);
    }
    let mirror = with_material(folder.path(), "Kd 0 0 0\nKs 0.9 0.9 0.9\nillum 3\nd 0.25");
    assert_eq!((mirror.materials[0].metallic, mirror.materials[0].base_color), (1.0, [0.9, 0.9, 0.9, 0.25]));
    assert_eq!(mirror.materials[0].alpha_mode, AlphaMode::Blend);
    // The colour may come from a texture.
    image(folder.path(), "color.png");
    let textured = with_material(folder.path(), "Kd 0 0 0\nmap_Kd color.png\nNi 1.45\nd 0.5\nillum 9");
    assert_eq!((textured.materials[0].transmission, textured.materials[0].base_color[3]), (0.0, 0.5));
}

/// Maya writes these statements for opaque surfaces.
#[test]
fn opaque_surfaces_of_maya_are_no_glass() {
    let folder = tempfile::tempdir().expect("a folder");
    for lines in [
        "illum 4\nKd 0.50 0.40 0.30\nKa 0.00 0.00 0.00\nTf 1.00 1.00 1.00\nNi 1.00",
        "illum 4\nKd 0.50 0.40 0.30\nTf 1.00 1.00 1.00\nNi 1.00\nKs 0.5 0.5 0.5\nNs 18.00",
        "illum 4\nKd 0.50 0.40 0.30",
        "illum 7\nKd 0.50 0.40 0.30\nNi 1\nd 1",
    ] {
        let scene = with_material(folder.path(), lines);
        assert!(is_opaque(&scene.materials[0]), "{lines}");
        assert_eq!(scene.materials[0].base_color[..3], [0.5, 0.4, 0.3]);
        assert!(!lines.contains("Ks") || scene.materials[0].ior == 1.5, "its Ks is seen");
        assert!(scene.warnings.is_empty(), "{:?}", scene.warnings);
    }
}

#[test]
fn glass_stays_glass() {
    let folder = tempfile::tempdir().expect("a folder");
    for (lines, color, said) in [
        ("Kd 0 0 0\nTf 0.9 1 0.9\nillum 7\nNi 1.5", [0.9, 1.0, 0.9], false),
        ("Kd 0 0 0\nKs 1 1 1\nNi 1.5\nd 0.1\nillum 7", [1.0; 3], true),
        ("Kd 0 0 0\nNi 1.5\nd 0\nillum 9", [1.0; 3], false),
        ("Kd 0.1 0.1 0.1\nTf 0.9 0.8 0.7\nNi 1.5\nd 0.2\nillum 6", [0.9, 0.8, 0.7], true),
        ("Kd 0.1 0.1 0.1\nTf 1 1 1\nNi 1.5\nd 1\nillum 4", [1.0; 3], true),
        ("Kd 0.6 0.1 0.1\nNi 1.5\nd 1\nillum 7", [1.0; 3], true),
        ("Kd 0.6 0.1 0.1\nNi 1.5\nd 0\nillum 7", [1.0; 3], true),
        ("illum 4", [1.0; 3], false),
    ] {
        let scene = with_material(folder.path(), lines);
        let material = &scene.materials[0];
        assert_eq!((material.transmission, material.alpha_mode), (1.0, AlphaMode::Opaque), "{lines}");
        assert_eq!(material.base_color[..3], color, "{lines}");
        assert_eq!(kinds(&scene), vec!["transparency"; usize::from(said)], "{lines}: {:?}", scene.warnings);
    }
    let scene = with_material(folder.path(), "illum 7\nKd 0.6 0.1 0.1\nTf 0.5 0.5 0.5\nNi 1.5\nd 0.5");
    assert!(
        scene.warnings[0]
            .message
            .contains("material m: is glass, coloured by Tf alone: its Kd and d are not shown")
    );
}

/// Each statement of a material that has no effect is named in a remark.
#[test]
fn what_a_material_says_beyond_the_model_is_named() {
    let folder = tempfile::tempdir().expect("a folder");
    image(folder.path(), "color.png");
    for (lines, kind, words) in [
        ("Tf 0.5 0.5 0.5\nillum 2", "transparency", "its Tf is not shown"),
        ("d 0.5\nmap_d color.png", "transparency", "beside a map_d"),
        ("Kd 2 0 0", "material-range", "Kd is 2, not from 0 to 1"),
        ("Ks 0 -1 0", "material-range", "Ks is -1"),
        ("Ke 1 -1 0", "material-range", "Ke is -1"),
        ("d 7", "material-range", "d or 1 - Tr is 7"),
        ("Ni 0.5", "material-range", "Ni is 0.5, not from 1 to 10; it was taken as 1.5"),
        ("map_Ka color.png", "ambient-map", "write map_Kd"),
        ("map_Kd -blendu off color.png", "unsupported-material-statements", "map_kd -blendu off"),
        (
            "Ps 0.5\nPc 1\nPcr 0.1\naniso 0.5\nanisor 0.5",
            "unsupported-material-statements",
            "aniso (1), anisor (1), pc (1), pcr (1), ps (1)",
        ),
        (
            "map_Pr color.png\nmap_Pm color.png\nrefl -type sphere color.png\ndecal color.png\ndisp color.png\nmap_aat on",
            "unsupported-material-statements",
            "decal (1), disp (1), map_aat (1), map_pm (1), map_pr (1), refl (1)",
        ),
        (
            "map_Kd -bm 2 -boost 3 -texres 64 -imfchan r -cc on -t 1 1 1 color.png",
            "unsupported-material-statements",
            "-imfchan",
        ),
    ] {
        let scene = with_material(folder.path(), lines);
        let lower = |text: &str| text.to_ascii_lowercase();
        let found = scene.warnings.iter().find(|warning| warning.kind == kind);
        let found = found.unwrap_or_else(|| panic!("{lines}: {:?}", scene.warnings));
        assert!(lower(&found.message).contains(&lower(words)), "{lines}: {}", found.message);
    }
}

#[test]
fn metallic_roughness_numbers_and_strengths_are_read() {
    let folder = tempfile::tempdir().expect("a folder");
    image(folder.path(), "normal.png");
    let scene =
        with_material(folder.path(), "Kd 0.9 0.6 0.2\nNs 10\nPr 0.25\nPm 1.0\nnorm -bm 0.5 normal.png");
    assert!(scene.warnings.is_empty(), "{:?}", scene.warnings);
    let material = &scene.materials[0];
    assert_eq!((material.roughness, material.metallic, material.normal_scale), (0.25, 1.0, 0.5));
    assert!(material.normal_texture.is_some());
}

/// A texture that is named by a path of another machine is looked for beside the scene, and nowhere else.
#[test]
fn references_that_lead_outside_are_never_followed() {
    let above = tempfile::tempdir().expect("a folder");
    let folder = above.path().join("scene");
    fs::create_dir_all(&folder).expect("a folder");
    image(above.path(), "above.png");
    let absolute = above.path().join("above.png").display().to_string();
    for name in [
        "C:\\Users\\me\\Assets\\wood.png",
        "c:/wood.png",
        "C:wood.png",
        "\\\\server\\share\\wood.png",
        "/home/me/my textures/wood.png",
        "file:///wood.png",
        "a/../../wood.png",
        "..",
        "../above.png",
        &absolute,
    ] {
        for statement in ["map_Kd", "map_d", "map_Ke", "norm"] {
            let scene = with_material(&folder, &format!("{statement} {name}"));
            assert_eq!(kinds(&scene), ["missing-texture"], "{statement} {name}");
            assert!(scene.images.is_empty() && scene.files.len() == 1, "{:?}", scene.files);
            let message = &scene.warnings[0].message;
            assert!(message.contains(name) && message.contains("beside the scene"), "{message}");
        }
    }
    image(&folder, "wood.png");
    for name in [
        "C:\\Users\\me\\Assets\\wood.png",
        "C:wood.png",
        "\\\\server\\wood.png",
        "/a b/wood.png",
        "../wood.png",
    ] {
        let scene = with_material(&folder, &format!("map_Kd {name}\nmap_Ke {name}\nKe 1 1 1"));
        assert_eq!((kinds(&scene), scene.images.len()), (vec!["texture-elsewhere"], 1), "{name}");
        assert!(scene.materials[0].base_color_texture.is_some());
        assert_eq!(scene.files[1], folder.join("wood.png"));
    }
    // A reference below the folder works as before.
    let scene = with_material(&folder, "map_Kd .\\wood.png");
    assert!(scene.warnings.is_empty(), "{:?}", scene.warnings);
}

#[test]
fn libraries_that_lead_outside_are_looked_for_beside_the_scene() {
    let above = tempfile::tempdir().expect("a folder");
    let folder = above.path().join("scene");
    fs::create_dir_all(&folder).expect("a folder");
    fs::write(above.path().join("other.mtl"), "newmtl m\nKd 1 0 0\n").expect("written");
    for name in ["../other.mtl", "/etc/passwd", "C:\\Users\\me\\my models\\other.mtl"] {
        let scene = read(&folder, &format!("mtllib {name}\n{TRIANGLE}"));
        assert!(kinds(&scene).contains(&"missing-material-library"), "{name}: {:?}", scene.warnings);
        assert!(kinds(&scene).contains(&"missing-material") && scene.files.is_empty());
    }
    fs::write(folder.join("other.mtl"), "newmtl m\nKd 0 1 0\n").expect("written");
    for name in ["../other.mtl", "/etc/other.mtl", "C:\\Users\\me\\my models\\other.mtl"] {
        let scene = read(&folder, &format!("mtllib {name}\n{TRIANGLE}"));
        assert_eq!((kinds(&scene), scene.files.len()), (vec!["library-elsewhere"], 1), "{name}");
        assert_eq!(scene.materials[0].base_color, [0.0, 1.0, 0.0, 1.0], "the one beside the scene");
    }
}

/// Two squares that meet at a right angle.
const ROOF: &str = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\n";

#[test]
fn smoothing_groups_make_normals() {
    let folder = tempfile::tempdir().expect("a folder");
    let normals = |text: &str| {
        let scene = read(folder.path(), &format!("{ROOF}{text}"));
        assert!(scene.warnings.is_empty(), "{:?}", scene.warnings);
        let all = scene.meshes.iter().map(|mesh| {
            let normals = mesh.normals.clone();
            normals.map(|normals| {
                mesh.indices.iter().map(|&corner| normals[corner as usize]).collect::<Vec<_>>()
            })
        });
        all.collect::<Vec<_>>()
    };
    let half = std::f32::consts::FRAC_1_SQRT_2;
    let (up, front, edge) = ([0.0, 0.0, 1.0], [0.0, 1.0, 0.0], [0.0, half, half]);
    // The edge is between the vertices 1 and 2.
    let smooth = normals("s 1\nf 1 2 3 4\nf 1 5 6 2\n");
    let near = |found: &[[f32; 3]], wanted: &[[f32; 3]]| {
        assert_eq!(found.len(), wanted.len());
        for (found, wanted) in found.iter().flatten().zip(wanted.iter().flatten()) {
            assert_abs_diff_eq!(found, wanted, epsilon = 1.0e-6);
        }
    };
    let wanted = [edge, edge, up, edge, up, up, edge, front, front, edge, front, edge];
    near(smooth[0].as_ref().expect("normals"), &wanted);
    // Smoothing also crosses borders of materials.
    let across =
        normals("s on\nf 1 2 3 4\nusemtl other\nf 1 5 6 2\n".replace("usemtl other\n", "g part\n").as_str());
    near(across[0].as_ref().expect("normals"), &wanted);
    // Another group has other normals; faces without a group are flat.
    let apart = normals("s 1\nf 1 2 3 4\ns 2\nf 1 5 6 2\n");
    near(apart[0].as_ref().expect("normals"), &[[up; 6], [front; 6]].concat());
    for off in ["", "s off\n", "s 0\n", "s 1\ns off\n"] {
        assert_eq!(normals(&format!("{off}f 1 2 3 4\nf 1 5 6 2\n")), [None]);
    }
    let both = normals("s 1\nf 1 2 3 4\ns 0\nf 1 5 6 2\n");
    near(both[0].as_ref().expect("normals"), &[up; 6]);
    assert_eq!(both[1], None);
    // Normals of the file take precedence.
    let given = normals("vn 1 0 0\ns 1\nf 1//1 2//1 3//1 4//1\n");
    assert_eq!(given, [Some(vec![[1.0, 0.0, 0.0]; 6])]);
}

#[test]
fn smoothing_reaches_across_materials() {
    let folder = tempfile::tempdir().expect("a folder");
    fs::write(folder.path().join("two.mtl"), "newmtl a\nnewmtl b\n").expect("written");
    let text = format!("mtllib two.mtl\n{ROOF}s 3\nusemtl a\nf 1 2 3 4\nusemtl b\nf 1 5 6 2\n");
    let scene = read(folder.path(), &text);
    assert_eq!(scene.meshes.len(), 2);
    for mesh in &scene.meshes {
        let normals = mesh.normals.as_ref().expect("normals");
        let shared = mesh.positions.iter().zip(normals).filter(|(position, _)| position[1..] == [0.0, 0.0]);
        for (_, normal) in shared {
            assert_abs_diff_eq!(normal[1], normal[2], epsilon = 1.0e-6);
        }
    }
}

#[test]
fn statements_that_are_not_read_are_named() {
    let folder = tempfile::tempdir().expect("a folder");
    let text = "v 0 0 0 1\nv 1 0 0 1.0\nv 0 1 0 0.5\nvn 0 0 1\nvp 0 0\nvp 1 1\ncstype bezier\ncurv 0 1 1 2\nbevel on\nlod 3\n\
                mg 1 2\nf 1//1 2//1 3\n";
    let scene = read(folder.path(), text);
    let message = |kind: &str| {
        let found = scene.warnings.iter().find(|warning| warning.kind == kind);
        &*found.unwrap_or_else(|| panic!("{kind}: {:?}", scene.warnings)).message
    };
    let unknown = message("unknown-statements");
    assert!(unknown.starts_with("7 statements") && unknown.contains("`vp` in line 5"), "{unknown}");
    assert!(unknown.ends_with("bevel (1), cstype (1), curv (1), lod (1), mg (1), vp (2)"), "{unknown}");
    assert!(message("vertex-weights").starts_with("1 vertices"));
    assert!(message("partial-attributes").starts_with("1 faces"));
    assert!(scene.meshes[0].normals.is_none());
}
