// What: how a surface scatters: value, density and sampling of its lobes.
// Reads: materials (specular colour only). Writes: nothing.
// Source: docs/shading.md, "Reflection and transmission"; glTF 2.0 appendix B.
#ifndef SCENE_BSDF_GLSL
#define SCENE_BSDF_GLSL

#include "scene/accessors.glsl"
#include "scene/features.glsl"
#include "scene/microfacet.glsl"

// Below this perceptual roughness the microfacet lobes are perfect mirrors.
#define BSDF_SMOOTH_ROUGHNESS 0.03
// Indices closer to 1 than this do not bend: the half vector of refraction would be rounding noise.
#define BSDF_STRAIGHT_INDEX 1.0e-3
// Bounds of the probability of the diffuse family where both families exist.
#define BSDF_DIFFUSE_LEAST 0.05
#define BSDF_DIFFUSE_MOST 0.95

struct BsdfTerms {
    vec3 f0;             // dielectric, normal incidence
    float f90;
    vec3 base_color;
    float metallic;
    float transmission;
    float alpha;
    float eta;           // index on the side of o over the index on the other side; 1: straight on
    bool mirror;
    mat3 frame;          // world from local
    vec3 o;              // local
};

struct BsdfValue {
    vec3 value;          // 1/sr, cosine not included
    float pdf;           // 1/sr with which bsdf_sample answers this direction
};

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
    terms.alpha = max(s.roughness * s.roughness, BSDF_SMOOTH_ROUGHNESS * BSDF_SMOOTH_ROUGHNESS);
    bool straight = s.thickness <= 0.0 || terms.transmission <= 0.0 || abs(ior - 1.0) < BSDF_STRAIGHT_INDEX;
    terms.eta = straight ? 1.0 : (s.side == 1u ? 1.0 / ior : ior);
    terms.frame = basis_around(s.normal);
    terms.o = o * terms.frame;
    return terms;
}

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

vec3 bsdf_transmitted(BsdfTerms terms, float cosine) {
    float through = 1.0 - largest_component(bsdf_fresnel(terms, cosine));
    return terms.base_color * ((1.0 - terms.metallic) * terms.transmission * through);
}

vec3 bsdf_diffuse(BsdfTerms terms, float cosine_o, float cosine_i) {
    float share = (1.0 - terms.metallic) * (1.0 - terms.transmission);
    if (share <= 0.0) return vec3(0.0);
    float through = (1.0 - largest_component(bsdf_fresnel(terms, cosine_o)))
                  * (1.0 - largest_component(bsdf_fresnel(terms, cosine_i)));
    return terms.base_color * (share * through / MICROFACET_PI);
}

// Probability of the diffuse family.
float bsdf_diffuse_probability(BsdfTerms terms) {
    float diffuse = luminance(bsdf_diffuse(terms, terms.o.z, 1.0)) * MICROFACET_PI;
    float facets = luminance(bsdf_reflected(terms, terms.o.z) + bsdf_transmitted(terms, terms.o.z));
    if (diffuse <= 0.0) return 0.0;
    if (facets <= 0.0) return 1.0;
    return clamp(diffuse / (diffuse + facets), BSDF_DIFFUSE_LEAST, BSDF_DIFFUSE_MOST);
}

// Probability that a facet reflects what it does not absorb.
float bsdf_reflect_probability(BsdfTerms terms, float cosine) {
    float reflected = luminance(bsdf_reflected(terms, cosine));
    float transmitted = luminance(bsdf_transmitted(terms, cosine));
    return transmitted > 0.0 ? reflected / (reflected + transmitted) : 1.0;
}

// Half vector of a refraction from o to i, on the side of the normal.
vec3 bsdf_refraction_half(BsdfTerms terms, vec3 i) {
    vec3 h = normalize(terms.eta * terms.o + i);
    return h.z < 0.0 ? -h : h;
}

// 1 if i is reflected, -1 if transmitted, 0 if shading and geometric normal disagree or i grazes.
int bsdf_side(Surface s, vec3 world_i, vec3 i) {
    float geometric = dot(s.geometric_normal, world_i);
    if (i.z > 0.0 && geometric > 0.0) return 1;
    if (i.z < 0.0 && geometric < 0.0) return -1;
    return 0;
}

// What the rough microfacet family does towards local i: share of the value and density. The share
// is per unit of reflected (x) or transmitted light at the facet, whose cosine is `facet_cosine`.
void bsdf_facets(BsdfTerms terms, vec3 i, int side, out float facet_cosine, out float value, out float pdf) {
    facet_cosine = 0.0;
    value = 0.0;
    pdf = 0.0;
    vec3 o = terms.o;
    if (side > 0 || terms.eta == 1.0) {
        vec3 up = vec3(i.xy, abs(i.z));
        vec3 h = normalize(o + up);
        facet_cosine = dot(o, h);
        float distribution = ggx_distribution(h, terms.alpha);
        value = distribution * ggx_visibility(o.z, up.z, terms.alpha);
        pdf = distribution * ggx_visibility_one(o.z, terms.alpha);
        return;
    }
    vec3 h = bsdf_refraction_half(terms, i);
    float cosine_o = dot(o, h);
    float cosine_i = dot(i, h);
    // Both ends of a refraction lie on opposite sides of the facet.
    if (cosine_o <= 0.0 || cosine_i >= 0.0) return;
    float sum = terms.eta * cosine_o + cosine_i;
    float jacobian = -cosine_i / (sum * sum);
    float distribution = ggx_distribution(h, terms.alpha);
    facet_cosine = cosine_o;
    value = distribution * ggx_visibility(o.z, -i.z, terms.alpha) * 4.0 * cosine_o * jacobian;
    pdf = distribution * ggx_visibility_one(o.z, terms.alpha) * 4.0 * cosine_o * jacobian;
}

// Value and density towards i; o and i are unit and point away from the surface. Delta lobes are left out.
BsdfValue bsdf_towards(BsdfTerms terms, Surface s, vec3 i) {
    BsdfValue result = BsdfValue(vec3(0.0), 0.0);
    vec3 local = i * terms.frame;
    int side = bsdf_side(s, i, local);
    if (side == 0 || terms.o.z <= 0.0) return result;
    float diffuse = bsdf_diffuse_probability(terms);
    if (side > 0) {
        result.value = bsdf_diffuse(terms, terms.o.z, local.z);
        result.pdf = diffuse * local.z / MICROFACET_PI;
    }
    if (terms.mirror) return result;
    float cosine, facets, pdf;
    bsdf_facets(terms, local, side, cosine, facets, pdf);
    float reflect_share = bsdf_reflect_probability(terms, cosine);
    result.value += facets * (side > 0 ? bsdf_reflected(terms, cosine) : bsdf_transmitted(terms, cosine));
    result.pdf += (1.0 - diffuse) * pdf * (side > 0 ? reflect_share : 1.0 - reflect_share);
    return result;
}

// 1/sr, cosine not included.
vec3 bsdf_evaluate(Surface s, vec3 o, vec3 i) { return bsdf_towards(bsdf_terms(s, o), s, i).value; }

// 1/sr with which bsdf_sample answers i.
float bsdf_pdf(Surface s, vec3 o, vec3 i) { return bsdf_towards(bsdf_terms(s, o), s, i).pdf; }

// i refracted at the facet, or straight on through a thin wall. False beyond the critical angle.
bool bsdf_refract(BsdfTerms terms, vec3 h, out vec3 i) {
    float cosine = dot(terms.o, h);
    if (terms.eta == 1.0) {
        vec3 reflected = 2.0 * cosine * h - terms.o;
        i = vec3(reflected.xy, -reflected.z);
        return true;
    }
    float sine_squared = terms.eta * terms.eta * max(0.0, 1.0 - cosine * cosine);
    i = vec3(0.0);
    if (sine_squared >= 1.0) return false;
    i = (terms.eta * cosine - sqrt(1.0 - sine_squared)) * h - terms.eta * terms.o;
    return true;
}

// Random numbers: lobe, side, and two for the direction. flags 0: absorbed.
BsdfSample bsdf_sample(Surface s, vec3 o, vec4 random) {
    BsdfSample chosen = BsdfSample(vec3(0.0, 0.0, 1.0), 0.0, vec3(0.0), 0u);
    BsdfTerms terms = bsdf_terms(s, o);
    if (terms.o.z <= 0.0) return chosen;
    float diffuse = bsdf_diffuse_probability(terms);
    vec3 local;
    uint flags = SAMPLE_VALID;
    int expected = 1;
    if (random.x < diffuse) {
        local = cosine_hemisphere(random.zw);
    } else {
        vec3 h = terms.mirror ? vec3(0.0, 0.0, 1.0) : ggx_visible_normal(terms.o, terms.alpha, random.zw);
        float cosine = dot(terms.o, h);
        float reflect_share = bsdf_reflect_probability(terms, cosine);
        bool reflects = random.y < reflect_share;
        if (reflects) {
            local = 2.0 * cosine * h - terms.o;
        } else {
            if (!bsdf_refract(terms, h, local)) return chosen;
            flags |= SAMPLE_TRANSMITTED;
            expected = -1;
        }
        if (terms.mirror) {
            float probability = (1.0 - diffuse) * (reflects ? reflect_share : 1.0 - reflect_share);
            vec3 share = reflects ? bsdf_reflected(terms, cosine) : bsdf_transmitted(terms, cosine);
            vec3 world = normalize(terms.frame * local);
            if (bsdf_side(s, world, local) != expected || !(probability > 0.0)) return chosen;
            return BsdfSample(world, probability, share / probability, flags | SAMPLE_DELTA);
        }
    }
    vec3 world = normalize(terms.frame * local);
    // A facet can send light through the surface as a whole: single scattering loses it.
    if (bsdf_side(s, world, local) != expected) return chosen;
    BsdfValue towards = bsdf_towards(terms, s, world);
    if (!(towards.pdf > 0.0) || towards.pdf > 1.0e30) return chosen;
    vec3 weight = towards.value * (abs(dot(world, s.normal)) / towards.pdf);
    if (!(largest_component(weight) > 0.0)) return chosen;
    return BsdfSample(world, towards.pdf, weight, flags);
}

#endif
