//! Page of a paper: published numbers beside ours, and a short form of the measurements.

use crate::brief::{SharedSettings, merged, shown, take_alike};
use crate::claim::{Claim, Finding};
use crate::paper::{Item, Paper, word};
use crate::plan::{ExperimentPlan, Plan};
use crate::sheet::Sheet;
use rasray_report::{Campaign, Experiment, Row, in_line, number, rows_markdown};
use std::collections::BTreeSet;
use std::fmt::Write;

/// Returns the page of a paper, and the sheets of pictures that it shows. For each item that was made, the
/// page has the differences from the paper, the paper's numbers beside ours, and the runs. Experiments of
/// `campaign` are those of [`Plan::joined`] with [`word`].
pub fn paper_page(paper: &Paper, items: &[(&Item, Plan)], campaign: &Campaign) -> (String, Vec<Sheet>) {
    let made = |item: &Item, experiment: &ExperimentPlan| {
        let name = format!("{}: {}", word(paper, item), experiment.name);
        campaign.experiments.iter().find(|made| made.name == name)
    };
    let all = items.iter().flat_map(|(item, plan)| plan.experiments.iter().filter_map(|one| made(item, one)));
    let rows: Vec<_> = all.flat_map(|made| &made.rows).collect();
    let of_all = SharedSettings::of(&rows, &SharedSettings::default());
    let of_kinds = [true, false].map(|is_rays| {
        let rows: Vec<_> = rows.iter().copied().filter(|row| is_of_rays(row) == is_rays).collect();
        SharedSettings::of(&rows, &of_all)
    });
    let names: Vec<_> = items.iter().map(|(item, _)| item.name).collect();
    let mut text = head(paper, &names, campaign, &of_all, &of_kinds);
    let mut page = Page { paper, of_kinds, tables: Vec::new(), sheets: Vec::new() };
    for (item, plan) in items {
        _ = writeln!(text, "\n## {}: {}\n", item.name, in_line(&plan.title));
        if !plan.about.is_empty() {
            _ = writeln!(text, "{}\n", plan.about);
        }
        if !plan.discussion.is_empty() {
            _ = writeln!(text, "*Two cores, small size.* {}\n", plan.discussion);
        }
        for (number, experiment) in plan.experiments.iter().enumerate() {
            let mut place = item.name.to_owned();
            if plan.experiments.len() > 1 {
                let name = in_line(&experiment.name);
                _ = writeln!(text, "### {name}\n");
                place += &format!(", {name}");
            }
            match made(item, experiment) {
                Some(made) => text += &page.section((item, number), &place, experiment, made),
                None => text += "Nothing was made.\n\n",
            }
        }
        text.truncate(text.trim_end().len());
        text.push('\n');
    }
    (text, page.sheets)
}

fn is_of_rays(row: &Row) -> bool {
    row.run().ray_set.is_some()
}

fn head(
    paper: &Paper,
    items: &[&str],
    campaign: &Campaign,
    of_all: &SharedSettings,
    of_kinds: &[SharedSettings; 2],
) -> String {
    let device = &campaign.device;
    let software = if device.software { ", a software driver" } else { "" };
    let mut text = format!("# Replication of {}\n\n{}.\n\n", paper.name, paper.cited);
    let name = device.full_name();
    let (program, name) = (in_line(&campaign.program), in_line(&name));
    _ = writeln!(text, "Made by rasray {program} on {name}{software}:\n");
    _ = writeln!(text, "```\nrasray replicate {} {}\n```\n", paper.name, items.join(" "));
    text += "*Ours*: of a ratio the geometric mean over all pairs of runs that differ in nothing else (the least to the \
             greatest), of other numbers, which depend on the machine, the median. It *holds* within a factor of two on the same \
             side of 1. *Wrong hits* of fragments without a triangle: missed or false; *dt/t*: how far off others are. \
             `table.csv` has all numbers.\n\n";
    let [of_rays, of_images] = of_kinds;
    for (of, said) in [("runs", of_all), ("rays", of_rays), ("images", of_images)] {
        if !said.words().is_empty() {
            _ = writeln!(text, "- All {of}: {}", in_line(&said.words().join("; ")));
        }
    }
    text
}

/// Page as far as it is written.
struct Page<'a> {
    paper: &'a Paper,
    /// Settings that all rays share, and settings that all images share.
    of_kinds: [SharedSettings; 2],
    /// Place of each table on the page, and the keys of its runs.
    tables: Vec<(String, BTreeSet<String>)>,
    sheets: Vec<Sheet>,
}

impl Page<'_> {
    /// Returns the section of an experiment, given its item and its number among the item's experiments;
    /// `place` is its place on the page.
    fn section(
        &mut self,
        (item, number): (&Item, usize),
        place: &str,
        plan: &ExperimentPlan,
        made: &Experiment,
    ) -> String {
        let mut parts: Vec<_> = made.parts().iter().map(merged).collect();
        // The reference comes before the rows that are compared with it. It has another seed, which shows the
        // effect of noise alone.
        for part in &mut parts {
            part.rows.sort_by_key(|row| row.setting("system") != "reference");
        }
        // Settings that rays and images share are told once.
        let before = match &parts[..] {
            [one] => self.of_kind(one).clone(),
            _ => self.of_kinds[0].shared(&self.of_kinds[1]),
        };
        let of_both = SharedSettings::of(&made.rows.iter().collect::<Vec<_>>(), &before);
        let mut words = of_both.words().to_vec();
        let (mut sheet, mut tables) = (String::new(), String::new());
        for (index, part) in parts.iter().enumerate() {
            let is_rays = part.rows.iter().all(is_of_rays);
            let name = if is_rays { "Rays" } else { "Images" };
            if let Some(place) = self.above(part) {
                _ = writeln!(tables, "{name}: those of {place}.\n");
                continue;
            }
            let said = SharedSettings::of(
                &part.rows.iter().collect::<Vec<_>>(),
                &of_both.clone().and(self.of_kind(part)),
            );
            if !is_rays {
                let of_images = Sheet::of(self.paper, item, number, part);
                sheet = of_images.markdown();
                self.sheets.push(of_images);
            }
            let mut columns = shown(part, &plan.columns, index > 0);
            let own = [said.words().to_vec(), take_alike(part, &mut columns)].concat();
            if parts.len() > 1 {
                let own = [vec![name.to_owned()], own].concat();
                _ = writeln!(tables, "{}:\n", in_line(&own.join("; ")));
            } else {
                words.extend(own);
            }
            tables += &rows_markdown(part, &said.untold(part), &columns);
            tables.push('\n');
            let keys = part.rows.iter().map(|row| row.key.clone()).collect();
            self.tables.push((place.to_owned(), keys));
        }
        let words = in_line(&words.join("; ")).into_owned();
        let end = if parts.len() > 1 { "." } else { ":" };
        let words = if words.is_empty() { words } else { format!("{words}{end}\n\n") };
        sheet + &held_against(&plan.claims, made) + &words + &tables
    }

    fn of_kind(&self, part: &Experiment) -> &SharedSettings {
        let [of_rays, of_images] = &self.of_kinds;
        if part.rows.iter().all(is_of_rays) { of_rays } else { of_images }
    }

    /// Returns the place of an earlier table that has all runs of this experiment.
    fn above(&self, part: &Experiment) -> Option<&str> {
        let has_all = |keys: &BTreeSet<String>| part.rows.iter().all(|row| keys.contains(&row.key));
        self.tables.iter().find(|(_, keys)| has_all(keys)).map(|(place, _)| place.as_str())
    }
}

/// Returns the table of the paper's numbers beside ours, with notes.
fn held_against(claims: &[Claim], made: &Experiment) -> String {
    if claims.is_empty() {
        return String::new();
    }
    let mut text = "| the paper says | published | ours | |\n| --- | ---: | ---: | --- |\n".to_owned();
    for claim in claims {
        let found = claim.find(made);
        let (ours, verdict) =
            found.as_ref().map_or((String::new(), "not measured"), |found| (found.words(), verdict(found)));
        let says = claim.says.replace('|', "\\|");
        _ = writeln!(text, "| {says} | {} | {ours} | {verdict} |", number(claim.published));
    }
    text.push('\n');
    let notes: Vec<_> = claims.iter().filter(|claim| !claim.note.is_empty()).collect();
    for claim in &notes {
        _ = writeln!(text, "- *{}*: {}", claim.says, claim.note);
    }
    if !notes.is_empty() {
        text.push('\n');
    }
    text
}

/// Returns the verdict on a claim, in words; empty for numbers that depend on the machine.
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
    use rasray_report::{Device, Origin, Report, Run, SceneRecord};

    type Pairs<'a, T> = &'a [(&'a str, T)];

    fn row(key: &str, settings: Pairs<'_, &str>, results: Pairs<'_, f64>) -> Row {
        let ray_set = settings.iter().find(|(name, _)| *name == "ray-set").map(|(_, set)| (*set).to_owned());
        let run = Run { ray_set, ..Run::default() };
        let (origin, scene) = (Origin::default(), SceneRecord::default());
        Row {
            key: key.to_owned(),
            settings: settings
                .iter()
                .map(|(name, value)| ((*name).to_owned(), (*value).to_owned()))
                .collect(),
            results: results.iter().map(|(name, value)| ((*name).to_owned(), *value)).collect(),
            report: Report::new(origin, Device::default(), scene, vec![run]),
        }
    }

    /// Returns the page of two items of a paper, with these rows for their experiments.
    fn page(plans: [&str; 2], rows: [Vec<Row>; 2]) -> (String, Vec<Sheet>) {
        let paper = Paper::named("selective").expect("a paper");
        let items = ["table2", "table3"].map(|name| paper.item(name).expect("an item"));
        let plans = plans.map(|text| Plan::read(text, true).expect("valid"));
        let mut experiments = Vec::new();
        for ((item, plan), rows) in items.iter().zip(&plans).zip(rows) {
            experiments.push(Experiment {
                name: format!("{}: {}", word(paper, item), plan.experiments[0].name),
                rows,
            });
        }
        let (title, program) = ("All".to_owned(), "1".to_owned());
        let campaign = Campaign { title, program, device: Device::default(), experiments };
        let items: Vec<_> = items.into_iter().zip(plans).collect();
        paper_page(paper, &items, &campaign)
    }

    const PLAN: &str = "[[experiment]]\nname = \"Selection\"\nscene = \"cornell\"";

    #[test]
    fn settings_and_runs_are_said_once() {
        let rows = || {
            let of_pool = |key, system, fetch, trace_ms, wrong| {
                let settings = [
                    ("scene", "pool"),
                    ("camera", "deck"),
                    ("size", "4x3"),
                    ("system", system),
                    ("ray-set", "eye"),
                    ("fetch", fetch),
                ];
                let results =
                    [("trace_ms", trace_ms), ("error_share", wrong), ("memory.structure_bytes", 64.0)];
                row(key, &settings, &results)
            };
            vec![
                of_pool("a", "hu", "raster", 1.0, 0.25),
                of_pool("a", "hu", "direct", 1.0, 0.25),
                of_pool("b", "bvh", "raster", 2.0, 0.0),
                row(
                    "c",
                    &[
                        ("scene", "walker"),
                        ("camera", "low"),
                        ("size", "4x3"),
                        ("system", "hu"),
                        ("fetch", "raster"),
                    ],
                    &[("image_ms", 3.0), ("image.flip_mean", 0.5)],
                ),
                row(
                    "d",
                    &[
                        ("scene", "walker"),
                        ("camera", "low"),
                        ("size", "4x3"),
                        ("system", "reference"),
                        ("fetch", "raster"),
                    ],
                    &[("image.flip_mean", 0.125)],
                ),
            ]
        };
        let (text, sheets) = page([PLAN; 2], [rows(), rows()]);
        for (words, count) in [
            ("size 4x3", 1),
            ("pool: camera deck, ray-set eye; walker: camera low", 1),
            ("Rays; hu: fetch raster, direct; bvh: fetch raster; bytes 64 B:", 1),
            (
                "| system | trace ms | wrong hits, % |\n| --- | ---: | ---: |\n| hu | 1.00 | 25.0 |\n| bvh | 2.00 | 0 |",
                1,
            ),
            // The reference comes first, as on the sheet.
            ("| reference |  | 0.125 |\n| hu | 3.00 | 0.500 |", 1),
            ("Rays: those of table2.", 1),
            ("Images: those of table2.", 1),
        ] {
            assert_eq!(text.matches(words).count(), count, "{words}: {text}");
        }
        let [sheet] = &sheets[..] else { panic!("{sheets:?}") };
        assert_eq!(
            (sheet.file.as_str(), &sheet.pictures[..]),
            ("selective-table2.png", &["d".to_owned(), "c".to_owned()][..])
        );
    }

    #[test]
    fn a_plan_names_the_results_that_are_shown() {
        let rows = |key| {
            vec![
                row(
                    key,
                    &[("scene", "pool"), ("system", "hu"), ("ray-set", "eye")],
                    &[("trace_ms", 1.0), ("counters.fragments", 9.0)],
                ),
                row(
                    "c",
                    &[("scene", "pool"), ("system", "bvh"), ("ray-set", "eye")],
                    &[("trace_ms", 2.0), ("counters.fragments", 8.0)],
                ),
            ]
        };
        let plan = format!("{PLAN}\ncolumns = [\"counters.fragments\"]");
        let (text, _) = page([PLAN, &plan], [rows("a"), rows("b")]);
        assert!(text.contains("| system | trace ms |") && text.contains("| system | fragments |"), "{text}");
        assert!(text.contains("All runs") && !text.contains("All images"), "{text}");
    }
}
