//! Whitted's ray tracing, as `docs/whitted.md` defines it.

use glam::Vec3;
use rasray_options::{OptionValues, Value};

use super::{Image, NaiveIntegrator, Tracer, cube_map::CubeMap, path::LAYER_LIMIT};
use crate::shading::{
    BsdfSample, PosedScene, Ray, ReferenceError, Surface, View,
    bsdf::SMOOTH_ROUGHNESS,
    bsdf_sample, bsdf_straight, bsdf_times_cosine,
    random::{Numbers, RANDOM_LIGHT_KIND, random_dimension},
    spawn_ray,
};

pub(super) const ROW: NaiveIntegrator = NaiveIntegrator {
    name: "whitted",
    render: |posed, view, values| posed.render_whitted(view, Rules::of(values)),
};

/// Rules that choose the rays to follow.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Rules {
    pub ray_depth: u32,
    /// Weight above which a ray is followed. Rays without weight do not change pictures, so none is followed
    /// here.
    pub threshold: f32,
    /// True if surfaces that the camera sees send no ray on unless they mirror.
    pub from_reflective: bool,
    /// True if surfaces that neither mirror nor refract are lit without shadow rays.
    pub specular_shadows: bool,
    /// Largest number of reflections and refractions at which surfaces are in shadow.
    pub shadow_depth: Option<u32>,
    pub mirror_roughness: f32,
    /// Map that answers mirrored and refracted rays in place of their trees.
    pub map: Option<CubeMap>,
    /// True if rays go on behind smooth surfaces that they hit from behind.
    pub passes_backs: bool,
}

impl Rules {
    /// Reads the rules from options; absent options have no effect.
    pub fn of(values: &OptionValues) -> Self {
        let is = |option, word: &str| values.get(option).and_then(Value::word) == Some(word);
        let number = |option| values.get(option).and_then(Value::number).unwrap_or_default();
        let ray_depth = values.get("ray-depth").and_then(Value::whole).unwrap_or_default();
        Self {
            ray_depth,
            threshold: if is("select", "expected") { number("threshold") } else { 0.0 },
            from_reflective: is("select", "reflective"),
            specular_shadows: is("select", "specular"),
            shadow_depth: match values.get("shadows").and_then(Value::word) {
                Some("none") => None,
                Some("first") => Some(0),
                _ => Some(ray_depth),
            },
            mirror_roughness: number("mirror-roughness"),
            map: None,
            passes_backs: false,
        }
    }

    /// True if a surface of this roughness counts as perfectly smooth.
    pub fn are_smooth(&self, roughness: f32) -> bool {
        roughness < self.mirror_roughness.max(SMOOTH_ROUGHNESS)
    }
}

/// State of a ray in the tree of a sample.
#[derive(Clone, Copy)]
pub(super) struct Node {
    throughput: Vec3,
    /// Index of the material whose inside the ray is in.
    medium: Option<usize>,
    /// Number of reflections and refractions so far.
    depth: u32,
    /// Number of the branch, from the refractions and passed surfaces on the way.
    branch: u32,
}

impl Node {
    /// Returns the first node of a tree.
    pub fn root(branch: u32) -> Self {
        Self { throughput: Vec3::ONE, medium: None, depth: 0, branch }
    }

    fn branched(self, is_refracted: bool) -> u32 {
        let event = 2 * self.depth + u32::from(is_refracted);
        self.branch.wrapping_mul(747_796_405).wrapping_add(2_891_336_453).wrapping_add(event)
    }
}

impl Tracer<'_> {
    /// Returns the light that a ray of a tree finds, W/(sr m^2), as far as the camera sees it.
    pub(super) fn tree(&self, rules: &Rules, random: Numbers, mut ray: Ray, mut node: Node) -> Vec3 {
        let mut radiance = Vec3::ZERO;
        for _ in 0..=LAYER_LIMIT {
            let Some(surface) = self.closest(&ray) else {
                return radiance + node.throughput * self.posed.environment_radiance(ray.direction);
            };
            if let Some(medium) = node.medium {
                node.throughput *= self.posed.transmittance(medium, surface.t);
            }
            if !(rules.passes_backs && !surface.front && rules.are_smooth(surface.roughness)) {
                radiance += self.surface(rules, random, &ray, node, &surface);
                let (share, _) = bsdf_straight(&surface, -ray.direction);
                node.throughput *= surface.opacity * share + (1.0 - surface.opacity);
            }
            if !(node.throughput.max_element() > rules.threshold) {
                break;
            }
            node.branch = node.branched(false);
            // The ray keeps its kind: a camera ray passes the backs that camera rays pass.
            let culls_back_faces = ray.culls_back_faces;
            let through = left(&ray, &surface, ray.direction);
            ray = Ray { culls_back_faces, ..through };
        }
        radiance
    }

    /// Returns the light that a surface sends along a ray, without the light that goes straight through it.
    fn surface(&self, rules: &Rules, random: Numbers, ray: &Ray, node: Node, surface: &Surface) -> Vec3 {
        let throughput = node.throughput * surface.opacity;
        let mut radiance = throughput * surface.emission;
        let [mirrored, refracted] = perfect_lobes(surface, -ray.direction);
        let in_shadow = rules.shadow_depth.is_some_and(|depth| node.depth <= depth)
            && !(rules.specular_shadows && mirrored.is_none() && refracted.is_none());
        radiance += throughput * self.light(surface, -ray.direction, random, node, in_shadow);
        if let Some(map) = &rules.map {
            for lobe in [mirrored, refracted].into_iter().flatten() {
                let looked_up = self.looked_up(rules, map, random, lobe.direction);
                radiance += throughput * (lobe.weight * lobe.pdf) * looked_up;
            }
            return radiance;
        }
        if node.depth >= rules.ray_depth || (rules.from_reflective && node.depth == 0 && mirrored.is_none()) {
            return radiance;
        }
        for lobe in [mirrored, refracted].into_iter().flatten() {
            let throughput = throughput * (lobe.weight * lobe.pdf);
            if !(throughput.max_element() > rules.threshold) {
                continue;
            }
            let mut next = Node { throughput, depth: node.depth + 1, ..node };
            if lobe.transmitted {
                next.branch = node.branched(true);
                if surface.thickness > 0.0 {
                    next.medium = surface.material.filter(|_| surface.front);
                }
            }
            let ray = self.spawned(left(ray, surface, lobe.direction));
            radiance += self.tree(rules, random, ray, next);
        }
        radiance
    }

    /// Returns one light sample for all lobes but the perfect ones.
    fn light(&self, surface: &Surface, o: Vec3, random: Numbers, node: Node, in_shadow: bool) -> Vec3 {
        let dimension =
            random_dimension(node.depth, RANDOM_LIGHT_KIND).wrapping_add(node.branch.wrapping_mul(256));
        let Some(light) = self.posed.light_sample(surface, random.four(dimension)) else { return Vec3::ZERO };
        let sent = bsdf_times_cosine(surface, o, light.direction) * light.radiance / light.pdf;
        if !in_shadow || !(sent.max_element() > 0.0) {
            return sent;
        }
        light.shadow_ray(surface).map_or(Vec3::ZERO, |ray| sent * self.arriving(ray, light.target))
    }
}

/// Returns the mirrored and the refracted lobe of a perfectly smooth surface, if it has them: the random
/// numbers that choose a lobe are set to the ends of their ranges.
fn perfect_lobes(surface: &Surface, o: Vec3) -> [Option<BsdfSample>; 2] {
    let last = 1.0_f32.next_down();
    let lobe = |side| bsdf_sample(surface, o, [last, side, 0.5, 0.5]).filter(|lobe| lobe.delta);
    let carries = |lobe: &BsdfSample| lobe.weight.max_element() > 0.0;
    [
        lobe(0.0).filter(|lobe| !lobe.transmitted && carries(lobe)),
        lobe(last).filter(|lobe| lobe.transmitted && carries(lobe)),
    ]
}

/// Makes a ray that leaves a surface with the cone of the ray that reached it.
fn left(ray: &Ray, surface: &Surface, direction: Vec3) -> Ray {
    let cone_width = ray.cone_width + ray.cone_spread * surface.t;
    Ray { cone_width, cone_spread: ray.cone_spread, ..spawn_ray(surface, direction, f32::INFINITY) }
}

impl PosedScene<'_> {
    /// Renders by Whitted's ray tracing; W/(sr m^2).
    pub(super) fn render_whitted(&self, view: &View, rules: Rules) -> Result<Image, ReferenceError> {
        self.render_smoothed(view, (true, rules.mirror_roughness), |tracer, random| {
            tracer.tree(&rules, random, tracer.camera_ray(view, random), Node::root(0))
        })
    }
}
