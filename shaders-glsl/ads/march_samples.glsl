// Marches a segment of a ray in steps of equal length on the screen, as the MMRT paper does.
// Reads, writes: nothing.
// Source: MMRT section 3.4, with its jitter "using a fixed offset per ray"; McGuire and Mara 2014. Each
// sample stands for one cell, which is tested against the depths of the sample's step. Cells between samples
// are not visited: this is the published approximation.
// Steps divide the segment between its two end points, since 1/z is linear on the screen; nothing is
// accumulated.
#ifndef ADS_MARCH_SAMPLES_GLSL
#define ADS_MARCH_SAMPLES_GLSL

#include "contract/random_words.glsl"
#include "ads/views.glsl"

// The samples of a segment.
struct SampleMarch {
    vec2 place_begin;     // place on the screen where the segment begins, in cells
    vec2 place_end;       // place on the screen where it ends, in cells
    float z_begin;        // depth where the segment begins, metres, positive
    float z_end;          // depth where it ends, metres, positive
    float t_begin;        // t where it begins
    float t_end;          // t where it ends
    uint resolution;      // cells along a side of the face
    uint count;           // number of samples
    float offset;         // place of a sample within its step, as a fraction of the step
};

// Returns the jitter of a ray, a fraction of a step in [0, 1): a hash of the ray's bits.
float samples_jitter(vec3 origin, vec3 direction) {
    uvec3 words = random_words(uvec4(floatBitsToUint(origin), 0u)).xyz;
    return random_unit(random_words(uvec4(words ^ floatBitsToUint(direction), 1u)).x);
}

// Begins a march. Origin and direction are in face space, and the segment lies in the pyramid of the face.
// `samples` is the largest number of samples. If steps are longer than a cell, `jitter` is the place of
// samples within steps; in shorter steps samples are in the middle.
SampleMarch samples_begin(vec3 origin, vec3 direction, uint resolution, float t_begin, float t_end, uint samples, float jitter) {
    SampleMarch m;
    vec3 p = origin + t_begin * direction;
    vec3 q = origin + t_end * direction;
    m.z_begin = max(p.z, 1.0e-30);
    m.z_end = max(q.z, 1.0e-30);
    float side = float(resolution);
    m.place_begin = clamp((p.xy / m.z_begin * 0.5 + 0.5) * side, vec2(0.0), vec2(side));
    m.place_end = clamp((q.xy / m.z_end * 0.5 + 0.5) * side, vec2(0.0), vec2(side));
    m.t_begin = t_begin;
    m.t_end = t_end;
    m.resolution = resolution;
    vec2 span = abs(m.place_end - m.place_begin);
    // A step is one cell long along the longer axis, or longer if that would take more than `samples`
    // samples.
    float cells = ceil(max(span.x, span.y));
    m.count = uint(clamp(cells, 1.0, float(samples)));
    m.offset = cells > float(samples) ? jitter : 0.5;
    return m;
}

// Returns t at a fraction of the segment's length on the screen.
float samples_t(SampleMarch m, float share) {
    float near_weight = (1.0 - share) * m.z_end;
    float far_weight = share * m.z_begin;
    return (m.t_begin * near_weight + m.t_end * far_weight) / (near_weight + far_weight);
}

// Returns the cell of sample `i`, and the interval of t of its step.
void samples_cell(SampleMarch m, uint i, out ivec2 cell, out float t_in, out float t_out) {
    float step_share = 1.0 / float(m.count);
    vec2 place = mix(m.place_begin, m.place_end, (float(i) + m.offset) * step_share);
    cell = min(ivec2(place), ivec2(m.resolution) - 1);
    t_in = samples_t(m, float(i) * step_share);
    t_out = samples_t(m, float(i + 1u) * step_share);
}

#endif
