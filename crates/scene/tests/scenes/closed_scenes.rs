//! Scenes that promise closed solids: every edge has one triangle on each side.

use std::collections::HashMap;

use rasray_scene::{Mesh, Moment, Scene};

use crate::made::scene;

/// Returns the directed edges, by the bits of positions, that do not have exactly one triangle along them and
/// one against them.
fn unmatched_edges(mesh: &Mesh) -> usize {
    let key = |vertex: u32| mesh.positions[vertex as usize].map(|value| (value + 0.0).to_bits());
    let mut along: HashMap<_, u32> = HashMap::new();
    for corners in mesh.indices.chunks_exact(3) {
        for side in 0..3 {
            *along.entry((key(corners[side]), key(corners[(side + 1) % 3]))).or_default() += 1;
        }
    }
    along.iter().filter(|((from, to), count)| **count != 1 || along.get(&(*to, *from)) != Some(&1)).count()
}

/// Returns six times the volume: positive if fronts face outwards.
fn volume(mesh: &Mesh) -> f64 {
    let point = |vertex: u32| glam::DVec3::from_array(mesh.positions[vertex as usize].map(f64::from));
    mesh.indices.chunks_exact(3).map(|c| point(c[0]).dot(point(c[1]).cross(point(c[2])))).sum()
}

/// Asserts that all meshes but the named ones are closed, with fronts outwards.
fn assert_closed(spec: &str, open: &[&str]) {
    let scene = scene(spec);
    for mesh in scene.meshes.iter().filter(|mesh| !open.contains(&mesh.name.as_str())) {
        assert_eq!(unmatched_edges(mesh), 0, "{spec}: {} is open", mesh.name);
        assert!(volume(mesh) > 0.0, "{spec}: {} is inside out", mesh.name);
    }
    for name in open {
        let mesh = scene.meshes.iter().find(|mesh| mesh.name == *name);
        assert!(mesh.is_some_and(|mesh| unmatched_edges(mesh) > 0), "{spec}: {name} is closed");
    }
}

#[test]
fn things_on_the_table_are_closed() {
    for spec in ["still-life", "still-life:detail=0.25", "still-life:detail=1.7"] {
        assert_closed(spec, &["wall", "window"]);
    }
}

#[test]
fn the_water_of_the_pool_is_a_closed_volume_at_every_time() {
    assert_closed("pool", &["basin", "lines", "ground"]);
    let rest = scene("pool");
    let water =
        |scene: &Scene| scene.meshes.iter().find(|mesh| mesh.name == "water").cloned().expect("water");
    let moment = |seconds: f64| Moment { seconds, ..Moment::default() };
    let first = water(&rest);
    for seconds in [0.0, 0.4, 7.25, 20.0] {
        let now = water(&rest.at(&moment(seconds)).expect("it has no files"));
        assert_eq!(unmatched_edges(&now), 0, "{seconds} s");
        assert_eq!(now.indices, first.indices);
        // The water is at rest at the beginning, then has waves of centimetres, and keeps its volume.
        assert_eq!(now.positions == first.positions, seconds == 0.0);
        let moved = now.positions.iter().zip(&first.positions).map(|(a, b)| (a[1] - b[1]).abs());
        assert!(moved.fold(0.0, f32::max) < 0.08, "{seconds} s");
        assert!((volume(&now) / volume(&first) - 1.0).abs() < 0.01, "{seconds} s");
    }
}

#[test]
fn things_in_the_smithy_are_closed() {
    assert_closed("smithy", &["mortar", "daylight"]);
}

#[test]
fn the_bowl_and_its_fittings_are_closed() {
    let open = ["pitch", "mown pitch", "track", "lines", "teapot", "red seats", "white seats", "blue seats"];
    assert_closed("stadium", &open);
}
