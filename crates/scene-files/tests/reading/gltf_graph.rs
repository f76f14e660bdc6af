//! Nodes: transforms multiplied in f64, scene order, and graphs with faults.

use approx::assert_abs_diff_eq;
use std::fmt::Write;
use std::path::Path;

use crate::gltf_support::{kinds, load_bytes, triangle_gltf};
use glam::DVec3;
use rasray_scene::{Scene, SceneError};
use rasray_scene_files::{LoadOptions, SceneChoice, gltf};

fn load_nodes(nodes: &str) -> Scene {
    load_bytes(triangle_gltf(nodes, "", "").as_bytes()).expect("a good file")
}

/// Makes a chain of `count` nodes of the given transform; the last holds the mesh.
fn chain(count: usize, transform: &str) -> String {
    let mut nodes = String::from("[");
    for i in 0..count {
        let end =
            if i + 1 < count { format!(r#""children":[{}]}},"#, i + 1) } else { r#""mesh":0}"#.to_owned() };
        write!(nodes, "{{{transform},{end}").expect("writing to a string cannot fail");
    }
    nodes + "]"
}

fn with_depth(depth: u64) -> LoadOptions {
    let mut options = LoadOptions::default();
    options.limits.depth = depth;
    options
}

/// A thousand steps around a regular polygon end where they began. In f32 the products drift by
/// about 1e-4; in f64 by less than 1e-10.
#[test]
fn long_chains_are_multiplied_in_f64() {
    let half = std::f64::consts::PI / 1000.0;
    let transform =
        format!(r#""translation":[1,0,0],"rotation":[0,0,{:.17},{:.17}]"#, half.sin(), half.cos());
    let file = triangle_gltf(&chain(1000, &transform), "", "");
    let scene =
        gltf::from_slice(Path::new("chain.gltf"), file.as_bytes(), &with_depth(1000)).expect("a good file");
    let world = scene.instances[0].world_from_mesh;
    assert!(world.translation.length() < 1e-10, "{}", world.translation);
    assert!((world.matrix3.x_axis - DVec3::X).length() < 1e-12, "{}", world.matrix3);
    // The steps as matrices.
    let (sin, cos) = (2.0 * half).sin_cos();
    let transform =
        format!(r#""matrix":[{cos:.17},{sin:.17},0,0,{:.17},{cos:.17},0,0,0,0,1,0,1,0,0,1]"#, -sin);
    let file = triangle_gltf(&chain(1000, &transform), "", "");
    let scene =
        gltf::from_slice(Path::new("chain.gltf"), file.as_bytes(), &with_depth(1000)).expect("a good file");
    let world = scene.instances[0].world_from_mesh;
    assert!(world.translation.length() < 1e-10, "{}", world.translation);
    assert!((world.matrix3.x_axis - DVec3::X).length() < 1e-12, "{}", world.matrix3);
    // Half turns with a mirror: the product of an even number is exactly the identity.
    let mirrored = r#""matrix":[-1,0,0,0,0,1,0,0,0,0,1,0,0,0,0,1],"name":"mirror""#;
    let file = triangle_gltf(&chain(999, mirrored), "", "");
    let scene =
        gltf::from_slice(Path::new("chain.gltf"), file.as_bytes(), &with_depth(1000)).expect("a good file");
    assert_eq!(scene.instances[0].world_from_mesh.matrix3.determinant(), -1.0);
}

#[test]
fn numbers_keep_the_precision_of_the_file() {
    let scene = load_nodes(r#"[{"mesh":0,"translation":[1000000.123456789,0,-3e200]}]"#);
    let place = scene.instances[0].world_from_mesh.translation;
    assert_eq!(place, DVec3::new(1_000_000.123_456_789, 0.0, -3e200));
}

#[test]
fn mirrored_and_singular_transforms_are_kept() {
    let scene =
        load_nodes(r#"[{"mesh":0,"scale":[-1,1,1]},{"mesh":0,"scale":[1,1,0]},{"mesh":0,"scale":[0,0,0]}]"#);
    assert_eq!(scene.meshes.len(), 1);
    assert_eq!(scene.meshes[0].indices, [0, 1, 2], "the winding is that of the file");
    let determinants: Vec<f64> =
        scene.instances.iter().map(|instance| instance.world_from_mesh.matrix3.determinant()).collect();
    assert_eq!(determinants, [-1.0, 0.0, 0.0]);
}

#[test]
fn matrices_and_parts_agree() {
    let scene = load_nodes(
        r#"[{"mesh":0,"translation":[1,2,3],"rotation":[0,0,2,2],"scale":[2,3,4]},
        {"mesh":0,"matrix":[0,2,0,0,-3,0,0,0,0,0,4,0,1,2,3,1]}]"#,
    );
    let [parts, matrix] = [0, 1].map(|i: usize| scene.instances[i].world_from_mesh);
    assert_abs_diff_eq!(parts, matrix, epsilon = 1e-15);
}

#[test]
fn a_place_that_overflows_drops_the_instance() {
    let scene =
        load_nodes(r#"[{"scale":[1e200,1,1],"children":[1]},{"scale":[1e200,1,1],"mesh":0},{"mesh":0}]"#);
    assert_eq!((scene.instances.len(), kinds(&scene)), (1, vec!["non-finite-instances"]));
    let scene = load_nodes(r#"[{"mesh":0,"rotation":[0,0,0,0]}]"#);
    assert_eq!((scene.instances.len(), kinds(&scene)), (1, vec!["bad-rotation"]));
}

#[test]
fn depth_is_bounded() {
    let deep = |count| load_bytes(triangle_gltf(&chain(count, r#""scale":[1,1,1]"#), "", "").as_bytes());
    assert!(deep(512).is_ok());
    for count in [513, 100_000] {
        let error = deep(count);
        assert!(matches!(error, Err(SceneError::TooLarge { option: "depth", .. })), "{count}: {error:?}");
    }
}

#[test]
fn graphs_that_are_no_forest_are_refused() {
    let cases = [
        (r#"[{"children":[0]}]"#, "its own ancestor"),
        (r#"[{"children":[1]},{"children":[2]},{"children":[0]}]"#, "its own ancestor"),
        (r#"[{"mesh":0},{"children":[2]},{"children":[1]}]"#, "its own ancestor"),
        (r#"[{"children":[2]},{"children":[2]},{"mesh":0}]"#, "a node has one parent"),
        (r#"[{"children":[1,1]},{"mesh":0}]"#, "a node has one parent"),
    ];
    for (nodes, words) in cases {
        match load_bytes(triangle_gltf(nodes, "", "").as_bytes()) {
            Err(error @ SceneError::Invalid { .. }) => assert!(error.to_string().contains(words), "{error}"),
            other => panic!("{nodes}: {other:?}"),
        }
    }
    for (list, words) in [("[0,0]", "listed twice"), ("[0,1]", "has a parent")] {
        let scenes = format!(r#","scenes":[{{"nodes":{list}}}]"#);
        let file = triangle_gltf(r#"[{"children":[1]},{"mesh":0}]"#, "", &scenes);
        match load_bytes(file.as_bytes()) {
            Err(error @ SceneError::Invalid { .. }) => assert!(error.to_string().contains(words), "{error}"),
            other => panic!("{list}: {other:?}"),
        }
    }
}

#[test]
fn scene_order_is_depth_first() {
    let scene = load_nodes(
        r#"[{"name":"a","mesh":0,"children":[3,1]},{"name":"c","mesh":0},{"name":"d","mesh":0},
        {"name":"b","mesh":0,"children":[4]},{"name":"b","mesh":0}]"#,
    );
    let names: Vec<&str> = scene.instances.iter().map(|instance| instance.name.as_str()).collect();
    assert_eq!(names, ["a", "b", "b.2", "c", "d"]);
    assert_eq!(scene.meshes.len(), 1, "a mesh is read once");
}

#[test]
fn scenes_are_chosen() {
    let file = triangle_gltf(
        r#"[{"name":"a","mesh":0},{"name":"b","mesh":0},{"name":"c","mesh":0}]"#,
        "",
        r#","scene":1,"scenes":[{"nodes":[0]},{"name":"two","nodes":[1]},{"name":"all","nodes":[2,0]},{}]"#,
    );
    let load = |text: &str, scene: SceneChoice| {
        let options = LoadOptions { scene, ..LoadOptions::default() };
        gltf::from_slice(Path::new("scenes.gltf"), text.as_bytes(), &options).map(|scene| {
            scene.instances.iter().map(|instance| instance.name.clone()).collect::<Vec<_>>().join(" ")
        })
    };
    let chosen = |scene| load(&file, scene).expect("a scene that exists");
    assert_eq!(chosen(SceneChoice::Default), "b");
    assert_eq!(chosen(SceneChoice::Index(0)), "a");
    assert_eq!(chosen(SceneChoice::Index(3)), "");
    assert_eq!(chosen(SceneChoice::Name("all".to_owned())), "c a");
    let first = file.replace(r#""scene":1,"#, "");
    assert_eq!(load(&first, SceneChoice::Default).expect("the first scene"), "a");
    let none =
        triangle_gltf(r#"[{"name":"a","children":[1]},{"name":"b","mesh":0},{"name":"c","mesh":0}]"#, "", "");
    assert_eq!(load(&none, SceneChoice::Default).expect("all nodes without a parent"), "b c");
    for wanted in [SceneChoice::Index(4), SceneChoice::Name("three".to_owned())] {
        match load(&file, wanted) {
            Err(error @ SceneError::NoSuchScene { .. }) => {
                assert!(error.to_string().contains("1 (two), 2 (all)"))
            }
            other => panic!("{other:?}"),
        }
    }
}
