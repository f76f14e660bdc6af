// Numbers that the A-buffer's shaders and crate share. Only `#define NAME number` may stand here.
#ifndef ABUFFER_CONSTANTS_GLSL
#define ABUFFER_CONSTANTS_GLSL

// Steps of a ray through cells.
#define ABUFFER_MARCH_SAMPLES 0u
#define ABUFFER_MARCH_EXACT 1u
#define ABUFFER_MARCH_DDA 2u
#define ABUFFER_MARCH_PYRAMID 3u

// Steps of a ray, by which modules differ: from cell to cell, skipping blocks of them, or by samples.
#define ABUFFER_STEP_CELLS 0u
#define ABUFFER_STEP_SKIPS 1u
#define ABUFFER_STEP_SAMPLES 2u

// Candidates that a ray tests, by which modules differ: triangles only, the planes of fragments, or their depths.
#define ABUFFER_TEST_TRIANGLES 0u
#define ABUFFER_TEST_PLANES 1u
#define ABUFFER_TEST_DEPTHS 2u

// Views that are drawn: bits.
#define ABUFFER_VIEWS_CUBE 1u
#define ABUFFER_VIEWS_CAMERA 2u

// The number of the camera's view, behind the faces and SEGMENT_NEAR.
#define ABUFFER_CAMERA 7u

// Point at which a ray passes from one view to the next: at the sides of their pyramids, or half a cell inside of one
// view to half a cell outside of it.
#define ABUFFER_SWITCH_EXACT 0u
#define ABUFFER_SWITCH_SNAP 1u

// When a fragment counts as hit.
#define ABUFFER_ACCEPT_INTERVAL 0u
#define ABUFFER_ACCEPT_THICKNESS 1u
#define ABUFFER_ACCEPT_PLANE 2u
#define ABUFFER_ACCEPT_SLOPE 3u

// Payload of a fragment.
#define ABUFFER_PAYLOAD_INDEX 0u
#define ABUFFER_PAYLOAD_ATTRIBUTES 1u
#define ABUFFER_PAYLOAD_NORMAL 2u
#define ABUFFER_PAYLOAD_PLANE 3u

// Rule by which a cell is covered; conservative: exact, and triangles that reach into a cell outside of its
// centre are kept, so that triangles can be tested in place of planes; edge-on: of these only triangles that no cell
// keeps or that are seen edge-on.
#define ABUFFER_COVERAGE_HARDWARE 0u
#define ABUFFER_COVERAGE_EXACT 1u
#define ABUFFER_COVERAGE_CONSERVATIVE 2u
#define ABUFFER_COVERAGE_EDGE_ON 3u

// Ratio of depth to width over a cell beyond which a triangle's plane counts as edge-on there: about seven degrees.
#define ABUFFER_EDGE_ON_SLOPE 8.0

// Depth bounds of a cell before fragments are stored: of the fragments that it will have, or of the boxes around
// objects that are over it.
#define ABUFFER_BOUNDS_GEOMETRY 0u
#define ABUFFER_BOUNDS_BOXES 1u

// Boxes around objects that there is room for; where there are more draws, several in a row share one.
#define ABUFFER_BOXES 4096u

// Words of such a box.
#define ABUFFER_BOX_WORDS 6u

// Storage of the fragments of a cell.
#define ABUFFER_STORAGE_LL 0u
#define ABUFFER_STORAGE_DLL 1u
#define ABUFFER_STORAGE_LLB 2u
#define ABUFFER_STORAGE_DLLB 3u
#define ABUFFER_STORAGE_SB 4u
#define ABUFFER_STORAGE_PAGED 5u

// A contiguous list of more nodes than this is bisected for the depth to begin at.
#define ABUFFER_SEEK_LENGTH 16u

// Reach of a fragment's plane beyond its triangle, in widths of a cell at that depth. More closes
// gaps between triangles smaller than a cell, less keeps planes seen edge-on out of the way.
#define ABUFFER_PLANE_REACH 2.0

// Threads in a workgroup of the build's compute passes.
#define ABUFFER_GROUP_SIZE 64u

// Half side of the near region over the number of cells along a side times the distance of the geometry: closer to the
// eye, the cell of a point is lost in rounding. NEAR_REGION where no triangle may be lost.
#define ABUFFER_NEAR_BOX 4.8e-7

// Margin for the rounding of what is subtracted from the eye, over the distance of the geometry and the eye's own.
#define ABUFFER_ROUNDING 4.0e-7

#endif
