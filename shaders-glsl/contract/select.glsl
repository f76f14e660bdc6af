// What: the one place that chooses a structure: forwards the contract's plain names to the prefix of
// the structure that the permutation list names in STRUCTURE.
// Reads, writes: see the structure.
#ifndef CONTRACT_SELECT_GLSL
#define CONTRACT_SELECT_GLSL

#include "contract/structures.glsl"

#if STRUCTURE == STRUCTURE_BRUTE
#include "brute/trace.glsl"
#define StructureRef BruteRef
#define STRUCTURE_TRACE_CLOSEST brute_trace_closest
#define STRUCTURE_TRACE_OCCLUDED brute_trace_occluded
#ifdef SURFACES_ENABLED
#include "brute/surface.glsl"
#define STRUCTURE_SURFACE_AT brute_surface_at
#endif
#elif STRUCTURE == STRUCTURE_ABUFFER
#include "abuffer/trace.glsl"
#define StructureRef AbufferRef
#define STRUCTURE_TRACE_CLOSEST abuffer_trace_closest
#define STRUCTURE_TRACE_OCCLUDED abuffer_trace_occluded
#ifdef SURFACES_ENABLED
#include "abuffer/surface.glsl"
#define STRUCTURE_SURFACE_AT abuffer_surface_at
#endif
#elif STRUCTURE == STRUCTURE_BVH
#include "bvh/trace.glsl"
#define StructureRef BvhRef
#define STRUCTURE_TRACE_CLOSEST bvh_trace_closest
#define STRUCTURE_TRACE_OCCLUDED bvh_trace_occluded
#ifdef SURFACES_ENABLED
#include "bvh/surface.glsl"
#define STRUCTURE_SURFACE_AT bvh_surface_at
#endif
#elif STRUCTURE == STRUCTURE_PRIMITIVE
#include "primitive/trace.glsl"
#define StructureRef PrimitiveRef
#define STRUCTURE_TRACE_CLOSEST primitive_trace_closest
#define STRUCTURE_TRACE_OCCLUDED primitive_trace_occluded
#ifdef SURFACES_ENABLED
#include "primitive/surface.glsl"
#define STRUCTURE_SURFACE_AT primitive_surface_at
#endif
#elif STRUCTURE == STRUCTURE_VOXEL
#include "voxel/trace.glsl"
#define StructureRef VoxelRef
#define STRUCTURE_TRACE_CLOSEST voxel_trace_closest
#define STRUCTURE_TRACE_OCCLUDED voxel_trace_occluded
#ifdef SURFACES_ENABLED
#include "voxel/surface.glsl"
#define STRUCTURE_SURFACE_AT voxel_surface_at
#endif
#elif STRUCTURE == STRUCTURE_LDC
#include "ldc/trace.glsl"
#define StructureRef LdcRef
#define STRUCTURE_TRACE_CLOSEST ldc_trace_closest
#define STRUCTURE_TRACE_OCCLUDED ldc_trace_occluded
#ifdef SURFACES_ENABLED
#include "ldc/surface.glsl"
#define STRUCTURE_SURFACE_AT ldc_surface_at
#endif
#else
#error "STRUCTURE names no structure: add it to contract/select.glsl"
#endif

uint trace_closest(StructureRef s, Ray ray, inout TraceState state, out Hit hit) {
    return STRUCTURE_TRACE_CLOSEST(s, ray, state, hit);
}

uint trace_occluded(StructureRef s, Ray ray, inout TraceState state) {
    return STRUCTURE_TRACE_OCCLUDED(s, ray, state);
}

#ifdef SURFACES_ENABLED
Surface surface_at(StructureRef s, Ray ray, Hit hit) {
    return STRUCTURE_SURFACE_AT(s, ray, hit);
}
#endif

#endif
