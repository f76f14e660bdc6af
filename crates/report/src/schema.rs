//! Schema of a report and its runs. A measurement that was not made is an absent field, never 0.

use crate::accuracy::{Accuracy, HardRecord, ImageError};
use crate::cell::CellRecord;
use crate::cost::{Counters, Memory, Pass, Spread, StageTime, Times};
use serde::{Deserialize, Serialize};
use serde_json::Value;
use std::collections::BTreeMap;

/// Name of the schema, which every report holds.
pub const SCHEMA: &str = "rasray-report/1";

/// Report of measurements.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Report {
    /// Name of the schema, [`SCHEMA`].
    pub schema: String,
    /// Version of the program.
    pub version: String,
    /// Commit that the program was built from.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub commit: Option<String>,
    /// Command line as it was typed, words joined by spaces.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub command: Option<String>,
    /// Device that the runs ran on.
    pub device: Device,
    /// Scene that the runs ran on.
    pub scene: SceneRecord,
    /// Camera from which the scene was seen; absent for hard cases, which have an eye of their own.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub camera: Option<CameraRecord>,
    /// Cell of a comparison that this line holds, where each run has a line of its own; absent otherwise.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub cell: Option<CellRecord>,
    /// Confidence of the intervals of all rates together; absent where no rate was estimated.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub statistics: Option<Statistics>,
    /// Runs, one per system, preset and ray set or image.
    pub runs: Vec<Run>,
}

impl Report {
    /// Returns the version of the program, and its commit where known.
    pub fn program(&self) -> String {
        match &self.commit {
            Some(commit) => format!("{} ({commit})", self.version),
            None => self.version.clone(),
        }
    }
}

/// Number of rates in a report, and the confidence in all of them.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Statistics {
    /// Number of rates with an interval in this report.
    pub rates: u64,
    /// Confidence of every `interval` by itself.
    pub confidence: f64,
    /// Confidence that every `family_interval` of the report holds.
    pub family_confidence: f64,
    /// Confidence of each `family_interval`: 1 - (1 - `family_confidence`) / `rates` (Bonferroni).
    pub confidence_of_each: f64,
}

/// Device that runs ran on.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Device {
    /// Name of the device, as the driver gives it.
    pub name: String,
    /// Name and version of the driver.
    pub driver: String,
    /// True if the device is a program on the processor, whose times are only for ratios on that device.
    pub software: bool,
    /// Processor that a software device runs on, where the system names it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub processor: Option<String>,
}

impl Device {
    /// Returns the name, for a software device with the processor that it runs on.
    pub fn full_name(&self) -> String {
        match &self.processor {
            Some(processor) => format!("{} on {processor}", self.name),
            None => self.name.clone(),
        }
    }
}

/// Scene of a report.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SceneRecord {
    /// Name of the scene: the stem of its file, or the built-in name with its parameters.
    pub name: String,
    /// Number of triangles over all instances.
    pub triangles: u64,
    /// SHA-256 of the scene file, in hexadecimal; absent for built-in scenes.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub sha256: Option<String>,
    /// Bytes of the scene's tables that were not allocated on the device, because no image of the integrator
    /// can show the data in them; absent for hard cases.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub not_uploaded_bytes: Option<u64>,
    /// Time at which the scene was shown; absent at rest.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub pose: Option<PoseRecord>,
    /// Light from outside: `scene` for the scene's own, `given` for an environment that was asked for,
    /// `default` for the light of a scene without lights; absent for hard cases.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub environment: Option<String>,
    /// Treatment of transparency: `off` where every surface was made opaque; absent otherwise.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub alpha: Option<String>,
    /// Images that were made smaller, because the device cannot hold the texels of all images; absent where
    /// there are none.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub smaller_images: Vec<SmallerImageRecord>,
}

/// Time of an animation.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PoseRecord {
    /// Time in seconds from the beginning of the clips.
    pub time_s: f64,
    /// Names of the clips that were played.
    pub clips: Vec<String>,
    /// Number of the animation's frame; absent where one time was asked for.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub frame: Option<u32>,
    /// All frames that the command makes, of which this is one; absent where one time was asked for.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub frames: Option<FramesRecord>,
    /// Name of the file that was shown, for a sequence of files; absent otherwise.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub file: Option<String>,
}

/// Frames of one animation, by which reports of its shares are recognised as parts of one sequence.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct FramesRecord {
    /// Number of the first frame.
    pub first: u32,
    /// Number of the last frame, not less than the first.
    pub last: u32,
    /// Share of the frames that the command makes, such as `2/8`; absent where it makes all.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub shard: Option<String>,
    /// Key of the sequence, equal for all shares, 64 hexadecimal digits: a hash of the first frame's key and
    /// of the frames per second.
    pub key: String,
}

/// Image that was made smaller.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SmallerImageRecord {
    /// Name or file of the image.
    pub name: String,
    /// Width and height in the scene, texels.
    pub from: [u32; 2],
    /// Width and height as used, texels.
    pub to: [u32; 2],
}

/// Camera from which a scene was seen.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct CameraRecord {
    /// Name of the camera in the scene; `default` or `command line` for a camera that is not the scene's.
    pub name: String,
    /// Index among the scene's cameras, from 0; absent for a camera that is not the scene's.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub index: Option<u64>,
    /// Kind of projection: `perspective` or `orthographic`.
    pub kind: String,
    /// Full vertical angle of view, degrees; only of a perspective.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub fov_y_degrees: Option<f64>,
    /// Height of the view in the world, from the lower to the upper edge, metres; only of a parallel
    /// projection.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub height_m: Option<f64>,
    /// Ratio of width to height that the camera frames, where the camera states one. An image that is
    /// narrower for its height shows more above and below than the camera's angle or height states.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub aspect_ratio: Option<f64>,
    /// Diameter of the lens's opening, metres; absent for a pinhole.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub aperture_m: Option<f64>,
    /// Distance along the view to the plane in focus, metres; only of a lens.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub focus_m: Option<f64>,
    /// Position of the eye in the world, metres.
    pub eye: [f64; 3],
    /// Unit direction in which the camera looks, world.
    pub forward: [f64; 3],
    /// Unit direction that points up in the picture, world.
    pub up: [f64; 3],
}

/// Adaptive sampling: samples shared by noise.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct AdaptiveRecord {
    /// Standard error that a pixel may have, as a share of its luminance.
    pub threshold: f64,
    /// Number of samples that every pixel got first; their noise decided how the rest was shared.
    pub least_samples: u32,
    /// Mean number of samples over the pixels.
    pub samples_mean: f64,
    /// Number of samples of the pixel that got the most.
    pub samples_most: u32,
}

/// Run of one system and preset on one ray set or image.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Run {
    /// Name of the system, such as `mmrt`.
    pub system: String,
    /// Name of the structure, such as `abuffer`.
    pub structure: String,
    /// Name of the preset: `robust` or `published`.
    pub preset: String,
    /// Options in which the run differs from other runs of the same system and preset, such as `leaf=2`;
    /// absent where there is only one.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub variant: Option<String>,
    /// Reason for which the program chose the system, where the user asked for none.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub chosen: Option<String>,
    /// Key of a picture, 64 hexadecimal digits: a hash of everything that decides the picture's values;
    /// absent for ray sets.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub key: Option<String>,
    /// Share of the samples that was made, such as `2/8`; absent where all samples were made.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub shard: Option<String>,
    /// Options as resolved from the preset and the command line.
    pub options: BTreeMap<String, Value>,
    /// Choices that depend on the device: builder, coverage, atomics.
    pub paths: BTreeMap<String, String>,
    /// Name of the set of rays; absent for images.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub ray_set: Option<String>,
    /// Name of the integrator, such as `path`; absent for ray sets.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub integrator: Option<String>,
    /// Width of the image, pixels.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub width: Option<u32>,
    /// Height of the image, pixels.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub height: Option<u32>,
    /// Number of samples per pixel that were made.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub spp: Option<u32>,
    /// Adaptive sampling, where some pixels got more samples than others; `spp` is then the most that a pixel
    /// could get.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub adaptive: Option<AdaptiveRecord>,
    /// Largest number of scatterings of a path; absent unless paths are traced.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub bounces: Option<u32>,
    /// Method by which the first hits of camera rays were found: `trace`, `raster` or `fragments`; absent for
    /// ray sets.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub primary: Option<String>,
    /// Occluder that answered shadow rays: `structure` or `shadow-maps`; absent for ray sets.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub occluder: Option<String>,
    /// Texels along a side of a shadow map; absent without shadow maps.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub shadow_resolution: Option<u32>,
    /// Points on each emitting triangle that have shadow maps; absent where rays to these points were traced.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub shadow_points: Option<u32>,
    /// Seed of all random numbers.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub seed: Option<u32>,
    /// Source of random numbers of an image, such as `sobol`; absent for ray sets.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub sampler: Option<String>,
    /// Rays that pass the backs of single-sided surfaces, such as `camera`; absent for ray sets.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub back_faces: Option<String>,
    /// Options of the integrator by name, including those at their default; empty for ray sets.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub integrator_options: BTreeMap<String, Value>,
    /// Times of the run and its ray rate.
    #[serde(flatten)]
    pub times: Times,
    /// Spread of repeated times, by the name of their median: `build_ms`, `build_host_ms`, `trace_ms`.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub spread: BTreeMap<String, Spread>,
    /// Times of every stage that was timed, in the order of a frame.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub stages: Vec<StageTime>,
    /// Times of every pass that was timed.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub passes: Vec<Pass>,
    /// Memory of the run, bytes.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub memory: Option<Memory>,
    /// Counts that do not depend on the machine.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub counters: Option<Counters>,
    /// Accuracy of hits against the oracle.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub accuracy: Option<Accuracy>,
    /// Errors of the image against the reference.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub image: Option<ImageError>,
    /// Verdict on the hard case that was traced.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub hard: Option<HardRecord>,
}

impl Run {
    /// Returns the system and preset, and the variant where there are several.
    pub fn contestant(&self) -> String {
        let parts = [Some(self.system.as_str()), Some(self.preset.as_str()), self.variant.as_deref()];
        parts.into_iter().flatten().filter(|part| !part.is_empty()).collect::<Vec<_>>().join(" ")
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cost::Timer;

    #[test]
    fn what_was_not_measured_is_absent() {
        let run =
            Run { times: Times { build_ms: Some(f64::NAN), ..Default::default() }, ..Default::default() };
        let value = serde_json::to_value(&run).expect("plain data");
        let keys: Vec<_> = value.as_object().expect("an object").keys().map(String::as_str).collect();
        assert_eq!(keys, ["options", "paths", "preset", "structure", "system"]);
    }

    #[test]
    fn numbers_read_back_to_the_last_bit() {
        for time in [3.639_595_686_561_530_7e-9, 0.1 + 0.2, f64::MIN_POSITIVE, f64::MAX, 5.0e-324] {
            let run =
                Run { times: Times { build_ms: Some(time), ..Default::default() }, ..Default::default() };
            let text = serde_json::to_string(&run).expect("plain data");
            assert_eq!(serde_json::from_str::<Run>(&text).expect("a run"), run);
        }
    }

    #[test]
    fn times_stand_next_to_the_other_fields_of_a_run() {
        let times =
            Times { timer: Some(Timer::Host), build_ms: Some(2.5), rays: Some(7), ..Default::default() };
        let value = serde_json::to_value(Run { times, ..Default::default() }).expect("plain data");
        assert_eq!(value["timer"], "host");
        assert_eq!(value["build_ms"], 2.5);
        assert_eq!(value["rays"], 7);
    }
}
