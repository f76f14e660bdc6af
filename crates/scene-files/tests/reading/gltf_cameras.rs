//! Cameras of a glTF file.

use crate::gltf_support::moving::{File, TRIANGLE, messages};

/// Every image holds the frame of the camera; images of another shape show more.
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
    // Without a frame, and in an image of the frame's shape, the height is that of the file, to the bit.
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
