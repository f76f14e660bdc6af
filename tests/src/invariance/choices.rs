use super::{Law, Subject, Value, law};

/// Whether a subject takes an option's value, alone or beside a value of one of `others`.
pub fn takes<'a>(subject: &Subject, mut others: impl Iterator<Item = &'a Law>, chosen: (&str, &str)) -> bool {
    subject.with(&[chosen]).is_some()
        || others.any(|other| {
            let beside = |choice: &&str| subject.with(&[(other.option, *choice), chosen]).is_some();
            other.option != chosen.0 && other.values.iter().any(beside)
        })
}

/// The options of a subject that may not change a hit, each with the values that it takes alone or beside one
/// other choice of these: pages go with paged lists only.
pub fn speed_options(subject: &Subject) -> Vec<(&'static str, Vec<&'static str>)> {
    let laws: Vec<_> = subject
        .spec
        .system()
        .options
        .iter()
        .filter_map(|option| law(option))
        .filter(|law| law.of(subject.kind) != Value::MayChange)
        .collect();
    let options = laws.iter().filter_map(|law| {
        let all = laws.iter().copied();
        let values: Vec<_> = law
            .values
            .iter()
            .copied()
            .filter(|&value| takes(subject, all.clone(), (law.option, value)))
            .collect();
        (!values.is_empty()).then_some((law.option, values))
    });
    options.collect()
}

/// What pairs are made of: of an option some of whose values exclude others', that it stays as it is comes first.
pub fn choices<'a>(
    subject: &Subject,
    options: &[(&'a str, Vec<&'a str>)],
) -> Vec<(&'a str, Vec<Option<&'a str>>)> {
    let excludes = |option: &str, values: &[&str]| {
        options.iter().filter(|(other, _)| *other != option).any(|(other, others)| {
            let together = |value: &str, choice: &str| subject.with(&[(option, value), (other, choice)]);
            values.iter().any(|value| others.iter().any(|choice| together(value, choice).is_none()))
        })
    };
    let with_default = |(option, values): &(&'a str, Vec<&'a str>)| {
        let default = excludes(option, values).then_some(None);
        (*option, default.into_iter().chain(values.iter().copied().map(Some)).collect())
    };
    options.iter().map(with_default).collect()
}
