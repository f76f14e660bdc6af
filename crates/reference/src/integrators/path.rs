//! Path tracing with light sampling, in the order of `docs/shading.md`, "Paths".

use glam::Vec3;
use rasray_options::{OptionValues, Value};
use rasray_scene::{Camera, Sampler, Scene, ShadowTerminator};

use super::{Image, NaiveIntegrator, Tracer, eye, photons::Map};
use crate::shading::{
    BsdfSample, LightSample, PosedScene, Ray, ReferenceError, Surface, View, bsdf_pdf, bsdf_sample,
    bsdf_straight, bsdf_times_cosine,
    random::{
        Numbers, RANDOM_BSDF_LOBE, RANDOM_LIGHT_KIND, RANDOM_OPACITY_FIRST, RANDOM_ROULETTE, random_dimension,
    },
    spawn_ray, spawn_segment,
};

pub(super) const ROW: NaiveIntegrator = NaiveIntegrator {
    name: "path",
    render: |posed, view, values| posed.render_path(view, path_options(values)),
};

/// Options of paths.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct PathOptions {
    /// Largest number of scatterings.
    pub bounces: u32,
    /// True if light goes straight through smooth thin panes and takes their tint, unless there are no
    /// bounces. Otherwise panes stop shadow rays, and the passage is a scattering.
    pub passes_panes: bool,
    /// Origin of shadow rays on smooth surfaces.
    pub shadow_terminator: ShadowTerminator,
    /// True if surfaces reflect by Ward's lobe ([`Surface::is_ward`]).
    pub is_ward: bool,
}

impl From<u32> for PathOptions {
    /// Makes options with this many bounces, and all other defaults.
    fn from(bounces: u32) -> Self {
        Self { bounces, passes_panes: true, shadow_terminator: ShadowTerminator::None, is_ward: false }
    }
}

pub(super) fn path_options(values: &OptionValues) -> PathOptions {
    let is = |option, word: &str| values.get(option).and_then(Value::word) == Some(word);
    let offset = ShadowTerminator::Offset;
    PathOptions {
        passes_panes: !is("glass-shadows", "opaque"),
        shadow_terminator: if is("shadow-terminator", offset.name()) {
            offset
        } else {
            ShadowTerminator::None
        },
        is_ward: is("specular", "ward"),
        ..PathOptions::from(values.get("bounces").and_then(Value::whole).unwrap_or_default())
    }
}

/// Number of the scattering from which on a path may be ended at random.
const ROULETTE_BOUNCE: u32 = 3;
/// Largest number of surfaces that one ray passes in a straight line.
pub(super) const LAYER_LIMIT: u32 = 4096;

pub(super) struct PathState {
    pub random: Numbers,
    pub throughput: Vec3,
    radiance: Vec3,
    /// Density of the last scattering, 1/sr; with `None` the emission at the next hit counts fully.
    bsdf_pdf: Option<f32>,
    /// True if photons carry the light that light samples find: the last scatterings were perfectly smooth
    /// and an earlier one was not.
    is_of_photons: bool,
    /// Index of the material whose inside the path is in.
    pub medium: Option<usize>,
    /// Number of scatterings so far.
    pub bounce: u32,
    /// Number of random choices so far whether to go straight through a surface.
    choices: u32,
    /// Number of surfaces that the ray has passed in a straight line.
    passed: u32,
    /// Point of the last scattering.
    pub origin: Vec3,
    shadow_terminator: ShadowTerminator,
}

/// Returns the weight of the technique with density `used` against the one with density `other`.
fn power_heuristic(used: f32, other: f32) -> f32 {
    if !(other > 0.0) {
        return 1.0;
    }
    let ratio = other / used;
    1.0 / (1.0 + ratio * ratio)
}

impl PathState {
    /// Makes a path before its first ray.
    pub fn new(random: Numbers, shadow_terminator: ShadowTerminator) -> Self {
        Self {
            random,
            throughput: Vec3::ONE,
            radiance: Vec3::ZERO,
            bsdf_pdf: None,
            is_of_photons: false,
            medium: None,
            bounce: 0,
            choices: 0,
            passed: 0,
            origin: Vec3::ZERO,
            shadow_terminator,
        }
    }

    /// True if the path goes straight through a surface, with this probability.
    pub fn chooses(&mut self, probability: f32) -> bool {
        let dimension = RANDOM_OPACITY_FIRST + self.choices;
        self.choices += 1;
        self.random.float(dimension) < probability
    }

    /// Continues straight behind the surface: no scattering, since shadow rays go through as well.
    pub fn pass(&mut self, ray: &Ray, surface: &Surface, footprint: f32) -> Option<Ray> {
        if self.passed >= LAYER_LIMIT {
            return None;
        }
        self.passed += 1;
        let ahead = spawn_ray(surface, ray.direction, f32::INFINITY);
        // The ray keeps its kind: a camera ray passes the backs that camera rays pass.
        let culls_back_faces = ray.culls_back_faces;
        Some(Ray { culls_back_faces, cone_width: footprint, cone_spread: ray.cone_spread, ..ahead })
    }

    fn emission_weight(&self, light_pdf: impl FnOnce() -> f32) -> f32 {
        if self.is_of_photons {
            return if light_pdf() > 0.0 { 0.0 } else { 1.0 };
        }
        self.bsdf_pdf.map_or(1.0, |used| power_heuristic(used, light_pdf()))
    }
}

impl Tracer<'_> {
    /// Returns one sample, W/(sr m^2); with a map, its photons carry part of the light.
    pub(super) fn path(&self, view: &View, options: PathOptions, map: Option<&Map>, random: Numbers) -> Vec3 {
        let PathOptions { shadow_terminator, is_ward, .. } = options;
        let mut state = PathState::new(random, shadow_terminator);
        let mut next = Some(self.camera_ray(view, random));
        while let Some(ray) = next {
            next = match self.closest(&ray) {
                Some(surface) => self.step(&mut state, &ray, &Surface { is_ward, ..surface }, (options, map)),
                None => {
                    let weight = state.emission_weight(|| self.posed.environment_pdf(ray.direction));
                    state.radiance +=
                        state.throughput * self.posed.environment_radiance(ray.direction) * weight;
                    None
                }
            };
        }
        state.radiance
    }

    fn step(
        &self,
        state: &mut PathState,
        ray: &Ray,
        surface: &Surface,
        (options, map): (PathOptions, Option<&Map>),
    ) -> Option<Ray> {
        let footprint = ray.cone_width + ray.cone_spread * surface.t;
        if let Some(medium) = state.medium {
            state.throughput *= self.posed.transmittance(medium, surface.t);
        }
        if surface.opacity < 1.0 && state.chooses(1.0 - surface.opacity) {
            return state.pass(ray, surface, footprint);
        }
        if surface.emission.max_element() > 0.0 {
            let pdf = || match surface.primitive {
                Some(primitive) => self.posed.light_pdf_emitter(primitive, state.origin, surface.position),
                None => 0.0,
            };
            state.radiance += state.throughput * surface.emission * state.emission_weight(pdf);
        }
        if map.is_some_and(|map| map.has_all) && state.bsdf_pdf.is_some() {
            return None;
        }
        let (straight, probability) = bsdf_straight(surface, -ray.direction);
        if probability > 0.0 {
            if state.chooses(probability) {
                state.throughput *= straight / probability;
                return state.pass(ray, surface, footprint);
            }
            state.throughput /= 1.0 - probability;
        }
        if state.bounce >= options.bounces {
            return None;
        }
        state.radiance += self.direct_light(state, surface, -ray.direction);
        if let Some(map) = map {
            let scatterings = options.bounces - state.bounce - 1;
            state.radiance += state.throughput * map.gathered(surface, -ray.direction, scatterings);
        }
        let is_rough = state.bsdf_pdf.is_some() || state.is_of_photons;
        let random = state.random.four(random_dimension(state.bounce, RANDOM_BSDF_LOBE));
        let chosen = bsdf_sample(surface, -ray.direction, random)?;
        let next = scatter(state, ray, surface, footprint, &chosen);
        state.is_of_photons = map.is_some() && chosen.delta && is_rough;
        next.map(|ray| self.spawned(ray))
    }

    /// Returns one light sample, seen from the surface.
    fn direct_light(&self, state: &PathState, surface: &Surface, o: Vec3) -> Vec3 {
        let random = state.random.four(random_dimension(state.bounce, RANDOM_LIGHT_KIND));
        let smooth = match state.shadow_terminator {
            ShadowTerminator::None => *surface,
            ShadowTerminator::Offset => self.posed.terminator_surface(surface, o),
        };
        let Some(light) = self.posed.light_sample(&smooth, random) else { return Vec3::ZERO };
        // Scattered rays do not leave below the triangle, so no other technique finds the light there.
        let above = |normal: Vec3| light.direction.dot(normal) > 0.0;
        let is_found = above(surface.geometric_normal) == above(smooth.geometric_normal);
        let pending = state.throughput * reflected(&smooth, o, &light, is_found);
        if !(pending.max_element() > 0.0) {
            return Vec3::ZERO;
        }
        light.shadow_ray(&smooth).map_or(Vec3::ZERO, |ray| pending * self.arriving(ray, light.target))
    }

    /// Returns the share of the light that arrives along a shadow ray, which ends at `target` if there is
    /// one.
    pub(super) fn arriving(&self, mut ray: Ray, target: Option<Vec3>) -> Vec3 {
        let mut share = Vec3::ONE;
        for _ in 0..=LAYER_LIMIT {
            let Some(surface) = self.closest(&self.spawned(ray)) else { return share };
            let (straight, _) = bsdf_straight(&surface, -ray.direction);
            share *= surface.opacity * straight + (1.0 - surface.opacity);
            if !(share.max_element() > 0.0) {
                break;
            }
            let ahead = match target {
                Some(target) => spawn_segment(&surface, target),
                None => Some(spawn_ray(&surface, ray.direction, f32::INFINITY)),
            };
            // A light that touches the surface has nothing before it.
            let Some(ahead) = ahead else { return share };
            ray = ahead;
        }
        Vec3::ZERO
    }
}

/// Returns the light of an unoccluded light sample that the surface sends along `o`, weighted; `is_found` is
/// true if scattered rays find the light, too.
fn reflected(surface: &Surface, o: Vec3, light: &LightSample, is_found: bool) -> Vec3 {
    let value = bsdf_times_cosine(surface, o, light.direction);
    let weight = if light.delta || !is_found {
        1.0
    } else {
        power_heuristic(light.pdf, bsdf_pdf(surface, o, light.direction))
    };
    value * light.radiance * (weight / light.pdf)
}

/// Continues in the chosen direction, unless the path ends.
pub(super) fn scatter(
    state: &mut PathState,
    ray: &Ray,
    surface: &Surface,
    footprint: f32,
    chosen: &BsdfSample,
) -> Option<Ray> {
    state.throughput *= chosen.weight;
    state.bsdf_pdf = (!chosen.delta).then_some(chosen.pdf);
    if chosen.transmitted && surface.thickness > 0.0 {
        state.medium = surface.material.filter(|_| surface.front);
    }
    if state.bounce >= ROULETTE_BOUNCE {
        let survival = state.throughput.max_element().min(0.95);
        if state.random.float(random_dimension(state.bounce, RANDOM_ROULETTE)) >= survival {
            return None;
        }
        state.throughput /= survival;
    }
    state.bounce += 1;
    state.passed = 0;
    let rough = 0.5 * surface.roughness * surface.roughness;
    let cone_spread = if chosen.delta { ray.cone_spread } else { ray.cone_spread.max(rough) };
    let ahead = spawn_ray(surface, chosen.direction, f32::INFINITY);
    state.origin = ahead.origin;
    Some(Ray { cone_width: footprint, cone_spread, ..ahead })
}

impl PosedScene<'_> {
    /// Renders by path tracing; W/(sr m^2). A number of bounces converts into options.
    ///
    /// # Errors
    /// An error if the image is empty or the scene has more triangles than ids.
    pub fn render_path(&self, view: &View, options: impl Into<PathOptions>) -> Result<Image, ReferenceError> {
        let options = options.into();
        let passes_panes = options.passes_panes && options.bounces > 0;
        self.render(view, passes_panes, |tracer, random| tracer.path(view, options, None, random))
    }
}

/// Renders like [`PosedScene::render_path`], with the frame origin at the eye.
///
/// # Errors
/// An error if the scene refers to an element that it does not have, or the image is empty.
pub fn render_path(
    scene: &Scene,
    camera: &Camera,
    width: u32,
    height: u32,
    samples: u32,
    seed: u32,
    options: impl Into<PathOptions>,
) -> Result<Image, ReferenceError> {
    let view = View { camera: camera.clone(), width, height, samples, seed, sampler: Sampler::default() };
    PosedScene::new(scene, eye(camera))?.render_path(&view, options)
}
