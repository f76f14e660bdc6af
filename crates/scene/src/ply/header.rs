//! The header: what elements follow, how many, and with which properties.

use std::path::Path;

use crate::SceneError;

/// How numbers stand in the body.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Encoding {
    Ascii,
    LittleEndian,
    BigEndian,
}

/// A scalar type of the format.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Scalar {
    I8,
    U8,
    I16,
    U16,
    I32,
    U32,
    F32,
    F64,
}

impl Scalar {
    fn named(name: &str) -> Option<Self> {
        Some(match name {
            "char" | "int8" => Self::I8,
            "uchar" | "uint8" => Self::U8,
            "short" | "int16" => Self::I16,
            "ushort" | "uint16" => Self::U16,
            "int" | "int32" => Self::I32,
            "uint" | "uint32" => Self::U32,
            "float" | "float32" => Self::F32,
            "double" | "float64" => Self::F64,
            _ => return None,
        })
    }

    /// Bytes of one number in a binary body.
    pub fn size(self) -> usize {
        match self {
            Self::I8 | Self::U8 => 1,
            Self::I16 | Self::U16 => 2,
            Self::I32 | Self::U32 | Self::F32 => 4,
            Self::F64 => 8,
        }
    }

    pub fn is_float(self) -> bool {
        matches!(self, Self::F32 | Self::F64)
    }
}

/// A property of an element.
#[derive(Clone, Debug)]
pub(super) struct Property {
    pub name: String,
    /// Type of the number, or of a list's entries.
    pub scalar: Scalar,
    /// Type of the length, if this is a list.
    pub length: Option<Scalar>,
}

/// A kind of element and how many follow.
#[derive(Clone, Debug)]
pub(super) struct Element {
    pub name: String,
    pub count: u64,
    pub properties: Vec<Property>,
}

/// What stands before the body.
pub(super) struct Header {
    pub encoding: Encoding,
    pub elements: Vec<Element>,
    /// Where the body begins, in bytes from the start of the file.
    pub body: usize,
    /// Lines of the header.
    pub lines: usize,
}

/// Longest header that is read, bytes.
const MAX_HEADER: usize = 1 << 20;

/// Reads the header up to and including the line `end_header`.
pub(super) fn parse(path: &Path, bytes: &[u8]) -> Result<Header, SceneError> {
    let mut header = Header { encoding: Encoding::Ascii, elements: Vec::new(), body: 0, lines: 0 };
    let mut encoding = None;
    loop {
        let fail = |line: usize, reason: &str| SceneError::syntax(path, format!("line {line}: {reason}"));
        let Some((line, next)) = next_line(&bytes[..bytes.len().min(MAX_HEADER)], header.body) else {
            return Err(fail(header.lines + 1, "the header does not end; it must end with `end_header`"));
        };
        header.body = next;
        header.lines += 1;
        let number = header.lines;
        let text = String::from_utf8_lossy(line);
        let words: Vec<&str> = text.split_whitespace().collect();
        if number == 1 {
            if words != ["ply"] {
                return Err(fail(1, "a PLY file begins with the line `ply`"));
            }
            continue;
        }
        match words[..] {
            [] | ["comment" | "obj_info", ..] => {}
            ["format", form, version] => {
                encoding = Some(match form {
                    "ascii" => Encoding::Ascii,
                    "binary_little_endian" => Encoding::LittleEndian,
                    "binary_big_endian" => Encoding::BigEndian,
                    _ => {
                        return Err(fail(
                            number,
                            "the format must be ascii, binary_little_endian or binary_big_endian",
                        ));
                    }
                });
                if version != "1.0" {
                    return Err(fail(number, "only version 1.0 of the format exists"));
                }
            }
            ["element", name, count] => {
                let count = count
                    .parse()
                    .map_err(|_| fail(number, "the number of elements is not a whole number"))?;
                header.elements.push(Element { name: name.to_owned(), count, properties: Vec::new() });
            }
            ["property", "list", length, entry, name] => {
                let (Some(length), Some(scalar)) = (Scalar::named(length), Scalar::named(entry)) else {
                    return Err(fail(number, "a property has an unknown type"));
                };
                if length.is_float() {
                    return Err(fail(number, "the length of a list must have a type of whole numbers"));
                }
                let property = Property { name: name.to_owned(), scalar, length: Some(length) };
                push(&mut header, property)
                    .ok_or_else(|| fail(number, "a property stands before any element"))?;
            }
            ["property", scalar, name] => {
                let scalar =
                    Scalar::named(scalar).ok_or_else(|| fail(number, "a property has an unknown type"))?;
                let property = Property { name: name.to_owned(), scalar, length: None };
                push(&mut header, property)
                    .ok_or_else(|| fail(number, "a property stands before any element"))?;
            }
            ["end_header"] => break,
            _ => return Err(fail(number, "this is no line of a PLY header")),
        }
    }
    header.encoding = encoding.ok_or_else(|| SceneError::syntax(path, "the header has no line `format`"))?;
    Ok(header)
}

fn push(header: &mut Header, property: Property) -> Option<()> {
    header.elements.last_mut()?.properties.push(property);
    Some(())
}

/// The line that begins at `start`, and where the next begins. Ends with LF, CR LF or CR; a CR that
/// closes `end_header` before a binary body takes a following LF with it.
fn next_line(bytes: &[u8], start: usize) -> Option<(&[u8], usize)> {
    let rest = bytes.get(start..)?;
    let end = rest.iter().position(|byte| matches!(byte, b'\n' | b'\r'))?;
    let ends_twice = rest[end] == b'\r' && rest.get(end + 1) == Some(&b'\n');
    Some((&rest[..end], start + end + 1 + usize::from(ends_twice)))
}
