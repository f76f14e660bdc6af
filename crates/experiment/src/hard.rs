//! A hard case through all systems, judged by the oracle and by what is stated of the case.

use glam::{DAffine3, DVec3, Vec3};
use rasray_ads::{Hit, PRIMITIVE_NONE, PRIMITIVE_UNKNOWN, Ray, StructureKind};
use rasray_gpu::Device;
use rasray_hard_cases::{Answer, CAMERA_TOWARDS, HardCase, Triangle};
use rasray_reference::oracle::{self, COORDINATE_LIMIT, Oracle, Verdict};
use rasray_scene::default_view::camera_looking_at;
use rasray_scene::needs::Needs;
use rasray_scene::{Instance, Material, Mesh, Scene};

use crate::compare::triangles;
use crate::contestant::Contestant;
use crate::error::ExperimentError;
use crate::hard_verdict::{Judged, hard_record};
use crate::jobs::{Comparison, HardJob, OnProgress, Progress};
use crate::replay::replay_case;
use crate::stage::{Stage, device_error};
use crate::traced_set::{RaysWithTruth, Wanted, compare_set};

/// A case as it is on the device: what loaders keep of its triangles, relative to the world's origin.
struct Placed {
    /// The case's id of each triangle on the device.
    kept: Vec<u32>,
    scene: Scene,
}

impl Placed {
    /// Triangles whose coordinates are finite and have finite squares, as loaders keep them.
    fn new(case: &HardCase) -> Self {
        let good = |triangle: &Triangle| triangle.iter().flatten().all(|x| x.abs() <= COORDINATE_LIMIT);
        let kept: Vec<u32> =
            (0..case.triangles.len() as u32).filter(|&id| good(&case.triangles[id as usize])).collect();
        let positions: Vec<[f32; 3]> = kept.iter().flat_map(|&id| case.triangles[id as usize]).collect();
        let mut scene = Scene { name: format!("hard:{}", case.id), ..Scene::default() };
        if !positions.is_empty() {
            scene.materials.push(Material::default());
            scene.meshes.push(Mesh {
                name: case.id.to_owned(),
                indices: (0..positions.len() as u32).collect(),
                positions,
                normals: None,
                tangents: None,
                uvs: [None, None],
                colors: None,
                material: 0,
            });
            scene.instances.push(Instance {
                name: case.id.to_owned(),
                mesh: 0,
                world_from_mesh: DAffine3::IDENTITY,
            });
        }
        Self { kept, scene }
    }

    /// The ray with ids as the device counts them.
    fn device_ray(&self, ray: &oracle::Ray) -> Ray {
        // An excluded triangle that was dropped excludes nothing.
        let exclude = ray.exclude_primitive.and_then(|id| self.kept.binary_search(&id).ok());
        Ray {
            t_min: ray.t_min,
            t_max: ray.t_max,
            exclude_primitive: exclude.map_or(PRIMITIVE_NONE, |index| index as u32),
            ..Ray::new(ray.origin, ray.direction)
        }
    }

    /// The hit with ids as the case counts them.
    fn named(&self, hit: Hit) -> Hit {
        Hit { primitive: self.id(hit.primitive), ..hit }
    }

    /// The case's id of a triangle on the device.
    fn id(&self, on_device: u32) -> u32 {
        if matches!(on_device, PRIMITIVE_NONE | PRIMITIVE_UNKNOWN) {
            return on_device;
        }
        // An id that is on no triangle must not become that of one.
        self.kept.get(on_device as usize).copied().unwrap_or(PRIMITIVE_UNKNOWN - 1)
    }
}

/// Runs all systems on the rays of a case.
pub(super) fn hard(
    device: &Device,
    job: &HardJob<'_>,
    progress: &mut OnProgress<'_>,
) -> Result<Comparison, ExperimentError> {
    let case = job.case;
    let placed = Placed::new(case);
    let eye = DVec3::from(Vec3::from(case.eye));
    let camera =
        camera_looking_at("hard case", eye, eye + DVec3::from(CAMERA_TOWARDS), std::f32::consts::FRAC_PI_2);
    // Relative to the world's own origin, so that positions are those of the case bit for bit.
    let stage = Stage::around(device, &placed.scene, DVec3::ZERO, &camera, [1, 1], job.seed, &Needs::all())?;
    check_positions(device, &stage, case, &placed.kept)?;
    if let Some(index) = job.replay {
        let rays = case.rays.iter().map(|ray| placed.device_ray(ray)).collect();
        return replay_case(device, &stage, job.systems, (case.id, case.eye), rays, index);
    }
    let (positions, indices) = case.buffers();
    let oracle = Oracle::new(&positions, &indices, None).map_err(device_error)?;
    let set = RaysWithTruth {
        name: case.id.to_owned(),
        rays: case.rays.iter().map(|ray| placed.device_ray(ray)).collect(),
        verdicts: oracle.closest_batch(&case.rays),
    };
    let contestants = Contestant::all(device, &stage, job.systems, case.eye, job.repetitions, progress)?;
    let mut comparison = Comparison::default();
    if job.keep {
        comparison.kept.triangles = case.triangles.clone();
        comparison.kept.case = Some(case.id.to_owned());
    }
    let wanted = Wanted {
        repetitions: job.repetitions,
        seed: job.seed,
        figures: job.figures,
        keep: job.keep,
        given_hits: job.hits_files,
    };
    let name = |hits: Vec<Hit>| hits.into_iter().map(|hit| placed.named(hit)).collect();
    let answers = compare_set(device, &contestants, &set, wanted, name, &mut comparison)?;
    for ray in comparison.kept.sets.iter_mut().flat_map(|set| &mut set.rays) {
        ray.exclude_primitive = placed.id(ray.exclude_primitive);
    }
    for (run, answer) in comparison.runs.iter_mut().zip(&answers) {
        let mut judged = judged(case, answer.kind, &set.verdicts, &answer.hits);
        let largest_dt = run.accuracy.as_ref().and_then(|accuracy| accuracy.dt_rel_max);
        judged.dt = largest_dt.zip(case.largest_dt.filter(|_| answer.kind == StructureKind::Primitive));
        run.hard = Some(hard_record(case, answer.kind, &judged, run.options.get("resolution")));
    }
    let done = comparison.runs.len() as u64;
    // Nothing follows that an early end could spare.
    _ = progress(Progress { task: case.id, done, total: done, unit: "runs" });
    Ok(comparison)
}

/// That the device has the case's triangles and no others, bit for bit.
fn check_positions(
    device: &Device,
    stage: &Stage,
    case: &HardCase,
    kept: &[u32],
) -> Result<(), ExperimentError> {
    let geometry = stage.scene.geometry().desc();
    let positions = device
        .download_as::<[f32; 3]>(&geometry.positions, 0, geometry.vertex_count as usize)
        .map_err(device_error)?;
    let indices = device
        .download_as::<u32>(&geometry.indices, 0, 3 * geometry.triangle_count as usize)
        .map_err(device_error)?;
    let bits = |triangle: &Triangle| triangle.map(|corner| corner.map(f32::to_bits));
    let expected = kept.iter().map(|&id| bits(&case.triangles[id as usize]));
    if triangles(&positions, &indices).iter().map(bits).eq(expected) {
        return Ok(());
    }
    Err(ExperimentError::device(
        format!("the triangles of {} are not the same on the device", case.id),
        "this is a defect; please report it with the command line",
    ))
}

/// Depth that a fragment may be off by and count as right, relative.
const FRAGMENT_DEPTH: f64 = 1.0e-3;

/// 64 units of rounding: what a hit may differ by beyond the bounds that the oracle derives from the test.
const ROUNDING: f64 = 64.0 / 16_777_216.0;

/// Counts what of the hits neither oracle nor statement allows.
fn judged(case: &HardCase, kind: StructureKind, verdicts: &[Verdict], hits: &[Hit]) -> Judged {
    let tolerance = match kind {
        StructureKind::Primitive | StructureKind::LossyPrimitive => ROUNDING,
        StructureKind::Fragment => FRAGMENT_DEPTH,
    };
    let mut judged = Judged { rays: hits.len() as u64, ..Judged::default() };
    for (index, (verdict, hit)) in verdicts.iter().zip(crate::judge::device_hits(hits)).enumerate() {
        let answer = case.answer(index);
        judged.hits += u64::from(hit.is_some());
        judged.non_finite += u64::from(hit.is_some_and(|hit| !hit.t.is_finite()));
        let must_hit = matches!(answer, Answer::Hit | Answer::HitAt { .. } | Answer::HitOn { .. });
        judged.lost += u64::from(must_hit && hit.is_none());
        if case.accepts(index, verdict, hit, tolerance) {
            continue;
        }
        judged.rejected += 1;
        judged.first_rejected.get_or_insert(index as u64);
        judged.rejected_hits += u64::from(hit.is_some());
        judged.out_of_range += u64::from(matches!(answer, Answer::Anything { .. }));
    }
    judged
}
