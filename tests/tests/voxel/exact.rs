//! Voxels whose cells keep every triangle that reaches into them against brute force, bit for bit; and cells
//! that keep less are noticed.

use rasray_ads::{BruteForce, Ray, Structure, StructureKind};
use rasray_gpu::Timing;
use rasray_tests::harness::{Bench, bits};
use rasray_tests::random::Random;
use rasray_tests::rays::along_axis;
use rasray_tests::shapes::{all_sizes, needles};
use rasray_tracer::build_until_complete;
use rasray_voxel::{Addressing, Config, Coverage, Storage, Voxels, well_formed};

/// Anywhere within, along the axes, and at what is small.
fn rays(count: usize) -> Vec<Ray> {
    let mut random = Random::new(31);
    (0..count)
        .map(|index| {
            let origin = random.point(-9.0, 9.0);
            let mut direction = random.direction();
            if index % 4 == 0 {
                direction = along_axis(index / 4);
            }
            if index % 4 == 1 {
                let target = random.point(-0.02, 0.02);
                direction = std::array::from_fn(|axis| [1.0, 0.25, 0.5][axis] + target[axis] - origin[axis]);
            }
            Ray::new(origin, direction)
        })
        .collect()
}

#[test]
fn cells_that_keep_all_that_reaches_into_them_lose_no_hit() {
    let bench = Bench::new();
    let (triangles, rays) = (all_sizes(), rays(4000));
    let geometry = bench.geometry(&triangles);
    let brute = BruteForce::new(bench.device(), &geometry, None, false).expect("pipelines can be made");
    let (expected, occluded) = (bench.trace(&brute, &rays).hits, bench.occluded(&brute, &rays));
    let different = |config: Config| {
        let mut structure =
            Voxels::new(bench.device(), config, &geometry, None).expect("the options are valid");
        build_until_complete(bench.device(), &mut structure, [0.0; 3], Timing::None)
            .expect("the build completes");
        let contents = structure.download(bench.device()).expect("the device works");
        well_formed(&contents, triangles.len() as u32).expect("lists are well formed");
        let hits = bench.trace(&structure, &rays).hits;
        let wrong = hits.iter().zip(&expected).filter(|(hit, expected)| bits(hit) != bits(expected)).count();
        let found = bench.occluded(&structure, &rays);
        (structure.description().kind, wrong + found.iter().zip(&occluded).filter(|(a, b)| a != b).count())
    };
    let kept = |resolution| Config { coverage: Coverage::Conservative, ..Config::at_centres(resolution) };
    for config in [
        kept(1),
        kept(16),
        kept(37),
        Config { grid: Some(40), ..kept(64) },
        Config { sort: false, ..kept(16) },
        Config { storage: Storage::Linked, ..kept(16) },
        Config { storage: Storage::Paged, ..kept(16) },
        Config { addressing: Addressing::Address, ..kept(16) },
        Config { addressing: Addressing::Address, storage: Storage::Linked, ..kept(16) },
        Config { addressing: Addressing::Address, storage: Storage::Paged, page: 7, ..kept(16) },
    ] {
        assert_eq!(different(config), (StructureKind::Primitive, 0), "{config:?}");
    }
    let (kind, wrong) = different(Config::at_centres(16));
    assert_eq!(kind, StructureKind::Fragment);
    assert!(
        wrong > 100,
        "cells that keep what covers their centres answer {wrong} of {} rays wrong",
        rays.len()
    );
}

/// Depths that rounding leaves open are stored as none, in some cells of long needles and in no cell of
/// others.
#[test]
fn some_slivers_are_tested_at_all_depths_of_their_cells() {
    let bench = Bench::new();
    let geometry = bench.geometry(&needles());
    for resolution in [21, 64, 512] {
        let mut structure = Voxels::new(bench.device(), Config::robust(resolution), &geometry, None)
            .expect("the options are valid");
        build_until_complete(bench.device(), &mut structure, [0.0; 3], Timing::None)
            .expect("the build completes");
        let contents = structure.download(bench.device()).expect("the device works");
        let depths = contents.fragments.chunks(2).map(|fragment| fragment[0]);
        let (anywhere, kept) = (depths.clone().filter(|&depth| depth == 0).count(), depths.count());
        println!("{resolution} cells along a side: {anywhere} of {kept} at all depths");
        assert!(0 < anywhere && anywhere < kept, "{anywhere} of {kept}");
    }
}
