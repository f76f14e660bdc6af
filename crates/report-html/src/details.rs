//! Details of each run in parts that open on demand: options, paths and every number of the JSON.

use super::markup::Markup;
use super::names::workload;
use super::section::Section;
use crate::error::{HtmlError, misfit};
use rasray_report::Report;
use serde_json::Value;

/// Fields that have tables of their own, before all other fields.
const OWN_TABLES: [(&str, &str); 2] = [("options", "Options"), ("paths", "What the device decided")];

/// Fields that are left out, because the summary or a plot shows each of their values.
const LEFT_OUT: [&str; 3] = ["system", "preset", "passes"];

/// Makes one part per run.
///
/// # Errors
/// A run cannot be written as JSON.
pub(super) fn section(report: &Report) -> Result<Option<Section>, HtmlError> {
    if report.runs.is_empty() {
        return Ok(None);
    }
    let mut body = Markup::default();
    body.leaf(
        "p",
        &[],
        "Options as resolved from preset and command line, and every number by its name in the JSON report.",
    );
    for run in &report.runs {
        let value = serde_json::to_value(run).map_err(|error| misfit(error.to_string()))?;
        body.element("details", &[], |body| {
            body.leaf("summary", &[], format_args!("{}, {}", run.contestant(), workload(run)));
            for (field, title) in OWN_TABLES {
                let mut rows = Vec::new();
                flatten(&value[field], String::new(), &mut rows);
                table(body, title, &rows);
            }
            let mut rows = Vec::new();
            for (name, field) in value.as_object().into_iter().flatten() {
                let known = LEFT_OUT.contains(&name.as_str()) || OWN_TABLES.iter().any(|own| own.0 == name);
                if !known {
                    flatten(field, name.clone(), &mut rows);
                }
            }
            table(body, "Measured", &rows);
            pass_table(body, run);
        });
        body.fixed("\n");
    }
    Ok(Some(Section::new("runs", "Runs in full", body)))
}

/// Flattens a value into rows of a dotted name and the value in words.
fn flatten(value: &Value, name: String, rows: &mut Vec<[String; 2]>) {
    match value {
        Value::Null => {}
        Value::Object(fields) => {
            for (field, value) in fields {
                let name = if name.is_empty() { field.clone() } else { format!("{name}.{field}") };
                flatten(value, name, rows);
            }
        }
        Value::String(text) => rows.push([name, text.clone()]),
        other => rows.push([name, other.to_string()]),
    }
}

fn table(body: &mut Markup, title: &'static str, rows: &[[String; 2]]) {
    if rows.is_empty() {
        return;
    }
    body.element(
        "div",
        &[("class", "scrolled"), ("tabindex", "0"), ("role", "region"), ("aria-label", title)],
        |body| {
            body.element("table", &[("class", "pairs")], |table| {
                table.leaf("caption", &[], title).fixed("<tbody>");
                for [name, value] in rows {
                    table.element("tr", &[], |row| {
                        row.leaf("th", &[("scope", "row")], name).leaf("td", &[], value);
                    });
                }
                table.fixed("</tbody>");
            });
        },
    );
}

fn pass_table(body: &mut Markup, run: &rasray_report::Run) {
    if run.passes.is_empty() {
        return;
    }
    body.element("div", &[("class", "scrolled"), ("tabindex", "0"), ("role", "region"), ("aria-label", "Passes")], |body| {
        body.element("table", &[], |table| {
            table.fixed(
                "<caption>Passes, ms: all dispatches together, share of the figure, and over repetitions</caption>\
                 <thead><tr><th scope=\"col\">pass</th><th scope=\"col\">stage</th><th scope=\"col\" class=\"number\">share</th>\
                 <th scope=\"col\" class=\"number\">median</th><th scope=\"col\" class=\"number\">shortest</th>\
                 <th scope=\"col\" class=\"number\">longest</th></tr></thead><tbody>",
            );
            for pass in &run.passes {
                table.element("tr", &[], |row| {
                    row.leaf("th", &[("scope", "row")], &pass.label);
                    row.leaf("td", &[], pass.stage.as_deref().unwrap_or_default());
                    for value in [pass.ms_share.unwrap_or(pass.ms_median), pass.ms_median, pass.ms_min, pass.ms_max] {
                        row.leaf("td", &[("class", "number")], format_args!("{value:.4}"));
                    }
                });
            }
            table.fixed("</tbody>");
        });
    });
}
