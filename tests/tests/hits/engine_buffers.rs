//! Triangles as an engine has them: one buffer for everything, vertices with more than a position, indices of
//! 16 bits, base vertices, a number of triangles that only the device knows. Hits are those of packed
//! buffers, bit for bit.

use rasray_ads::{
    BoundsPass, BufferOffset, Draw, Geometry, GeometryDesc, GeometryHeader, IndexFormat, IndexRange,
    Indexing, PositionRange, Structure,
};
use rasray_gpu::BufferUsage;
use rasray_tests::harness::Bench;
use rasray_tests::invariance::{EYE, Subject, assert_same, ray_count, rays, scene};
use rasray_tests::shapes::{Triangle, closed_box};

/// Vertices of no triangle, before all others.
const UNUSED_VERTICES: u32 = 5;

/// Layout of triangles in the buffer.
#[derive(Clone, Copy)]
struct Layout {
    name: &'static str,
    stride: u32,
    format: IndexFormat,
    per_draw: bool,
    counted: bool,
}

/// As [`Geometry`] takes them without options.
const PACKED: Layout =
    Layout { name: "packed", stride: 12, format: IndexFormat::U32, per_draw: false, counted: false };

const LAYOUTS: [Layout; 6] = [
    Layout { name: "strided", stride: 28, ..PACKED },
    Layout { name: "u16", format: IndexFormat::U16, ..PACKED },
    Layout { name: "base vertices", per_draw: true, ..PACKED },
    Layout { name: "u16 and base vertices", format: IndexFormat::U16, per_draw: true, ..PACKED },
    Layout { name: "counted", counted: true, ..PACKED },
    Layout { name: "everything", stride: 20, format: IndexFormat::U16, per_draw: true, counted: true },
];

/// The buffer of an engine. Whatever nobody placed is all ones: not a number, and no index.
#[derive(Default)]
struct Engine {
    bytes: Vec<u8>,
}

impl Engine {
    /// Puts values at the first multiple of `alignment` that leaves something before them, which no larger
    /// power of two below 256 divides.
    fn place<T: bytemuck::NoUninit>(&mut self, values: &[T], alignment: usize) -> u64 {
        let mut offset = (self.bytes.len() + 1).next_multiple_of(alignment);
        if alignment < 256 && offset.is_multiple_of(2 * alignment) {
            offset += alignment;
        }
        self.bytes.resize(offset, 0xFF);
        self.bytes.extend_from_slice(bytemuck::cast_slice(values));
        offset as u64
    }
}

/// Three draws of different lengths over so many triangles.
fn draws(triangles: u32) -> Vec<Draw> {
    let starts = [0, triangles / 3, triangles / 2, triangles];
    starts
        .windows(2)
        .map(|ends| Draw { first_triangle: ends[0], triangle_count: ends[1] - ends[0], ..Draw::default() })
        .collect()
}

/// Triangles in the buffer of an engine, with its count where there is one.
fn geometry(bench: &Bench, triangles: &[Triangle], layout: Layout) -> (Geometry, Option<BufferOffset>) {
    let Layout { name, stride, format, per_draw, counted } = layout;
    let count = triangles.len() as u32;
    let mut draws = draws(count);
    let mut vertices = vec![[0.0_f32; 3]; UNUSED_VERTICES as usize];
    let mut indices: Vec<u32> = Vec::new();
    if per_draw {
        // Vertices of the last draw come first, indices of the second.
        for draw in draws.iter_mut().rev() {
            let bias = [0, 7, 40_000][draw.first_triangle as usize % 3];
            draw.base_vertex = vertices.len() as i32 - bias;
            let first = draw.first_triangle as usize;
            vertices.extend(triangles[first..first + draw.triangle_count as usize].iter().flatten());
        }
        for place in [1, 2, 0] {
            indices.extend([u32::MAX; 3]);
            let draw = &mut draws[place];
            draw.first_index = indices.len() as u32;
            let bias = [0, 7, 40_000][draw.first_triangle as usize % 3];
            indices.extend((0..3 * draw.triangle_count).map(|corner| corner + bias));
        }
    } else {
        vertices.extend(triangles.iter().flatten());
        indices.extend(UNUSED_VERTICES..UNUSED_VERTICES + 3 * count);
    }
    let mut engine = Engine::default();
    let words = stride as usize / 4;
    let mut strided = vec![u32::MAX; words * vertices.len()];
    for (vertex, position) in strided.chunks_mut(words).zip(&vertices) {
        vertex[..3].copy_from_slice(&position.map(f32::to_bits));
    }
    let positions = engine.place(&strided, 4);
    let index_count = indices.len() as u32;
    let indices = match format {
        IndexFormat::U16 => engine.place(&indices.iter().map(|index| *index as u16).collect::<Vec<_>>(), 2),
        IndexFormat::U32 => engine.place(&indices, 4),
    };
    let draw_records = engine.place(&draws, 256);
    let counter = engine.place(&[count], 4);
    let usage = BufferUsage::STORAGE | BufferUsage::TRANSFER_SRC;
    let buffer = bench.device().create_buffer_with(name, usage, &engine.bytes).expect("it fits");
    let at = |offset| BufferOffset { buffer: buffer.clone(), offset };
    let mut bounds = [[f32::INFINITY; 3], [f32::NEG_INFINITY; 3]];
    for corner in triangles.iter().flatten() {
        bounds[0] = std::array::from_fn(|axis| bounds[0][axis].min(corner[axis]));
        bounds[1] = std::array::from_fn(|axis| bounds[1][axis].max(corner[axis]));
    }
    let indexing = if per_draw { Indexing::PerDraw { index_count } } else { Indexing::Absolute };
    let desc = GeometryDesc {
        positions: PositionRange { buffer: buffer.clone(), offset: positions, stride },
        indices: IndexRange { buffer: buffer.clone(), offset: indices, format, indexing },
        draws: at(draw_records),
        vertex_count: vertices.len() as u32,
        triangle_count: count,
        count: counted.then(|| at(counter)),
        draw_count: draws.len() as u32,
        bounds,
        frame_origin: [0.0; 3],
    };
    (Geometry::new(bench.device(), desc).expect("the buffer holds it"), counted.then(|| at(counter)))
}

/// Tells the device how many triangles there are.
fn set_count(bench: &Bench, count: &BufferOffset, triangles: u32) {
    bench.device().upload_slice(&count.buffer, count.offset, &[triangles]).expect("the device works");
}

fn corners(bench: &Bench, geometry: &Geometry) -> Vec<Triangle> {
    let (positions, indices) = geometry.download(bench.device()).expect("the device works");
    indices.chunks(3).map(|three| std::array::from_fn(|corner| positions[three[corner] as usize])).collect()
}

fn assert_sound(bench: &Bench, name: &str, structure: &dyn Structure) {
    let fault = structure.inspect().map_or(Ok(None), |pools| pools.fault(bench.device()));
    assert_eq!(fault.expect("the device works"), None, "{name}");
}

#[test]
fn buffers_of_an_engine_change_no_hit() {
    let bench = Bench::new();
    let (triangles, rays) = (scene(true), rays(ray_count()));
    let packed = geometry(&bench, &triangles, PACKED).0;
    let layouts = LAYOUTS.map(|layout| (layout.name, geometry(&bench, &triangles, layout).0));
    for (name, geometry) in &layouts {
        assert!(corners(&bench, geometry) == triangles, "{name}");
    }
    for subject in Subject::all() {
        let mut structure =
            subject.spec.create(bench.device(), &packed, None).expect("the options are valid");
        let expected = subject.answers_of(&bench, EYE, structure.as_mut(), &rays);
        for (name, geometry) in &layouts {
            let name = format!("{}: {name}", subject.name());
            structure.set_geometry(bench.device(), geometry).expect("it fits");
            let found = subject.answers_of(&bench, EYE, structure.as_mut(), &rays);
            assert_same(&name, &rays, &expected, &found);
            assert_sound(&bench, &name, structure.as_ref());
        }
    }
}

/// Measured before anything is gathered, from indices of every kind.
#[test]
fn bounds_are_those_of_the_triangles_wherever_their_indices_lie() {
    let bench = Bench::new();
    let device = bench.device();
    let pass = BoundsPass::new(device).expect("the device works");
    let triangles = scene(true);
    for layout in LAYOUTS {
        let (whole, counter) = geometry(&bench, &triangles, layout);
        let stated = whole.desc().bounds;
        let desc = GeometryDesc { bounds: [[0.0; 3]; 2], ..whole.desc().clone() };
        let unmeasured = Geometry::new(device, desc).expect("the buffer holds it");
        let measured = || {
            device.submit(|recorder| pass.record(recorder, &unmeasured)).expect("the device works");
            let header = device.download_as::<GeometryHeader>(unmeasured.header(), 0, 1);
            let header = header.expect("the device works")[0];
            [header.lower, header.upper]
        };
        assert_eq!(measured(), stated, "{}", layout.name);
        if let Some(counter) = counter {
            set_count(&bench, &counter, 1);
            let corners = |with: fn(f32, f32) -> f32| -> [f32; 3] {
                std::array::from_fn(|axis| {
                    triangles[0].iter().map(|corner| corner[axis]).reduce(with).expect("three corners")
                })
            };
            assert_eq!(measured(), [corners(f32::min), corners(f32::max)], "{}: one", layout.name);
        }
    }
}

#[test]
fn triangles_beyond_the_count_of_the_device_do_not_exist() {
    let bench = Bench::new();
    let mut triangles = scene(true);
    let count = triangles.len() as u32;
    // No ray from near the eye would leave it.
    triangles.extend(closed_box(EYE.map(|x| x - 1.0), EYE.map(|x| x + 1.0)));
    let most = triangles.len() as u32;
    let rays = rays(ray_count());
    let layout = Layout { counted: true, ..PACKED };
    let (whole, counter) = geometry(&bench, &triangles, layout);
    let counter = counter.expect("it is counted");
    let bounds = whole.desc().bounds;
    // Geometry whose number of triangles the host knows; cells are laid out for the same maximum where that
    // decides hits.
    let alone = |count: u32| {
        let desc = GeometryDesc { triangle_count: count, count: None, bounds, ..whole.desc().clone() };
        Geometry::new(bench.device(), desc).expect("it is part of it")
    };
    let counts = [count, 1, 0, 2, count / 2, most];
    let alone = counts.map(|count| (count, alone(count)));
    for subject in Subject::all() {
        let name = subject.name();
        let mut structure = subject.spec.create(bench.device(), &whole, None).expect("the options are valid");
        for (count, alone) in &alone {
            let mut known = subject.spec.create(bench.device(), alone, None).expect("the options are valid");
            let expected = subject.answers_of(&bench, EYE, known.as_mut(), &rays);
            set_count(&bench, &counter, *count);
            let found = subject.answers_of(&bench, EYE, structure.as_mut(), &rays);
            assert_same(&format!("{name}: {count} of {most}"), &rays, &expected, &found);
            assert_sound(&bench, &name, structure.as_ref());
            assert_eq!(whole.download_count(bench.device()).expect("the device works"), *count);
        }
        set_count(&bench, &counter, most + 3);
        let status = bench.build_once(structure.as_mut(), EYE);
        if subject.spec.system().name == "brute-force" {
            // It has no build that could be incomplete, and takes the maximum.
            assert_eq!(whole.download_count(bench.device()).expect("the device works"), most);
        } else {
            assert_eq!((status.complete, status.outside), (false, 3), "{name}");
        }
    }
}

/// Draws that the device wrote are not trusted: invalid indices in them are counted.
#[test]
fn draws_with_invalid_indices_are_counted() {
    let bench = Bench::new();
    let device = bench.device();
    let triangles = closed_box([-1.0; 3], [1.0; 3]);
    let subject = Subject::all().into_iter().find(|subject| subject.name() == "bricks robust");
    let subject = subject.expect("the registry has bricks");
    for format in [IndexFormat::U16, IndexFormat::U32] {
        let layout = Layout { per_draw: true, format, ..PACKED };
        let (geometry, _) = geometry(&bench, &triangles, layout);
        let BufferOffset { buffer, offset } = &geometry.desc().draws;
        let sound: Vec<Draw> = device.download_as(buffer, *offset, 3).expect("the device works");
        let mut structure = subject.spec.create(device, &geometry, None).expect("it can be made");
        // Draws have four, two and six of the twelve triangles.
        assert_eq!(sound.iter().map(|draw| draw.triangle_count).collect::<Vec<_>>(), [4, 2, 6]);
        type Change = fn(&mut [Draw]);
        let changes: [(Change, u32); 7] = [
            (|_| {}, 0),
            (|draws| draws[1].first_index = u32::MAX - 1, 2),
            (|draws| draws[2].first_index = 44, 6),
            (|draws| draws[0].base_vertex = 100, 4),
            (|draws| draws[0].base_vertex = -1, 1),
            (|draws| draws[1].triangle_count = 1, 1),
            (|draws| draws[0].first_triangle = 3, 3),
        ];
        for (change, outside) in changes {
            let mut draws = sound.clone();
            change(&mut draws);
            device.upload_slice(buffer, *offset, &draws).expect("the device works");
            let status = bench.build_once(structure.as_mut(), EYE);
            assert_eq!(status.outside, outside, "{draws:?}");
            device.upload_slice(buffer, *offset, &sound).expect("the device works");
        }
    }
}

#[test]
fn ranges_are_what_is_read_and_one_family_needs_no_transfer() {
    let bench = Bench::new();
    let device = bench.device();
    let layout = LAYOUTS[5];
    let (geometry, _) = geometry(&bench, &closed_box([-1.0; 3], [1.0; 3]), layout);
    let ranges = geometry.ranges(device);
    let vertices = 36 + u64::from(UNUSED_VERTICES);
    let positions = (vertices - 1) * 20 + 12;
    // 36 of triangles, three before each draw; an odd place and an odd number fill whole words.
    let indices = 2 * (36 + 9);
    assert_eq!(
        ranges.iter().map(|range| range.size).collect::<Vec<_>>(),
        [positions, indices, 3 * size_of::<Draw>() as u64, 4]
    );
    // Indices among the positions: one range.
    let mut desc = geometry.desc().clone();
    desc.indices.offset = desc.positions.offset + 20;
    let joined = desc.positions.offset;
    let inside = Geometry::new(device, desc).expect("the buffer holds it");
    let ranges = inside.ranges(device);
    assert_eq!(ranges.iter().map(|range| range.size).collect::<Vec<_>>(), [positions, 72, 4]);
    assert_eq!(ranges[0].offset, joined);
    let family = device.queue_family();
    device
        .submit(|recorder| {
            geometry.record_acquire(recorder, family);
            geometry.record_release(recorder, family);
        })
        .expect("nothing is recorded that could fail");
}
