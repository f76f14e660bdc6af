//! Skins of a glTF file: joints that are far away, without weight or of no size, and degenerate nodes that a
//! skin or a clip makes harmless.

use glam::DVec3;
use rasray_scene::{Moment, Scene};

use crate::gltf_support::kinds;
use crate::gltf_support::moving::{File, TRIANGLE, corners, messages};

/// Makes a triangle that follows joints at these places, with these weights; the joints turn by half a turn
/// about z in a second.
fn skinned(places: &[[f32; 3]], joints: [u8; 4], weights: [f32; 4], mesh_node: &str) -> Scene {
    let mut file = File::new();
    let of = file.accessor(&joints.repeat(3), 5121, "VEC4", 3);
    let shares = file.floats("VEC4", &weights.repeat(3));
    let turn = [0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.6, 0.8];
    let (input, output) = (file.floats("SCALAR", &[0.0, 1.0]), file.floats("VEC4", &turn));
    let nodes: Vec<_> = places.iter().map(|place| format!(r#"{{"translation":{place:?}}}"#)).collect();
    let numbers: Vec<_> = (1..=places.len()).map(|node| node.to_string()).collect();
    let channels: Vec<_> = (numbers.iter())
        .map(|node| format!(r#"{{"sampler":0,"target":{{"node":{node},"path":"rotation"}}}}"#))
        .collect();
    file.load(&format!(
        r#""meshes":[{{"primitives":[{{"attributes":{{"POSITION":0,"JOINTS_0":{of},"WEIGHTS_0":{shares}}}}}]}}],
        "nodes":[{{"mesh":0,"skin":0{mesh_node}}},{}],"skins":[{{"joints":[{}]}}],
        "animations":[{{"channels":[{}],"samplers":[{{"input":{input},"output":{output}}}]}}]"#,
        nodes.join(","),
        numbers.join(","),
        channels.join(",")
    ))
}

/// The place of a joint without effect, and the order of joints, cost no digit.
#[test]
fn a_far_joint_without_weight_costs_no_digits() {
    let (far, near, beside) = ([1.0e5, -3.0e6, 7.0], [0.25, 0.5, 0.125], [-0.5, 0.75, 0.3]);
    let third = [0.3, 0.3, 0.1, 0.3];
    let expected = skinned(&[near, beside], [0, 1, 0, 1], third, "");
    for (places, joints) in [
        ([far, near, beside], [1, 2, 1, 2]),
        ([near, far, beside], [0, 2, 0, 2]),
        ([near, beside, far], [0, 1, 0, 1]),
        ([beside, far, near], [2, 0, 2, 0]),
    ] {
        let scene = skinned(&places, joints, third, "");
        for seconds in [0.0, 0.4, 1.0] {
            let rounded = |scene: &Scene| {
                corners(scene, 0, seconds)
                    .into_iter()
                    .map(|corner| corner.as_vec3().to_array())
                    .collect::<Vec<_>>()
            };
            // The joints' terms are added in another order.
            for (found, expected) in
                rounded(&scene).into_flattened().iter().zip(rounded(&expected).as_flattened())
            {
                assert!(
                    (found - expected).abs() <= f32::EPSILON * expected.abs(),
                    "{found} {expected} {places:?}"
                );
            }
        }
    }
}

/// Vertices keep their digits where joints with weight are far from those of other vertices, and far from the
/// origin.
#[test]
fn positions_of_skins_keep_their_digits_anywhere() {
    for place in [[0.0; 3], [3.0e5, 0.0, -2.0e6], [-40.0, 8.0e6, 0.5]] {
        let at = |offset: f32| place.map(|x| x + offset);
        // The sum of the weights is not 1 in f32.
        let scene = skinned(&[at(0.0), at(1.0)], [0, 1, 0, 1], [0.1, 0.2, 0.3, 0.3], "");
        for seconds in [0.0, 0.3] {
            // The expected transform is a turn about z, of 2 asin(0.6) in a second, and the mean of both
            // joints: 4 to 5.
            let angle = 2.0 * 0.6_f64.asin() * seconds;
            let weights = [0.1_f32, 0.2, 0.3, 0.3].map(f64::from);
            let sum: f64 = weights.iter().sum();
            let share = (weights[1] + weights[3]) / sum;
            let [a, b] = [at(0.0), at(1.0)].map(|place| DVec3::from(place.map(f64::from)));
            let origin = a * (1.0 - share) + b * share;
            for (found, corner) in
                corners(&scene, 0, seconds).into_iter().zip([DVec3::ZERO, DVec3::X, DVec3::Y])
            {
                let expected = origin + glam::DMat3::from_rotation_z(angle) * corner;
                // Weights are rounded once more, and keys hold single precision; the distance to the origin
                // has no effect.
                assert!((found - expected).length() < 4.0e-7, "{found} {expected}");
            }
        }
    }
}

#[test]
fn weights_that_move_nothing_are_named() {
    let scene = skinned(&[[1.0, 0.0, 0.0], [2.0, 0.0, 0.0]], [1, 0, 0, 0], [0.0; 4], "");
    assert!(messages(&scene, "bad-weights")[0].contains("3 vertices have no joint with weight"));
    assert_eq!(corners(&scene, 0, 0.0)[0], DVec3::X, "they follow the first");
    let scene = skinned(&[[1.0, 0.0, 0.0], [2.0, 0.0, 0.0]], [1, 0, 0, 0], [1.0, -1.0, f32::NAN, 0.0], "");
    assert!(messages(&scene, "bad-weights")[0].contains("6 weights of joints are negative or not finite"));
    let mut file = File::new();
    let joints = file.accessor(&[0; 12], 5121, "VEC4", 3);
    let scene = file.load(&format!(
        r#""meshes":[{{"primitives":[{{"attributes":{{"POSITION":0,"JOINTS_0":{joints}}}}}]}}],
        "nodes":[{{"mesh":0,"skin":0}}],"skins":[{{"joints":[0]}}]"#
    ));
    assert_eq!(kinds(&scene), ["skin-without-joints"]);
}

/// A node with a scale of 0 gets a warning where it flattens triangles: not the node of a skin, which has no
/// effect, not a joint without weight, and not one that a playing clip scales.
#[test]
fn only_what_flattens_something_is_named() {
    let zero = r#","scale":[0,0,0]"#;
    assert!(skinned(&[[0.0; 3]], [0; 4], [1.0, 0.0, 0.0, 0.0], zero).warnings.is_empty());
    let file = File::new();
    let flat =
        |nodes: &str| messages(&file.load(&format!(r#"{TRIANGLE},"nodes":{nodes}"#)), "zero-scale").len();
    assert_eq!(flat(r#"[{"scale":[0,0,0],"children":[1]},{"children":[2]},{"mesh":0}]"#), 1);
    assert_eq!(flat(r#"[{"scale":[0,0,0]},{"mesh":0}]"#), 0);

    let mut file = File::new();
    let (input, output) =
        (file.floats("SCALAR", &[0.0, 1.0]), file.floats("VEC3", &[0.0, 0.0, 0.0, 1.0, 1.0, 1.0]));
    let mut scene = file.load(&format!(
        r#"{TRIANGLE},"nodes":[{{"mesh":0,"scale":[0,0,0]}},{{"mesh":0,"scale":[1,0,1]}}],"animations":[{{
        "channels":[{{"sampler":0,"target":{{"node":0,"path":"scale"}}}}],"samplers":[{{"input":{input},"output":{output}}}]}}]"#
    ));
    assert_eq!(messages(&scene, "zero-scale").len(), 1);
    assert!(messages(&scene, "zero-scale")[0].starts_with("nodes[0] and 1 more: "), "at rest both are flat");
    let posed = scene.at(&Moment { seconds: 0.0, clips: vec![0] }).expect("a rig");
    assert!(messages(&posed, "zero-scale")[0].starts_with("nodes[1]: "), "{:?}", posed.warnings);
    scene.warn_while_playing(&[0]);
    assert_eq!(messages(&scene, "zero-scale"), messages(&posed, "zero-scale"));
    scene.warn_while_playing(&[]);
    assert!(messages(&scene, "zero-scale")[0].contains("1 more"));
}

/// A mesh that a joint hides at rest by a scale of 0 is not at fault: triangles and normals exist when it is
/// shown.
#[test]
fn what_a_joint_hides_at_rest_is_not_said_to_be_broken() {
    let mut file = File::new();
    let (joints, weights) =
        (file.accessor(&[0; 12], 5121, "VEC4", 3), file.floats("VEC4", &[1.0, 0.0, 0.0, 0.0].repeat(3)));
    let normals = file.floats("VEC3", &[0.0, 0.0, 1.0].repeat(3));
    let (input, output) = (file.floats("SCALAR", &[0.0]), file.floats("VEC3", &[1.0; 3]));
    let rest = |clips: &str| {
        file.load(&format!(
            r#""meshes":[{{"primitives":[{{"attributes":{{"POSITION":0,"NORMAL":{normals},"JOINTS_0":{joints},"WEIGHTS_0":{weights}}}}}]}}],
            "nodes":[{{"mesh":0,"skin":0}},{{"scale":[0,0,0]}}],"skins":[{{"joints":[1]}}]{clips}"#
        ))
    };
    let scene = rest(&format!(
        r#","animations":[{{"channels":[{{"sampler":0,"target":{{"node":1,"path":"scale"}}}}],
        "samplers":[{{"input":{input},"output":{output}}}]}}]"#
    ));
    assert_eq!(kinds(&scene), ["zero-scale"], "{:?}", scene.warnings);
    assert!(scene.meshes[0].normals.is_some());
    let shown = scene.at(&Moment { seconds: 0.0, clips: vec![0] }).expect("a rig");
    assert!(shown.warnings.is_empty(), "{:?}", shown.warnings);
    assert_eq!(shown.meshes[0].normals, Some(vec![[0.0, 0.0, 1.0]; 3]));
    // Without a clip the mesh stays flat.
    assert!(kinds(&rest("")).contains(&"degenerate-triangles"));
}

#[test]
fn skins_and_cameras_say_what_is_wrong_with_them() {
    let mut file = File::new();
    let joints = file.accessor(&[0; 12], 5121, "VEC4", 3);
    let weights = file.floats("VEC4", &[1.0, 0.0, 0.0, 0.0].repeat(3));
    let identity = [1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0];
    for (place, value, says) in
        [(12, f32::NAN, "1 matrices are not finite"), (3, 0.5, "1 matrices are projective")]
    {
        let mut matrix = identity;
        matrix[place] = value;
        let mut file = File {
            buffers: file.buffers.clone(),
            views: file.views.clone(),
            accessors: file.accessors.clone(),
        };
        let matrices = file.floats("MAT4", &matrix);
        let scene = file.load(&format!(
            r#""meshes":[{{"primitives":[{{"attributes":{{"POSITION":0,"JOINTS_0":{joints},"WEIGHTS_0":{weights}}}}}]}}],
            "nodes":[{{"mesh":0,"skin":0}},{{}}],"skins":[{{"joints":[1],"inverseBindMatrices":{matrices}}}]"#
        ));
        let found = messages(&scene, "skin-matrices");
        assert!(found.len() == 1 && found[0].contains(says), "{:?}", scene.warnings);
        assert_eq!(corners(&scene, 0, 0.0)[1], DVec3::X);
    }
    for (node, camera, says) in [
        (
            "",
            r#"{"type":"perspective","perspective":{"yfov":9,"znear":1}}"#,
            "yfov 9 is not between 0 and pi",
        ),
        (
            "",
            r#"{"type":"orthographic","orthographic":{"xmag":1,"ymag":0,"znear":1,"zfar":2}}"#,
            "ymag 0 is no height",
        ),
        ("", r#"{"type":"perspective"}"#, "it has no perspective"),
        (
            r#","scale":[0,0,0]"#,
            r#"{"type":"perspective","perspective":{"yfov":1,"znear":1}}"#,
            "looks in no direction",
        ),
    ] {
        let scene = file
            .load(&format!(r#"{TRIANGLE},"nodes":[{{"mesh":0}},{{"camera":0{node}}}],"cameras":[{camera}]"#));
        let found = messages(&scene, "bad-camera");
        assert!(found.len() == 1 && found[0].contains(says), "{:?}", scene.warnings);
    }
}
