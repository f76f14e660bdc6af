//! Files that are no scenes, and references to files of another kind: an error or a warning at once, which
//! names the kind that was found.

use std::fs;
use std::path::Path;

use rasray_scene::{Scene, SceneError};
use rasray_scene_files::{LoadOptions, load};

fn load_in(folder: &Path, name: &str, bytes: &[u8]) -> Result<Scene, SceneError> {
    let path = folder.join(name);
    fs::write(&path, bytes).expect("a temporary file");
    load(&path, &LoadOptions::default())
}

#[test]
fn what_is_no_scene_is_named() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let noise: Vec<u8> = (0..5000_u32).map(|i| (i.wrapping_mul(2_654_435_761) >> 13) as u8).collect();
    let noise = &noise[..];
    let cases: [(&[u8], &str); 8] = [
        (b"", "is empty"),
        (b"<!DOCTYPE html>\n<html><body>404</body></html>", "is an HTML page"),
        (b"version https://git-lfs.github.com/spec/v1\noid sha256:0\nsize 9\n", "is a Git LFS pointer"),
        (b"PK\x03\x04\x14\0\0\0", "is a ZIP archive"),
        (b"\x89PNG\r\n\x1a\n\0\0", "is a PNG image"),
        (b"Kaydara FBX Binary  \0", "is an FBX file"),
        (b"<?xml version=\"1.0\"?><COLLADA/>", "is an XML document"),
        (noise, "is binary data"),
    ];
    for extension in ["obj", "ply", "gltf", "glb"] {
        for (bytes, words) in cases {
            let name = format!("scene.{extension}");
            match load_in(folder.path(), &name, bytes) {
                Err(error @ SceneError::NotThisFormat { .. }) => {
                    let text = error.to_string();
                    assert!(text.contains(words) && text.contains(&name), "{text}");
                }
                other => panic!("{name}, {words}: {other:?}"),
            }
        }
    }
    let comment = load_in(folder.path(), "noise.obj", b"#\xe1\xb8\xa5\x1f\xff");
    assert!(matches!(comment, Err(SceneError::NotThisFormat { .. })), "{comment:?}");
    let prose = load_in(folder.path(), "readme.obj", b"Hello there.\n\nThis is a page.\n");
    let text = prose.map(drop).expect_err("prose").to_string();
    assert!(text.contains("no line is a statement of an OBJ file, line 1 begins with `Hello`"), "{text}");
    for (name, bytes) in [("a.obj", &b"glTF\x02\0\0\0"[..]), ("b.glb", b"ply\nformat ascii 1.0\n")] {
        let text = load_in(folder.path(), name, bytes).map(drop).expect_err(name).to_string();
        assert!(text.contains("give the file the extension of its format"), "{text}");
    }
}

#[test]
fn files_whose_triangles_are_all_dropped_are_errors() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let ply = |faces: &str| {
        format!(
            "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n\
             element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\nnan 1 0\n{faces}\n"
        )
    };
    let cases = [
        ("short.obj", "v 0 0 0\nv 1 0 0\nf 1 2\n".to_owned(), "1 faces have fewer than three corners"),
        ("nan.obj", "v 0 0 0\nv 1 0 0\nv nan 1 0\nf 1 2 3\n".to_owned(), "1 triangles were dropped"),
        ("short.ply", ply("2 0 1"), "fewer than three corners"),
        ("nan.ply", ply("3 0 1 2"), "1 triangles were dropped"),
    ];
    for (name, text, words) in cases {
        match load_in(folder.path(), name, text.as_bytes()) {
            Err(error @ SceneError::NoTriangles { .. }) => {
                let text = error.to_string();
                assert!(text.contains(words) && text.contains(name), "{text}");
            }
            other => panic!("{name}: {other:?}"),
        }
    }
    for (name, text) in
        [("points.obj", "v 0 0 0\np 1\n"), ("comment.obj", "# nothing yet\n"), ("group.obj", "g a\n")]
    {
        let scene = load_in(folder.path(), name, text.as_bytes()).unwrap_or_else(|error| panic!("{error}"));
        assert!(scene.warnings.iter().any(|warning| warning.kind == "no-triangles"), "{name}");
    }
}

const GLTF: &str = r#"{"asset":{"version":"2.0"},"nodes":[{"mesh":0}],
    "buffers":[{"byteLength":36,"uri":"BUFFER"}],"bufferViews":[{"buffer":0,"byteLength":36}],
    "accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"}],
    "meshes":[{"primitives":[{"attributes":{"POSITION":0},"material":0}]}],
    "materials":[{"emissiveTexture":{"index":0}}],"textures":[{"source":0}],"images":[{"uri":"IMAGE"}]}"#;
const OBJ: &str = "mtllib LIBRARY\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nusemtl m\nf 1/1 2/1 3/1\n";

fn triangle() -> Vec<u8> {
    [0.0_f32, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0].iter().flat_map(|x| x.to_le_bytes()).collect()
}

/// A pipe would keep its reader waiting: no reference opens one.
#[cfg(unix)]
#[test]
fn pipes_are_never_waited_for() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let folder = folder.path();
    let pipe = folder.join("pipe");
    let made = std::process::Command::new("mkfifo").arg(&pipe).status().expect("mkfifo runs");
    assert!(made.success());
    fs::write(folder.join("good.bin"), triangle()).expect("written");
    fs::write(folder.join("good.mtl"), "newmtl m\nmap_Kd pipe\n").expect("written");

    let buffer = GLTF.replace("BUFFER", "pipe").replace("IMAGE", "gone.png");
    match load_in(folder, "buffer.gltf", buffer.as_bytes()) {
        Err(error @ SceneError::Missing { .. }) => {
            let text = error.to_string();
            assert!(
                text.contains("buffer.gltf: buffers[0] needs") && text.contains("not a regular file"),
                "{text}"
            );
        }
        other => panic!("{other:?}"),
    }
    let says = |result: Result<Scene, SceneError>, kind: &str| {
        let scene = result.unwrap_or_else(|error| panic!("{error}"));
        let warning = scene.warnings.iter().find(|warning| warning.kind == kind);
        let warning = warning.unwrap_or_else(|| panic!("{kind}: {:?}", scene.warnings));
        assert!(warning.message.contains("not a regular file"), "{}", warning.message);
        assert_eq!(scene.meshes[0].triangle_count(), 1);
    };
    let image = GLTF.replace("BUFFER", "good.bin").replace("IMAGE", "pipe");
    says(load_in(folder, "image.gltf", image.as_bytes()), "missing-texture");
    says(load_in(folder, "texture.obj", OBJ.replace("LIBRARY", "good.mtl").as_bytes()), "missing-texture");
    says(
        load_in(folder, "library.obj", OBJ.replace("LIBRARY", "pipe").as_bytes()),
        "missing-material-library",
    );
    for name in ["pipe.obj", "pipe.glb", "pipe.ply"] {
        fs::rename(
            fs::read_dir(folder)
                .expect("listed")
                .flatten()
                .map(|entry| entry.path())
                .find(|path| path.file_name().is_some_and(|name| name.to_string_lossy().starts_with("pipe")))
                .expect("the pipe"),
            folder.join(name),
        )
        .expect("renamed");
        let error = load(&folder.join(name), &LoadOptions::default());
        assert!(matches!(error, Err(SceneError::Read { .. })), "{error:?}");
    }
}

/// Pages that were downloaded by mistake in place of a buffer, image or library.
#[test]
fn foreign_references_are_named() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let folder = folder.path();
    fs::write(folder.join("page"), "<!doctype html>").expect("written");
    fs::write(folder.join("good.bin"), triangle()).expect("written");
    let buffer = GLTF.replace("BUFFER", "page").replace("IMAGE", "gone.png");
    let text = load_in(folder, "scene.gltf", buffer.as_bytes()).map(drop).expect_err("a page").to_string();
    assert!(
        text.contains("scene.gltf: buffers[0] needs ")
            && text.contains("page, which is an HTML page; download"),
        "{text}"
    );
    let image = GLTF.replace("BUFFER", "good.bin").replace("IMAGE", "page");
    let scene = load_in(folder, "scene.gltf", image.as_bytes()).unwrap_or_else(|error| panic!("{error}"));
    assert!(scene.warnings.iter().any(|warning| warning.message.contains("it is an HTML page; only PNG")));
    let scene = load_in(folder, "scene.obj", OBJ.replace("LIBRARY", "page").as_bytes());
    let scene = scene.unwrap_or_else(|error| panic!("{error}"));
    let library = scene.warnings.iter().find(|warning| warning.kind == "missing-material-library");
    assert!(
        library.is_some_and(|warning| warning.message.contains("is an HTML page, not a material library"))
    );
}

/// The error of an unreadable library names the scene as well.
#[test]
fn errors_of_libraries_name_the_scene() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    fs::write(folder.path().join("bad.mtl"), "newmtl m\nKd red\n").expect("written");
    let result = load_in(folder.path(), "scene.obj", OBJ.replace("LIBRARY", "bad.mtl").as_bytes());
    let text = result.map(drop).expect_err("no number").to_string();
    assert!(
        text.contains("scene.obj: ") && text.contains("bad.mtl: line 2: `red` is not a number"),
        "{text}"
    );
}
