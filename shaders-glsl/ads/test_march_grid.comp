// Lists the cells that the march through a grid visits, for tests.
// Reads: rays in grid units. Writes: visits (cells), number of visits of each ray.
// One invocation per ray.
#version 460
#include "contract/extensions.glsl"
#include "contract/types.glsl"
#include "ads/march_grid.glsl"

layout(local_size_x = 64) in;

layout(set = 0, binding = 0, scalar) readonly buffer RayBuffer { Ray rays[]; };
layout(set = 0, binding = 1, scalar) buffer VisitBuffer { ivec3 visits[]; };
layout(set = 0, binding = 2, scalar) buffer CountBuffer { uint counts[]; };

// Number of rays, and the cells of the march. 12 bytes.
layout(push_constant, scalar) uniform GridMarchTestConstants {
    uint ray_count;       // rays
    uint size;            // cells along each axis
    uint limit;           // visits that are stored per ray at most
} pushed;

void add(uint ray, ivec3 cell) {
    uint place = counts[ray]++;
    if (place < pushed.limit) {
        visits[ray * pushed.limit + place] = cell;
    }
}

void main() {
    uint index = gl_GlobalInvocationID.x;
    if (index >= pushed.ray_count) {
        return;
    }
    Ray ray = rays[index];
    GridMarch m;
    if (!grid_begin(ray.origin, ray.direction, ivec3(pushed.size), ray.t_min, ray.t_max, m)) {
        return;
    }
    bool more = true;
    while (more) {
        add(index, m.cell);
        ivec3 cell;
        while (grid_take_neighbour(m, cell)) {
            add(index, cell);
        }
        more = grid_next(m);
    }
}
