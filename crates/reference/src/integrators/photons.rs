//! Photon maps, as `docs/photons.md` defines them. A surface gathers from every photon of the map, without a
//! search structure.

use glam::{DVec3, Vec3};
use rasray_options::{OptionValues, Value};
use rasray_scene::ShadowTerminator;
use rayon::prelude::*;

use super::{
    Image, NaiveIntegrator, Tracer,
    path::{PathOptions, PathState, path_options, scatter},
};
use crate::shading::{
    PosedScene, ReferenceError, Surface, View, bsdf_is_rough, bsdf_sample, bsdf_times_cosine,
    random::{Numbers, RANDOM_BSDF_LOBE, RANDOM_LENS_U, RANDOM_LIGHT_KIND, RandomStream, random_dimension},
    window,
};

pub(super) const ROW: NaiveIntegrator = NaiveIntegrator {
    name: "photons",
    render: |posed, view, values| posed.render_photons(view, &rules(values)),
};

/// Bit that, together with the number of the sample, stands for the pixel in the random numbers of photons.
const PHOTON_PIXEL: u32 = 0x8000_0000;
/// Default radius of the first sample, as a share of the diagonal of the box of all triangles.
const RADIUS_SHARE: f64 = 0.01;
/// Share of the photons of a sample that the radius of the next one keeps.
const KEPT_SHARE: f64 = 2.0 / 3.0;

struct Rules {
    paths: PathOptions,
    has_all: bool,
    photon_paths: u32,
    radius: Option<f32>,
}

fn rules(values: &OptionValues) -> Rules {
    Rules {
        paths: PathOptions { passes_panes: false, ..path_options(values) },
        has_all: values.get("photons").and_then(Value::word) == Some("all"),
        photon_paths: values.get("photon-paths").and_then(Value::whole).unwrap_or_default(),
        radius: values.get("radius").and_then(Value::number),
    }
}

/// Photon: light that arrived at a surface after at least one scattering.
#[derive(Clone, Copy, Debug)]
struct Photon {
    position: Vec3,
    /// Unit direction towards the photon's origin.
    direction: Vec3,
    /// Number of scatterings so far.
    bounce: u32,
    /// Flux, W.
    flux: Vec3,
}

/// Photons of a sample.
pub(super) struct Map {
    /// True if photons carry all indirect light, and not caustics alone.
    pub has_all: bool,
    /// Distance within which photons count, metres.
    radius: f32,
    photons: Vec<Photon>,
}

impl Map {
    /// Returns the radiance along `o`, W/(sr m^2), from the photons around a surface that were scattered at
    /// most `scatterings` times.
    pub fn gathered(&self, surface: &Surface, o: Vec3, scatterings: u32) -> Vec3 {
        let mut sum = DVec3::ZERO;
        let radius = f64::from(self.radius);
        for photon in self.photons.iter().filter(|photon| photon.bounce <= scatterings) {
            let squared = (photon.position - surface.position).as_dvec3().length_squared();
            let share = 1.0 - squared / (radius * radius);
            let cosine = f64::from(surface.geometric_normal.dot(photon.direction).abs());
            if !(share > 0.0) || !(cosine > 0.0) {
                continue;
            }
            let value = bsdf_times_cosine(surface, o, photon.direction) * photon.flux;
            sum += value.as_dvec3() * (2.0 * share / (std::f64::consts::PI * radius * radius * cosine));
        }
        sum.as_vec3()
    }
}

/// Returns the ratio of the radiance that photons carry along `i` to the radiance that paths see along it, at
/// a shading normal.
fn shading_normal_share(surface: &Surface, o: Vec3, i: Vec3) -> f32 {
    let (shading, geometric) = (surface.normal, surface.geometric_normal);
    let leaving = shading.dot(i).abs() * geometric.dot(o);
    if !(shading.dot(o) > 0.0) || !(leaving > 0.0) {
        return 0.0;
    }
    shading.dot(o) * geometric.dot(i).abs() / leaving
}

impl Tracer<'_> {
    /// Returns the photons that one path stores.
    fn photons(&self, rules: &Rules, random: Numbers) -> Vec<Photon> {
        let mut stored = Vec::new();
        let towards = random.four(random_dimension(0, RANDOM_LIGHT_KIND));
        let Some(emission) = self.posed.emit_photon(random.four(RANDOM_LENS_U), towards) else {
            return stored;
        };
        let flux = emission.flux / rules.photon_paths as f32;
        let most = flux.max_element();
        if !(most > 0.0) {
            return stored;
        }
        let mut state = PathState::new(random, ShadowTerminator::None);
        (state.throughput, state.origin) = (flux / most, emission.ray.origin);
        let mut next = Some(self.spawned(emission.ray));
        while let Some(ray) = next.take() {
            let Some(surface) = self.closest(&ray) else { break };
            let surface = Surface { is_ward: rules.paths.is_ward, ..surface };
            let o = -ray.direction;
            if let Some(medium) = state.medium {
                state.throughput *= self.posed.transmittance(medium, surface.t);
            }
            if surface.opacity < 1.0 && state.chooses(1.0 - surface.opacity) {
                next = state.pass(&ray, &surface, 0.0);
                continue;
            }
            if state.bounce == 0 {
                state.throughput *= window(surface.position.distance(state.origin), emission.range);
            }
            if state.bounce > 0 && bsdf_is_rough(&surface, o) {
                let (position, bounce, flux) = (surface.position, state.bounce, state.throughput * most);
                stored.push(Photon { position, direction: o, bounce, flux });
            }
            if state.bounce + 2 > rules.paths.bounces {
                break;
            }
            let random = state.random.four(random_dimension(state.bounce, RANDOM_BSDF_LOBE));
            let Some(mut chosen) = bsdf_sample(&surface, o, random) else { break };
            if !rules.has_all && !chosen.delta {
                break;
            }
            chosen.weight *= shading_normal_share(&surface, o, chosen.direction);
            if !(chosen.weight.max_element() > 0.0) {
                break;
            }
            next = scatter(&mut state, &ray, &surface, 0.0, &chosen);
            next = next
                .map(|ray| self.spawned(crate::shading::Ray { cone_width: 0.0, cone_spread: 0.0, ..ray }));
        }
        stored
    }

    fn map(&self, view: &View, rules: &Rules, sample: u32) -> Map {
        let of_path = |path: u32| {
            let stream = RandomStream { seed: view.seed, pixel: PHOTON_PIXEL | sample, sample: path };
            self.photons(rules, Numbers { sampler: view.sampler, stream })
        };
        let shares = (1..=sample).map(|k| (f64::from(k) + KEPT_SHARE) / (f64::from(k) + 1.0));
        let shrunk = shares.product::<f64>().sqrt();
        let radius = match rules.radius {
            Some(radius) => (f64::from(radius) * shrunk) as f32,
            None => (RADIUS_SHARE * shrunk) as f32 * self.posed.diagonal(),
        };
        let photons = (0..rules.photon_paths).into_par_iter().flat_map_iter(of_path).collect();
        Map { has_all: rules.has_all, radius, photons }
    }
}

impl PosedScene<'_> {
    fn render_photons(&self, view: &View, rules: &Rules) -> Result<Image, ReferenceError> {
        let maps = |tracer: &Tracer<'_>| {
            (0..view.samples).map(|sample| tracer.map(view, rules, sample)).collect::<Vec<_>>()
        };
        self.render_prepared(view, (false, 0.0), maps, |tracer, maps, random| {
            let map = maps.get(random.stream.sample as usize);
            tracer.path(view, rules.paths, map, random)
        })
    }
}
