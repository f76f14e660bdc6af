//! Laws and deviations of the layered depth cube's rows.

use super::deviations::{deviation, line};
use super::{Deviation, Law};

const COARSE: &str = "coordinates are so coarse that neighbouring triangles lean against each other far more than the surface bends";
const SILHOUETTE: &str = "silhouettes: a plane represents what is next to it in its cell";
const BORDER: &str = "triangles of few cells, whose planes protrude by up to a cell";
const AT_SURFACE: &str =
    "rays start at the surface, where a neighbour's plane may lie in front of what they hit";

const THIN: &str = "thinner than a cell, so that no cell's centre is covered";
const LEANING: &str = "fragments of surfaces with a slope above the tolerance per cell have gaps, others are hit up to the tolerance early";
const CENTRE: &str =
    "t is that of a fragment at its cell's centre: off by up to the rise of the surface over half a cell";
const BESIDE: &str =
    "triangles of few cells, whose fragments are hit up to the end of their cells, not of the triangles";
const SHELL: &str = "surfaces closer together than the tolerance or the spacing of 16-bit depths are one";
const LEAVING: &str = "a ray that leaves a surface hits the fragments next to its own";
const NEAR: &str =
    "what lies within a cell and the tolerance of the triangle that a ray leaves is not seen from it";
const DETAIL: &str = "detail smaller than a cell, most of which covers no cell's centre";

/// Laws of cases whose errors fall with the size of a cell like those of others, but from a higher start.
pub(super) const PLANES_LAWS: &[Law] = &[
    line("E2", SILHOUETTE, 2.0),
    line("E2-far", COARSE, 12.0),
    line("E2-400-far", COARSE, 36.0),
    line("V5", SILHOUETTE, 1.8),
    line("V8", SILHOUETTE, 3.0),
    line("V11", SILHOUETTE, 3.0),
    line("V15", SILHOUETTE, 2.0),
    line("V15-near", AT_SURFACE, 13.0),
    line("V15-vertex", AT_SURFACE, 14.0),
    line("Z2-5", COARSE, 2.4),
    line("Z2-6", COARSE, 20.0),
    line("C4", BORDER, 12.0),
    line("C5", BORDER, 14.0),
    line("X6", SILHOUETTE, 1.0),
    line("T1", BORDER, 1.2),
    line("T4", BORDER, 1.4),
    line("P1", "spheres inside spheres, seen from outside, half of each at grazing angles", 11.0),
    line("P7", AT_SURFACE, 1.8),
];

/// Deviations of fragments' own depths in 64 x 64 cells per view.
pub(super) const SLOPE_64: &[Deviation] = &[
    deviation("G11", CENTRE, 0.342, 0.534),
    deviation("G12", CENTRE, 0.069, 0.108),
    deviation("V2-0", CENTRE, 0.37, 0.578),
    deviation("V4", CENTRE, 0.54, 0.844),
    deviation("V15-near", AT_SURFACE, 0.504, 0.787),
    deviation("V15-vertex", AT_SURFACE, 0.509, 0.796),
    deviation("X2", CENTRE, 0.18, 0.281),
    deviation("X10", CENTRE, 0.08, 0.125),
    deviation("X12", CENTRE, 0.454, 0.71),
    deviation("X15", CENTRE, 0.463, 0.724),
    deviation("C4", BESIDE, 0.209, 0.326),
    deviation("C5", BESIDE, 0.245, 0.383),
    deviation("P5", LEAVING, 0.478, 0.747),
    deviation("P1", LEAVING, 0.552, 0.862),
    deviation("P7", LEAVING, 0.508, 0.794),
    deviation("V8", CENTRE, 0.032, 0.05),
    deviation("Z2-6", COARSE, 0.038, 0.061),
    deviation("T1", CENTRE, 0.033, 0.053),
    deviation("T4", CENTRE, 0.047, 0.074),
];

/// Deviations of tolerance, 16-bit depths and the rasterizer's coverage in 16 x 16 cells per view.
pub(super) const PUBLISHED_16: &[Deviation] = &[
    deviation("Z6", SHELL, 0.704, 1.0),
    deviation("Z6-pixel", THIN, 0.99, 1.0),
    deviation("Z7", DETAIL, 0.4, 0.626),
];

/// Deviations as [`PUBLISHED_16`], in 64 x 64 cells per view.
pub(super) const PUBLISHED_64: &[Deviation] = &[
    deviation("G1", THIN, 0.699, 1.0),
    deviation("G2", THIN, 0.99, 1.0),
    deviation("G7", THIN, 0.49, 0.767),
    deviation("G10", DETAIL, 0.745, 1.0),
    deviation("G11", LEANING, 0.37, 0.58),
    deviation("G12", LEANING, 0.282, 0.441),
    deviation("E2", LEANING, 0.162, 0.319),
    deviation("E2-far", LEANING, 0.16, 0.315),
    deviation("E2-400", LEANING, 0.187, 0.368),
    deviation("E2-400-far", LEANING, 0.219, 0.43),
    deviation("E8", LEANING, 0.029, 0.047),
    deviation("V2-0", LEANING, 0.485, 0.759),
    deviation("V4", LEANING, 0.7, 1.0),
    deviation("V11", LEANING, 0.033, 0.053),
    deviation("V13", LEANING, 0.074, 0.117),
    deviation("V14", DETAIL, 0.456, 0.714),
    deviation("V15", LEANING, 0.169, 0.333),
    deviation("V15-near", LEAVING, 0.314, 0.492),
    deviation("V15-vertex", LEAVING, 0.346, 0.542),
    deviation("V15-surface", LEAVING, 0.108, 0.17),
    deviation("V16", THIN, 0.99, 1.0),
    deviation("V5", LEANING, 0.284, 0.445),
    deviation("V6", LEANING, 0.319, 0.499),
    deviation("V7", LEANING, 0.464, 0.727),
    deviation("V8", LEANING, 0.198, 0.311),
    deviation("V9", LEANING, 0.232, 0.364),
    deviation("V10-3", LEANING, 0.232, 0.363),
    deviation("V10-6", LEANING, 0.232, 0.364),
    deviation("V10-24", LEANING, 0.245, 0.383),
    deviation("V10-120", LEANING, 0.13, 0.204),
    deviation("Z1", DETAIL, 0.641, 1.0),
    deviation("Z15", DETAIL, 0.648, 1.0),
    deviation("Z2-4", LEANING, 0.183, 0.287),
    deviation("Z2-5", LEANING, 0.182, 0.286),
    deviation("Z2-6", LEANING, 0.246, 0.385),
    deviation("Z3-3", SHELL, 0.524, 0.82),
    deviation("Z3-4", SHELL, 0.522, 0.816),
    deviation("Z3-5", SHELL, 0.522, 0.816),
    deviation("Z11-1", SHELL, 0.196, 0.307),
    deviation("Z11-2", SHELL, 0.4, 0.625),
    deviation("Z11-3", SHELL, 0.4, 0.625),
    deviation("Z11-4", SHELL, 0.4, 0.625),
    deviation("Z11-5", SHELL, 0.446, 0.698),
    deviation("Z11-6", SHELL, 0.99, 1.0),
    deviation("Z13", DETAIL, 0.558, 0.874),
    deviation("X2", DETAIL, 0.273, 0.428),
    deviation("X7", THIN, 0.99, 1.0),
    deviation("X9", DETAIL, 0.052, 0.082),
    deviation("X10", DETAIL, 0.104, 0.164),
    deviation("X11", SHELL, 0.99, 1.0),
    deviation("X12", DETAIL, 0.763, 1.0),
    deviation("X15", LEANING, 0.666, 1.0),
    deviation("C2", LEANING, 0.03, 0.047),
    deviation("C3", LEANING, 0.195, 0.306),
    deviation("C4", LEANING, 0.2, 0.314),
    deviation("C5", DETAIL, 0.457, 0.715),
    deviation("C7", DETAIL, 0.288, 0.451),
    deviation("C8", LEANING, 0.034, 0.054),
    deviation("C9", SHELL, 0.161, 0.253),
    deviation("T1", LEANING, 0.13, 0.205),
    deviation("T2", THIN, 0.99, 1.0),
    deviation("T4", LEANING, 0.102, 0.161),
    deviation("P3", LEAVING, 0.396, 0.619),
    deviation("P5", LEAVING, 0.296, 0.464),
    deviation("P1", LEAVING, 0.5, 0.782),
    deviation("P8-2", NEAR, 0.48, 0.75),
    deviation("P7", LEAVING, 0.377, 0.59),
];
