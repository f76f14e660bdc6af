//! Content that is read: geometry, instances, materials, lights, cameras, deformation.

use crate::gltf_support::rich::{png, rich_glb};
use crate::gltf_support::{
    assert_well_formed, data_uri, floats, kinds, load_bytes, triangle_bytes, triangle_gltf,
};
use approx::assert_abs_diff_eq;
use glam::{DVec3, Vec3};
use rasray_scene::animation::{ChannelValues, NodeTransform};
use rasray_scene::{AlphaMode, Filter, Light, Projection, Scene, SceneError, Wrap};

const NODE: &str = r#"[{"mesh":0}]"#;

fn load_text(text: &str) -> Scene {
    let scene = load_bytes(text.as_bytes()).expect("a good file");
    assert_well_formed(&scene);
    scene
}

/// Makes a file whose only mesh has the given positions, in the given mode, without indices.
fn soup(positions: &[f32], mode: u32) -> String {
    let bytes = floats(positions);
    format!(
        r#"{{"asset":{{"version":"2.0"}},"buffers":[{{"byteLength":{length},"uri":"{}"}}],
        "bufferViews":[{{"buffer":0,"byteLength":{length}}}],
        "accessors":[{{"bufferView":0,"componentType":5126,"count":{},"type":"VEC3"}}],
        "meshes":[{{"primitives":[{{"attributes":{{"POSITION":0}},"mode":{mode}}}]}}],"nodes":[{{"mesh":0}}]}}"#,
        data_uri(&bytes),
        positions.len() / 3,
        length = bytes.len()
    )
}

#[test]
fn strips_and_fans_become_triangles() {
    let positions: Vec<f32> = (0..18).map(|i| (i * i % 7) as f32).collect();
    let indices = |mode| load_text(&soup(&positions, mode)).meshes[0].indices.clone();
    assert_eq!(indices(4), [0, 1, 2, 3, 4, 5]);
    assert_eq!(indices(5), [0, 1, 2, 1, 3, 2, 2, 3, 4, 3, 5, 4]);
    assert_eq!(indices(6), [1, 2, 0, 2, 3, 0, 3, 4, 0, 4, 5, 0]);
    for (mode, kind) in [(0, "points"), (1, "lines"), (2, "lines"), (3, "lines")] {
        let scene = load_text(&soup(&positions, mode));
        assert_eq!((scene.meshes.len(), kinds(&scene)), (0, vec![kind]));
    }
    for mode in [5, 6] {
        let short = load_bytes(soup(&positions[..6], mode).as_bytes());
        assert!(matches!(short, Err(SceneError::NoTriangles { .. })), "{short:?}");
    }
}

/// Each coordinate of one triangle among many good ones takes each awkward value.
#[test]
fn awkward_coordinates_harm_only_their_triangle() {
    let good: Vec<f32> =
        (0..200).flat_map(|i| [i as f32, 0.0, 0.0, i as f32, 1.0, 0.0, i as f32, 0.0, 1.0]).collect();
    let values = [f32::NAN, f32::INFINITY, f32::NEG_INFINITY, 1e38, 1e19, 1.8e18, 1e18, -0.0, 1e-40];
    for coordinate in 0..9 {
        for value in values {
            let mut positions = good.clone();
            positions[900 + coordinate] = value;
            let scene = load_text(&soup(&positions, 4));
            let kept = value.abs() <= 1.8e18;
            let mesh = &scene.meshes[0];
            assert_eq!(mesh.triangle_count(), if kept { 200 } else { 199 }, "{value} at {coordinate}");
            assert_eq!(mesh.indices.contains(&301), kept);
            let warned: Vec<&str> =
                kinds(&scene).into_iter().filter(|kind| *kind != "degenerate-triangles").collect();
            match value {
                1e-40 => assert_eq!(warned, ["subnormal-coordinates"]),
                _ if kept => assert!(warned.is_empty(), "{warned:?}"),
                _ => assert_eq!(warned, ["dropped-triangles"]),
            }
            let untouched = |i: usize| mesh.positions[i] == [good[3 * i], good[3 * i + 1], good[3 * i + 2]];
            assert!((0..600).filter(|i| !(300..303).contains(i)).all(untouched));
        }
    }
}

#[test]
fn triangles_without_area_are_kept_and_counted() {
    let flat = [0.0, 0.0, 0.0, 1.0, 1.0, 1.0, 3.0, 3.0, 3.0];
    let repeated = [0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 1.0, 0.0, 0.0];
    let sliver = [0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 1e-30, 1e-30, 0.0];
    let scene = load_text(&soup(&[flat, repeated, sliver].concat(), 4));
    assert_eq!(scene.meshes[0].triangle_count(), 3);
    assert_eq!(kinds(&scene), ["degenerate-triangles"]);
    assert!(scene.warnings[0].message.contains(" 2 triangles"), "{}", scene.warnings[0].message);
}

#[test]
fn missing_attributes_stay_missing() {
    let scene = load_text(&triangle_gltf(NODE, "", ""));
    let mesh = &scene.meshes[0];
    assert!(
        mesh.normals.is_none() && mesh.tangents.is_none() && mesh.colors.is_none() && mesh.uvs[0].is_none()
    );
    assert_eq!((scene.materials.len(), mesh.material), (1, 0));
    assert_eq!(scene.materials[0].name, "default");
    let without = r#"{"attributes":{}},{"attributes":{"POSITION":0}}"#;
    let two = triangle_gltf(NODE, "", "").replace(r#"{"attributes":{"POSITION":0},"indices":1}"#, without);
    let scene = load_text(&two);
    assert_eq!((scene.meshes.len(), kinds(&scene)), (1, vec!["no-positions"]));
}

/// The format says that backs are culled unless the material is double-sided or bounds a volume.
#[test]
fn materials_say_whether_their_back_is_culled() {
    let culls = |material: &str| {
        let used = r#","extensionsUsed":["KHR_materials_volume","KHR_materials_transmission"]"#;
        let extra = format!(r#"{used},"materials":[{material}]"#);
        load_text(&triangle_gltf(NODE, r#","material":0"#, &extra)).materials[0].culls_back
    };
    let volume = |thickness: f32| {
        format!(
            r#"{{"extensions":{{"KHR_materials_transmission":{{"transmissionFactor":1}},
                "KHR_materials_volume":{{"thicknessFactor":{thickness}}}}}}}"#
        )
    };
    assert!(culls("{}") && culls(r#"{"doubleSided":false}"#) && !culls(r#"{"doubleSided":true}"#));
    assert!(culls(&volume(0.0)) && !culls(&volume(0.1)));
    assert!(load_text(&triangle_gltf(NODE, "", "")).materials[0].culls_back, "the format's own material");
}

#[test]
fn attributes_of_another_length_are_dropped() {
    let text = triangle_gltf(NODE, "", "").replace(r#""POSITION":0"#, r#""POSITION":0,"NORMAL":2"#).replace(
        r#""type":"SCALAR"}"#,
        r#""type":"SCALAR"},{"bufferView":0,"componentType":5126,"count":2,"type":"VEC3"}"#,
    );
    let scene = load_text(&text);
    assert!(scene.meshes[0].normals.is_none());
    assert_eq!(kinds(&scene), ["attribute-length"]);
}

#[test]
fn quantised_positions_need_their_extension() {
    let shorts: Vec<u8> =
        [0_i16, 0, 0, 100, 0, 0, 0, -32768, 0].iter().flat_map(|x| x.to_le_bytes()).collect();
    let mut bytes = triangle_bytes();
    bytes[..18].copy_from_slice(&shorts);
    let text = triangle_gltf(NODE, "", r#","extensionsUsed":["KHR_mesh_quantization"]"#)
        .replace(&data_uri(&triangle_bytes()), &data_uri(&bytes))
        .replace(r#""componentType":5126"#, r#""componentType":5122"#);
    assert_eq!(load_text(&text).meshes[0].positions[1..], [[100.0, 0.0, 0.0], [0.0, -32768.0, 0.0]]);
    let normalized = text.replace(r#""componentType":5122"#, r#""componentType":5122,"normalized":true"#);
    assert_eq!(load_text(&normalized).meshes[0].positions[2], [0.0, -1.0, 0.0]);
    assert!(load_bytes(text.replace("KHR_mesh_quantization", "KHR_other").as_bytes()).is_err());
}

/// `KHR_materials_anisotropy`, which may be required.
#[test]
fn anisotropy_is_read() {
    let extra = |members: &str| {
        format!(
            r#","materials":[{{"extensions":{{"KHR_materials_anisotropy":{{{members}}}}}}}],
            "extensionsUsed":["KHR_materials_anisotropy"],"extensionsRequired":["KHR_materials_anisotropy"],
            "textures":[{{"source":0}}],"images":[{{"uri":"{}"}}]"#,
            data_uri(&png())
        )
    };
    let load = |members: &str| load_text(&triangle_gltf(NODE, r#","material":0"#, &extra(members)));
    let scene = load(r#""anisotropyStrength":0.75,"anisotropyRotation":1.5,"anisotropyTexture":{"index":0}"#);
    let material = &scene.materials[0];
    assert_eq!((material.anisotropy, material.anisotropy_rotation), (0.75, 1.5));
    assert_eq!(material.anisotropy_texture.expect("a texture").uv_set, 0);
    let bare = load("");
    assert_eq!((bare.materials[0].anisotropy, bare.materials[0].anisotropy_texture), (0.0, None));
    assert_eq!(load(r#""anisotropyStrength":2"#).materials[0].anisotropy, 1.0, "brought into range");
    for (members, word) in [
        (r#""anisotropyTexture":{"index":7}"#, "anisotropyTexture"),
        (r#""anisotropyStrength":"much""#, "anisotropyStrength"),
    ] {
        let text = triangle_gltf(NODE, r#","material":0"#, &extra(members));
        let error = load_bytes(text.as_bytes()).expect_err("refused").to_string();
        assert!(error.contains(word), "{error}");
    }
}

#[test]
fn the_rich_file_is_read_in_full() {
    let scene = load_bytes(&rich_glb()).expect("a good file");
    let names: Vec<&str> = scene.instances.iter().map(|instance| instance.name.as_str()).collect();
    assert_eq!(names, ["body", "field", "field.2", "field.3"]);

    let glass = &scene.materials[0];
    assert_eq!(
        (glass.name.as_str(), glass.base_color, glass.roughness),
        ("glass", [1.0, 0.5, 0.25, 1.0], 0.5)
    );
    assert_eq!((glass.emission, glass.transmission, glass.ior, glass.specular), ([5.0; 3], 1.0, 1.3, 0.5));
    assert_eq!((glass.thickness, glass.attenuation_distance), (0.1, 2.0));
    let used = glass.base_color_texture.expect("a base colour texture");
    assert_eq!(glass.normal_texture.expect("a normal texture"), used, "its transform is read as well");
    assert_eq!(glass.transmission_texture, Some(used));
    assert_abs_diff_eq!(used.uv_transform[0][0], 2.0 * 0.1_f32.cos(), epsilon = 1e-6);
    let texture = scene.textures[used.texture];
    assert_eq!((texture.wrap_u, texture.wrap_v), (Wrap::Clamp, Wrap::Mirror));
    assert_eq!((texture.filter, texture.mipmapped), (Filter::Nearest, true));
    assert_eq!(scene.images[0].rgba8[4..8], [255, 0, 128, 255]);
    let leaf = &scene.materials[1];
    assert_eq!(leaf.alpha_mode, AlphaMode::Mask { cutoff: 0.25 });
    assert!(leaf.unlit && leaf.double_sided && !glass.unlit);

    let copies = &scene.meshes[1];
    assert_eq!(copies.uvs[0].as_ref().map(|set| set[1]), Some([1.0, 0.0]));
    assert_eq!(copies.colors.as_ref().map(|set| set[0][0]), Some(1.0));
    assert_eq!(copies.indices, [0, 1, 2, 2, 1, 3]);

    let Light::Spot { position, direction, intensity, outer_cone, .. } = scene.lights[0] else {
        panic!("{:?}", scene.lights)
    };
    assert_eq!((position, direction), (DVec3::new(0.0, 0.0, 5.0), DVec3::NEG_Z));
    assert_eq!((intensity, outer_cone), ([40.0; 3], 0.5));
    assert_eq!(scene.cameras[0].name, "eye");
    assert_eq!(scene.cameras[0].world_from_camera.translation, DVec3::new(0.0, 0.0, 5.0));
    assert_eq!(scene.cameras[0].projection, Projection::Perspective { fov_y: 0.8 });
}

/// The instances of `EXT_mesh_gpu_instancing` go through their node: here turned by 90 degrees
/// about y and mirrored.
#[test]
fn copies_are_placed_through_their_node() {
    let scene = load_bytes(&rich_glb()).expect("a good file");
    let places: Vec<DVec3> =
        scene.instances[1..].iter().map(|instance| instance.world_from_mesh.translation).collect();
    let expected = [DVec3::ZERO, DVec3::new(0.0, 0.0, -5.0), DVec3::new(0.0, -10.0, 0.0)];
    assert!(places.iter().zip(expected).all(|(a, b)| (*a - b).length() < 1e-12), "{places:?}");
}

/// Copies with all three attributes; integer rotations are shares of their largest value.
#[test]
fn copies_turn_and_scale() {
    let mut bytes = triangle_bytes();
    bytes.extend(floats(&[1.0, 2.0, 3.0, 2.0, 3.0, 4.0]));
    bytes.extend([0, 0, 127, 127, 0, 0, 0, 127]);
    let instancing = |attributes: &str| {
        triangle_gltf(
            &format!(
                r#"[{{"mesh":0,"extensions":{{"EXT_mesh_gpu_instancing":{{"attributes":{attributes}}}}}}}]"#
            ),
            "",
            "",
        )
        .replace(&data_uri(&triangle_bytes()), &data_uri(&bytes))
        .replace(r#""byteLength":44"#, r#""byteLength":76"#)
        .replace(
            r#"{"buffer":0,"byteOffset":36,"byteLength":6}"#,
            r#"{"buffer":0,"byteOffset":36,"byteLength":6},{"buffer":0,"byteOffset":44,"byteLength":24},
            {"buffer":0,"byteOffset":68,"byteLength":8}"#,
        )
        .replace(
            r#""type":"SCALAR"}"#,
            r#""type":"SCALAR"},{"bufferView":2,"componentType":5126,"count":2,"type":"VEC3"},
            {"bufferView":3,"componentType":5120,"normalized":true,"count":2,"type":"VEC4"}"#,
        )
    };
    let scene = load_text(&instancing(r#"{"TRANSLATION":2,"SCALE":2,"ROTATION":3,"_CUSTOM":3}"#));
    let corner = |i: usize| scene.instances[i].world_from_mesh.transform_point3(DVec3::X);
    // x scaled by 1, turned to y, moved by (1, 2, 3); then x scaled by 2 and moved by (2, 3, 4).
    assert!((corner(0) - DVec3::new(1.0, 3.0, 3.0)).length() < 1e-12, "{}", corner(0));
    assert!((corner(1) - DVec3::new(4.0, 3.0, 4.0)).length() < 1e-12, "{}", corner(1));
    let odd = bytes.len() - 8;
    let flat = instancing(r#"{"SCALE":2,"ROTATION":3}"#).replace(&data_uri(&bytes), &{
        let mut flat = bytes.clone();
        // The x of the first scale and of the first rotation become 0.
        flat[44..48].fill(0);
        flat[odd..odd + 4].fill(0);
        data_uri(&flat)
    });
    let scene = load_text(&flat);
    assert_eq!(kinds(&scene), ["bad-rotation", "zero-scale"]);
    assert!(
        scene.warnings.iter().all(|warning| warning.message.starts_with("nodes[0]: 1 ")),
        "{:?}",
        scene.warnings
    );
    let refused = |attributes: &str| {
        load_bytes(instancing(attributes).as_bytes()).map(drop).expect_err("refused").to_string()
    };
    assert!(refused(r#"{"TRANSLATION":2,"SCALE":0}"#).contains("differ in length"));
    assert!(refused(r#"{"TRANSLATION":9}"#).contains("refers to no accessor"));
    assert!(refused(r#"{"ROTATION":2}"#).contains("elements of type VEC3 where 4 numbers are needed"));
    assert!(refused("{}").contains("has no attributes"));
}

/// The joint lifts the quad by 1, the morph target by half of its displacements before that.
#[test]
fn deformed_meshes_are_posed_at_rest() {
    let scene = load_bytes(&rich_glb()).expect("a good file");
    let world = scene.instances[0].world_from_mesh;
    let heights: Vec<f64> = (scene.meshes[0].positions.iter())
        .map(|&position| world.transform_point3(Vec3::from(position).as_dvec3()).z)
        .collect();
    assert_eq!(heights, [1.0, 1.25, 1.0, 1.125]);

    let rig = &scene.animation.rig;
    assert_eq!((scene.animation.clips.as_slice(), scene.animation.duration), (&["turn".to_owned()][..], 1.5));
    assert_eq!((scene.animation.skins, scene.animation.morphed_meshes), (1, 1));
    assert_eq!(rig.placements.len(), scene.instances.len());
    assert_eq!((rig.nodes[1].parent, rig.nodes[1].name.as_str()), (Some(0), "joint"));
    assert!(matches!(rig.nodes[1].transform, NodeTransform::Parts { translation: DVec3::Z, .. }));
    let deformed = &rig.deformed[0];
    assert_eq!((deformed.mesh, deformed.weights.as_slice()), (0, &[0.5][..]));
    assert_eq!(deformed.positions[1], [1.0, 0.0, 0.0]);
    assert_eq!(deformed.targets[0].positions.as_ref().map(|list| list[1]), Some([0.0, 0.0, 0.5]));
    let skin = deformed.skin.as_ref().expect("it has joints");
    assert_eq!((skin.per_vertex, &skin.weights[..4]), (4, &[1.0, 0.0, 0.0, 0.0][..]));
    let channel = &rig.clips[0].channels[0];
    assert_eq!((channel.node, channel.times.as_slice()), (1, &[0.0, 1.5][..]));
    assert!(matches!(&channel.values, ChannelValues::Rotation(turns) if turns[1] == [0.0, 0.0, 1.0, 0.0]));
}

/// A morph target without a buffer view is all zeros, which some exporters write.
#[test]
fn absent_displacements_are_zero() {
    let text = triangle_gltf(NODE, r#","targets":[{"POSITION":2}]"#, "")
        .replace(r#""type":"SCALAR"}"#, r#""type":"SCALAR"},{"componentType":5126,"count":3,"type":"VEC3"}"#)
        .replace(r#""meshes":[{"#, r#""meshes":[{"weights":[1],"#);
    let scene = load_text(&text);
    assert_eq!(scene.meshes[0].positions[1], [1.0, 0.0, 0.0]);
    assert!(kinds(&scene).is_empty(), "{:?}", scene.warnings);
    assert_eq!(scene.animation.rig.deformed[0].targets[0].positions, Some(vec![[0.0; 3]; 3]));
}

#[test]
fn material_values_are_brought_into_range() {
    let extra = r#","materials":[{"pbrMetallicRoughness":{"roughnessFactor":7,"baseColorFactor":[2,-1,0.5,1e39]},
        "emissiveFactor":[-1,1,1],"extensions":{"KHR_materials_ior":{"ior":0},"KHR_materials_volume":{"attenuationDistance":0}}}]"#;
    let scene = load_text(&triangle_gltf(NODE, r#","material":0"#, extra));
    let material = &scene.materials[0];
    assert_eq!((material.roughness, material.base_color), (1.0, [1.0, 0.0, 0.5, 1.0]));
    assert_eq!((material.emission, material.ior), ([0.0, 1.0, 1.0], 1.0));
    assert_eq!(material.attenuation_distance, f32::INFINITY);
    assert_eq!(kinds(&scene), ["material-range"]);
}

#[test]
fn lights_and_cameras_follow_their_nodes() {
    let extra = r#","extensions":{"KHR_lights_punctual":{"lights":[{"type":"directional","color":[1,0.5,0],"intensity":2},
        {"type":"point","range":9},{"type":"spot","spot":{"innerConeAngle":3,"outerConeAngle":0.5}},{"type":"spot"}]}},
        "cameras":[{"type":"orthographic","orthographic":{"xmag":2,"ymag":3,"zfar":9,"znear":1}},
        {"type":"perspective","perspective":{"yfov":9,"znear":1}}]"#;
    let at =
        |what: &str| format!(r#"{{{what},"rotation":[0,1,0,1],"translation":[1,2,3],"scale":[2,2,-2]}}"#);
    let light = |i: usize| at(&format!(r#""extensions":{{"KHR_lights_punctual":{{"light":{i}}}}}"#));
    let nodes = format!(
        "[{},{},{},{},{},{}]",
        light(0),
        light(1),
        light(2),
        light(3),
        at(r#""camera":0"#),
        at(r#""camera":1"#)
    );
    let scene = load_text(&triangle_gltf(&nodes, "", extra));
    let position = DVec3::new(1.0, 2.0, 3.0);
    let close = |a: DVec3, b: DVec3| (a - b).length() < 1e-12;
    match scene.lights[..] {
        [
            Light::Directional { direction, irradiance },
            Light::Point { position: point, intensity, range },
            Light::Spot { position: spot, inner_cone, outer_cone, .. },
        ] => {
            // -z, mirrored to +z by the scale, turned to +x.
            assert!(close(direction, DVec3::X), "{direction}");
            assert_eq!(irradiance, [2.0, 1.0, 0.0]);
            assert!(close(point, position) && close(spot, position));
            assert_eq!((intensity, range), ([1.0; 3], 9.0));
            assert_eq!((inner_cone, outer_cone), (0.5, 0.5));
        }
        _ => panic!("{:?}", scene.lights),
    }
    assert_eq!(scene.cameras.len(), 1);
    let camera = &scene.cameras[0];
    assert_eq!(camera.projection, Projection::Orthographic { half_height: 3.0 });
    let axes = camera.world_from_camera.matrix3;
    assert_abs_diff_eq!(axes.determinant(), 1.0, epsilon = 1e-12);
    assert_eq!(kinds(&scene), ["light-range", "bad-light", "bad-camera", "no-triangles"]);
}
