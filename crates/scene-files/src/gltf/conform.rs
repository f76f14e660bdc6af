//! Check of a plain JSON tree against the schema of the format; a fault has its place and value.

use std::collections::{BTreeSet, HashMap};
use std::fmt::{self, Display};
use std::path::Path;

use ::gltf::json::Value;

use super::shape::{Kind, Member, ROOT};
use rasray_scene::SceneError;
use rasray_scene::text::shown;

/// Contents of a tree that have no place in the typed tree.
#[derive(Default)]
pub(super) struct Found {
    /// Values of enumerations that the format does not know, by their place, as written.
    pub unknown: HashMap<String, String>,
    /// Names of all extensions of elements.
    pub extensions: BTreeSet<String>,
}

/// Checks the tree of a whole file, and converts it to the form that the typed tree accepts.
///
/// # Errors
/// [`SceneError::Invalid`] at the first value that has the wrong kind, or that is missing.
pub(super) fn conform(path: &Path, tree: &mut Value) -> Result<Found, SceneError> {
    let mut found = Found::default();
    let file = Place { above: None, step: Step::Member("") };
    check(tree, &ROOT, &file, &mut found)
        .map_err(|(place, reason)| SceneError::invalid(path, place, reason))?;
    Ok(found)
}

/// Place of a value, formatted only for messages. The depth is bounded by that of the JSON parser.
struct Place<'a> {
    above: Option<&'a Place<'a>>,
    step: Step<'a>,
}

enum Step<'a> {
    Member(&'a str),
    Element(usize),
}

impl Place<'_> {
    fn member<'a>(&'a self, name: &'a str) -> Place<'a> {
        Place { above: Some(self), step: Step::Member(name) }
    }

    fn element(&self, index: usize) -> Place<'_> {
        Place { above: Some(self), step: Step::Element(index) }
    }
}

impl Display for Place<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Some(above) = self.above else { return Ok(()) };
        above.fmt(f)?;
        match self.step {
            Step::Element(index) => write!(f, "[{index}]"),
            Step::Member(name) if above.above.is_none() => f.write_str(name),
            Step::Member(name) => write!(f, ".{name}"),
        }
    }
}

/// Fault: its place and its description.
type Fault = (String, String);

fn check(value: &mut Value, kind: &Kind, place: &Place<'_>, found: &mut Found) -> Result<(), Fault> {
    match kind {
        Kind::Whole => {
            let whole = whole(value, place)?;
            if whole > u64::from(u32::MAX) {
                return Err((place.to_string(), format!("{whole} is too large")));
            }
        }
        Kind::Size => drop(whole(value, place)?),
        Kind::Number if value.is_number() => {}
        Kind::Number => return Err(must_be("a number", value, place)),
        Kind::Numbers(count) => {
            let items = value.as_array().filter(|items| items.len() == *count);
            if !items.is_some_and(|items| items.iter().all(Value::is_number)) {
                return Err(must_be(&format!("{count} numbers"), value, place));
            }
        }
        Kind::Text if value.is_string() => {}
        Kind::Text => return Err(must_be("text", value, place)),
        Kind::Flag if value.is_boolean() => {}
        Kind::Flag => return Err(must_be("true or false", value, place)),
        Kind::Word(known) => {
            if !value.as_str().is_some_and(|word| known.contains(&word)) {
                return Err(must_be(&format!("one of {}", known.join(", ")), value, place));
            }
        }
        Kind::Code(known) => {
            if !whole(value, place).is_ok_and(|code| known.contains(&code)) {
                let known: Vec<String> = known.iter().map(u64::to_string).collect();
                return Err(must_be(&format!("one of {}", known.join(", ")), value, place));
            }
        }
        Kind::OpenWord(known) => match value.as_str() {
            Some(word) if known.contains(&word) => {}
            Some(_) => note_unknown(value, place, found),
            None => return Err(must_be("text", value, place)),
        },
        Kind::OpenCode(known) => {
            if !known.contains(&whole(value, place)?) {
                note_unknown(value, place, found);
            }
        }
        Kind::List(kind) => {
            let Some(items) = value.as_array_mut() else { return Err(must_be("an array", value, place)) };
            for (i, item) in items.iter_mut().enumerate() {
                check(item, kind, &place.element(i), found)?;
            }
        }
        Kind::Map(kind) => {
            must_be_object(value, place)?;
            let Some(members) = value.as_object_mut() else { return Ok(()) };
            members.retain(|_, member| !member.is_null());
            for (name, member) in members {
                check(member, kind, &place.member(name), found)?;
            }
        }
        Kind::Object(members) => check_members(value, members, place, found)?,
        Kind::Extensions(members) => {
            found.extensions.extend(value.as_object().into_iter().flat_map(|names| names.keys().cloned()));
            check_members(value, members, place, found)?;
        }
    }
    Ok(())
}

fn check_members(
    value: &mut Value,
    members: &[Member],
    place: &Place<'_>,
    found: &mut Found,
) -> Result<(), Fault> {
    must_be_object(value, place)?;
    let Some(object) = value.as_object_mut() else { return Ok(()) };
    for Member { name, kind, required } in members {
        if object.get(*name).is_some_and(Value::is_null) {
            object.remove(*name);
        }
        match object.get_mut(*name) {
            Some(member) => check(member, kind, &place.member(name), found)?,
            None if *required => return Err((place.member(name).to_string(), "is missing".to_owned())),
            None => {}
        }
    }
    Ok(())
}

fn must_be_object(value: &Value, place: &Place<'_>) -> Result<(), Fault> {
    if value.is_object() { Ok(()) } else { Err(must_be("an object", value, place)) }
}

/// Reads a whole number that is not negative; `1.0` counts, and becomes `1`.
fn whole(value: &mut Value, place: &Place<'_>) -> Result<u64, Fault> {
    if let Some(whole) = value.as_u64() {
        return Ok(whole);
    }
    // The largest f64 below 2^64 is a whole number that u64 can hold.
    let written =
        value.as_f64().filter(|x| x.fract() == 0.0 && (0.0..18_446_744_073_709_551_616.0).contains(x));
    match written {
        Some(whole) => {
            *value = (whole as u64).into();
            Ok(whole as u64)
        }
        None => Err(must_be("a whole number that is not negative", value, place)),
    }
}

fn note_unknown(value: &Value, place: &Place<'_>, found: &mut Found) {
    found.unknown.insert(place.to_string(), shown(value));
}

fn must_be(what: &str, value: &Value, place: &Place<'_>) -> Fault {
    (place.to_string(), format!("must be {what}, is {}", shown(value)))
}
