//! Scenes that move, at several times: every structure over the vertices that the device has then, against
//! the oracle. Structures are kept from one time to the next, as in an animation; the oracle reads the
//! vertices back.

use std::ffi::OsString;
use std::fmt::Write as _;
use std::path::{Path, PathBuf};

use rasray_ads::{Geometry, Structure};
use rasray_experiment::{DeviceScene, device_hits, incoherent_rays, oracle_ray};
use rasray_gpu::Timing;
use rasray_scene::needs::{Needs, Workload};
use rasray_scene::{Camera, Moment, Motion, Scene, default_view};
use rasray_scene_source::load;
use rasray_systems::Preset;
use rasray_tests::conformance::{
    Cases, Curve, Demand, Law, Prepared, ROWS, Row, Tier, compare, evaluate, first_other,
};
use rasray_tests::hard_cases::{self, Expectation, HardCase, Scale, Target, Targets, Triangle};
use rasray_tests::harness::Bench;
use rasray_tests::random::Random;
use rasray_tests::rays::towards;
use rasray_tests::shapes::sphere;
use rasray_tests::tier::{Counts, is_full};
use rasray_tracer::build_until_complete;

/// Rays at a time.
const RAYS: Counts<usize> = Counts { quick: 120, software: 4000, full: 40_000 };

/// Source of a scene.
enum Source {
    /// Below `RASRAY_SCENES`.
    File(&'static str),
    /// By the word of the command.
    BuiltIn(&'static str),
    /// Files with a number that are written here: other triangles in each.
    Written,
}

/// Absent where a scene states none.
type Laws = Option<&'static [[Law; 1]; 2]>;

/// A scene that moves.
struct Moving {
    name: &'static str,
    source: Source,
    /// Seconds.
    times: &'static [f64],
    tier: Tier,
    /// Laws by which errors of structures that store fragments fall with the resolution: [`laws`].
    laws: Laws,
}

const SCENES: &[Moving] = &[
    file(
        "CesiumMan",
        "skinned/CesiumMan/CesiumMan.glb",
        &[0.0, 0.67, 1.55],
        Tier::Quick,
        Some(&laws("CesiumMan", 28.0, 33.0)),
    ),
    file(
        "AnimatedMorphCube",
        "morph/AnimatedMorphCube/AnimatedMorphCube.glb",
        &[0.4, 1.5, 3.1],
        Tier::Quick,
        Some(&laws("AnimatedMorphCube", 8.0, 18.0)),
    ),
    file(
        "CesiumMilkTruck",
        "animated/CesiumMilkTruck/CesiumMilkTruck.glb",
        &[0.0, 0.37, 1.0],
        Tier::Quick,
        Some(&laws("CesiumMilkTruck", 21.0, 25.0)),
    ),
    Moving {
        name: "walker",
        source: Source::BuiltIn("walker:8k"),
        times: &[0.2, 2.6, 4.9],
        tier: Tier::Quick,
        laws: Some(&laws("walker", 38.0, 94.0)),
    },
    Moving {
        name: "cloth-ball",
        source: Source::BuiltIn("cloth-ball:1k"),
        times: &[0.0, 0.6, 1.4],
        tier: Tier::Quick,
        laws: Some(&laws("cloth-ball", 47.0, 85.0)),
    },
    Moving {
        name: "numbered files",
        source: Source::Written,
        times: &[0.04, 0.09, 0.12],
        tier: Tier::Quick,
        laws: Some(&laws("numbered files", 16.0, 27.0)),
    },
    file("Fox", "skinned/Fox/Fox.glb", &[0.5, 1.7, 3.0], Tier::Full, None),
    file("RiggedFigure", "skinned/RiggedFigure/RiggedFigure.glb", &[0.1, 0.6, 1.2], Tier::Full, None),
    file("RiggedSimple", "skinned/RiggedSimple/RiggedSimple.glb", &[0.5, 1.0, 1.6], Tier::Full, None),
    file("SimpleSkin", "skinned/SimpleSkin/SimpleSkin.gltf", &[0.7, 1.5, 4.2], Tier::Full, None),
    file("MorphStressTest", "morph/MorphStressTest/MorphStressTest.glb", &[0.5, 3.1, 8.0], Tier::Full, None),
    file(
        "AnimatedMorphSphere",
        "morph/AnimatedMorphSphere/AnimatedMorphSphere.glb",
        &[1.0, 3.6, 5.9],
        Tier::Full,
        None,
    ),
    file("BoxAnimated", "animated/BoxAnimated/BoxAnimated.glb", &[0.3, 1.9, 3.5], Tier::Full, None),
    file(
        "InterpolationTest",
        "animated/InterpolationTest/InterpolationTest.glb",
        &[0.2, 0.8, 1.5],
        Tier::Full,
        None,
    ),
    file("cloth_ball", "deforming/cloth_ball/cloth_ball##.ply", &[3.68, 3.72], Tier::Full, None),
];

const fn file(
    name: &'static str,
    path: &'static str,
    times: &'static [f64],
    tier: Tier,
    laws: Laws,
) -> Moving {
    Moving { name, source: Source::File(path), times, tier, laws }
}

/// Meshes as fine as cells have a border in nearly every one, so that a ray is right only where none spoils
/// it. For [`FRAGMENTS`], then for other rows: smaller cells lose more of a ray per cell, since fewer borders
/// share one.
const fn laws(case: &'static str, per_cell: f64, others: f64) -> [[Law; 1]; 2] {
    const fn law(case: &'static str, per_cell: f64) -> Law {
        Law { case, reason: "triangles as small as cells", per_cell, curve: Curve::Chances }
    }
    [[law(case, per_cell)], [law(case, others)]]
}

/// Rows of fragments in the quick tier, all with 64 cells along a side.
const FRAGMENTS: [&str; 3] = ["mmrt-centres-64", "hu-centres-64", "ldc-planes-64"];

/// Rows that find triangles, and those of fragments whose rules are robust: of each structure one in the
/// quick tier. Those of a law are held to that of the scene, and where it states none only to what the
/// structure answers when it is made anew.
fn rows(moving: &'static Moving) -> impl Iterator<Item = Row> {
    // A row that differs from another in smaller cells alone.
    const FINER: &str = "bricks-cube-128";
    let is_held = |row: &&Row| {
        let is_law = matches!(row.demand, Demand::Law { .. }) && row.preset == Preset::Robust;
        let is_quick = match row.is_exact() {
            true => row.tier == Tier::Quick && row.name != FINER,
            false => FRAGMENTS.contains(&row.name),
        };
        let tried = is_full() || is_quick || row.name.starts_with("bvh-refit");
        tried && !row.only_camera() && row.cases != Cases::Deep && (is_law || row.is_exact())
    };
    ROWS.iter().filter(is_held).map(|row| match row.demand {
        Demand::Law { resolution, per_cell, depth_tolerance, .. } => {
            let laws: &[Law] = match moving.laws {
                Some([own, _]) if FRAGMENTS.contains(&row.name) => own,
                Some([_, others]) => others,
                None => &[],
            };
            let demand = Demand::Law { resolution, per_cell, depth_tolerance, laws };
            Row { demand, deviations: &[], ..*row }
        }
        _ => *row,
    })
}

/// Writes four files of spheres that move and are made of ever more triangles.
fn written(folder: &Path) -> OsString {
    for number in 0..4_u16 {
        let at = f32::from(number);
        let mut triangles = sphere([0.5 * at, 0.3, -0.2 * at], 1.0, 6 + usize::from(2 * number));
        triangles.extend(sphere([-1.5, 0.25 * at, 0.5], 0.75, 5));
        let mut text = format!(
            "ply\nformat ascii 1.0\nelement vertex {}\nproperty float x\nproperty float y\nproperty float z\nelement face {}\n\
             property list uchar int vertex_indices\nend_header\n",
            3 * triangles.len(),
            triangles.len()
        );
        for [x, y, z] in triangles.as_flattened() {
            writeln!(text, "{x} {y} {z}").expect("text");
        }
        for first in (0..3 * triangles.len()).step_by(3) {
            writeln!(text, "3 {first} {} {}", first + 1, first + 2).expect("text");
        }
        std::fs::write(folder.join(format!("spheres.{number:02}.ply")), text).expect("a file");
    }
    folder.join("spheres.##.ply").into()
}

/// Rays from all over the bounds, and rays that start outside and aim at triangles.
fn rays(
    triangles: &[Triangle],
    [lower, upper]: [[f32; 3]; 2],
    seed: u64,
    count: usize,
) -> Vec<rasray_ads::Ray> {
    let mut random = Random::new(seed);
    let sizes: [f32; 3] = std::array::from_fn(|axis| upper[axis] - lower[axis]);
    let longest = sizes.into_iter().fold(0.0, f32::max);
    let mut rays = incoherent_rays([lower, upper], seed as u32, count as u32 / 2);
    while rays.len() < count {
        let corners = triangles[(random.bits() % triangles.len() as u64) as usize];
        let mut weights = [random.between(0.05, 1.0), random.between(0.05, 1.0), random.between(0.05, 1.0)];
        let sum: f32 = weights.iter().sum();
        weights.iter_mut().for_each(|weight| *weight /= sum);
        let at = |axis: usize| (0..3).map(|corner| weights[corner] * corners[corner][axis]).sum::<f32>();
        let origin: [f32; 3] = std::array::from_fn(|axis| {
            // Rays within the plane of a flat scene hit nothing.
            let size = if sizes[axis] > 0.0 { sizes[axis] } else { longest };
            random.between(lower[axis] - 0.5 * size, upper[axis] + 0.5 * size)
        });
        rays.push(towards(origin, std::array::from_fn(at)));
    }
    rays
}

/// The vertices that the device has, with rays and what the oracle says of them.
fn prepared(bench: &Bench, moving: &Moving, geometry: &Geometry, number: usize) -> Prepared {
    let (positions, indices) = geometry.download(bench.device()).expect("readable");
    let corner = |index: &u32| positions[*index as usize];
    let triangles: Vec<Triangle> =
        indices.as_chunks::<3>().0.iter().map(|corners| corners.each_ref().map(corner)).collect();
    let over = |with: fn(f32, f32) -> f32| -> [f32; 3] {
        std::array::from_fn(|axis| {
            triangles.as_flattened().iter().map(|corner| corner[axis]).reduce(with).expect("there are some")
        })
    };
    let bounds = [over(f32::min), over(f32::max)];
    let count = RAYS.on(bench.device(), "rays at a time");
    let rays = rays(&triangles, bounds, 500 + number as u64, count);
    // Before the scene, at some height.
    let share = [0.4, 0.6, 1.1];
    let eye = std::array::from_fn(|axis| bounds[0][axis] + share[axis] * (bounds[1][axis] - bounds[0][axis]));
    let case = HardCase {
        id: moving.name,
        title: "a scene that moves",
        rays: rays.iter().map(oracle_ray).collect(),
        triangles,
        eye,
        expect: Expectation::Oracle,
        largest_dt: None,
        target: Targets { primitives: Target::Exact, fragments: Target::Law },
        ..hard_cases::case("E1", Scale::QUICK).expect("the case exists")
    };
    let prepared = Prepared::new(bench, case);
    assert_eq!(prepared.geometry.triangle_count(), geometry.triangle_count(), "ids are those of the device");
    prepared
}

fn hold(bench: &Bench, moving: &'static Moving, scene: &Scene) -> Vec<String> {
    let device = bench.device();
    let camera: Camera = default_view::default_camera(scene);
    let needs = Needs::of(scene, Workload { emission: true, shades: true, ..Workload::VISIBILITY });
    let changes = scene.motion() == Motion::Changing;
    let make = if changes { DeviceScene::new } else { DeviceScene::moving };
    let mut shown = make(device, scene, &camera, [16, 16], 1, &needs).expect("it fits");
    let mut structures: Vec<(Row, Box<dyn Structure>)> = rows(moving)
        .map(|row| {
            let structure = row.make(bench, shown.scene.geometry());
            (row, structure)
        })
        .collect();
    let (mut faults, mut before) = (Vec::new(), Vec::new());
    for (number, &seconds) in moving.times.iter().enumerate() {
        let moment = Moment { seconds, clips: scene.animation.rig.compatible_clips() };
        if changes {
            let posed = scene.at(&moment).expect("the files are whole");
            let stage = DeviceScene::new(device, &posed, &camera, [16, 16], 1, &needs).expect("it fits");
            for (_, structure) in &mut structures {
                structure.set_geometry(device, stage.scene.geometry()).expect("it fits");
            }
            shown = stage;
        } else {
            shown.pose(device, scene, &moment, Timing::None).expect("the device works");
        }
        let prepared = prepared(bench, moving, shown.scene.geometry(), number);
        assert_ne!(prepared.case.triangles, before, "{} does not move until {seconds} s", moving.name);
        let hit = prepared.verdicts.iter().filter(|verdict| verdict.outcome.hit().is_some()).count();
        assert!(4 * hit > prepared.rays.len(), "{} at {seconds} s: {hit} hits say little", moving.name);
        for (row, structure) in &mut structures {
            build_until_complete(device, structure.as_mut(), prepared.viewpoint, Timing::None)
                .expect("the build completes");
            let hits = device_hits(bench.trace(structure.as_ref(), &prepared.rays).hits);
            let (depth_tolerance, rounding) = row.tolerances();
            let measured = compare(&prepared, &hits, depth_tolerance, rounding);
            if std::env::var_os("RASRAY_RATES").is_some() {
                let (rate, ambiguous) = (measured.evaluated(), measured.inadmissible);
                println!(
                    "{} {} {seconds} s {} of {}, and of ambiguous rays {} of {}",
                    row.name, moving.name, rate.count, rate.total, ambiguous.count, ambiguous.total
                );
            }
            if !row.is_exact() {
                let mut fresh = row.make(bench, shown.scene.geometry());
                build_until_complete(device, fresh.as_mut(), prepared.viewpoint, Timing::None)
                    .expect("the build completes");
                let expected = device_hits(bench.trace(fresh.as_ref(), &prepared.rays).hits);
                if let Some(ray) = first_other(&expected, &hits) {
                    faults.push(format!(
                        "{} on {} at {seconds} s: ray {ray} finds {:?}, and {:?} where the structure is made anew",
                        row.name, moving.name, hits[ray], expected[ray]
                    ));
                }
                if moving.laws.is_none() {
                    continue;
                }
            }
            for fault in evaluate(row, &prepared, &measured) {
                // The command replays hard cases only.
                let told = fault.lines().next().unwrap_or_default();
                faults.push(format!("at {seconds} s: {told}"));
            }
        }
        before = prepared.case.triangles;
    }
    faults
}

#[test]
fn every_row_keeps_its_demand_while_scenes_move() {
    let folder = std::env::var_os("RASRAY_SCENES").map(PathBuf::from);
    let temporary = tempfile::tempdir().expect("a folder");
    let bench = Bench::new();
    let mut faults = Vec::new();
    for moving in SCENES.iter().filter(|moving| is_full() || moving.tier == Tier::Quick) {
        let name: OsString = match (&moving.source, &folder) {
            (Source::File(path), Some(folder)) => folder.join(path).into(),
            (Source::File(_), None) => {
                eprintln!("skipped {}: RASRAY_SCENES is not set", moving.name);
                continue;
            }
            (Source::BuiltIn(words), _) => words.into(),
            (Source::Written, _) => written(temporary.path()),
        };
        let loaded = load(&name).unwrap_or_else(|error| panic!("{}: {error}", moving.name));
        faults.extend(hold(&bench, moving, &loaded.scene));
    }
    assert!(faults.is_empty(), "{} faults:\n{}", faults.len(), faults.join("\n"));
}
