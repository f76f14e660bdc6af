//! Clips of a glTF file: keys at the times of frames, channels that cannot be played and why, and the parts
//! of clips that are not read.

use glam::DVec3;
use rasray_scene::Scene;
use rasray_scene::animation::ChannelValues;

use crate::gltf_support::load_bytes;
use crate::gltf_support::moving::{File, TRIANGLE, corners, messages};

/// An exporter writes frame k at k / fps, rounded to f32: frame k is shown at that time, in every
/// interpolation.
#[test]
fn a_frame_shows_the_key_that_was_written_for_it() {
    for fps in [12.0, 23.976, 24.0, 25.0, 29.97, 30.0, 48.0, 50.0, 59.94, 60.0, 120.0] {
        let times: Vec<f32> = (0..=120).map(|key| (f64::from(key) / fps) as f32).collect();
        let places: Vec<f32> = (0..=120).flat_map(|key| [key as f32, 0.0, 0.0]).collect();
        let spline: Vec<f32> = (0..=120)
            .flat_map(|key| [[1.0, 2.0, 3.0], [key as f32, 0.0, 0.0], [4.0, 5.0, 6.0]].concat())
            .collect();
        for (interpolation, values) in [("STEP", &places), ("LINEAR", &places), ("CUBICSPLINE", &spline)] {
            let mut file = File::new();
            let (input, output) = (file.floats("SCALAR", &times), file.floats("VEC3", values));
            let scene = file.load(&format!(
                r#"{TRIANGLE},"nodes":[{{"mesh":0}}],"animations":[{{
                "channels":[{{"sampler":0,"target":{{"node":0,"path":"translation"}}}}],
                "samplers":[{{"input":{input},"output":{output},"interpolation":"{interpolation}"}}]}}]"#
            ));
            for key in 0..=120_u32 {
                let seconds = f64::from(key) / fps;
                let at = |seconds| corners(&scene, 0, seconds)[0];
                assert_eq!(
                    at(seconds),
                    DVec3::new(f64::from(key), 0.0, 0.0),
                    "{interpolation}, {key} at {fps}"
                );
                // The time is that of the command line and that of the file.
                let written = format!("{seconds:.9}").parse().expect("a number");
                assert_eq!(at(written), at(seconds));
                assert_eq!(at(f64::from(times[key as usize])), at(seconds));
                if interpolation == "STEP" && key > 0 {
                    let before = seconds * (1.0 - 1.0e-6);
                    assert_eq!(at(before).x, f64::from(key) - 1.0, "just before {key} at {fps}");
                }
            }
        }
    }
}

/// A clip plays where only some primitives of a mesh have morph targets; the others stay.
#[test]
fn primitives_without_targets_are_not_displaced() {
    for first in [true, false] {
        let mut file = File::new();
        let target = file.floats("VEC3", &[0.0, 0.7, 0.0].repeat(3));
        let (input, output) = (file.floats("SCALAR", &[0.0, 1.0]), file.floats("SCALAR", &[0.0, 1.0]));
        let morphed = format!(r#"{{"attributes":{{"POSITION":0}},"targets":[{{"POSITION":{target}}}]}}"#);
        let plain = r#"{"attributes":{"POSITION":0}}"#.to_owned();
        let primitives = if first { [plain, morphed] } else { [morphed, plain] };
        let scene = file.load(&format!(
            r#""meshes":[{{"primitives":[{}]}}],"nodes":[{{"mesh":0}}],"animations":[{{
            "channels":[{{"sampler":0,"target":{{"node":0,"path":"weights"}}}}],
            "samplers":[{{"input":{input},"output":{output}}}]}}]"#,
            primitives.join(",")
        ));
        assert!(scene.warnings.is_empty(), "{:?}", scene.warnings);
        let heights = [0, 1].map(|instance| corners(&scene, instance, 1.0)[0].y as f32);
        assert_eq!(heights, if first { [0.0, 0.7] } else { [0.7, 0.0] });
    }
}

/// Parts of a channel: the path with its node, times and values, its interpolation, and the expected remark.
type Channel<'a> = (&'a str, &'a [f32], &'a [f32], &'a str, &'a str);

/// The remark on a channel that cannot be played names its fault.
#[test]
fn a_channel_that_cannot_be_played_says_why() {
    let nan = f32::NAN;
    let three = [0.0; 9];
    let cases: &[Channel<'_>] = &[
        ("translation", &[], &[], "LINEAR", "it has no keys"),
        ("translation", &[0.0, nan, 2.0], &three, "LINEAR", "the time of key 1 is NaN"),
        (
            "translation",
            &[0.0, 2.0, 1.0],
            &three,
            "STEP",
            "do not ascend: key 2 is at 1 s, the one before at 2 s",
        ),
        ("scale", &[0.0, 1.0], &three, "LINEAR", "it has 3 values for 2 keys;"),
        ("scale", &[0.0, 1.0], &three, "CUBICSPLINE", "it has 3 values for 2 keys, three of them a key"),
        (
            "scale",
            &[0.0, 1.0, 2.0],
            &[0.0, 0.0, 0.0, 0.0, nan, 0.0, 0.0, 0.0, 0.0],
            "STEP",
            "a value of key 1 is NaN",
        ),
        ("weights", &[0.0, 1.0, 2.0], &[0.0; 5], "LINEAR", "it has 5 weights for 3 keys of 2 morph targets"),
        ("weights on 1", &[0.0], &[0.0], "STEP", "the weights of nodes[1], which has no mesh"),
        ("weights on 2", &[0.0], &[0.0], "STEP", "no primitive of meshes[1] has morph targets"),
        (
            "rotation on 3",
            &[0.0],
            &[0.0, 0.0, 0.0, 1.0],
            "STEP",
            "the rotation of nodes[3], which has a matrix",
        ),
    ];
    for (what, times, values, interpolation, says) in cases {
        let (path, node) = what.split_once(" on ").unwrap_or((what, "0"));
        let kind = match path {
            "rotation" => "VEC4",
            "weights" => "SCALAR",
            _ => "VEC3",
        };
        let mut file = File::new();
        let (input, output) = (file.floats("SCALAR", times), file.floats(kind, values));
        let scene = file.load(&format!(
            r#""meshes":[{{"primitives":[{{"attributes":{{"POSITION":0}},"targets":[{{"POSITION":0}},{{"POSITION":0}}]}}]}},
            {{"primitives":[{{"attributes":{{"POSITION":0}}}}]}}],
            "nodes":[{{"mesh":0}},{{}},{{"mesh":1}},{{"mesh":1,"matrix":[1,0,0,0,0,1,0,0,0,0,1,0,5,0,0,1]}}],
            "animations":[{{"name":"walk","channels":[{{"sampler":0,"target":{{"node":{node},"path":"{path}"}}}}],
            "samplers":[{{"input":{input},"output":{output},"interpolation":"{interpolation}"}}]}}]"#
        ));
        let found = messages(&scene, "bad-channel");
        let [found] = &found[..] else { panic!("{what}: {:?}", scene.warnings) };
        assert!(found.starts_with("animation walk, channel 0: ") && found.contains(says), "{what}: {found}");
        assert!(scene.animation.rig.clips[0].channels.is_empty(), "{what}");
        if !says.contains("ascend") {
            assert!(!found.contains("ascend"), "{what}: {found}");
        }
    }
    // An accessor that suits other uses is named with the channel that needs another form.
    let file = File::new();
    let rest = format!(
        r#"{TRIANGLE},"nodes":[{{"mesh":0}}],"animations":[{{"name":"walk",
        "channels":[{{"sampler":0,"target":{{"node":0,"path":"rotation"}}}}],"samplers":[{{"input":0,"output":0}}]}}]"#
    );
    let text = format!(
        r#"{{"asset":{{"version":"2.0"}},"buffers":[{}],"bufferViews":[{}],"accessors":[{}],{rest}}}"#,
        file.buffers[0], file.views[0], file.accessors[0]
    );
    let error = load_bytes(text.as_bytes()).map(drop).expect_err("times are no vectors").to_string();
    assert!(
        error.contains("accessors[0]") && error.contains("animation walk, channel 0, rotation"),
        "{error}"
    );
}

/// Of two channels for one property the later one counts, and the other is named; rotations without direction
/// are named, too.
#[test]
fn channels_that_are_played_in_part_are_named() {
    let mut file = File::new();
    let input = file.floats("SCALAR", &[0.0]);
    let (near, far) = (file.floats("VEC3", &[1.0, 0.0, 0.0]), file.floats("VEC3", &[2.0, 0.0, 0.0]));
    let nowhere = file.floats("VEC4", &[0.0; 4]);
    let channel = |sampler, path| format!(r#"{{"sampler":{sampler},"target":{{"node":0,"path":"{path}"}}}}"#);
    let scene = file.load(&format!(
        r#"{TRIANGLE},"nodes":[{{"mesh":0}}],"animations":[{{"name":"go","channels":[{},{},{}],"samplers":[
        {{"input":{input},"output":{near}}},{{"input":{input},"output":{far}}},{{"input":{input},"output":{nowhere}}}]}}]"#,
        channel(0, "translation"),
        channel(1, "translation"),
        channel(2, "rotation"),
    ));
    assert_eq!(messages(&scene, "bad-channel").len(), 1);
    assert!(
        messages(&scene, "bad-channel")[0]
            .starts_with("animation go, channel 0: channel 1 animates the same")
    );
    assert!(messages(&scene, "bad-rotation")[0].contains("channel 2: 1 rotations of its keys"));
    assert_eq!(corners(&scene, 0, 0.0)[0], DVec3::new(2.0, 0.0, 0.0));
}

#[test]
fn attributes_that_are_not_read_are_named() {
    let file = File::new();
    let with = |attributes: &str, targets: &str, more: &str| {
        file.load(&format!(
            r#""meshes":[{{"primitives":[{{"attributes":{{"POSITION":0{attributes}}}{targets}}}]{more}}}],
            "nodes":[{{"mesh":0}}]"#
        ))
    };
    let named = |scene: &Scene, words: &[&str]| {
        let found = messages(scene, "unread-attributes");
        assert_eq!(found.len(), words.len(), "{found:?}");
        for (message, word) in found.iter().zip(words) {
            assert!(message.contains(word) && message.starts_with("meshes[0].primitives[0]: "), "{message}");
        }
    };
    named(&with(r#","COLOR_1":0,"SHINE":0,"_OWN":0,"TEXCOORD_7":0"#, "", ""), &["COLOR_1", "SHINE"]);
    let targets = r#","targets":[{"COLOR_0":0},{"POSITION":0,"COLOR_0":0,"TEXCOORD_0":0,"_OWN":0}]"#;
    named(&with("", targets, ""), &["targets displace COLOR_0", "targets displace TEXCOORD_0"]);
    named(&with("", r#","targets":[{"POSITION":0,"NORMAL":0,"TANGENT":0}]"#, ""), &[]);
    for (weights, says) in
        [("[1]", "its mesh has 1 weights for 2"), ("[0,0,1]", "its mesh has 3 weights for 2")]
    {
        let targets = r#","targets":[{"POSITION":0},{"POSITION":0}]"#;
        let scene = with("", targets, &format!(r#","weights":{weights}"#));
        assert!(messages(&scene, "morph-weights")[0].contains(says), "{:?}", scene.warnings);
    }
    let material = file.load(
        r#""meshes":[{"primitives":[{"attributes":{"POSITION":0},"material":0}]}],"nodes":[{"mesh":0}],
        "materials":[{"occlusionTexture":{"index":0}}],"textures":[{}]"#,
    );
    assert!(messages(&material, "unused-texture")[0].contains("occlusionTexture"));
}

/// The values of a channel are those of the file, whatever else is remarked.
#[test]
fn weights_of_several_targets_stay_apart() {
    let mut file = File::new();
    let (input, output) = (file.floats("SCALAR", &[0.0, 1.0]), file.floats("SCALAR", &[0.0, 1.0, 0.5, 0.25]));
    let scene = file.load(&format!(
        r#""meshes":[{{"primitives":[{{"attributes":{{"POSITION":0}},"targets":[{{"POSITION":0}}]}},
        {{"attributes":{{"POSITION":0}},"targets":[{{"POSITION":0}},{{"POSITION":0}}]}}]}}],"nodes":[{{"mesh":0}}],
        "animations":[{{"channels":[{{"sampler":0,"target":{{"node":0,"path":"weights"}}}}],
        "samplers":[{{"input":{input},"output":{output}}}]}}]"#
    ));
    let values = &scene.animation.rig.clips[0].channels[0].values;
    assert!(matches!(values, ChannelValues::Weights { targets: 2, .. }), "{values:?}");
    // Corner 1 is at 1, and each target displaces it by its weight.
    assert_eq!([0, 1].map(|instance| corners(&scene, instance, 0.0)[1].x), [1.0, 2.0]);
    assert_eq!([0, 1].map(|instance| corners(&scene, instance, 1.0)[1].x), [1.5, 1.75]);
}
