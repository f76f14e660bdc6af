//! Hits in `.npy` files: records of t, primitive, u and v.

use super::LIMIT;
use super::error::FormatError;
use super::npy::{self, Array, Kind};
use rasray_ads::{Hit, PRIMITIVE_NONE, StructureKind};

/// Answer of the oracle to a ray.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TrueHit {
    /// Distance in units of the direction's length; infinite for a miss.
    pub t: f64,
    /// Global triangle id; `u32::MAX` for a miss.
    pub primitive: u32,
    /// Barycentric weights of vertices 1 and 2.
    pub barycentrics: [f64; 2],
    /// True if f32 arithmetic may decide differently.
    pub ambiguous: bool,
}

/// Hits that another tracer found, one per ray.
#[derive(Clone, Debug, PartialEq)]
pub struct HitsFile {
    /// Name of the tracer in the report.
    pub name: String,
    /// Hits in the order of the rays.
    pub hits: Vec<Hit>,
}

/// Position of t, primitive, u and v in a row.
#[derive(Clone, Copy)]
enum Columns {
    /// Indices of the fields of a record.
    Fields([Option<usize>; 4]),
    /// Number of columns of plain numbers.
    Plain(usize),
}

/// Hit that stands for a miss.
const MISS: Hit = Hit { t: f32::INFINITY, primitive: PRIMITIVE_NONE, a: 0.0, b: 0.0 };

/// Reads hits: records with the fields `t` and `primitive`, and optionally `u` and `v`, or N x 2 to 4 plain
/// numbers in that order. A miss has the primitive 4294967295 or -1, or an infinite t.
///
/// # Errors
/// An error if the bytes are no such array, or a primitive is no whole number in [-1, 2^32).
pub fn hits_from_npy(bytes: &[u8]) -> Result<Vec<Hit>, FormatError> {
    const WANTED: &str = "records with t and primitive, or N x 2 to 4 numbers (t, primitive, u, v)";
    let array = npy::read(bytes)?;
    let content = || FormatError::Content { what: array.describe(), wanted: WANTED };
    let count = array.shape.first().copied().ok_or_else(content)?;
    if count > LIMIT {
        return Err(FormatError::TooMany { entries: count as u64 });
    }
    let columns = match *array.shape.as_slice() {
        [_] if array.field("t").is_some() && array.field("primitive").is_some() => {
            Columns::Fields(["t", "primitive", "u", "v"].map(|name| array.field(name)))
        }
        [_, columns @ 2..=4] if array.single_kind().is_some() => Columns::Plain(columns),
        _ => return Err(content()),
    };
    let number = |row: usize, column: usize| match columns {
        Columns::Fields(fields) => Some(array.number(row, fields[column]?)),
        Columns::Plain(columns) => (column < columns).then(|| array.number(row * columns + column, 0)),
    };
    (0..count)
        .map(|index| {
            let t = number(index, 0).unwrap_or(f64::INFINITY) as f32;
            let primitive = primitive(index, number(index, 1).unwrap_or(-1.0))?;
            if primitive == PRIMITIVE_NONE || t == f32::INFINITY {
                return Ok(MISS);
            }
            let [a, b] = [2, 3].map(|column| number(index, column).unwrap_or(0.0) as f32);
            Ok(Hit { t, primitive, a, b })
        })
        .collect()
}

fn primitive(index: usize, number: f64) -> Result<u32, FormatError> {
    if number == -1.0 {
        return Ok(PRIMITIVE_NONE);
    }
    // Written so that NaN fails.
    if number >= 0.0 && number <= f64::from(u32::MAX) && number.fract() == 0.0 {
        return Ok(number as u32);
    }
    Err(FormatError::Entry { index, what: "its primitive is no whole number from -1 to 4294967295" })
}

/// Writes hits as records of t (float32), primitive (uint32), u and v (float32): weights of vertices 1 and 2,
/// NaN where the structure does not know them. A miss has an infinite t and the primitive 4294967295.
pub fn hits_to_npy(hits: &[Hit], kind: StructureKind) -> Vec<u8> {
    let fields = [("t", Kind::F4), ("primitive", Kind::U4), ("u", Kind::F4), ("v", Kind::F4)];
    let bytes = hits.iter().flat_map(|hit| {
        let hit = if hit.is_hit() { *hit } else { MISS };
        let weight = |weight: f32| if kind.finds_triangles() { weight } else { f32::NAN };
        [
            hit.t.to_le_bytes(),
            hit.primitive.to_le_bytes(),
            weight(hit.a).to_le_bytes(),
            weight(hit.b).to_le_bytes(),
        ]
        .into_iter()
        .flatten()
    });
    Array::records(&fields, hits.len(), bytes.collect()).to_bytes()
}

/// Writes the oracle's answers as records of t (float64), primitive (uint32), u, v (float64) and ambiguous
/// (bool).
pub fn truth_to_npy(truth: &[TrueHit]) -> Vec<u8> {
    let fields = [
        ("t", Kind::F8),
        ("primitive", Kind::U4),
        ("u", Kind::F8),
        ("v", Kind::F8),
        ("ambiguous", Kind::Bool),
    ];
    let mut bytes = Vec::with_capacity(truth.len() * 29);
    for hit in truth {
        bytes.extend(hit.t.to_le_bytes());
        bytes.extend(hit.primitive.to_le_bytes());
        bytes.extend(hit.barycentrics.into_iter().flat_map(f64::to_le_bytes));
        bytes.push(hit.ambiguous.into());
    }
    Array::records(&fields, truth.len(), bytes).to_bytes()
}
