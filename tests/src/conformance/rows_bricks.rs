//! Rows of bricks.

use super::row::{Cases, Row, Tier};

/// All rows of bricks.
pub(super) const ROWS: &[Row] = &[
    // These rows have faces of a cube: 16 columns along a side and few slices, then as many as a scene of
    // three hundred thousand triangles gets.
    Row::exact(
        "bricks-cube-16",
        "bricks",
        &[("views", "cube"), ("grid", "16"), ("slices", "12")],
        Tier::Quick,
        Cases::All,
    ),
    Row::exact(
        "bricks-cube-128",
        "bricks",
        &[("views", "cube"), ("grid", "128")],
        Tier::Quick,
        Cases::Shallow,
    ),
    // These rows have cells along the axes: as many as the rule gives, then few, then many.
    Row::exact("bricks-axes", "bricks", &[], Tier::Quick, Cases::Shallow),
    Row::exact("bricks-axes-16", "bricks", &[("grid", "16")], Tier::Full, Cases::All),
    Row::exact("bricks-axes-128", "bricks", &[("grid", "128")], Tier::Full, Cases::Shallow),
];
