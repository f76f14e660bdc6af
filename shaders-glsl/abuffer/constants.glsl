// Numbers that the A-buffer's shaders and crate share. Only `#define NAME number` may stand here.
#ifndef ABUFFER_CONSTANTS_GLSL
#define ABUFFER_CONSTANTS_GLSL

// March of a ray through the cells of a view: by samples at equal steps on the screen, to every cell that it
// crosses, by samples one cell apart, or to every cell with skips over blocks of cells.
#define ABUFFER_MARCH_SAMPLES 0u
#define ABUFFER_MARCH_EXACT 1u
#define ABUFFER_MARCH_DDA 2u
#define ABUFFER_MARCH_PYRAMID 3u

// Kind of step for which traces are compiled separately: from cell to cell, with skips over blocks of cells,
// or by samples.
#define ABUFFER_STEP_CELLS 0u
#define ABUFFER_STEP_SKIPS 1u
#define ABUFFER_STEP_SAMPLES 2u

// Kind of candidate for which traces are compiled separately: triangles only, the planes of fragments, or
// their depths.
#define ABUFFER_TEST_TRIANGLES 0u
#define ABUFFER_TEST_PLANES 1u
#define ABUFFER_TEST_DEPTHS 2u

// Views that are built, as bits.
#define ABUFFER_VIEWS_CUBE 1u
#define ABUFFER_VIEWS_CAMERA 2u

// Number of the camera's view: behind those of the faces and SEGMENT_NEAR, and equal to VIEW_CAMERA of logged
// steps.
#define ABUFFER_CAMERA 7u

// Place at which a ray passes from one view to the next: at the sides of the views' pyramids, or from half a
// cell before the side of the first view to half a cell behind that side.
#define ABUFFER_SWITCH_EXACT 0u
#define ABUFFER_SWITCH_SNAP 1u

// Condition under which a ray hits a fragment. Interval: the fragment's depth is within the ray's depths in
// the cell. Thickness: as with interval, or the fragment is closer to the eye than these depths by at most
// the thickness. Plane: the ray meets the plane of the fragment's triangle within the cell. Slope: the depths
// that the triangle takes in the cell overlap those of the ray.
#define ABUFFER_ACCEPT_INTERVAL 0u
#define ABUFFER_ACCEPT_THICKNESS 1u
#define ABUFFER_ACCEPT_PLANE 2u
#define ABUFFER_ACCEPT_SLOPE 3u

// Payload of a fragment: its triangle, quantised attributes of its surface, its normal, or its plane.
#define ABUFFER_PAYLOAD_INDEX 0u
#define ABUFFER_PAYLOAD_ATTRIBUTES 1u
#define ABUFFER_PAYLOAD_NORMAL 2u
#define ABUFFER_PAYLOAD_PLANE 3u

// Rule by which cells keep triangles. Hardware: the rasterizer finds a cell's centre covered. Exact: the
// shared triangle test does. Conservative: as exact, and a cell also keeps triangles that reach into it
// without covering its centre, so that rays can test triangles in place of planes. Edge-on: as conservative,
// but of these further triangles only those without a fragment and those seen edge-on.
#define ABUFFER_COVERAGE_HARDWARE 0u
#define ABUFFER_COVERAGE_EXACT 1u
#define ABUFFER_COVERAGE_CONSERVATIVE 2u
#define ABUFFER_COVERAGE_EDGE_ON 3u

// Ratio of a plane's range of depths over a cell to the cell's width, beyond which the plane counts as seen
// edge-on there: the line of sight is then within about seven degrees of the plane.
#define ABUFFER_EDGE_ON_SLOPE 8.0

// Source of a cell's depth bounds before fragments are stored: the fragments that the cell will have, or the
// boxes around objects that cover the cell.
#define ABUFFER_BOUNDS_GEOMETRY 0u
#define ABUFFER_BOUNDS_BOXES 1u

// Maximum number of boxes around objects. If there are more draws, several consecutive draws share one.
#define ABUFFER_BOXES 4096u

// Number of words of a box around objects.
#define ABUFFER_BOX_WORDS 6u

// Storage of a cell's fragments: linked list, doubly linked list, each of these per bucket, contiguous list,
// or linked pages per bucket.
#define ABUFFER_STORAGE_LL 0u
#define ABUFFER_STORAGE_DLL 1u
#define ABUFFER_STORAGE_LLB 2u
#define ABUFFER_STORAGE_DLLB 3u
#define ABUFFER_STORAGE_SB 4u
#define ABUFFER_STORAGE_PAGED 5u

// Length of a contiguous list above which a trace finds the depth to begin at by bisection.
#define ABUFFER_SEEK_LENGTH 16u

// Distance from its triangle up to which the plane of a fragment is hit, in widths of a cell at that depth. A
// greater reach closes gaps between triangles smaller than a cell; a smaller reach keeps planes that are seen
// edge-on out of the way.
#define ABUFFER_PLANE_REACH 2.0

// Half side of the near region, divided by the number of cells along a side and by the geometry's largest
// coordinate relative to the eye. Closer to the eye, rounding leaves the cell of a point open. If no triangle
// may be lost, NEAR_REGION is used in place of this number.
#define ABUFFER_NEAR_BOX 4.8e-7

// Margin for the rounding of positions relative to the eye, divided by the sum of the geometry's largest
// coordinate relative to the eye and the eye's own largest coordinate.
#define ABUFFER_ROUNDING 4.0e-7

#endif
