//! Scenes that deform: the walker, the cloth.

use std::collections::HashMap;

use glam::DVec3;
use rasray_scene::needs::moving_instances;
use rasray_scene::{Mesh, Moment, Motion, Scene};

use crate::made::scene;

fn at(scene: &Scene, seconds: f64) -> Scene {
    let clips = scene.animation.rig.compatible_clips();
    scene.at(&Moment { seconds, clips }).unwrap_or_else(|error| panic!("{error}"))
}

fn mesh<'a>(scene: &'a Scene, name: &str) -> &'a Mesh {
    scene.meshes.iter().find(|mesh| mesh.name == name).unwrap_or_else(|| panic!("there is a mesh {name}"))
}

/// Returns the positions of vertices in the world.
fn placed(scene: &Scene, name: &str) -> Vec<DVec3> {
    let instance = scene.instances.iter().find(|instance| instance.name == name).expect("an instance");
    let point =
        |point: &[f32; 3]| instance.world_from_mesh.transform_point3(DVec3::from(point.map(f64::from)));
    scene.meshes[instance.mesh].positions.iter().map(point).collect()
}

fn triangles(scene: &Scene) -> usize {
    scene.meshes.iter().map(Mesh::triangle_count).sum()
}

/// True if every edge of a mesh has a triangle on both sides.
fn is_closed(mesh: &Mesh) -> bool {
    let mut sides: HashMap<(u32, u32), i32> = HashMap::new();
    for corners in mesh.indices.chunks_exact(3) {
        for side in 0..3 {
            let (from, to) = (corners[side], corners[(side + 1) % 3]);
            *sides.entry((from.min(to), from.max(to))).or_default() += if from < to { 1 } else { -1 };
        }
    }
    sides.values().all(|sum| *sum == 0)
}

const PARTS: [&str; 6] = ["skin", "shirt", "trousers", "shoes", "hair", "eyes"];

#[test]
fn the_walker_is_a_skin_over_joints_moved_by_a_clip() {
    for (spec, wanted) in [("walker:8k", 8_000.0), ("walker", 30_000.0), ("walker:120k", 120_000.0)] {
        let walker = scene(spec);
        let count = triangles(&walker) as f64;
        assert!((count / wanted - 1.0).abs() < 0.05, "{spec}: {count}");
        assert!(PARTS.iter().all(|part| is_closed(mesh(&walker, part))), "{spec}");
    }
    let walker = scene("walker");
    assert_eq!(walker.motion(), Motion::Rig);
    assert_eq!(
        (walker.animation.clips.as_slice(), walker.animation.duration),
        (&["walk".to_owned()][..], 6.0)
    );
    let rig = &walker.animation.rig;
    assert_eq!((rig.skins.len(), rig.skins[0].joints.len(), rig.deformed.len()), (1, 19, 6));
    let mut blended = 0;
    for deformed in &rig.deformed {
        let binding = deformed.skin.as_ref().expect("a skin");
        for vertex in 0..deformed.positions.len() {
            let weights: Vec<f32> = binding.of_vertex(vertex).map(|(_, weight)| weight).collect();
            assert!((weights.iter().sum::<f32>() - 1.0).abs() < 1.0e-6 && weights.iter().all(|w| *w >= 0.0));
            blended += usize::from(weights.iter().filter(|weight| **weight > 0.05).count() > 1);
        }
    }
    assert!(blended > 3_000, "{blended} vertices follow more than one joint");
    assert_eq!(moving_instances(&walker), [false, true, true, true, true, true, true]);
}

#[test]
fn the_walker_ends_as_it_begins_and_its_normals_stay_on_their_side() {
    let walker = scene("walker:8k");
    let (first, last) = (at(&walker, 0.0), at(&walker, 6.0));
    for part in PARTS {
        let apart = placed(&first, part).into_iter().zip(placed(&last, part)).map(|(a, b)| a.distance(b));
        assert!(apart.fold(0.0, f64::max) < 1.0e-5, "{part}");
    }
    for step in 0..12 {
        let shown = at(&walker, f64::from(step) / 12.0);
        for part in PARTS {
            let mesh = mesh(&shown, part);
            let normals = mesh.normals.as_ref().expect("smooth");
            let mut against = 0;
            for corners in mesh.indices.chunks_exact(3) {
                let point = |k: usize| DVec3::from(mesh.positions[corners[k] as usize].map(f64::from));
                let face = (point(1) - point(0)).cross(point(2) - point(0)).normalize();
                let normal = |k: usize| DVec3::from(normals[corners[k] as usize].map(f64::from));
                assert!((0..3).all(|k| (normal(k).length() - 1.0).abs() < 1.0e-5));
                against += usize::from((0..3).any(|k| normal(k).dot(face) < 0.0));
            }
            // Where skin is folded, as in an armpit, single triangles flip.
            assert!(against * 100 <= mesh.triangle_count(), "{part} at {step}/12: {against} turned");
        }
    }
}

#[test]
fn standing_feet_do_not_slide_and_nothing_is_below_the_ground() {
    let walker = scene("walker");
    let (mut standing, mut longest): (usize, f64) = (0, 0.0);
    for step in 0..60 {
        let seconds = f64::from(step) * 0.1;
        let (now, soon) =
            (placed(&at(&walker, seconds), "shoes"), placed(&at(&walker, seconds + 0.01), "shoes"));
        let lowest = now.iter().map(|point| point.y).fold(f64::INFINITY, f64::min);
        assert!((-0.012..0.02).contains(&lowest), "{seconds} s: {lowest}");
        for (a, b) in now.iter().zip(&soon).filter(|(a, b)| a.y.max(b.y) < 0.005) {
            standing += 1;
            longest = longest.max(a.distance(*b));
        }
    }
    // In this time the body moves by 11 mm.
    assert!(
        standing > 100 && longest < 0.001,
        "{standing} vertices stand, the farthest moves by {longest} m"
    );
}

#[test]
fn the_cloth_falls_over_the_ball_and_keeps_its_triangles() {
    let start = scene("cloth-ball");
    assert_eq!(start.motion(), Motion::Deforming);
    assert_eq!(moving_instances(&start), [true, false, false]);
    assert_eq!(mesh(&start, "cloth").triangle_count(), 10_082);
    assert_eq!(start.animation.duration, 3.0);
    let ball = placed(&start, "ball");
    let middle = ball.iter().sum::<DVec3>() / ball.len() as f64;
    let radius = ball.iter().map(|point| point.distance(middle)).fold(0.0, f64::max);
    for seconds in [0.0, 0.3, 0.6, 1.0] {
        let shown = at(&start, seconds);
        let cloth = mesh(&shown, "cloth");
        assert_eq!(cloth.indices, mesh(&start, "cloth").indices);
        assert_eq!((shown.instances.len(), shown.materials.len(), shown.meshes.len()), (3, 3, 3));
        let point = |corner: &u32| DVec3::from(cloth.positions[*corner as usize].map(f64::from));
        for corners in cloth.indices.chunks_exact(3) {
            let corners: Vec<DVec3> = corners.iter().map(point).collect();
            let centre = corners.iter().sum::<DVec3>() / 3.0;
            for point in corners.iter().chain([&centre]) {
                assert!(point.distance(middle) > radius && point.y > 0.0, "{seconds} s: {point}");
            }
        }
        let normals = cloth.normals.as_ref().expect("smooth");
        assert!(normals.iter().all(|n| (DVec3::from(n.map(f64::from)).length() - 1.0).abs() < 1.0e-5));
    }
    // Earlier moments make no difference, and neither do copies or times out of range.
    let (fresh, used) = (scene("cloth-ball:2k"), scene("cloth-ball:2k"));
    let later = at(&used.clone(), 0.7);
    assert_eq!(mesh(&at(&later, 0.4), "cloth").positions, mesh(&at(&fresh, 0.4), "cloth").positions);
    assert_eq!(mesh(&at(&used, -1.0), "cloth").positions, mesh(&used, "cloth").positions);
    assert_eq!(mesh(&at(&used, 3.0), "cloth").positions, mesh(&at(&used, 1.0e9), "cloth").positions);
}
