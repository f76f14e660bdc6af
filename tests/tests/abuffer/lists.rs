//! Long lists, the near region, unusual resolutions and eyes, and rays with limits.

use rasray_abuffer::{ABuffer, Config, Storage, well_formed};
use rasray_ads::{BruteForce, Hit, PRIMITIVE_NONE, Ray, Structure};
use rasray_gpu::Timing;
use rasray_shaders_glsl::constants::ads::{NODE_SORT_LIMIT, NODE_SORT_LONG_LIMIT};
use rasray_tests::harness::{Bench, oracle_of, oracle_ray};
use rasray_tests::random::Random;
use rasray_tests::rays::towards;
use rasray_tests::shapes::{Triangle, closed_box, quad, sphere};
use rasray_tests::tier::first;
use rasray_tracer::build_until_complete;

fn abuffer(bench: &Bench, config: Config, triangles: &[Triangle], eye: [f32; 3]) -> ABuffer {
    let geometry = bench.geometry(triangles);
    let mut structure = ABuffer::new(bench.device(), config, &geometry, None).expect("the options are valid");
    build_until_complete(bench.device(), &mut structure, eye, Timing::None).expect("the build completes");
    structure
}

fn brute_force(bench: &Bench, triangles: &[Triangle], rays: &[Ray]) -> Vec<Hit> {
    let geometry = bench.geometry(triangles);
    let structure = BruteForce::new(bench.device(), &geometry, None, false).expect("pipelines can be made");
    bench.trace(&structure, rays).hits
}

/// Layers in cell 8 of 16, which spans 0 to 1/8 in x/z, drawn in a scrambled order; they leave its border
/// free. The two triangles of a layer share the cell's centre and have a fragment each.
fn layers(count: usize) -> Vec<Triangle> {
    let order = Random::new(7).shuffled(count);
    order.into_iter().flat_map(|layer| quad(side(layer), side(layer), layer_depth(layer))).collect()
}

fn layer_depth(layer: usize) -> f32 {
    1.0 + layer as f32 * 1.0e-3
}

fn side(layer: usize) -> [f32; 2] {
    [0.0125 * layer_depth(layer), 0.1125 * layer_depth(layer)]
}

/// Rays from between two layers towards one of them, from both sides.
fn rays_between_layers(layers: usize, count: usize) -> Vec<Ray> {
    let mut random = Random::new(2);
    (0..count)
        .map(|index| {
            let depth = layer_depth(index * 617 % (layers - 1));
            let x = random.between(0.03, 0.1) * depth;
            let y = random.between(0.03, 0.1) * depth;
            let direction = if index % 2 == 0 { 1.0 } else { -1.0 };
            Ray::new([x, y, depth + 5.0e-4], [random.between(-1e-3, 1e-3), 0.0, direction])
        })
        .collect()
}

/// 10,000 fragments in one cell: every storage sorts them, with one bucket and with several, and finds each
/// layer from both sides.
#[test]
fn a_deep_cell_is_sorted_by_every_storage() {
    const LAYERS: usize = 5_000;
    const FRAGMENTS: u32 = 10_000;
    const { assert!(FRAGMENTS > NODE_SORT_LIMIT && FRAGMENTS < NODE_SORT_LONG_LIMIT) };
    let bench = Bench::new();
    let triangles = layers(LAYERS);
    let rays = rays_between_layers(LAYERS, 200);
    let expected = brute_force(&bench, &triangles, &rays);
    assert!(expected.iter().all(Hit::is_hit));
    let one = |storage| Config { storage, buckets: 1, ..Config::at_centres(16) };
    // Lists of 10,000, of 5,000, and of fewer than one dispatch sorts.
    let configs = [
        one(Storage::Ll),
        one(Storage::Dll),
        one(Storage::Paged),
        Config { storage: Storage::Sb, inline: true, ..Config::at_centres(16) },
        Config { storage: Storage::Llb, buckets: 2, ..Config::at_centres(16) },
        Config { buckets: 16, ..Config::at_centres(16) },
        one(Storage::Llb),
        one(Storage::Dllb),
        one(Storage::Sb),
        Config { buckets: 2, ..Config::at_centres(16) },
    ];
    for &config in first(&configs, 6) {
        let structure = abuffer(&bench, config, &triangles, [0.0; 3]);
        let status = structure.status(0).expect("the header is readable");
        assert_eq!((status.unsorted, status.corrupted), (0, 0), "{config:?}: {status:?}");
        let contents = structure.download(bench.device()).expect("the device works");
        let report = structure.report().expect("the header is readable");
        assert_eq!(report.stored, Some(FRAGMENTS.into()), "{config:?}");
        well_formed(&contents).unwrap_or_else(|fault| panic!("{config:?}: {fault}"));
        let hits = bench.trace(&structure, &rays).hits;
        for (ray, (hit, expected)) in hits.iter().zip(&expected).enumerate() {
            // Two triangles of a quad share its diagonal: only the layer is compared.
            assert_eq!(hit.primitive / 2, expected.primitive / 2, "{config:?}, {:?}", rays[ray]);
            let difference = (hit.t - expected.t).abs();
            assert!(difference <= 1.0e-6, "{config:?}, ray {ray}: {} for {}", hit.t, expected.t);
        }
    }
}

/// Lists that are short enough each, and too many nodes for the thread that sorts several: the rest
/// is sorted with the long ones.
#[test]
fn lists_that_one_thread_cannot_sort_together_are_sorted() {
    const LAYERS: u32 = 400;
    const { assert!(3 * LAYERS < 2 * NODE_SORT_LIMIT) };
    let bench = Bench::new();
    let wide = |layer: u32| {
        let depth = layer_depth((layer * 157 % LAYERS) as usize);
        quad([-0.9 * depth, 0.9 * depth], [-0.9 * depth, 0.9 * depth], depth)
    };
    let triangles: Vec<Triangle> = (0..LAYERS).flat_map(wide).collect();
    for storage in [Storage::Ll, Storage::Dll] {
        let config = Config { storage, ..Config::at_centres(16) };
        let structure = abuffer(&bench, config, &triangles, [0.0; 3]);
        let header = structure.header().expect("the header is readable");
        // A cell has one fragment per layer, two on the diagonal.
        assert!(header.long_demand > 0 && header.long_demand < 16 * 16, "{}", header.long_demand);
        assert_eq!(header.unsorted, 0);
        let contents = structure.download(bench.device()).expect("the device works");
        well_formed(&contents).unwrap_or_else(|fault| panic!("{config:?}: {fault}"));
    }
}

/// More fragments in one linked list than the dispatches sort: it is counted, and hits are the same.
#[test]
fn a_list_beyond_the_limit_is_counted_and_searched_in_full() {
    let layers_beyond = NODE_SORT_LONG_LIMIT as usize / 2 + 100;
    let bench = Bench::new();
    let triangles = layers(layers_beyond);
    let rays = rays_between_layers(layers_beyond, 60);
    let expected = brute_force(&bench, &triangles, &rays);
    let config = Config { storage: Storage::Ll, ..Config::at_centres(16) };
    let structure = abuffer(&bench, config, &triangles, [0.0; 3]);
    let status = structure.status(0).expect("the header is readable");
    assert_eq!((status.unsorted, status.corrupted), (1, 0), "{status:?}");
    let hits = bench.trace(&structure, &rays).hits;
    for (ray, (hit, expected)) in hits.iter().zip(&expected).enumerate() {
        assert_eq!(hit.primitive / 2, expected.primitive / 2, "{:?}", rays[ray]);
    }
}

/// Triangles so close to the eye that their cell is lost in rounding are found all the same.
#[test]
fn triangles_around_the_eye_are_found() {
    let bench = Bench::new();
    for eye in [[0.0; 3], [0.3, -0.7, 0.2]] {
        let shifted = |p: [f32; 3]| -> [f32; 3] { std::array::from_fn(|axis| p[axis] + eye[axis]) };
        let mut triangles = closed_box([-4.0; 3], [4.0; 3]);
        let close = 2.0_f32.powi(-17);
        triangles.push([[-0.02, -0.02, close], [0.02, -0.02, close], [0.0, 0.02, close]].map(shifted));
        let structure = abuffer(&bench, Config::at_centres(64), &triangles, eye);
        let header = structure.header().expect("the header is readable");
        assert!(header.near_size > close && header.near_size < 1e-3, "{}", header.near_size);
        assert_eq!(header.near_demand, 1);
        let mut random = Random::new(8);
        let reach = 0.5 * header.near_size;
        let rays: Vec<Ray> = (0..400)
            .map(|_| {
                let target = shifted([random.between(-reach, reach), random.between(-reach, reach), close]);
                let origin = shifted([random.between(-1.0, 1.0), random.between(-1.0, 1.0), -1.0]);
                towards(origin, target)
            })
            .collect();
        let expected = brute_force(&bench, &triangles, &rays);
        let hits = bench.trace(&structure, &rays).hits;
        assert!(expected.iter().all(|hit| hit.primitive == 12));
        assert_eq!(hits, expected, "eye at {eye:?}");
        // From the eye itself, through it, and away from it.
        let rays: Vec<Ray> = (0..400).map(|_| Ray::new(eye, random.direction())).collect();
        let hits = bench.trace(&structure, &rays).hits;
        for (hit, ray) in hits.iter().zip(&rays) {
            assert!(hit.is_hit() && hit.t.is_finite(), "{ray:?}: {hit:?}");
        }
    }
}

/// Each face sees one wall of a box around the eye, so hits are exact at every resolution, odd ones and 1
/// included.
#[test]
fn a_room_is_exact_at_every_resolution() {
    let bench = Bench::new();
    let triangles = closed_box([-2.0, -2.0, -2.0], [2.0, 2.0, 2.0]);
    let rays = Random::new(4).rays(1000, -1.9, 1.9);
    let expected = brute_force(&bench, &triangles, &rays);
    for resolution in [1, 2, 3, 5, 7, 33, 100, 255] {
        let structure = abuffer(&bench, Config::at_centres(resolution), &triangles, [0.0; 3]);
        let hits = bench.trace(&structure, &rays).hits;
        let occluded = bench.occluded(&structure, &rays);
        for (ray, (hit, expected)) in hits.iter().zip(&expected).enumerate() {
            assert!(hit.is_hit() && occluded[ray], "resolution {resolution}, {:?}: {expected:?}", rays[ray]);
            let difference = (hit.t - expected.t).abs();
            assert!(
                difference <= 4.0e-6 * expected.t.max(1.0e-2),
                "resolution {resolution}, {:?}: {hit:?} for {expected:?}",
                rays[ray]
            );
        }
    }
}

/// An eye far outside of the scene: cells are coarse there, answers stay finite and follow the law.
#[test]
fn an_eye_far_outside_sees_a_coarse_scene() {
    const RESOLUTION: u32 = 256;
    let bench = Bench::new();
    let mut triangles = sphere([0.0; 3], 2.0, 8);
    triangles.extend(quad([-4.0, 4.0], [-4.0, 4.0], 3.0));
    let rays = Random::new(6).rays(3000, -3.0, 2.9);
    let oracle = oracle_of(&triangles);
    let verdicts: Vec<_> = rays.iter().map(|ray| oracle.closest(&oracle_ray(ray))).collect();
    for distance in [20.0, 1.0e3, 1.0e6] {
        let structure = abuffer(&bench, Config::at_centres(RESOLUTION), &triangles, [0.0, 0.0, -distance]);
        let hits = bench.trace(&structure, &rays).hits;
        assert!(hits.iter().filter(|hit| hit.is_hit()).all(|hit| hit.t.is_finite() && hit.t > 0.0));
        assert!(
            hits.iter()
                .all(|hit| hit.primitive == PRIMITIVE_NONE || (hit.primitive as usize) < triangles.len())
        );
        if distance > 20.0 {
            continue;
        }
        let wrong = hits.iter().zip(&verdicts).filter(|(hit, verdict)| {
            let truth = verdict.outcome.hit();
            !verdict.ambiguous && truth.map(|(id, _)| id) != hit.is_hit().then_some(hit.primitive)
        });
        let share = wrong.count() as f64 / rays.len() as f64;
        // A cell is 0.16 m wide there and a triangle about 0.8 m: every other hit near an edge may err.
        assert!(share > 0.0 && share < 0.45, "{share} of the answers are wrong");
    }
}

#[test]
fn invalid_rays_miss_and_finish() {
    let bench = Bench::new();
    let triangles = closed_box([-2.0; 3], [2.0; 3]);
    let structure = abuffer(&bench, Config::at_centres(32), &triangles, [0.0; 3]);
    let good = Ray::new([0.1, 0.2, 0.3], [0.3, -0.5, 0.8]);
    let mut rays = vec![good];
    for bad in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY] {
        for axis in 0..3 {
            let mut ray = good;
            ray.origin[axis] = bad;
            rays.push(ray);
            let mut ray = good;
            ray.direction[axis] = bad;
            rays.push(ray);
        }
    }
    rays.push(Ray { direction: [0.0, -0.0, 0.0], ..good });
    rays.push(Ray { t_min: f32::NAN, ..good });
    rays.push(Ray { t_max: f32::NAN, ..good });
    rays.push(Ray { t_min: f32::INFINITY, ..good });
    rays.push(Ray { t_min: 5.0, t_max: 1.0, ..good });
    rays.push(Ray { t_max: 0.0, ..good });
    rays.push(Ray { t_max: -1.0, ..good });
    rays.push(good);
    let hits = bench.trace(&structure, &rays).hits;
    let occluded = bench.occluded(&structure, &rays);
    let last = rays.len() - 1;
    for (index, hit) in hits.iter().enumerate() {
        let expected = index == 0 || index == last;
        assert_eq!(hit.is_hit(), expected, "{:?}: {hit:?}", rays[index]);
        assert_eq!(occluded[index], expected, "{:?}", rays[index]);
    }
    assert_eq!(hits[0], hits[last]);
}

#[test]
fn limits_and_exclusion_are_kept() {
    let bench = Bench::new();
    let mut triangles: Vec<Triangle> = Vec::new();
    for depth in [2.0, 3.0, 4.0] {
        triangles.push([[-9.0, -9.0, depth], [9.0, -9.0, depth], [0.0, 18.0, depth]]);
    }
    let structure = abuffer(&bench, Config::at_centres(32), &triangles, [0.0; 3]);
    let mut random = Random::new(9);
    for _ in 0..20 {
        let direction = [random.between(-0.3, 0.3), random.between(-0.3, 0.3), 1.0];
        let ray = Ray::new([random.between(-0.2, 0.2), random.between(-0.2, 0.2), 0.0], direction);
        let rays = [
            ray,
            Ray { t_max: 2.0_f32.next_down(), ..ray },
            Ray { t_max: 2.5, ..ray },
            Ray { t_min: 2.5, ..ray },
            Ray { t_min: 2.5, t_max: 2.9, ..ray },
            Ray { exclude_primitive: 0, ..ray },
            Ray { exclude_primitive: 0, t_max: 2.5, ..ray },
            Ray { exclude_primitive: 1, t_min: 2.5, ..ray },
            Ray { t_min: 4.5, ..ray },
        ];
        let expected = [Some(0), None, Some(0), Some(1), None, Some(1), None, Some(2), None];
        let hits = bench.trace(&structure, &rays).hits;
        let occluded = bench.occluded(&structure, &rays);
        for (index, hit) in hits.iter().enumerate() {
            let found = hit.is_hit().then_some(hit.primitive);
            assert_eq!(found, expected[index], "{:?}", rays[index]);
            assert_eq!(occluded[index], expected[index].is_some(), "{:?}", rays[index]);
            if let Some(primitive) = found {
                let t = 2.0 + primitive as f32;
                assert!((hit.t - t).abs() < 1e-6, "{hit:?}");

                assert!(hit.t > rays[index].t_min && hit.t < rays[index].t_max);
            }
        }
    }
}
