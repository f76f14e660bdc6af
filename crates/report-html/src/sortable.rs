//! Table that a click on a heading sorts.

use super::markup::Markup;

/// Heading of a column.
#[derive(Clone, Copy)]
pub(super) struct Heading<'a> {
    pub name: &'a str,
    /// True for a column of numbers, which are aligned to the right.
    pub is_number: bool,
    /// Meaning of the column, shown where a pointer rests on the heading.
    pub meaning: Option<&'static str>,
}

impl<'a> Heading<'a> {
    /// Makes the heading of a column of words.
    pub const fn words(name: &'a str) -> Self {
        Self { name, is_number: false, meaning: None }
    }

    /// Makes the heading of a column of numbers.
    pub const fn number(name: &'a str, meaning: Option<&'static str>) -> Self {
        Self { name, is_number: true, meaning }
    }
}

/// Writes the table, in a box that scrolls sideways if the table is wider than the page.
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
