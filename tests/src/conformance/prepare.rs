use bytemuck::Zeroable;
use glam::DVec3;
use rasray_ads::{Geometry, Ray, Viewpoint};
use rasray_experiment::{Placed, case_camera};
use rasray_gpu_scene::{
    View,
    layout::{Frame, viewpoint_of},
};
use rasray_reference::oracle::{Oracle, Verdict};

use crate::hard_cases::{Expectation, HardCase};
use crate::harness::Bench;

/// A hard case with its truth and its triangles on the device, for all rows.
#[derive(Debug)]
pub struct Prepared {
    /// The case; its primitive ids are those of the case's own triangle list.
    pub case: HardCase,
    /// One per ray.
    pub verdicts: Vec<Verdict>,
    /// Triangles that a loader keeps.
    pub geometry: Geometry,
    /// The rays with ids as the device counts them.
    pub rays: Vec<Ray>,
    /// The case's eye, and a camera there.
    pub viewpoint: Viewpoint,
    /// Only what the camera sees is evaluated.
    pub only_camera: bool,
    /// Numbers of these triangles.
    pub placed: Placed,
}

impl Prepared {
    /// Queries the oracle and uploads what a loader keeps.
    ///
    /// # Panics
    /// If the device fails or the oracle refuses the triangles.
    pub fn new(bench: &Bench, case: HardCase) -> Self {
        let (positions, indices) = case.buffers();
        let oracle = Oracle::new(&positions, &indices, None).expect("indices are in order");
        let verdicts = oracle.closest_batch(&case.rays);
        let placed = Placed::new(&case.triangles);
        let rays = case.rays.iter().map(|ray| placed.device_ray(ray)).collect();
        let viewpoint = viewpoint(case.eye);
        let geometry = bench.geometry(&placed.triangles(&case.triangles));
        Self { geometry, verdicts, rays, viewpoint, only_camera: false, placed, case }
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

    /// True for rays that are not evaluated: only what the camera sees is, and something that it may hit lies
    /// outside.
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
}

/// An eye with the camera that all hard cases have.
fn viewpoint(eye: [f32; 3]) -> Viewpoint {
    let mut frame = Frame::zeroed();
    View { camera: case_camera(eye), width: 1, height: 1, seed: 0 }.write(&mut frame, DVec3::ZERO);
    viewpoint_of(&frame).at(eye)
}
