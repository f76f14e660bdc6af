//! Build and trace times of every registered system: `cargo bench -- [SCENE] [RAYS]`.

use rasray_ads::TraceMode;
use rasray_benches::{BenchError, Stage};
use rasray_metrics::median;
use rasray_systems::{SYSTEMS, Spec};
use rasray_tracer::{BatchTracer, build_until_complete};

const REPETITIONS: usize = 5;

fn main() -> Result<(), BenchError> {
    let arguments: Vec<String> = std::env::args().skip(1).filter(|a| !a.starts_with("--")).collect();
    let scene = arguments.first().map_or("spheres:10k", String::as_str);
    let rays: u32 = arguments.get(1).and_then(|text| text.parse().ok()).unwrap_or(4096);
    let stage = Stage::new(scene)?;
    let device = &stage.device;
    println!("{}, {scene}, {rays} incoherent rays, medians of {REPETITIONS}", device.name());

    let timing = device.best_timing();
    let rays = stage.incoherent_rays(rays);
    let tracer = BatchTracer::new(device, rays.len().clamp(1, 131_072) as u32)?;
    let mut rows = Vec::new();
    for system in SYSTEMS {
        for preset in system.presets {
            let spec = Spec::new(system.name, preset.name(), [])?;
            let mut structure = spec.create(device, stage.scene.geometry(), Some(stage.scene.binding()))?;
            build_until_complete(device, structure.as_mut(), stage.scene.eye(), timing)?;
            rows.push((format!("{} {}", system.name, preset.name()), structure, Vec::new(), Vec::new()));
        }
    }
    for _ in 0..REPETITIONS {
        for (_, structure, builds, traces) in &mut rows {
            let outcome = build_until_complete(device, structure.as_mut(), stage.scene.eye(), timing)?;
            builds.push(outcome.host_milliseconds);
            let traced = tracer.trace(structure.as_ref(), &rays, TraceMode::Closest, timing)?;
            traces.push(traced.milliseconds());
        }
    }
    println!("{:<24} {:>12} {:>12} {:>14}", "system", "build ms", "trace ms", "Mrays/s");
    for (name, _, builds, traces) in &rows {
        let (build, trace) = (median(builds).unwrap_or(0.0), median(traces).unwrap_or(0.0));
        println!("{name:<24} {build:>12.2} {trace:>12.2} {:>14.3}", rays.len() as f64 / trace / 1.0e3);
    }
    Ok(())
}
