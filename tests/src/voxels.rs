//! Voxel structures for tests.

use rasray_ads::Geometry;
use rasray_gpu::Timing;
use rasray_tracer::build_until_complete;
use rasray_voxel::{Config, Contents, Payload, Voxels};

use crate::harness::Bench;
use crate::shapes::Triangle;

/// Returns the published rules of Hu et al. with triangles in the fragments, since attributes need a scene.
pub fn hu(resolution: u32) -> Config {
    Config { payload: Payload::Index, ..Config::published_hu(resolution) }
}

/// Returns the published rules of Selective reflections with triangles in the fragments, since attributes
/// need a scene.
pub fn selective(resolution: u32) -> Config {
    Config { payload: Payload::Index, ..Config::published_selective(resolution) }
}

/// Makes a structure of these triangles, without a build.
///
/// # Panics
/// If the options are not valid, or the device fails.
pub fn made(bench: &Bench, config: Config, triangles: &[Triangle]) -> Voxels {
    let geometry = bench.geometry(triangles);
    Voxels::new(bench.device(), config, &geometry, None).expect("the options are valid")
}

/// Makes as [`made`], and builds with as much capacity as needed.
///
/// # Panics
/// As [`made`], or if it cannot be built.
pub fn built(bench: &Bench, config: Config, triangles: &[Triangle]) -> Voxels {
    built_of(bench, config, &bench.geometry(triangles))
}

/// Makes and builds as [`built`] for a geometry that was uploaded.
///
/// # Panics
/// As [`built`].
pub fn built_of(bench: &Bench, config: Config, geometry: &Geometry) -> Voxels {
    let mut structure = Voxels::new(bench.device(), config, geometry, None).expect("the options are valid");
    build_until_complete(bench.device(), &mut structure, [0.0; 3], Timing::None)
        .expect("the build completes");
    structure
}

/// Reads the contents of a structure.
///
/// # Panics
/// If the device fails.
pub fn contents(bench: &Bench, structure: &Voxels) -> Contents {
    structure.download(bench.device()).expect("the device works")
}
