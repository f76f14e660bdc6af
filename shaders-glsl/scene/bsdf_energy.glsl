// Light that one scattering at the facets loses, and what becomes of it: after several scatterings it is
// reflected or goes through.
// Reads: materials (table of rough glass), vertex attributes (that table). Writes: nothing.
// Source: docs/shading.md, "Energy".
#ifndef SCENE_BSDF_ENERGY_GLSL
#define SCENE_BSDF_ENERGY_GLSL

#include "scene/accessors.glsl"
#include "scene/albedo.glsl"
#include "scene/bsdf_facets.glsl"

// Returns the mean reflectance of the dielectric's facets, seen from the side of the smaller index.
vec3 bsdf_facet_mean(BsdfTerms terms) {
    return terms.f0 + (vec3(terms.f90) - terms.f0) * ALBEDO_SCHLICK_MEAN;
}

// Returns the share of the light from `cosine` that the dielectric as a whole does not reflect, by its
// brightest channel.
float bsdf_entering(BsdfTerms terms, float cosine, float loss) {
    if (terms.eta > 1.0) {
        if (terms.glass.first != ATTRIBUTE_NONE) return 1.0 - glass_albedo(terms.glass, GLASS_REFLECTED, cosine);
        return 1.0 - largest_component(bsdf_fresnel(terms, cosine));
    }
    float schlick = albedo_schlick(cosine, terms.alpha, loss);
    float once = largest_component(terms.f0) * (1.0 - loss - schlick) + terms.f90 * schlick;
    return max(1.0 - once - terms.returned_most * loss, 0.0);
}

// Returns the mean share of the light that the dielectric's facets let through, by its brightest channel.
// From the side of the larger index it is smaller by the square of the ratio of indices, because nothing goes
// through beyond the critical angle.
float bsdf_facet_through(BsdfTerms terms) {
    float through = 1.0 - largest_component(bsdf_facet_mean(terms));
    return terms.eta > 1.0 ? through / (terms.eta * terms.eta) : through;
}

// Returns the mean of bsdf_entering over the hemisphere, weighted by the cosine.
float bsdf_entering_mean(BsdfTerms terms) {
    if (terms.eta > 1.0) {
        bool rough = terms.glass.first != ATTRIBUTE_NONE;
        float entering = rough ? 1.0 - glass_albedo_mean(terms.glass, GLASS_REFLECTED) : bsdf_facet_through(terms);
        return max(entering, 1.0e-6);
    }
    float schlick = albedo_schlick_mean(terms.alpha);
    float once = largest_component(terms.f0) * (1.0 - terms.loss_mean - schlick) + terms.f90 * schlick;
    return max(1.0 - once - terms.returned_most * terms.loss_mean, 1.0e-3);
}

// Sets the terms of the light that one scattering at the boundary of a rough volume loses. As much of it goes
// through as facets let through, but no more than is lost on the way back, so that scattering is reciprocal.
void bsdf_set_glass(inout BsdfTerms terms, Surface s) {
    terms.glass = GlassRows(ATTRIBUTE_NONE, 0.0);
    terms.glass_side = s.side == 1u ? GLASS_LOST_FRONT : GLASS_LOST_BACK;
    terms.glass_o = 0.0;
    terms.glass_mean = 0.0;
    terms.glass_beyond = 0.0;
    terms.glass_returned = vec3(0.0);
    terms.glass_passed = vec3(0.0);
    if (!SHADING_TRANSMISSION || terms.eta == 1.0 || terms.alpha < ALBEDO_LOSSLESS_ALPHA) return;
    uint table = scene_material_albedo(s.material);
    if (table == ATTRIBUTE_NONE) return;
    terms.glass = glass_rows(table, terms.anisotropic ? sqrt(terms.alpha) : s.roughness);
    float mean = glass_albedo_mean(terms.glass, terms.glass_side);
    float beyond = glass_albedo_mean(terms.glass, GLASS_LOST_BACK - terms.glass_side);
    if (!(mean > 0.0) || !(beyond > 0.0)) return;
    terms.glass_mean = mean;
    terms.glass_beyond = beyond;
    terms.glass_o = glass_albedo(terms.glass, terms.glass_side, max(terms.o.z, 0.0));
    float share = bsdf_volume_share(terms);
    float through = bsdf_facet_through(terms) * min(1.0, beyond / mean);
    vec3 facet = bsdf_facet_mean(terms);
    float most = largest_component(facet);
    // Inside a volume, most of the light that is reflected is reflected in full.
    vec3 tint = terms.eta < 1.0 && most > 0.0 ? facet / most : vec3(1.0);
    terms.glass_returned = tint * (share * (1.0 - through));
    terms.glass_passed = terms.base_color * (share * through);
}

// Sets the terms of the light that one scattering loses outside of volumes. On the side of the larger index,
// losses of the dielectric count as light that enters.
void bsdf_set_energy(inout BsdfTerms terms) {
    terms.loss_o = albedo_loss(max(terms.o.z, 0.0), terms.alpha);
    terms.loss_mean = albedo_loss_mean(terms.alpha);
    vec3 metal = terms.base_color + (vec3(1.0) - terms.base_color) * ALBEDO_SCHLICK_MEAN;
    vec3 returned = terms.eta > 1.0 ? vec3(0.0) : albedo_returned(bsdf_facet_mean(terms), terms.loss_mean);
    terms.returned_most = largest_component(returned);
    if (terms.eta != 1.0) returned *= 1.0 - terms.transmission;
    terms.returned = mix(returned, albedo_returned(metal, terms.loss_mean), terms.metallic);
    float through = terms.eta == 1.0 ? bsdf_volume_share(terms) : 0.0;
    terms.passed = terms.base_color * (through * (1.0 - terms.returned_most));
    terms.entering_o = bsdf_entering(terms, max(terms.o.z, 0.0), terms.loss_o);
    terms.entering_mean = bsdf_entering_mean(terms);
}

// Sets the terms of bsdf_set_energy for a material without facets, which all light enters.
void bsdf_set_no_facets(inout BsdfTerms terms) {
    terms.loss_o = 0.0;
    terms.loss_mean = 1.0;
    terms.returned = vec3(0.0);
    terms.passed = vec3(0.0);
    terms.returned_most = 0.0;
    terms.entering_o = 1.0;
    terms.entering_mean = 1.0;
}

// Returns the light that leaves the boundary of a rough volume after several scatterings, 1/sr. Arguments are
// as for bsdf_cosine_family.
vec3 bsdf_glass(BsdfTerms terms, float cosine, int side) {
    if (!SHADING_TRANSMISSION || !(terms.glass_mean > 0.0)) return vec3(0.0);
    uint block = side > 0 ? terms.glass_side : GLASS_LOST_BACK - terms.glass_side;
    float lost = terms.glass_o * glass_albedo(terms.glass, block, cosine) / MICROFACET_PI;
    return side > 0 ? terms.glass_returned * (lost / terms.glass_mean)
                    : terms.glass_passed * (lost / terms.glass_beyond);
}

#endif
