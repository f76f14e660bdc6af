//! A part of the page with a heading, and the plots in it.

use super::markup::Markup;
use serde_json::{Value, json};
use std::borrow::Cow;

/// A part of the page. A part exists only where there is something to show.
#[derive(Debug)]
pub(super) struct Section {
    /// Its anchor.
    pub id: Cow<'static, str>,
    /// Its heading.
    pub title: Cow<'static, str>,
    /// Its contents.
    pub body: Markup,
    /// Plots whose places are in `body`.
    pub plots: Vec<Plot>,
}

impl Section {
    /// A part without plots.
    pub fn new(id: impl Into<Cow<'static, str>>, title: impl Into<Cow<'static, str>>, body: Markup) -> Self {
        Self { id: id.into(), title: title.into(), body, plots: Vec::new() }
    }

    /// A part that explains its plots and then shows them; absent without plots.
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

    /// Adds plots below what it holds.
    pub fn add(&mut self, plots: Vec<Plot>) {
        self.body.element("div", &[("class", "plots")], |body| {
            for plot in &plots {
                plot.place(body);
            }
        });
        self.plots.extend(plots);
    }
}

/// A plot: traces and layout in the words of plotly.js.
#[derive(Clone, Debug)]
pub(super) struct Plot {
    /// Its anchor, unique in the page.
    pub id: String,
    /// The line above it.
    pub title: String,
    /// More about how it is drawn, or nothing.
    pub note: String,
    /// Description in words, for those who cannot see it.
    pub description: String,
    /// Pixels from top to bottom.
    pub height: usize,
    /// Traces.
    pub data: Vec<Value>,
    /// Axes and lines.
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

    /// Value that the page's script draws.
    pub fn value(&self) -> Value {
        json!({"id": self.id, "data": self.data, "layout": self.layout})
    }
}
