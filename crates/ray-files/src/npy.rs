//! Arrays of NumPy's `.npy` format, versions 1 to 3: little-endian, in C order, of numbers or of records
//! with named fields.
//!
//! The parser is written here because npyz 0.9, on files that are no arrays, multiplies lengths without a
//! check and allocates the size that a header asks for before it checks the length of the file.

use super::LIMIT;
use super::error::FormatError;
use super::literal::{Literal, parse};

const MAGIC: &[u8; 6] = b"\x93NUMPY";

/// Type of a number in an array.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    /// One byte, zero for false.
    Bool,
    I4,
    U4,
    I8,
    U8,
    F4,
    F8,
}

impl Kind {
    const ALL: [Self; 7] = [Self::Bool, Self::I4, Self::U4, Self::I8, Self::U8, Self::F4, Self::F8];

    /// Returns NumPy's name of the type.
    fn word(self) -> &'static str {
        match self {
            Self::Bool => "|b1",
            Self::I4 => "<i4",
            Self::U4 => "<u4",
            Self::I8 => "<i8",
            Self::U8 => "<u8",
            Self::F4 => "<f4",
            Self::F8 => "<f8",
        }
    }

    fn size(self) -> usize {
        match self {
            Self::Bool => 1,
            Self::I4 | Self::U4 | Self::F4 => 4,
            Self::I8 | Self::U8 | Self::F8 => 8,
        }
    }
}

/// Part of each element.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Field {
    /// Name of the field; empty in arrays of plain numbers.
    pub(super) name: String,
    pub(super) kind: Kind,
}

/// Array: elements of one or more fields, packed.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Array {
    pub(super) shape: Vec<usize>,
    pub(super) fields: Vec<Field>,
    /// Bytes of the elements; shape and fields determine their number.
    bytes: Vec<u8>,
}

impl Array {
    /// Makes an array of plain numbers.
    pub(super) fn plain(kind: Kind, shape: &[usize], bytes: Vec<u8>) -> Self {
        Self { shape: shape.to_vec(), fields: vec![Field { name: String::new(), kind }], bytes }
    }

    /// Makes a row of records.
    pub(super) fn records(fields: &[(&str, Kind)], count: usize, bytes: Vec<u8>) -> Self {
        let fields = fields.iter().map(|(name, kind)| Field { name: (*name).to_owned(), kind: *kind });
        Self { shape: vec![count], fields: fields.collect(), bytes }
    }

    /// Returns the type of number if elements are plain numbers.
    pub(super) fn single_kind(&self) -> Option<Kind> {
        match self.fields.as_slice() {
            [field] if field.name.is_empty() => Some(field.kind),
            _ => None,
        }
    }

    /// Returns the index of a field.
    pub(super) fn field(&self, name: &str) -> Option<usize> {
        self.fields.iter().position(|field| field.name == name)
    }

    /// Returns the bytes of an element.
    fn stride(&self) -> usize {
        self.fields.iter().map(|field| field.kind.size()).sum()
    }

    /// Returns the bytes of a field of an element, extended to 8 by zeros.
    fn raw(&self, element: usize, field: usize) -> [u8; 8] {
        let before: usize = self.fields[..field].iter().map(|field| field.kind.size()).sum();
        let start = element * self.stride() + before;
        let size = self.fields[field].kind.size();
        let mut bytes = [0; 8];
        bytes[..size].copy_from_slice(&self.bytes[start..start + size]);
        bytes
    }

    /// Returns a field of an element as a number; whole numbers above 2^53 are rounded.
    pub(super) fn number(&self, element: usize, field: usize) -> f64 {
        let raw = self.raw(element, field);
        let low = u64::from_le_bytes(raw) as u32;
        match self.fields[field].kind {
            Kind::Bool => f64::from(raw[0] != 0),
            Kind::I4 => f64::from(low as i32),
            Kind::U4 => f64::from(low),
            Kind::I8 => i64::from_le_bytes(raw) as f64,
            Kind::U8 => u64::from_le_bytes(raw) as f64,
            Kind::F4 => f64::from(f32::from_bits(low)),
            Kind::F8 => f64::from_le_bytes(raw),
        }
    }

    /// Describes shape and fields for messages.
    pub(super) fn describe(&self) -> String {
        let shape = self.shape.iter().map(usize::to_string).collect::<Vec<_>>().join(" x ");
        let fields = self.fields.iter().map(|field| match field.name.as_str() {
            "" => field.kind.word().to_owned(),
            name => format!("{name} {}", field.kind.word()),
        });
        format!("an array of {shape} with {}", fields.collect::<Vec<_>>().join(", "))
    }

    /// Returns the bytes of a file of version 1.
    pub(super) fn to_bytes(&self) -> Vec<u8> {
        let descr = match self.single_kind() {
            Some(kind) => format!("'{}'", kind.word()),
            None => {
                let fields = self.fields.iter().map(|f| format!("('{}', '{}')", f.name, f.kind.word()));
                format!("[{}]", fields.collect::<Vec<_>>().join(", "))
            }
        };
        let shape: String = self.shape.iter().map(|length| format!("{length}, ")).collect();
        let mut header =
            format!("{{'descr': {descr}, 'fortran_order': False, 'shape': ({}), }}", shape.trim_end());
        // The array begins at a multiple of 64 bytes; the header ends with a line break.
        let whole = MAGIC.len() + 4 + header.len() + 1;
        header.extend(std::iter::repeat_n(' ', whole.next_multiple_of(64) - whole));
        header.push('\n');
        let mut bytes = MAGIC.to_vec();
        bytes.extend([1, 0]);
        bytes.extend((header.len() as u16).to_le_bytes());
        bytes.extend(header.as_bytes());
        bytes.extend(&self.bytes);
        bytes
    }
}

/// Reads an array.
///
/// # Errors
/// An error for another format, version, byte order or element, Fortran order, or a length that does not fit.
pub(super) fn read(bytes: &[u8]) -> Result<Array, FormatError> {
    let Some(rest) = bytes.strip_prefix(MAGIC) else {
        return Err(FormatError::Magic { format: ".npy" });
    };
    let short =
        |promised: usize| FormatError::Length { bytes: bytes.len() as u64, promised: promised as u64 };
    let (length, rest) = match rest {
        [1, _, a, b, rest @ ..] => (u32::from(u16::from_le_bytes([*a, *b])), rest),
        [2 | 3, _, a, b, c, d, rest @ ..] => (u32::from_le_bytes([*a, *b, *c, *d]), rest),
        [1..=3, ..] | [] => return Err(short(12)),
        [major, ..] => return Err(FormatError::Version { version: major.to_string(), known: "1 to 3" }),
    };
    let before = bytes.len() - rest.len();
    let Some((header, data)) = rest.split_at_checked(length as usize) else {
        return Err(short(before.saturating_add(length as usize)));
    };
    let header = std::str::from_utf8(header)
        .map_err(|error| FormatError::Header { what: format!("it is not text: {error}") })?;
    let (fields, shape) = understand(header)?;
    let stride: usize = fields.iter().map(|field| field.kind.size()).sum();
    let elements = shape.iter().try_fold(1_u64, |product, length| product.checked_mul(*length as u64));
    let elements = elements.unwrap_or(u64::MAX);
    // Rows of numbers have up to nine columns.
    if elements > 16 * LIMIT as u64 {
        return Err(FormatError::TooMany { entries: elements });
    }
    let promised = elements * stride as u64;
    if promised != data.len() as u64 {
        let header = (bytes.len() - data.len()) as u64;
        return Err(FormatError::Length { bytes: bytes.len() as u64, promised: header + promised });
    }
    Ok(Array { shape, fields, bytes: data.to_vec() })
}

/// Reads fields and shape from a header.
fn understand(header: &str) -> Result<(Vec<Field>, Vec<usize>), FormatError> {
    let wrong = |what: String| FormatError::Header { what };
    let Literal::Dictionary(entries) = parse(header)? else {
        return Err(wrong("it is not a dictionary".to_owned()));
    };
    let entry = |name: &str| {
        let found = entries.iter().find(|(key, _)| *key == Literal::Text(name.to_owned()));
        found.map(|(_, value)| value).ok_or_else(|| wrong(format!("'{name}' is missing")))
    };
    match entry("fortran_order")? {
        Literal::Truth(false) => {}
        Literal::Truth(true) => {
            return Err(FormatError::Content {
                what: "an array in Fortran order".to_owned(),
                wanted: "one in C order (numpy.ascontiguousarray)",
            });
        }
        _ => return Err(wrong("'fortran_order' is neither True nor False".to_owned())),
    }
    let Literal::Tuple(lengths) = entry("shape")? else {
        return Err(wrong("'shape' is not a tuple".to_owned()));
    };
    let shape = lengths.iter().map(|length| match length {
        Literal::Whole(length) => usize::try_from(*length).ok(),
        _ => None,
    });
    let shape =
        shape.collect::<Option<Vec<_>>>().ok_or_else(|| wrong("'shape' is not of lengths".to_owned()))?;
    let fields = match entry("descr")? {
        Literal::Text(word) => vec![Field { name: String::new(), kind: kind(word)? }],
        Literal::List(fields) => fields.iter().map(field).collect::<Result<_, _>>()?,
        _ => return Err(wrong("'descr' is neither a type nor a list of fields".to_owned())),
    };
    if fields.is_empty() {
        return Err(wrong("'descr' lists no field".to_owned()));
    }
    Ok((fields, shape))
}

fn field(literal: &Literal) -> Result<Field, FormatError> {
    match literal {
        Literal::Tuple(parts) => match parts.as_slice() {
            [Literal::Text(name), Literal::Text(word)] if !name.is_empty() => {
                Ok(Field { name: name.clone(), kind: kind(word)? })
            }
            _ => Err(FormatError::Header { what: "a field of 'descr' is not (name, type)".to_owned() }),
        },
        _ => Err(FormatError::Header { what: "a field of 'descr' is not a tuple".to_owned() }),
    }
}

fn kind(word: &str) -> Result<Kind, FormatError> {
    Kind::ALL.into_iter().find(|kind| kind.word() == word).ok_or_else(|| FormatError::Content {
        what: format!("numbers of type '{}'", word.escape_debug()),
        wanted: "little-endian float32, float64, int32, uint32, int64, uint64 or bool",
    })
}
