//! Options of `rasray ablate` and `rasray replicate`.

use super::options::choice;
use super::shared::DeviceArguments;
use super::values;
use clap::Args;
use clap::builder::TypedValueParser;
use rasray_campaign::{PAPERS, Paper};
use rasray_experiment::Shard;
use std::path::{Path, PathBuf};

const REPLICATE_HELP: &str = "\
Examples:
  rasray replicate --list
  rasray replicate mmrt table1 fig12 --output mmrt
  rasray replicate all --small --output replication
  rasray replicate all --small --output replication --resume

The folder gets what rasray ablate writes, and PAPER.md: of each item the paper's numbers beside ours, what differs from
the paper, and the error of every run against the exact structure. Scenes are the nearest of the built-in ones.";

const AFTER_HELP: &str = "\
Examples:
  rasray ablate storages.toml --output storages --dry-run
  rasray ablate storages.toml --output storages
  rasray ablate storages.toml --output storages --resume
  rasray ablate storages.toml --output out.1 --shard 1/3    (then: rasray merge report.html out.*/cells.*.jsonl)

A plan is a list of experiments; an experiment is options of rasray compare, some with lists of values, of which every
combination is made:

  [[experiment]]
  name = \"Storages of lists\"
  scene = [\"cornell\", \"walker\"]
  systems = \"mmrt\"
  ray-set = [\"camera\", \"bounce\"]
  \"mmrt.storage\" = [\"ll\", \"sb\"]
  repetitions = 3

The folder gets cells.jsonl, a line per run, which is whole or not there after a kill; table.csv, a row per run;
report.html, plots before tables; report.md. A run that several experiments ask for is made once.

SIGINT (Ctrl-C), SIGTERM or SIGHUP: the folder holds the runs that were whole, exit code 130; --resume makes the others.";

/// Options of `rasray ablate`.
#[derive(Debug, Args)]
#[command(after_help = AFTER_HELP)]
pub struct AblateArguments {
    /// A plan, .toml
    #[arg(value_name = "PLAN")]
    pub plan: PathBuf,
    /// Options of the campaign.
    #[command(flatten)]
    pub campaign: CampaignArguments,
}

/// Options of a campaign.
#[derive(Debug, Args)]
pub struct CampaignArguments {
    /// Folder for the results; made where there is none
    #[arg(long, short, value_name = "FOLDER", required = true)]
    pub output: Option<PathBuf>,
    /// With the sizes that the plan calls small
    #[arg(long)]
    pub small: bool,
    /// Say which runs would be made, and how long they would take where the folder holds runs to tell by
    #[arg(long, conflicts_with = "resume")]
    pub dry_run: bool,
    /// Leave the runs alone that the folder holds. A line of another program, device or plan is refused
    #[arg(long)]
    pub resume: bool,
    /// One of N shares of the work, I from 1 to N: each Nth set of rays or list of images, whose systems take
    /// turns. Writes cells.I-of-N.jsonl alone
    #[arg(long, value_name = "I/N", value_parser = values::shard)]
    pub shard: Option<Shard>,
    /// Device that does the work.
    #[command(flatten)]
    pub device: DeviceArguments,
}

impl CampaignArguments {
    /// Returns the folder for the results; the parser demands one if there are any results.
    pub fn folder(&self) -> &Path {
        self.output.as_deref().unwrap_or(Path::new("."))
    }
}

/// Options of `rasray replicate`.
#[derive(Debug, Args)]
#[command(after_help = REPLICATE_HELP, mut_arg("output", |argument| argument.required(false).required_unless_present("list")))]
pub struct ReplicateArguments {
    /// mmrt, dirt, hu, selective, ldc, or all
    #[arg(value_name = "PAPER", value_parser = paper_parser(), required_unless_present = "list")]
    pub paper: Option<PaperChoice>,
    /// Tables and figures, such as table1 or fig7 [default: all of the paper]
    #[arg(value_name = "ITEM")]
    pub items: Vec<String>,
    /// Print the items of the paper, or of all, and what they are
    #[arg(long)]
    pub list: bool,
    /// Options of the campaign.
    #[command(flatten)]
    pub campaign: CampaignArguments,
}

/// Choice of papers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PaperChoice {
    /// All of them.
    All,
    /// One.
    One(&'static Paper),
}

fn paper_parser() -> impl TypedValueParser<Value = PaperChoice> {
    choice([PaperChoice::All].into_iter().chain(PAPERS.iter().map(PaperChoice::One)), |choice| match choice {
        PaperChoice::All => ("all", "All five"),
        PaperChoice::One(paper) => (paper.name, paper.cited),
    })
}
