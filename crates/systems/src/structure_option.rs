//! Properties of an option in addition to its row: its group, and whether it may change a hit.

use rasray_ads::StructureKind;
use rasray_options::{OptionRow, Values, Word};

/// Groups of options by purpose, in the order in which help shows them.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Group {
    /// Resolution of a structure.
    Size,
    /// Choices of stored data and of conditions for a hit, mostly between a paper's method and another.
    Method,
    /// Options that change only time and memory.
    Speed,
    /// Limits of memory and work.
    Limit,
    /// Diagnostics only.
    Diagnostic,
}

impl Group {
    /// All groups.
    pub const ALL: [Self; 5] = [Self::Size, Self::Method, Self::Speed, Self::Limit, Self::Diagnostic];

    /// Returns the heading of the group.
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

/// Cases in which an option may change a hit, by kind of hits. In all other cases hits are bit-identical for
/// all values of the option.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Hits {
    /// Never: hits are bit-identical for all values.
    Same,
    /// Only in structures in which rules of a paper lose hits of triangles.
    SameWithoutLoss,
    /// Only in structures that lose hits of triangles, and in structures that store fragments.
    SameForTriangles,
    /// Always: the option decides whether something is a hit, or what a hit represents.
    MayChange,
}

impl Hits {
    /// Returns true if hits of this kind may change.
    pub fn may_change(self, kind: StructureKind) -> bool {
        match (self, kind) {
            (Self::Same, _) => false,
            (Self::SameWithoutLoss, kind) => kind == StructureKind::LossyPrimitive,
            (Self::SameForTriangles, kind) => kind != StructureKind::Primitive,
            (Self::MayChange, _) => true,
        }
    }

    /// Returns the cases in a few words, which the page of options explains.
    pub fn describe(self) -> &'static str {
        match self {
            Self::Same => "never",
            Self::SameWithoutLoss => "lossy",
            Self::SameForTriangles => "fragments, lossy",
            Self::MayChange => "always",
        }
    }
}

/// Option of structures.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StructureOption {
    /// Row with the option's name, values and help.
    pub row: OptionRow,
    /// Group by purpose.
    pub group: Group,
    /// Cases in which the option may change a hit.
    pub hits: Hits,
}

/// Returns an option from its row.
pub(crate) const fn of(row: OptionRow, group: Group, hits: Hits) -> StructureOption {
    StructureOption { row, group, hits }
}

/// Returns an option with values that tests try.
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

/// Returns an option that takes one of several words.
pub(crate) const fn words(
    name: &'static str,
    group: Group,
    hits: Hits,
    words: &'static [Word],
    doc: &'static str,
) -> StructureOption {
    of(OptionRow::words(name, words, doc), group, hits)
}

/// Returns an option that is on or off.
pub(crate) const fn switch(
    name: &'static str,
    group: Group,
    hits: Hits,
    doc: &'static str,
) -> StructureOption {
    of(OptionRow::switch(name, doc), group, hits)
}

/// Returns an option with other values for tests to try.
pub(crate) const fn trying(tried: &'static [&'static str], option: StructureOption) -> StructureOption {
    StructureOption { row: option.row.trying(tried), ..option }
}
