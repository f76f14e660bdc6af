//! A back end with known answers, and the command run on it in a process of its own.
//!
//! The process is this test program again: the test named `as_command` becomes the command when the
//! environment says so, and passes otherwise.

use rasray_experiment::{
    Aov, AovImage, Backend, ChosenPath, CompareJob, Comparison, DeviceChoice, DeviceDescription,
    ExperimentError, Feature, FilmSums, FinishedRun, GpuError, HardJob, KeptScene, OnProgress, OnRun,
    PassCommands, Progress, RenderJob, RenderOutput, Stage, TexelCapacity,
};
use rasray_report::{Counters, Device, HardRecord, ImageError, ListRecord, Run, Times};
use std::path::Path;
use std::process::{Command, Output};
use std::time::Duration;

/// Set for the process that becomes the command: its arguments, one a line.
const ARGUMENTS: &str = "RASRAY_TEST_ARGUMENTS";

/// Set for that process where it shall say that it works: a file that it makes.
pub const READY: &str = "RASRAY_TEST_READY";

/// Answers at once, except where the device's name says otherwise: `slow` takes 20 ms a sample and half a
/// minute for a case after G1, unless it is stopped, `stuck` takes a minute before the first, `broken` fails
/// (of hard cases, G3), `unfinished` leaves a ray unanswered, `small` holds 2000 texels, `absent` cannot be
/// opened.
pub struct Scripted {
    device: String,
}

/// Channel number k holds k + 1, indices are 7.
fn aov_image(aov: Aov, pixels: usize) -> AovImage {
    match aov.is_whole() {
        true => AovImage::Whole(vec![7; pixels]),
        false => {
            let channels = (0..aov.channels().len()).map(|channel| vec![channel as f32 + 1.0; pixels]);
            AovImage::Floats(channels.collect())
        }
    }
}

/// Error of the device named `broken`.
fn lost() -> ExperimentError {
    GpuError::DeviceLost { call: "vkQueueSubmit", during: "trace".to_owned() }.into()
}

impl Backend for Scripted {
    fn device(&self) -> Device {
        Device { name: "scripted".to_owned(), driver: "none 1".to_owned(), software: true, processor: None }
    }

    fn texel_capacity(&self) -> TexelCapacity {
        let texels = if self.device == "small" { 2000 } else { u32::MAX.into() };
        TexelCapacity { texels, device: self.device().name }
    }

    fn render(
        &mut self,
        job: &RenderJob<'_>,
        _kept: &mut KeptScene,
        progress: &mut OnProgress<'_>,
    ) -> Result<RenderOutput, ExperimentError> {
        if self.device == "broken" {
            return Err(lost());
        }
        let (width, height) = (job.frame.width, job.frame.height);
        let pixels = width as usize * height as usize;
        say_ready();
        if self.device == "stuck" {
            std::thread::sleep(Duration::from_secs(60));
        }
        let wanted = job.shard.unwrap_or_default().samples(job.frame.spp).count();
        let mut samples_done = 0;
        while samples_done < wanted {
            let (done, total) = (samples_done.into(), wanted.into());
            if progress(Progress { task: "trace", done, total, unit: "samples" }).is_break() {
                break;
            }
            if self.device == "slow" {
                std::thread::sleep(Duration::from_millis(20));
            }
            samples_done += 1;
        }
        let beauty = vec![[0.5, 0.25, 1.0]; pixels];
        let sum = |mean: &[f32; 3]| mean.map(|channel| channel * samples_done as f32);
        Ok(RenderOutput {
            width,
            height,
            sums: job.shard.map(|_| FilmSums {
                sums: beauty.iter().map(sum).collect(),
                counts: vec![samples_done; pixels],
            }),
            beauty,
            aovs: job.aovs.iter().map(|aov| (aov, aov_image(aov, pixels))).collect(),
            samples_done,
            times: Times { trace_ms: Some(2.0), rays: Some(1000), ..Default::default() },
            counters: Some(Counters {
                unfinished: Some((self.device == "unfinished").into()),
                ..Default::default()
            }),
            ..Default::default()
        })
    }

    fn passes(&mut self, job: &RenderJob<'_>) -> Result<Vec<PassCommands>, ExperimentError> {
        let label = format!("{}/build_0_header", job.system.system.name);
        let pass = PassCommands::of(Stage::Build, &label);
        Ok(vec![PassCommands { dispatches: 2, workgroups: 7, transfers: 1, ..pass }])
    }

    fn lists(&mut self, job: &RenderJob<'_>) -> Result<Vec<ListRecord>, ExperimentError> {
        let list = ListRecord { cells_of: job.system.system.name.to_owned(), cells: 9, ..Default::default() };
        Ok(vec![list])
    }

    fn compare(
        &mut self,
        job: &CompareJob<'_>,
        finished: &mut OnRun<'_>,
        progress: &mut OnProgress<'_>,
    ) -> Result<Comparison, ExperimentError> {
        say_ready();
        let mut comparison = Comparison::default();
        let cells = job.ray_sets.iter().flat_map(|set| job.systems.iter().map(move |system| (set, system)));
        for (place, (set, system)) in cells.enumerate() {
            if job.only.as_ref().is_some_and(|only| !only.contains(&place)) {
                continue;
            }
            if progress(Progress { task: "compare", done: 0, total: 0, unit: "rays" }).is_break() {
                break;
            }
            if self.device == "slow" {
                std::thread::sleep(Duration::from_millis(300));
            }
            let run = Run {
                system: system.system.name.to_owned(),
                preset: system.preset.name().to_owned(),
                variant: system.variant.clone(),
                ray_set: Some(set.name().to_owned()),
                options: rasray_report::options(
                    system.options.iter().map(|(name, value)| (name, value.to_string())),
                ),
                counters: (self.device == "unfinished")
                    .then(|| Counters { unfinished: Some(1), ..Counters::default() }),
                ..Default::default()
            };
            let end = finished(FinishedRun { place, run: &run, pixels: None });
            comparison.places.push(place);
            comparison.runs.push(run);
            if end.is_break() {
                break;
            }
        }
        // Behind the sets the images, and that of the reference with another seed.
        let first = job.ray_sets.len() * job.systems.len();
        let images = job.systems.iter().map(|system| (system.system.name, system.preset.name()));
        let images = images.chain([("reference", "another-seed")]).filter(|_| job.image);
        for (place, (system, preset)) in (first..).zip(images) {
            if job.only.as_ref().is_some_and(|only| !only.contains(&place)) {
                continue;
            }
            let run = Run {
                system: system.to_owned(),
                preset: preset.to_owned(),
                image: Some(ImageError { flip_visible: Some(0.25), ..ImageError::default() }),
                ..Default::default()
            };
            let pixels = vec![[0.5; 3]; (job.frame.width * job.frame.height) as usize];
            let end = finished(FinishedRun { place, run: &run, pixels: Some(&pixels) });
            comparison.places.push(place);
            comparison.runs.push(run);
            if end.is_break() {
                break;
            }
        }
        Ok(comparison)
    }

    fn hard(
        &mut self,
        job: &HardJob<'_>,
        progress: &mut OnProgress<'_>,
    ) -> Result<Comparison, ExperimentError> {
        if self.device == "broken" && job.case.id == "G3" {
            return Err(lost());
        }
        if self.device == "slow" && job.case.id != "G1" {
            say_ready();
            for _ in 0..1500 {
                if progress(Progress { task: "build", done: 0, total: 0, unit: "mmrt" }).is_break() {
                    return Ok(Comparison::default());
                }
                std::thread::sleep(Duration::from_millis(20));
            }
        }
        // The first system meets its target, the others do not.
        let run = |(place, system): (usize, &rasray_experiment::SystemConfig)| Run {
            system: system.system.name.to_owned(),
            preset: system.preset.name().to_owned(),
            ray_set: Some(job.case.id.to_owned()),
            seed: Some(job.seed),
            hard: Some(HardRecord {
                id: job.case.id.to_owned(),
                met: Some(place == 0),
                reason: format!("{} rays", job.case.rays.len()),
                ..HardRecord::default()
            }),
            ..Run::default()
        };
        let wants = |place: &usize| job.only.as_ref().is_none_or(|only| only.contains(place));
        let places: Vec<_> = (0..job.systems.len()).filter(wants).collect();
        let runs = places.iter().map(|place| run((*place, &job.systems[*place]))).collect();
        _ = progress(Progress { task: "hard", done: 1, total: 1, unit: "runs" });
        Ok(Comparison { runs, places, ..Comparison::default() })
    }

    fn info(&mut self) -> Result<DeviceDescription, ExperimentError> {
        let feature = |name: &str, present, required| Feature {
            name: name.to_owned(),
            present,
            required,
            purpose: "a test".to_owned(),
        };
        Ok(DeviceDescription {
            devices: vec!["scripted".to_owned(), "another".to_owned()],
            api_version: "1.2.3".to_owned(),
            features: vec![feature("scalarBlockLayout", true, true), feature("shaderInt64", false, false)],
            limits: vec![("storage buffer".to_owned(), "128 MiB".to_owned())],
            paths: vec![ChosenPath {
                system: "mmrt".to_owned(),
                choice: "addressing".to_owned(),
                chosen: "descriptor".to_owned(),
                reason: "a software driver".to_owned(),
            }],
        })
    }
}

fn say_ready() {
    if let Ok(path) = std::env::var(READY) {
        std::fs::write(path, b"").expect("a file that says ready");
    }
}

/// Becomes the command if the environment says so; otherwise returns.
pub fn become_the_command() {
    let Ok(arguments) = std::env::var(ARGUMENTS) else { return };
    let mut open = |choice: &DeviceChoice| -> Result<Box<dyn Backend>, ExperimentError> {
        let device = choice.device.clone().unwrap_or_default();
        if device == "absent" {
            return Err(ExperimentError::Opening(GpuError::NoMatchingDevice {
                preference: "absent".to_owned(),
                devices: "none".to_owned(),
            }));
        }
        Ok(Box::new(Scripted { device }))
    };
    let code = rasray_app::run(arguments.lines().map(Into::into), &mut open);
    std::process::exit(code.into());
}

/// The command in a process of its own, not started yet.
pub fn command(folder: &Path, line: &str) -> Command {
    let arguments: Vec<_> = std::iter::once("rasray").chain(line.split_whitespace()).collect();
    let mut command = Command::new(std::env::current_exe().expect("this program"));
    command.args(["as_command", "--exact", "--nocapture", "--test-threads=1"]);
    command.env(ARGUMENTS, arguments.join("\n")).current_dir(folder);
    command
}

/// Output of the command on the known answers.
pub fn scripted(folder: &Path, line: &str) -> Output {
    command(folder, line).output().expect("the command starts")
}

/// Messages of that command, which succeeds.
pub fn done(folder: &Path, line: &str) -> String {
    let output = scripted(folder, line);
    assert_eq!(output.status.code(), Some(0), "{line}: {}", stderr(&output));
    stderr(&output)
}

/// The text of a file.
pub fn read(folder: &Path, name: &str) -> String {
    std::fs::read_to_string(folder.join(name)).expect(name)
}

/// The built command, on a device.
pub fn rasray(folder: &Path, line: &str) -> Output {
    Command::new(env!("CARGO_BIN_EXE_rasray"))
        .args(line.split_whitespace())
        .current_dir(folder)
        .output()
        .expect("the command starts")
}

/// Text of the test harness before the command begins.
pub const HARNESS: &[u8] = b"\nrunning 1 test\ntest as_command ... ";

/// Bytes that the command wrote to stdout, without those of the test harness around them.
pub fn stdout(output: &Output) -> Vec<u8> {
    output.stdout.strip_prefix(HARNESS).expect("the harness's lines").to_vec()
}

/// Messages of the command on stderr.
pub fn stderr(output: &Output) -> String {
    String::from_utf8_lossy(&output.stderr).into_owned()
}

/// Names in a folder, sorted.
pub fn entries(folder: &Path) -> Vec<String> {
    let mut names: Vec<_> = std::fs::read_dir(folder)
        .expect("the folder")
        .map(|entry| entry.expect("an entry").file_name().to_string_lossy().into_owned())
        .collect();
    names.sort();
    names
}
