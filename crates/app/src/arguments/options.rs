//! Options of the command line, made from their rows.

use crate::hints::with_flags;
use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};
use clap::{Arg, ArgAction, ArgMatches};
use rasray_options::{OptionRow, Unit, Value, Values};

/// Makes a parser that reads one of these values by its name; `told` returns the name and the line of help of
/// a value.
pub fn choice<T: Copy + Send + Sync + 'static>(
    values: impl IntoIterator<Item = T>,
    told: fn(T) -> (&'static str, &'static str),
) -> impl TypedValueParser<Value = T> {
    let values: Vec<T> = values.into_iter().collect();
    let names: Vec<_> = values
        .iter()
        .map(|value| told(*value))
        .map(|(name, doc)| PossibleValue::new(name).help(with_flags(doc)))
        .collect();
    PossibleValuesParser::new(names).map(move |given| {
        let named = |value: &T| told(*value).0 == given;
        values.iter().copied().find(named).expect("only names of values are possible")
    })
}

/// Makes the argument of an option with its help, and the argument that stands for the option's value `off`,
/// if it has one.
pub fn arguments(row: &'static OptionRow, help: String) -> impl Iterator<Item = Arg> {
    let argument = Arg::new(row.name).long(row.name).help(with_flags(&help));
    let read = move |text: &str| row.values.parse(text);
    let argument = match row.values {
        Values::Words(words) => {
            let words = words.iter().map(|(word, doc)| PossibleValue::new(*word).help(with_flags(doc)));
            argument
                .value_name("WORD")
                .value_parser(PossibleValuesParser::new(words).try_map(move |word| read(&word)))
        }
        Values::Whole(..) => argument.value_name("N").value_parser(read),
        Values::Number(Unit::Metres, _) => argument.value_name("METRES").value_parser(read),
        Values::Number(Unit::Share, _) => argument.value_name("SHARE").value_parser(read),
        Values::Cells(_) => argument.value_name("WxH").value_parser(read),
        Values::Point => argument.value_name("X,Y,Z").allow_hyphen_values(true).value_parser(read),
    };
    let off = row.off_name.map(|name| {
        let off = Arg::new(name).long(name).action(ArgAction::SetTrue).conflicts_with(row.name);
        off.help(format!("Short for --{}=off", row.name))
    });
    let argument = match off {
        Some(_) => argument.num_args(0..=1).require_equals(true).default_missing_value("on"),
        None => argument,
    };
    std::iter::once(argument).chain(off)
}

/// Returns the value given for an option.
pub fn given(row: &OptionRow, matches: &ArgMatches) -> Option<Value> {
    let off = row.off_name.is_some_and(|name| matches.get_flag(name)).then_some(Value::Word("off"));
    matches.get_one::<Value>(row.name).copied().or(off)
}
