// Stores each triangle of a divided cell in those of the smaller cells that it reaches into.
// Reads: records, bricks, geometry, header. Writes: records (without the divided cells), records and masks of
// the next level, header.record_demand, header.record_groups, header.demand.
// One invocation per record of the level.
// Source: bricks/refine.glsl.
#version 460
#include "contract/extensions.glsl"
#include "bricks/bin.glsl"
#include "bricks/level.glsl"
#include "bricks/refine.glsl"

layout(local_size_x = BUILD_GROUP_SIZE) in;

void main() {
    uint next = build.step + 1u;
    BoxCells axes = bricks_axes(build.structure, next);
    uvec3 all = bricks_cells(build.structure) << 2u * bricks_divisions(build.structure, next);
    uvec3 side = uvec3(bricks_side(build.structure, build.step));
    ivec3 next_side = bricks_side(build.structure, next);
    uint entries = 0u;
    uvec2 range = bricks_level_records();
    for (uint place = range.x; place < range.y; place += BRICKS_LEVEL_STRIDE) {
        BricksRecord record = bricks_record(build.structure, place);
        uvec2 divided = bricks_divided(build.structure, record.brick);
        uvec2 cells = divided & record.cells;
        if ((cells.x | cells.y) == 0u) {
            continue;
        }
        bricks_set_cells(build.structure, place, record.cells & ~divided);
        BinTriangle triangle;
        if (!bin_centred(BRICKS_HEADER(build.structure).centre, record.primitive, triangle)) {
            continue;
        }
        BoxClip clip = box_clip_begin(axes, all, triangle.a, triangle.b, triangle.c);
        uvec3 brick = bricks_place_of(build.structure, record.brick, build.step);
        uint child = BRICKS_POOL(build.structure, bricks)[bricks_child_at(record.brick)];
        // There is one loop over the columns of all divided cells, so that in lockstep invocations with few
        // cells or columns do not wait for those with many.
        Refined part;
        uint word;
        uint bit;
        bool begins = true;
        while (true) {
            if (begins) {
                if (!bricks_take_cell(cells, word, bit)) {
                    break;
                }
                part = refined_begin(clip, side * brick + uvec3(bricks_cell_of_bit(word, bit)), next_side);
            }
            begins = !refined_column(clip, part);
            if (begins) {
                // The entry of the divided cell no longer exists, so 1 is subtracted.
                entries += uint(bitCount(part.cells.x) + bitCount(part.cells.y)) - 1u;
                if ((part.cells.x | part.cells.y) != 0u) {
                    uint of_cell = child + bricks_rank(divided, word, bit);
                    bricks_store_record(build.structure, next, BricksRecord(record.primitive, of_cell, box_clip_is_small(clip), part.cells));
                }
            }
        }
    }
    bricks_count_entries(build.structure, entries);
}
