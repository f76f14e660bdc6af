//! Options of `rasray compare`.

use super::ray_files::RayFileArguments;
use super::shared::WorkArguments;
use super::structure::{preset_parser, ray_set_parser, system_parser};
use super::values;
use crate::error::AppError;
use clap::Args;
use rasray_experiment::{RaySet, Shard, SystemConfig, several_systems};
use rasray_systems::{Preset, System};
use std::ffi::OsString;
use std::path::PathBuf;

const AFTER_HELP: &str = "\
Examples:
  rasray compare cornell --systems mmrt,brute-force
  rasray compare spheres:10k --systems mmrt --presets published,robust --ray-set incoherent,bounce
  rasray compare scene.glb --systems mmrt,brute-force --buckets 8 mmrt.march=samples --report r.json
  rasray compare cornell --systems mmrt --image --size 256x256 --spp 64 --report r.json --html r.html
  rasray compare scene.glb --systems mmrt --ray-set bounce --save-rays out --save-hits out
  rasray compare scene.glb --systems mmrt --rays-file out/bounce.rays --hits-file other=other.npy
  rasray compare hard: (lists the hard cases)
  rasray compare hard:all --systems mmrt,brute-force --check
  rasray compare hard:all --systems mmrt --report 1.jsonl --shard 1/4 --resume    (then: rasray merge)
  rasray compare cornell --systems mmrt --presets published --ray-set incoherent --replay 17

Every system traces the same rays and is compared with an oracle in double precision. Rays that no f32
program can decide are counted apart. Systems take turns, so that what slows the machine slows all of
them. An option goes to the systems that have it; SYSTEM.OPTION=VALUE addresses one, and
SYSTEM-PRESET.OPTION=VALUE one preset of it; mmrt.buckets=1,4,8 takes part once with each value.
Times of software devices are for ratios on that device.

With --report NAME.jsonl each run is a line, which is whole or not there after a kill: --resume makes the others. Systems
take turns with those that are made by the same process; rasray merge makes one report of the shares.

SIGINT (Ctrl-C), SIGTERM or SIGHUP: the report holds the runs that were whole, of hard:all the cases, exit code 130;
where none is, the command ends within two seconds and writes nothing. A build or a trace that is under way
ends first. A second signal stops at once and writes nothing.";

const SHARES: &str = "Resuming and shares";

/// Options of `rasray compare`.
#[derive(Debug, Args)]
#[command(after_help = AFTER_HELP, mut_arg("integrator", |argument| argument.help("Integrator, of all systems [default: path]")),
          mut_arg("primary", |argument| argument.help("Method of first hits of images [default: trace]")),
          mut_arg("occluder", |argument| argument.help("Occluder of shadow rays to lights without extent, of images [default: structure]")))]
pub struct CompareArguments {
    /// A file (.gltf .glb .obj .ply), numbered files ('a.####.ply'), a built-in scene with parameters, or a
    /// hard case (hard:E5, hard:all)
    #[arg(value_name = "SCENE")]
    pub scene: OsString,
    /// Options for one system, such as mmrt.march=samples; of several values each takes part
    #[arg(value_name = "SYSTEM.OPTION=VALUE")]
    pub assignments: Vec<String>,
    /// Systems to compare
    #[arg(long, value_parser = system_parser(), value_delimiter = ',', required = true)]
    pub systems: Vec<&'static System>,
    /// Fidelity of the systems to their papers; each takes part with the presets that it has
    #[arg(long, value_parser = preset_parser(), value_delimiter = ',', default_value = Preset::Robust.name())]
    pub presets: Vec<Preset>,
    /// Sets of rays [default: incoherent,camera; none with --rays-file]
    #[arg(long, value_parser = ray_set_parser(), value_delimiter = ',')]
    pub ray_set: Vec<RaySet>,
    /// Rays per set, 1 to 100000000 [default: 200000; 2000 for hard cases]
    #[arg(long, value_name = "N", value_parser = values::whole(1, 100_000_000))]
    pub rays: Option<u32>,
    /// Times that each build and each set of rays is timed, after turns to warm up, 1 to 10000
    #[arg(long, value_name = "N", default_value_t = 5, value_parser = values::whole(1, 10_000))]
    pub repetitions: u32,
    /// With a hard case: meshes in the size of the catalogue
    #[arg(long)]
    pub full: bool,
    /// With a hard case: exit code 1 if a target is not met
    #[arg(long)]
    pub check: bool,
    /// Show step by step what every system and the oracle do for one ray of the set, instead of comparing
    #[arg(long, value_name = "INDEX", conflicts_with_all = ["image", "report", "html", "markdown", "hits_file", "save_rays", "save_hits"])]
    pub replay: Option<u32>,
    /// Also render an image with each system and compare it with the reference
    #[arg(long)]
    pub image: bool,
    /// Also count what the lists of each structure hold: layers per cell, slots that pages waste
    #[arg(long)]
    pub statistics: bool,
    /// JSON with everything that was measured; - is standard output; a .jsonl takes a line per run as soon as
    /// it is whole
    #[arg(long, value_name = "FILE")]
    pub report: Option<PathBuf>,
    /// Page with tables, pictures and graphs, whole in one file
    #[arg(long, value_name = "FILE")]
    pub html: Option<PathBuf>,
    /// Markdown table of all ray sets, a line a run
    #[arg(long, value_name = "FILE")]
    pub markdown: Option<PathBuf>,
    /// Go on with a --report .jsonl: runs that it holds are left alone. A line of another program, device or
    /// comparison is refused
    #[arg(long, requires = "report", conflicts_with_all = ["replay", "save_rays", "save_hits"], help_heading = SHARES)]
    pub resume: bool,
    /// One of N shares of the work, I from 1 to N, for rasray merge: each Nth set of rays or hard case, whose
    /// systems take turns; all images count as one
    #[arg(long, value_name = "I/N", value_parser = values::shard, requires = "report",
          conflicts_with_all = ["replay", "save_rays", "save_hits"], help_heading = SHARES)]
    pub shard: Option<Shard>,
    /// Rays for others and from others.
    #[command(flatten)]
    pub files: RayFileArguments,
    /// The image, the camera, the scene, the structure and the device.
    #[command(flatten)]
    pub work: WorkArguments,
    /// Long names of the options that were typed.
    #[arg(skip)]
    pub typed: Vec<String>,
}

impl CompareArguments {
    /// Returns the systems to compare: every named system with every named preset that it has, and with each
    /// of the values that assignments give to it.
    ///
    /// # Errors
    /// No system has a preset or an option, or values are not accepted or do not go together.
    pub fn systems(&self) -> Result<Vec<SystemConfig>, AppError> {
        Ok(several_systems(&self.systems, &self.presets, &self.work.structure.0, &self.assignments)?)
    }
}
