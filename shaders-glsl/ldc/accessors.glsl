// Declares the pools of a layered depth cube, and reads and writes lists, depths and payload of fragments.
// Reads, writes: header, lists, depths, payload, blocks, heads, conservative lists, scratch. Stages that
// define STRUCTURE_READ_ONLY only read them.
// A place is the number of a fragment over all lists.
#ifndef LDC_ACCESSORS_GLSL
#define LDC_ACCESSORS_GLSL

#include "ldc/header.glsl"
#include "ads/axis_views.glsl"
#include "ads/constants.glsl"

POOL_WORDS(ldc, lists, 1)
POOL_WORDS(ldc, depths, 2)
POOL_WORDS(ldc, payload, 3)
POOL_WORDS(ldc, blocks, 4)
POOL_WORDS(ldc, heads, 5)
POOL_WORDS(ldc, conservative, 6)
POOL_WORDS(ldc, scratch, 7)
#define LDC_POOL(s, pool) POOL_WORDS_OF(ldc, pool, LDC_HEADER(s))

// Returns the view along an axis.
AxisView ldc_view(LdcRef s, uint axis) {
    return AxisView(LDC_HEADER(s).origin, LDC_HEADER(s).cell, LDC_HEADER(s).resolution, axis);
}

uint ldc_cell_count(LdcRef s) {
    return AXIS_VIEWS * LDC_HEADER(s).resolution * LDC_HEADER(s).resolution;
}

// Returns the number of words at the front of the scratch pool that hold the sums of the scan. Long lists, or
// with peeling the counts of layers, lie behind them.
uint ldc_scan_words(LdcRef s) {
    return (ldc_cell_count(s) + SCAN_BLOCK - 1u) / SCAN_BLOCK;
}

// Returns the running index of a cell over all views.
uint ldc_cell(LdcRef s, uint axis, ivec2 cell) {
    return axis_cell_index(axis, cell, LDC_HEADER(s).resolution);
}

// True if the pools hold all fragments that the build found.
bool ldc_fragments_fit(LdcRef s) {
    return LDC_HEADER(s).demand <= LDC_HEADER(s).capacity;
}

// Returns the place at which a list begins that may begin at `place` or behind it. Two depths of 16 bits
// share a word; lists then begin at even places, so that no two lists share a word.
uint ldc_aligned(uint place) {
    return LDC_DEPTH_BITS == 16u ? (place + 1u) & ~1u : place;
}

// Returns the number of places that hold fragments.
uint ldc_places(LdcRef s) {
    return min(LDC_HEADER(s).capacity, LDC_HEADER(s).demand);
}

// Returns the first place of a cell's list, and the place behind its last one. A list that reaches beyond
// `places`, the number that exist, is counted as corrupted and treated as empty.
uvec2 ldc_list(LdcRef s, uint cell, uint places) {
    uint begin = cell == 0u ? 0u : ldc_aligned(LDC_POOL(s, lists)[cell - 1u]);
    uint end = LDC_POOL(s, lists)[cell];
    if (begin > end || end > places) {
        atomicAdd(LDC_HEADER(s).corrupted, 1u);
        return uvec2(0u);
    }
    return uvec2(begin, end);
}

// Returns the number of words of a fragment's payload together with the triangle that LDC_IDS keeps for
// diagnostics. With attributes the first word holds the triangle until all passes that need triangles are
// done.
uint ldc_payload_stride() {
    return (LDC_PAYLOAD == LDC_PAYLOAD_ATTRIBUTES ? 2u : 1u) + LDC_IDS;
}

// Returns the triangle of a fragment. With attributes it exists during the build only.
uint ldc_primitive(LdcRef s, uint place) {
    return LDC_POOL(s, payload)[ldc_payload_stride() * place];
}

void ldc_set_primitive(LdcRef s, uint place, uint primitive) {
    LDC_POOL(s, payload)[ldc_payload_stride() * place] = primitive;
}

// Lowers the triangle at a place to `primitive`, if `primitive` is lower. The bits of a place start out as
// ones.
void ldc_lower_primitive(LdcRef s, uint place, uint primitive) {
    atomicMin(LDC_POOL(s, payload)[ldc_payload_stride() * place], primitive);
}

// Returns colour and normal of a fragment. An invalid place is counted as corrupted.
uvec2 ldc_attributes(LdcRef s, uint place) {
    if (place >= ldc_places(s)) {
        atomicAdd(LDC_HEADER(s).corrupted, 1u);
        return uvec2(0u);
    }
    uint first = ldc_payload_stride() * place;
    return uvec2(LDC_POOL(s, payload)[first], LDC_POOL(s, payload)[first + 1u]);
}

// Replaces the triangle of a fragment by colour and normal. With LDC_IDS the triangle moves behind them.
void ldc_set_attributes(LdcRef s, uint place, uvec2 words) {
    uint first = ldc_payload_stride() * place;
    if (LDC_IDS != 0u) {
        LDC_POOL(s, payload)[first + 2u] = LDC_POOL(s, payload)[first];
    }
    LDC_POOL(s, payload)[first] = words.x;
    LDC_POOL(s, payload)[first + 1u] = words.y;
}

// Returns the triangle of a fragment with attributes, which LDC_IDS keeps. An invalid place is counted as
// corrupted.
uint ldc_kept_id(LdcRef s, uint place) {
    if (place >= ldc_places(s)) {
        atomicAdd(LDC_HEADER(s).corrupted, 1u);
        return PRIMITIVE_UNKNOWN;
    }
    return LDC_POOL(s, payload)[ldc_payload_stride() * place + 2u];
}

// Returns the bits as which a depth is stored. With 16 bits they are the depth as a share of the cube's side.
uint ldc_depth_bits(LdcRef s, float z) {
    return LDC_DEPTH_BITS == 16u ? packHalf2x16(vec2(z / LDC_HEADER(s).size, 0.0)) & 0xFFFFu : floatBitsToUint(z);
}

// Returns the value of a half-float that is not negative. The function works on bits, because compilers
// replace unpackHalf2x16(packHalf2x16(x)) by x, while the stored value differs from x.
float ldc_half(uint bits) {
    return bits < 0x400u ? float(bits) * (1.0 / 16777216.0) : uintBitsToFloat((bits << 13u) + 0x38000000u);
}

float ldc_depth_of_bits(LdcRef s, uint bits) {
    return LDC_DEPTH_BITS == 16u ? ldc_half(bits) * LDC_HEADER(s).size : uintBitsToFloat(bits);
}

// Returns the largest error of a stored depth, metres.
float ldc_depth_rounding(LdcRef s) {
    return LDC_DEPTH_BITS == 16u ? 2.5e-4 * LDC_HEADER(s).size : 0.0;
}

// Returns how far the fragments of a surface may lie from a point of the surface, metres. Over a cell a
// surface rises by no more than a cell.
float ldc_reach(LdcRef s) {
    return LDC_HEADER(s).cell + LDC_HEADER(s).tolerance + ldc_depth_rounding(s);
}

// Stores the first depth at a place. Where two depths share a word, the word starts out as zero.
void ldc_add_depth(LdcRef s, uint place, uint bits) {
    if (LDC_DEPTH_BITS == 16u) {
        atomicOr(LDC_POOL(s, depths)[place >> 1u], bits << (16u * (place & 1u)));
    } else {
        LDC_POOL(s, depths)[place] = bits;
    }
}

uint ldc_bits_at(LdcRef s, uint place) {
    if (LDC_DEPTH_BITS == 16u) {
        return (LDC_POOL(s, depths)[place >> 1u] >> (16u * (place & 1u))) & 0xFFFFu;
    }
    return LDC_POOL(s, depths)[place];
}

// Lowers the depth at a place to `bits`, if `bits` are lower. The bits of a place start out as ones. Of two
// depths that share a word, the first is final before the second is lowered.
void ldc_lower_depth(LdcRef s, uint place, uint bits) {
    uint word = bits;
    if (LDC_DEPTH_BITS == 16u) {
        word = (place & 1u) == 0u ? 0xFFFF0000u | bits : bits << 16u | ldc_bits_at(s, place - 1u);
    }
    atomicMin(LDC_POOL(s, depths)[LDC_DEPTH_BITS == 16u ? place >> 1u : place], word);
}

// Returns the depth of a fragment as it was stored, metres.
float ldc_depth(LdcRef s, uint place) {
    return ldc_depth_of_bits(s, ldc_bits_at(s, place));
}

// Counts a fragment that is layer `layer` of its cell.
void ldc_count_layer(LdcRef s, uint layer) {
    if (layer >= LDC_HEADER(s).layer_limit) {
        atomicAdd(LDC_HEADER(s).beyond, 1u);
    }
    if (LDC_HEADER(s).layer_demand <= layer) {
        atomicMax(LDC_HEADER(s).layer_demand, layer + 1u);
    }
    if (layer < LDC_HEADER(s).layer_capacity) {
        atomicAdd(LDC_POOL(s, scratch)[ldc_scan_words(s) + layer], 1u);
    }
}

// Replaces the depth at a place, in a list that no other thread writes.
void ldc_set_bits(LdcRef s, uint place, uint bits) {
    if (LDC_DEPTH_BITS == 16u) {
        uint shift = 16u * (place & 1u);
        LDC_POOL(s, depths)[place >> 1u] = (LDC_POOL(s, depths)[place >> 1u] & ~(0xFFFFu << shift)) | bits << shift;
    } else {
        LDC_POOL(s, depths)[place] = bits;
    }
}

#endif
