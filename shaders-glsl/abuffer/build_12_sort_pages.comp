// Sorts the nodes of each page in place: by depth, and nodes of equal depth by the first word of their
// payload.
// Reads: header, nodes, data. Writes: nodes, data. One invocation per page.
// Source: not in the paper. Slots of a page are used from its end. Unused slots have depth 0 and stay in
// front, so the pass need not know how many slots are used.
#version 460
#include "contract/extensions.glsl"
#include "abuffer/exchange.glsl"
#include "abuffer/lists.glsl"
#include "abuffer/names.glsl"
#include "ads/build_constants.glsl"

layout(local_size_x = SORT_GROUP_SIZE) in;

void main() {
    uint page = gl_GlobalInvocationID.y * gl_NumWorkGroups.x * SORT_GROUP_SIZE + gl_GlobalInvocationID.x;
    uint pages = ABUFFER_HEADER(build.structure).demand;
    if (pages > ABUFFER_HEADER(build.structure).capacity || page >= pages) {
        return;
    }
    uint first = page * ABUFFER_PAGE + 1u;
    // A page has at most 8 nodes, so both loops take at most 28 steps.
    for (uint i = 1u; i < ABUFFER_PAGE; i++) {
        for (uint k = i; k > 0u && !abuffer_comes_first(build.structure, first + k - 1u, first + k); k--) {
            abuffer_exchange(build.structure, first + k - 1u, first + k);
        }
    }
}
