// Makes the terms of scattering at a surface that is seen from one direction, and gives the shares and
// probabilities of the cosine family.
// Reads: materials (specular colour, table of rough glass), vertex attributes (that table); where facets are
// rougher along one direction, what scene/anisotropy.glsl reads. Writes: nothing.
// Source: docs/shading.md, "Reflection and transmission", "Energy"; glTF 2.0 appendix B.
#ifndef SCENE_BSDF_TERMS_GLSL
#define SCENE_BSDF_TERMS_GLSL

#include "scene/accessors.glsl"
#include "scene/bsdf_energy.glsl"
#include "scene/ward.glsl"
#ifdef BSDF_WITHOUT_TRIANGLES
// Kernels whose surfaces belong to no triangle bind no geometry, so nothing says where tangents point.
float anisotropy_at(Surface s, out vec3 rougher) {
    rougher = vec3(0.0);
    return 0.0;
}
#else
#include "scene/anisotropy.glsl"
#endif

// Bounds of the probability of the cosine family, if both families exist. Its least value is the first
// number, or the share of the light that the family sends times the second number if that is smaller: near
// the horizon the family sends more than cosines tell. The third number is its largest value.
#define BSDF_COSINE_LEAST 0.05
#define BSDF_COSINE_FACTOR 4.0
#define BSDF_COSINE_MOST 0.95
// Cosine between o and the facets' normal, to which the normal is bent if the shading normal faces away from
// o.
#define BSDF_NORMAL_COSINE 0.01
// Least height over the geometric surface of the direction mirrored by the facets' normal: the first number,
// or the second number times the height of o if o itself grazes. The second number is less than 1, so that a
// normal that agrees with the surface keeps its bits.
#define BSDF_MIRRORED_HEIGHT 0.01
#define BSDF_MIRRORED_SHARE 0.9

// Returns the normal around which facets lie. This is the shading normal, bent until it faces o, and then
// bent just so far that the mirror image of o leaves the geometric surface. To bend it so far, the mirrored
// direction is lifted to the least height; the vector halfway between o and the lifted direction is then the
// normal that mirrors o to that direction.
vec3 bsdf_facet_normal(Surface s, vec3 o) {
    vec3 normal = s.normal;
    float cosine = dot(normal, o);
    if (cosine < BSDF_NORMAL_COSINE) normal = normalize(normal + (BSDF_NORMAL_COSINE - cosine) * o);
    vec3 mirrored = 2.0 * dot(normal, o) * normal - o;
    float height = dot(mirrored, s.geometric_normal);
    float least = min(BSDF_MIRRORED_HEIGHT, BSDF_MIRRORED_SHARE * dot(o, s.geometric_normal));
    if (height >= least) return normal;
    vec3 along = mirrored - height * s.geometric_normal;
    float squared = dot(along, along);
    if (!(squared > 0.0)) return s.geometric_normal;
    vec3 lifted = s.geometric_normal * least + along * (sqrt(1.0 - least * least) * inversesqrt(squared));
    return normalize(o + lifted);
}

// Turns the frame so that facets are rougher along its x axis, and sets their roughness. Across that axis
// facets have at least BSDF_SMOOTH_ROUGHNESS, so they are no mirrors.
void bsdf_set_anisotropy(inout BsdfTerms terms, Surface s) {
    vec3 rougher;
    float strength = anisotropy_at(s, rougher);
    vec3 normal = terms.frame[2];
    vec3 along = rougher - normal * dot(normal, rougher);
    float squared = dot(along, along);
    if (!(strength > 0.0) || !(squared > 0.0)) return;
    along *= inversesqrt(squared);
    terms.frame = mat3(along, cross(normal, along), normal);
    float roughness = max(s.roughness, BSDF_SMOOTH_ROUGHNESS);
    float least = roughness * roughness;
    terms.anisotropic = true;
    terms.alphas = vec2(least + (1.0 - least) * strength * strength, least);
    terms.alpha = sqrt(0.5 * dot(terms.alphas, terms.alphas));
    terms.mirror = false;
    terms.pane = false;
}

// Returns the terms of scattering at a surface, seen from the unit direction o.
BsdfTerms bsdf_terms(Surface s, vec3 o) {
    BsdfTerms terms;
    // In glTF an index of 0 stands for full reflection. Such a surface does not bend light.
    float ior = s.ior > 1.0e-3 ? s.ior : 1.0;
    float root = (max(s.ior, 0.0) - 1.0) / (max(s.ior, 0.0) + 1.0);
    terms.f0 = min(root * root * scene_material_specular_color(s.material), vec3(1.0)) * s.specular;
    terms.f90 = s.specular;
    terms.base_color = s.base_color;
    terms.metallic = s.metallic;
    terms.transmission = SHADING_TRANSMISSION ? s.transmission : 0.0;
    terms.mirror = s.roughness < BSDF_SMOOTH_ROUGHNESS;
    terms.pane = SHADING_PANES && terms.mirror && s.thickness <= 0.0 && terms.transmission > 0.0;
    terms.alpha = terms.mirror ? 0.0 : s.roughness * s.roughness;
    terms.alphas = vec2(terms.alpha);
    terms.anisotropic = false;
    terms.ward = SPECULAR_IS_WARD && !(terms.transmission > 0.0);
    bool straight = s.thickness <= 0.0 || terms.transmission <= 0.0 || abs(ior - 1.0) < BSDF_STRAIGHT_INDEX;
    terms.eta = straight ? 1.0 : (s.side == 1u ? 1.0 / ior : ior);
    terms.frame = basis_around(bsdf_facet_normal(s, o));
    if (SHADING_ANISOTROPY) bsdf_set_anisotropy(terms, s);
    // Nothing makes up for the losses of Ward's lobe. The base below the lobe is lit as below a mirror.
    if (terms.ward) terms.alpha = 0.0;
    terms.base = s.normal * terms.frame;
    terms.o = o * terms.frame;
    bsdf_set_glass(terms, s);
    if (SHADING_FACETS) bsdf_set_energy(terms);
    else bsdf_set_no_facets(terms);
    return terms;
}

// Returns the share of the surface that is its diffuse base.
float bsdf_diffuse_share(BsdfTerms terms) {
    return (1.0 - terms.metallic) * (1.0 - terms.transmission);
}

// Returns the probability with which a path goes straight through a pane. The pane lets the share `straight`
// of the light through.
float bsdf_straight_probability(BsdfTerms terms, vec3 straight) {
    float through = luminance(straight);
    if (!(through > 0.0)) return 0.0;
    float rest = luminance(bsdf_reflected(terms, terms.o.z))
               + luminance(terms.base_color) * (bsdf_diffuse_share(terms) * terms.entering_o);
    return through / (through + rest);
}

// Returns the value of the cosine family, 1/sr: of the diffuse base, and of the light that leaves the facets
// after several scatterings. `cosine` is that of the other direction and positive; `side` is as for
// bsdf_side.
vec3 bsdf_cosine_family(BsdfTerms terms, float cosine, int side) {
    if (!SHADING_FACETS) return side > 0 ? terms.base_color * (1.0 / MICROFACET_PI) : vec3(0.0);
    float loss = albedo_loss(cosine, terms.alpha);
    float several = terms.loss_o > 0.0 ? terms.loss_o * loss / (terms.loss_mean * MICROFACET_PI) : 0.0;
    vec3 glass = bsdf_glass(terms, cosine, side);
    if (side < 0) return terms.passed * several + glass;
    float share = bsdf_diffuse_share(terms);
    if (share <= 0.0) return terms.returned * several + glass;
    float through = terms.entering_o * bsdf_entering(terms, cosine, loss) / terms.entering_mean;
    return terms.returned * several + glass + terms.base_color * (share * through / MICROFACET_PI);
}

// Finds the probability of the cosine family, and within the family the probability of going through the
// surface.
void bsdf_cosine_probability(BsdfTerms terms, out float family, out float through) {
    if (!SHADING_FACETS) {
        family = luminance(terms.base_color) > 0.0 ? 1.0 : 0.0;
        through = 0.0;
        return;
    }
    float down = luminance(terms.passed) * terms.loss_o + luminance(terms.glass_passed) * terms.glass_o;
    float up = luminance(terms.returned) * terms.loss_o + luminance(terms.glass_returned) * terms.glass_o
             + luminance(terms.base_color) * (bsdf_diffuse_share(terms) * terms.entering_o);
    float total = up + down;
    float volume = terms.glass_mean > 0.0 ? bsdf_volume_share(terms) : 0.0;
    float facets = (1.0 - mix(terms.loss_o, terms.glass_o, volume))
                 * luminance(bsdf_reflected(terms, terms.o.z) + bsdf_transmitted(terms, terms.o.z));
    through = total > 0.0 ? down / total : 0.0;
    if (total <= 0.0) family = 0.0;
    else if (facets <= 0.0) family = 1.0;
    else {
        float share = total / (total + facets);
        family = clamp(share, min(BSDF_COSINE_LEAST, BSDF_COSINE_FACTOR * share), BSDF_COSINE_MOST);
    }
}

#endif
