// Numbers that the A-buffer's shaders and crate share. Only `#define NAME number` may stand here.
#ifndef ABUFFER_CONSTANTS_GLSL
#define ABUFFER_CONSTANTS_GLSL

// Steps of a ray through cells.
#define ABUFFER_MARCH_SAMPLES 0u
#define ABUFFER_MARCH_EXACT 1u
#define ABUFFER_MARCH_DDA 2u
#define ABUFFER_MARCH_PYRAMID 3u

// Steps of a ray, in which modules differ: from cell to cell, skipping blocks of cells, or by samples.
#define ABUFFER_STEP_CELLS 0u
#define ABUFFER_STEP_SKIPS 1u
#define ABUFFER_STEP_SAMPLES 2u

// Candidates that a ray tests, in which modules differ: triangles only, the planes of fragments, or their
// depths.
#define ABUFFER_TEST_TRIANGLES 0u
#define ABUFFER_TEST_PLANES 1u
#define ABUFFER_TEST_DEPTHS 2u

// Views that are drawn, as bits.
#define ABUFFER_VIEWS_CUBE 1u
#define ABUFFER_VIEWS_CAMERA 2u

// Number of the camera's view, after the faces and SEGMENT_NEAR; the same as VIEW_CAMERA of logged steps.
#define ABUFFER_CAMERA 7u

// Point at which a ray passes from one view to the next: at the sides of their pyramids, or from half a cell
// inside one view to half a cell outside it.
#define ABUFFER_SWITCH_EXACT 0u
#define ABUFFER_SWITCH_SNAP 1u

// Condition under which a fragment counts as hit.
#define ABUFFER_ACCEPT_INTERVAL 0u
#define ABUFFER_ACCEPT_THICKNESS 1u
#define ABUFFER_ACCEPT_PLANE 2u
#define ABUFFER_ACCEPT_SLOPE 3u

// Payload of a fragment.
#define ABUFFER_PAYLOAD_INDEX 0u
#define ABUFFER_PAYLOAD_ATTRIBUTES 1u
#define ABUFFER_PAYLOAD_NORMAL 2u
#define ABUFFER_PAYLOAD_PLANE 3u

// Rule by which a cell is covered. Conservative: exact, and triangles that reach into a cell outside its
// centre are kept as well, so that triangles can be tested in place of planes. Edge-on: among these only
// triangles that no cell keeps or that are seen edge-on.
#define ABUFFER_COVERAGE_HARDWARE 0u
#define ABUFFER_COVERAGE_EXACT 1u
#define ABUFFER_COVERAGE_CONSERVATIVE 2u
#define ABUFFER_COVERAGE_EDGE_ON 3u

// Ratio of depth to width over a cell beyond which a triangle's plane counts as edge-on there: about seven degrees.
#define ABUFFER_EDGE_ON_SLOPE 8.0

// Depth bounds of a cell before fragments are stored: those of the fragments that it will have, or of the
// boxes around objects that cover it.
#define ABUFFER_BOUNDS_GEOMETRY 0u
#define ABUFFER_BOUNDS_BOXES 1u

// Maximum number of boxes around objects; if there are more draws, several in a row share one.
#define ABUFFER_BOXES 4096u

// Number of words of a box around objects.
#define ABUFFER_BOX_WORDS 6u

// Storage of the fragments of a cell.
#define ABUFFER_STORAGE_LL 0u
#define ABUFFER_STORAGE_DLL 1u
#define ABUFFER_STORAGE_LLB 2u
#define ABUFFER_STORAGE_DLLB 3u
#define ABUFFER_STORAGE_SB 4u
#define ABUFFER_STORAGE_PAGED 5u

// Length of a contiguous list above which the depth to begin at is found by bisection.
#define ABUFFER_SEEK_LENGTH 16u

// Reach of a fragment's plane beyond its triangle, in widths of a cell at that depth. A greater reach closes
// gaps between triangles smaller than a cell, a smaller one keeps planes seen edge-on out of the way.
#define ABUFFER_PLANE_REACH 2.0

// Half side of the near region over the number of cells along a side times the distance of the geometry:
// closer to the eye, the cell of a point is lost in rounding. If no triangle may be lost, NEAR_REGION is
// used.
#define ABUFFER_NEAR_BOX 4.8e-7

// Margin for the rounding of differences to the eye, over the distance of the geometry and the eye's own.
#define ABUFFER_ROUNDING 4.0e-7

#endif
