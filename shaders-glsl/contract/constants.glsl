// Numbers that shaders and Rust share. The build script turns every `#define NAME number` of this file into a
// Rust constant of the same name, with the comment above it as documentation; nothing else may stand here.
#ifndef CONTRACT_CONSTANTS_GLSL
#define CONTRACT_CONSTANTS_GLSL

// Bound of the relative rounding error of one operation in single precision: 2^-24, rounded up. Bounds of
// errors are multiples of it.
#define FLOAT_ROUNDING 6.0e-8

// Value in place of a triangle's id or number where there is no triangle, as in a miss.
#define PRIMITIVE_NONE 0xFFFFFFFFu

// Result of a trace function: the ray hits nothing.
#define TRACE_MISS 0u
// Result of a trace function: the ray hits something.
#define TRACE_HIT 1u
// Result of a trace function: the ray has spent the work budget of this dispatch. Its state holds what the
// next dispatch needs to go on.
#define TRACE_PAUSED 2u
// Result of a trace function: there is no answer, because the structure's build is not complete, or is of
// other triangles.
#define TRACE_NOT_READY 3u

// Value of Hit.primitive for a fragment whose triangle is not known. The meaning of Hit.a and Hit.b is the
// structure's.
#define PRIMITIVE_UNKNOWN 0xFFFFFFFEu

// Bits of Hit.b for a stored fragment whose triangle's id is in Hit.primitive: Hit.a and the surface are
// those of the fragment. No barycentric is as large.
#define HIT_STORED 0x7F7FFFFFu

// Bits of Hit.b for a fragment in the part of the geometry that was traced just before the last one. They are
// one less for each further part that was traced since.
#define HIT_EARLIER 0x7F7FFFFDu
// Maximum number of parts of a geometry.
#define PARTS_MOST 65536u

// Bits of Hit.b of a miss that is no answer, because the structure was not complete or the ray has not
// finished.
#define HIT_NOT_READY 0x7F7FFFFEu

// Flag of a draw: it has an alpha mask, by which the alpha test refuses candidates.
#define DRAW_ALPHA_MASKED 1u
// Flag of a draw: its triangles have a back, through which rays with RAY_CULL_BACK_FACES pass.
#define DRAW_SINGLE_SIDED 2u
// Flag of a draw: the front of its triangles is the clockwise side and not the counter-clockwise one.
// Instances that mirror their mesh have it.
#define DRAW_MIRRORED 256u

// Flag of a ray: it passes through backs of triangles whose draw has DRAW_SINGLE_SIDED.
#define RAY_CULL_BACK_FACES 1u
// First bit of Ray.flags that holds the light: for a shadow ray 1 plus the number of the light that it leads
// to, for every other ray 0. Lights without extent are numbered first, then emitting triangles, each in the
// order of its table.
#define RAY_LIGHT_SHIFT 8u
// Value of a ray's light in place of all that are larger and do not fit into the bits of Ray.flags.
#define RAY_LIGHT_MOST 0xFFFFFFu

// Flag of Surface.valid: the structure knows the field. Fields that it does not know hold the defaults of
// `scene/surface.glsl`.
#define SURFACE_POSITION 1u
#define SURFACE_NORMAL 2u
#define SURFACE_MATERIAL 4u
#define SURFACE_PRIMITIVE 8u
#define SURFACE_EMISSION 16u

// Extent to which the work of rays is recorded: not at all. Each following value includes what those before
// it record.
#define COUNTERS_OFF 0u
// Extent to which the work of rays is recorded: as sums over all rays, in the queue's header.
#define COUNTERS_SUMS 1u
// Extent to which the work of rays is recorded: as a RayWork per slot of the queue.
#define COUNTERS_PER_RAY 2u
// Extent to which the work of rays is recorded: as every step of the ray in one slot, the logged one.
#define COUNTERS_STEPS 3u

// Kind of a logged step: a dispatch begins for the ray. a: the round, b: 1 if the trace goes on from the hit
// in another part of the geometry. All kinds have the words a, b, c, t_low and t_high; words that a kind does
// not name are not used.
#define STEP_ROUND 1u
// Kind of a step: a view is entered. a: the view, VIEW_NEAR, VIEW_CAMERA or VIEW_ALL, t_low and t_high: the
// interval of the ray in it.
#define STEP_VIEW 2u
// Kind of a step: a cell is visited, to be searched or skipped. a: the view, b and c: column and row
// (signed), t_low and t_high: the interval of the ray in the cell, widened by rounding.
#define STEP_CELL 3u
// Kind of a step: a node of a tree is visited. a: the node, b: its first child or entry, t_low and t_high:
// the interval of the ray in it.
#define STEP_NODE 4u
// Kind of a step: a bucket or a list is searched. a: the bucket, b: its first entry, t_low and t_high: the
// interval of depths that is searched, metres.
#define STEP_LIST 5u
// Kind of a step: something is skipped. a: the reason (SKIP_*), t_low and t_high: the interval that is
// searched, in t or in depth.
#define STEP_SKIP 6u
// Kind of a step: an entry of a list is read. a: the entry, t_low: its depth, metres.
#define STEP_ENTRY 7u
// Kind of a step: a triangle is tested. a: the triangle's id, b: the verdict (TEST_*), t_low: t, t_high: the
// bound of the error of t.
#define STEP_TEST 8u
// Kind of a step: a fragment is compared by its depth. a: the id of its triangle, b: the verdict (TEST_*),
// t_low: t, t_high: its depth, metres.
#define STEP_FRAGMENT 9u
// Kind of a step: a candidate becomes the best hit. a: the id of its triangle, t_low: t.
#define STEP_BEST 10u
// Kind of a step: the ray has spent the work budget of the dispatch, and pauses.
#define STEP_PAUSE 11u
// Kind of a step: the trace of the ray ends. a: the result of the trace function (TRACE_*), b: the id of the
// triangle that is hit, t_low: t.
#define STEP_END 12u

// Kind of a step: the visited voxel is occupied, and is searched in views of its own. a: the axes of these
// views, as bits.
#define STEP_OCCUPIED 13u

// Value in place of a view: the near region around the centre of the faces, whose triangles are tested one by
// one.
#define VIEW_NEAR 6u
// Value in place of a view: the camera's view.
#define VIEW_CAMERA 7u
// Value in place of a view: every triangle is tested, as for rays that start far away.
#define VIEW_ALL 8u

// Verdict of a test: the candidate is accepted.
#define TEST_ACCEPTED 0u
// Verdict of a test: the ray excludes this triangle.
#define TEST_EXCLUDED 1u
// Verdict of a test: the ray passes beside the triangle.
#define TEST_OUTSIDE 2u
// Verdict of a test: the ray is parallel to the triangle's plane, or the triangle has no area.
#define TEST_PARALLEL 3u
// Verdict of a test: the hit is at or before t_min, or within rounding of the ray's origin.
#define TEST_BEFORE 4u
// Verdict of a test: the hit is at or beyond t_max.
#define TEST_BEYOND 5u
// Verdict of a test: the hit is outside the t interval of the cell or segment, or outside the interval of
// depths that is searched.
#define TEST_OUTSIDE_CELL 6u
// Verdict of a test: the hit is on the triangle's plane, farther from the triangle than is accepted.
#define TEST_OUT_OF_REACH 7u
// Verdict of a test: the ray starts on the plane that it would hit.
#define TEST_LEAVING 8u
// Verdict of a test: the hit is no better than the best hit.
#define TEST_NOT_BETTER 9u
// Verdict of a test: the alpha test refuses the hit.
#define TEST_TRANSPARENT 10u
// Verdict of a test: the ray meets the back of a triangle, and passes through backs.
#define TEST_BACK_FACE 11u

// Reason for a skip: the cell or list is empty.
#define SKIP_EMPTY 0u
// Reason for a skip: nothing in the cell is within the interval of depths that is searched, or the ray misses
// the node.
#define SKIP_OUTSIDE 1u
// Reason for a skip: everything skipped lies behind the best hit.
#define SKIP_BEHIND 2u
// Reason for a skip: the rest of a list that is sorted by depth lies beyond the interval of depths that is
// searched.
#define SKIP_PAST 3u
// Reason for a skip: the rest of the ray is outside the bounds of the geometry.
#define SKIP_BOUNDS 4u

// Value in place of the number of slots that a pass works on: it works on the slots that were selected.
#define DOMAIN_SELECTED 0xFFFFFFFFu

// Threads in a workgroup of a queue kernel.
#define QUEUE_GROUP_SIZE 64u

// Default number of units of work that a ray may spend in one dispatch: cells visited, list entries read,
// triangles tested. It has to be small, since software drivers end all loops of a group of eight invocations
// after 65,535 iterations in all.
#define TRACE_WORK_BUDGET 4096u

// Bits of a structure's status word. STATUS_COMPLETE: the build is complete. Bits above STATUS_FLAGS are the
// stamp of the triangles that the structure was built for.
#define STATUS_COMPLETE 1u
// Bit of a status: a pool was too small, or a triangle is outside the stated bounds, so the build is not
// complete.
#define STATUS_OVERFLOW 2u
// Bit of a status: lists that are too long to be sorted stayed unsorted.
#define STATUS_UNSORTED 4u
// All bits of a status below the stamp.
#define STATUS_FLAGS 15u

#endif
