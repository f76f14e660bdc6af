//! Numbered files that form one scene over time.

use std::fmt::Write;
use std::path::Path;

use rasray_scene::needs::moving_instances;
use rasray_scene::{Mesh, Moment, Motion, Scene, SceneError};
use rasray_scene_files::{LoadOptions, load};

use crate::gltf_support::scenes_folder;

fn at(scene: &Scene, seconds: f64) -> Scene {
    let clips = scene.animation.rig.compatible_clips();
    scene.at(&Moment { seconds, clips }).unwrap_or_else(|error| panic!("{error}"))
}

fn triangles(scene: &Scene) -> usize {
    scene.meshes.iter().map(Mesh::triangle_count).sum()
}

/// Makes a folder of files `triangles.NN.ply` with as many triangles as given for each number.
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
    // The last file that has begun is shown; before the first and after the last the scene stands still.
    let table = [(-1.0, 7), (0.75, 7), (0.8, 8), (0.89, 8), (0.9, 9), (1.0, 10), (50.0, 10)];
    for (seconds, number) in table {
        let file = format!("triangles.{number:02}.ply");
        assert_eq!(deformer.file(seconds).and_then(Path::file_name), Some(file.as_ref()), "{seconds}");
        let shown = at(&scene, seconds);
        assert_eq!(triangles(&shown), [0, 2, 5, 1][number - 7], "{seconds}");
        assert_eq!((shown.instances.len(), shown.materials.len()), (1, 1));
    }
    // Remarks concern the file that is shown.
    let empty =
        |scene: &Scene| scene.warnings.iter().filter(|warning| warning.kind == "no-triangles").count();
    let later = at(&scene, 0.9);
    assert_eq!((empty(&scene), empty(&later), empty(&at(&later, 0.0))), (1, 0, 1));
    // Every frame is shown at its time, however that is rounded.
    for fps in [23.976, 25.0, 29.97, 48.0] {
        let scene = sequence(folder.path(), "triangles.##.ply", fps).expect("files");
        let deformer = scene.animation.deformer.expect("files");
        for number in 7..=10 {
            let (file, exact) = (format!("triangles.{number:02}.ply"), f64::from(number) / fps);
            for seconds in [exact, f64::from(exact as f32)] {
                assert_eq!(deformer.file(seconds).and_then(Path::file_name), Some(file.as_ref()));
            }
        }
        // The end of the animation, which is in single precision, shows the last file.
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

    // A file that is broken, and one that does not match the first, are errors when they are shown.
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
    let Some(folder) = scenes_folder("a_simulated_cloth_is_shown_from_its_files") else { return };
    let folder = folder.join("deforming/cloth_ball");
    let scene = sequence(&folder, "cloth_ball##.ply", 25.0).expect("two files");
    let (first, second) = (at(&scene, 92.0 / 25.0), at(&scene, 93.0 / 25.0));
    assert_eq!((triangles(&first), triangles(&second)), (92_230, 92_230));
    assert_eq!(first.meshes[0].positions, scene.meshes[0].positions);
    assert_ne!(first.meshes[0].positions, second.meshes[0].positions);
}
