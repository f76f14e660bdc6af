// The terms of a surface's scattering, seen from one direction, and the light that its facets reflect and
// transmit in one scattering.
// Reads, writes: nothing.
// Source: docs/shading.md, "Reflection and transmission"; glTF 2.0 appendix B.
#ifndef SCENE_BSDF_FACETS_GLSL
#define SCENE_BSDF_FACETS_GLSL

#include "scene/features.glsl"
#include "scene/glass_albedo.glsl"
#include "scene/microfacet.glsl"

// Terms of the scattering at a surface that is seen from direction o. Shares of light are by colour channel
// where they are vectors.
struct BsdfTerms {
    vec3 f0;             // reflectance of the dielectric at normal incidence
    // reflectance of the dielectric at grazing angles
    float f90;
    vec3 base_color;
    float metallic;
    float transmission;
    // alpha of the facets, 0 for perfect mirrors; root mean square of both `alphas` if these differ
    float alpha;
    vec2 alphas;         // alpha along x and along y of the frame
    bool anisotropic;    // true if the two alphas differ
    bool ward;           // true if the surface reflects by Ward's lobe
    float eta;           // index on the side of o over the index on the other side; 1: light goes straight on
    // true if facets are perfect mirrors
    bool mirror;
    // true for a smooth thin wall: the light that it lets through is followed apart, and is in no lobe
    bool pane;
    mat3 frame;          // world from local; local z is the normal of the facets
    vec3 base;           // shading normal, local, around which the cosine family lies
    vec3 o;              // unit direction from which the surface is seen, local
    float loss_o;        // share of the light from o that one scattering at the facets loses
    float loss_mean;     // mean of this share over the hemisphere
    vec3 returned;       // share of the lost light that is reflected
    vec3 passed;         // share of the lost light that goes through a thin wall
    float returned_most; // share of its lost light that the dielectric reflects, by its brightest channel
    float entering_o;    // share of the light from o that enters the dielectric
    float entering_mean; // mean of this share over the hemisphere
    GlassRows glass;     // rows of a rough volume's table; if it has none, the members below are zero
    uint glass_side;     // block of the table for the side of o
    float glass_o;       // share of the light from o that one scattering at the boundary loses
    float glass_mean;    // mean of this share over the hemisphere
    float glass_beyond;  // the same mean on the other side
    vec3 glass_returned; // share of the light lost at the boundary that is reflected
    vec3 glass_passed;   // share of the light lost at the boundary that goes through
};

// Returns the share of the light that a facet of the dielectric reflects, seen under `cosine`. Schlick's
// curve holds for the cosine on the side of the smaller index. Beyond the critical angle everything is
// reflected.
vec3 bsdf_fresnel(BsdfTerms terms, float cosine) {
    float x = cosine;
    if (terms.eta > 1.0) {
        float sine_squared = terms.eta * terms.eta * (1.0 - cosine * cosine);
        if (sine_squared >= 1.0) return vec3(1.0);
        x = sqrt(1.0 - sine_squared);
    }
    return terms.f0 + (vec3(terms.f90) - terms.f0) * fresnel_power(x);
}

// Returns the share of the light that a facet reflects, seen under `cosine`.
vec3 bsdf_reflected(BsdfTerms terms, float cosine) {
    if (!SHADING_FACETS) return vec3(0.0);
    vec3 metal = terms.base_color + (vec3(1.0) - terms.base_color) * fresnel_power(cosine);
    return mix(bsdf_fresnel(terms, cosine), metal, terms.metallic);
}

// Returns the share of the surface that may let light through.
float bsdf_volume_share(BsdfTerms terms) {
    return (1.0 - terms.metallic) * terms.transmission;
}

// Returns the share of the light that a facet lets through, seen under `cosine`, panes included.
vec3 bsdf_facet_transmitted(BsdfTerms terms, float cosine) {
    float through = 1.0 - largest_component(bsdf_fresnel(terms, cosine));
    return terms.base_color * (bsdf_volume_share(terms) * through);
}

// Returns the share of the light that a facet transmits in a lobe. A pane has no such lobe.
vec3 bsdf_transmitted(BsdfTerms terms, float cosine) {
    return SHADING_PANES && terms.pane ? vec3(0.0) : bsdf_facet_transmitted(terms, cosine);
}

// Returns the share of the light that goes straight through a pane; 0 for any other surface.
vec3 bsdf_straight(BsdfTerms terms) {
    return SHADING_PANES && terms.pane && terms.o.z > 0.0 ? bsdf_facet_transmitted(terms, terms.o.z) : vec3(0.0);
}

#endif
