//! Parameters of a built-in scene: the part of its name after the colon.

use std::ops::RangeInclusive;

use crate::SceneError;
use crate::nearest::nearest;

/// Parameters as written; each is taken out once by the scene that knows it.
pub(super) struct Parameters {
    spec: String,
    /// Value without a key, as in `spheres:10k`.
    positional: Option<String>,
    named: Vec<(String, String)>,
    /// Keys that the scene asked for, which are the keys that it has.
    known: Vec<String>,
}

impl Parameters {
    /// Splits `key=value,key=value`; one value without a key may stand in front.
    pub fn parse(spec: &str, rest: Option<&str>) -> Result<Self, SceneError> {
        let mut parsed =
            Self { spec: spec.to_owned(), positional: None, named: Vec::new(), known: Vec::new() };
        let Some(rest) = rest else { return Ok(parsed) };
        for (place, part) in rest.split(',').enumerate() {
            let part = part.trim();
            match part.split_once('=') {
                Some((key, value)) => {
                    let key = key.trim();
                    if parsed.named.iter().any(|(other, _)| other == key) {
                        return Err(parsed.error(format!("parameter `{key}` is given twice; keep one")));
                    }
                    parsed.named.push((key.to_owned(), value.trim().to_owned()));
                }
                None if part.is_empty() => {
                    return Err(parsed.error("a parameter is empty; write name:key=value".to_owned()));
                }
                None if place == 0 => parsed.positional = Some(part.to_owned()),
                None => {
                    return Err(parsed.error(format!("`{part}` has no key; write key={part}")));
                }
            }
        }
        Ok(parsed)
    }

    /// Gives the value without a key the name `key`.
    pub fn name_positional(&mut self, key: &str) -> Result<(), SceneError> {
        if let Some(value) = self.positional.take() {
            if self.named.iter().any(|(other, _)| other == key) {
                return Err(self.error(format!("parameter `{key}` is given twice; keep one")));
            }
            self.named.push((key.to_owned(), value));
        }
        Ok(())
    }

    /// Takes a real number within `range`.
    pub fn number(&mut self, key: &str, default: f64, range: RangeInclusive<f64>) -> Result<f64, SceneError> {
        let Some(text) = self.take(key) else { return Ok(default) };
        match text.parse::<f64>() {
            Ok(value) if range.contains(&value) => Ok(value),
            _ => Err(self.out_of_range(key, &text, range.start(), range.end())),
        }
    }

    /// Takes a whole number within `range`; the suffixes `k` and `M` are understood.
    pub fn count(&mut self, key: &str, default: u64, range: RangeInclusive<u64>) -> Result<u64, SceneError> {
        let Some(text) = self.take(key) else { return Ok(default) };
        let (digits, factor) = match text.as_bytes().last() {
            Some(b'k' | b'K') => (&text[..text.len() - 1], 1.0e3),
            Some(b'm' | b'M') => (&text[..text.len() - 1], 1.0e6),
            _ => (text.as_str(), 1.0),
        };
        // The cast saturates for huge values and gives 0 for NaN; the range refuses both.
        let value = digits.parse::<f64>().map(|value| (value * factor).round() as u64);
        match value {
            Ok(value) if range.contains(&value) => Ok(value),
            _ => Err(self.out_of_range(key, &text, range.start(), range.end())),
        }
    }

    /// Takes one of a few words; the returned word is one of `choices` or the default.
    pub fn word<'a>(
        &mut self,
        key: &str,
        default: &'a str,
        choices: &[&'a str],
    ) -> Result<&'a str, SceneError> {
        let Some(text) = self.take(key) else { return Ok(default) };
        match choices.iter().find(|choice| **choice == text) {
            Some(choice) => Ok(choice),
            None => Err(self.error(format!("`{key}={text}`: must be one of {}", choices.join(", ")))),
        }
    }

    /// Refuses parameters that the scene did not take.
    pub fn finish(self) -> Result<(), SceneError> {
        if let Some((key, value)) = self.named.first() {
            let known = self.known.iter().map(String::as_str);
            let fix = match nearest(key, known) {
                Some(meant) => format!("did you mean `{meant}={value}`? "),
                None => String::new(),
            };
            return Err(self.error(format!("there is no parameter `{key}`; {fix}{}", self.what_there_is())));
        }
        if let Some(value) = &self.positional {
            let fix = match self.known.as_slice() {
                [only] => format!("write {only}={value}"),
                [] => self.what_there_is(),
                _ => format!("write key={value}; {}", self.what_there_is()),
            };
            return Err(self.error(format!("`{value}` has no key; {fix}")));
        }
        Ok(())
    }

    /// Lists the parameters that the scene has.
    fn what_there_is(&self) -> String {
        match self.known.as_slice() {
            [] => "the scene takes none".to_owned(),
            known => format!("the scene takes {}", known.join(", ")),
        }
    }

    fn take(&mut self, key: &str) -> Option<String> {
        self.known.push(key.to_owned());
        let place = self.named.iter().position(|(other, _)| other == key)?;
        Some(self.named.swap_remove(place).1)
    }

    fn out_of_range(
        &self,
        key: &str,
        text: &str,
        low: &dyn std::fmt::Display,
        high: &dyn std::fmt::Display,
    ) -> SceneError {
        self.error(format!("`{key}={text}`: must be a number from {low} to {high}"))
    }

    fn error(&self, problem: String) -> SceneError {
        SceneError::Builtin { spec: self.spec.clone(), problem }
    }
}
