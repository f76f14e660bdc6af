//! Stadium: large and small at once, and a bench for every ten seats.

use std::collections::HashMap;

use glam::DVec3;
use rasray_scene::default_view::bounds;
use rasray_scene::{Instance, Scene};

use crate::made::scene;

fn benches(scene: &Scene) -> Vec<&Instance> {
    scene.instances.iter().filter(|instance| scene.meshes[instance.mesh].name.ends_with("seats")).collect()
}

#[test]
fn benches_are_as_many_as_asked_and_stand_beside_each_other() {
    for (spec, count) in
        [("stadium:100", 10), ("stadium:1005", 101), ("stadium", 1_200), ("stadium:15k", 1_500)]
    {
        let scene = scene(spec);
        let benches = benches(&scene);
        assert_eq!(benches.len(), count, "{spec}");
        let mut rows: HashMap<u64, Vec<DVec3>> = HashMap::new();
        for bench in &benches {
            let place = bench.world_from_mesh;
            rows.entry(place.translation.y.to_bits()).or_default().push(place.translation);
            let inward = place.matrix3.z_axis.dot(-DVec3::new(place.translation.x, 0.0, place.translation.z));
            assert!(
                inward > 0.0 && (place.matrix3.determinant() - 1.0).abs() < 1.0e-9,
                "{spec}: it looks outwards"
            );
        }
        for row in rows.values() {
            for (index, one) in row.iter().enumerate() {
                let nearest =
                    row[..index].iter().map(|other| other.distance(*one)).fold(f64::INFINITY, f64::min);
                assert!(nearest > 5.2, "{spec}: benches overlap at {one}, {nearest} m");
            }
        }
    }
}

#[test]
fn the_bowl_is_200_metres_long_and_beads_have_edges_below_a_millimetre() {
    let scene = scene("stadium:100");
    let (low, high) = bounds(&scene).expect("bounds");
    assert!((170.0..=200.0).contains(&(high.x - low.x)), "{low} {high}");
    let mesh = |name: &str| scene.meshes.iter().find(|mesh| mesh.name == name).expect("mesh");
    let beads = mesh("beads");
    let point = |index: u32| DVec3::from_array(beads.positions[index as usize].map(f64::from));
    let edges = beads.indices.chunks_exact(3).flat_map(|c| [(c[0], c[1]), (c[1], c[2]), (c[2], c[0])]);
    let longest = edges.map(|(from, to)| point(from).distance(point(to))).fold(0.0, f64::max);
    assert!(longest < 0.001, "{longest} m");
    let eye = scene.cameras[0].world_from_camera.translation;
    let nearest =
        mesh("teapot").positions.iter().map(|point| DVec3::from_array(point.map(f64::from)).distance(eye));
    assert!(nearest.fold(f64::INFINITY, f64::min) < 0.6);
}
