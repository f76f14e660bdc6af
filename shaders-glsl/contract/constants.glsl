// Numbers that shaders and Rust share. build.rs turns every `#define NAME number` of this file into
// a Rust constant of the same name; nothing else may stand here.
#ifndef CONTRACT_CONSTANTS_GLSL
#define CONTRACT_CONSTANTS_GLSL

// Largest relative error of one operation in single precision, rounded up. Bounds of errors are multiples of it.
#define FLOAT_ROUNDING 6.0e-8

// Absence of a primitive: a miss, or a structure that does not know the id.
#define PRIMITIVE_NONE 0xFFFFFFFFu

// Result of a trace function: the ray hits nothing.
#define TRACE_MISS 0u
#define TRACE_HIT 1u
// Result of a trace function: the work budget of this dispatch is used up; the state holds the data to
// resume.
#define TRACE_PAUSED 2u
// Result of a trace function: the structure was not complete when it was traced; no answer was given.
#define TRACE_NOT_READY 3u

// Value of Hit.primitive for a fragment without a known triangle; a and b belong to the structure.
#define PRIMITIVE_UNKNOWN 0xFFFFFFFEu

// Value of Hit.b, as bits, for a stored fragment: a and the surface are the fragment's, although the hit has
// the triangle's id. No barycentric is as large.
#define HIT_STORED 0x7F7FFFFFu

// Value of Hit.b, as bits, for a fragment in the part of the geometry that was traced just before; one less
// for each part that was traced since.
#define HIT_EARLIER 0x7F7FFFFDu
// Maximum number of parts of a geometry.
#define PARTS_MOST 65536u

// Value of Hit.b of a miss, as bits: the structure was not complete, so there is no answer.
#define HIT_NOT_READY 0x7F7FFFFEu

// Flag of a draw: alpha cuts holes, where candidates are refused.
#define DRAW_ALPHA_MASKED 1u
// Flag of a draw: triangles have a back that rays with RAY_CULL_BACK_FACES pass.
#define DRAW_SINGLE_SIDED 2u
// Flag of a draw: the front is the clockwise side, not the counter-clockwise one, for instances that mirror
// their mesh.
#define DRAW_MIRRORED 256u

// Flag of a ray: backs of draws with DRAW_SINGLE_SIDED are not hits.
#define RAY_CULL_BACK_FACES 1u
// First bit of a ray's light: 1 + the number of the light that a shadow ray leads to; 0 for every other ray.
// Lights without extent come first, then emitting triangles, each in the order of its table.
#define RAY_LIGHT_SHIFT 8u
// Value for a light whose number does not fit.
#define RAY_LIGHT_MOST 0xFFFFFFu

// Flag of a Surface for a field that the structure fills; the other fields hold documented defaults.
#define SURFACE_POSITION 1u
#define SURFACE_NORMAL 2u
#define SURFACE_MATERIAL 4u
#define SURFACE_PRIMITIVE 8u
#define SURFACE_EMISSION 16u

// Extent to which the work of rays is recorded: nothing. Each following value includes those before it.
#define COUNTERS_OFF 0u
// Work is recorded as sums over all rays, in the queue's header.
#define COUNTERS_SUMS 1u
// Work is recorded as a RayWork per slot.
#define COUNTERS_PER_RAY 2u
// Work is recorded as every step of the logged slot.
#define COUNTERS_STEPS 3u

// Kind of a logged step: a dispatch begins for the ray; a: the round, b: 1 if the trace goes on from the hit
// of another part. Each kind gives the meaning of a, b, c, t_low and t_high.
#define STEP_ROUND 1u
// Kind of a step: a view is entered; a: the view, VIEW_NEAR, VIEW_CAMERA or VIEW_ALL, t: its interval along
// the ray.
#define STEP_VIEW 2u
// Kind of a step: a cell is visited, to be searched or skipped; a: the view, b and c: column and row
// (signed), t: its interval along the ray, widened.
#define STEP_CELL 3u
// Kind of a step: a node of a hierarchy is visited; a: the node, b: its first child or entry, t: its interval
// along the ray.
#define STEP_NODE 4u
// Kind of a step: a bucket or list is searched; a: the bucket, b: its first entry, t: the depth interval
// searched, metres.
#define STEP_LIST 5u
// Kind of a step: something is skipped; a: the reason (SKIP_*), t: the interval searched, in t or in depth.
#define STEP_SKIP 6u
// Kind of a step: an entry of a list is read; a: the entry, t_low: its depth, metres.
#define STEP_ENTRY 7u
// Kind of a step: a primitive is tested; a: the primitive, b: the verdict (TEST_*), t_low: t, t_high: the
// bound of its error.
#define STEP_TEST 8u
// Kind of a step: a fragment is compared by its depth; a: the primitive, b: the verdict (TEST_*), t_low: t,
// t_high: depth, metres.
#define STEP_FRAGMENT 9u
// Kind of a step: the best hit is replaced; a: the primitive, t_low: t.
#define STEP_BEST 10u
// Kind of a step: the work budget of the dispatch is used up.
#define STEP_PAUSE 11u
// Kind of a step: the ray is answered; a: the result of the trace function, b: the primitive, t_low: t.
#define STEP_END 12u

// Kind of a step: the visited cell, a voxel, holds something that is searched in cells of its own; a: the
// axes along which it is searched, as bits.
#define STEP_OCCUPIED 13u

// Value in place of a view: the near region around the centre of a cube's faces.
#define VIEW_NEAR 6u
// Number of the camera's view.
#define VIEW_CAMERA 7u
// Value in place of a view: every triangle is tested, as for rays from far away.
#define VIEW_ALL 8u

// Verdict of a test: the candidate is accepted.
#define TEST_ACCEPTED 0u
// Verdict of a test: the ray excludes this primitive.
#define TEST_EXCLUDED 1u
// Verdict of a test: the ray passes outside the triangle.
#define TEST_OUTSIDE 2u
// Verdict of a test: the ray runs along the triangle's plane, or the triangle has no area.
#define TEST_PARALLEL 3u
// Verdict of a test: the hit is at or before t_min, or within rounding of the origin.
#define TEST_BEFORE 4u
// Verdict of a test: the hit is at or beyond t_max.
#define TEST_BEYOND 5u
// Verdict of a test: the hit is outside the t interval of the cell or segment, or outside the depth interval
// searched.
#define TEST_OUTSIDE_CELL 6u
// Verdict of a test: the hit is on the triangle's plane, too far from the triangle.
#define TEST_OUT_OF_REACH 7u
// Verdict of a test: the ray starts on the plane.
#define TEST_LEAVING 8u
// Verdict of a test: the hit is no better than the best hit.
#define TEST_NOT_BETTER 9u
// Verdict of a test: the alpha test refuses the hit.
#define TEST_TRANSPARENT 10u
// Verdict of a test: the ray passes backs of single-sided triangles, and meets one.
#define TEST_BACK_FACE 11u

// Reason for a skip: the cell or list is empty.
#define SKIP_EMPTY 0u
// Reason for a skip: nothing in the cell is within the depth interval searched, or the ray misses the node.
#define SKIP_OUTSIDE 1u
// Reason for a skip: it lies behind the best hit.
#define SKIP_BEHIND 2u
// Reason for a skip: the rest of a sorted list lies beyond the depth interval searched.
#define SKIP_PAST 3u
// Reason for a skip: the rest of the ray's range is outside the bounds of the geometry.
#define SKIP_BOUNDS 4u

// Value in place of a number of slots: the slots that were selected.
#define DOMAIN_SELECTED 0xFFFFFFFFu

// Threads in a workgroup of a queue kernel.
#define QUEUE_GROUP_SIZE 64u

// Number of work units (cells stepped, list entries read, primitive tests) that a ray may spend in one
// dispatch. Software drivers end all loops of a group of eight invocations after 65,535 iterations in all.
#define TRACE_WORK_BUDGET 4096u

// Bits of a structure's status word. Those above STATUS_FLAGS are the stamp of the triangles that it was built for.
#define STATUS_COMPLETE 1u
#define STATUS_OVERFLOW 2u
#define STATUS_UNSORTED 4u
#define STATUS_FLAGS 15u

#endif
