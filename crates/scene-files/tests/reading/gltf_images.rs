//! Images of glTF files: decoded, or left out with a warning.

use crate::gltf_support::rich::png;
use crate::gltf_support::{assert_well_formed, data_uri, kinds, load_bytes, triangle_gltf};
use rasray_scene::Scene;

/// Kind of warning about a textured triangle of [`triangle_gltf`], which has no texture coordinates.
const BARE: &str = "texture-without-coordinates";

const NODE: &str = r#"[{"mesh":0}]"#;

fn load_text(text: &str) -> Scene {
    let scene = load_bytes(text.as_bytes()).expect("a good file");
    assert_well_formed(&scene);
    scene
}

fn textured(image: &[u8], info: &str) -> String {
    let material = format!(
        r#","images":[{{"uri":"{}"}}],"textures":[{{"source":0}}],
        "materials":[{{"pbrMetallicRoughness":{{"baseColorTexture":{info}}}}}]"#,
        data_uri(image)
    );
    triangle_gltf(NODE, r#","material":0"#, &material)
}

#[test]
fn images_are_decoded() {
    let deep = image::ImageBuffer::from_pixel(3, 1, image::Rgb([65535_u16, 32768, 0]));
    let mut bytes = std::io::Cursor::new(Vec::new());
    deep.write_to(&mut bytes, image::ImageFormat::Png).expect("writing to memory cannot fail");
    let scene = load_text(&textured(bytes.get_ref(), r#"{"index":0}"#));
    assert_eq!(kinds(&scene), ["image-depth", BARE]);
    assert_eq!((scene.images[0].width, scene.images[0].rgba8[..4].to_vec()), (3, vec![255, 128, 0, 255]));

    let set = load_text(&textured(&png(), r#"{"index":0,"texCoord":2}"#));
    assert_eq!((set.materials[0].base_color_texture, kinds(&set)), (None, vec!["uv-set"]));
    let absent =
        textured(&png(), r#"{"index":0}"#).replace(r#""textures":[{"source":0}]"#, r#""textures":[{}]"#);
    assert_eq!(kinds(&load_text(&absent)), ["texture-without-image"]);
    let dangling = textured(&png(), r#"{"index":0}"#).replace(r#""source":0"#, r#""source":5"#);
    assert!(load_bytes(dangling.as_bytes()).is_err());
    // No mesh uses the material, so the broken image is not even read.
    let unused = textured(b"broken", r#"{"index":0}"#).replace(r#","material":0"#, "");
    assert!(kinds(&load_text(&unused)).is_empty());
}

/// The factors of a material stand in for an image that is missing or cannot be decoded.
#[test]
fn images_that_cannot_be_read_are_left_out() {
    let broken: [(&[u8], &str); 4] = [
        (&png()[..40], "is damaged or cut short"),
        (b"GIF89a", "is a .gif image; only PNG, JPEG and KTX2 are read"),
        (b"<!DOCTYPE html>", "is an HTML page"),
        (b"version https://git-lfs.github.com/spec/v1\noid 1\n", "is a Git LFS pointer"),
    ];
    for (bytes, words) in broken {
        let scene = load_text(&textured(bytes, r#"{"index":0}"#));
        assert_eq!(
            (kinds(&scene), scene.materials[0].base_color_texture),
            (vec!["unreadable-texture"], None)
        );
        assert!(scene.warnings[0].message.contains(words), "{}", scene.warnings[0].message);
        assert!(scene.textures.is_empty() && scene.images.is_empty());
    }
    // An image for two textures is looked for once.
    let material = r#","images":[{"uri":"gone.png"}],"textures":[{"source":0},{"source":0}],
        "materials":[{"pbrMetallicRoughness":{"baseColorTexture":{"index":0}},"emissiveTexture":{"index":1}}]"#;
    let scene = load_text(&triangle_gltf(NODE, r#","material":0"#, material));
    assert_eq!(kinds(&scene), ["missing-texture"]);
    assert!(scene.warnings[0].message.contains("texture nowhere/gone.png: is not shown"));
}

/// Equal remarks on many places become one warning.
#[test]
fn warnings_of_many_places_are_one() {
    let images: Vec<String> = (0..98).map(|i| format!(r#"{{"uri":"gone{i}.png"}}"#)).collect();
    let textures: Vec<String> = (0..98).map(|i| format!(r#"{{"source":{i}}}"#)).collect();
    let materials: Vec<String> = (0..98)
        .map(|i| format!(r#"{{"pbrMetallicRoughness":{{"baseColorTexture":{{"index":{i}}}}}}}"#))
        .collect();
    let primitives: Vec<String> =
        (0..98).map(|i| format!(r#"{{"attributes":{{"POSITION":0}},"material":{i}}}"#)).collect();
    let extra = format!(
        r#","images":[{}],"textures":[{}],"materials":[{}]"#,
        images.join(","),
        textures.join(","),
        materials.join(",")
    );
    let text = triangle_gltf(NODE, "", &extra)
        .replace(r#"{"attributes":{"POSITION":0},"indices":1}"#, &primitives.join(","));
    let scene = load_text(&text);
    assert_eq!((scene.meshes.len(), kinds(&scene)), (98, vec!["missing-texture"]));
    let message = &scene.warnings[0].message;
    assert!(message.starts_with("texture nowhere/gone0.png and 97 more: is not shown"), "{message}");
}

/// A reference that cannot be followed is a missing image; a file of its name beside the scene stands in.
#[test]
fn references_of_images_that_lead_outside_are_never_followed() {
    let above = tempfile::tempdir().expect("a folder");
    let folder = above.path().join("scene");
    std::fs::create_dir_all(folder.join("textures")).expect("a folder");
    std::fs::write(above.path().join("wood.png"), png()).expect("written");
    let read = |uri: &str| {
        let material = format!(
            r#","images":[{{"uri":"{uri}"}}],"textures":[{{"source":0}}],
            "materials":[{{"pbrMetallicRoughness":{{"baseColorTexture":{{"index":0}}}}}}]"#
        );
        let path = folder.join("scene.gltf");
        std::fs::write(&path, triangle_gltf(NODE, r#","material":0"#, &material)).expect("written");
        let options = rasray_scene_files::LoadOptions::default();
        rasray_scene_files::load(&path, &options).unwrap_or_else(|error| panic!("{uri}: {error}"))
    };
    let outside = [
        r"C:\\textures\\wood.png",
        "C:/textures/wood.png",
        "../wood.png",
        "/wood.png",
        "%2e%2e/wood.png",
        "file:///C:/textures/wood.png",
        "http://host/a/wood.png",
        r"\\\\host\\wood.png",
    ];
    for uri in outside.into_iter().chain(["", "wood.png%", "%ff/wood.png", r"textures\\wood.png"]) {
        let scene = read(uri);
        assert_eq!(kinds(&scene), ["missing-texture"], "{uri}");
        assert!(scene.images.is_empty() && scene.files.is_empty(), "{uri}");
    }
    std::fs::write(folder.join("wood.png"), png()).expect("written");
    for uri in outside.into_iter().chain(["%ff/wood.png"]) {
        let scene = read(uri);
        assert_eq!(kinds(&scene), ["texture-elsewhere", BARE], "{uri}");
        assert_eq!((scene.images.len(), &scene.files[..]), (1, &[folder.join("wood.png")][..]), "{uri}");
    }
    // The reference is written for another system, or not escaped: the file itself exists.
    for (name, uri) in [("textures/wood.png", r"textures\\wood.png"), ("100%.png", "100%.png")] {
        std::fs::write(folder.join(name), png()).expect("written");
        let scene = read(uri);
        assert_eq!((kinds(&scene), scene.files.len()), (vec!["texture-elsewhere", BARE], 1), "{uri}");
        assert_eq!(scene.files[0], folder.join(name));
    }
    for uri in ["data:image/png;base64,*", "data:image/png", "DATA:,%f"] {
        let scene = read(uri);
        assert_eq!((kinds(&scene), scene.images.len()), (vec!["unreadable-texture"], 0), "{uri}");
    }
}
