//! Published payloads: surfaces come from what fragments store, hits stay where they are, and secondary rays
//! hit fragments that do not say which triangle they are of.

use rasray_ads::{Hit, PRIMITIVE_UNKNOWN, Structure, Surface};
use rasray_gpu::Timing;
use rasray_gpu_scene::GpuScene;
use rasray_integrators::{AmbientOcclusion, Film, IntegratorDesc};
use rasray_systems::{self as registry, Spec, System};
use rasray_tests::harness::Bench;
use rasray_tests::pictures::{rays_inside, rendered, stage};
use rasray_tests::tier::{first, is_full};
use rasray_tracer::build_until_complete;

pub(crate) const SIZE: u32 = 32;

/// Systems whose published fragments carry attributes.
const SYSTEMS: [&str; 4] = ["mmrt", "hu", "selective", "ldc"];

#[test]
fn every_system_of_fragments_is_tried() {
    let has_payload = |system: &&System| system.has("payload");
    let names: Vec<_> = registry::SYSTEMS.iter().filter(has_payload).map(|system| system.name).collect();
    assert!(names.iter().all(|name| SYSTEMS.contains(name)), "{names:?}");
}

/// A published structure with a payload, built around the scene.
pub(crate) fn made(
    bench: &Bench,
    scene: &GpuScene,
    system: &str,
    options: &[(&str, &str)],
) -> Box<dyn Structure> {
    let options = options.iter().map(|(name, value)| ((*name).to_owned(), (*value).to_owned()));
    let spec = Spec::new(system, "published", options).expect("the options are valid");
    let mut structure =
        spec.create(bench.device(), scene.geometry(), Some(scene.binding())).expect("pipelines are made");
    build_until_complete(bench.device(), structure.as_mut(), scene.eye(), Timing::None)
        .expect("the build completes");
    let report = structure.report().expect("the header is readable");
    assert_eq!(
        report.formula_bytes,
        report.bytes() - report.slack(),
        "{system}: what is stored is what the formula says"
    );
    structure
}

/// Mean ambient occlusion of an image.
fn mean(bench: &Bench, scene: &GpuScene, structure: &mut dyn Structure) -> f32 {
    let device = bench.device();
    let film = Film::new(device, SIZE, SIZE).expect("a small film fits");
    let desc = IntegratorDesc::new(device, scene, &film);
    let integrator = AmbientOcclusion::new(&desc, f32::INFINITY).expect("the range is valid");
    let pixels = rendered(bench, &integrator, &film, 4, structure);
    pixels.iter().map(|pixel| pixel[0]).sum::<f32>() / pixels.len() as f32
}

#[test]
fn secondary_rays_hit_fragments_without_ids() {
    let bench = Bench::new();
    let scene = stage(&bench, "cornell", SIZE);
    // `hu` hits more of the triangle that a ray leaves where it cannot exclude it, and has a test of its own.
    for system in ["mmrt", "selective", "ldc"] {
        let mean_of = |payload| {
            let options = [("resolution", "256"), ("payload", payload)];
            mean(&bench, &scene, made(&bench, &scene, system, &options).as_mut())
        };
        // Equal rules with and without ids: rays start a little apart, so a few hit something else.
        let (with_ids, without_ids) = (mean_of("index"), mean_of("attributes"));
        println!("{system}: {with_ids} with ids, {without_ids} without");
        assert!(with_ids < 0.9, "{system}: walls occlude: {with_ids}");
        assert!(
            (with_ids - without_ids).abs() < 0.02,
            "{system}: {with_ids} with ids, {without_ids} without"
        );
    }
}

/// Parities lose little of a room, so that occlusion is near the truth with ids and without. All rays start a
/// cell off a surface; only those that know its triangle exclude it, and the others may hit it again.
/// A-buffers by their paper's rules are as near; where fragments have no thickness they lose most of the
/// walls, which shows that the comparison would notice.
#[test]
fn secondary_rays_of_parities_come_near_the_truth() {
    let bench = Bench::new();
    let scene = stage(&bench, "cornell", SIZE);
    let spec = Spec::new("brute-force", "robust", []).expect("it has no options");
    let mut every_triangle =
        spec.create(bench.device(), scene.geometry(), Some(scene.binding())).expect("pipelines are made");
    build_until_complete(bench.device(), every_triangle.as_mut(), scene.eye(), Timing::None)
        .expect("the build completes");
    let truth = mean(&bench, &scene, every_triangle.as_mut());
    assert!(truth > 0.2 && truth < 0.5, "a room with an open side: {truth}");
    let error_of = |system, options: &[(&str, &str)]| {
        let options: Vec<_> = [("resolution", "512")].into_iter().chain(options.iter().copied()).collect();
        let found = mean(&bench, &scene, made(&bench, &scene, system, &options).as_mut());
        println!("{system}, {options:?}: {found} of {truth}");
        (found - truth).abs()
    };
    // The renders draw the same random numbers; even if they did not, this is four standard deviations of
    // such a mean.
    for payload in ["index", "attributes"] {
        assert!(error_of("hu", &[("payload", payload)]) < 0.03, "{payload}");
    }
    assert!(error_of("mmrt", &[("view-switching", "exact")]) < 0.05);
    // Rays that are snapped from view to view lose a little more: 0.064.
    assert!(error_of("mmrt", &[]) < 0.08);
    assert!(error_of("mmrt", &[("accept", "interval")]) > 0.2);
}

/// The largest share of a colour.
fn largest(color: [f32; 3]) -> f32 {
    color.into_iter().fold(0.0, f32::max)
}

/// True if a hit is a fragment's, not that of a triangle close to the eye, of which the A-buffer alone has a
/// list.
fn is_fragment(system: &str, hit: &Hit) -> bool {
    system != "mmrt" || hit.primitive == PRIMITIVE_UNKNOWN
}

fn dot(a: [f32; 3], b: [f32; 3]) -> f32 {
    (0..3).map(|axis| a[axis] * b[axis]).sum()
}

/// Metallic, roughness and specular that fragments of a system keep of a triangle's, or the defaults of those
/// they do not.
fn terms(system: &str, of_triangle: &Surface) -> [f32; 3] {
    match system {
        "mmrt" | "hu" => [of_triangle.metallic, of_triangle.roughness, of_triangle.specular],
        // Reflecting materials are mirrors.
        "selective" => [of_triangle.metallic, if of_triangle.metallic > 0.0 { 0.0 } else { 1.0 }, 0.0],
        _ => [0.0, 1.0, 0.0],
    }
}

/// Largest difference of eight bits' shares.
fn difference(left: [f32; 3], right: [f32; 3]) -> f32 {
    (0..3).fold(0.0, |largest, i| (left[i] - right[i]).abs().max(largest))
}

/// Answer to a ray: t, the triangle, and where it hits something position, normal and error of the position.
type Answer = (f32, u32, Option<([f32; 3], [f32; 3], f32)>);

/// Attributes that the paper stores for ambient occlusion are enough for it: hits are those of all
/// attributes, bit for bit, and so are normals except for one ray in a hundred where fragments have the same
/// t: a ray that enters a cell behind several of them within their thickness hits all of these where it
/// enters.
#[test]
fn normals_alone_serve_ambient_occlusion() {
    let bench = Bench::new();
    for name in ["cornell", "spheres:10k", "atrium:detail=0.25"] {
        let scene = stage(&bench, name, SIZE);
        let rays = rays_inside(&scene, 2000);
        let mut expected: Option<(Vec<_>, f32)> = None;
        for (payload, storage, inline, builder, coverage) in [
            ("attributes", "dllb", "off", "raster", "exact"),
            ("normal", "dllb", "off", "raster", "exact"),
            ("normal", "sb", "off", "binning", "exact"),
            ("normal", "paged", "on", "raster", "exact"),
            ("attributes", "dllb", "off", "raster", "hardware"),
            ("normal", "dllb", "off", "raster", "hardware"),
        ] {
            // Every storage where triangles have masks; elsewhere one, and in the full tier all.
            let is_usual = storage == "dllb" && coverage == "exact" && name == "cornell";
            if !is_usual && !is_full() && name != "atrium:detail=0.25" {
                continue;
            }
            let options = [
                ("resolution", "64"),
                ("payload", payload),
                ("storage", storage),
                ("inline", inline),
                ("builder", builder),
                ("coverage", coverage),
            ];
            let mut structure = made(&bench, &scene, "mmrt", &options);
            let found = bench.surfaces(structure.as_ref(), &rays);
            let stored = |surface: &Surface| surface.valid != 0 && surface.primitive == PRIMITIVE_UNKNOWN;
            let met = found.iter().filter(|(_, surface)| stored(surface)).count();
            assert!(met > rays.len() / 8, "{name}: {met} fragments");
            if payload == "normal" {
                let white = |surface: &Surface| surface.base_color == [1.0; 3] && surface.metallic == 0.0;
                assert!(found.iter().all(|(_, surface)| !stored(surface) || white(surface)), "{name}");
            }
            let key = |(hit, surface): &(Hit, Surface)| {
                let met = hit.is_hit().then_some((surface.position, surface.normal, surface.position_error));
                (hit.t, hit.primitive, met)
            };
            let answers: Vec<_> = found.iter().map(key).collect();
            let mean = mean(&bench, &scene, structure.as_mut());
            // Coverages have hits of their own.
            match expected.as_ref().filter(|_| payload == "normal") {
                None => expected = Some((answers, mean)),
                // Fragments at one t are told apart by their words, which are others.
                Some((expected, mean_of_all)) => {
                    assert!((mean - mean_of_all).abs() < 1.0e-3, "{name}: {mean}, {mean_of_all} with all");
                    let pairs = || expected.iter().zip(&answers);
                    // Payloads are of different kernels, of which hardware may contract a product and a sum
                    // in one.
                    let (rounding, turn) =
                        if bench.device().is_software() { (0.0, None) } else { (1.0e-5, Some(1.0e-3)) };
                    let is_same_hit = |(all, one): (&Answer, &Answer)| {
                        let is_near = (one.0 - all.0).abs() <= rounding * all.0;
                        (one.0.to_bits() == all.0.to_bits() || is_near) && one.1 == all.1
                    };
                    assert!(pairs().all(is_same_hit), "{name}, {storage}");
                    let is_other = |(all, one): &(&Answer, &Answer)| match (turn, all.2, one.2) {
                        (Some(turn), Some(all), Some(one)) => difference(all.1, one.1) > turn,
                        _ => all != one,
                    };
                    let other = pairs().filter(is_other).count();
                    assert!(other <= rays.len() / 100, "{name}, {storage}: {other} other answers");
                }
            }
            println!("{name}, {payload}, {storage}: {met} fragments, mean {mean}");
        }
    }
}

/// Systems and payloads that both builders store.
const BUILT: [(&str, &str); 5] = [
    ("mmrt", "attributes"),
    ("hu", "attributes"),
    ("ldc", "attributes"),
    ("selective", "attributes"),
    ("mmrt", "normal"),
];

/// Fragments carry the same whether they were drawn or computed, with what masks cut out of them left out.
#[test]
fn both_builders_store_the_same_attributes() {
    let bench = Bench::new();
    for &name in first(&["atrium:detail=0.25", "cornell"], 1) {
        let scene = stage(&bench, name, SIZE);
        let rays = rays_inside(&scene, 2000);
        for &(system, payload) in first(&BUILT, 3) {
            let found = |builder| {
                let options =
                    [("resolution", "48"), ("coverage", "exact"), ("payload", payload), ("builder", builder)];
                let structure = made(&bench, &scene, system, &options);
                let key = |(hit, surface): (Hit, Surface)| {
                    let met = hit.is_hit().then_some((surface.base_color, surface.normal));
                    (hit.t.to_bits(), hit.primitive, met)
                };
                let found = bench.surfaces(structure.as_ref(), &rays).into_iter().map(key);
                (found.collect::<Vec<_>>(), structure.report().expect("the header is readable").stored)
            };
            let [(drawn, stored), computed] = ["raster", "binning"].map(found);
            assert!(drawn.iter().any(|(_, _, met)| met.is_some()) && stored > Some(0), "{system}, {name}");
            assert!((drawn, stored) == computed, "{system}, {name}");
        }
    }
}

/// Rays hit fragments where they would if those had triangle ids, and see their colours and normals, except
/// for the quantisation and the other material terms that a fragment stores.
#[test]
fn stored_surfaces_are_those_of_the_triangles() {
    const HALF_A_STEP: f32 = 0.51 / 255.0;
    let bench = Bench::new();
    // Flat walls of several colours; a round one; metals and glazes with interpolated normals.
    for (name, resolution, largest_turn) in
        [("cornell", "64", 1.0e-3), ("furnace", "128", 0.04), ("spheres:10k", "128", 0.4)]
    {
        let scene = stage(&bench, name, SIZE);
        let rays = rays_inside(&scene, 4000);
        for system in SYSTEMS {
            let found = |payload, addressing| {
                let options = [("resolution", resolution), ("payload", payload), ("addressing", addressing)];
                bench.surfaces(made(&bench, &scene, system, &options).as_ref(), &rays)
            };
            let (named, stored) = (found("index", "descriptor"), found("attributes", "descriptor"));
            if name == "cornell" {
                let by_address = found("attributes", "address");
                // A miss has no surface.
                let key = |(hit, surface): &(Hit, Surface)| {
                    let met = hit.is_hit().then_some((surface.base_color, surface.normal));
                    (hit.t.to_bits(), surface.primitive, met)
                };
                assert!(stored.iter().map(key).eq(by_address.iter().map(key)), "{system} by address");
                // However lists are made and kept: fragments without ids are identified by their words.
                // Systems of voxels share what keeps lists, so that the quick tier tries one way for each.
                let kept = match system {
                    "mmrt" => &[("storage", "sb"), ("storage", "ll"), ("storage", "paged")][..],
                    "hu" => first(&[("storage", "paged"), ("storage", "sb"), ("storage", "ll")], 1),
                    "selective" => first(&[("storage", "ll"), ("storage", "sb"), ("storage", "paged")], 1),
                    _ => &[("build", "single"), ("build", "peel")],
                };
                for (option, value) in kept {
                    let options = [("resolution", resolution), (option, value)];
                    let kept = bench.surfaces(made(&bench, &scene, system, &options).as_ref(), &rays);
                    assert!(stored.iter().map(key).eq(kept.iter().map(key)), "{system}: {option} {value}");
                }
            }
            let (mut met, mut turned, mut other, mut lamps) = (0, 0.0_f32, 0, 0);
            for (ray, ((hit, expected), (stored_hit, surface))) in named.iter().zip(&stored).enumerate() {
                assert_eq!(hit.t.to_bits(), stored_hit.t.to_bits(), "{system}, {name}, ray {ray}");
                assert_eq!(hit.is_hit(), stored_hit.is_hit());
                if !hit.is_hit() || !is_fragment(system, stored_hit) {
                    // Triangles close to the eye are known whatever fragments carry.
                    assert_eq!(hit.primitive, stored_hit.primitive);
                    continue;
                }
                met += 1;
                // Fragments keep the triangle of what emits, from behind as well: how bright it is, and how
                // likely light sampling finds it.
                let named = system != "selective" && surface.primitive != PRIMITIVE_UNKNOWN;
                if largest(expected.emission) > 0.0 || named {
                    lamps += 1;
                    assert_eq!(
                        (surface.emission, surface.primitive, surface.side),
                        (expected.emission, expected.primitive, expected.side),
                        "{system}, {name}, ray {ray}"
                    );
                    assert!(surface.position_error > 0.0 && surface.t.to_bits() == hit.t.to_bits());
                    continue;
                }
                assert_eq!(surface.emission, [0.0; 3], "{system}, {name}, ray {ray}");
                let id = if system == "selective" { hit.primitive } else { PRIMITIVE_UNKNOWN };
                assert_eq!(
                    (stored_hit.primitive, surface.primitive),
                    (id, id),
                    "{system}, {name}, ray {ray}"
                );
                assert!(dot(surface.normal, rays[ray].direction) <= 1.0e-6, "normals face the ray");
                assert!(surface.position_error > 0.0 && surface.t.to_bits() == hit.t.to_bits());
                let of_surface = [surface.metallic, surface.roughness, surface.specular];
                let cosine = dot(surface.normal, expected.normal).abs();
                let same = difference(surface.base_color, expected.base_color) <= HALF_A_STEP
                    && difference(of_surface, terms(system, expected)) <= HALF_A_STEP;
                if same && cosine > 0.5 {
                    turned += 1.0 - cosine;
                } else {
                    other += 1;
                }
            }
            // Twice 1 - cos is about the square of the angle.
            let turn = (2.0 * turned / met as f32).max(0.0).sqrt();
            println!("{system}, {name}: {met} fragments, turned by {turn}, {other} of another surface");
            assert!(met > rays.len() / 8, "{system}, {name}: {met} fragments");
            assert!(name != "cornell" || lamps > 5, "{system}: the lamp is hit {lamps} times");
            assert!(turn < largest_turn, "{system}, {name}: normals turned by {turn}");
            // Where fragments are at one t, ids take another one than words do: in corners, where a ray
            // enters a cell within the tolerance of both walls.
            assert!(other <= met / 1000, "{system}, {name}: {other} of {met} see another surface");
        }
    }
}
