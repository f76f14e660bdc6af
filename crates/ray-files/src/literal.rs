//! Parser of Python literals: the header of a `.npy` file is the text of a Python dictionary.

use super::error::FormatError;

/// Largest depth of nesting of a header.
const DEPTH: usize = 8;

/// Python literal, of the kinds that array headers use.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Literal {
    /// Text in single or double quotes, without escapes.
    Text(String),
    /// A whole number of at least 0.
    Whole(u64),
    /// `True` or `False`.
    Truth(bool),
    /// Tuple, in parentheses.
    Tuple(Vec<Literal>),
    /// List, in brackets.
    List(Vec<Literal>),
    /// Dictionary, in braces.
    Dictionary(Vec<(Literal, Literal)>),
}

/// Reads the text of one literal; only spaces may follow it.
pub(super) fn parse(text: &str) -> Result<Literal, FormatError> {
    let mut reader = Reader { rest: text };
    let literal = reader.literal(0)?;
    reader.skip_spaces();
    if reader.rest.is_empty() { Ok(literal) } else { Err(reader.unexpected("the end")) }
}

struct Reader<'a> {
    rest: &'a str,
}

impl Reader<'_> {
    fn literal(&mut self, depth: usize) -> Result<Literal, FormatError> {
        self.skip_spaces();
        if depth > DEPTH {
            return Err(self.unexpected("less nesting"));
        }
        match self.rest.chars().next() {
            Some(quote @ ('\'' | '"')) => self.text(quote),
            Some('0'..='9') => self.whole(),
            Some('(') => Ok(Literal::Tuple(self.items(')', |reader| reader.literal(depth + 1))?)),
            Some('[') => Ok(Literal::List(self.items(']', |reader| reader.literal(depth + 1))?)),
            Some('{') => Ok(Literal::Dictionary(self.items('}', |reader| {
                let key = reader.literal(depth + 1)?;
                reader.expect(':')?;
                Ok((key, reader.literal(depth + 1)?))
            })?)),
            _ if self.take("True") => Ok(Literal::Truth(true)),
            _ if self.take("False") => Ok(Literal::Truth(false)),
            _ => Err(self.unexpected("a text, a number, True, False, '(', '[' or '{'")),
        }
    }

    fn text(&mut self, quote: char) -> Result<Literal, FormatError> {
        let inner = &self.rest[1..];
        let Some(end) = inner.find([quote, '\\']).filter(|end| inner[*end..].starts_with(quote)) else {
            return Err(self.unexpected("a text that ends, without escapes"));
        };
        let text = inner[..end].to_owned();
        self.rest = &inner[end + 1..];
        Ok(Literal::Text(text))
    }

    fn whole(&mut self) -> Result<Literal, FormatError> {
        let end = self.rest.find(|c: char| !c.is_ascii_digit()).unwrap_or(self.rest.len());
        let Ok(value) = self.rest[..end].parse() else {
            return Err(self.unexpected("a number of 64 bits"));
        };
        self.rest = &self.rest[end..];
        // Python 2 marked long numbers with an L.
        self.take("L");
        Ok(Literal::Whole(value))
    }

    /// Reads items in brackets, with a comma between them and optionally after the last.
    fn items<T>(
        &mut self,
        close: char,
        mut item: impl FnMut(&mut Self) -> Result<T, FormatError>,
    ) -> Result<Vec<T>, FormatError> {
        self.rest = &self.rest[1..];
        let mut items = Vec::new();
        loop {
            self.skip_spaces();
            if self.rest.starts_with(close) {
                self.rest = &self.rest[1..];
                return Ok(items);
            }
            items.push(item(self)?);
            self.skip_spaces();
            if !self.rest.starts_with(close) {
                self.expect(',')?;
            }
        }
    }

    fn expect(&mut self, wanted: char) -> Result<(), FormatError> {
        self.skip_spaces();
        match self.rest.strip_prefix(wanted) {
            Some(rest) => {
                self.rest = rest;
                Ok(())
            }
            None => Err(self.unexpected(&format!("'{wanted}'"))),
        }
    }

    fn take(&mut self, word: &str) -> bool {
        let rest = self.rest.strip_prefix(word);
        self.rest = rest.unwrap_or(self.rest);
        rest.is_some()
    }

    fn skip_spaces(&mut self) {
        self.rest = self.rest.trim_start();
    }

    fn unexpected(&self, wanted: &str) -> FormatError {
        let found: String = self.rest.chars().take(12).collect();
        FormatError::Header { what: format!("expected {wanted} at '{}'", found.escape_debug()) }
    }
}
