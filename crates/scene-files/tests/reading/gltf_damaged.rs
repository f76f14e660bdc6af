//! Files that were cut off or have flipped bits: every one ends in a scene that keeps its promises
//! or in a typed error, never in a panic, and soon.

use std::path::Path;
use std::time::{Duration, Instant};

use crate::gltf_support::rich::{rich_glb, rich_gltf};
use crate::gltf_support::{assert_well_formed, kinds, load_bytes, placed_triangles};
use ::gltf::json::Value;
use ::gltf::json::deserialize::from_slice;
use rasray_scene::{Scene, SceneError};
use rasray_scene_files::{Limits, LoadOptions, decode_image, load};

/// Longest time that one small file may take.
const PATIENCE: Duration = Duration::from_secs(2);

/// Generator of well-mixed random numbers.
pub struct Random(u64);

impl Random {
    /// Makes the generator of one of the sequences of numbers.
    pub fn new(seed: u64) -> Self {
        Self(seed)
    }

    /// Returns the next number, below `bound`.
    pub fn below(&mut self, bound: usize) -> usize {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mixed = (self.0 ^ self.0 >> 30).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        let mixed = (mixed ^ mixed >> 27).wrapping_mul(0x94D0_49BB_1331_11EB);
        ((mixed ^ mixed >> 31) % bound as u64) as usize
    }
}

/// Checks one outcome; true if a scene was made.
pub fn survives(what: &str, attempt: impl FnOnce() -> Result<Scene, SceneError>) -> bool {
    let start = Instant::now();
    let result = attempt();
    assert!(start.elapsed() < PATIENCE, "{what} took {:?}", start.elapsed());
    match result {
        Ok(scene) => {
            assert_well_formed(&scene);
            true
        }
        // A caught panic counts as a panic.
        Err(SceneError::Internal { reason, .. }) => panic!("{what}: {reason}"),
        Err(error) => {
            let text = error.to_string();
            // The schema must refuse, with a place, all that the typed tree would refuse.
            assert!(!text.is_empty() && !text.contains("a value of the wrong kind"), "{what}: {text}");
            false
        }
    }
}

#[test]
fn the_undamaged_file_loads() {
    for (what, bytes) in [("GLB", rich_glb()), ("text", rich_gltf())] {
        let scene = load_bytes(&bytes).unwrap_or_else(|error| panic!("{what}: {error}"));
        assert_well_formed(&scene);
        assert_eq!(placed_triangles(&scene), 2 + 3 * 2, "{what}");
        assert!(kinds(&scene).is_empty(), "{what}: {:?}", scene.warnings);
        assert_eq!((scene.lights.len(), scene.cameras.len(), scene.images.len()), (1, 1, 1), "{what}");
    }
}

#[test]
fn every_truncation_is_refused() {
    for (what, bytes) in [("GLB", rich_glb()), ("text", rich_gltf())] {
        for length in 0..bytes.len() {
            let name = format!("{what} of {length} bytes");
            assert!(!survives(&name, || load_bytes(&bytes[..length])), "{name} loads");
        }
    }
}

#[test]
fn flipped_bits_of_gltf_do_no_harm() {
    for (what, bytes, flips) in [("GLB", rich_glb(), 10_000), ("text", rich_gltf(), 5_000)] {
        let mut random = Random::new(17);
        let mut loaded = 0;
        for flip in 0..flips {
            let mut damaged = bytes.clone();
            let bit = random.below(damaged.len() * 8);
            damaged[bit / 8] ^= 1 << (bit % 8);
            loaded +=
                usize::from(survives(&format!("{what}, flip {flip}, bit {bit}"), || load_bytes(&damaged)));
        }
        // The test would show nothing if all files were refused, or none.
        assert!((flips / 50..flips).contains(&loaded), "{what}: {loaded} of {flips} flips load");
    }
}

/// Collects JSON pointers to all values below one.
fn pointers(value: &Value, place: &str, found: &mut Vec<String>) {
    found.push(place.to_owned());
    for (i, item) in value.as_array().into_iter().flatten().enumerate() {
        pointers(item, &format!("{place}/{i}"), found);
    }
    for (name, member) in value.as_object().into_iter().flatten() {
        pointers(member, &format!("{place}/{name}"), found);
    }
}

/// Each value of a file in turn is replaced by one of another kind.
#[test]
fn values_of_another_kind_do_no_harm() {
    let tree: Value = from_slice(&rich_gltf()).expect("the file is JSON");
    let mut places = Vec::new();
    pointers(&tree, "", &mut places);
    let others: Vec<Value> =
        ["null", "true", "-1", "0.5", "1e300", "4294967296", "\"x\"", "[]", "{}", "[[]]"]
            .iter()
            .map(|text| from_slice(text.as_bytes()).expect("the value is JSON"))
            .collect();
    let mut loaded = 0;
    for place in &places {
        for other in &others {
            let mut damaged = tree.clone();
            *damaged.pointer_mut(place).expect("the place is there") = other.clone();
            let text = damaged.to_string();
            loaded += usize::from(survives(&format!("{place}: {other}"), || load_bytes(text.as_bytes())));
        }
    }
    let attempts = places.len() * others.len();
    assert!((attempts / 50..attempts / 2).contains(&loaded), "{loaded} of {attempts} load");
}

#[test]
fn several_damages_at_once_do_no_harm() {
    let bytes = rich_glb();
    let mut random = Random::new(23);
    for round in 0..3_000 {
        let mut damaged = bytes.clone();
        for _ in 0..1 + random.below(8) {
            let at = random.below(damaged.len());
            damaged[at] = match random.below(4) {
                0 => 0,
                1 => 0xFF,
                2 => b'9',
                _ => random.below(256) as u8,
            };
        }
        survives(&format!("round {round}"), || load_bytes(&damaged));
    }
}

const OBJ: &str = "mtllib none.mtl\no tetra\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1 0.5 0.5 0.5\nvt 0 0\nvt 1 0\nvt 0 1\n\
vn 0 0 1\nvn 0 1 0\nusemtl red\nf 1/1/1 2/2/1 3/3/1\nf 1//2 2//2 4//2\ng side\ns 1\nf -4 -1 -2\nf 2 3 4 1\nl 1 2\np 1\n";

fn ply() -> Vec<u8> {
    let mut bytes = b"ply\nformat binary_little_endian 1.0\ncomment small\nelement vertex 4\nproperty float x\n\
property float y\nproperty float z\nproperty uchar red\nelement face 3\nproperty list uchar int vertex_indices\n\
end_header\n"
        .to_vec();
    for [x, y, z] in [[0.0_f32, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]] {
        bytes.extend([x, y, z].iter().flat_map(|x| x.to_le_bytes()));
        bytes.push(200);
    }
    for corners in [&[0_i32, 1, 2][..], &[0, 1, 3], &[0, 1, 2, 3]] {
        bytes.push(corners.len() as u8);
        bytes.extend(corners.iter().flat_map(|corner| corner.to_le_bytes()));
    }
    bytes
}

/// Damages a file of a format that is read from disk.
fn damage(file_name: &str, bytes: &[u8], flips: usize) {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let path = folder.path().join(file_name);
    let attempt = |what: &str, damaged: &[u8]| {
        std::fs::write(&path, damaged).expect("a temporary file");
        survives(&format!("{file_name}, {what}"), || load(Path::new(&path), &LoadOptions::default()))
    };
    assert!(attempt("whole", bytes));
    for length in 0..bytes.len() {
        attempt(&format!("{length} bytes"), &bytes[..length]);
    }
    let mut random = Random::new(29);
    let mut loaded = 0;
    for flip in 0..flips {
        let mut damaged = bytes.to_vec();
        let bit = random.below(damaged.len() * 8);
        damaged[bit / 8] ^= 1 << (bit % 8);
        loaded += usize::from(attempt(&format!("flip {flip}, bit {bit}"), &damaged));
    }
    assert!((flips / 50..flips).contains(&loaded), "{file_name}: {loaded} of {flips} flips load");
}

#[test]
fn damaged_obj_does_no_harm() {
    damage("damaged.obj", OBJ.as_bytes(), 2_000);
}

#[test]
fn damaged_ply_does_no_harm() {
    damage("damaged.ply", &ply(), 2_000);
}

#[test]
fn damaged_images_do_no_harm() {
    let texels =
        image::RgbImage::from_fn(24, 17, |x, y| image::Rgb([x as u8 * 10, y as u8 * 15, (x * y) as u8]));
    for format in [image::ImageFormat::Png, image::ImageFormat::Jpeg] {
        let mut encoded = std::io::Cursor::new(Vec::new());
        texels.write_to(&mut encoded, format).expect("writing to memory cannot fail");
        let bytes = encoded.into_inner();
        let attempt = |damaged: &[u8]| {
            let start = Instant::now();
            let limits = Limits { image_pixels: 1 << 20, ..Limits::default() };
            let result = decode_image(Path::new("scene.glb"), "image", damaged, &limits, &mut Vec::new());
            assert!(start.elapsed() < PATIENCE);
            match result {
                Ok(image) => {
                    assert_eq!(image.rgba8.len() as u64, u64::from(image.width) * u64::from(image.height) * 4)
                }
                Err(SceneError::Internal { reason, .. }) => panic!("{format:?}: {reason}"),
                Err(_) => {}
            }
        };
        attempt(&bytes);
        (0..bytes.len()).for_each(|length| attempt(&bytes[..length]));
        let mut random = Random::new(31);
        for _ in 0..2_000 {
            let mut damaged = bytes.clone();
            let bit = random.below(damaged.len() * 8);
            damaged[bit / 8] ^= 1 << (bit % 8);
            attempt(&damaged);
        }
    }
}
