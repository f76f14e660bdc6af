// Lists the squares that a traversal of a flat grid visits, for tests: once in one go, and once with a stop
// and a resumption at every square.
// Reads: rays in units of cells. Writes: visits (square, rows left), counts. One invocation per ray.
#version 460
#include "contract/extensions.glsl"
#include "contract/bits.glsl"
#include "contract/types.glsl"
#include "ldc/march.glsl"

layout(local_size_x = 64) in;

layout(set = 0, binding = 0, scalar) readonly buffer RayBuffer { Ray rays[]; };
layout(set = 0, binding = 1, scalar) buffer VisitBuffer { ivec3 visits[]; };
layout(set = 0, binding = 2, scalar) buffer CountBuffer { uint counts[]; };

// Rays and squares to march through. 16 bytes.
layout(push_constant, scalar) uniform SquareMarchTestConstants {
    uint ray_count;       // number of rays
    int first;            // first square of the area, the same along both sides
    int last;             // last square of the area, the same along both sides
    uint limit;           // visits stored per traversal
} pushed;

void traverse(uint index, Ray ray, bool stopped) {
    LdcFlatRay flat_ray = ldc_flat_ray(ray.origin.xy, ray.direction.xy);
    LdcArea area = ldc_area(flat_ray, vec2(1.0), ivec2(pushed.first), ivec2(pushed.last));
    vec2 t = vec2(ray.t_min, ray.t_max);
    LdcMarch march;
    bool more = ldc_march_begin(flat_ray, area, t, march);
    while (more) {
        if (stopped) {
            uint kept = bits_of_cell(ldc_march_square(flat_ray, march));
            ldc_march_begin(flat_ray, area, t, march);
            ldc_march_resume(flat_ray, cell_of_bits(kept), march);
        }
        uint place = counts[index]++;
        if (place < pushed.limit) {
            visits[index * pushed.limit + place] = ivec3(ldc_march_square(flat_ray, march), march.rows);
        }
        more = ldc_march_next(flat_ray, march);
    }
}

void main() {
    uint index = gl_GlobalInvocationID.x;
    if (index < pushed.ray_count) {
        traverse(2u * index, rays[index], false);
        traverse(2u * index + 1u, rays[index], true);
    }
}
