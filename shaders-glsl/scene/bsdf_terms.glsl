// What: what scattering at one surface towards one direction needs to know: shares, probabilities and the light that
// leaves the facets after several scatterings.
// Reads: materials (specular colour, table of rough glass), vertex attributes (that table); what scene/anisotropy.glsl
// reads where facets are rougher along one direction. Writes: nothing.
// Source: docs/shading.md, "Reflection and transmission", "Energy"; glTF 2.0 appendix B.
#ifndef SCENE_BSDF_TERMS_GLSL
#define SCENE_BSDF_TERMS_GLSL

#include "scene/accessors.glsl"
#include "scene/albedo.glsl"
#include "scene/features.glsl"
#include "scene/glass_albedo.glsl"
#include "scene/microfacet.glsl"
#include "scene/ward.glsl"
#ifdef BSDF_WITHOUT_TRIANGLES
// Kernels whose surfaces are of no triangle bind none: nothing says where tangents point.
float anisotropy_at(Surface s, out vec3 rougher) {
    rougher = vec3(0.0);
    return 0.0;
}
#else
#include "scene/anisotropy.glsl"
#endif

// Bounds of the probability of the cosine family where both families exist. It may exceed its share of the light by
// this factor: near the horizon it sends more than cosines tell.
#define BSDF_COSINE_LEAST 0.05
#define BSDF_COSINE_FACTOR 4.0
#define BSDF_COSINE_MOST 0.95
// Cosine to which the facets' normal is bent where the shading normal faces away from o.
#define BSDF_NORMAL_COSINE 0.01
// Height of a mirrored direction over the geometric surface: at least this, or this share of that of o where o itself
// grazes. Below 1, so that a normal that agrees with the surface keeps its bits.
#define BSDF_MIRRORED_HEIGHT 0.01
#define BSDF_MIRRORED_SHARE 0.9

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

// Reflected share of the dielectric at a facet seen under `cosine`. Schlick's curve holds on the side
// of the smaller index; beyond the critical angle everything is reflected.
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
    vec3 metal = terms.base_color + (vec3(1.0) - terms.base_color) * fresnel_power(cosine);
    return mix(bsdf_fresnel(terms, cosine), metal, terms.metallic);
}

// Share of the surface that lets light through.
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

// Share of the light that a pane lets through in a straight line; 0 of everything else.
vec3 bsdf_straight(BsdfTerms terms) {
    return SHADING_PANES && terms.pane && terms.o.z > 0.0 ? bsdf_facet_transmitted(terms, terms.o.z) : vec3(0.0);
}

// Mean reflectance of the dielectric's facets on the side of the smaller index.
vec3 bsdf_facet_mean(BsdfTerms terms) {
    return terms.f0 + (vec3(terms.f90) - terms.f0) * ALBEDO_SCHLICK_MEAN;
}

// Share of the light from `cosine` that the dielectric as a whole does not reflect, by its brightest channel.
float bsdf_entering(BsdfTerms terms, float cosine, float loss) {
    if (terms.eta > 1.0) {
        if (terms.glass.first != ATTRIBUTE_NONE) return 1.0 - glass_albedo(terms.glass, GLASS_REFLECTED, cosine);
        return 1.0 - largest_component(bsdf_fresnel(terms, cosine));
    }
    float schlick = albedo_schlick(cosine, terms.alpha, loss);
    float once = largest_component(terms.f0) * (1.0 - loss - schlick) + terms.f90 * schlick;
    return max(1.0 - once - terms.returned_most * loss, 0.0);
}

// Mean share of the light that the dielectric's facets let through, by its brightest channel. From the side of the
// larger index it is smaller by the square of the ratio: beyond the critical angle nothing goes through.
float bsdf_facet_through(BsdfTerms terms) {
    float through = 1.0 - largest_component(bsdf_facet_mean(terms));
    return terms.eta > 1.0 ? through / (terms.eta * terms.eta) : through;
}

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

// What becomes of light that one scattering at the boundary of a rough volume loses: it goes through as facets let it,
// but no more than is lost for light that takes the same way back.
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
    // Inside, what is reflected is mostly reflected in full.
    vec3 tint = terms.eta < 1.0 && most > 0.0 ? facet / most : vec3(1.0);
    terms.glass_returned = tint * (share * (1.0 - through));
    terms.glass_passed = terms.base_color * (share * through);
}

// What becomes of light that one scattering loses, of what is not a volume's. What the dielectric loses on the side of
// the larger index counts as let in.
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

// The normal that facets lie around: the shading normal, bent until it faces o, and then just so far that o mirrored at
// it leaves the geometric surface: the mirrored direction is lifted to the least height, and what lies halfway between
// it and o mirrors one to the other.
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

// Turns the frame so that facets are rougher along its x axis, and makes them so. Facets that are smooth across it scatter all
// the same.
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

BsdfTerms bsdf_terms(Surface s, vec3 o) {
    BsdfTerms terms;
    // glTF: an index of 0 stands for full reflection; such a surface does not bend light.
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
    // Nothing makes up for what Ward's lobe loses: the rest is as below a mirror.
    if (terms.ward) terms.alpha = 0.0;
    terms.base = s.normal * terms.frame;
    terms.o = o * terms.frame;
    bsdf_set_glass(terms, s);
    bsdf_set_energy(terms);
    return terms;
}

// Share of the diffuse base.
float bsdf_diffuse_share(BsdfTerms terms) {
    return (1.0 - terms.metallic) * (1.0 - terms.transmission);
}

// Probability with which a path goes straight through a pane that lets `straight` of the light through.
float bsdf_straight_probability(BsdfTerms terms, vec3 straight) {
    float through = luminance(straight);
    if (!(through > 0.0)) return 0.0;
    float rest = luminance(bsdf_reflected(terms, terms.o.z))
               + luminance(terms.base_color) * (bsdf_diffuse_share(terms) * terms.entering_o);
    return through / (through + rest);
}

// What left the boundary of a rough volume after several scatterings, 1/sr; as bsdf_cosine_family.
vec3 bsdf_glass(BsdfTerms terms, float cosine, int side) {
    if (!SHADING_TRANSMISSION || !(terms.glass_mean > 0.0)) return vec3(0.0);
    uint block = side > 0 ? terms.glass_side : GLASS_LOST_BACK - terms.glass_side;
    float lost = terms.glass_o * glass_albedo(terms.glass, block, cosine) / MICROFACET_PI;
    return side > 0 ? terms.glass_returned * (lost / terms.glass_mean)
                    : terms.glass_passed * (lost / terms.glass_beyond);
}

// Value of the cosine family, 1/sr: the diffuse base, and what left the facets after several scatterings. `cosine` of
// the other direction is positive; `side` as of bsdf_side.
vec3 bsdf_cosine_family(BsdfTerms terms, float cosine, int side) {
    float loss = albedo_loss(cosine, terms.alpha);
    float several = terms.loss_o > 0.0 ? terms.loss_o * loss / (terms.loss_mean * MICROFACET_PI) : 0.0;
    vec3 glass = bsdf_glass(terms, cosine, side);
    if (side < 0) return terms.passed * several + glass;
    float share = bsdf_diffuse_share(terms);
    if (share <= 0.0) return terms.returned * several + glass;
    float through = terms.entering_o * bsdf_entering(terms, cosine, loss) / terms.entering_mean;
    return terms.returned * several + glass + terms.base_color * (share * through / MICROFACET_PI);
}

// Probability of the cosine family, and within it of going through the surface.
void bsdf_cosine_probability(BsdfTerms terms, out float family, out float through) {
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
