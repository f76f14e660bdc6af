//! Table of all rows of a campaign, for other programs.

use rasray_report::{Campaign, in_order};
use std::collections::BTreeSet;

/// Returns a table with a row per cell and experiment, as CSV (RFC 4180) with a line of heads: `experiment`,
/// `key`, the settings, `run` (system, preset and variant as reports name them), the results. Cells are empty
/// for settings and results that a row does not have.
pub fn csv_table(campaign: &Campaign) -> Vec<u8> {
    let rows =
        || campaign.experiments.iter().flat_map(|one| one.rows.iter().map(move |row| (&one.name, row)));
    let settings = in_order(rows().flat_map(|(_, row)| row.settings.keys().map(String::as_str)));
    let results: BTreeSet<&str> =
        rows().flat_map(|(_, row)| row.results.keys().map(String::as_str)).collect();
    let mut table = csv::Writer::from_writer(Vec::new());
    let heads = ["experiment", "key"].into_iter().chain(settings.iter().copied()).chain(["run"]);
    let mut write = |record: Vec<String>| {
        table.write_record(record).expect("memory takes every record, and all have the same length");
    };
    write(heads.chain(results.iter().copied()).map(str::to_owned).collect());
    for (experiment, row) in rows() {
        let own = [experiment.clone(), row.key.clone()];
        let settings = settings.iter().map(|name| row.setting(name).to_owned());
        let number = |name: &&str| row.results.get(*name).map(f64::to_string).unwrap_or_default();
        let record = own.into_iter().chain(settings).chain([row.run().contestant()]);
        write(record.chain(results.iter().map(number)).collect());
    }
    table.into_inner().expect("memory takes what is left")
}
