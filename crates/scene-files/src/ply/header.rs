//! Header of a file: the elements that follow, their numbers and their properties.

use std::path::Path;

use crate::recognise::{binary, recognise};
use rasray_scene::SceneError;
use rasray_scene::text::shown;

/// Encoding of numbers in the body.
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

    /// Returns the bytes of one number in a binary body.
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

/// Property of an element.
#[derive(Clone, Debug)]
pub(super) struct Property {
    pub name: String,
    /// Type of the number, or of the entries of a list.
    pub scalar: Scalar,
    /// Type of the length, if the property is a list.
    pub length: Option<Scalar>,
}

/// Kind of element, and number of such elements in the body.
#[derive(Clone, Debug)]
pub(super) struct Element {
    pub name: String,
    pub count: u64,
    pub properties: Vec<Property>,
}

/// Header of the file, before the body.
pub(super) struct Header {
    pub encoding: Encoding,
    pub elements: Vec<Element>,
    /// Names of image files, from the comments `TextureFile` that MeshLab and others write.
    pub textures: Vec<String>,
    /// Start of the body, in bytes from the start of the file.
    pub body: usize,
    /// Number of lines of the header.
    pub lines: usize,
}

/// Longest header that is read, bytes.
const MAX_HEADER: usize = 1 << 20;

/// Reads the header up to and including the line `end_header`.
pub(super) fn parse(path: &Path, bytes: &[u8]) -> Result<Header, SceneError> {
    let mut header =
        Header { encoding: Encoding::Ascii, elements: Vec::new(), textures: Vec::new(), body: 0, lines: 0 };
    let mut encoding = None;
    loop {
        let line = next_line(&bytes[..bytes.len().min(MAX_HEADER)], header.body);
        if header.lines == 0 && line.is_none_or(|(line, _)| line.trim_ascii() != b"ply") {
            let foreign = recognise(bytes).or_else(|| binary(bytes));
            return Err(foreign.map_or_else(
                || SceneError::syntax(path, "line 1: a PLY file begins with the line `ply`"),
                |foreign| foreign.refuse(path, "a PLY file"),
            ));
        }
        let fail = |line: usize, reason: &str| SceneError::syntax(path, format!("line {line}: {reason}"));
        let Some((line, next)) = line else {
            return Err(fail(header.lines + 1, "the header does not end; it must end with `end_header`"));
        };
        header.body = next;
        header.lines += 1;
        let number = header.lines;
        if number == 1 {
            continue;
        }
        let text = String::from_utf8_lossy(line);
        let words: Vec<&str> = text.split_whitespace().collect();
        let unknown = |what: &str, word: &str| fail(number, &format!("`{}` is {what}", shown(word)));
        match words[..] {
            ["comment", "TextureFile", _, ..] => {
                let name = text.split_once("TextureFile").map(|(_, name)| name.trim());
                header.textures.extend(name.map(str::to_owned));
            }
            [] | ["comment" | "obj_info", ..] => {}
            ["format", form, version] => {
                encoding = Some(match form {
                    "ascii" => Encoding::Ascii,
                    "binary_little_endian" => Encoding::LittleEndian,
                    "binary_big_endian" => Encoding::BigEndian,
                    _ => {
                        let what = "no format; there are ascii, binary_little_endian and binary_big_endian";
                        return Err(unknown(what, form));
                    }
                });
                if version != "1.0" {
                    return Err(unknown("no version of the format; there is only 1.0", version));
                }
            }
            ["element", name, count] => {
                let count = count.parse().map_err(|_| unknown("not a whole number of elements", count))?;
                header.elements.push(Element { name: name.to_owned(), count, properties: Vec::new() });
            }
            ["property", ref types @ .., name] if matches!(types, [_] | ["list", _, _]) => {
                let scalar =
                    |word: &str| Scalar::named(word).ok_or_else(|| unknown("no type of the format", word));
                let (length, scalar) = match *types {
                    [_, length, entry] => (Some(scalar(length)?), scalar(entry)?),
                    _ => (None, scalar(types[0])?),
                };
                if length.is_some_and(Scalar::is_float) {
                    return Err(fail(number, "the length of a list must have a type of whole numbers"));
                }
                let property = Property { name: name.to_owned(), scalar, length };
                let element = header.elements.last_mut();
                let element = element.ok_or_else(|| fail(number, "a property stands before any element"))?;
                element.properties.push(property);
            }
            ["end_header"] => break,
            _ => return Err(unknown("no line of a PLY header", text.trim())),
        }
    }
    header.encoding = encoding.ok_or_else(|| SceneError::syntax(path, "the header has no line `format`"))?;
    Ok(header)
}

/// Returns the line that begins at `start`, and the start of the next. A line ends with LF, CR LF or CR; a CR
/// that closes `end_header` before a binary body takes a following LF with it.
fn next_line(bytes: &[u8], start: usize) -> Option<(&[u8], usize)> {
    let rest = bytes.get(start..)?;
    let end = rest.iter().position(|byte| matches!(byte, b'\n' | b'\r'))?;
    let ends_twice = rest[end] == b'\r' && rest.get(end + 1) == Some(&b'\n');
    Some((&rest[..end], start + end + 1 + usize::from(ends_twice)))
}
