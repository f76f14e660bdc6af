use glam::{DAffine3, DMat3, DVec3, Vec2, Vec3};
use rasray_scene::{Filter, Image, Material, Texture, TextureRef, Wrap};

use crate::{
    shading::{
        PosedScene, Ray, ReferenceError, Surface, View, bsdf_sample, facet_normal::facet_normal,
        random::RandomStream,
    },
    testing::{diffuse, quad, scene},
};

const IDENTITY: [[f32; 3]; 2] = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];

fn ray(origin: Vec3, direction: Vec3) -> Ray {
    Ray {
        origin,
        direction: direction.normalize(),
        t_max: f32::INFINITY,
        exclude_primitive: None,
        culls_back_faces: false,
        cone_width: 0.0,
        cone_spread: 0.0,
    }
}

fn unit_quad(material: usize) -> rasray_scene::Mesh {
    quad(Vec3::ZERO, Vec3::X, Vec3::Y, material)
}

fn seen(scene: &rasray_scene::Scene, from_front: bool) -> Surface {
    let posed = PosedScene::new(scene, DVec3::ZERO).expect("valid");
    let z = if from_front { 1.0 } else { -1.0 };
    posed.surface(&ray(Vec3::new(0.5, 0.25, z), Vec3::new(0.0, 0.0, -z)), 1.0, 0, Vec2::new(0.25, 0.25))
}

#[test]
fn the_front_is_counter_clockwise_and_mirrored_with_the_instance() {
    let emitter = Material { emission: [2.0; 3], ..diffuse(0.5) };
    let mut scene = scene(vec![emitter], vec![unit_quad(0)]);
    for (mirrored, double_sided) in [(false, false), (true, false), (false, true), (true, true)] {
        let sign = if mirrored { -1.0 } else { 1.0 };
        scene.instances[0].world_from_mesh =
            DAffine3::from_mat3(DMat3::from_diagonal(DVec3::new(sign, 1.0, 1.0)));
        scene.materials[0].double_sided = double_sided;
        for from_front in [true, false] {
            let surface = seen(&scene, from_front);
            // The mesh's own front faces +z, and mirroring in x keeps that.
            assert_eq!(surface.front, from_front, "{mirrored}");
            assert_eq!(surface.geometric_normal, if from_front { Vec3::Z } else { Vec3::NEG_Z });
            let shines = from_front || double_sided;
            assert_eq!(surface.emission, if shines { Vec3::splat(2.0) } else { Vec3::ZERO });
        }
    }
}

#[test]
fn positions_lie_within_their_bound() {
    let mut mesh = unit_quad(0);
    mesh.positions.iter_mut().for_each(|p| *p = [p[0] * 3.7 + 1000.3, p[1] * 0.1 - 77.7, p[0] + p[1] * 0.3]);
    let corners: Vec<DVec3> = mesh.positions.iter().map(|p| DVec3::from(p.map(f64::from))).collect();
    let scene = scene(vec![diffuse(0.5)], vec![mesh]);
    let posed = PosedScene::new(&scene, DVec3::ZERO).expect("valid");
    let mut largest = 0.0_f64;
    for step in 0..1000 {
        let (b, c) = (f64::from(step) / 2001.0, f64::from(step % 37) / 80.0);
        let barycentrics = Vec2::new(b as f32, c as f32);
        let (b, c) = (f64::from(barycentrics.x), f64::from(barycentrics.y));
        let exact = corners[0] * (1.0 - b - c) + corners[1] * b + corners[2] * c;
        let surface = posed.surface(&ray(Vec3::ZERO, Vec3::X), 1.0, 0, barycentrics);
        let error =
            (surface.position.as_dvec3() - exact).abs().max_element() / f64::from(surface.position_error);
        largest = largest.max(error);
    }
    assert!(largest < 1.0 && largest > 0.01, "{largest}");
}

#[test]
fn shading_normals_are_interpolated_and_facets_face_the_ray() {
    let mut mesh = unit_quad(0);
    let tilted = Vec3::new(0.28, 0.0, 0.96).to_array();
    mesh.normals = Some(vec![tilted; 4]);
    let mut scene = scene(vec![diffuse(0.5)], vec![mesh]);
    assert!((seen(&scene, true).normal - Vec3::from(tilted)).length() < 1.0e-6);
    assert!((seen(&scene, false).normal + Vec3::from(tilted)).length() < 1.0e-6);

    // Scaling in z tilts normals in the opposite sense to positions.
    scene.instances[0].world_from_mesh = DAffine3::from_mat3(DMat3::from_diagonal(DVec3::new(1.0, 1.0, 3.0)));
    let expected = Vec3::new(0.28, 0.0, 0.32).normalize();
    assert!((seen(&scene, true).normal - expected).length() < 1.0e-6);

    scene.meshes[0].normals = Some(vec![[0.0, 0.0, -1.0]; 4]);
    assert!(
        (seen(&scene, true).normal - Vec3::Z).length() < 1.0e-6,
        "a normal that points inwards is turned"
    );

    scene.meshes[0].normals = Some(vec![Vec3::new(0.999, 0.0, 0.0447).to_array(); 4]);
    let posed = PosedScene::new(&scene, DVec3::ZERO).expect("valid");
    let grazing = ray(Vec3::ZERO, Vec3::new(1.0, 0.0, -0.3));
    let surface = posed.surface(&grazing, 1.0, 0, Vec2::splat(0.2));
    let o = -grazing.direction;
    assert!(surface.normal.dot(o) < 0.0, "{} is not bent", surface.normal);
    let facets = facet_normal(surface.normal, surface.geometric_normal, o);
    assert!(facets.dot(o) > 0.005 && (facets.length() - 1.0).abs() < 1.0e-5, "{facets}");
}

fn with_texture(scene: &mut rasray_scene::Scene, texel: [u8; 4]) -> TextureRef {
    scene.images.push(Image { name: "texel".to_owned(), width: 1, height: 1, rgba8: texel.to_vec() });
    scene.textures.push(Texture {
        image: scene.images.len() - 1,
        wrap_u: Wrap::Repeat,
        wrap_v: Wrap::Repeat,
        filter: Filter::Linear,
        mipmapped: true,
    });
    TextureRef { texture: scene.textures.len() - 1, uv_set: 0, uv_transform: IDENTITY }
}

/// Red tilts towards growing u, green towards the image's top: with and without tangents in the mesh,
/// mirrored or not, from either side.
#[test]
fn normal_maps_tilt_towards_u_and_up() {
    let mut scene = scene(vec![diffuse(0.5)], vec![unit_quad(0)]);
    let reference = with_texture(&mut scene, [191, 178, 230, 255]);
    scene.materials[0].normal_texture = Some(reference);
    let tilt = (Vec3::new(191.0, 178.0, 230.0) / 255.0 * 2.0 - 1.0).normalize();
    for with_tangents in [false, true] {
        scene.meshes[0].tangents = with_tangents.then(|| vec![[1.0, 0.0, 0.0, 1.0]; 4]);
        for mirrored in [false, true] {
            let sign = if mirrored { -1.0 } else { 1.0 };
            scene.instances[0].world_from_mesh =
                DAffine3::from_mat3(DMat3::from_diagonal(DVec3::new(sign, 1.0, 1.0)));
            // u runs along x (mirrored: -x); the image's top is at y = 1.
            let expected = Vec3::new(tilt.x * sign as f32, tilt.y, tilt.z);
            let normal = seen(&scene, true).normal;
            assert!((normal - expected).length() < 1.0e-5, "{with_tangents} {mirrored}: {normal} {expected}");
            let behind = seen(&scene, false).normal;
            assert!((behind + expected).length() < 1.0e-5, "{with_tangents} {mirrored}: {behind}");
        }
    }
}

#[test]
fn material_terms_are_factor_times_texture_times_vertex_colour() {
    let mut scene = scene(vec![diffuse(0.5)], vec![unit_quad(0)]);
    let linear = with_texture(&mut scene, [51, 102, 204, 255]);
    scene.meshes[0].colors = Some(vec![[0.5, 1.0, 1.0, 0.25]; 4]);
    let material = &mut scene.materials[0];
    material.base_color = [1.0, 0.5, 1.0, 0.8];
    material.base_color_texture = Some(linear);
    material.metallic_roughness_texture = Some(linear);
    material.transmission_texture = Some(linear);
    (material.metallic, material.roughness, material.transmission) = (0.5, 1.0, 1.0);
    material.alpha_mode = rasray_scene::AlphaMode::Blend;
    let surface = seen(&scene, true);
    let decoded = [51.0, 102.0, 204.0].map(|byte: f32| crate::shading::texture::srgb_decode(byte / 255.0));
    let expected = Vec3::new(decoded[0] * 0.5, decoded[1] * 0.5, decoded[2]);
    assert!((surface.base_color - expected).length() < 1.0e-6);
    assert!((surface.metallic - 0.4).abs() < 1.0e-6 && (surface.roughness - 0.4).abs() < 1.0e-6);
    assert!((surface.transmission - 0.2).abs() < 1.0e-6 && (surface.opacity - 0.2).abs() < 1.0e-6);
}

#[test]
fn scenes_that_name_what_is_not_there_are_refused() {
    let good = scene(vec![diffuse(0.5)], vec![unit_quad(0)]);
    let refused = |change: &dyn Fn(&mut rasray_scene::Scene)| {
        let mut bad = good.clone();
        change(&mut bad);
        matches!(PosedScene::new(&bad, DVec3::ZERO), Err(ReferenceError::Malformed { .. }))
    };
    assert!(!refused(&|_| ()));
    assert!(refused(&|scene| scene.instances[0].mesh = 7));
    assert!(refused(&|scene| scene.meshes[0].material = 1));
    assert!(refused(&|scene| scene.meshes[0].indices[2] = 4));
    assert!(refused(&|scene| scene.meshes[0].colors = Some(vec![[1.0; 4]; 3])));
    assert!(refused(&|scene| {
        scene.materials[0].base_color_texture =
            Some(TextureRef { texture: 0, uv_set: 0, uv_transform: IDENTITY });
    }));
    let positions = vec![[0.0; 3]; 5];
    assert_eq!(
        PosedScene::with_positions(&good, DVec3::ZERO, positions).err(),
        Some(ReferenceError::PositionCount { given: 5, expected: 4 })
    );
}

fn unit(random: RandomStream, dimension: u32) -> Vec3 {
    let [u, v, ..] = random.four(dimension);
    let cosine = 1.0 - 2.0 * u;
    let sine = (1.0 - cosine * cosine).max(0.0).sqrt();
    let azimuth = std::f32::consts::TAU * v;
    Vec3::new(sine * azimuth.cos(), sine * azimuth.sin(), cosine)
}

/// Mirrored directions leave the surface, for any normals; normals that need no bending keep their bits.
#[test]
fn facets_mirror_away_from_the_surface() {
    let g = Vec3::Z;
    let above = |d: Vec3| if d.z < 0.0 { -d } else { d };
    let (mut kept, mut bent) = (0, 0);
    for pixel in 0..20_000 {
        let random = RandomStream { seed: 3, pixel, sample: 0 };
        let (given, o) = (above(unit(random, 0)), above(unit(random, 4)));
        let cosine = given.dot(o);
        let n = if cosine < 0.01 { (given + (0.01 - cosine) * o).normalize() } else { given };
        let mirrored = |n: Vec3| 2.0 * n.dot(o) * n - o;
        let least = 0.01_f32.min(0.9 * o.z);
        let fit = facet_normal(given, g, o);
        if mirrored(n).z >= least {
            assert_eq!(fit, n);
            kept += 1;
            continue;
        }
        bent += 1;
        assert!((mirrored(fit).z - least).abs() < 1.0e-5, "{n} {o}: {}", mirrored(fit));
        assert!((fit.length() - 1.0).abs() < 1.0e-5 && fit.dot(o) > 0.0 && fit.z > 0.0, "{n} {o}: {fit}");
        // The normal is bent in the plane of the mirrored direction and the surface's normal: the light keeps
        // its azimuth.
        let before = mirrored(n).truncate().normalize();
        assert!(before.dot(mirrored(fit).truncate().normalize()) > 0.999, "{n} {o}");
    }
    assert!(kept > 5000 && bent > 5000, "{kept} {bent}");
    // The rule begins without a step.
    let o = Vec3::new(0.6, 0.0, 0.8);
    let leaning = |angle: f32| Vec3::new(-angle.sin(), 0.0, angle.cos());
    let start = 0.5 * (0.8_f32.asin() - 0.01_f32.asin());
    for angle in [start - 1.0e-3, start + 1.0e-3] {
        let fit = facet_normal(leaning(angle), g, o);
        assert!((fit - leaning(start)).length() < 2.0e-3, "{angle} {fit}");
    }
}

/// A polished metal with leaning shading normals absorbs nothing, for every view.
#[test]
fn leaning_mirrors_are_not_black() {
    let mut mesh = unit_quad(0);
    mesh.normals = Some(vec![Vec3::new(-0.8, 0.0, 0.6).to_array(); 4]);
    let polished = Material { metallic: 1.0, roughness: 0.0, ..diffuse(1.0) };
    let scene = scene(vec![polished], vec![mesh]);
    let posed = PosedScene::new(&scene, DVec3::ZERO).expect("valid");
    for step in 0..200 {
        let angle = std::f32::consts::PI * (step as f32 + 0.5) / 200.0;
        let towards = ray(Vec3::ZERO, Vec3::new(-angle.cos(), 0.0, -angle.sin()));
        let surface = posed.surface(&towards, 1.0, 0, Vec2::splat(0.2));
        let sample = bsdf_sample(&surface, -towards.direction, [0.5; 4]).expect("nothing is absorbed");
        assert!(sample.delta && (sample.weight - 1.0).abs().max_element() < 1.0e-5, "{angle} {sample:?}");
        assert!(sample.direction.dot(surface.geometric_normal) > 0.0, "{angle}");
    }
}

/// Fine stripes seen at a grazing angle keep their contrast across them, and more samples per pixel resolve
/// them finer.
#[test]
fn footprints_are_those_of_one_sample_and_do_not_grow_with_the_angle() {
    let mut scene = scene(vec![diffuse(1.0)], vec![unit_quad(0)]);
    let stripes = (0..64 * 64).flat_map(|texel| [if texel % 2 == 0 { 0 } else { 255 }; 4]).collect();
    scene.images.push(Image { name: "stripes".to_owned(), width: 64, height: 64, rgba8: stripes });
    scene.textures.push(Texture {
        image: 0,
        wrap_u: Wrap::Repeat,
        wrap_v: Wrap::Repeat,
        filter: Filter::Linear,
        mipmapped: true,
    });
    scene.materials[0].base_color_texture =
        Some(TextureRef { texture: 0, uv_set: 0, uv_transform: IDENTITY });
    let posed = PosedScene::new(&scene, DVec3::ZERO).expect("valid");
    let contrast = |direction: Vec3, cone_width: f32| {
        let seen = |u: f32| {
            let ray = Ray { cone_width, ..ray(Vec3::Z, direction) };
            posed.surface(&ray, 1.0, 0, Vec2::new(u, 0.25)).base_color.x
        };
        (seen(32.5 / 64.0) - seen(31.5 / 64.0)).abs()
    };
    // A texel is 1/64 m wide: a cone as wide sees level 0, from above and from the side; a cone twice as wide
    // sees a grey.
    for direction in [Vec3::NEG_Z, Vec3::new(0.0, 1.0, -0.05)] {
        assert!(contrast(direction, 1.0 / 64.0) > 0.99, "{direction}");
        assert!(contrast(direction, 2.0 / 64.0) < 0.01, "{direction}");
    }
    let mut view = crate::testing::view([0.0, 0.0, 5.0], [0.0; 3], 8, 1);
    let of = |view: &View| crate::shading::camera_ray(view, DVec3::ZERO, Vec2::splat(4.0)).cone_spread;
    let whole = of(&view);
    view.samples = 16;
    assert_eq!(of(&view), 0.25 * whole);
}
