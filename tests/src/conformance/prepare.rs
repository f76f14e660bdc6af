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

/// Hard case with its truth and its triangles on the device, for all rows.
#[derive(Debug)]
pub struct Prepared {
    /// Hard case; its primitive ids are those of the case's own triangle list.
    pub case: HardCase,
    /// Verdicts of the oracle, one per ray.
    pub verdicts: Vec<Verdict>,
    /// Geometry of the triangles that a loader keeps.
    pub geometry: Geometry,
    /// Rays with ids as the device counts them.
    pub rays: Vec<Ray>,
    /// Viewpoint: the case's eye, and a camera there.
    pub viewpoint: Viewpoint,
    /// True if only rays whose hits the camera sees are evaluated.
    pub only_camera: bool,
    /// Ids of the kept triangles.
    pub placed: Placed,
}

impl Prepared {
    /// Asks the oracle, and uploads the triangles that a loader keeps.
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

    /// Keeps only the first rays, for structures whose work per ray grows with the number of triangles.
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

    /// True for a ray that is not evaluated: only hits that the camera sees are evaluated, and a possible hit
    /// of this ray lies outside its view.
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

/// Makes the viewpoint of an eye with the camera that all hard cases have.
fn viewpoint(eye: [f32; 3]) -> Viewpoint {
    let mut frame = Frame::zeroed();
    View { camera: case_camera(eye), width: 1, height: 1, seed: 0 }.write(&mut frame, DVec3::ZERO);
    viewpoint_of(&frame).at(eye)
}
