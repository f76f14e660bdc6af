//! OBJ files that others made, found through `RASRAY_SCENES`.

use std::path::{Path, PathBuf};
use std::time::Instant;

use rasray_scene::default_view::bounds;
use rasray_scene::{AlphaMode, Scene, SceneError};
use rasray_scene_files::{LoadOptions, obj};

use crate::gltf_support::placed_triangles;

fn corpus(test: &str) -> Option<PathBuf> {
    let folder = std::env::var_os("RASRAY_SCENES").map(PathBuf::from);
    if folder.is_none() {
        eprintln!("skipped: {test} needs RASRAY_SCENES");
    }
    folder
}

fn load(path: &Path) -> Result<Scene, SceneError> {
    obj::load(path, &LoadOptions::default())
}

fn has_warning(scene: &Scene, kind: &str) -> bool {
    scene.warnings.iter().any(|warning| warning.kind == kind)
}

#[test]
fn sponza_loads_whole_and_fast() {
    let Some(folder) = corpus("sponza_loads_whole_and_fast") else { return };
    let start = Instant::now();
    let scene = load(&folder.join("architecture/crytek_sponza/sponza.obj")).expect("sponza");
    let seconds = start.elapsed().as_secs_f64();
    eprintln!("sponza: {seconds:.2} s, {} meshes", scene.meshes.len());
    assert_eq!(placed_triangles(&scene), 279_163);
    assert_eq!(scene.materials.len(), 26, "materials that faces use");
    let masked =
        scene.materials.iter().filter(|material| material.alpha_mode == AlphaMode::Mask { cutoff: 0.5 });
    assert_eq!(masked.count(), 3);
    assert!(scene.materials.iter().all(|material| material.metallic == 0.0 && material.specular == 0.0));
    assert!(!has_warning(&scene, "missing-texture"), "{:?}", scene.warnings);
    assert!(scene.meshes.iter().all(|mesh| mesh.normals.is_some() && mesh.uvs[0].is_some()));
    let (low, high) = bounds(&scene).expect("bounds");
    assert!((high - low).max_element() > 3000.0);
    // Twice the promised time: the machine may be shared.
    assert!(seconds < 6.0, "{seconds} s");
}

#[test]
fn the_thorn_mask_cuts_holes() {
    let Some(folder) = corpus("the_thorn_mask_cuts_holes") else { return };
    let scene = load(&folder.join("architecture/crytek_sponza/sponza.obj")).expect("sponza");
    let leaf = scene.materials.iter().find(|material| material.name == "leaf").expect("leaf");
    let texture = leaf.base_color_texture.expect("texture");
    let image = &scene.images[scene.textures[texture.texture].image];
    let alpha: Vec<u8> = image.rgba8.chunks_exact(4).map(|texel| texel[3]).collect();
    let holes = alpha.iter().filter(|alpha| **alpha < 128).count() as f64 / alpha.len() as f64;
    assert!((0.05..0.95).contains(&holes), "{holes}");
}

/// Counts follow from the files' own face lists.
#[test]
fn common_models_have_all_their_triangles() {
    let Some(folder) = corpus("common_models_have_all_their_triangles") else { return };
    let table = [
        ("architecture/medieval_building/Medieval_building.obj", 16_715),
        ("organic/stanford-bunny/stanford-bunny.obj", 69_451),
        ("organic/suzanne/suzanne.obj", 968),
        ("organic/spot/spot.obj", 5_856),
        ("organic/teapot/teapot.obj", 6_320),
        ("organic/beetle_car/beetle-alt.obj", 38_656),
        ("organic/fandisk/fandisk.obj", 12_946),
        ("organic/max_planck_decimated/decimated-max.obj", 10_540),
        ("cornell/cornell_mitsuba/meshes/cbox_smallbox.obj", 12),
    ];
    for (file, count) in table {
        let scene = load(&folder.join(file)).unwrap_or_else(|error| panic!("{error}"));
        assert_eq!(placed_triangles(&scene), count, "{file}: {:?}", scene.warnings);
        assert!(!scene.materials.is_empty());
    }
}

#[test]
fn odd_files_end_as_the_table_says() {
    let Some(folder) = corpus("odd_files_end_as_the_table_says") else { return };
    /// Expected number of triangles and a warning, or a part of the error's message.
    type Outcome<'a> = Result<(usize, &'a str), &'a str>;
    let table: [(&str, Outcome<'_>); 14] = [
        ("cube_compressed.obj", Ok((12, ""))),
        ("empty.obj", Ok((0, "no-triangles"))),
        ("face_in_group_name.obj", Ok((0, "no-triangles"))),
        // The first face refers to normals, and the file has none.
        ("face_in_group_name_mid_file.obj", Err("line 5: normal 1 does not exist")),
        ("jacked.obj", Ok((12, "missing-material-library"))),
        ("negative_indices.obj", Ok((12, ""))),
        ("notenoughindices.obj", Ok((1, "short-faces"))),
        ("obj_with_no_face_in_chunk.obj", Ok((1, "missing-material"))),
        ("polygonfaces.obj", Ok((3, "missing-material-library"))),
        ("singlevn.obj", Ok((2, "missing-material-library"))),
        ("wallhole.obj", Ok((66, "missing-material-library"))),
        ("emptyIO/obj_empty.obj", Ok((0, "no-triangles"))),
        ("emptyIO/obj_points.obj", Ok((0, "no-triangles"))),
        ("emptyIO/obj_wireframe.obj", Ok((0, "points-and-lines"))),
    ];
    for (file, expected) in table {
        let path = folder.join("degenerate/trimesh_odd").join(file);
        match (load(&path), expected) {
            (Ok(scene), Ok((count, kind))) => {
                assert_eq!(placed_triangles(&scene), count, "{file}: {:?}", scene.warnings);
                assert!(kind.is_empty() || has_warning(&scene, kind), "{file}: {:?}", scene.warnings);
            }
            (Err(error), Err(part)) => {
                let message = error.to_string();
                assert!(message.contains(part) && message.contains(file), "{message}");
            }
            (Ok(scene), Err(_)) => panic!("{file} was accepted with {} triangles", placed_triangles(&scene)),
            (Err(error), Ok(_)) => panic!("{error}"),
        }
    }
}
