//! Fixture: a report that has every part, made without a device; its numbers are plausible, not measured.

#![allow(
    clippy::field_reassign_with_default,
    clippy::needless_update,
    reason = "fields may be added to the schema"
)]

use rasray_metrics::Rate;
use rasray_report::figures::{DepthErrors, Figures, Images, SystemImage, WorkMap};
use rasray_report::{
    Accuracy, Counters, HardRecord, ImageError, Memory, Pass, PassOf, RateRecord, Report, Run, SCHEMA,
    Spread, Times,
};
use serde_json::json;

/// Width of all pictures, pixels.
pub const WIDTH: u32 = 96;
/// Height of all pictures, pixels.
pub const HEIGHT: u32 = 54;

/// Contestants: system, preset, Mrays/s of camera rays, wrong answers of 200,000, and the factor of errors in
/// t.
const CONTESTANTS: [(&str, &str, f64, u64, f64); 5] = [
    ("mmrt", "robust", 1.9, 14, 4.0),
    ("mmrt", "published", 3.4, 870, 40.0),
    ("dirt", "robust", 1.2, 0, 0.0),
    ("bvh", "robust", 6.5, 0, 1.0),
    ("brute-force", "robust", 0.02, 0, 0.0),
];

/// Makes passes whose shares add up to the figure while their medians do not, and some of which are
/// dispatched often.
fn passes(figure: f64, of: PassOf, system: &str) -> Vec<Pass> {
    let names: &[&str] = match (of, system) {
        (PassOf::Build, "mmrt") => {
            &["count", "scan", "fill", "sort", "skip", "bounds", "pages", "clear", "header", Pass::WAITING]
        }
        (PassOf::Build, "bvh") => &[Pass::HOST, "refit", Pass::WAITING],
        (PassOf::Build, "brute-force") => &[Pass::WAITING],
        (PassOf::Build, _) => &["bin", "scan", "scatter", Pass::WAITING],
        (PassOf::Pose, _) => &[Pass::HOST, "pose_vertices"],
        (PassOf::Trace, _) => &["trace_queue"],
        (PassOf::Image, _) => &["generate", "trace_queue", "shade"],
    };
    let weight = |index: usize| 1.0 / (1.0 + ((index * 5) % 7) as f64);
    let all: f64 = (0..names.len()).map(weight).sum();
    let pass = |(index, name): (usize, &&str)| {
        let share = figure * weight(index) / all;
        let median = 0.97 * share;
        let mut pass = Pass::default();
        pass.label =
            if name.starts_with("host") { (*name).to_owned() } else { format!("{system}/{name}.comp") };
        (pass.of, pass.ms_share, pass.dispatches) = (Some(of), Some(share), Some(1 + 5 * index as u64));
        (pass.ms_median, pass.ms_min, pass.ms_max) = (median, 0.9 * median, 1.3 * median);
        (pass.ms_q1, pass.ms_q3) = (Some(0.95 * median), Some(1.1 * median));
        pass
    };
    names.iter().enumerate().map(pass).collect()
}

fn memory(system: &str) -> Memory {
    let parts: &[(&str, u64)] = match system {
        "mmrt" => &[("fragments", 9_437_184), ("heads", 3_145_728), ("skip", 524_288)],
        "brute-force" => &[("triangles", 480_000)],
        _ => &[("cells", 2_097_152), ("lists", 6_291_456)],
    };
    let total: u64 = parts.iter().map(|part| part.1).sum();
    Memory {
        structure_bytes: Some(total),
        formula_bytes: Some(total * 9 / 10),
        capacity_bytes: Some(total * 12 / 10),
        by_part: parts.iter().map(|(name, size)| ((*name).to_owned(), *size)).collect(),
        ..Default::default()
    }
}

fn spread(name: &str, median: f64) -> (String, Spread) {
    let spread =
        Spread { count: 5, min: 0.9 * median, q1: 0.95 * median, q3: 1.1 * median, max: 1.2 * median };
    (name.to_owned(), spread)
}

/// Returns the rate of `count` in 199,959 rays.
fn rate(name: &str, count: u64) -> (String, RateRecord) {
    let record = RateRecord::of(Rate { count, total: 199_959 }).expect("rays");
    (name.to_owned(), record)
}

fn run(contestant: &(&str, &str, f64, u64, f64), slowness: f64, of: PassOf) -> Run {
    let (system, preset, rate, ..) = *contestant;
    let (build_ms, trace_ms) = (40.0 / rate.sqrt(), slowness * 200.0 / rate);
    let image_ms = (of == PassOf::Image).then_some(1.25 * trace_ms);
    let traced = passes(image_ms.unwrap_or(trace_ms), of, system);
    Run {
        system: system.to_owned(),
        structure: if system == "mmrt" { "abuffer" } else { system }.to_owned(),
        preset: preset.to_owned(),
        options: [("resolution".to_owned(), 512.into()), ("march".to_owned(), "dda".into())].into(),
        paths: [("builder".to_owned(), "raster".to_owned())].into(),
        seed: Some(1),
        spread: [spread("build_ms", 40.0 / rate.sqrt()), spread("trace_ms", slowness * 200.0 / rate)].into(),
        times: Times {
            build_ms: Some(40.0 / rate.sqrt()),
            trace_ms: Some(slowness * 200.0 / rate),
            frame_ms: Some(slowness * 200.0 / rate + 40.0 / rate.sqrt()),
            rays: Some(200_000),
            mrays_per_s: Some(rate / slowness),
            image_ms,
            ..Default::default()
        },
        passes: passes(build_ms, PassOf::Build, system).into_iter().chain(traced).collect(),
        memory: Some(memory(system)),
        counters: Some(Counters {
            cells_per_ray: Some(12.0 * slowness),
            nodes_per_ray: Some(31.5 / rate),
            tests_per_ray: Some(5.25 / rate),
            ..Default::default()
        }),
        ..Default::default()
    }
}

fn traced(contestant: &(&str, &str, f64, u64, f64), set: &str, slowness: f64) -> Run {
    let (system, _, _, wrong, factor) = *contestant;
    Run {
        ray_set: Some(set.to_owned()),
        accuracy: Some(Accuracy {
            rays: 200_000,
            ambiguous: 41,
            missed: wrong / 2,
            false_hits: wrong / 7,
            wrong_primitive: (system != "mmrt").then_some(wrong - wrong / 2 - wrong / 7),
            dt_rel_p50: Some(factor * 2.1e-8),
            dt_rel_p90: Some(factor * 8.0e-8),
            dt_rel_p999: Some(factor * 1.1e-6),
            dt_rel_p99: Some(factor * 1.7e-7),
            dt_rel_max: Some(factor * factor * 9.0e-6),
            rates: [rate("missed", wrong / 2), rate("false_hits", wrong / 7)].into(),
            ..Default::default()
        }),
        ..run(contestant, slowness, PassOf::Trace)
    }
}

fn depth_errors(run: usize, factor: f64) -> DepthErrors {
    let center = 7.0 + 4.0 * (1.0 + factor).log10();
    let count = |bin: usize| (9.0e4 * (-(bin as f64 - center).powi(2) / 4.0).exp()) as u64;
    let bins =
        if factor == 0.0 { vec![0; DepthErrors::BINS] } else { (0..DepthErrors::BINS).map(count).collect() };
    DepthErrors { run, zero: 60_000, bins }
}

/// Draws a shaded disc over a gradient, with `noise` in the red channel.
fn pixels(noise: f32) -> Vec<[f32; 3]> {
    each_pixel(|x, y| {
        let distance = (x * x + y * y).sqrt();
        let light = (1.0 - distance).max(0.0).sqrt();
        let speck = if (x * 41.0 + y * 67.0).sin() > 0.8 { noise } else { 0.0 };
        [0.05 + light + speck, 0.1 + 0.8 * light, 0.2 + 0.3 * (1.0 + y) + 0.4 * light]
    })
}

fn each_pixel<T>(value: impl Fn(f32, f32) -> T) -> Vec<T> {
    let place = |index: u32| (index % WIDTH, index / WIDTH);
    let coordinates = |(column, row): (u32, u32)| {
        let scale = 2.0 / HEIGHT as f32;
        (column as f32 * scale - WIDTH as f32 / HEIGHT as f32, row as f32 * scale - 1.0)
    };
    (0..WIDTH * HEIGHT).map(|index| coordinates(place(index))).map(|(x, y)| value(x, y)).collect()
}

fn work(run: usize, rate: f64) -> WorkMap {
    let cost = |scale: f64| {
        each_pixel(move |x, y| (scale / rate * f64::from(1.5 - (x * x + y * y).sqrt()).max(0.02)) as u32)
    };
    WorkMap { run, width: WIDTH, height: HEIGHT, cells: cost(40.0), entries: cost(90.0), tests: cost(20.0) }
}

/// Makes a report of two ray sets and images of five contestants on a scene of that name.
pub fn everything(scene: &str) -> (Report, Figures) {
    let mut runs = Vec::new();
    let mut figures = Figures::default();
    for (set, slowness) in [("camera", 1.0), ("incoherent", 2.2)] {
        for contestant in &CONTESTANTS {
            figures.depth_errors.push(depth_errors(runs.len(), contestant.4));
            if set == "camera" {
                figures.work.push(work(runs.len(), contestant.2));
            }
            runs.push(traced(contestant, set, slowness));
        }
    }
    let mut images = Images { width: WIDTH, height: HEIGHT, reference: pixels(0.0), systems: Vec::new() };
    for contestant in &CONTESTANTS {
        let noise = contestant.3 as f32 / 1000.0;
        images.systems.push(SystemImage {
            run: runs.len(),
            pixels: pixels(noise),
            flip: pixels(noise).iter().zip(pixels(0.0)).map(|(a, b)| (a[0] - b[0]).clamp(0.0, 1.0)).collect(),
        });
        runs.push(Run {
            integrator: Some("path".to_owned()),
            width: Some(WIDTH),
            height: Some(HEIGHT),
            spp: Some(4),
            image: Some(ImageError {
                flip_mean: Some(f64::from(noise) * 0.04),
                flip_p99: Some(f64::from(noise) * 0.5),
                rmse: Some(f64::from(noise) * 0.02),
                ssim: Some(1.0 - f64::from(noise) * 0.01),
                ..Default::default()
            }),
            ..run(contestant, 3.0, PassOf::Image)
        });
    }
    figures.images = Some(images);
    let mut report: Report = serde_json::from_value(json!({
        "schema": SCHEMA,
        "version": "0.1.0",
        "commit": "0123456789ab",
        "device": {"name": "A device", "driver": "a driver 1.2", "software": true},
        "command": "rasray compare spheres:10k --html page.html",
        "scene": {"name": scene, "triangles": 10_000},
        "statistics": {
            "rates": 30, "confidence": 0.95, "family_confidence": 0.95, "confidence_of_each": 0.998_333,
        },
        "runs": [],
    }))
    .expect("the schema");
    report.runs = runs;
    (report, figures)
}

/// Makes the runs of hard cases, each traced by every contestant; every third verdict is bad.
#[allow(dead_code, reason = "each test program has its own copy")]
pub fn hard_runs(cases: usize) -> Vec<Run> {
    let mut runs = Vec::new();
    for case in 0..cases {
        for contestant in &CONTESTANTS {
            let hard = HardRecord {
                id: format!("E{case}"),
                title: "Rays through shared edges".to_owned(),
                measure: "rays that leak".to_owned(),
                target: "none".to_owned(),
                met: Some(runs.len() % 3 != 0),
                reason: format!("{} of 1,000 rays leaked", runs.len() % 3),
                ..Default::default()
            };
            runs.push(Run { hard: Some(hard), ..traced(contestant, "hard", 1.0) });
        }
    }
    runs
}
