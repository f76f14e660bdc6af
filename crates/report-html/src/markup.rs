//! Markup of HTML, in which all text that does not come from this program's source is escaped.

use rasray_report::{escaped, json_escaped};
use serde_json::Value;
use std::fmt::{Display, Write};

/// Growing piece of a page. Only `&'static str` is added unchanged, so that no name of a scene, a device or a
/// file can become markup.
#[derive(Debug, Default)]
pub(super) struct Markup {
    text: String,
}

impl Markup {
    /// Adds markup from this program's source, unchanged.
    pub fn fixed(&mut self, markup: &'static str) -> &mut Self {
        self.text += markup;
        self
    }

    /// Adds text from any source, escaped.
    pub fn text(&mut self, text: impl Display) -> &mut Self {
        escape_into(&mut self.text, &text.to_string());
        self
    }

    /// Adds `<name attributes>content</name>`; attribute values are escaped.
    pub fn element(
        &mut self,
        name: &'static str,
        attributes: &[(&'static str, &str)],
        content: impl FnOnce(&mut Self),
    ) -> &mut Self {
        self.empty(name, attributes);
        content(self);
        _ = write!(self.text, "</{name}>");
        self
    }

    /// Adds an element that holds only text, escaped.
    pub fn leaf(
        &mut self,
        name: &'static str,
        attributes: &[(&'static str, &str)],
        text: impl Display,
    ) -> &mut Self {
        self.element(name, attributes, |inner| {
            inner.text(text);
        })
    }

    /// Adds `<name attributes>` without an end tag, such as `img`.
    pub fn empty(&mut self, name: &'static str, attributes: &[(&'static str, &str)]) -> &mut Self {
        _ = write!(self.text, "<{name}");
        for (key, value) in attributes {
            _ = write!(self.text, " {key}=\"");
            escape_into(&mut self.text, value);
            self.text.push('"');
        }
        self.text.push('>');
        self
    }

    /// Adds data for scripts of the page, in an element that is not executed.
    pub fn data(&mut self, id: &'static str, value: &Value) -> &mut Self {
        _ = write!(self.text, "<script type=\"application/json\" id=\"{id}\">");
        // In JSON these characters occur only in strings, where the escape has the same meaning; without
        // these characters no end tag and no comment can begin.
        for character in json_escaped(&value.to_string()).chars() {
            match character {
                '<' => self.text += "\\u003c",
                '>' => self.text += "\\u003e",
                '&' => self.text += "\\u0026",
                other => self.text.push(other),
            }
        }
        self.fixed("</script>\n")
    }

    /// Adds a script of this program.
    pub fn script(&mut self, source: &'static str) -> &mut Self {
        self.fixed("<script>\n").fixed(source).fixed("</script>\n")
    }

    /// Adds a script of a library that is compiled into this program.
    pub fn library(&mut self, source: &str) -> &mut Self {
        self.fixed("<script>\n");
        self.text += source;
        self.fixed("</script>\n")
    }

    /// Adds another piece of markup, which is escaped already.
    pub fn append(&mut self, other: &Markup) -> &mut Self {
        self.text += &other.text;
        self
    }

    /// Returns the text of the markup.
    pub fn into_string(self) -> String {
        self.text
    }
}

fn escape_into(target: &mut String, text: &str) {
    for character in escaped(text).chars() {
        match character {
            '&' => *target += "&amp;",
            '<' => *target += "&lt;",
            '>' => *target += "&gt;",
            '"' => *target += "&quot;",
            '\'' => *target += "&#39;",
            other => target.push(other),
        }
    }
}

/// Escapes text for labels of plots, because the library interprets a few tags in labels.
pub(super) fn plot_text(text: &str) -> String {
    escaped(text).replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;")
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    #[test]
    fn text_and_attributes_cannot_become_markup() {
        let mut page = Markup::default();
        page.element("p", &[("title", "\"><script>")], |inner| {
            inner.text("</p><script>alert('x')&");
        });
        assert_eq!(
            page.into_string(),
            "<p title=\"&quot;&gt;&lt;script&gt;\">&lt;/p&gt;&lt;script&gt;alert(&#39;x&#39;)&amp;</p>"
        );
    }

    #[test]
    fn data_reads_back_and_cannot_end_its_element() {
        let value = json!({"name": "</script><!--&\u{2028}", "count": 3});
        let mut page = Markup::default();
        page.data("plots", &value);
        let text = page.into_string();
        let inner = text
            .strip_prefix("<script type=\"application/json\" id=\"plots\">")
            .and_then(|rest| rest.strip_suffix("</script>\n"))
            .expect("one element");
        assert!(!inner.contains(['<', '>', '&']), "{inner}");
        assert_eq!(serde_json::from_str::<Value>(inner).expect("JSON"), value);
    }

    #[test]
    fn labels_of_plots_hold_no_tags() {
        assert_eq!(plot_text("<a href=x>&"), "&lt;a href=x&gt;&amp;");
    }
}
