// Reads the light that rough glass loses in one scattering from the table of its material.
// Reads: vertex attributes. Writes: nothing.
// Source: docs/shading.md, "Energy". Polynomials in cosine, roughness and index are not accurate enough.
#ifndef SCENE_GLASS_ALBEDO_GLSL
#define SCENE_GLASS_ALBEDO_GLSL

#include "scene/accessors.glsl"

// Blocks of a table: light lost that arrives at the front; light lost that arrives at the back; light
// reflected once on the side of the larger index.
#define GLASS_LOST_FRONT 0u
#define GLASS_LOST_BACK 1u
#define GLASS_REFLECTED 2u

// The two rows of a table around a roughness.
struct GlassRows {
    uint first;          // word of the lower row in the first block, or ATTRIBUTE_NONE
    float above;         // weight of the row above
};

// Returns the rows around a perceptual roughness, in the table that begins at word `table`.
GlassRows glass_rows(uint table, float roughness) {
    float place = clamp(roughness, 0.0, 1.0) * float(GLASS_ROWS - 1u);
    uint row = min(uint(place), GLASS_ROWS - 2u);
    return GlassRows(table + row * GLASS_ROW_WORDS, place - float(row));
}

// Returns the value between both rows at a word of the lower row.
float glass_between(GlassRows rows, uint word) {
    return mix(scene_vertex_float(word), scene_vertex_float(word + GLASS_ROW_WORDS), rows.above);
}

// Returns the value of a block of the table at a cosine. Columns are spaced evenly in the root of the cosine,
// because losses change fastest at grazing angles.
float glass_albedo(GlassRows rows, uint block, float cosine) {
    float place = sqrt(clamp(cosine, 0.0, 1.0)) * float(GLASS_ROW_WORDS - 2u);
    uint column = min(uint(place), GLASS_ROW_WORDS - 3u);
    uint word = rows.first + block * (GLASS_ROWS * GLASS_ROW_WORDS) + column;
    return mix(glass_between(rows, word), glass_between(rows, word + 1u), place - float(column));
}

// Returns the mean of a block's values over the hemisphere, weighted by the cosine.
float glass_albedo_mean(GlassRows rows, uint block) {
    return glass_between(rows, rows.first + block * (GLASS_ROWS * GLASS_ROW_WORDS) + GLASS_ROW_WORDS - 1u);
}

#endif
