//! A table that is sorted by a click on a heading.

use super::markup::Markup;

/// The heading of a column.
#[derive(Clone, Copy)]
pub(super) struct Heading<'a> {
    pub name: &'a str,
    /// Numbers stand to the right.
    pub is_number: bool,
    /// Shown where a pointer rests on it.
    pub meaning: Option<&'static str>,
}

impl<'a> Heading<'a> {
    /// Heading of a column of words.
    pub const fn words(name: &'a str) -> Self {
        Self { name, is_number: false, meaning: None }
    }

    /// Heading of a column of numbers.
    pub const fn number(name: &'a str, meaning: Option<&'static str>) -> Self {
        Self { name, is_number: true, meaning }
    }
}

/// The table, in a box that scrolls sideways where it is wider than the page.
pub(super) fn table<'a>(
    body: &mut Markup,
    title: &str,
    headings: impl IntoIterator<Item = Heading<'a>>,
    rows: impl FnOnce(&mut Markup),
) {
    let scrolled = [("class", "scrolled"), ("tabindex", "0"), ("role", "region"), ("aria-label", title)];
    body.element("div", &scrolled, |body| {
        body.element("table", &[("class", "sortable")], |table| {
            table.leaf("caption", &[], title).fixed("<thead><tr>");
            for heading in headings {
                let mut attributes = vec![("scope", "col")];
                attributes.extend(heading.is_number.then_some(("class", "number")));
                attributes.extend(heading.meaning.map(|meaning| ("title", meaning)));
                table.leaf("th", &attributes, heading.name);
            }
            table.fixed("</tr></thead>\n<tbody>\n");
            rows(table);
            table.fixed("</tbody>");
        });
    });
    body.fixed("\n");
}
