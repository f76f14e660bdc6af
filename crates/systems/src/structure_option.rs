//! Facts of an option in addition to its row: its group, and whether it may change a hit.

use rasray_ads::StructureKind;
use rasray_options::{OptionRow, Values, Word};

/// Purposes of options, in the order in which help shows them.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Group {
    /// The resolution of a structure.
    Size,
    /// Stored data, and conditions of a hit: mostly choices between a paper's method and another.
    Method,
    /// Options that change only time and memory.
    Speed,
    /// Limits of memory and work.
    Limit,
    /// Diagnostics.
    Diagnostic,
}

impl Group {
    /// Every group.
    pub const ALL: [Self; 5] = [Self::Size, Self::Method, Self::Speed, Self::Limit, Self::Diagnostic];

    /// A heading.
    pub fn title(self) -> &'static str {
        match self {
            Self::Size => "sizes",
            Self::Method => "methods",
            Self::Speed => "speed",
            Self::Limit => "limits",
            Self::Diagnostic => "diagnostics",
        }
    }
}

/// Cases in which an option may change a hit, by kind of hits. Elsewhere hits are bit-identical whatever its
/// value.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Hits {
    /// Never.
    Same,
    /// Only where rules of a paper lose hits of triangles.
    SameWithoutLoss,
    /// Only there, and where fragments are stored.
    SameForTriangles,
    /// Always: it decides whether something is a hit, or what it represents.
    MayChange,
}

impl Hits {
    /// True if hits of that kind may change.
    pub fn may_change(self, kind: StructureKind) -> bool {
        match (self, kind) {
            (Self::Same, _) => false,
            (Self::SameWithoutLoss, kind) => kind == StructureKind::LossyPrimitive,
            (Self::SameForTriangles, kind) => kind != StructureKind::Primitive,
            (Self::MayChange, _) => true,
        }
    }

    /// In a few words, which the page of options explains.
    pub fn describe(self) -> &'static str {
        match self {
            Self::Same => "never",
            Self::SameWithoutLoss => "lossy",
            Self::SameForTriangles => "fragments, lossy",
            Self::MayChange => "always",
        }
    }
}

/// An option of structures.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StructureOption {
    /// Its name, what it takes, and what it says.
    pub row: OptionRow,
    /// Purpose.
    pub group: Group,
    /// Cases in which it may change a hit.
    pub hits: Hits,
}

/// An option from its row.
pub(crate) const fn of(row: OptionRow, group: Group, hits: Hits) -> StructureOption {
    StructureOption { row, group, hits }
}

/// One with the values that tests try.
pub(crate) const fn row(
    name: &'static str,
    group: Group,
    hits: Hits,
    values: Values,
    tried: &'static [&'static str],
    doc: &'static str,
) -> StructureOption {
    of(OptionRow::new(name, values, doc).trying(tried), group, hits)
}

/// One of words.
pub(crate) const fn words(
    name: &'static str,
    group: Group,
    hits: Hits,
    words: &'static [Word],
    doc: &'static str,
) -> StructureOption {
    of(OptionRow::words(name, words, doc), group, hits)
}

/// One that is on or off.
pub(crate) const fn switch(
    name: &'static str,
    group: Group,
    hits: Hits,
    doc: &'static str,
) -> StructureOption {
    of(OptionRow::switch(name, doc), group, hits)
}

/// Replaces the values that tests try.
pub(crate) const fn trying(tried: &'static [&'static str], option: StructureOption) -> StructureOption {
    StructureOption { row: option.row.trying(tried), ..option }
}
