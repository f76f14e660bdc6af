//! Files far from the origin as a user renders them: the same pictures as of a file that is near.

use crate::scripted::{rasray, stderr};
use std::fmt::Write;
use std::path::Path;

/// A plate of one metre with a rough surface, moved by whole metres; coordinates as exporters write them.
fn plate(path: &Path, by: [f64; 3]) {
    let mut text = String::new();
    for place in 0..121 {
        let (x, y) = (place % 11, place / 11);
        let z = if (x + y) % 2 == 0 { 0.345 } else { 0.375 };
        let point = [0.456 + 0.1 * f64::from(x), 0.654 + 0.1 * f64::from(y), z];
        let [x, y, z] = [0, 1, 2].map(|axis| point[axis] + by[axis]);
        writeln!(text, "v {x:.4} {y:.4} {z:.4}").expect("text");
    }
    for first in (1..111).filter(|place| place % 11 != 0) {
        writeln!(text, "f {first} {} {} {}", first + 1, first + 12, first + 11).expect("text");
    }
    std::fs::write(path, text).expect("a scene");
}

/// Distances along the rays of a camera above the plate, metres; 0 for a miss.
fn depths(folder: &Path, scene: &str, by: [f64; 3]) -> Vec<f32> {
    let at = |point: [f64; 3]| {
        let [x, y, z] = [0, 1, 2].map(|axis| point[axis] + by[axis]);
        format!("{x},{y},{z}")
    };
    let line = format!(
        "render {scene} --integrator raycast --size 24x24 --spp 1 --aov depth --eye {} --target {} -o {scene}.exr",
        at([0.956, 1.154, 2.0]),
        at([0.956, 1.2, 0.345]),
    );
    let output = rasray(folder, &line);
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    let read = exr::prelude::read_all_flat_layers_from_file(folder.join(format!("{scene}.exr")));
    let image = read.expect("an image");
    let channels = image.layer_data.iter().flat_map(|layer| &layer.channel_data.list);
    let depth = channels
        .filter(|channel| channel.name.eq("Z"))
        .flat_map(|channel| channel.sample_data.values_as_f32());
    depth.collect()
}

#[test]
fn a_georeferenced_file_is_seen_as_one_that_is_near() {
    let folder = tempfile::tempdir().expect("a folder");
    let utm = [500_123.0, 4_649_776.0, 112.0];
    plate(&folder.path().join("far.obj"), utm);
    plate(&folder.path().join("near.obj"), [0.0; 3]);
    let (far, near) = (depths(folder.path(), "far.obj", utm), depths(folder.path(), "near.obj", [0.0; 3]));
    assert_eq!((far.len(), near.len()), (576, 576));
    let hits = near.iter().filter(|depth| **depth > 0.0).count();
    assert!(hits > 100, "the plate is seen: {hits}");
    for (far, near) in far.iter().zip(&near) {
        assert!((far - near).abs() < 1.0e-5, "{far} where {near} is right");
    }
}
