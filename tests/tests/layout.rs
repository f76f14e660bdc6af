//! Every record that Rust and shaders share, held against two readers of the compiled modules: names,
//! offsets, sizes and strides.

use std::collections::BTreeMap;
use std::mem::offset_of;

use rasray_abuffer::Header;
use rasray_ads::{Draw, GeometryHeader, Hit, QueueHeader, Ray, RayWork, Surface, TraceState, TraceStep};
use rasray_bvh as bvh;
use rasray_gpu_scene::layout as scene;
use rasray_integrators::{AovPixel, FilmFaults, FilmPixel, PathState};
use rasray_shaders_glsl::layout::layouts;
use rasray_shaders_glsl::{self as shaders, Shader};
use rasray_tests::visits::Visit;
use spirq::reflect_cfg::ReflectConfig;
use spirq::ty::Type;
use spirq::var::Variable;

/// A member: name, offset, size.
type Member = (String, usize, usize);

/// A record as a reader of modules sees it.
#[derive(Clone, Debug, PartialEq)]
struct Record {
    members: Vec<Member>,
    size: usize,
    stride: Option<usize>,
}

/// What the product's own reader says.
fn read_by_us(shader: &Shader) -> BTreeMap<String, Record> {
    layouts(shader.words())
        .into_iter()
        .map(|layout| {
            let members = layout.members.iter().map(|m| (m.name.clone(), m.offset as usize, m.size as usize));
            let record = Record {
                members: members.collect(),
                size: layout.size() as usize,
                stride: layout.stride.map(|stride| stride as usize),
            };
            (layout.name, record)
        })
        .collect()
}

const OP_CONSTANT_NULL: u32 = 46;
const OP_SPEC_CONSTANT_OP: u32 = 52;

/// The module with expressions of specialisation constants replaced by zeros: no layout depends on
/// them, and spirq does not know all their operations.
fn without_constant_expressions(words: &[u32]) -> Vec<u32> {
    let (header, mut rest) = words.split_at(5);
    let mut kept = header.to_vec();
    while let Some(&first) = rest.first() {
        let (instruction, after) = rest.split_at(((first >> 16).max(1) as usize).min(rest.len()));
        if first & 0xFFFF == OP_SPEC_CONSTANT_OP {
            kept.extend([3 << 16 | OP_CONSTANT_NULL, instruction[1], instruction[2]]);
        } else {
            kept.extend_from_slice(instruction);
        }
        rest = after;
    }
    kept
}

/// What an independent reader says.
fn read_by_spirq(shader: &Shader) -> BTreeMap<String, Record> {
    let entry_points = ReflectConfig::new()
        .spv(without_constant_expressions(shader.words()))
        .ref_all_rscs(true)
        .reflect()
        .unwrap_or_else(|error| panic!("{shader:?}: {error}"));
    let mut found = BTreeMap::new();
    for variable in entry_points.iter().flat_map(|entry_point| &entry_point.vars) {
        if let Variable::Descriptor { ty, .. } | Variable::PushConstant { ty, .. } = variable {
            collect(ty, None, &mut found);
        }
    }
    found
}

fn collect(ty: &Type, stride: Option<usize>, found: &mut BTreeMap<String, Record>) {
    match ty {
        Type::Array(array) => collect(&array.element_ty, array.stride, found),
        Type::Struct(record) => {
            let members = record.members.iter().map(|member| {
                let name = member.name.clone().unwrap_or_default();
                // A run-time array has no size of its own.
                (name, member.offset.unwrap_or(usize::MAX), member.ty.nbyte().unwrap_or(0))
            });
            let members: Vec<Member> = members.collect();
            let size = members.last().map_or(0, |(_, offset, size)| offset + size);
            for member in &record.members {
                collect(&member.ty, None, found);
            }
            let name = record.name.clone().unwrap_or_default();
            let known = found.entry(name).or_insert(Record { members, size, stride });
            known.stride = known.stride.or(stride);
        }
        _ => {}
    }
}

/// How a record differs from what Rust has; `None` if it does not.
fn difference(record: Option<&Record>, members: &[Member], size: usize) -> Option<String> {
    let Some(record) = record else {
        return Some("the module does not have it".to_owned());
    };
    if record.members != members {
        return Some(format!("members {:?}, expected {members:?}", record.members));
    }
    if record.size != size {
        return Some(format!("{} bytes, expected {size}", record.size));
    }
    match record.stride {
        Some(stride) if stride != size => Some(format!("stride {stride}, expected {size}")),
        _ => None,
    }
}

/// Checks a record in a module with both readers.
fn check(shader: &Shader, name: &str, members: &[Member], size: usize) {
    for (reader, records) in [("own reader", read_by_us(shader)), ("spirq", read_by_spirq(shader))] {
        if let Some(difference) = difference(records.get(name), members, size) {
            panic!("{name} in {} ({reader}): {difference}", shader.name);
        }
    }
}

/// Size of a member that a function leads to.
fn size_of_member<T, M>(_: fn(&T) -> &M) -> usize {
    size_of::<M>()
}

macro_rules! members {
    ($record:ty { $($member:ident $(as $name:literal)?),* $(,)? }) => {
        [$((
            [$($name,)? stringify!($member)][0].to_owned(),
            offset_of!($record, $member),
            size_of_member(|record: &$record| &record.$member),
        )),*]
    };
}

macro_rules! check_layout {
    ($shaders:expr, $record:ty as $name:literal { $($members:tt)* }) => {
        for shader in $shaders {
            check(shader, $name, &members!($record { $($members)* }), size_of::<$record>());
        }
    };
}

/// A traversal, an occlusion test and a surface pass of either structure.
const TRACES: [&Shader; 5] = [
    &shaders::BRUTE_TRACE_CLOSEST,
    &shaders::BRUTE_TRACE_OCCLUDED,
    &shaders::ABUFFER_TRACE_CLOSEST,
    &shaders::ABUFFER_TRACE_OCCLUDED,
    &shaders::ABUFFER_TRACE_CLOSEST_ADDRESS,
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
    let queues = [&shaders::ADS_QUEUE_NEXT_ROUND, TRACES[0], TRACES[1], TRACES[2], TRACES[3], TRACES[4]];
    check_layout!(queues, QueueHeader as "QueueHeader" {
        groups_x, groups_y, groups_z, capacity, round, listed, paused, unfinished, not_ready, spare,
        cells_low, cells_high, entries_low, entries_high, tests_low, tests_high,
    });
    check_layout!([&shaders::ABUFFER_BUILD_1_NEAR, TRACES[0]], GeometryHeader as "GeometryHeader" {
        vertex_count, triangle_count, draw_count,
    });
    // Wherever draws are read; a module that does not read them does not have the record.
    let readers = shaders::ALL.iter().copied().filter(|shader| read_by_us(shader).contains_key("Draw"));
    check_layout!(readers, Draw as "Draw" { first_triangle, triangle_count, instance, flags });
}

/// Whatever module a shared record is declared in, it is the same record.
#[test]
fn records_are_the_same_in_all_modules() {
    const SHARED: [&str; 21] = [
        "Ray",
        "Hit",
        "TraceState",
        "RayWork",
        "TraceStep",
        "Surface",
        "Draw",
        "GeometryHeader",
        "QueueHeader",
        "AbufferHeader",
        "BvhHeader",
        "BvhNode",
        "BvhRecord",
        "VoxelHeader",
        "VoxelFragment",
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

#[test]
fn records_of_the_abuffer() {
    let modules = [
        &shaders::ABUFFER_BUILD_1_NEAR,
        &shaders::ABUFFER_BUILD_RASTER,
        &shaders::ABUFFER_BUILD_2_BOUNDS,
        &shaders::ABUFFER_BUILD_3_SCALE,
        &shaders::ABUFFER_BUILD_4_COUNT,
        &shaders::ABUFFER_BUILD_5_SCAN_BLOCKS,
        &shaders::ABUFFER_BUILD_5_SCAN_SUMS,
        &shaders::ABUFFER_BUILD_5_SCAN_PLACES,
        &shaders::ABUFFER_BUILD_6_STORE,
        &shaders::ABUFFER_BUILD_7_REORDER,
        &shaders::ABUFFER_BUILD_8_REORDER_LONG,
        &shaders::ABUFFER_BUILD_9_STATUS,
        &shaders::ABUFFER_TRACE_CLOSEST,
    ];
    check_layout!(modules, Header as "AbufferHeader" {
        status, demand, capacity, near_demand, near_capacity, unsorted, corrupted, resolution, samples,
        thickness, near_size, long_demand, eye, long_capacity, lower, fragments, upper, camera_resolution,
        camera_x, camera_y, camera_z,
        bounds_address, lists_address, nodes_address, data_address, near_address, sums_address, long_address,
    });
}

#[test]
fn records_of_the_bvh() {
    let modules =
        [&shaders::BVH_BUILD_6_RECORDS, &shaders::BVH_BUILD_8_TOPOLOGY, &shaders::BVH_TRACE_CLOSEST];
    check_layout!(modules, bvh::Header as "BvhHeader" {
        status, root, triangle_count, node_capacity, record_capacity, scratch_capacity, order_offset,
        order_stride, lower, spare_lower, cells_per_metre, corrupted, nodes_address, records_address,
        scratch_address, spare_address,
    });
    check_layout!([&shaders::BVH_BUILD_8_TOPOLOGY, &shaders::BVH_TRACE_CLOSEST], bvh::Node as "BvhNode" {
        lower_0, child_0, upper_0, child_1, lower_1, parent, upper_1, spare,
    });
    check_layout!(modules, bvh::Record as "BvhRecord" { a, b, c, primitive });
}

#[test]
fn records_of_primitive_lists() {
    let modules = [
        &shaders::PRIMITIVE_BUILD_1_NEAR,
        &shaders::PRIMITIVE_BUILD_RASTER,
        &shaders::PRIMITIVE_BUILD_2_BOUNDS,
        &shaders::PRIMITIVE_BUILD_3_SCALE,
        &shaders::PRIMITIVE_BUILD_4_COUNT,
        &shaders::PRIMITIVE_BUILD_5_SCAN_BLOCKS,
        &shaders::PRIMITIVE_BUILD_5_SCAN_SUMS,
        &shaders::PRIMITIVE_BUILD_5_SCAN_PLACES,
        &shaders::PRIMITIVE_BUILD_6_STORE,
        &shaders::PRIMITIVE_BUILD_7_STATUS,
        &shaders::PRIMITIVE_BRICKS_2_SLICES,
        &shaders::PRIMITIVE_BRICKS_3_BIN,
        &shaders::PRIMITIVE_BRICKS_3_BIN_MANY,
        &shaders::PRIMITIVE_BRICKS_4_MARK,
        &shaders::PRIMITIVE_BRICKS_5_CELLS,
        &shaders::PRIMITIVE_BRICKS_7_COUNT,
        &shaders::PRIMITIVE_BRICKS_9_STORE,
        &shaders::PRIMITIVE_BRICKS_10_REACH_SLICES,
        &shaders::PRIMITIVE_BRICKS_10_REACH_COLUMNS,
        &shaders::PRIMITIVE_BRICKS_10_REACH_ROWS,
        &shaders::PRIMITIVE_BRICKS_11_TRIANGLES,
        &shaders::PRIMITIVE_TRACE_CLOSEST,
        &shaders::PRIMITIVE_TRACE_OCCLUDED,
    ];
    check_layout!(modules, rasray_ads_primitive::Header as "PrimitiveHeader" {
        status, demand, capacity, near_demand, near_capacity, corrupted, tiles, spare, reach, near_size, rounding,
        spare_length, eye, spare_eye, lower, spare_lower, upper, spare_upper, bounds_address, lists_address,
        entries_address, sums_address, near_address, records_address, triangles_address, slices, slice_first, slice_shift, record_demand, record_capacity,
        cell_demand, cell_capacity, triangle_capacity, pairs, groups, octaves,
    });
    let by_address = &read_by_us(&shaders::PRIMITIVE_TRACE_CLOSEST_ADDRESS)["PrimitiveHeader"];
    assert_eq!(*by_address, read_by_us(&shaders::PRIMITIVE_TRACE_CLOSEST)["PrimitiveHeader"]);
}

#[test]
fn records_of_voxels() {
    let modules = [
        &shaders::VOXEL_BUILD_COLUMNS,
        &shaders::VOXEL_BUILD_1_VOXELS,
        &shaders::VOXEL_BUILD_2_AXES,
        &shaders::VOXEL_BUILD_RASTER,
        &shaders::VOXEL_BUILD_3_COUNT,
        &shaders::VOXEL_BUILD_4_SCAN_BLOCKS,
        &shaders::VOXEL_BUILD_4_SCAN_SUMS,
        &shaders::VOXEL_BUILD_4_SCAN_PLACES,
        &shaders::VOXEL_BUILD_5_STORE,
        &shaders::VOXEL_BUILD_6_SORT,
        &shaders::VOXEL_BUILD_7_SORT_LONG,
        &shaders::VOXEL_BUILD_8_STATUS,
        &shaders::VOXEL_TRACE_CLOSEST,
        &shaders::VOXEL_TRACE_OCCLUDED,
    ];
    check_layout!(modules, rasray_voxel::Header as "VoxelHeader" {
        status, demand, capacity, fragments, unsorted, long_demand, long_capacity, corrupted, resolution, grid, samples, cell, voxel,
        cells_per_metre, voxels_per_metre, lower, voxels_address, normals_address, lists_address,
        fragments_address, scratch_address,
    });
    let fragment = [("z", 0), ("primitive", 4)].map(|(name, offset)| (name.to_owned(), offset, 4));
    let sizes = rasray_voxel::plan(
        &rasray_voxel::Config::robust(8),
        rasray_voxel::Demand { entries: 1, long_lists: 0 },
    )
    .expect("in range");
    let pool = sizes.pools.iter().find(|pool| pool.name == "fragments").expect("the pool exists");
    for shader in [&shaders::VOXEL_BUILD_5_STORE, &shaders::VOXEL_BUILD_6_SORT, &shaders::VOXEL_TRACE_CLOSEST]
    {
        check(shader, "VoxelFragment", &fragment, pool.element_bytes as usize);
        assert_eq!(read_by_us(shader)["VoxelFragment"].stride, Some(pool.element_bytes as usize));
    }
    let direct = read_by_us(&shaders::VOXEL_TRACE_CLOSEST);
    let by_address = read_by_us(&shaders::VOXEL_TRACE_CLOSEST_ADDRESS);
    for name in ["VoxelHeader", "VoxelFragment"] {
        assert_eq!(direct[name], by_address[name], "{name}");
    }
}

#[test]
fn records_of_layered_depth_cubes() {
    let modules = [
        &shaders::LDC_BUILD_RASTER,
        &shaders::LDC_BUILD_RASTER_FRINGE,
        &shaders::LDC_BUILD_1_COUNT,
        &shaders::LDC_BUILD_2_SCAN_BLOCKS,
        &shaders::LDC_BUILD_2_SCAN_SUMS,
        &shaders::LDC_BUILD_2_SCAN_PLACES,
        &shaders::LDC_BUILD_3_STORE,
        &shaders::LDC_BUILD_3_PEEL,
        &shaders::LDC_BUILD_4_SORT,
        &shaders::LDC_BUILD_5_SORT_LONG,
        &shaders::LDC_BUILD_6_FRINGE,
        &shaders::LDC_BUILD_7_STATUS,
        &shaders::LDC_TRACE_CLOSEST,
        &shaders::LDC_TRACE_OCCLUDED,
    ];
    check_layout!(modules, rasray_ldc::Header as "LdcHeader" {
        status, demand, capacity, fringe_demand, fringe_capacity, unsorted, corrupted, resolution, cell, size,
        tolerance, long_demand, origin, long_capacity, lower, layer_demand, upper, slices_a_metre, lists_address,
        depths_address, primitives_address, blocks_address, heads_address, fringe_address, scratch_address,
        layer_capacity, layer_limit, beyond, spare,
    });
    let by_address = &read_by_us(&shaders::LDC_TRACE_CLOSEST_ADDRESS)["LdcHeader"];
    assert_eq!(*by_address, read_by_us(&shaders::LDC_TRACE_CLOSEST)["LdcHeader"]);
}

/// With device addresses the header is reached by a pointer, which only the own reader follows.
#[test]
fn records_reached_by_address_are_the_same() {
    let direct = read_by_us(&shaders::ABUFFER_TRACE_CLOSEST);
    let by_address = read_by_us(&shaders::ABUFFER_TRACE_CLOSEST_ADDRESS);
    assert_eq!(direct["AbufferHeader"], by_address["AbufferHeader"]);
    let direct = read_by_us(&shaders::BVH_TRACE_CLOSEST);
    let by_address = read_by_us(&shaders::BVH_TRACE_CLOSEST_ADDRESS);
    for name in ["BvhHeader", "BvhNode", "BvhRecord"] {
        assert_eq!(direct[name], by_address[name], "{name}");
    }
}

#[test]
fn records_of_the_scene() {
    let modules = [&shaders::BRUTE_SURFACES, &shaders::INTEGRATORS_PATH_SHADE];
    check_layout!([&shaders::INTEGRATORS_PRIMARY, &shaders::INTEGRATORS_PATH_SHADE], scene::Frame as "Frame" {
        camera_position, projection, camera_right, half_width, camera_up, half_height, camera_forward,
        cone_spread, cone_width, width, height, seed, triangle_count, light_count, emissive_count,
        environment_kind, environment_width, environment_height, environment_sampled,
        environment_radiance,
    });
    check_layout!(modules, scene::Material as "Material" {
        base_color, emission, metallic, roughness, transmission, ior, thickness, attenuation_color,
        attenuation_distance, specular_color, specular, normal_scale, alpha_cutoff, flags, spare,
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
        position, kind, direction, range, intensity, cone_scale, cone_offset, spare,
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

/// Push constants of traversals: the address of the structure, in halves, where there is one, and a count.
#[test]
fn push_constants_of_traversals() {
    for shader in TRACES {
        let records = read_by_us(shader);
        let (name, push) = records
            .iter()
            .find(|(name, _)| name.ends_with("Constants"))
            .unwrap_or_else(|| panic!("{}: {:?}", shader.name, records.keys()));
        assert_eq!(push.members.last().map(|(_, offset, size)| (*offset, *size)), Some((8, 4)), "{name}");
        assert_eq!(push.size, 12, "{name}");
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
