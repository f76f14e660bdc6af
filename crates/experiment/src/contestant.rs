//! Contestants, the systems of a comparison: each has a structure, built in turns with the others.

use rasray_gpu::Device;
use rasray_systems::Spec;

use crate::backend::{OnProgress, Progress};
use crate::built::Built;
use crate::device_scene::DeviceScene;
use crate::error::ExperimentError;
use crate::system_config::SystemConfig;
use rasray_report::{ListRecord, Run, Times};

/// System of a comparison with its built structure.
pub struct Contestant<'a> {
    /// Configuration of the system.
    pub config: &'a SystemConfig,
    /// Spec of the structure.
    pub spec: Spec,
    /// Structure of the system after its build.
    pub built: Built,
    /// Counts of the lists of the structure's cells; empty if they were not counted.
    pub lists: Vec<ListRecord>,
}

impl<'a> Contestant<'a> {
    /// Makes the structures as [`Contestant::all`], only for systems whose position `takes_part` accepts;
    /// each is returned with its position.
    pub(super) fn some(
        device: &Device,
        stage: &DeviceScene,
        systems: &'a [SystemConfig],
        takes_part: impl Fn(usize) -> bool,
        (center, repetitions): ([f32; 3], u32),
        progress: &mut OnProgress<'_>,
    ) -> Result<Option<Vec<(usize, Self)>>, ExperimentError> {
        let positions: Vec<_> = (0..systems.len()).filter(|position| takes_part(*position)).collect();
        let systems = positions.iter().map(|position| &systems[*position]);
        let made = Self::all(device, stage, systems, center, repetitions, progress)?;
        Ok(made.map(|made| positions.into_iter().zip(made).collect()))
    }

    /// Makes the structures of all systems around `center` (metres, relative to the frame origin) and builds
    /// each `repetitions` times for its medians: one build of each in turn, so that a temporary slowdown of
    /// the machine affects all of them. Returns `None` if `progress` asks for an early end before all are
    /// built.
    ///
    /// # Errors
    /// The options do not go together, the device lacks a feature or fails, or a build does not become
    /// complete.
    pub fn all(
        device: &Device,
        stage: &DeviceScene,
        systems: impl IntoIterator<Item = &'a SystemConfig>,
        center: [f32; 3],
        repetitions: u32,
        progress: &mut OnProgress<'_>,
    ) -> Result<Option<Vec<Self>>, ExperimentError> {
        let mut contestants = Vec::new();
        let mut stops = |unit: &str| progress(Progress { task: "build", done: 0, total: 0, unit }).is_break();
        for config in systems {
            if stops(config.system.name) {
                return Ok(None);
            }
            let spec = config.spec()?;
            let built = Built::new(device, &spec, &stage.scene, center)?;
            contestants.push(Self { config, spec, built, lists: Vec::new() });
        }
        for _ in 0..repetitions {
            for contestant in &mut contestants {
                if stops("timed builds") {
                    return Ok(None);
                }
                contestant.built.build_again(device)?;
            }
        }
        Ok(Some(contestants))
    }

    /// Makes a run with the names, options, build times and bytes of the system.
    ///
    /// # Errors
    /// The device fails.
    pub fn run(&self, device: &Device) -> Result<Run, ExperimentError> {
        let (options, paths) = self.built.resolved()?;
        let mut times = Times::default();
        self.built.write_times(&mut times);
        Ok(Run {
            system: self.config.system.name.to_owned(),
            structure: self.spec.structure().to_owned(),
            preset: self.config.preset.name().to_owned(),
            variant: self.config.variant.clone(),
            options,
            paths,
            times,
            spread: self.built.spread().collect(),
            stages: self.built.stages(),
            passes: self.built.pass_times(),
            memory: Some(self.built.memory(device)?),
            ..Run::default()
        })
    }
}
