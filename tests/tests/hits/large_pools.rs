//! Pools larger than what one binding holds: refused by name through descriptors, and reached by address with
//! the same hits; and, in the full tier, a million triangles through every system.

use rasray_ads::{AdsError, BruteForce, Hit, Ray, Structure, StructureKind};
use rasray_bvh::{Builder, Bvh};
use rasray_gpu::{Feature, GpuError, Timing};
use rasray_primitive::{Addressing, Config, PrimitiveLists};
use rasray_systems::{SYSTEMS, Spec, System, SystemsError};
use rasray_tests::harness::{Bench, bits, is_offered};
use rasray_tests::random::Random;
use rasray_tests::shapes::{Triangle, closed_box, sphere};
use rasray_tests::tier::is_full;
use rasray_tracer::build_until_complete;

/// The share of rays that structures of fragments may answer wrongly among a million small triangles, at 512
/// cells along a side.
const FRAGMENTS_OFF: f64 = 0.05;

fn rays(count: usize) -> Vec<Ray> {
    Random::new(402).rays(count, -3.5, 3.5)
}

fn all_bits(hits: &[Hit]) -> Vec<[u32; 4]> {
    hits.iter().map(bits).collect()
}

#[test]
fn a_pool_beyond_a_binding_is_reached_by_address() {
    let bench = Bench::new();
    let limit = bench.device().limits().max_storage_buffer_range;
    let mut triangles: Vec<Triangle> = sphere([0.5, 0.25, 0.75], 1.0, 24);
    triangles.extend(closed_box([-4.0; 3], [4.0; 3]));
    let geometry = bench.geometry(&triangles);
    // One word per list: 202 million bytes of lists.
    let config = Config { tile: 1, buckets: 8, ..Config::robust(1024) };
    let described = PrimitiveLists::new(bench.device(), config, &geometry, None);
    if limit >= 202 << 20 {
        println!("skipped: one binding of this device holds {limit} bytes");
        return;
    }
    let error = described.expect_err("the lists exceed a binding");
    assert!(matches!(error, AdsError::Gpu(GpuError::TooLarge { .. })), "{error}");
    assert!(error.to_string().contains("lists"), "{error}");
    if !bench.device().has(Feature::BufferDeviceAddress) {
        println!("skipped: the device has no buffer device addresses");
        return;
    }
    let config = Config { addressing: Addressing::Address, ..config };
    let mut lists = PrimitiveLists::new(bench.device(), config, &geometry, None).expect("addresses reach it");
    let pool = lists.sizes().pools.iter().find(|pool| pool.name == "lists").expect("the pool");
    assert!(pool.elements * pool.element_bytes > limit);
    let rays = rays(2000);
    let found = bench.build_and_trace(&mut lists, [0.1, 0.2, 0.3], &rays);
    let config = rasray_bvh::Config::new(Builder::Sah);
    let mut tree = Bvh::new(bench.device(), config, &geometry, None).expect("the options are valid");
    assert_eq!(all_bits(&found), all_bits(&bench.build_and_trace(&mut tree, [0.0; 3], &rays)));
}

#[test]
fn every_system_reaches_large_pools_by_address() {
    let bench = Bench::new();
    if !bench.device().has(Feature::BufferDeviceAddress) {
        println!("skipped: the device has no buffer device addresses");
        return;
    }
    let mut triangles: Vec<Triangle> = sphere([0.5, 0.25, 0.75], 1.0, 24);
    triangles.extend(closed_box([-4.0; 3], [4.0; 3]));
    let geometry = bench.geometry(&triangles);
    let rays = rays(2000);
    let eye = [0.1, 0.2, 0.3];
    let mut tree = Bvh::new(bench.device(), rasray_bvh::Config::new(Builder::Sah), &geometry, None)
        .expect("the options are valid");
    let truth = bench.build_and_trace(&mut tree, eye, &rays);
    let large = || SYSTEMS.iter().filter(|system| !system.large_pools.is_empty());
    for system in SYSTEMS.iter().filter(|system| system.size_option().is_some()) {
        assert!(large().any(|other| other == system), "{} has no large pool in its row", system.name);
    }
    let tried: Vec<_> = large().filter(|system| is_full() || system.name == "hu").collect();
    if !is_full() {
        println!("skipped: set RASRAY_FULL to 1 for systems other than hu");
    }
    for System { name: system, large_pools, .. } in tried {
        let options = large_pools.iter().map(|(name, value)| ((*name).to_owned(), (*value).to_owned()));
        let spec = Spec::new(system, "robust", options).expect("the options are valid");
        match spec.create(bench.device(), &geometry, None) {
            Err(SystemsError::Ads(AdsError::Gpu(GpuError::TooLarge { .. }))) => {}
            Err(error) => panic!("{system}: {error}"),
            Ok(_) => {
                let limit = bench.device().limits().max_storage_buffer_range;
                println!("skipped: {system}: one binding of this device holds {limit} bytes");
                continue;
            }
        }
        let spec = spec.with_option("addressing", "address").expect("every system takes it");
        let mut structure = spec.create(bench.device(), &geometry, None).expect("addresses reach it");
        build_until_complete(bench.device(), structure.as_mut(), eye, Timing::None).expect("it is built");
        let hits = bench.trace(structure.as_ref(), &rays).hits;
        if structure.description().kind == StructureKind::Primitive {
            assert_eq!(all_bits(&hits), all_bits(&truth), "{system}");
        }
        let is_other = |(hit, truth): &(&Hit, &Hit)| hit.primitive != truth.primitive;
        let off = hits.iter().zip(&truth).filter(is_other).count();
        println!("{system}: {off} of {} rays hit another triangle", rays.len());
        assert!(off <= rays.len() / 100, "{system}: {off}");
    }
}

/// A room with so many triangles of small spheres in it, or a few more.
fn many_spheres(count: usize) -> Vec<Triangle> {
    let mut random = Random::new(403);
    let mut triangles: Vec<Triangle> = closed_box([-4.0; 3], [4.0; 3]);
    while triangles.len() < count {
        triangles.extend(sphere(random.point(-3.0, 3.0), random.between(0.02, 0.2), 40));
    }
    triangles
}

/// Trees grow with triangles alone, and so do bricks where their cells follow from these: with more of
/// them than a binding has capacity for, both builders and the bricks are refused by name or reached by
/// address, and find the same.
#[test]
fn trees_and_bricks_of_many_triangles_are_reached_by_address() {
    if !is_full() {
        println!("skipped: set RASRAY_FULL to 1 for the large counts");
        return;
    }
    let bench = Bench::new();
    if !bench.device().has(Feature::BufferDeviceAddress) {
        println!("skipped: the device has no buffer device addresses");
        return;
    }
    let geometry = bench.geometry(&many_spheres(2_300_000));
    let rays = rays(20_000);
    // Every triangle for a few.
    let few = &rays[..200];
    let brute = BruteForce::new(bench.device(), &geometry, None, true).expect("pipelines can be made");
    let truth = all_bits(&bench.trace(&brute, few).hits);
    let mut expected: Option<Vec<[u32; 4]>> = None;
    for (system, option, value) in
        [("bvh", "builder", "sah"), ("bvh", "builder", "lbvh"), ("bricks", "views", "cube")]
    {
        let described = Spec::new(system, "robust", [(option.to_owned(), value.to_owned())]).expect("valid");
        let spec = described.clone().with_option("addressing", "address").expect("every system takes it");
        let build = |spec: &Spec| -> Result<_, String> {
            let structure = spec.create(bench.device(), &geometry, None);
            let mut structure = structure.map_err(|error| error.to_string())?;
            build_until_complete(bench.device(), structure.as_mut(), [0.1, 0.2, 0.3], Timing::None)
                .map_err(|error| error.to_string())?;
            Ok(structure)
        };
        let structure = build(&spec).expect("addresses reach it");
        let pools = structure.sizes().pools.iter();
        let largest = pools.max_by_key(|pool| pool.elements * pool.element_bytes).expect("it has pools");
        let bytes = largest.elements * largest.element_bytes;
        println!("{system} {value}: {} takes {bytes} bytes", largest.name);
        if bytes > bench.device().limits().max_storage_buffer_range {
            let refusal = build(&described).map(drop).expect_err("a binding cannot hold it");
            assert!(refusal.contains("a storage buffer binding ends at"), "{refusal}");
        } else {
            println!("skipped: a binding of this device holds {}", largest.name);
        }
        let hits = all_bits(&bench.trace(structure.as_ref(), &rays).hits);
        assert_eq!(hits[..few.len()], truth, "{system} {value}");
        assert!(expected.get_or_insert_with(|| hits.clone()) == &hits, "{system} {value}");
    }
}

#[test]
fn a_million_triangles_are_found_alike() {
    if !is_full() {
        println!("skipped: set RASRAY_FULL to 1 for the large counts");
        return;
    }
    let bench = Bench::new();
    let triangles = many_spheres(1_000_000);
    let geometry = bench.geometry(&triangles);
    let rays = rays(20_000);
    let mut specs: Vec<(&str, Option<(&str, &str)>)> = SYSTEMS
        .iter()
        .filter(|system| system.name != "brute-force")
        .map(|system| (system.name, None))
        .collect();
    // The tree on the host is what the others are held against.
    specs.sort_by_key(|(system, ..)| *system != "bvh");
    specs.extend([("bvh", Some(("builder", "lbvh"))), ("bricks", Some(("views", "cube")))]);
    let mut expected: Vec<Hit> = Vec::new();
    for (system, option) in specs {
        let options = option.map(|(name, value)| (name.to_owned(), value.to_owned()));
        let spec = Spec::new(system, "robust", options).expect("the options are valid");
        if !is_offered(&spec) {
            continue;
        }
        let mut structure = spec.create(bench.device(), &geometry, None).expect("its pools fit");
        build_until_complete(bench.device(), structure.as_mut(), [0.1, 0.2, 0.3], Timing::None)
            .expect("it is built");
        let hits = bench.trace(structure.as_ref(), &rays).hits;
        if expected.is_empty() {
            expected = hits;
            continue;
        }
        let name = format!("{system} {}", option.map_or("", |(_, value)| value));
        if structure.description().kind == StructureKind::Primitive {
            assert_eq!(all_bits(&hits), all_bits(&expected), "{name}");
            println!("{name}: the same hits");
            continue;
        }
        // Triangles are finer than cells: hits must lie on the surface.
        let is_near = |(hit, truth): &(&Hit, &Hit)| (hit.t - truth.t).abs() < 0.05;
        let off = rays.len() - hits.iter().zip(&expected).filter(is_near).count();
        let share = off as f64 / rays.len() as f64;
        println!("{name}: {share:.4} of the rays are more than 0.05 off");
        assert!(share < FRAGMENTS_OFF, "{name}: {share}");
    }
}
