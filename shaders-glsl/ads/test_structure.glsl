// What: one of the structures that a test puts into one shader: the trace of TEST_STRUCTURE under the name
// TEST_TRACE, with its descriptors in STRUCTURE_SET. Included once for each; the three are undefined again at
// the end.
// Reads, writes: see the structure.

#if TEST_STRUCTURE == STRUCTURE_ABUFFER
#include "abuffer/trace.glsl"
uint TEST_TRACE(uvec2 header, Ray ray, inout TraceState state, out Hit hit) {
    return abuffer_trace_closest(AbufferRef(header), ray, state, hit);
}
#elif TEST_STRUCTURE == STRUCTURE_BVH
#include "bvh/trace.glsl"
uint TEST_TRACE(uvec2 header, Ray ray, inout TraceState state, out Hit hit) {
    return bvh_trace_closest(BvhRef(header), ray, state, hit);
}
#elif TEST_STRUCTURE == STRUCTURE_LDC
#include "ldc/trace.glsl"
uint TEST_TRACE(uvec2 header, Ray ray, inout TraceState state, out Hit hit) {
    return ldc_trace_closest(LdcRef(header), ray, state, hit);
}
#elif TEST_STRUCTURE == STRUCTURE_PRIMITIVE
#include "primitive/trace.glsl"
uint TEST_TRACE(uvec2 header, Ray ray, inout TraceState state, out Hit hit) {
    return primitive_trace_closest(PrimitiveRef(header), ray, state, hit);
}
#elif TEST_STRUCTURE == STRUCTURE_VOXEL
#include "voxel/trace.glsl"
uint TEST_TRACE(uvec2 header, Ray ray, inout TraceState state, out Hit hit) {
    return voxel_trace_closest(VoxelRef(header), ray, state, hit);
}
#else
#error "TEST_STRUCTURE names no structure: add it to ads/test_structure.glsl"
#endif

#undef TEST_STRUCTURE
#undef TEST_TRACE
#undef STRUCTURE_SET
