//! Logged steps of traversals, and their text.

use std::fmt;
use std::ops::Deref;

use bytemuck::{Pod, Zeroable};
use rasray_shaders_glsl::{constants::contract as numbers, records};

use crate::{PRIMITIVE_NONE, PRIMITIVE_UNKNOWN};

/// Action of a traversal.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum StepKind {
    /// A dispatch began for the ray.
    Round,
    /// A view was entered.
    View,
    /// A cell was visited, to be searched or skipped.
    Cell,
    /// A node of a hierarchy was visited.
    Node,
    /// A bucket or list was searched.
    List,
    /// A cell, a list, or the rest of a list or of the ray was skipped.
    Skip,
    /// An entry of a list was read.
    Entry,
    /// A primitive was tested.
    Test,
    /// A fragment was compared by its depth.
    Fragment,
    /// The best hit was replaced.
    Best,
    /// The work budget of a dispatch was used up.
    Pause,
    /// The ray was answered.
    End,
    /// The visited voxel is occupied; its contents are searched in cells of their own.
    Occupied,
    /// The number has no meaning here.
    Unknown,
}

/// Result of the test of a primitive.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum TestVerdict {
    /// The primitive is the best hit so far.
    Accepted,
    /// The ray excludes this primitive.
    Excluded,
    /// The ray passes outside the triangle.
    Outside,
    /// The ray runs along the triangle's plane, or the triangle has no area.
    Parallel,
    /// The hit is at or before `t_min`, or within rounding of the origin.
    Before,
    /// The hit is at or beyond `t_max`.
    Beyond,
    /// The hit is outside of the cell's t interval, or of the depth interval searched.
    OutsideCell,
    /// The hit is on the triangle's plane, but too far from the triangle.
    OutOfReach,
    /// The ray starts on the triangle's plane.
    Leaving,
    /// The hit is not better than the best one.
    NotBetter,
    /// The alpha test refused the hit.
    Transparent,
    /// The ray ignores backs of single-sided triangles, and meets one.
    BackFace,
    /// The number has no meaning here.
    Unknown,
}

/// Reason of a skip.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum SkipReason {
    /// The cell or list is empty.
    Empty,
    /// No content is within the interval searched.
    Outside,
    /// The contents lie behind the best hit.
    Behind,
    /// The rest of a sorted list lies beyond the depth interval searched.
    Past,
    /// The rest of the ray's range is outside of the bounds of the geometry.
    Bounds,
    /// The number has no meaning here.
    Unknown,
}

/// One step of a logged traversal, as the device writes it; the methods give the meaning of its words.
#[repr(transparent)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct TraceStep(pub records::TraceStep);

impl Deref for TraceStep {
    type Target = records::TraceStep;

    fn deref(&self) -> &Self::Target {
        &self.0
    }
}

impl TraceStep {
    /// Returns the action of the step.
    pub fn kind(&self) -> StepKind {
        match self.kind {
            numbers::STEP_ROUND => StepKind::Round,
            numbers::STEP_VIEW => StepKind::View,
            numbers::STEP_CELL => StepKind::Cell,
            numbers::STEP_NODE => StepKind::Node,
            numbers::STEP_LIST => StepKind::List,
            numbers::STEP_SKIP => StepKind::Skip,
            numbers::STEP_ENTRY => StepKind::Entry,
            numbers::STEP_TEST => StepKind::Test,
            numbers::STEP_FRAGMENT => StepKind::Fragment,
            numbers::STEP_BEST => StepKind::Best,
            numbers::STEP_PAUSE => StepKind::Pause,
            numbers::STEP_END => StepKind::End,
            numbers::STEP_OCCUPIED => StepKind::Occupied,
            _ => StepKind::Unknown,
        }
    }

    /// Returns the result of a test or of the comparison of a fragment; `None` for other steps.
    pub fn verdict(&self) -> Option<TestVerdict> {
        if !matches!(self.kind(), StepKind::Test | StepKind::Fragment) {
            return None;
        }
        Some(match self.b {
            numbers::TEST_ACCEPTED => TestVerdict::Accepted,
            numbers::TEST_EXCLUDED => TestVerdict::Excluded,
            numbers::TEST_OUTSIDE => TestVerdict::Outside,
            numbers::TEST_PARALLEL => TestVerdict::Parallel,
            numbers::TEST_BEFORE => TestVerdict::Before,
            numbers::TEST_BEYOND => TestVerdict::Beyond,
            numbers::TEST_OUTSIDE_CELL => TestVerdict::OutsideCell,
            numbers::TEST_OUT_OF_REACH => TestVerdict::OutOfReach,
            numbers::TEST_LEAVING => TestVerdict::Leaving,
            numbers::TEST_NOT_BETTER => TestVerdict::NotBetter,
            numbers::TEST_TRANSPARENT => TestVerdict::Transparent,
            numbers::TEST_BACK_FACE => TestVerdict::BackFace,
            _ => TestVerdict::Unknown,
        })
    }

    /// Returns the reason of a skip; `None` for other steps.
    pub fn skip_reason(&self) -> Option<SkipReason> {
        if self.kind() != StepKind::Skip {
            return None;
        }
        Some(match self.a {
            numbers::SKIP_EMPTY => SkipReason::Empty,
            numbers::SKIP_OUTSIDE => SkipReason::Outside,
            numbers::SKIP_BEHIND => SkipReason::Behind,
            numbers::SKIP_PAST => SkipReason::Past,
            numbers::SKIP_BOUNDS => SkipReason::Bounds,
            _ => SkipReason::Unknown,
        })
    }

    /// Returns view, column and row of a cell; `None` for other steps. Columns and rows of a cube's border
    /// are -1 and the resolution.
    pub fn cell(&self) -> Option<(u32, i32, i32)> {
        (self.kind() == StepKind::Cell).then(|| (self.a, self.b.cast_signed(), self.c.cast_signed()))
    }

    /// Returns true if the ray enters a view. The near region, and all triangles tested one by one, are none.
    pub fn is_view(&self) -> bool {
        self.kind() == StepKind::View && ![numbers::VIEW_NEAR, numbers::VIEW_ALL].contains(&self.a)
    }

    /// Returns the primitive of a test, a fragment, a best hit or an answer, if it is known.
    pub fn primitive(&self) -> Option<u32> {
        let id = match self.kind() {
            StepKind::Test | StepKind::Fragment | StepKind::Best => self.a,
            StepKind::End => self.b,
            _ => return None,
        };
        (id != PRIMITIVE_NONE && id != PRIMITIVE_UNKNOWN).then_some(id)
    }
}

/// Returns the text for a primitive.
fn name_of(primitive: u32) -> String {
    match primitive {
        PRIMITIVE_NONE => "no triangle".to_owned(),
        PRIMITIVE_UNKNOWN => "a fragment without id".to_owned(),
        id => format!("triangle {id}"),
    }
}

impl fmt::Display for TraceStep {
    /// Writes one line without indentation.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let records::TraceStep { a, b, t_low, t_high, .. } = self.0;
        match self.kind() {
            StepKind::Round if self.b != 0 => write!(f, "round {a} of the next part"),
            StepKind::Round => write!(f, "round {a}"),
            StepKind::View if a == numbers::VIEW_NEAR => write!(f, "near region, t {t_low} to {t_high}"),
            StepKind::View if a == numbers::VIEW_ALL => {
                write!(f, "all triangles one by one, t {t_low} to {t_high}")
            }
            StepKind::View if a == numbers::VIEW_CAMERA => {
                write!(f, "the camera's view, t {t_low} to {t_high}")
            }
            StepKind::View => write!(f, "view {a}, t {t_low} to {t_high}"),
            StepKind::Cell => {
                let (view, x, y) = (a, b.cast_signed(), self.c.cast_signed());
                write!(f, "cell ({x}, {y}) of view {view}, t {t_low} to {t_high}")
            }
            StepKind::Node => write!(f, "node {a}, first {b}, t {t_low} to {t_high}"),
            StepKind::List if b == 0 => write!(f, "bucket {a}: empty"),
            StepKind::List => write!(f, "bucket {a} from entry {b}, depths {t_low} to {t_high}"),
            StepKind::Skip => match self.skip_reason().unwrap_or(SkipReason::Unknown) {
                SkipReason::Empty => write!(f, "skipped: empty"),
                SkipReason::Outside => write!(f, "skipped: nothing within {t_low} to {t_high}"),
                SkipReason::Behind => write!(f, "ended: t {t_low} lies behind the best hit"),
                SkipReason::Past => write!(f, "rest of the list skipped: beyond {t_low} to {t_high}"),
                SkipReason::Bounds => write!(f, "ended: nothing of the geometry after t {t_low}"),
                SkipReason::Unknown => write!(f, "skipped: reason {a}"),
            },
            StepKind::Entry => write!(f, "entry {a}, depth {t_low}"),
            StepKind::Test => write!(f, "{}: {}", name_of(a), Words(self)),
            StepKind::Fragment => write!(f, "{} at depth {t_high}: {}", name_of(a), Words(self)),
            StepKind::Best => write!(f, "best hit: {}, t {t_low}", name_of(a)),
            StepKind::Pause => write!(f, "pause: work budget used up"),
            StepKind::End if a == numbers::TRACE_NOT_READY => write!(f, "answer: the structure is not built"),
            StepKind::End => write!(f, "answer: {}, t {t_low}", name_of(b)),
            StepKind::Occupied => write!(f, "occupied, searched along the axes {a:#05b}"),
            StepKind::Unknown => write!(f, "step {} ({a}, {b}, {}, {t_low}, {t_high})", self.kind, self.c),
        }
    }
}

/// Text of the result of a test, with t if there is one.
struct Words<'a>(&'a TraceStep);

impl fmt::Display for Words<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let t = self.0.t_low;
        match self.0.verdict().unwrap_or(TestVerdict::Unknown) {
            TestVerdict::Accepted => write!(f, "accepted, t {t}"),
            TestVerdict::Excluded => write!(f, "excluded by the ray"),
            TestVerdict::Outside => write!(f, "passed outside"),
            TestVerdict::Parallel => write!(f, "parallel to the ray, or without area"),
            TestVerdict::Before => write!(f, "refused, t {t} is before the range"),
            TestVerdict::Beyond => write!(f, "refused, t {t} is beyond the range"),
            TestVerdict::OutsideCell if self.0.kind() == StepKind::Fragment => {
                write!(f, "refused, outside of the depths searched")
            }
            TestVerdict::OutsideCell => write!(f, "refused, t {t} is outside of the cell"),
            TestVerdict::OutOfReach => write!(f, "refused, t {t} is too far from the triangle"),
            TestVerdict::Leaving => write!(f, "refused, the ray starts on the plane"),
            TestVerdict::NotBetter => write!(f, "t {t} is no better than the best hit"),
            TestVerdict::Transparent => write!(f, "transparent at t {t}"),
            TestVerdict::BackFace => write!(f, "the ray passes its back, t {t}"),
            TestVerdict::Unknown => write!(f, "verdict {}", self.0.b),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn step(kind: u32, [a, b, c]: [u32; 3], [t_low, t_high]: [f32; 2]) -> TraceStep {
        TraceStep(records::TraceStep { kind, round: 0, a, b, c, t_low, t_high })
    }

    #[test]
    fn steps_read_as_they_were_meant() {
        let cell = step(numbers::STEP_CELL, [3, u32::MAX, 7], [0.5, 1.5]);
        assert_eq!(cell.cell(), Some((3, -1, 7)));
        assert_eq!(cell.to_string(), "cell (-1, 7) of view 3, t 0.5 to 1.5");
        let test = step(numbers::STEP_TEST, [12, numbers::TEST_OUTSIDE_CELL, 0], [2.5, 0.0]);
        assert_eq!((test.primitive(), test.verdict()), (Some(12), Some(TestVerdict::OutsideCell)));
        assert_eq!(test.to_string(), "triangle 12: refused, t 2.5 is outside of the cell");
        let end = step(numbers::STEP_END, [numbers::TRACE_MISS, PRIMITIVE_NONE, 0], [4.0, 4.0]);
        assert_eq!((end.primitive(), end.verdict(), end.skip_reason()), (None, None, None));
        assert_eq!(end.to_string(), "answer: no triangle, t 4");
        for (view, name) in [
            (5, "view 5"),
            (numbers::VIEW_NEAR, "near region"),
            (numbers::VIEW_CAMERA, "the camera's view"),
            (numbers::VIEW_ALL, "all triangles one by one"),
        ] {
            let entered = step(numbers::STEP_VIEW, [view, 0, 0], [1.0, 2.0]);
            assert_eq!(entered.to_string(), format!("{name}, t 1 to 2"));
        }
        let skip = step(numbers::STEP_SKIP, [numbers::SKIP_PAST, 0, 0], [1.0, 2.0]);
        assert_eq!(skip.skip_reason(), Some(SkipReason::Past));
    }

    /// Numbers that a newer shader might write are shown as numbers, and not as another step.
    #[test]
    fn unknown_numbers_stay_visible() {
        let unknown = step(99, [1, 2, 3], [0.0; 2]);
        assert_eq!(unknown.kind(), StepKind::Unknown);
        assert_eq!(unknown.to_string(), "step 99 (1, 2, 3, 0, 0)");
        let verdict = step(numbers::STEP_TEST, [1, 77, 0], [0.0; 2]);
        assert_eq!(verdict.verdict(), Some(TestVerdict::Unknown));
        assert_eq!(step(numbers::STEP_SKIP, [55, 0, 0], [0.0; 2]).skip_reason(), Some(SkipReason::Unknown));
    }
}
