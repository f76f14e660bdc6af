//! Costs of layouts of an engine's buffers: `cargo bench --bench geometry -- [SCENE] [RAYS]`.
//!
//! Prints, for each layout of vertices and indices, the medians of the builds and of the traces of random
//! rays through the default systems of triangles, alternated between layouts in one process, and their ratios
//! to packed buffers. Hits are the same for all layouts, and are compared. Times of software devices are for
//! ratios on that device.

use std::collections::HashMap;
use std::error::Error;

use rasray_ads::{
    BufferOffset, Draw, Geometry, GeometryDesc, Hit, IndexFormat, IndexRange, Indexing, PositionRange,
    Structure, TraceMode,
};
use rasray_benches::setting::{SEED, Setting};
use rasray_experiment::incoherent_rays;
use rasray_gpu::{BufferUsage, Device};
use rasray_metrics::median;
use rasray_systems::Spec;
use rasray_tracer::{BatchTracer, build_until_complete};

type Result<T> = std::result::Result<T, Box<dyn Error>>;

const REPETITIONS: u32 = 7;

/// Largest number of triangles per draw, small enough for the draw's vertices to have 16-bit indices.
const DRAW_TRIANGLES: usize = 20_000;

/// Layout of triangles in buffers.
#[derive(Clone, Copy)]
struct Layout {
    name: &'static str,
    /// Bytes from one position to the next.
    stride: u32,
    /// Format of the indices of each draw, which count from the draw's own first vertex; absent for u32
    /// indices that count from the first vertex of all.
    per_draw: Option<IndexFormat>,
}

/// Layouts, the packed one first: its times divide those of the others.
const LAYOUTS: [Layout; 5] = [
    Layout { name: "12 bytes, u32", stride: 12, per_draw: None },
    Layout { name: "32 bytes, u32", stride: 32, per_draw: None },
    Layout { name: "64 bytes, u32", stride: 64, per_draw: None },
    Layout { name: "12 bytes, u32 per draw", stride: 12, per_draw: Some(IndexFormat::U32) },
    Layout { name: "32 bytes, u16 per draw", stride: 32, per_draw: Some(IndexFormat::U16) },
];

/// Systems, and an option for some of them.
const SYSTEMS: [(&str, Option<[&str; 2]>); 3] =
    [("bricks", None), ("bvh", Some(["builder", "lbvh"])), ("dirt", None)];

/// Arranges vertices and indices in the layout, with a draw for each run of triangles.
fn arranged(positions: &[[f32; 3]], indices: &[u32], layout: Layout) -> (Vec<[f32; 3]>, Vec<u32>, Vec<Draw>) {
    let count = indices.len() / 3;
    if layout.per_draw.is_none() {
        let draw = Draw { triangle_count: count as u32, ..Draw::default() };
        return (positions.to_vec(), indices.to_vec(), vec![draw]);
    }
    let (mut vertices, mut local, mut draws) = (Vec::new(), Vec::with_capacity(indices.len()), Vec::new());
    for (number, run) in indices.chunks(3 * DRAW_TRIANGLES).enumerate() {
        let base = vertices.len();
        draws.push(Draw {
            first_triangle: (number * DRAW_TRIANGLES) as u32,
            triangle_count: (run.len() / 3) as u32,
            first_index: local.len() as u32,
            base_vertex: base as i32,
            ..Draw::default()
        });
        let mut known = HashMap::new();
        for &index in run {
            local.push(*known.entry(index).or_insert_with(|| {
                vertices.push(positions[index as usize]);
                (vertices.len() - 1 - base) as u32
            }));
        }
    }
    (vertices, local, draws)
}

/// Uploads the triangles into buffers of that layout.
fn geometry(
    device: &Device,
    (positions, indices, bounds): (&[[f32; 3]], &[u32], [[f32; 3]; 2]),
    layout: Layout,
) -> Result<Geometry> {
    let (vertices, indices, draws) = arranged(positions, indices, layout);
    let words = layout.stride as usize / 4;
    let mut strided = vec![0; words * vertices.len()];
    for (vertex, position) in strided.chunks_mut(words).zip(&vertices) {
        vertex[..3].copy_from_slice(&position.map(f32::to_bits));
    }
    let format = layout.per_draw.unwrap_or(IndexFormat::U32);
    let packed: Vec<u32> = match format {
        IndexFormat::U32 => indices.clone(),
        IndexFormat::U16 => {
            indices.chunks(2).map(|two| two[0] | two.get(1).copied().unwrap_or_default() << 16).collect()
        }
    };
    let usage = BufferUsage::STORAGE | BufferUsage::TRANSFER_SRC;
    let index_count = indices.len() as u32;
    let desc = GeometryDesc {
        positions: PositionRange {
            buffer: device.create_buffer_with("positions", usage, &strided)?,
            offset: 0,
            stride: layout.stride,
        },
        indices: IndexRange {
            buffer: device.create_buffer_with("indices", usage, &packed)?,
            offset: 0,
            format,
            indexing: match layout.per_draw {
                Some(_) => Indexing::PerDraw { index_count },
                None => Indexing::Absolute,
            },
        },
        draws: BufferOffset { buffer: device.create_buffer_with("draws", usage, &draws)?, offset: 0 },
        vertex_count: vertices.len() as u32,
        triangle_count: index_count / 3,
        count: None,
        draw_count: draws.len() as u32,
        bounds,
        frame_origin: [0.0; 3],
    };
    Ok(Geometry::new(device, desc)?)
}

/// Structure over one layout, and its measured times.
struct Measured {
    structure: Box<dyn Structure>,
    builds: Vec<f64>,
    traces: Vec<f64>,
    hits: Vec<Hit>,
}

fn main() -> Result<()> {
    let Setting { name, rays: count, device, stage, .. } =
        Setting::read("cargo bench --bench geometry", "spheres:100k", 50_000)?;
    let (positions, indices) = stage.triangles(&device)?;
    let bounds = stage.scene.geometry().bounds();
    let rays = incoherent_rays(bounds, SEED, count);
    let (eye, timing) = (stage.scene.eye(), device.best_timing());
    let tracer = BatchTracer::new(&device, count)?;
    let triangles = indices.len() / 3;
    println!(
        "{}, {name}, {triangles} triangles, {count} incoherent rays, medians of {REPETITIONS}",
        device.name()
    );
    println!("\n| system | layout | build | | trace | |\n|---|---|---|---|---|---|");
    for (system, option) in SYSTEMS {
        let options = option.iter().map(|[name, value]| ((*name).to_owned(), (*value).to_owned()));
        let spec = Spec::new(system, "robust", options)?;
        let made = |layout: Layout| -> Result<Measured> {
            let geometry = geometry(&device, (&positions, &indices, bounds), layout)?;
            let structure = spec.create(&device, &geometry, None)?;
            Ok(Measured { structure, builds: Vec::new(), traces: Vec::new(), hits: Vec::new() })
        };
        let mut layouts = LAYOUTS.into_iter().map(made).collect::<Result<Vec<_>>>()?;
        for repetition in 0..=REPETITIONS {
            for measured in &mut layouts {
                let built = build_until_complete(&device, measured.structure.as_mut(), eye, timing)?;
                let traced = tracer.trace(measured.structure.as_ref(), &rays, TraceMode::Closest, timing)?;
                if repetition > 0 {
                    // The first build compiles kernels and grows pools, and is not timed.
                    measured.builds.push(built.passes.iter().map(|pass| pass.milliseconds).sum());
                    measured.traces.push(traced.milliseconds());
                }
                measured.hits = traced.hits;
            }
        }
        let medians = |times: fn(&Measured) -> &Vec<f64>| -> Vec<f64> {
            layouts.iter().map(|measured| median(times(measured)).unwrap_or(f64::NAN)).collect()
        };
        let (builds, traces) = (medians(|measured| &measured.builds), medians(|measured| &measured.traces));
        for (place, layout) in LAYOUTS.iter().enumerate() {
            let bits = |hit: &Hit| (hit.t.to_bits(), hit.primitive);
            let is_same = layouts[place].hits.iter().map(bits).eq(layouts[0].hits.iter().map(bits));
            if !is_same {
                return Err(format!("{system}: other hits with {}", layout.name).into());
            }
            println!(
                "| {system} | {} | {:.2} | {:.2} | {:.2} | {:.2} |",
                layout.name,
                builds[place],
                builds[place] / builds[0],
                traces[place],
                traces[place] / traces[0]
            );
        }
    }
    Ok(())
}
