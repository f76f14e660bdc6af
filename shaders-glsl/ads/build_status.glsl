// The status word of a build that has ended. It contains the stamp of the triangles that the build was made
// of.
// Reads: the geometry's header. Writes: nothing.
#ifndef ADS_BUILD_STATUS_GLSL
#define ADS_BUILD_STATUS_GLSL

#include "ads/geometry.glsl"
#include "contract/constants.glsl"

// Returns the status: complete if everything fitted (`fits`) and every triangle is within the stated bounds.
uint build_status(bool fits) {
    return geometry_header.stamp | (fits && geometry_is_sound() ? STATUS_COMPLETE : STATUS_OVERFLOW);
}

#endif
