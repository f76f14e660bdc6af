// Numbers that shaders and Rust share. build.rs turns every `#define NAME number` of this file into
// a Rust constant of the same name; nothing else may stand here.
#ifndef CONTRACT_CONSTANTS_GLSL
#define CONTRACT_CONSTANTS_GLSL

// "No primitive": a miss, or a structure that does not know the id.
#define PRIMITIVE_NONE 0xFFFFFFFFu

// Results of a trace function.
#define TRACE_MISS 0u
#define TRACE_HIT 1u
// The work budget of this dispatch is used up; the state holds what is needed to resume.
#define TRACE_PAUSED 2u
// The structure was not complete when it was traced; no answer was given.
#define TRACE_NOT_READY 3u

// In Hit.primitive: a fragment without a known triangle; a and b are the structure's.
#define PRIMITIVE_UNKNOWN 0xFFFFFFFEu

// In Hit.b, as bits: a and the surface are a stored fragment's, although the hit has the triangle's id.
// No barycentric is as large.
#define HIT_STORED 0x7F7FFFFFu

// In Hit.b, as bits: the same, of a fragment in the part of the geometry that was traced just before; one less for each
// part that was traced since.
#define HIT_EARLIER 0x7F7FFFFDu
// Parts of a geometry.
#define PARTS_MOST 65536u

// In Hit.b of a miss, as bits: the structure was not complete, so there is no answer.
#define HIT_NOT_READY 0x7F7FFFFEu

// Draw flags.
// Candidates are refused where alpha cuts holes.
#define DRAW_ALPHA_MASKED 1u
// Triangles have a back that rays with RAY_CULL_BACK_FACES pass.
#define DRAW_SINGLE_SIDED 2u
// The front is the clockwise side, not the counter-clockwise one: of instances that mirror their mesh.
#define DRAW_MIRRORED 256u

// Ray flags.
// Backs of draws with DRAW_SINGLE_SIDED are no hits.
#define RAY_CULL_BACK_FACES 1u
// The bits from here on: 1 + the number of the light that a shadow ray leads to; 0 for every other ray. Lights without extent
// come first, then emitting triangles, each in the order of its table.
#define RAY_LIGHT_SHIFT 8u
// Value for lights whose number has no room.
#define RAY_LIGHT_MOST 0xFFFFFFu

// Fields of a Surface that the structure fills; the others hold documented defaults.
#define SURFACE_POSITION 1u
#define SURFACE_NORMAL 2u
#define SURFACE_MATERIAL 4u
#define SURFACE_PRIMITIVE 8u
#define SURFACE_EMISSION 16u

// Extent to which the work of rays is recorded; each value includes those below it.
#define COUNTERS_OFF 0u
// Sums over all rays, in the queue's header.
#define COUNTERS_SUMS 1u
// A RayWork per slot.
#define COUNTERS_PER_RAY 2u
// Every step of the logged slot.
#define COUNTERS_STEPS 3u

// Kinds of steps that a traversal logs, with the meaning of a, b, c, t_low and t_high.
// A dispatch begins for the ray; a: the round, b: 1 where the trace goes on from the hit of another part.
#define STEP_ROUND 1u
// A view is entered; a: the view, VIEW_NEAR, VIEW_CAMERA or VIEW_ALL, t: its interval along the ray.
#define STEP_VIEW 2u
// A cell is visited, to be searched or skipped; a: the view, b and c: column and row (signed), t: its interval along
// the ray, widened.
#define STEP_CELL 3u
// A node of a hierarchy is visited; a: the node, b: its first child or entry, t: its interval along the ray.
#define STEP_NODE 4u
// A bucket or list is searched; a: the bucket, b: its first entry, t: the depth interval searched, metres.
#define STEP_LIST 5u
// Something is skipped; a: why (SKIP_*), t: the interval searched, in t or in depth.
#define STEP_SKIP 6u
// An entry of a list is read; a: the entry, t_low: its depth, metres.
#define STEP_ENTRY 7u
// A primitive is tested; a: the primitive, b: the verdict (TEST_*), t_low: t, t_high: the bound of its error.
#define STEP_TEST 8u
// A fragment is compared by its depth; a: the primitive, b: the verdict (TEST_*), t_low: t, t_high: depth, metres.
#define STEP_FRAGMENT 9u
// The best hit is replaced; a: the primitive, t_low: t.
#define STEP_BEST 10u
// The work budget of the dispatch is used up.
#define STEP_PAUSE 11u
// The ray is answered; a: what the trace function returned, b: the primitive, t_low: t.
#define STEP_END 12u

// The cell visited, a voxel, holds something that is searched in cells of its own; a: the axes along which it is, as bits.
#define STEP_OCCUPIED 13u

// In place of a view: the near region around the centre of a cube's faces.
#define VIEW_NEAR 6u
// The number of the camera's view.
#define VIEW_CAMERA 7u
// In place of a view: every triangle is tested, as for rays from far away.
#define VIEW_ALL 8u

// Verdicts of tests.
#define TEST_ACCEPTED 0u
// The ray excludes this primitive.
#define TEST_EXCLUDED 1u
// The ray passes outside of the triangle.
#define TEST_OUTSIDE 2u
// The ray runs along the triangle's plane, or the triangle has no area.
#define TEST_PARALLEL 3u
// At or before t_min, or within rounding of the origin.
#define TEST_BEFORE 4u
// At or beyond t_max.
#define TEST_BEYOND 5u
// Outside of the t interval of the cell or segment, or of the depth interval searched.
#define TEST_OUTSIDE_CELL 6u
// On the triangle's plane, too far from the triangle.
#define TEST_OUT_OF_REACH 7u
// The ray starts on the plane.
#define TEST_LEAVING 8u
// No better than the best hit.
#define TEST_NOT_BETTER 9u
// Refused by the alpha test.
#define TEST_TRANSPARENT 10u
// The ray passes backs of single-sided triangles, and meets one.
#define TEST_BACK_FACE 11u

// Why something is skipped.
// The cell or list is empty.
#define SKIP_EMPTY 0u
// Nothing in the cell is within the depth interval searched, or the ray misses the node.
#define SKIP_OUTSIDE 1u
// It lies behind the best hit.
#define SKIP_BEHIND 2u
// The rest of a sorted list lies beyond the depth interval searched.
#define SKIP_PAST 3u
// The rest of the ray's range is outside of the bounds of the geometry.
#define SKIP_BOUNDS 4u

// In place of a number of slots: those that were selected.
#define DOMAIN_SELECTED 0xFFFFFFFFu

// Threads in a workgroup of a queue kernel.
#define QUEUE_GROUP_SIZE 64u

// Work units (cells stepped, list entries read, primitive tests) a ray may spend in one dispatch.
// Software drivers end all loops of a group of eight invocations after 65,535 iterations in all.
#define TRACE_WORK_BUDGET 4096u

// Bits of a structure's status word. Those above STATUS_FLAGS are the stamp of the triangles that it was built for.
#define STATUS_COMPLETE 1u
#define STATUS_OVERFLOW 2u
#define STATUS_UNSORTED 4u
#define STATUS_FLAGS 15u

#endif
