// Building blocks of scattering, in a frame whose z axis is the shading normal.
// Reads, writes: nothing.
// Source: docs/shading.md, "Reflection and transmission"; Duff et al., "Building an orthonormal basis,
// revisited", JCGT 6(1), 2017; Walter et al. 2007 (GGX); Heitz 2014 (height-correlated masking); Dupuy and
// Benyoub 2023 (visible normals as a spherical cap).
#ifndef SCENE_MICROFACET_GLSL
#define SCENE_MICROFACET_GLSL

#define MICROFACET_PI 3.14159265358979

// Returns a basis with the columns tangent, bitangent, normal.
mat3 basis_around(vec3 normal) {
    float turn = normal.z >= 0.0 ? 1.0 : -1.0;
    float a = -1.0 / (turn + normal.z);
    float b = normal.x * normal.y * a;
    return mat3(vec3(1.0 + turn * normal.x * normal.x * a, turn * b, -turn * normal.x),
                vec3(b, turn + normal.y * normal.y * a, -normal.y), normal);
}

// Returns a direction over the upper hemisphere, with density cosine / pi.
vec3 cosine_hemisphere(vec2 random) {
    float radius = sqrt(random.x);
    float azimuth = 2.0 * MICROFACET_PI * random.y;
    return vec3(radius * cos(azimuth), radius * sin(azimuth), sqrt(max(0.0, 1.0 - random.x)));
}

// Returns the GGX distribution of facet normals, 1/sr. The formula does without 1 - z*z, which cancels for
// small alpha.
float ggx_distribution(vec3 h, float alpha) {
    float slope = (h.x * h.x + h.y * h.y) / (alpha * alpha) + h.z * h.z;
    return 1.0 / (MICROFACET_PI * alpha * alpha * slope * slope);
}

float ggx_root(float cosine, float alpha) {
    return sqrt(alpha * alpha + (1.0 - alpha * alpha) * cosine * cosine);
}

// Returns G(o, i) / (4 cos o cos i) for positive cosines.
float ggx_visibility(float cosine_o, float cosine_i, float alpha) {
    return 0.5 / (cosine_o * ggx_root(cosine_i, alpha) + cosine_i * ggx_root(cosine_o, alpha));
}

// Returns G1(o) / (4 cos o).
float ggx_visibility_one(float cosine_o, float alpha) {
    return 0.5 / (cosine_o + ggx_root(cosine_o, alpha));
}

// The following overloads are for facets with one alpha along x and another one along y. o and i are
// directions on either side of the surface.
float ggx_distribution(vec3 h, vec2 alpha) {
    vec3 scaled = vec3(h.xy / alpha, h.z);
    float slope = dot(scaled, scaled);
    return 1.0 / (MICROFACET_PI * alpha.x * alpha.y * slope * slope);
}

float ggx_root(vec3 direction, vec2 alpha) {
    return length(vec3(alpha * direction.xy, direction.z));
}

float ggx_visibility(vec3 o, vec3 i, vec2 alpha) {
    return 0.5 / (abs(o.z) * ggx_root(i, alpha) + abs(i.z) * ggx_root(o, alpha));
}

float ggx_visibility_one(vec3 o, vec2 alpha) {
    return 0.5 / (abs(o.z) + ggx_root(o, alpha));
}

// Returns a facet normal that is visible from o, with the density G1(o) D(h) max(0, o.h) / cos o. `alpha` is
// that along x and that along y.
vec3 ggx_visible_normal(vec3 o, vec2 alpha, vec2 random) {
    vec3 stretched = normalize(vec3(alpha * o.xy, o.z));
    float azimuth = 2.0 * MICROFACET_PI * random.x;
    float z = (1.0 - random.y) * (1.0 + stretched.z) - stretched.z;
    float sine = sqrt(clamp(1.0 - z * z, 0.0, 1.0));
    vec3 h = vec3(sine * cos(azimuth), sine * sin(azimuth), z) + stretched;
    return normalize(vec3(alpha * h.xy, max(h.z, 1.0e-7)));
}

// Returns (1 - cosine)^5 of Schlick's curve.
float fresnel_power(float cosine) {
    float rest = clamp(1.0 - cosine, 0.0, 1.0);
    float squared = rest * rest;
    return squared * squared * rest;
}

float luminance(vec3 color) { return dot(color, vec3(0.2126, 0.7152, 0.0722)); }
float largest_component(vec3 color) { return max(color.x, max(color.y, color.z)); }

#endif
