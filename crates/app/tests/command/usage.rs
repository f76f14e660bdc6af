//! The built command, as far as it goes without a device: every mistake is answered before one is
//! opened, with two lines on stderr and the documented exit code.

use crate::scripted::{rasray, stderr};
use std::process::{Command, Stdio};

#[test]
fn mistakes_end_with_2_and_name_what_is_wrong_and_the_fix() {
    let folder = tempfile::tempdir().expect("a folder");
    std::fs::write(folder.path().join("broken.glb"), b"glTF\x02\0\0\0but not really").expect("a file");
    std::fs::write(folder.path().join("notes.txt"), b"text").expect("a file");
    std::fs::write(folder.path().join("short.rays"), b"RASRAY").expect("a file");
    let cases = [
        ("render cornell -o a.jpg", "a.jpg", ".png"),
        ("render cornell -o a", "a: ", ".png"),
        ("render cornell -o missing/a.png", "missing", "mkdir"),
        ("render cornell -o a.png --report missing/r.json", "missing/r.json", "mkdir"),
        ("render cornell -o a.png --report a.png", "same file", "two files"),
        ("render cornell -o a.png --aov depth", "--aov", ".exr"),
        ("render cornell -o a.exr --aov motion", "--aov motion", "--frames"),
        ("render cornell -o a.exr --aov direct --integrator ao", "--aov direct", "--integrator path"),
        ("render cornell -o a.exr --aov indirect --adaptive 0.1", "--aov indirect", "leave one"),
        ("render cornell -o a.exr --aov variance --shard 1/2", "--aov variance", "leave one"),
        ("render cornell -o a.exr --aov colour", "colour", "--help"),
        ("render cornell -o a.exr --denoise --shard 1/2", "--denoise", "rasray merge"),
        ("render cornell -o a.exr --denoise --aov direct", "--denoise", "leave one"),
        ("render cornell -o a.exr --exposure 1", "--exposure", ".png"),
        ("render cornell -o a.exr --tone agx", "--tone", ".png"),
        ("render cornell -o a.png --tone filmic", "filmic", "--help"),
        ("render cornell --report r.json --tone agx", "--output", "--help"),
        ("merge r.jsonl a.jsonl --tone agx", "--tone", "leave it out"),
        ("merge r.jsonl a.jsonl --denoise", "--denoise", "leave it out"),
        ("render cornel -o a.png", "cornel", "cornell"),
        ("render missing.glb -o a.png", "missing.glb", "check the name"),
        ("render notes.txt -o a.png", "notes.txt", ".gltf"),
        ("render broken.glb -o a.png", "broken.glb", "export"),
        ("render cornell:walls=7 -o a.png", "walls", "PARAMETER"),
        ("render cornell -o a.png --camera nobody", "nobody", "camera"),
        ("render cornell -o a.png --environment missing.hdr", "missing.hdr", ".hdr"),
        ("render cornell -o a.png --environment blue", "blue", "linear"),
        ("render cornell -o a.png --system brute-force --buckets 4", "--buckets", "mmrt"),
        ("render cornell -o a.png --system brute-force --preset published", "published", "robust"),
        ("render cornell -o a.png --integrator ao --bounces 1", "--bounces", "path"),
        ("render cornell -o a.png --integrator ao --glass-shadows opaque", "--glass-shadows", "path"),
        ("render cornell -o a.png --glass-shadows blue", "blue", "--help"),
        ("render cornell -o a.png --eye 0,0,0 --target 0,0,0", "--eye", "--target"),
        ("render broken.glb --report broken.glb", "scene file", "report.json"),
        ("compare broken.glb --systems mmrt --report ./broken.glb", "scene file", "report.json"),
        ("compare cornell --systems brute-force --storage dllb", "--storage", "mmrt"),
        ("compare cornell --systems brute-force mmrt.sort=on", "mmrt", "--systems"),
        ("compare cornell --systems mmrt --report missing/r.json", "missing/r.json", "mkdir"),
        ("compare cornell --systems mmrt --report a --html ./a", "same file", "two files"),
        ("compare cornell --systems mmrt --html a --markdown ./a", "same file", "two files"),
        ("compare broken.glb --systems mmrt --html broken.glb", "scene file", "report.json"),
        ("compare cornell --systems mmrt --check", "--check", "hard:E5"),
        ("compare cornell --systems mmrt --rays-file missing.rays", "missing.rays", "check the name"),
        ("compare cornell --systems mmrt --rays-file notes.txt", "notes.txt", ".npy"),
        ("compare cornell --systems mmrt --rays-file short.rays", "short.rays", "write the file again"),
        ("compare cornell --systems mmrt --hits-file a", "--hits-file", "rasray compare --help"),
        ("compare cornell --systems mmrt --hits-file a=notes.txt --ray-set eye", "notes.txt", "primitive"),
        ("compare cornell --systems mmrt --hits-file a=b.npy", "--hits-file", "--ray-set"),
        ("compare cornell --systems mmrt --save-rays missing", "missing", "mkdir"),
        ("compare cornell --systems mmrt --repetitions 0", "--repetitions", "--help"),
        ("compare hard:E5 --systems mmrt --image", "--image", "leave it out"),
        ("compare hard:E5 --systems mmrt --size 640x360", "--size", "leave it out"),
        ("compare hard:E5 --systems mmrt --ray-set eye", "--ray-set", "leave it out"),
        ("info cornel", "cornel", "did you mean cornell?"),
        ("render sphere:10k -o a.png", "sphere:10k", "did you mean spheres:10k?"),
        ("render Atrium:detail=2 -o a.png", "Atrium", "did you mean atrium:detail=2?"),
        ("render kitchen -o a.png", "kitchen", "scenes are .gltf"),
        (
            "render spheres:triangle=10k -o a.png",
            "did you mean `triangles=10k`? the scene takes triangles",
            "NAME:",
        ),
        ("render cornell:7 -o a.png", "`7` has no key; the scene takes none", "NAME:"),
        ("render atrium:2 -o a.png", "`2` has no key; write detail=2", "NAME:"),
        ("compare hard:E5 --systems mmrt --time 1", "--time", "leave it out"),
        ("compare hard:E5 --systems mmrt --primary raster", "--primary", "leave it out"),
        ("compare hard:E5 --systems mmrt --occluder shadow-maps", "--occluder", "leave it out"),
        (
            "render cornell -o a.png --shadow-resolution 64",
            "--shadow-resolution 64",
            "--occluder shadow-maps",
        ),
        ("render cornell -o a.png --shadow-points 4", "--shadow-points 4", "--occluder shadow-maps"),
        (
            "render cornell -o a.png --occluder shadow-maps --shadow-points 1025",
            "'1025' for '--shadow-points <N>': must be a whole number from 0 to 1024",
            "--help",
        ),
        (
            "render cornell -o a.png --occluder shadow-maps --shadow-resolution 15",
            "'15' for '--shadow-resolution <N>': must be a whole number from 16",
            "--help",
        ),
        // A scene that does not move is not the fault of an option that was not given.
        ("render cornell -o #.png --frames 0-3", "--frames asks", "leave --frames out"),
        ("render cornell -o a.png --time 1", "--time asks", "leave --time out"),
        ("compare cornell --systems mmrt --time 1", "--time asks", "leave --time out"),
        // Names of other renderers, slips, and options of other commands.
        ("render cornell -o a.png --width 640", "--width", "did you mean '--size WIDTHxHEIGHT'"),
        ("render cornell -o a.png --height=360", "--height", "did you mean '--size WIDTHxHEIGHT'"),
        ("compare cornell --systems mmrt --max-depth 3", "--max-depth", "did you mean '--bounces'?"),
        ("render cornell -o a.png --samples-per-pixel 4", "--samples-per-pixel", "did you mean '--spp'?"),
        ("render cornell -o a.png --systems mmrt", "--systems", "did you mean '--system'?"),
        ("compare cornell --system mmrt", "--system", "did you mean '--systems'?"),
        ("render cornell -o a.png --markdown t.md", "--markdown", "rasray compare"),
        ("render cornell -o a.png --nothing-like-it 4", "--nothing-like-it", "rasray render --help"),
        // Numbers that are negative, not finite or beyond what there is, by the option that they are for.
        ("render cornell -o a.png --spp -1", "'-1' for '--spp <N>': must be a whole number from 1", "--help"),
        ("render cornell -o a.png --seed -1", "'-1' for '--seed <N>'", "--help"),
        (
            "render cornell -o a.png --bounces -.5",
            "'-.5' for '--bounces <N>': must be a whole number from 0",
            "--help",
        ),
        ("render cornell -o a.png --size -640x360", "'-640x360' for '--size <WxH>'", "--help"),
        ("render cornell -o a.png --frames -5-3", "'-5-3' for '--frames <FIRST-LAST>'", "--help"),
        ("render cornell -o a.png --grid -2", "'-2' for '--grid <N>'", "--help"),
        (
            "render cornell -o a.png --fov -inf --eye 0,0,0 --target 1,0,0",
            "'-inf' for '--fov <DEGREES>'",
            "--help",
        ),
        ("render cornell -o a.png --aperture -1 --focus 1", "'-1' for '--aperture <METRES>'", "--help"),
        ("render cornell -o a.png --aperture 0.1 --focus 0", "'0' for '--focus <METRES>'", "--help"),
        ("render cornell -o a.png --focus 1", "--aperture <METRES>", "--help"),
        ("render cornell -o a.png --aperture 0.1", "nothing says what is", "say --focus METRES"),
        (
            "render cornell -o a.png --aperture 0.1 --focus 1 --primary raster",
            "--primary raster draws through a pinhole",
            "write --primary trace, or leave out --aperture",
        ),
        (
            "render cornell -o a.png --aperture 0.1 --focus 1 --primary fragments --system mmrt",
            "--primary fragments draws through a pinhole",
            "write --primary trace, or leave out --aperture",
        ),
        (
            "render cornell -o a.png --primary fragments --system bvh",
            "bvh has no view of the camera",
            "write --system mmrt --views cube+camera",
        ),
        ("render cornell -o a.png --adaptive 0", "'0' for '--adaptive <SHARE>': must be a share", "--help"),
        ("render cornell -o a.png --least-samples 8", "--adaptive <SHARE>", "--help"),
        (
            "render cornell -o a.png --spp 8 --adaptive 0.1 --least-samples 9",
            "--least-samples 9 are more than the 8 of --spp",
            "ask for fewer",
        ),
        (
            "render cornell -o a.png --adaptive 0.1 --primary raster",
            "--primary raster draws camera rays of all pixels",
            "leave one of the two out",
        ),
        (
            "render cornell -o a.exr --adaptive 0.1 --shard 1/2",
            "shares samples by the first of all",
            "make shares of --frames",
        ),
        (
            "render cornell -o a.exr --aov samples --shard 1/2",
            "--aov samples is of a whole image",
            "leave one",
        ),
        ("render cornell -o a.png --aov samples", "a PNG cannot hold what --aov asks for", "write an .exr"),
        ("compare cornell --systems mmrt --adaptive 0.1", "--adaptive", "it is an option of 'rasray render'"),
        ("compare hard:E5 --systems mmrt --aperture 1", "--aperture", "leave it out"),
        ("render cornell -o a.png --ao-distance -1", "'-1' for '--ao-distance <METRES>'", "--help"),
        ("compare cornell --systems mmrt --rays -5", "'-5' for '--rays <N>'", "--help"),
        ("render cornell -o a.png --environment -1,0,0", "--environment -1,0,0 has a value", "at least 0"),
        ("render cornell -o a.png --environment 0,nan,0", "--environment 0,nan,0 has a value", "at least 0"),
        (
            "render cornell -o a.png --eye 1e39,0,0 --target 0,0,0",
            "--eye <X,Y,Z>': each number must be from",
            "--help",
        ),
        (
            "render cornell -o a.png --eye 0,0,1 --target 0,-1e19,0",
            "--target <X,Y,Z>': each number must be from",
            "--help",
        ),
        (
            "render cornell -o a.png --eye 0,0,1 --target 0,0,nan",
            "--target <X,Y,Z>': each number must be from",
            "--help",
        ),
        (
            "render walker -o a.png --time 1e39",
            "--time <SECONDS>': must be a finite number of seconds from -1e9",
            "--help",
        ),
        (
            "render walker -o a.png --time -inf",
            "--time <SECONDS>': must be a finite number of seconds from -1e9",
            "--help",
        ),
        (
            "render cornell -o a.png --exposure nan",
            "--exposure <STOPS>': must be a number from -64",
            "--help",
        ),
        ("render cornell -o a.png --ao-distance 1e39", "--ao-distance <METRES>': must be a finite", "--help"),
    ];
    for (line, named, fix) in cases {
        let output = rasray(folder.path(), line);
        let text = stderr(&output);
        assert_eq!(output.status.code(), Some(2), "{line}: {text}");
        let lines: Vec<_> = text.lines().collect();
        assert_eq!(lines.len(), 2, "{line}: {text}");
        assert!(lines[0].starts_with("error: ") && lines[0].contains(named), "{line}: {text}");
        assert!(lines[1].starts_with("help: ") && lines[1].contains(fix), "{line}: {text}");
        assert!(output.stdout.is_empty(), "{line}");
    }
    let mut left: Vec<_> = std::fs::read_dir(folder.path())
        .expect("the folder")
        .map(|entry| entry.expect("an entry").file_name().to_string_lossy().into_owned())
        .collect();
    left.sort();
    assert_eq!(left, ["broken.glb", "notes.txt", "short.rays"]);
}

#[test]
fn a_hard_case_that_is_not_known_lists_those_that_are() {
    let folder = tempfile::tempdir().expect("a folder");
    for line in ["compare hard: --systems mmrt", "compare hard:E99 --systems mmrt"] {
        let output = rasray(folder.path(), line);
        assert_eq!(output.status.code(), Some(2), "{}", stderr(&output));
        let text = String::from_utf8_lossy(&output.stdout);
        for id in rasray_hard_cases::ids().into_iter().chain(rasray_hard_cases::file_ids()) {
            assert!(text.lines().any(|line| line.starts_with(&format!("  {id} "))), "{id}: {text}");
        }
        assert!(stderr(&output).contains("hard:all"), "{}", stderr(&output));
    }
    let output = rasray(folder.path(), "compare hard:e5 --systems mmrt");
    assert!(stderr(&output).contains("did you mean hard:E5?"), "{}", stderr(&output));
}

#[test]
fn help_and_version_go_to_stdout() {
    let folder = tempfile::tempdir().expect("a folder");
    for (line, words) in [
        ("--help", &["render", "compare", "info", "Exit codes", "Examples"][..]),
        ("render --help", &["--system", "--output", "--ao-distance", "Examples", "sRGB", "SIGINT"]),
        ("compare --help", &["--systems", "--ray-set", "mmrt.march=samples"]),
        ("view --help", &["Examples", "drag", "--features viewer"]),
        ("info --help", &["Examples"]),
        ("--version", &["rasray", env!("CARGO_PKG_VERSION")]),
    ] {
        let output = rasray(folder.path(), line);
        let text = String::from_utf8_lossy(&output.stdout);
        assert_eq!(output.status.code(), Some(0), "{line}");
        for word in words {
            assert!(text.contains(word), "{line}: {word}");
        }
    }
}

#[test]
fn info_shows_a_scene_without_a_device() {
    let folder = tempfile::tempdir().expect("a folder");
    let info = |line: &str| {
        let output = rasray(folder.path(), line);
        assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
        String::from_utf8_lossy(&output.stdout).into_owned()
    };
    let text = info("info cornell");
    assert!(text.contains("triangles") && text.contains("cornell"), "{text}");
    // Walls along the axes, 1.6 square metres of 2 as the axes see them, save nothing; sides of the turned
    // boxes do.
    assert!(text.contains("one view of three  saves 4.8"), "{text}");
    let needed = |text: &str| text.lines().filter(|line| line.contains("  needed  ")).count();
    // Occlusion looks at no material.
    assert!(needed(&text) > 0, "{text}");
    assert_eq!(needed(&info("info cornell --integrator ao")), 0);
}

#[test]
fn stdout_that_takes_nothing_is_lost_data_and_one_that_closes_is_not() {
    let full = match std::fs::File::options().write(true).open("/dev/full") {
        Ok(file) => file,
        Err(_) => return eprintln!("skipped: no /dev/full here"),
    };
    let command = || {
        let mut command = Command::new(env!("CARGO_BIN_EXE_rasray"));
        command.args(["info", "cornell"]);
        command
    };
    let output = command().stdout(Stdio::from(full)).output().expect("the command starts");
    assert_eq!(output.status.code(), Some(4), "{}", stderr(&output));
    let mut child = command().stdout(Stdio::piped()).spawn().expect("the command starts");
    drop(child.stdout.take());
    assert_eq!(child.wait().expect("the command ends").code(), Some(0));
}

#[cfg(not(feature = "viewer"))]
#[test]
fn without_its_window_the_command_says_how_to_build_it() {
    let folder = tempfile::tempdir().expect("a folder");
    let output = rasray(folder.path(), "view cornell");
    assert_eq!(output.status.code(), Some(2));
    let text = stderr(&output);
    assert!(
        text.contains("without its window") && text.contains("--features viewer -- view cornell"),
        "{text}"
    );
}
