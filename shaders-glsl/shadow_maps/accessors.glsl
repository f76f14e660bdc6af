// Declares the buffers of shadow maps.
// Reads, writes: the buffers of set SHADOW_MAPS_SET. Views are written if SHADOW_MAPS_VIEWS_WRITTEN is
// defined, texels if SHADOW_MAPS_TEXELS_WRITTEN is; otherwise they are only read.
#ifndef SHADOW_MAPS_ACCESSORS_GLSL
#define SHADOW_MAPS_ACCESSORS_GLSL

#include "contract/types.glsl"
#include "shadow_maps/constants.glsl"
#include "shadow_maps/types.glsl"

#ifndef SHADOW_MAPS_SET
#define SHADOW_MAPS_SET 1
#endif

#ifdef SHADOW_MAPS_VIEWS_WRITTEN
#define SHADOW_MAPS_VIEW_ACCESS
#else
#define SHADOW_MAPS_VIEW_ACCESS readonly
#endif
#ifdef SHADOW_MAPS_TEXELS_WRITTEN
#define SHADOW_MAPS_TEXEL_ACCESS coherent
#else
#define SHADOW_MAPS_TEXEL_ACCESS readonly
#endif

layout(set = SHADOW_MAPS_SET, binding = 0, scalar) SHADOW_MAPS_VIEW_ACCESS buffer ShadowMapsHeaderBuffer {
    ShadowMapsHeader shadow_maps_header;
    ShadowMapsLight shadow_maps_lights[];
};
layout(set = SHADOW_MAPS_SET, binding = 1, scalar) SHADOW_MAPS_VIEW_ACCESS buffer ShadowMapsViewBuffer {
    ShadowMapsView shadow_maps_views[];
};
// Texels hold depths as the bits of floats. Depths are not negative, so they order like their bits.
layout(set = SHADOW_MAPS_SET, binding = 2, scalar) SHADOW_MAPS_TEXEL_ACCESS buffer ShadowMapsTexelBuffer {
    uint shadow_maps_texels[];
};

// Returns the number of a texel in the buffer; column and row are within the view.
uint shadow_maps_texel(uint view, uvec2 place, uint resolution) {
    return (view * resolution + place.y) * resolution + place.x;
}

#endif
