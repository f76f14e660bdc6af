use super::{Curve, Deviation, Law};

const THIN: &str = "thinner than a cell, so that no cell's centre is covered";
const EDGE_ON: &str = "its plane holds the eye or nearly so, so that few cells' centres are covered or none";
const HALF_OPEN: &str = "a sample counts only if its depth lies in the half-open interval of a step, so that rays pass between the samples of surfaces that face them obliquely";
const SNAPPED: &str =
    "along the seams of the cube's faces, where rays that pass from one to the next are searched in neither";
const THICK: &str = "fragments are voxels of one thickness: rays hit the one in front before what lies closely behind it, or where they pass behind it";
const BORDER: &str = "triangles of few cells, whose borders are a cell wide";
const SHELL: &str = "both sides of the shell lie within one step";
const LEAVING: &str = "a ray that leaves a surface hits the samples next to its own";
const COARSE: &str = "coordinates are so coarse that neighbouring triangles lean against each other far more than the surface bends";

const FEW_CELLS: &str = "triangles of two or three cells, of which the turned view covers other centres";

const FAR_PLATES: &str =
    "plates so far off that they fill a few cells only, all of whose centres are near an edge";
const CORNER: &str = "rays at the ends of the diagonal, where centres of cells lie outside of the quad";
const LEFT_PLATES: &str = "plates so near to where rays begin that they count as their origin";
const NEIGHBOURS: &str =
    "rays that begin on a surface, not a cell off it, hit the planes of the neighbouring triangles";
const NEEDLE: &str = "inside of a needle a thousandth thick, nearly all of which is seen edge-on";
const DUST: &str = "triangles far smaller than cells: those without a cell's centre are lost";

/// Laws of cases whose errors fall with the size of a cell like those of others, but from a higher start.
pub(super) const CENTRES_LAWS: &[Law] = &[
    line("G11", "part of it is seen at grazing angles, where its border is wide", 18.0),
    line("E2-far", COARSE, 5.0),
    line("E2-400-far", COARSE, 36.0),
    line("V3", "an open wall, whose border is a cell wide", 1.0),
    line("V15-near", "the eye touches the surface, whose cells are seen at grazing angles", 13.0),
    line("V15-vertex", "as V15-near", 13.0),
    line("V8", "silhouettes: a plane stands for what is behind it in its cell", 2.5),
    line("Z2-6", COARSE, 17.0),
    line("C2", "an open triangle, whose border is a cell wide", 2.0),
    line("C4", BORDER, 16.0),
    chances("C5", BORDER, 85.0),
    line("P5", "a neighbour's plane may stand before the point that a ray leaves from", 2.5),
    line("E2-400", "poles, whose triangles are far narrower than cells", 1.5),
    line("E8", "both triangles are open except at the edge that rays hit", 2.6),
    line("X2", FAR_PLATES, 19.0),
    line("X3", FAR_PLATES, 28.0),
    line("X6", "a cube of a few cells, hit at its silhouette as well", 2.8),
    line("X7", FAR_PLATES, 33.0),
    line("X9", FAR_PLATES, 2.1),
    line("X10", FAR_PLATES, 3.9),
    line("X12", "half of the rays hit a corner, a fiftieth of the triangle in size", 38.0),
    line("T1", BORDER, 11.0),
    line("T3", BORDER, 2.9),
    line("T4", BORDER, 5.0),
    chances("P1", "spheres inside spheres, seen from outside, half of each at grazing angles", 70.0),
    line("P7", "rays that leave a surface at grazing angles hit the cells next to their own", 16.0),
];

/// Deviations of planes in 16 x 16 cells per face.
pub(super) const CENTRES_16: &[Deviation] = &[deviation("Z6-pixel", THIN, 0.99, 1.0)];

/// Deviations of planes in 64 x 64 cells per face.
pub(super) const CENTRES_64: &[Deviation] = &[
    deviation("G1", THIN, 0.699, 1.0),
    deviation("G2", THIN, 0.99, 1.0),
    deviation("G7", THIN, 0.49, 0.767),
    deviation("G12", EDGE_ON, 0.99, 1.0),
    deviation("V1", EDGE_ON, 0.99, 1.0),
    deviation("V2-1", EDGE_ON, 0.103, 0.162),
    deviation("V2-2", EDGE_ON, 0.403, 0.631),
    deviation("V2-3", EDGE_ON, 0.99, 1.0),
    deviation("V2-4", EDGE_ON, 0.99, 1.0),
    deviation("V2-5", EDGE_ON, 0.99, 1.0),
    deviation("V2-6", EDGE_ON, 0.99, 1.0),
    deviation("V16", THIN, 0.99, 1.0),
    deviation("T2", NEEDLE, 0.524, 0.826),
];

/// Deviations of planes with lost triangles and those seen edge-on in conservative lists, in 64 x 64 cells
/// per face.
pub(super) const EDGE_ON_64: &[Deviation] = &[deviation("V16", THIN, 0.39, 0.63)];

/// Deviations of planes that fragments carry themselves, in 64 x 64 cells per face.
pub(super) const PLANES_64: &[Deviation] = &[
    deviation("G1", THIN, 0.699, 1.0),
    deviation("G2", THIN, 0.99, 1.0),
    deviation("G7", THIN, 0.49, 0.767),
    deviation("G12", EDGE_ON, 0.99, 1.0),
    deviation("V1", EDGE_ON, 0.99, 1.0),
    deviation("V2-1", EDGE_ON, 0.103, 0.162),
    deviation("V2-2", EDGE_ON, 0.403, 0.631),
    deviation("V2-3", EDGE_ON, 0.99, 1.0),
    deviation("V2-4", EDGE_ON, 0.99, 1.0),
    deviation("V2-5", EDGE_ON, 0.99, 1.0),
    deviation("V2-6", EDGE_ON, 0.99, 1.0),
    deviation("V16", THIN, 0.99, 1.0),
    deviation("T2", NEEDLE, 0.26, 0.42),
    deviation("P1", NEIGHBOURS, 0.67, 0.93),
    deviation("P5", NEIGHBOURS, 0.62, 0.93),
    deviation("P7", NEIGHBOURS, 0.55, 0.9),
];

/// Deviations of planes in 64 x 64 cells of the view of a camera that looks away from the axes.
pub(super) const CAMERA_64: &[Deviation] = &[
    deviation("G1", THIN, 0.69, 1.0),
    deviation("G2", THIN, 0.99, 1.0),
    deviation("G7", THIN, 0.435, 0.68),
    deviation("G12", EDGE_ON, 0.99, 1.0),
    deviation("E1", CORNER, 0.016, 0.026),
    deviation("V1", EDGE_ON, 0.99, 1.0),
    deviation("V2-1", EDGE_ON, 0.107, 0.168),
    deviation("V2-2", EDGE_ON, 0.597, 0.934),
    deviation("V2-3", EDGE_ON, 0.77, 1.0),
    deviation("V2-4", EDGE_ON, 0.78, 1.0),
    deviation("V2-5", EDGE_ON, 0.78, 1.0),
    deviation("V2-6", EDGE_ON, 0.78, 1.0),
    deviation("V7", FEW_CELLS, 0.049, 0.079),
    deviation("V16", THIN, 0.74, 1.0),
    deviation("Z3-3", LEFT_PLATES, 0.012, 0.02),
    deviation("X1", FEW_CELLS, 0.355, 0.556),
    deviation("X10", FEW_CELLS, 0.085, 0.135),
    deviation("T2", NEEDLE, 0.69, 1.0),
];

/// Deviations of planes in 64 x 64 cells of a cube's faces, and twice as many along a side of that camera's
/// view.
pub(super) const CUBE_CAMERA_64: &[Deviation] = &[
    deviation("G1", THIN, 0.69, 1.0),
    deviation("G2", THIN, 0.99, 1.0),
    deviation("G7", THIN, 0.41, 0.77),
    deviation("G12", EDGE_ON, 0.99, 1.0),
    deviation("V1", EDGE_ON, 0.99, 1.0),
    deviation("V2-1", EDGE_ON, 0.03, 0.048),
    deviation("V2-2", EDGE_ON, 0.241, 0.378),
    deviation("V2-3", EDGE_ON, 0.629, 0.984),
    deviation("V2-4", EDGE_ON, 0.668, 1.0),
    deviation("V2-5", EDGE_ON, 0.678, 1.0),
    deviation("V2-6", EDGE_ON, 0.688, 1.0),
    deviation("V16", THIN, 0.721, 1.0),
    deviation("T2", NEEDLE, 0.5, 0.85),
];

/// Deviations of planes in 128 x 128 cells per face.
pub(super) const CENTRES_128: &[Deviation] = &[
    deviation("G1", THIN, 0.699, 1.0),
    deviation("G2", THIN, 0.99, 1.0),
    deviation("G7", THIN, 0.49, 0.767),
    deviation("G12", EDGE_ON, 0.99, 1.0),
    deviation("V1", EDGE_ON, 0.99, 1.0),
    deviation("V2-1", EDGE_ON, 0.098, 0.155),
    deviation("V2-2", EDGE_ON, 0.423, 0.662),
    deviation("V2-3", EDGE_ON, 0.99, 1.0),
    deviation("V2-4", EDGE_ON, 0.99, 1.0),
    deviation("V2-5", EDGE_ON, 0.99, 1.0),
    deviation("V2-6", EDGE_ON, 0.99, 1.0),
    deviation("V16", THIN, 0.99, 1.0),
    deviation("T2", NEEDLE, 0.513, 0.809),
    deviation("C3-random", DUST, 0.007, 0.011),
];

/// Deviations of planes in 256 x 256 cells per face.
pub(super) const CENTRES_256: &[Deviation] = &[
    deviation("G1", THIN, 0.695, 1.0),
    deviation("G2", THIN, 0.99, 1.0),
    deviation("G7", THIN, 0.488, 0.77),
    deviation("G12", EDGE_ON, 0.99, 1.0),
    deviation("V1", EDGE_ON, 0.99, 1.0),
    deviation("V2-2", EDGE_ON, 0.149, 0.235),
    deviation("V2-3", EDGE_ON, 0.497, 0.785),
    deviation("V2-4", EDGE_ON, 0.99, 1.0),
    deviation("V2-5", EDGE_ON, 0.99, 1.0),
    deviation("V2-6", EDGE_ON, 0.99, 1.0),
    deviation("T2", NEEDLE, 0.504, 0.795),
    deviation("C3-random", DUST, 0.008, 0.012),
];

/// Deviations of samples in 16 x 16 cells per face.
pub(super) const PUBLISHED_16: &[Deviation] =
    &[deviation("Z6-pixel", THIN, 0.99, 1.0), deviation("Z7", THICK, 0.286, 0.446)];

/// Deviations of samples in 128 x 128 cells per face.
pub(super) const PUBLISHED_128: &[Deviation] = &[
    deviation("G1", THIN, 0.699, 1.0),
    deviation("G2", THIN, 0.99, 1.0),
    deviation("G7", THIN, 0.49, 0.767),
    deviation("G10", HALF_OPEN, 0.253, 0.397),
    deviation("G11", HALF_OPEN, 0.63, 0.985),
    deviation("G12", EDGE_ON, 0.99, 1.0),
    deviation("V1", EDGE_ON, 0.99, 1.0),
    deviation("V2-0", HALF_OPEN, 0.503, 0.787),
    deviation("V2-1", EDGE_ON, 0.761, 1.0),
    deviation("V2-2", EDGE_ON, 0.99, 1.0),
    deviation("V2-3", EDGE_ON, 0.99, 1.0),
    deviation("V2-4", EDGE_ON, 0.99, 1.0),
    deviation("V2-5", EDGE_ON, 0.99, 1.0),
    deviation("V2-6", EDGE_ON, 0.99, 1.0),
    deviation("V3", HALF_OPEN, 0.66, 1.0),
    deviation("V4", HALF_OPEN, 0.628, 0.982),
    deviation("V12", HALF_OPEN, 0.048, 0.075),
    deviation("V15-near", HALF_OPEN, 0.084, 0.132),
    deviation("V15-vertex", HALF_OPEN, 0.094, 0.147),
    deviation("V16", THIN, 0.99, 1.0),
    deviation("V8", HALF_OPEN, 0.057, 0.091),
    deviation("E5", SNAPPED, 0.99, 1.0),
    deviation("V5", SNAPPED, 0.55, 0.861),
    deviation("V6", SNAPPED, 0.028, 0.045),
    deviation("V7", SNAPPED, 0.418, 0.654),
    deviation("Z11-5", SHELL, 0.602, 0.94),
    deviation("Z11-6", SHELL, 0.99, 1.0),
    deviation("C4", BORDER, 0.085, 0.134),
    deviation("C5", BORDER, 0.395, 0.619),
    deviation("P5", LEAVING, 0.333, 0.521),
    deviation("X1", HALF_OPEN, 0.661, 1.0),
    deviation("X2", HALF_OPEN, 0.357, 0.558),
    deviation("X3", HALF_OPEN, 0.243, 0.383),
    deviation("X6", HALF_OPEN, 0.099, 0.155),
    deviation("X7", HALF_OPEN, 0.059, 0.092),
    deviation("X10", THICK, 0.308, 0.481),
    deviation("X12", BORDER, 0.144, 0.225),
    deviation("X13", HALF_OPEN, 0.312, 0.492),
    deviation("X14", THICK, 0.114, 0.178),
    deviation("X15", HALF_OPEN, 0.348, 0.543),
    deviation("T1", HALF_OPEN, 0.205, 0.321),
    deviation("T2", NEEDLE, 0.532, 0.84),
    deviation("T3", BORDER, 0.015, 0.024),
    deviation("T4", HALF_OPEN, 0.128, 0.2),
    deviation("P1", LEAVING, 0.614, 0.969),
    deviation("P2", HALF_OPEN, 0.349, 0.545),
    deviation("P7", LEAVING, 0.531, 0.83),
    deviation("P8-1", LEAVING, 0.513, 0.809),
    deviation("P8-2", LEAVING, 0.605, 0.956),
    deviation("P8-4", LEAVING, 0.641, 1.0),
    deviation("P8-8", LEAVING, 0.596, 0.941),
    deviation("V14", THICK, 0.2, 0.313),
    deviation("Z1", THICK, 0.295, 0.461),
    deviation("Z15", THICK, 0.422, 0.659),
    deviation("Z3-3", THICK, 0.044, 0.069),
    deviation("Z3-4", THICK, 0.046, 0.072),
    deviation("Z11-0", THICK, 0.272, 0.425),
    deviation("Z11-1", THICK, 0.5, 0.781),
    deviation("Z11-2", THICK, 0.587, 0.917),
    deviation("Z11-3", THICK, 0.588, 0.918),
    deviation("Z11-4", THICK, 0.581, 0.908),
    deviation("Z11-7", THICK, 0.185, 0.289),
    deviation("Z13", THICK, 0.217, 0.339),
    deviation("X9", THICK, 0.308, 0.481),
    deviation("X11", THICK, 0.274, 0.428),
    deviation("C7", THICK, 0.182, 0.284),
    deviation("P4-2", THICK, 0.06, 0.094),
    deviation("P4-3", THICK, 0.288, 0.449),
    deviation("P4-4", THICK, 0.284, 0.443),
    deviation("P4-5", THICK, 0.282, 0.441),
    deviation("P9", THICK, 0.186, 0.291),
];

pub(super) const fn deviation(
    case: &'static str,
    reason: &'static str,
    at_least_rate: f64,
    at_most_rate: f64,
) -> Deviation {
    Deviation { case, reason, at_least_rate, at_most_rate }
}

/// Makes a law of errors at one border, which a ray hits or misses.
pub(super) const fn line(case: &'static str, reason: &'static str, per_cell: f64) -> Law {
    Law { case, reason, per_cell, curve: Curve::Line }
}

/// Makes a law of errors at many borders, each of which may spoil a ray.
pub(super) const fn chances(case: &'static str, reason: &'static str, per_cell: f64) -> Law {
    Law { case, reason, per_cell, curve: Curve::Chances }
}
