// Scatters light at given surfaces and draws random numbers, for tests.
// Reads: cases, the seed of the frame. Writes: results. One invocation per case.
// Source: docs/shading.md, "Reflection and transmission", "Random numbers".
#version 460
#include "contract/extensions.glsl"
#define BSDF_WITHOUT_TRIANGLES
#include "scene/bsdf.glsl"
#include "scene/random.glsl"

layout(local_size_x = 64) in;

// Input of a test.
struct Case {
    Surface surface;
    // unit direction from which the surface is seen
    vec3 o;
    uint pixel;         // key of the random numbers, as are sample_index and dimension
    vec3 i;             // unit direction in which scattering is evaluated, beside the sampled one
    uint sample_index;
    uint dimension;
};

// Output of a test.
struct Result {
    BsdfSample chosen;
    vec3 value;         // towards i, 1/sr
    float pdf;
    vec4 random;
};

layout(set = 0, binding = 0, scalar) readonly buffer CaseBuffer { Case cases[]; };
layout(set = 0, binding = 1, scalar) writeonly buffer ResultBuffer { Result results[]; };

void main() {
    uint index = gl_GlobalInvocationID.x;
    if (index >= cases.length()) {
        return;
    }
    Case c = cases[index];
    vec4 random = random_vec4(c.pixel, c.sample_index, c.dimension);
    BsdfSample chosen = bsdf_sample(bsdf_terms(c.surface, c.o), c.surface, random);
    results[index] = Result(chosen, bsdf_evaluate(c.surface, c.o, c.i), bsdf_pdf(c.surface, c.o, c.i), random);
}
