// The buffers of shadow maps.
// Reads, writes: set SHADOW_MAPS_SET. The views are written with SHADOW_MAPS_VIEWS_WRITTEN, texels with
// SHADOW_MAPS_TEXELS_WRITTEN, else they are read.
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
// Depths as the bits of floats, which order like them, since none is negative.
layout(set = SHADOW_MAPS_SET, binding = 2, scalar) SHADOW_MAPS_TEXEL_ACCESS buffer ShadowMapsTexelBuffer {
    uint shadow_maps_texels[];
};

// Returns the place of a texel in the buffer; column and row are within the view.
uint shadow_maps_texel(uint view, uvec2 place, uint resolution) {
    return (view * resolution + place.y) * resolution + place.x;
}

#endif
