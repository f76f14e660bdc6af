//! What the registry says of an option: what it is for, what it takes, and whether it may change a hit.

use rasray_ads::StructureKind;

/// What an option is for, the order in which help shows them.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Group {
    /// The resolution of a structure.
    Size,
    /// What is stored, and what counts as a hit: mostly choices between a paper's method and another.
    Method,
    /// What changes only time and memory.
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

/// A word that an option takes, and what it means.
pub type Word = (&'static str, &'static str);

/// What an option takes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Values {
    /// One of these words.
    Words(&'static [Word]),
    /// A whole number from the first to the second.
    Whole(u32, u32),
    /// A length in metres, not negative.
    Metres,
    /// A share, not negative.
    Share,
    /// Columns and rows, 1 to 8192 each, such as `720x480`; or one number for both.
    Cells,
}

/// Whether an option may change a hit, by what hits are. Where it may not, hits are bit-identical whatever its value.
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
    /// Whether hits of that kind may change.
    pub fn may_change(self, kind: StructureKind) -> bool {
        match (self, kind) {
            (Self::Same, _) => false,
            (Self::SameWithoutLoss, kind) => kind == StructureKind::LossyPrimitive,
            (Self::SameForTriangles, kind) => kind != StructureKind::Primitive,
            (Self::MayChange, _) => true,
        }
    }

    /// In words.
    pub fn describe(self) -> &'static str {
        match self {
            Self::Same => "never",
            Self::SameWithoutLoss => "where rules lose hits",
            Self::SameForTriangles => "of fragments, and where rules lose hits",
            Self::MayChange => "always",
        }
    }
}

/// An option.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OptionRow {
    /// Name, on the command line and in reports.
    pub name: &'static str,
    /// What it is for.
    pub group: Group,
    /// What it takes.
    pub values: Values,
    /// Another name that stands for the value `off`; then the option's own name without a value is `on`.
    pub off_name: Option<&'static str>,
    /// Whether it may change a hit.
    pub hits: Hits,
    /// Values that tests try; all words where none are listed.
    pub tried: &'static [&'static str],
    /// What it says, for help.
    pub doc: &'static str,
}

impl OptionRow {
    /// Values that tests try.
    pub fn tried(&self) -> Vec<&'static str> {
        match self.values {
            Values::Words(words) if self.tried.is_empty() => words.iter().map(|(word, _)| *word).collect(),
            _ => self.tried.to_vec(),
        }
    }
}
