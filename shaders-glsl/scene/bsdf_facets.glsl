// Terms of a surface's scattering seen from one direction, and light its facets reflect and let through once.
// Reads, writes: nothing.
// Source: docs/shading.md, "Reflection and transmission"; glTF 2.0 appendix B.
#ifndef SCENE_BSDF_FACETS_GLSL
#define SCENE_BSDF_FACETS_GLSL

#include "scene/features.glsl"
#include "scene/glass_albedo.glsl"
#include "scene/microfacet.glsl"

struct BsdfTerms {
    vec3 f0;             // dielectric, normal incidence
    float f90;
    vec3 base_color;
    float metallic;
    float transmission;
    float alpha;         // 0 for perfect mirrors; of facets that are rougher along one direction the root mean square
    vec2 alphas;         // along x and y of the frame
    bool anisotropic;    // they differ
    bool ward;           // reflects by Ward's lobe
    float eta;           // index on the side of o over the index on the other side; 1: straight on
    bool mirror;
    bool pane;           // a smooth thin wall: what it lets through is followed apart, and is in no lobe
    mat3 frame;          // world from local; z is the normal of the facets
    vec3 base;           // shading normal, local: the cosine family lies around it
    vec3 o;              // local
    float loss_o;        // share of the light that one scattering at the facets loses
    float loss_mean;     // its mean over the hemisphere
    vec3 returned;       // share of the lost light that is reflected
    vec3 passed;         // share of the lost light that goes through a thin wall
    float returned_most; // of the dielectric, the largest channel
    float entering_o;    // share of the light that the dielectric lets in
    float entering_mean; // its mean over the hemisphere
    GlassRows glass;     // of a rough volume; the rest is zero where it has none
    uint glass_side;     // block of the side of o
    float glass_o;       // share of the light that one scattering at the boundary loses
    float glass_mean;    // its mean over the hemisphere
    float glass_beyond;  // the mean on the other side
    vec3 glass_returned; // share of the lost light that is reflected
    vec3 glass_passed;   // share of the lost light that goes through
};

// Returns the reflected share of the dielectric at a facet seen under `cosine`. Schlick's curve holds on the
// side of the smaller index; beyond the critical angle everything is reflected.
vec3 bsdf_fresnel(BsdfTerms terms, float cosine) {
    float x = cosine;
    if (terms.eta > 1.0) {
        float sine_squared = terms.eta * terms.eta * (1.0 - cosine * cosine);
        if (sine_squared >= 1.0) return vec3(1.0);
        x = sqrt(1.0 - sine_squared);
    }
    return terms.f0 + (vec3(terms.f90) - terms.f0) * fresnel_power(x);
}

vec3 bsdf_reflected(BsdfTerms terms, float cosine) {
    if (!SHADING_FACETS) return vec3(0.0);
    vec3 metal = terms.base_color + (vec3(1.0) - terms.base_color) * fresnel_power(cosine);
    return mix(bsdf_fresnel(terms, cosine), metal, terms.metallic);
}

// Returns the share of the surface that lets light through.
float bsdf_volume_share(BsdfTerms terms) {
    return (1.0 - terms.metallic) * terms.transmission;
}

vec3 bsdf_facet_transmitted(BsdfTerms terms, float cosine) {
    float through = 1.0 - largest_component(bsdf_fresnel(terms, cosine));
    return terms.base_color * (bsdf_volume_share(terms) * through);
}

vec3 bsdf_transmitted(BsdfTerms terms, float cosine) {
    return SHADING_PANES && terms.pane ? vec3(0.0) : bsdf_facet_transmitted(terms, cosine);
}

// Returns the share of the light that a pane lets through in a straight line; 0 for everything else.
vec3 bsdf_straight(BsdfTerms terms) {
    return SHADING_PANES && terms.pane && terms.o.z > 0.0 ? bsdf_facet_transmitted(terms, terms.o.z) : vec3(0.0);
}

#endif
