//! Built-in scenes: counts, closedness, winding, materials, determinism, parameters.

use approx::assert_abs_diff_eq;
use std::collections::HashMap;

use glam::DVec3;
use rasray_scene::builtin::{NAMES, builtin};
use rasray_scene::default_view::{bounds, is_lit};
use rasray_scene::{AlphaMode, Environment, Mesh, Moment, Projection, Scene, SceneError};

use crate::made::{placed_triangles, scene};

fn corners(mesh: &Mesh) -> impl Iterator<Item = [[f32; 3]; 3]> {
    mesh.indices.chunks_exact(3).map(|corners| [0, 1, 2].map(|at| mesh.positions[corners[at] as usize]))
}

/// Returns the directed edges, by position, along which no triangle runs in the other direction.
fn open_edges<'a>(meshes: impl IntoIterator<Item = &'a Mesh>) -> Vec<([f32; 3], [f32; 3])> {
    let key = |point: [f32; 3]| point.map(|value| (value + 0.0).to_bits());
    let mut count: HashMap<_, i64> = HashMap::new();
    for mesh in meshes {
        for triangle in corners(mesh) {
            for side in 0..3 {
                let (from, to) = (key(triangle[side]), key(triangle[(side + 1) % 3]));
                if from < to {
                    *count.entry((from, to)).or_default() += 1;
                } else {
                    *count.entry((to, from)).or_default() -= 1;
                }
            }
        }
    }
    let open = count.into_iter().filter(|(_, count)| *count != 0);
    open.map(|((from, to), _)| (from.map(f32::from_bits), to.map(f32::from_bits))).collect()
}

/// Returns the signed volume by the divergence theorem: positive if the fronts of a closed mesh face
/// outwards.
fn volume(mesh: &Mesh) -> f64 {
    let point = |corner: [f32; 3]| DVec3::from_array(corner.map(f64::from));
    corners(mesh).map(|[a, b, c]| point(a).dot(point(b).cross(point(c))) / 6.0).sum()
}

/// Asserts that a scene is well formed: indices, attribute lengths, unit normals on the front side.
fn assert_well_formed(scene: &Scene) {
    assert_eq!(scene.cameras.len(), 1, "{}", scene.name);
    assert!(is_lit(scene), "{}", scene.name);
    assert!(scene.warnings.is_empty());
    for instance in &scene.instances {
        let mesh = &scene.meshes[instance.mesh];
        assert!(mesh.material < scene.materials.len());
        let normals = mesh.normals.as_ref();
        assert_eq!(normals.is_none(), scene.name == "furnace", "only the furnace is flat");
        assert!(normals.is_none_or(|normals| normals.len() == mesh.positions.len()));
        assert_eq!(mesh.uvs[0].as_ref().map(Vec::len), Some(mesh.positions.len()));
        assert!(mesh.positions.iter().flatten().all(|value| value.is_finite()));
        let mut turned = 0;
        for indices in mesh.indices.chunks_exact(3) {
            let at = |corner: u32| DVec3::from_array(mesh.positions[corner as usize].map(f64::from));
            let [a, b, c] = [at(indices[0]), at(indices[1]), at(indices[2])];
            let face = (b - a).cross(c - a);
            assert!(face.length() > 1.0e-9, "{}: {} has a triangle without area", scene.name, mesh.name);
            for (&corner, normals) in indices.iter().zip(normals.into_iter().cycle()) {
                let normal = DVec3::from_array(normals[corner as usize].map(f64::from));
                assert_abs_diff_eq!(normal.length(), 1.0, epsilon = 1.0e-5);
                let agreement = normal.dot(face.normalize());
                let folds = mesh.triangle_count() > 1_000 && scene.name.starts_with("walker");
                turned += usize::from(agreement <= 0.3);
                assert!(
                    agreement > 0.3 || folds,
                    "{}: {} normal against winding: {agreement}",
                    scene.name,
                    mesh.name
                );
            }
        }
        // Triangles of a skin may fold in an armpit.
        assert!(turned * 100 <= mesh.triangle_count(), "{}: {turned} corners of {}", scene.name, mesh.name);
    }
    for texture in &scene.textures {
        assert!(texture.image < scene.images.len());
    }
    for image in &scene.images {
        assert_eq!(image.rgba8.len(), image.width as usize * image.height as usize * 4);
    }
}

#[test]
fn every_scene_is_well_formed_and_the_same_twice() {
    for name in NAMES {
        let spec = match name {
            "spheres" => "spheres:10k",
            "ruins" => "ruins:10k",
            other => other,
        };
        let first = scene(spec);
        assert_well_formed(&first);
        assert_eq!(first.name, spec);
        let second = scene(spec);
        assert_eq!(first.meshes.len(), second.meshes.len());
        for (one, other) in first.meshes.iter().zip(&second.meshes) {
            assert_eq!(one.positions, other.positions);
            assert_eq!(one.indices, other.indices);
        }
    }
}

#[test]
fn names_that_are_no_built_ins_are_left_to_others() {
    assert!(builtin("scene.gltf").is_none());
    assert!(builtin("Cornell").is_none());
    assert!(builtin("").is_none());
    assert!(builtin("C:\\scenes\\cornell").is_none());
}

#[test]
fn wrong_parameters_are_refused_with_the_name_and_the_reason() {
    let table = [
        ("cornell:size=2", "no parameter `size`"),
        ("cornell:big", "`big` has no key"),
        ("furnace:albedo=1", "from 0 to 0.999999"),
        ("furnace:albedo=nan", "`albedo=nan`"),
        ("furnace:albedo=0.5,albedo=0.6", "given twice"),
        ("furnace:shape=cone", "one of sphere, box"),
        ("furnace:0.5", "has no key"),
        ("furnace:", "empty"),
        ("spheres:5k", "from 10000 to 10000000"),
        ("spheres:11M", "from 10000 to 10000000"),
        ("spheres:1e99", "from 10000"),
        ("spheres:-10k", "from 10000"),
        ("spheres:10k,triangles=20k", "given twice"),
        ("spheres:k", "must be a number"),
        ("atrium:detail=9", "from 0.25 to 4"),
        ("ruins:9k", "from 10000 to 10000000"),
        ("corridor:width=0", "from 0.5 to 50"),
        ("mirror-hall:90", "from 0 to 80"),
        ("still-life:detail=5", "from 0.25 to 4"),
        ("pool:deep", "has no key"),
        ("teapots:0", "from 1 to 2000"),
        ("teapots:lamps=3", "from 0 to 2"),
        ("teapots:ground=wood", "one of mirror, matt"),
        ("foliage:shape=needle", "one of leaf, card"),
        ("walker:3k", "from 8000 to 2000000"),
        ("walker:speed=2", "no parameter `speed`"),
        ("cloth-ball:2M", "from 1000 to 1000000"),
    ];
    for (spec, expected) in table {
        let error =
            builtin(spec).expect("a built-in name").err().unwrap_or_else(|| panic!("{spec} was accepted"));
        assert!(matches!(error, SceneError::Builtin { .. }), "{spec}");
        let message = error.to_string();
        assert!(message.contains(expected) && message.contains(spec), "{spec}: {message}");
    }
}

#[test]
fn cornell_is_open_at_the_front_only() {
    let scene = scene("cornell");
    assert_eq!(placed_triangles(&scene), 38);
    let shell: Vec<_> = scene.meshes.iter().filter(|mesh| !mesh.name.contains("block")).collect();
    let open = open_edges(shell);
    assert_eq!(open.len(), 4);
    assert!(open.iter().all(|(from, to)| from[2] == 0.0 && to[2] == 0.0), "{open:?}");
    for block in scene.meshes.iter().filter(|mesh| mesh.name.contains("block")) {
        let open = open_edges([block]);
        assert_eq!(open.len(), 4, "{}", block.name);
        assert!(open.iter().all(|(from, to)| from[1] == 0.0 && to[1] == 0.0), "{open:?}");
        // The missing bottom lies in the plane through the origin, so it adds nothing.
        assert!(volume(block) > 0.003, "{}", volume(block));
    }
}

#[test]
fn cornell_has_its_colours_sides_and_light() {
    let scene = scene("cornell");
    let mesh = |name: &str| scene.meshes.iter().find(|mesh| mesh.name == name).expect("mesh");
    assert!(mesh("red wall").positions.iter().all(|point| point[0] < 0.0));
    assert!(mesh("green wall").positions.iter().all(|point| point[0] > 0.0));
    let red = &scene.materials[mesh("red wall").material];
    assert!(red.base_color[0] > 5.0 * red.base_color[1]);
    assert!(scene.materials.iter().all(|material| material.metallic == 0.0 && material.specular == 0.0));
    assert_eq!(scene.materials.iter().filter(|material| material.emission[0] > 0.0).count(), 1);
    let light = mesh("light").normals.as_ref().expect("normals")[0];
    assert_eq!(light, [0.0, -1.0, 0.0]);
    // The camera stands in front of the opening, in the box's axis, and sees both sides of it.
    let camera = &scene.cameras[0];
    let eye = camera.world_from_camera.translation;
    assert!(eye.z > 0.5 && eye.x == 0.0);
    assert!(camera.world_from_camera.matrix3.z_axis.distance(DVec3::Z) < 1.0e-12);
    let Projection::Perspective { fov_y } = camera.projection else { panic!("perspective") };
    assert_abs_diff_eq!(fov_y.to_degrees(), 39.3, epsilon = 0.1);
    let half_height = f64::from(fov_y / 2.0).tan() * eye.z;
    assert!(half_height > 0.27 && half_height < 0.31, "{half_height}");
}

#[test]
fn furnaces_are_closed_and_face_inwards() {
    for (spec, count, enclosed) in [("furnace", 1280, 4.1), ("furnace:shape=box", 12, 8.0)] {
        let scene = scene(spec);
        assert_eq!(placed_triangles(&scene), count);
        assert!(open_edges(&scene.meshes).is_empty());
        let volume = volume(&scene.meshes[0]);
        assert!((volume + enclosed).abs() < 0.1, "{spec}: {volume}");
        let (low, high) = bounds(&scene).expect("bounds");
        let eye = scene.cameras[0].world_from_camera.translation;
        assert!(eye.cmpgt(low).all() && eye.cmplt(high).all());
    }
    let set = scene("furnace:albedo=0.8,emission=2.5");
    assert_eq!(set.materials[0].base_color, [0.8, 0.8, 0.8, 1.0]);
    assert_eq!(set.materials[0].emission, [2.5; 3]);
    assert_eq!(set.materials[0].specular, 0.0);
}

#[test]
fn spheres_have_the_triangles_asked_for_and_are_closed() {
    for (spec, count) in [("spheres:10k", 10_000), ("spheres", 300_000), ("spheres:123456", 123_456)] {
        let scene = scene(spec);
        let found = placed_triangles(&scene);
        assert!(found.abs_diff(count) <= 10, "{spec}: {found}");
        assert!(open_edges(&scene.meshes).is_empty(), "{spec}");
        assert!(scene.meshes.iter().all(|mesh| volume(mesh) > 0.0));
        let (low, high) = bounds(&scene).expect("bounds");
        assert!(low.min_element() >= -10.0 && high.max_element() <= 10.0);
        assert!((high - low).min_element() > 14.0, "{spec} fills its cube: {low} {high}");
    }
    assert_eq!(placed_triangles(&scene("spheres:0.5M")), placed_triangles(&scene("spheres:500k")));
}

#[test]
fn a_missing_triangle_opens_a_sphere() {
    let mut scene = scene("spheres:10k");
    let indices = &mut scene.meshes[0].indices;
    indices.truncate(indices.len() - 3);
    assert_eq!(open_edges(&scene.meshes).len(), 3);
}

/// Returns the numbers of triangles above and below a point of the ground.
fn layers(scene: &Scene, x: f64, z: f64) -> usize {
    let above = |[a, b, c]: [[f32; 3]; 3]| {
        let side = |from: [f32; 3], to: [f32; 3]| {
            let (from, to) = (from.map(f64::from), to.map(f64::from));
            (to[0] - from[0]) * (z - from[2]) - (to[2] - from[2]) * (x - from[0]) > 0.0
        };
        side(a, b) == side(b, c) && side(b, c) == side(c, a)
    };
    scene.meshes.iter().flat_map(corners).filter(|&corners| above(corners)).count()
}

#[test]
fn ruins_are_solid_stones_many_layers_deep() {
    for (spec, count, deep) in [("ruins:10k", 10_000, 1), ("ruins", 200_000, 8), ("ruins:600k", 600_000, 8)] {
        let scene = scene(spec);
        let found = placed_triangles(&scene);
        assert!(found <= count && count - found < 20, "{spec}: {found}");
        for stones in scene.meshes.iter().filter(|mesh| mesh.name.ends_with("stone")) {
            assert!(open_edges([stones]).is_empty(), "{spec}: {}", stones.name);
            assert!(volume(stones) > 0.0);
        }
        let places = (0..25).map(|k| (0.5 * f64::from(k % 5) - 1.01, 0.5 * f64::from(k / 5) - 1.02));
        let heap: usize = places.map(|(x, z)| layers(&scene, x, z)).sum();
        assert!(heap >= 25 * deep, "{spec}: {heap} layers at 25 places of a heap");
        assert_eq!(layers(&scene, 13.0, 13.1), 1, "{spec}: nothing but ground in the corner");
    }
}

#[test]
fn atrium_has_textures_masks_sun_and_sky() {
    let scene = scene("atrium");
    let count = placed_triangles(&scene);
    assert!((50_000..=100_000).contains(&count), "{count}");
    let textured: Vec<_> =
        scene.materials.iter().filter(|material| material.base_color_texture.is_some()).collect();
    assert!(textured.len() >= 3);
    assert!(scene.materials.iter().any(|material| material.alpha_mode == AlphaMode::Mask { cutoff: 0.5 }));
    assert!(scene.materials.iter().any(|material| material.metallic == 1.0));
    assert_eq!(scene.lights.len(), 1);
    let Environment::LatLong { width, height, radiance } = &scene.environment else { panic!("a sky") };
    assert_eq!(radiance.len(), (width * height) as usize);
    // The sky is blue at the top, where the rows begin.
    assert!(radiance[0][2] > radiance[0][0]);
    let (low, high) = bounds(&scene).expect("bounds");
    assert_eq!(low.y, 0.0);
    assert!(high.y > 8.0);
    assert!(placed_triangles(&self::scene("atrium:detail=0.25")) < count / 4);
}

#[test]
fn the_pierced_screen_has_holes_and_bars() {
    let scene = scene("atrium");
    let screen = scene.images.iter().find(|image| image.name == "screen").expect("screen");
    let holes = screen.rgba8.chunks_exact(4).filter(|texel| texel[3] == 0).count();
    let share = holes as f64 / (f64::from(screen.width) * f64::from(screen.height));
    assert!((0.3..0.6).contains(&share), "{share}");
}

#[test]
fn corridor_is_closed_with_mirrors_as_far_apart_as_asked() {
    let scene = scene("corridor:reflectance=0.9,width=3");
    assert_eq!(placed_triangles(&scene), 1300);
    assert!(open_edges(&scene.meshes).is_empty());
    let mirrors = scene.meshes.iter().find(|mesh| mesh.name == "mirrors").expect("mirrors");
    let material = &scene.materials[mirrors.material];
    assert_eq!((material.metallic, material.roughness), (1.0, 0.0));
    assert_eq!(material.base_color[..3], [0.9; 3]);
    assert!(mirrors.positions.iter().all(|point| point[0].abs() == 1.5));
    let (low, high) = bounds(&scene).expect("bounds");
    let eye = scene.cameras[0].world_from_camera.translation;
    assert!(eye.cmpgt(low).all() && eye.cmplt(high).all());
}

#[test]
fn urns_and_drapes_stand_on_and_above_the_floor() {
    let scene = scene("atrium");
    let lowest = |name: &str| {
        let mesh = scene.meshes.iter().find(|mesh| mesh.name == name).expect("mesh");
        mesh.positions.iter().map(|point| point[1]).fold(f32::INFINITY, f32::min)
    };
    assert_eq!(lowest("brass"), 0.0);
    assert!(lowest("red drapes") > 0.2 && lowest("blue drapes") > 4.5);
}

#[test]
fn teapots_are_instances_of_one_shape_above_a_mirror() {
    for (spec, pots, kinds) in
        [("teapots:1", 1, 1), ("teapots:3", 3, 3), ("teapots", 37, 7), ("teapots:2k", 2_000, 7)]
    {
        let scene = scene(spec);
        // The mirror and the lamps add two instances and two meshes.
        assert_eq!((scene.instances.len(), scene.meshes.len()), (pots + 2, kinds + 2), "{spec}");
        let (mirror, lamps) = (&scene.meshes[kinds], &scene.meshes[kinds + 1]);
        assert!(scene.meshes[..kinds].iter().all(|pot| pot.indices == scene.meshes[0].indices));
        let material = &scene.materials[mirror.material];
        assert_eq!((material.metallic, material.roughness), (1.0, 0.0));
        assert!(mirror.positions.iter().all(|point| point[1] == 0.0));
        assert!(scene.materials[lamps.material].emission[0] > 0.0);
        let lowest = scene.instances[..pots].iter().map(|pot| pot.world_from_mesh.translation.y);
        assert!(lowest.fold(f64::INFINITY, f64::min) > 0.0, "{spec}: none stands in the plane of the mirror");
        let places: Vec<DVec3> =
            scene.instances[..pots].iter().map(|pot| pot.world_from_mesh.translation).collect();
        let nearest = |at: usize| {
            let others = places.iter().enumerate().filter(|(other, _)| *other != at);
            others.map(|(_, other)| other.distance(places[at])).fold(f64::INFINITY, f64::min)
        };
        assert!((0..pots).all(|pot| nearest(pot) > 0.7), "{spec}: two pots touch");
    }
}

/// The ball of `ground=matt` is the mirror, and stands on the ground in a place without a pot.
#[test]
fn teapots_on_matt_ground_have_a_ball_and_as_many_lamps_as_asked() {
    for (lamps, pots) in [(0, 1), (1, 1), (2, 5)] {
        let scene = scene(&format!("teapots:{pots},ground=matt,lamps={lamps}"));
        let mesh = |name: &str| scene.meshes.iter().find(|mesh| mesh.name == name);
        let (ball, ground) = (mesh("mirror").expect("a ball"), mesh("ground").expect("a ground"));
        assert_eq!(scene.materials[ball.material].roughness, 0.0);
        assert_eq!(scene.materials[ground.material].metallic, 0.0);
        let lowest = ball.positions.iter().fold(f32::INFINITY, |lowest, point| lowest.min(point[1]));
        assert!(lowest > 0.0 && lowest < 0.001, "{lowest} m above the ground");
        let nearest =
            scene.instances[..pots].iter().map(|pot| pot.world_from_mesh.translation).flat_map(|pot| {
                ball.positions.iter().map(move |point| {
                    let point = DVec3::from_array(point.map(f64::from));
                    DVec3::new(pot.x - point.x, 0.0, pot.z - point.z).length()
                })
            });
        assert!(nearest.fold(f64::INFINITY, f64::min) > 0.33, "the ball touches a pot");
        assert_eq!(mesh("lamps").map_or(0, |mesh| mesh.indices.len() / 6), lamps, "{lamps} lamps");
        let last = mesh("lamps").and_then(|mesh| corners(mesh).last());
        assert!(last.is_none_or(|[a, b, c]| {
            let [a, b, c] = [a, b, c].map(|corner| DVec3::from_array(corner.map(f64::from)));
            (b - a).cross(c - a).y < 0.0
        }));
        assert_eq!(matches!(scene.environment, Environment::LatLong { .. }), lamps == 0);
    }
}

/// Returns the number of triangles of leaves and grass, and the number of those narrower than a pixel of 640
/// by 360.
fn slivers(scene: &Scene) -> (usize, usize) {
    let camera = &scene.cameras[0];
    let view = camera.world_from_camera.inverse();
    let pixel = 2.0 * camera.half_extents(640, 360)[1] / 360.0;
    let width = |corners: [[f32; 3]; 3]| {
        let [a, b, c] = corners
            .map(|corner| view.transform_point3(DVec3::from_array(corner.map(f64::from))))
            .map(|point| point.truncate() / -point.z / pixel);
        let longest = a.distance(b).max(b.distance(c)).max(c.distance(a));
        (b - a).perp_dot(c - a).abs() / longest
    };
    let blades = scene.meshes.iter().filter(|mesh| mesh.name == "leaves" || mesh.name == "grass");
    let widths: Vec<f64> = blades.flat_map(corners).map(width).collect();
    (widths.len(), widths.iter().filter(|width| **width < 1.0).count())
}

#[test]
fn foliage_has_the_leaves_asked_for_and_most_are_slivers() {
    for (spec, count) in [
        ("foliage:1k", 667 * 6 + 333 * 5),
        ("foliage", 26_667 * 6 + 13_333 * 5),
        ("foliage:10k,shape=card", 6_667 * 2 + 3_333 * 5),
    ] {
        let scene = scene(spec);
        let (all, thin) = slivers(&scene);
        assert_eq!(all, count, "{spec}");
        println!("{spec}: {thin} of {all}");
        assert!(spec != "foliage" || 2 * thin > all, "{spec}: {thin} of {all} are slivers");
        let masks =
            scene.materials.iter().filter(|material| material.alpha_mode != AlphaMode::Opaque).count();
        assert_eq!(masks, usize::from(spec.ends_with("card")), "{spec}");
    }
}

#[test]
fn wind_bends_leaves_and_lets_them_go() {
    let rest = scene("foliage:1k");
    let furthest = |seconds: f64| {
        let now = rest.at(&Moment { seconds, ..Moment::default() }).expect("it has no files");
        let moved = now.meshes.iter().zip(&rest.meshes).flat_map(|(now, then)| {
            assert_eq!(now.indices, then.indices);
            now.positions
                .iter()
                .zip(&then.positions)
                .map(|(a, b)| DVec3::from_array(std::array::from_fn(|k| f64::from(a[k] - b[k]))))
        });
        moved.map(DVec3::length).fold(0.0, f64::max)
    };
    assert_eq!(furthest(0.0), 0.0);
    assert!((0.02..0.5).contains(&furthest(1.3)), "{}", furthest(1.3));
    // After the last gust the scene is as at the beginning.
    assert!(furthest(8.0) < 1.0e-5, "{}", furthest(8.0));
}
