//! Options of `rasray merge`.

use super::tone::ToneArguments;
use clap::Args;
use std::path::PathBuf;

const AFTER_HELP: &str = "\
Examples:
  rasray render scene.glb --spp 256 --shard 1/2 --output part.1.exr
  rasray render scene.glb --spp 256 --shard 2/2 --output part.2.exr
  rasray merge scene.exr part.1.exr part.2.exr
  rasray merge scene.png part.*.exr --exposure 1
  rasray merge scene.png part.*.exr --denoise    (of parts that --aov albedo,normal was given for)
  rasray merge walk.jsonl walk.1.jsonl walk.2.jsonl
  rasray merge hard.json hard.1.jsonl hard.2.jsonl    (shares of rasray compare)

Shares of the samples (--shard of render) add up to the picture that render makes without it, up to the
rounding of its sums, and to the same bytes in whatever order they are named; render --resume takes it for its
own. All parts are to be of the same picture and to hold each sample once. Reports (.jsonl, a row per frame)
are sorted by frame; rows with the same key are kept once. All frames that their commands were to make are to be
there, of all shares. Reports of rasray compare (.jsonl, a line per run) make one report: .json, .md or .html, or lines
again; all runs of the comparison are to be there, of one program and device.";

/// Options of `rasray merge`.
#[derive(Debug, Args)]
#[command(after_help = AFTER_HELP)]
pub struct MergeArguments {
    /// File to write: .png or .exr of shares of the samples, .jsonl of reports, .json, .md or .html of
    /// comparisons
    #[arg(value_name = "OUT")]
    pub out: PathBuf,
    /// Files to put together
    #[arg(value_name = "PART", required = true)]
    pub parts: Vec<PathBuf>,
    /// Colours of a .png.
    #[command(flatten)]
    pub tone: ToneArguments,
    /// Take what noise is left out of the picture, with the library Open Image Denoise where it is installed;
    /// shares are to have --aov albedo,normal
    #[arg(long)]
    pub denoise: bool,
}
