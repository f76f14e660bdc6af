use bytemuck::Zeroable;
use glam::DVec3;
use rasray_ads::{Geometry, PRIMITIVE_NONE, Ray, Viewpoint};
use rasray_gpu_scene::{View, layout::Frame};
use rasray_reference::oracle::{self, COORDINATE_LIMIT, Oracle, Verdict};

use rasray_scene::default_view::camera_looking_at;

use crate::hard_cases::{CAMERA_TOWARDS, Expectation, HardCase, Triangle};
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
    /// The case's eye, and a camera there.
    pub viewpoint: Viewpoint,
    /// Only what the camera sees is judged.
    pub only_camera: bool,
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
        let viewpoint = viewpoint(case.eye);
        let geometry = bench.geometry(&triangles);
        Self { geometry, verdicts, rays, viewpoint, only_camera: false, kept, case }
    }

    /// Keeps only the first rays, for structures whose work grows with all triangles.
    pub fn truncate(&mut self, rays: usize) {
        self.case.rays.truncate(rays);
        self.verdicts.truncate(rays);
        self.rays.truncate(rays);
    }

    /// Keeps only the rays of these indices.
    pub fn retain(&mut self, keep: impl Fn(usize) -> bool) {
        let kept: Vec<usize> = (0..self.rays.len()).filter(|&index| keep(index)).collect();
        self.case.rays = kept.iter().map(|&index| self.case.rays[index]).collect();
        self.verdicts = kept.iter().map(|&index| self.verdicts[index].clone()).collect();
        self.rays = kept.iter().map(|&index| self.rays[index]).collect();
        if let Expectation::PerRay(answers) = &mut self.case.expect {
            *answers = kept.iter().map(|&index| answers[index]).collect();
        }
    }

    /// Whether a ray is not judged: only what the camera sees is, and of all that it may meet something lies outside.
    pub fn is_unseen(&self, index: usize) -> bool {
        let Some(camera) = self.viewpoint.camera.filter(|_| self.only_camera) else { return false };
        let (ray, verdict) = (&self.case.rays[index], &self.verdicts[index]);
        let is_outside = |t: f64| {
            let eye = self.viewpoint.eye;
            !camera.sees(std::array::from_fn(|axis| {
                f64::from(ray.origin[axis]) + t * f64::from(ray.direction[axis]) - f64::from(eye[axis])
            }))
        };
        let candidates = verdict.candidates.iter().flat_map(|one| [one.t_low, one.t_high]);
        verdict.outcome.hit().map(|(_, t)| t).into_iter().chain(candidates).any(is_outside)
    }

    /// The case's id of a triangle on the device; absent if there is no such triangle.
    pub fn primitive(&self, on_device: u32) -> Option<u32> {
        self.kept.get(on_device as usize).copied()
    }
}

/// An eye with the camera that all hard cases have.
fn viewpoint(eye: [f32; 3]) -> Viewpoint {
    let at = DVec3::from_array(eye.map(f64::from));
    let target = at + DVec3::from_array(CAMERA_TOWARDS);
    let camera = camera_looking_at("hard case", at, target, std::f32::consts::FRAC_PI_2);
    let mut frame = Frame::zeroed();
    View { camera, width: 1, height: 1, seed: 0 }.write(&mut frame, DVec3::ZERO);
    frame.viewpoint().at(eye)
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
