//! A report and its runs. A measurement that was not made is an absent field, never 0.

use crate::accuracy::{Accuracy, HardRecord, ImageError};
use crate::cell::CellRecord;
use crate::cost::{Counters, Memory, Pass, Spread, StageTime, Times};
use serde::{Deserialize, Serialize};
use serde_json::Value;
use std::collections::BTreeMap;

/// Name of the schema, in every report.
pub const SCHEMA: &str = "rasray-report/1";

/// A whole report.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Report {
    /// [`SCHEMA`].
    pub schema: String,
    /// Version of the program.
    pub version: String,
    /// Commit that the program was built from.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub commit: Option<String>,
    /// The command line as it was typed, words joined by spaces.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub command: Option<String>,
    /// Device that it ran on.
    pub device: Device,
    /// The scene that it ran on.
    pub scene: SceneRecord,
    /// From where it was seen; absent for hard cases, which have an eye of their own.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub camera: Option<CameraRecord>,
    /// The run of a comparison that this line is of, where each run has a line of its own; absent otherwise.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub cell: Option<CellRecord>,
    /// Confidence of the intervals of all rates together; absent where no rate was estimated.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub statistics: Option<Statistics>,
    /// One entry per system, preset and ray set or image.
    pub runs: Vec<Run>,
}

impl Report {
    /// The version of the program, and the commit where it is known.
    pub fn program(&self) -> String {
        match &self.commit {
            Some(commit) => format!("{} ({commit})", self.version),
            None => self.version.clone(),
        }
    }
}

/// Number of rates of a report, and the confidence in all of them.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Statistics {
    /// Rates with an interval in this report.
    pub rates: u64,
    /// Confidence of every `interval` by itself.
    pub confidence: f64,
    /// Confidence that every `family_interval` of the report holds.
    pub family_confidence: f64,
    /// Confidence of each `family_interval`: 1 - (1 - `family_confidence`) / `rates` (Bonferroni).
    pub confidence_of_each: f64,
}

/// A device.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Device {
    /// Name that the driver gives.
    pub name: String,
    /// Driver and its version.
    pub driver: String,
    /// True if it is a program on the processor: its times are for ratios on that device.
    pub software: bool,
}

/// A scene.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SceneRecord {
    /// File stem, or built-in name with its parameters.
    pub name: String,
    /// Triangles over all instances.
    pub triangles: u64,
    /// SHA-256 of the scene file, in hexadecimal; absent for built-in scenes.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub sha256: Option<String>,
    /// Bytes of its tables that were not allocated on the device, because no image of the integrator can show
    /// what they hold; absent for hard cases.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub not_uploaded_bytes: Option<u64>,
    /// When it was shown; absent at rest.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub pose: Option<PoseRecord>,
    /// The light from outside: `scene` for the scene's own, `given` for one that was asked for, `default` for
    /// the light of a scene that nothing lights; absent for hard cases.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub environment: Option<String>,
    /// `off` where every surface was made opaque; absent otherwise.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub alpha: Option<String>,
    /// Images that were made smaller, because the device does not hold the texels of all; absent where there
    /// are none.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub smaller_images: Vec<SmallerImageRecord>,
}

/// A time of an animation.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PoseRecord {
    /// Seconds from the beginning of the clips.
    pub time_s: f64,
    /// Names of the clips that were played.
    pub clips: Vec<String>,
    /// Number of the frame of an animation; absent where one time was asked for.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub frame: Option<u32>,
    /// The frames that the command makes, of which this is one; absent where one time was asked for.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub frames: Option<FramesRecord>,
    /// For a sequence of files, the name of the one that was shown; absent otherwise.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub file: Option<String>,
}

/// Frames of one animation, by which reports of its shares are known to go together.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct FramesRecord {
    /// Number of the first frame.
    pub first: u32,
    /// Number of the last frame, not below the first.
    pub last: u32,
    /// Share of them that the command makes, such as `2/8`; absent where it makes all.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub shard: Option<String>,
    /// Key of the sequence, equal for all shares, 64 hexadecimal digits: a hash of the first frame's key and
    /// of frames per second.
    pub key: String,
}

/// An image that was made smaller.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SmallerImageRecord {
    /// Name or file.
    pub name: String,
    /// Texels per row and rows in the scene.
    pub from: [u32; 2],
    /// Texels per row and rows as it was used.
    pub to: [u32; 2],
}

/// From where a scene was seen.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct CameraRecord {
    /// As the scene has it; `default` or `command line` for a camera that is not the scene's.
    pub name: String,
    /// Position among the scene's cameras, from 0; absent for a camera that is not the scene's.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub index: Option<u64>,
    /// `perspective` or `orthographic`.
    pub kind: String,
    /// Full vertical angle of view, degrees; of a perspective.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub fov_y_degrees: Option<f64>,
    /// Metres of the world from the lower to the upper edge; of a parallel projection.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub height_m: Option<f64>,
    /// Width over height of what the camera frames, where it says so; an image that is narrower for its
    /// height shows more above and below than its angle or height says.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub aspect_ratio: Option<f64>,
    /// Metres, the diameter of the lens's opening; absent: a pinhole.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub aperture_m: Option<f64>,
    /// Metres along the view to the plane in focus; of a lens.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub focus_m: Option<f64>,
    /// Metres, world.
    pub eye: [f64; 3],
    /// Unit direction in which it looks, world.
    pub forward: [f64; 3],
    /// Unit direction that is up in the picture, world.
    pub up: [f64; 3],
}

/// Samples by noise.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct AdaptiveRecord {
    /// Standard error that a pixel may have, as a share of its luminance.
    pub threshold: f64,
    /// Samples that every pixel got, by which the rest was shared.
    pub least_samples: u32,
    /// Mean over the pixels.
    pub samples_mean: f64,
    /// Samples of the pixel that got most.
    pub samples_most: u32,
}

/// One system, preset and ray set or image.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Run {
    /// Such as `mmrt`.
    pub system: String,
    /// Such as `abuffer`.
    pub structure: String,
    /// `robust` or `published`.
    pub preset: String,
    /// The options in which it differs from other runs of the same system and preset, such as `leaf=2`;
    /// absent where there is one.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub variant: Option<String>,
    /// Why the system was taken, where none was asked for.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub chosen: Option<String>,
    /// Key of a picture, 64 hexadecimal digits: a hash of everything that decides its values; absent for ray
    /// sets.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub key: Option<String>,
    /// Share of the samples that was made, such as `2/8`; absent where all were.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub shard: Option<String>,
    /// Options as resolved from preset and command line.
    pub options: BTreeMap<String, Value>,
    /// Choices of the device: builder, coverage, atomics.
    pub paths: BTreeMap<String, String>,
    /// Set of rays; absent for images.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub ray_set: Option<String>,
    /// Its name, such as `path`; absent for ray sets.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub integrator: Option<String>,
    /// Pixels a row.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub width: Option<u32>,
    /// Rows.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub height: Option<u32>,
    /// Samples per pixel that were made.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub spp: Option<u32>,
    /// Sharing of samples among the pixels, where some got more than others; then `spp` is the most that one
    /// could get.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub adaptive: Option<AdaptiveRecord>,
    /// Scatterings at most; absent unless paths are traced.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub bounces: Option<u32>,
    /// `trace`, `raster` or `fragments`: how what camera rays hit was found; absent for ray sets.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub primary: Option<String>,
    /// `structure` or `shadow-maps`: what answered shadow rays; absent for ray sets.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub occluder: Option<String>,
    /// Texels along a side of a shadow map; absent without any.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub shadow_resolution: Option<u32>,
    /// Points on each emitting triangle that have shadow maps; absent where rays to these were traced.
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
    /// Options of the integrator by name, also those at their default; empty for ray sets.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub integrator_options: BTreeMap<String, Value>,
    /// Times and rate.
    #[serde(flatten)]
    pub times: Times,
    /// Spread of repeated times, by the name of their median: `build_ms`, `build_host_ms`, `trace_ms`.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub spread: BTreeMap<String, Spread>,
    /// Every stage that was timed, in the order of a frame.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub stages: Vec<StageTime>,
    /// Every pass that was timed.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub passes: Vec<Pass>,
    /// Bytes.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub memory: Option<Memory>,
    /// Counts that do not depend on the machine.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub counters: Option<Counters>,
    /// Hits against the oracle.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub accuracy: Option<Accuracy>,
    /// Image against the reference.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub image: Option<ImageError>,
    /// The hard case that was traced.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub hard: Option<HardRecord>,
}

impl Run {
    /// System and preset, and the variant where there are several.
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
