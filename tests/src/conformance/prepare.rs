use rasray_ads::{Geometry, PRIMITIVE_NONE, Ray};
use rasray_reference::oracle::{self, COORDINATE_LIMIT, Oracle, Verdict};

use crate::hard_cases::{HardCase, Triangle};
use crate::harness::Bench;

/// A hard case with its truth and its triangles on the device, for all rows.
#[derive(Debug)]
pub struct Prepared {
    /// The case; its primitive ids are those of the case's own triangle list.
    pub case: HardCase,
    /// One per ray.
    pub verdicts: Vec<Verdict>,
    /// What a loader keeps of the triangles.
    pub geometry: Geometry,
    /// The rays with ids as the device counts them.
    pub rays: Vec<Ray>,
    /// The case's id of each triangle on the device.
    kept: Vec<u32>,
}

/// Indices of the triangles that loaders keep: those whose coordinates are finite and have finite squares.
pub fn loadable(triangles: &[Triangle]) -> Vec<u32> {
    let good = |triangle: &Triangle| triangle.iter().flatten().all(|x| x.abs() <= COORDINATE_LIMIT);
    (0..triangles.len() as u32).filter(|&index| good(&triangles[index as usize])).collect()
}

impl Prepared {
    /// Asks the oracle and uploads what a loader keeps.
    ///
    /// # Panics
    /// If the device fails or the oracle refuses the triangles.
    pub fn new(bench: &Bench, case: HardCase) -> Self {
        let (positions, indices) = case.buffers();
        let oracle = Oracle::new(&positions, &indices, None).expect("indices are in order");
        let verdicts = oracle.closest_batch(&case.rays);
        let kept = loadable(&case.triangles);
        let triangles: Vec<Triangle> = kept.iter().map(|&index| case.triangles[index as usize]).collect();
        let rays = case.rays.iter().map(|ray| device_ray(ray, &kept)).collect();
        Self { geometry: bench.geometry(&triangles), verdicts, rays, kept, case }
    }

    /// Keeps only the first rays, for structures whose work grows with all triangles.
    pub fn truncate(&mut self, rays: usize) {
        self.case.rays.truncate(rays);
        self.verdicts.truncate(rays);
        self.rays.truncate(rays);
    }

    /// The case's id of a triangle on the device; absent if there is no such triangle.
    pub fn primitive(&self, on_device: u32) -> Option<u32> {
        self.kept.get(on_device as usize).copied()
    }
}

fn device_ray(ray: &oracle::Ray, kept: &[u32]) -> Ray {
    // An excluded triangle that was dropped excludes nothing.
    let exclude = ray.exclude_primitive.and_then(|id| kept.binary_search(&id).ok());
    Ray {
        t_min: ray.t_min,
        t_max: ray.t_max,
        exclude_primitive: exclude.map_or(PRIMITIVE_NONE, |index| index as u32),
        ..Ray::new(ray.origin, ray.direction)
    }
}
