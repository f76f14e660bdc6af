//! Every record that Rust and the integrator kernels share, held against SPIR-V reflection.

use std::mem::offset_of;

use rasray_gpu_scene::layout as scene;
use rasray_integrators::{AovPixel, FilmFaults, FilmPixel, PathState};
use rasray_shaders_glsl::{
    INTEGRATORS_AOV, INTEGRATORS_FILM_ACCUMULATE, INTEGRATORS_PATH_SHADE, INTEGRATORS_PRIMARY,
    INTEGRATORS_RAYCAST_SHADE, Shader,
    layout::{Layout, layouts},
};

fn layout_of(shader: &Shader, name: &str) -> Layout {
    let found = layouts(shader.words()).into_iter().find(|layout| layout.name == name);
    found.unwrap_or_else(|| panic!("{shader:?} declares no {name}"))
}

/// Compares names and offsets of all members and the size.
fn check(shader: &Shader, name: &str, size: usize, members: &[(&str, usize)]) {
    let layout = layout_of(shader, name);
    let found: Vec<_> =
        layout.members.iter().map(|member| (member.name.as_str(), member.offset as usize)).collect();
    assert_eq!(found, members, "{name}");
    assert_eq!(layout.size() as usize, size, "{name}");
    assert!(layout.stride.is_none_or(|stride| stride as usize == size), "{name}");
}

macro_rules! check_layout {
    ($shader:expr, $record:ty as $name:literal { $($member:ident),* $(,)? }) => {
        check($shader, $name, size_of::<$record>(), &[$((stringify!($member), offset_of!($record, $member))),*])
    };
}

#[test]
fn film_path_and_aov_records() {
    check_layout!(&INTEGRATORS_FILM_ACCUMULATE, FilmPixel as "FilmPixel" { sum, samples });
    check_layout!(&INTEGRATORS_FILM_ACCUMULATE, FilmFaults as "FilmFaults" { non_finite });
    check_layout!(&INTEGRATORS_PATH_SHADE, PathState as "PathState" {
        throughput, pixel, radiance, sample_index, bsdf_pdf, medium, bounce, layers, flags,
    });
    check_layout!(&INTEGRATORS_AOV, AovPixel as "AovPixel" { distance, normal, primitive });
}

#[test]
fn scene_records() {
    let shade = &INTEGRATORS_PATH_SHADE;
    for shader in [&INTEGRATORS_PRIMARY, &INTEGRATORS_RAYCAST_SHADE, shade] {
        check_layout!(shader, scene::Frame as "Frame" {
            camera_position, projection, camera_right, half_width, camera_up, half_height, camera_forward,
            cone_spread, cone_width, width, height, seed, triangle_count, light_count, emissive_count,
            environment_kind, environment_width, environment_height, environment_sampled,
            environment_radiance, sampling, footprint_scale, kind_shares, texel_shift,
        });
    }
    check_layout!(shade, scene::Material as "Material" {
        base_color, emission, metallic, roughness, transmission, ior, thickness, attenuation_color,
        attenuation_distance, specular_color, specular, normal_scale, alpha_cutoff, flags, albedo,
        base_color_texture, metallic_roughness_texture, normal_texture, emission_texture,
        transmission_texture,
    });
    check_layout!(shade, scene::TextureUse as "TextureRef" { texture, uv_set, row_u, row_v });
    check_layout!(shade, scene::Texture as "Texture" { first_texel, width, height, level_count, sampling });
    check_layout!(shade, scene::Light as "Light" {
        position, kind, direction, range, intensity, cone_scale, cone_offset, cumulative,
    });
    check_layout!(shade, scene::EmissiveTriangle as "EmissiveTriangle" { primitive, cumulative });
    check_layout!(shade, scene::DrawShading as "DrawShading" {
        first_triangle, first_vertex, material, flags, normals, tangents, uv0, uv1, colors, first_emissive,
        instance,
    });
}

#[test]
fn a_wrong_layout_is_noticed() {
    let wrong = std::panic::catch_unwind(|| {
        check(&INTEGRATORS_AOV, "AovPixel", 20, &[("distance", 0), ("normal", 16)])
    });
    assert!(wrong.is_err());
}
