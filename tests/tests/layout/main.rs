//! Every record that Rust and shaders share, held against two readers of the compiled modules: names,
//! offsets, sizes and strides.

#[macro_use]
mod reader;

use std::collections::BTreeMap;

use rasray_ads::{
    Draw, GeometryHeader, Hit, QueueHeader, Ray, RayWork, RecordLayout, Surface, TraceState, TraceStep,
};
use rasray_gpu_scene::layout as scene;
use rasray_integrators::{AovPixel, FilmFaults, FilmPixel, PathState};
use rasray_shaders_glsl::{self as shaders, Shader};
use rasray_systems::SYSTEMS;
use rasray_tests::visits::Visit;

use crate::reader::{Member, Record, difference, read_by_spirq, read_by_us};

/// A traversal, an occlusion test and a surface pass of either structure.
const TRACES: [&Shader; 5] = [
    &shaders::BRUTE_TRACE_CLOSEST,
    &shaders::BRUTE_TRACE_OCCLUDED,
    &shaders::ABUFFER_TRACE_CLOSEST_CELLS_PLANES,
    &shaders::ABUFFER_TRACE_OCCLUDED_CELLS_PLANES,
    &shaders::ABUFFER_TRACE_CLOSEST_CELLS_PLANES_ADDRESS,
];

#[test]
fn records_of_the_contract() {
    check_layout!(TRACES, Ray as "Ray" {
        origin, t_min, direction, t_max, exclude_primitive, flags, cone_width, cone_spread,
    });
    check_layout!(TRACES, Hit as "Hit" { t, primitive, a, b });
    check_layout!(TRACES, TraceState as "TraceState" { best, cursor, cells, entries, tests, rounds });
    check_layout!(TRACES, RayWork as "RayWork" { cells, entries, tests, rounds });
    check_layout!(TRACES, TraceStep as "TraceStep" { kind, round, a, b, c, t_low, t_high });
    check_layout!([&shaders::BRUTE_SURFACES, &shaders::ABUFFER_SURFACES], Surface as "Surface" {
        position, position_error, geometric_normal, primitive, normal, valid, base_color, metallic,
        emission, roughness, transmission, ior, opacity, thickness, attenuation_color,
        attenuation_distance, specular, side, t, material,
    });
}

#[test]
fn records_of_queues_and_geometry() {
    let queues = [
        &shaders::ADS_QUEUE_NEXT_ROUND,
        &shaders::ADS_QUEUE_TAKE,
        TRACES[0],
        TRACES[1],
        TRACES[2],
        TRACES[3],
        TRACES[4],
    ];
    check_layout!(queues, QueueHeader as "QueueHeader" {
        groups_x, groups_y, groups_z, capacity, round, listed, paused, unfinished, not_ready, selecting,
        cells_low, cells_high, entries_low, entries_high, tests_low, tests_high, selected_x, selected_y,
        selected_z, selected, takes, corrupted,
    });
    check_layout!([&shaders::ABUFFER_BUILD_1_NEAR, TRACES[0]], GeometryHeader as "GeometryHeader" {
        vertex_count, triangle_count, draw_count, outside, lower, upper, position_word, position_words, index_word,
    });
    // Modules have what they read alone, and few read draws.
    check_layout!([&shaders::LDC_BUILD_6_FRINGE, &shaders::ADS_GEOMETRY_GATHER], Draw as "Draw" {
        first_triangle, triangle_count, instance, flags, first_index, base_vertex,
    });
}

/// Whatever module a shared record is declared in, it is the same record.
#[test]
fn records_are_the_same_in_all_modules() {
    const SHARED: [&str; 15] = [
        "Ray",
        "Hit",
        "TraceState",
        "RayWork",
        "TraceStep",
        "Surface",
        "Draw",
        "GeometryHeader",
        "QueueHeader",
        "Frame",
        "Material",
        "TextureRef",
        "DrawShading",
        "PathState",
        "FilmPixel",
    ];
    let mut known: BTreeMap<String, (Vec<Member>, &str)> = BTreeMap::new();
    let mut compared = 0;
    for shader in shaders::ALL {
        for (name, record) in read_by_us(shader) {
            if SHARED.contains(&name.as_str()) {
                let (members, first) =
                    known.entry(name.clone()).or_insert((record.members.clone(), shader.name));
                assert_eq!(*members, record.members, "{name} in {first} and in {}", shader.name);
                compared += 1;
            }
        }
    }
    assert!(compared > 100, "only {compared} records were compared");
}

/// Members of a record as readers of modules name them.
fn members_of(record: &RecordLayout) -> Vec<Member> {
    record.members.iter().map(|(name, offset, size)| ((*name).to_owned(), *offset, *size)).collect()
}

/// The records that a structure says it shares, in every module of its folder that has them: all that trace have its
/// header. With device addresses records are reached by pointers, which only the own reader follows.
#[test]
fn records_of_every_structure() {
    for system in SYSTEMS {
        let folder = system.structure.trim_start_matches("ads-");
        let of_folder = |shader: &&&Shader| shader.name.split('/').next() == Some(folder);
        for (place, record) in system.records.iter().enumerate() {
            let members = members_of(record);
            // Modules with the record as either reader sees them: some declare it and use nothing of it.
            let mut counts = [0, 0];
            for shader in shaders::ALL.iter().filter(of_folder) {
                let by_address = shader.name.ends_with(".address");
                let mut readers = vec![read_by_us(shader)];
                if !by_address {
                    readers.push(read_by_spirq(shader));
                }
                for (found, count) in readers.iter().zip(&mut counts) {
                    let traces = place == 0 && shader.name.contains("/trace_");
                    if traces || found.contains_key(record.name) {
                        let difference = difference(found.get(record.name), &members, record.size);
                        assert_eq!(difference, None, "{} in {}", record.name, shader.name);
                        *count += 1;
                    }
                }
            }
            assert!(counts[1] > 1 && counts[0] > counts[1], "{folder}: {counts:?} with {}", record.name);
        }
        assert!(!system.records.is_empty() || system.name == "brute-force", "{} shares nothing", system.name);
    }
}

#[test]
fn records_of_the_scene() {
    let modules = [&shaders::BRUTE_SURFACES, &shaders::INTEGRATORS_PATH_SHADE];
    check_layout!([&shaders::INTEGRATORS_PRIMARY, &shaders::INTEGRATORS_PATH_SHADE], scene::Frame as "Frame" {
        camera_position, projection, camera_right, half_width, camera_up, half_height, camera_forward,
        cone_spread, cone_width, width, height, seed, triangle_count, light_count, emissive_count,
        environment_kind, environment_width, environment_height, environment_sampled,
        environment_radiance, sampling, footprint_scale, kind_shares, texel_shift,
    });
    check_layout!(modules, scene::Material as "Material" {
        base_color, emission, metallic, roughness, transmission, ior, thickness, attenuation_color,
        attenuation_distance, specular_color, specular, normal_scale, alpha_cutoff, flags, albedo,
        base_color_texture, metallic_roughness_texture, normal_texture, emission_texture,
        transmission_texture,
    });
    check_layout!(modules, scene::TextureUse as "TextureRef" { texture, uv_set, row_u, row_v });
    check_layout!(modules, scene::Texture as "Texture" { first_texel, width, height, level_count, sampling });
    check_layout!(modules, scene::DrawShading as "DrawShading" {
        first_triangle, first_vertex, material, flags, normals, tangents, uv0, uv1, colors, first_emissive,
        instance,
    });
    let lights = [&shaders::INTEGRATORS_PATH_SHADE];
    check_layout!(lights, scene::Light as "Light" {
        position, kind, direction, range, intensity, cone_scale, cone_offset, cumulative,
    });
    check_layout!(lights, scene::EmissiveTriangle as "EmissiveTriangle" { primitive, cumulative });
}

#[test]
fn records_of_integrators() {
    check_layout!([&shaders::INTEGRATORS_PATH_SHADE, &shaders::INTEGRATORS_PATH_RESOLVE], PathState as "PathState" {
        throughput, pixel, radiance, sample_index, bsdf_pdf, medium, bounce, layers, flags,
    });
    check_layout!([&shaders::INTEGRATORS_FILM_ACCUMULATE], FilmPixel as "FilmPixel" { sum, samples });
    check_layout!([&shaders::INTEGRATORS_FILM_ACCUMULATE], FilmFaults as "FilmFaults" { non_finite });
    check_layout!([&shaders::INTEGRATORS_AOV], AovPixel as "AovPixel" { distance, normal, primitive });
}

/// Push constants of traversals: the address of the structure, in halves, where there is one, a count, and but for
/// surfaces the work budget.
#[test]
fn push_constants_of_traversals() {
    for shader in TRACES {
        let records = read_by_us(shader);
        let (name, push) = records
            .iter()
            .find(|(name, _)| name.ends_with("Constants"))
            .unwrap_or_else(|| panic!("{}: {:?}", shader.name, records.keys()));
        let words: &[_] = if name == "TraceConstants" { &[(8, 4), (12, 4)] } else { &[(8, 4)] };
        let found: Vec<_> = push.members.iter().map(|(_, offset, size)| (*offset, *size)).collect();
        assert!(found.ends_with(words), "{name}: {found:?}");
        assert_eq!(push.size, 8 + 4 * words.len(), "{name}");
    }
}

#[test]
fn records_of_the_test_kernels() {
    check_layout!([&shaders::ADS_TEST_MARCH_CELLS], Visit as "Visit" { face, x, y, t_low, t_high });
}

/// The comparer must be able to fail: each property of each member, and the record as a whole.
#[test]
fn a_wrong_expectation_is_noticed() {
    let members = members!(Hit { t, primitive, a, b }).to_vec();
    let size = size_of::<Hit>();
    for records in [read_by_us(TRACES[0]), read_by_spirq(TRACES[0])] {
        let hit = records.get("Hit");
        assert_eq!(difference(hit, &members, size), None);
        for index in 0..members.len() {
            let wrong = |change: fn(&mut Member)| {
                let mut wrong = members.clone();
                change(&mut wrong[index]);
                difference(hit, &wrong, size)
            };
            assert!(wrong(|(name, _, _)| name.push('x')).is_some());
            assert!(wrong(|(_, offset, _)| *offset += 4).is_some());
            assert!(wrong(|(_, _, size)| *size += 4).is_some());
            let mut fewer = members.clone();
            fewer.remove(index);
            assert!(difference(hit, &fewer, size).is_some());
        }
        let mut swapped = members.clone();
        swapped.swap(2, 3);
        assert!(difference(hit, &swapped, size).is_some());
        assert!(difference(hit, &members, size + 4).is_some());
        assert!(difference(None, &members, size).is_some());
        let strided = hit.map(|record| Record { stride: Some(size + 16), ..record.clone() });
        assert!(difference(strided.as_ref(), &members, size).is_some());
    }
}
