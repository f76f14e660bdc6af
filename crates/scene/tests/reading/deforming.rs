//! Scenes that deform: the walker, the cloth, numbered files.

use std::collections::HashMap;
use std::fmt::Write;
use std::path::{Path, PathBuf};

use glam::DVec3;
use rasray_scene::builtin::builtin;
use rasray_scene::needs::moving_instances;
use rasray_scene::{LoadOptions, Mesh, Moment, Motion, Scene, SceneError, load};

fn scene(spec: &str) -> Scene {
    builtin(spec).unwrap_or_else(|| panic!("{spec} is a built-in")).unwrap_or_else(|error| panic!("{error}"))
}

fn at(scene: &Scene, seconds: f64) -> Scene {
    let clips = scene.animation.rig.compatible_clips();
    scene.at(&Moment { seconds, clips }).unwrap_or_else(|error| panic!("{error}"))
}

fn mesh<'a>(scene: &'a Scene, name: &str) -> &'a Mesh {
    scene.meshes.iter().find(|mesh| mesh.name == name).unwrap_or_else(|| panic!("there is a mesh {name}"))
}

/// Vertices in the world.
fn placed(scene: &Scene, name: &str) -> Vec<DVec3> {
    let instance = scene.instances.iter().find(|instance| instance.name == name).expect("an instance");
    let point =
        |point: &[f32; 3]| instance.world_from_mesh.transform_point3(DVec3::from(point.map(f64::from)));
    scene.meshes[instance.mesh].positions.iter().map(point).collect()
}

fn triangles(scene: &Scene) -> usize {
    scene.meshes.iter().map(Mesh::triangle_count).sum()
}

/// Whether every edge of a mesh has a triangle on both sides.
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
            // Where skin is folded, as in an armpit, single triangles turn.
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
    // In that time the body moves by 11 mm.
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
    // What was asked for before makes no difference, nor do copies, nor times that are out of range.
    let (fresh, used) = (scene("cloth-ball:2k"), scene("cloth-ball:2k"));
    let later = at(&used.clone(), 0.7);
    assert_eq!(mesh(&at(&later, 0.4), "cloth").positions, mesh(&at(&fresh, 0.4), "cloth").positions);
    assert_eq!(mesh(&at(&used, -1.0), "cloth").positions, mesh(&used, "cloth").positions);
    assert_eq!(mesh(&at(&used, 3.0), "cloth").positions, mesh(&at(&used, 1.0e9), "cloth").positions);
}

/// A folder with `triangles.NN.ply` of as many triangles as each number has.
fn numbered(counts: &[(u32, usize)]) -> tempfile::TempDir {
    let folder = tempfile::tempdir().expect("a folder");
    for (number, count) in counts {
        write(&folder.path().join(format!("triangles.{number:02}.ply")), *count);
    }
    folder
}

fn write(path: &Path, count: usize) {
    let mut text = format!(
        "ply\nformat ascii 1.0\nelement vertex {}\nproperty float x\nproperty float y\nproperty float z\nelement face {count}\n\
         property list uchar int vertex_indices\nend_header\n",
        3 * count
    );
    for k in 0..count {
        writeln!(text, "{k} 0 0\n{k} 1 0\n{k} 0 1").expect("text");
    }
    for k in 0..count {
        writeln!(text, "3 {} {} {}", 3 * k, 3 * k + 1, 3 * k + 2).expect("text");
    }
    std::fs::write(path, text).expect("a file");
}

fn sequence(folder: &Path, pattern: &str, fps: f64) -> Result<Scene, SceneError> {
    load(&folder.join(pattern), &LoadOptions { fps, ..LoadOptions::default() })
}

#[test]
fn numbered_files_are_one_scene_over_time() {
    let folder = numbered(&[(7, 0), (8, 2), (9, 5), (10, 1)]);
    std::fs::write(folder.path().join("triangles.9.ply"), "other digits").expect("a file");
    let scene = sequence(folder.path(), "triangles.##.ply", 10.0).expect("files");
    assert_eq!((scene.motion(), scene.instances.len(), triangles(&scene)), (Motion::Changing, 1, 0));
    assert_eq!(scene.animation.duration, 1.0);
    assert_eq!(moving_instances(&scene), [true]);
    let deformer = scene.animation.deformer.clone().expect("files");
    // The last that has begun; before the first and after the last stands still.
    let table = [(-1.0, 7), (0.75, 7), (0.8, 8), (0.89, 8), (0.9, 9), (1.0, 10), (50.0, 10)];
    for (seconds, number) in table {
        let file = format!("triangles.{number:02}.ply");
        assert_eq!(deformer.file(seconds).and_then(Path::file_name), Some(file.as_ref()), "{seconds}");
        let shown = at(&scene, seconds);
        assert_eq!(triangles(&shown), [0, 2, 5, 1][number - 7], "{seconds}");
        assert_eq!((shown.instances.len(), shown.materials.len()), (1, 1));
    }
    // What is remarked on is of the file that is shown.
    let empty =
        |scene: &Scene| scene.warnings.iter().filter(|warning| warning.kind == "no-triangles").count();
    let later = at(&scene, 0.9);
    assert_eq!((empty(&scene), empty(&later), empty(&at(&later, 0.0))), (1, 0, 1));
    // Every number of a frame is shown at its time, however that is rounded.
    for fps in [23.976, 25.0, 29.97, 48.0] {
        let scene = sequence(folder.path(), "triangles.##.ply", fps).expect("files");
        let deformer = scene.animation.deformer.expect("files");
        for number in 7..=10 {
            let (file, exact) = (format!("triangles.{number:02}.ply"), f64::from(number) / fps);
            for seconds in [exact, f64::from(exact as f32)] {
                assert_eq!(deformer.file(seconds).and_then(Path::file_name), Some(file.as_ref()));
            }
        }
        // Its end, which is in single precision, shows the last.
        let last = deformer.file(f64::from(scene.animation.duration)).and_then(Path::file_name);
        assert_eq!(last, Some("triangles.10.ply".as_ref()), "{fps}");
    }
}

#[test]
fn files_that_make_no_sequence_are_refused_by_name() {
    let folder = numbered(&[(1, 1), (2, 1), (4, 1)]);
    let refused = |pattern: &str| match sequence(folder.path(), pattern, 25.0) {
        Ok(_) => panic!("{pattern} was read"),
        Err(error) => error.to_string(),
    };
    let gap = refused("triangles.##.ply");
    assert!(gap.contains("triangles.03.ply is missing"), "{gap}");
    assert!(refused("nothing.####.ply").contains("no such file, such as nothing.0001.ply"));
    assert!(refused("triangles.##.glb").contains(".obj or .ply"));
    assert!(matches!(sequence(folder.path(), "no/such.#.ply", 25.0), Err(SceneError::Read { .. })));

    // A file that is broken, and one that does not go with the first, are errors when they are shown.
    std::fs::write(folder.path().join("triangles.03.ply"), "ply\nformat ascii 1.0\nend").expect("a file");
    let scene = sequence(folder.path(), "triangles.##.ply", 1.0).expect("the first is whole");
    let error = scene.at(&Moment { seconds: 3.0, clips: Vec::new() }).expect_err("broken");
    assert!(error.to_string().contains("triangles.03.ply"), "{error}");
    assert_eq!(triangles(&at(&scene, 4.0)), 1);
    let face = "v 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl a\nf 1 2 3\n";
    let files = [("o.1.obj", String::new()), ("o.2.obj", "usemtl b\nf 1 2 3\n".to_owned())];
    for (name, more) in files {
        std::fs::write(folder.path().join(name), format!("{face}{more}")).expect("a file");
    }
    let scene = sequence(folder.path(), "o.#.obj", 1.0).expect("the first is whole");
    let error = scene.at(&Moment { seconds: 2.0, clips: Vec::new() }).expect_err("another material");
    let text = error.to_string();
    assert!(text.contains("o.2.obj") && text.contains("2 meshes, and o.1.obj has 1"), "{text}");
    std::fs::write(folder.path().join("o.2.obj"), face.replace("usemtl a", "usemtl c")).expect("a file");
    let text =
        scene.at(&Moment { seconds: 2.0, clips: Vec::new() }).expect_err("another material").to_string();
    assert!(text.contains("o.2.obj") && text.contains("material `c`"), "{text}");
}

#[test]
fn a_file_with_such_a_name_is_a_file() {
    let folder = tempfile::tempdir().expect("a folder");
    write(&folder.path().join("a#.ply"), 3);
    let scene = sequence(folder.path(), "a#.ply", 25.0).expect("a file");
    assert_eq!((scene.motion(), triangles(&scene)), (Motion::Still, 3));
}

#[test]
fn a_simulated_cloth_is_shown_from_its_files() {
    let folder =
        std::env::var_os("RASRAY_SCENES").map(|folder| PathBuf::from(folder).join("deforming/cloth_ball"));
    let Some(folder) = folder.filter(|folder| folder.is_dir()) else {
        eprintln!(
            "skipped: a_simulated_cloth_is_shown_from_its_files needs RASRAY_SCENES with deforming/cloth_ball"
        );
        return;
    };
    let scene = sequence(&folder, "cloth_ball##.ply", 25.0).expect("two files");
    let (first, second) = (at(&scene, 92.0 / 25.0), at(&scene, 93.0 / 25.0));
    assert_eq!((triangles(&first), triangles(&second)), (92_230, 92_230));
    assert_eq!(first.meshes[0].positions, scene.meshes[0].positions);
    assert_ne!(first.meshes[0].positions, second.meshes[0].positions);
}
