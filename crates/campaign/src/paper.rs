//! Tables and figures of the papers: a plan for each, and the page that lays ours beside what was published.

use crate::claim::{Claim, Finding};
use crate::plan::{Plan, PlanError};
use crate::sheet::Sheet;
use rasray_report::{Campaign, Experiment, experiment_markdown, in_line, number};
use std::fmt::Write;

/// A paper whose tables and figures are made again.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Paper {
    /// The name of its system.
    pub name: &'static str,
    /// Authors, title, year.
    pub cited: &'static str,
    /// In the order of the paper.
    pub items: &'static [Item],
}

/// A table or a figure.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Item {
    /// Such as `table1` or `fig7`.
    pub name: &'static str,
    text: &'static str,
}

macro_rules! items {
    ($paper:literal: $($name:literal),* $(,)?) => {
        &[$(Item {
            name: $name,
            text: include_str!(concat!("../../../tools/plans/", $paper, "/", $name, ".toml")),
        }),*]
    };
}

/// All of them.
pub const PAPERS: [Paper; 5] = [
    Paper {
        name: "mmrt",
        cited: "Vardis, Vasilakis, Papaioannou: A multiview and multilayer approach for interactive ray tracing, I3D 2016",
        items: items!("mmrt": "table1", "table2", "fig7", "fig8", "fig9", "fig10", "fig11", "fig12"),
    },
    Paper {
        name: "dirt",
        cited: "Vardis, Vasilakis, Papaioannou: DIRT: Deferred Image-based Ray Tracing, HPG 2016",
        items: items!("dirt": "table1", "table2", "table3", "fig7", "fig8", "fig9", "fig10", "fig11", "text"),
    },
    Paper {
        name: "hu",
        cited: "Hu, Huang, Zhang, Yuan, Li: Ray tracing via GPU rasterization, The Visual Computer 30, 2014",
        items: items!("hu": "table1", "fig1", "fig6", "fig7", "fig8", "fig9", "fig10", "fig11"),
    },
    Paper {
        name: "selective",
        cited: "Frid Kastrati, Goswami: Selective rasterized ray-traced reflections on the GPU, 2017",
        items: items!("selective": "table1", "table2", "table3", "fig5", "fig6", "fig7", "fig8"),
    },
    Paper {
        name: "ldc",
        cited: "Bürger, Hertel, Krüger, Westermann: GPU Rendering of Secondary Effects, VMV 2007",
        items: items!("ldc": "table1", "fig1", "fig2", "fig10"),
    },
];

impl Paper {
    /// The paper of a system.
    pub fn named(name: &str) -> Option<&'static Self> {
        PAPERS.iter().find(|paper| paper.name == name)
    }

    /// An item by its name.
    pub fn item(&self, name: &str) -> Option<&'static Item> {
        self.items.iter().find(|item| item.name == name)
    }
}

impl Item {
    /// Its plan.
    ///
    /// # Errors
    /// None for the plans of this program, which a test reads.
    pub fn plan(&self, small: bool) -> Result<Plan, PlanError> {
        Plan::read(self.text, small)
    }
}

/// The page of a paper: of each item that was made, what differs from the paper, the paper's numbers beside ours, and all
/// that was measured; and the sheets of pictures that it shows. Experiments of `campaign` are those of [`Plan::joined`]
/// with [`word`].
pub fn paper_page(paper: &Paper, items: &[(&Item, Plan)], campaign: &Campaign) -> (String, Vec<Sheet>) {
    let mut sheets = Vec::new();
    let device = &campaign.device;
    let software = if device.software { ", a software driver" } else { "" };
    let mut text = format!("# Replication of {}\n\n{}.\n\n", paper.name, paper.cited);
    _ = writeln!(
        text,
        "Made by rasray {} on {}{software}:\n",
        in_line(&campaign.program),
        in_line(&device.name)
    );
    let names: Vec<_> = items.iter().map(|(item, _)| item.name).collect();
    _ = writeln!(text, "```\nrasray replicate {} {}\n```\n", paper.name, names.join(" "));
    text += "Of a ratio, *ours* is the geometric mean over all pairs of runs that differ in nothing else, with the least and \
             the greatest; of other numbers the median. It *holds* within a factor of two on the same side of 1. Times of \
             other numbers depend on device, scene and size. *Wrong hits* of fragments without a triangle, as mmrt, hu and ldc \
             have them in their published form, are hits that are missed or false; how far off the others are is *dt/t*.\n";
    for (item, plan) in items {
        _ = writeln!(text, "\n## {}: {}\n", item.name, in_line(&plan.title));
        if !plan.about.is_empty() {
            _ = writeln!(text, "{}\n", plan.about);
        }
        if !plan.discussion.is_empty() {
            _ = writeln!(text, "**On two processor cores, in small size.** {}\n", plan.discussion);
        }
        for (number, experiment) in plan.experiments.iter().enumerate() {
            let name = format!("{}: {}", word(paper, item), experiment.name);
            let made = campaign.experiments.iter().find(|made| made.name == name);
            _ = writeln!(text, "### {}\n", in_line(&experiment.name));
            let Some(made) = made else {
                text += "Nothing was made.\n";
                continue;
            };
            if let Some(sheet) = Sheet::of(paper, item, number, made) {
                text += &sheet.markdown();
                sheets.push(sheet);
            }
            text += &section(&experiment.claims, made);
        }
    }
    (text, sheets)
}

/// What stands before the names of an item's experiments.
pub fn word(paper: &Paper, item: &Item) -> String {
    format!("{} {}", paper.name, item.name)
}

fn section(claims: &[Claim], made: &Experiment) -> String {
    let mut text = String::new();
    if !claims.is_empty() {
        text += "| the paper says | published | ours | ours / published | |\n| --- | ---: | ---: | ---: | --- |\n";
        for claim in claims {
            let found = claim.find(made);
            let (ours, relation, verdict) = match &found {
                Some(found) => (found.words(), number(found.relation), verdict(found)),
                None => (String::new(), String::new(), "not measured"),
            };
            let published = number(claim.published);
            _ = writeln!(
                text,
                "| {} | {published} | {ours} | {relation} | {verdict} |",
                claim.says.replace('|', "\\|")
            );
        }
        text.push('\n');
        for claim in claims.iter().filter(|claim| !claim.note.is_empty()) {
            _ = writeln!(text, "- *{}*: {}", claim.says, claim.note);
        }
        if claims.iter().any(|claim| !claim.note.is_empty()) {
            text.push('\n');
        }
    }
    text + &experiment_markdown(made)
}

/// Whether a claim holds, in words; nothing of numbers that depend on the machine.
fn verdict(found: &Finding) -> &'static str {
    match found.same_side {
        None => "",
        Some(false) => "does not hold",
        Some(true) if (0.5..=2.0).contains(&found.relation) => "holds",
        Some(true) => "same direction",
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_item_has_a_plan_that_reads_in_both_sizes() {
        for (paper, item) in PAPERS.iter().flat_map(|paper| paper.items.iter().map(move |item| (paper, item)))
        {
            for small in [false, true] {
                let plan =
                    item.plan(small).unwrap_or_else(|error| panic!("{} {}: {error}", paper.name, item.name));
                assert!(!plan.about.is_empty() && plan.title != "Campaign", "{} {}", paper.name, item.name);
                let words = plan.comparisons().map(|(_, one)| one.words.clone());
                let size = match (paper.name, item.name) {
                    ("mmrt", "fig12") => "--size=800x800",
                    _ if small => "--size=144x96",
                    _ => "--size=640x360",
                };
                assert!(
                    words.into_iter().all(|words| words.contains(&size.to_owned())),
                    "{} {}",
                    paper.name,
                    item.name
                );
            }
        }
        assert_eq!(
            Paper::named("hu").and_then(|paper| paper.item("fig6")).map(|item| item.name),
            Some("fig6")
        );
        assert!(Paper::named("none").is_none());
    }
}
