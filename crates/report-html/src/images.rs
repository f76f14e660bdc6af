//! Images against the reference: a slider between any two, a gallery of all images, and maps of FLIP.

use super::markup::Markup;
use super::picture::{address, ramp};
use super::section::Section;
use crate::error::{HtmlError, misfit};
use rasray_metrics::tone_map;
use rasray_report::Report;
use rasray_report::colour_scale::{MAGMA, colour};
use rasray_report::figures::{Figures, Images, SystemImage};

/// Makes the section of images; absent unless images were compared.
///
/// # Errors
/// An image or a map lacks pixels.
pub(super) fn section(report: &Report, figures: &Figures) -> Result<Option<Section>, HtmlError> {
    let Some(images) = &figures.images else { return Ok(None) };
    let mut body = Markup::default();
    body.leaf(
        "p",
        &[],
        "Tone mapping: linear colours clamped to [0, 1], then the sRGB curve; nothing else. The reference \
         is rendered with the same random numbers, so that noise is no difference.",
    );
    viewer(&mut body, report, images);
    body.fixed("<h3>All images</h3>\n<div class=\"pictures\">\n");
    let alternative = "The scene as the reference renders it";
    picture(
        &mut body,
        images,
        ("image-reference", "reference", alternative),
        &beauty(images, &images.reference)?,
    );
    for (index, system) in images.systems.iter().enumerate() {
        let name = report.runs[system.run].contestant();
        let id = format!("image-{index}");
        let alternative = format!("The scene as {name} renders it");
        picture(&mut body, images, (&id, &name, &alternative), &beauty(images, &system.pixels)?);
    }
    body.fixed("</div>\n");
    if images.systems.iter().any(|system| !system.flip.is_empty()) {
        maps(&mut body, report, images)?;
    }
    Ok(Some(Section::new("images", "Images", body)))
}

fn beauty(images: &Images, pixels: &[[f32; 3]]) -> Result<String, HtmlError> {
    address(images.width, images.height, &tone_map(pixels, 0.0))
}

/// Writes the viewer of two images, one over the other. The page's script takes both from the gallery, so
/// that no image is in the page twice.
fn viewer(body: &mut Markup, report: &Report, images: &Images) {
    if images.systems.is_empty() {
        return;
    }
    let names: Vec<String> =
        images.systems.iter().map(|system| report.runs[system.run].contestant()).collect();
    body.element("div", &[("class", "viewer script-only"), ("id", "viewer")], |body| {
        body.fixed("<div class=\"choices\">");
        for (id, label, chosen) in [("viewer-left", "Left", 0), ("viewer-right", "Right", 1)] {
            body.element("label", &[("for", id)], |body| {
                body.fixed(label).fixed(" ").element("select", &[("id", id)], |body| {
                    let all = std::iter::once("reference").chain(names.iter().map(String::as_str));
                    for (index, name) in all.enumerate() {
                        let value = match index.checked_sub(1) {
                            Some(index) => format!("image-{index}"),
                            None => "image-reference".to_owned(),
                        };
                        let selected = [("value", value.as_str()), ("selected", "")];
                        body.leaf("option", &selected[..if index == chosen { 2 } else { 1 }], name);
                    }
                });
            });
        }
        let shape = format!("aspect-ratio:{}/{}", images.width, images.height);
        body.fixed("</div>\n").element("div", &[("class", "stage"), ("style", &shape)], |body| {
            body.fixed("<img id=\"viewer-under\" alt=\"\"><img id=\"viewer-over\" alt=\"\">");
        });
        body.fixed(
            "\n<label for=\"viewer-split\">Boundary between left and right</label>\
             <input type=\"range\" id=\"viewer-split\" min=\"0\" max=\"100\" value=\"50\">",
        );
    });
    body.fixed("\n");
}

fn picture(body: &mut Markup, images: &Images, (id, caption, alternative): (&str, &str, &str), source: &str) {
    let size = [images.width, images.height].map(|length| length.to_string());
    body.element("figure", &[], |figure| {
        let attributes =
            [("id", id), ("src", source), ("alt", alternative), ("width", &size[0]), ("height", &size[1])];
        // Images without a name need no id, since nothing looks them up.
        figure.empty("img", if id.is_empty() { &attributes[1..] } else { &attributes });
        figure.leaf("figcaption", &[], caption);
    });
    body.fixed("\n");
}

fn maps(body: &mut Markup, report: &Report, images: &Images) -> Result<(), HtmlError> {
    body.fixed("<h3>FLIP of each pixel</h3>\n<div class=\"legend\">");
    let words = "From 0 (dark, no visible difference) to 1 (bright)";
    body.empty("img", &[("src", &ramp(MAGMA)?), ("alt", words)]);
    body.fixed("<div aria-hidden=\"true\">");
    for (place, label) in [
        ("left:0%", "0"),
        ("left:25%", "0.25"),
        ("left:50%", "0.5"),
        ("left:75%", "0.75"),
        ("left:100%", "1"),
    ] {
        body.leaf("span", &[("style", place)], label);
    }
    body.fixed("</div></div>\n<div class=\"pictures\">\n");
    for system in images.systems.iter().filter(|system| !system.flip.is_empty()) {
        map(body, report, images, system)?;
    }
    body.fixed("</div>\n");
    Ok(())
}

fn map(body: &mut Markup, report: &Report, images: &Images, system: &SystemImage) -> Result<(), HtmlError> {
    if system.flip.len() != system.pixels.len() {
        return Err(misfit(format!("a map of FLIP has {} pixels", system.flip.len())));
    }
    let rgb: Vec<u8> = system.flip.iter().flat_map(|value| colour(MAGMA, f64::from(*value))).collect();
    let source = address(images.width, images.height, &rgb)?;
    let name = report.runs[system.run].contestant();
    let mean = system.flip.iter().map(|value| f64::from(*value)).sum::<f64>() / system.flip.len() as f64;
    let largest = system.flip.iter().copied().fold(0.0, f32::max);
    let caption = format!("{name}: mean {mean:.5}, largest {largest:.3}");
    picture(body, images, ("", &caption, &format!("Map of FLIP of {caption}")), &source);
    Ok(())
}
