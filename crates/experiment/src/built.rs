//! Structure over a scene on the device: the build, its times and its bytes.

use std::collections::BTreeMap;
use std::time::Instant;

use rasray_ads::{AdsError, Combined, GeometryParts, ListCounts, Structure, Viewpoint};
use rasray_gpu::{Device, Feature, GpuError, Stage, Timing};
use rasray_gpu_scene::{GpuScene, GpuSceneError};
use rasray_scene::Scene;
use rasray_systems::Spec;
use rasray_tracer::{BuildOutcome, FrameSettings, FrameStructure, refresh_until_complete};
use serde_json::Value;

use crate::device_scene::DeviceScene;
use crate::error::ExperimentError;
use crate::jobs::Refresh;
use crate::passes::{Passes, median, spread};
use rasray_report::{Counters, ListRecord, Memory, Pass, PassOf, Spread, StageTime, Times};

/// True if the addressing was left open and the device supports addresses.
fn may_use_addresses(device: &Device, spec: &Spec) -> bool {
    let has_option = spec.system().has("addressing");
    has_option && spec.options().get("addressing").is_none() && device.has(Feature::BufferDeviceAddress)
}

/// Settings of frames made one after the other, each of which waits for its build: pools are just as large as
/// their contents.
const SETTINGS: FrameSettings = FrameSettings { slots: 1, headroom: 0 };

/// Makes a structure, in parts if these are given, and builds it until it is complete.
fn first_build(
    device: &Device,
    spec: &Spec,
    (scene, parts): (&GpuScene, Option<&GeometryParts>),
    viewpoint: Viewpoint,
    timing: Timing,
) -> Result<(FrameStructure, BuildOutcome), ExperimentError> {
    let requirements = spec.requirements()?;
    if let Some(missing) = requirements.required.iter().find(|feature| !device.has(**feature)) {
        return Err(missing_feature(device, spec, *missing));
    }
    let create = |geometry: &_| spec.create(device, geometry, Some(scene.binding()));
    let made: rasray_tracer::Refresh = match parts {
        Some(parts) => Combined::new(parts, create).map(Into::into),
        None => create(scene.geometry()).map(Into::into),
    }
    .map_err(|error| too_large(error.into(), spec))?;
    let mut structure =
        FrameStructure::new(device, made, SETTINGS).map_err(|error| too_large(error.into(), spec))?;
    let outcome = refresh_until_complete(device, &mut structure, viewpoint, timing)
        .map_err(|error| too_large(error.into(), spec))?;
    Ok((structure, outcome))
}

/// Makes the error of a device that lacks a feature which a system or one of its options needs.
fn missing_feature(device: &Device, spec: &Spec, missing: Feature) -> ExperimentError {
    let (system, device) = (spec.system().name, device.name().to_owned());
    match spec.option_that_requires(missing) {
        Some((option, value)) => {
            ExperimentError::OptionNeedsFeature { system, option, value, feature: missing, device }
        }
        None => ExperimentError::SystemNeedsFeature { system, feature: missing, device },
    }
}

/// Adds the name of the structure or of the scene to the error of a buffer that is larger than one binding;
/// other errors are returned unchanged.
fn too_large(error: ExperimentError, spec: &Spec) -> ExperimentError {
    match error {
        ExperimentError::Ads(AdsError::Gpu(error @ GpuError::TooLarge { .. }))
        | ExperimentError::Gpu(error @ GpuError::TooLarge { .. }) => match &error {
            GpuError::TooLarge { name, .. } if is_pool(name, spec) => {
                ExperimentError::PoolExceedsBinding { system: spec.system(), source: error }
            }
            _ => GpuSceneError::Gpu(error).into(),
        },
        other => other,
    }
}

/// True for a structure's own buffers, whose names begin with the structure's name: only these are reached by
/// addresses.
fn is_pool(name: &str, spec: &Spec) -> bool {
    name.strip_prefix(spec.structure()).is_some_and(|rest| rest.starts_with(' '))
}

/// Options and choices of the device, by name.
pub type ResolvedOptions = (BTreeMap<String, Value>, BTreeMap<String, String>);

/// Structure after its build, with the costs of the build.
pub struct Built {
    /// Structure of frames, whose last build was complete.
    pub(super) frames: FrameStructure,
    pub(super) outcome: BuildOutcome,
    pub(super) passes: Passes,
    viewpoint: Viewpoint,
    /// Flags of the moving parts that moved in this frame; empty if all moved.
    moved: Vec<bool>,
    /// Time of the first complete build, milliseconds; absent if the structure existed before.
    first_ms: Option<f64>,
    /// Times of the repeated builds, or of the build of a frame, measured by the host, milliseconds.
    whole: Vec<f64>,
    /// Times of the host's own part of each build, milliseconds.
    prepare: Vec<f64>,
    /// True if these times are of builds that were repeated to be timed.
    is_repeated: bool,
}

impl Built {
    /// Makes the structure of a spec and builds it as seen from `eye`, where the scene's camera is, until the
    /// build is complete. If a pool exceeds the limit of one binding and the spec leaves the addressing open,
    /// the pools are reached by device address instead.
    ///
    /// # Errors
    /// The device lacks a feature or fails, or the build does not become complete.
    pub fn new(
        device: &Device,
        spec: &Spec,
        scene: &GpuScene,
        eye: [f32; 3],
    ) -> Result<Self, ExperimentError> {
        Self::over(device, spec, (scene, None), eye)
    }

    /// Makes and builds the structure of a scene that may move, in the parts that `refresh` asks for.
    /// [`DeviceScene::parts`] must be called before the scene is posed.
    ///
    /// # Errors
    /// As for [`Built::new`]; also if nothing of the scene moves on the device, or the structure cannot be
    /// built in parts.
    pub fn refreshed(
        device: &Device,
        spec: &Spec,
        stage: &mut DeviceScene,
        (shown, refresh): (&Scene, Refresh),
    ) -> Result<Self, ExperimentError> {
        let parts = stage.parts(device, shown, refresh)?;
        Self::over(device, spec, (&stage.scene, parts.as_ref()), stage.scene.eye())
    }

    fn over(
        device: &Device,
        spec: &Spec,
        (scene, parts): (&GpuScene, Option<&GeometryParts>),
        eye: [f32; 3],
    ) -> Result<Self, ExperimentError> {
        let started = Instant::now();
        let timing = device.best_timing();
        let viewpoint = scene.viewpoint().at(eye);
        let (frames, outcome) = match first_build(device, spec, (scene, parts), viewpoint, timing) {
            Err(ExperimentError::PoolExceedsBinding { .. }) if may_use_addresses(device, spec) => {
                tracing::info!(
                    system = spec.system().name,
                    "a pool exceeds one binding: reached by device address"
                );
                let spec = spec.with_option("addressing", "address")?;
                first_build(device, &spec, (scene, parts), viewpoint, timing)?
            }
            other => other?,
        };
        let mut passes = Passes::default();
        if outcome.prepare_milliseconds > 0.0 {
            passes.add_one(Stage::Build, Pass::HOST, outcome.prepare_milliseconds);
        }
        passes.add(&outcome.passes);
        Ok(Self {
            frames,
            outcome,
            passes,
            viewpoint,
            moved: Vec::new(),
            first_ms: Some(started.elapsed().as_secs_f64() * 1.0e3),
            whole: Vec::new(),
            prepare: Vec::new(),
            is_repeated: false,
        })
    }

    /// Returns the structure that rays are traced through.
    pub fn structure(&self) -> &dyn Structure {
        self.frames.structure()
    }

    /// Chooses how much of their work rays count.
    ///
    /// # Errors
    /// The device refuses a pipeline.
    pub fn set_counters(
        &mut self,
        device: &Device,
        counters: rasray_ads::Counters,
    ) -> Result<(), ExperimentError> {
        Ok(self.frames.set_counters(device, counters)?)
    }

    /// Builds the stale parts for the current scene: the moving parts that have `moved` (all if that is
    /// empty), and everything that depends on the eye. From then on times and passes are those of this frame.
    ///
    /// # Errors
    /// As for [`Built::build_again`].
    pub fn follow(
        &mut self,
        device: &Device,
        scene: &GpuScene,
        moved: &[bool],
    ) -> Result<(), ExperimentError> {
        let started = Instant::now();
        self.viewpoint = scene.viewpoint().at(scene.eye());
        self.frames.parts_moved(moved);
        self.moved = moved.to_vec();
        self.outcome = self.refresh(device)?;
        self.passes = Passes::default();
        self.first_ms = None;
        (self.whole, self.prepare) = (Vec::new(), Vec::new());
        self.keep_times(started.elapsed().as_secs_f64() * 1.0e3);
        self.is_repeated = false;
        Ok(())
    }

    fn refresh(&mut self, device: &Device) -> Result<BuildOutcome, ExperimentError> {
        Ok(refresh_until_complete(device, &mut self.frames, self.viewpoint, device.best_timing())?)
    }

    /// Returns the times of the passes of builds, with the host's work. If builds were repeated to be timed,
    /// or a frame took a build, the shares of these passes add up to `build_ms`.
    pub fn pass_times(&self) -> Vec<Pass> {
        self.passes.report((!self.whole.is_empty()).then_some(PassOf::Build))
    }

    /// Returns the time of the build stage, if builds were repeated to be timed or a frame took a build.
    pub(super) fn stages(&self) -> Vec<StageTime> {
        if self.whole.is_empty() { Vec::new() } else { self.passes.stages() }
    }

    /// Builds the moved parts once more (the whole structure unless it has parts), and keeps the times.
    ///
    /// # Errors
    /// The device fails, or the build does not become complete.
    pub fn build_again(&mut self, device: &Device) -> Result<(), ExperimentError> {
        let regrows = self.outcome.regrows;
        self.frames.parts_moved(&self.moved);
        self.outcome = self.refresh(device)?;
        self.outcome.regrows += regrows;
        if !std::mem::replace(&mut self.is_repeated, true) {
            // Times of the first build include the driver's compilation, and those of a frame's build the
            // growth of pools.
            self.passes = Passes::default();
            self.whole.clear();
            self.prepare.clear();
        }
        self.keep_times(self.outcome.host_milliseconds);
        Ok(())
    }

    /// Keeps the times of the last build, which took `whole` milliseconds, with the host's work as passes, so
    /// that the passes add up to the whole.
    fn keep_times(&mut self, whole: f64) {
        let BuildOutcome { passes, prepare_milliseconds, .. } = &self.outcome;
        self.passes.repeat();
        self.passes.add_one(Stage::Build, Pass::HOST, *prepare_milliseconds);
        self.passes.add(passes);
        let seen = prepare_milliseconds + passes.iter().map(|pass| pass.milliseconds).sum::<f64>();
        self.passes.add_one(Stage::Build, Pass::WAITING, whole - seen);
        self.whole.push(whole);
        self.prepare.push(*prepare_milliseconds);
    }

    /// Sets the times of the build in a run.
    pub fn write_times(&self, times: &mut Times) {
        times.first_build_ms = self.first_ms;
        if !self.whole.is_empty() {
            times.build_ms = Some(median(&self.whole));
            times.build_host_ms = Some(median(&self.prepare));
        }
    }

    /// Returns the spread of the times of repeated builds, by the names of a report.
    pub(super) fn spread(&self) -> impl Iterator<Item = (String, Spread)> {
        [("build_ms", &self.whole), ("build_host_ms", &self.prepare)]
            .into_iter()
            .filter_map(|(name, times)| Some((name.to_owned(), spread(times)?)))
    }

    /// Returns options and choices as the structure resolved them.
    ///
    /// # Errors
    /// The device fails.
    pub fn resolved(&self) -> Result<ResolvedOptions, ExperimentError> {
        let report = self.structure().report()?;
        let paths = report.paths.into_iter().map(|(name, value)| (name.to_owned(), value));
        Ok((rasray_report::options(report.options), paths.collect()))
    }

    /// Returns the bytes of the structure, by part, and the bytes that its formula gives.
    ///
    /// # Errors
    /// The device fails.
    pub fn memory(&self, device: &Device) -> Result<Memory, ExperimentError> {
        let report = self.structure().report()?;
        Ok(Memory {
            structure_bytes: Some(report.bytes() - report.slack() - report.diagnostic_bytes),
            formula_bytes: Some(report.formula_bytes - report.diagnostic_bytes),
            capacity_bytes: Some(report.bytes()),
            diagnostic_bytes: (report.diagnostic_bytes > 0).then_some(report.diagnostic_bytes),
            device_peak_bytes: Some(device.peak_bytes()),
            by_part: report.bytes_by_part.into_iter().map(|(name, bytes)| (name.to_owned(), bytes)).collect(),
            ..Memory::default()
        })
    }

    /// Counts the lists of the structure's cells, all cells together first. All pools are read back.
    ///
    /// # Errors
    /// The device fails, or lists are damaged.
    pub fn lists(&self, device: &Device) -> Result<Vec<ListRecord>, ExperimentError> {
        let pools = self.structure().inspect();
        let counts = pools.map_or(Ok(Vec::new()), |pools| pools.list_counts(device))?;
        let all = ListCounts::all(&counts).filter(|_| counts.len() > 1);
        Ok(all.into_iter().chain(counts).map(list_record).collect())
    }

    /// Returns the counts of the build.
    pub(super) fn counters(&self) -> Result<Counters, ExperimentError> {
        let report = self.structure().report()?;
        let pool = self.outcome.status.pools.first();
        Ok(Counters {
            fragments: report.stored,
            lost: report.lost,
            demand: pool.map(|pool| pool.demand),
            capacity: pool.map(|pool| pool.capacity),
            overflow: pool.map(|pool| pool.demand.saturating_sub(pool.capacity)),
            regrows: Some(self.outcome.regrows.into()),
            ..Counters::default()
        })
    }
}

fn list_record(count: ListCounts) -> ListRecord {
    ListRecord {
        cells_of: count.cells_of.to_owned(),
        cells: count.cells,
        occupied: count.occupied,
        layers: count.layers,
        layers_mean: (count.occupied > 0).then(|| count.layers as f64 / count.occupied as f64),
        layers_most: count.most,
        entries: count.entries,
        slots: count.slots,
        waste_bytes: (count.slots - count.entries) * count.slot_bytes,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Checks that addressing is named only in errors of buffers that addresses reach.
    #[test]
    fn pools_that_exceed_a_binding_are_told_from_other_buffers() {
        let spec = |system: &str| Spec::new(system, "robust", []).expect("registered");
        let of = |system: &str, buffer: &str| {
            let error = GpuError::TooLarge { name: buffer.to_owned(), size: 1 << 31, limit: 1 << 30 };
            let error = too_large(AdsError::Gpu(error).into(), &spec(system));
            assert!(error.to_string().contains(buffer) && !error.to_string().contains("address"), "{error}");
            error
        };
        for (name, pool) in [("mmrt", "abuffer lists"), ("bricks", "bricks entries")] {
            match of(name, pool) {
                ExperimentError::PoolExceedsBinding { system, .. } => assert_eq!(system.name, name),
                other => panic!("{other:?}"),
            }
        }
        // The scene's triangles are bound for any structure.
        for buffer in ["indices", "positions", "bricks"] {
            let error = of("bricks", buffer);
            assert!(matches!(error, ExperimentError::SceneExceedsBinding { .. }), "{error:?}");
        }
    }
}
