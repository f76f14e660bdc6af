// Lists the cells that the march through a cube visits, for tests.
// Reads: rays. Writes: visits (face, cell, interval of t), number of visits of each ray.
// One invocation per ray.
#version 460
#include "contract/extensions.glsl"
#include "contract/types.glsl"
#include "ads/march_cells.glsl"
#include "ads/march_cube.glsl"

layout(local_size_x = 64) in;

// A cell that a march visited, and where the ray was in it. Shared, 20 bytes.
struct Visit {
    uint face;            // 0 to 5; SEGMENT_NEAR for the near region
    int x;                // column, from -1 to the resolution
    int y;                // row, from -1 to the resolution
    float t_low;          // t at which the ray enters, lowered by the bound of its error
    float t_high;         // t at which the ray leaves, raised by the bound of its error
};

layout(set = 0, binding = 0, scalar) readonly buffer RayBuffer { Ray rays[]; };
layout(set = 0, binding = 1, scalar) buffer VisitBuffer { Visit visits[]; };
layout(set = 0, binding = 2, scalar) buffer CountBuffer { uint counts[]; };

// Number of rays, and the cells of the march. 16 bytes.
layout(push_constant, scalar) uniform CellMarchTestConstants {
    uint ray_count;       // rays
    uint resolution;      // cells along the side of a face
    uint limit;           // visits that are stored per ray at most
    float near_size;      // half side of the near region, metres
} pushed;

void add(uint ray, uint face, ivec2 cell, float t_low, float t_high) {
    uint place = counts[ray]++;
    if (place < pushed.limit) {
        visits[ray * pushed.limit + place] = Visit(face, cell.x, cell.y, t_low, t_high);
    }
}

void main() {
    uint index = gl_GlobalInvocationID.x;
    if (index >= pushed.ray_count) {
        return;
    }
    Ray ray = rays[index];
    vec2 near = near_region_interval(ray.origin, ray.direction, pushed.near_size);
    float t = ray.t_min;
    for (uint i = 0u; i < SEGMENT_LIMIT && t < ray.t_max; i++) {
        Segment segment = segment_at(ray.origin, ray.direction, t, ray.t_max, near);
        t = segment.t_end;
        if (segment.face == SEGMENT_NEAR) {
            add(index, SEGMENT_NEAR, ivec2(0), segment.t_begin - segment.t_error, segment.t_end + segment.t_error);
            continue;
        }
        CellMarch m = march_begin(face_from_world(ray.origin, segment.face), face_from_world(ray.direction, segment.face),
            pushed.resolution, segment.t_begin, segment.t_end, segment.t_error);
        bool more = true;
        while (more) {
            add(index, segment.face, m.cell, m.t_in - m.error_in, m.t_out + m.error_out);
            ivec2 cell;
            while (march_take_neighbour(m, cell)) {
                add(index, segment.face, cell, m.t_in - m.error_in, m.t_out + m.error_out);
            }
            more = march_next(m);
        }
    }
}
