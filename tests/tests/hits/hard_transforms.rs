//! Mirrored, anisotropic, singular and chained transforms on the device: positions, sides and normals.

use glam::{DAffine3, DMat3, DVec3};
use rasray_ads::{BruteForce, PRIMITIVE_NONE};
use rasray_gpu::Timing;
use rasray_gpu_scene::{GpuScene, Parts, SceneTables, View};
use rasray_integrators::{AovPass, AovPixel, Bands, Wave};
use rasray_scene::{Camera, Projection};
use rasray_shaders_glsl::constants::contract::DRAW_MIRRORED;
use rasray_tests::hard_cases::{self, Scale, Transformed};
use rasray_tests::harness::Bench;
use rasray_tracer::build_until_complete;

const SIZE: u32 = 48;

fn placed(id: &str) -> Transformed {
    hard_cases::transformed(id).expect("it is about transforms")
}

fn tables(transformed: &Transformed) -> SceneTables {
    SceneTables::new(&transformed.scene, DVec3::ZERO, &Parts::ALL).expect("the scene is whole")
}

fn angle(a: DVec3, b: DVec3) -> f64 {
    a.cross(b).length().atan2(a.dot(b))
}

/// The device gets the corners that the cases are made of, bit by bit, and knows what is mirrored.
#[test]
fn the_device_gets_the_triangles_of_the_cases() {
    for (id, mirrored) in [("T1", true), ("T2", false), ("T3", false), ("T4", true)] {
        let tables = tables(&placed(id));
        let case = hard_cases::case(id, Scale { rays: 1, ..Scale::QUICK }).expect("it exists");
        let corner = |index: &u32| tables.posed.positions[*index as usize].map(f32::to_bits);
        let uploaded: Vec<_> = tables.posed.indices.iter().map(corner).collect();
        let stated: Vec<_> =
            case.triangles.as_flattened().iter().map(|corner| corner.map(f32::to_bits)).collect();
        assert_eq!(uploaded, stated, "{id}");
        assert!(
            tables.draw_shadings.iter().all(|draw| (draw.flags & DRAW_MIRRORED != 0) == mirrored),
            "{id}"
        );
    }
}

/// Largest angle of the uploaded normals from those that the adjugate gives, radians.
fn worst_normal(transformed: &Transformed) -> f64 {
    let tables = tables(transformed);
    let first = tables.draw_shadings[0].normals as usize;
    let normals = transformed.scene.meshes[0].normals.as_ref().expect("the mesh is smooth");
    let uploaded = tables.posed_attributes[first..].chunks_exact(3);
    let pairs = normals.iter().zip(uploaded);
    pairs
        .map(|(normal, words)| {
            let found = DVec3::new(words[0].into(), words[1].into(), words[2].into());
            angle(found, DVec3::from(transformed.normal(*normal)))
        })
        .fold(0.0, f64::max)
}

#[test]
fn smooth_normals_are_uploaded_by_the_inverse_transpose() {
    let mut transformed = placed("T2");
    let worst = worst_normal(&transformed);
    assert!(worst < 1e-5, "{worst} rad");
    // Were they moved as positions are, they would be told apart.
    transformed.world_from_mesh[1][1] = 1.0;
    let wrong = worst_normal(&transformed);
    assert!(wrong > 0.1, "{wrong} rad");
}

/// Distance, normal and primitive at all pixels of a camera at `eye` that looks at the middle of the mesh.
fn image(bench: &Bench, transformed: &Transformed, eye: DVec3) -> Vec<AovPixel> {
    let device = bench.device();
    let mesh = &transformed.scene.meshes[0];
    let middle: DVec3 = mesh.positions.iter().map(|p| DVec3::from(transformed.position(*p))).sum::<DVec3>()
        / mesh.positions.len() as f64;
    let back = (eye - middle).normalize();
    let right = DVec3::new(0.3, 1.0, 0.2).cross(back).normalize();
    let camera = Camera {
        name: "eye".to_owned(),
        world_from_camera: DAffine3::from_mat3_translation(
            DMat3::from_cols(right, back.cross(right), back),
            eye,
        ),
        projection: Projection::Perspective { fov_y: 0.6 },
        aspect_ratio: None,
        lens: None,
    };
    let view = View { camera, width: SIZE, height: SIZE, seed: 1 };
    let scene = GpuScene::upload(device, &tables(transformed), &view).expect("the scene fits");
    let mut structure =
        BruteForce::new(device, scene.geometry(), Some(scene.binding()), false).expect("pipelines are made");
    build_until_complete(device, &mut structure, scene.eye(), Timing::None).expect("the build completes");
    let bands = Bands::new(device, [SIZE, SIZE]).expect("a small image");
    let aov = AovPass::new(device, &scene, bands, SIZE * SIZE).expect("a small image fits");
    device.submit(|recorder| aov.record_reset(recorder)).expect("the device works");
    let wave = Wave { first_pixel: 0, pixel_count: SIZE * SIZE, sample: 0 };
    let submitted = device
        .submit(|recorder| aov.record_wave(recorder, (&structure).into(), wave))
        .expect("the device works");
    submitted.value.expect("the wave fits");
    aov.read(device, SIZE * SIZE).expect("the image is readable")
}

/// Largest angle of a pixel's normal from that of the face as it is placed in double precision, and how many
/// pixels see the mesh.
fn worst_pixel(pixels: &[AovPixel], transformed: &Transformed, eye: DVec3) -> (f64, usize) {
    let mesh = &transformed.scene.meshes[0];
    let hits: Vec<_> = pixels.iter().filter(|pixel| pixel.primitive != PRIMITIVE_NONE).collect();
    let angles = hits.iter().map(|pixel| {
        let corners = mesh.indices.as_chunks::<3>().0[pixel.primitive as usize];
        let [a, b, c] = corners.map(|i| DVec3::from(transformed.position(mesh.positions[i as usize])));
        let normal = (b - a).cross(c - a);
        // Whatever the winding, the normal is on the side of the eye.
        let facing = if normal.dot(eye - a) < 0.0 { -normal } else { normal };
        angle(DVec3::from(pixel.normal.map(f64::from)), facing)
    });
    (angles.fold(0.0, f64::max), hits.len())
}

/// Faces of mirrored, flat and sheared meshes: every pixel's normal faces the eye and is that of the face.
#[test]
fn normals_of_pixels_face_the_eye() {
    let bench = Bench::new();
    for (id, eye) in [
        ("T1", DVec3::new(0.1, 0.2, 2.0)),
        ("T1", DVec3::new(-0.5, -1.5, 5.0)),
        ("T3", DVec3::new(0.1, 0.2, 2.5)),
        ("T3", DVec3::new(-0.2, 0.3, 5.5)),
        ("T4", DVec3::new(0.9, -1.5, 3.5)),
    ] {
        let transformed = placed(id);
        let pixels = image(&bench, &transformed, eye);
        let (worst, hits) = worst_pixel(&pixels, &transformed, eye);
        assert!(hits > 100, "{id}: {hits} pixels see the mesh");
        assert!(worst < 1e-5, "{id} from {eye}: {worst} rad");
        // Normals that do not face the ray, as mirrored faces' would without care, are noticed.
        let turned: Vec<_> =
            pixels.iter().map(|pixel| AovPixel { normal: pixel.normal.map(|x| -x), ..*pixel }).collect();
        assert!(worst_pixel(&turned, &transformed, eye).0 > 3.0, "{id}");
    }
}
