// Samples textures from buffers of texels: wrap modes; nearest, bilinear and trilinear filtering.
// Reads: textures, texels. Writes: nothing.
// Source: docs/shading.md, "Textures".
#ifndef SCENE_TEXTURE_GLSL
#define SCENE_TEXTURE_GLSL

#include "scene/accessors.glsl"
#include "scene/features.glsl"

float srgb_decode(float encoded) {
    return encoded <= 0.04045 ? encoded / 12.92 : pow((encoded + 0.055) / 1.055, 2.4);
}

// Brings a coordinate near [0, 1] (with mirrored repeat [0, 2)), so that integers are exact afterwards. A
// coordinate that is not finite becomes 0.
float texture_reduce(float u, uint wrap) {
    if (!(abs(u) < 1.0e9)) return 0.0;
    if (wrap == WRAP_REPEAT) return u - floor(u);
    if (wrap == WRAP_MIRROR) return u - 2.0 * floor(u * 0.5);
    return clamp(u, -0.5, 1.5);
}

// Returns the index of a texel for x in [-size, 2 size].
int texture_wrap(int x, int size, uint wrap) {
    if (wrap == WRAP_REPEAT) {
        if (x < 0) x += size;
        if (x >= size) x -= size;
    } else if (wrap == WRAP_MIRROR) {
        if (x >= 2 * size) x -= 2 * size;
        if (x < 0) x = -1 - x;
        if (x >= size) x = 2 * size - 1 - x;
    }
    return clamp(x, 0, size - 1);
}

// Returns a texel of the level that begins at `first_texel` and is `width` texels wide, decoded to linear.
vec4 texture_fetch(Texture source, uint first_texel, int width, ivec2 texel) {
    vec4 value = scene_texel(first_texel + uint(texel.y) * uint(width) + uint(texel.x));
    if ((source.sampling & TEXTURE_SRGB) != 0u) {
        value.rgb = vec3(srgb_decode(value.r), srgb_decode(value.g), srgb_decode(value.b));
    }
    return value;
}

// Samples one level; uv is already reduced. If the texture is filtered the function reads four texels,
// otherwise one. Both cases fetch their first texel by the same code.
vec4 texture_sample_level(Texture source, vec2 uv, uint level) {
    uint first_texel = source.first_texel;
    uvec2 size = uvec2(source.width, source.height);
    for (uint l = 0u; l < level; l++) {
        first_texel += size.x * size.y;
        size = max(size >> 1, uvec2(1u));
    }
    ivec2 extent = ivec2(size);
    uint wrap_u = source.sampling & 3u;
    uint wrap_v = (source.sampling >> TEXTURE_WRAP_V_SHIFT) & 3u;
    bool filtered = (source.sampling & TEXTURE_LINEAR) != 0u;
    vec2 place = uv * vec2(extent);
    if (filtered) place -= 0.5;
    vec2 corner = floor(place);
    vec2 share = place - corner;
    ivec2 texel = ivec2(corner);
    ivec2 near = ivec2(texture_wrap(texel.x, extent.x, wrap_u), texture_wrap(texel.y, extent.y, wrap_v));
    vec4 first = texture_fetch(source, first_texel, extent.x, near);
    if (!filtered) return first;
    ivec2 far = ivec2(texture_wrap(texel.x + 1, extent.x, wrap_u), texture_wrap(texel.y + 1, extent.y, wrap_v));
    vec4 top = mix(first, texture_fetch(source, first_texel, extent.x, ivec2(far.x, near.y)), share.x);
    vec4 bottom = mix(texture_fetch(source, first_texel, extent.x, ivec2(near.x, far.y)),
                      texture_fetch(source, first_texel, extent.x, far), share.x);
    return mix(top, bottom, share.y);
}

// Returns the RGBA of a texture, decoded to linear if the texture holds sRGB; white if there is no texture. A
// loop samples both levels by the same code: a kernel that has this function at several places compiles in a
// fraction of the time.
vec4 texture_sample(TextureRef reference, vec2 uv, float level) {
    if (!SHADING_TEXTURES || reference.texture == TEXTURE_NONE) return vec4(1.0);
    Texture source = scene_texture(reference.texture);
    vec2 place = vec2(dot(reference.row_u, vec3(uv, 1.0)), dot(reference.row_v, vec3(uv, 1.0)));
    place.x = texture_reduce(place.x, source.sampling & 3u);
    place.y = texture_reduce(place.y, (source.sampling >> TEXTURE_WRAP_V_SHIFT) & 3u);
    float last = float(source.level_count - 1u);
    float used = level > 0.0 ? min(level, last) : 0.0;
    bool filtered = (source.sampling & TEXTURE_LINEAR) != 0u;
    float lower = filtered ? floor(used) : used + 0.5;
    uint levels = filtered && used > lower ? 2u : 1u;
    vec4 value = vec4(0.0);
    [[dont_unroll]] for (uint above = 0u; above < levels; above++) {
        vec4 sampled = texture_sample_level(source, place, uint(lower) + above);
        value = above == 0u ? sampled : mix(value, sampled, used - lower);
    }
    return value;
}

// Returns the level of a texture for a footprint that is `footprint` metres across. The surface covers
// `uv_area` of texture coordinates (before the texture's transform) per square metre. The level is 0 for a
// footprint of 0.
float texture_level(TextureRef reference, float uv_area, float footprint) {
    if (!SHADING_TEXTURES || reference.texture == TEXTURE_NONE || !(footprint > 0.0)) return 0.0;
    Texture source = scene_texture(reference.texture);
    float determinant = reference.row_u.x * reference.row_v.y - reference.row_u.y * reference.row_v.x;
    float texels = uv_area * abs(determinant) * float(source.width) * float(source.height);
    if (!(texels > 0.0)) return 0.0;
    return 0.5 * log2(texels) + log2(footprint);
}

#endif
