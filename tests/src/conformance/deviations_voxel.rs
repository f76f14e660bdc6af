//! Voxels with axis A-buffers: laws and deviations of both systems.

use super::deviations::{chances, deviation, line};
use super::{Deviation, Law};

const THIN: &str = "thinner than a cell, so that no cell's centre is covered";
const SMALL: &str = "parts smaller than a cell of the cube that holds the whole scene";
const CELL: &str = "triangles as large as a cell: whether they cover a centre depends on where they lie";
const SIDE: &str = "flat scenes lie in the cube's middle, where voxels meet: a stretch that begins on the surface begins on either side of it";
const EVEN: &str = "surfaces that coincide in even numbers turn no parity, and opposite normals no axis";
const STEPS: &str = "t is where a parity turns, at a fragment's depth or a cell's side: up to a cell from a surface that leans";
const LEAVING: &str = "a ray that leaves a surface begins on either side of its samples";
const SEVERAL: &str = "several surfaces within one step: an even number turns no parity, and the votes of one take the other's axis";
const EDGE: &str = "at edges a voxel is searched along the axis of one of the surfaces that meet there";

const BORDER: &str = "triangles of few cells, whose borders are a cell wide";
const COARSE: &str = "coordinates are so coarse that neighbouring triangles lean against each other far more than the surface bends";
const SEAM: &str =
    "triangles that meet are kept in different views: at their edge neither may cover a cell's centre";
const GRAZING: &str = "met at grazing angles, where borders are wide";

/// Cases whose errors fall with the size of a cell as others do, from a higher start.
pub(super) const LAWS: &[Law] = &[
    line("E2-far", COARSE, 6.2),
    line("E2-400", BORDER, 1.2),
    chances("E2-400-far", COARSE, 55.0),
    line("V11", SEAM, 2.1),
    line("V15", SEAM, 1.5),
    line("V15-near", GRAZING, 9.7),
    line("V15-vertex", GRAZING, 10.1),
    line("V5", SEAM, 5.5),
    line("V6", SEAM, 1.7),
    line("V8", SEAM, 1.1),
    line("V9", SEAM, 1.1),
    line("V10-6", SEAM, 0.9),
    line("V10-24", SEAM, 0.8),
    line("V10-120", SEAM, 0.8),
    line("Z2-4", SEAM, 0.9),
    line("Z2-5", SEAM, 1.3),
    line("Z2-6", COARSE, 10.6),
    line("X12", BORDER, 1.2),
    line("C3", BORDER, 1.1),
    line("C3-random", BORDER, 1.4),
    line("C4", BORDER, 7.7),
    line("C5", BORDER, 17.0),
    line("T4", BORDER, 0.9),
    line("P1", BORDER, 6.5),
];

/// Planes in 16 x 16 cells a view.
pub(super) const ROBUST_16: &[Deviation] =
    &[deviation("Z6-pixel", SMALL, 0.99, 1.0), deviation("Z7", SMALL, 0.4, 0.626)];

/// Planes in 64 x 64 cells a view.
pub(super) const ROBUST_64: &[Deviation] = &[
    deviation("G1", THIN, 0.699, 1.0),
    deviation("G2", THIN, 0.99, 1.0),
    deviation("G7", THIN, 0.49, 0.767),
    deviation("G10", SMALL, 0.274, 0.429),
    deviation("V14", SMALL, 0.4, 0.626),
    deviation("V16", SMALL, 0.99, 1.0),
    deviation("Z1", SMALL, 0.616, 0.964),
    deviation("Z15", SMALL, 0.636, 0.996),
    deviation("Z3-3", SMALL, 0.524, 0.82),
    deviation("Z3-4", SMALL, 0.522, 0.816),
    deviation("Z3-5", SMALL, 0.522, 0.816),
    deviation("Z13", SMALL, 0.42, 0.658),
    deviation("X7", SMALL, 0.99, 1.0),
    deviation("C7", SMALL, 0.288, 0.45),
    deviation("T2", SMALL, 0.99, 1.0),
];

/// Planes in 128 x 128 cells a view.
pub(super) const ROBUST_128: &[Deviation] = &[
    deviation("G1", THIN, 0.699, 1.0),
    deviation("G2", THIN, 0.99, 1.0),
    deviation("G7", THIN, 0.49, 0.767),
    deviation("G10", SMALL, 0.274, 0.429),
    deviation("V14", SMALL, 0.2, 0.314),
    deviation("V16", SMALL, 0.99, 1.0),
    deviation("Z1", SMALL, 0.575, 0.9),
    deviation("Z15", SMALL, 0.596, 0.932),
    deviation("Z3-3", SMALL, 0.524, 0.82),
    deviation("Z3-4", SMALL, 0.522, 0.816),
    deviation("Z3-5", SMALL, 0.522, 0.816),
    deviation("Z13", SMALL, 0.21, 0.329),
    deviation("X7", SMALL, 0.99, 1.0),
    deviation("X10", CELL, 0.147, 0.23),
    deviation("C7", SMALL, 0.288, 0.45),
    deviation("T2", SMALL, 0.99, 1.0),
];

/// Parities in 16 x 16 cells, all views.
pub(super) const HU_16: &[Deviation] = &[
    deviation("C10", EVEN, 0.99, 1.0),
    deviation("Z6", SEVERAL, 0.787, 1.0),
    deviation("Z6-pixel", SMALL, 0.99, 1.0),
    deviation("Z7", SMALL, 0.4, 0.626),
];

/// Parities in 128 x 128 cells, all views.
pub(super) const HU_128: &[Deviation] = &[
    deviation("V10-24", EDGE, 0.013, 0.033),
    deviation("V10-120", EDGE, 0.012, 0.03),
    deviation("G1", THIN, 0.699, 1.0),
    deviation("G2", THIN, 0.99, 1.0),
    deviation("G7", THIN, 0.49, 0.767),
    deviation("G10", SMALL, 0.537, 0.84),
    deviation("G11", STEPS, 0.088, 0.138),
    deviation("E1", SIDE, 0.551, 0.862),
    deviation("E3", SIDE, 0.14, 0.22),
    deviation("E4", SIDE, 0.38, 0.594),
    deviation("E6", EDGE, 0.03, 0.047),
    deviation("V2-0", STEPS, 0.118, 0.185),
    deviation("V4", STEPS, 0.316, 0.494),
    deviation("V11", EDGE, 0.041, 0.065),
    deviation("V12", SIDE, 0.584, 0.914),
    deviation("V14", SMALL, 0.449, 0.703),
    deviation("V15-near", LEAVING, 0.231, 0.362),
    deviation("V15-vertex", LEAVING, 0.25, 0.392),
    deviation("V15-surface", EDGE, 0.032, 0.052),
    deviation("V16", SMALL, 0.427, 0.668),
    deviation("V5", SIDE, 0.241, 0.378),
    deviation("Z1", SMALL, 0.762, 1.0),
    deviation("Z15", SMALL, 0.726, 1.0),
    deviation("Z3-3", SMALL, 0.538, 0.842),
    deviation("Z3-4", SMALL, 0.532, 0.832),
    deviation("Z3-5", SMALL, 0.537, 0.84),
    deviation("Z5", EVEN, 0.4, 0.626),
    deviation("Z8", SIDE, 0.05, 0.079),
    deviation("Z11-5", SEVERAL, 0.223, 0.349),
    deviation("Z11-6", SEVERAL, 0.4, 0.626),
    deviation("Z11-7", EVEN, 0.99, 1.0),
    deviation("Z13", SMALL, 0.726, 1.0),
    deviation("Z4", EVEN, 0.99, 1.0),
    deviation("Z14", SIDE, 0.088, 0.139),
    deviation("X1", SEVERAL, 0.79, 1.0),
    deviation("X2", SEVERAL, 0.737, 1.0),
    deviation("X4", EDGE, 0.068, 0.108),
    deviation("X7", SMALL, 0.99, 1.0),
    deviation("X9", EVEN, 0.99, 1.0),
    deviation("X10", SEVERAL, 0.249, 0.391),
    deviation("X11", SEVERAL, 0.275, 0.432),
    deviation("X12", SEVERAL, 0.719, 1.0),
    deviation("X13", SIDE, 0.024, 0.037),
    deviation("X14", EDGE, 0.038, 0.061),
    deviation("X15", STEPS, 0.26, 0.408),
    deviation("C3-random", BORDER, 0.017, 0.027),
    deviation("C4", SEVERAL, 0.45, 0.704),
    deviation("C5", SEVERAL, 0.673, 1.0),
    deviation("C7", SMALL, 0.289, 0.452),
    deviation("C9", SEVERAL, 0.298, 0.467),
    deviation("T1", EDGE, 0.046, 0.073),
    deviation("T2", SMALL, 0.99, 1.0),
    deviation("T3", EVEN, 0.99, 1.0),
    deviation("T4", EDGE, 0.024, 0.037),
    deviation("P5", LEAVING, 0.202, 0.316),
    deviation("P1", SEVERAL, 0.247, 0.387),
    deviation("P2", EVEN, 0.99, 1.0),
    deviation("P6", EDGE, 0.045, 0.072),
    deviation("P7", LEAVING, 0.286, 0.448),
];

/// Parities in 16 x 16 cells, one view a voxel.
pub(super) const SELECTIVE_16: &[Deviation] = &[
    deviation("C10", EVEN, 0.99, 1.0),
    deviation("Z6", SEVERAL, 0.787, 1.0),
    deviation("Z6-pixel", SMALL, 0.99, 1.0),
    deviation("Z7", SMALL, 0.4, 0.626),
];

/// Parities in 128 x 128 cells, one view a voxel.
pub(super) const SELECTIVE_128: &[Deviation] = &[
    deviation("G1", THIN, 0.699, 1.0),
    deviation("G2", THIN, 0.99, 1.0),
    deviation("G7", THIN, 0.49, 0.767),
    deviation("G10", SMALL, 0.537, 0.84),
    deviation("G11", STEPS, 0.092, 0.145),
    deviation("E2-400", EDGE, 0.029, 0.046),
    deviation("E2-400-far", EDGE, 0.039, 0.061),
    deviation("E5", EDGE, 0.092, 0.144),
    deviation("E6", EDGE, 0.03, 0.047),
    deviation("E8", EDGE, 0.693, 1.0),
    deviation("V2-0", STEPS, 0.117, 0.184),
    deviation("V4", STEPS, 0.3, 0.469),
    deviation("V11", EDGE, 0.041, 0.065),
    deviation("V14", SMALL, 0.449, 0.703),
    deviation("V15-near", LEAVING, 0.241, 0.377),
    deviation("V15-vertex", LEAVING, 0.262, 0.411),
    deviation("V15-surface", EDGE, 0.032, 0.051),
    deviation("V16", SMALL, 0.405, 0.634),
    deviation("V5", EDGE, 0.118, 0.186),
    deviation("V6", EDGE, 0.056, 0.088),
    deviation("V8", EDGE, 0.06, 0.094),
    deviation("V9", EDGE, 0.019, 0.03),
    deviation("V10-3", EDGE, 0.02, 0.032),
    deviation("V10-6", EDGE, 0.021, 0.033),
    deviation("V10-24", EDGE, 0.022, 0.034),
    deviation("V10-120", EDGE, 0.022, 0.034),
    deviation("Z1", SMALL, 0.762, 1.0),
    deviation("Z15", SMALL, 0.726, 1.0),
    deviation("Z2-4", EDGE, 0.024, 0.037),
    deviation("Z2-5", EDGE, 0.026, 0.041),
    deviation("Z2-6", EDGE, 0.091, 0.143),
    deviation("Z3-3", SMALL, 0.538, 0.841),
    deviation("Z3-4", SMALL, 0.532, 0.832),
    deviation("Z3-5", SMALL, 0.538, 0.841),
    deviation("Z5", EVEN, 0.4, 0.626),
    deviation("Z11-5", SEVERAL, 0.223, 0.349),
    deviation("Z11-6", SEVERAL, 0.4, 0.626),
    deviation("Z11-7", EVEN, 0.99, 1.0),
    deviation("Z13", SMALL, 0.726, 1.0),
    deviation("Z4", EVEN, 0.99, 1.0),
    deviation("X1", SEVERAL, 0.79, 1.0),
    deviation("X2", SEVERAL, 0.747, 1.0),
    deviation("X4", EDGE, 0.071, 0.111),
    deviation("X7", SMALL, 0.99, 1.0),
    deviation("X9", EVEN, 0.99, 1.0),
    deviation("X10", SEVERAL, 0.99, 1.0),
    deviation("X11", SEVERAL, 0.275, 0.432),
    deviation("X12", SEVERAL, 0.99, 1.0),
    deviation("X14", EDGE, 0.104, 0.163),
    deviation("X15", STEPS, 0.284, 0.445),
    deviation("C3", EDGE, 0.028, 0.045),
    deviation("C3-random", EDGE, 0.064, 0.102),
    deviation("C4", SEVERAL, 0.413, 0.647),
    deviation("C5", SEVERAL, 0.675, 1.0),
    deviation("C7", SMALL, 0.289, 0.452),
    deviation("C9", SEVERAL, 0.298, 0.467),
    deviation("T1", EDGE, 0.11, 0.173),
    deviation("T2", SMALL, 0.99, 1.0),
    deviation("T3", EVEN, 0.99, 1.0),
    deviation("T4", EDGE, 0.151, 0.237),
    deviation("P5", LEAVING, 0.216, 0.338),
    deviation("P1", SEVERAL, 0.366, 0.573),
    deviation("P2", EVEN, 0.99, 1.0),
    deviation("P6", EDGE, 0.045, 0.072),
    deviation("P7", LEAVING, 0.296, 0.464),
];
