//! Catalogue: the measured quantity of each case, and the demands on each kind of structure.

use Target::{Counted, Exact, Finite, Law, NoneMissed, Refused};

/// Demand on structures of one kind on a case.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Target {
    /// No ray that hits gets a miss, however close to an edge it passes; triangle and t are right up to
    /// rounding. This is the promise of watertightness.
    NoneMissed,
    /// No answer is wrong beyond rounding: no false hit, no other triangle, no NaN.
    Exact,
    /// The rate of errors follows a law in the resolution, or stays between stated bounds.
    Law,
    /// Both answers are legal; the rate of each is reported.
    Counted,
    /// Any answer is legal if it is finite and the work is bounded.
    Finite,
    /// The loader refuses the file with a typed error, or reads it as stated.
    Refused,
}

impl Target {
    /// Description in a few words, for tables.
    pub fn text(self) -> &'static str {
        match self {
            NoneMissed => "P1: none missed",
            Exact => "none wrong",
            Law => "P2: law in the resolution",
            Counted => "count only",
            Finite => "P0: finite answers, no crash",
            Refused => "refused with a typed error",
        }
    }
}

impl std::fmt::Display for Target {
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        formatter.pad(self.text())
    }
}

/// Demands of a case on each kind of structure.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Targets {
    /// Target of structures that find triangles.
    pub primitives: Target,
    /// Target of structures that find fragments, samples or voxels.
    pub fragments: Target,
}

/// Number of the catalogue; its cases are this number, alone or with a variant after a dash.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CatalogueRow {
    /// Number, such as `G1`.
    pub id: &'static str,
    /// Name of the measured quantity.
    pub measure: &'static str,
    /// Demands on each kind of structure.
    pub target: Targets,
    /// Largest relative error of t on the right triangle, for structures that find triangles, if the
    /// catalogue gives one. Otherwise the oracle's bounds of rounding hold.
    pub largest_dt: Option<f64>,
}

/// Returns the row of a case: that of its id up to the dash; `None` if there is none.
pub fn catalogue_row(id: &str) -> Option<&'static CatalogueRow> {
    let number = id.split('-').next()?;
    CATALOGUE.iter().find(|row| row.id == number)
}

const fn row(id: &'static str, measure: &'static str, primitives: Target, fragments: Target) -> CatalogueRow {
    CatalogueRow { id, measure, target: Targets { primitives, fragments }, largest_dt: None }
}

const fn within(largest_dt: f64, row: CatalogueRow) -> CatalogueRow {
    CatalogueRow { largest_dt: Some(largest_dt), ..row }
}

/// All rows by theme.
pub const CATALOGUE: &[CatalogueRow] = &[
    // Shape of triangles.
    row(
        "G1",
        "missed rays; for fragments at the rate that follows from the height in pixels",
        NoneMissed,
        Law,
    ),
    within(1e-5, row("G2", "missed rays, |dt| / t", NoneMissed, Law)),
    row("G3", "false hits, NaN", Exact, Exact),
    row("G4", "false hits, NaN", Exact, Exact),
    row("G5", "false hits", Exact, Exact),
    row("G6", "false hits", Exact, Exact),
    row("G7", "wrong and false hits against the exact predicate", Exact, Law),
    row("G8", "NaN", Finite, Finite),
    row("G9", "missed rays", NoneMissed, Law),
    within(1e-6, row("G10", "missed rays, |dt| / t", NoneMissed, Law)),
    row("G11", "missed rays; bounds of cells contain the exact ones", NoneMissed, Law),
    row("G12", "missed rays, NaN", NoneMissed, Law),
    // Edges and vertices.
    row("E1", "missed rays", NoneMissed, Law),
    row("E2", "missed rays", NoneMissed, Law),
    row("E3", "missed rays", NoneMissed, Law),
    row("E4", "misses at the seam, which are legal", Counted, Law),
    row("E5", "missed rays, |dt| / t", NoneMissed, Law),
    row("E6", "false hits, NaN", NoneMissed, Law),
    row("E7", "NaN, t of what is hit", Finite, Finite),
    row("E8", "missed rays", NoneMissed, Law),
    row("E9", "missed, false and wrong hits", Exact, Counted),
    // Views.
    row("V1", "missed rays", NoneMissed, Law),
    row("V2", "missed rays by slope", NoneMissed, Law),
    row("V3", "missed rays", NoneMissed, Law),
    row("V4", "missed rays against the law of slopes", NoneMissed, Law),
    row("V5", "missed rays", NoneMissed, Law),
    row("V6", "missed rays", NoneMissed, Law),
    row("V7", "missed rays", NoneMissed, Law),
    row("V8", "missed rays", NoneMissed, Law),
    row("V9", "missed rays, NaN", NoneMissed, Law),
    row("V10", "missed rays, |dt| / t", NoneMissed, Law),
    row("V11", "missed rays", NoneMissed, Law),
    row("V12", "missed rays", NoneMissed, Law),
    row("V13", "missed rays; visited cells contain the exact ones", NoneMissed, Law),
    row("V14", "missed rays", NoneMissed, Law),
    row("V15", "missed rays from inside, NaN", NoneMissed, Law),
    row("V16", "missed rays", NoneMissed, Law),
    // Depth and layers.
    within(1e-5, row("Z1", "missed rays, |dt| / t", NoneMissed, Law)),
    row("Z2", "missed rays, |dt| / t", NoneMissed, Law),
    row("Z3", "missed rays by size of the room", NoneMissed, Law),
    row("Z4", "wrong triangles over repeated builds", Exact, Law),
    row("Z5", "wrong triangles", Exact, Law),
    row("Z6", "missed rays, order of layers", NoneMissed, Law),
    row("Z7", "missed rays", NoneMissed, Law),
    row("Z8", "missed rays, NaN", NoneMissed, Law),
    row("Z9", "missed rays", NoneMissed, Law),
    row("Z10", "wrong triangles", Exact, Law),
    row("Z11", "wrong triangles by thickness", Exact, Law),
    row("Z12", "false hits behind", Exact, Law),
    row("Z13", "missed rays and wrong triangles", NoneMissed, Law),
    row("Z14", "wrong triangles over repeated builds", Exact, Law),
    row("Z15", "wrong triangles", NoneMissed, Law),
    // Voxels.
    row("X1", "missed rays; cells visited, steps at most 3 * 64 + 3", NoneMissed, Law),
    row("X2", "missed rays; cells visited, steps at most 3 * 64 + 3", NoneMissed, Law),
    row("X3", "missed rays on either side of a plane between cells", NoneMissed, Law),
    row("X4", "NaN, missed rays", NoneMissed, Law),
    row("X5", "hits of rays without direction", Exact, Exact),
    row("X6", "missed rays; cells out of range", NoneMissed, Law),
    row("X7", "missed rays; steps bounded", NoneMissed, Law),
    row("X8", "false hits; work bounded by the grid", Exact, Law),
    row("X9", "missed rays", NoneMissed, Law),
    row("X10", "missed rays", NoneMissed, Law),
    row("X11", "wrong triangles", Exact, Law),
    row("X12", "missed rays; cells contain the exact ones", NoneMissed, Law),
    row("X13", "missed rays from both sides", NoneMissed, Law),
    row("X14", "missed rays", NoneMissed, Law),
    row("X15", "missed rays", NoneMissed, Law),
    // Capacity and bad input.
    row("C1", "false hits", Exact, Exact),
    row("C2", "missed rays", NoneMissed, Law),
    row("C3", "missed rays, or a typed refusal", NoneMissed, Law),
    row("C4", "missed rays; difference after pools grew", NoneMissed, Law),
    row("C5", "missed rays of what is left, NaN", NoneMissed, Law),
    row("C6", "error of loading", Refused, Refused),
    row("C7", "missed rays, NaN", NoneMissed, Law),
    row("C8", "hits of rays without range, NaN", Exact, Law),
    row("C9", "steps bounded and flagged where lists are corrupted; missed rays where not", NoneMissed, Law),
    row("C10", "wrong triangles over repeated builds", Exact, Law),
    // Transforms.
    row("T1", "wrong triangles, side of the normal", NoneMissed, Law),
    row("T2", "|dt| / t, angle of the normal", NoneMissed, Law),
    row("T3", "missed rays, NaN", NoneMissed, Law),
    row("T4", "missed rays, drift of the transform", NoneMissed, Law),
    row("T5", "error of loading", Refused, Refused),
    // Light transport.
    row("P1", "wrong interfaces", NoneMissed, Law),
    row("P2", "triangles other than the lowest", Exact, Law),
    row("P3", "missed rays, |dt| / t", NoneMissed, Law),
    row("P4", "hits on the surface that a ray starts on", Exact, Law),
    row("P5", "hits on the surface that a ray starts on", Exact, Law),
    row("P6", "rays that leave a closed box", NoneMissed, Law),
    row("P7", "hits on the surface that a ray starts on, NaN", Exact, Law),
    row("P8", "wrong interfaces", NoneMissed, Law),
    row("P9", "missed rays, NaN", NoneMissed, Law),
];

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Scale, case, file_ids, ids};

    /// Letters of the themes, each with its number of rows: 91 in all.
    const THEMES: [(&str, usize); 8] =
        [("G", 12), ("E", 9), ("V", 16), ("Z", 15), ("X", 15), ("C", 10), ("T", 5), ("P", 9)];

    fn numbers() -> Vec<String> {
        THEMES
            .iter()
            .flat_map(|(theme, count)| (1..=*count).map(move |number| format!("{theme}{number}")))
            .collect()
    }

    /// Returns the numbers without an id.
    fn uncovered(ids: &[&str]) -> Vec<String> {
        let stands_for = |id: &str, number: &str| {
            id.strip_prefix(number).is_some_and(|rest| rest.is_empty() || rest.starts_with('-'))
        };
        numbers().into_iter().filter(|number| !ids.iter().any(|id| stands_for(id, number))).collect()
    }

    #[test]
    fn every_number_of_the_catalogue_has_a_row_and_a_case() {
        assert_eq!(numbers().len(), 91);
        let rows: Vec<_> = CATALOGUE.iter().map(|row| row.id.to_owned()).collect();
        let [stated, found] = [numbers(), rows].map(|mut list| {
            list.sort();
            list
        });
        assert_eq!(stated, found);
        let all = [ids(), file_ids()].concat();
        assert_eq!(uncovered(&all), Vec::<String>::new());
        for id in &all {
            assert!(catalogue_row(id).is_some(), "{id} has no row");
        }
    }

    #[test]
    fn a_case_that_is_left_out_is_noticed() {
        let without: Vec<_> = ids().into_iter().filter(|id| *id != "X1" && *id != "G7").collect();
        assert_eq!(uncovered(&without), ["G7", "X1", "C6", "T5"]);
    }

    #[test]
    fn cases_carry_their_row() {
        for id in ["V1", "V10-24", "E2-400-far"] {
            let case = case(id, Scale { rays: 1, ..Scale::QUICK }).expect("the id is in the catalogue");
            let row = catalogue_row(id).expect("it has a row");
            assert_eq!(
                (case.measure, case.target, case.largest_dt),
                (row.measure, row.target, row.largest_dt)
            );
            assert!(!case.measure.is_empty() && !format!("{}", case.target.fragments).is_empty());
        }
        assert_eq!(catalogue_row("Z99"), None);
        // Refused files have no rays, and cases with rays are not refused.
        for row in CATALOGUE {
            let refused = row.target.primitives == Target::Refused;
            assert_eq!(refused, row.target.fragments == Target::Refused, "{}", row.id);
            let is_file = file_ids().iter().any(|id| catalogue_row(id) == Some(row));
            assert_eq!(refused, is_file, "{}", row.id);
        }
    }
}
