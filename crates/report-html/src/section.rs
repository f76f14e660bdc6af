//! Section of the page: a part with a heading, and its plots.

use super::markup::Markup;
use serde_json::{Value, json};
use std::borrow::Cow;

/// Part of the page, which exists only if there is something to show.
#[derive(Debug)]
pub(super) struct Section {
    /// Anchor of the part.
    pub id: Cow<'static, str>,
    /// Heading of the part.
    pub title: Cow<'static, str>,
    /// Contents of the part.
    pub body: Markup,
    /// Plots whose places are in `body`.
    pub plots: Vec<Plot>,
}

impl Section {
    /// Makes a part without plots.
    pub fn new(id: impl Into<Cow<'static, str>>, title: impl Into<Cow<'static, str>>, body: Markup) -> Self {
        Self { id: id.into(), title: title.into(), body, plots: Vec::new() }
    }

    /// Makes a part that explains its plots and then shows them; absent without plots.
    pub fn of_plots(
        id: &'static str,
        title: &'static str,
        explanation: &'static str,
        plots: Vec<Plot>,
    ) -> Option<Self> {
        if plots.is_empty() {
            return None;
        }
        let mut section = Self::new(id, title, Markup::default());
        section.body.leaf("p", &[], explanation);
        section.add(plots);
        Some(section)
    }

    /// Adds plots below the contents.
    pub fn add(&mut self, plots: Vec<Plot>) {
        self.body.element("div", &[("class", "plots")], |body| {
            for plot in &plots {
                plot.place(body);
            }
        });
        self.plots.extend(plots);
    }
}

/// Plot: traces and layout in the terms of plotly.js.
#[derive(Clone, Debug)]
pub(super) struct Plot {
    /// Anchor of the plot, unique in the page.
    pub id: String,
    /// Title above the plot.
    pub title: String,
    /// Note on how the plot is drawn; may be empty.
    pub note: String,
    /// Description in words, for readers who cannot see the plot.
    pub description: String,
    /// Height, pixels.
    pub height: usize,
    /// Traces of plotly.js.
    pub data: Vec<Value>,
    /// Layout of plotly.js: axes and lines.
    pub layout: Value,
}

impl Plot {
    fn place(&self, body: &mut Markup) {
        body.element("figure", &[("class", "plot")], |figure| {
            figure.element("figcaption", &[], |caption| {
                caption.leaf("strong", &[], &self.title);
                if !self.note.is_empty() {
                    caption.fixed(" ").text(&self.note);
                }
            });
            let height = format!("height:{}px", self.height);
            let area = [
                ("class", "area"),
                ("id", self.id.as_str()),
                ("style", &height),
                ("role", "img"),
                ("aria-label", &self.description),
            ];
            figure.element("div", &area, |_| {});
        });
        body.fixed("\n");
    }

    /// Returns the value that the page's script draws.
    pub fn value(&self) -> Value {
        json!({"id": self.id, "data": self.data, "layout": self.layout})
    }
}
