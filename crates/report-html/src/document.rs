//! Frame of the page: head, title, device, navigation, parts, notices and scripts.

use super::markup::Markup;
use super::section::Section;
use rasray_report::{Device, Report, bytes, grouped};
use serde_json::Value;
use std::borrow::Cow;

/// Content security policy that forbids every load from elsewhere, even if a part of the page tries one.
const POLICY: &str =
    "default-src 'none'; img-src data: blob:; style-src 'unsafe-inline'; script-src 'unsafe-inline'";

/// Head of a page.
pub(super) struct Head<'a> {
    /// Command that made the page.
    pub command: &'static str,
    /// Subject of the page.
    pub subject: &'a str,
    /// Facts about the page: names and their values.
    pub facts: Vec<(&'static str, Cow<'a, str>)>,
    /// Device that the runs ran on.
    pub device: &'a Device,
}

/// Writes the page of a report.
pub(super) fn of_report(report: &Report, sections: &[Section]) -> String {
    let head = Head {
        command: "rasray compare",
        subject: &report.scene.name,
        facts: facts(report),
        device: &report.device,
    };
    document(&head, sections)
}

/// Writes a whole page.
pub(super) fn document(head: &Head<'_>, sections: &[Section]) -> String {
    let mut page = Markup::default();
    page.fixed("<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n");
    page.empty("meta", &[("http-equiv", "Content-Security-Policy"), ("content", POLICY)]);
    page.fixed("\n<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n");
    page.fixed("<meta name=\"color-scheme\" content=\"light dark\">\n");
    page.leaf("title", &[], format_args!("{}: {}", head.command, head.subject));
    page.fixed("\n<style>\n").fixed(include_str!("page.css")).fixed("</style>\n");
    // This script runs before the layout, because parts that need the script are hidden where no script runs.
    page.script("document.documentElement.classList.add('scripted');");
    page.fixed("</head>\n<body>\n");
    header(&mut page, head);
    navigation(&mut page, sections);
    page.fixed("<main>\n");
    for section in sections {
        page.element("section", &[("id", &*section.id)], |page| {
            page.leaf("h2", &[], &section.title).fixed("\n").append(&section.body);
        });
        page.fixed("\n");
    }
    page.fixed("</main>\n");
    footer(&mut page);
    let plots: Vec<Value> =
        sections.iter().flat_map(|section| &section.plots).map(super::section::Plot::value).collect();
    if !plots.is_empty() {
        page.library(PLOT_LIBRARY);
        page.data("plots", &Value::Array(plots));
    }
    page.script(include_str!("page.js"));
    page.fixed("</body>\n</html>\n");
    page.into_string()
}

fn facts(report: &Report) -> Vec<(&'static str, Cow<'_, str>)> {
    let mut facts: Vec<(&'static str, Cow<'_, str>)> = Vec::new();
    facts.push(("Triangles", grouped(report.scene.triangles).into()));
    if let Some(sum) = &report.scene.sha256 {
        facts.push(("Scene, SHA-256", sum.into()));
    }
    if let Some(count) = report.scene.not_uploaded_bytes {
        facts.push(("Scene, not uploaded", bytes(count).into()));
    }
    if let Some(pose) = &report.scene.pose {
        let names: Vec<_> = pose.clips.iter().chain(&pose.file).map(String::as_str).collect();
        let of = if names.is_empty() { String::new() } else { format!(" of {}", names.join(", ")) };
        facts.push(("Time", format!("{} s{of}", pose.time_s).into()));
    }
    let smaller = report.scene.smaller_images.iter().map(|image| {
        let ([width, height], [from_width, from_height]) = (image.to, image.from);
        format!("{} as {width}x{height}, not {from_width}x{from_height}", image.name)
    });
    if !report.scene.smaller_images.is_empty() {
        facts.push(("Smaller images", smaller.collect::<Vec<_>>().join("; ").into()));
    }
    facts.push(("Device", device_words(&report.device).into()));
    let commit = report.commit.as_ref().map(|commit| format!(", commit {commit}")).unwrap_or_default();
    facts.push(("Version", format!("{}{commit}", report.version).into()));
    facts.push(("Runs", grouped(report.runs.len() as u64).into()));
    facts.extend(report.command.as_ref().map(|command| ("Command", command.into())));
    facts
}

/// Describes a device and its driver.
pub(super) fn device_words(device: &Device) -> String {
    let kind = if device.software { ", software" } else { "" };
    format!("{} ({}{kind})", device.full_name(), device.driver)
}

fn header(page: &mut Markup, head: &Head<'_>) {
    page.fixed("<header>\n");
    page.element("h1", &[], |title| {
        title.leaf("span", &[], head.command).fixed(" ").text(head.subject);
    });
    page.fixed("\n<dl class=\"facts\">");
    for (name, value) in &head.facts {
        page.element("div", &[], |pair| {
            pair.leaf("dt", &[], name).leaf("dd", &[], value);
        });
    }
    page.fixed("</dl>\n");
    if head.device.software {
        page.fixed(
            "<p class=\"note\" role=\"note\"><strong>A software driver.</strong> Its times are for ratios \
             between runs on this device, not for what a graphics card would need.</p>\n",
        );
    }
    page.fixed("</header>\n");
}

fn navigation(page: &mut Markup, sections: &[Section]) {
    page.element("nav", &[("aria-label", "Parts of the page")], |page| {
        for section in sections {
            page.leaf("a", &[("href", &format!("#{}", section.id))], &section.title).fixed(" ");
        }
    });
    page.fixed("\n<noscript><p class=\"note\">Plots, sorting and the slider need JavaScript; tables and images do not.</p></noscript>\n");
}

fn footer(page: &mut Markup) {
    page.fixed("<footer>\n<details><summary>Licences of libraries in this page</summary><pre>");
    page.text(include_str!("notices.txt"));
    page.fixed("</pre></details>\n</footer>\n");
}

/// Source of plotly.js, as in npm's plotly.js-basic-dist-min 3.0.1: only scatter and bar plots, the kinds
/// that pages use.
const PLOT_LIBRARY: &str = include_str!("plotly-basic.min.js");

#[cfg(test)]
mod tests {
    use super::*;

    /// Checks that nothing in the library ends the script element that holds it.
    #[test]
    fn the_library_can_stand_in_a_page() {
        assert!(["</script", "<script", "<!--"].iter().all(|mark| !PLOT_LIBRARY.contains(mark)));
        assert!(PLOT_LIBRARY.contains("plotly.js (basic - minified) v3.0.1"));
    }
}
