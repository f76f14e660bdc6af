//! Position of the default camera in rooms and around solids, and emission that counts as light.

use glam::{DAffine3, DVec3};
use rasray_scene::default_view::{bounds, default_camera, default_light, ensure_lit, is_lit};
use rasray_scene::needs::{Needs, Term, Workload};
use rasray_scene::{
    Camera, Environment, Filter, Image, Instance, Light, Material, Mesh, Projection, Scene, Texture,
    TextureRef, Wrap,
};

/// Quads of a box, seen counter-clockwise from outside, by the corners' bits (x, y, z). In order: left,
/// right, floor, ceiling, back (-z), front.
const SIDES: [[usize; 4]; 6] =
    [[0, 4, 6, 2], [1, 3, 7, 5], [0, 1, 5, 4], [2, 6, 7, 3], [0, 2, 3, 1], [4, 5, 7, 6]];
const FLOOR: usize = 2;
const FRONT: usize = 5;

/// Makes a box of this size around the origin without some of its sides.
fn box_mesh(size: [f32; 3], inwards: bool, without: &[usize]) -> Mesh {
    let corner = |bits: usize| [0, 1, 2].map(|axis| size[axis] * ((bits >> axis & 1) as f32 - 0.5));
    let mut indices = Vec::new();
    for (_, quad) in SIDES.iter().enumerate().filter(|(side, _)| !without.contains(side)) {
        for mut triangle in [[quad[0], quad[1], quad[2]], [quad[0], quad[2], quad[3]]] {
            if inwards {
                triangle.swap(1, 2);
            }
            indices.extend(triangle.map(|index| index as u32));
        }
    }
    Mesh { positions: (0..8).map(corner).collect(), indices, ..Mesh::default() }
}

fn scene_of(placed: Vec<(Mesh, DAffine3)>) -> Scene {
    let mut scene = Scene { materials: vec![Material::default()], ..Scene::default() };
    for (mesh, world_from_mesh) in placed {
        let instance = Instance { name: "box".to_owned(), mesh: scene.meshes.len(), world_from_mesh };
        scene.instances.push(instance);
        scene.meshes.push(mesh);
    }
    scene
}

fn one(mesh: Mesh) -> Scene {
    scene_of(vec![(mesh, DAffine3::IDENTITY)])
}

const HALL: [f32; 3] = [10.0, 3.0, 4.0];

fn eye(camera: &Camera) -> DVec3 {
    camera.world_from_camera.translation
}

fn forward(camera: &Camera) -> DVec3 {
    -camera.world_from_camera.matrix3.z_axis
}

fn stands_inside(scene: &Scene) -> bool {
    let (low, high) = bounds(scene).expect("triangles");
    let eye = eye(&default_camera(scene));
    eye.cmpgt(low).all() && eye.cmplt(high).all()
}

#[test]
fn in_a_hall_the_camera_looks_along_it() {
    let scene = one(box_mesh(HALL, true, &[]));
    let camera = default_camera(&scene);
    let (eye, forward) = (eye(&camera), forward(&camera));
    let clearance = 0.02 * DVec3::new(10.0, 3.0, 4.0).length();
    let walls = DVec3::new(5.0, 1.5, 2.0) - eye.abs();
    assert!(walls.min_element() >= clearance * (1.0 - 1.0e-9), "{eye} is clear of the walls");
    assert!(forward.x.abs() > 0.9 && forward.y < 0.0 && forward.y > -0.1, "along the hall: {forward}");
    assert!(eye.x * forward.x < -3.0, "it stands at one end and sees the other: {eye}");
    let Projection::Perspective { fov_y } = camera.projection else { panic!("perspective") };
    assert!((60.0..=70.001).contains(&fov_y.to_degrees()), "{}", fov_y.to_degrees());
    let again = default_camera(&scene);
    assert_eq!(camera.world_from_camera, again.world_from_camera);
}

#[test]
fn a_solid_is_seen_from_outside() {
    assert!(!stands_inside(&one(box_mesh(HALL, false, &[]))));
    let hall = box_mesh(HALL, true, &[]);
    let mut unreliable = hall.clone();
    for triangle in unreliable.indices.chunks_exact_mut(3).step_by(2) {
        triangle.swap(1, 2);
    }
    assert!(stands_inside(&one(hall)));
    assert!(!stands_inside(&one(unreliable)), "sides at random");
}

#[test]
fn mirrors_change_nothing_about_sides() {
    let mirror = DAffine3::from_scale(DVec3::new(-1.0, 1.0, 1.0));
    assert!(stands_inside(&scene_of(vec![(box_mesh(HALL, true, &[]), mirror)])));
    assert!(!stands_inside(&scene_of(vec![(box_mesh(HALL, false, &[]), mirror)])));
}

#[test]
fn size_and_place_in_the_world_do_not_matter() {
    let near = eye(&default_camera(&one(box_mesh(HALL, true, &[]))));
    for exponent in [-6, 0, 6] {
        let scale = 10.0_f64.powi(exponent);
        for shift in [0.0, 1.0e4] {
            let offset = DVec3::new(shift, -shift, shift) * scale;
            let place = DAffine3::from_translation(offset) * DAffine3::from_scale(DVec3::splat(scale));
            let scene = scene_of(vec![(box_mesh(HALL, true, &[]), place)]);
            let there = (eye(&default_camera(&scene)) - offset) / scale;
            assert!((there.abs() - near.abs()).length() < 1.0e-6, "{near} {there} at {scale} + {shift}");
        }
    }
}

/// Makes a box with walls of its own on both sides, without some sides of both.
fn lined(without: &[usize]) -> Vec<(Mesh, DAffine3)> {
    vec![
        (box_mesh([2.0; 3], false, without), DAffine3::IDENTITY),
        (box_mesh([1.9; 3], true, without), DAffine3::IDENTITY),
    ]
}

#[test]
fn hollow_things_are_seen_from_outside() {
    for without in [&[][..], &[FLOOR], &[FRONT], &[0], &[FLOOR, FRONT]] {
        assert!(!stands_inside(&scene_of(lined(without))), "without {without:?}");
    }
    // Objects inside, as in a machine, do not make it a room.
    let part = |x: f64| (box_mesh([0.3; 3], false, &[]), DAffine3::from_translation(DVec3::new(x, 0.5, 0.0)));
    let machine = [lined(&[]), vec![part(-0.6), part(0.0), part(0.6)]].concat();
    assert!(!stands_inside(&scene_of(machine)));
}

#[test]
fn a_building_made_for_its_inside_is_seen_from_inside() {
    // The scene is a house around four rows of columns, with more surface in it than on it.
    let mut parts = vec![
        (box_mesh([10.4, 3.4, 4.4], false, &[]), DAffine3::IDENTITY),
        (box_mesh(HALL, true, &[]), DAffine3::IDENTITY),
    ];
    for place in 0..36 {
        let (x, z) = (f64::from(place % 9) - 4.0, [-1.8, -1.4, 1.4, 1.8][place as usize / 9]);
        parts
            .push((box_mesh([0.3, 3.0, 0.3], false, &[]), DAffine3::from_translation(DVec3::new(x, 0.0, z))));
    }
    assert!(stands_inside(&scene_of(parts.clone())));
    parts.truncate(2);
    assert!(!stands_inside(&scene_of(parts)), "as large outside as inside");
}

#[test]
fn the_outside_view_fills_its_picture() {
    for size in [[2.0; 3], [4.0, 1.0, 1.0], [1.0, 4.0, 1.0], [1.0, 1.0, 4.0]] {
        let scene = one(box_mesh(size, false, &[]));
        let camera = default_camera(&scene);
        let Projection::Perspective { fov_y } = camera.projection else { panic!("perspective") };
        let camera_from_world = camera.world_from_camera.inverse();
        let reach = |point: &[f32; 3]| {
            let seen = camera_from_world.transform_point3(DVec3::from_array(point.map(f64::from)));
            seen.x.abs().max(seen.y.abs()) / (-seen.z * f64::from(fov_y / 2.0).tan())
        };
        let furthest = scene.meshes[0].positions.iter().map(reach).fold(0.0, f64::max);
        assert!((0.94..=0.9525).contains(&furthest), "{size:?}: {furthest}");
    }
}

#[test]
fn into_a_nook_of_a_large_scene_nobody_goes() {
    let nook = || (box_mesh([1.0; 3], true, &[]), DAffine3::IDENTITY);
    let far = |x: f64| (box_mesh([1.0; 3], false, &[]), DAffine3::from_translation(DVec3::new(x, 0.0, 0.0)));
    assert!(stands_inside(&scene_of(vec![nook()])));
    assert!(!stands_inside(&scene_of(vec![nook(), far(-4.0), far(4.0)])));
}

#[test]
fn one_open_side_is_looked_in_through() {
    let scene = one(box_mesh([4.0, 3.0, 5.0], true, &[FRONT]));
    let camera = default_camera(&scene);
    assert!(forward(&camera).distance(DVec3::NEG_Z) < 1.0e-12);
    let eye = eye(&camera);
    assert!(eye.x == 0.0 && eye.y == 0.0 && eye.z > 2.5);
    let Projection::Perspective { fov_y } = camera.projection else { panic!("perspective") };
    let half_seen = f64::from(fov_y / 2.0).tan() * (eye.z - 2.5);
    assert!(half_seen >= 2.0, "the whole side is in a square picture: {half_seen}");

    let turned = DAffine3::from_rotation_y(std::f64::consts::FRAC_PI_2);
    let scene = scene_of(vec![(box_mesh([4.0, 3.0, 5.0], true, &[FRONT]), turned)]);
    assert!(forward(&default_camera(&scene)).distance(DVec3::NEG_X) < 1.0e-9);
    let courtyard = one(box_mesh(HALL, true, &[3]));
    assert!(stands_inside(&courtyard), "the sky is no side to look in through");
}

#[test]
fn what_stands_in_the_middle_is_looked_past() {
    let obstacle = box_mesh([0.5, 0.9, 0.5], false, &[]);
    let next_to = DAffine3::from_translation(DVec3::new(1.0, -1.0, 0.0));
    let scene = scene_of(vec![(box_mesh(HALL, true, &[]), DAffine3::IDENTITY), (obstacle, next_to)]);
    let camera = default_camera(&scene);
    let (eye, forward) = (eye(&camera), forward(&camera));
    assert!(stands_inside(&scene) && (eye.x * forward.x) < -3.0, "{eye} {forward}");
}

#[test]
fn what_is_broken_or_too_large_is_seen_from_outside() {
    let mut broken = box_mesh(HALL, true, &[]);
    broken.positions[3] = [f32::NAN; 3];
    broken.indices.extend([1000, 1, 2, 0]);
    assert!(default_camera(&one(broken)).world_from_camera.is_finite());

    let place = DAffine3::from_translation(DVec3::splat(f64::INFINITY));
    let lost = scene_of(vec![(box_mesh(HALL, true, &[]), place)]);
    assert!(default_camera(&lost).world_from_camera.is_finite());

    let mut stacked = one(box_mesh(HALL, true, &[]));
    stacked.meshes[0].indices = stacked.meshes[0].indices.repeat(20_000);
    assert!(!stands_inside(&stacked), "every ray meets thousands");

    let mut heavy = one(box_mesh(HALL, true, &[]));
    heavy.meshes[0].indices.extend([0; 360_000]);
    assert!(stands_inside(&heavy), "specks in a corner");
    heavy.instances = vec![heavy.instances[0].clone(); 71];
    assert!(!stands_inside(&heavy), "more than 2^23 triangles");
}

/// A sky of one colour everywhere would show no shape, and a good default light neither outshines white
/// surfaces nor leaves them dark.
#[test]
fn the_default_light_shows_grey_things_before_grey() {
    let Environment::LatLong { width, height, radiance } = default_light() else { panic!("a map") };
    assert_eq!(radiance.len(), (width * height) as usize);
    assert!(radiance.iter().all(|[red, green, blue]| red == green && green == blue), "neutral");
    let direction = |index: usize| {
        let (column, row) = ((index as u32 % width) as f64, (index as u32 / width) as f64);
        let azimuth = std::f64::consts::TAU * (column + 0.5) / f64::from(width);
        let polar = std::f64::consts::PI * (row + 0.5) / f64::from(height);
        let solid_angle = polar.sin() * 2.0 * std::f64::consts::PI.powi(2) / f64::from(width * height);
        (DVec3::new(polar.sin() * azimuth.cos(), polar.cos(), polar.sin() * azimuth.sin()), solid_angle)
    };
    // The closure returns the radiance of a surface of base colour 0.8, by the direction that it faces.
    let shown = |normal: DVec3| -> f64 {
        let light = radiance.iter().enumerate().map(|(index, radiance)| {
            let (direction, solid_angle) = direction(index);
            f64::from(radiance[0]) * direction.dot(normal).max(0.0) * solid_angle
        });
        0.8 / std::f64::consts::PI * light.sum::<f64>()
    };
    let key = DVec3::new(-0.42, 1.19, 0.91).normalize();
    let (lit, front, shadow) = (shown(key), shown(DVec3::Z), shown(DVec3::new(1.0, -1.0, -1.0).normalize()));
    assert!((0.65..0.75).contains(&lit), "towards the key light: {lit}");
    assert!(front > 1.3 * shown(DVec3::X) && lit > 1.5 * front, "form is shown: {front}");
    assert!((0.08..0.2).contains(&shadow), "no shadow is black: {shadow}");
    let behind = |index: &usize| direction(*index).0.dot(forward(&default_camera(&Scene::default()))) > 0.8;
    for index in (0..radiance.len()).filter(behind).step_by(97) {
        assert!((0.1..0.3).contains(&radiance[index][0]), "the background is grey: {:?}", radiance[index]);
    }
}

/// Makes two triangles of a square metre each: one grey, and one of this material with these texture
/// coordinates at its corners.
fn next_to(material: Material, uv: [f32; 2]) -> Scene {
    let triangle = |x: f32, material| Mesh {
        positions: vec![[x, 0.0, 0.0], [x + 2.0, 0.0, 0.0], [x, 1.0, 0.0]],
        indices: vec![0, 1, 2],
        uvs: [Some(vec![uv; 3]), None],
        material,
        ..Mesh::default()
    };
    let mut scene =
        scene_of(vec![(triangle(0.0, 0), DAffine3::IDENTITY), (triangle(5.0, 1), DAffine3::IDENTITY)]);
    scene.materials.push(material);
    scene.images = vec![Image {
        name: "black, white".to_owned(),
        width: 2,
        height: 1,
        rgba8: vec![0, 0, 0, 255, 255, 255, 255, 255],
    }];
    let (wrap_u, wrap_v) = (Wrap::Repeat, Wrap::Clamp);
    scene.textures = vec![Texture { image: 0, wrap_u, wrap_v, filter: Filter::Linear, mipmapped: true }];
    scene
}

#[test]
fn what_glows_a_little_is_no_light() {
    let glow = |emission: f32| Material { emission: [emission; 3], ..Material::default() };
    // Half of the surface emits, from one side: 0.1 is 0.05 on average.
    assert!(is_lit(&next_to(glow(0.101), [0.0; 2])));
    assert!(!is_lit(&next_to(glow(0.099), [0.0; 2])));
    assert!(is_lit(&next_to(Material { double_sided: true, ..glow(0.051) }, [0.0; 2])), "from both");
    // The mean is by luminance.
    assert!(!is_lit(&next_to(Material { emission: [0.0, 0.0, 1.0], ..Material::default() }, [0.0; 2])));
    assert!(is_lit(&next_to(Material { emission: [0.0, 1.0, 0.0], ..Material::default() }, [0.0; 2])));
    // Unlit surfaces emit their base colour.
    let unlit = |base_color| Material { unlit: true, base_color, ..Material::default() };
    assert!(is_lit(&next_to(unlit([0.051, 0.051, 0.051, 1.0]), [0.0; 2])));
    assert!(!is_lit(&next_to(unlit([0.049, 0.049, 0.049, 1.0]), [0.0; 2])));
    // Without instances no surface emits, and lights without intensity light nothing.
    let mut nothing = next_to(glow(1.0), [0.0; 2]);
    nothing.instances.pop();
    assert!(!is_lit(&nothing));
    nothing.lights.push(Light::Directional { direction: DVec3::NEG_Y, irradiance: [0.0; 3] });
    assert!(!is_lit(&nothing));
    nothing.lights.push(Light::Directional { direction: DVec3::NEG_Y, irradiance: [0.0, 0.1, 0.0] });
    assert!(is_lit(&nothing));
}

#[test]
fn emission_is_what_its_texture_leaves_of_it() {
    let identity = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
    let with = |uv_transform| Material {
        emission: [1.0; 3],
        emission_texture: Some(TextureRef { texture: 0, uv_set: 0, uv_transform }),
        ..Material::default()
    };
    let (black, white) = ([0.25, 0.5], [0.75, 0.5]);
    assert!(is_lit(&next_to(with(identity), white)));
    assert!(!is_lit(&next_to(with(identity), black)));
    let shifted = [[1.0, 0.0, 1.5], [0.0, 1.0, 0.0]];
    assert!(is_lit(&next_to(with(shifted), black)) && !is_lit(&next_to(with(shifted), white)), "repeated");
    let mut mirrored = next_to(with([[1.0, 0.0, 1.0], [0.0, 1.0, 0.0]]), black);
    assert!(!is_lit(&mirrored));
    mirrored.textures[0].wrap_u = Wrap::Mirror;
    assert!(is_lit(&mirrored));
    // A missing texture counts as white.
    mirrored.images.clear();
    assert!(is_lit(&mirrored));

    let mut scene = next_to(with(identity), black);
    assert!(!Needs::of(&scene, Workload::ALL).requires(Term::Environment));
    assert!(ensure_lit(&mut scene));
    assert!(matches!(scene.environment, Environment::LatLong { .. }));
    assert_eq!(scene.warnings.len(), 1);
    assert_eq!(scene.warnings[0].kind, "default-light");
    assert!(scene.warnings[0].message.contains("too little"), "{}", scene.warnings[0].message);
    let needs = Needs::of(&scene, Workload::ALL);
    assert!(needs.requires(Term::Environment), "it is a light now");
    assert!(needs.requires(Term::Emission), "and what glows still does");

    let mut dark = one(box_mesh(HALL, false, &[]));
    assert!(ensure_lit(&mut dark));
    assert!(dark.warnings[0].message.contains("nothing"), "{}", dark.warnings[0].message);
    assert!(!ensure_lit(&mut dark), "it is lit now");
}
