//! What moves in a glTF file: keys at the times of frames, channels that cannot be played and why, joints far away, nodes
//! that a skin or a clip makes harmless, and what of it is not read.

use glam::DVec3;
use rasray_scene::animation::ChannelValues;
use rasray_scene::{Moment, Scene};

use crate::gltf_support::{assert_well_formed, data_uri, floats, kinds, load_bytes};

/// A file whose accessors are made one by one.
#[derive(Default)]
struct File {
    buffers: Vec<String>,
    views: Vec<String>,
    accessors: Vec<String>,
}

impl File {
    /// With the corners of a triangle as accessor 0.
    fn new() -> Self {
        let mut file = Self::default();
        file.floats("VEC3", &[0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0]);
        file
    }

    fn accessor(&mut self, bytes: &[u8], component: u32, kind: &str, count: usize) -> usize {
        let index = self.accessors.len();
        self.buffers.push(format!(r#"{{"byteLength":{},"uri":"{}"}}"#, bytes.len(), data_uri(bytes)));
        self.views.push(format!(r#"{{"buffer":{index},"byteLength":{}}}"#, bytes.len()));
        let accessor = format!(
            r#"{{"bufferView":{index},"componentType":{component},"count":{count},"type":"{kind}"}}"#
        );
        self.accessors.push(accessor);
        index
    }

    fn floats(&mut self, kind: &str, values: &[f32]) -> usize {
        let width = match kind {
            "SCALAR" => 1,
            "VEC3" => 3,
            "VEC4" => 4,
            _ => 16,
        };
        self.accessor(&floats(values), 5126, kind, values.len() / width)
    }

    fn load(&self, rest: &str) -> Scene {
        let Self { buffers, views, accessors } = self;
        let text = format!(
            r#"{{"asset":{{"version":"2.0"}},"buffers":[{}],"bufferViews":[{}],"accessors":[{}],{rest}}}"#,
            buffers.join(","),
            views.join(","),
            accessors.join(",")
        );
        let scene = load_bytes(text.as_bytes()).unwrap_or_else(|error| panic!("{error}: {rest}"));
        assert_well_formed(&scene);
        scene
    }
}

const TRIANGLE: &str = r#""meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}]"#;

/// The messages of a scene's warnings of a kind.
fn messages(scene: &Scene, kind: &str) -> Vec<String> {
    let of = scene.warnings.iter().filter(|warning| warning.kind == kind);
    of.map(|warning| warning.message.clone()).collect()
}

/// Where the corners of an instance are at a time, with all clips.
fn corners(scene: &Scene, instance: usize, seconds: f64) -> Vec<DVec3> {
    let clips = (0..scene.animation.clips.len()).collect();
    let posed = scene.at(&Moment { seconds, clips }).expect("a rig");
    let instance = &posed.instances[instance];
    let place = |p: &[f32; 3]| instance.world_from_mesh.transform_point3(DVec3::from(p.map(f64::from)));
    posed.meshes[instance.mesh].positions.iter().map(place).collect()
}

/// An exporter writes frame k at k / fps, rounded to f32: that is where frame k is shown, in every interpolation.
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
                // As the command line and the file have the time.
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

/// The path with its node, times and values of a channel, its interpolation, and what is said of it.
type Channel<'a> = (&'a str, &'a [f32], &'a [f32], &'a str, &'a str);

/// What is wrong with a channel is said of what is wrong.
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
    // An accessor that suits others is named with who needs it otherwise.
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

/// Of two channels for one property the later one counts, and the other is named; rotations without direction, too.
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

/// A triangle that follows joints at these places, by these weights; the joints turn by half a turn about z in a second.
fn skinned(places: &[[f32; 3]], joints: [u8; 4], weights: [f32; 4], mesh_node: &str) -> Scene {
    let mut file = File::new();
    let of = file.accessor(&joints.repeat(3), 5121, "VEC4", 3);
    let shares = file.floats("VEC4", &weights.repeat(3));
    let turn = [0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.6, 0.8];
    let (input, output) = (file.floats("SCALAR", &[0.0, 1.0]), file.floats("VEC4", &turn));
    let nodes: Vec<_> = places.iter().map(|place| format!(r#"{{"translation":{place:?}}}"#)).collect();
    let numbers: Vec<_> = (1..=places.len()).map(|node| node.to_string()).collect();
    let channels: Vec<_> = (numbers.iter())
        .map(|node| format!(r#"{{"sampler":0,"target":{{"node":{node},"path":"rotation"}}}}"#))
        .collect();
    file.load(&format!(
        r#""meshes":[{{"primitives":[{{"attributes":{{"POSITION":0,"JOINTS_0":{of},"WEIGHTS_0":{shares}}}}}]}}],
        "nodes":[{{"mesh":0,"skin":0{mesh_node}}},{}],"skins":[{{"joints":[{}]}}],
        "animations":[{{"channels":[{}],"samplers":[{{"input":{input},"output":{output}}}]}}]"#,
        nodes.join(","),
        numbers.join(","),
        channels.join(",")
    ))
}

/// Where a joint is that moves nothing, and which joint comes first, does not cost a digit.
#[test]
fn a_far_joint_without_weight_costs_no_digits() {
    let (far, near, beside) = ([1.0e5, -3.0e6, 7.0], [0.25, 0.5, 0.125], [-0.5, 0.75, 0.3]);
    let third = [0.3, 0.3, 0.1, 0.3];
    let expected = skinned(&[near, beside], [0, 1, 0, 1], third, "");
    for (places, joints) in [
        ([far, near, beside], [1, 2, 1, 2]),
        ([near, far, beside], [0, 2, 0, 2]),
        ([near, beside, far], [0, 1, 0, 1]),
        ([beside, far, near], [2, 0, 2, 0]),
    ] {
        let scene = skinned(&places, joints, third, "");
        for seconds in [0.0, 0.4, 1.0] {
            let rounded = |scene: &Scene| {
                corners(scene, 0, seconds)
                    .into_iter()
                    .map(|corner| corner.as_vec3().to_array())
                    .collect::<Vec<_>>()
            };
            // The joints' shares are added in another order.
            for (found, expected) in
                rounded(&scene).into_flattened().iter().zip(rounded(&expected).as_flattened())
            {
                assert!(
                    (found - expected).abs() <= f32::EPSILON * expected.abs(),
                    "{found} {expected} {places:?}"
                );
            }
        }
    }
}

/// Vertices keep their digits where joints with weight are far from those of other vertices, and far from the origin.
#[test]
fn positions_of_skins_keep_their_digits_anywhere() {
    for place in [[0.0; 3], [3.0e5, 0.0, -2.0e6], [-40.0, 8.0e6, 0.5]] {
        let at = |offset: f32| place.map(|x| x + offset);
        // Weights whose sum is not 1 in f32.
        let scene = skinned(&[at(0.0), at(1.0)], [0, 1, 0, 1], [0.1, 0.2, 0.3, 0.3], "");
        for seconds in [0.0, 0.3] {
            // A turn about z, of 2 asin(0.6) in a second, and the mean of both joints: 4 to 5.
            let angle = 2.0 * 0.6_f64.asin() * seconds;
            let weights = [0.1_f32, 0.2, 0.3, 0.3].map(f64::from);
            let sum: f64 = weights.iter().sum();
            let share = (weights[1] + weights[3]) / sum;
            let [a, b] = [at(0.0), at(1.0)].map(|place| DVec3::from(place.map(f64::from)));
            let origin = a * (1.0 - share) + b * share;
            for (found, corner) in
                corners(&scene, 0, seconds).into_iter().zip([DVec3::ZERO, DVec3::X, DVec3::Y])
            {
                let expected = origin + glam::DMat3::from_rotation_z(angle) * corner;
                // Weights are rounded once more, and keys hold single precision; the way from the origin plays no part.
                assert!((found - expected).length() < 4.0e-7, "{found} {expected}");
            }
        }
    }
}

#[test]
fn weights_that_move_nothing_are_named() {
    let scene = skinned(&[[1.0, 0.0, 0.0], [2.0, 0.0, 0.0]], [1, 0, 0, 0], [0.0; 4], "");
    assert!(messages(&scene, "bad-weights")[0].contains("3 vertices have no joint with weight"));
    assert_eq!(corners(&scene, 0, 0.0)[0], DVec3::X, "they follow the first");
    let scene = skinned(&[[1.0, 0.0, 0.0], [2.0, 0.0, 0.0]], [1, 0, 0, 0], [1.0, -1.0, f32::NAN, 0.0], "");
    assert!(messages(&scene, "bad-weights")[0].contains("6 weights of joints are negative or not finite"));
    let mut file = File::new();
    let joints = file.accessor(&[0; 12], 5121, "VEC4", 3);
    let scene = file.load(&format!(
        r#""meshes":[{{"primitives":[{{"attributes":{{"POSITION":0,"JOINTS_0":{joints}}}}}]}}],
        "nodes":[{{"mesh":0,"skin":0}}],"skins":[{{"joints":[0]}}]"#
    ));
    assert_eq!(kinds(&scene), ["skin-without-joints"]);
}

/// A node with a scale of 0 is worth a warning where it flattens something: not the node of a skin, which plays no part, not
/// a joint without weight, and not one that a clip that plays scales.
#[test]
fn only_what_flattens_something_is_named() {
    let zero = r#","scale":[0,0,0]"#;
    assert!(skinned(&[[0.0; 3]], [0; 4], [1.0, 0.0, 0.0, 0.0], zero).warnings.is_empty());
    let file = File::new();
    let flat =
        |nodes: &str| messages(&file.load(&format!(r#"{TRIANGLE},"nodes":{nodes}"#)), "zero-scale").len();
    assert_eq!(flat(r#"[{"scale":[0,0,0],"children":[1]},{"children":[2]},{"mesh":0}]"#), 1);
    assert_eq!(flat(r#"[{"scale":[0,0,0]},{"mesh":0}]"#), 0);

    let mut file = File::new();
    let (input, output) =
        (file.floats("SCALAR", &[0.0, 1.0]), file.floats("VEC3", &[0.0, 0.0, 0.0, 1.0, 1.0, 1.0]));
    let mut scene = file.load(&format!(
        r#"{TRIANGLE},"nodes":[{{"mesh":0,"scale":[0,0,0]}},{{"mesh":0,"scale":[1,0,1]}}],"animations":[{{
        "channels":[{{"sampler":0,"target":{{"node":0,"path":"scale"}}}}],"samplers":[{{"input":{input},"output":{output}}}]}}]"#
    ));
    assert_eq!(messages(&scene, "zero-scale").len(), 1);
    assert!(messages(&scene, "zero-scale")[0].starts_with("nodes[0] and 1 more: "), "at rest both are flat");
    let posed = scene.at(&Moment { seconds: 0.0, clips: vec![0] }).expect("a rig");
    assert!(messages(&posed, "zero-scale")[0].starts_with("nodes[1]: "), "{:?}", posed.warnings);
    scene.warn_while_playing(&[0]);
    assert_eq!(messages(&scene, "zero-scale"), messages(&posed, "zero-scale"));
    scene.warn_while_playing(&[]);
    assert!(messages(&scene, "zero-scale")[0].contains("1 more"));
}

/// What a camera frames is in every image; images of another shape show more.
#[test]
fn cameras_frame_what_they_say() {
    let file = File::new();
    let camera = |text: &str| {
        let scene = file.load(&format!(r#"{TRIANGLE},"nodes":[{{"mesh":0,"camera":0}}],"cameras":[{text}]"#));
        (scene.cameras[0].clone(), messages(&scene, "camera-range").join("; "))
    };
    let parallel = |sides: &str| {
        camera(&format!(r#"{{"type":"orthographic","orthographic":{{{sides},"znear":0.1,"zfar":9}}}}"#))
    };
    let perspective = |more: &str| {
        camera(&format!(r#"{{"type":"perspective","perspective":{{"yfov":1.2,"znear":0.1{more}}}}}"#))
    };
    let (wide, said) = parallel(r#""xmag":2,"ymag":1"#);
    assert!(said.is_empty(), "{said}");
    let tangent = (0.5 * f64::from(1.2_f32)).tan();
    for (camera, half) in
        [(&wide, [2.0, 1.0]), (&perspective(r#","aspectRatio":2"#).0, [2.0 * tangent, tangent])]
    {
        for [width, height] in [[90, 90], [180, 90], [360, 90], [30, 90], [1, 1000], [641, 360]] {
            let [across, up] = camera.half_extents(width, height);
            let slack = 1.0 - 1.0e-12;
            assert!(across >= half[0] * slack && up >= half[1] * slack, "{width}x{height}: {across} {up}");
            assert!(
                across <= half[0] / slack || up <= half[1] / slack,
                "no more than it takes: {width}x{height}"
            );
            assert!((across / up - f64::from(width) / f64::from(height)).abs() < 1.0e-9, "pixels are square");
        }
    }
    // Without a frame, and in an image of the frame's shape, the height is what the file says, to the bit.
    assert_eq!(perspective("").0.half_extents(30, 90)[1], tangent);
    assert_eq!(perspective(r#","aspectRatio":1.7777777777777777"#).0.half_extents(1920, 1080)[1], tangent);
    assert_eq!(parallel(r#""xmag":-2,"ymag":-1"#).0.half_extents(90, 90), [2.0, 2.0]);
    for (said, says) in [
        (parallel(r#""xmag":-2,"ymag":1"#).1, "xmag -2 is negative, and taken as 2"),
        (parallel(r#""xmag":0,"ymag":1"#).1, "xmag 0 is no width"),
        (perspective(r#","aspectRatio":0"#).1, "aspectRatio 0 is not above 0"),
    ] {
        assert!(said.contains(says), "{said}");
    }
}

/// A channel's values are as the file has them, whatever else is remarked.
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
    // Corner 1 is at 1, and each target displaces it by as much as its weight.
    assert_eq!([0, 1].map(|instance| corners(&scene, instance, 0.0)[1].x), [1.0, 2.0]);
    assert_eq!([0, 1].map(|instance| corners(&scene, instance, 1.0)[1].x), [1.5, 1.75]);
}

/// What a skin hides at rest by a scale of 0 is no fault of the mesh: its triangles and normals are there when it is shown.
#[test]
fn what_a_joint_hides_at_rest_is_not_said_to_be_broken() {
    let mut file = File::new();
    let (joints, weights) =
        (file.accessor(&[0; 12], 5121, "VEC4", 3), file.floats("VEC4", &[1.0, 0.0, 0.0, 0.0].repeat(3)));
    let normals = file.floats("VEC3", &[0.0, 0.0, 1.0].repeat(3));
    let (input, output) = (file.floats("SCALAR", &[0.0]), file.floats("VEC3", &[1.0; 3]));
    let rest = |clips: &str| {
        file.load(&format!(
            r#""meshes":[{{"primitives":[{{"attributes":{{"POSITION":0,"NORMAL":{normals},"JOINTS_0":{joints},"WEIGHTS_0":{weights}}}}}]}}],
            "nodes":[{{"mesh":0,"skin":0}},{{"scale":[0,0,0]}}],"skins":[{{"joints":[1]}}]{clips}"#
        ))
    };
    let scene = rest(&format!(
        r#","animations":[{{"channels":[{{"sampler":0,"target":{{"node":1,"path":"scale"}}}}],
        "samplers":[{{"input":{input},"output":{output}}}]}}]"#
    ));
    assert_eq!(kinds(&scene), ["zero-scale"], "{:?}", scene.warnings);
    assert!(scene.meshes[0].normals.is_some());
    let shown = scene.at(&Moment { seconds: 0.0, clips: vec![0] }).expect("a rig");
    assert!(shown.warnings.is_empty(), "{:?}", shown.warnings);
    assert_eq!(shown.meshes[0].normals, Some(vec![[0.0, 0.0, 1.0]; 3]));
    // Without a clip it is so for good.
    assert!(kinds(&rest("")).contains(&"degenerate-triangles"));
}

#[test]
fn skins_and_cameras_say_what_is_wrong_with_them() {
    let mut file = File::new();
    let joints = file.accessor(&[0; 12], 5121, "VEC4", 3);
    let weights = file.floats("VEC4", &[1.0, 0.0, 0.0, 0.0].repeat(3));
    let identity = [1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0];
    for (place, value, says) in
        [(12, f32::NAN, "1 matrices are not finite"), (3, 0.5, "1 matrices are projective")]
    {
        let mut matrix = identity;
        matrix[place] = value;
        let mut file = File {
            buffers: file.buffers.clone(),
            views: file.views.clone(),
            accessors: file.accessors.clone(),
        };
        let matrices = file.floats("MAT4", &matrix);
        let scene = file.load(&format!(
            r#""meshes":[{{"primitives":[{{"attributes":{{"POSITION":0,"JOINTS_0":{joints},"WEIGHTS_0":{weights}}}}}]}}],
            "nodes":[{{"mesh":0,"skin":0}},{{}}],"skins":[{{"joints":[1],"inverseBindMatrices":{matrices}}}]"#
        ));
        let found = messages(&scene, "skin-matrices");
        assert!(found.len() == 1 && found[0].contains(says), "{:?}", scene.warnings);
        assert_eq!(corners(&scene, 0, 0.0)[1], DVec3::X);
    }
    for (node, camera, says) in [
        (
            "",
            r#"{"type":"perspective","perspective":{"yfov":9,"znear":1}}"#,
            "yfov 9 is not between 0 and pi",
        ),
        (
            "",
            r#"{"type":"orthographic","orthographic":{"xmag":1,"ymag":0,"znear":1,"zfar":2}}"#,
            "ymag 0 is no height",
        ),
        ("", r#"{"type":"perspective"}"#, "it has no perspective"),
        (
            r#","scale":[0,0,0]"#,
            r#"{"type":"perspective","perspective":{"yfov":1,"znear":1}}"#,
            "looks in no direction",
        ),
    ] {
        let scene = file
            .load(&format!(r#"{TRIANGLE},"nodes":[{{"mesh":0}},{{"camera":0{node}}}],"cameras":[{camera}]"#));
        let found = messages(&scene, "bad-camera");
        assert!(found.len() == 1 && found[0].contains(says), "{:?}", scene.warnings);
    }
}
