//! Scenes as exporters for the web compress them, against the plain scenes that they were made from: the
//! files of `tests/compressed`, which its `make.mjs` makes.

use std::path::{Path, PathBuf};

use glam::{DVec3, Vec3};
use rasray_scene::{Moment, Scene, SceneError};
use rasray_scene_files::{Limits, LoadOptions, decode_image, gltf, load};

use crate::gltf_damaged::{Random, survives};
use crate::gltf_support::{assert_well_formed, load_bytes, triangle_gltf};

fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/compressed")
}

fn read(file: &str) -> Scene {
    let scene = load(&folder().join(file), &LoadOptions::default()).unwrap_or_else(|error| panic!("{error}"));
    assert_well_formed(&scene);
    assert!(scene.warnings.is_empty(), "{file}: {:?}", scene.warnings);
    scene
}

/// Corner of a triangle, as it is shown.
#[derive(Clone, Copy)]
struct Corner {
    position: DVec3,
    normal: Option<Vec3>,
    /// Coordinates at which the texture is read.
    texture: Option<[f32; 2]>,
    color: Option<[f32; 4]>,
}

/// Returns the triangles of all instances in the world, each with the name of its material.
fn triangles(scene: &Scene) -> Vec<(&str, [Corner; 3])> {
    let mut found = Vec::new();
    for instance in &scene.instances {
        let mesh = &scene.meshes[instance.mesh];
        let material = &scene.materials[mesh.material];
        let texture = material.base_color_texture.or(material.emission_texture);
        let normals = instance.world_from_mesh.matrix3.inverse().transpose();
        let corner = |vertex: u32| {
            let vertex = vertex as usize;
            let position = Vec3::from(mesh.positions[vertex]).as_dvec3();
            let uvs =
                texture.and_then(|texture| Some((texture, mesh.uvs[texture.uv_set as usize].as_ref()?)));
            Corner {
                position: instance.world_from_mesh.transform_point3(position),
                normal: mesh.normals.as_ref().map(|normals_of| {
                    (normals * Vec3::from(normals_of[vertex]).as_dvec3()).normalize().as_vec3()
                }),
                texture: uvs.map(|(texture, uvs)| {
                    let [u, v] = uvs[vertex];
                    texture.uv_transform.map(|row| row[0] * u + row[1] * v + row[2])
                }),
                color: mesh.colors.as_ref().map(|colors| colors[vertex]),
            }
        };
        for triangle in mesh.indices.chunks_exact(3) {
            found.push((&material.name[..], [0, 1, 2].map(|k| corner(triangle[k]))));
        }
    }
    found
}

/// Largest differences between corners.
#[derive(Clone, Copy, Debug, Default)]
struct Error {
    position: f64,
    normal: f32,
    texture: f32,
    color: f32,
}

impl Error {
    fn of(plain: Corner, twin: Corner) -> Self {
        let greatest = |a: &[f32], b: &[f32]| a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f32::max);
        // An attribute that only one of the two has counts as the largest difference.
        let pair = |a: Option<&[f32]>, b: Option<&[f32]>| match (a, b) {
            (Some(a), Some(b)) => greatest(a, b),
            (None, None) => 0.0,
            _ => f32::INFINITY,
        };
        Self {
            position: (plain.position - twin.position).length(),
            normal: match (plain.normal, twin.normal) {
                (Some(plain), Some(twin)) => plain.angle_between(twin),
                (None, None) => 0.0,
                _ => f32::INFINITY,
            },
            texture: pair(
                plain.texture.as_ref().map(<[f32; 2]>::as_slice),
                twin.texture.as_ref().map(<[f32; 2]>::as_slice),
            ),
            color: pair(
                plain.color.as_ref().map(<[f32; 4]>::as_slice),
                twin.color.as_ref().map(<[f32; 4]>::as_slice),
            ),
        }
    }

    fn or(self, other: Self) -> Self {
        Self {
            position: self.position.max(other.position),
            normal: self.normal.max(other.normal),
            texture: self.texture.max(other.texture),
            color: self.color.max(other.color),
        }
    }
}

/// Pairs the triangles of two scenes, in any order and with any first corner; each is in one pair.
fn compare(file: &str, plain: &Scene, twin: &Scene) -> Error {
    let plain = triangles(plain);
    let mut twin = triangles(twin);
    assert_eq!(plain.len(), twin.len(), "{file}");
    let mut worst = Error::default();
    for (material, corners) in plain {
        let errors = twin.iter().enumerate().filter(|(_, (other, _))| *other == material).flat_map(
            |(i, (_, candidate))| {
                (0..3).map(move |turn| {
                    let pairs = (0..3).map(|k| Error::of(corners[k], candidate[(k + turn) % 3]));
                    (i, pairs.fold(Error::default(), Error::or))
                })
            },
        );
        let (nearest, error) = errors
            .min_by(|(_, a), (_, b)| a.position.total_cmp(&b.position))
            .unwrap_or_else(|| panic!("{file}: no triangle of {material} is left"));
        twin.swap_remove(nearest);
        worst = worst.or(error);
    }
    worst
}

/// Compressed scenes equal those that the exporters were given, within the numbers of bits that the exporters
/// were told to keep.
#[test]
fn compressed_scenes_equal_their_plain_twins() {
    let plain = read("plain.glb");
    let clips = plain.animation.rig.compatible_clips();
    // Bounds follow from the bits that exporters keep. Normals in radians: 8 bits in octahedra (1/127 on
    // either axis), 8 bits an axis, 10 bits, floats of 8 bits, 16 bits. Colours: the filter keeps 7 of 8 bits
    // of green and of chroma.
    for (file, normal, color) in [
        ("gltf-transform-high.glb", 0.015, 0.0),
        ("gltf-transform-medium.glb", 0.0025, 0.0),
        ("gltfpack-c.glb", 0.008, 0.0),
        ("gltfpack-cc.glb", 0.015, 0.0),
        ("gltfpack-khr.glb", 0.0012, 1.0 / 65535.0),
        ("gltfpack-floats.glb", 0.005, 1.0 / 255.0),
        // The second file, the fallback, does not exist.
        ("gltfpack-fallback.gltf", 0.008, 0.0),
        ("draco-edgebreaker.glb", 0.0025, 0.0),
        ("draco-valence.glb", 0.0025, 0.0),
        ("draco-sequential.glb", 0.0025, 0.0),
    ] {
        let twin = read(file);
        let mut worst = compare(file, &plain, &twin);
        for seconds in [0.0, 0.25, 0.5, 1.2, 2.0] {
            let at = |scene: &Scene| scene.at(&Moment { seconds, clips: clips.clone() }).expect("a rig");
            worst = worst.or(compare(file, &at(&plain), &at(&twin)));
        }
        println!("{file}: {worst:?}");
        // Weights of joints have 8 bits, and joints move their vertices by up to 1.3; rotations of copies, 5
        // long, have 12.
        assert!(worst.position < 0.0026, "{file}: {worst:?}");
        // Texture coordinates have 12 bits of 3.
        assert!(worst.texture < 0.5 * 3.0 / 4095.0 + 1e-6, "{file}: {worst:?}");
        assert!(worst.normal < normal && worst.color <= color + 1e-6, "{file}: {worst:?}");
    }
}

/// Without a filter, decoding restores every bit: the same exporter writes with and without compression the
/// same scene, but for the order of triangles and their first corners.
#[test]
fn compression_without_filters_loses_nothing() {
    let quantized = read("gltfpack-quantized.glb");
    for file in ["gltfpack-c.glb", "gltfpack-fallback.gltf"] {
        let worst = compare(file, &quantized, &read(file));
        let differs = [worst.position as f32, worst.normal, worst.texture, worst.color];
        assert_eq!(differs, [0.0; 4], "{file}");
    }
}

fn texels(scene: &Scene) -> (u32, u32, &[u8]) {
    assert_eq!(scene.images.len(), 1);
    (scene.images[0].width, scene.images[0].height, &scene.images[0].rgba8)
}

/// Every texel equals the one that the library of Basis Universal decodes.
#[test]
fn textures_of_basis_universal_are_decoded() {
    let plain = read("plain.glb");
    for (file, reference, largest, mean) in [
        ("ktx2-etc1s.glb", "ktx2-etc1s.png", 28, 5.7),
        ("ktx2-uastc.glb", "ktx2-uastc.png", 6, 1.01),
        ("ktx2-uastc-zstd.glb", "ktx2-uastc.png", 6, 1.01),
    ] {
        let twin = read(file);
        let bytes = std::fs::read(folder().join(reference)).expect(reference);
        let reference = image::load_from_memory(&bytes).expect(reference).into_rgba8();
        assert_eq!(texels(&twin), (reference.width(), reference.height(), &reference.as_raw()[..]), "{file}");
        assert_eq!(compare(file, &plain, &twin).position, 0.0, "{file}");
        let ((width, height, before), (.., after)) = (texels(&plain), texels(&twin));
        assert_eq!((width, height), (36, 20));
        let differences: Vec<u8> = before.iter().zip(after).map(|(a, b)| a.abs_diff(*b)).collect();
        let worst = differences.iter().copied().max().unwrap_or_default();
        let average = differences.iter().map(|&d| f64::from(d)).sum::<f64>() / differences.len() as f64;
        println!("{file}: at most {worst}, {average:.2} on average, of 255");
        assert!(worst <= largest && average <= mean, "{file}: {worst}, {average}");
    }
}

/// Loads a file of the folder in whose JSON some text is replaced by other text, no longer than it.
fn load_with(file: &str, from: &str, to: &str) -> Result<Scene, SceneError> {
    let mut bytes = std::fs::read(folder().join(file)).expect(file);
    let at = bytes.windows(from.len()).position(|window| window == from.as_bytes()).expect(from);
    bytes[at..at + from.len()].fill(b' ');
    bytes[at..at + to.len()].copy_from_slice(to.as_bytes());
    gltf::from_slice(&folder().join(file), &bytes, &LoadOptions::default())
}

/// Values of a view are checked before its stream is decoded; the message names the view.
#[test]
fn what_views_say_of_their_streams_is_checked() {
    for (from, to, words) in [
        (r#""mode":"TRIANGLES""#, r#""mode":"SQUARES""#, r#"is "SQUARES", which the format does not know"#),
        (r#""filter":"COLOR""#, r#""filter":"COVER""#, r#"is "COVER", which the format does not know"#),
        (r#""mode":"TRIANGLES""#, r#""mode":"INDICES""#, "are no INDICES of"),
        (
            r#""byteStride":8,"mode":"ATTRIBUTES","filter":"QUATERNION""#,
            r#""byteStride":4,"mode":"ATTRIBUTES","filter":"QUATERNION""#,
            "byteStride of 4, not of 8",
        ),
        (
            r#""mode":"ATTRIBUTES","filter":"OCTAHEDRAL""#,
            r#""mode":"TRIANGLES","filter":"OCTAHEDRAL""#,
            "has a filter",
        ),
        (r#""count":732"#, r#""count":731"#, "731 indices, which do not make whole triangles"),
        (r#""count":732"#, r#""count":729"#, "729 elements of 2 bytes, but its view has 1464 bytes"),
        (r#""byteStride":8,"mode""#, r#""byteStride":6,"mode""#, "byteStride of 6, not a multiple of 4"),
        (
            r#"_compression":{"buffer":0"#,
            r#"_compression":{"buffer":9"#,
            "refers to element 9, but there are only 2",
        ),
    ] {
        let error = match load_with("gltfpack-khr.glb", from, to) {
            Ok(_) => panic!("{to} loads"),
            Err(error) => error.to_string(),
        };
        assert!(error.contains("gltfpack-khr.glb: bufferViews[") && error.contains(words), "{to}: {error}");
    }
}

/// Claims of accessors are checked against the Draco stream.
#[test]
fn what_accessors_claim_of_draco_streams_is_checked() {
    for (from, to, words) in [
        (
            r#""bufferView":7,"attributes":{"POSITION":0,"NORMAL":1"#,
            r#""bufferView":99,"attributes":{"POSITION":0"#,
            "refers to element 99, but there are only",
        ),
        (r#""POSITION":0"#, r#""POSITION":9"#, "is attribute 9 of bufferViews["),
        (r#""count":89"#, r#""count":88"#, "claims 88 elements of 3 floats, but its Draco stream has 89"),
        (r#""count":360"#, r#""count":363"#, "claims 363 elements of 1 unsigned"),
        ("DRACO", "DRAKE", "is no mesh that Draco compressed"),
    ] {
        let error = match load_with("draco-edgebreaker.glb", from, to) {
            Ok(_) => panic!("{to} loads"),
            Err(error) => error.to_string(),
        };
        assert!(error.contains("draco-edgebreaker.glb: ") && error.contains(words), "{to}: {error}");
    }
    let path = folder().join("draco-edgebreaker.glb");
    let limits = Limits { triangles: 100, ..Limits::default() };
    let error = load(&path, &LoadOptions { limits, ..LoadOptions::default() }).expect_err("120 triangles");
    assert!(error.to_string().contains("too large for the limits of scenes"), "{error}");
}

/// Decoded bytes count as bytes of buffers, and none are reserved for a stream that is too short for them.
#[test]
fn decoded_bytes_are_bounded() {
    let path = folder().join("gltfpack-cc.glb");
    let bytes = std::fs::read(&path).expect("a file");
    let limits = Limits { file_bytes: bytes.len() as u64, ..Limits::default() };
    assert!(gltf::from_slice(&path, &bytes, &LoadOptions { limits, ..LoadOptions::default() }).is_ok());
    let limits = Limits { file_bytes: 4096, ..Limits::default() };
    match gltf::from_slice(&path, &bytes, &LoadOptions { limits, ..LoadOptions::default() }) {
        Err(SceneError::TooLarge { option: "file_bytes", .. }) => {}
        other => panic!("{other:?}"),
    }
    // A hundred bytes claim to decode to four billion.
    let view = r#"{"buffer":0,"byteLength":4294967280,"byteStride":16,"extensions":{"EXT_meshopt_compression":
        {"buffer":0,"byteLength":44,"byteStride":16,"count":268435455,"mode":"ATTRIBUTES"}}}"#;
    let text = triangle_gltf(r#"[{"mesh":0}]"#, "", "").replace(r#"{"buffer":0,"byteLength":36}"#, view);
    let error = load_bytes(text.as_bytes()).expect_err("too short a stream").to_string();
    assert!(error.contains("are no ATTRIBUTES of 268435455 elements of 16 bytes"), "{error}");
}

/// Damaged streams and images end in a scene or an error.
#[test]
fn damaged_compressed_scenes_do_no_harm() {
    for file in [
        "gltf-transform-high.glb",
        "gltfpack-khr.glb",
        "gltfpack-floats.glb",
        "draco-edgebreaker.glb",
        "draco-valence.glb",
        "draco-sequential.glb",
        "ktx2-etc1s.glb",
        "ktx2-uastc-zstd.glb",
    ] {
        let bytes = std::fs::read(folder().join(file)).expect(file);
        let length = u32::from_le_bytes([bytes[12], bytes[13], bytes[14], bytes[15]]) as usize;
        let mut random = Random::new(37);
        let mut loaded = 0;
        let flips = 1_500;
        for flip in 0..flips {
            let mut damaged = bytes.clone();
            for _ in 0..1 + random.below(3) {
                // The damage hits streams rather than the JSON before them.
                let at = 20 + length + random.below(bytes.len() - length - 20);
                damaged[at] ^= 1 << random.below(8);
            }
            loaded += usize::from(survives(&format!("{file}, flip {flip}"), || load_bytes(&damaged)));
        }
        println!("{file}: {loaded} of {flips} load");
        assert!(loaded > 0, "{file}");
    }
}

/// Damaged KTX2 images: every part of the header and of the data.
#[test]
fn damaged_ktx2_images_do_no_harm() {
    for file in ["ktx2-etc1s.glb", "ktx2-uastc.glb", "ktx2-uastc-zstd.glb"] {
        let bytes = std::fs::read(folder().join(file)).expect(file);
        let at = bytes.windows(8).position(|window| window == b"\xABKTX 20\xBB").expect("an image");
        let bytes = &bytes[at..];
        let limits = Limits { image_pixels: 1 << 16, ..Limits::default() };
        let mut decoded = 0;
        let mut attempt = |damaged: &[u8]| match decode_image(
            Path::new("scene.glb"),
            "image",
            damaged,
            &limits,
            &mut Vec::new(),
        ) {
            Ok(image) => {
                assert_eq!(image.rgba8.len() as u64, u64::from(image.width) * u64::from(image.height) * 4);
                decoded += 1;
            }
            Err(SceneError::Internal { reason, .. }) => panic!("{file}: {reason}"),
            Err(_) => {}
        };
        attempt(bytes);
        (0..bytes.len()).for_each(|length| attempt(&bytes[..length]));
        let mut random = Random::new(41);
        for _ in 0..6_000 {
            let mut damaged = bytes.to_vec();
            for _ in 0..1 + random.below(3) {
                let head = if random.below(2) == 0 { bytes.len() } else { 300 };
                damaged[random.below(head)] = [0, 0xFF, random.below(256) as u8][random.below(3)];
            }
            attempt(&damaged);
        }
        println!("{file}: {decoded} decoded");
        assert!(decoded > 100, "{file}");
    }
}
