//! Replay of one ray of a comparison, step by step: the steps of every system, and below them the truth.

use std::fmt::Write as _;

use rasray_ads::{Counters, Ray, TraceMode};
use rasray_gpu::Device;
use rasray_reference::oracle::{Oracle, OracleReplay};
use rasray_reference::views::cells_along;
use rasray_systems::Spec;
use rasray_tracer::{BatchTracer, Replay};
use serde_json::Value;

use crate::built::Built;
use crate::device_scene::DeviceScene;
use crate::error::ExperimentError;
use crate::jobs::Comparison;
use crate::rays::oracle_ray;
use crate::system_config::SystemConfig;

/// Largest number of cells of a view that are listed: more do not help a reader.
const MOST_CELLS: usize = 4096;

/// Scene and oracle for the replay of a ray.
pub(super) struct ReplaySetting<'a> {
    pub(super) device: &'a Device,
    pub(super) stage: &'a DeviceScene,
    pub(super) oracle: &'a Oracle<'a>,
    /// The views' centre relative to the frame origin, metres.
    pub(super) center: [f32; 3],
}

impl ReplaySetting<'_> {
    /// Replays the ray at `index` through all systems and the oracle, in words. `set` names the source of the
    /// ray.
    pub(super) fn replay(
        &self,
        specs: &[Spec],
        set: &str,
        rays: &[Ray],
        index: u32,
    ) -> Result<String, ExperimentError> {
        let Some(ray) = rays.get(index as usize) else {
            return Err(ExperimentError::NoSuchRay { index, set: set.to_owned(), rays: rays.len() });
        };
        let truth = self.oracle.replay(&oracle_ray(ray));
        let mut text = format!("ray {index} of {set}\n");
        for spec in specs {
            let spec = spec.clone().with_counters(Counters::Steps);
            let built = Built::new(self.device, &spec, &self.stage.scene, self.center)?;
            let tracer = BatchTracer::new(self.device, 1)?;
            let replay = tracer.replay(built.structure(), ray, TraceMode::Closest)?;
            let _ = write!(text, "\n{} {}: {replay}", spec.system().name, spec.preset().name());
            text.push_str(&met(&replay, &truth));
            if let Some(resolution) = cube_resolution(&built)? {
                text.push_str(&exact_cells(&replay, &truth, self.center, resolution));
            }
        }
        let _ = write!(text, "\n{truth}");
        Ok(text)
    }
}

/// Replays the ray at `index` of every set through all systems and the oracle, instead of a comparison.
pub(super) fn replay_sets(
    setting: &ReplaySetting<'_>,
    systems: &[SystemConfig],
    sets: impl Iterator<Item = (String, Vec<Ray>)>,
    index: u32,
) -> Result<Comparison, ExperimentError> {
    let specs = systems.iter().map(SystemConfig::spec).collect::<Result<Vec<_>, _>>()?;
    let mut text = String::new();
    for (name, rays) in sets {
        text.push_str(&setting.replay(&specs, &name, &rays, index)?);
    }
    Ok(Comparison { replay: Some(text), ..Comparison::default() })
}

/// Returns the ray of a hard case to replay, with ids of the device.
pub(super) fn replay_case(
    device: &Device,
    stage: &DeviceScene,
    systems: &[SystemConfig],
    case: (&str, [f32; 3]),
    rays: Vec<Ray>,
    index: u32,
) -> Result<Comparison, ExperimentError> {
    let (name, center) = case;
    let (positions, indices) = stage.triangles(device)?;
    let oracle = Oracle::new(&positions, &indices, None)?;
    let setting = ReplaySetting { device, stage, oracle: &oracle, center };
    replay_sets(&setting, systems, std::iter::once((name.to_owned(), rays)), index)
}

/// Describes a system's tests of the triangle that is truly hit.
fn met(replay: &Replay, truth: &OracleReplay) -> String {
    let Some((primitive, _)) = truth.verdict.outcome.hit() else { return String::new() };
    let met = replay.steps_of(primitive);
    if met.is_empty() {
        return format!("triangle {primitive}, which is truly hit, was not tested\n");
    }
    let mut text = format!("triangle {primitive}, which is truly hit, was tested here:\n");
    for (place, step) in met {
        let place = place.map_or_else(String::new, |place| format!(" in {place}"));
        let _ = writeln!(text, "  {step}{place}");
    }
    text
}

/// Returns the number of cells along a side of a system's cube of views; `None` without a cube.
fn cube_resolution(built: &Built) -> Result<Option<u32>, ExperimentError> {
    let (options, _) = built.resolved()?;
    let views = options.get("views").and_then(Value::as_str);
    let is_cube = views.is_some_and(|views| views.starts_with("cube"));
    let resolution = options.get("resolution").filter(|_| is_cube).and_then(Value::as_u64);
    Ok(resolution.map(|cells| cells as u32))
}

/// Describes the cells that the ray exactly crosses up to its hit, and those of them that the system
/// searched.
fn exact_cells(replay: &Replay, truth: &OracleReplay, center: [f32; 3], resolution: u32) -> String {
    let ray = &replay.ray;
    let origin = std::array::from_fn(|axis| f64::from(ray.origin[axis]) - f64::from(center[axis]));
    let end = truth.verdict.outcome.hit().map_or(f64::from(ray.t_max), |(_, t)| t);
    let chords = cells_along(origin, ray.direction.map(f64::from), [f64::from(ray.t_min), end], resolution);
    let mut text = String::from("cells that the ray truly crosses up to its hit:\n");
    for chord in chords.iter().take(MOST_CELLS) {
        let [x, y] = chord.cell.map(u32::cast_signed);
        let searched = replay.steps.iter().any(|step| step.cell() == Some((chord.view, x, y)));
        let _ = writeln!(text, "  {chord}{}", if searched { "" } else { ", not searched" });
    }
    if chords.len() > MOST_CELLS {
        let _ = writeln!(text, "  … and {} more", chords.len() - MOST_CELLS);
    }
    text
}
