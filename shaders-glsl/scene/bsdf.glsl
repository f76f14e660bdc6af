// Scattering at a surface: value, density and sampling of its lobes.
// Reads: materials (specular colour only). Writes: nothing.
// Source: docs/shading.md, "Reflection and transmission", "Energy"; glTF 2.0 appendix B.
// In these functions o points to the previous vertex of the path, i to the light. A surface has two families
// of lobes: facets, which reflect or refract once, and the cosine family, which is the diffuse base and the
// light that leaves the facets after several scatterings.
#ifndef SCENE_BSDF_GLSL
#define SCENE_BSDF_GLSL

#include "scene/bsdf_terms.glsl"

// Scattering towards one direction.
struct BsdfValue {
    // 1/sr, with the cosine: the families may lie around different normals, so their cosines differ
    vec3 value;
    float pdf;           // 1/sr: density with which bsdf_sample chooses this direction
};

// Returns the probability that a facet reflects, and does not transmit, the light that it does not absorb.
float bsdf_reflect_probability(BsdfTerms terms, float cosine) {
    float reflected = luminance(bsdf_reflected(terms, cosine));
    float transmitted = luminance(bsdf_transmitted(terms, cosine));
    return transmitted > 0.0 ? reflected / (reflected + transmitted) : 1.0;
}

// Returns the half vector of a refraction from o to i, on the side of the normal.
vec3 bsdf_refraction_half(BsdfTerms terms, vec3 i) {
    vec3 h = normalize(terms.eta * terms.o + i);
    return h.z < 0.0 ? -h : h;
}

// Returns the side on which i lies: 1 if light is reflected, -1 if it is transmitted, and 0 if i grazes or
// lies on different sides of the geometric surface and of the normal to which `cosine` belongs.
int bsdf_side(Surface s, vec3 world_i, float cosine) {
    float geometric = dot(s.geometric_normal, world_i);
    if (cosine > 0.0 && geometric > 0.0) return 1;
    if (cosine < 0.0 && geometric < 0.0) return -1;
    return 0;
}

// Returns the distribution D(h) of the facets' normals, 1/sr.
float bsdf_distribution(BsdfTerms terms, vec3 h) {
    if (terms.anisotropic) return ggx_distribution(h, terms.alphas);
    return ggx_distribution(h, terms.alpha);
}

// Returns G(o, i) / (4 |cos o cos i|) of the facets.
float bsdf_visibility(BsdfTerms terms, vec3 i) {
    if (terms.anisotropic) return ggx_visibility(terms.o, i, terms.alphas);
    return ggx_visibility(terms.o.z, abs(i.z), terms.alpha);
}

// Returns G1(o) / (4 cos o) of the facets.
float bsdf_visibility_one(BsdfTerms terms) {
    if (terms.anisotropic) return ggx_visibility_one(terms.o, terms.alphas);
    return ggx_visibility_one(terms.o.z, terms.alpha);
}

// Evaluates the rough facets towards i, which is local. `value` is per unit of the light that a facet
// reflects or transmits under `facet_cosine`; `pdf` is the density of i among the directions that facets
// choose.
void bsdf_facets(BsdfTerms terms, vec3 i, int side, out float facet_cosine, out float value, out float pdf) {
    facet_cosine = 0.0;
    value = 0.0;
    pdf = 0.0;
    vec3 o = terms.o;
    if (side > 0 || terms.eta == 1.0) {
        vec3 up = vec3(i.xy, abs(i.z));
        vec3 h = normalize(o + up);
        facet_cosine = dot(o, h);
        if (terms.ward) {
            float halves = ward_distribution(h, terms.alphas);
            value = halves / (4.0 * facet_cosine * facet_cosine);
            pdf = halves * h.z / (4.0 * facet_cosine);
            return;
        }
        float distribution = bsdf_distribution(terms, h);
        value = distribution * bsdf_visibility(terms, up);
        pdf = distribution * bsdf_visibility_one(terms);
        return;
    }
    vec3 h = bsdf_refraction_half(terms, i);
    float cosine_o = dot(o, h);
    float cosine_i = dot(i, h);
    // The two directions of a refraction lie on opposite sides of the facet.
    if (cosine_o <= 0.0 || cosine_i >= 0.0) return;
    float sum = terms.eta * cosine_o + cosine_i;
    float jacobian = -cosine_i / (sum * sum);
    float distribution = bsdf_distribution(terms, h);
    facet_cosine = cosine_o;
    value = distribution * bsdf_visibility(terms, i) * 4.0 * cosine_o * jacobian;
    pdf = distribution * bsdf_visibility_one(terms) * 4.0 * cosine_o * jacobian;
}

// Returns value and density towards i. o and i are unit vectors that point away from the surface. Delta lobes
// are left out.
BsdfValue bsdf_towards(BsdfTerms terms, Surface s, vec3 i) {
    BsdfValue result = BsdfValue(vec3(0.0), 0.0);
    vec3 local = i * terms.frame;
    if (terms.o.z <= 0.0) return result;
    float family, through;
    bsdf_cosine_probability(terms, family, through);
    float base = dot(terms.base, local);
    int side = bsdf_side(s, i, base);
    if (side != 0) {
        result.value = bsdf_cosine_family(terms, abs(base), side) * abs(base);
        result.pdf = family * (side > 0 ? 1.0 - through : through) * abs(base) / MICROFACET_PI;
    }
    if (!SHADING_FACETS) return result;
    side = bsdf_side(s, i, local.z);
    if (side == 0 || terms.mirror) return result;
    float cosine, facets, pdf;
    bsdf_facets(terms, local, side, cosine, facets, pdf);
    float reflect_share = bsdf_reflect_probability(terms, cosine);
    facets *= abs(local.z);
    result.value += facets * (side > 0 ? bsdf_reflected(terms, cosine) : bsdf_transmitted(terms, cosine));
    result.pdf += (1.0 - family) * pdf * (side > 0 ? reflect_share : 1.0 - reflect_share);
    return result;
}

// Returns the value, 1/sr, without the cosine at the shading normal.
vec3 bsdf_evaluate(Surface s, vec3 o, vec3 i) {
    float cosine = abs(dot(s.normal, i));
    return cosine > 0.0 ? bsdf_towards(bsdf_terms(s, o), s, i).value / cosine : vec3(0.0);
}

// Returns the density, 1/sr, with which bsdf_sample chooses i.
float bsdf_pdf(Surface s, vec3 o, vec3 i) { return bsdf_towards(bsdf_terms(s, o), s, i).pdf; }

// Refracts o at a facet into i, or lets it go straight on through a thin wall. Returns false beyond the
// critical angle.
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

// Chooses a direction by one of the lobes. Unless the direction is a delta, its weight and pdf are still to
// be found by bsdf_chosen. The random numbers are for the lobe, for the side, and two for the direction. If
// flags is 0, the light is absorbed. `terms` are those of the surface seen from the path's previous vertex; a
// caller that uses them several times makes them once.
BsdfSample bsdf_choose(BsdfTerms terms, Surface s, vec4 random) {
    BsdfSample chosen = BsdfSample(vec3(0.0, 0.0, 1.0), 0.0, vec3(0.0), 0u);
    if (terms.o.z <= 0.0) return chosen;
    float family, through;
    bsdf_cosine_probability(terms, family, through);
    vec3 local;
    uint flags = SAMPLE_VALID;
    int expected = 1;
    if (random.x < family) {
        local = basis_around(terms.base) * cosine_hemisphere(random.zw);
        if (random.y < through) {
            local -= 2.0 * dot(local, terms.base) * terms.base;
            flags |= SAMPLE_TRANSMITTED;
            expected = -1;
        }
    } else {
        if (!SHADING_FACETS) return chosen;
        vec3 h = vec3(0.0, 0.0, 1.0);
        if (!terms.mirror) {
            h = terms.ward ? ward_half(terms.alphas, random.zw) : ggx_visible_normal(terms.o, terms.alphas, random.zw);
        }
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
            float probability = (1.0 - family) * (reflects ? reflect_share : 1.0 - reflect_share);
            vec3 share = reflects ? bsdf_reflected(terms, cosine) : bsdf_transmitted(terms, cosine);
            vec3 world = normalize(terms.frame * local);
            if (bsdf_side(s, world, local.z) != expected || !(probability > 0.0)) return chosen;
            return BsdfSample(world, probability, share / probability, flags | SAMPLE_DELTA);
        }
    }
    vec3 world = normalize(terms.frame * local);
    // A facet can send light to the wrong side of the surface, where it is lost. The cosine family makes up
    // for this loss.
    float cosine = random.x < family ? dot(local, terms.base) : local.z;
    if (bsdf_side(s, world, cosine) != expected) return chosen;
    return BsdfSample(world, 0.0, vec3(0.0), flags);
}

// True if a direction was chosen whose weight and pdf bsdf_chosen still has to find.
bool bsdf_is_open(BsdfSample chosen) { return chosen.flags != 0u && (chosen.flags & SAMPLE_DELTA) == 0u; }

// Returns the sample of a chosen direction, from the sum `towards` of all lobes in that direction.
BsdfSample bsdf_chosen(BsdfSample chosen, BsdfValue towards) {
    BsdfSample absorbed = BsdfSample(vec3(0.0, 0.0, 1.0), 0.0, vec3(0.0), 0u);
    if (!(towards.pdf > 0.0) || towards.pdf > 1.0e30) return absorbed;
    vec3 weight = towards.value / towards.pdf;
    if (!(largest_component(weight) > 0.0)) return absorbed;
    return BsdfSample(chosen.direction, towards.pdf, weight, chosen.flags);
}

// Chooses a direction, and returns its complete sample.
BsdfSample bsdf_sample(BsdfTerms terms, Surface s, vec4 random) {
    BsdfSample chosen = bsdf_choose(terms, s, random);
    if (!bsdf_is_open(chosen)) return chosen;
    return bsdf_chosen(chosen, bsdf_towards(terms, s, chosen.direction));
}

#endif
