//! Page of a campaign: for each experiment plots, then a table.

use super::campaign_plots::plots;
use super::document::{Head, device_words, document};
use super::markup::Markup;
use super::section::Section;
use super::sortable::{Heading, table};
use rasray_report::{Campaign, Experiment, grouped};

/// Writes the page as UTF-8 text.
pub fn campaign_page(campaign: &Campaign) -> Vec<u8> {
    let rows: usize = campaign.experiments.iter().map(|experiment| experiment.rows.len()).sum();
    let facts = vec![
        ("Device", device_words(&campaign.device).into()),
        ("Version", campaign.program.as_str().into()),
        ("Experiments", grouped(campaign.experiments.len() as u64).into()),
        ("Runs", grouped(rows as u64).into()),
    ];
    let head = Head { command: "rasray", subject: &campaign.title, facts, device: &campaign.device };
    let sections: Vec<_> = campaign
        .experiments
        .iter()
        .enumerate()
        .map(|(place, experiment)| section(place, experiment))
        .collect();
    document(&head, &sections).into_bytes()
}

fn section(place: usize, experiment: &Experiment) -> Section {
    let mut section = Section::new(format!("experiment-{place}"), experiment.name.clone(), Markup::default());
    let parts = experiment.parts();
    for (number, part) in parts.iter().enumerate() {
        section.add(plots(&format!("experiment-{place}-{number}"), part));
    }
    for part in &parts {
        part_table(&mut section.body, part);
    }
    section
}

fn part_table(body: &mut Markup, experiment: &Experiment) {
    let (varied, columns) = (experiment.varied(), experiment.columns());
    let settings = varied.iter().copied().map(Heading::words);
    let numbers = columns.iter().map(|column| Heading::number(column.head, Some(column.meaning)));
    body.leaf("p", &[], experiment.common());
    table(body, &experiment.name, settings.chain(numbers), |body| {
        for row in &experiment.rows {
            body.element("tr", &[], |cells| {
                for name in &varied {
                    cells.leaf("td", &[], row.setting(name));
                }
                for column in &columns {
                    // A click on the heading sorts by this number; null stays at the end.
                    let value = row.results.get(column.name).map_or("null".to_owned(), f64::to_string);
                    let attributes = [("class", "number"), ("data-value", value.as_str())];
                    cells.leaf("td", &attributes, column.of(row));
                }
            });
            body.fixed("\n");
        }
    });
}
