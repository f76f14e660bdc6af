//! Ten million triangles: traced or refused by name. Full tier only.

use std::collections::HashMap;

use rasray_abuffer::{ABuffer, Config};
use rasray_ads::{Draw, Geometry, GeometryDesc, Hit, Ray};
use rasray_gpu::{BufferUsage, Timing};
use rasray_metrics::{DeviceHit, HitConfusion};
use rasray_reference::oracle::Oracle;
use rasray_systems::Spec;
use rasray_tests::hard_cases::{self, HardCase, Scale};
use rasray_tests::harness::Bench;
use rasray_tests::tier::is_full;
use rasray_tracer::build_until_complete;

const RAYS: usize = 10_000;

/// Structures that find triangles without loss, with pools beyond what one binding of many devices holds. The
/// tree of the host is left out, which takes minutes.
const TRIANGLES: &[(&str, &[(&str, &str)])] = &[
    ("bricks", &[("views", "cube"), ("addressing", "address")]),
    ("bvh", &[("addressing", "address"), ("builder", "lbvh")]),
];

/// Corners without repetition, and indices: what a loader makes of the triangles.
fn shared(case: &HardCase) -> (Vec<[f32; 3]>, Vec<u32>) {
    let mut places: HashMap<[u32; 3], u32> = HashMap::new();
    let (mut positions, mut indices) = (Vec::new(), Vec::with_capacity(3 * case.triangles.len()));
    for corner in case.triangles.as_flattened() {
        let place = *places.entry(corner.map(f32::to_bits)).or_insert(positions.len() as u32);
        if place as usize == positions.len() {
            positions.push(*corner);
        }
        indices.push(place);
    }
    (positions, indices)
}

/// The geometry on the device, or why it does not fit.
fn upload(bench: &Bench, positions: &[[f32; 3]], indices: &[u32]) -> Result<Geometry, String> {
    let device = bench.device();
    let triangle_count = (indices.len() / 3) as u32;
    let draws = [Draw { first_triangle: 0, triangle_count, ..Draw::default() }];
    let buffer = |name, bytes: &[u8]| {
        device.create_buffer_with(name, BufferUsage::STORAGE, bytes).map_err(|error| error.to_string())
    };
    let desc = GeometryDesc {
        positions: buffer("positions", bytemuck::cast_slice(positions))?.into(),
        indices: buffer("indices", bytemuck::cast_slice(indices))?.into(),
        draws: buffer("draws", bytemuck::cast_slice(&draws))?.into(),
        vertex_count: positions.len() as u32,
        triangle_count,
        count: None,
        draw_count: 1,
        bounds: [[-2.0; 3], [2.0; 3]],
        frame_origin: [0.0; 3],
    };
    Geometry::new(device, desc).map_err(|error| error.to_string())
}

/// Hits as the metrics know them: all of these structures know their triangles.
fn named(hits: &[Hit]) -> Vec<Option<DeviceHit>> {
    let named = |hit: &Hit| DeviceHit { t: hit.t, primitive: Some(hit.primitive) };
    hits.iter().map(|hit| hit.is_hit().then(|| named(hit))).collect()
}

#[test]
fn ten_million_triangles_are_traced_or_refused() {
    if !is_full() {
        eprintln!("skipped: set RASRAY_FULL to 1 for ten million triangles");
        return;
    }
    let bench = Bench::new();
    // Tiny random triangles are lost where no cell's centre is in them: nothing bounds how many.
    for (id, most_missed) in [("C3", Some(0.01)), ("C3-random", None)] {
        let scale = Scale { rays: RAYS, seed: 1, full: true };
        let case = hard_cases::case(id, scale).expect("it exists");
        assert!(case.triangles.len() > 9_900_000, "{id}: {}", case.triangles.len());
        let (positions, indices) = shared(&case);
        let geometry = match upload(&bench, &positions, &indices) {
            Ok(geometry) => geometry,
            Err(refusal) => {
                // By name and with both sizes.
                assert!(refusal.contains("positions") || refusal.contains("indices"), "{refusal}");
                assert!(refusal.contains("bytes"), "{refusal}");
                println!("{id}: refused: {refusal}");
                continue;
            }
        };
        let mut structure =
            ABuffer::new(bench.device(), Config::at_centres(64), &geometry, None).expect("it is valid");
        let rays: Vec<Ray> = case.rays.iter().map(|ray| Ray::new(ray.origin, ray.direction)).collect();
        let hits = bench.build_and_trace(&mut structure, case.eye, &rays);
        let hits = named(&hits);
        let oracle = Oracle::new(&positions, &indices, None).expect("well formed");
        let verdicts = oracle.closest_batch(&case.rays);
        let confusion = HitConfusion::measure(&verdicts, &hits, 1e-3).expect("one hit per ray");
        println!("{id}: {confusion:?}");
        assert_eq!(confusion.non_finite.count, 0, "{id}: {confusion:?}");
        if let Some(most) = most_missed {
            let [_, missed] = confusion.missed.interval().expect("rays hit");
            assert!(missed <= most, "{id}: {confusion:?}");
            // Without every tenth hit it would not do.
            let gaps: Vec<_> =
                hits.iter().enumerate().map(|(ray, hit)| hit.filter(|_| ray % 10 != 0)).collect();
            let worse = HitConfusion::measure(&verdicts, &gaps, 1e-3).expect("one hit per ray");
            assert!(worse.missed.interval().expect("rays hit")[0] > most);
        }
        for (system, options) in TRIANGLES {
            let name = format!("{id}, {system}");
            let options = options.iter().map(|(option, value)| ((*option).to_owned(), (*value).to_owned()));
            let spec = Spec::new(system, "robust", options).expect("the options are valid");
            let made = spec.create(bench.device(), &geometry, None).map_err(|error| error.to_string());
            let built = made.and_then(|mut structure| {
                build_until_complete(bench.device(), structure.as_mut(), case.eye, Timing::None)
                    .map_err(|error| error.to_string())?;
                Ok(structure)
            });
            let structure = match built {
                Ok(structure) => structure,
                Err(refusal) => {
                    assert!(refusal.contains("bytes") || refusal.contains("feature"), "{name}: {refusal}");
                    println!("{name}: refused: {refusal}");
                    continue;
                }
            };
            let hits = named(&bench.trace(structure.as_ref(), &rays).hits);
            let confusion = HitConfusion::measure(&verdicts, &hits, 0.0).expect("one hit per ray");
            let bytes = structure.report().expect("the header is readable").bytes();
            println!("{name}: {} MiB, {confusion:?}", bytes >> 20);
            assert!(confusion.is_clean(), "{name}: {confusion:?}");
            assert!(confusion.t_off.count == 0 && confusion.t_off.total > 9_000, "{name}: {confusion:?}");
        }
    }
}
