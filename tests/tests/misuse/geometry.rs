//! Geometries that their buffers, bounds or vertices do not allow.

use rasray_ads::{
    AdsError, BufferOffset, Draw, Geometry, GeometryDesc, Hit, IndexFormat, Indexing, Ray, TraceMode,
};
use rasray_gpu::{BufferDesc, BufferUsage, Device, MemoryLocation, Timing};
use rasray_tests::harness::Bench;
use rasray_tests::invariance::Subject;
use rasray_tests::shapes::closed_box;
use rasray_tracer::{BatchTracer, TracerError, build_until_complete};

fn desc_of(device: &Device, triangles: u32) -> GeometryDesc {
    let buffer = |name, bytes: u64| {
        let usage = BufferUsage::STORAGE;
        device.create_buffer(&BufferDesc { name, size: bytes, usage, location: MemoryLocation::Device })
    };
    let bytes = u64::from(triangles);
    GeometryDesc {
        positions: buffer("positions", 36 * bytes).expect("it fits").into(),
        indices: buffer("indices", 12 * bytes).expect("it fits").into(),
        draws: buffer("draws", size_of::<Draw>() as u64).expect("it fits").into(),
        vertex_count: 3 * triangles,
        triangle_count: triangles,
        count: None,
        draw_count: 1,
        bounds: [[-1.0; 3], [1.0; 3]],
        frame_origin: [0.0; 3],
    }
}

#[test]
fn a_geometry_that_its_buffers_do_not_hold_is_an_error() {
    let bench = Bench::new();
    let device = bench.device();
    let desc = desc_of(device, 4);
    drop(Geometry::new(device, desc.clone()).expect("it is right"));
    type Change = fn(&mut GeometryDesc);
    let wrong: [(Change, &str); 17] = [
        (|desc| desc.positions.stride = 8, "a stride of 8 bytes"),
        (|desc| desc.positions.stride = 14, "a stride of 14 bytes"),
        (|desc| desc.positions.stride = 16, "12 vertices are 188 bytes from byte 0"),
        (|desc| desc.positions.offset = 2, "byte 2 of buffer `positions`"),
        (|desc| desc.positions.offset = 4, "12 vertices are 144 bytes from byte 4"),
        (|desc| desc.positions.offset = u64::MAX - 3, "12 vertices"),
        (|desc| desc.indices.offset = 2, "byte 2 of buffer `indices`, which must be a multiple of 4"),
        (
            |desc| (desc.indices.format, desc.indices.offset) = (IndexFormat::U16, 1),
            "byte 1 of buffer `indices`, which must be a multiple of 2",
        ),
        (|desc| desc.indices.indexing = Indexing::PerDraw { index_count: 13 }, "13 indices are 52 bytes"),
        (|desc| desc.draws.offset = 4, "byte 4 of buffer `draws`"),
        (
            |desc| desc.count = Some(BufferOffset { buffer: desc.draws.buffer.clone(), offset: 24 }),
            "the number of triangles",
        ),
        (|desc| desc.vertex_count = 13, "13 vertices"),
        (|desc| desc.triangle_count = u32::MAX, "4294967295 triangles"),
        (|desc| desc.draw_count = 2, "2 draws"),
        (|desc| desc.bounds[1][2] = f32::NAN, "finite"),
        (|desc| desc.bounds[0][0] = f32::NEG_INFINITY, "finite"),
        (|desc| desc.bounds[0][1] = 1.5, "the lower corner first"),
    ];
    for (change, text) in wrong {
        let mut desc = desc.clone();
        change(&mut desc);
        let error = Geometry::new(device, desc).map(drop).expect_err(text);
        assert!(matches!(error, AdsError::Geometry { .. }), "{error}");
        assert!(error.to_string().contains(text), "{error}");
    }
}

/// Bounds are what cells are placed by: a triangle outside of them would be lost without notice.
#[test]
fn triangles_outside_of_the_stated_bounds_are_counted_and_no_build_is_complete() {
    let bench = Bench::new();
    let device = bench.device();
    let triangles = closed_box([-1.0; 3], [1.0; 3]);
    let sound = bench.geometry(&triangles);
    let tight = GeometryDesc { bounds: [[-1.0, -1.0, -1.0], [1.0, 1.0, 0.5]], ..sound.desc().clone() };
    let tight = Geometry::new(device, tight).expect("the host cannot see it");
    let few = GeometryDesc { vertex_count: 35, ..sound.desc().clone() };
    let few = Geometry::new(device, few).expect("the host cannot see it");
    let reaching = triangles.iter().filter(|triangle| triangle.iter().any(|corner| corner[2] > 0.5)).count();
    let rays = [Ray::new([0.0; 3], [0.1, 0.2, 1.0]); 5];
    let tracer = BatchTracer::new(device, 8).expect("a queue fits");
    for subject in Subject::all() {
        if subject.spec.system().name == "brute-force" {
            // It reads no bounds, and takes an invalid vertex for the origin.
            continue;
        }
        for (geometry, outside) in [(&tight, reaching as u32), (&few, 1)] {
            let mut structure = subject.spec.create(device, geometry, None).expect("it can be made");
            let status = bench.build_once(structure.as_mut(), [0.0; 3]);
            assert_eq!((status.complete, status.outside), (false, outside), "{}", subject.name());
            let error = structure.check(&status, 0).expect_err("no size helps");
            assert!(
                matches!(error, AdsError::OutsideBounds { triangles } if triangles == outside),
                "{error}"
            );
            let outcome = tracer.trace(structure.as_ref(), &rays, TraceMode::Closest, Timing::None);
            assert!(matches!(outcome, Err(TracerError::NotReady { .. })), "{}", subject.name());
            // It is as good as new once the triangles are.
            structure.set_geometry(device, &sound).expect("it fits");
            build_until_complete(device, structure.as_mut(), [0.0; 3], Timing::None).expect("it is sound");
            assert!(bench.trace(structure.as_ref(), &rays).hits.iter().all(Hit::is_hit));
        }
    }
}
