//! Numbers that a paper published, beside those that its plan has measured.

use crate::plan::{PlanError, line, word_of};
use rasray_report::{Experiment, Row, number};
use std::collections::BTreeMap;
use toml::Value;

/// Published number of a paper, and the results with which it is compared.
#[derive(Clone, Debug, PartialEq)]
pub struct Claim {
    /// Statement of the paper, in one line.
    pub says: String,
    /// Published number, in the unit of the result; a ratio has no unit.
    pub published: f64,
    /// Name of the result, as in [`Row::results`].
    pub measure: String,
    /// Settings that select the rows.
    of: BTreeMap<String, String>,
    /// Settings in which the divisor of a ratio differs from the row that it divides. `None` if the claim is
    /// about values, not ratios.
    over: Option<BTreeMap<String, String>>,
    /// Reason why our number differs, and other remarks; may be empty.
    pub note: String,
}

/// Our numbers beside the paper's.
#[derive(Clone, Debug, PartialEq)]
pub struct Finding {
    /// Values, or ratios, of all selected rows, in ascending order.
    pub ours: Vec<f64>,
    /// Middle of these numbers: the geometric mean of ratios, the median of values.
    pub middle: f64,
    /// Middle divided by the published number.
    pub relation: f64,
    /// True if our ratio lies on the same side of 1 as the paper's. `None` for values, which depend on the
    /// machine.
    pub same_side: Option<bool>,
}

impl Claim {
    /// Reads a claim from a plan.
    ///
    /// # Errors
    /// A key is missing or unknown, or has a value of another kind.
    pub(crate) fn read(value: Value) -> Result<Self, PlanError> {
        let help = "a claim has says, published, measure, of, and may have over and note";
        let wrong = |message: String| PlanError::new(message, help);
        let Value::Table(mut table) = value else { return Err(wrong("a claim is no table".to_owned())) };
        let mut text = |name: &str| match table.remove(name) {
            Some(Value::String(text)) => Ok(line(&text)),
            Some(_) => Err(wrong(format!("'{name}' of a claim is no text"))),
            None => Ok(String::new()),
        };
        let (says, measure, note) = (text("says")?, text("measure")?, text("note")?);
        if says.is_empty() || measure.is_empty() {
            return Err(wrong("a claim says nothing or has no measure".to_owned()));
        }
        let published = match table.remove("published") {
            Some(Value::Float(number)) => number,
            Some(Value::Integer(number)) => number as f64,
            _ => return Err(wrong(format!("claim '{says}': 'published' is no number"))),
        };
        if !(published.is_finite() && published > 0.0) {
            return Err(wrong(format!("claim '{says}': 'published' is not above 0")));
        }
        let mut settings = |name: &str| match table.remove(name) {
            Some(Value::Table(settings)) => settings
                .iter()
                .map(|(name, value)| Some((name.clone(), word_of(value)?)))
                .collect::<Option<BTreeMap<_, _>>>()
                .map(Some)
                .ok_or_else(|| wrong(format!("claim '{says}': '{name}' has a value that is no setting's"))),
            Some(_) => Err(wrong(format!("claim '{says}': '{name}' is no table"))),
            None => Ok(None),
        };
        let (of, over) = (settings("of")?.unwrap_or_default(), settings("over")?);
        if let Some(key) = table.keys().next() {
            return Err(wrong(format!("claim '{says}': '{key}' has no place in a claim")));
        }
        Ok(Self { says, published, measure, of, over, note })
    }

    /// Compares the claim with the rows of an experiment. Returns `None` if no row bears on the claim.
    pub fn find(&self, experiment: &Experiment) -> Option<Finding> {
        let varied = experiment.varied();
        let has = |row: &Row, wanted: &BTreeMap<String, String>| {
            wanted.iter().all(|(name, value)| row.setting(name) == value)
        };
        let value = |row: &Row| row.results.get(&self.measure).copied();
        let rows = || experiment.rows.iter().filter(|row| has(row, &self.of));
        let mut ours: Vec<f64> = match &self.over {
            None => rows().filter_map(value).collect(),
            Some(over) => {
                // A twin of a row is alike in all settings that vary, except those that define the twin.
                let decides = |name: &&&str| !over.contains_key(**name);
                let is_twin = |row: &Row, other: &Row| {
                    varied.iter().filter(decides).all(|name| is_alike(row, other, name))
                };
                let ratio = |row: &Row| {
                    let twin =
                        experiment.rows.iter().find(|other| has(other, over) && is_twin(row, other))?;
                    Some(value(row)? / value(twin)?)
                };
                rows().filter_map(ratio).collect()
            }
        };
        ours.retain(|one| one.is_finite());
        ours.sort_by(f64::total_cmp);
        if ours.is_empty() {
            return None;
        }
        let count = ours.len();
        let is_ratio = self.over.is_some();
        let middle = if is_ratio && ours[0] > 0.0 {
            (ours.iter().map(|one| one.ln()).sum::<f64>() / count as f64).exp()
        } else {
            0.5 * (ours[(count - 1) / 2] + ours[count / 2])
        };
        let same_side = is_ratio.then_some((middle > 1.0) == (self.published > 1.0));
        Some(Finding { relation: middle / self.published, ours, middle, same_side })
    }
}

impl Finding {
    /// Returns the middle, with the smallest and largest number if there are several.
    pub fn words(&self) -> String {
        match &self.ours[..] {
            [least, .., most] => {
                format!("{} ({} to {})", number(self.middle), number(*least), number(*most))
            }
            _ => number(self.middle),
        }
    }
}

/// Returns true if two rows are alike in a setting. An option that only one of two systems or integrators
/// takes does not make rows different.
fn is_alike(row: &Row, other: &Row, name: &str) -> bool {
    let is_option = |row: &Row| {
        let asked = row.report.cell.as_ref().map(|cell| &cell.depends_on);
        let of_image = asked.and_then(|asked| asked.image.as_ref());
        asked.is_some_and(|asked| asked.options.contains_key(name))
            || of_image.is_some_and(|image| image.options.contains_key(name))
    };
    match (row.settings.get(name), other.settings.get(name)) {
        (Some(one), Some(two)) => one == two,
        (None, None) => true,
        _ => is_option(row) || is_option(other),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use rasray_report::{Device, Origin, Report, SceneRecord};

    fn row(scene: &str, inline: &str, ms: f64) -> Row {
        let settings = [("scene", scene), ("inline", inline)];
        let settings = settings.map(|(name, value)| (name.to_owned(), value.to_owned()));
        let report = Report::new(Origin::default(), Device::default(), SceneRecord::default(), Vec::new());
        let results = BTreeMap::from([("trace_ms".to_owned(), ms)]);
        Row { key: String::new(), settings: settings.into(), results, report }
    }

    fn claim(text: &str) -> Result<Claim, PlanError> {
        Claim::read(Value::Table(text.parse().expect("TOML")))
    }

    const DECOUPLED: &str = "says = \"decoupling\"\npublished = 1.1\nmeasure = \"trace_ms\"\n\
                             of = { inline = \"on\" }\nover = { inline = \"off\" }";

    #[test]
    fn rows_are_divided_by_their_twins() {
        let rows = vec![
            row("a", "on", 20.0),
            row("b", "off", 2.0),
            row("a", "off", 10.0),
            row("b", "on", 1.0),
            row("c", "on", 5.0),
        ];
        let experiment = Experiment { name: String::new(), rows };
        let found = claim(DECOUPLED).expect("valid").find(&experiment).expect("two pairs");
        assert_eq!((found.ours.clone(), found.middle), (vec![0.5, 2.0], 1.0));
        assert_eq!((found.same_side, found.words()), (Some(false), "1.00 (0.500 to 2.00)".to_owned()));
        let value = "says = \"s\"\npublished = 4\nmeasure = \"trace_ms\"\nof = { scene = \"a\" }";
        let found = claim(value).expect("valid").find(&experiment).expect("two rows");
        assert_eq!((found.middle, found.relation, found.same_side), (15.0, 3.75, None));
        let none = value.replace("trace_ms", "build_ms");
        assert_eq!(claim(&none).expect("valid").find(&experiment), None);
    }

    #[test]
    fn what_is_wrong_with_a_claim_is_named() {
        let without = |line: &str| DECOUPLED.replace(line, "");
        for (text, expected) in [
            (without("says = \"decoupling\""), "says nothing"),
            (without("measure = \"trace_ms\""), "measure"),
            (without("published = 1.1"), "'published'"),
            (DECOUPLED.replace("1.1", "0"), "above 0"),
            (DECOUPLED.replace("1.1", "\"1.1\""), "no number"),
            (format!("{DECOUPLED}\nother = 1"), "'other'"),
            (format!("{DECOUPLED}\nnote = 1"), "'note'"),
            (DECOUPLED.replace("{ inline = \"on\" }", "{ inline = [] }"), "'of'"),
            (DECOUPLED.replace("{ inline = \"on\" }", "3"), "'of'"),
        ] {
            let error = claim(&text).expect_err(&text);
            assert!(error.to_string().contains(expected), "{text}: {error}");
        }
        assert!(Claim::read(Value::Integer(1)).is_err());
    }
}
