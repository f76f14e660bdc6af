//! Rendered images against closed forms: `docs/image-truth.md`.

mod albedo;
mod corridor;
mod form_factors;
mod furnace;
mod glass;
mod gltf;
mod layers;
mod leaks;
mod polygon_light;

use rasray_tests::harness::Bench;
use rasray_tests::image_truth::System;
use rasray_tests::tier::Counts;

/// Cells along a side of the A-buffer where it is held against closed forms.
const RESOLUTION: u32 = 64;

/// Brute force and the A-buffer.
const SYSTEMS: [System; 2] = [System::BruteForce, System::Fragments(RESOLUTION)];

/// Samples over those of the quick tier.
const MORE: Counts<u32> = Counts { quick: 1, software: 4, full: 16 };

/// Samples of a picture, from those of the quick tier.
fn samples(bench: &Bench, quick: u32) -> u32 {
    quick * MORE.on(bench.device(), "samples over those of the quick tier")
}

/// `exact` for brute force, `fragments` for the A-buffer.
fn by_system<T>(system: System, exact: T, fragments: T) -> T {
    if system == System::BruteForce { exact } else { fragments }
}

/// Largest error of a structure, relative, in an image whose samples depend on `traces` traces: nothing, or
/// the share of wrong rays that the conformance rows allow.
fn law(system: System, traces: u32) -> f64 {
    match system {
        System::BruteForce => 0.0,
        System::Fragments(resolution) => 0.64 / f64::from(resolution) * f64::from(traces),
    }
}

/// One value in all channels.
fn grey(value: f64) -> [f64; 3] {
    [value; 3]
}
