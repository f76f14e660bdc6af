//! Plans in TOML: experiments, each a list of comparisons.

use crate::claim::Claim;
use rasray_report::COLUMNS;
use std::collections::BTreeMap;
use toml::{Table, Value};

/// Error for a plan that cannot be read, in words.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{message}")]
pub struct PlanError {
    message: String,
    help: String,
}

impl PlanError {
    pub(crate) fn new(message: impl Into<String>, help: impl Into<String>) -> Self {
        Self { message: message.into(), help: help.into() }
    }

    /// Returns advice for the author of the plan, in one sentence.
    pub fn help(&self) -> &str {
        &self.help
    }
}

/// Plan: experiments under a title.
#[derive(Clone, Debug, PartialEq)]
pub struct Plan {
    /// Title in one line; `Campaign` if the plan has none.
    pub title: String,
    /// Remarks, such as how the plan's scenes differ from those of a paper; may be empty.
    pub about: String,
    /// Results of the plan and the reasons for them; may be empty.
    pub discussion: String,
    /// Experiments, in the order of the file.
    pub experiments: Vec<ExperimentPlan>,
}

/// Experiment: comparisons that are shown together.
#[derive(Clone, Debug, PartialEq)]
pub struct ExperimentPlan {
    /// Name in one line, unique in the plan.
    pub name: String,
    /// Comparisons: every combination of the lists of options.
    pub comparisons: Vec<ComparisonPlan>,
    /// Cells that are left out of the comparisons.
    pub exclusions: Vec<Exclusion>,
    /// Published numbers with which the results are compared.
    pub claims: Vec<Claim>,
    /// Names of the results that the page of a paper shows; if empty, the page shows the usual ones.
    pub columns: Vec<String>,
}

/// Comparison of systems on a scene.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ComparisonPlan {
    /// Settings that all cells of the comparison have in common, by the names of options. Options with values
    /// that take turns are not among them.
    pub settings: BTreeMap<String, String>,
    /// Words of `rasray compare`, the scene first.
    pub words: Vec<String>,
}

/// Cells that are left out: those that have, for each setting, one of its values.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Exclusion(BTreeMap<String, Vec<String>>);

impl Exclusion {
    /// Returns true if a cell with these settings is left out.
    pub fn holds(&self, settings: &BTreeMap<String, String>) -> bool {
        self.0.iter().all(|(name, values)| settings.get(name).is_some_and(|value| values.contains(value)))
    }

    /// Returns the names of the settings that the exclusion looks at.
    pub fn names(&self) -> impl Iterator<Item = &str> {
        self.0.keys().map(String::as_str)
    }
}

impl std::fmt::Display for Exclusion {
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let settings = self.0.iter().map(|(name, values)| format!("{name} = {}", values.join(" or ")));
        write!(formatter, "{{ {} }}", settings.collect::<Vec<_>>().join(", "))
    }
}

/// Keys of an experiment that are not options.
const OWN: [&str; 6] = ["name", "exclude", "small", "claim", "columns", "with"];

/// Options that take several values at once, which take turns in one comparison.
const TOGETHER: [&str; 3] = ["systems", "presets", "ray-set"];

/// Options of a comparison that a plan cannot have, with advice.
const REFUSED: [(&str, &str); 17] = [
    ("report", FOLDER),
    ("html", FOLDER),
    ("markdown", FOLDER),
    ("save-rays", COMPARE),
    ("save-hits", COMPARE),
    ("hits-file", COMPARE),
    ("replay", COMPARE),
    ("check", COMPARE),
    ("full", COMPARE),
    ("resume", COMMAND),
    ("shard", COMMAND),
    ("device", COMMAND),
    ("validation", COMMAND),
    ("quiet", COMMAND),
    ("verbose", COMMAND),
    ("help", COMMAND),
    ("help-all", COMMAND),
];

const FOLDER: &str = "leave it out: all reports go to the folder of the campaign";
const COMPARE: &str = "leave it out: it is of single comparisons, `rasray compare`";
const COMMAND: &str = "leave it out, and say it on the command line";

impl Plan {
    /// Reads a plan. If `small` is true, the plan's settings for small sizes apply.
    ///
    /// # Errors
    /// The text is no TOML, a key is in the wrong place, a value is neither text, number, `true` nor `false`,
    /// an experiment has no name or no scene, or two experiments have one name.
    pub fn read(text: &str, small: bool) -> Result<Self, PlanError> {
        let file: Table = text.parse().map_err(|error: toml::de::Error| {
            PlanError::new(error.to_string().trim_end(), "write it as docs/campaigns.md shows")
        })?;
        let (mut title, mut about, mut discussion) = ("Campaign".to_owned(), String::new(), String::new());
        let (mut common, mut smaller, mut experiments) = (Table::new(), Table::new(), Vec::new());
        for (key, value) in file {
            match (key.as_str(), value) {
                ("title", Value::String(text)) => title = line(&text),
                ("about", Value::String(text)) => about = line(&text),
                ("discussion", Value::String(text)) => discussion = line(&text),
                ("common", Value::Table(table)) => common = table,
                ("small", Value::Table(table)) => smaller = table,
                ("experiment", Value::Array(list)) => experiments = list,
                _ => {
                    let help = "a plan has title, about, discussion, [common], [small] and one [[experiment]] or several";
                    return Err(PlanError::new(format!("'{key}' has no place at the top of a plan"), help));
                }
            }
        }
        if let Some(key) = [&common, &smaller].into_iter().flat_map(Table::keys).find(|key| is_own(key)) {
            let message = format!("'{key}' is of an experiment, and neither of [common] nor of [small]");
            return Err(PlanError::new(message, "move it into an [[experiment]]"));
        }
        let mut read: Vec<ExperimentPlan> = Vec::new();
        for value in experiments {
            let Value::Table(own) = value else {
                return Err(PlanError::new(
                    "an experiment is no table",
                    "write [[experiment]] above its keys",
                ));
            };
            let mut all = common.clone();
            if small {
                all.extend(smaller.clone());
            }
            all.extend(own);
            let experiment = ExperimentPlan::read(all, small)?;
            if read.iter().any(|other| other.name == experiment.name) {
                let message = format!("two experiments have the name '{}'", experiment.name);
                return Err(PlanError::new(message, "give each a name of its own"));
            }
            read.push(experiment);
        }
        if read.is_empty() {
            return Err(PlanError::new("there is no experiment", "write one under [[experiment]]"));
        }
        Ok(Self { title, about, discussion, experiments: read })
    }

    /// Joins several plans to one, in their order. Each name of an experiment gets its plan's word and a
    /// colon before it.
    pub fn joined(title: &str, plans: impl IntoIterator<Item = (String, Self)>) -> Self {
        let named = |(word, plan): (String, Self)| {
            plan.experiments.into_iter().map(move |experiment| ExperimentPlan {
                name: format!("{word}: {}", experiment.name),
                ..experiment
            })
        };
        let experiments = plans.into_iter().flat_map(named).collect();
        Self { title: title.to_owned(), about: String::new(), discussion: String::new(), experiments }
    }

    /// Returns the comparisons in their order, each with the index of its experiment.
    pub fn comparisons(&self) -> impl Iterator<Item = (usize, &ComparisonPlan)> {
        self.experiments
            .iter()
            .enumerate()
            .flat_map(|(place, experiment)| experiment.comparisons.iter().map(move |one| (place, one)))
    }
}

impl ExperimentPlan {
    fn read(mut keys: Table, small: bool) -> Result<Self, PlanError> {
        let Some(Value::String(name)) = keys.remove("name") else {
            return Err(PlanError::new(
                "an experiment has no name",
                "write name = \"...\", one line of text",
            ));
        };
        let name = line(&name);
        let wrong =
            |error: PlanError| PlanError { message: format!("experiment '{name}': {error}"), ..error };
        match keys.remove("small") {
            Some(Value::Table(smaller)) if small => keys.extend(smaller),
            Some(Value::Table(_)) | None => {}
            Some(_) => {
                let error = PlanError::new("'small' is no table", "write small = { rays = 1000 }");
                return Err(wrong(error));
            }
        }
        let exclusions = exclusions(keys.remove("exclude")).map_err(wrong)?;
        let claims = match keys.remove("claim") {
            None => Vec::new(),
            Some(Value::Array(list)) => {
                list.into_iter().map(Claim::read).collect::<Result<_, _>>().map_err(wrong)?
            }
            Some(_) => {
                let error = PlanError::new("'claim' is no list", "write [[experiment.claim]]");
                return Err(wrong(error));
            }
        };
        let columns = columns(keys.remove("columns")).map_err(wrong)?;
        let sets = tables("with", keys.remove("with")).map_err(wrong)?;
        let mut comparisons = Vec::new();
        for own in if sets.is_empty() { vec![Table::new()] } else { sets } {
            let mut keys = keys.clone();
            keys.extend(own);
            comparisons.extend(combinations(&keys).map_err(wrong)?);
        }
        Ok(Self { name, comparisons, exclusions, claims, columns })
    }
}

fn columns(value: Option<Value>) -> Result<Vec<String>, PlanError> {
    let Some(value) = value else { return Ok(Vec::new()) };
    let names = words_of("columns", &value)?;
    let known = COLUMNS.map(|column| column.name);
    match names.iter().find(|name| !known.contains(&name.as_str())) {
        None => Ok(names),
        Some(name) => {
            let message = format!("'{name}' is none of the results that 'columns' can name");
            Err(PlanError::new(message, format!("they are {}", known.join(", "))))
        }
    }
}

fn is_own(key: &str) -> bool {
    OWN.contains(&key)
}

/// Returns the text in one line, with single spaces.
pub(crate) fn line(text: &str) -> String {
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}

/// Returns a list of tables, empty if the key is absent.
fn tables(key: &str, value: Option<Value>) -> Result<Vec<Table>, PlanError> {
    let shape = || {
        let help = format!("write {key} = [{{ ... }}, {{ ... }}]");
        PlanError::new(format!("'{key}' is no list of tables"), help)
    };
    let table = |value: Value| match value {
        Value::Table(table) => Ok(table),
        _ => Err(shape()),
    };
    match value {
        None => Ok(Vec::new()),
        Some(Value::Array(list)) => list.into_iter().map(table).collect(),
        Some(_) => Err(shape()),
    }
}

fn exclusions(value: Option<Value>) -> Result<Vec<Exclusion>, PlanError> {
    let exclusion = |table: Table| {
        if table.is_empty() {
            let help = "name what is left out, or leave 'exclude' out";
            return Err(PlanError::new("an empty table in 'exclude' would leave out everything", help));
        }
        let values = |(key, value): (String, Value)| Ok((key.clone(), words_of(&key, &value)?));
        Ok(Exclusion(table.into_iter().map(values).collect::<Result<_, PlanError>>()?))
    };
    tables("exclude", value)?.into_iter().map(exclusion).collect()
}

/// Returns the value of an option or a setting as a word, or `None` for a list, a table or the like.
pub(crate) fn word_of(value: &Value) -> Option<String> {
    match value {
        Value::String(text) => Some(text.clone()),
        Value::Integer(number) => Some(number.to_string()),
        // A number is written without an exponent, and without a fraction if it is whole.
        Value::Float(number) if number.is_finite() => Some(number.to_string()),
        Value::Boolean(is) => Some(is.to_string()),
        _ => None,
    }
}

/// Returns the values of a key as words. A single value counts as a list of one.
fn words_of(key: &str, value: &Value) -> Result<Vec<String>, PlanError> {
    let word = |value: &Value| {
        word_of(value).ok_or_else(|| {
            let help = "values are text, numbers, true or false, or a list of these";
            PlanError::new(format!("'{key}' has a value that is no option's"), help)
        })
    };
    match value {
        Value::Array(list) if list.is_empty() => {
            Err(PlanError::new(format!("'{key}' is an empty list"), "give it a value, or leave it out"))
        }
        Value::Array(list) => list.iter().map(word).collect(),
        one => Ok(vec![word(one)?]),
    }
}

/// Returns every combination of the values of keys, except those whose values take turns in one comparison.
/// The last key changes fastest.
fn combinations(keys: &Table) -> Result<Vec<ComparisonPlan>, PlanError> {
    for (key, help) in REFUSED {
        if keys.contains_key(key) {
            return Err(PlanError::new(format!("'{key}' has no place in a plan"), help));
        }
    }
    if !keys.contains_key("scene") {
        return Err(PlanError::new("there is no scene", "write scene = \"cornell\", or a list of scenes"));
    }
    let mut all = vec![Vec::new()];
    for (key, value) in keys {
        let words = words_of(key, value)?;
        // Values of an option that is addressed to one system take turns as well.
        let choices =
            if TOGETHER.contains(&key.as_str()) || key.contains('.') { vec![words.join(",")] } else { words };
        all = all
            .into_iter()
            .flat_map(|chosen: Vec<(&str, String)>| {
                choices.iter().map(move |word| {
                    let mut chosen = chosen.clone();
                    chosen.push((key, word.clone()));
                    chosen
                })
            })
            .collect();
    }
    Ok(all.into_iter().map(comparison).collect())
}

/// Returns true if the values of a key take turns in one comparison.
fn takes_turns(key: &str) -> bool {
    TOGETHER.contains(&key) || key.contains('.')
}

fn comparison(chosen: Vec<(&str, String)>) -> ComparisonPlan {
    let scene = chosen.iter().filter(|(key, _)| *key == "scene").map(|(_, word)| word.clone());
    let mut words: Vec<_> = scene.collect();
    for (key, word) in chosen.iter().filter(|(key, _)| *key != "scene") {
        match (key.contains('.'), word.as_str()) {
            (true, _) => words.push(format!("{key}={word}")),
            (false, "true") => words.push(format!("--{key}")),
            (false, "false") => {}
            (false, word) => words.push(format!("--{key}={word}")),
        }
    }
    let of_all = chosen.into_iter().filter(|(key, _)| !takes_turns(key));
    let settings = of_all.map(|(key, word)| (key.to_owned(), word)).collect();
    ComparisonPlan { settings, words }
}

#[cfg(test)]
mod tests {
    use super::*;

    const PLAN: &str = r#"
        title = """Two  lines
        of title"""
        [common]
        systems = ["mmrt", "bvh"]
        repetitions = 3
        [small]
        repetitions = 1
        [[experiment]]
        name = "Storages"
        scene = ["cornell", "walker"]
        time = [0, 0.5]
        "mmrt.storage" = ["ll", "dll"]
        image = true
        keep = false
        exclude = [{ scene = "walker", storage = ["dll", "llb"] }]
        small = { scene = "cornell" }
        [[experiment]]
        name = "Rays"
        scene = "cornell"
        repetitions = 7
    "#;

    #[test]
    fn a_plan_is_every_combination_of_its_lists() {
        let plan = Plan::read(PLAN, false).expect("valid");
        assert_eq!(plan.title, "Two lines of title");
        let words: Vec<_> = plan.comparisons().map(|(place, one)| (place, one.words.join(" "))).collect();
        let first = |scene: &str, time: &str| {
            let rest = "mmrt.storage=ll,dll --image";
            (0, format!("{scene} --systems=mmrt,bvh --repetitions=3 --time={time} {rest}"))
        };
        assert_eq!(
            words,
            [
                first("cornell", "0"),
                first("cornell", "0.5"),
                first("walker", "0"),
                first("walker", "0.5"),
                (1, "cornell --systems=mmrt,bvh --repetitions=7".to_owned()),
            ]
        );
        assert_eq!(plan.experiments[0].comparisons[1].settings["time"], "0.5");
    }

    #[test]
    fn small_sizes_take_the_place_of_full_ones() {
        let plan = Plan::read(PLAN, true).expect("valid");
        let words: Vec<_> = plan.comparisons().map(|(_, one)| one.words.join(" ")).collect();
        // Options of an experiment itself take precedence over those that all experiments have.
        assert_eq!(words.len(), 3);
        assert!(words[0].contains("--repetitions=1") && words[2].contains("--repetitions=7"), "{words:?}");
        assert!(words.iter().all(|words| words.starts_with("cornell ")), "{words:?}");
    }

    #[test]
    fn sets_of_options_that_go_together_take_the_place_of_combinations() {
        let text = "[[experiment]]\nname = \"a\"\nscene = \"cornell\"\nspp = 4\n\
                    with = [{ \"hu.march\" = \"exact\" }, { \"hu.samples\" = [1, 3], spp = [8, 9] }]";
        let plan = Plan::read(text, false).expect("valid");
        let words: Vec<_> = plan.comparisons().map(|(_, one)| one.words.join(" ")).collect();
        let sampled = |spp| format!("cornell --spp={spp} hu.samples=1,3");
        assert_eq!(words, ["cornell --spp=4 hu.march=exact".to_owned(), sampled(8), sampled(9)]);
    }

    #[test]
    fn what_has_all_settings_of_an_exclusion_is_left_out() {
        let plan = Plan::read(PLAN, false).expect("valid");
        let [exclusion] = &plan.experiments[0].exclusions[..] else { panic!("one exclusion") };
        let of = |scene: &str, storage: Option<&str>| {
            let own = [Some(("scene", scene)), storage.map(|storage| ("storage", storage))];
            let own = own.into_iter().flatten().map(|(name, value)| (name.to_owned(), value.to_owned()));
            exclusion.holds(&own.collect())
        };
        assert!(of("walker", Some("dll")) && of("walker", Some("llb")));
        assert!(!of("walker", Some("ll")) && !of("cornell", Some("dll")) && !of("walker", None));
        assert_eq!(exclusion.names().collect::<Vec<_>>(), ["scene", "storage"]);
    }

    #[test]
    fn what_is_wrong_is_named() {
        let with = |keys: &str| format!("[[experiment]]\nname = \"a\"\nscene = \"cornell\"\n{keys}");
        let cases = [
            ("title = 3".to_owned(), "'title'"),
            ("other = 3".to_owned(), "'other'"),
            (String::new(), "no experiment"),
            ("experiment = [3]".to_owned(), "no table"),
            ("[[experiment]]\nscene = \"cornell\"".to_owned(), "no name"),
            ("[[experiment]]\nname = \"a\"".to_owned(), "no scene"),
            ("[common]\nname = \"a\"".to_owned(), "'name'"),
            (with("rays = []"), "'rays' is an empty list"),
            (with("rays = [[1]]"), "'rays'"),
            (with("rays = nan"), "'rays'"),
            (with("rays = 1979-05-27"), "'rays'"),
            (with("html = \"a\""), "'html'"),
            (with("shard = \"1/2\""), "'shard'"),
            (with("exclude = 3"), "'exclude'"),
            (with("exclude = [{}]"), "everything"),
            (with("small = 3"), "'small'"),
            (with("columns = \"rays\""), "'rays'"),
            (with("columns = []"), "'columns'"),
            (with("with = 3"), "'with'"),
            (with("with = [3]"), "'with'"),
            (with("claim = 3"), "'claim'"),
            (with("claim = [3]"), "no table"),
            (with("rays = 1\nrays = 2"), "duplicate key"),
            (with("") + &with(""), "two experiments"),
            ("title = \"".to_owned(), "1"),
        ];
        for (text, expected) in cases {
            let error = Plan::read(&text, false).expect_err(&text);
            assert!(error.to_string().contains(expected), "{text}: {error}");
            assert!(!error.help().is_empty());
        }
    }
}
