//! Losses by the published rules of DIRT: rates with the quick meshes, which do not fall with the size of
//! tiles.

use super::Deviation;
use super::deviations::deviation;

const EDGE_ON: &str = "a plane seen nearly edge-on is hit by the rays of few of a tile's corners, so that depths and buckets miss part of it";
const PASSED: &str = "tiles crossed in less than half a pixel are skipped, and a hit that lies in one does not count elsewhere";
const GAPS: &str = "tiles whose centre a triangle does not cover do not list it";
const THIN: &str = "thinner than a tile, so that no tile's centre is covered";

/// Largest share of the rays of a case that may be lost, unless stated otherwise.
pub(super) const SHARE: f64 = 0.05;

/// Deviations of all rules, if every tile lists each triangle that reaches into it.
pub(super) const PUBLISHED: &[Deviation] = &[
    deviation("C5", PASSED, 0.037, 0.058),
    deviation("E2-400-far", PASSED, 0.029, 0.065),
    deviation("G11", EDGE_ON, 0.114, 0.178),
    deviation("G12", PASSED, 0.089, 0.139),
    deviation("T2", PASSED, 0.076, 0.119),
    deviation("V2-1", EDGE_ON, 0.103, 0.161),
    deviation("V2-2", EDGE_ON, 0.407, 0.636),
    deviation("V2-3", EDGE_ON, 0.415, 0.649),
    deviation("V2-4", EDGE_ON, 0.396, 0.619),
    deviation("V2-5", EDGE_ON, 0.393, 0.614),
    deviation("V2-6", EDGE_ON, 0.397, 0.62),
    deviation("V3", EDGE_ON, 0.237, 0.37),
    deviation("X9", PASSED, 0.051, 0.079),
];

/// Deviations of all rules in 16 x 16 tiles per face.
pub(super) const PUBLISHED_16: &[Deviation] = &[];

/// Deviations of all rules with the tiles whose centres the rasterizer covers, one pixel per tile.
pub(super) const HARDWARE: &[Deviation] = &[
    deviation("C2", GAPS, 0.064, 0.1),
    deviation("C3", GAPS, 0.431, 0.673),
    deviation("C4", GAPS, 0.066, 0.103),
    deviation("C5", GAPS, 0.335, 0.524),
    deviation("C9", GAPS, 0.055, 0.086),
    deviation("E1", GAPS, 0.218, 0.341),
    deviation("E2", GAPS, 0.22, 0.495),
    deviation("E2-400", GAPS, 0.495, 1.0),
    deviation("E2-400-far", GAPS, 0.46, 1.0),
    deviation("E2-far", GAPS, 0.254, 0.571),
    deviation("E3", GAPS, 0.154, 0.241),
    deviation("E5", GAPS, 0.081, 0.126),
    deviation("E8", GAPS, 0.38, 0.594),
    deviation("E9", GAPS, 0.069, 0.108),
    deviation("G1", THIN, 0.583, 1.0),
    deviation("G11", GAPS, 0.101, 0.158),
    deviation("G12", EDGE_ON, 0.9, 1.0),
    deviation("G2", THIN, 0.9, 1.0),
    deviation("G7", GAPS, 0.491, 0.767),
    deviation("G9", GAPS, 0.407, 0.636),
    deviation("P1", GAPS, 0.486, 0.76),
    deviation("P7", GAPS, 0.089, 0.139),
    deviation("T1", GAPS, 0.096, 0.151),
    deviation("T2", GAPS, 0.521, 0.814),
    deviation("T4", GAPS, 0.105, 0.164),
    deviation("V1", EDGE_ON, 0.9, 1.0),
    deviation("V10-120", GAPS, 0.592, 0.927),
    deviation("V10-24", GAPS, 0.121, 0.188),
    deviation("V10-3", GAPS, 0.128, 0.2),
    deviation("V10-6", GAPS, 0.132, 0.206),
    deviation("V11", GAPS, 0.056, 0.087),
    deviation("V13", GAPS, 0.178, 0.279),
    deviation("V14", GAPS, 0.078, 0.122),
    deviation("V15", GAPS, 0.188, 0.424),
    deviation("V15-near", GAPS, 0.316, 0.494),
    deviation("V15-vertex", GAPS, 0.308, 0.482),
    deviation("V16", THIN, 0.9, 1.0),
    deviation("V2-0", EDGE_ON, 0.07, 0.109),
    deviation("V2-1", EDGE_ON, 0.134, 0.21),
    deviation("V2-2", EDGE_ON, 0.518, 0.809),
    deviation("V2-3", EDGE_ON, 0.9, 1.0),
    deviation("V2-4", EDGE_ON, 0.9, 1.0),
    deviation("V2-5", EDGE_ON, 0.9, 1.0),
    deviation("V2-6", EDGE_ON, 0.9, 1.0),
    deviation("V3", GAPS, 0.094, 0.147),
    deviation("V4", GAPS, 0.08, 0.125),
    deviation("V5", GAPS, 0.154, 0.346),
    deviation("V6", GAPS, 0.17, 0.265),
    deviation("V8", GAPS, 0.167, 0.261),
    deviation("V9", GAPS, 0.14, 0.218),
    deviation("X1", GAPS, 0.1, 0.156),
    deviation("X10", GAPS, 0.136, 0.213),
    deviation("X11", GAPS, 0.084, 0.132),
    deviation("X12", GAPS, 0.258, 0.403),
    deviation("X13", GAPS, 0.07, 0.109),
    deviation("X14", GAPS, 0.099, 0.154),
    deviation("X15", GAPS, 0.106, 0.166),
    deviation("X3", GAPS, 0.283, 0.442),
    deviation("X6", GAPS, 0.077, 0.12),
    deviation("X7", GAPS, 0.102, 0.16),
    deviation("X9", GAPS, 0.185, 0.289),
    deviation("Z1", GAPS, 0.037, 0.058),
    deviation("Z11-6", GAPS, 0.05, 0.079),
    deviation("Z13", GAPS, 0.059, 0.093),
    deviation("Z15", GAPS, 0.036, 0.056),
    deviation("Z2-4", GAPS, 0.209, 0.326),
    deviation("Z2-5", GAPS, 0.233, 0.364),
    deviation("Z2-6", GAPS, 0.227, 0.355),
    deviation("Z3-3", GAPS, 0.068, 0.106),
];
