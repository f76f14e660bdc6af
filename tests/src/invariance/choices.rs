use rasray_systems::StructureOption;

use super::Subject;

/// True if a subject accepts an option's value, alone or together with a value of one of `others`.
pub fn takes(
    subject: &Subject,
    mut others: impl Iterator<Item = &'static StructureOption>,
    chosen: (&str, &str),
) -> bool {
    subject.with(&[chosen]).is_some()
        || others.any(|other| {
            let nearby = |choice: &&str| subject.with(&[(other.row.name, *choice), chosen]).is_some();
            other.row.name != chosen.0 && other.row.tried().iter().any(nearby)
        })
}

/// Returns the options of a subject that may not change a hit, each with the values that it accepts alone or
/// together with one other of these options: pages go only with paged lists. Values that make a structure of
/// another kind are left out: a payload that does not go with conservative lists takes fragments alone.
pub fn speed_options(subject: &Subject) -> Vec<(&'static str, Vec<&'static str>)> {
    let mut rows = subject.spec.system().options();
    rows.retain(|row| !row.hits.may_change(subject.kind));
    let options = rows.iter().filter_map(|StructureOption { row, .. }| {
        let mut values = row.tried();
        let keeps_kind = |chosen: &[(&str, &str)]| {
            subject.with(chosen).is_some_and(|changed| changed.spec.kind().ok() == Some(subject.kind))
        };
        values.retain(|value| {
            let others = rows.iter().filter(|other| other.row.name != row.name);
            let mut choices =
                others.flat_map(|other| other.row.tried().into_iter().map(|choice| (other.row.name, choice)));
            keeps_kind(&[(row.name, *value)])
                || choices.any(|choice| keeps_kind(&[choice, (row.name, *value)]))
        });
        (!values.is_empty()).then_some((row.name, values))
    });
    options.collect()
}

/// Returns the choices for pairs. If values of an option exclude values of others, the first choice is to
/// leave it unset.
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
